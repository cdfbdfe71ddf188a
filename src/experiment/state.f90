!> Settings of a run, and its state from case to case
module contact_experiment_state
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : heat_source
   use contact_base_error, only : error_kind, error_type, full_text
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits, deadline_type
   use contact_base_log, only : log_type
   use contact_cases_accuracy, only : solve_contact_case
   use contact_cases_slot, only : open_contact, open_wheel_rail, problem_slot
   use contact_cases_spec, only : case_spec
   use contact_cases_wheel_rail_accuracy, only : solve_wheel_on_rail
   use contact_experiment_exports, only : export_files, export_request
   use contact_experiment_journal, only : journal_file
   use contact_experiment_lock, only : experiment_lock
   use contact_experiment_place, only : experiment_place
   use contact_experiment_progress, only : progress_line
   use contact_experiment_stopwatch, only : stopwatch
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_output_case_record, only : case_head, run_summary
   use contact_text_words, only : columns_of, integer_text
   implicit none (type, external)
   private

   public :: apply_settings, as_input_says, counted, experiment_state, find_slot, no_unit, numbered_slot, run_settings, &
      & solve_one, stop_question

   !> Temperatures as selected in the input; the established format has no selection and implies the established method
   integer, parameter :: as_input_says = -1
   !> No unit; 0 is the standard error stream of gfortran
   integer, parameter :: no_unit = -1

   abstract interface
      !> Is the run to end after the current case? Called between cases
      subroutine stop_question(reason)
         implicit none (type, external)
         !> Reason, such as "signal TERM"; unallocated: continue
         character(len=:), allocatable, intent(out) :: reason
      end subroutine stop_question
   end interface

   !> Settings of a run
   type :: run_settings
      !> Name of the experiment, with or without folder and suffix .inp
      character(len=:), allocatable :: experiment
      !> Folder of the results; unallocated or "": folder of the input
      character(len=:), allocatable :: output_folder
      !> Version for the banner; unallocated: omitted
      character(len=:), allocatable :: version
      !> Only read and check the cases, without writing files?
      logical :: check_only = .false.
      !> Number of threads; 0: default
      integer :: threads = 0
      !> Unit of the log on the screen; 0: none
      integer :: screen = 0
      !> Unit for errors, or no_unit
      integer :: complaints = no_unit
      !> Show a progress line on the terminal?
      logical :: progress = .false.
      !> Limits of each case, and restriction of the run to its folder
      type(case_limits) :: limits
      !> Limits of the run: time, and total size of all files [bytes]
      type(deadline_type) :: run_deadline
      integer(long) :: output_bytes = huge(1_long)
      !> Called between cases to check whether the run is to end; null: never
      procedure(stop_question), pointer, nopass :: stop_requested => null()
      !> Is a case that does not converge a failure of the run?
      logical :: strict = .false.
      !> Optional files for other programs
      type(export_request) :: exports
      !> Method for temperatures, member of heat_source, or as_input_says
      integer :: heat_source = as_input_says
      !> Order of the discretisation of rolling, 1 or 2, or as_input_says
      integer :: order = as_input_says
      !> Requested bound of the relative error of the forces [-]; 0: as in the input
      real(wp) :: accuracy = 0.0_wp
      !> Allow simplified methods for an accuracy, regardless of the input?
      logical :: allows_approximate = .false.
      !> Contact angles on rails that vary along the track: of the section below the axle, as in the established program?
      logical :: angle_below_axle = .true.
      !> Run the classical solvers selected by cases?
      logical :: classical = .false.
      !> Estimate the errors of the totals?
      logical :: errors = .false.
      !> Resume a run that ended before all cases were finished?
      logical :: resume = .false.
   end type run_settings

   !> Contact problem of one result element and contact patch
   type, extends(problem_slot) :: numbered_slot
      integer :: reid = 0, cpid = 1
      !> Modules of which a case had errors when the input was checked; their values are kept separately
      logical :: refused(3) = .false.
   end type numbered_slot

   !> State of a run from case to case
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
      !> Numbers of cases read, and of errors
      integer :: cases = 0, errors = 0
      !> Planned and finished cases
      type(run_summary) :: run
      !> Was the run requested to end?
      logical :: interrupted = .false.
      !> Has no case requested results so far?
      logical :: silent = .true.
      !> The first error; unallocated: none
      type(error_type), allocatable :: first_error
      type(stopwatch) :: total, reading, solving, writing
      !> Limits of each case, and remaining size of the output
      type(case_limits) :: limits
      type(deadline_type) :: deadline
      !> Size of the HDF5 file when last determined
      integer(long) :: hdf5_bytes = 0
      !> Journal for `--resume`, and the last line of the input that is included in its hash
      type(journal_file) :: journal
      integer :: hashed = 0
      !> Time when the journal was last flushed, see wall_clock
      real(wp) :: last_save = 0.0_wp
      !> The current case, if any
      type(case_head) :: head
      logical :: in_case = .false.
   end type experiment_state

