!> Element division: states of the elements
module contact_grid_element_division
   implicit none (type, external)
   private

   public :: element, bounding_box, contact_box

   type :: element_list
      integer :: exterior = 0, adhesion = 1, slip = 2, plastic = 3
   end type element_list
   !> Element states; all states above exterior are in contact
   type(element_list), parameter :: element = element_list()

   !> Index ranges of the smallest rectangle that contains the contact area; empty if ix0 > ix1
   type :: bounding_box
      integer :: ix0 = 1, ix1 = 0, iy0 = 1, iy1 = 0
   end type bounding_box

contains

   !> Smallest rectangle that contains all elements in contact
   pure function contact_box(division) result(box)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      type(bounding_box) :: box
      integer :: ix, iy, first

      box = bounding_box(size(division, 1) + 1, 0, size(division, 2) + 1, 0)
      do iy = 1, size(division, 2)
         do first = 1, size(division, 1)
            if (division(first, iy) /= element%exterior) exit
         end do
         if (first > size(division, 1)) cycle
         box%ix0 = min(box%ix0, first)
         box%iy0 = min(box%iy0, iy)
         box%iy1 = iy
         ! only elements beyond the present end can extend the box
         do ix = size(division, 1), max(first, box%ix1 + 1), -1
            if (division(ix, iy) == element%exterior) cycle
            box%ix1 = ix
            exit
         end do
      end do
   end function contact_box
end module contact_grid_element_division
