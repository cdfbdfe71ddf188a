!> The archive that writes a case in the readable format
!>
!> Numbers equal to those of the last case with this group are left out, and so are unchanged preset numbers: the reader restores
!> them by the same rules. Real numbers are written with as many figures as distinguish them from all others.
module contact_output_toml_writer
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : archive_item, case_archive, is_pair, item_kind, lengths, own_word
   use contact_control_digits, only : case_digits, digit_text, digit_value
   use contact_control_words, only : form_key, form_table, form_title, form_word, key_length, key_of_item, key_table, &
      & translate_to_words, word_of_digit
   use contact_text_bounds, only : bounds_table, unit_length, unit_of
   use contact_text_words, only : exact_text, integer_text, small
   use contact_toml_quantities, only : read_quantity
   implicit none (type, external)
   private

   public :: quoted, remembered_texts, toml_writer

   integer, parameter :: max_keys = 400
   !> Column of remarks, and width of lines of long lists [characters]
   integer, parameter :: remark_column = 34, line_width = 100
   character(len=*), parameter :: line_feed = achar(10)
   !> Groups whose tables are left out if they have no keys: without them a case keeps the same values. Empty tables of other groups
   !> have a meaning, such as a new grid, or the rail and wheelset in the .out file
   character(len=10), parameter :: left_out_if_empty(*) = [character(len=10) :: "iteration", "kinematics", "velocity"]

   !> Texts of values, by "group.key"
   type :: remembered_texts
      integer :: count = 0
      character(len=2*key_length) :: names(max_keys) = ""
      type(text_of_value), allocatable :: texts(:)
   contains
      procedure :: is_same
      procedure :: keep
   end type remembered_texts

   type :: text_of_value
      character(len=:), allocatable :: text
   end type text_of_value

   !> Writes the tables of a case
   type, extends(case_archive) :: toml_writer
      !> Text written so far of the case, of the current group, and of its sets or blocks
      character(len=:), allocatable :: case_text, body, parts
      character(len=key_length) :: group = ""
      !> Values given by previous cases, and preset values of numbers
      type(remembered_texts), pointer :: memory => null(), presets => null()
      !> Data of the case: module 1 or 3, digits
      integer :: module_number = 3
      type(case_digits) :: digits
      !> Motion of the case, on which units depend; member of motion
      integer :: moves = 0
      !> Are preset numbers being recorded? Then nothing is written
      logical :: is_recording = .false.
      !> Does each row of the grid have its own friction law?
      logical :: has_rows = .false.
      !> Is the current table a set or block?
      logical :: in_part = .false.
   contains
      procedure :: end_line => write_line
      procedure :: list => write_list
      procedure :: own_choice => write_choice
      procedure :: own_number => write_own_number
      procedure :: open_group => open_table
      procedure :: close_group => close_table
      !> Add a key with a value to the current group, unless the value is unchanged
      procedure :: put
      !> Add a key to the case itself
      procedure :: put_choice
   end type toml_writer

