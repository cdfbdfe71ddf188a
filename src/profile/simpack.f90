!> Simpack profiles: .prr for rails, .prw for wheels
!>
!> A block header.begin ... header.end, and a block spline.begin ... spline.end with the processing, which contains a block
!> point.begin ... point.end with rows y z [weight]. Comments start with ! or %.
module contact_profile_simpack
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_profile_line, only : end_of_values, file_place, max_columns, point_list, read_row, split_assignment
   use contact_profile_request, only : profile_file, profile_side
   use contact_text_lexer, only : input_lexer
   use contact_text_line_words, only : printable
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: read_simpack

   type :: section_list
      integer :: none = 0, header = 1, spline = 2, point = 3
   end type section_list
   type(section_list), parameter :: section = section_list()
   character(len=*), parameter :: section_names(0:3) = [character(len=6) :: "", "header", "spline", "point"]

   !> Minimum distance between points that a file may request
   real(wp), parameter :: smallest_distance = 1.0e-6_wp
   !> Maximum number of messages of one kind per file
   integer, parameter :: max_messages = 4

contains

   !> Read the points and the processing
   !>
   !> Long because the parts of the file share what was read so far; each is an internal procedure of at most 43 lines.
   subroutine read_simpack(text, side, profile, log, error)
      !> The complete file
      type(input_lexer), intent(in) :: text
      !> Member of profile_side
      integer, intent(in) :: side
      !> Points with their lines, and the prescribed processing
      type(profile_file), intent(out) :: profile
      !> Receives warnings about unused keywords
      type(log_type), intent(inout) :: log
      !> Gives file, line and what is accepted
      type(error_type), allocatable, intent(out) :: error
      type(file_place) :: place
      type(point_list) :: points
      character(len=:), allocatable :: line, key, value
      real(wp) :: row(max_columns), rotation, angle_unit, length_unit
      integer :: now, n, skipped, rotation_line
      logical :: assigned, finished

      rotation_line = 0
      now = section%none
      skipped = 0
      rotation = 0.0_wp
      angle_unit = 1.0_wp
      length_unit = 1.0_wp
      finished = .false.
      profile%guess_z = .false.
      place%file = text%file
      do while (place%line < text%count_lines() .and. .not. finished)
         place%line = place%line + 1
         line = text%line_text(place%line)
         line = line(:end_of_values(line, "!%"))
         if (len_trim(line) == 0) cycle
         call split_assignment(line, key, value, assigned)
         if (assigned) then
            call read_assignment(key, value)
         else if (now == section%point .and. index(line, ".begin") == 0 .and. index(line, ".end") == 0) then
            call read_point()
         else
            call change_section(trim(adjustl(line)))
         end if
         if (allocated(error)) return
      end do
      if (.not. finished) then
         call fatal_error(error, "the end of the file is reached; expected spline.end", file=text%file, line=place%line)
         return
      end if
      profile%rotation = rotation/angle_unit
      if (abs(profile%rotation) > pi) then
         call fatal_error(error, "rotate = " // real_text(rotation) // " is an angle of " // real_text(profile%rotation) // &
            & " rad; expected at most pi (are units.ang.f per radian?)", file=text%file, line=rotation_line)
         return
      end if
      profile%units_per_mm = length_unit/1000.0_wp
      if (skipped > max_messages) call log%warning(text%file // ": " // integer_text(skipped) // " rows were skipped.")
      call points%get(profile%y, profile%z, profile%line)

   contains

      subroutine read_point()
         call read_row(line, place, "a point, two or three numbers y z [weight]", row, n, error)
         if (allocated(error)) return
         if (n == 2 .or. n == 3) then
            call points%add(row(1), row(2), place%line)
            return
         end if
         skipped = skipped + 1
         if (skipped <= max_messages) call log%warning(text%file // ", line " // integer_text(place%line) // &
            & ": a row of " // integer_text(n) // " numbers is skipped; points have two or three, y z [weight].")
      end subroutine read_point

      subroutine change_section(word)
         character(len=*), intent(in) :: word
         integer :: expected_now, next

         select case (word)
         case ("header.begin")
            expected_now = section%none
            next = section%header
         case ("header.end")
            expected_now = section%header
            next = section%none
         case ("spline.begin")
            expected_now = section%none
            next = section%spline
         case ("spline.end")
            expected_now = section%spline
            next = section%none
            finished = .true.
         case ("point.begin")
            expected_now = section%spline
            next = section%point
         case ("point.end")
            expected_now = section%point
            next = section%spline
         case default
            call fatal_error(error, 'unknown word "' // printable(word) // '"; accepted: header.begin, header.end, &
               &spline.begin, point.begin, point.end, spline.end, or key = value', file=text%file, line=place%line, &
               & column=verify(line, " "))
            return
         end select
         if (now /= expected_now) then
            if (now == section%none) then
               call fatal_error(error, word // " is outside its block; expected header.begin or spline.begin", &
                  & file=text%file, line=place%line, column=verify(line, " "))
            else
               call fatal_error(error, word // " is inside the block " // trim(section_names(now)) // "; expected " // &
                  & trim(section_names(now)) // ".end first", file=text%file, line=place%line, column=verify(line, " "))
            end if
            finished = .false.
            return
         end if
         now = next
      end subroutine change_section

      subroutine read_assignment(key, value)
         character(len=*), intent(in) :: key, value
         real(wp) :: number

         select case (now)
         case (section%header)
            call one_number(key, value, number)
            if (allocated(error) .or. key /= "type") return
            if (side == profile_side%rail .and. number /= 0.0_wp) then
               call fatal_error(error, "type = " // real_text(number) // ", but a rail is required; expected 0", &
                  & file=text%file, line=place%line)
            else if (side == profile_side%wheel .and. number /= 1.0_wp) then
               call fatal_error(error, "type = " // real_text(number) // ", but a wheel is required; expected 1", &
                  & file=text%file, line=place%line)
            end if
         case (section%spline, section%point)
            select case (key)
            case ("file", "file.mtime", "comment", "type", "units.len", "units.ang")
               return
            case ("approx.smooth", "point.dist.min", "shift.y", "shift.z", "rotate", "bound.y.min", "bound.y.max", &
               & "bound.z.min", "bound.z.max", "mirror.y", "mirror.z", "inversion", "units.len.f", "units.ang.f")
               call one_number(key, value, number)
               if (.not. allocated(error)) call store(key, number)
            case default
               call log%warning(text%file // ", line " // integer_text(place%line) // ': the key "' // printable(key) // &
                  & '" is unknown and ignored.')
            end select
         case default
            call fatal_error(error, '"' // printable(key) // '" is outside the blocks header and spline', &
               & file=text%file, line=place%line, column=verify(line, " "))
         end select
      end subroutine read_assignment

      subroutine one_number(key, value, number)
         character(len=*), intent(in) :: key, value
         real(wp), intent(out) :: number

         call read_row(repeat(" ", index(line, "=")) // line(index(line, "=") + 1:), place, "one number for " // key, row, n, &
            & error)
         number = row(1)
         if (allocated(error) .or. n == 1) return
         call fatal_error(error, key // " has " // integer_text(n) // ' values, "' // printable(value) // &
            & '"; expected one number', file=text%file, line=place%line)
      end subroutine one_number

      subroutine store(key, number)
         character(len=*), intent(in) :: key
         real(wp), intent(in) :: number

         select case (key)
         case ("point.dist.min"); profile%nearest = max(smallest_distance, number)
         case ("shift.y"); profile%shift_y = number
         case ("shift.z"); profile%shift_z = number
         case ("rotate")
            rotation = number
            rotation_line = place%line
         case ("bound.y.min"); profile%lower_y = number
         case ("bound.y.max"); profile%upper_y = number
         case ("bound.z.min"); profile%lower_z = number
         case ("bound.z.max"); profile%upper_z = number
         case ("mirror.y"); profile%mirror_y = number == 1.0_wp
         case ("mirror.z"); profile%mirror_z = number == 1.0_wp
         case ("inversion"); profile%inversion = merge(1, 0, number == 1.0_wp)
         case ("units.len.f", "units.ang.f")
            if (number <= 0.0_wp) then
               call fatal_error(error, key // " = " // real_text(number) // " is not possible; expected a positive number", &
                  & file=text%file, line=place%line)
            else if (key == "units.len.f") then
               length_unit = number
            else
               angle_unit = number
            end if
         end select
      end subroutine store
   end subroutine read_simpack
end module contact_profile_simpack
