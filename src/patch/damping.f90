!> Damping forces proportional to the rate of the contact forces
!>
!> Between two moments the elastic forces change; a force in proportion to their rate, of limited size, is
!> meant for time integration of vehicles. It has no influence on the contact problem itself, and
!> the elastic forces are what is reported elsewhere.
module contact_patch_damping
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: damping_law, damping_forces

   !> Proportional damping; first the normal force, then both tangential ones
   type :: damping_law
      !> Damping force per rate [s]
      real(wp) :: coefficient(2) = 0.0_wp
      !> Largest rate that counts [N/s], positive or zero
      real(wp) :: largest_rate(2) = 0.0_wp
   end type damping_law

   !> Time steps below this one count as this one [s]
   real(wp), parameter :: min_step = 1.0e-20_wp

contains

   !> Forces that come on top of the elastic ones [N]
   pure function damping_forces(law, before, now, dt) result(force)
      !> Coefficients and the largest forces
      type(damping_law), intent(in) :: law
      !> Elastic forces Fn, Fx, Fy of the previous and the present time step [N]
      real(wp), intent(in) :: before(3), now(3)
      !> Time between both [s]
      real(wp), intent(in) :: dt
      real(wp) :: force(3)
      integer, parameter :: kind_of(3) = [1, 2, 2]

      force = (now - before)/max(min_step, dt)
      force = law%coefficient(kind_of)*min(law%largest_rate(kind_of), max(-law%largest_rate(kind_of), force))
   end function damping_forces
end module contact_patch_damping
