!> Tractions that change linearly in time are extrapolated exactly, on grids that are shifted from case to case
program test_extrapolation
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_extrapolation, only : extrapolate
   use contact_patch_problem, only : patch_state, traction_fields
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: dx = 0.3_wp, dy = 0.5_wp, close = 1.0e-12_wp
   type(test_suite) :: suite
   type(patch_state) :: state
   integer :: iy

   call suite%start("extrapolation")
   ! the first case has no predecessor
   call set_fields(0.0_wp, 9, 7, 0, 0, state%now)
   call extrapolate(state, 1.0_wp)
   call compare(0.0_wp, 9, 7, 0, 0, "one case only")
   ! the second grid is larger and starts before the first one
   call set_fields(1.0_wp, 11, 8, -1, -1, state%now)
   call extrapolate(state, 0.0_wp)
   call compare(1.0_wp, 11, 8, -1, -1, "no step")
   call set_fields(2.0_wp, 8, 7, 1, 0, state%now)
   call extrapolate(state, 1.5_wp)
   call compare(3.5_wp, 8, 7, 1, 0, "one and a half steps")
   ! pressures do not become negative, and elements without pressure remain so
   call set_fields(3.0_wp, 8, 7, 1, 0, state%now)
   state%now%pn = 0.1_wp*state%now%pn
   state%now%pn(3, :) = 0.0_wp
   call extrapolate(state, 1.0_wp)
   call suite%check(minval(state%now%pn) >= 0.0_wp .and. maxval(state%now%pn) <= 0.0_wp, "pressures that vanish")
   ! fields on other elements are not used
   call set_fields(4.0_wp, 8, 7, 1, 0, state%now)
   state%earlier%grid%dx = 2.0_wp*dx
   call extrapolate(state, 1.0_wp)
   call compare(4.0_wp, 8, 7, 1, 0, "elements of another size")
   call suite%finish()

contains

   !> Fields of a time on a grid whose first element has the given numbers on a common lattice
   subroutine set_fields(time, mx, my, first_x, first_y, fields)
      real(wp), intent(in) :: time
      integer, intent(in) :: mx, my, first_x, first_y
      type(traction_fields), intent(inout) :: fields
      integer :: ix, iy

      fields%grid = potential_contact(mx=mx, my=my, xl=first_x*dx, yl=first_y*dy, dx=dx, dy=dy)
      fields%pen = 0.1_wp + 0.01_wp*time
      if (allocated(fields%pn)) deallocate(fields%pn, fields%px, fields%py)
      allocate(fields%pn(mx, my), fields%px(mx, my), fields%py(mx, my))
      do iy = 1, my
         do ix = 1, mx
            associate (x => real(first_x + ix, wp), y => real(first_y + iy, wp))
               fields%pn(ix, iy) = 10.0_wp + x + 2.0_wp*y + time*(1.0_wp + 0.1_wp*x*y)
               fields%px(ix, iy) = x - y + time*x
               fields%py(ix, iy) = x*y - time*y
            end associate
         end do
      end do
   end subroutine set_fields

   !> Compare the estimate with the fields of a time, where the two cases before have common elements
   subroutine compare(time, mx, my, first_x, first_y, label)
      real(wp), intent(in) :: time
      integer, intent(in) :: mx, my, first_x, first_y
      character(len=*), intent(in) :: label
      type(traction_fields) :: expected

      call set_fields(time, mx, my, first_x, first_y, expected)
      call suite%close_to([state%now%pen], [expected%pen], close, label // ": approach")
      do iy = 1, my
         call suite%close_to(state%now%pn(:, iy), expected%pn(:, iy), close, label // ": pressures")
         call suite%close_to(state%now%px(:, iy), expected%px(:, iy), close, label // ": tractions in x")
         call suite%close_to(state%now%py(:, iy), expected%py(:, iy), close, label // ": tractions in y")
      end do
   end subroutine compare
end program test_extrapolation
