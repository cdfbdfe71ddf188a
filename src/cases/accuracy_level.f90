!> One grid of a search for a prescribed accuracy: the case solved on it, after those that it continues
module contact_cases_accuracy_level
   use contact_base_choices, only : estimate_choice, grid_form, material_model, motion, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_base_log, only : log_type
   use contact_cases_accuracy_grid, only : first_counts, level_grid, set_elements, stay_below
   use contact_cases_accuracy_plan, only : accuracy_law, contact_sides, first_across, most_elements, prepare_level, &
      & smaller_tolerance, solver_tolerance
   use contact_cases_accuracy_series, only : has_history
   use contact_cases_accuracy_time, only : most_in_time
   use contact_cases_session, only : contact_session, solve_case
   use contact_cases_spec, only : case_spec, grid_spec, part_source
   use contact_patch_level_errors, only : share_of_residual
   use contact_patch_problem, only : patch_state
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: first_grid, held_solution, keeps_axes, solve_level, use_curvatures

   !> Solution of the last case of a series on one grid, which later cases can continue if a finer grid is not completed
   type :: held_solution
      !> Tractions on the elements, and on those of the coarse level; unallocated for none
      type(patch_state), allocatable :: state, coarse_state
   contains
      !> Store the solution of a session
      procedure :: hold
      !> Give it back to the session
      procedure :: restore
   end type held_solution

contains

   subroutine hold(self, session)
      class(held_solution), intent(inout) :: self
      !> Has solved the case, with estimated errors
      type(contact_session), intent(in) :: session

      self%state = session%state
      if (allocated(session%coarse)) self%coarse_state = session%coarse%state
   end subroutine hold

   subroutine restore(self, session)
      class(held_solution), intent(inout) :: self
      type(contact_session), intent(inout) :: session

      if (allocated(self%state)) session%state = self%state
      if (allocated(self%coarse_state)) session%coarse%state = self%coarse_state
   end subroutine restore

   !> Are there semi-axes that belong to the load of a previous case? Then the curvatures derived from them are kept
   pure logical function keeps_axes(spec)
      type(case_spec), intent(in) :: spec

      keeps_axes = any(spec%grid%form == [grid_form%hertz_axes, grid_form%hertz_line]) .and. .not. spec%has_new_geometry()
   end function keeps_axes

   !> Replace semi-axes by curvatures
   pure subroutine use_curvatures(curvatures, grid)
      !> Coefficients of x**2 and y**2 [1/mm]
      real(wp), intent(in) :: curvatures(2)
      !> On entry with semi-axes, on return with curvatures
      type(grid_spec), intent(inout) :: grid

      grid%a1 = curvatures(1)
      grid%b1 = curvatures(2)
      grid%form = merge(grid_form%hertz_line_curvature, grid_form%hertz_curvatures, grid%is_line_contact())
   end subroutine use_curvatures

   !> The first grid of a search, or a coarser one
   subroutine first_grid(session, spec, law, fixed, grid, most_across)
      !> With the grid of the cases that this one continues
      type(contact_session), intent(in) :: session
      type(case_spec), intent(in) :: spec
      !> Expected error
      type(accuracy_law), intent(in) :: law
      !> Prescribed numbers of elements, 0 for others
      integer, intent(in) :: fixed(2)
      !> First grid, not finer than limits allow
      type(level_grid), intent(out) :: grid
      !> Maximum number of elements across the contact, without effect on cases that continue others; default no limit
      real(wp), intent(in), optional :: most_across
      real(wp) :: contact(2), across

      if (has_history(spec)) then
         grid = session%series%grid
         grid%eps = min(grid%eps, tolerance_of(spec))
      else
         grid%eps = tolerance_of(spec)
         call contact_sides(spec, contact)
         across = first_across(law, spec%iteration%accuracy)
         if (present(most_across)) across = min(across, most_across)
         call first_counts(spec%grid, across, contact, grid%lengths, grid%counts)
         where (fixed > 0) grid%counts = fixed
         call stay_below(most_in_time(spec), fixed, grid%counts)
      end if
      call stay_below(most_elements(spec%limits), fixed, grid%counts)
   end subroutine first_grid

   !> Tolerance of the solvers for the accuracy of a case
   pure real(wp) function tolerance_of(spec) result(eps)
      type(case_spec), intent(in) :: spec

      eps = solver_tolerance(spec%iteration%accuracy)
      if (spec%material_model == material_model%interfacial_layer) &
         & eps = smaller_tolerance(eps, share_of_residual(.false.)/share_of_residual(.true.))
   end function tolerance_of

   !> Solve a case on one grid, after those that it continues
   subroutine solve_level(session, spec, grid, refines, log, result, is_solved, seconds, error, folder)
      type(contact_session), intent(inout) :: session
      !> The case as specified
      type(case_spec), intent(in) :: spec
      !> Elements, window and tolerance
      type(level_grid), intent(in) :: grid
      !> Does the session hold the solution of this case on a coarser grid?
      logical, intent(in) :: refines
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      !> Did all iterations converge, also those of the cases before?
      logical, intent(out) :: is_solved
      !> Elapsed time [s]
      real(wp), intent(out) :: seconds
      type(error_type), allocatable, intent(out) :: error
      !> Folder to which names of files are relative; default the current one
      character(len=*), intent(in), optional :: folder
      type(case_spec) :: before
      real(wp) :: began
      integer :: k

      began = wall_clock()
      seconds = 0.0_wp
      is_solved = .true.
      if (.not. session%series%is_at(spec, grid)) then
         do k = 1, session%series%before(spec)
            before = session%series%steps(k)
            before%limits = spec%limits
            call solve_step(session, before, grid, .false., log, result, is_solved, error, folder)
            if (allocated(error)) return
         end do
      end if
      call solve_step(session, spec, grid, refines .and. .not. has_history(spec), log, result, is_solved, error, folder)
      seconds = wall_clock() - began
   end subroutine solve_level

   !> Solve one case on one grid
   subroutine solve_step(session, spec, grid, refines, log, result, is_solved, error, folder)
      type(contact_session), intent(inout) :: session
      !> The case as specified
      type(case_spec), intent(in) :: spec
      type(level_grid), intent(in) :: grid
      !> Do iterations start from the solution of this case on a coarser grid?
      logical, intent(in) :: refines
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      !> Set to false if iterations do not converge, otherwise unchanged
      logical, intent(inout) :: is_solved
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: folder
      type(case_spec) :: level

      level = spec
      call prepare_level(grid%eps, level)
      if (has_history(spec)) then
         level%link = session%series%link_of(spec)
         if (level%link == time_link%repeat_step) level%link = session%series%steps(session%series%used)%link
         if (level%link /= time_link%initiate) level%estimate = estimate_choice%previous
      end if
      session%refines = refines .and. result%ncon > 0
      if (session%refines) level%estimate = estimate_choice%previous
      level%parts%grid = part_source%given
      level%parts%geometry = part_source%given
      if (keeps_axes(spec)) call use_curvatures(session%curvatures, level%grid)
      call set_elements(level%grid, grid%counts, grid%lengths)
      if (grid%lengths(1) > 0.0_wp .and. spec%motion == motion%steady_rolling) level%rolling%dq = grid%lengths(1)/grid%counts(1)
      call log%defer()
      call solve_case(session, level, log, result, error, folder)
      session%refines = .false.
      if (.not. allocated(error)) is_solved = is_solved .and. result%status%is_solved()
   end subroutine solve_step
end module contact_cases_accuracy_level
