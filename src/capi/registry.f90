!> Runs of the library and the problems of its callers
!>
!> Access to a problem is between `enter` and `leave`, during which no other thread can change or free it.
module contact_capi_registry
   use, intrinsic :: iso_c_binding, only : c_int, c_loc, c_null_ptr
   use, intrinsic :: iso_fortran_env, only : output_unit
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_set_lock, omp_set_num_threads, &
      & omp_test_lock, omp_unset_lock
   use contact_base_guard, only : set_owner
   use contact_base_log, only : log_type
   use contact_base_output_file, only : output_file
   use contact_capi_files, only : place_result, set_folders
   use contact_capi_host, only : begin_turn, call_stage, end_turn, give_floats_back, hold_floats, is_forked, note_call
   use contact_capi_library, only : element_slot, entry_type, finalised, library, max_elements, running, units_given, virgin
   use contact_capi_messages, only : begin_setting, report_error, end_setting, forget_error, set_last_error
   use contact_capi_problem, only : library_problem, max_patches, new_problem, release_problem
   use contact_capi_timers, only : book_times, write_timers
   use contact_control_library_codes, only : code_text, library_code
   use contact_experiment_stopwatch, only : stopwatch
   use contact_output_report, only : write_banner
   implicit none (type, external)
   private

   public :: scope_type, scope, enter, enter_calculation, leave, leave_calculation
   public :: forget_call, is_setting
   public :: start_library, stop_library, is_running, register_element, remove_element, record_units
   public :: set_threads, max_threads

   !> Maximum number of simultaneous result elements
   integer, parameter :: max_active = 100

   !> Result elements and patches accepted by a routine
   type :: scope_type
      !> Accepted modules
      logical :: wheel_rail = .true., contact = .true.
      !> In module 1: wheel and rail as a whole, one patch
      logical :: whole = .true., patch = .true.
   end type scope_type

   type :: scope_list
      !> Settings: wheel and rail as a whole, or a contact problem
      type(scope_type) :: settings = scope_type(patch=.false.)
      !> Results of one patch, in both modules; also results of wheel and rail as a whole
      type(scope_type) :: one_patch = scope_type(whole=.false.)
      type(scope_type) :: any = scope_type()
      !> Module 1 only: as a whole, one patch, both
      type(scope_type) :: wheel_rail = scope_type(contact=.false., patch=.false.)
      type(scope_type) :: wheel_rail_patch = scope_type(contact=.false., whole=.false.)
      type(scope_type) :: wheel_rail_any = scope_type(contact=.false.)
      !> Module 3 only
      type(scope_type) :: contact = scope_type(wheel_rail=.false.)
   end type scope_list
   !> Scopes of routines
   type(scope_list), parameter :: scope = scope_list()

