!> Tables of a case in the readable format: looking up keys in this case and in previous ones, and finding keys that nothing has
!> read
module contact_input_toml_tables
   use contact_cases_archive, only : case_archive
   use contact_control_words, only : key_length
   use contact_input_problems, only : problem_list, severity
   use contact_text_bounds, only : bounds_of
   use contact_text_line_words, only : printable
   use contact_text_nearest, only : nearest_word, words_of
   use contact_text_words, only : capital
   use contact_toml_document, only : toml_document, toml_kind, toml_kind_text
   implicit none (type, external)
   private

   public :: find, is_tables, leaves_of, list_of, number_of, sets_of, key_with_value, toml_memory, toml_tables

   !> Maximum number of keys that cases read and store
   integer, parameter :: max_keys = 400
   integer, parameter :: name_length = 2*key_length

   !> Values given last by the cases of a result element: names "group.key" and nodes of the document
   type :: toml_memory
      integer :: count = 0
      character(len=name_length) :: names(max_keys) = ""
      integer :: nodes(max_keys) = 0
   contains
      procedure :: recall
      procedure :: remember
   end type toml_memory

   !> State shared by the readers of tables
   type, abstract, extends(case_archive) :: toml_tables
      type(toml_document), pointer :: document => null()
      !> Problems of the values of the case
      type(problem_list), pointer :: problems => null()
      !> Keys given by previous cases
      type(toml_memory), pointer :: memory => null()
      !> Which nodes of the document have been read
      logical, pointer :: used(:) => null()
      !> Table of the case, of the current group and of the current set or block; 0 for none
      integer :: case_node = 0, group_node = 0, part_node = 0
      character(len=key_length) :: group = ""
      !> Groups and keys that the case has looked up, to suggest the nearest valid one
      integer :: known_count = 0
      character(len=key_length) :: known_groups(max_keys) = "", known_keys(max_keys) = ""
      !> Motion of the case, on which units depend; member of motion
      integer :: moves = 0
      !> Is a value of the last line missing or wrong?
      logical :: line_is_bad = .false.
      !> Was the case read before, with other values? Then its keys are known already
      logical :: is_repeat = .false.
   contains
      procedure :: line_of
      !> Does the case give a group?
      procedure :: has_group
      !> Record that a key was looked up
      procedure :: note_key
      !> Add a problem at a node, or at the case
      procedure :: add_problem
      !> Report keys of the case that nothing has looked up, as errors
      procedure :: refuse_unused
   end type toml_tables

