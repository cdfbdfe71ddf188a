!> The height of a wheel that carries a prescribed vertical force
!>
!> The force F rises with the penetration d = z - z0 beyond the first touch, roughly as d**1.5, with
!> kinks where patches appear and possibly with jumps where they merge. F**(2/3) is nearly linear in
!> d, so that interpolation is done for it. There is always a bracket from below, the first touch with
!> F = 0; as soon as there is one from above, every trial halves it at the latest in every third step.
!> The caller asks for trials and answers with forces; nothing is called back.
module contact_wheelrail_force_balance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: force_balance, balance_ending

   type :: balance_ending_list
      !> Not finished
      integer :: running = 0
      !> The force is reached
      integer :: reached = 1
      !> The force jumps over the prescribed one; the closer side is taken
      integer :: jump = 2
      !> All allowed trials were used
      integer :: trial_limit = 3
      !> The force cannot be reached within the range of heights
      integer :: out_of_reach = 4
   end type balance_ending_list
   !> Names of the ways in which the search ends
   type(balance_ending_list), parameter :: balance_ending = balance_ending_list()

   !> A search for the height
   type :: force_balance
      !> Force to be reached [N] and its tolerance [N]
      real(wp) :: target = 0.0_wp, tolerance = 0.0_wp
      !> Height of first touch, highest height allowed, width of a bracket that counts as a point [mm]
      real(wp) :: touch = 0.0_wp, highest = 0.0_wp, resolution = 1.0e-9_wp
      !> Number of trials so far and allowed
      integer :: trials = 0, most_trials = 25
      !> Best trial so far: height [mm] and force [N]
      real(wp) :: z = 0.0_wp, force = 0.0_wp
      !> Member of balance_ending
      integer :: ended = 0
      !> Bracket: heights and forces [mm], [N]; above only when it was found
      real(wp), private :: low = 0.0_wp, low_force = 0.0_wp, high = 0.0_wp, high_force = 0.0_wp
      logical, private :: has_high = .false.
      !> Last trial with its slope dF/dz [N/mm], 0 when unknown
      real(wp), private :: last = 0.0_wp, last_force = 0.0_wp, last_slope = 0.0_wp
      !> Trials since the bracket was last halved, and its width then
      integer, private :: slow = 0
      real(wp), private :: old_width = huge(1.0_wp)
   contains
      !> Begin a search
      procedure :: start
      !> Height of the next trial
      procedure :: next_trial
      !> Answer to a trial
      procedure :: record
   end type force_balance

   !> Without a bracket from above the penetration grows at most by this factor per trial
   real(wp), parameter :: largest_growth = 4.0_wp
   !> Slopes that differ by more than this part are not the same
   real(wp), parameter :: alike = 0.2_wp
   !> Trials stay this part of a bracket away from its ends
   real(wp), parameter :: margin = 1.0e-3_wp

