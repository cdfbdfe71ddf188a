!> Run of an experiment, from its input file to its result files
!>
!> Cases are read, solved and written one after the other. Each result element and contact patch has its own session and result
!> until the end of the run, so that arrays are reused.
!>
!> Handling of errors: an unreadable file, an invalid value, or a choice that is not implemented ends the run before that case
!> is computed. A case that cannot be solved, and a .mat or .subs file that cannot be written, are reported and the run
!> continues. In all of these cases the run has failed.
module contact_experiment_run
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_loc, c_ptr
   use omp_lib, only : omp_get_max_threads, omp_set_num_threads
   use contact_base_case_status, only : case_state, case_status
   use contact_base_choices, only : heat_source, kernel_model
   use contact_base_error, only : add_context, error_kind, error_type, fatal_error, full_text
   use contact_base_guard, only : cause_text, do_guarded, free_left_blocks, guard_end, new_owner
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : wall_clock
   use contact_base_output_file, only : remove_file
   use contact_cases_estimate, only : case_cost, cost_text, estimate_cost
   use contact_cases_wheel_rail_session, only : check_files
   use contact_cases_session, only : check_case
   use contact_cases_slot, only : open_contact, open_wheel_rail, problem_slot, release_slot
   use contact_cases_spec, only : case_spec
   use contact_control_digit_terms, only : tell_in_digits
   use contact_experiment_exports, only : number_of_exports
   use contact_experiment_journal, only : journal_name
   use contact_experiment_place, only : choose_input, input_suffix, locate_experiment, readable_suffix
   use contact_experiment_resume, only : find_resume_point, record_case, restore_state, resume_point, settings_of
   use contact_experiment_state, only : apply_settings, as_input_says, counted, experiment_state, find_slot, no_unit, &
      & numbered_slot, run_settings, solve_one, stop_question
   use contact_input_experiment_file, only : experiment_reader, input_case, is_readable_format
   use contact_input_problems, only : problem_text, severity
   use contact_output_case_record, only : case_head, planned_text
   use contact_output_finished_file, only : case_file_name, close_result, open_result, open_result_again
   use contact_output_mat_file, only : write_mat_file
   use contact_output_wheel_rail_files, only : write_wheel_rail_files
   use contact_output_report, only : timer_line, write_banner, write_case, write_case_line, write_closing, write_end, &
      & write_subsurface
   use contact_output_report_wheel_rail, only : write_wheel_rail
   use contact_output_subs_file, only : write_subs_file
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: as_input_says, no_unit, run_experiment, run_settings, stop_question

   !> Thresholds of time [s] and memory [bytes] above which the estimated cost of a case is reported: in a check, and before it
   !> is computed
   real(wp), parameter :: reported_seconds = 1.0_wp, reported_bytes = 1.0e8_wp, large_seconds = 10.0_wp, large_bytes = 1.0e9_wp

   !> Data of guarded work
   type :: guarded_run
      type(experiment_state), pointer :: state => null()
      type(run_settings), pointer :: settings => null()
      !> Why the work was abandoned, member of guard_end
      integer :: cause = guard_end%done
   end type guarded_run

