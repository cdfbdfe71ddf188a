!> Search for the height of a wheel that carries a prescribed vertical force
!>
!> The force F increases with the penetration d = z - z0 beyond first touch, roughly as d**1.5, with kinks where patches appear and
!> possibly with jumps where they merge. F**(2/3) is nearly linear in d, and is interpolated. A lower end of the bracket is always
!> known: first touch with F = 0. Once an upper end is known, the bracket is halved at least in every third trial. If the force
!> increases in the bracket much more than the stiffness of the contact explains, it is taken as a jump: the bracket is bisected,
!> and the search ends when the position of the jump is known accurately. The search uses reverse communication: the caller
!> evaluates the force at the requested heights.
module contact_wheelrail_force_balance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: force_balance, balance_ending, height_trial

   type :: balance_ending_list
      !> Not finished
      integer :: running = 0
      !> The force was reached
      integer :: reached = 1
      !> The force has a jump at the prescribed value; the nearer side is used
      integer :: jump = 2
      !> The maximum number of trials was reached
      integer :: trial_limit = 3
      !> The force cannot be reached within the range of heights
      integer :: out_of_reach = 4
      !> The force is exceeded at first touch
      integer :: above_touch = 5
   end type balance_ending_list
   !> Ways in which the search ends
   type(balance_ending_list), parameter :: balance_ending = balance_ending_list()

   !> One trial: height [mm], force [N], slope dF/dz [N/mm] or 0 if unknown, its estimate by the stiffness of the contacts [N/mm],
   !> number of contact patches
   type :: height_trial
      real(wp) :: z = 0.0_wp, force = 0.0_wp, slope = 0.0_wp, stiffness = 0.0_wp
      integer :: patches = 0
   end type height_trial

   !> A search for the height
   type :: force_balance
      !> Prescribed force [N] and its tolerance [N]
      real(wp) :: target = 0.0_wp, tolerance = 0.0_wp
      !> Height of first touch, maximum height, width of a bracket that is regarded as a point [mm]
      real(wp) :: touch = 0.0_wp, highest = 0.0_wp, resolution = 1.0e-9_wp
      !> Number of trials, and its maximum
      integer :: trials = 0, max_trials = 25
      !> Best trial so far: height [mm] and force [N]
      real(wp) :: z = 0.0_wp, force = 0.0_wp
      !> Member of balance_ending
      integer :: ended = 0
      !> Bracket; `high` is valid only if has_high
      type(height_trial) :: low, high
      logical :: has_high = .false.
      !> Are forces computed with estimated friction? Then the search ends as soon as a jump is suspected
      logical, private :: forces_are_estimates = .false.
      !> Number of successive trials with a negative force that is below the force of the previous trial
      integer, private :: falling = 0
      !> The last trial, and the one before
      type(height_trial), private :: last, before
      !> Number of trials since the bracket was last halved, and its width then
      integer, private :: slow = 0
      real(wp), private :: old_width = huge(1.0_wp)
      !> Number of trials above the prescribed force as long as none is below it
      integer, private :: from_above = 0
   contains
      !> Start a search
      procedure :: start
      !> Height of the next trial
      procedure :: next_trial
      !> Process the force of a trial
      procedure :: record
   end type force_balance

   !> Maximum growth of the penetration per trial while there is no upper end of the bracket
   real(wp), parameter :: largest_growth = 4.0_wp
   !> Slopes whose relative difference exceeds this value are regarded as different
   real(wp), parameter :: alike = 0.2_wp
   !> Minimum distance of trials from the ends of a bracket, relative to its width or to the last step, whichever is shorter
   real(wp), parameter :: margin = 1.0e-3_wp
   !> While no trial is below the prescribed force, a trial makes progress if it reduces the deviation by this factor
   real(wp), parameter :: quick = 0.1_wp
   !> Maximum number of successive trials with estimated, decreasing negative forces, after which the friction estimate is given up
   integer, parameter :: max_falling = 5
   !> Ratio of the increase of the force to the stiffness of the contact above which a jump is suspected, and is certain
   real(wp), parameter :: seems_to_jump = 5.0_wp, jumps = 20.0_wp
   !> Accuracy of the position of a jump [mm], absolute and relative to the penetration
   real(wp), parameter :: place_of_jump = 1.0e-6_wp, part_of_penetration = 1.0e-3_wp
   !> Factor of the absolute accuracy if the slope of the force is not known
   real(wp), parameter :: steep_part = 1.0e-3_wp

   !> Width of a bracket that is regarded as a point, relative to the height of first touch or 1 mm: of the order of round-off
   real(wp), parameter :: point_width = 1.0e-12_wp
   !> Minimum growth of the penetration per trial while there is no upper end of the bracket
   real(wp), parameter :: min_growth = 1.02_wp
   !> Penetration that defines the length of the first steps from first touch [mm]
   real(wp), parameter :: shallow = 1.0e-3_wp
   !> Relative difference of the forces at the ends of a bracket that is regarded as round-off
   real(wp), parameter :: same_force = 1.0e-14_wp

