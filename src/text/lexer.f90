!> Lexer of input files: lines into words, words into groups of values
!>
!> The file is read into memory once, see contact_text_file_text; contact_text_line_words divides its lines into words. A group
!> starts on a new line and extends over as many lines as its mandatory values need. Optional values follow on the line of the last
!> mandatory one; the first word that cannot be read as the next optional value ends the group without an error.
module contact_text_lexer
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_text_file_text, only : add_to_hash, empty_hash, read_text
   use contact_text_line_words, only : find_word, printable, quote, single_quotes, word_place
   use contact_text_words, only : columns_of, integer_text, to_angle, to_integer, to_real, word_state
   implicit none (type, external)
   private

   public :: input_lexer, input_value

   !> One value of a group
   type :: input_value
      !> Name in messages
      character(len=:), allocatable :: name
      !> The word as in the file; unallocated if it was not given
      character(len=:), allocatable :: word
      !> Was the value given? Always true for mandatory values of a group that was read
      logical :: given = .false.
      !> The value according to its type, integers also as a real number; angles in rad
      integer :: i = 0
      real(wp) :: r = 0.0_wp
      character(len=:), allocatable :: s
      !> Position in the file
      integer :: line = 0, column = 0
   end type input_value

   !> A text with a reading position
   type :: input_lexer
      !> Name of the file in messages
      character(len=:), allocatable :: file
      !> Number of the last line read, 0 before the first
      integer :: line = 0
      !> Are there more numbers on the last line than were read, without decimal points but with commas between figures?
      logical :: has_decimal_commas = .false.
      character(len=:), allocatable, private :: text
      !> First and last character of each line in the text
      integer, allocatable, private :: first(:), last(:)
   contains
      procedure :: open_file
      procedure :: open_text
      procedure :: read_group
      procedure :: read_array
      procedure :: at_end
      procedure :: count_lines
      procedure :: line_text
      procedure :: get_text
      procedure :: fingerprint
      procedure :: hash_lines
      procedure, private :: next_line
      procedure, private :: note_decimal_commas
      procedure, private :: parse
      procedure, private :: refuse_word
      procedure, private :: refuse_end
   end type input_lexer

   character(len=*), parameter :: line_feed = achar(10), carriage_return = achar(13), figures = "0123456789"

