!> The control words of a case and the checks of its digits
module contact_input_control
   use contact_base_choices, only : contact_location, slip_source
   use contact_base_error, only : error_type
   use contact_cases_rules, only : choice_kind, choice_rules, is_broken
   use contact_cases_spec, only : case_spec
   use contact_control_digits, only : allowed_text, case_digits, choice_of, decode_words, digit_names, digit_text, digit_value, &
      & is_built, is_known
   use contact_control_rule_text, only : describe_broken_rule, letter_of
   use contact_control_translation, only : apply_digits, digits_of
   use contact_input_problems, only : problem_list, severity
   use contact_text_lexer, only : input_lexer, input_value
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: control_words, read_control_words, check_digits, refuse_unbuilt_digits, add_for_digit, check_physics

   !> Control words with their positions, for messages, and their digits
   type :: control_words
      type(case_digits) :: digits
      !> Words 1, 2 and 3
      type(input_value) :: word(3)
      !> The second number of word 2
      type(input_value) :: second
      !> Were choices given by keys? Then each digit has its own position
      logical :: has_keys = .false.
      integer :: lines(size(digit_names)) = 0, columns(size(digit_names)) = 0
   end type control_words

contains

   !> Read the control words and convert their digits to named choices
   subroutine read_control_words(lexer, words, module_number, spec, error)
      !> Positioned at the first word
      type(input_lexer), intent(inout) :: lexer
      type(control_words), intent(out) :: words
      integer, intent(in) :: module_number
      !> On entry the previous case; its effective choices remain if a digit is "keep"
      type(case_spec), intent(inout) :: spec
      type(error_type), allocatable, intent(out) :: error
      type(input_value) :: values(2)

      call lexer%read_group("i", trim(merge("CPBTNFS", "PBTNFS ", module_number == 1)), values, error)
      if (allocated(error)) return
      words%word(1) = values(1)
      call lexer%read_group("iI", "VLDCMZE M2", values, error)
      if (allocated(error)) return
      words%word(2) = values(1)
      words%second = values(2)
      call lexer%read_group("i", "XHGIAOWR", values, error)
      if (allocated(error)) return
      words%word(3) = values(1)

      ! the weighting is kept if there is no second number
      if (allocated(spec%wheel_rail)) words%digits%gapwgt = spec%wheel_rail%search%gap_weight
      associate (word => words%word%i)
         if (words%second%given) then
            call decode_words(word(1), word(2), word(3), module_number, words%digits, words%second%i)
         else
            call decode_words(word(1), word(2), word(3), module_number, words%digits)
         end if
      end associate
      if (words%digits%x > 0) then
         call lexer%read_group("iI", "PSFLCIN READLN", values, error)
         if (allocated(error)) return
      end if
      call apply_digits(words%digits, module_number, spec)
   end subroutine read_control_words

   !> Check the range of each digit, and the requirements of digits on each other and on the previous case
   !>
   !> Digits without a meaning are corrected with a warning: P to 2 and I to 0 in a first case, C = 0 to 1 in module 1.
   subroutine check_digits(words, module_number, previous, has_previous, spec, problems)
      type(control_words), intent(inout) :: words
      integer, intent(in) :: module_number
      !> The previous case of this module and result element
      type(case_spec), intent(in) :: previous
      !> Is there one?
      logical, intent(in) :: has_previous
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems

      call check_ranges(words, module_number, problems)
      if (module_number == 1 .and. words%digits%c == 0) then
         if (has_previous) call add_for_digit(problems, words, severity%warning, "C", "C = 0 is replaced by 1: the grids of " // &
            & "wheel-rail contact change, and coefficients are formed when they are needed")
         words%digits%c = 1
      end if
      if (.not. has_previous) call start_sequence(words, problems)
      ! repeated with the digits that may have been corrected
      if (module_number == 1 .or. .not. has_previous) call apply_digits(words%digits, module_number, spec)
      if (has_previous) then
         call check_kept(words, previous, spec, problems)
         if (module_number == 1) call check_kept_wheelset(words, previous, problems)
      else
         if (module_number == 1) then
            call check_first_pair(words, problems)
         else
            call check_first_contact(words, problems)
         end if
      end if
      if (module_number == 1) then
         call check_wheel_rail(words, problems)
      else
         call check_contact(words, merge(previous%motion, spec%motion, has_previous), problems)
      end if
      call check_physics(words, spec, problems)
   end subroutine check_digits

   !> Check that control words are not negative, that GAPWGT is in its range, and that each digit exists in the module
   subroutine check_ranges(words, module_number, problems)
      type(control_words), intent(in) :: words
      integer, intent(in) :: module_number
      type(problem_list), intent(inout) :: problems
      character(len=:), allocatable :: name
      integer :: digit, k

      do k = 1, 3
         associate (word => words%word(k))
            if (word%i < 0) call problems%add(severity%error, "the control word " // word%name // " = " // word%word // &
               & " is negative; it must consist of digits", word%line, word%column)
         end associate
      end do
      if (module_number == 3) call check_length(words%word(1), problems)
      if (words%second%i < 0) call problems%add(severity%error, "the second number of the control word, " // words%second%word // &
         & ", is negative; it must consist of digits", words%second%line, words%second%column)
      if (words%digits%gapwgt > 2) call problems%add(severity%error, "GAPWGT = " // integer_text(words%digits%gapwgt) // &
         & " is outside its range 0 to 2", words%second%line, words%second%column)
      do k = 1, size(digit_names)
         name = trim(digit_names(k))
         if (module_number == 3 .and. name == "C1") cycle
         digit = digit_value(words%digits, name)
         if (is_known(name, digit, module_number)) cycle
         call add_for_digit(problems, words, severity%error, name, name // " = " // integer_text(digit) // &
            & " is not a known digit of module " // integer_text(module_number) // "; allowed are " // &
            & trim(allowed_text(name, module_number)))
      end do
   end subroutine check_ranges

   !> Check that the first control word of module 3 has six digits; a seventh one in front is C1 of module 1
   subroutine check_length(word, problems)
      type(input_value), intent(in) :: word
      type(problem_list), intent(inout) :: problems

      if (word%i >= 10000000) then
         call problems%add(severity%error, "the control word PBTNFS = " // word%word // " has more than six digits", word%line, &
            & word%column)
      else if (word%i >= 1000000) then
         call problems%add(severity%warning, "the first digit of " // word%word // " is not used: in module 3 the first control " &
            & // "word is PBTNFS, without C1", word%line, word%column)
      end if
   end subroutine check_length

   !> Check that a first case of module 3 keeps nothing
   subroutine check_first_contact(words, problems)
      type(control_words), intent(in) :: words
      type(problem_list), intent(inout) :: problems

      associate (digits => words%digits)
         if (digits%d == 0) call add_for_digit(problems, words, severity%error, "D", &
            & "D = 0 keeps the potential contact area, but this is the first case")
         if (digits%d == 1) call add_for_digit(problems, words, severity%error, "D", &
            & "D = 1 forms the potential contact area from the values in store, but this is the first case")
         if (digits%c < 2) call add_for_digit(problems, words, severity%error, "C", "C = " // integer_text(digits%c) // &
            & " keeps the materials, but this is the first case; C = 2 reads them")
         if (digits%e == 1) call add_for_digit(problems, words, severity%error, "E", &
            & "E = 1 keeps the extra term of the rigid slip, but this is the first case; E = 9 reads it")
      end associate
   end subroutine check_first_contact

   !> Check that a first case of module 1 keeps nothing
   subroutine check_first_pair(words, problems)
      type(control_words), intent(in) :: words
      type(problem_list), intent(inout) :: problems

      associate (digits => words%digits)
         if (digits%c < 2) call add_for_digit(problems, words, severity%error, "C", "C = " // integer_text(digits%c) // &
            & " keeps the materials, but this is the first case; C = 2 reads them")
         if (digits%d < 2) call add_for_digit(problems, words, severity%error, "D", "D = " // integer_text(digits%d) // &
            & " keeps the settings of the contact search, but this is the first case")
         if (digits%z /= 3) call add_for_digit(problems, words, severity%error, "Z", "Z = " // integer_text(digits%z) // &
            & " in the first case: no rail profile has been given; Z = 3 is needed")
         if (digits%e /= 3 .and. digits%e /= 5) call add_for_digit(problems, words, severity%error, "E", "E = " // &
            & integer_text(digits%e) // " in the first case: no wheel profile has been given; E = 3 or 5 is needed")
      end associate
   end subroutine check_first_pair

   !> Check that the data kept by a later case exist
   subroutine check_kept(words, previous, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: previous, spec
      type(problem_list), intent(inout) :: problems
      type(case_digits) :: old

      associate (digits => words%digits)
         if (digits%l == 1) old = digits_of(previous)
         if ((digits%s == 1 .or. digits%s == 2) .and. .not. allocated(spec%subsurface%blocks)) &
            & call add_for_digit(problems, words, severity%error, "S", &
            & "S = " // integer_text(digits%s) // " keeps the subsurface points, but no case has given any")
         if (digits%h == 1 .and. .not. previous%heat%is_given) call add_for_digit(problems, words, severity%error, "H", &
            & "H = 1 keeps the thermal constants, but no case has given any; H = 3 reads them")
         if (digits%l == 1 .and. digits%v /= old%v) call add_for_digit(problems, words, severity%error, "L", &
            & "L = 1 keeps the friction law, but V changes from " // integer_text(old%v) // " to " // &
            & integer_text(digits%v) // ": new friction input is needed")
      end associate
   end subroutine check_kept

   !> Check that a track and wheelset kept by a later case are compatible with it
   subroutine check_kept_wheelset(words, previous, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: previous
      type(problem_list), intent(inout) :: problems
      type(case_digits) :: old

      old = digits_of(previous)
      associate (digits => words%digits)
         if (digits%e == 0 .and. digits%n /= old%n) call add_for_digit(problems, words, severity%error, "E", &
            & "E = 0 keeps the position of the wheelset, but N changes from " // integer_text(old%n) // " to " // &
            & integer_text(digits%n) // ": a new position is needed")
         if (digits%c1 /= old%c1 .and. (digits%z == 0 .or. digits%e == 0)) call add_for_digit(problems, words, &
            & severity%warning, "C1", "C1 changes from " // integer_text(old%c1) // " to " // &
            & integer_text(digits%c1) // ", but track or wheelset are kept")
      end associate
   end subroutine check_kept_wheelset

   !> Requirements of the digits of module 3 on each other
   subroutine check_contact(words, previous_motion, problems)
      type(control_words), intent(in) :: words
      !> T of the previous case; of this one if there is none
      integer, intent(in) :: previous_motion
      type(problem_list), intent(inout) :: problems

      associate (digits => words%digits)
         if (digits%d /= 0 .and. digits%z == 0) call add_for_digit(problems, words, severity%error, "Z", &
            & "Z = 0 keeps the undeformed distance, but D = " // integer_text(digits%d) // &
            & " forms a new grid, which needs a new one")
         if (digits%c == 0 .and. (digits%t <= 1 .neqv. previous_motion <= 1)) call add_for_digit(problems, words, &
            & severity%error, "C", "C = 0 keeps the influence coefficients, but T changes from " // &
            & integer_text(previous_motion) // " to " // integer_text(digits%t) // ", between shift and rolling")
      end associate
   end subroutine check_contact

   !> Requirements of the digits of module 1 on each other
   subroutine check_wheel_rail(words, problems)
      type(control_words), intent(in) :: words
      type(problem_list), intent(inout) :: problems

      associate (digits => words%digits)
         if (digits%c == 4 .and. digits%d >= 2 .and. choice_of("D", digits%d, 1) /= contact_location%conformal) &
            & call add_for_digit(problems, words, severity%warning, "C", "C = 4, the angle correction for conformal contact, " // &
            & "has no effect with D = " // integer_text(digits%d) // ", whose patches are flat; D = 4 has curved ones")
      end associate
   end subroutine check_wheel_rail

   !> Correct, with a warning, digits that a first case of either module cannot have, and check what it cannot keep
   subroutine start_sequence(words, problems)
      type(control_words), intent(inout) :: words
      type(problem_list), intent(inout) :: problems

      associate (digits => words%digits)
         if (digits%p /= 2) then
            call add_for_digit(problems, words, severity%warning, "P", "P = " // integer_text(digits%p) // &
               & " is replaced by 2: the first case has no previous tractions")
            digits%p = 2
         end if
         if (digits%i /= 0) then
            call add_for_digit(problems, words, severity%warning, "I", "I = " // integer_text(digits%i) // &
               & " is replaced by 0: the first case has no previous solution")
            digits%i = 0
         end if
         if (digits%l == 1) call add_for_digit(problems, words, severity%error, "L", &
            & "L = 1 keeps the friction law of the previous case, but this is the first case")
         if (digits%s == 1 .or. digits%s == 2) call add_for_digit(problems, words, severity%error, "S", &
            & "S = " // integer_text(digits%s) // " keeps the subsurface points, but this is the first case")
         if (digits%h == 1) call add_for_digit(problems, words, severity%error, "H", &
            & "H = 1 keeps the thermal constants, but this is the first case; H = 3 reads them")
      end associate
   end subroutine start_sequence

   !> Requirements of choices on each other, see contact_cases_rules
   subroutine check_physics(words, spec, problems, line_of_grid)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      !> Present: check the rules on the form of the grid; absent: check all others, which depend on digits only
      integer, intent(in), optional :: line_of_grid
      character(len=:), allocatable :: text
      integer :: k, kind

      do k = 1, size(choice_rules)
         associate (rule => choice_rules(k))
            if (any([rule%choice, rule%other] == choice_kind%grid_form) .neqv. present(line_of_grid)) cycle
            if (.not. is_broken(rule, spec)) cycle
            call describe_broken_rule(rule, spec, words%digits, text)
            kind = merge(severity%warning, severity%error, rule%only_warns)
            if (present(line_of_grid)) then
               call problems%add(kind, text, line_of_grid)
            else
               call add_for_digit(problems, words, kind, letter_of(rule%choice), text)
            end if
         end associate
      end do
   end subroutine check_physics

   !> Refuse, by name, choices that the format has but this version does not implement: used for files and calls of both modules
   !>
   !> A digit that keeps a choice is treated as the digit of that choice.
   subroutine refuse_unbuilt_digits(words, module_number, spec, problems)
      type(control_words), intent(in) :: words
      integer, intent(in) :: module_number
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      character(len=len(digit_names)) :: name
      character(len=:), allocatable :: text
      integer :: digit, k

      do k = 1, size(digit_names)
         name = digit_names(k)
         if (module_number == 3 .and. name == "C1") cycle
         digit = kept_digit(words%digits, spec, name, module_number)
         if (is_built(name, digit, module_number) .or. .not. is_known(name, digit, module_number)) cycle
         text = trim(digit_text(name, digit, module_number)) // ", is not implemented in this version"
         if (module_number == 1) text = text // " for wheel on rail" // trim(alternative(spec, name))
         call add_for_digit(problems, words, severity%unsupported, trim(name), trim(name) // " = " // integer_text(digit) // ", " &
            & // text)
      end do
   end subroutine refuse_unbuilt_digits

   !> Alternative to a digit of module 1 that is not implemented, preceded by a semicolon; blank if there is none
   pure function alternative(spec, name) result(text)
      type(case_spec), intent(in) :: spec
      !> Letter of the digit
      character(len=*), intent(in) :: name
      character(len=64) :: text

      text = ""
      if (name /= "D") return
      text = "; use D = 2 or 7, whose search needs no direction of view"
      if (spec%wheel_rail%search%location == contact_location%oblique_grid) &
         & text = "; use D = 5 or 6, whose search needs no direction of view"
   end function alternative

   !> A digit, or the one that it keeps
   pure integer function kept_digit(digits, spec, name, module_number) result(digit)
      type(case_digits), intent(in) :: digits
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: name
      integer, intent(in) :: module_number

      digit = digit_value(digits, name)
      ! by the first letter, which takes less time than by the name
      select case (name(1:1))
      case ("L"); if (digit == 1) digit = spec%friction_law
      case ("C"); if (name == "C" .and. digit <= 1) digit = spec%kernel
      case ("M"); if (name == "M2" .and. digit == 1 .and. spec%has_damping) digit = 2
      case ("D"); if (module_number == 1 .and. digit <= 1) digit = spec%wheel_rail%search%location
      case ("E"); if (module_number == 3 .and. digit == 1) digit = spec%slip_source
      end select
   end function kept_digit

   !> Add a problem at the position of the word that contains a digit
   subroutine add_for_digit(problems, words, kind, name, message)
      type(problem_list), intent(inout) :: problems
      type(control_words), intent(in) :: words
      !> Member of severity
      integer, intent(in) :: kind
      !> Letter of the digit
      character(len=*), intent(in) :: name
      !> One sentence
      character(len=*), intent(in) :: message

      if (words%has_keys) then
         associate (k => findloc(digit_names, name, dim=1))
            call problems%add(kind, message, words%lines(k), words%columns(k))
         end associate
         return
      end if
      select case (name)
      case ("C1", "P", "B", "T", "N", "F", "S")
         call problems%add(kind, message, words%word(1)%line, words%word(1)%column)
      case ("V", "L", "D", "C", "M", "Z", "E")
         call problems%add(kind, message, words%word(2)%line, words%word(2)%column)
      case ("M2")
         call problems%add(kind, message, words%word(2)%line)
      case default
         call problems%add(kind, message, words%word(3)%line, words%word(3)%column)
      end select
   end subroutine add_for_digit
end module contact_input_control
