!> Entries for what both modules know: solvers, materials, temperatures, friction, rolling
module contact_capi_physics
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_choices, only : friction_model, material_model, pressure_model, variation
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : integer_of, integers_of, real_of, reals_of
   use contact_capi_library, only : entry_type
   use contact_capi_messages, only : complain, count_fits, fits, say
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_capi_setter, only : min_value, new_setter, setter
   use contact_cases_inputs, only : visit_damping, visit_elastic, visit_friction_memory, visit_friction_set, visit_heat, &
      & visit_iteration, visit_material_model, visit_sheet
   use contact_cases_spec, only : case_spec, damping_spec, friction_set, friction_spec, heat_spec, iteration_spec, material_spec
   use contact_control_digits, only : case_digits, choice_of, digit_of
   use contact_control_units, only : inward, quantity
   use contact_elastic_material, only : combine, combined_material
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: cntc_setsolverflags, cntc_setmaterialparameters, cntc_settemperaturedata, cntc_settimestep
   public :: cntc_setrollingstepsize, cntc_setfrictionmethod, cntc_settangentialforces

   !> Bodies with a smaller difference parameter need no outer iteration [-]
   real(wp), parameter :: quasi_identical = 1.0e-4_wp
   !> Prescribed tangential forces by the friction bound are shortened to this, because the bound itself is
   !> reached by infinite creepage only
   real(wp), parameter :: largest_force = 1.0_wp - 1.0e-4_wp