contains

   !> Is this the text stored for a name?
   pure logical function is_same(self, name, text)
      class(remembered_texts), intent(in) :: self
      !> Name of a value, and its text
      character(len=*), intent(in) :: name, text
      integer :: k

      is_same = .false.
      do k = 1, self%count
         if (self%names(k) == name) is_same = self%texts(k)%text == text
      end do
   end function is_same

   !> Store the text for a name
   pure subroutine keep(self, name, text)
      class(remembered_texts), intent(inout) :: self
      !> Name of a value, and its text
      character(len=*), intent(in) :: name, text
      integer :: k

      if (.not. allocated(self%texts)) allocate(self%texts(max_keys))
      do k = 1, self%count
         if (self%names(k) == name) exit
      end do
      if (k > max_keys) return
      self%count = max(self%count, k)
      self%names(k) = name
      self%texts(k)%text = text
   end subroutine keep

   !> Begin a group
   subroutine open_table(self, text)
      class(toml_writer), intent(inout) :: self
      character(len=*), intent(in) :: text

      self%group = text
      self%body = ""
      self%parts = ""
      self%in_part = .false.
      if (self%is_recording) return
      call put_group_choices(self)
   end subroutine open_table

   !> Write a choice
   subroutine write_choice(self, name, title, words, chosen, usual, none)
      class(toml_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, title, words(:)
      integer, intent(inout) :: chosen
      integer, intent(in) :: usual
      integer, intent(in), optional :: none

      associate (unused => present(none))
      end associate
      call put_own(self, name, trim(own_word(words(chosen))), title, chosen == usual)
   end subroutine write_choice

   !> Write a number that is 0 if none is requested
   subroutine write_own_number(self, name, title, value, lowest, highest)
      class(toml_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, title
      real(wp), intent(inout) :: value
      real(wp), intent(in) :: lowest, highest

      associate (unused => [lowest, highest])
      end associate
      call put_own(self, name, trim(exact_text(value)), title, .not. value > 0.0_wp)
   end subroutine write_own_number

   !> Write such a key, unless it has its default value and no previous case has given it
   subroutine put_own(self, name, text, title, is_usual)
      class(toml_writer), intent(inout) :: self
      !> Key, right-hand side, and meaning
      character(len=*), intent(in) :: name, text, title
      !> Is it the value that readers use without the key?
      logical, intent(in) :: is_usual

      if (self%is_recording .or. (is_usual .and. all(self%memory%names /= trim(self%group) // "." // name))) return
      if (self%group == "") then
         call self%put_choice(name, text, "")
      else
         call self%put(name, text, remark=title)
      end if
   end subroutine put_own

   !> Write the choices of the current group
   subroutine put_group_choices(self)
      class(toml_writer), intent(inout) :: self
      character(len=:), allocatable :: text
      integer :: k

      do k = 1, size(key_table)
         associate (row => key_table(k))
            if (row%group /= self%group .or. all(row%module_number /= [0, self%module_number])) cycle
            text = trim(word_of_digit(trim(row%name), digit_value(self%digits, trim(row%name)), self%module_number))
            if (len(text) > 0) call self%put(trim(row%key), '"' // text // '"', remark=trim(digit_text(trim(row%name), &
               & digit_value(self%digits, trim(row%name)), self%module_number)))
         end associate
      end do
   end subroutine put_group_choices

   !> End a group: its header, its keys, its sets; kinematics have no header if nothing has changed
   subroutine close_table(self)
      class(toml_writer), intent(inout) :: self

      if (.not. self%is_recording) then
         if (self%group /= "stress_points" .and. (len(self%body) > 0 .or. all(left_out_if_empty /= self%group))) &
            & self%case_text = self%case_text // line_feed // "[case." // trim(self%group) // "]" // line_feed // &
            & self%body
         self%case_text = self%case_text // self%parts
      end if
      self%group = ""
   end subroutine close_table

   !> Write the current items
   subroutine write_line(self)
      class(toml_writer), intent(inout) :: self
      character(len=:), allocatable :: text
      integer :: k

      call begin_part(self)
      k = 0
      do while (k < self%count)
         k = k + 1
         if (any(lengths == self%items(k)%name) .or. self%items(k)%name == "ISUBS") cycle
         call text_of_item(self%items(k), self%moves, text)
         if (is_pair(self%items(:self%count), k)) then
            call put_pair(self, k, text)
            k = k + 1
         else
            call self%put(trim(key_of_item(self%items, k)), text, self%items(k))
         end if
      end do
      call self%finish_line()
   end subroutine write_line

   !> A set of friction or a block of points is written as a table of its own
   subroutine begin_part(self)
      class(toml_writer), intent(inout) :: self

      if (self%is_recording) return
      if (self%group == "friction") then
         self%in_part = self%items(1)%name == "ALPHA" .or. self%items(1)%name == "SVF" .or. (self%has_rows .and. &
            & self%items(1)%name /= "MEMDST")
         if (self%in_part) self%parts = self%parts // line_feed // "[[case.friction.set]]" // line_feed
      else if (self%items(1)%name == "ISUBS") then
         self%in_part = self%items(1)%i /= 0
         if (self%in_part) self%parts = self%parts // line_feed // "[[case.stress_points]]" // line_feed // 'points = "' // &
            & trim(form_word("ISUBS", self%items(1)%i)) // '"' // line_feed
      end if
   end subroutine begin_part

   !> key = [first, second]
   subroutine put_pair(self, k, first)
      class(toml_writer), intent(inout) :: self
      integer, intent(in) :: k
      !> Text of the first value
      character(len=*), intent(in) :: first
      character(len=:), allocatable :: second
      character(len=key_length) :: key

      key = key_of_item(self%items, k)
      call text_of_item(self%items(k + 1), self%moves, second)
      call self%put(key(:len_trim(key) - 1), "[" // first // ", " // second // "]", self%items(k))
   end subroutine put_pair

   !> Value of an item as TOML
   subroutine text_of_item(item, moves, text)
      type(archive_item), intent(in) :: item
      !> Motion of the case, member of motion
      integer, intent(in) :: moves
      character(len=:), allocatable, intent(out) :: text

      select case (item%kind)
      case (item_kind%integer, item_kind%branch)
         text = integer_text(item%i)
         if (any(form_table%name == item%name)) text = '"' // trim(form_word(item%name, item%i)) // '"'
      case (item_kind%text)
         call quoted(item%s%value, text)
      case (item_kind%angle)
         call text_of_angle(item%r, trim(unit_of(item%row, moves)), text)
      case default
         text = trim(exact_text(item%r))
      end select
   end subroutine text_of_item

   !> An angle or a rate, in degrees if that is shorter and exactly the same
   subroutine text_of_angle(value, unit, text)
      real(wp), intent(in) :: value
      !> Value [rad] or [rad/s]
      character(len=*), intent(in) :: unit
      character(len=:), allocatable, intent(out) :: text
      integer, parameter :: short = 10
      character(len=:), allocatable :: degrees, complaint
      character(len=24) :: word
      real(wp) :: back
      integer :: status

      text = trim(exact_text(value))
      if (len(text) <= short) return
      write(word, "(ES14.7)", iostat=status) value*(180.0_wp/pi)
      read(word, *, iostat=status) back
      degrees = trim(exact_text(back)) // " deg" // unit(4:)
      call read_quantity(degrees, unit, back, complaint)
      if (allocated(complaint) .or. abs(back - value) > 0.0_wp) return
      text = '"' // degrees // '"'
   end subroutine text_of_angle

   !> A text in double quotes
   pure subroutine quoted(value, text)
      !> Text as in the program
      character(len=*), intent(in) :: value
      !> Text with escapes
      character(len=:), allocatable, intent(out) :: text
      character(len=6) :: escape
      integer :: k

      text = '"'
      do k = 1, len(value)
         if (value(k:k) == '"' .or. value(k:k) == "\") then
            text = text // "\" // value(k:k)
         else if (iachar(value(k:k)) < 32 .or. iachar(value(k:k)) == 127) then
            write(escape, "(A, Z4.4)") "\u", iachar(value(k:k))
            text = text // escape
         else
            text = text // value(k:k)
         end if
      end do
      text = text // '"'
   end subroutine quoted

   !> Add a key with a value to the current group, unless the reader obtains the same value without it
   subroutine put(self, key, text, item, remark)
      class(toml_writer), intent(inout) :: self
      !> Key as in the file, and its right-hand side
      character(len=*), intent(in) :: key, text
      !> Item, with its meaning
      type(archive_item), intent(in), optional :: item
      !> Remark, if there is no item
      character(len=*), intent(in), optional :: remark
      character(len=:), allocatable :: line, name
      character(len=unit_length) :: unit
      logical :: can_miss

      name = trim(self%group) // "." // key
      if (self%is_recording) then
         call self%presets%keep(name, text)
         return
      end if
      can_miss = .false.
      if (present(item)) can_miss = (item%is_optional .or. item%is_preset) .and. item%name /= "D_TURN"
      if (.not. self%in_part) then
         if (self%memory%is_same(name, text)) return
         if (can_miss .and. .not. any(self%memory%names == name) .and. self%presets%is_same(name, text)) return
         call self%memory%keep(name, text)
      end if
      line = key // " = " // text
      if (present(remark)) call add_remark(self, line, remark)
      if (present(item)) then
         if (item%row > 0) then
            name = trim(bounds_table(item%row)%title)
            unit = unit_of(item%row, self%moves)
            if (unit /= "-" .and. unit /= "integer") name = name // " [" // trim(unit) // "]"
            call add_remark(self, line, name)
         else if (any(form_table%name == item%name)) then
            call add_remark(self, line, trim(form_title(item%name, item%i)))
         end if
      end if
      if (self%in_part) then
         self%parts = self%parts // line // line_feed
      else
         self%body = self%body // line // line_feed
      end if
   end subroutine put

   !> Meaning of a line, as a comment in the words of the format
   subroutine add_remark(self, line, remark)
      class(toml_writer), intent(in) :: self
      character(len=:), allocatable, intent(inout) :: line
      character(len=*), intent(in) :: remark
      character(len=:), allocatable :: text

      if (remark == "") return
      call translate_to_words(remark, self%module_number, text)
      if (len(line) < remark_column) line = line // repeat(" ", remark_column - len(line))
      line = line // "  # " // text
   end subroutine add_remark

   !> Add a key to the case itself, unless its value is unchanged
   subroutine put_choice(self, key, text, remark)
      class(toml_writer), intent(inout) :: self
      !> Key, and its right-hand side
      character(len=*), intent(in) :: key, text
      !> Remark; "" for none
      character(len=*), intent(in) :: remark
      character(len=:), allocatable :: line

      if (self%memory%is_same("." // key, text)) return
      call self%memory%keep("." // key, text)
      line = key // " = " // text
      call add_remark(self, line, remark)
      self%case_text = self%case_text // line // line_feed
   end subroutine put_choice

   !> Write a list as an array, as an array of small arrays if values belong together
   subroutine write_list(self, name, values, n, units, bounds)
      class(toml_writer), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      character(len=:), allocatable :: key, line, text, word
      integer :: group, k, last

      if (self%is_recording .or. n == 0) return
      associate (have_units => present(units), have_bounds => present(bounds))
         group = 1
         key = trim(form_key(name))
         if (key == "") key = small(name)
         if (name == "Y,ALPHA" .or. name == "EXRHS") group = 2
         if (name == "XL,XH,YL,YH") group = 4
      end associate
      ! written into a text of sufficient length, so that time is linear in the length
      allocate(character(len=n*27 + 64) :: text)
      last = 0
      line = key // " = ["
      do k = 1, n
         word = trim(exact_text(values(k)))
         if (group > 1 .and. modulo(k - 1, group) == 0) word = "[" // word
         if (group > 1 .and. modulo(k, group) == 0) word = word // "]"
         if (k < n) word = word // ","
         if (len(line) + len(word) + 1 > line_width) then
            call add_text(line // line_feed)
            line = "   "
         end if
         if (line(len(line):) /= "[" .and. len_trim(line) > 0) word = " " // word
         line = line // word
      end do
      call add_text(line // "]")
      if (self%in_part) then
         self%parts = self%parts // text(:last) // line_feed
         return
      end if
      if (self%memory%is_same(trim(self%group) // "." // key, text(:last))) return
      call self%memory%keep(trim(self%group) // "." // key, text(:last))
      self%body = self%body // text(:last) // line_feed

   contains

      !> Append a line
      subroutine add_text(piece)
         character(len=*), intent(in) :: piece

         text(last + 1:last + len(piece)) = piece
         last = last + len(piece)
      end subroutine add_text
   end subroutine write_list
end module contact_output_toml_writer
