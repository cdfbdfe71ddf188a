!> One case of module 3: all groups in their order, then all checks
module contact_input_reader3
   use contact_base_error, only : add_context, error_type
   use contact_cases_spec, only : case_spec
   use contact_input_checks3, only : case_lines, check_case
   use contact_input_control3, only : check_digits, control_words, read_control_words, refuse_unbuilt_digits
   use contact_input_grid3, only : frame_of, grid_frame, read_extra_slip, read_geometry, read_grid
   use contact_input_groups3, only : read_damping, read_friction, read_friction_rows, read_heat, read_iteration, &
      & read_kinematics, read_materials, read_rolling
   use contact_input_problems, only : problem_list
   use contact_input_subsurface_reader, only : read_subsurface
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_case3

contains

   !> Read a case
   !>
   !> The case starts as a copy of the previous one, so that what a digit keeps is there, and the
   !> groups that are read overwrite it. Values that break a rule are reported in `problems` and
   !> reading goes on; `error` means that reading cannot go on.
   subroutine read_case3(lexer, previous, has_previous, case_number, spec, problems, error, coefficients, first_line)
      type(input_lexer), intent(inout) :: lexer
      !> The previous case of this result element; a default one before the first
      type(case_spec), intent(in) :: previous
      !> Is there a previous case?
      logical, intent(in) :: has_previous
      !> For messages
      integer, intent(in) :: case_number
      type(case_spec), intent(out) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      !> Grid for which influence coefficients were last formed, kept from case to case by the
      !> caller; when absent, the grid of the previous case counts
      type(grid_frame), intent(inout), optional :: coefficients
      !> Line of the first control word, 0 when there is none
      integer, intent(out), optional :: first_line
      type(control_words) :: words
      type(case_lines) :: lines
      type(grid_frame) :: stored

      spec = previous
      call problems%start(lexer%file)
      if (has_previous) stored = frame_of(previous%grid)
      if (present(coefficients)) stored = coefficients

      call read_control_words(lexer, words, spec, error)
      if (present(first_line)) first_line = words%word(1)%line
      if (.not. allocated(error)) then
         call check_digits(words, previous, has_previous, spec, problems)
         call read_groups(lexer, spec, problems, lines, error)
      end if
      if (allocated(error)) then
         call add_context(error, "case " // integer_text(case_number))
         return
      end if

      call check_case(words, lines, previous, has_previous, stored, spec, problems)
      call refuse_unbuilt_digits(words, spec, on_rail=.false., problems=problems)
      if (present(coefficients) .and. spec%digits%c /= 0) coefficients = frame_of(spec%grid)
   end subroutine read_case3

   !> The groups behind the control words
   subroutine read_groups(lexer, spec, problems, lines, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(case_lines), intent(out) :: lines
      type(error_type), allocatable, intent(out) :: error

      call read_iteration(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_kinematics(lexer, spec, problems, lines%kinematics, error)
      if (allocated(error)) return
      call read_friction(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_rolling(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_materials(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_damping(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_heat(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_grid(lexer, spec, problems, lines%grid, error)
      if (allocated(error)) return
      call read_geometry(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_friction_rows(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_extra_slip(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_subsurface(lexer, spec, problems, error)
   end subroutine read_groups
end module contact_input_reader3
