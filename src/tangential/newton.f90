!> Semismooth Newton-Krylov method for friction on a given contact area
!>
!> Solves p - P_g(p - r S(p)) = 0 (see contact_tangential_problem); with prescribed forces the creepages are one or two
!> additional unknowns. After Alart and Curnier (1991) and Hueeber, Stadler and Wohlmuth (2008) for the formulation, and
!> Eisenstat and Walker (1996) for the accuracy of the inner iteration. The Jacobian is in `newton_jacobian`, the linear systems
!> in `newton_linear`, the steps are here.
module contact_tangential_newton
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending
   use contact_elastic_compliance, only : compliance
   use contact_numeric_pieces, only : copy_long
   use contact_tangential_layer_start, only : march_along_rows
   use contact_tangential_newton_jacobian, only : apply_d, differentiate_return_map, fit_workspace, linear_system, linearise, &
      & new_system, newton_workspace
   use contact_tangential_newton_linear, only : solve_linear
   use contact_tangential_problem, only : add_creepages, apply_operator, divide_elements, slip_of, tangential_problem, &
      & tangential_solution, true_residual
   use contact_tangential_slip_loops, only : step_and_project
   implicit none (type, external)
   private

   public :: newton_workspace, newton_outcome, newton_derivative, newton_solve

   !> Outcome of a solve
   type :: newton_outcome
      !> Member of ending
      integer :: ended = ending%not_started
      !> Numbers of Newton steps and of applications of the preconditioner
      integer :: steps = 0, preconditionings = 0
      !> True residual on exit
      real(wp) :: residual = 0.0_wp
      !> Are tractions against the slip of their own element in a scheme of second order, because those against the mean slip
      !> made no progress?
      logical :: is_unturned = .false.
   end type newton_outcome

   !> Maximum number of Newton steps; chosen
   integer, parameter :: max_steps = 60
   !> The method stops if the residual has not decreased to this fraction within this number of steps; chosen
   real(wp), parameter :: halved = 0.5_wp
   integer, parameter :: patience = 8
   !> Tolerance of the linear systems: maximum, and factor and exponent of the ratio of residuals of Eisenstat and Walker
   !> (1996), whose exponent is (1 + sqrt(5))/2
   real(wp), parameter :: rough = 0.2_wp, forcing_factor = 0.5_wp, forcing_power = 1.5_wp
   !> Lower limits of that tolerance: this fraction of the tolerance of the problem, but not below the other value; chosen
   real(wp), parameter :: enough = 0.3_wp, min_accuracy = 0.1_wp
   !> Step lengths tried in turn; the first that decreases the residual by this fraction of its length is accepted; chosen
   real(wp), parameter :: lengths(6) = [1.0_wp, 0.5_wp, 0.25_wp, 0.1_wp, 0.03_wp, 0.01_wp]
   real(wp), parameter :: decrease = 0.1_wp
   !> Initial limit of the change of creepages, relative to the slip that full sliding causes, and its growth after a limited
   !> step that succeeded; see doc/theory/solvers.md
   real(wp), parameter :: first_range = 0.2_wp, range_growth = 3.0_wp
   !> Residual below which slip is turned, or number of steps after which it is; measured
   real(wp), parameter :: turn_below = 0.03_wp
   integer, parameter :: late = 12
   !> Minimum weight of an element in the mean slip, relative to its bound; chosen
   real(wp), parameter :: min_weight = 1.0e-3_wp

