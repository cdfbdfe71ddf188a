!> Semismooth Newton-Krylov method for friction on a given contact area
!>
!> Solves  p - P_g(p - r S(p)) = 0  (see contact_tangential_problem), with prescribed forces as
!> one or two more unknowns, the creepages. After Alart and Curnier (1991) and Hueeber, Stadler
!> and Wohlmuth (2008) for the formulation; Eisenstat and Walker (1996) for the accuracy of the
!> inner iteration. In an element D is the derivative of the projection: the identity where
!> |z| <= g, z = p - r S, and (g/|z|)(1 - n n'), n = z/|z|, elsewhere; the Jacobian is
!> J dp = dp - D(dp - r B dp). Directions in the range of D are preconditioned by the inverse of
!> the circulant that belongs to B, the others are left alone; border rows by block elimination.
!> Where the yield limit has a slope, the return map takes the place of the projection: D gets a
!> radial part, and in steady rolling the limit carries changes downstream along each row.
module contact_tangential_newton
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_tangential_problem, only : add_creepages, apply_operator, divide_elements, limits_before, residual_scale, &
      & slip_of, tangential_problem, tangential_solution, true_residual
   use contact_tangential_yield, only : return_map, yield_point
   implicit none (type, external)
   private

   public :: newton_workspace, newton_outcome, newton_derivative, newton_solve

   !> Scratch of one window size; no meaning between calls
   type :: newton_workspace
      integer :: mx = 0, my = 0
      !> Krylov basis and the same after preconditioning, shapes (2 mx my + 2, restart + 1), (..., restart)
      real(wp), allocatable :: basis(:, :), preconditioned(:, :)
      !> Solution, right-hand side and scratch of the linear system, shape (2 mx my + 2)
      real(wp), allocatable :: x(:), b(:), work(:)
      !> Weight g/|z| (1 in adhesion, 0 outside contact) and direction n (0 in adhesion)
      real(wp), allocatable :: weight(:, :), direction(:, :, :)
      !> Trial tractions and slip, residual, and two scratch fields
      real(wp), allocatable :: trial(:, :, :), trial_slip(:, :, :), residual(:, :, :), step(:, :, :), best_slip(:, :, :)
      !> Border columns after preconditioning
      real(wp), allocatable :: border(:, :, :, :)
      !> Linearised return map, shape (mx, my); unallocated where the yield limit has no slope
      type(yield_point), allocatable :: point(:, :)
   end type newton_workspace

   !> How a solve ended
   type :: newton_outcome
      !> Member of ending
      integer :: ended = ending%not_started
      !> Newton steps and applications of the preconditioner
      integer :: steps = 0, preconditionings = 0
      !> True residual on exit
      real(wp) :: residual = 0.0_wp
   end type newton_outcome

   !> Largest Krylov space between restarts, number of restarts, Newton steps
   integer, parameter :: restart = 40, max_cycles = 4, max_steps = 60

   !> One linearised system with its scales
   type :: linear_system
      !> Unknown creepages
      integer :: n_forces = 0
      !> Number of traction unknowns
      integer :: n = 0
      !> 1/A_xx(0) [(N/mm2)/mm]
      real(wp) :: r = 1.0_wp
      !> Scales of tractions |g| and sums of g, and of the creepages
      real(wp) :: g_norm = 1.0_wp, g_sum = 1.0_wp, creep_scale = 1.0_wp
      !> Inverse of the Schur complement of the preconditioner
      real(wp) :: schur(2, 2) = 0.0_wp
   end type linear_system

contains

   !> Improve a solution until the true residual is below a tolerance
   subroutine newton_solve(problem, operator, tolerance, workspace, solution, outcome, log)
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> On the true residual [-]
      real(wp), intent(in) :: tolerance
      type(newton_workspace), intent(inout) :: workspace
      !> Tractions inside the discs and creepages to start from
      type(tangential_solution), intent(inout) :: solution
      type(newton_outcome), intent(out) :: outcome
      !> Gets a line per step from flow-trace level 5 on; absent: no trace
      type(log_type), intent(inout), optional :: log
      type(linear_system) :: system
      real(wp) :: residual, previous, forcing, history(0:max_steps), alpha, best, longest, &
         & creep_range, creep(2), best_creep(2), trial
      real(wp) :: correction(2), unbalance(2)
      integer :: step, k, attempt
      real(wp), parameter :: lengths(6) = [1.0_wp, 0.5_wp, 0.25_wp, 0.1_wp, 0.03_wp, 0.01_wp]

      outcome%residual = 0.0_wp
      if (.not. any(problem%contact)) return
      call fit_workspace(workspace, problem%mx, problem%my)
      system%n_forces = problem%n_forces
      system%n = 2*problem%mx*problem%my
      system%r = residual_scale(problem, operator)
      system%g_norm = sqrt(sum(problem%bound**2))
      system%g_sum = sum(problem%bound)
      if (system%g_norm <= 0.0_wp) then
         ! no friction at all
         solution%p = 0.0_wp
         call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
         call divide_elements(problem, solution%p, solution%slip, system%r, solution%division)
         outcome%ended = ending%converged
         return
      end if
      system%creep_scale = system%g_sum/(count(problem%contact)*system%r*problem%dq)

      creep_range = huge(creep_range)
      if (problem%n_forces > 0) then
         ! slip that full sliding in one direction would bring about
         workspace%trial(:, :, 1) = problem%bound
         workspace%trial(:, :, 2) = 0.0_wp
         call apply_operator(problem, operator, workspace%trial, workspace%trial_slip)
         creep_range = 0.2_wp*maxval(abs(workspace%trial_slip(:, :, 1)), problem%contact)/problem%dq
      end if
      call start_values(problem, operator, system, solution, workspace, residual)
      previous = residual
      history = 0.0_wp
      outcome%ended = ending%iteration_limit
      do step = 0, max_steps
         history(step) = residual
         outcome%steps = step
         outcome%residual = residual
         if (present(log)) call trace_step(problem, step, residual, solution, log)
         if (.not. residual <= huge(residual)) then
            outcome%ended = ending%diverged
            exit
         end if
         if (residual <= tolerance) then
            outcome%ended = ending%converged
            exit
         end if
         if (step >= 8 .and. residual > 0.5_wp*history(max(0, step - 8))) then
            outcome%ended = ending%stagnated
            exit
         end if
         if (step == max_steps) exit
         if (problem%deadline%has_passed()) then
            outcome%ended = ending%out_of_time
            exit
         end if

         call linearise(problem, system, solution, workspace)
         do k = 1, problem%n_forces
            unbalance(k) = (sum(solution%p(:, :, k)) - problem%target(k))/system%g_sum
         end do
         ! no more accuracy than the next residual can make use of
         forcing = min(0.2_wp, 0.5_wp*(residual/max(previous, residual))**1.5_wp)
         forcing = max(forcing, min(0.1_wp, 0.3_wp*tolerance/residual))
         if (step == 0) forcing = 0.2_wp
         call solve_linear(problem, operator, system, workspace, unbalance, forcing, correction, outcome%preconditionings)

         best = huge(best)
         best_creep = solution%creep
         longest = 1.0_wp
         if (problem%n_forces > 0) longest = creep_range/max(creep_range, norm2(correction))
         do attempt = 1, size(lengths)
            alpha = longest*lengths(attempt)
            call step_and_project(problem, solution%p, alpha, workspace%step, workspace%trial)
            creep = solution%creep + alpha*correction
            call slip_of(problem, operator, workspace%trial, creep, workspace%trial_slip)
            trial = true_residual(problem, workspace%trial, workspace%trial_slip, system%r)
            ! in full sliding the force no longer depends on the creepage: no place to continue from
            if (slides_too_far(problem, system, workspace)) cycle
            if (trial < best) then
               best = trial
               best_creep = creep
               workspace%residual = workspace%trial
               workspace%best_slip = workspace%trial_slip
            end if
            if (trial < residual*(1.0_wp - 0.1_wp*alpha)) exit
         end do
         ! a step that was cut short and still did well: the next one may go farther
         if (longest < 1.0_wp .and. attempt == 1) creep_range = 3.0_wp*creep_range
         if (.not. best < huge(best)) then
            outcome%ended = ending%diverged
            exit
         end if
         previous = residual
         residual = best
         solution%p = workspace%residual
         solution%slip = workspace%best_slip
         solution%creep = best_creep
      end do
      call divide_elements(problem, solution%p, solution%slip, system%r, solution%division)
   end subroutine newton_solve

   !> Derivative of the tractions at a solution, while rigid slip and bounds change and creepages do not
   !>
   !> One more system with the Jacobian of the method: J dp = -r D dS + n dg in slip, where n is the direction
   !> of the tractions. In adhesion the bound has no influence. Where an element is about to
   !> change between adhesion and slip, it is the derivative to the side on which the element is.
   subroutine newton_derivative(problem, operator, tolerance, workspace, solution, shift, bound, derivative, reached)
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Relative to the right-hand side
      real(wp), intent(in) :: tolerance
      type(newton_workspace), intent(inout) :: workspace
      type(tangential_solution), intent(in) :: solution
      !> Derivatives of the rigid slip per step, shape (mx, my, 2), and of the bound, shape (mx, my)
      real(wp), contiguous, intent(in) :: shift(:, :, :), bound(:, :)
      !> Derivative of the tractions, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: derivative(:, :, :)
      !> Relative residual that was reached
      real(wp), intent(out) :: reached
      type(linear_system) :: system
      type(tangential_solution) :: at
      real(wp) :: correction(2)
      integer :: preconditionings, k

      derivative = 0.0_wp
      reached = 0.0_wp
      if (.not. any(problem%bound > 0.0_wp)) return
      call fit_workspace(workspace, problem%mx, problem%my)
      system%n = 2*problem%mx*problem%my
      system%r = residual_scale(problem, operator)
      system%g_norm = sqrt(sum(problem%bound**2))
      system%g_sum = sum(problem%bound)
      ! the slip of a settled solution has no plastic part
      at = solution
      call slip_of(problem, operator, at%p, at%creep, at%slip)
      call linearise(problem, system, at, workspace)
      if (allocated(workspace%point)) then
         workspace%trial = -system%r*shift
         call differentiate_return_map(problem, workspace, workspace%trial, workspace%residual, bound)
         workspace%residual = -workspace%residual
      else
         workspace%residual = system%r*shift
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

   !> Slip and residual of the estimate, with creepages that suit its tractions
   !>
   !> With prescribed forces and no tractions yet, they start as the same share of the bound
   !> everywhere, which has the right total. Creepages that cancel the mean slip of the elements
   !> far from their bound replace the given ones when the residual gets smaller by it.
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
            weight = max(1.0e-3_wp*problem%bound(ix, iy), &
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
   !> Where all elements slide the same way the force is at its limit and no longer depends on the
   !> creepages. Sliding with spin or lateral motion is another thing: there the force does change.
   pure logical function slides_too_far(problem, system, workspace)
      type(tangential_problem), intent(in) :: problem
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(in) :: workspace
      integer :: ix, iy, k
      real(wp) :: force, target
      !> Distance to the limit, relative to that of the target, below which the force counts as constant
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

   !> Weights and directions of D, and the residual field, at the present tractions
   subroutine linearise(problem, system, solution, workspace)
      type(tangential_problem), intent(in) :: problem
      type(linear_system), intent(in) :: system
      type(tangential_solution), intent(in) :: solution
      type(newton_workspace), intent(inout) :: workspace
      integer :: ix, iy
      real(wp) :: z(2), length, g

      if (allocated(workspace%point)) deallocate(workspace%point)
      if (problem%hardens()) then
         call linearise_return_map(problem, system, solution, workspace)
         return
      end if
      do iy = 1, problem%my
         do ix = 1, problem%mx
            workspace%weight(ix, iy) = 0.0_wp
            workspace%direction(ix, iy, :) = 0.0_wp
            workspace%residual(ix, iy, :) = 0.0_wp
            if (.not. problem%contact(ix, iy)) cycle
            g = problem%bound(ix, iy)
            z = solution%p(ix, iy, :) - system%r*solution%slip(ix, iy, :)
            length = sqrt(z(1)**2 + z(2)**2)
            if (g <= 0.0_wp) then
               z = 0.0_wp
            else if (length <= g) then
               workspace%weight(ix, iy) = 1.0_wp
            else
               workspace%weight(ix, iy) = g/length
               workspace%direction(ix, iy, :) = z/length
               z = z*(g/length)
            end if
            workspace%residual(ix, iy, :) = solution%p(ix, iy, :) - z
         end do
      end do
   end subroutine linearise

   !> The same where the yield limit has a slope
   subroutine linearise_return_map(problem, system, solution, workspace)
      type(tangential_problem), intent(in) :: problem
      type(linear_system), intent(in) :: system
      type(tangential_solution), intent(in) :: solution
      type(newton_workspace), intent(inout) :: workspace
      real(wp), allocatable :: before(:, :)
      integer :: ix, iy
      real(wp) :: z(2), length

      before = limits_before(problem, solution%p, solution%slip, system%r)
      allocate(workspace%point(problem%mx, problem%my))
      workspace%weight = 0.0_wp
      workspace%direction = 0.0_wp
      workspace%residual = 0.0_wp
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) cycle
            z = solution%p(ix, iy, :) - system%r*solution%slip(ix, iy, :)
            length = sqrt(z(1)**2 + z(2)**2)
            associate (point => workspace%point(ix, iy))
               point = return_map(length, problem%bound(ix, iy), before(ix, iy), problem%yield%slope, &
                  & problem%yield%lowest, system%r)
               workspace%weight(ix, iy) = 1.0_wp
               if (point%state /= element%adhesion) then
                  workspace%weight(ix, iy) = point%radius/length
                  workspace%direction(ix, iy, :) = z/length
                  z = z*(point%radius/length)
               end if
            end associate
            workspace%residual(ix, iy, :) = solution%p(ix, iy, :) - z
         end do
      end do
   end subroutine linearise_return_map

   !> v := v + n radial n.w, what the derivative of the return map has along n
   subroutine add_radial(workspace, w, v)
      type(newton_workspace), intent(in) :: workspace
      real(wp), contiguous, intent(in) :: w(:, :, :)
      real(wp), contiguous, intent(inout) :: v(:, :, :)
      integer :: ix, iy
      real(wp) :: c

      do iy = 1, size(v, 2)
         do ix = 1, size(v, 1)
            c = workspace%direction(ix, iy, 1)*w(ix, iy, 1) + workspace%direction(ix, iy, 2)*w(ix, iy, 2)
            v(ix, iy, :) = v(ix, iy, :) + workspace%point(ix, iy)%radius_by_length*c*workspace%direction(ix, iy, :)
         end do
      end do
   end subroutine add_radial

   !> Change of the returned tractions by changes of z = p - r S, and of the bound
   !>
   !> In steady rolling the changes of the yield limits are carried downstream.
   subroutine differentiate_return_map(problem, workspace, z, out, bound)
      type(tangential_problem), intent(in) :: problem
      type(newton_workspace), intent(in) :: workspace
      real(wp), contiguous, intent(in) :: z(:, :, :)
      real(wp), contiguous, intent(inout) :: out(:, :, :)
      real(wp), contiguous, intent(in), optional :: bound(:, :)
      integer :: ix, iy, k
      real(wp) :: c, g, limit, n(2)

      do iy = 1, problem%my
         limit = 0.0_wp
         do k = 1, problem%mx
            ix = merge(problem%mx + 1 - k, k, problem%direction > 0)
            n = workspace%direction(ix, iy, :)
            c = sum(n*z(ix, iy, :))
            associate (point => workspace%point(ix, iy))
               g = 0.0_wp
               if (present(bound)) then
                  if (point%state == element%slip) g = bound(ix, iy)
               end if
               out(ix, iy, :) = workspace%weight(ix, iy)*(z(ix, iy, :) - c*n) &
                  & + (point%radius_by_length*c + point%radius_by_limit*limit + g)*n
               if (problem%steady) then
                  limit = point%limit_by_length*c + point%limit_by_limit*limit
                  ! the limit has risen to the bound
                  if (point%plastic > 0.0_wp) limit = limit + g
               end if
            end associate
         end do
      end do
   end subroutine differentiate_return_map

   !> v := D v
   subroutine apply_d(workspace, v)
      type(newton_workspace), intent(in) :: workspace
      real(wp), contiguous, intent(inout) :: v(:, :, :)
      real(wp), allocatable :: whole(:, :, :)
      integer :: ix, iy
      real(wp) :: c

      if (allocated(workspace%point)) whole = v
      do iy = 1, size(v, 2)
         do ix = 1, size(v, 1)
            c = workspace%direction(ix, iy, 1)*v(ix, iy, 1) + workspace%direction(ix, iy, 2)*v(ix, iy, 2)
            v(ix, iy, 1) = workspace%weight(ix, iy)*(v(ix, iy, 1) - workspace%direction(ix, iy, 1)*c)
            v(ix, iy, 2) = workspace%weight(ix, iy)*(v(ix, iy, 2) - workspace%direction(ix, iy, 2)*c)
         end do
      end do
      if (allocated(workspace%point)) call add_radial(workspace, whole, v)
   end subroutine apply_d

   !> out := J y, y = (tractions, creepages), both scaled
   subroutine apply_jacobian(problem, operator, system, workspace, y, out)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(inout) :: workspace
      real(wp), contiguous, target, intent(in) :: y(:)
      real(wp), contiguous, target, intent(out) :: out(:)
      real(wp), pointer, contiguous :: dp(:, :, :), res(:, :, :)
      real(wp) :: creep(2), c, vx, vy
      integer :: ix, iy, k

      dp(1:problem%mx, 1:problem%my, 1:2) => y(:system%n)
      res(1:problem%mx, 1:problem%my, 1:2) => out(:system%n)
      call apply_operator(problem, operator, dp, workspace%trial)
      creep = 0.0_wp
      do k = 1, system%n_forces
         creep(k) = system%creep_scale*y(system%n + k)/system%g_norm
      end do
      if (allocated(problem%share)) then
         call add_creepages(problem, creep, workspace%trial)
         creep = 0.0_wp
      end if
      creep = problem%dq*creep
      if (allocated(workspace%point)) then
         do k = 1, 2
            workspace%trial(:, :, k) = dp(:, :, k) - system%r*(workspace%trial(:, :, k) + creep(k))
         end do
         call differentiate_return_map(problem, workspace, workspace%trial, res)
         res = dp - res
      else
         do iy = 1, problem%my
            do ix = 1, problem%mx
               vx = dp(ix, iy, 1) - system%r*(workspace%trial(ix, iy, 1) + creep(1))
               vy = dp(ix, iy, 2) - system%r*(workspace%trial(ix, iy, 2) + creep(2))
               c = workspace%direction(ix, iy, 1)*vx + workspace%direction(ix, iy, 2)*vy
               res(ix, iy, 1) = dp(ix, iy, 1) - workspace%weight(ix, iy)*(vx - workspace%direction(ix, iy, 1)*c)
               res(ix, iy, 2) = dp(ix, iy, 2) - workspace%weight(ix, iy)*(vy - workspace%direction(ix, iy, 2)*c)
            end do
         end do
      end if
      do k = 1, system%n_forces
         out(system%n + k) = sum(dp(:, :, k))*system%g_norm/system%g_sum
      end do
   end subroutine apply_jacobian

   !> u := (D C^-1 D / r + 1 - D) v for traction fields
   subroutine precondition_field(problem, operator, system, workspace, v, u)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(inout) :: workspace
      real(wp), contiguous, intent(in) :: v(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      real(wp), allocatable :: whole(:, :, :)
      integer :: ix, iy
      real(wp) :: c, vx, vy, ux, uy, w, nx, ny

      workspace%trial = v
      call apply_d(workspace, workspace%trial)
      if (problem%steady) then
         call operator%steady_inverse(workspace%trial, u)
      else
         call operator%tangential_inverse(workspace%trial, u)
      end if
      if (allocated(workspace%point)) whole = u/system%r
      do iy = 1, problem%my
         do ix = 1, problem%mx
            w = workspace%weight(ix, iy)
            nx = workspace%direction(ix, iy, 1)
            ny = workspace%direction(ix, iy, 2)
            ux = u(ix, iy, 1)/system%r
            uy = u(ix, iy, 2)/system%r
            c = nx*ux + ny*uy
            vx = v(ix, iy, 1) - workspace%trial(ix, iy, 1)
            vy = v(ix, iy, 2) - workspace%trial(ix, iy, 2)
            u(ix, iy, 1) = w*(ux - nx*c) + vx
            u(ix, iy, 2) = w*(uy - ny*c) + vy
         end do
      end do
      if (allocated(workspace%point)) call add_radial(workspace, whole, u)
   end subroutine precondition_field

   !> Preconditioned border columns and the inverse of their Schur complement
   subroutine prepare_border(problem, operator, system, workspace, preconditionings)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(inout) :: system
      type(newton_workspace), intent(inout) :: workspace
      integer, intent(inout) :: preconditionings
      integer :: k, j
      real(wp) :: s(2, 2), det, creep(2)

      s = 0.0_wp
      do k = 1, system%n_forces
         workspace%best_slip = 0.0_wp
         creep = 0.0_wp
         creep(k) = system%r*system%creep_scale/system%g_norm
         call add_creepages(problem, creep, workspace%best_slip)
         call apply_d(workspace, workspace%best_slip)
         call precondition_field(problem, operator, system, workspace, workspace%best_slip, workspace%border(:, :, :, k))
         preconditionings = preconditionings + 1
         do j = 1, system%n_forces
            s(j, k) = -sum(workspace%border(:, :, j, k))*system%g_norm/system%g_sum
         end do
      end do
      system%schur = 0.0_wp
      if (system%n_forces == 1) then
         if (abs(s(1, 1)) > 1.0e-12_wp) system%schur(1, 1) = 1.0_wp/s(1, 1)
      else if (system%n_forces == 2) then
         det = s(1, 1)*s(2, 2) - s(1, 2)*s(2, 1)
         if (abs(det) > 1.0e-14_wp*(s(1, 1)**2 + s(2, 2)**2)) then
            system%schur = reshape([s(2, 2), -s(2, 1), -s(1, 2), s(1, 1)], [2, 2])/det
         else
            do k = 1, 2
               if (abs(s(k, k)) > 0.0_wp) system%schur(k, k) = 1.0_wp/s(k, k)
            end do
         end if
      end if
   end subroutine prepare_border

   !> out := M^-1 v, bordered
   subroutine precondition(problem, operator, system, workspace, v, out, preconditionings)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(inout) :: workspace
      real(wp), contiguous, target, intent(in) :: v(:)
      real(wp), contiguous, target, intent(inout) :: out(:)
      integer, intent(inout) :: preconditionings
      real(wp), pointer, contiguous :: field(:, :, :), u(:, :, :)
      real(wp) :: rest(2), dc(2)
      integer :: k

      field(1:problem%mx, 1:problem%my, 1:2) => v(:system%n)
      u(1:problem%mx, 1:problem%my, 1:2) => out(:system%n)
      call precondition_field(problem, operator, system, workspace, field, u)
      preconditionings = preconditionings + 1
      if (system%n_forces == 0) return
      rest = 0.0_wp
      do k = 1, system%n_forces
         rest(k) = v(system%n + k) - sum(u(:, :, k))*system%g_norm/system%g_sum
      end do
      dc = matmul(system%schur, rest)
      do k = 1, system%n_forces
         u = u - dc(k)*workspace%border(:, :, :, k)
         out(system%n + k) = dc(k)
      end do
   end subroutine precondition

   !> Restarted GMRES (Saad and Schultz 1986), preconditioned from the right
   !>
   !> On exit workspace%step holds the correction of the tractions [N/mm2].
   subroutine solve_linear(problem, operator, system, workspace, unbalance, tolerance, correction, preconditionings, reached)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(inout) :: system
      type(newton_workspace), target, intent(inout) :: workspace
      !> Errors of the prescribed forces, relative
      real(wp), intent(in) :: unbalance(2)
      !> Relative to the right-hand side
      real(wp), intent(in) :: tolerance
      !> Correction of the creepages
      real(wp), intent(out) :: correction(2)
      integer, intent(inout) :: preconditionings
      !> Relative residual that was reached; a Newton step is judged by the residual of the tractions it leads to
      real(wp), intent(out), optional :: reached
      real(wp) :: h(restart + 1, restart), cs(restart), sn(restart), s(restart + 1), y(restart)
      real(wp) :: start, beta, before, after, t
      integer :: n, m, j, k, cycle_, used

      n = system%n + system%n_forces
      if (system%n_forces > 0) call prepare_border(problem, operator, system, workspace, preconditionings)
      associate (v => workspace%basis, z => workspace%preconditioned, x => workspace%x, b => workspace%b)
         x = 0.0_wp
         call flatten(workspace%residual, b)
         b(:system%n) = -b(:system%n)
         if (n > system%n) b(system%n + 1:n) = -system%g_norm*unbalance(:system%n_forces)
         v(:n, 1) = b(:n)
         start = norm2(v(:n, 1))
         beta = start
         do cycle_ = 1, max_cycles
            if (.not. beta > tolerance*start) exit
            v(:n, 1) = v(:n, 1)/beta
            s = 0.0_wp
            s(1) = beta
            used = 0
            do j = 1, restart
               call precondition(problem, operator, system, workspace, v(:n, j), z(:n, j), preconditionings)
               call apply_jacobian(problem, operator, system, workspace, z(:n, j), v(:n, j + 1))
               before = norm2(v(:n, j + 1))
               do k = 1, j
                  h(k, j) = dot_product(v(:n, k), v(:n, j + 1))
                  v(:n, j + 1) = v(:n, j + 1) - h(k, j)*v(:n, k)
               end do
               after = norm2(v(:n, j + 1))
               if (after < 0.1_wp*before) then
                  do k = 1, j
                     t = dot_product(v(:n, k), v(:n, j + 1))
                     h(k, j) = h(k, j) + t
                     v(:n, j + 1) = v(:n, j + 1) - t*v(:n, k)
                  end do
                  after = norm2(v(:n, j + 1))
               end if
               h(j + 1, j) = after
               if (after > 0.0_wp) v(:n, j + 1) = v(:n, j + 1)/after
               do k = 1, j - 1
                  t = cs(k)*h(k, j) + sn(k)*h(k + 1, j)
                  h(k + 1, j) = -sn(k)*h(k, j) + cs(k)*h(k + 1, j)
                  h(k, j) = t
               end do
               t = hypot(h(j, j), h(j + 1, j))
               if (.not. t > 0.0_wp) exit
               used = j
               cs(j) = h(j, j)/t
               sn(j) = h(j + 1, j)/t
               h(j, j) = t
               s(j + 1) = -sn(j)*s(j)
               s(j) = cs(j)*s(j)
               if (abs(s(j + 1)) <= tolerance*start .or. .not. after > 0.0_wp) exit
            end do
            if (used == 0) exit
            do k = used, 1, -1
               y(k) = (s(k) - dot_product(h(k, k + 1:used), y(k + 1:used)))/h(k, k)
            end do
            do k = 1, used
               x(:n) = x(:n) + y(k)*z(:n, k)
            end do
            beta = abs(s(used + 1))
            if (beta <= tolerance*start .or. cycle_ == max_cycles) exit
            call apply_jacobian(problem, operator, system, workspace, x(:n), workspace%work(:n))
            v(:n, 1) = b(:n) - workspace%work(:n)
            beta = norm2(v(:n, 1))
         end do
         if (present(reached)) reached = beta/start
         m = system%n
         call unfold(x, workspace%step)
         correction = 0.0_wp
         do k = 1, system%n_forces
            correction(k) = x(m + k)*system%creep_scale/system%g_norm
         end do
      end associate
   end subroutine solve_linear

   !> One line of the flow trace about a Newton step
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

   !> Traction field as the first part of a vector of unknowns
   pure subroutine flatten(field, vector)
      real(wp), contiguous, intent(in) :: field(:, :, :)
      real(wp), contiguous, intent(inout) :: vector(:)
      integer :: iy, k, first

      first = 0
      do k = 1, size(field, 3)
         do iy = 1, size(field, 2)
            vector(first + 1:first + size(field, 1)) = field(:, iy, k)
            first = first + size(field, 1)
         end do
      end do
   end subroutine flatten

   !> First part of a vector of unknowns as a traction field
   pure subroutine unfold(vector, field)
      real(wp), contiguous, intent(in) :: vector(:)
      real(wp), contiguous, intent(inout) :: field(:, :, :)
      integer :: iy, k, first

      first = 0
      do k = 1, size(field, 3)
         do iy = 1, size(field, 2)
            field(:, iy, k) = vector(first + 1:first + size(field, 1))
            first = first + size(field, 1)
         end do
      end do
   end subroutine unfold

   !> out := projection of p + alpha d onto the discs
   subroutine step_and_project(problem, p, alpha, d, out)
      type(tangential_problem), intent(in) :: problem
      real(wp), contiguous, intent(in) :: p(:, :, :), d(:, :, :)
      real(wp), intent(in) :: alpha
      real(wp), contiguous, intent(inout) :: out(:, :, :)
      integer :: ix, iy
      real(wp) :: q(2), length

      do iy = 1, problem%my
         do ix = 1, problem%mx
            q = p(ix, iy, :) + alpha*d(ix, iy, :)
            length = sqrt(q(1)**2 + q(2)**2)
            if (.not. problem%contact(ix, iy)) then
               q = 0.0_wp
            else if (length > problem%bound(ix, iy)) then
               q = q*(problem%bound(ix, iy)/length)
            end if
            out(ix, iy, :) = q
         end do
      end do
   end subroutine step_and_project

   !> Allocate scratch for a window; keeps it when the size is the same
   subroutine fit_workspace(workspace, mx, my)
      type(newton_workspace), intent(inout) :: workspace
      integer, intent(in) :: mx, my

      if (workspace%mx == mx .and. workspace%my == my) return
      if (allocated(workspace%basis)) then
         deallocate(workspace%basis, workspace%preconditioned, workspace%x, workspace%b, workspace%work)
         deallocate(workspace%weight, workspace%direction, workspace%trial, workspace%trial_slip)
         deallocate(workspace%residual, workspace%step, workspace%best_slip, workspace%border)
      end if
      ! memory is touched when a vector is first used
      allocate(workspace%basis(2*mx*my + 2, restart + 1), workspace%preconditioned(2*mx*my + 2, restart))
      allocate(workspace%x(2*mx*my + 2), workspace%b(2*mx*my + 2), workspace%work(2*mx*my + 2))
      allocate(workspace%weight(mx, my), workspace%direction(mx, my, 2), source=0.0_wp)
      allocate(workspace%trial(mx, my, 2), workspace%trial_slip(mx, my, 2), source=0.0_wp)
      allocate(workspace%residual(mx, my, 2), workspace%step(mx, my, 2), workspace%best_slip(mx, my, 2), source=0.0_wp)
      allocate(workspace%border(mx, my, 2, 2), source=0.0_wp)
      workspace%mx = mx
      workspace%my = my
   end subroutine fit_workspace
end module contact_tangential_newton
