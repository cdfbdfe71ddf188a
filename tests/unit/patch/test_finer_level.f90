!> A solution taken over to other elements of the same window: linear fields are kept, edges and states of elements, too
program test_finer_level
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_finer_level, only : interpolate_fields
   use contact_patch_problem, only : traction_fields
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: mx = 9, my = 6
   type(test_suite) :: suite
   type(potential_contact) :: old
   integer :: trial

   call suite%start("finer_level")
   old = potential_contact(mx=mx, my=my, xl=-1.2_wp, yl=0.7_wp, dx=0.3_wp, dy=0.5_wp)
   do trial = 1, 20
      call linear_fields(suite, mx + 3*trial, my + trial)
   end do
   call same_elements(suite)
   call one_row(suite)
   call suite%finish()

contains

   !> A field of each kind, linear in x and y and positive in the window
   pure real(wp) function linear(x, y)
      real(wp), intent(in) :: x, y

      linear = 5.0_wp + 0.7_wp*x - 0.9_wp*y
   end function linear

   !> Tractions on the old elements; contact everywhere, slip in the columns from the fifth one on
   subroutine fill(fields)
      type(traction_fields), intent(out) :: fields
      integer :: ix, iy

      fields%grid = old
      allocate(fields%pn(mx, my), fields%px(mx, my), fields%py(mx, my), fields%division(mx, my))
      do iy = 1, my
         do ix = 1, mx
            fields%pn(ix, iy) = linear(old%x(ix), old%y(iy))
         end do
      end do
      fields%px = -2.0_wp*fields%pn
      fields%py = 3.0_wp*fields%pn
      fields%division = element%adhesion
      fields%division(5:, :) = element%slip
   end subroutine fill

   subroutine linear_fields(suite, nx, ny)
      type(test_suite), intent(inout) :: suite
      !> Numbers of the new elements in the same window
      integer, intent(in) :: nx, ny
      type(traction_fields) :: fields
      type(potential_contact) :: grid
      real(wp) :: error, edge
      integer :: ix, iy

      call fill(fields)
      grid = potential_contact(mx=nx, my=ny, xl=old%xl, yl=old%yl, dx=mx*old%dx/nx, dy=my*old%dy/ny)
      call interpolate_fields(grid, fields)
      call suite%check(fields%grid%mx == nx .and. all(shape(fields%pn) == [nx, ny]), "on the new elements")
      error = 0.0_wp
      edge = -huge(edge)
      do iy = 1, ny
         do ix = 1, nx
            associate (x => grid%x(ix), y => grid%y(iy))
               if (x < old%x(1) .or. x > old%x(mx) .or. y < old%y(1) .or. y > old%y(my)) then
                  ! beyond the outermost centres fields decrease to zero
                  edge = max(edge, fields%pn(ix, iy) - linear(x, y))
               else
                  error = max(error, abs(fields%pn(ix, iy) - linear(x, y)))
               end if
            end associate
         end do
      end do
      call suite%close_to(error, 0.0_wp, 1.0e-12_wp, "linear between centres")
      call suite%check(edge <= 0.9_wp, "no more than the outermost values at the edges")
      call suite%close_to(maxval(abs(fields%px + 2.0_wp*fields%pn)) + maxval(abs(fields%py - 3.0_wp*fields%pn)), 0.0_wp, &
         & 1.0e-12_wp, "all tractions equal")
      call suite%check(all(fields%division > element%exterior .eqv. fields%pn > 0.0_wp), "contact where there is pressure")
      call suite%check(fields%division(1, ny/2) == element%adhesion .and. fields%division(nx, ny/2) == element%slip, &
         & "states of the nearest elements")
   end subroutine linear_fields

   !> The same elements keep all
   subroutine same_elements(suite)
      type(test_suite), intent(inout) :: suite
      type(traction_fields) :: fields, before

      call fill(fields)
      before = fields
      call interpolate_fields(old, fields)
      call suite%close_to(maxval(abs(fields%pn - before%pn)), 0.0_wp, 1.0e-12_wp, "pressures of the same elements")
      call suite%check(all(fields%division == before%division), "states of the same elements")
   end subroutine same_elements

   !> One row of plane strain stays one row
   subroutine one_row(suite)
      type(test_suite), intent(inout) :: suite
      type(traction_fields) :: fields
      type(potential_contact) :: grid

      call fill(fields)
      fields%grid%my = 1
      fields%pn = reshape(fields%pn(:, 1), [mx, 1])
      fields%px = reshape(fields%px(:, 1), [mx, 1])
      fields%py = reshape(fields%py(:, 1), [mx, 1])
      fields%division = reshape(fields%division(:, 1), [mx, 1])
      grid = potential_contact(mx=3*mx, my=1, xl=old%xl, yl=old%yl, dx=old%dx/3, dy=old%dy)
      call interpolate_fields(grid, fields)
      call suite%close_to(maxval(abs(fields%pn(2:3*mx - 1:3, 1) - [(linear(old%x(trial), old%y(1)), trial=1, mx)])), 0.0_wp, &
         & 1.0e-12_wp, "one row")
   end subroutine one_row
end program test_finer_level
