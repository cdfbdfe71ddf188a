!> Parser for the subset of TOML 1.0 that input files need
!>
!> Not supported, and refused by name: dates and times, multi-line strings, non-decimal integers, inf and nan. Whatever is
!> accepted has the same meaning as in other parsers of TOML 1.0; a test compares it with Python's.
module contact_toml_parser
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_text_line_words, only : printable
   use contact_text_words, only : integer_text
   use contact_toml_document, only : toml_document, toml_kind, toml_node
   use contact_toml_numbers, only : read_number
   use contact_toml_scanner, only : check_encoding, end_of_word, end_statement, fail, is_line_end, is_quote, next_line, shown, &
      & skip_blanks, skip_lines, parse_string, took, toml_scanner
   implicit none (type, external)
   private

   public :: parse_toml, is_bare_key

   !> Maximum nesting of arrays and inline tables, maximum number of parts of a dotted key
   integer, parameter :: deepest = 20, longest_key = 20
   !> Maximum number of nodes of a document
   integer, parameter :: max_nodes = 20000000

   character(len=*), parameter :: figures = "0123456789"
   character(len=*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
   !> Characters of an unquoted key, and of a value other than a string
   character(len=*), parameter :: bare = letters // figures // "_-", word_letters = bare // "+.:"

   !> Part of a key: its range in the store of the document, and its position in the text
   type :: key_part
      integer :: first = 1, last = 0, line = 0, column = 0
   end type key_part

   !> State of the parser
   type, extends(toml_scanner) :: toml_parser
      !> Number of arrays and inline tables that enclose the current position
      integer :: depth = 0
      !> Tables created by dotted keys since the last header
      integer, allocatable :: pending(:)
      integer :: pending_count = 0
   end type toml_parser

contains

   !> Parse a text
   subroutine parse_toml(text, file, document, error)
      !> Text in UTF-8, with lines ending with LF or CR-LF
      character(len=*), intent(in) :: text
      !> Name of the file in messages
      character(len=*), intent(in) :: file
      type(toml_document), intent(out) :: document
      type(error_type), allocatable, intent(out) :: error
      type(toml_parser) :: p
      integer :: table

      p%text = text
      p%file = file
      allocate(p%pending(8))
      call document%begin(text)
      call check_encoding(p)
      table = 1
      do while (.not. allocated(p%error))
         call skip_blanks(p)
         if (p%at > len(p%text)) exit
         if (is_line_end(p)) then
            call next_line(p)
            cycle
         end if
         select case (p%text(p%at:p%at))
         case ("#")
            continue
         case ("[")
            call parse_header(p, document, table)
         case default
            call parse_pair(p, document, table, is_inline=.false.)
         end select
         if (.not. allocated(p%error)) call end_statement(p)
      end do
      if (allocated(p%error)) call move_alloc(p%error, error)
   end subroutine parse_toml

   !> Can a key be written without quotes?
   pure logical function is_bare_key(key)
      !> Key without quotes
      character(len=*), intent(in) :: key

      is_bare_key = len(key) > 0 .and. verify(key, bare) == 0
   end function is_bare_key

   !> Parse a key of one or more parts
   subroutine parse_key(p, document, parts, n)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      type(key_part), intent(out) :: parts(longest_key)
      !> Number of parts
      integer, intent(out) :: n
      integer :: last

      n = 0
      do
         call skip_blanks(p)
         if (n == longest_key) then
            call fail(p, "a key has more than " // integer_text(longest_key) // " parts")
            return
         end if
         n = n + 1
         parts(n)%line = p%line
         parts(n)%column = p%at - p%line_first + 1
         last = end_of_word(p, bare)
         if (last >= p%at) then
            parts(n)%first = p%at
            parts(n)%last = last
            p%at = last + 1
         else if (is_quote(p)) then
            call keep_string(p, document, parts(n)%first, parts(n)%last)
         else
            call fail(p, trim(shown(p)) // " found where a key is expected; a key consists of letters, figures, - and _, " // &
               & "or is in quotes")
         end if
         if (allocated(p%error)) return
         call skip_blanks(p)
         if (.not. took(p, ".")) return
      end do
   end subroutine parse_key

   !> Move to a table below another one, creating it if needed; for an array of tables, to its last one
   subroutine enter(p, document, part, table, with_arrays)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      type(key_part), intent(in) :: part
      !> On entry the parent
      integer, intent(inout) :: table
      !> May the last table of an array of tables be used?
      logical, intent(in) :: with_arrays
      type(toml_node) :: node
      integer :: below

      below = document%child(table, document%store(part%first:part%last))
      if (below == 0) then
         node%kind = toml_kind%table
         node%key_first = part%first
         node%key_last = part%last
         node%key_line = part%line
         node%key_column = part%column
         node%line = part%line
         node%column = part%column
         call document%add(table, node, below)
         table = below
         return
      end if
      if (document%nodes(below)%has_tables .and. with_arrays) then
         table = document%nodes(below)%last
      else if (document%nodes(below)%kind == toml_kind%table) then
         table = below
      else
         call fail_duplicate(p, document, part, below, "is not a table and has no keys")
      end if
   end subroutine enter

   !> Report a key that is already defined
   subroutine fail_duplicate(p, document, part, index, what)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(in) :: document
      type(key_part), intent(in) :: part
      !> Node with this key
      integer, intent(in) :: index
      !> What is wrong
      character(len=*), intent(in) :: what

      if (allocated(p%error)) return
      associate (node => document%nodes(index))
         call fatal_error(p%error, '"' // printable(document%store(part%first:part%last)) // '" ' // what // &
            & "; it was given in line " // integer_text(node%key_line), error_kind%input, p%file, part%line, part%column)
      end associate
   end subroutine fail_duplicate

   !> Parse a header: a key in single or double brackets
   subroutine parse_header(p, document, table)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      !> The table that it opens
      integer, intent(inout) :: table
      type(key_part) :: parts(longest_key)
      type(toml_node) :: node
      integer :: below, k, n, start
      logical :: is_array

      do k = 1, p%pending_count
         document%nodes(p%pending(k))%is_explicit = .true.
      end do
      p%pending_count = 0
      start = p%at
      p%at = p%at + 1
      is_array = took(p, "[")
      call parse_key(p, document, parts, n)
      if (allocated(p%error)) return
      if (.not. took(p, "]")) then
         call fail(p, trim(shown(p)) // ' found where the "]" of the header is expected')
         return
      end if
      if (is_array) then
         if (.not. took(p, "]")) then
            call fail(p, trim(shown(p)) // ' found where the second "]" of the header is expected')
            return
         end if
      end if
      table = 1
      do k = 1, n - 1
         call enter(p, document, parts(k), table, with_arrays=.true.)
         if (allocated(p%error)) return
         if (document%nodes(table)%is_frozen) then
            call fail_duplicate(p, document, parts(k), table, "is complete, nothing can be added")
            return
         end if
      end do
      below = document%child(table, document%store(parts(n)%first:parts(n)%last))
      if (is_array) then
         if (below == 0) then
            node%kind = toml_kind%array
            node%has_tables = .true.
            node%is_explicit = .true.
            call place_node(parts(n))
            call document%add(table, node, below)
         else if (.not. document%nodes(below)%has_tables) then
            call fail_duplicate(p, document, parts(n), below, "is not an array of tables")
            return
         end if
         node = toml_node(kind=toml_kind%table)
         call place_node(parts(n))
         call document%add(below, node, table)
      else
         if (below > 0) then
            if (document%nodes(below)%is_explicit .or. document%nodes(below)%is_frozen) then
               call fail_duplicate(p, document, parts(n), below, "cannot be opened a second time")
               return
            end if
         end if
         call enter(p, document, parts(n), table, with_arrays=.true.)
         if (allocated(p%error)) return
         document%nodes(table)%is_explicit = .true.
         document%nodes(table)%key_line = parts(n)%line
         document%nodes(table)%key_column = parts(n)%column
         document%nodes(table)%line = p%line
         document%nodes(table)%column = start - p%line_first + 1
      end if
      call check_size(p, document)

   contains

      !> Set the key and position of the node
      subroutine place_node(part)
         type(key_part), intent(in) :: part

         node%key_first = part%first
         node%key_last = part%last
         node%key_line = part%line
         node%key_column = part%column
         node%line = p%line
         node%column = start - p%line_first + 1
      end subroutine place_node
   end subroutine parse_header

   !> Parse key = value
   recursive subroutine parse_pair(p, document, table, is_inline)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      !> Table to which it belongs
      integer, intent(in) :: table
      !> Within an inline table?
      logical, intent(in) :: is_inline
      type(key_part) :: parts(longest_key)
      type(toml_node) :: node
      integer :: below, k, n, index, made(longest_key)

      call parse_key(p, document, parts, n)
      if (allocated(p%error)) return
      if (.not. took(p, "=")) then
         call fail(p, trim(shown(p)) // ' found where the "=" after a key is expected')
         return
      end if
      call skip_blanks(p)

      below = table
      do k = 1, n - 1
         call enter(p, document, parts(k), below, with_arrays=.false.)
         if (allocated(p%error)) return
         made(k) = below
         if (document%nodes(below)%is_frozen) call fail_duplicate(p, document, parts(k), below, "is complete, nothing can be added")
         if (document%nodes(below)%is_explicit) call fail_duplicate(p, document, parts(k), below, &
            & "has its own header, under which its keys belong")
         if (allocated(p%error)) return
      end do
      index = document%child(below, document%store(parts(n)%first:parts(n)%last))
      if (index > 0) then
         call fail_duplicate(p, document, parts(n), index, "is given twice")
         return
      end if
      node%key_first = parts(n)%first
      node%key_last = parts(n)%last
      node%key_line = parts(n)%line
      node%key_column = parts(n)%column
      call parse_value(p, document, below, node)
      if (allocated(p%error) .or. is_inline) return
      do k = 1, n - 1
         if (p%pending_count == size(p%pending)) p%pending = [p%pending, p%pending]
         p%pending_count = p%pending_count + 1
         p%pending(p%pending_count) = made(k)
      end do
   end subroutine parse_pair

   !> Parse a value, which becomes a child
   recursive subroutine parse_value(p, document, parent, node)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      integer, intent(in) :: parent
      !> Node with its key
      type(toml_node), intent(inout) :: node
      integer :: index

      node%line = p%line
      node%column = p%at - p%line_first + 1
      if (p%at > len(p%text) .or. is_line_end(p)) then
         call fail(p, trim(shown(p)) // " found where a value is expected")
         return
      end if
      select case (p%text(p%at:p%at))
      case ("""", "'")
         node%kind = toml_kind%string
         call keep_string(p, document, node%text_first, node%text_last)
      case ("[", "{")
         node%kind = merge(toml_kind%array, toml_kind%table, p%text(p%at:p%at) == "[")
         node%is_frozen = .true.
      case default
         call parse_word(p, node)
      end select
      if (allocated(p%error)) return
      call document%add(parent, node, index)
      call check_size(p, document)
      if (node%kind == toml_kind%array) call parse_array(p, document, index)
      if (node%kind == toml_kind%table) call parse_inline_table(p, document, index)
   end subroutine parse_value

   !> Parse [value, value, ...], over any number of lines
   recursive subroutine parse_array(p, document, array)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      integer, intent(in) :: array
      type(toml_node) :: node

      call enter_level(p)
      p%at = p%at + 1
      do
         call skip_lines(p)
         if (allocated(p%error)) return
         if (took(p, "]")) exit
         node = toml_node()
         call parse_value(p, document, array, node)
         if (allocated(p%error)) return
         call skip_lines(p)
         if (allocated(p%error)) return
         if (took(p, ",")) cycle
         if (took(p, "]")) exit
         call fail(p, trim(shown(p)) // ' found where "," or "]" is expected, in the array that begins in line ' // &
            & integer_text(document%nodes(array)%line))
         return
      end do
      p%depth = p%depth - 1
   end subroutine parse_array

   !> Parse { key = value, ... } on one line
   recursive subroutine parse_inline_table(p, document, table)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      integer, intent(in) :: table

      call enter_level(p)
      if (allocated(p%error)) return
      ! the table itself is complete at its end
      document%nodes(table)%is_frozen = .false.
      p%at = p%at + 1
      call skip_blanks(p)
      if (.not. took(p, "}")) then
         do
            call parse_pair(p, document, table, is_inline=.true.)
            if (allocated(p%error)) return
            call skip_blanks(p)
            if (took(p, "}")) exit
            if (took(p, ",")) cycle
            call fail(p, trim(shown(p)) // ' found where "," or "}" is expected; an inline table ends on the line where it begins')
            return
         end do
      end if
      document%nodes(table)%is_frozen = .true.
      call freeze_below(document, table)
      p%depth = p%depth - 1
   end subroutine parse_inline_table

   !> Also close the tables created by dotted keys within an inline table
   recursive subroutine freeze_below(document, table)
      type(toml_document), intent(inout) :: document
      integer, intent(in) :: table
      integer :: k

      k = document%nodes(table)%first
      do while (k > 0)
         if (document%nodes(k)%kind == toml_kind%table .and. .not. document%nodes(k)%is_frozen) then
            document%nodes(k)%is_frozen = .true.
            call freeze_below(document, k)
         end if
         k = document%nodes(k)%next
      end do
   end subroutine freeze_below

   !> Enter an array or an inline table
   subroutine enter_level(p)
      type(toml_parser), intent(inout) :: p

      p%depth = p%depth + 1
      if (p%depth > deepest) call fail(p, "arrays and inline tables are nested more than " // integer_text(deepest) // " deep")
   end subroutine enter_level

   !> Check the size of the document
   subroutine check_size(p, document)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(in) :: document

      if (document%count >= max_nodes) call fail(p, "there are more than " // integer_text(max_nodes) // " values")
   end subroutine check_size

   !> Parse a string, which is in the text or, if it has escapes, appended to the store
   subroutine keep_string(p, document, first, last)
      type(toml_parser), intent(inout) :: p
      type(toml_document), intent(inout) :: document
      !> Its range in the store of the document
      integer, intent(out) :: first, last
      character(len=:), allocatable :: resolved

      call parse_string(p, resolved, first, last)
      if (allocated(resolved) .and. .not. allocated(p%error)) call document%keep(resolved, first, last)
   end subroutine keep_string

   !> Parse true, false, an integer or a real number
   subroutine parse_word(p, node)
      type(toml_parser), intent(inout) :: p
      type(toml_node), intent(inout) :: node
      integer :: last, start

      start = p%at
      last = end_of_word(p, word_letters)
      associate (word => p%text(start:last))
         node%text_first = start
         node%text_last = last
         if (len(word) == 0) then
            call fail(p, trim(shown(p)) // " found where a value is expected")
         else if (word == "true" .or. word == "false") then
            node%kind = toml_kind%logical
            node%l = word == "true"
         else if (scan(word(1:1), figures // "+-.") == 0) then
            if (word == "inf" .or. word == "nan") then
               call parse_number(p, word, node)
            else
               call fail(p, '"' // printable(word) // '" is not a value; a text needs quotes, "' // printable(word) // '"')
            end if
         else
            call parse_number(p, word, node)
         end if
      end associate
      p%at = last + 1
   end subroutine parse_word

   !> Parse an integer or a real number
   subroutine parse_number(p, word, node)
      type(toml_parser), intent(inout) :: p
      character(len=*), intent(in) :: word
      type(toml_node), intent(inout) :: node
      character(len=:), allocatable :: complaint
      logical :: is_real

      call read_number(word, is_real, node%i, node%r, complaint)
      node%kind = merge(toml_kind%real, toml_kind%integer, is_real)
      if (allocated(complaint)) call fail(p, '"' // printable(word) // '" ' // complaint)
   end subroutine parse_number
end module contact_toml_parser
