!> Lines of profile files: comments, `key = value`, and rows of numbers
module contact_profile_line
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_text_bounds, only : bounds_of, bounds_table, describe_breach
   use contact_text_line_words, only : printable
   use contact_text_words, only : to_real, word_state
   implicit none (type, external)
   private

   public :: end_of_values, split_assignment, leading_numbers, read_row, file_place, max_columns, point_list

   !> Maximum number of values of a row that are evaluated
   integer, parameter :: max_columns = 12
   character(len=*), parameter :: blanks = " ,"

   !> Position of a row
   type :: file_place
      character(len=:), allocatable :: file
      integer :: line = 0
   end type file_place

   !> Points collected while reading
   type :: point_list
      integer :: n = 0
      real(wp), allocatable :: y(:), z(:)
      !> Line of each point in its file
      integer, allocatable :: line(:)
   contains
      procedure :: add => add_point
      procedure :: get => get_points
   end type point_list

contains

   !> The last column before the first comment character outside single quotes
   pure integer function end_of_values(line, marks) result(last)
      !> Line of a profile file
      character(len=*), intent(in) :: line
      !> Characters that start a comment
      character(len=*), intent(in) :: marks
      logical :: quoted
      integer :: i

      quoted = .false.
      do i = 1, len(line)
         if (line(i:i) == "'") quoted = .not. quoted
         if (.not. quoted .and. scan(line(i:i), marks) == 1) exit
      end do
      last = i - 1
   end function end_of_values

   !> Parts before and after the first equals sign, without surrounding blanks
   pure subroutine split_assignment(line, key, value, found)
      !> Line of a profile file, without comment
      character(len=*), intent(in) :: line
      !> Texts before and after the sign; unallocated without one
      character(len=:), allocatable, intent(out) :: key, value
      !> Is there an equals sign?
      logical, intent(out) :: found
      integer :: i

      i = index(line, "=")
      found = i > 0
      key = trim(adjustl(line(:max(0, i - 1))))
      value = trim(adjustl(line(i + 1:)))
   end subroutine split_assignment

   !> Count the numbers at the start of a line, and check for text after them
   pure subroutine leading_numbers(line, n, text_follows)
      !> Line of a profile file, without comment
      character(len=*), intent(in) :: line
      !> Number of leading numbers
      integer, intent(out) :: n
      !> Are they followed by a word that is not a number?
      logical, intent(out) :: text_follows
      real(wp) :: value
      integer :: first, last, state

      n = 0
      last = 0
      text_follows = .false.
      do
         call next_word(line, last + 1, first, last)
         if (first == 0) return
         call to_real(line(first:last), value, state)
         text_follows = state == word_state%malformed
         if (text_follows) return
         n = n + 1
      end do
   end subroutine leading_numbers

   !> Read all numbers of a line; any other word is an error
   subroutine read_row(line, place, expected, row, n, error, enough)
      !> Line of a profile file, without comment
      character(len=*), intent(in) :: line
      !> File and line, for messages
      type(file_place), intent(in) :: place
      !> Expected content, for messages
      character(len=*), intent(in) :: expected
      !> The first max_columns numbers
      real(wp), intent(out) :: row(max_columns)
      !> Number of values, including those not stored
      integer, intent(out) :: n
      !> Gives file, line, column, what was found and what was expected
      type(error_type), allocatable, intent(out) :: error
      !> Text after this many numbers is ignored; default: never
      integer, intent(in), optional :: enough
      character(len=:), allocatable :: breach
      real(wp) :: value
      integer :: first, last, state, bounds

      row = 0.0_wp
      n = 0
      last = 0
      do
         call next_word(line, last + 1, first, last)
         if (first == 0) exit
         call to_real(line(first:last), value, state)
         if (present(enough)) then
            if (n >= enough .and. state == word_state%malformed) exit
         end if
         if (state /= word_state%good) then
            call fatal_error(error, '"' // printable(line(first:last)) // '" ' // trim(complaint(state)) // "; expected " // &
               & expected // '; the line reads "' // printable(line) // '"', file=place%file, line=place%line, column=first)
            return
         end if
         if (n == 0) bounds = bounds_of("PROFILE")
         if (value < bounds_table(bounds)%lowest .or. value > bounds_table(bounds)%highest) then
            call describe_breach("PROFILE", line(first:last), value, breach, "a number of the profile")
            call fatal_error(error, breach, file=place%file, line=place%line, column=first)
            return
         end if
         n = n + 1
         if (n <= max_columns) row(n) = value
      end do
   end subroutine read_row

   pure function complaint(state) result(text)
      !> Member of word_state
      integer, intent(in) :: state
      character(len=25) :: text

      select case (state)
      case (word_state%too_large)
         text = "is too large for a number"
      case (word_state%not_finite)
         text = "is not a finite number"
      case default
         text = "is not a number"
      end select
   end function complaint

   !> The next word from a position on; first = 0 if there is none
   pure subroutine next_word(line, from, first, last)
      character(len=*), intent(in) :: line
      integer, intent(in) :: from
      integer, intent(out) :: first, last
      integer :: length

      first = 0
      last = len(line)
      if (from > len(line)) return
      first = verify(line(from:), blanks)
      if (first == 0) return
      first = first + from - 1
      length = scan(line(first:), blanks) - 1
      if (length >= 0) last = first + length - 1
   end subroutine next_word

   pure subroutine add_point(self, y, z, line)
      class(point_list), intent(inout) :: self
      !> Coordinates as in the file
      real(wp), intent(in) :: y, z
      !> Line number
      integer, intent(in) :: line

      if (.not. allocated(self%y)) allocate(self%y(256), self%z(256), self%line(256))
      if (self%n == size(self%y)) then
         self%y = [self%y, self%y]
         self%z = [self%z, self%z]
         self%line = [self%line, self%line]
      end if
      self%n = self%n + 1
      self%y(self%n) = y
      self%z(self%n) = z
      self%line(self%n) = line
   end subroutine add_point

   !> Get the collected points
   pure subroutine get_points(self, y, z, line)
      class(point_list), intent(in) :: self
      !> Coordinates as in the file, shape (number of points)
      real(wp), allocatable, intent(out) :: y(:), z(:)
      !> Line of each point, same shape
      integer, allocatable, intent(out) :: line(:)

      if (self%n == 0) then
         allocate(y(0), z(0), line(0))
         return
      end if
      y = self%y(:self%n)
      z = self%z(:self%n)
      line = self%line(:self%n)
   end subroutine get_points
end module contact_profile_line
