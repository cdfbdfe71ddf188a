!> Newton-Krylov method with nested iteration: coarse grids provide the initial estimate
!>
!> Each level has half the number of elements in the directions that are long enough. Bounds and rigid slip are averaged;
!> tractions relative to the bound are interpolated bilinearly, extended beyond the edge by a few rings of elements, and limited
!> to the discs.
module contact_tangential_nested
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_elastic_new_compliance, only : new_compliance
   use contact_grid_coarsening, only : coarse_neighbours, coarse_size, coarsening_factor, shortest_side
   use contact_numeric_pieces, only : pieces_of
   use contact_tangential_local_estimate, only : estimate_locally
   use contact_tangential_newton_adjoint, only : newton_adjoint
   use contact_tangential_newton, only : newton_derivative, newton_outcome, newton_solve, newton_workspace
   use contact_tangential_problem, only : prepare_solution, residual_scale, finish_slip, slip_of, &
      & tangential_problem, tangential_solution, true_residual
   implicit none (type, external)
   private

   public :: nested_workspace, release_nested, solve_newton_krylov, traction_adjoint, traction_derivative

   !> Workspace of one level
   type :: level_type
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      class(compliance), allocatable :: operator
      type(newton_workspace) :: newton
      !> Relative tractions for interpolation, shape (mx, my, 2), and elements that have them
      real(wp), allocatable :: relative(:, :, :), smooth(:, :, :)
      logical, allocatable :: known(:, :), fresh(:, :)
   end type level_type

   !> Workspace of all levels; level 1 is the finest and contains only what the caller does not provide
   type :: nested_workspace
      type(level_type), allocatable :: level(:)
   end type nested_workspace

   !> Maximum number of levels
   integer, parameter :: levels = 12
   !> Windows with fewer elements are solved without coarser levels
   integer, parameter :: smallest = 900
   !> Tolerance of the coarse levels
   real(wp), parameter :: coarse_tolerance = 1.0e-2_wp
   !> An estimate better than this is not replaced by one from coarse grids
   real(wp), parameter :: good_estimate = 5.0e-2_wp

