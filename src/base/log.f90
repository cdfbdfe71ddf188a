!> The two sinks of messages: the log (screen and .out file) and the result (.out file only)
!>
!> A log without screen and file swallows everything, which is what a library caller gets
!> who did not ask for messages. Lines that solvers write carry the flow-trace level (W digit)
!> from which on they appear.
module contact_base_log
   use contact_base_output_file, only : output_file
   implicit none (type, external)
   private

   public :: log_type

   !> Where messages go
   type :: log_type
      !> Unit of the screen, 0 for none
      integer :: screen = 0
      !> The .out file; not open for none
      type(output_file) :: out
      !> Flow-trace level W of the case, 0...9
      integer :: level = 0
      !> Number of warnings written since the log was made
      integer :: warnings = 0
      !> Warnings that wait for `speak`, one a line; allocated while they are held back
      character(len=:), allocatable, private :: held
   contains
      !> Write a line to both sinks
      procedure :: line => log_line
      !> Write a line to the .out file only
      procedure :: result => log_result
      !> Write a line to both sinks when the flow-trace level is high enough
      procedure :: trace => log_trace
      !> Write a warning to both sinks and count it
      procedure :: warning => log_warning
      !> From now on hold warnings back, and forget those that are held: they belong to a trial that did not count
      procedure :: hold => log_hold
      !> Write the warnings that are held, and all later ones at once
      procedure :: speak => log_speak
      !> Is anything written at this flow-trace level?
      procedure :: shows => log_shows
   end type log_type

contains

   subroutine log_line(self, text)
      class(log_type), intent(inout) :: self
      character(len=*), intent(in) :: text
      if (self%screen /= 0) write(self%screen, '(A)') text
      call self%out%line(text)
   end subroutine log_line

   subroutine log_result(self, text)
      class(log_type), intent(inout) :: self
      character(len=*), intent(in) :: text
      call self%out%line(text)
   end subroutine log_result

   subroutine log_trace(self, level, text)
      class(log_type), intent(inout) :: self
      !> Lowest flow-trace level at which the line appears
      integer, intent(in) :: level
      character(len=*), intent(in) :: text
      if (self%level >= level) call self%line(text)
   end subroutine log_trace

   subroutine log_warning(self, text)
      class(log_type), intent(inout) :: self
      !> The sentence, without the leading word
      character(len=*), intent(in) :: text
      if (allocated(self%held)) then
         self%held = self%held // text // new_line(text)
         return
      end if
      self%warnings = self%warnings + 1
      call self%line(" Warning: " // text)
   end subroutine log_warning

   subroutine log_hold(self)
      class(log_type), intent(inout) :: self
      self%held = ""
   end subroutine log_hold

   subroutine log_speak(self)
      class(log_type), intent(inout) :: self
      character(len=:), allocatable :: held
      integer :: first, length

      if (.not. allocated(self%held)) return
      call move_alloc(self%held, held)
      first = 1
      do while (first <= len(held))
         length = index(held(first:), new_line(held)) - 1
         call self%warning(held(first:first + length - 1))
         first = first + length + 1
      end do
   end subroutine log_speak

   pure logical function log_shows(self, level) result(shows)
      class(log_type), intent(in) :: self
      integer, intent(in) :: level
      shows = self%level >= level .and. (self%screen /= 0 .or. self%out%is_open())
   end function log_shows
end module contact_base_log
