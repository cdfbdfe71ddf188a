!> Checks of a case that depend on its digits, its numbers and the previous case together
!>
!> The requirements and their reasons are in contact_cases_rules and contact_cases_continuation; here they are reported with their
!> position in the input.
module contact_input_checks
   use contact_base_choices, only : estimate_choice, time_link
   use contact_base_error, only : error_kind
   use contact_cases_archive, only : case_archive
   use contact_cases_continuation, only : describe_coefficients, describe_grid, describe_search, frame_of, keeps_elements
   use contact_cases_distance, only : distance_form
   use contact_cases_rules, only : describe_number, is_missed, number_rules
   use contact_cases_spec, only : case_spec, part_source
   use contact_grid_potential_contact, only : potential_contact
   use contact_input_control, only : add_for_digit, check_physics, control_words
   use contact_input_kept_numbers, only : check_kept_numbers
   use contact_input_problems, only : problem_list, severity
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: check_case

contains

   !> All checks after the groups have been read
   subroutine check_case(words, a, previous, has_previous, coefficients, spec, problems)
      type(control_words), intent(in) :: words
      !> Reader of the groups, with their positions
      class(case_archive), intent(in) :: a
      !> The previous case of this result element
      type(case_spec), intent(in) :: previous
      !> Is there one?
      logical, intent(in) :: has_previous
      !> Grid for which influence coefficients were last computed; mx = 0: none
      type(potential_contact), intent(in) :: coefficients
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      character(len=:), allocatable :: text
      integer :: k

      call check_physics(words, spec, problems, line_of_grid=grid_line(words, a))
      if (has_previous) call check_kept_numbers(words, spec, problems)
      do k = 1, size(number_rules)
         if (.not. is_missed(number_rules(k), spec)) cycle
         call describe_number(number_rules(k), spec, text)
         call problems%add(merge(severity%error, severity%unsupported, number_rules(k)%kind == error_kind%input), text, &
            & line_or_word(words, a, trim(number_rules(k)%group)))
      end do
      if (.not. allocated(spec%wheel_rail)) then
         call check_grid(words, a, previous, has_previous, coefficients, spec, problems)
      else if (has_previous .and. spec%link /= time_link%initiate) then
         call describe_search(spec%motion, spec%wheel_rail%search, previous%wheel_rail%search, text)
         if (allocated(text)) call add_for_digit(problems, words, severity%error, "D", text // &
            & "; the same values, or a new sequence, P = 2")
      end if
   end subroutine check_case

   !> Requirements on a grid that is kept or renewed
   subroutine check_grid(words, a, previous, has_previous, coefficients, spec, problems)
      type(control_words), intent(in) :: words
      !> Reader of the groups, with their positions
      class(case_archive), intent(in) :: a
      !> The previous case, and whether there is one
      type(case_spec), intent(in) :: previous
      logical, intent(in) :: has_previous
      !> Grid for which influence coefficients were last computed
      type(potential_contact), intent(in) :: coefficients
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      type(potential_contact) :: frame, old
      character(len=:), allocatable :: text

      frame = frame_of(spec%grid)
      if (words%digits%d /= 0 .and. words%digits%c == 0) then
         call describe_coefficients(frame, coefficients, text)
         if (allocated(text)) call problems%add(severity%error, text // " (C = 0)", grid_line(words, a))
      end if
      if (.not. has_previous) then
         if (words%digits%z == 1 .and. spec%grid%needs_geometry()) call add_for_digit(problems, words, severity%error, "Z", &
            & "Z = 1 forms the undeformed distance from the values in store, but this is the first case; Z = 2 reads it")
         return
      end if
      old = frame_of(previous%grid)
      if (words%digits%d == 2 .and. .not. (spec%link == time_link%initiate .and. spec%estimate == estimate_choice%fresh)) then
         call describe_grid(frame, old, text)
         if (allocated(text)) call problems%add(severity%error, text // " (P = " // integer_text(words%digits%p) // &
            & ", I = " // integer_text(words%digits%i) // ")", grid_line(words, a))
      end if
      if (words%digits%d /= 2 .or. keeps_elements(frame, old)) return
      ! lists with one entry per element
      if (spec%geometry%form == distance_form%elementwise .and. spec%parts%geometry /= part_source%given) &
         & call add_for_digit(problems, words, severity%error, "Z", "Z = " // integer_text(words%digits%z) // &
         & " keeps the undeformed distances of IBASE = 9, one per element, but the grid is not the one they were given for")
      if (words%digits%e == 1 .and. allocated(spec%extra_slip)) call add_for_digit(problems, words, severity%error, "E", &
         & "E = 1 keeps the extra rigid slip, one per element, but the grid is not the one it was given for")
   end subroutine check_grid

   !> Line of the grid group; that of the digit D if the grid is kept
   pure integer function grid_line(words, a)
      type(control_words), intent(in) :: words
      !> Reader of the groups, with their positions
      class(case_archive), intent(in) :: a

      grid_line = line_or_word(words, a, "grid")
   end function grid_line

   !> Line of a group; that of the second control word if the group is kept
   pure integer function line_or_word(words, a, group) result(line)
      type(control_words), intent(in) :: words
      !> Reader of the groups, with their positions
      class(case_archive), intent(in) :: a
      character(len=*), intent(in) :: group

      line = a%line_of(group)
      if (line == 0) line = words%word(2)%line
   end function line_or_word
end module contact_input_checks
