!> Progress line of a run on a terminal
!>
!> It is written to the standard error stream and overwritten in place; never to a pipe or file.
module contact_experiment_progress
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : error_unit
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   implicit none (type, external)
   private

   public :: progress_line, is_terminal, progress_text

   !> Runs with fewer cases have no progress line
   integer, parameter :: many_cases = 10
   !> Minimum time between updates [s]
   real(wp), parameter :: pause_between = 0.2_wp
   !> File descriptor of the standard error stream
   integer(c_int), parameter :: standard_error = 2
   character(len=*), parameter :: carriage_return = achar(13), clear_to_end = achar(27) // "[K"

   !> State of the progress line
   type :: progress_line
      !> Number of cases of the run; 0: no line is shown
      integer :: total = 0
      !> Is it visible now?
      logical, private :: visible = .false.
      !> Times of the start of the run and of the last update [s]
      real(wp), private :: started = 0.0_wp, changed = 0.0_wp
   contains
      procedure :: begin
      procedure :: show
      procedure :: hide
   end type progress_line

   interface
      !> POSIX: 1 if the file descriptor refers to a terminal
      function c_isatty(descriptor) result(answer) bind(c, name="isatty")
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int) :: answer
      end function c_isatty
   end interface

contains

   !> Is the standard error stream a terminal?
   logical function is_terminal()
      is_terminal = c_isatty(standard_error) == 1_c_int
   end function is_terminal

   !> Set the number of cases and start the clock
   subroutine begin(self, total)
      class(progress_line), intent(inout) :: self
      !> Number of cases of the run
      integer, intent(in) :: total

      self%total = merge(total, 0, total >= many_cases)
      self%started = wall_clock()
      self%changed = self%started
   end subroutine begin

   !> Show the number of finished cases; the cursor remains at the start of the line
   subroutine show(self, done)
      class(progress_line), intent(inout) :: self
      !> Number of finished cases
      integer, intent(in) :: done
      real(wp) :: now

      if (self%total == 0) return
      now = wall_clock()
      if (now - self%changed < pause_between) return
      self%changed = now
      self%visible = .true.
      write(error_unit, "(A)", advance="no") carriage_return // trim(progress_text(done, self%total, now - self%started)) // &
         & clear_to_end // carriage_return
      flush(error_unit)
   end subroutine show

   !> Clear the line before other output
   subroutine hide(self)
      class(progress_line), intent(inout) :: self

      if (.not. self%visible) return
      self%visible = .false.
      write(error_unit, "(A)", advance="no") carriage_return // clear_to_end
      flush(error_unit)
   end subroutine hide

   !> " case 12 of 171, 1:05 left"
   pure function progress_text(done, total, elapsed) result(text)
      !> Numbers of finished cases and of all cases
      integer, intent(in) :: done, total
      !> Elapsed time of the cases so far [s]
      real(wp), intent(in) :: elapsed
      character(len=80) :: text
      integer :: seconds

      if (done < 1) then
         write(text, '(" case ", I0, " of ", I0)') min(done + 1, total), total
      else
         seconds = nint(min(elapsed*real(total - done, wp)/real(done, wp), 3.0e7_wp))
         if (seconds >= 3600) then
            write(text, '(" case ", I0, " of ", I0, ", ", I0, ":", I2.2, ":", I2.2, " left")') min(done + 1, total), total, &
               & seconds/3600, mod(seconds, 3600)/60, mod(seconds, 60)
         else
            write(text, '(" case ", I0, " of ", I0, ", ", I0, ":", I2.2, " left")') min(done + 1, total), total, &
               & seconds/60, mod(seconds, 60)
         end if
      end if
   end function progress_text
end module contact_experiment_progress
