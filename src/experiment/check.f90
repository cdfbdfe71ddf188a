!> Check of an experiment without computing it: all cases are read, profiles and files of cases prepared, and the cost estimated
module contact_experiment_check
   use contact_base_choices, only : kernel_model
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_cases_estimate, only : case_cost, cost_text, estimate_cost
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_session, only : check_case
   use contact_cases_slot, only : open_contact, open_wheel_rail, problem_slot, release_slot
   use contact_cases_spec, only : case_spec
   use contact_cases_wheel_rail_session, only : check_files
   use contact_experiment_errors, only : place_error, read_case, report_error, report_problems
   use contact_experiment_state, only : counted, experiment_state, find_slot
   use contact_input_experiment_file, only : input_case
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: check_all_cases

   !> Thresholds of time [s] and memory [bytes] above which the estimated cost of a case is reported
   real(wp), parameter :: reported_seconds = 1.0_wp, reported_bytes = 1.0e8_wp

contains

   !> Read all cases and report everything that is wrong with them
   subroutine check_all_cases(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      type(input_case) :: this
      !> Number of elements and memory of the largest case, time of all cases
      type(case_cost) :: total
      !> Are errors of the case hidden, because they may follow from values that it keeps?
      logical :: is_hidden
      integer :: faulty, hidden, k
      logical :: is_found

      faulty = 0
      hidden = 0
      allocate(state%slots(4))
      do
         call read_case(state, this, is_found, error)
         if (allocated(error)) call report_error(state, error)
         if (.not. is_found) exit
         state%cases = state%cases + 1
         this%spec%limits%confined = state%limits%confined
         call find_slot(state, this%reid, this%cpid, k)
         call report_problems(state, this, state%slots(k)%refused(this%module_number), is_hidden)
         if (this%problems%is_usable()) then
            call add_cost(state, this, total)
            call check_without_solving(state%slots(k)%problem_slot, this%spec, state, error)
            if (.not. allocated(error)) cycle
            ! profiles are those that the case gives itself
            is_hidden = this%module_number == 3 .and. state%slots(k)%refused(3)
            call place_error(state, this, error)
            call add_context(error, "case " // integer_text(this%number))
            if (.not. is_hidden) call report_error(state, error)
         end if
         faulty = faulty + 1
         if (is_hidden) hidden = hidden + 1
         state%slots(k)%refused(this%module_number) = .true.
      end do
      do k = 1, state%used
         call release_slot(state%slots(k)%problem_slot)
      end do
      call state%log%line(" " // state%place%input // ": " // counted(state%cases, "case") // " checked, " // &
         & counted(faulty, "faulty case") // ", " // counted(state%errors, "error") // ", " // &
         & counted(state%log%warnings, "warning"))
      if (hidden > 0) call state%log%line(" " // integer_text(hidden) // " of the faulty cases " // &
         & trim(merge("keeps", "keep ", hidden == 1)) // " values of a case with errors; check again when these are corrected")
      if (state%cases > faulty) call state%log%line(" Estimate on one thread, largest case and time of all: " // &
         & trim(cost_text(total, machine_pace())))
   end subroutine check_all_cases

   !> Checks that require the preparation of a case: profiles, files, compatibility of its motion
   subroutine check_without_solving(slot, given, state, error)
      type(problem_slot), intent(inout) :: slot
      type(case_spec), intent(in) :: given
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (allocated(given%wheel_rail)) then
         if (.not. (given%wheel_rail%new_rail_profile .or. given%wheel_rail%new_wheel_profile &
            & .or. given%wheel_rail%new_track .or. given%kernel == kernel_model%tabulated)) return
         call open_wheel_rail(slot)
         call check_files(slot%wheel_rail, given, state%place%folder, state%log, error)
         call state%log%translate_choices(error)
      else
         call open_contact(slot)
         call check_case(slot%session, given, state%log, slot%result, error, state%place%folder)
      end if
   end subroutine check_without_solving

   !> Add the cost of a case to the total; report it if it is large
   subroutine add_cost(state, this, total)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      type(case_cost), intent(inout) :: total
      type(case_cost) :: cost

      call estimate_cost(this%spec, cost)
      if (cost%elements > total%elements) then
         total%elements = cost%elements
         total%at_most = cost%at_most
         total%beyond_most = cost%beyond_most
      end if
      total%bytes = max(total%bytes, cost%bytes)
      total%seconds = total%seconds + cost%seconds
      if (cost%seconds > reported_seconds .or. cost%bytes > reported_bytes) call state%log%line(" Estimate of case " // &
         & integer_text(this%number) // " on one thread: " // trim(cost_text(cost, machine_pace())))
   end subroutine add_cost
end module contact_experiment_check
