!> Number of calls and times of the phases of a run
module contact_experiment_stopwatch
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_output_report, only : timer_line
   implicit none (type, external)
   private

   public :: stopwatch

   !> Calls and times of a phase
   type :: stopwatch
      integer :: calls = 0
      !> Processor time of all threads, elapsed time [s]
      real(wp) :: cpu = 0.0_wp, wall = 0.0_wp
      !> Times at the start of the current call
      real(wp), private :: cpu_start = 0.0_wp, wall_start = 0.0_wp
   contains
      procedure :: start
      procedure :: halt
      !> Add the calls and times of another stopwatch
      procedure :: add
      !> A line of the timer table
      procedure :: fill_line
   end type stopwatch

contains

   !> Start a call
   subroutine start(self)
      class(stopwatch), intent(inout) :: self

      self%wall_start = wall_clock()
      call cpu_time(self%cpu_start)
   end subroutine start

   !> End a call and add its times
   subroutine halt(self)
      class(stopwatch), intent(inout) :: self
      real(wp) :: now

      self%calls = self%calls + 1
      self%wall = self%wall + (wall_clock() - self%wall_start)
      call cpu_time(now)
      self%cpu = self%cpu + (now - self%cpu_start)
   end subroutine halt

   pure subroutine add(self, other)
      class(stopwatch), intent(inout) :: self
      !> Stopwatch to add
      type(stopwatch), intent(in) :: other

      self%calls = self%calls + other%calls
      self%cpu = self%cpu + other%cpu
      self%wall = self%wall + other%wall
   end subroutine add

   !> Set a line of the timer table, component by component, because constructors with texts leak memory
   pure subroutine fill_line(self, name, line)
      class(stopwatch), intent(in) :: self
      !> Name of the phase
      character(len=*), intent(in) :: name
      !> Name, calls and times
      type(timer_line), intent(out) :: line

      line%name = name
      line%calls = self%calls
      line%cpu = self%cpu
      line%wall = self%wall
   end subroutine fill_line
end module contact_experiment_stopwatch
