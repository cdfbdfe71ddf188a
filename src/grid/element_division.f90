!> Element division: states of the elements
module contact_grid_element_division
   implicit none (type, external)
   private

   public :: element, bounding_box, contact_box, copy_states, list_elements, set_states, widest_strip

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
      integer, contiguous, intent(in) :: division(:, :)
      type(bounding_box) :: box
      !> Number of columns that are examined together
      integer, parameter :: together = 64
      integer :: columns(together), ix, iy, first, n, row

      box = bounding_box(size(division, 1) + 1, 0, size(division, 2) + 1, 0)
      do first = 1, size(division, 1), together
         n = min(together, size(division, 1) - first + 1)
         ! exterior elements have no bits
         columns = element%exterior
         do iy = 1, size(division, 2)
            row = element%exterior
            do ix = 1, n
               columns(ix) = ior(columns(ix), division(first + ix - 1, iy))
               row = ior(row, division(first + ix - 1, iy))
            end do
            if (row == element%exterior) cycle
            box%iy0 = min(box%iy0, iy)
            box%iy1 = max(box%iy1, iy)
         end do
         do ix = 1, n
            if (columns(ix) == element%exterior) cycle
            box%ix0 = min(box%ix0, first + ix - 1)
            box%ix1 = first + ix - 1
         end do
      end do
   end function contact_box

   !> Largest number of adjacent rows with elements in contact: the width of the widest strip, where rows without contact separate
   !> strips along x
   pure integer function widest_strip(division) result(widest)
      !> Element states, shape (mx, my)
      integer, contiguous, intent(in) :: division(:, :)
      integer :: iy, rows

      widest = 0
      rows = 0
      do iy = 1, size(division, 2)
         rows = merge(rows + 1, 0, any(division(:, iy) > element%exterior))
         widest = max(widest, rows)
      end do
   end function widest_strip

   !> Elements for tables, in increasing index
   subroutine list_elements(division, all_elements, at)
      !> Element states, shape (mx, my)
      integer, intent(in) :: division(:, :)
      !> Include those without contact?
      logical, intent(in) :: all_elements
      !> Column and row of each, shape (2, elements)
      integer, allocatable, intent(out) :: at(:, :)
      integer :: ix, iy, n

      n = size(division)
      if (.not. all_elements) n = count(division /= element%exterior)
      allocate(at(2, n))
      n = 0
      do iy = 1, size(division, 2)
         do ix = 1, size(division, 1)
            if (division(ix, iy) == element%exterior .and. .not. all_elements) cycle
            n = n + 1
            at(:, n) = [ix, iy]
         end do
      end do
   end subroutine list_elements

   !> Set contiguous element states to one value; see `copy_states`
   pure subroutine set_states(n, state, to)
      !> Number of elements
      integer, intent(in) :: n
      !> Member of element
      integer, intent(in) :: state
      !> States
      integer, intent(inout) :: to(n)

      to = state
   end subroutine set_states

   !> Copy contiguous element states: fields of two dimensions at once instead of column by column
   pure subroutine copy_states(n, from, to)
      !> Number of elements
      integer, intent(in) :: n
      !> Original
      integer, intent(in) :: from(n)
      !> Copy
      integer, intent(inout) :: to(n)

      to = from
   end subroutine copy_states
end module contact_grid_element_division