contains

   !> Improve a solution until the true residual is below a tolerance
   subroutine newton_solve(problem, operator, tolerance, workspace, solution, outcome, log)
      !> Rigid slip, bounds, prescribed forces, limits of the iteration; for the second-order scheme its turns are updated
      type(tangential_problem), intent(inout) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the true residual [-]
      real(wp), intent(in) :: tolerance
      !> Workspace of the size of the window, allocated here
      type(newton_workspace), intent(inout) :: workspace
      !> Initial creepages, and tractions inside the discs
      type(tangential_solution), intent(inout) :: solution
      !> Outcome, steps, residual
      type(newton_outcome), intent(out) :: outcome
      !> Receives a line per step from flow-trace level 5 on; absent: no trace
      type(log_type), intent(inout), optional :: log
      type(linear_system) :: system
      real(wp) :: residual, previous, forcing, history(0:max_steps), best, creep_range, correction(2), unbalance(2)
      integer :: step, k, since
      logical :: waits

      outcome%residual = 0.0_wp
      if (.not. any(problem%contact)) return
      call fit_workspace(workspace, problem%mx, problem%my)
      system = new_system(problem, operator)
      system%n_forces = problem%n_forces
      if (system%g_norm <= 0.0_wp) then
         ! no friction in any element
         solution%p = 0.0_wp
         call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
         call divide_elements(problem, solution%p, solution%slip, system%r, solution%division)
         outcome%ended = ending%converged
         return
      end if
      system%creep_scale = system%g_sum/(count(problem%contact)*system%r*problem%dq)

      creep_range = huge(creep_range)
      if (problem%n_forces > 0) then
         ! slip caused by full sliding in one direction
         workspace%trial(:, :, 1) = problem%bound
         workspace%trial(:, :, 2) = 0.0_wp
         call apply_operator(problem, operator, workspace%trial, workspace%trial_slip)
         creep_range = first_range*maxval(abs(workspace%trial_slip(:, :, 1)), problem%contact)/problem%dq
      end if
      call start_values(problem, operator, system, solution, workspace, residual)
      call march_along_rows(problem, operator, system%r, workspace%trial, workspace%trial_slip, solution, residual)
      previous = residual
      history = 0.0_wp
      waits = .false.
      if (allocated(problem%second)) waits = residual > turn_below
      if (waits) then
         problem%second%turns = .false.
         residual = true_residual(problem, solution%p, solution%slip, system%r)
      end if
      since = 0
      do step = 0, max_steps
         if (waits .and. (residual < max(turn_below, tolerance) .or. step > late)) then
            problem%second%turns = .true.
            residual = true_residual(problem, solution%p, solution%slip, system%r)
            waits = .false.
            since = step
         end if
         history(step) = residual
         outcome%steps = step
         outcome%residual = residual
         if (present(log)) call trace_step(problem, step, residual, solution, log)
         call check_ending(problem, step, since, history, tolerance, outcome%ended)
         if (outcome%ended == ending%stagnated .and. allocated(problem%second)) then
            ! an element may alternate between adhesion and turned slip without end
            if (problem%second%turns) then
               problem%second%turns = .false.
               residual = true_residual(problem, solution%p, solution%slip, system%r)
               since = step
               history(step) = residual
               outcome%residual = residual
               call check_ending(problem, step, since, history, tolerance, outcome%ended)
            end if
         end if
         if (outcome%ended /= ending%not_started) exit

         call linearise(problem, system, solution, workspace)
         do k = 1, problem%n_forces
            unbalance(k) = (sum(solution%p(:, :, k)) - problem%target(k))/system%g_sum
         end do
         ! no more accuracy than the next residual can benefit from
         forcing = min(rough, forcing_factor*(residual/max(previous, residual))**forcing_power)
         forcing = max(forcing, min(min_accuracy, enough*tolerance/residual))
         if (step == 0) forcing = rough
         call solve_linear(problem, operator, system, workspace, unbalance, forcing, correction, outcome%preconditionings)

         call take_step(problem, operator, system, correction, residual, creep_range, workspace, solution, best)
         if (.not. best < huge(best)) then
            outcome%ended = ending%diverged
            exit
         end if
         previous = residual
         residual = best
      end do
      if (allocated(problem%second)) outcome%is_unturned = .not. problem%second%turns
      call divide_elements(problem, solution%p, solution%slip, system%r, solution%division)
   end subroutine newton_solve

   !> Decide whether the iteration ends before the next step, and how
   subroutine check_ending(problem, step, since, history, tolerance, ended)
      type(tangential_problem), intent(in) :: problem
      !> Number of steps so far, and number of steps at the last change of the equations
      integer, intent(in) :: step, since
      !> Residuals after 0 to `step` steps, and the tolerance [-]
      real(wp), intent(in) :: history(0:), tolerance
      !> Member of ending; not_started if the iteration continues
      integer, intent(out) :: ended

      ended = ending%not_started
      associate (residual => history(step))
         if (.not. residual <= huge(residual)) then
            ended = ending%diverged
         else if (residual <= tolerance) then
            ended = ending%converged
         else if (step >= since + patience .and. residual > halved*history(max(0, step - patience))) then
            ended = ending%stagnated
         else if (step == max_steps) then
            ended = ending%iteration_limit
         else if (problem%deadline%has_passed()) then
            ended = ending%out_of_time
         end if
      end associate
   end subroutine check_ending

   !> Step along the correction, with shorter steps until the residual decreases sufficiently; the best step is used
   subroutine take_step(problem, operator, system, correction, residual, creep_range, workspace, solution, best)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      !> Correction of the creepages [-]; that of the tractions is workspace%step
      real(wp), intent(in) :: correction(2)
      !> Residual before the step [-]
      real(wp), intent(in) :: residual
      !> Limit of the change of the creepages [-]; may increase
      real(wp), intent(inout) :: creep_range
      type(newton_workspace), intent(inout) :: workspace
      !> Unchanged if no step is possible
      type(tangential_solution), intent(inout) :: solution
      !> Residual after the step [-]; huge if no step is possible
      real(wp), intent(out) :: best
      real(wp) :: alpha, longest, trial, creep(2), best_creep(2)
      integer :: attempt

      best = huge(best)
      best_creep = solution%creep
      longest = 1.0_wp
      if (problem%n_forces > 0) longest = creep_range/max(creep_range, norm2(correction))
      do attempt = 1, size(lengths)
         alpha = longest*lengths(attempt)
         call step_and_project(problem%mx*problem%my, problem%contact, problem%bound, alpha, solution%p, workspace%step, &
            & workspace%trial)
         creep = solution%creep + alpha*correction
         call slip_of(problem, operator, workspace%trial, creep, workspace%trial_slip)
         trial = true_residual(problem, workspace%trial, workspace%trial_slip, system%r)
         ! in full sliding the force does not depend on the creepage: not a point to continue from
         if (slides_too_far(problem, system, workspace)) cycle
         if (trial < best) then
            best = trial
            best_creep = creep
            call copy_long(2*problem%mx*problem%my, workspace%trial, workspace%residual)
            call copy_long(2*problem%mx*problem%my, workspace%trial_slip, workspace%best_slip)
         end if
         if (trial < residual*(1.0_wp - decrease*alpha)) exit
      end do
      ! a limited step that succeeded: the next one may be longer
      if (longest < 1.0_wp .and. attempt == 1) creep_range = range_growth*creep_range
      if (.not. best < huge(best)) return
      call copy_long(2*problem%mx*problem%my, workspace%residual, solution%p)
      call copy_long(2*problem%mx*problem%my, workspace%best_slip, solution%slip)
      solution%creep = best_creep
   end subroutine take_step

   !> Derivative of the tractions at a solution with respect to rigid slip and bounds, for constant creepages
   !>
   !> Requires one more system with the Jacobian of the method: J dp = -r D dS + n dg in slip, with n the direction of the
   !> tractions. In adhesion the bound has no influence. For an element at the transition between adhesion and slip it is the
   !> one-sided derivative for its present state.
   subroutine newton_derivative(problem, operator, tolerance, workspace, solution, shift, bound, derivative, reached)
      !> The problem that was solved
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tolerance relative to the right-hand side
      real(wp), intent(in) :: tolerance
      !> Workspace of the size of the window, allocated here
      type(newton_workspace), intent(inout) :: workspace
      !> Solution at which the derivative is taken
      type(tangential_solution), intent(in) :: solution
      !> Derivatives of the rigid slip per step, shape (mx, my, 2), and of the bound, shape (mx, my)
      real(wp), contiguous, intent(in) :: shift(:, :, :), bound(:, :)
      !> Derivative of the tractions, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: derivative(:, :, :)
      !> Relative residual
      real(wp), intent(out) :: reached
      type(linear_system) :: system
      type(tangential_solution) :: at
      real(wp) :: correction(2)
      integer :: preconditionings, k

      derivative = 0.0_wp
      reached = 0.0_wp
      if (.not. any(problem%bound > 0.0_wp)) return
      call fit_workspace(workspace, problem%mx, problem%my)
      system = new_system(problem, operator)
      ! after `finish_slip` the slip contains no plastic part
      at = solution
      call slip_of(problem, operator, at%p, at%creep, at%slip)
      call linearise(problem, system, at, workspace)
      if (allocated(workspace%point)) then
         workspace%trial = -system%r*shift
         call differentiate_return_map(problem, workspace, workspace%trial, workspace%residual, bound)
         workspace%residual = -workspace%residual
      else
         workspace%residual = system%r*shift
         if (allocated(problem%second)) call workspace%turns%apply(workspace%residual)
         call apply_d(workspace, workspace%residual)
         do k = 1, 2
            workspace%residual(:, :, k) = workspace%residual(:, :, k) - bound*workspace%direction(:, :, k)
         end do
      end if
      if (.not. any(abs(workspace%residual) > 0.0_wp)) return
      preconditionings = 0
      call solve_linear(problem, operator, system, workspace, [0.0_wp, 0.0_wp], tolerance, correction, preconditionings, reached)
      derivative = workspace%step
   end subroutine newton_derivative

   !> Slip and residual of the estimate, with creepages that match its tractions
   !>
   !> With prescribed forces and no tractions yet, tractions start as a constant fraction of the bound, with the right total.
   !> Creepages that cancel the mean slip of the elements far below their bound replace the given ones if this reduces the
   !> residual.
   subroutine start_values(problem, operator, system, solution, workspace, residual)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      type(tangential_solution), intent(inout) :: solution
      type(newton_workspace), intent(inout) :: workspace
      real(wp), intent(out) :: residual
      real(wp) :: creep(2), total, weight, other
      integer :: ix, iy, k

      if (problem%n_forces > 0) then
         if (.not. any(abs(solution%p) > 0.0_wp)) then
            do k = 1, problem%n_forces
               solution%p(:, :, k) = problem%target(k)/system%g_sum*problem%bound
            end do
         end if
      end if
      call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
      residual = true_residual(problem, solution%p, solution%slip, system%r)
      if (problem%n_forces == 0) return
      creep = 0.0_wp
      total = 0.0_wp
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) cycle
            weight = max(min_weight*problem%bound(ix, iy), &
               & problem%bound(ix, iy) - hypot(solution%p(ix, iy, 1), solution%p(ix, iy, 2)))
            creep = creep + weight*solution%slip(ix, iy, :)
            if (allocated(problem%share)) weight = weight*problem%share(ix, iy)
            total = total + weight
         end do
      end do
      creep(problem%n_forces + 1:) = 0.0_wp
      creep = creep/(total*problem%dq)
      workspace%trial_slip = solution%slip
      call add_creepages(problem, -creep, workspace%trial_slip)
      other = true_residual(problem, solution%p, workspace%trial_slip, system%r)
      if (other >= residual) return
      residual = other
      solution%slip = workspace%trial_slip
      solution%creep = solution%creep - creep
   end subroutine start_values

   !> Does the whole contact area slide in one direction, with more force than prescribed?
   !>
   !> If all elements slide in the same direction the force is at its limit and does not depend on the creepages. With spin or
   !> lateral motion it does.
   pure logical function slides_too_far(problem, system, workspace)
      type(tangential_problem), intent(in) :: problem
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(in) :: workspace
      integer :: ix, iy, k
      real(wp) :: force, target
      !> Distance from the limit, relative to that of the target, below which the force is regarded as constant
      real(wp), parameter :: near_limit = 0.05_wp

      slides_too_far = .false.
      if (problem%n_forces == 0) return
      force = 0.0_wp
      do k = 1, problem%n_forces
         force = force + sum(workspace%trial(:, :, k))**2
      end do
      force = sqrt(force)
      target = norm2(problem%target(:problem%n_forces))
      if (force <= target .or. system%g_sum - force > near_limit*(system%g_sum - target)) return
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (problem%bound(ix, iy) <= 0.0_wp) cycle
            if (hypot(workspace%trial(ix, iy, 1) - system%r*workspace%trial_slip(ix, iy, 1), &
               & workspace%trial(ix, iy, 2) - system%r*workspace%trial_slip(ix, iy, 2)) <= problem%bound(ix, iy)) return
         end do
      end do
      slides_too_far = .true.
   end function slides_too_far

   !> Write a line of the flow trace for a Newton step
   subroutine trace_step(problem, step, residual, solution, log)
      type(tangential_problem), intent(in) :: problem
      integer, intent(in) :: step
      real(wp), intent(in) :: residual
      type(tangential_solution), intent(in) :: solution
      type(log_type), intent(inout) :: log
      character(len=128) :: line

      if (.not. log%shows(5)) return
      write(line, "(4X,I6,A,I5,A,I5,A,ES10.2)") step, ", Newton: grid", problem%mx, " x", problem%my, ", residual :", residual
      if (problem%n_forces > 0) write(line(len_trim(line) + 1:), "(A,2ES14.6)") ", creepages :", solution%creep(:problem%n_forces)
      call log%trace(5, trim(line))
   end subroutine trace_step
end module contact_tangential_newton
