!> Friction that depends on slip velocity or temperature: iteration around the tangential problem
!>
!> Coefficients of friction determine slip, and slip determines coefficients. The caller solves the tangential problem with given
!> coefficients, passes the slip, and receives new coefficients, until slip velocities (or temperatures) no longer change. Falling
!> friction may have several solutions: more slip reduces friction, which increases slip. Started without slip, the iteration
!> increases to the solution with least slip; started with the rolling velocity, it decreases to the one with most slip. Hence it
!> must not overshoot.
module contact_patch_friction_iteration
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_friction_heated, only : heated_law
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : bounding_box, element
   use contact_patch_heat, only : new_heat_passage
   use contact_patch_problem, only : carried, patch_problem, patch_state, rolling_direction
   use contact_tangential_problem, only : tangential_solution
   use contact_temperature_flash_heating, only : heat_passage
   implicit none (type, external)
   private

   public :: friction_iteration

   !> State of the iteration
   type :: friction_iteration
      !> Member of ending; not_started while the iteration continues
      integer :: ended = 0
      !> Number of solutions so far, and number of successive solutions that did not converge
      integer :: passes = 0, failures = 0
      !> Last change of slip velocity [mm/s] or temperature [degC], and its magnitude; root mean squares
      real(wp) :: change = 0.0_wp, size = 0.0_wp
      !> Slip velocity of the present coefficients [mm/s], shape (mx, my)
      real(wp), allocatable, private :: speed(:, :)
      !> Distance that particles have slipped in the step [mm], shape (mx, my); unallocated where memory is of first order
      real(wp), allocatable, private :: path(:, :)
      !> Slip velocity [mm/s] and coefficient of the law [-] of the same particles in the previous time step, shape (mx, my)
      real(wp), allocatable, private :: speed_before(:, :), law_before(:, :)
      !> Temperature of body 1 for the present coefficients [degC], shape (mx, my)
      real(wp), allocatable, private :: temperature(:, :)
      !> Work space: velocities or temperatures of the new solution and of the last one, and coefficients of the last one, shape
      !> (mx, my)
      real(wp), allocatable, private :: new(:, :), last(:, :), last_mu(:, :)
      !> Time step [s]
      real(wp), private :: dt = 1.0_wp
      !> Relaxation factor where friction has increased, see problem%slip_relaxation [-]
      real(wp), private :: omega = 1.0_wp
      !> Number of slip elements of the last solution, -1 before the first one
      integer, private :: slipping = -1
   contains
      procedure :: start
      procedure :: advance
      procedure :: follows_paths
      procedure :: forget_paths
      procedure :: report => report_iteration
      procedure, private :: set_coefficients
   end type friction_iteration

   !> Relative change of slip velocities or temperatures at which the iteration has converged
   real(wp), parameter :: speed_tolerance = 1.0e-3_wp, temperature_tolerance = 1.0e-4_wp
   !> The relaxation factor is multiplied by `reduction` after each `speed_patience` or `temperature_patience` passes while the
   !> number of slip elements changes
   real(wp), parameter :: reduction = 0.8_wp
   integer, parameter :: speed_patience = 20, temperature_patience = 15
   !> Passes that are deducted from MAXIN to get the limit of the friction iteration
   integer, parameter :: spare_passes = 10

   !> Number of successive solutions without convergence after which the iteration is given up
   integer, parameter :: max_failures = 10

