!> Sinks of messages: the log (screen and .out file) and the result (.out file only)
!>
!> A log without screen and file discards all messages; this is the log of a library caller who requested none. Lines written by
!> solvers have the flow-trace level (W digit) from which on they appear.
module contact_base_log
   use contact_base_error, only : error_type
   use contact_base_output_file, only : output_file
   implicit none (type, external)
   private

   public :: choice_terms, log_type

   abstract interface
      !> Convert a message, which names choices as in the readable format, to the terms of its readers
      pure subroutine choice_terms(message, text)
         !> Message with the names of the readable format
         character(len=*), intent(in) :: message
         !> Message with the names that its readers know
         character(len=:), allocatable, intent(out) :: text
      end subroutine choice_terms
   end interface

   !> Maximum number of distinct warnings per case, and number of characters that are compared
   integer, parameter :: max_distinct = 16, compared_length = 160

   !> A warning of the current case and its number of occurrences
   type :: counted_warning
      character(len=compared_length) :: text = ""
      integer :: times = 0
   end type counted_warning

   !> Sinks and settings of messages
   type :: log_type
      !> Unit of the screen, 0: none
      integer :: screen = 0
      !> The .out file; not open: none
      type(output_file) :: out
      !> Flow-trace level W of the case, 0...9
      integer :: level = 0
      !> Conversion of choices to the terms of the readers; not associated: names of the readable format
      procedure(choice_terms), pointer, nopass :: terms => null()
      !> Number of warnings since the log was created; repeated warnings of a case count once
      integer :: warnings = 0
      !> The same with repeated warnings
      integer :: occurrences = 0
      !> Distinct warnings of the current case, each of which is written once; entries 1...distinct are in use
      integer, private :: distinct = 0
      type(counted_warning), private :: seen(max_distinct)
      !> Are warnings held until `write_held`? Held warnings, one per line; unallocated: none
      logical, private :: holds = .false.
      character(len=:), allocatable, private :: held
      !> Are warnings deferred until `write_deferred`, because the solution may be repeated? Deferred warnings, as above
      logical, private :: defers = .false.
      character(len=:), allocatable, private :: deferred
   contains
      !> Write a line to both sinks
      procedure :: line => log_line
      !> Write a line to the .out file only
      procedure :: result => log_result
      !> Write a line to both sinks when the flow-trace level is high enough
      procedure :: trace => log_trace
      !> Write a warning to both sinks and count it; a warning repeated in the same case is only counted
      procedure :: warning => log_warning
      !> Convert the choices named by an error to the terms of the log; does nothing on success
      procedure :: translate_choices
      !> Start a case: reset the list of warnings
      procedure :: begin_case
      !> End a case: write the number of occurrences of repeated warnings
      procedure :: end_case
      !> Hold warnings from now on, and discard those held so far, which belong to a rejected trial
      procedure :: hold => log_hold
      !> Write the held warnings, and all later ones immediately
      procedure :: write_held => log_write_held
      !> Take the held warnings, which are not written, as one text; later ones are written immediately
      procedure :: take_held => log_take_held
      !> Defer warnings from now on, and discard those deferred so far; trials in between may hold and write warnings
      procedure :: defer => log_defer
      !> Write the deferred warnings, each once, and all later ones immediately
      procedure :: write_deferred => log_write_deferred
      !> Is anything written at this flow-trace level?
      procedure :: shows => log_shows
   end type log_type

