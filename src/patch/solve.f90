!> Solution of one contact patch: normal and tangential problem, and quantities derived from them
!>
!> With K = 0 the two problems are solved once, one after the other (Johnson). Otherwise they are solved in turn with the tractions
!> of the other one fixed (Panagiotopoulos), until the pressures are consistent with the normal displacements by the tangential
!> tractions. These displacements are the variables of the outer iteration; they are extrapolated from previous passes
!> (contact_numeric_anderson).
module contact_patch_solve
   use contact_base_choices, only : motion
   use contact_base_constants, only : excluded_threshold
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_normal_conjugate_gradient, only : approach_scale
   use contact_numeric_pieces, only : clear_long
   use contact_patch_damping, only : damping_forces
   use contact_patch_derived, only : derive, remember_friction, reset_result
   use contact_patch_heat, only : derive_temperatures
   use contact_patch_kinematics, only : previous_displacement, rigid_slip
   use contact_patch_normal_step, only : normal_step, shear_lift
   use contact_patch_order, only : choose_order
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_patch_sensitivities, only : find_sensitivities
   use contact_patch_simplified_step, only : simplified_step
   use contact_patch_status, only : derive_status
   use contact_patch_tangential_step, only : tangential_step
   use contact_patch_workspace, only : fit_workspace, patch_workspace
   use contact_text_words, only : real_text
   implicit none (type, external)
   private

   public :: check_problem, solve_patch

   !> Number of passes in the history of the extrapolation
   integer, parameter :: outer_depth = 10
   !> Residuals of the two problems are noise for the outer iteration, amplified by strong coupling: once the change is below this
   !> multiple of EPS, they are solved to this fraction of EPS, but not below the level of round-off
   real(wp), parameter :: near_the_end = 10.0_wp, sharp = 0.1_wp, least_eps = 1.0e-12_wp

   !> Steps whose relative difference to the length of an element is below this value are one element
   real(wp), parameter :: step_slack = 0.01_wp