contains

   !> Is the library initialised?
   logical function is_running()
      !$omp critical (contact_registry)
      is_running = library%phase == running
      !$omp end critical (contact_registry)
   end function is_running

   !> Record unit numbers; they are not needed, since every file uses a free one
   subroutine record_units(accepted)
      !> False if it is too late
      logical, intent(out) :: accepted

      !$omp critical (contact_registry)
      accepted = library%phase == virgin
      if (accepted) library%phase = units_given
      !$omp end critical (contact_registry)
   end subroutine record_units

   !> Start a run: folders, name, .out file; nothing if a run is in progress
   subroutine start_library(work_folder, out_folder, name, screen, started)
      !> Folders and name of the experiment; "" for the previous value or the default
      character(len=*), intent(in) :: work_folder, out_folder, name
      !> Are messages written to the screen as well?
      logical, intent(in) :: screen
      !> False if a run was in progress
      logical, intent(out) :: started

      !$omp critical (contact_registry)
      started = library%phase /= running
      if (started) call begin_run(work_folder, out_folder, name, screen)
      !$omp end critical (contact_registry)
   end subroutine start_library

   !> The same inside the critical section
   subroutine begin_run(work_folder, out_folder, name, screen)
      character(len=*), intent(in) :: work_folder, out_folder, name
      logical, intent(in) :: screen
      type(log_type) :: fresh
      character(len=:), allocatable :: path, reason
      integer :: i, k

      call set_folders(work_folder, out_folder, name)
      library%log = fresh
      if (screen) library%log%screen = output_unit
      call place_result(library%name // ".out", path)
      call library%log%out%open_file(path, reason)
      library%phase = running
      library%input_dump = output_file()
      library%dump_was_tried = .false.
      library%max_threads = max(1, min(999, omp_get_max_threads()))
      library%threads = 1
      library%total = stopwatch()
      do k = 1, max_elements
         library%elements(k)%patch%timed_module = 0
         library%elements(k)%patch%total = stopwatch()
         library%elements(k)%patch%stresses = stopwatch()
         do i = 1, max_patches
            if (associated(library%elements(k)%patch(i)%written)) deallocate(library%elements(k)%patch(i)%written)
         end do
      end do
      call library%total%start()
      call write_banner(library%log)
      if (allocated(reason)) call set_last_error(-1, "the file " // path // " cannot be written: " // reason)
   end subroutine begin_run

   !> Register a result element; an active one is unchanged
   subroutine register_element(ire, module_number, code, was_active)
      !> Index of the result element, and its module: 1 or 3
      integer, intent(in) :: ire, module_number
      !> Member of library_code
      integer, intent(out) :: code
      !> Was it registered already?
      logical, intent(out) :: was_active

      !$omp critical (contact_registry)
      was_active = .false.
      if (ire < 1 .or. ire > max_elements) then
         code = library_code%bad_element
      else
         was_active = library%elements(ire)%module_number /= 0
         call activate(ire, module_number, code)
      end if
      !$omp end critical (contact_registry)
   end subroutine register_element

   !> Activate a result element, inside the critical section
   subroutine activate(ire, module_number, code)
      integer, intent(in) :: ire, module_number
      integer, intent(out) :: code

      code = library_code%success
      if (library%phase /= running) call begin_run("", "", "", .false.)
      if (library%elements(ire)%module_number /= 0) return
      if (library%active_elements >= max_active) then
         code = library_code%not_allowed
         return
      end if
      library%active_elements = library%active_elements + 1
      library%elements(ire)%module_number = module_number
   end subroutine activate

   !> Find the problem of a call and exclude other threads from it until `leave`
   !>
   !> On failure the problem is null, the code gives the reason, and a message is logged. A problem that does not exist yet is
   !> created with its defaults, as callers of the published interface expect.
   subroutine enter(call_of, allowed, problem, code)
      type(entry_type), intent(in) :: call_of
      !> Modules and kinds of problems accepted by the routine
      type(scope_type), intent(in) :: allowed
      type(library_problem), pointer, intent(out) :: problem
      !> Member of library_code
      integer, intent(out), optional :: code
      integer :: found

      call look_up(call_of, allowed, problem, found)
      if (associated(problem)) then
         call omp_set_lock(problem%lock)
         call come_in(problem)
         call problem%kept%use_again()
         call check_patch(call_of, problem, found)
         if (found /= library_code%success) then
            call leave(problem)
         else if (is_setting(call_of)) then
            call begin_setting(problem, call_of)
         end if
      end if
      if (found /= library_code%success) call report_error(call_of, trim(code_text(found)), found)
      if (present(code)) code = found
   end subroutine enter

   !> Does a routine make a setting, which calculations require?
   pure logical function is_setting(call_of)
      type(entry_type), intent(in) :: call_of
      is_setting = index(call_of%name, "cntc_set") == 1 .or. index(call_of%name, "subs_add") == 1
   end function is_setting

   !> The same for a calculation: it does not wait for another thread in the same problem, but for its turn if the maximum number
   !> of calculations is running; it uses the allowed number of threads
   subroutine enter_calculation(call_of, allowed, problem, code)
      type(entry_type), intent(in) :: call_of
      !> Modules and kinds of problems accepted by the routine
      type(scope_type), intent(in) :: allowed
      type(library_problem), pointer, intent(out) :: problem
      !> Member of library_code
      integer, intent(out) :: code

      call look_up(call_of, allowed, problem, code)
      if (associated(problem)) then
         if (.not. omp_test_lock(problem%lock)) then
            code = library_code%in_use
            call forget_user(problem)
            nullify(problem)
         end if
      end if
      if (associated(problem)) then
         call come_in(problem)
         call check_patch(call_of, problem, code)
         if (code == library_code%success) then
            call begin_turn(int(max_threads(), c_int))
            call note_call(c_loc(problem), call_stage%calculation)
            call set_owner(problem%owner)
            ! arrays of wheel and rail follow a contact that moves
            if (problem%module_number == 1) call problem%kept%use_them()
            call forget_error(problem)
            problem%threads_of_caller = omp_get_max_threads()
            call omp_set_num_threads(threads_inside())
         end if
         if (code /= library_code%success) call leave(problem)
      end if
      if (code /= library_code%success) call report_error(call_of, trim(code_text(code)), code)
   end subroutine enter_calculation

   !> Update the maximum number of threads, which callers may increase at any time
   subroutine see_threads()
      library%max_threads = min(999, max(library%max_threads, omp_get_max_threads(), omp_get_num_threads()))
   end subroutine see_threads

   !> Find the problem of a call and register one more user; null if the call is invalid
   subroutine look_up(call_of, allowed, problem, code)
      type(entry_type), intent(in) :: call_of
      type(scope_type), intent(in) :: allowed
      type(library_problem), pointer, intent(out) :: problem
      integer, intent(out) :: code

      nullify(problem)
      !$omp critical (contact_registry)
      code = library_code%bad_element
      if (call_of%ire >= 1 .and. call_of%ire <= max_elements) &
         & call activate(call_of%ire, merge(3, 1, call_of%icp > 0), code)
      if (code == library_code%success) then
         associate (element => library%elements(call_of%ire))
            code = misuse(element%module_number, call_of%icp, allowed)
            if (code == library_code%success) then
               associate (slot => element%patch(merge(call_of%icp, 1, element%module_number == 3)))
                  if (.not. associated(slot%p)) slot%p => new_problem(call_of%ire, merge(call_of%icp, -1, &
                     & element%module_number == 3), element%module_number)
                  slot%p%users = slot%p%users + 1
                  problem => slot%p
                  call note_call(c_loc(slot%p), call_stage%user)
               end associate
            end if
         end associate
      end if
      !$omp end critical (contact_registry)
   end subroutine look_up

   !> Reason why a call is invalid for a module; success if it is valid
   pure integer function misuse(module_number, icp, allowed) result(code)
      integer, intent(in) :: module_number, icp
      type(scope_type), intent(in) :: allowed

      code = library_code%success
      if (module_number == 1) then
         if (.not. allowed%wheel_rail) then
            code = library_code%not_module_1
         else if (icp /= -1 .and. (icp < 1 .or. icp > max_patches)) then
            code = library_code%bad_patch
         else if (icp == -1 .and. .not. allowed%whole) then
            code = library_code%patch_needed
         else if (icp > 0 .and. .not. allowed%patch) then
            code = library_code%patch_unwanted
         end if
      else if (.not. allowed%contact) then
         code = library_code%not_module_3
      else if (icp < 1 .or. icp > max_patches) then
         code = library_code%bad_patch
      end if
   end function misuse

   !> Check that a patch of module 1 exists in the result of the last calculation
   pure subroutine check_patch(call_of, problem, code)
      type(entry_type), intent(in) :: call_of
      type(library_problem), intent(in) :: problem
      integer, intent(out) :: code

      code = library_code%success
      if (problem%module_number == 3 .or. call_of%icp < 1) return
      if (call_of%icp > size(problem%wheel_rail_result%patches)) code = library_code%no_patch
   end subroutine check_patch

   !> Enter a problem whose lock the thread holds
   subroutine come_in(problem)
      type(library_problem), pointer, intent(in) :: problem

      call note_call(c_loc(problem), call_stage%inside)
      call hold_floats()
   end subroutine come_in

   !> Leave a problem: other threads may enter it
   subroutine leave(problem)
      type(library_problem), pointer, intent(inout) :: problem

      call end_setting(problem)
      call problem%kept%stop_using()
      call give_floats_back()
      call note_call(c_loc(problem), call_stage%user)
      call omp_unset_lock(problem%lock)
      call forget_user(problem)
      nullify(problem)
   end subroutine leave

   !> Unregister a user
   subroutine forget_user(problem)
      type(library_problem), pointer, intent(in) :: problem

      !$omp critical (contact_registry)
      problem%users = problem%users - 1
      call note_call(c_null_ptr, call_stage%outside)
      !$omp end critical (contact_registry)
   end subroutine forget_user

   !> Unregister a user and a calculation, after a call that was abandoned
   subroutine forget_call(problem, was_calculation)
      type(library_problem), pointer, intent(in) :: problem
      !> Was the call registered as a calculation?
      logical, intent(in) :: was_calculation

      if (was_calculation) call end_turn()
      call forget_user(problem)
   end subroutine forget_call

   !> End a calculation
   subroutine leave_calculation(problem)
      type(library_problem), pointer, intent(inout) :: problem

      call omp_set_num_threads(problem%threads_of_caller)
      call end_turn()
      call note_call(c_loc(problem), call_stage%inside)
      call set_owner(0)
      call problem%kept%stop_using()
      !$omp critical (contact_registry)
      ! the file can be read while the caller continues
      call library%log%out%flush_now()
      !$omp end critical (contact_registry)
      call leave(problem)
   end subroutine leave_calculation

   !> Free a result element; nothing if another thread is using it
   subroutine remove_element(call_of, removed, was_last)
      type(entry_type), intent(in) :: call_of
      !> False if it was not active, or is in use
      logical, intent(out) :: removed
      !> Are there no others left?
      logical, intent(out) :: was_last

      removed = .false.
      was_last = .false.
      !$omp critical (contact_registry)
      if (library%phase == running .and. call_of%ire >= 1 .and. call_of%ire <= max_elements) then
         if (library%elements(call_of%ire)%module_number /= 0) call free_element(library%elements(call_of%ire), removed)
         was_last = removed .and. library%active_elements == 0
      end if
      !$omp end critical (contact_registry)
   end subroutine remove_element

   !> Free the problems of an element that have no users
   subroutine free_element(element, freed)
      type(element_slot), intent(inout) :: element
      logical, intent(out) :: freed
      integer :: k

      freed = .true.
      do k = 1, max_patches
         if (.not. associated(element%patch(k)%p)) cycle
         if (element%patch(k)%p%users > 0) freed = .false.
      end do
      if (.not. freed) return
      do k = 1, max_patches
         if (.not. associated(element%patch(k)%p)) cycle
         call book_times(element%patch(k))
         call release_problem(element%patch(k)%p)
      end do
      element%module_number = 0
      library%active_elements = library%active_elements - 1
   end subroutine free_element

   !> End the run: free all elements, close the files; nothing if another thread is using a problem
   subroutine stop_library(stopped)
      !> False if a problem is in use, or no run was in progress
      logical, intent(out) :: stopped
      type(log_type) :: fresh
      integer :: k
      logical :: complete, dumped, freed

      !$omp critical (contact_registry)
      stopped = library%phase == running .and. .not. any_users()
      if (stopped) then
         call library%total%halt()
         do k = 1, max_elements
            if (library%elements(k)%module_number /= 0) call free_element(library%elements(k), freed)
         end do
         call write_timers()
         ! an incomplete file gets no final line
         if (.not. library%input_dump%has_failed()) call library%input_dump%line(" 0  MODULE")
         call library%input_dump%close_file(dumped)
         call library%log%out%close_file(complete)
         if (.not. dumped) call set_last_error(library_code%other, &
            & "the input file of the library (flag 2002) is not complete; is the disk full?")
         if (.not. complete .and. dumped) call set_last_error(library_code%other, &
            & "the .out file of the library is not complete; is the disk full?")
         if (.not. (complete .or. dumped)) call set_last_error(library_code%other, &
            & "the .out file and the input file of the library (flag 2002) are not complete; is the disk full?")
         library%log = fresh
         library%phase = finalised
      end if
      !$omp end critical (contact_registry)
   end subroutine stop_library

   !> Is any thread inside a problem?
   logical function any_users()
      integer :: k, i

      any_users = .false.
      do k = 1, max_elements
         if (library%elements(k)%module_number == 0) cycle
         do i = 1, max_patches
            if (.not. associated(library%elements(k)%patch(i)%p)) cycle
            if (library%elements(k)%patch(i)%p%users > 0) any_users = .true.
         end do
      end do
   end function any_users

   !> Set the number of threads inside a problem: negative for the maximum, 0 and 1 for one; ignored before initialisation
   subroutine set_threads(number)
      !> Number given by the caller
      integer, intent(in) :: number

      !$omp critical (contact_registry)
      if (library%phase == running) then
         call see_threads()
         library%threads = max(1, min(number, library%max_threads))
         if (number < 0) library%threads = library%max_threads
      end if
      !$omp end critical (contact_registry)
   end subroutine set_threads

   !> Number of threads of a calculation; one in a forked process, which has no others
   integer function threads_inside() result(number)
      !$omp critical (contact_registry)
      number = library%threads
      if (is_forked()) number = 1
      !$omp end critical (contact_registry)
   end function threads_inside

   !> Maximum number of threads
   integer function max_threads() result(number)
      !$omp critical (contact_registry)
      call see_threads()
      number = library%max_threads
      !$omp end critical (contact_registry)
   end function max_threads
end module contact_capi_registry
