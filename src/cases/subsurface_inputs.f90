!> Input values of points below the surface, once for all formats
!>
!> As in contact_cases_inputs.
module contact_cases_subsurface_inputs
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : case_archive
   use contact_cases_spec, only : subsurface_spec
   use contact_subsurface_points, only : point_block, point_selection
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: visit_block, visit_blocks, visit_option, visit_stress_output

   !> Maximum number of coordinates of a block in one direction
   integer, parameter, public :: longest_list = 9999
   !> Maximum number of a column or row
   integer, parameter :: largest_index = 999999

   type :: block_option_list
      !> Depths by first depth and step, with points at the centres of all elements, of ranges, of lists
      integer :: all_by_step = 1, ranges_by_step = 2, lists_by_step = 3
      !> The same with a list of depths; and points independent of the grid
      integer :: all = 5, ranges = 6, lists = 7, free = 9
   end type block_option_list
   !> Option of a block (ISUBS); 0 ends the list of blocks
   type(block_option_list), parameter, public :: block_option = block_option_list()

contains

   !> Output of stresses below the surface
   subroutine visit_stress_output(a, subsurface)
      class(case_archive), intent(inout) :: a
      type(subsurface_spec), intent(inout), target :: subsurface

      call a%integer("MATFIL_S", subsurface%matfil)
      call a%integer("OUTPUT_S", subsurface%output)
      call a%end_line()
   end subroutine visit_stress_output

   !> Blocks of points, which replace all previous ones
   subroutine visit_blocks(a, subsurface)
      class(case_archive), intent(inout) :: a
      type(subsurface_spec), intent(inout) :: subsurface
      type(point_block), allocatable :: blocks(:), longer(:)
      integer, target :: kind_of_block
      integer :: k, n

      if (.not. a%is_reading) then
         do k = 1, size(subsurface%blocks)
            kind_of_block = option_of(subsurface%blocks(k)%selection)
            call visit_option(a, kind_of_block)
            call visit_block(a, kind_of_block, subsurface%blocks(k))
         end do
         kind_of_block = 0
         call visit_option(a, kind_of_block)
         return
      end if

      if (.not. a%is_good) return
      n = 0
      allocate(blocks(4))
      do
         call visit_option(a, kind_of_block)
         if (.not. a%is_good .or. kind_of_block <= 0) exit
         if (n == size(blocks)) then
            allocate(longer(2*n))
            longer(:n) = blocks
            call move_alloc(longer, blocks)
         end if
         n = n + 1
         call visit_block(a, kind_of_block, blocks(n))
         if (.not. a%is_good) exit
      end do
      call a%add_context("subsurface block " // integer_text(max(1, n)))
      if (.not. a%is_good) return
      if (allocated(subsurface%blocks)) deallocate(subsurface%blocks)
      subsurface%blocks = blocks(:n)
   end subroutine visit_blocks

   !> Option of the next block
   subroutine visit_option(a, value)
      class(case_archive), intent(inout) :: a
      !> Member of block_option; 0 ends the list of blocks
      integer, intent(inout), target :: value

      call a%integer("ISUBS", value, unchecked=.true.)
      call a%end_line()
   end subroutine visit_option

   !> The option with a list of depths
   pure integer function option_of(selection)
      !> Member of point_selection
      integer, intent(in) :: selection

      select case (selection)
      case (point_selection%ranges); option_of = block_option%ranges
      case (point_selection%lists); option_of = block_option%lists
      case (point_selection%free); option_of = block_option%free
      case default; option_of = block_option%all
      end select
   end function option_of

   !> One block: columns and rows, then depths; or coordinates in all directions
   subroutine visit_block(a, kind_of_block, block)
      class(case_archive), intent(inout) :: a
      !> Member of block_option
      integer, intent(in) :: kind_of_block
      !> Points, from which the numbers are taken or in which they are stored
      type(point_block), intent(inout), target :: block
      real(wp), target :: first_depth, step
      integer, target :: nx, ny, nz
      integer :: k

      nz = 0
      if (allocated(block%z)) nz = size(block%z)
      select case (kind_of_block)
      case (block_option%all_by_step, block_option%all)
         block%selection = point_selection%all_elements
      case (block_option%ranges_by_step, block_option%ranges)
         block%selection = point_selection%ranges
         call visit_range(a, "IX", block%ixl, block%ixinc, block%ixh)
         call visit_range(a, "IY", block%iyl, block%iyinc, block%iyh)
      case (block_option%lists_by_step, block_option%lists)
         block%selection = point_selection%lists
         nx = 0
         ny = 0
         if (allocated(block%ix)) nx = size(block%ix)
         if (allocated(block%iy)) ny = size(block%iy)
         call a%integer("NX", nx, unchecked=.true.)
         call a%integer("NY", ny, unchecked=.true.)
         call a%end_line()
         call require_length(a, "NX", nx)
         call require_length(a, "NY", ny)
         call visit_indices(a, nx, "IX", block%ix)
         call visit_indices(a, ny, "IY", block%iy)
      case (block_option%free)
         block%selection = point_selection%free
         nx = 0
         ny = 0
         if (allocated(block%x)) nx = size(block%x)
         if (allocated(block%y)) ny = size(block%y)
         call a%integer("NX", nx, unchecked=.true.)
         call a%integer("NY", ny, unchecked=.true.)
         call a%integer("NZ", nz, unchecked=.true.)
         call a%end_line()
         call require_length(a, "NX", nx)
         call require_length(a, "NY", ny)
         call require_length(a, "NZ", nz)
         call visit_sorted(a, nx, "X", block%x)
         call visit_sorted(a, ny, "Y", block%y)
         call visit_sorted(a, nz, "Z", block%z)
         return
      case default
         call a%fail("ISUBS", " is not a known option; allowed are 1, 2, 3, 5, 6, 7 and 9, and in files 0 to end the blocks")
         return
      end select

      call a%integer("NZ", nz, unchecked=.true.)
      if (kind_of_block <= block_option%lists_by_step) then
         call a%real("ZL", first_depth)
         call a%real("DZ", step)
      end if
      call a%end_line()
      call require_length(a, "NZ", nz)
      if (.not. a%is_good) return
      if (kind_of_block <= block_option%lists_by_step) then
         block%z = [(first_depth + (k - 1)*step, k = 1, nz)]
      else
         call visit_sorted(a, nz, "Z", block%z)
      end if
   end subroutine visit_block

   !> First, step and last column or row
   subroutine visit_range(a, name, low, step, high)
      class(case_archive), intent(inout) :: a
      !> IX or IY
      character(len=2), intent(in) :: name
      integer, intent(inout), target :: low, step, high
      integer :: first

      if (a%is_reading) then
         low = 1
         step = 1
         high = 0
      end if
      call a%integer(name // "L", low)
      call a%integer(name // "INC", step)
      call a%integer(name // "H", high)
      call a%end_line()
      if (.not. a%is_reading) return
      first = max(1, min(low, largest_index))
      if (high >= 1 .and. high < first) call a%refuse(name // "H", " is outside its range " // integer_text(first) // &
         & " to " // integer_text(largest_index))
      step = max(1, step)
   end subroutine visit_range

   !> Without a valid length the list cannot be read
   subroutine require_length(a, name, length)
      class(case_archive), intent(inout) :: a
      character(len=*), intent(in) :: name
      integer, intent(in) :: length

      if (.not. a%is_good) return
      if (length < 1 .or. length > longest_list) call a%fail(name, " is outside its range 1 to " // integer_text(longest_list))
   end subroutine require_length

   !> A list of columns or rows; on reading, values are rounded and sorted, and repeated values are removed
   subroutine visit_indices(a, n, name, list)
      class(case_archive), intent(inout) :: a
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      integer, allocatable, intent(inout) :: list(:)
      real(wp), allocatable :: values(:)
      integer :: k, kept

      if (allocated(list)) values = real(list, wp)
      call a%list(name, values, n, units=["-"])
      if (.not. (a%is_reading .and. a%is_good)) return
      values = min(values, real(largest_index, wp))
      call sort(values)
      if (allocated(list)) deallocate(list)
      allocate(list(n))
      kept = 0
      do k = 1, n
         if (values(k) < 0.5_wp) cycle
         if (kept > 0) then
            if (list(kept) == nint(values(k))) cycle
         end if
         kept = kept + 1
         list(kept) = nint(values(k))
      end do
      list = list(:kept)
      if (kept < n) call a%warn("", integer_text(n - kept) // " of the " // integer_text(n) // " numbers of " // name // &
         & " are dropped: they are not positive, or given twice")
   end subroutine visit_indices

   !> A list of coordinates; on reading, values are sorted
   subroutine visit_sorted(a, n, name, list)
      class(case_archive), intent(inout) :: a
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      !> Coordinates [mm]
      real(wp), allocatable, intent(inout) :: list(:)

      call a%list(name, list, n)
      if (a%is_reading .and. a%is_good) call sort(list)
   end subroutine visit_sorted

   !> Sort in ascending order by insertion: the lists are short and mostly sorted
   pure subroutine sort(list)
      real(wp), intent(inout) :: list(:)
      real(wp) :: value
      integer :: k, place

      do k = 2, size(list)
         value = list(k)
         place = k
         do while (place > 1)
            if (list(place - 1) <= value) exit
            list(place) = list(place - 1)
            place = place - 1
         end do
         list(place) = value
      end do
   end subroutine sort
end module contact_cases_subsurface_inputs
