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
   use contact_base_choices, only : heat_source
   use contact_base_error, only : add_context, error_kind, error_type, fatal_error
   use contact_base_guard, only : cause_text, do_guarded, free_left_blocks, guard_end, new_owner
   use contact_base_kinds, only : long
   use contact_base_memory, only : megabytes_text
   use contact_cases_slot, only : release_slot
   use contact_control_digit_terms, only : translate_to_digits
   use contact_experiment_check, only : check_all_cases
   use contact_experiment_errors, only : read_case, report_error, report_final_error
   use contact_experiment_input_names, only : refuse_result_names
   use contact_experiment_one_case, only : compute_case, count_case
   use contact_experiment_place, only : choose_input, input_suffix, locate_experiment, readable_suffix
   use contact_experiment_result_files, only : close_all_files, keep_files_current, open_all_files
   use contact_experiment_resume, only : find_resume_point, restore_state, resume_point
   use contact_experiment_state, only : apply_settings, as_input_says, counted, experiment_state, no_unit, &
      & run_settings, stop_question
   use contact_input_experiment_file, only : experiment_reader, input_case, is_readable_format
   use contact_output_case_record, only : case_head
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: as_input_says, no_unit, run_experiment, run_settings, stop_question

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
      if (.not. is_readable_format(state%place%input)) state%log%terms => translate_to_digits
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
      call refuse_result_names(run%state%reader, run%state%place, run%state%limits%confined, error)
      if (run%settings%check_only) then
         if (allocated(error)) call report_error(run%state, error)
         call check_all_cases(run%state)
         return
      end if
      if (.not. allocated(error)) call run%state%lock%take(run%state%place, error)
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
         & trim(megabytes_text(state%limits%output%allowed)) // " (--limit-output)", error_kind%limit)
   end subroutine check_output_limit

   !> Check that the name is not empty after removing folder and suffix
   subroutine check_place(state, error)
      type(experiment_state), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      if (len_trim(state%place%name) > 0) return
      call fatal_error(error, "'" // state%place%folder // "' names no experiment; expected is a name such as folder/name", &
         & error_kind%file)
   end subroutine check_place

   !> Solve the cases one after the other and write the results
   subroutine compute_all_cases(state, settings)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: settings
      type(run_settings) :: requested
      type(resume_point) :: point
      type(error_type), allocatable :: error
      type(input_case) :: this
      logical :: go_on, is_done, is_found
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
         call read_case(state, this, is_found, error)
         call state%reading%halt()
         if (allocated(error)) call report_final_error(state, error)
         if (.not. is_found) exit
         state%cases = state%cases + 1
         call check_for_end(state, settings, error)
         if (allocated(error)) then
            state%cases = state%cases - 1
            call report_final_error(state, error)
            exit
         end if
         call apply_settings(state, requested, this)
         state%head = case_head(this%number, this%reid, this%cpid, this%module_number, this%first_line, &
            & state%run%finished + 1, status=case_status())
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
end module contact_experiment_run
