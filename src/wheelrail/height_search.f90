!> Search for the height of the wheelset: trials at different heights, and their evaluation
!>
!> The heights are chosen by contact_wheelrail_force_balance, the forces are computed by contact_wheelrail_trial.
module contact_wheelrail_height_search
   use contact_base_choices, only : motion
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_wheelrail_course, only : power
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   use contact_patch_small_step, only : small_step, step_with_tractions
   use contact_wheelrail_memory, only : force_not_estimated, sum_of_normal_forces, wheel_rail_memory, vertical_force, &
      & vertical_slope
   use contact_wheelrail_patch_solution, only : can_skip_tractions, can_step_all, find_forces, update_share
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_trial, only : evaluate
   implicit none (type, external)
   private

   public :: height_search, mostly_friction

   !> State of a search
   type :: height_search
      !> Prescribed force [N], and stiffness of a spring without force at first touch [N/mm]
      real(wp) :: target = 0.0_wp, spring = 0.0_wp
      !> Height of first touch, minimum height of a lifted wheel, estimate for the next search, best height found [mm]
      real(wp) :: touch = 0.0_wp, bottom = 0.0_wp, guess = 0.0_wp, z = 0.0_wp
      !> Force of the last trial [N], and its derivatives with respect to the height [N/mm]: by the computed stiffness of the
      !> contacts, 0 if not known, and with the stiffness of Hertzian contact as substitute
      real(wp) :: force = 0.0_wp, slope = 0.0_wp, stiffness = 0.0_wp
      !> Number of trials so far
      integer :: trials = 0
      !> The last bracket
      type(force_balance) :: balance
      !> Relative deviation of the force in the last trial [-]
      real(wp), private :: off = huge(1.0_wp)
      !> Ratio of the force to the normal forces if friction carries nearly all of these, otherwise 1 [-]
      real(wp), private :: small = 1.0_wp
      !> Number of trials of the case before this search
      integer, private :: trials_before = 0
      !> Are the pressures of all trials solved closer than within EPS? Their starting values do not matter to the force then
      logical :: is_sharp = .false.
      !> But for the first one, which only has to give the next height?
      logical, private :: is_rough = .false.
      !> Are tractions of the present trial solved with a larger tolerance?
      logical, private :: is_loose = .false.
   contains
      procedure :: begin
      procedure :: approach
      procedure :: run
      procedure :: follow
      procedure :: try
      procedure :: compare_stiffness
      procedure, private :: bracket
   end type height_search

   !> If the last trial missed the force by less than `near_by` times EPS, pressures are solved to the fraction `sharper` of EPS
   real(wp), parameter :: near_by = 20.0_wp, sharper = 0.05_wp
   !> Tolerance of the force in a search with coarse elements [-], and its maximum number of trials
   real(wp), parameter :: close_enough = 3.0e-2_wp
   integer, parameter :: few_trials = 5
   !> Lower bound of the ratio `small`, by which the tolerance of pressures is reduced
   real(wp), parameter :: smallest = 1.0e-4_wp
   !> Search that follows the last case: maximum number of trials, fraction of EPS to be reached, maximum reduction factors of the
   !> missed force per trial, within the tolerance and outside, and range of plausible derivatives of the force relative to those by
   !> the stiffness
   integer, parameter :: max_followed = 7
   real(wp), parameter :: smooth = 0.02_wp, quick_progress = 0.2_wp, some_progress = 0.6_wp, least_stiff = 0.3_wp, &
      & most_stiff = 3.0_wp
   !> If a trial misses the force by less than `finished` times EPS, the rest may be a linear extrapolation, which neglects the
   !> rotation of patches: this effect may be at most `turned` times EPS of the force
   real(wp), parameter :: finished = 20.0_wp, turned = 0.2_wp
   !> The same limit in the first trial of simplified theory on pressures of the full theory
   real(wp), parameter :: first_finished = 5.0_wp
   !> The same for approximate pressures, which are scaled: the derivative of their force is known to a tenth
   real(wp), parameter :: finished_scaled = 2.0_wp
   !> If the first trial of the last case missed the force by less than this multiple of EPS, pressures of this first trial are
   !> solved accurately enough to be final
   real(wp), parameter :: near_enough = 60.0_wp
   !> Maximum number of steps of this extrapolation, and number of trials with less accurate tractions
   integer, parameter :: max_rounds = 4, most_loose = 3
   !> Tolerance of tangential tractions relative to that of the pressures
   real(wp), parameter :: smooth_tractions = 5.0_wp
   !> Tolerance of pressures in a first trial that only gives the next height, and of tractions in the first trials, relative to
   !> EPS. The last step solves the tractions anew
   real(wp), parameter :: first_pressures = 0.3_wp, first_tractions = 30.0_wp
   !> Minimum difference of two heights for the computation of a derivative, relative to the penetration: for smaller ones the
   !> change of grids is not negligible. It causes steps of the force up to this fraction of the force
   real(wp), parameter :: telling_way = 1.0e-3_wp, step_of_grids = 1.0e-4_wp
   !> Ratio of normal forces to the prescribed force above which friction carries nearly all of them
   real(wp), parameter :: mostly_friction = 20.0_wp
   !> If the force is exceeded at first touch, the wheel is lifted by up to this multiple of the approach of its patches, at least
   !> by this length [mm]
   real(wp), parameter :: lifted_approaches = 6.0_wp, lifted_length = 1.0e-6_wp
   !> Maximum penetration of trials, in radii of the wheel
   real(wp), parameter :: deepest = 1.1_wp