contains

   !> Index of the slot of a result element and patch; a new slot is created if needed
   subroutine find_slot(state, reid, cpid, k)
      type(experiment_state), intent(inout) :: state
      !> Numbers of the result element and of the contact problem in it
      integer, intent(in) :: reid, cpid
      !> Index in the list of slots of the experiment
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

   !> Solve a case of either module
   subroutine solve_one(state, slot, this, log, status, solved, error)
      type(experiment_state), intent(in) :: state
      !> Contact problem of the case
      type(numbered_slot), intent(inout) :: slot
      type(input_case), intent(in) :: this
      type(log_type), intent(inout) :: log
      !> Final status
      type(case_status), intent(inout) :: status
      !> The case with the settings chosen for its accuracy; unallocated if none was requested
      type(case_spec), allocatable, intent(out) :: solved
      type(error_type), allocatable, intent(out) :: error

      if (this%module_number == 1) then
         call open_wheel_rail(slot%problem_slot)
         call solve_wheel_on_rail(slot%wheel_rail, this%spec, state%place%folder, log, slot%wheel_rail_result, solved, error)
         if (.not. allocated(error)) status = slot%wheel_rail_result%status
      else
         call open_contact(slot%problem_slot)
         call solve_contact_case(slot%session, this%spec, log, slot%result, solved, error, state%place%folder)
         if (.not. allocated(error)) status = slot%result%status
      end if
      if (.not. allocated(error)) return
      if (error%kind == error_kind%time) then
         call status%run_out_of_time(full_text(error))
      else
         call status%refuse(full_text(error))
      end if
   end subroutine solve_one

   !> Apply the settings of the run to a case
   subroutine apply_settings(state, requested, this)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: requested
      type(input_case), intent(inout) :: this

      if (requested%heat_source /= as_input_says) this%spec%heat%source = requested%heat_source
      if (requested%order /= as_input_says) this%spec%iteration%order = requested%order
      if (requested%accuracy > 0.0_wp) this%spec%iteration%accuracy = requested%accuracy
      if (requested%allows_approximate) this%spec%iteration%allows_approximate = .true.
      if (allocated(this%spec%wheel_rail)) this%spec%wheel_rail%search%angle_below_axle = requested%angle_below_axle
      this%spec%classical = requested%classical
      if (requested%errors) this%spec%estimates_errors = .true.
      if (this%spec%output_level > 0 .or. this%spec%mat_file > 0 .or. this%spec%has_stress) state%silent = .false.
      this%spec%limits = state%limits
      this%spec%limits%deadline%seconds = min(this%spec%limits%deadline%seconds, state%deadline%left())
      call this%spec%limits%deadline%start()
   end subroutine apply_settings

   !> Number with noun: "1 case", "2 cases"
   pure function counted(n, what) result(text)
      !> Number
      integer, intent(in) :: n
      !> Noun in the singular
      character(len=*), intent(in) :: what
      character(len=columns_of(n) + 1 + len(what) + merge(0, 1, n == 1)) :: text

      text = integer_text(n) // " " // what
      if (n /= 1) text(len(text):) = "s"
   end function counted
end module contact_experiment_state
