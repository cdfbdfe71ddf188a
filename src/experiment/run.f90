!> One experiment from its input file to its result files
!>
!> Cases are read, solved and written one after the other. Every result element and contact patch has
!> a session and a result of its own, which live until the end of the run, so that arrays are reused.
!>
!> What an error does: a file that cannot be understood, a wrong value and a choice that is not built
!> end the run before that case is computed. A case that cannot be solved and a .mat or .subs file that
!> cannot be written are reported, and the run goes on. After any of them the run counts as failed.
module contact_experiment_run
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_loc, c_ptr
   use omp_lib, only : omp_get_max_threads, omp_set_num_threads
   use contact_base_case_status, only : case_state, case_status
   use contact_base_choices, only : estimate_choice, heat_source, kernel_model, time_link
   use contact_base_error, only : add_context, error_kind, error_type, fatal_error, full_text
   use contact_base_guard, only : do_guarded, end_text, free_left_blocks, guard_end, new_owner
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits, deadline_type, wall_clock
   use contact_base_log, only : log_type
   use contact_base_output_file, only : remove_file
   use contact_cases_border_warning, only : is_same
   use contact_cases_estimate, only : case_cost, cost_text, estimate_cost
   use contact_cases_pair_session, only : check_files, solve_pair_case
   use contact_cases_session, only : check_case, solve_case
   use contact_cases_slot, only : open_contact, open_pair, problem_slot, release_slot
   use contact_cases_spec, only : case_spec
   use contact_experiment_exports, only : export_files, export_request, number_of_exports
   use contact_experiment_journal, only : advised, case_letter, checkpoint, is_advised, journal_file, journal_name, &
      & journal_settings, letter_of, read_journal
   use contact_experiment_lock, only : experiment_lock
   use contact_experiment_place, only : experiment_place, locate_experiment
   use contact_experiment_progress, only : is_terminal, progress_line
   use contact_experiment_stopwatch, only : stopwatch
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_input_problems, only : problem_text, severity
   use contact_output_case_record, only : case_head, planned_text, run_summary
   use contact_output_finished_file, only : close_result, open_result, open_result_again
   use contact_output_mat_file, only : mat_file_name, write_mat_file
   use contact_output_report, only : timer_line, write_banner, write_case, write_case_line, write_closing, write_end, &
      & write_subsurface
   use contact_output_pair_files, only : write_pair_files
   use contact_output_report_pair, only : write_pair
   use contact_output_subs_file, only : subs_file_name, write_subs_file
   use contact_patch_result, only : patch_result
   use contact_text_lexer, only : empty_hash
   use contact_text_words, only : columns_of, integer_text
   implicit none (type, external)
   private

   public :: no_unit, run_experiment, run_settings, stop_question

   !> Stands for no unit; 0 is the standard error stream of gfortran
   integer, parameter :: no_unit = -1

   !> Cases that are estimated to take more time [s] or memory [bytes] are announced: by a check, and before they are computed
   real(wp), parameter :: told_seconds = 1.0_wp, told_bytes = 1.0e8_wp, large_seconds = 10.0_wp, large_bytes = 1.0e9_wp

   abstract interface
      !> Is the run to end after the case in hand? It is asked between two cases
      subroutine stop_question(reason)
         implicit none (type, external)
         !> Why, such as "signal TERM"; unallocated: go on
         character(len=:), allocatable, intent(out) :: reason
      end subroutine stop_question
   end interface

   !> What is to be run and where messages go
   type :: run_settings
      !> Name of the experiment, with or without folder and suffix .inp
      character(len=:), allocatable :: experiment
      !> Folder of the results; unallocated or "" for the folder of the input
      character(len=:), allocatable :: output_folder
      !> Version for the banner; unallocated to leave it out
      character(len=:), allocatable :: version
      !> Only read and check the cases? Then no file is written
      logical :: check_only = .false.
      !> Number of threads, 0 for the default
      integer :: threads = 0
      !> Unit for the log on the screen, 0 for none
      integer :: screen = 0
      !> Unit for errors, or no_unit
      integer :: complaints = no_unit
      !> May a progress line be shown on the terminal?
      logical :: progress = .false.
      !> What each case may take, and whether the run is confined to its folder
      type(case_limits) :: limits
      !> What the whole run may take: time, and bytes of all files
      type(deadline_type) :: run_deadline
      integer(long) :: output_bytes = huge(1_long)
      !> Whom to ask between two cases whether the run is to end; null for nobody
      procedure(stop_question), pointer, nopass :: stop_asked => null()
      !> Is a case that does not converge a failure of the run?
      logical :: strict = .false.
      !> Files for other programs beside the usual ones
      type(export_request) :: exports
      !> How temperatures are computed, member of heat_source
      integer :: heat_source = heat_source%established
      !> Contact angles on rails that vary along the track: of the section below the axle, as in the established program?
      logical :: angle_below_axle = .true.
      !> Go on with a run that has ended before all cases were finished?
      logical :: resume = .false.
   end type run_settings

   !> Where to go on with a run
   type :: resume_point
      !> Are there finished cases to go on behind?
      logical :: active = .false.
      type(checkpoint) :: at
      !> End of its line in the journal [bytes]
      integer(long) :: place = 0
      !> How the finished cases ended, see case_letter
      character(len=:), allocatable :: letters
   end type resume_point

   !> The problem of one result element and contact patch
   type, extends(problem_slot) :: numbered_slot
      integer :: reid = 0, cpid = 1
   end type numbered_slot

   !> Everything that a run keeps from case to case
   type :: experiment_state
      type(experiment_place) :: place
      type(experiment_reader) :: reader
      type(experiment_lock) :: lock
      type(log_type) :: log
      type(progress_line) :: progress
      type(export_files) :: exports
      !> Slots 1...used are in use
      integer :: used = 0
      type(numbered_slot), allocatable :: slots(:)
      !> Unit for errors, or no_unit
      integer :: complaints = no_unit
      !> Numbers of cases read and of errors
      integer :: cases = 0, errors = 0
      !> What is planned and what is done
      type(run_summary) :: run
      !> Has somebody asked the run to end?
      logical :: interrupted = .false.
      !> Has no case asked for results so far?
      logical :: silent = .true.
      !> The first error; unallocated when there was none
      type(error_type), allocatable :: first_error
      type(stopwatch) :: total, reading, solving, writing
      !> What each case may take and the run may still write
      type(case_limits) :: limits
      type(deadline_type) :: deadline
      !> Size of the HDF5 file as it was counted last
      integer(long) :: hdf5_bytes = 0
      !> What `--resume` goes on from, and the last line of the input that its hash knows
      type(journal_file) :: journal
      integer :: hashed = 0
      !> When the journal was handed to the system last, see wall_clock
      real(wp) :: last_save = 0.0_wp
      !> The case in hand, if there is one
      type(case_head) :: head
      logical :: in_case = .false.
   end type experiment_state

   !> What guarded work is told
   type :: guarded_run
      type(experiment_state), pointer :: state
      type(run_settings), pointer :: settings
      !> Why the work was left, member of guard_end
      integer :: cause = guard_end%done
   end type guarded_run

