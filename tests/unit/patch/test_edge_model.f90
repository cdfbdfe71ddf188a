!> Errors at the leading edge of unlike bodies: the model for a solution against that for an expected one
program test_edge_model
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_edge_slip, only : edge_slip_error, expected_edge, expected_edge_error
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite

   call suite%start("edge model")
   call equal_rows(suite)
   call turning(suite)
   call suite%finish()

contains

   !> The expected error at the leading edge is that of a solution of equal rows
   subroutine equal_rows(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 12, rows = 5, ahead(3) = [0, 1, 3]
      real(wp), parameter :: mu = 0.2_wp, pressure = 300.0_wp, beta = 0.15_wp
      type(patch_problem) :: problem
      type(patch_result) :: result
      type(expected_edge) :: edge
      integer :: k

      problem%motion = motion%steady_rolling
      problem%model%material%nu = 0.3_wp
      problem%model%material%ak = beta*(1.0_wp - problem%model%material%nu)
      result%grid%mx = n
      result%grid%my = rows
      allocate(result%pn(n, rows), source=pressure)
      allocate(result%mu(n, rows), source=mu)
      allocate(result%px(n, rows), result%py(n, rows), source=0.0_wp)
      allocate(result%division(n, rows))
      do k = 1, size(ahead)
         result%division = element%adhesion
         result%px = 0.0_wp
         ! the bound is reached in the leading element that still sticks, or in the slip area ahead
         result%px(n - max(1, ahead(k)) + 1:, :) = mu*pressure
         result%division(n - ahead(k) + 1:, :) = element%slip
         edge%ratio = beta/mu
         edge%sticking = 1.0_wp - ahead(k)/real(n, wp)
         edge%turned = 0.5_wp
         edge%width = max(0.5_wp, real(ahead(k), wp))/n
         call suite%close_to(expected_edge_error(edge, real(n, wp)), edge_slip_error(problem, result), 1.0e-14_wp, &
            & "the model of a solution and of an expected one")
      end do
   end subroutine equal_rows

   !> Tractions that turn between the first two elements of an ellipse in full sliding, on more and more elements
   subroutine turning(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 100
      real(wp), parameter :: mu = 0.3_wp, angle = 0.1_wp, beta = 0.15_wp
      !> Rows and elements are finite in number
      real(wp), parameter :: close = 0.03_wp
      type(patch_problem) :: problem
      type(patch_result) :: result
      type(expected_edge) :: edge
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
      edge%ratio = beta/mu
      edge%turning = 2.0_wp*sin(0.5_wp*angle)
      e = expected_edge_error(edge, real(n, wp))
      call suite%close_to(edge_slip_error(problem, result), e, close*e, "tractions that turn")
   end subroutine turning
end program test_edge_model