contains

   !> Run or check an experiment
   subroutine run_experiment(settings, error, interrupted)
      !> Files, limits and choices requested by the caller
      type(run_settings), target, intent(in) :: settings
      type(error_type), allocatable, intent(out) :: error
      !> Was the run ended by settings%stop_requested?
      logical, intent(out), optional :: interrupted
      type(experiment_state), pointer :: state
      type(guarded_run), target :: run
      integer :: default_threads, owner, cause
      logical :: has_both

      allocate(state)
      default_threads = omp_get_max_threads()
      if (settings%threads > 0) call omp_set_num_threads(settings%threads)
      state%log%screen = settings%screen
      state%complaints = settings%complaints
      if (allocated(settings%output_folder)) then
         state%place = locate_experiment(settings%experiment, settings%output_folder)
      else
         state%place = locate_experiment(settings%experiment, "")
      end if
      call choose_input(state%place, has_both)
      if (.not. is_readable_format(state%place%input)) state%log%terms => tell_in_digits
      associate (input => state%place%input)
         if (has_both) call state%log%line(" There are " // state%place%name // input_suffix // " and " // state%place%name // &
            & readable_suffix // "; " // input // " is read; with its suffix the other one is")
      end associate

      call check_place(state, error)
      call set_limits(state, settings)
      if (.not. allocated(error)) call open_input(state, state%reader, error)
      if (allocated(error)) then
         call report_error(state, error)
      else
         run%state => state
         run%settings => settings
         owner = new_owner()
         call do_guarded(run_cases, c_loc(run), owner, run%cause)
      end if
      if (run%cause /= guard_end%done) then
         call do_guarded(end_early, c_loc(run), owner, cause)
         if (.not. allocated(state%first_error)) call fatal_error(state%first_error, trim(cause_text(run%cause)), &
            & error_kind%memory)
      end if
      call state%lock%release()
      if (associated(state%limits%output)) deallocate(state%limits%output)
      if (present(interrupted)) interrupted = state%interrupted
      call omp_set_num_threads(default_threads)
      call move_alloc(state%first_error, error)
      if (settings%strict .and. .not. allocated(error) .and. state%run%ended(case_state%not_converged) > 0) &
         & call fatal_error(error, integer_text(state%run%ended(case_state%not_converged)) // " of " // &
         & counted(state%cases, "case") // " did not converge", error_kind%not_converged)
      if (state%errors > 1) call add_context(error, "first of " // integer_text(state%errors) // " errors")
      if (run%cause == guard_end%done) then
         deallocate(state)
      else
         ! data that abandoned work was changing cannot be deallocated
         call free_left_blocks(owner)
      end if
   end subroutine run_experiment

   !> Check or compute the cases, as guarded work
   subroutine run_cases(data) bind(c)
      !> A guarded_run
      type(c_ptr), value :: data
      type(guarded_run), pointer :: run
      type(error_type), allocatable :: error

      call c_f_pointer(data, run)
      if (run%settings%check_only) then
         call check_all_cases(run%state)
         return
      end if
      call run%state%lock%take(run%state%place, error)
      if (allocated(error)) then
         call report_error(run%state, error)
      else
         call compute_all_cases(run%state, run%settings)
      end if
   end subroutine run_cases

   !> Report that there is not enough memory for the current case, and close the files
   !>
   !> The sessions of the cases are in an undefined state; files, log and counts are valid.
   subroutine end_early(data) bind(c)
      !> A guarded_run
      type(c_ptr), value :: data
      type(guarded_run), pointer :: run
      type(error_type), allocatable :: error
      character(len=:), allocatable :: reason

      call c_f_pointer(data, run)
      associate (state => run%state)
         reason = trim(cause_text(run%cause))
         if (state%in_case) then
            reason = reason // " for case " // integer_text(state%head%number)
            if (state%head%result_element > 0) reason = reason // ", result element " // integer_text(state%head%result_element)
         end if
         call fatal_error(error, reason, error_kind%memory)
         call report_error(state, error)
         state%run%reason = reason
         if (run%settings%check_only .or. .not. state%log%out%is_open()) return
         call state%progress%hide()
         if (state%in_case) then
            call state%head%status%refuse(reason)
            state%head%finished = state%run%finished
            call count_case(state, state%head%status)
            if (state%exports%has_any()) call state%exports%write_failure(state%head)
         end if
         call close_all_files(state)
      end associate
   end subroutine end_early

   !> Set the limits of the run and start its time
   subroutine set_limits(state, settings)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: settings

      state%limits = settings%limits
      if (settings%output_bytes < huge(1_long)) then
         allocate(state%limits%output)
         state%limits%output%allowed = settings%output_bytes
         state%limits%output%left = settings%output_bytes
      end if
      state%deadline = settings%run_deadline
      call state%deadline%start()
   end subroutine set_limits

   !> Open the input; in a confined run it must be a regular file in the folder of the experiment
   subroutine open_input(state, reader, error)
      type(experiment_state), intent(in) :: state
      type(experiment_reader), intent(inout) :: reader
      type(error_type), allocatable, intent(out) :: error

      if (state%limits%confined) then
         call reader%open_file(state%place%input, error, state%place%folder)
      else
         call reader%open_file(state%place%input, error)
      end if
   end subroutine open_input

   !> Give an error if the run is to end before its next case
   subroutine check_for_end(state, settings, error)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: settings
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason

      if (associated(settings%stop_requested)) then
         call settings%stop_requested(reason)
         if (allocated(reason)) then
            state%interrupted = .true.
            call fatal_error(error, "the run was ended by " // reason // " before case " // integer_text(state%cases), &
               & error_kind%interrupted)
            return
         end if
      end if
      call state%deadline%check("by the run as a whole", error)
   end subroutine check_for_end

   !> Give an error if the size of the output files has reached its limit; the report may exceed it
   subroutine check_output_limit(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (.not. associated(state%limits%output)) return
      if (.not. state%limits%output%is_exceeded()) return
      call state%log%out%charge_to(null())
      call fatal_error(error, "the results would take more than the limit of " // &
         & integer_text(int(min(state%limits%output%allowed/1000000_long, int(huge(1), long)))) // " MB (--limit-output)", &
         & error_kind%limit)
   end subroutine check_output_limit

   !> Check that the name is not empty after removing folder and suffix
   subroutine check_place(state, error)
      type(experiment_state), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      if (len_trim(state%place%name) > 0) return
      call fatal_error(error, "'" // state%place%folder // "' names no experiment; expected is a name such as folder/name", &
         & error_kind%file)
   end subroutine check_place

   !> Read all cases and report everything that is wrong with them
   subroutine check_all_cases(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      type(input_case) :: this
      !> Number of elements and memory of the largest case, time of all cases
      type(case_cost) :: total
      integer :: faulty, k

      faulty = 0
      allocate(state%slots(4))
      do
         call state%reader%next_case(this, error)
         if (allocated(error)) then
            ! a wrong digit may be the cause why the following text cannot be read
            if (allocated(this%problems%items)) call report_problems(state, this)
            call report_error(state, error)
            exit
         end if
         if (this%module_number == 0) then
            call report_problems(state, this)
            exit
         end if
         state%cases = state%cases + 1
         this%spec%limits%confined = state%limits%confined
         call report_problems(state, this)
         if (this%problems%is_usable()) call add_cost(state, this, total)
         if (.not. this%problems%is_usable()) then
            faulty = faulty + 1
            cycle
         end if
         call find_slot(state, this%reid, this%cpid, k)
         call check_without_solving(state%slots(k)%problem_slot, this%spec, state, error)
         if (.not. allocated(error)) cycle
         call place_error(state, this, error)
         call add_context(error, "case " // integer_text(this%number))
         call report_error(state, error)
         faulty = faulty + 1
      end do
      do k = 1, state%used
         call release_slot(state%slots(k)%problem_slot)
      end do
      call state%log%line(" " // state%place%input // ": " // counted(state%cases, "case") // " checked, " // &
         & counted(faulty, "faulty case") // ", " // counted(state%errors, "error") // ", " // &
         & counted(state%log%warnings, "warning"))
      if (state%cases > faulty) call state%log%line(" Estimate on one thread, largest case and time of all: " // &
         & trim(cost_text(total)))
   end subroutine check_all_cases

   !> Checks that require the preparation of a case: profiles, files, compatibility of its motion
   subroutine check_without_solving(slot, given, state, error)
      type(problem_slot), intent(inout) :: slot
      type(case_spec), intent(in) :: given
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (allocated(given%wheel_rail)) then
         if (.not. (given%wheel_rail%new_rail_profile .or. given%wheel_rail%new_wheel_profile &
            & .or. given%kernel == kernel_model%tabulated)) return
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
         & integer_text(this%number) // " on one thread: " // trim(cost_text(cost)))
   end subroutine add_cost

   !> Solve the cases one after the other and write the results
   subroutine compute_all_cases(state, settings)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: settings
      type(run_settings) :: requested
      type(resume_point) :: point
      type(error_type), allocatable :: error
      type(input_case) :: this
      logical :: go_on, is_done
      integer :: k

      call state%total%start()
      allocate(state%slots(4))
      requested = settings
      is_done = .false.
      if (requested%resume) then
         call find_resume_point(state, requested, point, is_done, error)
         ! limits of the earlier run are used unless others are given
         state%limits%deadline = requested%limits%deadline
         state%limits%bytes = requested%limits%bytes
         state%limits%elements = requested%limits%elements
      end if
      if (requested%heat_source == as_input_says .and. .not. is_readable_format(state%place%input)) &
         & requested%heat_source = heat_source%established
      if (.not. allocated(error) .and. point%active) call restore_state(state, requested, point, error)
      if (allocated(error)) then
         if (allocated(state%exports%hdf5)) call state%exports%hdf5%abandon()
         call report_error(state, error)
      end if
      if (.not. (allocated(error) .or. is_done)) call open_all_files(state, requested, point, go_on)
      if (allocated(error) .or. is_done) go_on = .false.
      if (go_on .and. requested%progress) call state%progress%begin(state%run%planned)
      do while (go_on)
         call state%reading%start()
         call state%reader%next_case(this, error)
         call state%reading%halt()
         if (allocated(error)) then
            ! a wrong digit may be the cause why the following text cannot be read
            if (allocated(this%problems%items)) call report_problems(state, this)
            call report_final_error(state, error)
            exit
         end if
         if (this%module_number == 0) then
            call report_problems(state, this)
            exit
         end if
         state%cases = state%cases + 1
         call check_for_end(state, settings, error)
         if (allocated(error)) then
            state%cases = state%cases - 1
            call report_final_error(state, error)
            exit
         end if
         call apply_settings(state, requested, this)
         state%head = case_head(this%number, this%reid, this%cpid, this%module_number, this%first_line, state%run%finished + 1)
         state%in_case = .true.
         call compute_case(state, this, go_on)
         state%in_case = .false.
         if (.not. go_on) exit
         call keep_files_current(state)
         call check_output_limit(state, error)
         if (allocated(error)) then
            call report_final_error(state, error)
            exit
         end if
         if (settings%screen == 0 .or. this%spec%flow_level == 0) call state%progress%show(state%cases)
      end do
      if (state%log%out%is_open()) call close_all_files(state)
      do k = 1, state%used
         call release_slot(state%slots(k)%problem_slot)
      end do
   end subroutine compute_all_cases

   !> Open the files of a run, or continue existing ones
   subroutine open_all_files(state, requested, point, done)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: requested
      type(resume_point), intent(in) :: point
      logical, intent(out) :: done
      type(error_type), allocatable :: error
      character(len=:), allocatable :: version

      version = ""
      if (allocated(requested%version)) version = requested%version
      if (point%active) then
         call open_result_again(state%log%out, state%place%results // ".out", point%at%out, error, state%limits)
      else
         ! a journal of an earlier run does not describe what is written now
         call remove_file(journal_name(state%place%results))
         call open_out_file(state, error)
      end if
      if (.not. allocated(error)) then
         ! counting the cases requires reading the complete input; for few and quick results it is postponed until the number is
         ! needed
         if (requested%progress .or. requested%exports%any()) call count_planned(state)
         if (point%active) then
            call state%exports%open_files(requested%exports, state%place, version, state%run, state%limits, error, point%at)
         else
            call state%exports%open_files(requested%exports, state%place, version, state%run, state%limits, error)
         end if
      end if
      done = .not. allocated(error)
      if (allocated(error)) then
         call report_final_error(state, error)
         return
      end if
      if (point%active) then
         call state%journal%resume(state%place%results, point%place, point%at, state%limits%confined)
         return
      end if
      state%silent = .not. state%exports%has_any()
      call write_banner(state%log, requested%version)
      if (allocated(state%lock%doubt)) call state%log%warning(state%lock%doubt)
      call state%journal%start(state%place%results, settings_of(requested), state%limits%confined)
   end subroutine open_all_files

   !> Record the progress of the run in all files, and close them
   subroutine close_all_files(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      integer :: errors, k

      call state%progress%hide()
      call require_planned(state)
      errors = state%errors
      do k = 1, number_of_exports
         call state%exports%close_file(k, state%run, error)
         if (allocated(error)) call report_error(state, error)
      end do
      call close_out_file(state)
      ! files that could not be completed may be completed when there is disk space again
      call state%journal%finish(state%run%is_complete() .and. state%errors == errors)
   end subroutine close_all_files

   !> Flush the output to the system, so that it survives this process; in a run with a size limit determine the size of the
   !> HDF5 file
   subroutine keep_files_current(state)
      type(experiment_state), intent(inout) :: state
      !> Computing time that a killed run may lose [s]
      real(wp), parameter :: interval = 0.002_wp
      logical :: ignored

      call state%log%out%flush_now()
      if (wall_clock() - state%last_save >= interval) then
         call state%journal%save_line()
         state%last_save = wall_clock()
      end if
      if (.not. associated(state%limits%output) .or. .not. allocated(state%exports%hdf5)) return
      associate (bytes => state%exports%hdf5%bytes_so_far())
         if (bytes > state%hdf5_bytes) ignored = state%limits%output%take(bytes - state%hdf5_bytes)
         state%hdf5_bytes = max(bytes, state%hdf5_bytes)
      end associate
   end subroutine keep_files_current

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
            call estimate_cost(this%spec, cost)
            if (cost%seconds > large_seconds .or. cost%bytes > large_bytes .or. cost%beyond_most) call state%log%line( &
               & " Estimate of this case on one thread: " // trim(cost_text(cost)))
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

   !> Why the input of a case is invalid: its first error
   subroutine find_refusal(this, reason)
      type(input_case), intent(in) :: this
      character(len=:), allocatable, intent(out) :: reason
      integer :: k

      reason = "its input cannot be used"
      do k = 1, this%problems%count
         associate (item => this%problems%items(k))
            if (item%severity == severity%warning) cycle
            reason = reason // ": " // full_text(item%what)
         end associate
         return
      end do
   end subroutine find_refusal

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
         call write_mat_file(case_file_name(state%place%results, this%number, "mat", this%reid, 0), solved, result, &
            & result%status, error)
         if (allocated(error)) call report_error(state, error)
      end if
      if (.not. solved%has_stress .or. .not. allocated(result%subsurface)) return
      call write_subsurface(state%log, solved, result)
      if (solved%subsurface%matfil >= 1) then
         call write_subs_file(case_file_name(state%place%results, this%number, "subs", this%reid, 0), solved, result, error)
         if (allocated(error)) call report_error(state, error)
      end if
   end subroutine write_contact_files

   !> Count the cases in the input, as far as it can be read
   subroutine count_planned(state)
      type(experiment_state), intent(inout) :: state
      type(experiment_reader) :: reader
      type(input_case) :: this
      type(error_type), allocatable :: error

      state%run%planned = 0
      reader = state%reader
      call reader%rewind()
      do while (.not. allocated(error))
         call reader%next_case(this, error)
         if (allocated(error)) exit
         if (this%module_number == 0) return
         state%run%planned = state%run%planned + 1
      end do
      ! the error belongs to another case
      state%run%planned = state%run%planned + 1
      state%run%readable = .false.
   end subroutine count_planned

   !> Number of planned cases, if not yet counted
   subroutine require_planned(state)
      type(experiment_state), intent(inout) :: state

      if (state%run%planned > 0) return
      state%run%planned = state%run%finished
      if (allocated(state%run%reason)) call count_planned(state)
   end subroutine require_planned

   !> Report the error that ends the run before all cases are finished
   subroutine report_final_error(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), intent(in) :: error

      call report_error(state, error)
      state%run%reason = full_text(error)
   end subroutine report_final_error

   !> Assign an error without position to the start of its case in the input
   subroutine place_error(state, this, error)
      type(experiment_state), intent(in) :: state
      type(input_case), intent(in) :: this
      type(error_type), intent(inout) :: error

      if (allocated(error%file)) return
      error%file = state%place%input
      error%line = this%first_line
   end subroutine place_error

   !> Write an error to the .out file and to the error unit, and remember the first one
   subroutine report_error(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), intent(in) :: error

      call write_error(state, " ERROR. " // full_text(error))
      state%errors = state%errors + 1
      if (.not. allocated(state%first_error)) state%first_error = error
   end subroutine report_error

   !> Write the problems of a case: warnings to the log, errors as in report_error
   subroutine report_problems(state, this)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      integer :: k

      do k = 1, this%problems%count
         associate (item => this%problems%items(k))
            if (item%severity == severity%warning) then
               call state%log%line(problem_text(item))
               state%log%warnings = state%log%warnings + 1
            else
               call write_error(state, problem_text(item))
               state%errors = state%errors + 1
               if (.not. allocated(state%first_error)) then
                  state%first_error = item%what
                  call add_context(state%first_error, "case " // integer_text(this%number))
               end if
            end if
         end associate
      end do
   end subroutine report_problems

   !> Write a line to the .out file and to the error unit, after clearing the progress line
   subroutine write_error(state, text)
      type(experiment_state), intent(inout) :: state
      character(len=*), intent(in) :: text
      integer :: status

      call state%log%result(text)
      if (state%complaints == no_unit) return
      call state%progress%hide()
      if (state%log%screen /= 0) flush(state%log%screen, iostat=status)
      write(state%complaints, "(A)") text
      flush(state%complaints, iostat=status)
   end subroutine write_error

   !> Open the .out file of the run
   subroutine open_out_file(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      call open_result(state%log%out, state%place%results // ".out", state%place%results // ".out", error, state%limits)
   end subroutine open_out_file

   !> Write timers and closing lines, and close the .out file
   subroutine close_out_file(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      type(timer_line) :: lines(4)

      ! the closing lines are always written
      call state%log%out%charge_to(null())
      call state%total%halt()
      call state%total%fill_line("Total", lines(1))
      call state%reading%fill_line("Reading input", lines(2))
      call state%solving%fill_line("Solving cases", lines(3))
      call state%writing%fill_line("Writing results", lines(4))
      call write_end(state%log, omp_get_max_threads(), lines)
      call state%log%line(" " // counted(state%cases, "case") // ": " // &
         & integer_text(state%run%ended(case_state%solved)) // " solved, " // &
         & integer_text(state%run%ended(case_state%not_converged)) // " not converged, " // &
         & integer_text(state%run%ended(case_state%refused)) // " refused")
      if (.not. state%run%is_complete()) call state%log%line(" Not complete: " // trim(planned_text(state%run)) // " finished")
      if (state%silent .and. state%cases > 0) call state%log%line( &
         & " No results were asked for: O, A and S are 0 in all cases.")
      call write_closing(state%log, state%errors > 0)
      call close_result(state%log%out, state%place%results // ".out", error)
      if (allocated(error)) call report_error(state, error)
   end subroutine close_out_file
end module contact_experiment_run
