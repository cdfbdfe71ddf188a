!> One case of an input file: control words, the groups that they ask for, then all checks
module contact_input_reader
   use contact_base_choices, only : motion
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_cases_whole_case, only : visit_case
   use contact_control_digits, only : case_digits
   use contact_input_checks3, only : check_case
   use contact_input_control, only : add_for_digit, check_digits, control_words, read_control_words, refuse_unbuilt_digits
   use contact_input_file_reader, only : file_reader, new_file_reader
   use contact_input_grid_frame, only : frame_of, grid_frame
   use contact_input_problems, only : problem_list, severity
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_case, check_elements_are_kept

contains

   !> Read a case
   !>
   !> The case starts as a copy of the previous one, so that what a digit keeps is there, and the
   !> groups that are read overwrite it. Values that break a rule are reported in `problems` and
   !> reading goes on; `error` means that reading cannot go on.
   subroutine read_case(lexer, module_number, previous, has_previous, case_number, spec, problems, error, coefficients, &
      & first_line, digits)
      type(input_lexer), intent(inout), target :: lexer
      !> 1 or 3
      integer, intent(in) :: module_number
      !> The previous case of this module and result element; a default one before the first
      type(case_spec), intent(in) :: previous
      !> Is there a previous case?
      logical, intent(in) :: has_previous
      !> For messages
      integer, intent(in) :: case_number
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(inout), target :: problems
      type(error_type), allocatable, intent(out) :: error
      !> Grid for which influence coefficients of module 3 were last formed, kept from case to case by the
      !> caller; when absent, the grid of the previous case counts
      type(grid_frame), intent(inout), optional :: coefficients
      !> Line of the first control word, 0 when there is none
      integer, intent(out), optional :: first_line
      !> Digits as the case gave them
      type(case_digits), intent(out), optional :: digits
      type(control_words) :: words
      type(file_reader) :: a
      type(grid_frame) :: stored

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
      if (allocated(error)) then
         call add_context(error, "case " // integer_text(case_number))
         return
      end if

      if (module_number == 1) then
         call check_elements_are_kept(words, previous, has_previous, spec, problems)
      else
         call check_case(words, a, previous, has_previous, stored, spec, problems)
         if (present(coefficients) .and. words%digits%c /= 0) coefficients = frame_of(spec%grid)
      end if
      call refuse_unbuilt_digits(words, module_number, spec, problems)
   end subroutine read_case

   !> A transient case of wheel on rail continues on the elements of the previous one
   subroutine check_elements_are_kept(words, previous, has_previous, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: previous
      logical, intent(in) :: has_previous
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      real(wp), parameter :: same_side = 1.0e-4_wp

      if (.not. has_previous .or. words%digits%p == 2) return
      if (spec%motion /= motion%shift .and. spec%motion /= motion%transient_rolling) return
      if (.not. allocated(previous%wheel_rail)) return
      associate (old => previous%wheel_rail%search, new => spec%wheel_rail%search)
         if (abs(new%dx - old%dx) <= same_side*new%dx .and. abs(new%ds - old%ds) <= same_side*new%ds) return
      end associate
      call add_for_digit(problems, words, severity%error, "D", "DX or DS differ from those of the previous case, which this " // &
         & "transient case continues; the same values, or a new sequence, P = 2")
   end subroutine check_elements_are_kept
end module contact_input_reader