contains

   subroutine log_line(self, text)
      class(log_type), intent(inout) :: self
      !> The line, without line end
      character(len=*), intent(in) :: text
      if (self%screen /= 0) write(self%screen, "(A)") text
      call self%out%line(text)
   end subroutine log_line

   subroutine log_result(self, text)
      class(log_type), intent(inout) :: self
      !> The line, without line end
      character(len=*), intent(in) :: text
      call self%out%line(text)
   end subroutine log_result

   subroutine log_trace(self, level, text)
      class(log_type), intent(inout) :: self
      !> Lowest flow-trace level at which the line is written
      integer, intent(in) :: level
      !> The line, without line end
      character(len=*), intent(in) :: text
      if (self%level >= level) call self%line(text)
   end subroutine log_trace

   subroutine log_warning(self, text)
      class(log_type), intent(inout) :: self
      !> The sentence, without the word "Warning"
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: translated

      if (self%holds) then
         call append(self%held, text)
      else if (self%defers) then
         call append(self%deferred, text)
      else if (associated(self%terms)) then
         call self%terms(text, translated)
         call write_warning(self, translated)
      else
         call write_warning(self, text)
      end if
   end subroutine log_warning

   !> Append a line
   pure subroutine append(lines, text)
      !> Unallocated: empty
      character(len=:), allocatable, intent(inout) :: lines
      character(len=*), intent(in) :: text

      if (.not. allocated(lines)) lines = ""
      lines = lines // text // new_line(text)
   end subroutine append

   !> Write a warning once per case
   subroutine write_warning(self, text)
      class(log_type), intent(inout) :: self
      character(len=*), intent(in) :: text
      integer :: k

      self%occurrences = self%occurrences + 1
      do k = 1, self%distinct
         if (.not. is_same_warning(self%seen(k)%text, text)) cycle
         self%seen(k)%times = self%seen(k)%times + 1
         return
      end do
      if (self%distinct < max_distinct) then
         self%distinct = self%distinct + 1
         self%seen(self%distinct)%text = text
         self%seen(self%distinct)%times = 1
      end if
      self%warnings = self%warnings + 1
      call self%line(" Warning: " // text)
   end subroutine write_warning

   subroutine translate_choices(self, error)
      class(log_type), intent(in) :: self
      !> Its message is converted; unallocated: nothing is done
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text

      if (.not. (allocated(error) .and. associated(self%terms))) return
      call self%terms(error%message, text)
      call move_alloc(text, error%message)
   end subroutine translate_choices

   subroutine begin_case(self)
      class(log_type), intent(inout) :: self
      self%distinct = 0
   end subroutine begin_case

   subroutine end_case(self)
      class(log_type), intent(inout) :: self
      character(len=48) :: count
      integer :: k

      do k = 1, self%distinct
         if (self%seen(k)%times < 2) cycle
         write(count, '(" Warning: (", I0, " times in this case) ")') self%seen(k)%times
         call self%line(trim(count) // " " // trim(self%seen(k)%text))
      end do
      self%distinct = 0
   end subroutine end_case

   !> Are two warnings identical except for numbers with a decimal point?
   pure logical function is_same_warning(one, other) result(same)
      !> A warning cut to compared_length, and a complete one
      character(len=*), intent(in) :: one, other
      integer :: a, b, next_a, next_b, length

      same = .false.
      length = min(len_trim(other), compared_length)
      a = 1
      b = 1
      do
         next_a = a + scan(one(a:) // " ", " ") - 1
         next_b = b + scan(other(b:length) // " ", " ") - 1
         if (one(a:next_a - 1) /= other(b:next_b - 1)) then
            if (.not. (is_real(one(a:next_a - 1)) .and. is_real(other(b:next_b - 1)))) return
         end if
         a = next_a + 1
         b = next_b + 1
         if (a > len_trim(one) .or. b > length) exit
      end do
      same = a > len_trim(one) .and. b > length
   end function is_same_warning

   !> Is a word a number with a decimal point?
   pure logical function is_real(word)
      character(len=*), intent(in) :: word
      is_real = scan(word, "0123456789") > 0 .and. index(word, ".") > 0 .and. verify(word, "0123456789.+-Ee,;:()") == 0
   end function is_real

   subroutine log_take_held(self, text)
      class(log_type), intent(inout) :: self
      !> Warnings with semicolons between; empty if there are none
      character(len=:), allocatable, intent(out) :: text
      integer :: k

      self%holds = .false.
      text = ""
      if (.not. allocated(self%held)) return
      call move_alloc(self%held, text)
      k = len(text)
      if (k > 0) text = text(:k - 1)
      do
         k = index(text, new_line(text))
         if (k == 0) exit
         text = text(:k - 1) // "; " // text(k + 1:)
      end do
   end subroutine log_take_held

   subroutine log_hold(self)
      class(log_type), intent(inout) :: self
      self%holds = .true.
      if (allocated(self%held)) deallocate(self%held)
   end subroutine log_hold

   subroutine log_write_held(self)
      class(log_type), intent(inout) :: self
      character(len=:), allocatable :: held

      self%holds = .false.
      if (.not. allocated(self%held)) return
      call move_alloc(self%held, held)
      call write_warnings(self, held)
   end subroutine log_write_held

   subroutine log_defer(self)
      class(log_type), intent(inout) :: self
      self%defers = .true.
      if (allocated(self%deferred)) deallocate(self%deferred)
   end subroutine log_defer

   subroutine log_write_deferred(self)
      class(log_type), intent(inout) :: self
      character(len=:), allocatable :: deferred

      self%defers = .false.
      if (.not. allocated(self%deferred)) return
      call move_alloc(self%deferred, deferred)
      call self%begin_case()
      call write_warnings(self, deferred)
      call self%end_case()
   end subroutine log_write_deferred

   !> Issue a warning for each line
   subroutine write_warnings(self, text)
      class(log_type), intent(inout) :: self
      !> Each line ends with a new_line
      character(len=*), intent(in) :: text
      integer :: first, length

      first = 1
      do while (first <= len(text))
         length = index(text(first:), new_line(text)) - 1
         call self%warning(text(first:first + length - 1))
         first = first + length + 1
      end do
   end subroutine write_warnings

   pure logical function log_shows(self, level) result(shows)
      class(log_type), intent(in) :: self
      !> Flow-trace level, 0 to 9
      integer, intent(in) :: level
      shows = self%level >= level .and. (self%screen /= 0 .or. self%out%is_open())
   end function log_shows
end module contact_base_log
