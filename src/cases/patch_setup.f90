!> Conversion of the specification of a case to the problem of its patch
module contact_cases_patch_setup
   use contact_base_choices, only : grid_form, has_slope_reduction, is_simplified, material_model, motion, &
      & normal_control, pressure_model, sensitivity_choice, slip_source, solver_choice
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_log, only : log_type
   use contact_base_memory, only : bytes_per_element, require_memory
   use contact_cases_elastic_setup, only : set_coefficients, set_inclination, set_model
   use contact_cases_friction_setup, only : set_friction, set_thermal
   use contact_cases_geometry, only : build_grid, part_labels, solve_hertz, undeformed_distance
   use contact_cases_numbers, only : check_numbers
   use contact_cases_rules, only : refuse_broken_rules
   use contact_cases_spec, only : case_spec, part_source
   use contact_friction_law, only : friction_driver
   use contact_grid_potential_contact, only : fit_field, potential_contact
   use contact_normal_estimate, only : elliptic_pressure, parabolic_pressure, sdec_pressure
   use contact_patch_damping, only : damping_law
   use contact_patch_problem, only : patch_problem
   use contact_simplified_flexibility, only : ellipse, slope_reduction
   use contact_simplified_problem, only : simplified_model
   use contact_cases_numbers, only : require_positive
   implicit none (type, external)
   private

   public :: set_method, set_problem, set_simplified_theory, set_yield_limit

