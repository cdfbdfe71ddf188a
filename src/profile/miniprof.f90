!> Miniprof profiles, .ban for rails and .whl for wheels, and plain tables of two columns
!>
!> Lines KEY=value up to the first blank line, then rows of numbers. A file without a header is a table.
!> Comments begin with ! " % or #.
module contact_profile_miniprof
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_line, only : file_place, is_numeric, most_columns, point_list, read_row, split_assignment, &
      & end_of_values
   use contact_profile_request, only : profile_file
   use contact_text_lexer, only : input_lexer, printable
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_miniprof

   !> Messages of one kind per file
   integer, parameter :: most_messages = 4
   !> What columns may hold: lateral, vertical, angle, curvature, number, yield strength
   character(len=*), parameter :: column_letters = "XYACNK"

contains

   subroutine read_miniprof(text, profile, log, error)
      type(input_lexer), intent(in) :: text
      type(profile_file), intent(out) :: profile
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(file_place) :: place
      type(point_list) :: points
      character(len=:), allocatable :: line, key, value, columns
      real(wp) :: row(most_columns)
      integer :: n, skipped
      logical :: assigned, blank_seen, header_seen, extra_seen

      columns = ""
      skipped = 0
      blank_seen = .false.
      header_seen = .false.
      extra_seen = .false.
      place%file = text%file
      do while (place%line < text%count_lines())
         place%line = place%line + 1
         line = text%line_text(place%line)
         if (len_trim(line) == 0) blank_seen = .true.
         line = line(:end_of_values(line, '!"%#'))
         if (len_trim(line) == 0) cycle
         call split_assignment(line, key, value, assigned)
         if (assigned) then
            if (points%n > 0) then
               call fatal_error(error, '"' // printable(key) // '" stands behind the first point; expected rows of numbers', &
                  & file=text%file, line=place%line, column=verify(line, " "))
            else
               header_seen = .true.
               call take_key()
            end if
         else if (points%n > 0 .or. is_numeric(line)) then
            if (points%n == 0 .and. header_seen .and. .not. blank_seen) call log%warning(text%file // ", line " // &
               & integer_text(place%line) // ": points begin without a blank line before.")
            call take_point()
         end if
         if (allocated(error)) return
      end do
      if (skipped > most_messages) call log%warning(text%file // ": " // integer_text(skipped) // " rows were skipped.")
      if (points%n > 0) then
         profile%y = points%y(:points%n)
         profile%z = points%z(:points%n)
      else
         allocate(profile%y(0), profile%z(0))
      end if

   contains

      subroutine take_key()
         select case (key)
         case ("ColumnDef")
            call take_columns()
         case ("XOffset", "Xoffset")
            call take_offset(profile%shift_y)
         case ("YOffset", "Yoffset")
            call take_offset(profile%shift_z)
         end select
      end subroutine take_key

      subroutine take_offset(offset)
         real(wp), intent(inout) :: offset

         if (len(value) == 0) return
         call read_row(repeat(" ", index(line, "=")) // line(index(line, "=") + 1:), place, "one number for " // key, row, n, &
            & error)
         if (.not. allocated(error)) offset = row(1)
      end subroutine take_offset

      subroutine take_columns()
         integer :: i

         columns = ""
         do i = 1, len(value)
            if (scan(value(i:i), " ,") == 1) cycle
            columns = columns // value(i:i)
            if (scan(value(i:i), column_letters // "*") == 0) exit
         end do
         if (verify(columns, column_letters // "*") > 0 .or. index(columns, "X") == 0 .or. index(columns, "Y") == 0 &
            & .or. len(columns) > most_columns) then
            call fatal_error(error, "ColumnDef=" // printable(value) // " cannot be used; expected letters of " // &
               & column_letters // " with X and Y among them, separated by commas", file=text%file, line=place%line)
         end if
      end subroutine take_columns

      subroutine take_point()
         call read_row(line, place, "a point, numbers y z", row, n, error)
         if (allocated(error)) return
         if (len(columns) > 0) then
            if (n == len(columns)) then
               call points%add(row(index(columns, "X")), row(index(columns, "Y")))
               return
            end if
            skipped = skipped + 1
            if (skipped <= most_messages) call log%warning(text%file // ", line " // integer_text(place%line) // &
               & ": a row of " // integer_text(n) // " numbers is skipped; ColumnDef promises " // &
               & integer_text(len(columns)) // ".")
         else if (n == 1) then
            call fatal_error(error, 'one number alone, "' // printable(line) // '"; expected a point, numbers y z', &
               & file=text%file, line=place%line, column=verify(line, " "))
         else
            if (n > 2 .and. .not. extra_seen) call log%warning(text%file // ", line " // integer_text(place%line) // &
               & ": of " // integer_text(n) // " columns the first two are used (numbers need points, not commas, before &
               &their decimals).")
            extra_seen = extra_seen .or. n > 2
            call points%add(row(1), row(2))
         end if
      end subroutine take_point
   end subroutine read_miniprof
end module contact_profile_miniprof
