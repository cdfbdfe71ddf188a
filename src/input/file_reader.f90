!> Archive that reads the values of a case from an input file
module contact_input_file_reader
   use contact_base_error, only : add_context, error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : archive_item, case_archive, item_kind, shown_length
   use contact_input_problems, only : problem_list, severity
   use contact_text_bounds, only : bounds_of, bounds_table, is_within
   use contact_text_lexer, only : input_lexer, input_value
   implicit none (type, external)
   private

   public :: file_reader, new_file_reader

   !> Maximum number of groups of a case
   integer, parameter :: max_groups = 32

   !> Position of the first number of a group; line 0 before it is read
   type :: group_place
      character(len=16) :: name = ""
      integer :: line = 0, column = 0
   end type group_place

   !> Reads the lines of an input file and reports numbers out of bounds
   type, extends(case_archive) :: file_reader
      !> The file, and the problems found in the values of the case
      type(input_lexer), pointer :: lexer => null()
      type(problem_list), pointer :: problems => null()
      !> Reason why reading cannot continue; unallocated while it can
      type(error_type), allocatable :: error
      !> Words of the last line
      type(input_value), allocatable :: values(:)
      !> Positions of the groups read so far, and index of the current group, 0 outside of groups
      type(group_place) :: groups(max_groups)
      integer :: group_count = 0, group = 0
   contains
      procedure :: end_line => read_line
      procedure :: list => read_list
      procedure :: report => report_value
      procedure :: fail => stop_reading
      procedure :: check => check_value
      procedure :: shown => show_value
      procedure :: place => place_value
      procedure :: open_group => open_group_of_file
      procedure :: close_group => close_group_of_file
      procedure :: report_group => report_of_group
      procedure :: add_context => add_context_of_file
      procedure :: line_of
   end type file_reader

