!> A search for the height of the wheelset: trials of heights, and what they tell
!>
!> The heights come from contact_wheelrail_force_balance, the forces from contact_wheelrail_trial.
module contact_wheelrail_height_search
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   use contact_wheelrail_memory, only : wheel_rail_memory, vertical_force, vertical_slope
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_trial, only : evaluate
   implicit none (type, external)
   private

   public :: height_search, mostly_friction, sum_of_normal_forces

   !> State of a search
   type :: height_search
      !> Force to be reached [N], and the stiffness of a spring that is free of force at first touch [N/mm]
      real(wp) :: target = 0.0_wp, spring = 0.0_wp
      !> Height of first touch, lowest height for a wheel that is lifted off, guess for the next search, best height found [mm]
      real(wp) :: touch = 0.0_wp, bottom = 0.0_wp, guess = 0.0_wp, z = 0.0_wp
      !> Force of the last trial [N] and its derivative to the height [N/mm]
      real(wp) :: force = 0.0_wp, slope = 0.0_wp
      !> Trials so far
      integer :: trials = 0
      !> The last bracket
      type(force_balance) :: balance
      !> What the last trial missed the force by, relative to it
      real(wp), private :: off = huge(1.0_wp)
      !> The force relative to the normal forces where friction carries nearly all of these, otherwise 1
      real(wp), private :: small = 1.0_wp
      !> Trials of the case before this search
      integer, private :: trials_before = 0
   contains
      procedure :: begin
      procedure :: run
      procedure :: try
      procedure, private :: bracket
   end type height_search

   !> A trial after one that missed the force by less than so many times EPS solves pressures to that part of EPS
   real(wp), parameter :: near_by = 20.0_wp, sharper = 0.05_wp
   !> Least part of the normal forces that pressures are made sharper for
   real(wp), parameter :: smallest = 1.0e-4_wp
   !> Where the normal forces are so many times the prescribed force, friction carries nearly all of them
   real(wp), parameter :: mostly_friction = 20.0_wp
   !> A wheel whose force is exceeded at first touch is lifted off by so many approaches of its patches, and by this length [mm]
   real(wp), parameter :: lifted_approaches = 6.0_wp, lifted_length = 1.0e-6_wp
   !> Greatest penetration that is tried, in radii of the wheel
   real(wp), parameter :: deepest = 1.1_wp

contains

   !> A search from the first touch on
   pure subroutine begin(self, memory, target, spring, trials_before)
      class(height_search), intent(inout) :: self
      !> With the gap at the present deflection of the rail
      type(wheel_rail_memory), intent(in) :: memory
      !> Force to be reached [N], positive, and the stiffness of a spring [N/mm]
      real(wp), intent(in) :: target, spring
      !> Trials of this case so far, for the flow trace
      integer, intent(in) :: trials_before

      self%target = target
      self%spring = spring
      self%touch = memory%geometry%touch
      self%bottom = self%touch
      self%trials_before = trials_before
   end subroutine begin

   !> A search from a bracket of its own, from `guess` on; its best height is z
   subroutine run(self, problem, memory, with_friction, max_trials, log, error)
      class(height_search), intent(inout) :: self
      !> What is asked for wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; those of the last one stay
      type(wheel_rail_memory), intent(inout) :: memory
      !> Solve the tangential problems in all trials, too?
      logical, intent(in) :: with_friction
      !> Trials after which it ends
      integer, intent(in) :: max_trials
      !> Takes the trace of the trials
      type(log_type), intent(inout) :: log
      !> Allocated when a trial has no result
      type(error_type), allocatable, intent(out) :: error
      integer :: before, k

      before = self%trials
      call self%bracket(problem, memory, with_friction, max_trials, log, error)
      if (allocated(error) .or. self%balance%ended /= balance_ending%above_touch) return
      ! Elements overlap before the mesh of the gap does, by less than its width shows: the regions of the first touch stay
      ! while the wheel is lifted off
      memory%geometry%lowest_for_regions = self%touch + 2.0_wp*self%balance%resolution
      self%bottom = self%touch - lifted_length
      do k = 1, memory%used
         self%bottom = min(self%bottom, self%touch - lifted_approaches*memory%slot(k)%result%pen)
      end do
      self%guess = self%touch
      call self%bracket(problem, memory, with_friction, max_trials - (self%trials - before), log, error)
   end subroutine run

   !> A search between two heights
   subroutine bracket(self, problem, memory, with_friction, max_trials, log, error)
      class(height_search), intent(inout) :: self
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      logical, intent(in) :: with_friction
      integer, intent(in) :: max_trials
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: trial

      call self%balance%start(self%target, problem%template%settings%eps, self%bottom, &
         & self%touch + deepest*memory%geometry%placement%wheel_radius, max(1, max_trials), &
         & forces_are_estimates=.not. with_friction)
      do while (self%balance%ended == balance_ending%running)
         trial = self%balance%next_trial(self%guess)
         call self%try(problem, memory, trial, with_friction, log, error)
         if (allocated(error)) return
         call self%balance%record(trial, self%force, self%slope, memory%used)
      end do
      self%z = self%balance%z
   end subroutine bracket

   !> Force and slope at a height; only the warnings of the last trial, or of one that fails, are those of the case
   subroutine try(self, problem, memory, z, with_friction, log, error)
      class(height_search), intent(inout) :: self
      !> What is asked for wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Gets the patches at this height
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm], z down
      real(wp), intent(in) :: z
      !> Solve the tangential problems, too?
      logical, intent(in) :: with_friction
      !> Takes the trace; warnings are held back
      type(log_type), intent(inout) :: log
      !> Allocated when a patch has no result
      type(error_type), allocatable, intent(out) :: error

      call log%hold()
      ! pressures within EPS of the last ones would be taken for those of this height
      memory%geometry%pressure_eps = 1.0_wp
      if (self%off > problem%template%settings%eps .and. self%off*self%small < near_by*problem%template%settings%eps) &
         & memory%geometry%pressure_eps = sharper*self%small
      call evaluate(problem, memory, z, with_friction, log, error)
      self%trials = self%trials + 1
      memory%geometry%pressure_eps = 1.0_wp
      if (allocated(error)) then
         call log%speak()
         return
      end if
      self%force = vertical_force(memory) + self%spring*(z - self%touch)
      self%off = abs(self%force - self%target)/self%target
      ! a small difference of large forces needs sharper ones
      self%small = 1.0_wp
      if (sum_of_normal_forces(memory) > mostly_friction*self%target) &
         & self%small = max(smallest, self%target/sum_of_normal_forces(memory))
      self%slope = vertical_slope(memory) + self%spring
      call trace_trial(self, z, log)
   end subroutine try

   !> Line of the flow trace
   subroutine trace_trial(self, z, log)
      type(height_search), intent(in) :: self
      !> [mm]
      real(wp), intent(in) :: z
      type(log_type), intent(inout) :: log
      character(len=100) :: line

      if (.not. log%shows(1)) return
      write(line, "(4X,I6,A,F12.4,ES12.4,A,ES12.3)") self%trials_before + self%trials, ", NR,  z_ws, Fz: ", z, self%force, &
         & ", dFz/dz:", self%slope
      call log%trace(1, trim(line))
   end subroutine trace_trial

   !> Normal forces of all patches [N]
   pure real(wp) function sum_of_normal_forces(memory) result(total)
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      total = 0.0_wp
      do k = 1, memory%used
         total = total + memory%slot(k)%result%fn
      end do
   end function sum_of_normal_forces
end module contact_wheelrail_height_search
