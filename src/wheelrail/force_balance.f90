!> The height of a wheel that carries a prescribed vertical force
!>
!> The force F rises with the penetration d = z - z0 beyond the first touch, roughly as d**1.5, with
!> kinks where patches appear and possibly with jumps where they merge. F**(2/3) is nearly linear in
!> d, so that interpolation is done for it. There is always a bracket from below, the first touch with
!> F = 0; as soon as there is one from above, every trial halves it at the latest in every third step.
!> Where the force rises much more between the ends of the bracket than the stiffness of the contact explains, it
!> jumps: the bracket is halved in every step, and the search ends when the place of the jump is known well enough.
!> The caller asks for trials and answers with forces; nothing is called back.
module contact_wheelrail_force_balance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: force_balance, balance_ending, height_trial

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
      !> The force is exceeded at the first touch already
      integer :: above_touch = 5
   end type balance_ending_list
   !> Names of the ways in which the search ends
   type(balance_ending_list), parameter :: balance_ending = balance_ending_list()

   !> One trial: height [mm], force [N], slope dF/dz [N/mm] or 0 when unknown, number of contact patches
   type :: height_trial
      real(wp) :: z = 0.0_wp, force = 0.0_wp, slope = 0.0_wp
      integer :: patches = 0
   end type height_trial

   !> A search for the height
   type :: force_balance
      !> Force to be reached [N] and its tolerance [N]
      real(wp) :: target = 0.0_wp, tolerance = 0.0_wp
      !> Height of first touch, highest height allowed, width of a bracket that counts as a point [mm]
      real(wp) :: touch = 0.0_wp, highest = 0.0_wp, resolution = 1.0e-9_wp
      !> Number of trials so far and allowed
      integer :: trials = 0, max_trials = 25
      !> Best trial so far: height [mm] and force [N]
      real(wp) :: z = 0.0_wp, force = 0.0_wp
      !> Member of balance_ending
      integer :: ended = 0
      !> Bracket; above only when it was found
      type(height_trial) :: low, high
      logical :: has_high = .false.
      !> Forces of trials are those of friction that is only estimated: what looks like a jump ends the search at once
      logical, private :: forces_are_estimates = .false.
      !> Trials one after the other, each with a force below zero and below that of the one before
      integer, private :: falling = 0
      !> The last trial, and the one before it
      type(height_trial), private :: last, before
      !> Trials since the bracket was last halved, and its width then
      integer, private :: slow = 0
      real(wp), private :: old_width = huge(1.0_wp)
      !> Trials with a force above the target, while there is none below it
      integer, private :: from_above = 0
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
   !> Trials stay this part of a bracket away from its ends, or of the last step where that is shorter
   real(wp), parameter :: margin = 1.0e-3_wp
   !> While no trial is below the force, one that misses it by this part of what the one before missed is no slow one
   real(wp), parameter :: quick = 0.1_wp
   !> Trials with estimated forces that fall further and further below zero, after which the ratio of friction leads nowhere
   integer, parameter :: max_falling = 5
   !> A force that rises this many times as much as the contact is stiff seems to jump, and jumps
   real(wp), parameter :: seems_to_jump = 5.0_wp, jumps = 20.0_wp
   !> The place of a jump is sought up to this distance [mm], and this part of the penetration
   real(wp), parameter :: place_of_jump = 1.0e-6_wp, part_of_penetration = 1.0e-3_wp

   !> Width of a bracket that counts as a point, relative to the height of first touch or 1 mm: what rounding leaves
   real(wp), parameter :: point_width = 1.0e-12_wp
   !> Without a bracket from above the penetration grows at least by this factor per trial
   real(wp), parameter :: min_growth = 1.02_wp
   !> Penetration that the first steps away from the first touch are measured by [mm]
   real(wp), parameter :: shallow = 1.0e-3_wp
   !> Forces at the ends of a bracket that differ by less than this part of the target are the same but for rounding
   real(wp), parameter :: same_force = 1.0e-14_wp

