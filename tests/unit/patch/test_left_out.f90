!> Elements in contact that are outside of another window, counted one by one
program test_left_out
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_time_steps, only : elements_left_out
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: mx = 7, my = 5
   type(test_suite) :: suite
   type(potential_contact) :: old, new
   integer :: division(mx, my), trial, kx, ky, ix, iy, n, expected
   real(wp) :: box(4), limits(4), state(mx, my), where_to(4)

   call suite%start("left_out")
   old = potential_contact(mx=mx, my=my, xl=-1.2_wp, yl=0.7_wp, dx=0.3_wp, dy=0.5_wp)
   do trial = 1, 300
      call random_number(state)
      call random_number(where_to)
      division = element%exterior
      ! full, sparse and empty divisions; single elements in the corners, too
      where (state < 0.3_wp*mod(trial, 4)) division = merge(element%slip, element%adhesion, state < 0.15_wp)
      if (mod(trial, 7) == 0) then
         division = element%exterior
         division(merge(1, mx, where_to(1) < 0.5_wp), merge(1, my, where_to(2) < 0.5_wp)) = element%adhesion
      end if
      kx = int(9.0_wp*where_to(1)) - 4
      ky = int(9.0_wp*where_to(2)) - 4
      new = potential_contact(mx=mx + int(5.0_wp*where_to(3)) - 2, my=my + int(5.0_wp*where_to(4)) - 2, &
         & xl=old%xl + kx*old%dx, yl=old%yl + ky*old%dy, dx=old%dx, dy=old%dy)
      call elements_left_out(division, old, new, n, box)
      expected = 0
      limits = [huge(1.0_wp), -huge(1.0_wp), huge(1.0_wp), -huge(1.0_wp)]
      do iy = my, 1, -1
         do ix = mx, 1, -1
            if (division(ix, iy) == element%exterior) cycle
            associate (x => old%xl + (ix - 0.5_wp)*old%dx, y => old%yl + (iy - 0.5_wp)*old%dy)
               if (x < new%xl .or. x > new%xl + new%mx*new%dx .or. y < new%yl .or. y > new%yl + new%my*new%dy) &
                  & expected = expected + 1
               limits = [min(limits(1), x - 0.15_wp), max(limits(2), x + 0.15_wp), min(limits(3), y - 0.25_wp), &
                  & max(limits(4), y + 0.25_wp)]
            end associate
         end do
      end do
      call suite%equal(n, expected, "number of elements")
      if (any(division > element%exterior)) call suite%close_to(box, limits, 1.0e-12_wp, "position of the contact")
   end do
   call suite%finish()
end program test_left_out
