!> The rectangular window of elements in which contact may occur
module contact_grid_potential_contact
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: fit_field, is_same_side, potential_contact

   !> Element sides whose relative difference is smaller are equal, and shifts that differ less from an integer number of
   !> elements, in elements, are integer: less strict than the established program, see the user guide
   real(wp), parameter :: same_side = 1.0e-4_wp, same_place = 1.0e-3_wp

   !> A grid of mx by my rectangular elements; element (ix, iy) has index ix + mx (iy - 1)
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
      !> Do the elements coincide with those of another grid, where both overlap?
      procedure :: continues
   end type potential_contact

contains

   elemental real(wp) function centre_x(self, ix) result(x)
      class(potential_contact), intent(in) :: self
      !> Column, from 1 at the smallest x; extrapolated outside the grid
      integer, intent(in) :: ix
      x = self%xl + (real(ix, wp) - 0.5_wp)*self%dx
   end function centre_x

   elemental real(wp) function centre_y(self, iy) result(y)
      class(potential_contact), intent(in) :: self
      !> Row, from 1 at the smallest y; extrapolated outside the grid
      integer, intent(in) :: iy
      y = self%yl + (real(iy, wp) - 0.5_wp)*self%dy
   end function centre_y

   !> Are element sides equal, so that solutions can be transferred from one grid to the other?
   elemental logical function is_same_side(side, other)
      !> Element sides [mm]
      real(wp), intent(in) :: side, other

      is_same_side = abs(side - other) <= same_side*other
   end function is_same_side

   pure function offset(self, other)
      class(potential_contact), intent(in) :: self
      !> Grid from whose lower corner the distance is measured, in elements of `self`
      class(potential_contact), intent(in) :: other
      real(wp) :: offset(2)

      offset = [(self%xl - other%xl)/self%dx, (self%yl - other%yl)/self%dy]
   end function offset

   pure logical function continues(self, other)
      class(potential_contact), intent(in) :: self
      !> Grid whose elements may coincide
      class(potential_contact), intent(in) :: other

      continues = is_same_side(self%dx, other%dx) .and. is_same_side(self%dy, other%dy)
      if (continues) continues = all(abs(self%offset(other) - anint(self%offset(other))) <= same_place)
   end function continues

   !> Allocate one value per element; kept with its values if the shape is right
   pure subroutine fit_field(grid, field)
      !> Grid that gives the size
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
