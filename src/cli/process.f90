!> The process of the program, see process.c: signals, streams, and execution of another program
module contact_cli_process
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_loc, c_null_char, c_null_ptr, c_ptr
   implicit none (type, external)
   private

   public :: catch_signals, exit_status_of_signal, fill_streams, replace_process, restore_signals, set_variable, stop_by_signal
   public :: word_type

   !> A word of a command line
   type :: word_type
      character(len=:), allocatable :: text
   end type word_type

   interface
      !> Open standard streams that are closed; must be called first
      subroutine fill_streams() bind(c, name="contact_fill_streams")
      end subroutine fill_streams

      !> End the run after the current case when a signal arrives
      subroutine catch_signals() bind(c, name="contact_catch_signals")
      end subroutine catch_signals

      !> Restore the default action of signals
      subroutine restore_signals() bind(c, name="contact_restore_signals")
      end subroutine restore_signals

      function caught_signal() result(number) bind(c, name="contact_caught_signal")
         import :: c_int
         integer(c_int) :: number
      end function caught_signal

      function execvp(file, words) result(status) bind(c, name="execvp")
         import :: c_char, c_int, c_ptr
         character(kind=c_char), intent(in) :: file(*)
         type(c_ptr), intent(in) :: words(*)
         integer(c_int) :: status
      end function execvp

      function setenv(name, value, overwrite) result(status) bind(c, name="setenv")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*), value(*)
         integer(c_int), value :: overwrite
         integer(c_int) :: status
      end function setenv
   end interface

contains

   !> Has a signal arrived? For run_experiment
   subroutine stop_by_signal(reason)
      !> "signal TERM"; unallocated: none
      character(len=:), allocatable, intent(out) :: reason
      integer :: number

      number = int(caught_signal())
      select case (number)
      case (0)
      case (1)
         reason = "signal HUP"
      case (2)
         reason = "signal INT"
      case (13)
         reason = "signal PIPE"
      case (15)
         reason = "signal TERM"
      case default
         reason = "signal XCPU"
      end select
   end subroutine stop_by_signal

   !> Exit status of a program ended by a signal, as used by shells
   integer function exit_status_of_signal() result(status)
      integer, parameter :: first = 128
      status = first + int(caught_signal())
   end function exit_status_of_signal

   !> Set an environment variable
   subroutine set_variable(name, value)
      !> Name and value
      character(len=*), intent(in) :: name, value
      integer(c_int) :: ignored

      ignored = setenv(name // c_null_char, value // c_null_char, 1_c_int)
   end subroutine set_variable

   !> Replace this program by another one in the same process; returns only if it is not found
   subroutine replace_process(words)
      !> Name of the program, to be found on the search path, and its arguments
      type(word_type), intent(in) :: words(:)
      type(word_type), target :: ended(size(words))
      type(c_ptr) :: pointers(size(words) + 1)
      integer(c_int) :: ignored
      integer :: k

      do k = 1, size(words)
         ended(k)%text = words(k)%text // c_null_char
         pointers(k) = c_loc(ended(k)%text)
      end do
      pointers(size(pointers)) = c_null_ptr
      ignored = execvp(ended(1)%text, pointers)
   end subroutine replace_process
end module contact_cli_process
