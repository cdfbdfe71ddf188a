!> Description of an experiment in words
module contact_experiment_explain
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_cases_estimate, only : case_cost
   use contact_cases_foreseen_cost, only : cost_forecast
   use contact_experiment_input_cases, only : list_problems, open_cases
   use contact_experiment_place, only : experiment_place, locate_experiment
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_input_problems, only : severity
   use contact_output_case_words, only : describe_case
   use contact_text_buffer, only : text_buffer
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: explain_experiment

contains

   !> Describe every case: what is simulated and what is not, the solvers, and the expected cost
   subroutine explain_experiment(experiment, messages, error, accuracy, allows_approximate)
      !> Name of the experiment, with or without suffix
      character(len=*), intent(in) :: experiment
      !> Description, line by line
      type(text_buffer), intent(inout) :: messages
      !> Allocated if the input is invalid, or a case cannot be computed
      type(error_type), allocatable, intent(out) :: error
      !> Accuracy that a run will request: bound of the relative error of the forces [-]; 0 or absent: as in the input
      real(wp), intent(in), optional :: accuracy
      !> Will the run allow simplified methods?
      logical, intent(in), optional :: allows_approximate
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(experiment_place) :: place
      type(cost_forecast) :: forecast
      type(case_cost) :: cost
      character(len=:), allocatable :: input
      integer :: cases

      call open_cases(experiment, reader, input, error)
      if (allocated(error)) return
      place = locate_experiment(experiment, "")
      cases = 0
      call messages%add_line(input)
      do
         call reader%next_case(this, error)
         if (allocated(error) .or. this%module_number == 0) exit
         cases = cases + 1
         call messages%add_line("")
         if (present(accuracy)) then
            if (accuracy > 0.0_wp) this%spec%iteration%accuracy = accuracy
         end if
         if (present(allows_approximate)) then
            if (allows_approximate) this%spec%iteration%allows_approximate = .true.
         end if
         if (this%problems%number_of(severity%error) == 0) then
            if (this%problems%is_usable()) then
               call forecast%foresee(this%spec, [this%reid, this%cpid], place%folder, cost)
               call describe_case(this%module_number, this%reid, cases, this%first_line, this%spec, messages, cost)
            else
               call describe_case(this%module_number, this%reid, cases, this%first_line, this%spec, messages)
            end if
         else
            call messages%add_line("Case " // integer_text(cases) // ", line " // integer_text(this%first_line) // &
               & ": its errors must be corrected first")
         end if
         call list_problems(this%problems, "  ", messages)
         call this%problems%first_failure(error)
         if (allocated(error)) exit
      end do
      call forecast%release()
   end subroutine explain_experiment
end module contact_experiment_explain
