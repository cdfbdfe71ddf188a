!> One contact problem through its cases: specification in, result out
module contact_cases_session
   use contact_base_choices, only : estimate_choice, is_rolling, motion, pressure_model
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_accuracy_series, only : accuracy_series
   use contact_cases_border_warning, only : warn_of_border
   use contact_cases_effects, only : name_effects
   use contact_cases_patch_setup, only : set_problem
   use contact_cases_spec, only : case_spec
   use contact_cases_stress_errors, only : estimate_stress_errors
   use contact_cases_subsurface, only : subsurface_stresses, warn_of_subsurface
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : fit_field, potential_contact
   use contact_normal_estimate, only : elliptic_pressure
   use contact_cases_resolution_warning, only : warn_of_few_elements
   use contact_patch_border, only : find_border
   use contact_patch_error_estimate, only : coarse_level, estimate_errors, release_coarse_level
   use contact_patch_finer_level, only : interpolate_fields
   use contact_patch_order, only : order_of_errors
   use contact_patch_time_steps, only : clear_time_step, link_time_steps
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_solve, only : check_problem, solve_patch
   use contact_patch_wear, only : derive_wear, forget_wear
   use contact_patch_workspace, only : patch_workspace, release_workspace
   use contact_subsurface_response_shelf, only : response_shelf
   implicit none (type, external)
   private

   public :: check_case, contact_session, refuse_nonsense, release_session, solve_case

   !> Data of one problem that are kept from case to case: physical state and workspace
   type :: contact_session
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      type(patch_problem) :: problem
      !> The coarse level for error estimates; unallocated until they are requested
      type(coarse_level), allocatable :: coarse
      !> Data kept for subsurface stresses
      type(response_shelf) :: shelf
      !> Grid for which a warning has suggested a larger one
      type(potential_contact) :: advised
      !> Curvatures of the Hertzian contact whose grid was chosen for an accuracy; 0 for none [1/mm]
      real(wp) :: curvatures(2) = 0.0_wp
      !> Does the next case continue from its own solution on other elements?
      logical :: refines = .false.
      !> Has the last case failed such that the next one has no predecessor? Had the last one none for this reason?
      logical :: has_failed = .false., started_anew = .false.
      !> Cases that the next one may continue, if they have an accuracy
      type(accuracy_series) :: series
   end type contact_session

