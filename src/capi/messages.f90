!> Messages to callers: errors of calls, which the library stores, and messages requested by the debugging level
module contact_capi_messages
   use omp_lib, only : omp_get_thread_num, omp_in_parallel
   use contact_base_case_status, only : case_status
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_capi_library, only : entry_type, existing_problem, library
   use contact_capi_problem, only : library_problem, refused_setting
   use contact_control_digit_terms, only : translate_to_digits
   use contact_text_bounds, only : describe_breach
   use contact_control_library_codes, only : library_code
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: report_error, warn, log_message, is_heard, set_debugging, library_log
   public :: keep_status, stored_error, last_status, forget_error, set_last_error
   public :: begin_setting, end_setting, first_refusal, refuse_for_ever
   public :: fits, count_fits

contains

   !> Report an error of a call: it is logged at every debugging level, and stored for the caller
   subroutine report_error(call_of, text, code)
      type(entry_type), intent(in) :: call_of
      !> One sentence without the name of the routine
      character(len=*), intent(in) :: text
      !> Member of library_code; default: other
      integer, intent(in), optional :: code
      character(len=:), allocatable :: message
      integer :: number

      call translate_to_digits(text, message)
      number = library_code%other
      if (present(code)) number = code
      !$omp critical (contact_registry)
      if (number /= library_code%success) call set_last_error(number, trim(call_of%name) // ": " // message, call_of)
      call library%log%line(trim(prefix_of(call_of)) // " " // message)
      call library%log%out%flush_now()
      !$omp end critical (contact_registry)
   end subroutine report_error

   !> Report a warning: it is logged at every debugging level, and stored for the caller with the code of success
   !>
   !> A stored error that the caller has not read yet is kept.
   subroutine warn(call_of, text)
      type(entry_type), intent(in) :: call_of
      !> One sentence without the name of the routine
      character(len=*), intent(in) :: text
      type(library_problem), pointer :: problem

      call report_error(call_of, "Warning: " // text, library_code%success)
      !$omp critical (contact_registry)
      if (library%last_code == library_code%success) library%last_error = trim(call_of%name) // ": Warning: " // text
      problem => existing_problem(call_of%ire, call_of%icp)
      if (associated(problem)) then
         if (problem%last_code == library_code%success) problem%last_error = trim(call_of%name) // ": Warning: " // text
      end if
      !$omp end critical (contact_registry)
   end subroutine warn

   !> Write a message at or above a debugging level
   subroutine log_message(level, call_of, text)
      !> Minimum debugging level at which it is written
      integer, intent(in) :: level
      type(entry_type), intent(in) :: call_of
      !> One sentence without the name of the routine
      character(len=*), intent(in) :: text

      if (.not. is_heard(level)) return
      !$omp critical (contact_registry)
      call library%log%line(trim(prefix_of(call_of)) // " " // text)
      !$omp end critical (contact_registry)
   end subroutine log_message

   !> Are messages of this level written?
   logical function is_heard(level)
      !> Debugging level of the message, 0 to 5
      integer, intent(in) :: level
      integer :: debugging

      !$omp atomic read
      debugging = library%debugging
      is_heard = debugging >= level
   end function is_heard

   !> Set the debugging level
   subroutine set_debugging(level)
      !> Level as in flag 2000, from -1 for none to 5
      integer, intent(in) :: level

      !$omp atomic write
      library%debugging = level
   end subroutine set_debugging

   !> Copy of the log, for writing messages
   type(log_type) function library_log() result(log)
      !$omp critical (contact_registry)
      log = library%log
      log%terms => translate_to_digits
      !$omp end critical (contact_registry)
   end function library_log

   !> A calculation begins: remove earlier errors of the problem
   subroutine forget_error(problem)
      type(library_problem), intent(inout) :: problem

      !$omp critical (contact_registry)
      problem%last_code = library_code%success
      if (allocated(problem%last_error)) deallocate(problem%last_error)
      !$omp end critical (contact_registry)
   end subroutine forget_error

   !> Store the status of a calculation that has ended
   subroutine keep_status(problem, status)
      type(library_problem), intent(inout) :: problem
      type(case_status), intent(in) :: status

      !$omp critical (contact_registry)
      problem%status = status
      problem%was_calculated = .true.
      !$omp end critical (contact_registry)
   end subroutine keep_status

   !> Final status of the last calculation of a problem
   subroutine last_status(ire, icp, known, status)
      !> Result element and contact problem, -1 for wheel and rail as a whole
      integer, intent(in) :: ire, icp
      !> Was there a calculation?
      logical, intent(out) :: known
      type(case_status), intent(out) :: status
      type(library_problem), pointer :: problem

      known = .false.
      !$omp critical (contact_registry)
      problem => existing_problem(ire, icp)
      if (associated(problem)) then
         known = problem%was_calculated
         status = problem%status
      end if
      !$omp end critical (contact_registry)
   end subroutine last_status

   !> Last error, "" if there was none; it is removed
   subroutine stored_error(code, text, ire, icp)
      !> Code returned by the call, 0 for a warning
      integer, intent(out) :: code
      !> One sentence
      character(len=:), allocatable, intent(out) :: text
      !> Numbers of a problem; result element 0: last error of the library
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
   end subroutine stored_error

   !> Store an error, inside the critical section
   subroutine set_last_error(code, text, call_of)
      !> Code returned by the call, 0 for a warning
      integer, intent(in) :: code
      !> One sentence
      character(len=*), intent(in) :: text
      !> Call whose problem the error belongs to, if there is one
      type(entry_type), intent(in), optional :: call_of
      type(library_problem), pointer :: problem

      library%last_code = code
      library%last_error = text
      if (.not. present(call_of)) return
      problem => existing_problem(call_of%ire, call_of%icp)
      if (.not. associated(problem)) return
      problem%last_code = code
      problem%last_error = text
      ! a setting with an error is refused
      if (len_trim(problem%setting%routine) == 0 .or. problem%setting%routine /= call_of%name) return
      if (allocated(problem%setting%reason)) return
      problem%setting%code = code
      problem%setting%reason = text
   end subroutine set_last_error

   !> Begin a setting: errors of its routine refuse it
   subroutine begin_setting(problem, call_of, group)
      type(library_problem), intent(inout) :: problem
      type(entry_type), intent(in) :: call_of
      !> Group of settings replaced by a valid value; default: the routine
      character(len=*), intent(in), optional :: group

      !$omp critical (contact_registry)
      problem%setting = refused_setting()
      problem%setting%routine = call_of%name
      problem%setting%group = call_of%name
      if (present(group)) problem%setting%group = group
      !$omp end critical (contact_registry)
   end subroutine begin_setting

   !> End a setting that was made or refused: calculations require that refused settings are made again
   subroutine end_setting(problem)
      type(library_problem), intent(inout) :: problem
      type(refused_setting) :: part
      integer :: first, length

      !$omp critical (contact_registry)
      if (len_trim(problem%setting%routine) > 0) then
         if (allocated(problem%setting%reason) .or. allocated(problem%refused)) then
            part = problem%setting
            first = 1
            do while (first <= len_trim(problem%setting%group))
               length = scan(problem%setting%group(first:) // "|", "|") - 1
               part%group = problem%setting%group(first:first + length - 1)
               call replace_refusal(problem%refused, part)
               first = first + length + 1
            end do
         end if
         problem%setting = refused_setting()
      end if
      !$omp end critical (contact_registry)
   end subroutine end_setting

   !> Refuse calculations until the result element is created again, since no setting can restore the problem
   subroutine refuse_for_ever(problem, call_of, reason)
      type(library_problem), intent(inout) :: problem
      type(entry_type), intent(in) :: call_of
      !> Reason, reported by each refused calculation
      character(len=*), intent(in) :: reason

      !$omp critical (contact_registry)
      problem%setting = refused_setting()
      allocate(problem%refused(1))
      ! the name of no routine, so that no good value replaces it
      problem%refused(1)%routine = "cntc_set"
      problem%refused(1)%group = "all settings"
      problem%refused(1)%code = library_code%other
      problem%refused(1)%reason = trim(call_of%name) // ": " // reason
      !$omp end critical (contact_registry)
   end subroutine refuse_for_ever

   !> Remove the refusals of a group from a list, and append the new one if it has a reason
   pure subroutine replace_refusal(list, new)
      type(refused_setting), allocatable, intent(inout) :: list(:)
      !> Without a reason only its group is used
      type(refused_setting), intent(in) :: new
      type(refused_setting), allocatable :: others(:)
      integer :: k, n

      if (.not. allocated(list)) allocate(list(0))
      n = count(list%group /= new%group)
      allocate(others(n + merge(1, 0, allocated(new%reason))))
      n = 0
      do k = 1, size(list)
         if (list(k)%group == new%group) cycle
         n = n + 1
         others(n) = list(k)
      end do
      if (allocated(new%reason)) others(n + 1) = new
      if (size(others) == 0) then
         deallocate(list)
      else
         call move_alloc(others, list)
      end if
   end subroutine replace_refusal

   !> First refused setting that was not made since, by a routine whose name begins with `routine`; 0: none
   pure integer function first_refusal(problem, routine) result(k)
      type(library_problem), intent(in) :: problem
      !> Beginning of the name of the routine
      character(len=*), intent(in) :: routine

      if (allocated(problem%refused)) then
         do k = 1, size(problem%refused)
            if (index(problem%refused(k)%routine, routine) == 1) return
         end do
      end if
      k = 0
   end function first_refusal

   !> Are the numbers of a call within their bounds? Reports the first that is not
   logical function fits(call_of, names, values, shown)
      type(entry_type), intent(in) :: call_of
      !> Names of the values in the table of bounds, separated by blanks; the last one applies to all further values
      character(len=*), intent(in) :: names
      !> Values in internal units; missing ones are NaN
      real(wp), intent(in) :: values(:)
      !> Names in the message, if they differ
      character(len=*), intent(in), optional :: shown
      character(len=16) :: name, label
      character(len=:), allocatable :: complaint
      integer :: k, words

      fits = .true.
      words = 1 + count([(names(k:k) == " ", k = 1, len(names))])
      do k = 1, size(values)
         if (k <= words) then
            name = word_of(names, k)
            label = name
            if (present(shown)) label = word_of(shown, k)
         end if
         call describe_breach(trim(name), "", values(k), complaint, trim(label))
         if (.not. allocated(complaint)) cycle
         fits = .false.
         if (size(values) > words .and. k >= words) complaint = "value " // integer_text(k) // ": " // complaint
         call report_error(call_of, complaint // "; nothing is stored")
         return
      end do
   end function fits

   !> The k-th word of a text
   pure function word_of(text, k) result(word)
      character(len=*), intent(in) :: text
      integer, intent(in) :: k
      character(len=16) :: word
      integer :: first, i

      first = 1
      do i = 1, k - 1
         first = first + index(text(first:), " ")
      end do
      word = text(first:first + index(text(first:) // " ", " ") - 2)
   end function word_of

   !> Is the number of values within the range of a method? Reports an error if not
   logical function count_fits(call_of, method, n, lowest, highest) result(fits)
      type(entry_type), intent(in) :: call_of
      !> Number of the method, number of values given, and its minimum and maximum
      integer, intent(in) :: method, n, lowest, highest

      fits = n >= lowest .and. n <= highest
      if (fits) return
      if (lowest == highest) then
         call report_error(call_of, "method " // integer_text(method) // " needs " // integer_text(lowest) // " values, not " // &
            & integer_text(n))
      else
         call report_error(call_of, "method " // integer_text(method) // " needs " // integer_text(lowest) // " to " // &
            & integer_text(highest) // " values, not " // integer_text(n))
      end if
   end function count_fits

   !> Beginning of a message: thread, routine, result element and patch
   function prefix_of(call_of) result(text)
      type(entry_type), intent(in) :: call_of
      character(len=64) :: text
      character(len=30) :: name
      character(len=4) :: thread
      character(len=24) :: place

      thread = ""
      if (omp_in_parallel()) write(thread, '(I3, "#")') mod(omp_get_thread_num(), 1000)
      name = adjustr(call_of%name // "  ")
      place = ":"
      if (call_of%ire /= 0 .and. call_of%icp > 0) then
         write(place, '("(", I3, ".", I1, "):")') min(999, max(-99, call_of%ire)), min(9, call_of%icp)
      else if (call_of%ire /= 0) then
         write(place, '("(", I3, "):")') min(999, max(-99, call_of%ire))
      end if
      text = trim(thread) // " ** " // name // trim(place)
   end function prefix_of
end module contact_capi_messages
