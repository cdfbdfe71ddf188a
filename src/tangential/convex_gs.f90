!> ConvexGS: Gauss-Seidel on the tractions, for shifts, transient and steady rolling
!>
!> Solves one element problem after the other, with rows and elements ordered from the trailing to the leading edge: in steady
!> rolling the opposite order does not converge. In a shift each step decreases the energy of a convex problem, so that the
!> method always converges; Kalker (1990).
module contact_tangential_convex_gs
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_grid_element_division, only : element
   use contact_tangential_element_problem, only : element_compliance
   use contact_tangential_problem, only : tangential_problem
   use contact_tangential_streaming, only : loads, streaming_rows
   use contact_tangential_sweep, only : trace_iteration, update_watch
   implicit none (type, external)
   private

   public :: convex_gs

   !> Number of sweeps after which slip elements are processed in every second sweep only
   integer, parameter :: patience = 1000

contains

   !> Iterate from the tractions in the rows; they remain admissible in all cases
   subroutine convex_gs(problem, rows, eps, report, log)
      !> Rigid slip, bounds, relaxation and number of iterations
      type(tangential_problem), intent(in) :: problem
      !> Prepared and started
      type(streaming_rows), intent(inout) :: rows
      !> Tolerance of the updates
      real(wp), intent(in) :: eps
      !> Receives ended, iterations
      type(solve_report), intent(inout) :: report
      !> Receives a line per iteration from flow-trace level 5 on
      type(log_type), intent(inout) :: log
      type(update_watch) :: watch
      type(element_compliance) :: own, here
      real(wp), allocatable :: before(:, :, :)
      !> Displacements within a row due to a unit change of traction, by offset "receiving minus loaded"
      real(wp) :: kxx(0:rows%mx - 1), kyy(0:rows%mx - 1), kxy(0:rows%mx - 1)
      real(wp) :: slip(rows%mx, 2), s0(2), old(2), p(2), change(2)
      integer :: i, iy, row, sweep, n
      logical :: increments, skew, rest

      n = rows%mx
      increments = rows%load == loads%increments
      kxx = rows%near_xx(0:n - 1)
      kyy = rows%near_yy(0:n - 1)
      kxy = rows%near_xy(0:n - 1)
      if (increments) then
         kxx = kxx - rows%near_xx(1:n)
         kyy = kyy - rows%near_yy(1:n)
      end if
      skew = any(kxy /= 0.0_wp)
      own = rows%own_compliance()
      watch = update_watch(eps=eps, n_contact=rows%n_contact, largest_bound=maxval(rows%bound), &
         & deadline=problem%deadline)
      before = rows%p
      do sweep = 1, problem%settings%maxgs
         before = rows%p
         rest = sweep > patience .and. mod(sweep, 2) == 0
         do row = 1, rows%my
            iy = merge(row, rows%my + 1 - row, problem%row_direction > 0)
            if (rows%first(iy) > rows%last(iy)) cycle
            call rows%row_slip(iy, slip)
            do i = rows%first(iy), rows%last(iy)
               if (rows%state(i, iy) == element%exterior) cycle
               if (rest .and. rows%state(i, iy) == element%slip) cycle
               old = rows%p(i, :, iy)
               here = own
               if (rows%entered(i, iy)) then
                  here = rows%entered_compliance(i, iy)
                  slip(i, :) = rows%entered_slip(i, iy)
               end if
               s0(1) = slip(i, 1) - here%xx*old(1) - here%xy*old(2)
               s0(2) = slip(i, 2) - here%xy*old(1) - here%yy*old(2)
               call rows%solve_one(i, iy, here, s0, problem%settings%omegah, problem%settings%omegas, p)
               change = p - old
               rows%p(i, :, iy) = p
               call spread(change, i, rows%last(iy))
            end do
            if (increments) rows%dp(:, :, iy) = rows%p(0:n, :, iy) - rows%p(1:n + 1, :, iy)
            call rows%renew_row(iy)
         end do
         report%iterations = sweep
         call watch%check_update(sum((rows%p - before)**2), sum(rows%p**2), problem%settings%maxgs, report%ended)
         call trace_iteration(log, watch, "ConvexGS", rows%state)
         if (report%ended /= ending%not_started) exit
      end do
      if (watch%updates < report%iterations) rows%p = before

   contains

      !> Add the displacements due to a change of traction to the remaining elements of the row
      subroutine spread(change, i, last)
         real(wp), intent(in) :: change(2)
         integer, intent(in) :: i, last
         integer :: m

         do m = i + 1, last
            slip(m, 1) = slip(m, 1) + kxx(m - i)*change(1)
         end do
         do m = i + 1, last
            slip(m, 2) = slip(m, 2) + kyy(m - i)*change(2)
         end do
         if (.not. skew) return
         do m = i + 1, last
            slip(m, 1) = slip(m, 1) + kxy(m - i)*change(2)
            slip(m, 2) = slip(m, 2) + kxy(m - i)*change(1)
         end do
      end subroutine spread
   end subroutine convex_gs
end module contact_tangential_convex_gs