contains

   !> Iteration limits and solver (G)
   subroutine cntc_setsolverflags(ire, icp, gdigit, nints, iparam, nreals, rparam) bind(c, name="inside_cntc_setsolverflags")
      integer(c_int), intent(in), optional :: ire, icp, gdigit, nints, iparam(*), nreals
      real(c_double), intent(in), optional :: rparam(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      !> Numbers of integers and reals for each method
      integer, parameter :: n_ints(0:6) = [4, 0, 5, 5, 5, 5, 1], n_reals(0:6) = [1, 0, 4, 4, 2, 8, 1]
      integer, allocatable :: ints(:)
      real(wp), allocatable :: reals(:)
      integer :: method

      this = entry_type("cntc_setSolverFlags", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      method = integer_of(gdigit)
      ints = integers_of(nints, iparam)
      reals = reals_of(nreals, rparam)
      if (method == 6) problem%setting%group = "sensitivities"
      if (method < 0 .or. method > 6) then
         call complain(this, "solver method " // integer_text(method) // " is outside its range 0 to 6")
      else if (count_fits(this, method, size(ints), n_ints(method), n_ints(method))) then
         if (count_fits(this, method, size(reals), n_reals(method), n_reals(method))) then
            call set_solver(this, method, ints, reals, problem)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setsolverflags

   !> Store solver settings whose counts fit
   subroutine set_solver(this, method, ints, reals, problem)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: method, ints(:)
      real(wp), intent(in) :: reals(:)
      type(library_problem), intent(inout) :: problem
      type(iteration_spec), target :: iteration
      type(setter) :: a

      iteration = problem%spec%iteration
      a = new_setter(this, problem%units, reals, ints)
      if (method == 6) then
         call a%integer("MXSENS", iteration%mxsens)
         call a%real("EPSENS", iteration%epsens)
         call a%end_line()
      else if (method /= 1) then
         call visit_iteration(a, iteration, choice_of("G", method, problem%module_number), with_elements=.false.)
      end if
      if (.not. a%is_good) return
      problem%spec%iteration = iteration
      if (method == 6) return
      problem%digits%g = method
      if (method /= 1) problem%spec%solver = choice_of("G", method, problem%module_number)
   end subroutine set_solver

   !> Materials (M), or damping forces (M2, 10 higher)
   subroutine cntc_setmaterialparameters(ire, icp, imeth, nparam, rparam) bind(c, name="inside_cntc_setmaterialparameters")
      integer(c_int), intent(in), optional :: ire, icp, imeth, nparam
      real(c_double), intent(in), optional :: rparam(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      !> Fewest and most values for each method; -1: no such method
      integer, parameter :: fewest(0:12) = [4, 8, 8, 7, 8, 7, 4, 4, -1, -1, 0, 0, 4]
      integer, parameter :: most(0:12) = [4, 8, 8, 7, 8, 7, 4, 4, -1, -1, 1, 1, 4]
      real(wp), allocatable :: values(:)
      integer :: method, with_sheet

      this = entry_type("cntc_setMaterialParameters", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      method = integer_of(imeth)
      values = reals_of(nparam, rparam)
      if (method >= 10) problem%setting%group = "damping"
      if (method < 0 .or. method > 12 .or. method == 8 .or. method == 9) then
         call complain(this, "there is no material method " // integer_text(method))
      else
         ! the flexibility of an elastic thin sheet comes last, where there is one
         with_sheet = 0
         if (method < 10 .and. problem%digits%b == digit_of("B", pressure_model%thin_sheet, problem%module_number)) &
            & with_sheet = 1
         if (.not. count_fits(this, method, size(values), fewest(method), most(method) + with_sheet)) then
            call leave(problem)
            return
         end if
         if (method >= 12) then
            call set_damping(this, values, problem)
         else if (method >= 10) then
            call keep_damping(method == 11, problem%digits, problem%spec)
         else
            call set_material(this, method, values, size(values) > most(method), problem)
         end if
      end if
      call leave(problem)
   end subroutine cntc_setmaterialparameters

   !> No damping, or the values in store
   subroutine keep_damping(keep, digits, spec)
      logical, intent(in) :: keep
      type(case_digits), intent(inout) :: digits
      type(case_spec), intent(inout) :: spec

      digits%m2 = merge(1, 0, keep)
      if (keep) then
         spec%has_damping = any([spec%damping%cdampn, spec%damping%cdampt] > 0.0_wp)
      else
         spec%damping%cdampn = 0.0_wp
         spec%damping%cdampt = 0.0_wp
         spec%damping%dfnmax = 0.0_wp
         spec%damping%dftmax = 0.0_wp
         spec%has_damping = .false.
      end if
   end subroutine keep_damping

   !> New damping
   subroutine set_damping(this, values, problem)
      type(entry_type), intent(in) :: this
      real(wp), intent(in) :: values(4)
      type(library_problem), intent(inout) :: problem
      type(damping_spec) :: damping
      type(setter) :: a

      a = new_setter(this, problem%units, values)
      call visit_damping(a, damping)
      if (.not. a%is_good) return
      problem%spec%damping = damping
      problem%digits%m2 = 2
      problem%spec%has_damping = .true.
   end subroutine set_damping

   !> Elastic constants and what belongs to the model
   subroutine set_material(this, method, values, with_sheet, problem)
      type(entry_type), intent(in) :: this
      integer, intent(in) :: method
      real(wp), intent(in) :: values(:)
      !> Is the last value the flexibility of an elastic thin sheet?
      logical, intent(in) :: with_sheet
      type(library_problem), intent(inout) :: problem
      type(material_spec) :: material
      type(combined_material) :: both
      type(setter) :: a
      logical :: unlike
      integer :: model

      model = choice_of("M", method, problem%module_number)
      material = problem%spec%material
      a = new_setter(this, problem%units, values)
      call visit_elastic(a, material)
      call visit_material_model(a, model, material)
      if (with_sheet) call visit_sheet(a, material)
      if (.not. a%is_good) return
      associate (spec => problem%spec)
         problem%digits%m = method
         spec%material_model = model
         spec%material = material
         both = combine(material%poiss, material%gg)
         unlike = abs(both%ak) >= quasi_identical
         if (model == material_model%viscoelastic) unlike = unlike .or. material%relaxes_apart()
         if (spec%iteration%maxout >= 2 .and. .not. unlike) spec%iteration%maxout = 1
         if (spec%iteration%maxout <= 1 .and. unlike) spec%iteration%maxout = 10
      end associate
   end subroutine set_material

   !> Surface temperatures (H)
   subroutine cntc_settemperaturedata(ire, icp, imeth, nparam, params) bind(c, name="inside_cntc_settemperaturedata")
      integer(c_int), intent(in), optional :: ire, icp, imeth, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(heat_spec) :: heat
      type(setter) :: a
      real(wp), allocatable :: v(:)
      integer :: method

      this = entry_type("cntc_setTemperatureData", integer_of(ire), integer_of(icp))
      call enter(this, scope%any, problem)
      if (.not. associated(problem)) return
      method = integer_of(imeth)
      v = reals_of(nparam, params)
      select case (method)
      case (0, 1)
         if (count_fits(this, method, size(v), 0, 1)) problem%digits%h = method
      case (3)
         if (count_fits(this, method, size(v), 9, 9)) then
            heat = problem%spec%heat
            a = new_setter(this, problem%units, v)
            call visit_heat(a, heat, with_plastic_work=.true.)
            if (a%is_good) then
               problem%digits%h = method
               problem%spec%heat = heat
            end if
         end if
      case default
         call complain(this, "there is no temperature method " // integer_text(method) // "; 0, 1 and 3 are")
      end select
      call leave(problem)
   end subroutine cntc_settemperaturedata

   !> Time step; every solution derives its own from step and velocity
   subroutine cntc_settimestep(ire, icp, dt) bind(c, name="inside_cntc_settimestep")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: dt
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_setTimeStep", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      if (fits(this, "TC", [real_of(dt)], "dt")) call say(2, this, "the time step follows from rolling step and velocity")
      call leave(problem)
   end subroutine cntc_settimestep

   !> Rolling direction and step; for wheel and rail the step in elements
   subroutine cntc_setrollingstepsize(ire, icp, chi, dq) bind(c, name="inside_cntc_setrollingstepsize")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: chi, dq
      type(library_problem), pointer :: problem
      type(entry_type) :: this

      this = entry_type("cntc_setRollingStepsize", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      if (problem%module_number == 1) then
         if (fits(this, "DQREL", [real_of(dq)])) then
            problem%spec%wheel_rail%search%dqrel = real_of(dq)
            if (problem%digits%d == 1) problem%digits%d = problem%spec%wheel_rail%search%location
         end if
      else
         associate (values => [real_of(chi)*inward(problem%units, quantity%angle), &
            & real_of(dq)*inward(problem%units, quantity%length)])
            if (fits(this, "CHI DQ", values)) then
               problem%spec%rolling%chi = values(1)
               problem%spec%rolling%dq = values(2)
            end if
         end associate
      end if
      call leave(problem)
   end subroutine cntc_setrollingstepsize

   !> Friction law (L) and its variation (V)
   subroutine cntc_setfrictionmethod(ire, icp, imeth, nparam, params) bind(c, name="inside_cntc_setfrictionmethod")
      integer(c_int), intent(in), optional :: ire, icp, imeth, nparam
      real(c_double), intent(in), optional :: params(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      !> Number of values of each law
      integer, parameter :: n_law(0:6) = [2, 0, 7, 7, 7, 3, 6]
      real(wp), allocatable :: values(:)
      integer :: method, law, points

      this = entry_type("cntc_setFrictionMethod", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      method = max(-1, integer_of(imeth))
      values = reals_of(nparam, params)
      law = mod(method, 10)
      if (method < 0 .or. method > 29 .or. law > 6) then
         call complain(this, "there is no friction method " // integer_text(method))
      else if (method >= 10 .and. problem%module_number /= 1) then
         call complain(this, "friction that varies over the rail belongs to wheel and rail, method " // integer_text(method))
      else if (law == 1) then
         if (count_fits(this, method, size(values), 0, 0)) problem%digits%l = 1
      else if (method < 10) then
         if (count_fits(this, method, size(values), n_law(law), n_law(law))) call set_friction_points(this, 0, law, 1, values, &
            & problem)
      else
         points = 0
         if (size(values) > 0) then
            if (abs(values(1)) < 1.0e6_wp) points = max(0, nint(values(1)))
         end if
         if (count_fits(this, method, size(values), 1 + points*(1 + n_law(law)), 1 + points*(1 + n_law(law)))) &
            & call set_friction_points(this, method/10, law, points, values(2:), problem)
      end if
      call leave(problem)
   end subroutine cntc_setfrictionmethod

   !> Store a law with its points
   subroutine set_friction_points(this, varies, method, points, values, problem)
      type(entry_type), intent(in) :: this
      !> V; the law, 5 for that of Polach; number of points
      integer, intent(in) :: varies, method, points
      !> Values of the law; with variation a position before those of each point
      real(wp), intent(in) :: values(:)
      type(library_problem), intent(inout) :: problem
      type(friction_spec), target :: friction
      type(setter) :: a
      integer :: k, law, member

      law = choice_of("L", merge(4, method, method == 5), problem%module_number)
      member = choice_of("V", varies, problem%module_number)
      friction%memdst = problem%spec%friction%memdst
      friction%mem_s0 = problem%spec%friction%mem_s0
      allocate(friction%sets(points))
      friction%sets = friction_set(sabsh1=10000.0_wp, sabsh2=10000.0_wp)
      a = new_setter(this, problem%units, values)
      do k = 1, points
         if (method == 5) then
            call set_polach(a, member, friction, k)
         else
            call visit_friction_set(a, law, member, friction%sets(k))
            call visit_friction_memory(a, law, friction)
         end if
         if (.not. a%is_good) return
         associate (set => friction%sets(k))
            if (law == friction_model%temperature) then
               set%dfheat = max(min_value("FREF") - set%fref, set%dfheat)
               set%fkin = set%fref + set%dfheat
            end if
            if (k == 1) cycle
            if (set%position > friction%sets(k - 1)%position) cycle
         end associate
         call complain(this, "the positions of friction data must increase; nothing is stored")
         return
      end do
      associate (spec => problem%spec)
         problem%digits%v = varies
         problem%digits%l = merge(4, method, method == 5)
         spec%variation = member
         spec%friction_law = law
         spec%friction = friction
      end associate
   end subroutine set_friction_points

   !> Polach's law: exponential decay from fstat to A fstat, halved at ln 2/B
   subroutine set_polach(a, varies, friction, k)
      type(setter), intent(inout) :: a
      !> Member of variation
      integer, intent(in) :: varies
      type(friction_spec), intent(inout), target :: friction
      !> Number of the point
      integer, intent(in) :: k
      real(wp), target :: ratio, decay

      associate (set => friction%sets(k))
         if (varies == variation%by_angle) call a%real("ALPHA", set%position)
         if (varies == variation%by_position) call a%real("SVF", set%position)
         call a%real("FSTAT", set%fstat)
         call a%real("POLACH_A", ratio)
         call a%real("POLACH_B", decay)
         call a%end_line()
         if (.not. a%is_good) return
         set%fkin = ratio*set%fstat
         set%coef1 = set%fstat - set%fkin
         set%sabsh1 = max(min_value("SABSH1"), log(2.0_wp)/max(tiny(1.0_wp), decay))
         friction%memdst = 0.001_wp
         friction%mem_s0 = 10.0_wp
      end associate
   end subroutine set_polach

   !> Prescribed tangential forces: relative ones (module 3), or the longitudinal force on the rail (module 1)
   subroutine cntc_settangentialforces(ire, icp, fx, fy) bind(c, name="inside_cntc_settangentialforces")
      integer(c_int), intent(in), optional :: ire, icp
      real(c_double), intent(in), optional :: fx, fy
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: force(2)

      this = entry_type("cntc_setTangentialForces", integer_of(ire), integer_of(icp))
      call enter(this, scope%settings, problem)
      if (.not. associated(problem)) return
      force = [real_of(fx), real_of(fy)]
      if (problem%module_number == 1) then
         force(1) = force(1)*inward(problem%units, quantity%force)
         if (fits(this, "FX_WS", force(:1))) problem%spec%wheel_rail%wheelset%fx = force(1)
      ! forces beyond the friction bound are shortened to it, so that the bounds of FX are too narrow here
      else if (fits(this, "CKSI CETA", force, "FX FY")) then
         force = force/max(1.0_wp, hypot(force(1), force(2))/largest_force)
         problem%spec%kinematics%fx = force(1)
         problem%spec%kinematics%fy = force(2)
      end if
      call leave(problem)
   end subroutine cntc_settangentialforces
end module contact_capi_physics
