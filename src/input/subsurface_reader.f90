!> Subsurface points: output digits and blocks (S = 2, 3)
module contact_input_subsurface_reader
   use contact_base_error, only : add_context, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_input_problems, only : problem_list, severity
   use contact_subsurface_points, only : point_block, point_selection
   use contact_input_values, only : read_list, read_values
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_subsurface

   !> Most coordinates of a block in one direction
   integer, parameter :: longest_list = 9999
   !> Largest number of a column or row
   integer, parameter :: largest_index = 999999

contains

   !> Output digits (S = 2, 3) and blocks (S = 3), which replace all that were stored
   subroutine read_subsurface(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(point_block), allocatable :: blocks(:), longer(:)
      type(input_value) :: v(2)
      integer :: n

      if (spec%digits%s < 2) return
      call read_values(lexer, "ii", "MATFIL_S OUTPUT_S", v, problems, error)
      if (allocated(error)) return
      spec%subsurface%matfil = v(1)%i
      spec%subsurface%output = v(2)%i
      if (spec%digits%s /= 3) return

      n = 0
      allocate(blocks(4))
      do
         call lexer%read_group("i", "ISUBS", v, error)
         if (allocated(error)) exit
         if (v(1)%i <= 0) exit
         if (n == size(blocks)) then
            allocate(longer(2*n))
            longer(:n) = blocks
            call move_alloc(longer, blocks)
         end if
         n = n + 1
         call read_block(lexer, v(1), blocks(n), problems, error)
         if (allocated(error)) exit
      end do
      call add_context(error, "subsurface block " // integer_text(max(1, n)))
      if (allocated(error)) return
      if (allocated(spec%subsurface%blocks)) deallocate(spec%subsurface%blocks)
      spec%subsurface%blocks = blocks(:n)
   end subroutine read_subsurface

   !> One block: columns and rows, then depths, or coordinates in all directions
   subroutine read_block(lexer, option, block, problems, error)
      type(input_lexer), intent(inout) :: lexer
      !> ISUBS
      type(input_value), intent(in) :: option
      type(point_block), intent(out) :: block
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: v(3)
      integer :: k

      select case (option%i)
      case (1, 5)
         block%selection = point_selection%all_elements
      case (2, 6)
         block%selection = point_selection%ranges
         call read_range("IXL IXINC IXH", block%ixl, block%ixinc, block%ixh)
         if (allocated(error)) return
         call read_range("IYL IYINC IYH", block%iyl, block%iyinc, block%iyh)
         if (allocated(error)) return
      case (3, 7)
         block%selection = point_selection%lists
         call lexer%read_group("ii", "NX NY", v, error)
         if (allocated(error)) return
         call require_length(v(1), error)
         if (allocated(error)) return
         call require_length(v(2), error)
         if (allocated(error)) return
         call read_indices(lexer, v(1)%i, "IX", block%ix, problems, error)
         if (allocated(error)) return
         call read_indices(lexer, v(2)%i, "IY", block%iy, problems, error)
         if (allocated(error)) return
      case (9)
         block%selection = point_selection%free
         call lexer%read_group("iii", "NX NY NZ", v, error)
         if (allocated(error)) return
         do k = 1, 3
            call require_length(v(k), error)
            if (allocated(error)) return
         end do
         call read_sorted(lexer, v(1)%i, "X", block%x, problems, error)
         if (allocated(error)) return
         call read_sorted(lexer, v(2)%i, "Y", block%y, problems, error)
         if (allocated(error)) return
         call read_sorted(lexer, v(3)%i, "Z", block%z, problems, error)
         return
      case default
         call fatal_error(error, "ISUBS = " // option%word // &
            & " is not a known option; allowed are 1, 2, 3, 5, 6, 7 and 9, and 0 to end the blocks", &
            & file=lexer%file, line=option%line, column=option%column)
         return
      end select

      if (option%i <= 3) then
         call read_values(lexer, "irr", "NZ ZL DZ", v, problems, error)
         if (allocated(error)) return
         call require_length(v(1), error)
         if (allocated(error)) return
         block%z = [(v(2)%r + (k - 1)*v(3)%r, k = 1, v(1)%i)]
      else
         call lexer%read_group("i", "NZ", v, error)
         if (allocated(error)) return
         call require_length(v(1), error)
         if (allocated(error)) return
         call read_sorted(lexer, v(1)%i, "Z", block%z, problems, error)
      end if

   contains

      !> First, step and last column or row
      subroutine read_range(names, low, step, high)
         character(len=*), intent(in) :: names
         integer, intent(out) :: low, step, high

         low = 1
         step = 1
         high = 0
         call read_values(lexer, "iii", names, v, problems, error)
         if (allocated(error)) return
         if (v(3)%i >= 1 .and. v(3)%i <= largest_index) call problems%check_integer(v(3), &
            & max(1, min(v(1)%i, largest_index)), largest_index)
         low = v(1)%i
         step = max(1, v(2)%i)
         high = v(3)%i
      end subroutine read_range

      !> Without a proper length the list cannot be read
      subroutine require_length(value, trouble)
         type(input_value), intent(in) :: value
         type(error_type), allocatable, intent(inout) :: trouble

         if (value%i >= 1 .and. value%i <= longest_list) return
         call fatal_error(trouble, value%name // " = " // value%word // " is outside its range 1 to " // &
            & integer_text(longest_list), file=lexer%file, line=value%line, column=value%column)
      end subroutine require_length
   end subroutine read_block

   !> A list of columns or rows: rounded, ascending, each once
   subroutine read_indices(lexer, n, name, list, problems, error)
      type(input_lexer), intent(inout) :: lexer
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      integer, allocatable, intent(out) :: list(:)
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: values(:)
      integer :: k, line, kept

      call read_list(lexer, n, name, values, problems, error, line=line)
      if (allocated(error)) return
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
      if (kept < n) call problems%add(severity%warning, integer_text(n - kept) // " of the " // integer_text(n) // &
         & " numbers of " // name // " are dropped: they are not positive, or given twice", line)
   end subroutine read_indices

   !> A list of coordinates, ascending
   subroutine read_sorted(lexer, n, name, list, problems, error)
      type(input_lexer), intent(inout) :: lexer
      integer, intent(in) :: n
      character(len=*), intent(in) :: name
      !> Coordinates [mm]
      real(wp), allocatable, intent(out) :: list(:)
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error

      call read_list(lexer, n, name, list, problems, error)
      if (.not. allocated(error)) call sort(list)
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
