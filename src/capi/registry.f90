!> The problems of the callers of the library, and its one .out file
!>
!> The only mutable module variable of the library. Whoever works on a problem goes through `enter` and
!> `leave`: between them no other thread can change or free it. The registry itself is guarded by a
!> critical section that is short; calculations run outside.
module contact_capi_registry
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : output_unit
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_get_thread_num, omp_in_parallel, omp_set_lock, &
      & omp_test_lock, omp_unset_lock
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_host, only : find_current_folder, give_floats_back, hold_floats, is_forked
   use contact_capi_problem, only : library_problem, most_patches, new_problem, release_problem
   use contact_control_library_codes, only : code_text, library_code
   use contact_experiment_stopwatch, only : stopwatch
   use contact_output_report, only : timer_line, write_banner, write_end
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: scope_type, scope, entry_type, enter, enter_calculation, leave, leave_calculation
   public :: start_library, stop_library, is_running, register_element, remove_element, record_units
   public :: complain, say, is_heard, library_log, level_of_debugging, set_debugging, set_threads, threads_inside, most_threads
   public :: set_timer_level, find_working_folder, find_result_file, last_complaint, forget_complaint
   public :: open_input_dump, input_dump, relate_to_results
   public :: are_finite, count_fits

   integer, parameter :: most_elements = 999, most_active = 100
   !> Amount of timers
   integer, parameter :: all_timers = 2

   !> Which result elements and patches a routine accepts
   type :: scope_type
      !> Modules
      logical :: pair = .true., contact = .true.
      !> In module 1: wheel and rail as a whole, one patch
      logical :: whole = .true., patch = .true.
   end type scope_type

   type :: scope_list
      !> Settings: wheel and rail as a whole, or a contact problem
      type(scope_type) :: settings = scope_type(patch=.false.)
      !> Results of one patch, in both modules; with results of wheel and rail as a whole
      type(scope_type) :: one_patch = scope_type(whole=.false.)
      type(scope_type) :: any = scope_type()
      !> Module 1 only: as a whole, one patch, both
      type(scope_type) :: pair = scope_type(contact=.false., patch=.false.)
      type(scope_type) :: pair_patch = scope_type(contact=.false., whole=.false.)
      type(scope_type) :: pair_any = scope_type(contact=.false.)
      !> Module 3 only
      type(scope_type) :: contact = scope_type(pair=.false.)
   end type scope_list
   !> Names of scopes
   type(scope_list), parameter :: scope = scope_list()

   !> A call: routine, result element, patch
   type :: entry_type
      character(len=28) :: name = ""
      integer :: ire = 0
      !> Patch as the caller gave it, -1 for none
      integer :: icp = -1
   end type entry_type

   type :: problem_pointer
      type(library_problem), pointer :: p => null()
      !> Calculations and stresses of problems with this number that were freed, for the timer table; their module
      type(stopwatch) :: total, stresses
      integer :: timed_module = 0
   end type problem_pointer

   !> A result element; in module 1 its one problem is the first
   type :: element_slot
      integer :: module_number = 0
      type(problem_pointer) :: patch(most_patches)
   end type element_slot

   !> States of the library
   integer, parameter :: virgin = -3, units_given = -2, finalised = -1, running = 1

   type :: library_state
      integer :: phase = virgin
      type(element_slot) :: elements(most_elements)
      integer :: active_elements = 0
      !> Calculations that are running now, largest number of threads seen, threads inside a problem
      integer :: calculations = 0, most_threads = 1, threads = 1
      !> Amount of messages about calls; timer table 0 none, 1 overview, 2 everything
      integer :: debugging = 0, timer_level = 1
      type(log_type) :: log
      !> Unit of the .inp file with the cases, 0 for none; was it tried to open it?
      integer :: input_dump = 0
      logical :: dump_was_tried = .false.
      character(len=:), allocatable :: work_folder, out_folder, name
      type(stopwatch) :: total
      !> What went wrong last without a problem to which it belongs
      character(len=:), allocatable :: last_error
      integer :: last_code = 0
   end type library_state

   type(library_state), target, save :: library

