!> Scanner for TOML texts: blanks, comments, line ends, words and strings, and positions of errors
module contact_toml_scanner
   use contact_base_error, only : error_kind, error_type, fatal_error
   implicit none (type, external)
   private

   public :: toml_scanner, check_encoding, end_of_word, end_statement, fail, is_line_end, is_quote, next_line, shown
   public :: skip_blanks, skip_lines, parse_string, took

   character(len=*), parameter :: line_feed = achar(10), carriage_return = achar(13), tab = achar(9)

   !> A text and the current position
   type :: toml_scanner
      character(len=:), allocatable :: text, file
      !> Next character, its line, and the first character of that line
      integer :: at = 1, line = 1, line_first = 1
      !> The first error
      type(error_type), allocatable :: error
   end type toml_scanner

contains

   !> Set an error at a position in the current line
   subroutine fail(p, message, at)
      class(toml_scanner), intent(inout) :: p
      !> One sentence without the position
      character(len=*), intent(in) :: message
      !> Character; default: the next one
      integer, intent(in), optional :: at
      integer :: place

      if (allocated(p%error)) return
      place = p%at
      if (present(at)) place = at
      call fatal_error(p%error, message, error_kind%input, p%file, p%line, place - p%line_first + 1)
   end subroutine fail

   !> The next character, for a message
   pure function shown(p) result(text)
      class(toml_scanner), intent(in) :: p
      character(len=24) :: text
      integer :: code

      text = "the end of the file"
      if (p%at > len(p%text)) return
      text = "the end of the line"
      if (is_line_end(p)) return
      code = iachar(p%text(p%at:p%at))
      text = '"' // p%text(p%at:p%at) // '"'
      if (code < 32 .or. code == 127) write(text, "(A, I0)") "control character ", code
      if (code > 127) text = "a letter beyond ASCII"
   end function shown

   !> Check that the text is UTF-8 without a byte order mark
   subroutine check_encoding(p)
      class(toml_scanner), intent(inout) :: p
      integer :: at, code, follow, k, line, line_first
      logical :: good

      at = 1
      line = 1
      line_first = 1
      do while (at <= len(p%text))
         code = iachar(p%text(at:at))
         if (code < 128) then
            if (code == 10) then
               line = line + 1
               line_first = at + 1
            end if
            at = at + 1
            cycle
         end if
         follow = -1
         if (code >= 194 .and. code <= 223) follow = 1
         if (code >= 224 .and. code <= 239) follow = 2
         if (code >= 240 .and. code <= 244) follow = 3
         good = follow > 0 .and. at + follow <= len(p%text)
         do k = 1, follow
            if (good) good = iand(iachar(p%text(at + k:at + k)), 192) == 128
         end do
         ! no overlong encoding, no surrogate, nothing beyond the Unicode range
         if (good .and. follow > 1) then
            k = iachar(p%text(at + 1:at + 1))
            good = .not. ((code == 224 .and. k < 160) .or. (code == 237 .and. k > 159) .or. (code == 240 .and. k < 144) &
               & .or. (code == 244 .and. k > 143))
         end if
         if (.not. good) then
            p%line = line
            p%line_first = line_first
            call fail(p, "the text is not UTF-8 here", at)
            return
         end if
         at = at + follow + 1
      end do
      if (index(p%text, char(239) // char(187) // char(191)) == 1) call fail(p, "the text begins with a byte order mark, which &
         &TOML does not have", 1)
   end subroutine check_encoding

   !> Is this a line end, LF or CR-LF?
   pure logical function is_line_end(p)
      class(toml_scanner), intent(in) :: p

      is_line_end = .false.
      if (p%at > len(p%text)) return
      is_line_end = p%text(p%at:p%at) == line_feed
      if (p%text(p%at:p%at) == carriage_return .and. p%at < len(p%text)) is_line_end = p%text(p%at + 1:p%at + 1) == line_feed
   end function is_line_end

   !> Move past a line end
   subroutine next_line(p)
      class(toml_scanner), intent(inout) :: p

      if (p%text(p%at:p%at) == carriage_return) p%at = p%at + 1
      p%at = p%at + 1
      p%line = p%line + 1
      p%line_first = p%at
   end subroutine next_line

   !> Skip blanks and tabs
   pure subroutine skip_blanks(p)
      class(toml_scanner), intent(inout) :: p

      do while (p%at <= len(p%text))
         if (p%text(p%at:p%at) /= " " .and. p%text(p%at:p%at) /= tab) exit
         p%at = p%at + 1
      end do
   end subroutine skip_blanks

   !> Skip the next character if it is the given one; true if it was
   logical function took(p, letter)
      class(toml_scanner), intent(inout) :: p
      !> Expected character
      character, intent(in) :: letter

      took = .false.
      if (p%at > len(p%text)) return
      took = p%text(p%at:p%at) == letter
      if (took) p%at = p%at + 1
   end function took

   !> Skip a comment; control characters are refused
   subroutine skip_comment(p)
      class(toml_scanner), intent(inout) :: p

      if (.not. took(p, "#")) return
      do while (p%at <= len(p%text) .and. .not. is_line_end(p))
         if (is_control(p%text(p%at:p%at))) then
            call fail(p, trim(shown(p)) // " in a comment; only tabs are allowed")
            return
         end if
         p%at = p%at + 1
      end do
   end subroutine skip_comment

   !> Is it a control character other than tab?
   pure logical function is_control(letter)
      character, intent(in) :: letter

      is_control = (iachar(letter) < 32 .and. letter /= tab) .or. iachar(letter) == 127
   end function is_control

   !> Check that only a comment follows a header or a pair
   subroutine end_statement(p)
      class(toml_scanner), intent(inout) :: p

      call skip_blanks(p)
      call skip_comment(p)
      if (allocated(p%error) .or. p%at > len(p%text)) return
      if (.not. is_line_end(p)) then
         call fail(p, trim(shown(p)) // " found where the end of the line is expected; each key or header needs a separate line")
         return
      end if
      call next_line(p)
   end subroutine end_statement

   !> Skip blanks, comments and line ends, as between the values of an array
   subroutine skip_lines(p)
      class(toml_scanner), intent(inout) :: p

      do while (.not. allocated(p%error))
         call skip_blanks(p)
         if (is_line_end(p)) then
            call next_line(p)
         else if (p%at > len(p%text)) then
            return
         else if (p%text(p%at:p%at) == "#") then
            call skip_comment(p)
         else
            return
         end if
      end do
   end subroutine skip_lines

   !> Last character of the word that starts at the next character; one before it if there is none
   pure integer function end_of_word(p, set) result(last)
      class(toml_scanner), intent(in) :: p
      !> Characters of which words consist
      character(len=*), intent(in) :: set

      do last = p%at, len(p%text)
         if (index(set, p%text(last:last)) == 0) exit
      end do
      last = last - 1
   end function end_of_word

   !> Is the next character a quote?
   pure logical function is_quote(p)
      class(toml_scanner), intent(in) :: p

      is_quote = .false.
      if (p%at <= len(p%text)) is_quote = index("""'", p%text(p%at:p%at)) > 0
   end function is_quote

   !> Number of characters to the end of the line, an upper bound of the length of a string
   pure integer function len_of_string(p, start) result(length)
      class(toml_scanner), intent(in) :: p
      integer, intent(in) :: start

      length = index(p%text(start:), line_feed)
      if (length == 0) length = len(p%text) - start + 1
   end function len_of_string

   !> Parse a string in single or double quotes
   subroutine parse_string(p, resolved, first, last)
      class(toml_scanner), intent(inout) :: p
      !> The string, if it has escapes; unallocated otherwise
      character(len=:), allocatable, intent(out) :: resolved
      !> Its first and last character in the text; with escapes the length is that of `resolved`
      integer, intent(out) :: first, last
      character :: quote
      integer :: start, length

      first = 1
      last = 0
      quote = p%text(p%at:p%at)
      start = p%at
      if (p%at + 2 <= len(p%text)) then
         if (p%text(p%at:p%at + 2) == repeat(quote, 3)) then
            call fail(p, "a text over several lines, in three quotes, is not accepted here; write it on one line")
            return
         end if
      end if
      p%at = p%at + 1
      do
         if (p%at > len(p%text) .or. is_line_end(p)) then
            call fail(p, "the text has no closing quote on its line", start)
            return
         end if
         if (p%text(p%at:p%at) == quote) exit
         if (is_control(p%text(p%at:p%at))) then
            call fail(p, trim(shown(p)) // " in a text; only tabs are allowed, and escapes such as \n in double quotes")
            return
         end if
         if (quote == """" .and. p%text(p%at:p%at) == "\") then
            if (.not. allocated(resolved)) then
               allocate(character(len=len_of_string(p, start)) :: resolved)
               length = p%at - start - 1
               resolved(:length) = p%text(start + 1:p%at - 1)
            end if
            call parse_escape(p, resolved, length)
            if (allocated(p%error)) return
            cycle
         end if
         if (allocated(resolved)) then
            length = length + 1
            resolved(length:length) = p%text(p%at:p%at)
         end if
         p%at = p%at + 1
      end do
      if (allocated(resolved)) resolved = resolved(:length)
      first = start + 1
      last = p%at - 1
      p%at = p%at + 1
   end subroutine parse_string

   !> Parse a backslash and the escape that follows
   subroutine parse_escape(p, text, length)
      class(toml_scanner), intent(inout) :: p
      !> String, long enough; the character is appended to its first `length` characters
      character(len=:), allocatable, intent(inout) :: text
      integer, intent(inout) :: length
      character(len=*), parameter :: names = "btnfr""\", hexadecimal = "0123456789abcdef0123456789ABCDEF"
      integer, parameter :: codes(7) = [8, 9, 10, 12, 13, 34, 92]
      integer :: code, k, which, width

      which = 0
      width = 0
      if (p%at < len(p%text)) then
         which = index(names, p%text(p%at + 1:p%at + 1))
         if (p%text(p%at + 1:p%at + 1) == "u") width = 4
         if (p%text(p%at + 1:p%at + 1) == "U") width = 8
      end if
      if (which > 0) then
         call add_byte(codes(which))
         p%at = p%at + 2
         return
      end if
      code = 0
      do k = 1, width
         which = 0
         if (p%at + 1 + k <= len(p%text)) which = index(hexadecimal, p%text(p%at + 1 + k:p%at + 1 + k))
         if (which == 0 .or. code >= 1114112) then
            width = 0
            exit
         end if
         code = 16*code + modulo(which - 1, 16)
      end do
      if (width == 0 .or. code >= 1114112 .or. (code >= 55296 .and. code < 57344)) then
         call fail(p, "unknown escape; accepted: \b, \t, \n, \f, \r, \"", \\, \uXXXX, \UXXXXXXXX; or use single quotes, " // &
            & "where a backslash has no meaning")
         return
      end if
      p%at = p%at + 2 + width
      if (code < 128) then
         call add_byte(code)
      else if (code < 2048) then
         call add_byte(192 + code/64)
         call add_byte(128 + modulo(code, 64))
      else if (code < 65536) then
         call add_byte(224 + code/4096)
         call add_byte(128 + modulo(code/64, 64))
         call add_byte(128 + modulo(code, 64))
      else
         call add_byte(240 + code/262144)
         call add_byte(128 + modulo(code/4096, 64))
         call add_byte(128 + modulo(code/64, 64))
         call add_byte(128 + modulo(code, 64))
      end if

   contains

      !> Append one byte
      subroutine add_byte(value)
         integer, intent(in) :: value

         length = length + 1
         text(length:length) = char(value)
      end subroutine add_byte
   end subroutine parse_escape
end module contact_toml_scanner