contains

   !> Solve for the tractions of this time step
   subroutine solve_patch(problem, state, workspace, log, result, error)
      !> Complete description of the problem
      type(patch_problem), intent(in) :: problem
      !> now: estimate on entry, solution on exit; before: the previous time step
      type(patch_state), intent(inout) :: state
      !> Work space, kept from case to case for speed; its contents have no meaning
      type(patch_workspace), intent(inout) :: workspace
      !> Receives the trace of all solvers, and warnings
      type(log_type), intent(inout) :: log
      !> Tractions, slip, totals, reports and the status of the case
      type(patch_result), intent(inout) :: result
      !> Allocated if the problem has no solution, or the time limit is exceeded
      type(error_type), allocatable, intent(out) :: error
      !> Outer iteration between pressures and tractions
      type(solve_report) :: turns
      integer :: outer

      call check_problem(problem, error)
      if (allocated(error)) return
      call fit_workspace(problem, workspace)
      call reset_result(problem, state, result)
      call choose_order(problem, result%tangential)
      ! in simplified theory the spin term has other weights
      if (problem%motion /= motion%none .and. .not. allocated(problem%simplified)) call rigid_slip(problem, result)
      if (problem%motion == motion%none) then
         call clear_long(size(state%now%px), state%now%px)
         call clear_long(size(state%now%py), state%now%py)
      else if (problem%motion /= motion%steady_rolling .and. .not. allocated(problem%simplified)) then
         call previous_displacement(problem, state, workspace)
      end if

      workspace%sharper = 1.0_wp
      do outer = 1, max(1, problem%settings%maxout)
         result%outer_iterations = outer
         call normal_step(problem, state, workspace, log, result)
         if (problem%motion == motion%none) exit
         if (allocated(problem%simplified)) then
            ! in simplified theory pressures do not depend on the tractions
            call simplified_step(problem, state, workspace, log, result)
            exit
         end if
         call tangential_step(problem, state, workspace, log, result)
         if (problem%settings%maxout <= 1 .or. result%ncon == 0 .or. .not. problem%couples()) exit
         if (.not. (result%normal%succeeded() .and. result%tangential%succeeded())) exit
         if (problem%deadline%has_passed()) then
            turns%ended = ending%out_of_time
            exit
         end if
         call next_pass(problem, state, workspace, log, result, turns)
         if (turns%ended /= ending%not_started) exit
         if (outer == problem%settings%maxout) turns%ended = ending%iteration_limit
      end do
      if (any([result%normal%ended, result%tangential%ended, turns%ended] == ending%out_of_time)) then
         call problem%deadline%check("in the solution of a contact patch", error)
         return
      end if
      call derive(problem, state, workspace, result)
      call derive_status(problem, turns, result)
      if (.not. result%status%is_solved()) call log%warning(result%status%reason)
      call remember_forces(problem, state, result)
      call find_sensitivities(problem, workspace, state, result, log)
      call remember_friction(problem, result, state)
      call derive_temperatures(problem, log, result)
      state%started = .true.
      state%is_steady = problem%motion == motion%steady_rolling
      if (any(problem%motion == [motion%transient_rolling, motion%steady_rolling])) call warn_of_creepages(result, log)
   end subroutine solve_patch

   !> Warn of creepages above 1
   subroutine warn_of_creepages(result, log)
      type(patch_result), intent(in) :: result
      type(log_type), intent(inout) :: log
      character(len=:), allocatable :: which

      if (max(abs(result%cksi), abs(result%ceta)) <= 1.0_wp) return
      which = ""
      if (abs(result%cksi) > 1.0_wp) which = "CKSI = " // real_text(result%cksi)
      if (abs(result%ceta) > 1.0_wp .and. len(which) > 0) which = which // ", "
      if (abs(result%ceta) > 1.0_wp) which = which // "CETA = " // real_text(result%ceta)
      if (len(which) > 0 .and. result%ncon > 0) call log%warning("creepages beyond 1 (" // which // "): the surfaces slide &
         &faster than they roll; creepages are relative to the rolling velocity, 1 % is 0.01")
   end subroutine warn_of_creepages

   !> Check convergence of the outer iteration; choose the normal displacements for the next pass
   subroutine next_pass(problem, state, workspace, log, result, turns)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(patch_workspace), intent(inout) :: workspace
      type(log_type), intent(inout) :: log
      type(patch_result), intent(in) :: result
      !> Ended if the change is within the tolerance
      type(solve_report), intent(inout) :: turns
      real(wp) :: change, scale
      integer :: level
      character(len=96) :: line

      call shear_lift(problem, state, workspace)
      change = maxval(abs(workspace%lift - workspace%un), problem%h < excluded_threshold)
      scale = max(approach_scale(result%pen, minval(problem%h), change), maxval(abs(workspace%lift)))
      level = merge(0, 1, result%outer_iterations >= problem%settings%maxout - 1)
      if (log%shows(level)) then
         write(line, "(I3,A,2ES12.3)") result%outer_iterations, ", Panag/Out: |Uk - Uk-1|,    Eps |Uk| :", change, &
            & problem%settings%eps*scale
         call log%trace(level, trim(line))
      end if
      turns%method = "outer iteration"
      turns%iterations = result%outer_iterations
      turns%residual = change/scale
      turns%tolerance = problem%settings%eps
      if (change <= problem%settings%eps*scale) then
         turns%ended = ending%converged
         return
      end if
      if (change <= near_the_end*problem%settings%eps*scale) &
         & workspace%sharper = max(sharp, min(1.0_wp, least_eps/problem%settings%eps))
      if (result%outer_iterations == 1) call workspace%outer%start(size(workspace%un), outer_depth)
      call workspace%outer%advance(workspace%un, workspace%lift)
   end subroutine next_pass

   !> Store the forces of this time step for the next one; damping forces from their change since the previous one
   subroutine remember_forces(problem, state, result)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(inout) :: state
      type(patch_result), intent(inout) :: result

      state%now%is_solved = .true.
      state%now%force = [result%fn, result%fx, result%fy]
      if (allocated(result%damping)) deallocate(result%damping)
      if (.not. allocated(problem%damping)) return
      allocate(result%damping(3), source=0.0_wp)
      if (state%before%is_solved) result%damping = damping_forces(problem%damping, state%before%force, state%now%force, result%dt)
   end subroutine remember_forces

   !> Refuse problems without solution
   subroutine check_problem(problem, error)
      !> Complete description of the problem
      type(patch_problem), intent(in) :: problem
      !> Allocated with the reason if it is refused
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: force
      character(len=16) :: text

      if (.not. problem%model%is_flat() .and. problem%motion == motion%transient_rolling &
         & .and. abs(problem%dq - problem%grid%dx) > step_slack*problem%grid%dx) then
         call fatal_error(error, "conformal contact and tabulated coefficients (material.influence = ""conformal"" &
            &or ""tabulated"") need steps of one element in transient rolling, DQ = DX", error_kind%input)
         return
      end if
      if (problem%motion == motion%none .or. problem%n_forces == 0) return
      force = norm2(problem%force(:problem%n_forces))
      if (force < 1.0_wp) return
      write(text, "(F0.6)") force
      call fatal_error(error, "the prescribed tangential force is " // trim(text) // &
         & " times the friction bound; forces below 1 can be reached", error_kind%input)
   end subroutine check_problem
end module contact_patch_solve
