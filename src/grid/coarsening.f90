!> Grids with half as many elements, for nested iteration
module contact_grid_coarsening
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: coarsening_factor, coarse_size, coarse_neighbours, shortest_side

   !> Directions with fewer elements are not coarsened
   integer, parameter :: shortest_side = 24

contains

   !> Number of fine elements per coarse element in a direction of n elements: 2 or 1
   pure integer function coarsening_factor(n)
      !> Number of fine elements in this direction
      integer, intent(in) :: n
      coarsening_factor = merge(2, 1, n >= shortest_side)
   end function coarsening_factor

   !> Number of coarse elements in a direction of n fine elements
   pure integer function coarse_size(n)
      !> Number of fine elements in this direction
      integer, intent(in) :: n
      coarse_size = (n + coarsening_factor(n) - 1)/coarsening_factor(n)
   end function coarse_size

   !> The two coarse elements whose centres enclose that of fine element i, and the weight of the second
   pure subroutine coarse_neighbours(i, n, first, second, weight)
      !> Index of the fine element, and number of fine elements in this direction
      integer, intent(in) :: i, n
      !> Coarse elements; equal at the ends
      integer, intent(out) :: first, second
      !> Weight of the second, 0...1
      real(wp), intent(out) :: weight
      real(wp) :: position

      position = (i - 0.5_wp)/coarsening_factor(n) + 0.5_wp
      first = floor(position)
      weight = position - first
      second = min(max(first + 1, 1), coarse_size(n))
      first = min(max(first, 1), coarse_size(n))
   end subroutine coarse_neighbours
end module contact_grid_coarsening
