!> Input values of the groups that both modules have, once for all formats: solvers, motion, friction, materials
!>
!> Each procedure passes the values of its group to or from an archive in the order of the input files; the caller knows the groups
!> of a case. Values that depend on values being read are set here, too.
module contact_cases_inputs
   use contact_base_choices, only : force_control, material_model, normal_control, solver_choice, variation
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive, shown_length, text_variable
   use contact_cases_spec, only : damping_spec, friction_spec, heat_spec, iteration_spec, kinematics_spec, &
      & largest_yield_limit, material_spec, rolling_spec, wear_spec
   use contact_friction_law, only : friction_set
   use contact_friction_new_law, only : friction_model, is_friction_law, is_varying_law
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: visit_iteration, visit_kinematics, visit_rolling
   public :: visit_friction, visit_friction_rows, visit_friction_set, visit_friction_memory
   public :: visit_elastic, visit_sheet, visit_material_model, visit_conformal, visit_inclinations, visit_coefficient_file
   public :: visit_damping, visit_heat, visit_wear

   !> Bounds of the maximum number of elements of a patch of wheel and rail
   integer, parameter :: fewest_elements = 100, max_elements = 1000000
   !> Coefficient of a friction term below which the term is switched off [-]
   real(wp), parameter :: no_term = 1.0e-8_wp
   !> Lower bound of the half-value slip velocity of a term that is switched off [mm/s]
   real(wp), parameter :: smallest_unused = 1.0e-4_wp
   !> Relative difference of coefficients of friction below which they are regarded as equal [-]
   real(wp), parameter :: same_friction = 1.0e-3_wp
   !> Maximum number of control points of friction, and their minimum distance [rad] or [mm]
   integer, parameter :: max_points = 10
   real(wp), parameter :: min_step = 1.0e-6_wp
   !> Default offset of the spin term [-]
   real(wp), parameter :: spin_offset = 1.0_wp/6.0_wp