contains

   !> Initial coefficients of a case, or coefficients on a changed contact area
   subroutine start(self, problem, state, dt, order, is_first, mu)
      class(friction_iteration), intent(inout) :: self
      !> Friction law with its memory, pressures, motion
      type(patch_problem), intent(in) :: problem
      !> Coefficients and slip of the same particles at the previous time step
      type(patch_state), intent(in) :: state
      !> Time step [s]
      real(wp), intent(in) :: dt
      !> Order of the tangential problem; with order 2 friction memory is of second order, too
      integer, intent(in) :: order
      !> First outer iteration of a case? Later ones continue from the last coefficients
      logical, intent(in) :: is_first
      !> Coefficients of friction [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)

      self%ended = ending%not_started
      self%passes = 0
      self%failures = 0
      self%slipping = -1
      self%dt = dt
      self%omega = problem%slip_relaxation
      if (is_first) then
         if (problem%slip_start < 0) then
            self%speed = spread(spread(problem%veloc, 1, size(mu, 1)), 2, size(mu, 2))
         else if (problem%slip_start > 0) then
            self%speed = spread(spread(0.0_wp, 1, size(mu, 1)), 2, size(mu, 2))
         else
            self%speed = hypot(state%before%memory(carried%sx)%value, state%before%memory(carried%sy)%value)/dt
         end if
      end if
      where (state%now%division == element%exterior) self%speed = 0.0_wp
      if (is_first) call start_paths(self, problem, state, order)
      call self%set_coefficients(problem, state, mu)
   end subroutine start

   !> Paths of the particles for friction memory of second order, by the initial slip velocities
   subroutine start_paths(self, problem, state, order)
      class(friction_iteration), intent(inout) :: self
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      integer, intent(in) :: order

      call self%forget_paths()
      if (order /= 2 .or. .not. problem%friction_memory%acts()) return
      if (problem%friction%driver() == friction_driver%temperature) return
      self%path = self%dt*self%speed
      if (problem%motion == motion%steady_rolling) return
      self%speed_before = hypot(state%before%memory(carried%sx)%value, state%before%memory(carried%sy)%value)/self%dt
      self%law_before = self%speed_before
      call problem%friction%coefficient(self%speed_before, self%law_before)
   end subroutine start_paths

   !> Does friction memory need the distance that particles slip in a step?
   pure logical function follows_paths(self)
      class(friction_iteration), intent(in) :: self
      follows_paths = allocated(self%path)
   end function follows_paths

   !> Go on with friction memory of first order
   subroutine forget_paths(self)
      class(friction_iteration), intent(inout) :: self
      if (allocated(self%path)) deallocate(self%path)
      if (allocated(self%law_before)) deallocate(self%speed_before, self%law_before)
   end subroutine forget_paths

   !> Process a solution: choose the next coefficients, or end the iteration
   subroutine advance(self, problem, state, box, solution, converged, log, mu)
      class(friction_iteration), intent(inout) :: self
      !> Friction law with its memory, tolerance and limit of the iteration
      type(patch_problem), intent(in) :: problem
      !> Coefficients and slip of the same particles at the previous time step
      type(patch_state), intent(in) :: state
      !> Part of the grid that the solution covers
      type(bounding_box), intent(in) :: box
      !> Tractions and slip with the coefficients on entry
      type(tangential_solution), intent(in) :: solution
      !> Did the tangential problem reach its tolerance?
      logical, intent(in) :: converged
      !> Receives a line per iteration from flow-trace level 2 on
      type(log_type), intent(inout) :: log
      !> Coefficients of the solution on entry, the next ones on exit [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      real(wp) :: tolerance
      integer :: slipping, patience, ix, iy
      logical :: by_temperature

      by_temperature = problem%friction%driver() == friction_driver%temperature
      self%passes = self%passes + 1
      self%failures = merge(0, self%failures + 1, converged)
      slipping = count(solution%division == element%slip)
      self%last = self%speed
      self%last_mu = mu
      ! allocation with the shape of the grid
      self%new = mu
      self%new = 0.0_wp
      do iy = box%iy0, box%iy1
         do ix = box%ix0, box%ix1
            associate (jx => ix - box%ix0 + 1, jy => iy - box%iy0 + 1)
               if (solution%division(jx, jy) == element%slip) self%new(ix, iy) = &
                  & hypot(solution%slip(jx, jy, 1), solution%slip(jx, jy, 2))/self%dt
            end associate
         end do
      end do
      if (allocated(self%path)) then
         self%path = 0.0_wp
         self%path(box%ix0:box%ix1, box%iy0:box%iy1) = merge(solution%path, 0.0_wp, solution%division == element%slip)
      end if
      if (by_temperature) then
         self%last = self%temperature
         self%speed = self%new
         call self%set_coefficients(problem, state, mu)
         self%new = self%temperature
      end if
      call measure(self%new, self%last, state%now%division, self%change, self%size)
      tolerance = merge(temperature_tolerance, speed_tolerance, by_temperature)
      call trace_pass(log, self, by_temperature, count(solution%division == element%adhesion), slipping, tolerance)
      patience = merge(temperature_patience, speed_patience, by_temperature)
      if (mod(self%passes, patience) == 0 .and. slipping /= self%slipping) self%omega = reduction*self%omega
      self%slipping = slipping

      if (self%change <= tolerance*self%size .or. slipping == 0) then
         self%ended = ending%converged
      else if (self%passes >= max(1, problem%settings%maxin - spare_passes)) then
         self%ended = ending%iteration_limit
      else if (self%failures >= max_failures) then
         self%ended = ending%stagnated
      end if
      if (by_temperature) then
         ! the result has the coefficients with which the tractions were computed
         if (self%ended /= ending%not_started .and. slipping > 0) mu = self%last_mu
         return
      end if
      if (self%ended /= ending%not_started) then
         self%speed = self%new
         if (slipping == 0) call self%set_coefficients(problem, state, mu)
         return
      end if
      if (self%passes > 1) then
         call previous_coefficients(problem, state, mu, self%last_mu)
         where (self%new > 0.0_wp .and. mu > self%last_mu) &
            & self%new = max(0.0_wp, self%new + (self%omega - 1.0_wp)*(self%new - self%last))
      end if
      self%speed = self%new
      call self%set_coefficients(problem, state, mu)
   end subroutine advance

   !> Coefficients for the present slip velocities
   subroutine set_coefficients(self, problem, state, mu)
      class(friction_iteration), intent(inout) :: self
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      real(wp), contiguous, intent(inout) :: mu(:, :)

      if (problem%friction%driver() == friction_driver%temperature) then
         call heat_up(self, problem, state, mu)
         return
      end if
      call problem%friction%coefficient(self%speed, mu)
      if (.not. problem%friction_memory%acts()) return
      if (problem%motion == motion%steady_rolling) then
         if (allocated(self%path)) then
            call problem%friction_memory%march_along(self%speed, self%path, self%dt, rolling_direction(problem), &
               & problem%static_mu, mu)
         else
            call problem%friction_memory%march(self%speed, self%dt, rolling_direction(problem), problem%static_mu, mu)
         end if
      else if (allocated(self%path)) then
         call problem%friction_memory%step_along(self%speed, self%path, self%dt, self%speed_before, self%law_before, &
            & state%before%memory(carried%mu)%value, mu)
      else
         call problem%friction_memory%step(self%speed, self%dt, state%before%memory(carried%mu)%value, mu)
      end if
   end subroutine set_coefficients

   !> Previous coefficients of the particles: of the previous time step, in steady rolling of the neighbouring element upstream
   subroutine previous_coefficients(problem, state, mu, before)
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      !> Present coefficients [-], shape (mx, my)
      real(wp), contiguous, intent(in) :: mu(:, :)
      !> Coefficients of friction of the particles one step before [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: before(:, :)
      integer :: mx

      mx = size(mu, 1)
      if (problem%motion /= motion%steady_rolling) then
         before = state%before%memory(carried%mu)%value
      else if (rolling_direction(problem) > 0) then
         before(:mx - 1, :) = mu(2:, :)
         before(mx, :) = problem%static_mu
      else
         before(2:, :) = mu(:mx - 1, :)
         before(1, :) = problem%static_mu
      end if
   end subroutine previous_coefficients

   !> Consistent coefficients and temperatures for the present slip velocities
   subroutine heat_up(self, problem, state, mu)
      class(friction_iteration), intent(inout) :: self
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(heat_passage) :: passage
      real(wp), allocatable :: heat(:, :)

      allocate(heat(size(mu, 1), size(mu, 2)), source=0.0_wp)
      self%temperature = heat
      passage = new_heat_passage(problem, state%now%division)
      select type (law => problem%friction)
      type is (heated_law)
         call passage%heat_by_friction(law, problem%friction_memory, state%now%pn, self%speed, heat, self%dt, mu, &
            & self%temperature)
      end select
   end subroutine heat_up

   !> Root mean squares over the contact area of the change and of the new values
   pure subroutine measure(new, old, division, change, size_)
      real(wp), intent(in) :: new(:, :), old(:, :)
      integer, intent(in) :: division(:, :)
      real(wp), intent(out) :: change, size_
      integer :: n

      n = max(1, count(division > element%exterior))
      change = sqrt(sum((new - old)**2, mask=division > element%exterior)/n)
      size_ = sqrt(sum(new**2, mask=division > element%exterior)/n)
   end subroutine measure

   !> How the iteration ended
   subroutine report_iteration(self, problem, report)
      class(friction_iteration), intent(in) :: self
      !> Tolerance of the iteration
      type(patch_problem), intent(in) :: problem
      !> Iterations and residual of the coefficients
      type(solve_report), intent(out) :: report

      report%method = "friction iteration"
      report%ended = self%ended
      report%iterations = self%passes
      report%passes = self%passes
      report%residual = self%change/max(self%size, epsilon(self%size)*self%change, tiny(self%size))
      report%tolerance = merge(temperature_tolerance, speed_tolerance, &
         & problem%friction%driver() == friction_driver%temperature)
   end subroutine report_iteration

   !> Line of the flow trace for one pass
   subroutine trace_pass(log, iteration, by_temperature, adhering, slipping, tolerance)
      type(log_type), intent(inout) :: log
      type(friction_iteration), intent(in) :: iteration
      logical, intent(in) :: by_temperature
      integer, intent(in) :: adhering, slipping
      real(wp), intent(in) :: tolerance
      character(len=120) :: line

      if (.not. log%shows(2)) return
      if (by_temperature) then
         write(line, "(I5,A,2I6,A,2ES12.3)") iteration%passes, ", Temp-dep: A, S=", adhering, slipping, &
            & ", |Tk-Tk-1|, .0001 |Tk| : ", iteration%change, tolerance*iteration%size
      else
         write(line, "(I5,A,2I6,A,2ES12.3)") iteration%passes, ", Vel-dep: A, S=", adhering, slipping, &
            & ", |Sk-Sk-1|, .001 |Sk| : ", iteration%change, tolerance*iteration%size
      end if
      call log%trace(2, trim(line))
   end subroutine trace_pass
end module contact_patch_friction_iteration