contains

   !> Start a search at first touch
   pure subroutine begin(self, memory, target, spring, trials_before)
      class(height_search), intent(inout) :: self
      !> Geometry with the gap at the present deflection of the rail
      type(wheel_rail_memory), intent(in) :: memory
      !> Prescribed force [N], positive, and stiffness of a spring [N/mm]
      real(wp), intent(in) :: target, spring
      !> Number of trials of this case so far, for the flow trace
      integer, intent(in) :: trials_before

      self%target = target
      self%spring = spring
      self%touch = memory%geometry%touch
      self%bottom = self%touch
      self%trials_before = trials_before
   end subroutine begin

   !> Improve the estimate by a separate search with coarse elements
   subroutine approach(self, problem, memory, coarser, log)
      class(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; those of the next trial start anew
      type(wheel_rail_memory), intent(inout) :: memory
      !> Sides of the coarse elements relative to the requested ones
      integer, intent(in) :: coarser
      !> Receives the trace of the solvers
      type(log_type), intent(inout) :: log
      type(error_type), allocatable :: error
      type(height_search) :: coarse

      call coarse%begin(memory, self%target, self%spring, self%trials_before)
      coarse%guess = self%guess
      memory%geometry%coarser = coarser
      call coarse%bracket(problem, memory, .false., close_enough, few_trials, log, error)
      memory%geometry%coarser = 1
      ! the first trial would fail with the same error
      if (allocated(error)) return
      if (coarse%balance%ended == balance_ending%reached .and. coarse%stiffness > 0.0_wp) &
         & self%guess = coarse%z + newton_step(coarse, coarse%stiffness)
   end subroutine approach

   !> Search with a new bracket, starting from `guess`; its best height is z
   subroutine run(self, problem, memory, with_friction, eps, max_trials, log, error)
      class(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; those of the last one are kept
      type(wheel_rail_memory), intent(inout) :: memory
      !> Are the tangential problems solved in all trials?
      logical, intent(in) :: with_friction
      !> Relative tolerance of the force [-]
      real(wp), intent(in) :: eps
      !> Maximum number of trials
      integer, intent(in) :: max_trials
      !> Receives the trace of the trials
      type(log_type), intent(inout) :: log
      !> Allocated if a trial has no result
      type(error_type), allocatable, intent(out) :: error
      integer :: before, k

      before = self%trials
      call self%bracket(problem, memory, with_friction, eps, max_trials, log, error)
      if (allocated(error) .or. self%balance%ended /= balance_ending%above_touch) return
      ! elements overlap before the mesh of the gap does, within its resolution: the regions of first touch are kept while the wheel
      ! is lifted
      memory%geometry%lowest_for_regions = self%touch + 2.0_wp*self%balance%resolution
      self%bottom = self%touch - lifted_length
      do k = 1, memory%used
         self%bottom = min(self%bottom, self%touch - lifted_approaches*memory%slot(k)%result%pen)
      end do
      self%guess = self%touch
      call self%bracket(problem, memory, with_friction, eps, max_trials - (self%trials - before), log, error)
   end subroutine run

   !> Search without bracket, with friction in every trial, from an estimate that follows the last case
   !>
   !> Newton's method for F**(2/3). The derivative by the stiffness neglects the rotation of steep patches and changes of friction;
   !> the true derivative, estimated from two trials, serves for the next trials, and for the next case. The force is reached more
   !> accurately than to EPS: the deviation would be noise between successive cases. If a step makes too little progress, the search
   !> fails, and only its time is lost.
   subroutine follow(self, problem, memory, stiffer, first_miss, is_settled, log, error)
      class(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; those of the last one are kept
      type(wheel_rail_memory), intent(inout) :: memory
      !> Ratio of the derivative of the force to its value by the stiffness [-]: last known value on entry, found value on exit
      real(wp), intent(inout) :: stiffer
      !> Deviation of the force in the first trial, relative to it [-]: in the last case on entry, in this one on exit
      real(wp), intent(inout) :: first_miss
      !> Was the force reached? z is the height, or the best one that was tried
      logical, intent(out) :: is_settled
      !> Receives the trace of the trials
      type(log_type), intent(inout) :: log
      !> Allocated if a trial has no result
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: z, last_z, last_force, miss, last_miss, best, low(2), high(2)
      logical :: is_plain, has_derivative, may_finish, skips, has_skipped
      integer :: k

      call self%balance%start(self%target, problem%template%settings%eps, self%bottom, &
         & self%touch + deepest*memory%geometry%placement%wheel_radius, max_followed, forces_are_estimates=.false.)
      is_settled = .false.
      ! tractions of simplified theory have no tolerance: with sharp pressures the first trial is as accurate as any
      is_plain = allocated(problem%template%simplified)
      has_derivative = problem%template%solves_for_pressure()
      self%is_sharp = .true.
      memory%geometry%ahead = 0.0_wp
      if (memory%geometry%follows_last) memory%geometry%ahead = memory%course%part(problem%spec%wheelset)
      z = self%guess
      best = huge(best)
      last_miss = huge(last_miss)
      last_z = z
      last_force = 0.0_wp
      low = huge(low)
      high = huge(high)
      skips = .false.
      do k = 1, max_followed
         self%is_rough = k == 1 .and. .not. is_plain .and. first_miss > near_enough*problem%template%settings%eps
         has_skipped = skips
         skips = self%is_rough .and. can_skip_tractions(problem, memory)
         self%is_loose = k == 1
         if (.not. is_plain .and. k > 1 .and. k <= most_loose) self%is_loose = can_step_all(memory)
         memory%geometry%is_first = k == 1
         memory%geometry%keeps_tractions = skips
         call self%try(problem, memory, z, .not. skips, log, error)
         memory%geometry%is_first = .false.
         memory%geometry%keeps_tractions = .false.
         if (allocated(error)) exit
         miss = abs(self%force - self%target)
         if (k == 1) first_miss = miss/self%target
         if (has_skipped) last_force = last_force + force_not_estimated(memory)
         if (k > 1) call self%compare_stiffness(z, last_z, last_force, stiffer)
         if (miss < best) then
            best = miss
            self%z = z
         end if
         is_settled = (is_plain .or. .not. self%is_loose) .and. miss <= smooth_part(problem)*self%balance%tolerance
         may_finish = .not. self%is_rough
         ! the derivative of the last case may not hold here
         if (k == 1 .and. is_plain .and. has_derivative) may_finish = miss <= first_finished*self%balance%tolerance
         if (may_finish .and. .not. is_settled .and. can_finish(self, miss, stiffer, has_derivative)) then
            call finish(self, problem, memory, self%is_loose .and. .not. is_plain, stiffer, z, log, is_settled)
            if (.not. (is_settled .or. (self%is_loose .and. k > 1)) .and. miss <= self%balance%tolerance) &
               & is_settled = k == max_followed .or. miss > quick_progress*last_miss
         end if
         if (is_settled) self%z = z
         if (is_settled .or. .not. (self%stiffness > 0.0_wp .and. self%force > 0.0_wp)) exit
         if (k > 1 .and. .not. has_skipped .and. miss > max(some_progress*last_miss, step_of_grids*self%target)) exit
         ! with estimated tractions the force may be on the other side
         if (self%force < self%target .and. .not. skips) low = [z, self%force]
         if (self%force >= self%target .and. .not. skips) high = [z, self%force]
         last_miss = miss
         last_z = z
         last_force = self%force
         z = z + newton_step(self, stiffer*self%stiffness)
         ! interpolate linearly between a lower and a higher force
         if (max(low(1), high(1)) < huge(low) .and. .not. (z > low(1) .and. z < high(1))) &
            & z = low(1) + (high(1) - low(1))*(self%target - low(2))/(high(2) - low(2))
         if (.not. z > self%touch) exit
      end do
      self%is_sharp = .false.
      self%is_rough = .false.
      self%is_loose = .false.
      self%balance%z = self%z
      self%balance%force = self%force
      self%guess = self%z
   end subroutine follow

   !> Newton step for F**(2/3) [mm]
   pure real(wp) function newton_step(self, derivative)
      !> Search with positive force of the last trial
      class(height_search), intent(in) :: self
      !> Derivative of the force with respect to the height [N/mm]
      real(wp), intent(in) :: derivative
      newton_step = self%force/(power*derivative)*((self%target/self%force)**power - 1.0_wp)
   end function newton_step

   !> Estimate the true derivative of the force from two trials
   pure subroutine compare_stiffness(self, z, last_z, last_force, stiffer)
      !> Search with force and stiffness of the last trial
      class(height_search), intent(in) :: self
      !> Heights of the last trial and of the one before [mm], and force of the latter [N]
      real(wp), intent(in) :: z, last_z, last_force
      !> Ratio of the derivative of the force to its value by the stiffness [-]; not changed if the estimate is not plausible
      real(wp), intent(inout) :: stiffer
      real(wp) :: ratio

      if (.not. abs(z - last_z) > telling_way*(z - self%touch)) return
      ratio = (self%force - last_force)/((z - last_z)*max(self%stiffness, tiny(ratio)))
      if (ratio > least_stiff .and. ratio < most_stiff) stiffer = ratio
   end subroutine compare_stiffness

   !> Is a linear extrapolation from the last trial accurate enough?
   pure logical function can_finish(self, miss, stiffer, has_derivative)
      type(height_search), intent(in) :: self
      !> Deviation of the force in the trial [N], and ratio of its derivative to the value by the stiffness [-]
      real(wp), intent(in) :: miss, stiffer
      !> Are pressures those of the full theory, whose derivative is known? Others are scaled
      logical, intent(in) :: has_derivative

      associate (tolerance => self%balance%tolerance)
         can_finish = miss <= tolerance
         if (has_derivative) then
            can_finish = can_finish .or. (miss <= finished*tolerance .and. abs(stiffer - 1.0_wp)*miss <= turned*tolerance)
         else
            can_finish = can_finish .or. miss <= finished_scaled*tolerance
         end if
      end associate
   end function can_finish

   !> Last Newton step as a linear extrapolation, if all patches allow it: to the prescribed force itself
   !>
   !> If the deviation exceeds EPS, or if tractions are rough, they are solved anew, which changes the force, and another step
   !> follows: one within EPS scales them to the force.
   subroutine finish(self, problem, memory, has_rough_tractions, stiffer, z, log, is_done)
      type(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches; updated to the new height
      type(wheel_rail_memory), intent(inout) :: memory
      !> Were tractions solved with the tolerance of a first trial?
      logical, intent(in) :: has_rough_tractions
      !> Ratio of the derivative of the force to its value by the stiffness [-]
      real(wp), intent(in) :: stiffer
      !> Height of the last trial on entry, the new one on exit [mm]
      real(wp), intent(inout) :: z
      !> Receives the trace of the solvers
      type(log_type), intent(inout) :: log
      !> Was the force reached? Otherwise another trial is needed, also if the tractions of a patch were not found
      logical, intent(out) :: is_done
      logical :: is_far
      real(wp) :: step
      integer :: k, round

      is_done = .false.
      if (.not. self%stiffness > 0.0_wp .or. memory%used == 0) return
      if (.not. can_step_all(memory)) return
      is_far = abs(self%force - self%target) > self%balance%tolerance .or. has_rough_tractions
      if (has_rough_tractions) then
         do k = 1, memory%used
            memory%slot(k)%problem%traction_eps = fine_tractions(problem)
         end do
      end if
      do round = 1, max_rounds
         step = (self%target - self%force)/(stiffer*self%stiffness)
         do k = 1, memory%used
            associate (slot => memory%slot(k), change => stiffer*memory%slot(k)%plane%axes(3, 3)*step)
               ! rotation and displacement of patches increase the stiffness; the step of each patch includes this factor
               if (is_far) then
                  call step_with_tractions(slot%problem, change, slot%state, slot%workspace, log, slot%result)
                  if (.not. slot%result%tangential%succeeded()) return
               else
                  call small_step(slot%problem, change, slot%state, slot%result)
               end if
               call find_forces(slot)
               ! new tractions have another ratio to the pressures
               if (is_far .and. slot%problem%motion /= motion%none) call update_share(slot)
            end associate
         end do
         z = z + step
         self%force = vertical_force(memory) + self%spring*(z - self%touch)
         is_done = .not. is_far
         if (is_done .or. .not. can_finish(self, abs(self%force - self%target), stiffer, .true.)) return
         is_far = abs(self%force - self%target) > self%balance%tolerance
      end do
   end subroutine finish

   !> Accuracy of the force relative to EPS, to limit noise between cases [-]
   pure real(wp) function smooth_part(problem)
      type(wheel_rail_problem), intent(in) :: problem
      !> Relative forces below this value are affected by round-off and residuals of iterations
      real(wp), parameter :: finest = 1.0e-8_wp

      smooth_part = min(1.0_wp, max(smooth, finest/problem%template%settings%eps))
   end function smooth_part

   !> Tolerance of tangential tractions relative to EPS [-]
   pure real(wp) function fine_tractions(problem)
      type(wheel_rail_problem), intent(in) :: problem

      fine_tractions = min(1.0_wp, smooth_tractions*smooth_part(problem))
   end function fine_tractions

   !> Search with a bracket
   subroutine bracket(self, problem, memory, with_friction, eps, max_trials, log, error)
      class(height_search), intent(inout) :: self
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      logical, intent(in) :: with_friction
      real(wp), intent(in) :: eps
      integer, intent(in) :: max_trials
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: trial, last_z, last_force, stiffer
      logical :: extrapolates, is_done
      integer :: k

      extrapolates = with_friction .and. problem%in_loop .and. allocated(problem%template%simplified)
      stiffer = 1.0_wp
      last_z = self%touch
      last_force = 0.0_wp
      k = 0
      call self%balance%start(self%target, eps, self%bottom, &
         & self%touch + deepest*memory%geometry%placement%wheel_radius, max(1, max_trials), &
         & forces_are_estimates=.not. with_friction)
      do while (self%balance%ended == balance_ending%running)
         trial = self%balance%next_trial(self%guess)
         call self%try(problem, memory, trial, with_friction, log, error)
         if (allocated(error)) return
         k = k + 1
         if (extrapolates .and. k > 1) then
            call self%compare_stiffness(trial, last_z, last_force, stiffer)
            last_z = trial
            last_force = self%force
            if (abs(self%force - self%target) > self%balance%tolerance .and. can_finish(self, abs(self%force - self%target), &
               & stiffer, problem%template%solves_for_pressure())) call finish(self, problem, memory, .false., stiffer, trial, &
               & log, is_done)
         else
            last_z = trial
            last_force = self%force
         end if
         call self%balance%record(trial, self%force, self%slope, memory%used, self%stiffness)
      end do
      self%z = self%balance%z
   end subroutine bracket

   !> Compute force and slope at a height; of the warnings, those of the last trial, or of one that fails, are kept
   subroutine try(self, problem, memory, z, with_friction, log, error)
      class(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> The patches at this height are solved
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm], z down
      real(wp), intent(in) :: z
      !> Are the tangential problems solved?
      logical, intent(in) :: with_friction
      !> Receives the trace; warnings are held back
      type(log_type), intent(inout) :: log
      !> Allocated if a patch has no result
      type(error_type), allocatable, intent(out) :: error

      call log%hold()
      ! with tolerance EPS, pressures of the last trial would be accepted at a nearby height
      memory%geometry%pressure_eps = 1.0_wp
      if (self%off > problem%template%settings%eps .and. self%off*self%small < near_by*problem%template%settings%eps) &
         & memory%geometry%pressure_eps = sharper*self%small
      memory%geometry%traction_eps = 1.0_wp
      if (self%is_sharp) then
         memory%geometry%pressure_eps = merge(first_pressures, smooth_part(problem), self%is_rough)*self%small
         memory%geometry%traction_eps = fine_tractions(problem)
         if (self%is_loose) memory%geometry%traction_eps = first_tractions
      end if
      call evaluate(problem, memory, z, with_friction, log, error)
      self%trials = self%trials + 1
      memory%geometry%pressure_eps = 1.0_wp
      memory%geometry%traction_eps = 1.0_wp
      if (allocated(error)) then
         if (memory%geometry%coarser == 1) call log%write_held()
         return
      end if
      self%force = vertical_force(memory) + self%spring*(z - self%touch)
      self%off = abs(self%force - self%target)/self%target
      ! a small difference of large forces requires higher accuracy
      self%small = 1.0_wp
      if (sum_of_normal_forces(memory) > mostly_friction*self%target) &
         & self%small = max(smallest, self%target/sum_of_normal_forces(memory))
      self%slope = vertical_slope(memory, estimated=.false.) + self%spring
      self%stiffness = vertical_slope(memory, estimated=.true.) + self%spring
      if (memory%geometry%coarser == 1) call trace_trial(self, z, log)
   end subroutine try

   !> Line of the flow trace
   subroutine trace_trial(self, z, log)
      type(height_search), intent(in) :: self
      !> Height of the trial [mm]
      real(wp), intent(in) :: z
      type(log_type), intent(inout) :: log
      character(len=100) :: line

      if (.not. log%shows(1)) return
      write(line, "(4X,I6,A,F12.4,ES12.4,A,ES12.3)") self%trials_before + self%trials, ", NR,  z_ws, Fz: ", z, self%force, &
         & ", dFz/dz:", self%slope
      call log%trace(1, trim(line))
   end subroutine trace_trial
end module contact_wheelrail_height_search
