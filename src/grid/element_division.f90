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
      integer :: first, ix, iy, last, mx
      logical :: is_inside

      mx = size(division, 1)
      box = bounding_box(mx + 1, 0, size(division, 2) + 1, 0)
      do iy = 1, size(division, 2)
         ! elements outside the present box may extend it; one inside shows that the row belongs to it
         do first = 1, box%ix0 - 1
            if (division(first, iy) /= element%exterior) exit
         end do
         do last = mx, max(first, box%ix1 + 1), -1
            if (division(last, iy) /= element%exterior) exit
         end do
         is_inside = first < box%ix0 .or. last >= max(first, box%ix1 + 1)
         do ix = box%ix0, box%ix1
            if (is_inside) exit
            is_inside = division(ix, iy) /= element%exterior
         end do
         if (.not. is_inside) cycle
         box%ix0 = min(box%ix0, first)
         box%ix1 = max(box%ix1, last)
         box%iy0 = min(box%iy0, iy)
         box%iy1 = iy
      end do
   end function contact_box
end module contact_grid_element_division
