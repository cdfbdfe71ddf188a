!> Surface tractions as loads of both bodies
module contact_subsurface_load
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : bounding_box
   use contact_grid_potential_contact, only : potential_contact
   implicit none (type, external)
   private

   public :: surface_load, new_surface_load

   !> Tractions on a window of elements, restricted to the loaded part
   type :: surface_load
      type(potential_contact) :: grid
      !> Columns and rows of the smallest rectangle that contains all loaded elements
      type(bounding_box) :: box
      !> Tractions px, py, pn on body 1 [N/mm2], shape (ix0:ix1, iy0:iy1, 3) of the box
      real(wp), allocatable :: traction(:, :, :)
      !> Are px, py, pn non-zero anywhere?
      logical :: acts(3) = .false.
      !> Are tractions values at centres, with linear interpolation? Otherwise constant on each element
      logical :: bilinear = .false.
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-] of body 1 and 2
      real(wp) :: gg(2) = 1.0_wp, nu(2) = 0.0_wp
   end type surface_load

contains

   !> Collect the loads of a solved contact
   pure subroutine new_surface_load(load, grid, pn, px, py, gg, nu, bilinear)
      !> Receives copies of the loaded part: the bounding box of all tractions
      type(surface_load), intent(out) :: load
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Tractions on body 1 [N/mm2], shape (mx, my); pn positive for compression
      real(wp), contiguous, intent(in) :: pn(:, :), px(:, :), py(:, :)
      !> Modulus of rigidity [N/mm2] and Poisson's ratio [-] of body 1 and 2
      real(wp), intent(in) :: gg(2), nu(2)
      !> Do tractions vary linearly between the centres? Default: constant on each element
      logical, intent(in), optional :: bilinear
      integer :: ix, iy

      load%grid = grid
      load%gg = gg
      load%nu = nu
      if (present(bilinear)) load%bilinear = bilinear
      associate (box => load%box)
         box = bounding_box(size(pn, 1) + 1, 0, size(pn, 2) + 1, 0)
         do iy = 1, size(pn, 2)
            do ix = 1, size(pn, 1)
               if (pn(ix, iy) == 0.0_wp .and. px(ix, iy) == 0.0_wp .and. py(ix, iy) == 0.0_wp) cycle
               box%ix0 = min(box%ix0, ix)
               box%ix1 = max(box%ix1, ix)
               box%iy0 = min(box%iy0, iy)
               box%iy1 = max(box%iy1, iy)
            end do
         end do
         allocate(load%traction(box%ix0:box%ix1, box%iy0:box%iy1, 3))
         if (size(load%traction) == 0) return
         load%traction(:, :, 1) = px(box%ix0:box%ix1, box%iy0:box%iy1)
         load%traction(:, :, 2) = py(box%ix0:box%ix1, box%iy0:box%iy1)
         load%traction(:, :, 3) = pn(box%ix0:box%ix1, box%iy0:box%iy1)
      end associate
      do ix = 1, 3
         load%acts(ix) = any(load%traction(:, :, ix) /= 0.0_wp)
      end do
   end subroutine new_surface_load
end module contact_subsurface_load
