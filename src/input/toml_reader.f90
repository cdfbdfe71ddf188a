!> The archive that sets the values of a case from a table of the readable format
!>
!> Groups are tables of the case, numbers are keys with their names in small letters. A number that a group does not give is that of
!> the last case with this group; if there is none, it keeps its preset value, or is reported as missing. Lists are arrays, whose
!> lengths need not be given. An element of an array "gg" of two values is used for gg1 and gg2.
module contact_input_toml_reader
   use contact_base_kinds, only : wp
   use contact_cases_archive, only : archive_item, item_kind, own_word, shown_length
   use contact_control_words, only : form_key, form_table, form_value, form_words, key_length, key_of_item
   use contact_input_problems, only : problem_list, severity
   use contact_input_toml_tables, only : find, is_tables, key_with_value, leaves_of, number_of, sets_of, toml_memory, &
      & toml_tables
   use contact_input_toml_values, only : check_item, count_values, fill_list, set_number
   use contact_text_bounds, only : bounds_of, bounds_table, unit_length, unit_of
   use contact_text_nearest, only : unknown_word, words_of
   use contact_text_words, only : exact_text, integer_text, small
   use contact_toml_document, only : toml_document, toml_kind, toml_kind_text
   implicit none (type, external)
   private

   public :: toml_reader, new_toml_reader

   !> Reads the tables of a case
   type, extends(toml_tables) :: toml_reader
      !> Number of the current set or block
      integer :: part = 0
      !> Name of a group that may be missing altogether
      character(len=key_length) :: lenient_group = ""
      !> Values of the last line, 0 for those not given
      integer :: nodes(16) = 0
   contains
      procedure :: end_line => read_line
      procedure :: list => read_list
      procedure :: own_choice => read_choice
      procedure :: own_number => read_own_number
      procedure :: report => report_value
      procedure :: fail => stop_reading
      procedure :: check => check_value
      procedure :: shown => show_value
      procedure :: place => place_value
      procedure :: open_group => open_table
      procedure :: close_group => close_table
      procedure :: report_group => report_table
   end type toml_reader

