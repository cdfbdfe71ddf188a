!> The rectangular window of elements in which contact may occur
module contact_grid_potential_contact
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: fit_field, is_same_side, potential_contact

   !> Sides of elements that differ by less, relative, are equal, and shifts that differ by less from a whole number of elements,
   !> in elements, are whole ones: looser than the established program, as the user guide says
   real(wp), parameter :: same_side = 1.0e-4_wp, same_place = 1.0e-3_wp

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
      !> Distance of the lower corner from that of another grid, in elements [-]
      procedure :: offset
      !> Are there the same elements as in another grid, as far as both reach?
      procedure :: continues
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

   !> Are the sides of elements equal, so that solutions go over from one to the other?
   elemental logical function is_same_side(side, other)
      !> [mm]
      real(wp), intent(in) :: side, other

      is_same_side = abs(side - other) <= same_side*other
   end function is_same_side

   pure function offset(self, other)
      class(potential_contact), intent(in) :: self
      !> Grid whose first corner the distance is counted from, in elements of `self`
      class(potential_contact), intent(in) :: other
      real(wp) :: offset(2)

      offset = [(self%xl - other%xl)/self%dx, (self%yl - other%yl)/self%dy]
   end function offset

   pure logical function continues(self, other)
      class(potential_contact), intent(in) :: self
      !> Grid with elements that may be the same ones
      class(potential_contact), intent(in) :: other

      continues = is_same_side(self%dx, other%dx) .and. is_same_side(self%dy, other%dy)
      if (continues) continues = all(abs(self%offset(other) - anint(self%offset(other))) <= same_place)
   end function continues

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