contains

   !> Read a file into memory
   subroutine open_file(self, file, error, below)
      class(input_lexer), intent(out) :: self
      !> Path
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(out) :: error
      !> Folder below which the file must be; absent: anywhere
      character(len=*), intent(in), optional :: below
      character(len=:), allocatable :: text

      call read_text(file, text, error, below)
      if (allocated(error)) return
      if (is_utf16(text)) then
         call fatal_error(error, "the file is text in UTF-16; expected is UTF-8 or ASCII, one byte per letter", &
            & error_kind%input, file)
         return
      end if
      call self%open_text(text, file)
   end subroutine open_file

   !> Does a text begin like one of two bytes per letter: with its byte order mark, or with a letter and a zero byte?
   pure logical function is_utf16(text)
      character(len=*), intent(in) :: text
      character(len=*), parameter :: marks = char(255) // char(254) // char(255)

      is_utf16 = .false.
      if (len(text) < 4) return
      is_utf16 = index(marks, text(1:2)) > 0 .or. all([text(1:1) /= char(0), text(2:2) == char(0), text(3:3) /= char(0), &
         & text(4:4) == char(0)]) .or. all([text(1:1) == char(0), text(2:2) /= char(0), text(3:3) == char(0), text(4:4) /= char(0)])
   end function is_utf16

   !> Open a text that is already in memory
   subroutine open_text(self, text, name)
      class(input_lexer), intent(out) :: self
      !> Text with lines that end with LF or CR-LF; without any LF, with CR
      character(len=*), intent(in) :: text
      !> Name of the file in messages
      character(len=*), intent(in) :: name
      character(len=*), parameter :: byte_order_mark = char(239) // char(187) // char(191)
      character :: end_of_line
      integer :: k, n

      self%file = name
      self%text = text
      end_of_line = line_feed
      if (index(text, line_feed) == 0) end_of_line = carriage_return
      n = 1
      do k = 1, len(text)
         if (text(k:k) /= end_of_line) cycle
         n = n + 1
         self%text(k:k) = line_feed
      end do
      allocate(self%first(n), self%last(n))
      self%first(1) = 1
      if (len(text) >= 3) then
         if (text(1:3) == byte_order_mark) self%first(1) = 4
      end if
      n = 1
      do k = 1, len(text)
         if (self%text(k:k) /= line_feed) cycle
         self%last(n) = k - 1
         n = n + 1
         self%first(n) = k + 1
      end do
      self%last(n) = len(text)
   end subroutine open_text

   !> Number of lines, for files whose grammar is not groups of values
   pure integer function count_lines(self) result(n)
      class(input_lexer), intent(in) :: self

      n = size(self%first)
   end function count_lines

   !> A line without line end; control characters, including tabs, become blanks
   pure function line_text(self, k) result(text)
      class(input_lexer), intent(in) :: self
      !> 1...count_lines()
      integer, intent(in) :: k
      character(len=self%last(k) - self%first(k) + 1) :: text
      integer :: i

      text = self%text(self%first(k):self%last(k))
      do i = 1, len(text)
         if (iachar(text(i:i)) < 32) text(i:i) = " "
      end do
   end function line_text

   !> The complete text, for formats with their own grammar
   subroutine get_text(self, text)
      class(input_lexer), intent(in) :: self
      !> Text with line ends
      character(len=:), allocatable, intent(out) :: text

      text = self%text
   end subroutine get_text

   !> Fingerprint of the text (FNV-1a with 32 bits, combined with the length); almost certainly differs for different texts
   pure integer(long) function fingerprint(self) result(hash)
      class(input_lexer), intent(in) :: self

      hash = empty_hash
      call add_to_hash(self%text, hash)
      hash = ieor(hash, int(len(self%text), long))
   end function fingerprint

   !> Update a hash with some lines of the text, without line ends
   pure subroutine hash_lines(self, first, last, hash)
      class(input_lexer), intent(in) :: self
      !> First and last line number, inclusive
      integer, intent(in) :: first, last
      !> As for add_to_hash
      integer(long), intent(inout) :: hash
      integer :: k

      do k = first, min(last, size(self%first))
         call add_to_hash(self%text(self%first(k):self%last(k)), hash)
      end do
   end subroutine hash_lines

   !> Are there no more words?
   logical function at_end(self)
      class(input_lexer), intent(in) :: self
      type(word_place) :: place
      integer :: k

      at_end = .false.
      do k = self%line + 1, size(self%first)
         place = find_word(self%text(:self%last(k)), self%first(k))
         if (place%first > 0) return
      end do
      at_end = .true.
   end function at_end

   !> Read a group of values of given types
   !>
   !> After an error the values are undefined and reading cannot continue.
   subroutine read_group(self, types, names, values, error)
      class(input_lexer), intent(inout) :: self
      !> One letter per value: i integer, r real, a angle, s string; capital letters for optional values
      character(len=*), intent(in) :: types
      !> Names of the values, separated by single blanks; together they form the name of the group
      character(len=*), intent(in) :: names
      !> Values, at least as many as types
      type(input_value), intent(inout) :: values(:)
      type(error_type), allocatable, intent(out) :: error
      type(word_place) :: place
      integer :: k, mandatory, position, state

      call name_values(names, values(:len(types)))
      self%has_decimal_commas = .false.
      mandatory = verify(types, "iras") - 1
      if (mandatory < 0) mandatory = len(types)
      k = 0
      do while (k < mandatory)
         if (.not. self%next_line()) then
            call self%refuse_end(types(k + 1:k + 1), values(k + 1)%name, names, error)
            return
         end if
         position = self%first(self%line)
         do while (k < len(types))
            place = find_word(self%text(:self%last(self%line)), position)
            position = place%next
            if (place%first == 0) exit
            call self%parse(place, lower(types(k + 1:k + 1)), values(k + 1), state)
            if (state /= word_state%good) then
               if (k >= mandatory) return
               call self%refuse_word(place, types(k + 1:k + 1), values(k + 1)%name, k + 1, names, state, error)
               return
            end if
            k = k + 1
         end do
      end do
      if (mandatory > 0) call self%note_decimal_commas(position)
   end subroutine read_group

   !> Read exactly n numbers, from as many lines as needed
   subroutine read_array(self, n, name, values, error, angles, line, lowest, highest, outside)
      class(input_lexer), intent(inout) :: self
      !> Number of values; nothing is read if it is not positive
      integer, intent(in) :: n
      !> Name of the array
      character(len=*), intent(in) :: name
      !> The values, [rad] for angles
      real(wp), allocatable, intent(out) :: values(:)
      type(error_type), allocatable, intent(out) :: error
      !> Are the values angles? Default no
      logical, intent(in), optional :: angles
      !> Line of the first value
      integer, intent(out), optional :: line
      !> Bounds of the values
      real(wp), intent(in), optional :: lowest, highest
      !> First value out of bounds, with its position; not given if there is none
      type(input_value), intent(out), optional :: outside
      type(input_value) :: value
      type(word_place) :: place
      character :: letter
      integer :: k, position, state

      letter = "r"
      if (present(angles)) letter = merge("a", "r", angles)
      if (present(line)) line = self%line + 1
      allocate(values(max(0, min(n, 1000))))
      self%has_decimal_commas = .false.
      k = 0
      do while (k < n)
         if (.not. self%next_line()) then
            call self%refuse_end(letter, element_name(name, k + 1), array_name(name, n), error)
            return
         end if
         if (k == 0 .and. present(line)) line = self%line
         position = self%first(self%line)
         do while (k < n)
            place = find_word(self%text(:self%last(self%line)), position)
            position = place%next
            if (place%first == 0) exit
            call self%parse(place, letter, value, state)
            if (state /= word_state%good) then
               call self%refuse_word(place, letter, element_name(name, k + 1), k + 1, array_name(name, n), state, error)
               return
            end if
            if (k == size(values)) call lengthen(values, min(n, 2*k))
            k = k + 1
            values(k) = value%r
            if (.not. present(outside)) cycle
            if (outside%given .or. (value%r >= lowest .and. value%r <= highest)) cycle
            outside = value
            outside%name = element_name(name, k)
         end do
      end do
      if (n > 0) call self%note_decimal_commas(position)
   end subroutine read_array

   !> Note a line whose commas were probably meant as decimal separators
   subroutine note_decimal_commas(self, position)
      class(input_lexer), intent(inout) :: self
      !> Position behind the last word that was read from the current line; 0: the line has no more words
      integer, intent(in) :: position
      type(input_value) :: value
      type(word_place) :: place
      integer :: first, k, state
      logical :: is_between

      if (position == 0) return
      first = self%first(self%line)
      is_between = .false.
      do k = first + 1, position
         if (self%text(k - 1:k - 1) == ".") return
         if (k >= self%last(self%line) .or. self%text(k:k) /= ",") cycle
         if (scan(self%text(k - 1:k - 1), figures)*scan(self%text(k + 1:k + 1), figures) > 0) is_between = .true.
      end do
      if (.not. is_between) return
      place = find_word(self%text(:self%last(self%line)), position)
      if (place%first == 0) return
      call self%parse(place, "a", value, state)
      self%has_decimal_commas = state == word_state%good .and. index(self%text(place%first:place%last), ".") == 0
   end subroutine note_decimal_commas

   !> Move to the next line with words; false at the end of the text
   logical function next_line(self) result(found)
      class(input_lexer), intent(inout) :: self
      type(word_place) :: place

      found = .false.
      do while (self%line < size(self%first))
         self%line = self%line + 1
         place = find_word(self%text(:self%last(self%line)), self%first(self%line))
         found = place%first > 0
         if (found) return
      end do
   end function next_line

   !> Parse a word as a value of the given type
   subroutine parse(self, place, letter, value, state)
      class(input_lexer), intent(in) :: self
      type(word_place), intent(in) :: place
      !> i, r, a or s
      character, intent(in) :: letter
      !> Result; only its name is kept
      type(input_value), intent(inout) :: value
      !> Member of word_state
      integer, intent(out) :: state

      associate (word => self%text(place%first:place%last))
         state = word_state%malformed
         if (letter == "s") then
            if (place%quoted .and. place%closed) state = word_state%good
            if (state == word_state%good) value%s = single_quotes(word)
         else if (.not. place%quoted) then
            select case (letter)
            case ("i")
               call to_integer(word, value%i, state)
               value%r = real(value%i, wp)
            case ("r"); call to_real(word, value%r, state)
            case ("a"); call to_angle(word, value%r, state)
            end select
         end if
         if (state /= word_state%good) return
         value%given = .true.
         value%word = word
         value%line = self%line
         value%column = place%first - self%first(self%line) + 1
      end associate
   end subroutine parse

   !> Error for a word that does not match the expected value
   subroutine refuse_word(self, place, letter, name, position, group, state, error)
      class(input_lexer), intent(in) :: self
      type(word_place), intent(in) :: place
      character, intent(in) :: letter
      !> Name, position and group of the expected value
      character(len=*), intent(in) :: name, group
      integer, intent(in) :: position
      !> Member of word_state
      integer, intent(in) :: state
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: complaint, word
      integer :: first, last

      first = self%first(self%line)
      last = self%last(self%line)
      word = self%text(place%first:place%last)
      if (place%quoted) word = quote // word // merge(quote, " ", place%closed)
      select case (state)
      case (word_state%too_large)
         complaint = "is too large for a number"
      case (word_state%not_finite)
         complaint = "is not a finite number"
      case default
         complaint = "is not " // trim(type_text(letter))
         if (letter == "s") complaint = complaint // ", or its second quote is missing"
      end select
      call fatal_error(error, '"' // printable(word) // '" ' // complaint // "; expected " // name // ", " // &
         & trim(type_text(letter)) // ", value " // integer_text(position) // " of the group " // group // &
         & '; the line reads "' // printable(self%text(first:last)) // '"', error_kind%input, self%file, self%line, &
         & merge(place%first - 1, place%first, place%quoted) - first + 1)
   end subroutine refuse_word

   !> Error for the end of the text within a group
   subroutine refuse_end(self, letter, name, group, error)
      class(input_lexer), intent(in) :: self
      character, intent(in) :: letter
      character(len=*), intent(in) :: name, group
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, "the end of the file is reached; expected " // name // ", " // trim(type_text(letter)) // &
         & ", in the group " // group, error_kind%input, self%file, self%line)
   end subroutine refuse_end

   !> Description of a type
   pure function type_text(letter) result(text)
      character, intent(in) :: letter
      character(len=23) :: text

      select case (lower(letter))
      case ("i"); text = "an integer"
      case ("r"); text = "a number"
      case ("a"); text = "an angle"
      case default; text = "a text in single quotes"
      end select
   end function type_text

   !> Lower-case letter of a type
   pure character function lower(letter)
      character, intent(in) :: letter

      lower = letter
      if (letter >= "A" .and. letter <= "Z") lower = achar(iachar(letter) + 32)
   end function lower

   !> Assign the names of a group to its values, and reset the values
   pure subroutine name_values(names, values)
      character(len=*), intent(in) :: names
      type(input_value), intent(inout) :: values(:)
      type(input_value) :: empty
      integer :: k, first, length

      first = 1
      do k = 1, size(values)
         values(k) = empty
         length = index(names(min(first, len(names) + 1):) // " ", " ") - 1
         values(k)%name = names(first:first + length - 1)
         first = min(first + length + 1, len(names) + 1)
      end do
   end subroutine name_values

   !> "H(37)"
   pure function element_name(name, k) result(text)
      character(len=*), intent(in) :: name
      integer, intent(in) :: k
      character(len=len(name) + columns_of(k) + 2) :: text

      text = name // "(" // integer_text(k) // ")"
   end function element_name

   !> "H(1..400)"
   pure function array_name(name, n) result(text)
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      character(len=len(name) + columns_of(n) + 5) :: text

      text = name // "(1.." // integer_text(n) // ")"
   end function array_name

   !> Extend an array
   pure subroutine lengthen(values, n)
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      real(wp), allocatable :: longer(:)

      allocate(longer(n))
      longer(:size(values)) = values
      call move_alloc(longer, values)
   end subroutine lengthen
end module contact_text_lexer