contains

   !> Run or check one experiment; the error is the first of all that were met
   subroutine run_experiment(settings, error, interrupted)
      type(run_settings), target, intent(in) :: settings
      type(error_type), allocatable, intent(out) :: error
      !> Did settings%stop_asked end it?
      logical, intent(out), optional :: interrupted
      type(experiment_state), pointer :: state
      type(guarded_run), target :: run
      integer :: default_threads, owner, cause

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
      if (state%place%shortened) call state%log%line(" The suffix .inp is taken off, the experiment is '" // &
         & state%place%name // "'")

      call check_place(state, error)
      call set_limits(state, settings)
      if (.not. allocated(error)) call open_input(state, state%reader, error)
      if (allocated(error)) then
         call report_error(state, error)
      else
         run%state => state
         run%settings => settings
         owner = new_owner()
         call do_guarded(work_on_cases, c_loc(run), owner, run%cause)
      end if
      if (run%cause /= guard_end%done) then
         call do_guarded(end_early, c_loc(run), owner, cause)
         if (.not. allocated(state%first_error)) call fatal_error(state%first_error, trim(end_text(run%cause)), &
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
         ! what the work was changing cannot be deallocated
         call free_left_blocks(owner)
      end if
   end subroutine run_experiment

   !> Check or compute the cases
   subroutine work_on_cases(data) bind(c)
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
   end subroutine work_on_cases

   !> Say that there is no memory for the case in hand, and close the files
   !>
   !> The sessions of the cases are in no defined state; files, log and counts are.
   subroutine end_early(data) bind(c)
      !> A guarded_run
      type(c_ptr), value :: data
      type(guarded_run), pointer :: run
      type(error_type), allocatable :: error
      character(len=:), allocatable :: reason

      call c_f_pointer(data, run)
      associate (state => run%state)
         reason = trim(end_text(run%cause))
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
            if (state%exports%wanted()) call state%exports%write_failure(state%head)
         end if
         call close_all_files(state)
      end associate
   end subroutine end_early

   !> The limits of the run, whose time begins
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

   !> Open the input; that of a confined run is an ordinary file in the folder of the experiment
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

   !> An error when the run is to end before its next case
   subroutine look_for_end(state, settings, error)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: settings
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason

      if (associated(settings%stop_asked)) then
         call settings%stop_asked(reason)
         if (allocated(reason)) then
            state%interrupted = .true.
            call fatal_error(error, "the run was ended by " // reason // " before case " // integer_text(state%cases), &
               & error_kind%interrupted)
            return
         end if
      end if
      call state%deadline%watch("by the run as a whole", error)
   end subroutine look_for_end

   !> An error when the files of the run have reached their limit; the report has room for it
   subroutine look_for_excess(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (.not. associated(state%limits%output)) return
      if (.not. state%limits%output%is_exceeded()) return
      call state%log%out%charge_to(null())
      call fatal_error(error, "the results would take more than the limit of " // &
         & integer_text(int(min(state%limits%output%allowed/1000000_long, int(huge(1), long)))) // " MB (--limit-output)", &
         & error_kind%limit)
   end subroutine look_for_excess

   !> A name must be left after the folder and the suffix
   subroutine check_place(state, error)
      type(experiment_state), intent(in) :: state
      type(error_type), allocatable, intent(out) :: error

      if (len_trim(state%place%name) > 0) return
      call fatal_error(error, "'" // state%place%folder // "' names no experiment; expected is a name such as folder/name", &
         & error_kind%file)
   end subroutine check_place

   !> Read the cases to the end and tell everything that is wrong with them
   subroutine check_all_cases(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      type(input_case) :: this
      !> Elements and memory of the largest case, time of all cases
      type(case_cost) :: total
      integer :: faulty, k

      faulty = 0
      allocate(state%slots(4))
      do
         call state%reader%next_case(this, error)
         if (allocated(error)) then
            ! a wrong digit may be the reason why the text behind it cannot be read
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

   !> What only the preparation of a case finds: its profiles, its files, what its motion does not go with
   subroutine check_without_solving(slot, given, state, error)
      type(problem_slot), intent(inout) :: slot
      type(case_spec), intent(in) :: given
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      if (allocated(given%wheel_rail)) then
         if (.not. (given%wheel_rail%new_rail_profile .or. given%wheel_rail%new_wheel_profile &
            & .or. given%kernel == kernel_model%tabulated)) return
         call open_pair(slot)
         call check_files(slot%pair, given, state%place%folder, state%log, error)
      else
         call open_contact(slot)
         call check_case(slot%session, given, state%log, slot%result, error, state%place%folder)
      end if
   end subroutine check_without_solving

   !> Add the cost of a case to that of all; tell it when it is large
   subroutine add_cost(state, this, total)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      type(case_cost), intent(inout) :: total
      type(case_cost) :: cost

      call estimate_cost(this%spec, cost)
      if (cost%elements > total%elements) then
         total%elements = cost%elements
         total%at_most = cost%at_most
      end if
      total%bytes = max(total%bytes, cost%bytes)
      total%seconds = total%seconds + cost%seconds
      if (cost%seconds > told_seconds .or. cost%bytes > told_bytes) call state%log%line(" Estimate of case " // &
         & integer_text(this%number) // " on one thread: " // trim(cost_text(cost)))
   end subroutine add_cost

   !> "1 case", "2 cases"
   pure function counted(n, what) result(text)
      integer, intent(in) :: n
      character(len=*), intent(in) :: what
      character(len=columns_of(n) + 1 + len(what) + merge(0, 1, n == 1)) :: text

      text = integer_text(n) // " " // what
      if (n /= 1) text(len(text):) = "s"
   end function counted

   !> Solve the cases one after the other and write the results
   subroutine compute_all_cases(state, settings)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: settings
      type(run_settings) :: asked
      type(resume_point) :: point
      type(error_type), allocatable :: error
      type(input_case) :: this
      logical :: go_on, is_done
      integer :: k

      call state%total%start()
      allocate(state%slots(4))
      asked = settings
      is_done = .false.
      if (asked%resume) then
         call find_point(state, asked, point, is_done, error)
         ! limits are those that the run had before, where no others are given
         state%limits%deadline = asked%limits%deadline
         state%limits%bytes = asked%limits%bytes
         state%limits%elements = asked%limits%elements
      end if
      if (.not. allocated(error) .and. point%active) call catch_up(state, asked, point, error)
      if (allocated(error)) then
         if (allocated(state%exports%hdf5)) call state%exports%hdf5%abandon()
         call report_error(state, error)
      end if
      if (.not. (allocated(error) .or. is_done)) call open_all_files(state, asked, point, go_on)
      if (allocated(error) .or. is_done) go_on = .false.
      if (go_on .and. asked%progress) call state%progress%begin(state%run%planned)
      do while (go_on)
         call state%reading%start()
         call state%reader%next_case(this, error)
         call state%reading%halt()
         if (allocated(error)) then
            ! a wrong digit may be the reason why the text behind it cannot be read
            if (allocated(this%problems%items)) call report_problems(state, this)
            call give_up(state, error)
            exit
         end if
         if (this%module_number == 0) then
            call report_problems(state, this)
            exit
         end if
         state%cases = state%cases + 1
         call look_for_end(state, settings, error)
         if (allocated(error)) then
            state%cases = state%cases - 1
            call give_up(state, error)
            exit
         end if
         call complete_spec(state, asked, this)
         state%head = case_head(this%number, this%reid, this%cpid, this%module_number, this%first_line, state%run%finished + 1)
         state%in_case = .true.
         call compute_case(state, this, go_on)
         state%in_case = .false.
         if (.not. go_on) exit
         call keep_files_current(state)
         call look_for_excess(state, error)
         if (allocated(error)) then
            call give_up(state, error)
            exit
         end if
         if (settings%screen == 0 .or. this%spec%flow_level == 0) call state%progress%show(state%cases)
      end do
      if (state%log%out%is_open()) call close_all_files(state)
      do k = 1, state%used
         call release_slot(state%slots(k)%problem_slot)
      end do
   end subroutine compute_all_cases

   !> What the run, not the input, says about a case
   subroutine complete_spec(state, asked, this)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: asked
      type(input_case), intent(inout) :: this

      this%spec%heat%source = asked%heat_source
      if (allocated(this%spec%wheel_rail)) this%spec%wheel_rail%search%angle_below_axle = asked%angle_below_axle
      if (this%spec%output_level > 0 .or. this%spec%mat_file > 0 .or. this%spec%digits%s > 0) state%silent = .false.
      this%spec%limits = state%limits
      this%spec%limits%deadline%seconds = min(this%spec%limits%deadline%seconds, state%deadline%left())
      call this%spec%limits%deadline%start()
   end subroutine complete_spec

   !> Open the files of a run, or go on with those that are there
   subroutine open_all_files(state, asked, point, done)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: asked
      type(resume_point), intent(in) :: point
      logical, intent(out) :: done
      type(error_type), allocatable :: error
      character(len=:), allocatable :: version

      version = ""
      if (allocated(asked%version)) version = asked%version
      if (point%active) then
         call open_result_again(state%log%out, state%place%results // ".out", point%at%out, error, state%limits)
      else
         ! a journal of an earlier run knows nothing of what is written now
         call remove_file(journal_name(state%place%results))
         call open_out_file(state, error)
      end if
      if (.not. allocated(error)) then
         ! counting means reading all of the input: where results are few and quick, that waits until somebody needs to know
         if (asked%progress .or. asked%exports%any()) call count_planned(state)
         if (point%active) then
            call state%exports%open_files(asked%exports, state%place%results, state%place%name, version, state%run, &
               & state%limits, error, point%at)
         else
            call state%exports%open_files(asked%exports, state%place%results, state%place%name, version, state%run, &
               & state%limits, error)
         end if
      end if
      done = .not. allocated(error)
      if (allocated(error)) then
         call give_up(state, error)
         return
      end if
      if (point%active) then
         call state%journal%go_on(state%place%results, point%place, point%at, state%limits%confined)
         return
      end if
      state%silent = .not. state%exports%wanted()
      call write_banner(state%log, asked%version)
      if (allocated(state%lock%doubt)) call state%log%warning(state%lock%doubt)
      call state%journal%start(state%place%results, settings_of(asked), state%limits%confined)
   end subroutine open_all_files

   !> Tell in all files how far the run has come, and close them
   subroutine close_all_files(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      integer :: errors, k

      call state%progress%hide()
      call learn_planned(state)
      errors = state%errors
      do k = 1, number_of_exports
         call state%exports%close_file(k, state%run, error)
         if (allocated(error)) call report_error(state, error)
      end do
      call close_out_file(state)
      ! files that could not be completed can be, when there is room again
      call state%journal%finish(state%run%is_complete() .and. state%errors == errors)
   end subroutine close_all_files

   !> With what a run was asked for, as far as results depend on it
   function settings_of(asked) result(settings)
      type(run_settings), intent(in) :: asked
      type(journal_settings) :: settings

      settings%version = "-"
      if (allocated(asked%version)) settings%version = asked%version
      settings%json = allocated(asked%exports%json)
      if (settings%json) settings%json = asked%exports%json /= "-"
      settings%hdf5 = asked%exports%hdf5
      settings%vtk = asked%exports%vtk
      settings%heat_source = asked%heat_source
      settings%angle_below_axle = asked%angle_below_axle
      if (asked%limits%deadline%seconds < huge(1.0_wp)) settings%seconds = asked%limits%deadline%seconds
      if (asked%limits%bytes < huge(1_long)) settings%bytes = asked%limits%bytes
      if (asked%limits%elements < huge(1_long)) settings%elements = asked%limits%elements
   end function settings_of

   !> Find out where to go on with a run, and with what it was asked for
   subroutine find_point(state, asked, point, is_done, error)
      type(experiment_state), intent(inout) :: state
      !> On return with what the run was asked for
      type(run_settings), intent(inout) :: asked
      type(resume_point), intent(out) :: point
      !> Is there nothing left to do?
      logical, intent(out) :: is_done
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: unreadable
      type(journal_settings) :: before
      integer(long) :: ends(3)
      integer :: rows(2)
      logical :: found

      is_done = .false.
      associate (results => state%place%results)
         ends = [length_of(results // ".out"), length_of(results // ".jsonl"), length_of(results // ".pvd")]
         call read_journal(results, ends, [huge(1), huge(1)], before, found, point%at, point%place, point%letters)
         if (.not. found) then
            is_done = says_complete(results // ".out")
            if (is_done) then
               call state%log%line(" " // results // ".out is complete: there is nothing to resume")
            else
               call state%log%line(" There are no results of " // state%place%name // " to go on with: an ordinary run")
            end if
            return
         end if
         call adopt(before, asked, error)
         if (allocated(error)) return
         if (before%hdf5 .and. point%at%cases > 0) then
            allocate(state%exports%hdf5)
            call state%exports%hdf5%open_again(results // ".h5", unreadable)
            rows = 0
            if (.not. allocated(unreadable)) rows = [state%exports%hdf5%rows(patch=.false.), state%exports%hdf5%rows(patch=.true.)]
            call read_journal(results, ends, rows, before, found, point%at, point%place, point%letters)
         end if
         point%active = point%at%cases > 0
         if (point%active) then
            call state%log%line(" " // results // ": " // counted(point%at%cases, "case") // &
               & " finished before; the run goes on with the next one")
         else
            call state%log%line(" No finished case of " // state%place%name // " stands in all its files: an ordinary run")
            if (allocated(state%exports%hdf5)) then
               call state%exports%hdf5%abandon()
               deallocate(state%exports%hdf5)
            end if
         end if
      end associate
   end subroutine find_point

   !> Take what a run was asked for before; refuse what does not go with it
   subroutine adopt(before, asked, error)
      type(journal_settings), intent(in) :: before
      type(run_settings), intent(inout) :: asked
      type(error_type), allocatable, intent(out) :: error
      type(journal_settings) :: now
      character(len=:), allocatable :: what

      now = settings_of(asked)
      what = ""
      if (now%version /= before%version) what = "by version " // trim(before%version) // ", this is " // trim(now%version)
      if (allocated(asked%exports%json)) then
         if (asked%exports%json == "-") what = "into files; --json=- does not go with --resume"
         if (now%json .and. .not. before%json) what = "without --json"
      end if
      if (now%hdf5 .and. .not. before%hdf5) what = "without --hdf5"
      if (now%vtk .and. .not. before%vtk) what = "without --vtk"
      if (now%heat_source /= before%heat_source .and. now%heat_source /= heat_source%established) &
         & what = "with another kind of temperatures (--heat)"
      if (before%angle_below_axle .and. .not. now%angle_below_axle) what = "with another kind of contact angles (--contact-angle)"
      if (len(what) > 0) then
         call fatal_error(error, "the run was made " // what // ": it cannot be resumed like this; run it anew without --resume")
         return
      end if
      if (before%json) asked%exports%json = ""
      asked%exports%hdf5 = before%hdf5
      asked%exports%vtk = before%vtk
      asked%heat_source = before%heat_source
      asked%angle_below_axle = before%angle_below_axle
      if (before%seconds > 0.0_wp .and. .not. now%seconds > 0.0_wp) asked%limits%deadline%seconds = before%seconds
      if (before%bytes > 0 .and. now%bytes == 0) asked%limits%bytes = before%bytes
      if (before%elements > 0 .and. now%elements == 0) asked%limits%elements = before%elements
   end subroutine adopt

   !> Bring the memory of all contact problems to where it was, without writing
   !>
   !> A case that starts anew (P = 2, I = 0) depends on none before it: of each contact problem the last one that has done so is
   !> solved again, and all behind it. Of those before only the files are read, so that nothing is told twice.
   subroutine catch_up(state, asked, point, error)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: asked
      type(resume_point), intent(in) :: point
      type(error_type), allocatable, intent(out) :: error
      type(input_case) :: this
      type(log_type) :: quiet
      integer, allocatable :: first(:)
      integer :: j, k
      character(len=1) :: letter
      logical :: was_advised

      call first_to_solve(state, point, first, error)
      if (allocated(error)) return
      state%silent = .not. asked%exports%any()
      do j = 1, point%at%cases
         call state%reader%next_case(this, error)
         if (allocated(error)) return
         call complete_spec(state, asked, this)
         letter = point%letters(j:j)
         call is_advised(letter, was_advised)
         call find_slot(state, this%reid, this%cpid, k)
         if (j >= first(place_of(k, this%module_number))) then
            if (letter == case_letter%time) this%spec%limits%deadline%seconds = tiny(1.0_wp)
            call this%spec%limits%deadline%start()
            call solve_one(state, state%slots(k), this, quiet, error)
         else if (this%module_number == 1) then
            call open_pair(state%slots(k)%problem_slot)
            call check_files(state%slots(k)%pair, this%spec, state%place%folder, quiet, error)
         else if (was_advised .or. this%spec%kernel == kernel_model%tabulated) then
            call open_contact(state%slots(k)%problem_slot)
            call check_case(state%slots(k)%session, this%spec, quiet, state%slots(k)%result, error, state%place%folder)
            if (was_advised) state%slots(k)%session%advised = state%slots(k)%session%problem%grid
         end if
         ! what went wrong then goes wrong again, and was told
         if (allocated(error)) deallocate(error)
         call remember_files(state, state%slots(k), this%module_number)
      end do
      if (state%journal%now%files /= point%at%files) then
         call fatal_error(error, "a profile or another file that the finished cases have read is not what it was: they cannot &
            &be continued; run the experiment anew without --resume", error_kind%file)
         return
      end if
      state%hashed = state%reader%lexer%line
      state%cases = point%at%cases
      state%run%finished = point%at%cases
      state%run%ended = point%at%ended
      state%errors = point%at%errors
      state%log%warnings = point%at%warnings
      if (state%errors > 0) call fatal_error(state%first_error, "there were errors before the run was resumed, see " // &
         & state%place%results // ".out")
   end subroutine catch_up

   !> First case of each contact problem that must be solved again, by place_of; huge for none
   subroutine first_to_solve(state, point, first, error)
      type(experiment_state), intent(inout) :: state
      type(resume_point), intent(in) :: point
      integer, allocatable, intent(out) :: first(:)
      type(error_type), allocatable, intent(out) :: error
      type(experiment_reader) :: reader
      type(input_case) :: this
      integer(long) :: hash
      integer, allocatable :: longer(:)
      integer :: j, k
      character(len=1) :: letter
      logical :: ignored, is_there

      allocate(first(0))
      reader = state%reader
      call reader%rewind()
      do j = 1, point%at%cases
         call reader%next_case(this, error)
         is_there = .not. allocated(error)
         if (is_there) is_there = this%module_number /= 0 .and. this%problems%is_usable()
         if (.not. is_there) exit
         call find_slot(state, this%reid, this%cpid, k)
         k = place_of(k, this%module_number)
         if (k > size(first)) then
            allocate(longer(k + 1), source=huge(1))
            longer(:size(first)) = first
            call move_alloc(longer, first)
         end if
         letter = point%letters(j:j)
         call is_advised(letter, ignored)
         first(k) = min(first(k), j)
         if (this%spec%link == time_link%initiate .and. this%spec%estimate == estimate_choice%fresh &
            & .and. any(letter == [case_letter%solved, case_letter%not_converged])) first(k) = j
      end do
      hash = empty_hash
      call reader%lexer%hash_lines(1, reader%lexer%line, hash)
      if (is_there .and. hash == point%at%input) return
      if (allocated(error)) deallocate(error)
      call fatal_error(error, "the input was changed where it was computed already, up to case " // &
         & integer_text(point%at%cases) // ": only what stands behind it may change; run it anew without --resume", &
         & file=state%place%input)
   end subroutine first_to_solve

   !> Index of what a slot remembers of a module
   pure integer function place_of(slot, module_number) result(k)
      integer, intent(in) :: slot, module_number
      k = 2*slot - merge(1, 0, module_number == 1)
   end function place_of

   !> Take note of the files that a case has read
   subroutine remember_files(state, slot, module_number)
      type(experiment_state), intent(inout) :: state
      type(numbered_slot), intent(in) :: slot
      integer, intent(in) :: module_number

      if (module_number == 1) then
         if (.not. associated(slot%pair)) return
         call add(slot%pair%profiles%history)
         if (allocated(slot%pair%coefficients%table)) call add(slot%pair%coefficients%table%fingerprint)
      else if (associated(slot%session)) then
         if (allocated(slot%session%problem%model%tabulated)) call add(slot%session%problem%model%tabulated%fingerprint)
      end if

   contains

      subroutine add(fingerprint)
         integer(long), intent(in) :: fingerprint

         associate (hash => state%journal%now%files)
            hash = modulo(31_long*hash + modulo(fingerprint, 2147483647_long), 2147483647_long)
         end associate
      end subroutine add
   end subroutine remember_files

   !> A case is finished: how it ended, and where all files end now
   subroutine note_case(state, this, status, slot)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      type(case_status), intent(in) :: status
      type(numbered_slot), intent(in) :: slot
      character(len=1) :: letter

      state%run%finished = state%run%finished + 1
      letter = letter_of(status, this%spec%solve)
      if (this%module_number /= 1) then
         if (is_same(slot%session%advised, slot%session%problem%grid)) letter = advised(letter)
      end if
      call remember_files(state, slot, this%module_number)
      associate (now => state%journal%now, lexer => state%reader%lexer)
         call lexer%hash_lines(state%hashed + 1, lexer%line, now%input)
         state%hashed = lexer%line
         now%cases = state%run%finished
         now%out = state%log%out%place()
         call state%exports%take_ends(now)
         now%errors = state%errors
         now%warnings = state%log%warnings
         now%ended = state%run%ended
      end associate
      call state%journal%note(letter)
   end subroutine note_case

   !> Length of a file [bytes], 0 when there is none
   integer(long) function length_of(file) result(length)
      character(len=*), intent(in) :: file

      inquire(file=file, size=length)
      length = max(0_long, length)
   end function length_of

   !> Does a report end as that of a complete run?
   logical function says_complete(file) result(complete)
      character(len=*), intent(in) :: file
      integer(long), parameter :: enough = 300
      character(len=:), allocatable :: tail
      integer(long) :: length
      integer :: unit, status

      complete = .false.
      length = length_of(file)
      if (length == 0) return
      allocate(character(len=int(min(enough, length))) :: tail)
      open(newunit=unit, file=file, access="stream", action="read", status="old", iostat=status)
      if (status /= 0) return
      read(unit, pos=length - len(tail) + 1, iostat=status) tail
      close(unit)
      complete = status == 0 .and. index(tail, " CONTACT ended ") > 0 .and. index(tail, " Not complete: ") == 0
   end function says_complete

   !> Hand what is written to the system, so that it outlives this process; in a run with a limit count the HDF5 file
   subroutine keep_files_current(state)
      type(experiment_state), intent(inout) :: state
      !> What a killed run computes anew when it is resumed [s]
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

   !> Check, solve and write one case
   subroutine compute_case(state, this, go_on)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      !> Can the next case be read?
      logical, intent(out) :: go_on
      type(error_type), allocatable :: error
      type(case_head) :: head
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
         call refusal_of(this, reason)
         call head%status%refuse(reason)
         head%finished = state%run%finished
         state%run%reason = reason
         call count_case(state, head%status)
         if (state%exports%wanted()) call state%exports%write_failure(head)
         return
      end if

      call find_slot(state, this%reid, this%cpid, k)
      associate (slot => state%slots(k))
         if (this%spec%solve) then
            call estimate_cost(this%spec, cost)
            if (cost%seconds > large_seconds .or. cost%bytes > large_bytes) call state%log%line( &
               & " Estimate of this case on one thread: " // trim(cost_text(cost)))
         end if
         solving_before = state%solving%wall
         call state%solving%start()
         state%log%level = this%spec%flow_level
         call solve_one(state, slot, this, state%log, error)
         call state%solving%halt()
         head%seconds = state%solving%wall - solving_before
         if (allocated(error)) then
            if (error%kind == error_kind%time) then
               call head%status%run_out_of_time(full_text(error))
            else
               call head%status%refuse(full_text(error))
            end if
         else if (this%module_number == 1) then
            head%status = slot%pair_result%status
         else
            head%status = slot%result%status
         end if
         if (allocated(error) .or. this%spec%solve) call count_case(state, head%status)
         if (allocated(error)) then
            if (state%exports%wanted()) call state%exports%write_failure(head)
            call place_error(state, this, error)
            call add_context(error, "case " // integer_text(this%number))
            if (this%reid > 0) call add_context(error, "result element " // integer_text(this%reid))
            call report_error(state, error)
         else if (this%module_number == 1) then
            call state%writing%start()
            if (this%spec%solve) then
               call write_pair(state%log, this%spec, slot%pair_result)
               call write_pair_files(state%place%results, this%number, this%reid, this%spec, slot%pair_result, error)
               if (allocated(error)) call report_error(state, error)
               if (state%exports%wanted()) then
                  call state%exports%write_pair(head, this%spec, slot%pair, slot%pair_result, error)
                  if (allocated(error)) call report_error(state, error)
               end if
            end if
            call state%writing%halt()
         else if (this%spec%solve) then
            call state%writing%start()
            call write_results(state, this, slot%result)
            if (state%exports%wanted()) then
               call state%exports%write_contact(head, this%spec, slot%result, error)
               if (allocated(error)) call report_error(state, error)
            end if
            call state%writing%halt()
         end if
         call note_case(state, this, head%status, slot)
      end associate
   end subroutine compute_case

   !> Solve a case of either module
   subroutine solve_one(state, slot, this, log, error)
      type(experiment_state), intent(in) :: state
      type(numbered_slot), intent(inout) :: slot
      type(input_case), intent(in) :: this
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error

      if (this%module_number == 1) then
         call open_pair(slot%problem_slot)
         call solve_pair_case(slot%pair, this%spec, state%place%folder, log, slot%pair_result, error)
      else
         call open_contact(slot%problem_slot)
         call solve_case(slot%session, this%spec, log, slot%result, error, state%place%folder)
      end if
   end subroutine solve_one

   !> Count a case by how it ended
   subroutine count_case(state, status)
      type(experiment_state), intent(inout) :: state
      type(case_status), intent(in) :: status

      state%run%ended(status%state) = state%run%ended(status%state) + 1
   end subroutine count_case

   !> Why the input of a case cannot be used: its first error
   subroutine refusal_of(this, reason)
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
   end subroutine refusal_of

   !> Report, .mat and .subs file of a solved case
   subroutine write_results(state, this, result)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      type(patch_result), intent(in) :: result
      type(error_type), allocatable :: error

      call write_case(state%log, this%spec, result)
      if (this%spec%mat_file >= 1) then
         call write_mat_file(mat_file_name(state%place%results, this%number, this%reid, 0), this%spec, result, result%status, &
            & error)
         if (allocated(error)) call report_error(state, error)
      end if
      if (this%spec%digits%s < 1 .or. .not. allocated(result%subsurface)) return
      call write_subsurface(state%log, this%spec, result)
      if (this%spec%subsurface%matfil >= 1) then
         call write_subs_file(subs_file_name(state%place%results, this%number, this%reid, 0), this%spec, result, error)
         if (allocated(error)) call report_error(state, error)
      end if
   end subroutine write_results

   !> Index of the slot of a result element and patch, which is made when it is new
   subroutine find_slot(state, reid, cpid, k)
      type(experiment_state), intent(inout) :: state
      integer, intent(in) :: reid, cpid
      integer, intent(out) :: k
      type(numbered_slot), allocatable :: longer(:)

      do k = 1, state%used
         if (state%slots(k)%reid == reid .and. state%slots(k)%cpid == cpid) return
      end do
      if (state%used == size(state%slots)) then
         allocate(longer(2*state%used))
         longer(:state%used) = state%slots
         call move_alloc(longer, state%slots)
      end if
      state%used = state%used + 1
      k = state%used
      state%slots(k)%reid = reid
      state%slots(k)%cpid = cpid
   end subroutine find_slot

   !> Number of cases in the input, as far as it can be read
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
      ! the error stands in one more case
      state%run%planned = state%run%planned + 1
      state%run%readable = .false.
   end subroutine count_planned

   !> What was planned, if that was not counted yet
   subroutine learn_planned(state)
      type(experiment_state), intent(inout) :: state

      if (state%run%planned > 0) return
      state%run%planned = state%run%finished
      if (allocated(state%run%reason)) call count_planned(state)
   end subroutine learn_planned

   !> Tell the error that ends the run before all cases are finished
   subroutine give_up(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), intent(in) :: error

      call report_error(state, error)
      state%run%reason = full_text(error)
   end subroutine give_up

   !> An error without a place belongs to its case as a whole: where that begins in the input
   subroutine place_error(state, this, error)
      type(experiment_state), intent(in) :: state
      type(input_case), intent(in) :: this
      type(error_type), intent(inout) :: error

      if (allocated(error%file)) return
      error%file = state%place%input
      error%line = this%first_line
   end subroutine place_error

   !> Write an error to the .out file and to the unit for errors, and remember the first
   subroutine report_error(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), intent(in) :: error

      call write_error(state, " ERROR. " // full_text(error))
      state%errors = state%errors + 1
      if (.not. allocated(state%first_error)) state%first_error = error
   end subroutine report_error

   !> Write the problems of a case: warnings to the log, errors as report_error does
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

   !> A line to the .out file and to the unit for errors, after what stands on the screen already
   subroutine write_error(state, text)
      type(experiment_state), intent(inout) :: state
      character(len=*), intent(in) :: text
      integer :: status

      call state%log%result(text)
      if (state%complaints == no_unit) return
      call state%progress%hide()
      if (state%log%screen /= 0) flush(state%log%screen, iostat=status)
      write(state%complaints, '(A)') text
      flush(state%complaints, iostat=status)
   end subroutine write_error

   !> Open the .out file of the run
   subroutine open_out_file(state, error)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable, intent(out) :: error

      call open_result(state%log%out, state%place%results // ".out", state%place%results // ".out", error, state%limits)
   end subroutine open_out_file

   !> Timers and closing lines, and the end of the .out file
   subroutine close_out_file(state)
      type(experiment_state), intent(inout) :: state
      type(error_type), allocatable :: error
      type(timer_line) :: lines(4)

      ! the end is told in any case
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