contains

   !> The node stored for a name, 0 if there is none
   pure integer function recall(self, name) result(node)
      class(toml_memory), intent(in) :: self
      !> "group.key"
      character(len=*), intent(in) :: name
      integer :: k

      node = 0
      do k = 1, self%count
         if (self%names(k) == name) node = self%nodes(k)
      end do
   end function recall

   !> Does the case give a group?
   pure logical function has_group(self, group)
      class(toml_tables), intent(in) :: self
      !> Name of the group
      character(len=*), intent(in) :: group

      has_group = self%document%child(self%case_node, group) > 0
   end function has_group

   !> Store the node for a name
   pure subroutine remember(self, name, node)
      class(toml_memory), intent(inout) :: self
      !> "group.key"
      character(len=*), intent(in) :: name
      !> Node of the document
      integer, intent(in) :: node
      integer :: k

      do k = 1, self%count
         if (self%names(k) == name) exit
      end do
      if (k > max_keys) return
      self%count = max(self%count, k)
      self%names(k) = name
      self%nodes(k) = node
   end subroutine remember

   !> Is it an array of tables, with headers or inline?
   pure logical function is_tables(document, index)
      type(toml_document), intent(in) :: document
      !> Node of the document
      integer, intent(in) :: index
      integer :: k

      is_tables = document%nodes(index)%kind == toml_kind%array
      k = document%nodes(index)%first
      do while (is_tables .and. k > 0)
         is_tables = document%nodes(k)%kind == toml_kind%table
         k = document%nodes(k)%next
      end do
   end function is_tables

   !> The n-th child, 0 if there are fewer
   pure integer function number_of(document, array, n) result(node)
      type(toml_document), intent(in) :: document
      !> Node of the document, and index of the child, from 1
      integer, intent(in) :: array, n
      integer :: k

      node = document%nodes(array)%first
      do k = 2, n
         if (node == 0) return
         node = document%nodes(node)%next
      end do
   end function number_of

   !> Number of values in an array of arrays
   recursive pure integer function leaves_of(document, index) result(n)
      type(toml_document), intent(in) :: document
      !> Node of the document
      integer, intent(in) :: index
      integer :: k

      n = 0
      k = document%nodes(index)%first
      do while (k > 0)
         if (document%nodes(k)%kind == toml_kind%array) then
            n = n + leaves_of(document, k)
         else
            n = n + 1
         end if
         k = document%nodes(k)%next
      end do
   end function leaves_of

   !> Record that a key was looked up
   subroutine note_key(self, group, key)
      class(toml_tables), intent(inout) :: self
      !> Group, "" for a key of the case
      character(len=*), intent(in) :: group, key
      integer :: k

      if (self%is_repeat) return
      do k = 1, self%known_count
         if (self%known_groups(k) == group .and. self%known_keys(k) == key) return
      end do
      if (k > max_keys) return
      self%known_count = k
      self%known_groups(k) = group
      self%known_keys(k) = key
   end subroutine note_key

   !> Node of the friction sets of the case; 0 if there are none
   integer function sets_of(self) result(node)
      class(toml_tables), intent(inout) :: self

      call self%note_key("friction", "set")
      node = 0
      if (self%group_node > 0) node = self%document%child(self%group_node, "set")
      if (node > 0) self%used(node) = .true.
   end function sets_of

   !> A key of the current table, or a stored one; 0 if there is none
   integer function list_of(self, key) result(node)
      class(toml_tables), intent(in) :: self
      !> Key as in the file
      character(len=*), intent(in) :: key
      integer :: table

      node = 0
      table = merge(self%part_node, self%group_node, self%part_node > 0)
      if (table > 0) node = self%document%child(table, key)
      if (node == 0 .and. self%part_node == 0) node = self%memory%recall(trim(self%group) // "." // key)
   end function list_of

   !> Find a key in the current table, then in those of previous cases; for names that end with a figure, an element of an array
   subroutine find(self, key, node)
      class(toml_tables), intent(inout) :: self
      !> Key as in the file
      character(len=*), intent(in) :: key
      !> Node; 0 if it was never given
      integer, intent(out) :: node
      integer :: figure, stem, table

      call self%note_key(trim(self%group), key)
      node = 0
      table = merge(self%part_node, self%group_node, self%part_node > 0)
      if (self%group == "") table = self%case_node
      figure = index("12", key(len(key):))
      if (figure > 0 .and. len(key) > 1) call self%note_key(trim(self%group), key(:len(key) - 1))
      if (table > 0) then
         node = self%document%child(table, key)
         if (node == 0 .and. figure > 0 .and. len(key) > 1) then
            stem = self%document%child(table, key(:len(key) - 1))
            if (stem > 0) then
               self%used(stem) = .true.
               if (self%document%nodes(stem)%kind == toml_kind%array .and. self%document%nodes(stem)%count == 2) then
                  node = number_of(self%document, stem, figure)
               else
                  if (figure == 1) call self%add_problem(severity%error, stem, key(:len(key) - 1) // &
                     & " must be an array of two values, [first, second]")
                  self%line_is_bad = .true.
                  node = -1
                  return
               end if
            end if
         end if
      end if
      if (node > 0) then
         self%used(node) = .true.
         if (self%part_node == 0) call self%memory%remember(trim(self%group) // "." // key, node)
      else if (self%part_node == 0) then
         node = self%memory%recall(trim(self%group) // "." // key)
      end if
   end subroutine find

   !> Add a problem at a node; without a node at the current table or the case
   subroutine add_problem(self, kind, index, message)
      class(toml_tables), intent(inout) :: self
      !> Member of severity
      integer, intent(in) :: kind
      !> Node, 0 if there is none
      integer, intent(in) :: index
      !> Message of one sentence
      character(len=*), intent(in) :: message
      integer :: place

      place = index
      if (place <= 0) place = self%part_node
      if (place <= 0) place = self%group_node
      if (place <= 0) place = self%case_node
      associate (node => self%document%nodes(place))
         call self%problems%add(kind, message, node%line, node%column, is_own=index > 0)
      end associate
   end subroutine add_problem

   !> Maximum length of a value in messages
   pure integer function len_key_with_value(self, index) result(length)
      class(toml_tables), intent(in) :: self
      integer, intent(in) :: index

      associate (node => self%document%nodes(index))
         select case (node%kind)
         case (toml_kind%string); length = len(printable(self%document%text_of(index))) + 2
         case (toml_kind%table, toml_kind%array); length = len_trim(toml_kind_text(node%kind)) + 2
         case default; length = len(printable(self%document%text_of(index)))
         end select
      end associate
   end function len_key_with_value

   !> "key = value" as in the input
   pure function key_with_value(self, key, index) result(text)
      class(toml_tables), intent(in) :: self
      !> Key as in the file
      character(len=*), intent(in) :: key
      !> Node of the value
      integer, intent(in) :: index
      character(len=len(key) + 3 + len_key_with_value(self, index)) :: text

      associate (node => self%document%nodes(index))
         select case (node%kind)
         case (toml_kind%string); text = key // ' = "' // printable(self%document%text_of(index)) // '"'
         case (toml_kind%table, toml_kind%array); text = key // " = (" // trim(toml_kind_text(node%kind)) // ")"
         case default; text = key // " = " // printable(self%document%text_of(index))
         end select
      end associate
   end function key_with_value

   !> Line on which a group begins, 0 if the case does not give it
   pure integer function line_of(self, name) result(line)
      class(toml_tables), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: node

      line = 0
      node = self%document%child(self%case_node, name)
      if (node > 0) line = self%document%nodes(node)%line
   end function line_of

   !> Report keys of the case that nothing has looked up, as errors, with the nearest valid key
   subroutine refuse_unused(self, known_groups)
      class(toml_tables), intent(inout) :: self
      !> All groups that a case can have
      character(len=*), intent(in) :: known_groups(:)
      integer :: k

      k = self%document%nodes(self%case_node)%first
      do while (k > 0)
         if (.not. self%used(k)) then
            call refuse_key(self, k, "", known_groups)
         else
            call refuse_unused_below(self, k, self%document%key_of(k))
         end if
         k = self%document%nodes(k)%next
      end do
   end subroutine refuse_unused

   !> Check the keys of a group, and of the tables in it
   recursive subroutine refuse_unused_below(self, index, group)
      class(toml_tables), intent(inout) :: self
      integer, intent(in) :: index
      character(len=*), intent(in) :: group
      character(len=1), parameter :: none(0) = ""
      integer :: k

      if (self%document%nodes(index)%kind /= toml_kind%table .and. .not. is_tables(self%document, index)) return
      k = self%document%nodes(index)%first
      do while (k > 0)
         if (self%used(k) .or. self%document%nodes(index)%kind == toml_kind%array) then
            call refuse_unused_below(self, k, group)
         else
            call refuse_key(self, k, group, none)
         end if
         k = self%document%nodes(k)%next
      end do
   end subroutine refuse_unused_below

   !> Report a key that nothing has looked up
   subroutine refuse_key(self, index, group, known)
      class(toml_tables), intent(inout) :: self
      integer, intent(in) :: index
      !> Group of the key, "" for the case
      character(len=*), intent(in) :: group
      !> Keys of this group that are valid in other cases
      character(len=*), intent(in) :: known(:)
      character(len=key_length) :: keys(max_keys)
      character(len=:), allocatable :: message, words
      integer :: place

      keys = ""
      where (self%known_groups == group) keys = self%known_keys
      message = '"' // printable(self%document%key_of(index)) // '"'
      if (any(known == self%document%key_of(index))) then
         message = message // " has no meaning in this case, whose choices do not use it"
      else
         place = nearest_word(self%document%key_of(index), keys)
         if (place > 0) then
            ! S_WS on a roller: a number that is valid in other cases
            if (bounds_of(capital(self%document%key_of(index))) > 0) then
               message = message // " has no meaning in this case, whose choices do not use it"
            else
               message = "unknown key " // message
            end if
            message = message // '; did you mean "' // trim(keys(place)) // '"?'
         else
            place = nearest_word(self%document%key_of(index), known)
            if (place > 0) then
               message = "unknown key " // message // '; did you mean "' // trim(known(place)) // '"?'
            else
               call words_of(keys, words)
               message = "unknown key " // message // ", or one without meaning in this case; accepted: " // words
            end if
         end if
      end if
      associate (node => self%document%nodes(index))
         call self%problems%add(severity%error, message, node%key_line, node%key_column, is_own=.false.)
      end associate
   end subroutine refuse_key
end module contact_input_toml_tables