contains

   !> Begin a search between the first touch and the highest height
   subroutine start(self, target, eps, touch, highest, max_trials, forces_are_estimates)
      class(force_balance), intent(inout) :: self
      !> Force to be reached [N], positive
      real(wp), intent(in) :: target
      !> Relative tolerance of the force [-]
      real(wp), intent(in) :: eps
      !> Height of first touch and highest height allowed [mm], z downwards
      real(wp), intent(in) :: touch, highest
      !> Trials after which the search ends without success
      integer, intent(in) :: max_trials
      !> Are the forces those of friction that is only estimated? A jump is then not located
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
   !> The first one is the caller's guess, later ones come from the forces found.
   real(wp) function next_trial(self, guess) result(z)
      class(force_balance), intent(inout) :: self
      !> Guess for the first trial [mm]
      real(wp), intent(in) :: guess
      real(wp) :: away, width

      if (self%trials == 0) then
         z = min(max(guess, self%touch + self%resolution), self%highest)
         return
      end if
      z = newton_step(self)
      if (leads_on(self) .and. .not. self%last%slope > 0.0_wp) z = secant(self)
      if (.not. self%has_high) then
         if (self%last%force < 0.0_wp .and. self%last%slope > 0.0_wp) &
            & z = self%last%z + (self%target - self%last%force)/self%last%slope
         ! from below: at least a little further, and not too far
         if (.not. leads_on(self)) z = max(z, self%touch + min_growth*(self%low%z - self%touch) + self%resolution)
         z = min(z, self%touch + largest_growth*max(self%low%z - self%touch, shallow), self%highest)
         return
      end if
      width = self%high%z - self%low%z
      away = margin*min(width, abs(self%last%z - self%before%z))
      if (self%from_above >= 3 .and. newton_from(self, self%high) < self%touch + margin*width) then
         ! everything points to a force at the first touch
         z = self%touch + 2.0_wp*self%resolution
      else if (self%slow >= 3 .or. rises_more(self, seems_to_jump)) then
         z = 0.5_wp*(self%low%z + self%high%z)
         self%slow = 0
         self%old_width = width
      else if (leads_on(self) .and. z > self%low%z .and. z < self%high%z) then
         ! however near to the end of the bracket
         continue
      else if (self%low%z > self%touch .and. .not. self%low%force > 0.0_wp) then
         if (self%low%force < 0.0_wp) then
            ! friction carries more than the pressures: the power of the penetration means nothing
            z = straight_step(self, margin*width)
         else
            ! the end below tells nothing of the force: from the one above
            z = newton_from(self, self%high)
         end if
         if (.not. (z > self%low%z + margin*width .and. z < self%high%z - margin*width)) z = 0.5_wp*(self%low%z + self%high%z)
      else if (.not. (z > self%low%z + away .and. z < self%high%z - away)) then
         z = interpolated(self)
         z = min(max(z, self%low%z + away), self%high%z - away)
      end if
   end function next_trial

   !> Is the last trial near the target, and nearer by far than the one before it, if there was one? Then the next step is believed.
   !> A first one without slope has to be nearer: the step takes the power of the penetration for granted
   pure logical function leads_on(self)
      class(force_balance), intent(in) :: self
      !> Missed force relative to the target, and to what the trial before missed
      real(wp), parameter :: near_target = 0.05_wp, very_near = 0.02_wp, nearer = 0.2_wp
      real(wp) :: miss

      associate (last => self%last, before => self%before)
         miss = abs(last%force - self%target)
         leads_on = last%z > self%touch .and. last%force > 0.0_wp .and. miss <= near_target*self%target
         if (.not. leads_on) return
         if (before%z > self%touch) then
            leads_on = miss <= nearer*abs(before%force - self%target) .and. before%force > 0.0_wp &
               & .and. (last%force - before%force)*(last%z - before%z) > 0.0_wp
         else
            leads_on = last%slope > 0.0_wp .or. miss <= very_near*self%target
         end if
      end associate
   end function leads_on

   !> Newton's step for F**(2/3) from the last trial; the interpolation where the slope is not known, or is not that of the
   !> bracket: the caller's slope leaves out that steep patches turn
   pure real(wp) function newton_step(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp) :: chord

      associate (last => self%last, low => self%low, high => self%high)
         chord = last%slope
         if (self%has_high .and. low%z > self%touch) chord = (high%force - low%force)/(high%z - low%z)
         if (.not. (last%slope > 0.0_wp .and. last%force > 0.0_wp) &
            & .or. abs(chord - last%slope) > alike*abs(last%slope)) then
            z = interpolated(self)
            if (creeps(self)) z = secant(self)
            return
         end if
         z = newton_from(self, last)
      end associate
   end function newton_step

   !> Did the last two trials end on the same side of the target, one nearer than the other, so that one end of the bracket stays?
   !>
   !> Where the force rises faster and faster, as on a flank, chords of the bracket only creep on.
   pure logical function creeps(self)
      class(force_balance), intent(in) :: self

      creeps = .false.
      if (.not. self%has_high .or. .not. self%before%z > self%touch .or. .not. self%before%force > 0.0_wp) return
      if ((self%before%force - self%target)*(self%last%force - self%target) <= 0.0_wp) return
      creeps = (self%last%force - self%before%force)*(self%last%z - self%before%z) > 0.0_wp &
         & .and. abs(self%last%force - self%target) < abs(self%before%force - self%target)
   end function creeps

   !> Where F**(2/3) meets the target on the straight line through the last two trials
   pure real(wp) function secant(self) result(z)
      class(force_balance), intent(in) :: self
      real(wp), parameter :: power = 2.0_wp/3.0_wp

      associate (last => self%last, before => self%before)
         z = last%z + (last%z - before%z)*(self%target**power - last%force**power)/(last%force**power - before%force**power)
      end associate
   end function secant

   !> The secant through the last two trials where it stays within the bracket; else its chord, or its middle
   !>
   !> The force falls at first and rises faster and faster then: a chord that meets the target near the lower end is far from
   !> the force, and leads there in ever smaller steps. The slope that follows from the stiffness is of little use here, as it
   !> leaves out that friction and steep patches turn.
   pure real(wp) function straight_step(self, away) result(z)
      class(force_balance), intent(in) :: self
      !> Distance from the ends of the bracket at least [mm]
      real(wp), intent(in) :: away
      !> Least part of the bracket at which chords are believed
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

   !> Newton's step for F**(2/3) from a trial; the trial itself where its force or its slope is not positive
   pure real(wp) function newton_from(self, trial) result(z)
      class(force_balance), intent(in) :: self
      type(height_trial), intent(in) :: trial

      z = trial%z
      if (trial%force > 0.0_wp .and. trial%slope > 0.0_wp) &
         & z = z + 1.5_wp*trial%force/trial%slope*((self%target/trial%force)**(2.0_wp/3.0_wp) - 1.0_wp)
   end function newton_from

   !> Linear interpolation of F**(2/3) in the bracket; extrapolation from touch and the best trial without one
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

   !> Does the force rise more in the bracket than so many times the stiffness of the contact at its ends explains?
   pure logical function rises_more(self, times)
      class(force_balance), intent(in) :: self
      real(wp), intent(in) :: times
      real(wp) :: stiffness

      stiffness = max(self%low%slope, self%high%slope)
      rises_more = self%has_high .and. stiffness > 0.0_wp &
         & .and. self%high%force - self%low%force > times*stiffness*(self%high%z - self%low%z)
   end function rises_more

   !> Answer to a trial: the force found there, and its slope where that is known
   subroutine record(self, z, force, slope, patches)
      class(force_balance), intent(inout) :: self
      !> Height [mm] and force [N]
      real(wp), intent(in) :: z, force
      !> dF/dz [N/mm]; not positive when unknown
      real(wp), intent(in) :: slope
      !> Number of contact patches
      integer, intent(in) :: patches
      real(wp) :: width

      self%trials = self%trials + 1
      self%before = self%last
      self%last = height_trial(z, force, slope, patches)
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
         ! in a bracket with a jump or a fold a trial may be lower than the end below; the bracket still shrinks
         if (z > self%low%z .and. (.not. self%has_high .or. z < self%high%z)) self%low = self%last
      else if (.not. self%has_high .or. z < self%high%z) then
         self%has_high = .true.
         self%high = self%last
         ! a lower force was found deeper: the bracket begins at the touch again
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
         ! the ratio of friction that was learned makes the force negative: deeper it falls further
         self%falling = merge(self%falling + 1, 0, force < min(0.0_wp, self%before%force) .and. slope < 0.0_wp)
         if (z >= self%highest .or. (self%forces_are_estimates .and. self%falling >= max_falling)) then
            self%ended = balance_ending%out_of_reach
            return
         end if
      end if
      if (self%trials >= self%max_trials) self%ended = balance_ending%trial_limit
   end subroutine record

   !> Does the force jump in the bracket, and is the place known well enough? Estimated forces only raise suspicion
   pure logical function jump_is_known(self, width)
      class(force_balance), intent(in) :: self
      !> Of the bracket [mm]
      real(wp), intent(in) :: width

      if (self%forces_are_estimates) then
         jump_is_known = rises_more(self, seems_to_jump)
      else
         jump_is_known = width <= min(place_of_jump, part_of_penetration*(self%high%z - self%touch))
         if (jump_is_known) jump_is_known = rises_more(self, jumps)
      end if
   end function jump_is_known
end module contact_wheelrail_force_balance
