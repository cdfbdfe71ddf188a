!> Search for the height of the wheelset: trials at different heights, and their evaluation
!>
!> The heights are chosen by contact_wheelrail_force_balance, the forces are computed by contact_wheelrail_trial.
module contact_wheelrail_height_search
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_wheelrail_course, only : power
   use contact_wheelrail_followed_force, only : far_off, followed_force
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   use contact_wheelrail_last_step, only : balance_point, can_finish, fine_tractions, finish, smooth_part
   use contact_wheelrail_memory, only : force_not_estimated, sum_of_normal_forces, wheel_rail_memory, vertical_force, &
      & vertical_slope
   use contact_wheelrail_patch_solution, only : can_skip_tractions, can_step_all
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
      procedure :: end_exactly
      procedure, private :: end_linearly
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
   !> Search that follows the last case: maximum number of trials, maximum reduction factor of the missed force per trial within the
   !> tolerance, and range of plausible derivatives of the force relative to those by the stiffness
   integer, parameter :: max_followed = 12
   real(wp), parameter :: quick_progress = 0.2_wp, least_stiff = 0.3_wp, most_stiff = 3.0_wp
   !> If the search ends with a linear extrapolation, which neglects the rotation of patches, its effect on the lateral force is at
   !> most this multiple of EPS of the vertical force
   real(wp), parameter :: turned_aside = 0.5_wp
   !> Largest deviation, relative to EPS, before this extrapolation in the first trial of simplified theory on pressures of the full
   !> theory
   real(wp), parameter :: first_finished = 5.0_wp
   !> If the first trial of the last case missed the force by less than this multiple of EPS, pressures of this first trial are
   !> solved accurately enough to be final
   real(wp), parameter :: near_enough = 60.0_wp
   !> Number of trials with less accurate tractions
   integer, parameter :: most_loose = 3
   !> Ratio of two forces beyond which their difference does not give the derivative; that of F**(2/3) does
   real(wp), parameter :: unlike = 1.2_wp
   !> Tolerance of pressures in a first trial that only gives the next height, and of tractions in the first trials, relative to
   !> EPS. The last step solves the tractions anew
   real(wp), parameter :: first_pressures = 0.3_wp, first_tractions = 30.0_wp
   !> Minimum difference of two heights for the computation of a derivative, relative to the penetration: for smaller ones the
   !> change of grids is not negligible
   real(wp), parameter :: telling_way = 1.0e-3_wp
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
   !> accurately than to EPS: the deviation would be noise between successive cases. A step from below may overshoot where another
   !> patch appears; the trial then is the upper end of a bracket. If steps make too little progress, the search fails, and only
   !> its time is lost.
   subroutine follow(self, problem, memory, stiffer, first_miss, sway, is_settled, log, error)
      class(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; those of the last one are kept
      type(wheel_rail_memory), intent(inout) :: memory
      !> Ratio of the derivative of the force to its value by the stiffness [-]: last known value on entry, found value on exit
      real(wp), intent(inout) :: stiffer
      !> Deviation of the force in the first trial, relative to it [-]: in the last case on entry, in this one on exit
      real(wp), intent(inout) :: first_miss
      !> Change of the ratio of horizontal to vertical forces per change of height [1/mm]: last known value on entry, found value on
      !> exit
      real(wp), intent(inout) :: sway
      !> Was the force reached? z is the height, or the best one that was tried
      logical, intent(out) :: is_settled
      !> Receives the trace of the trials
      type(log_type), intent(inout) :: log
      !> Allocated if a trial has no result
      type(error_type), allocatable, intent(out) :: error
      type(followed_force) :: course
      real(wp) :: z, miss, best
      logical :: is_plain, has_derivative, may_finish, skips, goes_on
      integer :: k

      call self%balance%start(self%target, problem%template%settings%eps, self%bottom, &
         & self%touch + deepest*memory%geometry%placement%wheel_radius, max_followed, forces_are_estimates=.false.)
      is_settled = .false.
      ! tractions of simplified theory have no tolerance: with sharp pressures the first trial is as accurate as any
      is_plain = allocated(problem%template%simplified)
      has_derivative = problem%template%solves_for_pressure()
      memory%geometry%ahead = 0.0_wp
      if (memory%geometry%follows_last) memory%geometry%ahead = memory%course%part(problem%spec%wheelset)
      course%target = self%target
      course%tolerance = self%balance%tolerance
      z = self%guess
      best = huge(best)
      skips = .false.
      do k = 1, max_followed
         self%is_rough = k == 1 .and. .not. is_plain .and. first_miss > near_enough*problem%template%settings%eps
         course%had_estimates = skips
         skips = self%is_rough .and. can_skip_tractions(problem, memory)
         self%is_loose = k == 1
         if (.not. is_plain .and. k > 1 .and. (k <= most_loose .or. course%miss > far_off*self%target)) &
            & self%is_loose = can_step_all(memory)
         memory%geometry%is_first = k == 1
         memory%geometry%keeps_tractions = skips
         call self%try(problem, memory, z, .not. skips, log, error)
         memory%geometry%is_first = .false.
         memory%geometry%keeps_tractions = .false.
         if (allocated(error)) exit
         miss = abs(self%force - self%target)
         if (k == 1) first_miss = miss/self%target
         if (course%had_estimates) course%force = course%force + force_not_estimated(memory)
         if (k > 1) call self%compare_stiffness(z, course%z, course%force, stiffer)
         call course%compare_lean(memory, z, telling_way*(z - self%touch), sway)
         if (miss < best) then
            best = miss
            self%z = z
         end if
         is_settled = (is_plain .or. .not. self%is_loose) .and. miss <= smooth_part(problem)*self%balance%tolerance
         may_finish = .not. self%is_rough .and. (miss <= self%balance%tolerance &
            & .or. sway*miss <= turned_aside*problem%template%settings%eps*stiffer*self%stiffness)
         ! the derivative of the last case may not hold here
         if (k == 1 .and. is_plain .and. has_derivative) may_finish = miss <= first_finished*self%balance%tolerance
         if (may_finish .and. .not. is_settled .and. can_finish(self%balance%tolerance, miss, stiffer, has_derivative)) then
            call self%end_linearly(problem, memory, self%is_loose .and. .not. is_plain, stiffer, z, log, is_settled)
            if (.not. (is_settled .or. (self%is_loose .and. k > 1)) .and. miss <= self%balance%tolerance) &
               & is_settled = k == max_followed .or. miss > quick_progress*course%miss
         end if
         if (is_settled) self%z = z
         if (is_settled .or. .not. (self%stiffness > 0.0_wp .and. self%force > 0.0_wp)) exit
         call course%record(z, self%force, miss, skips, self%is_loose, goes_on)
         if (.not. goes_on) exit
         z = course%step_to(z + newton_step(self, stiffer*self%stiffness))
         if (.not. z > self%touch) exit
      end do
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
      if (min(self%force, last_force) > 0.0_wp .and. max(self%force, last_force) > unlike*min(self%force, last_force)) &
         & ratio = (self%force**power - last_force**power)*self%force**(1.0_wp - power) &
         & /(power*(z - last_z)*max(self%stiffness, tiny(ratio)))
      if (ratio > least_stiff .and. ratio < most_stiff) stiffer = ratio
   end subroutine compare_stiffness

   !> End of a search with a bracket in a loop: the force is reached as accurately as by `follow`
   !>
   !> Within EPS of the vertical force, lateral forces of a flank differ by several EPS, and from those of `follow`.
   subroutine end_exactly(self, problem, memory, stiffer, log)
      class(height_search), intent(inout) :: self
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches of the last trial, at height z; updated to the new height
      type(wheel_rail_memory), intent(inout) :: memory
      !> Ratio of the derivative of the force to its value by the stiffness [-]
      real(wp), intent(in) :: stiffer
      !> Receives the trace of the solvers
      type(log_type), intent(inout) :: log
      logical :: is_done
      real(wp) :: z

      if (.not. (memory%geometry%follows_height .and. abs(self%force - self%target) <= self%balance%tolerance)) return
      z = self%z
      call self%end_linearly(problem, memory, .false., stiffer, z, log, is_done)
      if (is_done) self%z = z
   end subroutine end_exactly

   !> Last step of a search as a linear extrapolation
   subroutine end_linearly(self, problem, memory, has_rough_tractions, stiffer, z, log, is_done)
      class(height_search), intent(inout) :: self
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
      !> Was the force reached?
      logical, intent(out) :: is_done
      type(balance_point) :: point

      point = balance_point(target=self%target, tolerance=self%balance%tolerance, spring=self%spring, touch=self%touch, z=z, &
         & force=self%force, derivative=stiffer*self%stiffness, stiffer=stiffer)
      call finish(problem, memory, has_rough_tractions, point, log, is_done)
      z = point%z
      self%force = point%force
   end subroutine end_linearly

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
            if (abs(self%force - self%target) > self%balance%tolerance .and. can_finish(self%balance%tolerance, &
               & abs(self%force - self%target), stiffer, problem%template%solves_for_pressure())) &
               & call self%end_linearly(problem, memory, .false., stiffer, trial, log, is_done)
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