contains

   !> Solve one case, or only read its input (R = 2, 3)
   subroutine solve_case(session, spec, log, result, error, folder)
      type(contact_session), intent(inout) :: session
      !> Complete specification
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      !> Result; arrays of the right size are reused
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      !> Folder to which names of files are relative; default the current one
      character(len=*), intent(in), optional :: folder

      log%level = spec%flow_level
      call log%begin_case()
      if (present(folder)) then
         call solve_in_folder(session, spec, folder, log, result, error)
      else
         call solve_in_folder(session, spec, "", log, result, error)
      end if
      call log%translate_choices(error)
      call log%end_case()
   end subroutine solve_case

   !> Solve one case with a folder, between the beginning and the end of its log
   subroutine solve_in_folder(session, spec, folder, log, result, error)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      !> Folder, "" for the current one
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error

      session%started_anew = session%has_failed
      call set_problem(spec, folder, session%problem, log, error)
      call store_hertz(session%problem, result)
      if (allocated(error)) return
      if (session%refines) call interpolate_fields(session%problem%grid, session%state%now)
      call link_time_steps(session%problem, spec%link, session%state, error)
      if (allocated(error)) then
         call forget(session, result)
         return
      end if
      call choose_estimate(session, spec)
      if (spec%has_wear) call refuse_direction(spec, error)
      if (allocated(error) .or. .not. spec%solve) return
      call solve_patch(session%problem, session%state, session%workspace, log, result, error)
      if (allocated(error)) then
         ! an incomplete solution cannot be a previous time step
         if (error%kind == error_kind%time) call forget(session, result)
         return
      end if
      if (spec%has_wear) then
         call derive_wear(spec%wear, session%problem%spin_centre, result)
      else
         call forget_wear(result)
      end if
      if (.not. result%has_finite_totals()) then
         call refuse_nonsense(error)
         call forget(session, result)
         return
      end if
      session%has_failed = .false.
      call find_border(session%problem, result)
      ! prescribed pressures are known everywhere: contact is not truncated by a grid that contains them all
      if (allocated(session%problem%given_pressure) .and. spec%grid%scale >= 1.0_wp) result%border%side = .false.
      call warn_of_border(spec, session%problem, result, log, advised=session%advised)
      call warn_of_few_elements(result, "DY", log)
      call name_effects(spec, session%problem, result)
      if (allocated(result%errors)) deallocate(result%errors)
      ! the totals whose errors are estimated next must not include stresses of another case
      if (allocated(result%subsurface)) deallocate(result%subsurface)
      if (spec%estimates_errors) then
         if (.not. allocated(session%coarse)) allocate(session%coarse)
         call estimate_errors(session%problem, session%state, spec%link, order_of_errors(result%tangential), &
            & session%coarse, result, error)
         if (allocated(error)) return
      else if (allocated(session%coarse)) then
         session%coarse%state%started = .false.
      end if
      if (.not. spec%has_stress) return
      call subsurface_stresses(spec, result, error, shelf=session%shelf)
      if (allocated(error)) return
      call warn_of_subsurface(spec, result, log)
      if (spec%estimates_errors) call estimate_stress_errors(spec, session%coarse%result, result)
   end subroutine solve_in_folder

   !> The depth of wear in a passage is a sum along rows of elements: refuse other rolling directions
   subroutine refuse_direction(spec, error)
      type(case_spec), intent(in) :: spec
      !> Allocated if rolling is not along rows
      type(error_type), allocatable, intent(out) :: error
      !> Maximum angle that is regarded as along x [rad]
      real(wp), parameter :: along_x = 0.01_wp

      if (.not. (is_rolling(spec%motion) .and. spec%wear%archard > 0.0_wp)) return
      if (abs(sin(spec%rolling%chi)) > along_x) call fatal_error(error, "wear by Archard's coefficient, ARCHARD, needs rolling &
         &along x, CHI of 0 or 180 degrees within 0.01 rad: the depth of a passage is a sum over rows of elements", &
         & error_kind%input)
   end subroutine refuse_direction

   !> Store the Hertz solution of the geometry, which is a result also of a case that is not solved
   subroutine store_hertz(problem, result)
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(inout) :: result

      if (allocated(problem%hertz)) then
         result%hertz = problem%hertz
      else if (allocated(result%hertz)) then
         deallocate(result%hertz)
      end if
   end subroutine store_hertz

   !> Error of a case whose totals are infinite or not a number: it has no results
   subroutine refuse_nonsense(error)
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, "the numbers of this case are too large or too small to compute with: the solution is not " // &
         & "finite, and there are no results", error_kind%internal)
   end subroutine refuse_nonsense

   !> Perform the checks of a solution, without solving
   subroutine check_case(session, spec, log, result, error, folder)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      !> Unused after return
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      !> Folder to which names of files are relative; default the current one
      character(len=*), intent(in), optional :: folder
      type(case_spec) :: unsolved

      unsolved = spec
      unsolved%solve = .false.
      call solve_case(session, unsolved, log, result, error, folder)
      if (allocated(error) .or. .not. spec%solve) return
      call check_problem(session%problem, error)
   end subroutine check_case

   !> Release the memory of a session that is allocated outside Fortran; must be called before the session is destroyed
   subroutine release_session(session)
      type(contact_session), intent(inout) :: session
      call release_workspace(session%workspace)
      if (allocated(session%coarse)) call release_coarse_level(session%coarse)
   end subroutine release_session

   !> Set zero tractions and no contact, after a case that could not be linked
   subroutine forget(session, result)
      type(contact_session), intent(inout) :: session
      type(patch_result), intent(inout) :: result

      call clear_time_step(session%state%now, session%problem%grid)
      call clear_time_step(session%state%before, session%problem%grid)
      session%state%started = .true.
      session%has_failed = .true.
      result%ncon = 0
   end subroutine forget

   !> Set the initial estimate of the iteration
   subroutine choose_estimate(session, spec)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec

      associate (problem => session%problem, now => session%state%now)
         if (spec%estimate == estimate_choice%fresh .and. allocated(problem%hertz) &
            & .and. problem%pressure == pressure_model%full) then
            call fit_field(problem%grid, problem%pressure_estimate)
            call elliptic_pressure(problem%grid, problem%hertz%aa, problem%hertz%bb, spec%grid%is_line_contact(), &
               & problem%hertz%fn, problem%pressure_estimate)
         else if (allocated(problem%pressure_estimate)) then
            deallocate(problem%pressure_estimate)
         end if
         select case (spec%estimate)
         case (estimate_choice%fresh)
            now%px = 0.0_wp
            now%py = 0.0_wp
            now%pn = 0.0_wp
            now%division = element%exterior
            session%state%creep = 0.0_wp
         case (estimate_choice%previous_normal)
            now%px = 0.0_wp
            now%py = 0.0_wp
            where (now%division > element%exterior) now%division = element%adhesion
            session%state%creep = 0.0_wp
         end select
      end associate
   end subroutine choose_estimate
end module contact_cases_session