contains

   !> Settings of the iterative solvers
   subroutine visit_iteration(a, iteration, solver, with_elements)
      class(case_archive), intent(inout) :: a
      type(iteration_spec), intent(inout), target :: iteration
      !> Member of solver_choice
      integer, intent(in) :: solver
      !> Include the maximum number of elements of a patch?
      logical, intent(in) :: with_elements
      integer :: limited

      call a%integer("MAXGS", iteration%maxgs)
      call a%integer("MAXIN", iteration%maxin)
      call a%integer("MAXNR", iteration%maxnr)
      call a%integer("MAXOUT", iteration%maxout)
      call a%real("EPS", iteration%eps)
      if (with_elements) call a%integer("NPOT_MAX", iteration%npot_max, default=iteration%npot_max)
      call a%end_line()
      if (a%is_reading .and. with_elements) then
         limited = max(fewest_elements, min(max_elements, iteration%npot_max))
         if (limited /= iteration%npot_max) call a%warn("NPOT_MAX", " is replaced by " // integer_text(limited))
         iteration%npot_max = limited
      end if

      select case (solver)
      case (solver_choice%convex_gs, solver_choice%gauss_seidel, solver_choice%default_friction)
         if (solver /= solver_choice%default_friction) then
            call a%real("OMEGAH", iteration%omegah)
            call a%real("OMEGAS", iteration%omegas)
         end if
         call a%integer("INISLP", iteration%inislp, branch=.true.)
         call a%real("OMGSLP", iteration%omgslp)
         call a%end_line()
      case (solver_choice%gd_steady)
         call visit_gd_steady(a, iteration)
      end select
   end subroutine visit_iteration

   !> Parameters of the solver GDsteady
   subroutine visit_gd_steady(a, iteration)
      class(case_archive), intent(inout) :: a
      type(iteration_spec), intent(inout), target :: iteration

      call a%real("FDECAY", iteration%fdecay)
      call a%real("BETATH", iteration%betath)
      call a%integer("KDOWFB", iteration%kdowfb)
      call a%real("D_IFC", iteration%d_ifc)
      call a%real("D_LIN", iteration%d_lin)
      call a%real("D_CNS", iteration%d_cns)
      call a%real("D_SLP", iteration%d_slp)
      call a%real("POW_S", iteration%pow_s)
      call a%end_line()
      if (.not. a%is_reading) return
      iteration%d_ifc = max(0.01_wp, iteration%d_ifc)
      iteration%d_cns = max(0.01_wp, iteration%d_cns)
      iteration%d_slp = max(0.01_wp, iteration%d_slp)
      iteration%pow_s = max(0.01_wp, min(10.0_wp, iteration%pow_s))
      if (iteration%d_lin*(iteration%d_cns - iteration%d_ifc) >= 0.0_wp) return
      call a%warn("D_LIN", " leads away from " // trim(a%shown("D_CNS")) // "; it is replaced by 0, and D_CNS by " // &
         & trim(a%shown("D_IFC")))
      iteration%d_lin = 0.0_wp
      iteration%d_cns = iteration%d_ifc
   end subroutine visit_gd_steady

   !> Approach or normal force, creepages or tangential forces, spin
   subroutine visit_kinematics(a, kinematics, normal, force)
      class(case_archive), intent(inout) :: a
      type(kinematics_spec), intent(inout), target :: kinematics
      !> Members of normal_control and force_control
      integer, intent(in) :: normal, force

      associate (k => kinematics)
         if (normal == normal_control%force) then
            call a%real("FN", kinematics%fn)
         else
            call a%real("PEN", kinematics%pen)
         end if
         if (force == force_control%creepages) then
            call a%real("CKSI", kinematics%cksi)
         else
            call a%real("FX", kinematics%fx)
         end if
         if (force == force_control%fx_and_fy) then
            call a%real("FY", kinematics%fy)
         else
            call a%real("CETA", kinematics%ceta)
         end if
         call a%real("CPHI", kinematics%cphi)
         call a%real("SPINXO", kinematics%spinxo, default=0.0_wp)
         call a%real("SPINYO", kinematics%spinyo, default=0.0_wp)
         call a%end_line()
         if (.not. a%is_reading) return
         if (force == force_control%fx_and_fy .and. max(abs(k%fx), abs(k%fy)) <= 1.0_wp .and. hypot(k%fx, k%fy) > 1.0_wp) &
            & call a%refuse("FY", " and " // trim(a%shown("FX")) // " exceed the friction bound: FX**2 + FY**2 = " // &
            & real_text(hypot(k%fx, k%fy)**2) // " is above its upper bound 1")
         if (a%was_given("SPINXO") .and. .not. (a%was_given("SPINYO") .or. a%has_names)) then
            call a%warn("SPINXO", " is given without SPINYO; both are set to 0")
            k%spinxo = 0.0_wp
         end if
      end associate
   end subroutine visit_kinematics

   !> Rolling direction, distance travelled per step and rolling velocity
   subroutine visit_rolling(a, rolling, model)
      class(case_archive), intent(inout) :: a
      type(rolling_spec), intent(inout), target :: rolling
      !> Member of material_model
      integer, intent(in) :: model
      !> Maximum deviation of the rolling direction from the x axis [rad]
      real(wp), parameter :: along_x = 0.01_wp
      call a%real("CHI", rolling%chi)
      call a%real("DQ", rolling%dq)
      call a%real("VELOC", rolling%veloc)
      call a%real("FACPHI", rolling%facphi, default=spin_offset)
      call a%end_line()
      if (model == material_model%viscoelastic .and. abs(sin(rolling%chi)) > along_x) call a%refuse("CHI", &
         & " is not along x, 0 or 180 degrees within 0.01 rad, which viscoelastic material needs")
   end subroutine visit_rolling

   !> Friction: one set of parameters, or one per contact angle or position along the track
   subroutine visit_friction(a, law, varies, friction)
      class(case_archive), intent(inout) :: a
      !> Members of friction_model and variation
      integer, intent(in) :: law, varies
      type(friction_spec), intent(inout), target :: friction
      character(len=shown_length) :: previous
      character(len=5) :: name
      integer, target :: n
      integer :: k

      n = 1
      if (allocated(friction%sets)) n = size(friction%sets)
      if (varies == variation%none) then
         n = 1
      else
         call a%integer("NVF", n)
         call a%end_line()
         n = min(max(1, n), max_points)
      end if
      if (a%is_reading) then
         if (allocated(friction%sets)) deallocate(friction%sets)
         allocate(friction%sets(n))
      end if
      name = merge("ALPHA", "SVF  ", varies == variation%by_angle)
      do k = 1, n
         call visit_friction_set(a, law, varies, friction%sets(k))
         if (varies == variation%none .or. .not. a%is_reading) cycle
         if (k > 1) then
            if (.not. friction%sets(k)%position >= friction%sets(k - 1)%position + min_step) call a%refuse(trim(name), &
               & " does not lie above the one before it, " // trim(previous) // &
               & "; control points of friction must increase by at least 1e-6")
         end if
         previous = a%shown(trim(name))
      end do
      call visit_friction_memory(a, law, friction)
   end subroutine visit_friction

   !> Friction: one set of parameters per row of the grid
   subroutine visit_friction_rows(a, law, rows, friction)
      class(case_archive), intent(inout) :: a
      !> Member of friction_model
      integer, intent(in) :: law
      !> Number of rows
      integer, intent(in) :: rows
      type(friction_spec), intent(inout), target :: friction
      type(friction_set), allocatable :: longer(:)
      integer :: row, n

      if (a%is_reading) then
         ! an input that ends early must not allocate memory for all rows
         if (allocated(friction%sets)) deallocate(friction%sets)
         allocate(friction%sets(min(rows, 100)))
      end if
      do row = 1, rows
         n = size(friction%sets)
         if (row > n) then
            allocate(longer(min(rows, 2*n)))
            longer(:n) = friction%sets
            call move_alloc(longer, friction%sets)
         end if
         call visit_friction_set(a, law, variation%by_row, friction%sets(row))
         if (.not. a%is_good) return
      end do
      call visit_friction_memory(a, law, friction)
   end subroutine visit_friction_rows

   !> Values of one set, after those of the control point if there is one
   subroutine visit_friction_set(a, law, varies, set)
      class(case_archive), intent(inout) :: a
      !> Members of friction_model and variation
      integer, intent(in) :: law, varies
      type(friction_set), intent(inout), target :: set
      real(wp) :: hot

      if (.not. is_friction_law(law)) return
      if (varies == variation%by_angle) call a%real("ALPHA", set%position)
      if (varies == variation%by_position) call a%real("SVF", set%position)
      select case (law)
      case (friction_model%coulomb)
         call a%real("FSTAT", set%fstat)
         call a%real("FKIN", set%fkin, preset=.true.)
         call a%end_line()
         if (.not. a%is_reading) return
         if (.not. a%was_given("FKIN")) set%fkin = set%fstat
         if (abs(set%fstat - set%fkin) > same_friction*abs(set%fstat)) call a%warn("FKIN", " differs from FSTAT; " // &
            & "Coulomb friction has one coefficient: in an input file " // trim(a%shown("FSTAT")) // &
            & ", by cntc_setFrictionMethod the smaller one")
         if (a%of_library) set%fstat = min(set%fstat, set%fkin)
         set%fkin = set%fstat
      case (friction_model%linear)
         call visit_terms(a, "FLIN", set)
      case (friction_model%rational)
         call visit_terms(a, "FRAT", set)
      case (friction_model%exponential)
         call visit_terms(a, "FEXP", set)
      case (friction_model%temperature)
         call a%real("FREF", set%fref)
         call a%real("TREF", set%tref)
         call a%real("DFHEAT", set%dfheat)
         call a%real("DTHEAT", set%dtheat)
         call a%end_line()
         hot = set%fref + set%dfheat
         if (hot < 0.0_wp) call a%refuse("DFHEAT", ": FREF + DFHEAT = " // real_text(hot) // " is below its lower bound 0")
         if (.not. a%is_reading) return
         set%fstat = set%fref
         set%fkin = hot
      end select
   end subroutine visit_friction_set

   !> Friction that decreases with the slip velocity in two terms
   subroutine visit_terms(a, name, set)
      class(case_archive), intent(inout) :: a
      !> Name of the coefficients of the terms, without the number of the term
      character(len=*), intent(in) :: name
      type(friction_set), intent(inout), target :: set

      call a%real("FKIN", set%fkin)
      call a%real(name // "1", set%coef1)
      call a%real("SABSH1", set%sabsh1, unchecked=.true.)
      call a%real(name // "2", set%coef2)
      call a%real("SABSH2", set%sabsh2, unchecked=.true.)
      call a%end_line()
      if (a%is_reading) then
         if (set%coef1 < no_term) set%sabsh1 = max(smallest_unused, set%sabsh1)
         if (set%coef2 < no_term) set%sabsh2 = max(smallest_unused, set%sabsh2)
         set%fstat = set%fkin + set%coef1 + set%coef2
      end if
      call a%check("SABSH1")
      call a%check("SABSH2")
   end subroutine visit_terms

   !> Friction memory of laws that depend on slip velocity or temperature
   subroutine visit_friction_memory(a, law, friction)
      class(case_archive), intent(inout) :: a
      !> Member of friction_model
      integer, intent(in) :: law
      type(friction_spec), intent(inout), target :: friction

      if (.not. is_varying_law(law)) return
      call a%real("MEMDST", friction%memdst)
      call a%real("MEM_S0", friction%mem_s0)
      call a%end_line()
   end subroutine visit_friction_memory

   !> Elastic constants
   subroutine visit_elastic(a, material)
      class(case_archive), intent(inout) :: a
      type(material_spec), intent(inout), target :: material

      call a%reals("POISS", material%poiss)
      call a%reals("GG", material%gg)
      call a%end_line()
   end subroutine visit_elastic

   !> Flexibility of an elastic thin sheet
   subroutine visit_sheet(a, material)
      class(case_archive), intent(inout) :: a
      type(material_spec), intent(inout), target :: material

      call a%real("FLXZ", material%flxz)
      call a%end_line()
   end subroutine visit_sheet

   !> Additional values of a material model
   subroutine visit_material_model(a, model, material)
      class(case_archive), intent(inout) :: a
      !> Member of material_model
      integer, intent(in) :: model
      type(material_spec), intent(inout), target :: material

      select case (model)
      case (material_model%viscoelastic)
         call a%reals("FG", material%fg)
         call a%reals("TC", material%tc)
      case (material_model%fastsim_single, material_model%fastsim, material_model%fastrip)
         if (model == material_model%fastsim_single) call a%real("FLX", material%flx)
         call a%real("K0_MF", material%k0_mf)
         call a%real("ALFAMF", material%alfamf)
         call a%real("BETAMF", material%betamf)
      case (material_model%interfacial_layer)
         call a%real("GG3", material%gg3)
         call a%real("LAYTHK", material%laythk)
         call a%real("TAU_C0", material%tau_c0)
         call a%real("K_TAU", material%k_tau)
      case default
         return
      end select
      call a%end_line()
      if (a%is_reading .and. material%tau_c0 >= largest_yield_limit) material%tau_c0 = 0.0_wp
   end subroutine visit_material_model

   !> Angle correction for conformal contact; the inclinations are those of the profiles
   subroutine visit_conformal(a, material)
      class(case_archive), intent(inout) :: a
      type(material_spec), intent(inout), target :: material

      call a%integer("IF_METH", material%if_meth)
      call a%integer("VARIANT", material%variant)
      call a%end_line()
   end subroutine visit_conformal

   !> Angle correction for conformal contact, with a table of inclinations
   subroutine visit_inclinations(a, material)
      class(case_archive), intent(inout) :: a
      type(material_spec), intent(inout), target :: material
      integer, parameter :: longest_table = 1000000
      real(wp), allocatable :: table(:)
      integer, target :: n
      integer :: k

      n = 0
      if (allocated(material%table_y)) n = size(material%table_y)
      call a%integer("IF_METH", material%if_meth)
      call a%integer("VARIANT", material%variant)
      call a%integer("NN", n)
      call a%end_line()
      n = max(0, min(n, longest_table))
      if (.not. a%is_reading) table = [(material%table_y(k), material%table_alpha(k), k = 1, n)]
      call a%list("Y,ALPHA", table, 2*n, units=[character(len=3) :: "mm", "rad"])
      if (.not. (a%is_reading .and. a%is_good)) return
      material%table_y = table(1::2)
      material%table_alpha = table(2::2)
   end subroutine visit_inclinations

   !> File of influence coefficients
   subroutine visit_coefficient_file(a, material)
      class(case_archive), intent(inout) :: a
      type(material_spec), intent(inout) :: material
      type(text_variable), target :: name

      if (allocated(material%cfname)) name%value = material%cfname
      call a%text("CFNAME", name)
      call a%end_line()
      if (a%is_reading .and. allocated(name%value)) material%cfname = name%value
   end subroutine visit_coefficient_file

   !> Force-based damping
   subroutine visit_damping(a, damping)
      class(case_archive), intent(inout) :: a
      type(damping_spec), intent(inout), target :: damping

      call a%real("CDAMPN", damping%cdampn)
      call a%real("CDAMPT", damping%cdampt)
      call a%real("DFNMAX", damping%dfnmax)
      call a%real("DFTMAX", damping%dftmax)
      call a%end_line()
   end subroutine visit_damping

   !> Thermal constants
   subroutine visit_heat(a, heat, with_plastic_work)
      class(case_archive), intent(inout) :: a
      type(heat_spec), intent(inout), target :: heat
      !> Include the fraction of plastic work that is converted to heat?
      logical, intent(in) :: with_plastic_work
      character :: number
      integer :: body

      do body = 1, 2
         number = achar(iachar("0") + body)
         call a%real("BKTEMP" // number, heat%bktemp(body))
         call a%real("HEATCP" // number, heat%heatcp(body))
         call a%real("LAMBDA" // number, heat%lambda(body))
         call a%real("DENS" // number, heat%dens(body))
         call a%end_line()
      end do
      if (a%is_reading) heat%is_given = .true.
      if (.not. with_plastic_work) return
      call a%real("BETAPL", heat%betapl)
      call a%end_line()
   end subroutine visit_heat

   !> Material data for wear and fatigue
   subroutine visit_wear(a, wear)
      class(case_archive), intent(inout) :: a
      !> Archard's coefficient [-] and stresses [N/mm2], 0 if not given
      type(wear_spec), intent(inout), target :: wear

      call a%real("ARCHARD", wear%archard)
      call a%real("HARDNESS", wear%hardness)
      call a%real("SHEAR_YIELD", wear%shear_yield)
      call a%end_line()
      if (a%is_reading .and. wear%archard > 0.0_wp .and. .not. wear%hardness > 0.0_wp) call a%refuse( &
         & "HARDNESS", " is not given, which ARCHARD needs")
   end subroutine visit_wear
end module contact_cases_inputs
