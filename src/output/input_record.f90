!> The input of a case for programs: what was asked, kept groups included
module contact_output_input_record
   use contact_base_choices, only : has_slope_reduction, heat_source_name, material_model, motion, pressure_model, variation
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, friction_set
   use contact_cases_collector, only : collected_length, collector, friction_numbers
   use contact_control_digits, only : case_digits, digit_table
   use contact_control_translation, only : digits_of
   use contact_output_record, only : record_writer
   use contact_wheelrail_spec, only : profile_spec
   use contact_friction_new_law, only : is_varying_law
   use contact_text_bounds, only : bounds_of, bounds_table
   use contact_text_words, only : integer_text, small
   implicit none (type, external)
   private

   public :: describe_input

contains

   !> All groups of the input
   subroutine describe_input(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec

      call describe_digits(record, spec)
      call describe_iteration(record, spec)
      call describe_kinematics(record, spec)
      call describe_friction(record, spec)
      call describe_material(record, spec)
      if (spec%has_damping) then
         call record%open_group("damping")
         call record%number("cdampn", "s", "normal damping coefficient", spec%damping%cdampn)
         call record%number("cdampt", "s", "tangential damping coefficient", spec%damping%cdampt)
         call record%number("dfnmax", "N/s", "largest rate of the normal force", spec%damping%dfnmax)
         call record%number("dftmax", "N/s", "largest rate of the tangential force", spec%damping%dftmax)
         call record%close_group()
      end if
      if (spec%has_heat) then
         call record%open_group("heat")
         call record%numbers("bktemp", "degC", "bulk temperatures of bodies 1 and 2", spec%heat%bktemp)
         call record%numbers("heatcp", "J/(kg degC)", "specific heat capacities", spec%heat%heatcp)
         call record%numbers("lambda", "W/(mm degC)", "heat conductivities", spec%heat%lambda)
         call record%numbers("dens", "kg/mm3", "densities", spec%heat%dens)
         call record%number("betapl", "-", "part of plastic work that becomes heat", spec%heat%betapl)
         call record%text("source", "how the heat of an element acts on itself", &
            & trim(heat_source_name(spec%heat%source)))
         call record%close_group()
      end if
      if (allocated(spec%wheel_rail)) then
         call describe_wheel_rail(record, spec)
      else
         call describe_geometry(record, spec)
      end if
   end subroutine describe_input

   !> Control digits as the case gave them
   subroutine describe_digits(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec
      type(case_digits) :: d

      d = digits_of(spec)
      call record%open_group("digits")
      if (allocated(spec%wheel_rail)) call record%count("c1", "CONFIG", d%c1)
      call record%count("p", "PVTIME", d%p)
      call record%count("b", "BOUND", d%b)
      call record%count("t", "TANG", d%t)
      call record%count("n", "NORM", d%n)
      call record%count("f", "FORCE", d%f)
      call record%count("s", "STRESS", d%s)
      call record%count("v", "VARFRC", d%v)
      call record%count("l", "FRCLAW", d%l)
      call record%count("d", "DISCNS", d%d)
      call record%count("c", "INFLCF", d%c)
      call record%count("m", "MATER", d%m)
      call record%count("z", "RZNORM, ZTRACK", d%z)
      call record%count("e", "EXRHS, EWHEEL", d%e)
      call record%count("h", "HEAT", d%h)
      call record%count("g", "GAUSEI", d%g)
      call record%count("i", "IESTIM", d%i)
      call record%close_group()
   end subroutine describe_digits

   !> Settings of the solvers
   subroutine describe_iteration(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec

      call record%open_group("iteration")
      associate (it => spec%iteration)
         call record%count("maxgs", "largest number of iterations of a solver", it%maxgs)
         call record%count("maxin", "largest number of changes of the element division", it%maxin)
         call record%count("maxnr", "largest number of iterations for forces", it%maxnr)
         call record%count("maxout", "largest number of outer iterations", it%maxout)
         call record%number("eps", "-", "relative tolerance", it%eps)
      end associate
      call record%close_group()
   end subroutine describe_iteration

   !> What is prescribed for the relative motion
   subroutine describe_kinematics(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec

      if (.not. allocated(spec%wheel_rail)) then
         call record%open_group("kinematics")
         associate (k => spec%kinematics)
            call record%number("pen", "mm", "approach, prescribed with N = 0", k%pen)
            call record%number("fn", "N", "normal force, prescribed with N = 1", k%fn)
            call record%number("fx", "-", "relative force FX, prescribed with F = 1, 2", k%fx)
            call record%number("fy", "-", "relative force FY, prescribed with F = 2", k%fy)
            if (spec%motion == motion%shift) then
               call record%number("cksi", "mm", "longitudinal shift", k%cksi)
               call record%number("ceta", "mm", "lateral shift", k%ceta)
               call record%number("cphi", "rad", "rotation", k%cphi)
            else
               call record%number("cksi", "-", "longitudinal creepage", k%cksi)
               call record%number("ceta", "-", "lateral creepage", k%ceta)
               call record%number("cphi", "rad/mm", "spin", k%cphi)
            end if
            call record%close_group()
         end associate
         call record%open_group("rolling")
         call record%number("spinxo", "mm", "spin centre", spec%kinematics%spinxo)
         call record%number("spinyo", "mm", "spin centre", spec%kinematics%spinyo)
      else
         ! speed and steps of wheel and rail are in other groups
         return
      end if
      call record%number("chi", "rad", "rolling direction", spec%rolling%chi)
      call record%number("dq", "mm", "distance per step", spec%rolling%dq)
      call record%number("veloc", "mm/s", "velocity", spec%rolling%veloc)
      call record%close_group()
   end subroutine describe_kinematics

   !> Friction: one number per set of parameters
   subroutine describe_friction(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec
      type(friction_set), allocatable :: sets(:)
      type(collector), allocatable :: numbers(:)
      character(len=:), allocatable :: laws
      integer :: k

      call record%open_group("friction")
      laws = ""
      do k = 1, size(digit_table)
         associate (row => digit_table(k))
            if (row%name == "L" .and. row%word /= "") laws = laws // ", " // integer_text(row%choice) // " " // trim(row%word)
         end associate
      end do
      call record%count("law", laws(3:), spec%friction_law)
      call record%count("variation", "0 none, 1 by angle, 2 by position, 3 by row", spec%variation)
      allocate(sets(0))
      if (allocated(spec%friction%sets)) sets = spec%friction%sets
      if (spec%variation /= variation%none) call record%numbers("position", "rad or mm", "angles or positions of the sets", &
         & sets%position)
      allocate(numbers(0:size(sets)))
      ! the first one tells the names, also where there is no set
      call friction_numbers(numbers(0), spec%friction_law, friction_set())
      do k = 1, size(sets)
         call friction_numbers(numbers(k), spec%friction_law, sets(k))
      end do
      do k = 1, size(numbers(0)%names)
         call describe_parameter(record, numbers, k)
      end do
      if (is_varying_law(spec%friction_law)) then
         call record%number("memdst", "mm", "distance of the friction memory", spec%friction%memdst)
         call record%number("mem_s0", "mm/s", "lowest velocity of the friction memory", spec%friction%mem_s0)
      end if
      call record%close_group()
   end subroutine describe_friction

   !> One friction parameter in all sets
   subroutine describe_parameter(record, numbers, k)
      class(record_writer), intent(inout) :: record
      !> Parameters of the sets, behind one that is there for the names
      type(collector), intent(in) :: numbers(0:)
      !> Place of the parameter
      integer, intent(in) :: k
      character(len=collected_length) :: key
      integer :: i

      associate (name => numbers(0)%names(k))
         key = small(name)
         ! one name serves for the coefficients of the terms of three laws
         if (any(name(:4) == ["FLIN", "FRAT", "FEXP"])) key = "coef" // name(5:)
         associate (row => bounds_table(bounds_of(trim(name))))
            call record%numbers(trim(key), trim(row%unit), trim(row%title), [(numbers(i)%values(k), i=1, ubound(numbers, 1))])
         end associate
      end associate
   end subroutine describe_parameter

   !> Elastic constants and those of the material model
   subroutine describe_material(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec

      call record%open_group("material")
      associate (m => spec%material)
         call record%count("model", "digit M", spec%material_model)
         call record%numbers("gg", "N/mm2", "moduli of rigidity of bodies 1 and 2", m%gg)
         call record%numbers("poiss", "-", "Poisson ratios", m%poiss)
         if (spec%pressure == pressure_model%thin_sheet) call record%number("flxz", "mm3/N", &
            & "vertical flexibility of the elastic thin sheet", m%flxz)
         select case (spec%material_model)
         case (material_model%viscoelastic)
            call record%numbers("fg", "-", "ratios of viscoelastic to elastic flexibility", m%fg)
            call record%numbers("tc", "s", "relaxation times", m%tc)
         case (material_model%fastsim_single, material_model%fastsim, material_model%fastrip, material_model%fastrip_plain, &
            & material_model%fastrip_sliding)
            call record%number("flx", "mm3/N", "flexibility of simplified theory", m%flx)
            if (has_slope_reduction(spec%material_model)) then
               call record%number("k0_mf", "-", "initial slope reduction", m%k0_mf)
               call record%number("alfamf", "-", "final slope reduction over initial one", m%alfamf)
               call record%number("betamf", "-", "decay of the slope reduction", m%betamf)
            end if
         case (material_model%interfacial_layer)
            call record%number("gg3", "N/mm2", "modulus of rigidity of the layer", m%gg3)
            call record%number("laythk", "mm", "thickness of the layer", m%laythk)
            call record%number("tau_c0", "N/mm2", "yield limit", m%tau_c0)
            call record%number("k_tau", "N/mm3", "hardening", m%k_tau)
         end select
         if (allocated(m%cfname)) call record%text("cfname", "file of influence coefficients", m%cfname)
      end associate
      call record%close_group()
   end subroutine describe_material

   !> Grid and undeformed distance of module 3
   subroutine describe_geometry(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec

      call record%open_group("geometry")
      call record%count("ipotcn", "how the grid was given, negative: Hertzian", spec%grid%form)
      if (spec%grid%needs_geometry()) then
         associate (g => spec%geometry)
            call record%count("ibase", "how the undeformed distance was given", g%form)
            call record%count("iplan", "planform", g%planform)
            call record%numbers("b", "", "coefficients of the undeformed distance", g%b)
            if (allocated(g%profile)) call record%numbers("profile", "mm", "profile B(1...NN)", g%profile)
            if (g%planform == 2 .or. g%planform == 3) call record%numbers("pl", "mm", "parameters of the planform", g%pl)
            if (allocated(g%rectangles)) then
               call record%numbers("rectangles", "mm", "XL XH YL YH of each part of the planform", pack(g%rectangles, .true.))
               call record%numbers("interaction", "-", "factors between the parts of the planform", pack(g%interaction, .true.))
            end if
         end associate
      else
         associate (g => spec%grid)
            call record%number("a1", "1/mm", "curvature", g%a1)
            call record%number("b1", "1/mm", "curvature", g%b1)
            call record%number("aob", "-", "ratio of semi-axes", g%aob)
            call record%number("aa", "mm", "semi-axis", g%aa)
            call record%number("bb", "mm", "semi-axis", g%bb)
            call record%number("scale", "-", "grid over contact", g%scale)
         end associate
      end if
      call record%close_group()
   end subroutine describe_geometry

   !> Wheel, rail and track of module 1, with the signs of the input
   subroutine describe_wheel_rail(record, spec)
      class(record_writer), intent(inout) :: record
      type(case_spec), intent(in) :: spec

      associate (pair => spec%wheel_rail)
         call record%open_group("search")
         call record%flag("left", "left side of the track?", pair%left)
         call record%flag("roller", "on a roller?", pair%roller)
         call record%count("location", "digit D in effect: how the contact reference and its plane are found", pair%search%location)
         call record%number("dx", "mm", "element size", pair%search%dx)
         call record%number("ds", "mm", "element size along the profile", pair%search%ds)
         call record%number("dqrel", "-", "step in elements", pair%search%dqrel)
         call record%number("a_sep", "rad", "angle of separate patches", pair%search%a_sep)
         call record%number("d_sep", "mm", "distance of separate patches", pair%search%d_sep)
         call record%number("d_comb", "mm", "distance of combined patches", pair%search%d_comb)
         call record%number("d_turn", "mm", "distance of patches with own planes", pair%search%d_turn)
         call record%close_group()

         call record%open_group("track")
         call record%number("gaught", "mm", "height of the gauge point", pair%track%gaught)
         call record%number("gaugwd", "mm", "gauge", pair%track%gaugwd)
         call record%number("raily0", "mm", "lateral place of the rail", pair%track%raily0)
         call record%number("railz0", "mm", "vertical place of the rail", pair%track%railz0)
         call record%number("cant", "rad", "cant of the rail", pair%track%cant)
         call record%number("curvature", "1/mm", "curvature of the track", pair%track%curvature)
         if (pair%roller) call record%number("nomradr", "mm", "radius of the roller", pair%track%nomradr)
         call record%close_group()

         call record%open_group("rail")
         call record%number("dy", "mm", "lateral deviation", pair%rail%dy)
         call record%number("dz", "mm", "vertical deviation", pair%rail%dz)
         call record%number("roll", "rad", "roll", pair%rail%roll)
         call record%numbers("velocity", "mm/s, rad/s", "rates of the deviations", &
            & [pair%rail%vy, pair%rail%vz, pair%rail%vroll])
         call record%close_group()

         associate (w => pair%wheelset)
            call record%open_group("wheelset_dimensions")
            call record%number("fbdist", "mm", "flange-back distance", w%fbdist)
            call record%number("fbpos", "mm", "place of the flange back in the profile", w%fbpos)
            call record%number("nomradw", "mm", "nominal radius", w%nomradw)
            call record%number("ytape", "mm", "place of the nominal radius", w%ytape)
            call record%numbers("flexible", "mm, rad", "flexible deviations x, y, z, roll, yaw, pitch", w%flexible)
            call record%numbers("flexible_rate", "mm/s, rad/s", "and their rates", w%flexible_rate)
            call record%close_group()

            call record%open_group("wheelset")
            call record%number("s", "mm", "position along the track", w%s)
            call record%number("y", "mm", "lateral position", w%y)
            call record%number("z", "mm", "height, when prescribed", w%z)
            call record%number("fz", "N", "vertical force, when prescribed", w%fz)
            call record%number("roll", "rad", "roll angle", w%roll)
            call record%number("yaw", "rad", "yaw angle", w%yaw)
            call record%number("pitch", "rad", "pitch angle", w%pitch)
            call record%number("vs", "mm/s", "forward speed", w%vs)
            call record%number("vpitch", "rad/s", "pitch rate, when prescribed", w%vpitch)
            call record%numbers("velocity", "mm/s, rad/s", "rates y, z, roll, yaw", [w%vy, w%vz, w%vroll, w%vyaw])
            call record%close_group()
         end associate

         call describe_profile(record, "rail_profile", pair%rail_profile)
         call describe_profile(record, "wheel_profile", pair%wheel_profile)
      end associate
   end subroutine describe_wheel_rail

   !> A profile file and how it is read
   subroutine describe_profile(record, name, profile)
      class(record_writer), intent(inout) :: record
      character(len=*), intent(in) :: name
      type(profile_spec), intent(in) :: profile

      call record%open_group(name)
      if (allocated(profile%name)) call record%text("file", "name as typed", profile%name)
      call record%count("mirror_y", "MIRRORY", profile%mirror_y)
      call record%count("mirror_z", "MIRRORZ", profile%mirror_z)
      call record%number("scale", "-", "factor to mm", profile%scale)
      call record%count("smoothing_method", "ISMOOTH", profile%smoothing_method)
      call record%number("smoothing", trim(merge("mm3", "mm ", profile%smoothing_method == 0)), &
         & "weight (method 0) or wavelength (1, 2) of smoothing", profile%smoothing)
      call record%close_group()
   end subroutine describe_profile
end module contact_output_input_record
