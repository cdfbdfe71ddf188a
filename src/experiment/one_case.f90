!> A case of a run: checked, solved, and written to all result files
module contact_experiment_one_case
   use contact_base_case_status, only : case_status
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_estimate, only : case_cost, cost_text, estimate_cost
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_spec, only : case_spec
   use contact_experiment_errors, only : find_refusal, place_error, report_error, report_problems
   use contact_experiment_resume, only : record_case
   use contact_experiment_state, only : experiment_state, find_slot, numbered_slot, solve_one
   use contact_input_experiment_file, only : input_case
   use contact_output_case_record, only : case_head
   use contact_output_finished_file, only : case_file_name
   use contact_output_mat_file, only : write_mat_file
   use contact_output_report, only : write_case, write_case_line, write_subsurface
   use contact_output_report_wheel_rail, only : write_wheel_rail
   use contact_output_subs_file, only : write_subs_file
   use contact_output_wheel_rail_files, only : write_wheel_rail_files
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: compute_case, count_case

   !> Thresholds of time [s] and memory [bytes] above which the estimated cost of a case is reported before it is computed
   real(wp), parameter :: large_seconds = 10.0_wp, large_bytes = 1.0e9_wp

contains

   !> Check, solve and write a case
   subroutine compute_case(state, this, go_on)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      !> Can the next case be read?
      logical, intent(out) :: go_on
      type(error_type), allocatable :: error
      type(case_head) :: head
      type(case_spec), allocatable :: solved
      character(len=:), allocatable :: reason
      type(case_cost) :: cost
      real(wp) :: solving_before
      integer :: k

      if (state%log%screen /= 0) call state%progress%hide()
      head = state%head
      call write_case_line(state%log, this%number, this%reid)
      call report_problems(state, this)
      go_on = this%problems%is_usable()
      if (.not. go_on) then
         call state%log%line(" The run ends at case " // integer_text(this%number) // ", line " // &
            & integer_text(this%first_line) // ": its input cannot be used.")
         call find_refusal(this, reason)
         call head%status%refuse(reason)
         head%finished = state%run%finished
         state%run%reason = reason
         call count_case(state, head%status)
         if (state%exports%has_any()) call state%exports%write_failure(head)
         return
      end if

      call find_slot(state, this%reid, this%cpid, k)
      associate (slot => state%slots(k))
         if (this%spec%solve) then
            if (this%spec%iteration%allows_approximate .and. .not. this%spec%iteration%accuracy > 0.0_wp) &
               & call state%log%warning("simplified methods are allowed, but no accuracy is requested: the case is solved as given")
            call estimate_cost(this%spec, cost)
            if (cost%seconds > large_seconds .or. cost%bytes > large_bytes .or. cost%beyond_most) call state%log%line( &
               & " Estimate of this case on one thread: " // trim(cost_text(cost, machine_pace())))
         end if
         solving_before = state%solving%wall
         call state%solving%start()
         state%log%level = this%spec%flow_level
         call solve_one(state, slot, this, state%log, head%status, solved, error)
         call state%solving%halt()
         head%seconds = state%solving%wall - solving_before
         if (allocated(error) .or. this%spec%solve) call count_case(state, head%status)
         if (allocated(error)) then
            if (state%exports%has_any()) call state%exports%write_failure(head)
            call place_error(state, this, error)
            call add_context(error, "case " // integer_text(this%number))
            if (this%reid > 0) call add_context(error, "result element " // integer_text(this%reid))
            call report_error(state, error)
         else if (allocated(solved)) then
            call write_results(state, this, solved, slot, head)
         else if (this%spec%solve) then
            call write_results(state, this, this%spec, slot, head)
         end if
         call record_case(state, this, head%status, slot)
      end associate
   end subroutine compute_case

   !> Count a case by its final status
   subroutine count_case(state, status)
      type(experiment_state), intent(inout) :: state
      type(case_status), intent(in) :: status

      state%run%ended(status%state) = state%run%ended(status%state) + 1
   end subroutine count_case

   !> Write all results of a solved case of either module
   subroutine write_results(state, this, solved, slot, head)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      !> The case as solved
      type(case_spec), intent(in) :: solved
      !> Contact problem with results
      type(numbered_slot), intent(inout) :: slot
      !> Head of the case for files of other programs
      type(case_head), intent(in) :: head
      type(error_type), allocatable :: error

      call state%writing%start()
      if (this%module_number == 1) then
         call write_wheel_rail(state%log, solved, slot%wheel_rail_result)
         call write_wheel_rail_files(state%place%results, this%number, this%reid, solved, slot%wheel_rail_result, error)
         if (allocated(error)) call report_error(state, error)
      else
         call write_contact_files(state, this, solved, slot%result)
      end if
      if (state%exports%has_any()) then
         if (this%module_number == 1) then
            call state%exports%write_wheel_rail(head, this%spec, solved, slot%wheel_rail, slot%wheel_rail_result, error)
         else
            call state%exports%write_contact(head, this%spec, solved, slot%result, error)
         end if
         if (allocated(error)) call report_error(state, error)
      end if
      call state%writing%halt()
   end subroutine write_results

   !> Write the report, .mat and .subs file of a solved case of module 3
   subroutine write_contact_files(state, this, solved, result)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      !> The case as solved
      type(case_spec), intent(in) :: solved
      type(patch_result), intent(in) :: result
      type(error_type), allocatable :: error

      call write_case(state%log, solved, result)
      if (solved%mat_file >= 1) then
         call write_mat_file(case_file_name(state%place%results, this%number, "mat", this%reid, this%cpid, 0), solved, result, &
            & result%status, error)
         if (allocated(error)) call report_error(state, error)
      end if
      if (.not. solved%has_stress .or. .not. allocated(result%subsurface)) return
      call write_subsurface(state%log, solved, result)
      if (solved%subsurface%matfil >= 1) then
         call write_subs_file(case_file_name(state%place%results, this%number, "subs", this%reid, this%cpid, 0), solved, result, &
            & error)
         if (allocated(error)) call report_error(state, error)
      end if
   end subroutine write_contact_files
end module contact_experiment_one_case
