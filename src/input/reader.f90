!> One case of an input file: control words, the groups required by them, then all checks
module contact_input_reader
   use contact_base_error, only : add_context, error_type
   use contact_cases_continuation, only : frame_of
   use contact_cases_spec, only : case_spec
   use contact_cases_whole_case, only : visit_case
   use contact_control_digits, only : case_digits
   use contact_control_digit_terms, only : translate_error_to_digits, translate_to_digits
   use contact_grid_potential_contact, only : potential_contact
   use contact_input_checks, only : check_case
   use contact_input_control, only : check_digits, control_words, read_control_words, refuse_unbuilt_digits
   use contact_input_file_reader, only : file_reader, new_file_reader
   use contact_input_problems, only : problem_list
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_case

contains

   !> Read a case
   !>
   !> The case starts as a copy of the previous one, so that kept data are present, and the groups that are read replace theirs.
   !> Values that violate a rule are reported in `problems` and reading continues; `error` means that reading cannot continue.
   subroutine read_case(lexer, module_number, previous, has_previous, case_number, spec, problems, error, coefficients, &
      & first_line, digits)
      !> Positioned at the first word of the case
      type(input_lexer), intent(inout), target :: lexer
      integer, intent(in) :: module_number
      !> The previous case of this module and result element; a default one before the first
      type(case_spec), intent(in) :: previous
      !> Is there a previous case?
      logical, intent(in) :: has_previous
      !> Number of the case, for messages
      integer, intent(in) :: case_number
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(inout), target :: problems
      type(error_type), allocatable, intent(out) :: error
      !> Grid for which influence coefficients of module 3 were last computed, kept from case to case by the caller; absent: the
      !> grid of the previous case
      type(potential_contact), intent(inout), optional :: coefficients
      !> Line of the first control word, 0: none
      integer, intent(out), optional :: first_line
      !> Digits as given by the case
      type(case_digits), intent(out), optional :: digits
      type(control_words) :: words
      type(file_reader) :: a
      type(potential_contact) :: stored
      character(len=:), allocatable :: text
      integer :: k

      spec = previous
      call problems%start(lexer%file)
      if (has_previous) stored = frame_of(previous%grid)
      if (present(coefficients)) stored = coefficients

      call read_control_words(lexer, words, module_number, spec, error)
      if (present(first_line)) first_line = words%word(1)%line
      if (.not. allocated(error)) then
         call check_digits(words, module_number, previous, has_previous, spec, problems)
         if (present(digits)) digits = words%digits
         a = new_file_reader(lexer, problems)
         call visit_case(a, spec)
         if (allocated(a%error)) call move_alloc(a%error, error)
      end if
      if (.not. allocated(error)) then
         call check_case(words, a, previous, has_previous, stored, spec, problems)
         if (present(coefficients) .and. module_number == 3 .and. words%digits%c /= 0) coefficients = frame_of(spec%grid)
         call refuse_unbuilt_digits(words, module_number, spec, problems)
      end if
      do k = 1, problems%count
         call translate_to_digits(problems%items(k)%what%message, text)
         problems%items(k)%what%message = text
      end do
      call translate_error_to_digits(error)
      call add_context(error, "case " // integer_text(case_number))
   end subroutine read_case
end module contact_input_reader
