!> SteadyGS: Gauss-Seidel on the increments of the tractions in steady rolling
!>
!> Adhering elements carry a traction downstream: for constant increments a change of p(i) changes only the increment of i and,
!> with opposite sign, that of the first downstream element that does not adhere. Element problems have the compliance C = c(0)
!> - c(landing - i); rows are processed in increasing y, elements from the trailing to the leading edge. The method of CONTACT
!> (Vollebregt) for the discrete problem of Kalker (1990).
module contact_tangential_steady_gs
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_grid_element_division, only : element
   use contact_tangential_problem, only : tangential_problem
   use contact_tangential_streaming, only : streaming_rows
   use contact_tangential_sweep, only : trace_iteration, update_watch
   implicit none (type, external)
   private

   public :: steady_gs

contains

   !> Iterate from the tractions in the rows; they remain admissible in all cases
   subroutine steady_gs(problem, rows, eps, report, log)
      !> Rigid slip, bounds, relaxation and number of iterations
      type(tangential_problem), intent(in) :: problem
      !> Prepared for increments, and started
      type(streaming_rows), intent(inout) :: rows
      !> Tolerance of the updates
      real(wp), intent(in) :: eps
      !> Receives ended, iterations
      type(solve_report), intent(inout) :: report
      !> Receives a line per iteration from flow-trace level 5 on
      type(log_type), intent(inout) :: log
      type(update_watch) :: watch
      real(wp), allocatable :: before(:, :, :)
      integer :: iy, sweep
      real(wp) :: slip(rows%mx, 2)

      watch = update_watch(eps=eps, n_contact=rows%n_contact, largest_bound=maxval(rows%bound), &
         & deadline=problem%deadline)
      before = rows%p
      do sweep = 1, problem%settings%maxgs
         before = rows%p
         do iy = 1, rows%my
            if (rows%first(iy) > rows%last(iy)) cycle
            call rows%row_slip(iy, slip)
            call sweep_row(rows, iy, problem%settings%omegah, problem%settings%omegas, slip)
            call rows%renew_row(iy)
         end do
         report%iterations = sweep
         call watch%check_update(sum((rows%p - before)**2), sum(rows%p**2), problem%settings%maxgs, report%ended)
         call trace_iteration(log, watch, "SteadyGS", rows%state)
         if (report%ended /= ending%not_started) exit
      end do
      if (watch%updates < report%iterations) rows%p = before
   end subroutine steady_gs

   !> Process all elements of a row, from the trailing to the leading edge
   subroutine sweep_row(rows, iy, omegah, omegas, slip)
      type(streaming_rows), intent(inout) :: rows
      integer, intent(in) :: iy
      real(wp), intent(in) :: omegah, omegas
      !> Slip of the row [mm]; updated for the remaining elements
      real(wp), contiguous, intent(inout) :: slip(:, :)
      integer :: i, landing, behind
      real(wp) :: p(2), old(2), s0(2)

      behind = rows%last(iy)
      do i = rows%first(iy), rows%last(iy)
         if (rows%state(i, iy) == element%exterior) cycle
         landing = i - 1
         do while (rows%state(landing, iy) == element%adhesion)
            landing = landing - 1
         end do
         old = rows%p(i, :, iy)
         associate (c => rows%landing_compliance(i - landing))
            s0 = slip(i, :) - [c%xx*old(1), c%yy*old(2)]
            call rows%solve_one(i, iy, c, s0, omegah, omegas, p)
         end associate
         rows%p(i, :, iy) = p
         call change_increment(rows, iy, i, p - old, i, behind, slip)
         call carry_downstream(rows, iy, i, behind, slip)
      end do
   end subroutine sweep_row

   !> Make the tractions downstream of element i consistent with its traction
   subroutine carry_downstream(rows, iy, i, last, slip)
      type(streaming_rows), intent(inout) :: rows
      integer, intent(in) :: iy, i, last
      real(wp), contiguous, intent(inout) :: slip(:, :)
      integer :: k
      real(wp) :: p(2), change(2), length, bound

      do k = i - 1, 0, -1
         if (rows%state(k, iy) /= element%adhesion) exit
         p = rows%p(k + 1, :, iy) + rows%dp(k, :, iy)
         length = hypot(p(1), p(2))
         bound = rows%largest(k, iy)
         if (length > bound) then
            p = p*(bound/length)
            rows%p(k, :, iy) = p
            change = p - rows%p(k + 1, :, iy) - rows%dp(k, :, iy)
            call change_increment(rows, iy, k, change, i, last, slip)
         else
            rows%p(k, :, iy) = p
         end if
      end do
      ! the traction of a slipping element is unchanged, that of an exterior one is zero
      change = rows%p(k, :, iy) - rows%p(k + 1, :, iy) - rows%dp(k, :, iy)
      call change_increment(rows, iy, k, change, i, last, slip)
   end subroutine carry_downstream

   !> Change one increment, and add the effect to the slip of the elements upstream of i
   subroutine change_increment(rows, iy, k, change, i, last, slip)
      type(streaming_rows), intent(inout) :: rows
      integer, intent(in) :: iy, k, i, last
      real(wp), intent(in) :: change(2)
      real(wp), contiguous, intent(inout) :: slip(:, :)
      integer :: m

      if (all(change == 0.0_wp)) return
      rows%dp(k, :, iy) = rows%dp(k, :, iy) + change
      do m = i + 1, last
         slip(m, 1) = slip(m, 1) + rows%near_xx(m - k)*change(1)
      end do
      do m = i + 1, last
         slip(m, 2) = slip(m, 2) + rows%near_yy(m - k)*change(2)
      end do
   end subroutine change_increment
end module contact_tangential_steady_gs
