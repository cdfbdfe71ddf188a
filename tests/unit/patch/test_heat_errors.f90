!> Errors of the highest temperature from the shape of its maximum, against temperatures of the same heat on many elements
program test_heat_errors
   use contact_base_choices, only : heat_source, motion
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_heat, only : new_heat_passage
   use contact_patch_heat_errors, only : error_of_maximum, maximum_error
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_temperature_flash_heating, only : heat_passage, new_body_pair
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Positions of the grid, elements of the exact solution per element
   integer, parameter :: positions = 16, finer = 41
   !> Temperatures of the bodies outside the contact [degC]: equal, and different ones, whose conduction is no part of the error
   real(wp), parameter :: equal(2) = [20.0_wp, 20.0_wp], different(2) = [20.0_wp, 60.0_wp]
   type(test_suite) :: suite

   call suite%start("errors of temperatures")
   call rows(20, equal, 0.0_wp)
   call rows(80, different, 0.0_wp)
   call rows(30, equal, acos(-1.0_wp))
   call columns()
   call without_heat()
   call suite%finish()

contains

   !> Heat of a row in full sliding, the root of 1 - x^2, rolling towards +x or -x: the estimate contains what
   !> elements of constant heat add to the integral
   subroutine rows(n, bulk, chi)
      !> Number of elements in contact
      integer, intent(in) :: n
      !> Temperatures of the bodies [degC]; rolling direction [rad]
      real(wp), intent(in) :: bulk(2), chi
      real(wp), dimension(positions) :: true, computed, usual
      type(maximum_error) :: error
      type(patch_problem) :: problem
      type(patch_result) :: result
      real(wp) :: exact
      integer :: k

      call solve(finer*n, 1, [0.5_wp, 0.5_wp], bulk, chi, problem, result)
      exact = maxval(result%temp1)
      do k = 1, positions
         call solve(n, 1, [(k - 0.5_wp)/positions, 0.5_wp], bulk, chi, problem, result)
         error = error_of_maximum(problem, result)
         true(k) = abs(maxval(result%temp1) - exact)
         computed(k) = error%computed
         usual(k) = error%usual
      end do
      call suite%check(rms(computed) > 0.6_wp*rms(true) .and. rms(computed) < 1.1_wp*rms(true), "a row: computed")
      call suite%check(all(usual > 0.25_wp*rms(true) .and. usual < rms(true)), "a row: half of the usual error")
   end subroutine rows

   !> Few rows: the largest temperature at their centres is below that between them
   subroutine columns()
      real(wp), dimension(positions) :: true, computed
      type(maximum_error) :: error
      type(patch_problem) :: problem
      type(patch_result) :: result
      real(wp) :: exact
      integer :: k

      call solve(451, 451, [0.5_wp, 0.5_wp], equal, 0.0_wp, problem, result)
      exact = maxval(result%temp1)
      do k = 1, positions
         call solve(451, 11, [0.5_wp, (k - 0.5_wp)/positions], equal, 0.0_wp, problem, result)
         error = error_of_maximum(problem, result)
         true(k) = abs(maxval(result%temp1) - exact)
         computed(k) = error%computed
      end do
      call suite%check(rms(computed) > 0.5_wp*rms(true) .and. rms(computed) < 2.0_wp*rms(true), "few rows")
   end subroutine columns

   !> Bodies of different temperatures without friction, and no temperatures at all: no error
   subroutine without_heat()
      type(maximum_error) :: error
      type(patch_problem) :: problem
      type(patch_result) :: result
      type(heat_passage) :: passage

      call solve(20, 20, [0.5_wp, 0.5_wp], different, 0.0_wp, problem, result)
      passage = new_heat_passage(problem, result%division)
      call passage%conduct(result%temp1, result%temp2)
      result%px = 0.0_wp
      error = error_of_maximum(problem, result)
      call suite%check(.not. max(error%rise, error%computed, error%usual) > 0.0_wp, "conduction has no error")
      deallocate(result%temp1)
      error = error_of_maximum(problem, result)
      call suite%check(.not. max(error%rise, error%computed, error%usual) > 0.0_wp, "no temperatures")
   end subroutine without_heat

   !> Root mean square
   pure real(wp) function rms(values)
      real(wp), intent(in) :: values(:)

      rms = norm2(values)/sqrt(real(size(values), wp))
   end function rms

   !> Temperatures by the heat of pressures that are the root of 1 - x^2 - y^2, at the same slip everywhere
   subroutine solve(mx, my, offset, bulk, chi, problem, result)
      !> Number of elements across contact in both directions, and position of the grid in parts of an element
      integer, intent(in) :: mx, my
      real(wp), intent(in) :: offset(2)
      !> Temperatures of the bodies [degC]; rolling direction [rad]
      real(wp), intent(in) :: bulk(2), chi
      type(patch_problem), intent(out) :: problem
      type(patch_result), intent(out) :: result
      type(heat_passage) :: passage
      real(wp), allocatable :: heat(:, :)
      real(wp) :: x, y
      integer :: ix, iy

      problem%motion = motion%steady_rolling
      problem%chi = chi
      problem%veloc = 1000.0_wp
      problem%grid%mx = mx + 2
      problem%grid%my = my
      problem%grid%dx = 2.0_wp/mx
      problem%grid%dy = 2.0_wp/my
      result%grid = problem%grid
      problem%thermal = new_body_pair(bulk, spread(450.0_wp, 1, 2), spread(0.05_wp, 1, 2), spread(7.85e-6_wp, 1, 2), 1.0_wp)
      problem%thermal%source = heat_source%moving
      allocate(heat(mx + 2, my), result%division(mx + 2, my), result%temp1(mx + 2, my), result%temp2(mx + 2, my))
      do iy = 1, my
         y = (iy - 0.5_wp*(my + 1) + offset(2) - 0.5_wp)*problem%grid%dy
         do ix = 1, mx + 2
            x = (ix - 0.5_wp*(mx + 3) + offset(1) - 0.5_wp)*problem%grid%dx
            heat(ix, iy) = 1.0e4_wp*sqrt(max(0.0_wp, 1.0_wp - x**2 - y**2))
         end do
      end do
      result%px = heat
      result%sx = spread(spread(result%dt, 1, mx + 2), 2, my)
      allocate(result%py, result%sy, mold=heat)
      result%py = 0.0_wp
      result%sy = 0.0_wp
      result%division = merge(element%slip, element%exterior, heat > 0.0_wp)
      passage = new_heat_passage(problem, result%division)
      call passage%surface_temperatures(heat, result%temp1, result%temp2)
   end subroutine solve
end program test_heat_errors
