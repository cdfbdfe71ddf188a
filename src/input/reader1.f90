!> One case of module 1, wheel on rail: all groups in their order, then all checks
module contact_input_reader1
   use contact_base_choices, only : motion
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_input_control1, only : check_digits1, read_control_words1
   use contact_input_control3, only : add_for_digit, control_words, refuse_unbuilt_digits
   use contact_input_groups1, only : read_friction_points, read_search, read_track, read_wheelset
   use contact_input_groups3, only : read_damping, read_heat, read_iteration, read_materials
   use contact_input_problems, only : problem_list, severity
   use contact_input_subsurface_reader, only : read_subsurface
   use contact_text_lexer, only : input_lexer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: read_case1

contains

   !> Read a case; see read_case3 for the rules
   subroutine read_case1(lexer, previous, has_previous, case_number, spec, problems, error, first_line)
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
      !> Line of the first control word, 0 when there is none
      integer, intent(out) :: first_line
      type(control_words) :: words

      spec = previous
      call problems%start(lexer%file)
      call read_control_words1(lexer, words, spec, error)
      first_line = words%word(1)%line
      if (.not. allocated(error)) then
         call check_digits1(words, previous, has_previous, spec, problems)
         call read_groups(lexer, spec, problems, error)
      end if
      if (allocated(error)) then
         call add_context(error, "case " // integer_text(case_number))
         return
      end if
      call check_grid_is_kept(words, previous, has_previous, spec, problems)
      call refuse_unbuilt_digits(words, spec, on_rail=.true., problems=problems)
   end subroutine read_case1

   !> The groups behind the control words
   subroutine read_groups(lexer, spec, problems, error)
      type(input_lexer), intent(inout) :: lexer
      type(case_spec), intent(inout) :: spec
      type(problem_list), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error

      call read_iteration(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_friction_points(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_materials(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_damping(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_heat(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_search(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_track(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_wheelset(lexer, spec, problems, error)
      if (allocated(error)) return
      call read_subsurface(lexer, spec, problems, error)
   end subroutine read_groups

   !> A transient case continues on the elements of the previous one
   subroutine check_grid_is_kept(words, previous, has_previous, spec, problems)
      type(control_words), intent(in) :: words
      type(case_spec), intent(in) :: previous
      logical, intent(in) :: has_previous
      type(case_spec), intent(in) :: spec
      type(problem_list), intent(inout) :: problems
      real(wp), parameter :: same_side = 1.0e-4_wp

      if (.not. has_previous .or. spec%digits%p == 2) return
      if (spec%motion /= motion%shift .and. spec%motion /= motion%transient_rolling) return
      if (.not. allocated(previous%wheel_rail)) return
      associate (old => previous%wheel_rail%search, new => spec%wheel_rail%search)
         if (abs(new%dx - old%dx) <= same_side*new%dx .and. abs(new%ds - old%ds) <= same_side*new%ds) return
      end associate
      call add_for_digit(problems, words, severity%error, "D", "DX or DS differ from those of the previous case, which this " // &
         & "transient case continues; the same values, or a new sequence, P = 2")
   end subroutine check_grid_is_kept
end module contact_input_reader1
