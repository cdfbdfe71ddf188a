!> Resuming a run that ended before all cases were finished
!>
!> Each finished case is recorded in the journal. A resumed run reads the ends of the files from it, restores the memory of all
!> contact problems, and continues with the next case.
module contact_experiment_resume
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : estimate_choice, kernel_model, time_link
   use contact_base_case_status, only : case_status
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_log, only : log_type
   use contact_cases_border_warning, only : is_same
   use contact_cases_wheel_rail_session, only : check_files
   use contact_cases_session, only : check_case
   use contact_cases_slot, only : open_contact, open_wheel_rail, problem_slot
   use contact_cases_spec, only : case_spec
   use contact_experiment_journal, only : advised, case_letter, checkpoint, is_advised, journal_settings, letter_of, &
      & read_journal
   use contact_experiment_place, only : written_in_place
   use contact_experiment_state, only : apply_settings, as_input_says, counted, experiment_state, find_slot, numbered_slot, &
      & run_settings, solve_one
   use contact_input_experiment_file, only : experiment_reader, input_case
   use contact_text_file_text, only : empty_hash
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: find_resume_point, record_case, restore_state, resume_point, settings_of

   !> State from which a run is resumed
   type :: resume_point
      !> Are there finished cases?
      logical :: active = .false.
      type(checkpoint) :: at
      !> End of the corresponding line in the journal [bytes]
      integer(long) :: place = 0
      !> Final status of the finished cases, see case_letter
      character(len=:), allocatable :: letters
   end type resume_point

