!> The control words of a case of module 1 and the checks of its digits
module contact_input_control1
   use contact_base_choices, only : contact_location, kernel_model, slip_source
   use contact_base_error, only : error_type
   use contact_cases_spec, only : case_digits, case_spec
   use contact_wheelrail_spec, only : wheel_rail_spec
   use contact_control_digits, only : digit_value
   use contact_control_digits1, only : allowed1_text, choice1_of, decode_words1, digit1_names, digit1_value_is_known
   use contact_input_control3, only : add_for_digit, check_kept, check_physics, check_signs, control_words, start_sequence
   use contact_input_problems, only : problem_list, severity
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_control_words1, check_digits1, name_choices1

contains

   !> Read the words and make named choices of their digits
   subroutine read_control_words1(lexer, words, spec, error)
      type(input_lexer), intent(inout) :: lexer
      type(control_words), intent(out) :: words
      !> On entry the previous case; its effective choices stay where a digit says "keep"
      type(case_spec), intent(inout) :: spec
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: values(2)

      call lexer%read_group("i", "CPBTNFS", values, error)
      if (allocated(error)) return
      words%word(1) = values(1)
      call lexer%read_group("iI", "VLDCMZE M2", values, error)
      if (allocated(error)) return
      words%word(2) = values(1)
      words%second = values(2)
      call lexer%read_group("i", "XHGIAOWR", values, error)
      if (allocated(error)) return
      words%word(3) = values(1)

      associate (word => words%word%i)
         if (words%second%given) then
            call decode_words1(word(1), word(2), word(3), spec%digits, words%second%i)
         else
            call decode_words1(word(1), word(2), word(3), spec%digits)
         end if
      end associate
      if (spec%digits%x > 0) then
         call lexer%read_group("iI", "PSFLCIN READLN", values, error)
         if (allocated(error)) return
      end if
      call name_choices1(spec)
   end subroutine read_control_words1

   !> Digits to names; effective values of the digits that can say "keep"
   subroutine name_choices1(spec)
      type(case_spec), intent(inout) :: spec

      if (.not. allocated(spec%wheel_rail)) allocate(spec%wheel_rail, source=wheel_rail_spec())
      associate (digits => spec%digits)
         spec%wheel_rail%left = digits%c1 == 0 .or. digits%c1 == 4
         spec%wheel_rail%roller = digits%c1 == 4 .or. digits%c1 == 5
         spec%wheel_rail%search%weight_power = merge(1, 2, digits%gapwgt == 1)
         spec%wheel_rail%new_rail_profile = .false.
         spec%wheel_rail%new_wheel_profile = .false.
         spec%link = choice1_of("P", digits%p)
         spec%pressure = choice1_of("B", digits%b)
         spec%motion = choice1_of("T", digits%t)
         spec%normal = choice1_of("N", digits%n)
         spec%force = choice1_of("F", digits%f)
         spec%stress = choice1_of("S", digits%s)
         spec%variation = choice1_of("V", digits%v)
         spec%material_model = choice1_of("M", digits%m)
         spec%estimate = choice1_of("I", digits%i)
         spec%mat_file = digits%a
         spec%output_level = digits%o
         spec%flow_level = digits%w
         spec%solve = digits%r <= 1
         if (digits%l /= 1) spec%friction_law = choice1_of("L", digits%l)
         if (digits%c >= 2) spec%kernel = choice1_of("C", digits%c)
         if (digits%g /= 1) spec%solver = choice1_of("G", digits%g)
         if (digits%h /= 1) spec%heat_model = choice1_of("H", digits%h)
         if (digits%m2 /= 1) spec%has_damping = digits%m2 >= 2
         spec%slip_source = slip_source%none
         spec%new_grid = digits%d >= 2
         spec%new_geometry = .true.
         spec%new_kernel = digits%c >= 2
      end associate
   end subroutine name_choices1

   !> Range of each digit, and what digits demand of each other and of the previous case
   subroutine check_digits1(words, previous, has_previous, spec, problems)
      type(control_words), intent(in) :: words
      !> The previous case of this result element
      type(case_spec), intent(in) :: previous
      !> Is there one?
      logical, intent(in) :: has_previous
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems

      call check_ranges(words, spec%digits, problems)
      if (spec%digits%c == 0) then
         if (has_previous) call add_for_digit(problems, words, severity%warning, "C", "C = 0 is replaced by 1: the grids of " // &
            & "wheel-rail contact change, and coefficients are formed when they are needed")
         spec%digits%c = 1
      end if
      if (has_previous) then
         call check_later_case(words, previous, spec, problems)
      else
         call check_first_case(words, spec, problems)
      end if
      call check_combinations(words, spec, problems)
   end subroutine check_digits1

   !> Each digit must be one that the format knows
   subroutine check_ranges(words, digits, problems)
      type(control_words), intent(in) :: words
      type(case_digits), intent(in) :: digits
      type(problem_list), intent(inout) :: problems
      character(len=:), allocatable :: name
      integer :: k

      call check_signs(words, digits, problems)
      do k = 1, size(digit1_names)
         name = trim(digit1_names(k))
         if (digit1_value_is_known(name, digit_value(digits, name))) cycle
         call add_for_digit(problems, words, severity%error, name, name // " = " // &
            & integer_text(digit_value(digits, name)) // " is not a known digit of module 1; allowed are " // &
            & trim(allowed1_text(name)))
      end do
   end subroutine check_ranges

   !> A first case has nothing to continue and nothing to keep
   subroutine check_first_case(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems

      call start_sequence(words, spec, problems)
      associate (digits => spec%digits)
         if (digits%c < 2) call add_for_digit(problems, words, severity%error, "C", "C = " // integer_text(digits%c) // &
            & " keeps the materials, but this is the first case; C = 2 reads them")
         if (digits%d < 2) call add_for_digit(problems, words, severity%error, "D", "D = " // integer_text(digits%d) // &
            & " keeps the settings of the contact search, but this is the first case")
         if (digits%z /= 3) call add_for_digit(problems, words, severity%error, "Z", "Z = " // integer_text(digits%z) // &
            & " in the first case: no rail profile has been given; Z = 3 is needed")
         if (digits%e /= 3 .and. digits%e /= 5) call add_for_digit(problems, words, severity%error, "E", "E = " // &
            & integer_text(digits%e) // " in the first case: no wheel profile has been given; E = 3 or 5 is needed")
      end associate
   end subroutine check_first_case

   !> What a later case keeps must be there
   subroutine check_later_case(words, previous, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: previous, spec
      type(problem_list), intent(inout) :: problems

      call check_kept(words, previous, spec, problems)
      associate (digits => spec%digits)
         if (digits%e == 0 .and. digits%n /= previous%digits%n) call add_for_digit(problems, words, severity%error, "E", &
            & "E = 0 keeps the position of the wheelset, but N changes from " // integer_text(previous%digits%n) // " to " // &
            & integer_text(digits%n) // ": a new position is needed")
         if (digits%c1 /= previous%digits%c1 .and. (digits%z == 0 .or. digits%e == 0)) call add_for_digit(problems, words, &
            & severity%warning, "C1", "C1 changes from " // integer_text(previous%digits%c1) // " to " // &
            & integer_text(digits%c1) // ", but track or wheelset are kept")
      end associate
   end subroutine check_later_case

   !> What digits demand of each other
   subroutine check_combinations(words, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems

      associate (digits => spec%digits)
         if (digits%f /= 0 .and. digits%t == 0) call add_for_digit(problems, words, severity%error, "F", "F = " // &
            & integer_text(digits%f) // " needs a tangential problem, T = 1, 2 or 3")
         if (digits%c == 4 .and. digits%d >= 2 .and. choice1_of("D", digits%d) /= contact_location%conformal) &
            & call add_for_digit(problems, words, severity%warning, "C", "C = 4, the angle correction for conformal contact, " // &
            & "has no effect with D = " // integer_text(digits%d) // ", whose patches are flat; D = 4 has curved ones")
      end associate
      call check_physics(words, spec, problems)
   end subroutine check_combinations
end module contact_input_control1