contains

   !> Convert the specification to the problem of the patch
   subroutine set_problem(spec, folder, problem, log, error)
      type(case_spec), intent(in) :: spec
      !> Folder to which names of files are relative; "" for the current one
      character(len=*), intent(in) :: folder
      !> On entry the problem of the previous case
      type(patch_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call refuse_broken_rules(spec, error)
      if (.not. allocated(error)) call check_numbers(spec, error)
      if (allocated(error)) return
      call set_model(spec, problem%model, error)
      if (.not. allocated(error)) call set_inclination(spec, problem%model, error)
      if (allocated(error)) return
      call solve_hertz(spec%grid, spec%normal, spec%kinematics%fn, spec%kinematics%pen, problem%model%material%gg, &
         & problem%model%material%nu, problem%hertz, error)
      if (allocated(error)) return
      problem%fn = spec%kinematics%fn
      problem%pen = spec%kinematics%pen
      problem%force_prescribed = spec%normal == normal_control%force
      ! a Hertzian grid and distance follow load and materials if the case gives or forms them, not if it keeps them
      if (spec%has_new_geometry() .or. .not. problem%has_geometry) then
         call set_geometry(spec, problem, error)
         if (allocated(error)) return
      end if
      call set_coefficients(spec, problem%grid, folder, problem%model, log, error)
      if (allocated(error)) return
      call set_pressures(spec, problem, log, error)
      if (allocated(error)) return
      problem%estimate = spec%estimate
      problem%n_forces = spec%force
      problem%force = [spec%kinematics%fx, spec%kinematics%fy]
      problem%creep = [spec%kinematics%cksi, spec%kinematics%ceta]
      problem%spin = spec%kinematics%cphi
      problem%spin_centre = [spec%kinematics%spinxo, spec%kinematics%spinyo]
      problem%spin_weight = merge(0.0_wp, 1.0_wp, spec%slip_source == [slip_source%no_spin_x, slip_source%no_spin_y])
      call set_method(spec, problem)
      problem%sensitivity = spec%iteration%sensitivity
      ! sensitivities that were not requested are computed only if they are printed
      if (problem%sensitivity == sensitivity_choice%forces .and. spec%output_level < 2) &
         & problem%sensitivity = sensitivity_choice%none
      problem%mxsens = spec%iteration%mxsens
      problem%epsens = spec%iteration%epsens
      if (allocated(problem%damping)) deallocate(problem%damping)
      if (spec%has_damping) then
         allocate(problem%damping)
         problem%damping = damping_law(coefficient=[spec%damping%cdampn, spec%damping%cdampt], &
            & largest_rate=[spec%damping%dfnmax, spec%damping%dftmax])
      end if
      call set_friction(spec, problem, error)
      if (allocated(error)) return
      call set_thermal(spec, problem, error)
      if (allocated(error)) return
      call set_simplified_theory(spec, problem, log, error)
      if (allocated(error)) return
      call set_yield_limit(spec, problem)
      problem%want_exterior = spec%mat_file >= 2 .or. spec%output_level >= 6
      call set_rolling(spec, problem, log, error)
      if (allocated(error)) return
      if (allocated(problem%extra_slip)) deallocate(problem%extra_slip)
      if (spec%slip_source == slip_source%given) then
         if (.not. allocated(spec%extra_slip)) then
            call fatal_error(error, "an extra term of the rigid slip is requested, but none was given")
            return
         end if
         if (size(spec%extra_slip, 2) /= problem%grid%npot() .or. &
            & any(spec%slip_grid > 0 .and. spec%slip_grid /= [problem%grid%mx, problem%grid%my])) then
            call fatal_error(error, "the extra rigid slip was given for another number of columns or rows of elements")
            return
         end if
         allocate(problem%extra_slip(problem%grid%mx, problem%grid%my, 2))
         do i = 1, 2
            problem%extra_slip(:, :, i) = reshape(spec%extra_slip(i, :), [problem%grid%mx, problem%grid%my])
         end do
      end if
   end subroutine set_problem

   !> Near-surface plasticity: set a yield limit that is positive and can be reached
   subroutine set_yield_limit(spec, problem)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem

      problem%remembers_yield = spec%has_plasticity()
      problem%initial_yield_limit = merge(spec%material%tau_c0, 0.0_wp, problem%remembers_yield)
      problem%yield_slope = merge(spec%material%k_tau, 0.0_wp, problem%remembers_yield)
   end subroutine set_yield_limit

   !> Motion, solvers and their tolerances
   subroutine set_method(spec, problem)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem

      problem%motion = spec%motion
      problem%solver = spec%solver
      problem%classical = spec%classical
      problem%settings = spec%iteration%solver_settings
      problem%settings%maxout = spec%outer_iterations()
      problem%deadline = spec%limits%deadline
      problem%relaxation_given = spec%solver == solver_choice%convex_gs .or. spec%solver == solver_choice%gauss_seidel
   end subroutine set_method

   !> Potential contact, unless the case keeps it, and undeformed distance
   subroutine set_geometry(spec, problem, error)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error
      type(potential_contact) :: grid

      grid = problem%grid
      if (spec%parts%grid /= part_source%kept .or. .not. problem%has_geometry) then
         problem%has_geometry = .false.
         call build_grid(spec%grid, problem%hertz, grid, error)
      end if
      if (.not. allocated(error)) call spec%limits%check(int(grid%npot(), long), bytes_per_element, "elements", error)
      if (.not. allocated(error)) call require_memory(int(grid%npot(), long), bytes_per_element, "elements", error)
      if (allocated(error)) return
      problem%has_geometry = .false.
      problem%grid = grid
      if (allocated(problem%parts)) deallocate(problem%parts)
      if (spec%grid%form == grid_form%half_ellipses) then
         ! not computed: that of an earlier grid says nothing about these pressures
         call fit_field(grid, problem%h)
         problem%h = 0.0_wp
         problem%has_geometry = .true.
         return
      end if
      call undeformed_distance(spec%geometry, grid, problem%hertz, problem%h, error)
      if (allocated(error)) return
      if (.not. allocated(problem%hertz) .and. allocated(spec%geometry%rectangles)) then
         allocate(problem%parts)
         problem%parts%label = part_labels(spec%geometry, grid)
         problem%parts%interaction = spec%geometry%interaction
      end if
      problem%has_geometry = .true.
   end subroutine set_geometry

   !> Choose the model of pressures; compute pressures that are given in closed form
   subroutine set_pressures(spec, problem, log, error)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error

      problem%pressure = spec%pressure
      ! a sheet is part of the bodies: the normal problem is the same
      if (spec%pressure == pressure_model%thin_sheet) problem%pressure = pressure_model%full
      select case (spec%pressure)
      case (pressure_model%sdec)
         call fit_field(problem%grid, problem%given_pressure)
         call sdec_pressure(problem%grid, spec%grid%aa, spec%grid%bneg, spec%grid%bpos, problem%fn, problem%given_pressure)
         ! the undeformed distance, and with it the approach, is not computed
         problem%pen = 0.0_wp
      case (pressure_model%elliptical, pressure_model%parabolical)
         call fit_field(problem%grid, problem%given_pressure)
         if (spec%pressure == pressure_model%elliptical) then
            call elliptic_pressure(problem%grid, problem%hertz%aa, problem%hertz%bb, spec%grid%is_line_contact(), &
               & problem%hertz%fn, problem%given_pressure)
         else
            call parabolic_pressure(problem%grid, problem%hertz%aa, problem%hertz%bb, spec%grid%is_line_contact(), &
               & problem%hertz%fn, problem%given_pressure)
         end if
         problem%fn = problem%hertz%fn
         problem%pen = problem%hertz%pen
      case default
         if (allocated(problem%given_pressure)) deallocate(problem%given_pressure)
         return
      end select
      call carry_force(problem%grid, problem%fn, problem%given_pressure, log, error)
   end subroutine set_pressures

   !> Scale pressures by formula, evaluated at the centres of elements, such that their sum is the force of the formula.
   !>
   !> Of the two ways to make total and pressures consistent this one has the smaller error in the tangential forces
   !> (doc/theory/approximate_normal.md), and a prescribed force is carried in full, as by the full solution.
   subroutine carry_force(grid, fn, pn, log, error)
      type(potential_contact), intent(in) :: grid
      !> Normal force [N]
      real(wp), intent(in) :: fn
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), intent(inout) :: pn(:, :)
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      !> Maximum relative difference of the sum without a warning, and minimum fraction of the force for a valid contact
      real(wp), parameter :: rough = 0.1_wp, nothing = 1.0e-3_wp
      character(len=12) :: percent
      real(wp) :: total

      if (.not. fn > 0.0_wp) return
      total = sum(pn)*grid%dx*grid%dy
      if (.not. total > nothing*fn) then
         call fatal_error(error, "the pressures by formula (pressure = ""elliptical"", ""parabolical"" or ""sdec"") are zero at &
            &the centres of all elements: the grid is too coarse, or SCALE too large, for a contact that &
            &carries FN", error_kind%input)
         return
      end if
      pn = pn*(fn/total)
      if (abs(total - fn) <= rough*fn) return
      write(percent, "(I0)") nint(100*min(total/fn, 1.0e6_wp))
      call log%warning("the grid is too coarse or too small for pressures by formula: at the centres of its elements they " // &
         & "add up to " // trim(percent) // " % of FN. They are scaled to carry FN")
   end subroutine carry_force

   !> Set up simplified theory for the tangential problem, if it is the material model
   subroutine set_simplified_theory(spec, problem, log, error)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(simplified_model) :: fresh

      if (spec%motion == motion%none .or. .not. is_simplified(spec%material_model)) then
         if (allocated(problem%simplified)) deallocate(problem%simplified)
         return
      end if
      if (allocated(problem%friction)) then
         ! friction follows from the rigid slip velocity, particles have no memory
         problem%remembers_friction = .false.
      end if
      if (.not. allocated(problem%simplified)) allocate(problem%simplified)
      problem%simplified = fresh
      associate (model => problem%simplified)
         model%choice = spec%material_model
         model%flx = spec%material%flx
         if (has_slope_reduction(spec%material_model)) model%reduction = slope_reduction(spec%material%k0_mf, &
            & spec%material%alfamf, spec%material%betamf)
         if (allocated(problem%hertz)) model%hertz = ellipse(problem%hertz%aa, problem%hertz%bb)
         call require_positive("slope reduction factor K0_MF", model%reduction%k0, error)
         if (model%choice == material_model%fastsim_single) call require_positive("flexibility FLX", model%flx, error)
      end associate
      if (problem%model%coupled()) call log%warning("simplified theory leaves out how pressures and shear tractions of " // &
         & "dissimilar bodies act on each other")
   end subroutine set_simplified_theory

   !> Rolling direction and step; steady solvers except ConvexGS use steps of one element along x
   subroutine set_rolling(spec, problem, log, error)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(inout) :: problem
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: angle_tolerance = 0.01_wp, step_tolerance = 0.01_wp
      logical :: oblique, other_step

      problem%chi = 0.0_wp
      problem%dq = 1.0_wp
      problem%veloc = 1.0_wp
      problem%spin_offset = 0.0_wp
      problem%corrects_leading_edge = .false.
      problem%general_step = .false.
      if (spec%motion /= motion%transient_rolling .and. spec%motion /= motion%steady_rolling) return
      problem%chi = spec%rolling%chi
      problem%dq = spec%rolling%dq
      problem%veloc = spec%rolling%veloc
      problem%spin_offset = spec%rolling%facphi
      oblique = abs(sin(problem%chi)) > angle_tolerance
      other_step = abs(problem%dq - problem%grid%dx) > step_tolerance*problem%grid%dx
      ! particles of a layer are followed from element to element
      if (spec%motion /= motion%steady_rolling .and. spec%material_model /= material_model%interfacial_layer) then
         if (allocated(problem%simplified) .or. problem%dq <= (1.0_wp + step_tolerance)*problem%grid%dx) return
         call set_leading_edge()
         return
      end if
      problem%general_step = (oblique .or. other_step) .and. takes_any_step(spec, problem)
      if (problem%general_step) then
         if (problem%dq > (1.0_wp + step_tolerance)*problem%grid%dx) call set_leading_edge()
         return
      end if
      if (oblique) then
         call fatal_error(error, trim(kind_of_rolling(spec)) // " goes along x, CHI = 0 or 180 degrees. In other directions: " // &
            & "a grid with its x-axis along the rolling direction, motion = ""transient_rolling"", or motion = &
            &""steady_rolling"" with ConvexGS (iteration.solver = ""convex_gs""), flat elastic bodies and &
            &Coulomb friction", error_kind%unsupported)
         return
      end if
      ! DX of a Hertzian option is not known beforehand
      if (other_step .and. .not. allocated(problem%simplified) .and. spec%grid%needs_geometry()) &
         & call log%warning(trim(kind_of_rolling(spec)) // " advances by one element per step: DQ is set to DX; " // &
         & "ConvexGS (iteration.solver = ""convex_gs"") takes other steps")
      problem%dq = problem%grid%dx

   contains

      !> For steps longer than an element along x: the edge of contact is found in each row
      subroutine set_leading_edge()
         problem%corrects_leading_edge = .not. oblique
         if (oblique) call log%warning("DQ is larger than DX: slip near the leading edge is corrected for rolling along x " // &
            & "only; DQ at most DX needs no correction")
      end subroutine set_leading_edge
   end subroutine set_rolling

   !> Name of the model that advances by one element per step
   pure function kind_of_rolling(spec) result(text)
      type(case_spec), intent(in) :: spec
      character(len=33) :: text

      text = "rolling with an interfacial layer"
      if (spec%motion == motion%steady_rolling) text = "steady rolling"
   end function kind_of_rolling

   !> Can steady rolling be solved with coefficients at arbitrary distances, and does no other model follow particles?
   pure logical function takes_any_step(spec, problem)
      type(case_spec), intent(in) :: spec
      type(patch_problem), intent(in) :: problem

      takes_any_step = spec%motion == motion%steady_rolling .and. spec%solver == solver_choice%convex_gs &
         & .and. problem%model%is_flat() .and. .not. allocated(problem%model%memory) &
         & .and. .not. allocated(problem%simplified) .and. .not. problem%remembers_yield &
         & .and. .not. allocated(problem%thermal)
      if (takes_any_step .and. allocated(problem%friction)) takes_any_step = .not. problem%friction_memory%acts() &
         & .and. problem%friction%driver() /= friction_driver%temperature
   end function takes_any_step
end module contact_cases_patch_setup