contains

   !> Begin a search between the first touch and the highest height
   subroutine start(self, target, eps, touch, highest, most_trials)
      class(force_balance), intent(inout) :: self
      !> Force to be reached [N], positive
      real(wp), intent(in) :: target
      !> Relative tolerance of the force [-]
      real(wp), intent(in) :: eps
      !> Height of first touch and highest height allowed [mm], z downwards
      real(wp), intent(in) :: touch, highest
      integer, intent(in) :: most_trials

      self%target = target
      self%tolerance = eps*target
      self%touch = touch
      self%highest = highest
      self%resolution = 1.0e-12_wp*max(1.0_wp, abs(touch))
      self%most_trials = most_trials
      self%trials = 0
      self%z = touch
      self%force = 0.0_wp
      self%ended = balance_ending%running
      self%low = touch
      self%low_force = 0.0_wp
      self%has_high = .false.
      self%last = touch
      self%last_force = 0.0_wp
      self%last_slope = 0.0_wp
      self%slow = 0
      self%old_width = huge(1.0_wp)
   end subroutine start

   !> Height of the next trial
   !>
   !> The first one is the caller's guess, later ones come from the forces found.
   real(wp) function next_trial(self, guess) result(z)
      class(force_balance), intent(inout) :: self
      !> Guess for the first trial [mm]
      real(wp), intent(in) :: guess
      real(wp) :: width

      if (self%trials == 0) then
         z = min(max(guess, self%touch + self%resolution), self%highest)
         return
      end if
      z = newton_step(self)
      if (.not. self%has_high) then
         ! from below: at least a little further, and not too far
         z = max(z, self%touch + 1.02_wp*(self%low - self%touch) + self%resolution)
         z = min(z, self%touch + largest_growth*max(self%low - self%touch, 1.0e-3_wp), self%highest)
         return
      end if
      width = self%high - self%low
      if (self%slow >= 3) then
         z = 0.5_wp*(self%low + self%high)
         self%slow = 0
         self%old_width = width
      else if (.not. (z > self%low + margin*width .and. z < self%high - margin*width)) then
         z = interpolated(self)
         z = min(max(z, self%low + margin*width), self%high - margin*width)
      end if
   end function next_trial

   !> Newton's step for F**(2/3) from the last trial; the interpolation where the slope is not known, or is not that of the
   !> bracket: the caller's slope leaves out that steep patches turn
   pure real(wp) function newton_step(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp) :: ratio, chord

      chord = self%last_slope
      if (self%has_high .and. self%low > self%touch) chord = (self%high_force - self%low_force)/(self%high - self%low)
      if (.not. (self%last_slope > 0.0_wp .and. self%last_force > 0.0_wp) &
         & .or. abs(chord - self%last_slope) > alike*abs(self%last_slope)) then
         z = interpolated(self)
         return
      end if
      ratio = self%target/self%last_force
      z = self%last + 1.5_wp*self%last_force/self%last_slope*(ratio**(2.0_wp/3.0_wp) - 1.0_wp)
   end function newton_step

   !> Linear interpolation of F**(2/3) in the bracket; extrapolation from touch and the best trial without one
   pure real(wp) function interpolated(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp) :: below, above, wanted

      wanted = self%target**(2.0_wp/3.0_wp)
      below = max(0.0_wp, self%low_force)**(2.0_wp/3.0_wp)
      if (self%has_high) then
         above = max(0.0_wp, self%high_force)**(2.0_wp/3.0_wp)
         if (above - below > 1.0e-14_wp*wanted) then
            z = self%low + (self%high - self%low)*(wanted - below)/(above - below)
         else
            z = 0.5_wp*(self%low + self%high)
         end if
      else if (below > 0.0_wp) then
         z = self%touch + (self%low - self%touch)*wanted/below
      else
         z = self%touch + 2.0_wp*(self%low - self%touch) + 1.0e-3_wp
      end if
   end function interpolated

   !> Answer to a trial: the force found there, and its slope where that is known
   subroutine record(self, z, force, slope)
      class(force_balance), intent(inout) :: self
      !> Height [mm] and force [N]
      real(wp), intent(in) :: z, force
      !> dF/dz [N/mm]; not positive when unknown
      real(wp), intent(in) :: slope
      real(wp) :: width

      self%trials = self%trials + 1
      self%last = z
      self%last_force = force
      self%last_slope = slope
      if (.not. ieee_is_finite(force)) then
         self%ended = balance_ending%out_of_reach
         return
      end if
      if (self%trials == 1 .or. abs(force - self%target) < abs(self%force - self%target)) then
         self%z = z
         self%force = force
      end if
      if (abs(force - self%target) <= self%tolerance) then
         self%ended = balance_ending%reached
         return
      end if
      if (force < self%target) then
         ! in a bracket with a jump or a fold a trial may be lower than the end below; the bracket still shrinks
         if (z > self%low .and. (.not. self%has_high .or. z < self%high)) then
            self%low = z
            self%low_force = force
         end if
      else if (.not. self%has_high .or. z < self%high) then
         self%has_high = .true.
         self%high = z
         self%high_force = force
         ! a lower force was found deeper: the bracket begins at the touch again
         if (self%low >= self%high) then
            self%low = self%touch
            self%low_force = 0.0_wp
         end if
      end if

      if (self%has_high) then
         width = self%high - self%low
         self%slow = self%slow + 1
         if (width <= 0.5_wp*self%old_width) then
            self%slow = 0
            self%old_width = width
         end if
         if (width <= self%resolution*2.0_wp) then
            self%ended = balance_ending%jump
            return
         end if
      else if (z >= self%highest) then
         self%ended = balance_ending%out_of_reach
         return
      end if
      if (self%trials >= self%most_trials) self%ended = balance_ending%trial_limit
   end subroutine record
end module contact_wheelrail_force_balance
