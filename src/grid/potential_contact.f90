!> The rectangular window of elements in which contact may occur
module contact_grid_potential_contact
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: fit_field, potential_contact

   !> A grid of mx by my rectangular elements; element (ix, iy) has number ix + mx (iy - 1)
   type :: potential_contact
      !> Number of elements along and across the rolling direction
      integer :: mx = 0, my = 0
      !> Lower corner of the window [mm]
      real(wp) :: xl = 0.0_wp, yl = 0.0_wp
      !> Sides of one element [mm]
      real(wp) :: dx = 1.0_wp, dy = 1.0_wp
   contains
      !> x of the centre of column ix [mm]
      procedure :: x => centre_x
      !> y of the centre of row iy [mm]
      procedure :: y => centre_y
      !> Number of elements
      procedure :: npot => number_of_elements
   end type potential_contact

contains

   elemental real(wp) function centre_x(self, ix) result(x)
      class(potential_contact), intent(in) :: self
      !> Column, from 1 at the smallest x; columns outside the grid are continued
      integer, intent(in) :: ix
      x = self%xl + (real(ix, wp) - 0.5_wp)*self%dx
   end function centre_x

   elemental real(wp) function centre_y(self, iy) result(y)
      class(potential_contact), intent(in) :: self
      !> Row, from 1 at the smallest y; rows outside the grid are continued
      integer, intent(in) :: iy
      y = self%yl + (real(iy, wp) - 0.5_wp)*self%dy
   end function centre_y

   !> Room for one value per element; kept with its values when the shape is right
   pure subroutine fit_field(grid, field)
      !> Grid whose size the field gets
      type(potential_contact), intent(in) :: grid
      !> Shape (mx, my)
      real(wp), allocatable, intent(inout) :: field(:, :)

      if (allocated(field)) then
         if (all(shape(field) == [grid%mx, grid%my])) return
         deallocate(field)
      end if
      allocate(field(grid%mx, grid%my))
   end subroutine fit_field

   elemental integer function number_of_elements(self) result(n)
      class(potential_contact), intent(in) :: self
      n = self%mx*self%my
   end function number_of_elements
end module contact_grid_potential_contact