contains

   !> Start a search between first touch and the maximum height
   subroutine start(self, target, eps, touch, highest, max_trials, forces_are_estimates)
      class(force_balance), intent(inout) :: self
      !> Prescribed force [N], positive
      real(wp), intent(in) :: target
      !> Relative tolerance of the force [-]
      real(wp), intent(in) :: eps
      !> Height of first touch and maximum height [mm], z down
      real(wp), intent(in) :: touch, highest
      !> Maximum number of trials
      integer, intent(in) :: max_trials
      !> Are forces computed with estimated friction? Then a jump is not located
      logical, intent(in) :: forces_are_estimates

      self%target = target
      self%tolerance = eps*target
      self%touch = touch
      self%highest = highest
      self%resolution = point_width*max(1.0_wp, abs(touch))
      self%max_trials = max_trials
      self%trials = 0
      self%z = touch
      self%force = 0.0_wp
      self%ended = balance_ending%running
      self%low = height_trial(z=touch)
      self%has_high = .false.
      self%last = height_trial(z=touch)
      self%before = self%last
      self%forces_are_estimates = forces_are_estimates
      self%falling = 0
      self%slow = 0
      self%old_width = huge(1.0_wp)
      self%from_above = 0
   end subroutine start

   !> Height of the next trial
   !>
   !> The first one is the caller's estimate, later ones are computed from the forces found.
   real(wp) function next_trial(self, guess) result(z)
      class(force_balance), intent(inout) :: self
      !> Estimate for the first trial [mm]
      real(wp), intent(in) :: guess
      real(wp) :: away, width

      if (self%trials == 0) then
         z = min(max(guess, self%touch + self%resolution), self%highest)
         return
      end if
      z = newton_step(self)
      if (is_close(self) .and. .not. self%last%slope > 0.0_wp) z = secant(self)
      if (.not. self%has_high) then
         if (self%last%force < 0.0_wp .and. self%last%slope > 0.0_wp) &
            & z = self%last%z + (self%target - self%last%force)/self%last%slope
         ! from below: with minimum and maximum growth of the penetration
         if (.not. is_close(self)) z = max(z, self%touch + min_growth*(self%low%z - self%touch) + self%resolution)
         z = min(z, self%touch + largest_growth*max(self%low%z - self%touch, shallow), self%highest)
         return
      end if
      width = self%high%z - self%low%z
      away = margin*min(width, abs(self%last%z - self%before%z))
      if (self%from_above >= 3 .and. newton_from(self, self%high) < self%touch + margin*width) then
         ! all trials indicate that the force acts at first touch
         z = self%touch + 2.0_wp*self%resolution
      else if (self%slow >= 3 .or. rises_more(self, seems_to_jump)) then
         z = 0.5_wp*(self%low%z + self%high%z)
         self%slow = 0
         self%old_width = width
      else if (is_close(self) .and. z > self%low%z .and. z < self%high%z) then
         ! any distance from the ends of the bracket is accepted
         continue
      else if (self%low%z > self%touch .and. .not. self%low%force > 0.0_wp) then
         if (self%low%force < 0.0_wp) then
            ! friction carries more than the pressures: the power law of the penetration does not hold
            z = straight_step(self, margin*width)
         else
            ! the lower end has no information on the force: step from the upper one
            z = newton_from(self, self%high)
         end if
         if (.not. (z > self%low%z + margin*width .and. z < self%high%z - margin*width)) z = 0.5_wp*(self%low%z + self%high%z)
      else if (.not. (z > self%low%z + away .and. z < self%high%z - away)) then
         z = interpolated(self)
         z = min(max(z, self%low%z + away), self%high%z - away)
      end if
   end function next_trial

   !> Is the last trial near the prescribed force, and much nearer than the one before, if there is one? Then the next step is
   !> accepted. A first trial without slope has to be nearer, as its step relies on the power law
   pure logical function is_close(self)
      class(force_balance), intent(in) :: self
      !> Maximum deviation of the force relative to the prescribed one, with and without slope, and relative to the deviation of the
      !> trial before
      real(wp), parameter :: near_target = 0.05_wp, very_near = 0.02_wp, nearer = 0.2_wp
      real(wp) :: miss

      associate (last => self%last, before => self%before)
         miss = abs(last%force - self%target)
         is_close = last%z > self%touch .and. last%force > 0.0_wp .and. miss <= near_target*self%target
         if (.not. is_close) return
         if (before%z > self%touch) then
            is_close = miss <= nearer*abs(before%force - self%target) .and. before%force > 0.0_wp &
               & .and. (last%force - before%force)*(last%z - before%z) > 0.0_wp
         else
            is_close = last%slope > 0.0_wp .or. miss <= very_near*self%target
         end if
      end associate
   end function is_close

   !> Newton step for F**(2/3) from the last trial; interpolation if the slope is not known, or differs from that of the bracket:
   !> the caller's slope neglects the rotation of steep patches
   pure real(wp) function newton_step(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp) :: chord

      associate (last => self%last, low => self%low, high => self%high)
         chord = last%slope
         if (self%has_high .and. low%z > self%touch) chord = (high%force - low%force)/(high%z - low%z)
         if (.not. (last%slope > 0.0_wp .and. last%force > 0.0_wp) &
            & .or. abs(chord - last%slope) > alike*abs(last%slope)) then
            z = interpolated(self)
            if (one_end_stays(self)) z = secant(self)
            return
         end if
         z = newton_from(self, last)
      end associate
   end function newton_step

   !> Are the last two trials on the same side of the prescribed force, the last one nearer, so that one end of the bracket is not
   !> moved?
   !>
   !> If the slope of the force increases strongly, as on a flank, chords of the bracket converge slowly.
   pure logical function one_end_stays(self)
      class(force_balance), intent(in) :: self

      one_end_stays = .false.
      if (.not. self%has_high .or. .not. self%before%z > self%touch .or. .not. self%before%force > 0.0_wp) return
      if ((self%before%force - self%target)*(self%last%force - self%target) <= 0.0_wp) return
      one_end_stays = (self%last%force - self%before%force)*(self%last%z - self%before%z) > 0.0_wp &
         & .and. abs(self%last%force - self%target) < abs(self%before%force - self%target)
   end function one_end_stays

   !> Root of the straight line through F**(2/3) of the last two trials
   pure real(wp) function secant(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp), parameter :: power = 2.0_wp/3.0_wp

      associate (last => self%last, before => self%before)
         z = last%z + (last%z - before%z)*(self%target**power - last%force**power)/(last%force**power - before%force**power)
      end associate
   end function secant

   !> Secant through the last two trials if it is within the bracket; otherwise the chord of the bracket, or its middle
   !>
   !> The force first decreases and then increases with growing slope: a chord whose root is near the lower end is a poor estimate,
   !> and gives ever smaller steps. The slope by the stiffness is of little use here, as it neglects changes of friction and the
   !> rotation of steep patches.
   pure real(wp) function straight_step(self, away) result(z)
      class(force_balance), intent(in) :: self
      !> Minimum distance from the ends of the bracket [mm]
      real(wp), intent(in) :: away
      !> Minimum position in the bracket, relative to its width, at which a chord is accepted
      real(wp), parameter :: near_low_end = 0.25_wp
      real(wp) :: rise, part

      associate (last => self%last, low => self%low, high => self%high)
         rise = (last%force - self%before%force)*(last%z - self%before%z)
         if (rise > 0.0_wp) then
            z = last%z + (self%target - last%force)*(last%z - self%before%z)**2/rise
            if (z > low%z + away .and. z < high%z - away) return
         end if
         part = (self%target - low%force)/(high%force - low%force)
         if (part < near_low_end) part = 0.5_wp
         z = low%z + (high%z - low%z)*part
      end associate
   end function straight_step

   !> Newton step for F**(2/3) from a trial; the trial itself if its force or its slope is not positive
   pure real(wp) function newton_from(self, trial) result(z)
      class(force_balance), intent(in) :: self
      type(height_trial), intent(in) :: trial

      z = trial%z
      if (trial%force > 0.0_wp .and. trial%slope > 0.0_wp) &
         & z = z + 1.5_wp*trial%force/trial%slope*((self%target/trial%force)**(2.0_wp/3.0_wp) - 1.0_wp)
   end function newton_from

   !> Linear interpolation of F**(2/3) in the bracket; without an upper end extrapolation from first touch and the best trial
   pure real(wp) function interpolated(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp) :: below, above, wanted

      wanted = self%target**(2.0_wp/3.0_wp)
      below = max(0.0_wp, self%low%force)**(2.0_wp/3.0_wp)
      if (self%has_high) then
         above = max(0.0_wp, self%high%force)**(2.0_wp/3.0_wp)
         if (above - below > same_force*wanted) then
            z = self%low%z + (self%high%z - self%low%z)*(wanted - below)/(above - below)
         else
            z = 0.5_wp*(self%low%z + self%high%z)
         end if
      else if (below > 0.0_wp) then
         z = self%touch + (self%low%z - self%touch)*wanted/below
      else
         z = self%touch + 2.0_wp*(self%low%z - self%touch) + shallow
      end if
   end function interpolated

   !> Does the force increase in the bracket by more than a multiple of the stiffness of the contact at its ends?
   pure logical function rises_more(self, times)
      class(force_balance), intent(in) :: self
      real(wp), intent(in) :: times
      real(wp) :: stiffness

      stiffness = max(self%low%stiffness, self%high%stiffness)
      rises_more = self%has_high .and. stiffness > 0.0_wp &
         & .and. self%high%force - self%low%force > times*stiffness*(self%high%z - self%low%z)
   end function rises_more

   !> Process the force of a trial, and its slope if that is known
   subroutine record(self, z, force, slope, patches, stiffness)
      class(force_balance), intent(inout) :: self
      !> Height [mm] and force [N]
      real(wp), intent(in) :: z, force
      !> dF/dz [N/mm]; not positive if unknown
      real(wp), intent(in) :: slope
      !> Number of contact patches
      integer, intent(in) :: patches
      !> Estimate of dF/dz that shows jumps if the slope is not known [N/mm]
      real(wp), intent(in), optional :: stiffness
      real(wp) :: width

      self%trials = self%trials + 1
      self%before = self%last
      self%last = height_trial(z, force, slope, slope, patches)
      if (present(stiffness)) self%last%stiffness = max(slope, stiffness)
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
      if (force > self%target .and. z - self%touch <= 4.0_wp*self%resolution) then
         self%ended = balance_ending%above_touch
         return
      end if
      if (force < self%target) then
         ! with a jump or a fold in the bracket, a trial may have a lower force than the lower end; the bracket still shrinks
         if (z > self%low%z .and. (.not. self%has_high .or. z < self%high%z)) self%low = self%last
      else if (.not. self%has_high .or. z < self%high%z) then
         self%has_high = .true.
         self%high = self%last
         ! a lower force was found at larger penetration: the bracket starts at first touch again
         if (self%low%z >= self%high%z) self%low = height_trial(z=self%touch)
      end if

      if (self%has_high) then
         width = self%high%z - self%low%z
         self%from_above = merge(0, self%from_above + 1, self%low%z > self%touch)
         self%slow = self%slow + 1
         if (width <= 0.5_wp*self%old_width .or. (self%from_above > 0 &
            & .and. abs(force - self%target) < quick*abs(self%before%force - self%target))) then
            self%slow = 0
            self%old_width = width
         end if
         if (width <= self%resolution*2.0_wp .or. jump_is_known(self, width)) then
            self%ended = balance_ending%jump
            return
         end if
      else
         ! the estimated friction makes the force negative: it decreases further with the penetration
         self%falling = merge(self%falling + 1, 0, force < min(0.0_wp, self%before%force) .and. slope < 0.0_wp)
         if (z >= self%highest .or. (self%forces_are_estimates .and. self%falling >= max_falling)) then
            self%ended = balance_ending%out_of_reach
            return
         end if
      end if
      if (self%trials >= self%max_trials) self%ended = balance_ending%trial_limit
   end subroutine record

   !> Does the force jump in the bracket, at an accurately known position? With estimated friction, a suspected jump is sufficient
   pure logical function jump_is_known(self, width)
      class(force_balance), intent(in) :: self
      !> Width of the bracket [mm]
      real(wp), intent(in) :: width
      real(wp) :: place

      if (self%forces_are_estimates) then
         jump_is_known = rises_more(self, seems_to_jump)
      else
         place = place_of_jump
         ! approximate pressures rise steeply, but not abruptly, where elements enter the contact
         if (.not. max(self%low%slope, self%high%slope) > 0.0_wp) place = steep_part*place_of_jump
         jump_is_known = width <= min(place, part_of_penetration*(self%high%z - self%touch))
         if (jump_is_known) jump_is_known = rises_more(self, jumps)
      end if
   end function jump_is_known
end module contact_wheelrail_force_balance
