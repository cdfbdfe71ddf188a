!> Change of the slip direction from element to element, which causes discretisation errors of the tangential forces
module contact_patch_turning
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: turned_round, turns

contains

   !> Sum of half the traction differences between slip elements whose directions differ by more than a right angle, and which are
   !> neighbours or separated by elements in adhesion only [N/mm2]
   pure real(wp) function turned_round(result, most_between) result(total_change)
      !> Solved
      type(patch_result), intent(in) :: result
      !> Maximum number of separating elements in adhesion
      integer, intent(in) :: most_between
      integer :: ix, iy, jx, jy, side, step(2), n

      total_change = 0.0_wp
      if (result%nslip < 2) return
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (result%division(ix, iy) /= element%slip) cycle
            do side = 1, 2
               step = merge([1, 0], [0, 1], side == 1)
               do n = 1, most_between + 1
                  jx = min(result%grid%mx, ix + n*step(1))
                  jy = min(result%grid%my, iy + n*step(2))
                  if (result%division(jx, jy) /= element%adhesion) exit
               end do
               if (result%division(jx, jy) /= element%slip) cycle
               if (result%px(ix, iy)*result%px(jx, jy) + result%py(ix, iy)*result%py(jx, jy) >= 0.0_wp) cycle
               total_change = total_change + 0.5_wp*hypot(result%px(ix, iy) - result%px(jx, jy), &
                  & result%py(ix, iy) - result%py(jx, jy))
            end do
         end do
      end do
   end function turned_round

   !> Sum over neighbouring slip elements of the squared angle between their tractions times the traction [N/mm2]
   pure real(wp) function turns(result)
      !> Solved
      type(patch_result), intent(in) :: result
      real(wp) :: p(2), next(2), square
      integer :: ix, iy, jx, jy, side

      turns = 0.0_wp
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (result%division(ix, iy) /= element%slip) cycle
            p = [result%px(ix, iy), result%py(ix, iy)]
            do side = 1, 2
               jx = min(result%grid%mx, ix + 2 - side)
               jy = min(result%grid%my, iy + side - 1)
               if (result%division(jx, jy) /= element%slip) cycle
               next = [result%px(jx, jy), result%py(jx, jy)]
               square = norm2(p)*norm2(next)
               if (square > 0.0_wp) turns = turns + 2.0_wp*(square - dot_product(p, next))/sqrt(square)
            end do
         end do
      end do
   end function turns
end module contact_patch_turning