contains

   !> Solve a tangential problem by Newton-Krylov, with nested iteration if this is faster
   subroutine solve_newton_krylov(problem, operator, workspace, solution, report, log)
      !> Rigid slip, bounds, prescribed forces, tolerance; for the second-order scheme its turns are updated
      type(tangential_problem), intent(inout) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Coarser levels with operators and workspace, kept from call to call
      type(nested_workspace), intent(inout) :: workspace
      !> Estimate on entry (zero tractions if there is none)
      type(tangential_solution), intent(inout) :: solution
      !> Outcome, iterations, residual; transforms are added to the present count
      type(solve_report), intent(inout) :: report
      !> For the flow trace; absent: none
      type(log_type), intent(inout), optional :: log
      type(newton_outcome) :: outcome
      real(wp) :: residual, pairs_before
      integer :: k, products_before

      if (.not. allocated(workspace%level)) allocate(workspace%level(levels))
      pairs_before = operator%fft_pairs()
      products_before = operator%products
      report%method = "Newton-Krylov"
      report%tolerance = problem%settings%eps
      if (operator%can_coarsen() .and. is_large(problem)) then
         call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
         residual = true_residual(problem, solution%p, solution%slip, residual_scale(problem, operator))
         ! limits that are followed along rows require an estimate near the solution
         if (residual > good_estimate .or. (problem%hardens() .and. .not. any(abs(solution%p) > 0.0_wp))) then
            call solve_coarse(problem, operator, workspace, 2, solution, log)
         end if
      end if
      call estimate_from_nothing(problem, operator, solution)
      call newton_solve(problem, operator, problem%settings%eps, workspace%level(1)%newton, solution, outcome, log)
      call finish_slip(problem, residual_scale(problem, operator), solution)
      report%ended = outcome%ended
      report%iterations = outcome%steps
      report%residual = outcome%residual
      if (report%order == 2) report%order_reason = ""
      if (outcome%is_unturned) report%order_reason = "directions of slip are not turned"
      report%products = report%products + operator%products - products_before
      report%fft_pairs = report%fft_pairs + operator%fft_pairs() - pairs_before
      do k = 2, size(workspace%level)
         if (.not. allocated(workspace%level(k)%operator)) cycle
         call workspace%level(k)%operator%collect_pairs(problem%mx*problem%my, report%fft_pairs)
      end do
   end subroutine solve_newton_krylov

   !> Derivative of the tractions at a solution found by any method; see newton_derivative
   subroutine traction_derivative(problem, operator, tolerance, workspace, solution, shift, bound, derivative, reached)
      !> The problem that was solved
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the linear system, relative to its right-hand side [-]
      real(wp), intent(in) :: tolerance
      !> Workspace of the solution or any other; its contents are overwritten
      type(nested_workspace), intent(inout) :: workspace
      !> Solution at which the derivative is taken
      type(tangential_solution), intent(in) :: solution
      !> Derivative of the rigid slip per step with respect to a parameter, shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: shift(:, :, :)
      !> Derivative of the traction bound with respect to the same parameter, shape (mx, my)
      real(wp), contiguous, intent(in) :: bound(:, :)
      !> Derivative of the tractions with respect to the parameter, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: derivative(:, :, :)
      !> Relative residual of the linear system [-]
      real(wp), intent(out) :: reached

      if (.not. allocated(workspace%level)) allocate(workspace%level(levels))
      call newton_derivative(problem, operator, tolerance, workspace%level(1)%newton, solution, shift, bound, derivative, reached)
   end subroutine traction_derivative

   !> Derivatives of weighted sums of tractions at a solution found by any method; see newton_adjoint
   subroutine traction_adjoint(problem, operator, tolerance, workspace, solution, weight, by_slip, by_bound, by_angle, &
      & reached)
      !> The problem that was solved
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the linear systems, relative to their right-hand sides [-]
      real(wp), intent(in) :: tolerance
      !> Workspace of the solution or any other; its contents are overwritten
      type(nested_workspace), intent(inout) :: workspace
      !> Solution at which the derivatives are taken
      type(tangential_solution), intent(in) :: solution
      !> Weights of the sums, shape (mx, my, 2, sums)
      real(wp), contiguous, intent(in) :: weight(:, :, :, :)
      !> Derivatives with respect to the slip per step, shape (mx, my, 2, sums)
      real(wp), contiguous, intent(inout) :: by_slip(:, :, :, :)
      !> Derivatives with respect to the traction bound, shape (mx, my, sums)
      real(wp), contiguous, intent(inout) :: by_bound(:, :, :)
      !> Derivatives with respect to the angle by which the slip of an element is turned, shape (mx, my, sums)
      real(wp), contiguous, intent(inout) :: by_angle(:, :, :)
      !> Largest relative residual [-]
      real(wp), intent(out) :: reached

      if (.not. allocated(workspace%level)) allocate(workspace%level(levels))
      call newton_adjoint(problem, operator, tolerance, workspace%level(1)%newton, solution, weight, by_slip, by_bound, &
         & by_angle, reached)
   end subroutine traction_adjoint

   !> Free the plans of all levels
   subroutine release_nested(workspace)
      !> Levels whose plans are freed; may be used again
      type(nested_workspace), intent(inout) :: workspace
      integer :: k

      if (.not. allocated(workspace%level)) return
      do k = 1, size(workspace%level)
         if (allocated(workspace%level(k)%operator)) call workspace%level(k)%operator%release()
      end do
   end subroutine release_nested

   !> Is nested iteration faster?
   pure logical function is_large(problem)
      type(tangential_problem), intent(in) :: problem
      is_large = problem%mx*problem%my >= smallest .and. max(problem%mx, problem%my) >= shortest_side
   end function is_large

   !> Initial estimate without an earlier one for given creepages; with prescribed forces the method provides its own
   subroutine estimate_from_nothing(problem, operator, solution)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(tangential_solution), intent(inout) :: solution

      if (problem%n_forces > 0 .or. problem%hardens()) return
      if (.not. any(problem%bound > 0.0_wp) .or. any(abs(solution%p) > 0.0_wp)) return
      call estimate_locally(problem, operator, solution%p, solution%slip)
   end subroutine estimate_from_nothing

   !> Estimate the solution from the next coarser level
   recursive subroutine solve_coarse(fine, fine_operator, workspace, k, solution, log)
      type(tangential_problem), intent(in) :: fine
      class(compliance), intent(in) :: fine_operator
      type(nested_workspace), intent(inout) :: workspace
      !> Index of the coarse level
      integer, intent(in) :: k
      !> Solution of the fine problem, receives the estimate
      type(tangential_solution), intent(inout) :: solution
      type(log_type), intent(inout), optional :: log
      type(newton_outcome) :: outcome

      associate (level => workspace%level(k))
         call coarsen(fine, level%problem)
         call prepare_solution(level%problem, level%solution)
         level%solution%p = 0.0_wp
         level%solution%creep = solution%creep
         call new_compliance(fine_operator%model, level%operator)
         call level%operator%prepare(fine_operator%model, level%problem%dx, level%problem%dy, level%problem%mx, &
            & level%problem%my, fine%direction, fine_operator%y_first + 0.5_wp*(level%problem%dy - fine%dy))
         if (k < size(workspace%level) .and. is_large(level%problem)) &
            & call solve_coarse(level%problem, level%operator, workspace, k + 1, level%solution, log)
         call estimate_from_nothing(level%problem, level%operator, level%solution)
         call newton_solve(level%problem, level%operator, coarse_tolerance, level%newton, level%solution, outcome, log)
         ! even an unconverged coarse solution is a useful estimate: it is inside the discs
         if (outcome%ended == ending%diverged) return
         call prolong(level, fine, solution)
      end associate
   end subroutine solve_coarse

   !> The same contact with half as many elements per direction
   subroutine coarsen(fine, coarse)
      type(tangential_problem), intent(in) :: fine
      type(tangential_problem), intent(inout) :: coarse
      integer :: fx, fy, mx, my, ix, iy, jx, jy
      real(wp) :: step

      fx = coarsening_factor(fine%mx)
      fy = coarsening_factor(fine%my)
      mx = coarse_size(fine%mx)
      my = coarse_size(fine%my)
      if (allocated(coarse%contact)) then
         if (any(shape(coarse%contact) /= [mx, my])) deallocate(coarse%contact, coarse%bound, coarse%shift)
      end if
      if (.not. allocated(coarse%contact)) allocate(coarse%contact(mx, my), coarse%bound(mx, my), coarse%shift(mx, my, 2))
      coarse%mx = mx
      coarse%my = my
      coarse%dx = fx*fine%dx
      coarse%dy = fy*fine%dy
      coarse%steady = fine%steady
      coarse%direction = fine%direction
      ! the step of steady rolling is one element
      step = merge(real(fx, wp), 1.0_wp, fine%steady)
      coarse%dq = step*fine%dq
      coarse%n_forces = fine%n_forces
      coarse%deadline = fine%deadline
      if (pieces_of(fine%mx*fine%my) == 1) then
         do iy = 1, my
            call coarsen_row(iy)
         end do
      else
         !$omp parallel do
         do iy = 1, my
            call coarsen_row(iy)
         end do
         !$omp end parallel do
      end if
      coarse%target = fine%target/(fx*fy)
      if (allocated(coarse%share)) deallocate(coarse%share)
      if (allocated(fine%share)) call coarsen_share()
      if (allocated(coarse%yield)) deallocate(coarse%yield)
      if (fine%hardens()) call coarsen_limits()

   contains

      !> Contact, bounds and rigid slip of a coarse row
      subroutine coarsen_row(iy)
         integer, intent(in) :: iy
         integer :: ix, jx, jy, n
         real(wp) :: g, w(2)

         do ix = 1, mx
            g = 0.0_wp
            w = 0.0_wp
            n = 0
            coarse%contact(ix, iy) = .false.
            do jy = fy*(iy - 1) + 1, min(fy*iy, fine%my)
               do jx = fx*(ix - 1) + 1, min(fx*ix, fine%mx)
                  g = g + fine%bound(jx, jy)
                  w = w + fine%shift(jx, jy, :)
                  n = n + 1
                  if (fine%contact(jx, jy)) coarse%contact(ix, iy) = .true.
               end do
            end do
            coarse%bound(ix, iy) = g/(fx*fy)
            coarse%shift(ix, iy, :) = step*w/n
         end do
      end subroutine coarsen_row

      !> Average the fractions of the step
      subroutine coarsen_share()
         integer :: last_x, last_y

         allocate(coarse%share(mx, my))
         do iy = 1, my
            last_y = min(fy*iy, fine%my)
            do ix = 1, mx
               last_x = min(fx*ix, fine%mx)
               coarse%share(ix, iy) = sum(fine%share(fx*(ix - 1) + 1:last_x, fy*(iy - 1) + 1:last_y)) &
                  & /((last_x - fx*(ix - 1))*(last_y - fy*(iy - 1)))
            end do
         end do
      end subroutine coarsen_share

      !> Average the yield limits; plastic displacements do not depend on the element size
      subroutine coarsen_limits()
         allocate(coarse%yield)
         coarse%yield%slope = fine%yield%slope
         coarse%yield%lowest = fine%yield%lowest
         allocate(coarse%yield%limit(mx, my))
         do iy = 1, my
            jy = min(fy*iy, fine%my)
            do ix = 1, mx
               jx = min(fx*ix, fine%mx)
               coarse%yield%limit(ix, iy) = sum(fine%yield%limit(fx*(ix - 1) + 1:jx, fy*(iy - 1) + 1:jy)) &
                  & /((jx - fx*(ix - 1))*(jy - fy*(iy - 1)))
            end do
         end do
      end subroutine coarsen_limits
   end subroutine coarsen

   !> Interpolate tractions relative to their bounds to the fine grid
   subroutine prolong(level, fine, solution)
      type(level_type), intent(inout) :: level
      type(tangential_problem), intent(in) :: fine
      type(tangential_solution), intent(inout) :: solution
      integer :: mx, my, ix, iy, k

      mx = level%problem%mx
      my = level%problem%my
      if (allocated(level%relative)) then
         if (any(shape(level%known) /= [mx, my])) deallocate(level%relative, level%smooth, level%known, level%fresh)
      end if
      if (.not. allocated(level%relative)) then
         allocate(level%relative(mx, my, 2), level%smooth(mx, my, 2), level%known(mx, my), level%fresh(mx, my))
      end if
      level%relative = 0.0_wp
      do iy = 1, my
         do ix = 1, mx
            level%known(ix, iy) = level%problem%bound(ix, iy) > 0.0_wp
            if (level%known(ix, iy)) level%relative(ix, iy, :) = level%solution%p(ix, iy, :)/level%problem%bound(ix, iy)
         end do
      end do
      do k = 1, 2
         call extend(level)
      end do
      if (pieces_of(fine%mx*fine%my) == 1) then
         do iy = 1, fine%my
            call interpolate_row(iy)
         end do
      else
         !$omp parallel do schedule(dynamic, 8)
         do iy = 1, fine%my
            call interpolate_row(iy)
         end do
         !$omp end parallel do
      end if
      solution%creep = level%solution%creep

   contains

      !> Tractions of a row
      subroutine interpolate_row(iy)
         integer, intent(in) :: iy
         integer :: ix, i0, j0, i1, j1
         real(wp) :: a, b, q(2), length

         call coarse_neighbours(iy, fine%my, j0, j1, b)
         do ix = 1, fine%mx
            solution%p(ix, iy, :) = 0.0_wp
            if (.not. fine%contact(ix, iy)) cycle
            call coarse_neighbours(ix, fine%mx, i0, i1, a)
            q = (1.0_wp - b)*((1.0_wp - a)*level%relative(i0, j0, :) + a*level%relative(i1, j0, :)) &
               & + b*((1.0_wp - a)*level%relative(i0, j1, :) + a*level%relative(i1, j1, :))
            length = hypot(q(1), q(2))
            if (length > 1.0_wp) q = q/length
            solution%p(ix, iy, :) = q*fine%bound(ix, iy)
         end do
      end subroutine interpolate_row
   end subroutine prolong

   !> Extend the known elements by one ring, with the mean of the known neighbours
   subroutine extend(level)
      type(level_type), intent(inout) :: level
      integer :: ix, iy, jx, jy, n
      real(wp) :: total(2)

      level%fresh = level%known
      do iy = 1, size(level%known, 2)
         do ix = 1, size(level%known, 1)
            if (level%known(ix, iy)) cycle
            total = 0.0_wp
            n = 0
            do jy = max(1, iy - 1), min(size(level%known, 2), iy + 1)
               do jx = max(1, ix - 1), min(size(level%known, 1), ix + 1)
                  if (.not. level%known(jx, jy)) cycle
                  total = total + level%relative(jx, jy, :)
                  n = n + 1
               end do
            end do
            if (n == 0) cycle
            level%smooth(ix, iy, :) = total/n
            level%fresh(ix, iy) = .true.
         end do
      end do
      do iy = 1, size(level%known, 2)
         do ix = 1, size(level%known, 1)
            if (level%fresh(ix, iy) .and. .not. level%known(ix, iy)) level%relative(ix, iy, :) = level%smooth(ix, iy, :)
         end do
      end do
      level%known = level%fresh
   end subroutine extend
end module contact_tangential_nested
