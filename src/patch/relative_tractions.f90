!> Tangential tractions relative to the pressures, as an estimate for other pressures
module contact_patch_relative_tractions
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: divide_by_pressures, multiply_by_pressures

contains

   !> Divide the tractions of each element by its pressure; 0 where there is no pressure
   pure subroutine divide_by_pressures(pn, px, py)
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :)
      !> Tractions [N/mm2] on entry, relative to the pressures [-] on exit, shape (mx, my)
      real(wp), contiguous, intent(inout) :: px(:, :), py(:, :)
      integer :: ix, iy

      do iy = 1, size(pn, 2)
         do ix = 1, size(pn, 1)
            if (pn(ix, iy) > 0.0_wp) then
               px(ix, iy) = px(ix, iy)/pn(ix, iy)
               py(ix, iy) = py(ix, iy)/pn(ix, iy)
            else
               px(ix, iy) = 0.0_wp
               py(ix, iy) = 0.0_wp
            end if
         end do
      end do
   end subroutine divide_by_pressures

   !> Multiply relative tractions by the pressures of the elements
   pure subroutine multiply_by_pressures(pn, px, py)
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: pn(:, :)
      !> Relative to the pressures [-] on entry, tractions [N/mm2] on exit, shape (mx, my)
      real(wp), contiguous, intent(inout) :: px(:, :), py(:, :)
      integer :: ix, iy

      do iy = 1, size(pn, 2)
         do ix = 1, size(pn, 1)
            px(ix, iy) = px(ix, iy)*pn(ix, iy)
            py(ix, iy) = py(ix, iy)*pn(ix, iy)
         end do
      end do
   end subroutine multiply_by_pressures
end module contact_patch_relative_tractions
