!> How often and how long the phases of a run were at work
module contact_experiment_stopwatch
   use contact_base_kinds, only : long, wp
   implicit none (type, external)
   private

   public :: stopwatch, wall_clock

   !> Calls and seconds of one phase
   type :: stopwatch
      integer :: calls = 0
      !> Processor time of all threads, elapsed time [s]
      real(wp) :: cpu = 0.0_wp, wall = 0.0_wp
      !> Times at the start of the call that is running
      real(wp), private :: cpu_start = 0.0_wp, wall_start = 0.0_wp
   contains
      procedure :: start
      procedure :: halt
   end type stopwatch

contains

   !> Start to count
   subroutine start(self)
      class(stopwatch), intent(inout) :: self

      self%wall_start = wall_clock()
      call cpu_time(self%cpu_start)
   end subroutine start

   !> Add what has passed since the start
   subroutine halt(self)
      class(stopwatch), intent(inout) :: self
      real(wp) :: now

      self%calls = self%calls + 1
      self%wall = self%wall + (wall_clock() - self%wall_start)
      call cpu_time(now)
      self%cpu = self%cpu + (now - self%cpu_start)
   end subroutine halt

   !> Elapsed time since a fixed moment [s]
   real(wp) function wall_clock() result(seconds)
      integer(long) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function wall_clock
end module contact_experiment_stopwatch
