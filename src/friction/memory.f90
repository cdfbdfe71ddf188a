!> Friction memory: the coefficient follows the law with a delay
!>
!> Particles carry a coefficient with them. Over a slipped distance of the order of the memory distance it approaches that of
!> the law,
!>
!>     mu = theta mu_before + (1 - theta) mu_law,   theta = d/(d + dt max(s, s_0)),
!>
!> with the memory distance d, the time step dt, the slip velocity s and a lower bound s_0 for it.
!> It is one step of the implicit Euler method for d mu/dt = -(max(s, s_0)/d)(mu - mu_law).
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
   end type friction_memory

   !> Smaller memory distances mean no memory [mm]
   real(wp), parameter :: no_distance = 1.0e-9_wp

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
end module contact_friction_memory
