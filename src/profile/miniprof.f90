!> Miniprof profiles, .ban for rails and .whl for wheels, and plain tables of two columns
!>
!> Lines KEY=value up to the first blank line, followed by rows of numbers; text after the numbers of a row is ignored. A header
!> of another kind starts with a line of text without "=" and extends to the next blank line. A file without a header is a
!> table. Comments start with ! " % or #.
module contact_profile_miniprof
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_line, only : end_of_values, file_place, leading_numbers, max_columns, point_list, read_row, &
      & split_assignment
   use contact_profile_request, only : profile_file
   use contact_text_lexer, only : input_lexer
   use contact_text_line_words, only : printable
   use contact_text_words, only : integer_text, small
   implicit none (type, external)
   private

   public :: read_miniprof

   !> Maximum number of messages of one kind per file
   integer, parameter :: max_messages = 4
   !> Permitted columns: lateral, vertical, angle, curvature, number, yield strength
   character(len=*), parameter :: column_letters = "XYACNK"
   !> Keys of the header that matter
   character(len=*), parameter :: known_keys(5) = [character(len=9) :: "ColumnDef", "XOffset", "YOffset", "Units", "Tilt"]

contains

   !> Read the points, and what the header prescribes
   !>
   !> Long because the parts of the file share what was read so far; each is an internal procedure of at most 28 lines.
   subroutine read_miniprof(text, profile, log, error)
      !> The complete file
      type(input_lexer), intent(in) :: text
      !> Points with their lines, and settings of the header
      type(profile_file), intent(out) :: profile
      !> Receives warnings about unused header entries
      type(log_type), intent(inout) :: log
      !> Gives file, line and what is accepted
      type(error_type), allocatable, intent(out) :: error
      type(file_place) :: place
      type(point_list) :: points
      character(len=:), allocatable :: line, key, value, columns
      real(wp) :: row(max_columns)
      integer :: n, skipped, header_end, numberlike
      logical :: assigned, blank_seen, header_seen, extra_seen, text_seen, text_follows

      columns = ""
      header_end = 0
      text_seen = .false.
      skipped = 0
      numberlike = 0
      blank_seen = .false.
      header_seen = .false.
      extra_seen = .false.
      place%file = text%file
      do while (place%line < text%count_lines())
         place%line = place%line + 1
         line = text%line_text(place%line)
         if (len_trim(line) == 0) blank_seen = .true.
         line = line(:end_of_values(line, '!"%#'))
         if (len_trim(line) == 0 .or. place%line < header_end) cycle
         call split_assignment(line, key, value, assigned)
         call leading_numbers(line, n, text_follows)
         ! any text may follow the numbers of a point
         assigned = assigned .and. .not. (points%n > 0 .and. n >= 2)
         if (assigned) then
            if (points%n > 0) then
               call fatal_error(error, '"' // printable(key) // '" follows the first point; expected rows of numbers', &
                  & file=text%file, line=place%line, column=verify(line, " "))
            else
               header_seen = .true.
               call read_key()
            end if
         else if (points%n == 0 .and. (n == 0 .or. text_follows .and. n < 2)) then
            if (numberlike == 0 .and. scan(adjustl(line), "+-.0123456789") == 1) numberlike = place%line
            call find_header_end()
         else
            if (points%n == 0 .and. header_seen .and. .not. blank_seen) call log%warning(text%file // ", line " // &
               & integer_text(place%line) // ": points begin without a blank line before.")
            call read_point()
         end if
         if (allocated(error)) return
      end do
      if (skipped > max_messages) call log%warning(text%file // ": " // integer_text(skipped) // " rows were skipped.")
      if (points%n == 0 .and. numberlike > 0) then
         line = text%line_text(numberlike)
         call fatal_error(error, "no point was found; """ // printable(trim(line)) // """ is not one: expected two numbers y z &
            &with decimal points, separated by blanks, tabs or a comma", file=text%file, line=numberlike)
         return
      end if
      call points%get(profile%y, profile%z, profile%line)

   contains

      !> Find the end of a header that starts with a line of text. The heading of a table, not separated from the points by a
      !> blank line, is that line only
      subroutine find_header_end()
         character(len=:), allocatable :: later
         integer :: i, rows, numbers
         logical :: more

         header_end = 0
         rows = 0
         do i = place%line + 1, text%count_lines()
            later = text%line_text(i)
            if (len_trim(later) == 0 .and. header_end == 0) then
               header_end = i
               numbers = rows
               rows = 0
            end if
            later = later(:end_of_values(later, '!"%#'))
            call leading_numbers(later, n, more)
            if (n >= 2) rows = rows + 1
         end do
         ! the rows after the blank line are the points
         if (header_end == 0) return
         if (rows == 0) then
            header_end = 0
         else if (numbers > 0) then
            call log%warning(text%file // ", line " // integer_text(place%line) // ": text without = starts a header, which &
               &ends at the blank line " // integer_text(header_end) // "; " // integer_text(numbers) // " rows of numbers in it &
               &are not points.")
         end if
      end subroutine find_header_end

      subroutine read_key()
         select case (key)
         case ("ColumnDef")
            call read_columns()
         case ("XOffset", "Xoffset")
            call read_offset(profile%shift_y)
         case ("YOffset", "Yoffset")
            call read_offset(profile%shift_z)
         case ("Units")
            if (.not. any(value == [character(len=11) :: "", "mm", "MM", "Mm", "millimetre", "millimeter", "millimetres", &
               & "millimeters"])) then
               profile%unit_name = value
               profile%unit_line = place%line
            end if
         case ("Tilt")
            call read_row(value, place, "one number for Tilt", row, n, error, enough=0)
            if (.not. allocated(error) .and. abs(row(1)) > 0.0_wp) call log%warning(text%file // ", line " // &
               & integer_text(place%line) // ": Tilt = " // printable(value) // " is not applied; points are used as given &
               &(rotate a rail by CANT or ROLL).")
         case default
            call warn_of_spelling()
         end select
      end subroutine read_key

      !> Warn of a key that differs from one of those above in capital and small letters only: it is ignored
      subroutine warn_of_spelling()
         integer :: k

         do k = 1, size(known_keys)
            if (small(key) == small(trim(known_keys(k)))) call log%warning(text%file // ", line " // &
               & integer_text(place%line) // ": the key " // printable(key) // " is unknown and ignored; it is spelled " // &
               & trim(known_keys(k)) // ".")
         end do
      end subroutine warn_of_spelling

      subroutine read_offset(offset)
         real(wp), intent(inout) :: offset

         if (len(value) == 0) return
         call read_row(repeat(" ", index(line, "=")) // line(index(line, "=") + 1:), place, "one number for " // key, row, n, &
            & error)
         if (.not. allocated(error)) offset = row(1)
      end subroutine read_offset

      subroutine read_columns()
         integer :: i

         columns = ""
         do i = 1, len(value)
            if (scan(value(i:i), " ,") == 1) cycle
            columns = columns // value(i:i)
            if (scan(value(i:i), column_letters // "*") == 0) exit
         end do
         if (verify(columns, column_letters // "*") > 0 .or. index(columns, "X") == 0 .or. index(columns, "Y") == 0 &
            & .or. len(columns) > max_columns) then
            call fatal_error(error, "ColumnDef=" // printable(value) // " cannot be used; expected letters of " // &
               & column_letters // " with X and Y among them, separated by commas", file=text%file, line=place%line)
         end if
      end subroutine read_columns

      subroutine read_point()
         call read_row(line, place, "a point, numbers y z", row, n, error, enough=2)
         if (allocated(error)) return
         if (text_follows .and. .not. text_seen) call log%warning(text%file // ", line " // integer_text(place%line) // &
            & ": text after the numbers is ignored, here and in later rows.")
         text_seen = text_seen .or. text_follows
         if (len(columns) > 0) then
            if (n == len(columns)) then
               call points%add(row(index(columns, "X")), row(index(columns, "Y")), place%line)
               return
            end if
            skipped = skipped + 1
            if (skipped <= max_messages) call log%warning(text%file // ", line " // integer_text(place%line) // &
               & ": a row of " // integer_text(n) // " numbers is skipped; ColumnDef defines " // &
               & integer_text(len(columns)) // ".")
         else if (n == 1) then
            call fatal_error(error, 'a single number, "' // printable(line) // '"; expected a point, numbers y z', &
               & file=text%file, line=place%line, column=verify(line, " "))
         else
            if (n > 2 .and. .not. extra_seen) call log%warning(text%file // ", line " // integer_text(place%line) // &
               & ": of " // integer_text(n) // " columns the first two are used (decimals need a point, not a &
               &comma).")
            extra_seen = extra_seen .or. n > 2
            call points%add(row(1), row(2), place%line)
         end if
      end subroutine read_point
   end subroutine read_miniprof
end module contact_profile_miniprof