contains

   !> Create a reader that starts at the next line of a file
   function new_file_reader(lexer, problems) result(reader)
      !> Both must outlive the reader
      type(input_lexer), intent(in), target :: lexer
      type(problem_list), intent(in), target :: problems
      type(file_reader) :: reader

      reader%is_reading = .true.
      reader%lexer => lexer
      reader%problems => problems
      allocate(reader%values(size(reader%items)))
   end function new_file_reader

   !> Read the current items; values out of bounds are reported
   subroutine read_line(self)
      class(file_reader), intent(inout) :: self
      character(len=size(self%items)) :: types
      character(len=16*size(self%items)) :: names
      integer :: k, n, last

      n = self%count
      if (self%is_good .and. n > 0) then
         types = ""
         names = ""
         last = 0
         do k = 1, n
            types(k:k) = letter_of(self%items(k))
            names(last + 1:) = self%items(k)%name
            last = len_trim(names) + 1
         end do
         call self%lexer%read_group(types(:n), trim(names), self%values(:n), self%error)
         self%is_good = .not. allocated(self%error)
         if (self%is_good) then
            if (self%group > 0) call note_place(self%groups(self%group), self%values(1))
            call warn_of_commas(self)
            do k = 1, n
               call set_value(self, self%items(k), self%values(k))
            end do
         end if
      end if
      call self%finish_line()
   end subroutine read_line

   !> Warn if commas of the last line were probably meant as decimal separators
   subroutine warn_of_commas(self)
      class(file_reader), intent(inout) :: self

      if (self%lexer%has_decimal_commas) call self%problems%add(severity%warning, "commas separate numbers, so that the line has " &
         & // "more numbers than are read; the decimal separator is a point", self%lexer%line)
   end subroutine warn_of_commas

   !> Record the position of a group, which is that of its first number
   subroutine note_place(group, first)
      type(group_place), intent(inout) :: group
      type(input_value), intent(in) :: first

      if (group%line > 0) return
      group%line = first%line
      group%column = first%column
   end subroutine note_place

   !> Begin a group: the following numbers belong to it
   subroutine open_group_of_file(self, text)
      class(file_reader), intent(inout) :: self
      character(len=*), intent(in) :: text

      self%group_count = min(max_groups, self%group_count + 1)
      self%group = self%group_count
      self%groups(self%group) = group_place(name=text)
   end subroutine open_group_of_file

   !> End a group: the following numbers do not belong to it
   subroutine close_group_of_file(self)
      class(file_reader), intent(inout) :: self

      self%group = 0
   end subroutine close_group_of_file

   !> Line on which a group begins, 0: not read
   pure integer function line_of(self, name) result(line)
      class(file_reader), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k

      line = 0
      do k = 1, self%group_count
         if (self%groups(k)%name == name) line = self%groups(k)%line
      end do
   end function line_of

   !> Add a problem at the beginning of the current group; outside of groups at the last line
   subroutine report_of_group(self, is_error, text)
      class(file_reader), intent(inout) :: self
      logical, intent(in) :: is_error
      character(len=*), intent(in) :: text

      associate (kind => merge(severity%error, severity%warning, is_error))
         if (self%group > 0) then
            call self%problems%add(kind, text, self%groups(self%group)%line, self%groups(self%group)%column)
         else
            call self%problems%add(kind, text, self%lexer%line)
         end if
      end associate
   end subroutine report_of_group

   !> Add the position at which reading stopped, if it did
   subroutine add_context_of_file(self, text)
      class(file_reader), intent(inout) :: self
      character(len=*), intent(in) :: text

      call add_context(self%error, text)
   end subroutine add_context_of_file

   !> Letter of the type of an item, as required by read_group
   pure character function letter_of(item) result(letter)
      type(archive_item), intent(in) :: item

      select case (item%kind)
      case (item_kind%angle); letter = "a"
      case (item_kind%integer); letter = "i"
      case (item_kind%text); letter = "s"
      case default; letter = "r"
      end select
      if (item%is_optional) letter = achar(iachar(letter) - 32)
   end function letter_of

   !> Set the variable of an item
   subroutine set_value(self, item, value)
      class(file_reader), intent(inout) :: self
      type(archive_item), intent(inout) :: item
      type(input_value), intent(in) :: value

      item%given = value%given
      if (.not. value%given) then
         if (associated(item%r)) item%r = item%default
         if (associated(item%i)) item%i = nint(item%default)
         return
      end if
      if (item%kind == item_kind%text) then
         item%s%value = value%s
         return
      end if
      ! the name is looked up again only to describe the problem
      if (.not. (item%is_unchecked .or. is_within(item%row, value%r))) call self%problems%check_bounds(value)
      select case (item%kind)
      case (item_kind%integer); item%i = value%i
      ! only the sign is significant
      case (item_kind%branch); item%i = int(sign(min(1000.0_wp, anint(abs(value%r) + 0.49_wp)), value%r))
      case default; item%r = value%r
      end select
   end subroutine set_value

   !> Read exactly n numbers and report the first that is out of bounds
   subroutine read_list(self, name, values, n, units, bounds)
      class(file_reader), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      type(input_value) :: outside
      integer :: row
      logical :: has_angles

      if (.not. self%is_good) return
      has_angles = .false.
      if (present(units)) has_angles = any(units == "rad")
      row = bounds_of(name)
      if (present(bounds)) row = bounds_of(bounds)
      call self%lexer%read_array(n, name, values, self%error, has_angles, lowest=bounds_table(row)%lowest, &
         & highest=bounds_table(row)%highest, outside=outside)
      self%is_good = .not. allocated(self%error)
      if (self%is_good) call warn_of_commas(self)
      if (self%is_good .and. outside%given) call self%problems%check_bounds(outside, trim(bounds_table(row)%name))
   end subroutine read_list

   !> Report that a value cannot be used, is doubtful or was replaced: "name = word" and the reason, at its position
   subroutine report_value(self, is_error, name, text)
      class(file_reader), intent(inout) :: self
      logical, intent(in) :: is_error
      character(len=*), intent(in) :: name, text
      integer :: line, column

      if (.not. self%is_good) return
      line = self%lexer%line
      column = 0
      call self%place(name, line, column)
      call self%problems%add(merge(severity%error, severity%warning, is_error), trim(self%shown(name)) // text, line, column)
   end subroutine report_value

   !> Stop reading because of a value, or of data read before if there is no name
   subroutine stop_reading(self, name, text)
      class(file_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      integer :: line, column

      if (.not. self%is_good) return
      self%is_good = .false.
      line = self%lexer%line
      column = 0
      call self%place(name, line, column)
      call fatal_error(self%error, trim(self%shown(name)) // text, error_kind%input, self%lexer%file, line, column)
   end subroutine stop_reading

   !> Check the bounds of a value that was replaced, or that has one of two names
   subroutine check_value(self, name, bounds)
      class(file_reader), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in), optional :: bounds
      type(input_value) :: value
      integer :: k

      k = self%place_of(name)
      if (k == 0 .or. .not. self%is_good) return
      value = self%values(k)
      value%r = self%items(k)%r
      if (present(bounds)) value%name = bounds
      call self%problems%check_bounds(value)
   end subroutine check_value

   !> "name = word", padded with blanks
   pure function show_value(self, name) result(text)
      class(file_reader), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=shown_length) :: text
      integer :: k

      k = self%place_of(name)
      text = name
      if (k == 0) return
      if (.not. allocated(self%values(k)%word)) return
      if (len(self%values(k)%word) > 0) text = name // " = " // self%values(k)%word
   end function show_value

   !> Line and column of a value
   subroutine place_value(self, name, line, column)
      class(file_reader), intent(in) :: self
      character(len=*), intent(in) :: name
      integer, intent(inout) :: line, column
      integer :: k

      k = self%place_of(name)
      if (k == 0) return
      if (.not. self%values(k)%given) return
      line = self%values(k)%line
      column = self%values(k)%column
   end subroutine place_value
end module contact_input_file_reader
