!> Course of a search that follows the last case: the last trial, and a bracket of the force once there is one
module contact_wheelrail_followed_force
   use contact_base_kinds, only : wp
   use contact_wheelrail_course, only : power
   use contact_wheelrail_memory, only : total_force, wheel_rail_memory
   implicit none (type, external)
   private

   public :: far_off, followed_force

   !> The trials so far
   type :: followed_force
      !> Prescribed force and its tolerance [N]
      real(wp) :: target = 0.0_wp, tolerance = 0.0_wp
      !> Height [mm], force and deviation of the force [N] of the last trial
      real(wp) :: z = 0.0_wp, force = 0.0_wp, miss = huge(1.0_wp)
      !> Did the last trial have estimated tractions?
      logical :: had_estimates = .false.
      !> Height of the last trial with a ratio of horizontal to vertical forces [mm], and this ratio [-]
      real(wp), private :: leaning_z = 0.0_wp, lean(2) = 0.0_wp
      logical, private :: has_lean = .false.
      !> Heights [mm] and forces [N] at the ends of the bracket
      real(wp), private :: low(2) = huge(1.0_wp), high(2) = huge(1.0_wp)
      !> Width of the bracket before the last trial [mm]; deviation below which the last trial says little [N]
      real(wp), private :: width = huge(1.0_wp), noise = huge(1.0_wp)
      !> Number of trials without progress; was the last one of them?
      integer, private :: stalled = 0
      logical, private :: stalls = .false.
   contains
      !> Change of the ratio of horizontal to vertical forces with the height
      procedure :: compare_lean
      !> Store a trial
      procedure :: record
      !> Height of the next trial
      procedure :: step_to
   end type followed_force

   !> Maximum reduction factor of the missed force per trial outside of the tolerance
   real(wp), parameter :: some_progress = 0.6_wp
   !> Maximum number of trials that miss the force by as much as the one before, but narrow its bracket
   integer, parameter :: most_stalls = 3
   !> Changes of grids cause steps of the force up to this fraction of the force
   real(wp), parameter :: step_of_grids = 1.0e-4_wp
   !> Deviations of the force relative to it above which the next trial will not be the last one, and above which estimated
   !> tractions do not change its sign [-]
   real(wp), parameter :: far_off = 0.01_wp, surely_off = 0.3_wp

contains

   !> Change of the ratio of horizontal to vertical forces with the height, from two trials
   pure subroutine compare_lean(self, memory, z, telling, sway)
      class(followed_force), intent(inout) :: self
      !> Patches of a trial
      type(wheel_rail_memory), intent(in) :: memory
      !> Its height, and the minimum difference of two heights that tells the change [mm]
      real(wp), intent(in) :: z, telling
      !> Change of the ratio per change of height [1/mm]; not changed if it is not known
      real(wp), intent(inout) :: sway
      real(wp) :: force(3), lean(2)

      force = total_force(memory)
      if (.not. abs(force(3)) > 0.0_wp) return
      lean = force(:2)/force(3)
      if (self%has_lean .and. abs(z - self%leaning_z) > telling) sway = norm2(lean - self%lean)/abs(z - self%leaning_z)
      self%lean = lean
      self%leaning_z = z
      self%has_lean = .true.
   end subroutine compare_lean

   !> Store a trial, and decide whether the search goes on
   !>
   !> A trial without progress may overshoot: it goes on if this gives a bracket, or narrows it.
   pure subroutine record(self, z, force, miss, has_estimates, is_loose, goes_on)
      class(followed_force), intent(inout) :: self
      !> Height [mm], force [N] and its deviation from the prescribed one [N]
      real(wp), intent(in) :: z, force, miss
      !> Are its tractions estimated? Were they solved with the tolerance of first trials?
      logical, intent(in) :: has_estimates, is_loose
      !> Is another trial worth while?
      logical, intent(out) :: goes_on
      real(wp) :: sure

      self%stalls = .not. self%had_estimates .and. miss > max(some_progress*self%miss, self%noise)
      ! with estimated or inaccurate tractions the force may be on the other side
      sure = 0.0_wp
      if (is_loose) sure = far_off*self%target
      if (has_estimates) sure = surely_off*self%target
      if (miss > sure) then
         if (force < self%target) then
            self%low = [z, force]
         else
            self%high = [z, force]
         end if
      end if
      goes_on = .true.
      if (self%stalls) then
         self%stalled = self%stalled + 1
         goes_on = self%stalled <= most_stalls
         if (miss > step_of_grids*self%target) goes_on = goes_on .and. has_bracket(self) &
            & .and. self%high(1) - self%low(1) < self%width
      end if
      if (has_bracket(self)) then
         self%width = self%high(1) - self%low(1)
         goes_on = goes_on .and. self%width > 0.0_wp
      end if
      self%noise = merge(far_off*self%target, self%tolerance, is_loose)
      self%z = z
      self%force = force
      self%miss = miss
   end subroutine record

   !> Height of the next trial, inside the bracket if there is one [mm]
   pure real(wp) function step_to(self, newton) result(z)
      !> After `record`
      class(followed_force), intent(in) :: self
      !> Newton's estimate [mm]
      real(wp), intent(in) :: newton
      real(wp) :: a, b

      z = newton
      if (.not. has_bracket(self)) return
      if (self%stalls .and. self%force < self%target) then
         z = 0.5_wp*(self%low(1) + self%high(1))
      else if (.not. (z > self%low(1) .and. z < self%high(1))) then
         a = max(self%low(2), 0.0_wp)**power
         b = self%high(2)**power
         z = self%low(1) + (self%high(1) - self%low(1))*(self%target**power - a)/(b - a)
      end if
   end function step_to

   !> Are both ends of the bracket known?
   pure logical function has_bracket(self)
      type(followed_force), intent(in) :: self

      has_bracket = max(self%low(1), self%high(1)) < huge(1.0_wp)
   end function has_bracket
end module contact_wheelrail_followed_force
