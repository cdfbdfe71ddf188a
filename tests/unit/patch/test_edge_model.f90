!> Errors at the leading edge of unlike bodies: of a solution, and of one on smaller elements that is expected from it
program test_edge_model
   use contact_base_choices, only : motion
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_edge_slip, only : edge_slip_error
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Coefficient of friction, and Dundurs' constant: more than half of it, so that levels do not show the error
   real(wp), parameter :: mu = 0.2_wp, beta = 0.15_wp
   type(test_suite) :: suite

   call suite%start("edge model")
   call equal_rows(suite)
   call turning(suite)
   call suite%finish()

contains

   !> Equal rows: the error on finer elements that is expected from coarse ones is that of a solution on finer ones
   subroutine equal_rows(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 12, finer = 3
      real(wp), parameter :: below = 0.9_wp
      type(patch_problem) :: problem
      type(patch_result) :: coarse, fine
      real(wp) :: e

      problem%motion = motion%steady_rolling
      problem%model%material%nu = 0.3_wp
      problem%model%material%ak = beta*(1.0_wp - problem%model%material%nu)
      call make_rows(n, 1, 1.0_wp, coarse)
      call make_rows(finer*n, finer, 1.0_wp, fine)
      e = edge_slip_error(problem, fine)
      call suite%close_to(edge_slip_error(problem, coarse, real(finer, wp)), e, 1.0e-14_wp, "slip that becomes resolved")
      ! a part n - 1 of n sticks, and tractions reverse between both slip areas
      call suite%close_to(edge_slip_error(problem, coarse), 2.0_wp*beta/(pi*mu)/n*(1.0_wp - 0.5_wp/n), 1.0e-14_wp, &
         & "slip in one element")
      call make_rows(n, 0, below, coarse)
      e = edge_slip_error(problem, coarse)
      call suite%close_to(e, 2.0_wp*beta/(pi*mu)/n*0.5_wp*exp((below - 1.0_wp)*pi*mu/beta), 1.0e-14_wp, "slip within an element")
      call suite%close_to(edge_slip_error(problem, coarse, 1.5_wp), e, 1.0e-14_wp, "smaller elements that are still too long")
      call suite%check(edge_slip_error(problem, coarse, 8.0_wp) < 0.1_wp*e, "elements that resolve slip")
   end subroutine equal_rows

   !> Equal rows with constant pressures: slip at the leading edge, adhesion behind it
   subroutine make_rows(n, ahead, used, result)
      !> Number of elements in a row, and of those that slip
      integer, intent(in) :: n, ahead
      !> Part of the bound that is used in the leading element
      real(wp), intent(in) :: used
      type(patch_result), intent(out) :: result
      integer, parameter :: rows = 5
      real(wp), parameter :: pressure = 300.0_wp

      result%grid%mx = n
      result%grid%my = rows
      allocate(result%pn(n, rows), source=pressure)
      allocate(result%mu(n, rows), source=mu)
      allocate(result%px(n, rows), result%py(n, rows), source=0.0_wp)
      allocate(result%division(n, rows), source=element%adhesion)
      result%px(n - max(1, ahead) + 1:, :) = used*mu*pressure
      result%division(n - ahead + 1:, :) = element%slip
   end subroutine make_rows

   !> Tractions that turn between the first two elements of an ellipse in full sliding, on more and more elements
   subroutine turning(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 100
      real(wp), parameter :: angle = 0.1_wp
      type(patch_problem) :: problem
      type(patch_result) :: result
      real(wp) :: x, y, e
      integer :: ix, iy

      problem%motion = motion%steady_rolling
      problem%model%material%nu = 0.3_wp
      problem%model%material%ak = beta*(1.0_wp - problem%model%material%nu)
      result%grid%mx = n
      result%grid%my = n
      allocate(result%pn(n, n), result%px(n, n), result%py(n, n), source=0.0_wp)
      allocate(result%mu(n, n), source=mu)
      allocate(result%division(n, n), source=element%exterior)
      do iy = 1, n
         y = (2.0_wp*iy - 1.0_wp)/n - 1.0_wp
         do ix = 1, n
            ! the leading element of each row begins at the edge
            x = sqrt(1.0_wp - y**2) - (2.0_wp*(n - ix) + 1.0_wp)/n
            if (x**2 + y**2 >= 1.0_wp) cycle
            result%pn(ix, iy) = sqrt(1.0_wp - x**2 - y**2)
            result%division(ix, iy) = element%slip
         end do
      end do
      result%px = mu*result%pn
      result%px(n, :) = mu*result%pn(n, :)*cos(angle)
      result%py(n, :) = mu*result%pn(n, :)*sin(angle)
      e = edge_slip_error(problem, result)
      ! one and a half times the change of direction, in the part of the leading elements
      call suite%close_to(e, 1.5_wp*2.0_wp*sin(0.5_wp*angle)*sum(result%pn(n, :))/sum(result%pn), 1.0e-12_wp, "tractions that turn")
      ! the part of the leading elements decreases with the power 1.5, and so fast at least the error
      call suite%check(edge_slip_error(problem, result, 4.0_wp) < e/8.0_wp, "smaller elements")
      call suite%check(edge_slip_error(problem, result, 4.0_wp) > e/16.0_wp, "less than by the second order")
   end subroutine turning
end program test_edge_model