contains

   !> Settings of a run that affect its results
   function settings_of(requested) result(settings)
      type(run_settings), intent(in) :: requested
      type(journal_settings) :: settings

      settings%version = "-"
      if (allocated(requested%version)) settings%version = requested%version
      settings%json = allocated(requested%exports%json)
      if (settings%json) settings%json = requested%exports%json /= "-"
      settings%hdf5 = requested%exports%hdf5
      settings%vtk = requested%exports%vtk
      settings%heat_source = requested%heat_source
      settings%angle_below_axle = requested%angle_below_axle
      settings%classical = requested%classical
      settings%errors = requested%errors
      settings%order = requested%order
      settings%accuracy = requested%accuracy
      settings%allows_approximate = requested%allows_approximate
      if (requested%limits%deadline%seconds < huge(1.0_wp)) settings%seconds = requested%limits%deadline%seconds
      if (requested%limits%bytes < huge(1_long)) settings%bytes = requested%limits%bytes
      if (requested%limits%elements < huge(1_long)) settings%elements = requested%limits%elements
   end function settings_of

   !> Determine where to resume a run, and its settings
   subroutine find_resume_point(state, requested, point, is_done, error)
      type(experiment_state), intent(inout) :: state
      !> On return the settings of the earlier run
      type(run_settings), intent(inout) :: requested
      !> Start of the run if there is nothing to resume
      type(resume_point), intent(out) :: point
      !> Are all cases finished?
      logical, intent(out) :: is_done
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: unreadable
      type(journal_settings) :: before
      integer(long) :: ends(size(written_in_place))
      integer :: rows(2), k
      logical :: found

      is_done = .false.
      associate (results => state%place%results)
         ends = [(length_of(results // trim(written_in_place(k))), k = 1, size(ends))]
         call read_journal(results, ends, [huge(1), huge(1)], before, found, point%at, point%place, point%letters)
         if (.not. found) then
            is_done = ends_complete(results // ".out")
            if (is_done) then
               call state%log%line(" " // results // ".out is complete: there is nothing to resume")
            else
               call state%log%line(" There are no results of " // state%place%name // " to continue: an ordinary run")
            end if
            return
         end if
         call adopt_settings(before, requested, error)
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
               & " finished before; the run continues with the next one")
         else
            call state%log%line(" No finished case of " // state%place%name // " is in all its files: an ordinary run")
            if (allocated(state%exports%hdf5)) then
               call state%exports%hdf5%abandon()
               deallocate(state%exports%hdf5)
            end if
         end if
      end associate
   end subroutine find_resume_point

   !> Adopt the settings of the earlier run; refuse those that contradict it
   subroutine adopt_settings(before, requested, error)
      type(journal_settings), intent(in) :: before
      type(run_settings), intent(inout) :: requested
      type(error_type), allocatable, intent(out) :: error
      type(journal_settings) :: now
      character(len=:), allocatable :: what

      now = settings_of(requested)
      what = ""
      if (now%version /= before%version) what = "by version " // trim(before%version) // ", this is " // trim(now%version)
      if (allocated(requested%exports%json)) then
         if (requested%exports%json == "-") what = "into files; --json=- does not go with --resume"
         if (now%json .and. .not. before%json) what = "without --json"
      end if
      if (now%hdf5 .and. .not. before%hdf5) what = "without --hdf5"
      if (now%vtk .and. .not. before%vtk) what = "without --vtk"
      if (now%heat_source /= before%heat_source .and. now%heat_source /= as_input_says) &
         & what = "with another kind of temperatures (--heat)"
      if (now%order /= before%order .and. now%order /= as_input_says) what = "with another order of the discretisation (--order)"
      if (before%angle_below_axle .and. .not. now%angle_below_axle) what = "with another kind of contact angles (--contact-angle)"
      if (now%classical .and. .not. before%classical) what = "with the default solver (--classical)"
      if (now%accuracy > 0.0_wp .and. abs(now%accuracy - before%accuracy) > 0.0_wp) what = "with another accuracy (--accuracy)"
      if (now%allows_approximate .and. .not. before%allows_approximate) what = "without --allow approximate"
      if (now%errors .and. .not. before%errors) what = "without --errors"
      if (len(what) > 0) then
         call fatal_error(error, "the run was made " // what // ": it cannot be resumed like this; run it again without --resume")
         return
      end if
      if (before%json) requested%exports%json = ""
      requested%exports%hdf5 = before%hdf5
      requested%exports%vtk = before%vtk
      requested%heat_source = before%heat_source
      requested%angle_below_axle = before%angle_below_axle
      requested%classical = before%classical
      requested%errors = before%errors
      requested%order = before%order
      requested%accuracy = before%accuracy
      requested%allows_approximate = before%allows_approximate
      if (before%seconds > 0.0_wp .and. .not. now%seconds > 0.0_wp) requested%limits%deadline%seconds = before%seconds
      if (before%bytes > 0 .and. now%bytes == 0) requested%limits%bytes = before%bytes
      if (before%elements > 0 .and. now%elements == 0) requested%limits%elements = before%elements
   end subroutine adopt_settings

   !> Restore the memory of all contact problems, without writing
   !>
   !> A case that starts anew (P = 2, I = 0) is independent of earlier ones. Of each contact problem the last such case is
   !> solved again, and all later cases. Of earlier cases only the files are read, so that messages are not repeated.
   subroutine restore_state(state, requested, point, error)
      type(experiment_state), intent(inout) :: state
      type(run_settings), intent(in) :: requested
      !> State found by find_resume_point
      type(resume_point), intent(in) :: point
      type(error_type), allocatable, intent(out) :: error
      type(input_case) :: this
      type(log_type) :: quiet
      type(case_status) :: ended
      type(case_spec), allocatable :: solved
      integer, allocatable :: first(:)
      integer :: j, k
      character(len=1) :: letter
      logical :: was_advised

      quiet%terms => state%log%terms
      call first_to_solve(state, point, first, error)
      if (allocated(error)) return
      state%silent = .not. requested%exports%any()
      do j = 1, point%at%cases
         call state%reader%next_case(this, error)
         if (allocated(error)) return
         call apply_settings(state, requested, this)
         letter = point%letters(j:j)
         call is_advised(letter, was_advised)
         call find_slot(state, this%reid, this%cpid, k)
         if (j >= first(place_of(k, this%module_number))) then
            if (letter == case_letter%time) this%spec%limits%deadline%seconds = tiny(1.0_wp)
            call this%spec%limits%deadline%start()
            call solve_one(state, state%slots(k), this, quiet, ended, solved, error)
         else if (this%module_number == 1) then
            call open_wheel_rail(state%slots(k)%problem_slot)
            call check_files(state%slots(k)%wheel_rail, this%spec, state%place%folder, quiet, error)
         else if (was_advised .or. this%spec%kernel == kernel_model%tabulated) then
            call open_contact(state%slots(k)%problem_slot)
            call check_case(state%slots(k)%session, this%spec, quiet, state%slots(k)%result, error, state%place%folder)
            if (was_advised) state%slots(k)%session%advised = state%slots(k)%session%problem%grid
         end if
         ! failures repeat, and were reported before
         if (allocated(error)) deallocate(error)
         call record_files(state, state%slots(k), this%module_number)
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
   end subroutine restore_state

   !> First case of each contact problem that must be solved again, indexed by place_of; huge: none
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
         & integer_text(point%at%cases) // ": only later cases may be changed; run it again without --resume", &
         & file=state%place%input)
   end subroutine first_to_solve

   !> Index of the memory of a slot for a module
   pure integer function place_of(slot, module_number) result(k)
      integer, intent(in) :: slot, module_number
      k = 2*slot - merge(1, 0, module_number == 1)
   end function place_of

   !> Record the files read by a case
   subroutine record_files(state, slot, module_number)
      type(experiment_state), intent(inout) :: state
      type(numbered_slot), intent(in) :: slot
      integer, intent(in) :: module_number

      if (module_number == 1) then
         if (.not. associated(slot%wheel_rail)) return
         call add(slot%wheel_rail%profiles%history)
         if (allocated(slot%wheel_rail%coefficients%table)) call add(slot%wheel_rail%coefficients%table%fingerprint)
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
   end subroutine record_files

   !> Record a finished case: its final status, and the current ends of all files
   subroutine record_case(state, this, status, slot)
      type(experiment_state), intent(inout) :: state
      type(input_case), intent(in) :: this
      type(case_status), intent(in) :: status
      !> Contact problem of the case
      type(numbered_slot), intent(in) :: slot
      character(len=1) :: letter

      state%run%finished = state%run%finished + 1
      letter = letter_of(status, this%spec%solve)
      if (this%module_number /= 1) then
         if (is_same(slot%session%advised, slot%session%problem%grid)) letter = advised(letter)
      end if
      call record_files(state, slot, this%module_number)
      associate (now => state%journal%now, lexer => state%reader%lexer)
         call lexer%hash_lines(state%hashed + 1, lexer%line, now%input)
         state%hashed = lexer%line
         now%cases = state%run%finished
         now%out = state%log%out%place()
         call state%exports%record_ends(now)
         now%errors = state%errors
         now%warnings = state%log%warnings
         now%ended = state%run%ended
      end associate
      call state%journal%record(letter)
   end subroutine record_case

   !> Length of a file [bytes], 0 if it does not exist
   integer(long) function length_of(file) result(length)
      character(len=*), intent(in) :: file

      inquire(file=file, size=length)
      length = max(0_long, length)
   end function length_of

   !> Does a report end like that of a complete run?
   logical function ends_complete(file) result(complete)
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
   end function ends_complete
end module contact_experiment_resume
