!> Damping forces proportional to the rate of the contact forces
!>
!> The damping force is proportional to the change of the elastic contact forces between two time steps, with limited rate. It
!> serves the time integration of vehicle models. It does not influence the contact problem; all other outputs give the elastic
!> forces.
module contact_patch_damping
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: damping_law, damping_forces

   !> Proportional damping; first value for the normal force, second value for both tangential forces
   type :: damping_law
      !> Damping coefficient [s]
      real(wp) :: coefficient(2) = 0.0_wp
      !> Upper bound of the rate [N/s], not negative
      real(wp) :: largest_rate(2) = 0.0_wp
   end type damping_law

   !> Lower bound of the time step [s]
   real(wp), parameter :: min_step = 1.0e-20_wp

contains

   !> Damping forces, in addition to the elastic forces [N]
   pure function damping_forces(law, before, now, dt) result(force)
      !> Coefficients and bounds of the rates
      type(damping_law), intent(in) :: law
      !> Elastic forces Fn, Fx, Fy of the previous and the present time step [N]
      real(wp), intent(in) :: before(3), now(3)
      !> Time step [s]
      real(wp), intent(in) :: dt
      real(wp) :: force(3)
      integer, parameter :: kind_of(3) = [1, 2, 2]

      force = (now - before)/max(min_step, dt)
      force = law%coefficient(kind_of)*min(law%largest_rate(kind_of), max(-law%largest_rate(kind_of), force))
   end function damping_forces
end module contact_patch_damping
