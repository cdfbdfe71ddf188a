!> The cases of an experiment one after the other, for tasks that read them and solve nothing
module contact_experiment_input_cases
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_experiment_place, only : choose_input, experiment_place, locate_experiment
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_input_problems, only : problem_list, problem_text, severity
   use contact_text_buffer, only : text_buffer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: list_problems, next_valid_case, open_cases

contains

   !> Open the input of an experiment
   subroutine open_cases(experiment, reader, input, error)
      !> Name of the experiment, with or without suffix
      character(len=*), intent(in) :: experiment
      !> Ready to read the first case
      type(experiment_reader), intent(inout) :: reader
      !> Name of the input file
      character(len=:), allocatable, intent(out) :: input
      !> Allocated if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      type(experiment_place) :: place
      logical :: has_both

      place = locate_experiment(experiment, "")
      call choose_input(place, has_both)
      input = place%input
      call reader%open_file(input, error)
   end subroutine open_cases

   !> Read the next case, which must not have errors
   subroutine next_valid_case(reader, this, is_case, error, messages)
      !> Reader of an open input
      type(experiment_reader), intent(inout) :: reader
      !> The case
      type(input_case), intent(out) :: this
      !> False at the end of the input, and with an error
      logical, intent(out) :: is_case
      !> The first problem of a case with errors; if problems are listed in messages, the place of the case
      type(error_type), allocatable, intent(out) :: error
      !> Receives the problems of the case, warnings included
      type(text_buffer), intent(inout), optional :: messages

      is_case = .false.
      call reader%next_case(this, error)
      if (allocated(error)) return
      if (present(messages)) call list_problems(this%problems, "", messages)
      if (this%problems%number_of(severity%error) == 0) then
         is_case = this%module_number /= 0
      else if (present(messages)) then
         call fatal_error(error, "case " // integer_text(this%number) // ", which starts at this line, has errors; " // &
            & "nothing was written", error_kind%input, reader%lexer%file, this%first_line)
      else
         call this%problems%first_failure(error)
      end if
   end subroutine next_valid_case

   !> List the problems of a case, each on a line
   subroutine list_problems(problems, indent, messages)
      !> Problems of a case
      type(problem_list), intent(in) :: problems
      !> Blanks before each line
      character(len=*), intent(in) :: indent
      !> Receives the lines
      type(text_buffer), intent(inout) :: messages
      integer :: k

      do k = 1, problems%count
         call messages%add_line(indent // problem_text(problems%items(k)))
      end do
   end subroutine list_problems
end module contact_experiment_input_cases