contains

   !> Create a reader of a case; all arguments must outlive it
   function new_toml_reader(document, case_node, problems, memory, used) result(reader)
      type(toml_document), intent(in), target :: document
      !> Table of the case
      integer, intent(in) :: case_node
      type(problem_list), intent(in), target :: problems
      !> Keys given by previous cases
      type(toml_memory), intent(in), target :: memory
      !> Which nodes have been read, shape (nodes)
      logical, intent(in), target :: used(:)
      type(toml_reader) :: reader

      reader%is_reading = .true.
      reader%has_names = .true.
      reader%document => document
      reader%case_node = case_node
      reader%problems => problems
      reader%memory => memory
      reader%used => used
   end function new_toml_reader

   !> The following keys belong to a table of the case
   subroutine open_table(self, text)
      class(toml_reader), intent(inout) :: self
      character(len=*), intent(in) :: text

      self%group = text
      self%part = 0
      self%part_node = 0
      self%group_node = self%document%child(self%case_node, text)
      call self%note_key("", text)
      if (self%group_node == 0) return
      self%used(self%group_node) = .true.
      associate (node => self%document%nodes(self%group_node))
         if (text == "stress_points") then
            if (is_tables(self%document, self%group_node)) return
            call self%add_problem(severity%error, self%group_node, "stress_points is " // &
               & trim(toml_kind_text(node%kind)) // "; each block of points is a table [[case.stress_points]]")
         else
            if (node%kind == toml_kind%table) return
            call self%add_problem(severity%error, self%group_node, trim(text) // " is " // trim(toml_kind_text(node%kind)) // &
               & "; expected is a table, [case." // trim(text) // "]")
         end if
      end associate
      self%group_node = 0
   end subroutine open_table

   !> The following keys do not belong to the table
   subroutine close_table(self)
      class(toml_reader), intent(inout) :: self

      if (self%is_good) call refuse_more_sets(self)
      self%group = ""
      self%group_node = 0
      self%part_node = 0
   end subroutine close_table

   !> Report sets of friction beyond the required number
   subroutine refuse_more_sets(self)
      class(toml_reader), intent(inout) :: self
      integer :: sets

      if (self%group /= "friction" .or. self%part == 0) return
      sets = sets_of(self)
      if (sets == 0) return
      if (self%document%nodes(sets)%count > self%part) call self%add_problem(severity%error, sets, "there are " // &
         & integer_text(self%document%nodes(sets)%count) // " sets of friction, expected are " // integer_text(self%part))
   end subroutine refuse_more_sets

   !> Set the values of the current items
   subroutine read_line(self)
      class(toml_reader), intent(inout) :: self
      integer :: k

      self%line_is_bad = .false.
      self%nodes = 0
      if (self%is_good) then
         call enter_part(self)
         do k = 1, self%count
            call set_item(self, k)
         end do
      end if
      call self%finish_line()
   end subroutine read_line

   !> A line of a friction set is in a table of its own, and so is a block of points
   subroutine enter_part(self)
      class(toml_reader), intent(inout) :: self
      character(len=5), parameter :: of_sets(*) = [character(len=5) :: "ALPHA", "SVF", "FSTAT", "FKIN", "FREF"]
      integer :: array, n

      if (self%group == "stress_points") then
         if (self%items(1)%name == "ISUBS") call enter_number(self, self%group_node)
         return
      end if
      if (self%group /= "friction") return
      self%part_node = 0
      if (all(of_sets /= self%items(1)%name)) return
      array = sets_of(self)
      if (array == 0) return
      if (.not. is_tables(self%document, array)) then
         call self%add_problem(severity%error, array, "set is " // &
            & trim(toml_kind_text(self%document%nodes(array)%kind)) // "; each set of friction is a table, [[case.friction.set]]")
         self%is_good = .false.
         return
      end if
      n = self%document%nodes(array)%count
      call enter_number(self, array)
      if (self%part_node > 0) return
      call self%add_problem(severity%error, array, "there are " // integer_text(n) // " sets of friction, which are too few")
      self%is_good = .false.
   end subroutine enter_part

   !> Advance to the next table of an array; part_node is 0 after the last
   subroutine enter_number(self, array)
      class(toml_reader), intent(inout) :: self
      !> Node, 0 for an empty array
      integer, intent(in) :: array

      self%part = self%part + 1
      if (array == 0) then
         self%part_node = 0
      else if (self%part_node == 0 .or. self%part == 1) then
         self%part_node = number_of(self%document, array, self%part)
      else
         self%part_node = self%document%nodes(self%part_node)%next
      end if
      if (self%part_node > 0) self%used(self%part_node) = .true.
   end subroutine enter_number

   !> Set the value of the variable of an item
   subroutine set_item(self, k)
      class(toml_reader), intent(inout) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: key, complaint
      integer :: node, number

      associate (item => self%items(k))
         key = trim(key_of_item(self%items, k))
         item%given = .true.
         if (item%name == "ISUBS" .and. self%part_node == 0) then
            item%i = 0
            return
         end if
         call find(self, key, node)
         if (node < 0) return
         if (node == 0) then
            call count_values(self, trim(item%name), number)
            if (number >= 0) then
               item%i = number
               return
            end if
            call set_missing(self, item, key)
            return
         end if
         self%nodes(k) = node
         if (form_key(item%name) /= "") then
            call set_form(self, item, key, node)
            return
         end if
         call set_number(self, item, node, complaint)
         if (allocated(complaint)) then
            self%line_is_bad = .true.
            call self%add_problem(severity%error, node, key_with_value(self, key, node) // " " // complaint)
            return
         end if
         if (item%kind == item_kind%text .or. item%is_unchecked) return
         call check_item(self, item, key, node)
      end associate
   end subroutine set_item

   !> A value that was never given has its default or its preset value, or is missing
   subroutine set_missing(self, item, key)
      class(toml_reader), intent(inout) :: self
      type(archive_item), intent(inout) :: item
      character(len=*), intent(in) :: key
      character(len=:), allocatable :: message
      character(len=unit_length) :: unit
      character(len=8) :: opening, closing

      item%given = .false.
      if (item%is_optional) then
         if (associated(item%r)) item%r = item%default
         if (associated(item%i)) item%i = nint(item%default)
         return
      end if
      if (item%is_preset .or. self%lenient_group == self%group) return
      self%line_is_bad = .true.
      message = key // " is missing"
      if (item%row > 0) then
         message = message // ": " // trim(bounds_table(item%row)%title)
         unit = unit_of(item%row, self%moves)
         if (unit /= "-" .and. unit /= "integer") message = message // " [" // trim(unit) // "]"
      end if
      opening = merge("[[", "[ ", self%part_node > 0)
      closing = merge("]]", "] ", self%part_node > 0)
      message = message // "; it belongs under " // trim(opening) // "case." // trim(self%group)
      if (self%part_node > 0 .and. self%group == "friction") message = message // ".set"
      call self%add_problem(severity%error, 0, message // trim(closing))
   end subroutine set_missing

   !> A word that selects a number
   subroutine set_form(self, item, key, node)
      class(toml_reader), intent(inout) :: self
      type(archive_item), intent(inout) :: item
      character(len=*), intent(in) :: key
      integer, intent(in) :: node
      character(len=len(form_table%word)) :: list(size(form_table))
      character(len=:), allocatable :: words, complaint
      logical :: is_known

      if (self%document%nodes(node)%kind == toml_kind%string) then
         call form_value(trim(item%name), self%document%text_of(node), item%i, is_known)
         if (is_known) return
      end if
      self%line_is_bad = .true.
      list = form_words(trim(item%name))
      if (self%document%nodes(node)%kind == toml_kind%string) then
         call unknown_word(key, self%document%text_of(node), list, complaint)
      else
         call words_of(list, words)
         complaint = key // " must be a word in quotes; accepted: " // words
      end if
      call self%add_problem(severity%error, node, complaint)
      ! the meaning of the following keys depends on it
      self%is_good = .false.
   end subroutine set_form

   !> A choice that exists in this format only
   subroutine read_choice(self, name, title, words, chosen, usual, none)
      class(toml_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, title, words(:)
      integer, intent(inout) :: chosen
      integer, intent(in) :: usual
      integer, intent(in), optional :: none
      character(len=:), allocatable :: known
      integer :: node

      associate (unused => title, no_none => present(none))
      end associate
      call find(self, name, node)
      if (node <= 0) then
         chosen = usual
         return
      end if
      known = ""
      do chosen = 1, size(words)
         if (own_value(self%document, node) == own_word(words(chosen))) return
         if (chosen > 1) known = known // " or "
         known = known // trim(own_word(words(chosen)))
      end do
      chosen = usual
      call refuse_own(self, name, node, known)
   end subroutine read_choice

   !> A value that is not allowed for an own key is reported once: later cases do not inherit it
   subroutine refuse_own(self, name, node, known)
      class(toml_reader), intent(inout) :: self
      !> The key, and the allowed values
      character(len=*), intent(in) :: name, known
      !> Node of the value
      integer, intent(in) :: node

      call self%memory%remember(trim(self%group) // "." // name, 0)
      call self%add_problem(severity%error, node, name // " must be " // known)
   end subroutine refuse_own

   !> A value as written by own_word; blank if it can be no choice
   pure function own_value(document, index) result(text)
      type(toml_document), intent(in) :: document
      integer, intent(in) :: index
      character(len=16) :: text

      text = ""
      associate (node => document%nodes(index))
         select case (node%kind)
         case (toml_kind%string); if (len(document%text_of(index)) < len(text) - 2) text = '"' // document%text_of(index) // '"'
         case (toml_kind%integer); if (abs(node%i) < huge(1)) text = integer_text(int(node%i))
         case (toml_kind%logical); text = merge("true ", "false", node%l)
         end select
      end associate
   end function own_value

   !> A number that exists in this format only
   subroutine read_own_number(self, name, title, value, lowest, highest)
      class(toml_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, title
      real(wp), intent(inout) :: value
      real(wp), intent(in) :: lowest, highest
      integer :: node

      associate (unused => title)
      end associate
      call find(self, name, node)
      value = 0.0_wp
      if (node <= 0) return
      associate (given => self%document%nodes(node))
         if (any(given%kind == [toml_kind%real, toml_kind%integer]) .and. (abs(given%r) <= 0.0_wp .or. &
            & (given%r >= lowest .and. given%r <= highest))) then
            value = given%r
         else
            call refuse_own(self, name, node, "a number from " // trim(exact_text(lowest)) // " to " // &
               & trim(exact_text(highest)) // ", or 0 for none")
         end if
      end associate
   end subroutine read_own_number

   !> Read exactly n numbers of an array, which may be nested
   subroutine read_list(self, name, values, n, units, bounds)
      class(toml_reader), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: n
      character(len=*), intent(in), optional :: units(:)
      character(len=*), intent(in), optional :: bounds
      character(len=:), allocatable :: key
      integer :: array, filled, row

      if (.not. self%is_good) return
      if (allocated(values)) deallocate(values)
      allocate(values(max(0, n)), source=0.0_wp)
      key = trim(form_key(name))
      if (key == "") key = trim(small(name))
      call find(self, key, array)
      if (array == 0) then
         if (n == 0) return
         call self%add_problem(severity%error, 0, key // " is missing: an array of " // integer_text(n) // &
            & " numbers; it belongs under [case." // trim(self%group) // "]")
         self%is_good = .false.
         return
      end if
      row = bounds_of(name)
      if (present(bounds)) row = bounds_of(bounds)
      if (self%document%nodes(array)%kind /= toml_kind%array) then
         call self%add_problem(severity%error, array, key_with_value(self, key, array) // " must be an array of " // &
            & integer_text(n) // " numbers")
         self%is_good = .false.
      else if (leaves_of(self%document, array) /= n) then
         call self%add_problem(severity%error, array, key // " has " // integer_text(leaves_of(self%document, array)) // &
            & " numbers, expected are " // integer_text(n))
         self%is_good = .false.
      else
         filled = 0
         call fill_list(self, array, key, row, values, filled, units)
      end if
   end subroutine read_list

   !> A value is invalid, is doubtful or was replaced
   subroutine report_value(self, is_error, name, text)
      class(toml_reader), intent(inout) :: self
      logical, intent(in) :: is_error
      character(len=*), intent(in) :: name, text

      if (self%is_good .and. .not. self%line_is_bad) call self%add_problem(merge(severity%error, severity%warning, is_error), &
         & node_of(self, name), trim(self%shown(name)) // text)
   end subroutine report_value

   !> The rest of the case cannot be read
   subroutine stop_reading(self, name, text)
      class(toml_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, text

      call self%refuse(name, text)
      self%is_good = .false.
   end subroutine stop_reading

   !> The numbers of the current group are inconsistent or doubtful
   subroutine report_table(self, is_error, text)
      class(toml_reader), intent(inout) :: self
      logical, intent(in) :: is_error
      character(len=*), intent(in) :: text

      call self%add_problem(merge(severity%error, severity%warning, is_error), 0, text)
   end subroutine report_table

   !> Check the bounds of a value that was replaced, or that has one of two names
   subroutine check_value(self, name, bounds)
      class(toml_reader), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in), optional :: bounds
      integer :: k

      k = self%place_of(name)
      if (k == 0 .or. .not. self%is_good .or. self%line_is_bad) return
      if (.not. self%items(k)%given) return
      call check_item(self, self%items(k), trim(key_of_item(self%items, k)), self%nodes(k), bounds)
   end subroutine check_value

   !> Node of an item of the last line, 0 if there is none
   pure integer function node_of(self, name) result(node)
      class(toml_reader), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k

      node = 0
      k = self%place_of(name)
      if (k > 0) node = self%nodes(k)
   end function node_of

   !> "key = value" of an item of the last line, padded with blanks
   pure function show_value(self, name) result(text)
      class(toml_reader), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=shown_length) :: text
      integer :: k

      text = small(name)
      k = self%place_of(name)
      if (k == 0) return
      text = key_of_item(self%items, k)
      if (self%nodes(k) > 0) text = key_with_value(self, trim(text), self%nodes(k))
   end function show_value

   !> Line and column of a value
   pure subroutine place_of_node(self, index, line, column)
      class(toml_reader), intent(in) :: self
      integer, intent(in) :: index
      integer, intent(inout) :: line, column

      if (index <= 0) return
      line = self%document%nodes(index)%line
      column = self%document%nodes(index)%column
   end subroutine place_of_node

   !> Position of an item of the last line
   subroutine place_value(self, name, line, column)
      class(toml_reader), intent(in) :: self
      character(len=*), intent(in) :: name
      integer, intent(inout) :: line, column

      call place_of_node(self, self%case_node, line, column)
      call place_of_node(self, self%group_node, line, column)
      call place_of_node(self, node_of(self, name), line, column)
   end subroutine place_value
end module contact_input_toml_reader
