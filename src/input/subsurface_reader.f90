!> Subsurface points: output digits and blocks (S = 2, 3)
module contact_input_subsurface_reader
   use contact_base_error, only : add_context
   use contact_base_kinds, only : wp
   use contact_cases_inputs, only : visit_stress_output
   use contact_cases_spec, only : subsurface_spec
   use contact_input_file_reader, only : file_reader
   use contact_subsurface_points, only : point_block, point_selection
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_subsurface

   !> Most coordinates of a block in one direction
   integer, parameter :: longest_list = 9999
   !> Largest number of a column or row
   integer, parameter :: largest_index = 999999

contains

   !> Output digits, and blocks, which replace all that were stored
   subroutine read_subsurface(a, with_blocks, subsurface)
      type(file_reader), intent(inout) :: a
      !> S = 3?
      logical, intent(in) :: with_blocks
      type(subsurface_spec), intent(inout) :: subsurface
      type(point_block), allocatable :: blocks(:), longer(:)
      integer, target :: option
      integer :: n

      call visit_stress_output(a, subsurface)
      if (.not. with_blocks .or. .not. a%is_good) return
      n = 0
      allocate(blocks(4))
      do
         call a%integer("ISUBS", option, unchecked=.true.)
         call a%end_line()
         if (.not. a%is_good .or. option <= 0) exit
         if (n == size(blocks)) then
            allocate(longer(2*n))
            longer(:n) = blocks
            call move_alloc(longer, blocks)
         end if
         n = n + 1
         call read_block(a, option, blocks(n))
         if (.not. a%is_good) exit
      end do
      call add_context(a%error, "subsurface block " // integer_text(max(1, n)))
      if (.not. a%is_good) return
      if (allocated(subsurface%blocks)) deallocate(subsurface%blocks)
      subsurface%blocks = blocks(:n)
   end subroutine read_subsurface

   !> One block: columns and rows, then depths, or coordinates in all directions
   subroutine read_block(a, option, block)
      type(file_reader), intent(inout) :: a
      !> ISUBS
      integer, intent(in) :: option
      type(point_block), intent(out), target :: block
      real(wp), target :: first_depth, step
      integer, target :: nx, ny, nz
      integer :: k

      select case (option)
      case (1, 5)
         block%selection = point_selection%all_elements
      case (2, 6)
         block%selection = point_selection%ranges
         call read_range("IX", block%ixl, block%ixinc, block%ixh)
         call read_range("IY", block%iyl, block%iyinc, block%iyh)
      case (3, 7)
         block%selection = point_selection%lists
         call a%integer("NX", nx, unchecked=.true.)
         call a%integer("NY", ny, unchecked=.true.)
         call a%end_line()
         call require_length("NX", nx)
         call require_length("NY", ny)
         call read_indices(a, nx, "IX", block%ix)
         call read_indices(a, ny, "IY", block%iy)
      case (9)
         block%selection = point_selection%free
         call a%integer("NX", nx, unchecked=.true.)
         call a%integer("NY", ny, unchecked=.true.)
         call a%integer("NZ", nz, unchecked=.true.)
         call a%end_line()
         call require_length("NX", nx)
         call require_length("NY", ny)
         call require_length("NZ", nz)
         call read_sorted(a, nx, "X", block%x)
         call read_sorted(a, ny, "Y", block%y)
         call read_sorted(a, nz, "Z", block%z)
         return
      case default
         call a%fail("ISUBS", " is not a known option; allowed are 1, 2, 3, 5, 6, 7 and 9, and 0 to end the blocks")
         return
      end select

      call a%integer("NZ", nz, unchecked=.true.)
      if (option <= 3) then
         call a%real("ZL", first_depth)
         call a%real("DZ", step)
      end if
      call a%end_line()
      call require_length("NZ", nz)
      if (.not. a%is_good) return
      if (option <= 3) then
         block%z = [(first_depth + (k - 1)*step, k = 1, nz)]
      else
         call read_sorted(a, nz, "Z", block%z)
      end if

   contains

      !> First, step and last column or row
      subroutine read_range(name, low, step, high)
         !> IX or IY
         character(len=2), intent(in) :: name
         integer, intent(out), target :: low, step, high
         integer :: first

         low = 1
         step = 1
         high = 0
         call a%integer(name // "L", low)
         call a%integer(name // "INC", step)
         call a%integer(name // "H", high)
         call a%end_line()
         first = max(1, min(low, largest_index))
         if (high >= 1 .and. high < first) call a%refuse(name // "H", " is outside its range " // integer_text(first) // &
            & " to " // integer_text(largest_index))
         step = max(1, step)
      end subroutine read_range

      !> Without a proper length the list cannot be read
      subroutine require_length(name, length)
         character(len=*), intent(in) :: name
         integer, intent(in) :: length

         if (.not. a%is_good) return
         if (length < 1 .or. length > longest_list) call a%fail(name, " is outside its range 1 to " // integer_text(longest_list))
      end subroutine require_length
   end subroutine read_block

   !> A list of columns or rows: rounded, ascending, each once
   subroutine read_indices(a, n, name, list)
      type(file_reader), intent(inout) :: a
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      integer, allocatable, intent(out) :: list(:)
      real(wp), allocatable :: values(:)
      integer :: k, kept

      call a%list(name, values, n)
      if (.not. a%is_good) return
      values = min(values, real(largest_index, wp))
      call sort(values)
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
   end subroutine read_indices

   !> A list of coordinates, ascending
   subroutine read_sorted(a, n, name, list)
      type(file_reader), intent(inout) :: a
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      !> Coordinates [mm]
      real(wp), allocatable, intent(inout) :: list(:)

      call a%list(name, list, n)
      if (a%is_good) call sort(list)
   end subroutine read_sorted

   !> Sort ascending, by insertion: the lists are short and mostly in order
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
end module contact_input_subsurface_reader
