!> Friction memory: the coefficient follows the law with a delay
!>
!> Particles carry a coefficient with them. Over a slipped distance of the order of the memory distance it approaches that of
!> the law,
!>
!>     mu = theta mu_before + (1 - theta) mu_law,   theta = d/(d + dt max(s, s_0)),
!>
!> with the memory distance d, the time step dt, the slip velocity s and a lower bound s_0 for it.
!> It is one step of the implicit Euler method for d mu/dt = -(max(s, s_0)/d)(mu - mu_law), which is of first order in the step.
!> Rolling of second order has the exact solution for a coefficient of the law that changes evenly along the path of a particle.
module contact_friction_memory
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: friction_memory

   type :: friction_memory
      !> Memory distance [mm]; below 1e-9: no memory
      real(wp) :: distance = 0.0_wp
      !> Minimum slip velocity of the adaptation [mm/s]
      real(wp) :: lowest_speed = 0.0_wp
   contains
      !> Is there any memory?
      procedure :: acts
      !> Weight theta of the previous coefficient
      procedure :: weight
      !> Coefficients in a time step, from those of the same particles in the previous step
      procedure :: step
      !> Coefficients in steady rolling, from the upstream neighbour
      procedure :: march
      !> The same of second order in the step
      procedure :: step_along, march_along
      !> A single particle behind a step, of second order
      procedure, private :: behind_path
   end type friction_memory

   !> Smaller memory distances mean no memory [mm]
   real(wp), parameter :: no_distance = 1.0e-9_wp
   !> Paths below this part of the memory distance have their weights by a series; its error is of the size of round-off
   real(wp), parameter :: short_path = 1.0e-3_wp