contains

   !> Is the library initialised?
   logical function is_running()
      !$omp critical (contact_registry)
      is_running = library%phase == running
      !$omp end critical (contact_registry)
   end function is_running

   !> Take note of unit numbers; they are not needed, every file gets a free one
   subroutine record_units(accepted)
      !> False when it is too late
      logical, intent(out) :: accepted

      !$omp critical (contact_registry)
      accepted = library%phase == virgin
      if (accepted) library%phase = units_given
      !$omp end critical (contact_registry)
   end subroutine record_units

   !> Start a run: folders, name, .out file; nothing when one is going on
   subroutine start_library(work_folder, out_folder, name, screen, started)
      !> Folders and name of the experiment, "" for what was given before or the default
      character(len=*), intent(in) :: work_folder, out_folder, name
      !> Are messages shown on the screen too?
      logical, intent(in) :: screen
      !> False when a run was going on
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
      character(len=:), allocatable :: path
      integer :: status, unit, slash, k

      if (.not. allocated(library%name)) library%name = "contact_addon"
      if (.not. allocated(library%work_folder)) library%work_folder = ""
      if (.not. allocated(library%out_folder)) library%out_folder = ""
      if (len(work_folder) > 0) library%work_folder = with_separator(work_folder)
      if (len(out_folder) > 0) library%out_folder = with_separator(out_folder)
      if (len(name) > 0) then
         slash = index(name, "/", back=.true.)
         if (slash > 0 .and. len(work_folder) == 0) library%work_folder = name(:slash)
         if (slash < len(name)) library%name = name(slash + 1:)
      end if
      library%log = log_type()
      if (screen) library%log%screen = output_unit
      call place_result(library%name // ".out", path)
      open(newunit=unit, file=path, status="replace", action="write", iostat=status)
      if (status == 0) library%log%out = unit
      library%phase = running
      library%input_dump = 0
      library%dump_was_tried = .false.
      library%most_threads = max(1, min(999, omp_get_max_threads()))
      library%threads = 1
      library%total = stopwatch()
      do k = 1, most_elements
         library%elements(k)%patch%timed_module = 0
         library%elements(k)%patch%total = stopwatch()
         library%elements(k)%patch%stresses = stopwatch()
      end do
      call library%total%start()
      call write_banner(library%log)
      if (status /= 0) call set_last_error(-1, "the file " // path // " cannot be written")
   end subroutine begin_run

   !> A folder with a separator at its end
   pure function with_separator(folder) result(path)
      character(len=*), intent(in) :: folder
      character(len=len(folder) + merge(0, 1, folder(len(folder):) == "/")) :: path

      path = folder
      path(len(path):) = "/"
   end function with_separator

   !> Path of a file in the folder of results; a folder that is relative starts at the working folder
   subroutine find_result_file(file, path)
      character(len=*), intent(in) :: file
      character(len=:), allocatable, intent(out) :: path

      !$omp critical (contact_registry)
      call place_result(file, path)
      !$omp end critical (contact_registry)
   end subroutine find_result_file

   !> The same inside the critical section
   subroutine place_result(file, path)
      character(len=*), intent(in) :: file
      character(len=:), allocatable, intent(out) :: path

      path = library%out_folder // file
      if (path(:1) /= "/") path = library%work_folder // path
   end subroutine place_result

   !> Folder to which names of files are relative, with a separator at its end, "" for the current one
   subroutine find_working_folder(folder)
      character(len=:), allocatable, intent(out) :: folder

      !$omp critical (contact_registry)
      folder = ""
      if (allocated(library%work_folder)) folder = library%work_folder
      !$omp end critical (contact_registry)
   end subroutine find_working_folder

   !> Make a result element known; one that is active stays as it is
   subroutine register_element(ire, module_number, code, was_active)
      integer, intent(in) :: ire, module_number
      !> Member of library_code
      integer, intent(out) :: code
      logical, intent(out) :: was_active

      !$omp critical (contact_registry)
      was_active = .false.
      if (ire < 1 .or. ire > most_elements) then
         code = library_code%bad_element
      else
         was_active = library%elements(ire)%module_number /= 0
         call activate(ire, module_number, code)
      end if
      !$omp end critical (contact_registry)
   end subroutine register_element

   !> Make a result element active, inside the critical section
   subroutine activate(ire, module_number, code)
      integer, intent(in) :: ire, module_number
      integer, intent(out) :: code

      code = library_code%success
      if (library%phase /= running) call begin_run("", "", "", .false.)
      if (library%elements(ire)%module_number /= 0) return
      if (library%active_elements >= most_active) then
         code = library_code%not_allowed
         return
      end if
      library%active_elements = library%active_elements + 1
      library%elements(ire)%module_number = module_number
   end subroutine activate

   !> Find the problem of a call and keep other threads out of it until `leave`
   !>
   !> On failure the problem is null, the code tells why, and the reason is in the log. What is not there
   !> yet is made with its defaults, as callers of the published interface expect.
   subroutine enter(call_of, allowed, problem, code)
      type(entry_type), intent(in) :: call_of
      type(scope_type), intent(in) :: allowed
      type(library_problem), pointer, intent(out) :: problem
      !> Member of library_code
      integer, intent(out), optional :: code
      integer :: found

      call look_up(call_of, allowed, problem, found)
      if (associated(problem)) then
         call omp_set_lock(problem%lock)
         call hold_floats()
         call check_patch(call_of, problem, found)
         if (found /= library_code%success) call leave(problem)
      end if
      if (found /= library_code%success) call complain(call_of, trim(code_text(found)), found)
      if (present(code)) code = found
   end subroutine enter

   !> The same for a calculation, which does not wait for another thread
   subroutine enter_calculation(call_of, allowed, problem, code)
      type(entry_type), intent(in) :: call_of
      type(scope_type), intent(in) :: allowed
      type(library_problem), pointer, intent(out) :: problem
      !> Member of library_code
      integer, intent(out) :: code
      logical :: counted

      call look_up(call_of, allowed, problem, code)
      if (associated(problem)) then
         if (.not. omp_test_lock(problem%lock)) then
            code = library_code%in_use
            call forget_user(problem)
            nullify(problem)
         end if
      end if
      if (associated(problem)) then
         call hold_floats()
         call check_patch(call_of, problem, code)
         if (code == library_code%success) then
            call count_calculation(counted)
            if (.not. counted) code = library_code%not_allowed
         end if
         if (code /= library_code%success) call leave(problem)
      end if
      if (code /= library_code%success) call complain(call_of, trim(code_text(code)), code)
   end subroutine enter_calculation

   !> One calculation more, if there are threads for it
   subroutine count_calculation(counted)
      logical, intent(out) :: counted

      !$omp critical (contact_registry)
      call see_threads()
      counted = library%calculations < library%most_threads
      if (counted) library%calculations = library%calculations + 1
      !$omp end critical (contact_registry)
   end subroutine count_calculation

   !> Callers may raise the number of threads at any time
   subroutine see_threads()
      library%most_threads = min(999, max(library%most_threads, omp_get_max_threads(), omp_get_num_threads()))
   end subroutine see_threads

   !> The problem of a call and one user more; null when the call cannot be meant
   subroutine look_up(call_of, allowed, problem, code)
      type(entry_type), intent(in) :: call_of
      type(scope_type), intent(in) :: allowed
      type(library_problem), pointer, intent(out) :: problem
      integer, intent(out) :: code

      nullify(problem)
      !$omp critical (contact_registry)
      code = library_code%bad_element
      if (call_of%ire >= 1 .and. call_of%ire <= most_elements) &
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
               end associate
            end if
         end associate
      end if
      !$omp end critical (contact_registry)
   end subroutine look_up

   !> Why a call does not go with a module; success when it does
   pure integer function misuse(module_number, icp, allowed) result(code)
      integer, intent(in) :: module_number, icp
      type(scope_type), intent(in) :: allowed

      code = library_code%success
      if (module_number == 1) then
         if (.not. allowed%pair) then
            code = library_code%not_module_1
         else if (icp /= -1 .and. (icp < 1 .or. icp > most_patches)) then
            code = library_code%bad_patch
         else if (icp == -1 .and. .not. allowed%whole) then
            code = library_code%patch_needed
         else if (icp > 0 .and. .not. allowed%patch) then
            code = library_code%patch_unwanted
         end if
      else if (.not. allowed%contact) then
         code = library_code%not_module_3
      else if (icp < 1 .or. icp > most_patches) then
         code = library_code%bad_patch
      end if
   end function misuse

   !> Patches of module 1 are those that the last calculation found
   pure subroutine check_patch(call_of, problem, code)
      type(entry_type), intent(in) :: call_of
      type(library_problem), intent(in) :: problem
      integer, intent(out) :: code

      code = library_code%success
      if (problem%module_number == 3 .or. call_of%icp < 1) return
      if (call_of%icp > size(problem%pair_result%patches)) code = library_code%no_patch
   end subroutine check_patch

   !> Let other threads into the problem
   subroutine leave(problem)
      type(library_problem), pointer, intent(inout) :: problem

      call give_floats_back()
      call omp_unset_lock(problem%lock)
      call forget_user(problem)
      nullify(problem)
   end subroutine leave

   !> One user less
   subroutine forget_user(problem)
      type(library_problem), pointer, intent(in) :: problem

      !$omp critical (contact_registry)
      problem%users = problem%users - 1
      !$omp end critical (contact_registry)
   end subroutine forget_user

   !> The end of a calculation
   subroutine leave_calculation(problem)
      type(library_problem), pointer, intent(inout) :: problem

      !$omp critical (contact_registry)
      library%calculations = library%calculations - 1
      ! The file can be read while the caller goes on
      if (library%log%out /= 0) flush(library%log%out)
      !$omp end critical (contact_registry)
      call leave(problem)
   end subroutine leave_calculation

   !> Free a result element; nothing when another thread is at work on it
   subroutine remove_element(call_of, removed, was_last)
      type(entry_type), intent(in) :: call_of
      !> False when it was not active, or is in use
      logical, intent(out) :: removed
      !> Are there no others left?
      logical, intent(out) :: was_last

      removed = .false.
      was_last = .false.
      !$omp critical (contact_registry)
      if (library%phase == running .and. call_of%ire >= 1 .and. call_of%ire <= most_elements) then
         if (library%elements(call_of%ire)%module_number /= 0) call free_element(library%elements(call_of%ire), removed)
         was_last = removed .and. library%active_elements == 0
      end if
      !$omp end critical (contact_registry)
   end subroutine remove_element

   !> Free the problems of an element that nobody uses
   subroutine free_element(element, freed)
      type(element_slot), intent(inout) :: element
      logical, intent(out) :: freed
      integer :: k

      freed = .true.
      do k = 1, most_patches
         if (.not. associated(element%patch(k)%p)) cycle
         if (element%patch(k)%p%users > 0) freed = .false.
      end do
      if (.not. freed) return
      do k = 1, most_patches
         if (.not. associated(element%patch(k)%p)) cycle
         call book_times(element%patch(k))
         call release_problem(element%patch(k)%p)
      end do
      element%module_number = 0
      library%active_elements = library%active_elements - 1
   end subroutine free_element

   !> Keep the times of a problem that is going to be freed
   subroutine book_times(slot)
      type(problem_pointer), intent(inout) :: slot

      slot%timed_module = slot%p%module_number
      call add(slot%p%total, slot%total)
      call add(slot%p%stresses, slot%stresses)

   contains

      subroutine add(watch, sum)
         type(stopwatch), intent(in) :: watch
         type(stopwatch), intent(inout) :: sum

         sum%calls = sum%calls + watch%calls
         sum%cpu = sum%cpu + watch%cpu
         sum%wall = sum%wall + watch%wall
      end subroutine add
   end subroutine book_times

   !> End the run: free all elements, close the files; nothing when another thread is at work
   subroutine stop_library(stopped)
      !> False when something is in use, or no run was going on
      logical, intent(out) :: stopped
      integer :: k
      logical :: freed

      !$omp critical (contact_registry)
      stopped = library%phase == running .and. .not. any_users()
      if (stopped) then
         call library%total%halt()
         do k = 1, most_elements
            if (library%elements(k)%module_number /= 0) call free_element(library%elements(k), freed)
         end do
         call write_timers()
         if (library%input_dump /= 0) then
            write(library%input_dump, '(a)') " 0  MODULE"
            close(library%input_dump)
         end if
         library%input_dump = 0
         if (library%log%out /= 0) close(library%log%out)
         library%log = log_type()
         library%phase = finalised
      end if
      !$omp end critical (contact_registry)
   end subroutine stop_library

   !> Is any thread inside a problem?
   logical function any_users()
      integer :: k, i

      any_users = .false.
      do k = 1, most_elements
         if (library%elements(k)%module_number == 0) cycle
         do i = 1, most_patches
            if (.not. associated(library%elements(k)%patch(i)%p)) cycle
            if (library%elements(k)%patch(i)%p%users > 0) any_users = .true.
         end do
      end do
   end function any_users

   !> Table of the time spent, in total and per problem; with all timers that of stresses, too
   subroutine write_timers()
      type(timer_line), allocatable :: lines(:)
      integer :: k, i, n

      if (library%debugging < 0 .or. library%timer_level < 1) return
      n = 1
      do k = 1, most_elements
         n = n + 2*count(library%elements(k)%patch%timed_module /= 0)
      end do
      allocate(lines(n))
      n = 1
      call fill_line("Total", library%total, lines(1))
      do k = 1, most_elements
         do i = 1, most_patches
            associate (slot => library%elements(k)%patch(i))
               if (slot%timed_module == 0) cycle
               n = n + 1
               if (slot%timed_module == 3) then
                  call fill_line("Cp." // integer_text(i) // " on Res.el." // integer_text(k), slot%total, lines(n))
               else
                  call fill_line("Result element " // integer_text(k), slot%total, lines(n))
               end if
               if (library%timer_level < all_timers .or. slot%stresses%calls == 0) cycle
               n = n + 1
               call fill_line("- stresses below", slot%stresses, lines(n))
            end associate
         end do
      end do
      call write_end(library%log, library%most_threads, lines(:n))
   end subroutine write_timers

   !> A stopwatch as a line of the table; component by component, because constructors with texts leak
   subroutine fill_line(name, watch, line)
      character(len=*), intent(in) :: name
      type(stopwatch), intent(in) :: watch
      type(timer_line), intent(inout) :: line

      line%name = name
      line%calls = watch%calls
      line%cpu = watch%cpu
      line%wall = watch%wall
   end subroutine fill_line

   !> A copy of the sinks of messages
   type(log_type) function library_log() result(log)
      !$omp critical (contact_registry)
      log = library%log
      !$omp end critical (contact_registry)
   end function library_log

   !> A message about a wrong call: into the log at every level of debugging, and kept for the caller
   subroutine complain(call_of, text, code)
      type(entry_type), intent(in) :: call_of
      character(len=*), intent(in) :: text
      !> Member of library_code; default other
      integer, intent(in), optional :: code
      integer :: number

      number = library_code%other
      if (present(code)) number = code
      !$omp critical (contact_registry)
      if (number /= library_code%success) call set_last_error(number, trim(call_of%name) // ": " // text, call_of)
      call library%log%line(trim(prefix_of(call_of)) // " " // text)
      if (library%log%out /= 0) flush(library%log%out)
      !$omp end critical (contact_registry)
   end subroutine complain

   !> A message that callers see when they ask for messages of that level
   subroutine say(level, call_of, text)
      !> Level of debugging from which on it is written
      integer, intent(in) :: level
      type(entry_type), intent(in) :: call_of
      character(len=*), intent(in) :: text

      if (.not. is_heard(level)) return
      !$omp critical (contact_registry)
      call library%log%line(trim(prefix_of(call_of)) // " " // text)
      !$omp end critical (contact_registry)
   end subroutine say

   !> Are messages of this level written?
   logical function is_heard(level)
      integer, intent(in) :: level
      is_heard = level_of_debugging() >= level
   end function is_heard

   !> A calculation begins: what went wrong with the problem before does not count any more
   subroutine forget_complaint(problem)
      type(library_problem), intent(inout) :: problem

      !$omp critical (contact_registry)
      problem%last_code = library_code%success
      if (allocated(problem%last_error)) deallocate(problem%last_error)
      !$omp end critical (contact_registry)
   end subroutine forget_complaint

   !> Keep what went wrong, inside the critical section
   subroutine set_last_error(code, text, call_of)
      integer, intent(in) :: code
      character(len=*), intent(in) :: text
      !> Belongs to the problem of this call, if there is one
      type(entry_type), intent(in), optional :: call_of
      type(library_problem), pointer :: problem

      library%last_code = code
      library%last_error = text
      if (.not. present(call_of)) return
      problem => existing_problem(call_of%ire, call_of%icp)
      if (.not. associated(problem)) return
      problem%last_code = code
      problem%last_error = text
   end subroutine set_last_error

   !> The problem with these numbers, null when there is none; inside the critical section
   function existing_problem(ire, icp) result(problem)
      integer, intent(in) :: ire, icp
      type(library_problem), pointer :: problem
      integer :: k

      nullify(problem)
      if (ire < 1 .or. ire > most_elements) return
      k = 1
      if (library%elements(ire)%module_number == 3) k = icp
      if (k < 1 .or. k > most_patches) return
      problem => library%elements(ire)%patch(k)%p
   end function existing_problem

   !> What went wrong last, "" when nothing did; forgotten by this question
   subroutine last_complaint(code, text, ire, icp)
      integer, intent(out) :: code
      character(len=:), allocatable, intent(out) :: text
      !> A problem; result element 0 for whatever went wrong last in the library
      integer, intent(in) :: ire, icp
      type(library_problem), pointer :: problem

      !$omp critical (contact_registry)
      code = library_code%success
      text = ""
      if (ire == 0) then
         code = library%last_code
         if (allocated(library%last_error)) call move_alloc(library%last_error, text)
         library%last_code = library_code%success
      else
         problem => existing_problem(ire, icp)
         if (associated(problem)) then
            code = problem%last_code
            if (allocated(problem%last_error)) call move_alloc(problem%last_error, text)
            problem%last_code = library_code%success
         end if
      end if
      !$omp end critical (contact_registry)
   end subroutine last_complaint

   !> Are all numbers of a call finite? Complains when they are not
   logical function are_finite(call_of, values)
      type(entry_type), intent(in) :: call_of
      real(wp), intent(in) :: values(:)

      are_finite = all(ieee_is_finite(values))
      if (.not. are_finite) call complain(call_of, "a value is missing, infinite or not a number; nothing is stored")
   end function are_finite

   !> Does a method get as many values as it needs? Complains when it does not
   logical function count_fits(call_of, method, n, lowest, highest) result(fits)
      type(entry_type), intent(in) :: call_of
      !> Number of the method, number of values that were given, and the numbers that can be
      integer, intent(in) :: method, n, lowest, highest

      fits = n >= lowest .and. n <= highest
      if (fits) return
      if (lowest == highest) then
         call complain(call_of, "method " // integer_text(method) // " needs " // integer_text(lowest) // " values, not " // &
            & integer_text(n))
      else
         call complain(call_of, "method " // integer_text(method) // " needs " // integer_text(lowest) // " to " // &
            & integer_text(highest) // " values, not " // integer_text(n))
      end if
   end function count_fits

   !> Start of a message: thread, routine, result element and patch
   function prefix_of(call_of) result(text)
      type(entry_type), intent(in) :: call_of
      character(len=64) :: text
      character(len=30) :: name
      character(len=4) :: thread
      character(len=24) :: place

      thread = ""
      if (omp_in_parallel()) write(thread, '(i3, "#")') mod(omp_get_thread_num(), 1000)
      name = adjustr(call_of%name // "  ")
      place = ":"
      if (call_of%ire /= 0 .and. call_of%icp > 0) then
         write(place, '("(", i3, ".", i1, "):")') min(999, max(-99, call_of%ire)), min(9, call_of%icp)
      else if (call_of%ire /= 0) then
         write(place, '("(", i3, "):")') min(999, max(-99, call_of%ire))
      end if
      text = trim(thread) // " ** " // name // trim(place)
   end function prefix_of

   integer function level_of_debugging() result(level)
      !$omp atomic read
      level = library%debugging
   end function level_of_debugging

   !> Amount of messages
   subroutine set_debugging(level)
      integer, intent(in) :: level

      !$omp atomic write
      library%debugging = level
   end subroutine set_debugging

   !> Timer table: 0 none, 1 overview, 2 everything
   subroutine set_timer_level(level)
      integer, intent(in) :: level

      !$omp critical (contact_registry)
      library%timer_level = level
      !$omp end critical (contact_registry)
   end subroutine set_timer_level

   !> Threads inside a problem: negative for all, 0 and 1 for one; ignored before initialisation
   subroutine set_threads(number)
      integer, intent(in) :: number

      !$omp critical (contact_registry)
      if (library%phase == running) then
         call see_threads()
         library%threads = max(1, min(number, library%most_threads))
         if (number < 0) library%threads = library%most_threads
      end if
      !$omp end critical (contact_registry)
   end subroutine set_threads

   !> Threads that a calculation may use; one in a forked process, which has no others
   integer function threads_inside() result(number)
      !$omp critical (contact_registry)
      number = library%threads
      if (is_forked()) number = 1
      !$omp end critical (contact_registry)
   end function threads_inside

   !> Largest number of threads
   integer function most_threads() result(number)
      !$omp critical (contact_registry)
      call see_threads()
      number = library%most_threads
      !$omp end critical (contact_registry)
   end function most_threads

   !> Open the file in which cases are written as input; a failure is not tried again
   subroutine open_input_dump()
      character(len=:), allocatable :: path
      integer :: status, unit

      !$omp critical (contact_registry)
      if (.not. library%dump_was_tried) then
         library%dump_was_tried = .true.
         call place_result(library%name // ".inp", path)
         open(newunit=unit, file=path, status="replace", action="write", iostat=status)
         if (status == 0) library%input_dump = unit
         if (status /= 0) call set_last_error(library_code%other, "the file " // path // " cannot be written")
      end if
      !$omp end critical (contact_registry)
   end subroutine open_input_dump

   !> The name of a file of the caller, relative to the working folder, as the input file in the folder of results must give it
   subroutine relate_to_results(name)
      character(len=:), allocatable, intent(inout) :: name
      character(len=:), allocatable :: folder

      if (name(:1) == "/") return
      !$omp critical (contact_registry)
      if (len(library%out_folder) > 0) then
         name = library%work_folder // name
         if (name(:1) /= "/") then
            call find_current_folder(folder)
            name = folder // "/" // name
         end if
      end if
      !$omp end critical (contact_registry)
   end subroutine relate_to_results

   !> Unit of the file in which cases are written as input, 0 for none
   integer function input_dump() result(unit)
      !$omp critical (contact_registry)
      unit = library%input_dump
      !$omp end critical (contact_registry)
   end function input_dump
end module contact_capi_registry
