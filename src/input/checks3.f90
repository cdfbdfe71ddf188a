!> Checks of a case of module 3 that need the digits, the numbers and the previous case together
module contact_input_checks3
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec, part_source
   use contact_input_control, only : add_for_digit, control_words
   use contact_cases_archive, only : case_archive
   use contact_input_grid_frame, only : frame_of, grid_frame
   use contact_input_problems, only : problem_list, severity
   use contact_text_words, only : integer_text, real_text
   use contact_cases_distance, only : distance_form
   implicit none (type, external)
   private

   public :: check_case

   !> Relative difference of element sides that still count as equal [-]
   real(wp), parameter :: same_side = 1.0e-4_wp
   !> Distance from a whole number of elements that still counts as a match, in elements [-]
   real(wp), parameter :: same_place = 1.0e-3_wp

contains

   !> All checks after the groups have been read
   subroutine check_case(words, a, previous, has_previous, coefficients, spec, problems)
      type(control_words), intent(in) :: words
      !> The reader of the groups, which knows where they are
      class(case_archive), intent(in) :: a
      !> The previous case of this result element
      type(case_spec), intent(in) :: previous
      !> Is there one?
      logical, intent(in) :: has_previous
      !> Grid for which influence coefficients were last formed; mx = 0 when there are none
      type(grid_frame), intent(in) :: coefficients
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      type(grid_frame) :: frame

      frame = frame_of(spec%grid)
      call check_hertz_options(words, a, spec, problems)
      if (words%digits%d /= 0 .and. words%digits%c == 0) call check_kept_coefficients(words, a, frame, coefficients, problems)
      if (.not. has_previous .and. words%digits%z == 1 .and. spec%grid%needs_geometry()) call add_for_digit(problems, words, &
         & severity%error, "Z", "Z = 1 forms the undeformed distance from the values in store, but this is the first case; " // &
         & "Z = 2 reads it")
      if (.not. has_previous) return
      if (words%digits%d == 2) call check_continuation(words, a, frame, frame_of(previous%grid), problems)
      call check_kept_lists(words, frame, frame_of(previous%grid), spec, problems)
   end subroutine check_case

   !> Line of the grid group; of the digit D when the grid is kept
   pure integer function grid_line(words, a) result(line)
      type(control_words), intent(in) :: words
      !> The reader of the groups, which knows where they are
      class(case_archive), intent(in) :: a

      line = a%line_of("grid")
      if (line == 0) line = words%word(2)%line
   end function grid_line

   !> What the B, N and M digits demand of IPOTCN and the kinematics
   subroutine check_hertz_options(words, a, spec, problems)
      type(control_words), intent(in) :: words
      !> The reader of the groups, which knows where they are
      class(case_archive), intent(in) :: a
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      character(len=:), allocatable :: option, pressure
      integer :: line

      line = grid_line(words, a)
      option = "IPOTCN = " // integer_text(spec%grid%form)
      pressure = "B = " // integer_text(words%digits%b)
      associate (ipotcn => spec%grid%form, b => words%digits%b, n => words%digits%n)
         if (ipotcn >= 1 .and. (b == 2 .or. b == 3)) call problems%add(severity%error, option // " cannot be used with " // &
            & pressure // ", which needs a Hertzian option: IPOTCN = -5 to -1", line)
         if ((ipotcn == -6) .neqv. (b == 4)) call problems%add(severity%error, option // " cannot be used with " // &
            & pressure // ": IPOTCN = -6 and B = 4 need each other", line)
         if (ipotcn == -4 .or. ipotcn == -5) then
            if (n /= 1) call problems%add(severity%error, option // ", a two-dimensional Hertz contact, needs the normal " // &
               & "force: N = 1, not N = " // integer_text(n), line)
            if (n == 1 .and. (b == 2 .or. b == 3)) call problems%add(severity%warning, option // " with " // pressure // &
               & ": the approach is not computed", line)
         end if
         if (ipotcn >= -5 .and. ipotcn <= -1 .and. n == 0 .and. spec%kinematics%pen < 0.0_wp) call problems%add( &
            & severity%error, "PEN = " // real_text(spec%kinematics%pen) // " is below its lower bound 0 for a Hertzian " // &
            & "option, " // option, a%line_of("kinematics"))
         if (b == 3 .and. words%digits%m <= 1) call add_for_digit(problems, words, severity%warning, "B", &
            & "B = 3, a parabolic traction bound, is meant for simplified theory, M = 2, 3 or 5, not for M = " // &
            & integer_text(words%digits%m))
      end associate
   end subroutine check_hertz_options

   !> A new grid must fit the influence coefficients that are kept
   subroutine check_kept_coefficients(words, a, frame, coefficients, problems)
      type(control_words), intent(in) :: words
      !> The reader of the groups, which knows where they are
      class(case_archive), intent(in) :: a
      !> The grid, and the one of the coefficients
      type(grid_frame), intent(in) :: frame, coefficients
      type(problem_list), intent(inout) :: problems

      if (coefficients%mx == 0) return
      call check_side("DX", frame%dx, coefficients%dx)
      call check_side("DY", frame%dy, coefficients%dy)
      call check_number("MX", frame%mx, coefficients%mx)
      call check_number("MY", frame%my, coefficients%my)

   contains

      !> Sides must agree
      subroutine check_side(name, side, stored)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: side, stored

         if (.not. (frame%is_known .and. coefficients%is_known)) return
         if (abs(side - stored) > same_side*stored) call problems%add(severity%error, name // " = " // real_text(side) // &
            & " differs from the " // real_text(stored) // " of the influence coefficients that C = 0 keeps", &
            & grid_line(words, a))
      end subroutine check_side

      !> There must be enough coefficients
      subroutine check_number(name, number, stored)
         character(len=*), intent(in) :: name
         integer, intent(in) :: number, stored

         if (number > stored) call problems%add(severity%error, name // " = " // integer_text(number) // &
            & " is above its upper bound, the " // integer_text(stored) // " of the influence coefficients that C = 0 keeps", &
            & grid_line(words, a))
      end subroutine check_number
   end subroutine check_kept_coefficients

   !> A grid that takes over a solution must consist of the same elements
   !>
   !> Looser than the original program, as the user guide says: 0.01 % in the sides of an element,
   !> 0.1 % of a side in the shift.
   subroutine check_continuation(words, a, frame, old, problems)
      type(control_words), intent(in) :: words
      !> The reader of the groups, which knows where they are
      class(case_archive), intent(in) :: a
      !> The grid, and the one of the previous case
      type(grid_frame), intent(in) :: frame, old
      type(problem_list), intent(inout) :: problems

      if (words%digits%p == 2 .and. words%digits%i == 0) return
      if (.not. (frame%is_known .and. old%is_known)) return
      call check_direction("DX", "XC1", frame%dx, old%dx, frame%xc1 - old%xc1)
      call check_direction("DY", "YC1", frame%dy, old%dy, frame%yc1 - old%yc1)

   contains

      !> Side of the elements, and shift of the first one
      subroutine check_direction(side_name, place_name, side, old_side, shift)
         character(len=*), intent(in) :: side_name, place_name
         real(wp), intent(in) :: side, old_side, shift

         if (abs(side - old_side) > same_side*old_side) then
            call problems%add(severity%error, side_name // " = " // real_text(side) // " differs from the " // &
               & real_text(old_side) // " of the previous case, whose solution is used (P = " // &
               & integer_text(words%digits%p) // ", I = " // integer_text(words%digits%i) // ")", grid_line(words, a))
         else if (abs(shift/side - anint(shift/side)) > same_place) then
            call problems%add(severity%error, place_name // ", the centre of the first element, moves by " // &
               & real_text(shift) // ", which is not a whole multiple of " // side_name // " = " // real_text(side) // &
               & "; the solution of the previous case cannot be used (P = " // integer_text(words%digits%p) // ", I = " // &
               & integer_text(words%digits%i) // ")", grid_line(words, a))
         end if
      end subroutine check_direction
   end subroutine check_continuation

   !> Lists with one entry per element cannot be kept on another grid
   subroutine check_kept_lists(words, frame, old, spec, problems)
      type(control_words), intent(in) :: words
      !> The grid, and the one of the previous case
      type(grid_frame), intent(in) :: frame, old
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      if (spec%geometry%form == distance_form%elementwise .and. spec%parts%geometry /= part_source%given) then
         if (.not. is_same()) call add_for_digit(problems, words, severity%error, "Z", "Z = " // &
            & integer_text(words%digits%z) // " keeps the undeformed distances of IBASE = 9, one per element, " // &
            & "but the grid is not the one they were given for")
      end if
      if (words%digits%e == 1 .and. allocated(spec%extra_slip)) then
         if (.not. is_same()) call add_for_digit(problems, words, severity%error, "E", "E = 1 keeps the extra rigid " // &
            & "slip, one per element, but the grid is not the one it was given for")
      end if

   contains

      !> Do both grids consist of the same elements, as far as the input tells?
      pure logical function is_same()
         is_same = words%digits%d /= 2
         if (is_same) return
         is_same = frame%mx == old%mx .and. frame%my == old%my
         if (.not. (is_same .and. frame%is_known .and. old%is_known)) return
         is_same = abs(frame%dx - old%dx) <= same_side*old%dx .and. abs(frame%dy - old%dy) <= same_side*old%dy &
            & .and. abs(frame%xc1 - old%xc1) <= same_place*old%dx .and. abs(frame%yc1 - old%yc1) <= same_place*old%dy
      end function is_same
   end subroutine check_kept_lists
end module contact_input_checks3