contains

   pure logical function acts(self)
      class(friction_memory), intent(in) :: self
      acts = self%distance > no_distance
   end function acts

   !> Weight of the previous coefficient in an element, from 0 (no memory) to 1 (no change)
   pure elemental real(wp) function weight(self, speed, dt) result(theta)
      class(friction_memory), intent(in) :: self
      !> Slip velocity [mm/s] and time step [s]
      real(wp), intent(in) :: speed, dt

      theta = 0.0_wp
      if (self%acts()) theta = self%distance/(self%distance + dt*max(speed, self%lowest_speed))
   end function weight

   pure subroutine step(self, speed, dt, before, mu)
      class(friction_memory), intent(in) :: self
      !> Slip velocity [mm/s], shape (mx, my)
      real(wp), contiguous, intent(in) :: speed(:, :)
      !> Time step [s]
      real(wp), intent(in) :: dt
      !> Coefficients of the same particles in the previous time step [-], shape (mx, my)
      real(wp), contiguous, intent(in) :: before(:, :)
      !> Coefficients of the law on entry, with memory on exit [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      real(wp) :: theta
      integer :: ix, iy

      if (.not. self%acts()) return
      do iy = 1, size(mu, 2)
         do ix = 1, size(mu, 1)
            theta = self%weight(speed(ix, iy), dt)
            mu(ix, iy) = theta*before(ix, iy) + (1.0_wp - theta)*mu(ix, iy)
         end do
      end do
   end subroutine step

   pure subroutine march(self, speed, dt, direction, inflow, mu)
      class(friction_memory), intent(in) :: self
      !> Slip velocity [mm/s], shape (mx, my)
      real(wp), contiguous, intent(in) :: speed(:, :)
      !> Time in which particles pass one element [s]
      real(wp), intent(in) :: dt
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Coefficients of particles that enter the grid [-], size my
      real(wp), intent(in) :: inflow(:)
      !> Coefficients of the law on entry, with memory on exit [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      real(wp) :: theta, before
      integer :: ix, iy, first, last

      if (.not. self%acts()) return
      first = merge(size(mu, 1), 1, direction > 0)
      last = size(mu, 1) + 1 - first
      do iy = 1, size(mu, 2)
         before = inflow(iy)
         do ix = first, last, -direction
            theta = self%weight(speed(ix, iy), dt)
            mu(ix, iy) = theta*before + (1.0_wp - theta)*mu(ix, iy)
            before = mu(ix, iy)
         end do
      end do
   end subroutine march

   !> Coefficients in a time step, of second order in the step
   pure subroutine step_along(self, speed, path, dt, speed_before, law_before, before, mu)
      class(friction_memory), intent(in) :: self
      !> Slip velocity at the end of the step [mm/s], and distance that particles slip during the step [mm], shape (mx, my)
      real(wp), contiguous, intent(in) :: speed(:, :), path(:, :)
      !> Time step [s]
      real(wp), intent(in) :: dt
      !> Slip velocity [mm/s], coefficient of the law [-] and coefficient [-] of the same particles in the previous time step, shape
      !> (mx, my)
      real(wp), contiguous, intent(in) :: speed_before(:, :), law_before(:, :), before(:, :)
      !> Coefficients of the law on entry, with memory on exit [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      integer :: ix, iy

      if (.not. self%acts()) return
      do iy = 1, size(mu, 2)
         do ix = 1, size(mu, 1)
            mu(ix, iy) = self%behind_path(path(ix, iy), dt, [speed_before(ix, iy), speed(ix, iy)], &
               & [law_before(ix, iy), mu(ix, iy)], before(ix, iy))
         end do
      end do
   end subroutine step_along

   !> Coefficients in steady rolling, of second order in the step
   pure subroutine march_along(self, speed, path, dt, direction, inflow, mu)
      class(friction_memory), intent(in) :: self
      !> Slip velocity in the middle of elements [mm/s], and distance that particles slip on their way from the upstream neighbour
      !> [mm], shape (mx, my)
      real(wp), contiguous, intent(in) :: speed(:, :), path(:, :)
      !> Time in which particles pass one element [s]
      real(wp), intent(in) :: dt
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Coefficients of particles that enter the grid [-], size my
      real(wp), intent(in) :: inflow(:)
      !> Coefficients of the law on entry, with memory on exit [-], shape (mx, my)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      real(wp) :: before, law(2), speeds(2)
      integer :: ix, iy, first, last

      if (.not. self%acts()) return
      first = merge(size(mu, 1), 1, direction > 0)
      last = size(mu, 1) + 1 - first
      do iy = 1, size(mu, 2)
         before = inflow(iy)
         law = mu(first, iy)
         speeds = speed(first, iy)
         do ix = first, last, -direction
            law = [law(2), mu(ix, iy)]
            speeds = [speeds(2), speed(ix, iy)]
            mu(ix, iy) = self%behind_path(path(ix, iy), dt, speeds, law, before)
            before = mu(ix, iy)
         end do
      end do
   end subroutine march_along

   !> Coefficient of a particle behind a step
   !>
   !> With x = path/d and a coefficient of the law that changes evenly from law(1) to law(2) along the path, mu is
   !>
   !>     e mu_before + (w - e) law(1) + (1 - w) law(2),   e = exp(-x),   w = (1 - e)/x.
   !>
   !> Where slip begins or ends it is the velocity that changes evenly in time, so the path has more of the coefficient at the
   !> larger velocity: of short paths (s1 + 2 s2)/(3 (s1 + s2)) in place of one half. All weights are positive and their sum is one,
   !> so coefficients stay between those of the law.
   pure real(wp) function behind_path(self, path, dt, speed, law, before) result(mu)
      class(friction_memory), intent(in) :: self
      !> Distance slipped [mm] and time step [s]
      real(wp), intent(in) :: path, dt
      !> Slip velocity [mm/s] and coefficient of the law [-] at the beginning and at the end of the step
      real(wp), intent(in) :: speed(2), law(2)
      !> Coefficient at the beginning [-]
      real(wp), intent(in) :: before
      real(wp) :: s(2), x, e, w, first

      s = max(speed, self%lowest_speed)
      x = max(path, dt*self%lowest_speed)/self%distance
      e = exp(-x)
      if (x > short_path) then
         w = (1.0_wp - e)/x
      else
         w = 1.0_wp - x/2.0_wp + x**2/6.0_wp - x**3/24.0_wp
      end if
      first = w - e
      if (s(1) + s(2) > 0.0_wp) first = first*(1.0_wp + (s(1) - s(2))/(3.0_wp*(s(1) + s(2))))
      mu = e*before + first*law(1) + (1.0_wp - e - first)*law(2)
   end function behind_path
end module contact_friction_memory
