!> How much the neighbours of an element, and of a row of elements, count in the scheme of second order
!>
!> An element enters or leaves the contact with a pressure of zero, a row with a load of zero. Forces would jump if its neighbours'
!> equations changed at once. So neighbours count by their pressures, or loads: not at all at zero, and in full when the next
!> element or row is about to enter. See doc/theory/second_order.md.
module contact_tangential_edge_neighbours
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: edge_slope, find_parts

   !> Edges in the outermost rows are steeper than the difference to their one neighbour by this factor: a root, sampled; measured
   real(wp), parameter :: outermost = 1.7_wp
   !> Load of a row, relative to that of its neighbour, from which on it counts in full: near the end of an ellipse loads grow
   !> evenly from row to row, so this is the load of the outermost row when another one appears
   real(wp), parameter :: whole_row = 0.5_wp
   !> Square of the distance below which edges of a row are equally near [elements]; chosen
   real(wp), parameter :: near_edge = 0.01_wp

contains

   !> Slope of the edge, elements along x per row: mean of the differences to the edges of both neighbouring rows
   !>
   !> A row counts by its load. With one neighbour that counts the difference is multiplied, as an edge that closes like a root is
   !> steeper than its chord. Of several edges in a row the nearest prevails.
   pure real(wp) function edge_slope(place, load, first, iy, here) result(slope)
      !> Positions of all edges [elements], and loads of the stretches behind them [N/mm2]
      real(wp), intent(in) :: place(:), load(:)
      !> Index of the first edge of each row, and of one more row, which has none
      integer, intent(in) :: first(:)
      !> Row and index of this edge
      integer, intent(in) :: iy, here
      real(wp) :: part(2), difference(2), near, sum_near, absent
      integer :: side, row, k

      part = 0.0_wp
      difference = 0.0_wp
      do side = 1, 2
         row = iy + 2*side - 3
         if (row < 1 .or. row > size(first) - 1) cycle
         sum_near = 0.0_wp
         absent = 1.0_wp
         do k = first(row), first(row + 1) - 1
            near = part_by(load(k), whole_row*load(here))
            absent = absent*(1.0_wp - near)
            near = near/(near_edge + (place(k) - place(here))**2)**2
            sum_near = sum_near + near
            difference(side) = difference(side) + near*(place(k) - place(here))*(2*side - 3)
         end do
         if (sum_near > 0.0_wp) difference(side) = difference(side)/sum_near
         part(side) = 1.0_wp - absent
      end do
      slope = dot_product(part, difference)/max(1.0_wp, sum(part))*(outermost - (outermost - 1.0_wp)*product(part))
   end function edge_slope

   !> Part by which a neighbour counts: none if it is about to enter or to leave the contact, all from a value on; no kinks
   elemental real(wp) function part_by(value, whole) result(part)
      !> Pressure or load, and the value from which on it counts in full
      real(wp), intent(in) :: value, whole
      real(wp) :: ratio

      part = 1.0_wp
      if (value >= whole) return
      ratio = max(value, 0.0_wp)/whole
      part = ratio**2*(3.0_wp - 2.0_wp*ratio)
   end function part_by

   !> Parts of the neighbours of each element of a stretch, and its load
   pure subroutine find_parts(pn, ix, length, direction, whole, part, load)
      !> Pressures of the row [N/mm2]
      real(wp), intent(in) :: pn(:)
      !> Leading element, number of elements, rolling direction
      integer, intent(in) :: ix, length, direction
      !> Ratio of the first to the second pressure of a stretch when another element is about to enter [-]
      real(wp), intent(in) :: whole
      !> Of the neighbours behind and ahead, and of the bend of the directions of slip, shape (3, mx); those of the stretch are set
      real(wp), intent(inout) :: part(:, :)
      !> Sum of the pressures [N/mm2]
      real(wp), intent(out) :: load
      integer :: k, i

      load = 0.0_wp
      do k = 1, length
         i = ix - direction*(k - 1)
         load = load + pn(i)
         part(:, i) = 0.0_wp
         if (k < length) part(1, i) = part_by(pn(i - direction), whole*pn(i))
         if (k > 1) part(2, i) = part_by(pn(i + direction), whole*pn(i))
         ! the bend counts from the fourth element on
         if (k > 3) part(3, i) = part(2, i)*part(2, i + direction)*part(2, i + 2*direction)
      end do
   end subroutine find_parts
end module contact_tangential_edge_neighbours
