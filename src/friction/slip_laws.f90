!> Friction that decreases with slip velocity: piecewise linear, rational, exponential
!>
!> mu(s) = mu_kinetic + the sum of two terms that decrease to one half at their velocity s_h:
!>
!>     linear       c max(0, 1 - s/(2 s_h))
!>     rational     c1/(1 + s/s_h1) + c2/(1 + (s/s_h2)**2)
!>     exponential  c 2**(-s/s_h)
!>
!> See Vollebregt and Schuttelaars (2012) for their effect on contact problems.
module contact_friction_slip_laws
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver, friction_law, friction_set, title_length
   implicit none (type, external)
   private

   public :: exponential_law, linear_law, rational_law

   !> Laws that depend on slip velocity, with terms that each have a velocity
   type, abstract, extends(friction_law) :: slip_law
   contains
      procedure, nopass :: driver => slip_speed
      procedure, nopass :: fault => fault_of_speeds
   end type slip_law

   type, extends(slip_law) :: linear_law
   contains
      procedure :: coefficient => linear_coefficient
      procedure, nopass :: title => linear_title
   end type linear_law

   type, extends(slip_law) :: rational_law
   contains
      procedure :: coefficient => rational_coefficient
      procedure, nopass :: title => rational_title
   end type rational_law

   type, extends(slip_law) :: exponential_law
   contains
      procedure :: coefficient => exponential_coefficient
      procedure, nopass :: title => exponential_title
   end type exponential_law

contains

   pure integer function slip_speed() result(driver)
      driver = friction_driver%slip_speed
   end function slip_speed

   !> The velocities of the terms must be positive
   pure function fault_of_speeds(set) result(text)
      type(friction_set), intent(in) :: set
      character(len=100) :: text

      text = ""
      if (.not. min(set%sabsh1, set%sabsh2) > 0.0_wp) text = "the velocities at which friction has fallen by half must be positive"
   end function fault_of_speeds

   pure subroutine linear_coefficient(self, cause, mu)
      class(linear_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(friction_set) :: set
      integer :: iy

      do iy = 1, size(mu, 2)
         set = self%set_of_row(iy)
         mu(:, iy) = set%fkin + set%coef1*max(0.0_wp, 1.0_wp - 0.5_wp*cause(:, iy)/set%sabsh1) &
            & + set%coef2*max(0.0_wp, 1.0_wp - 0.5_wp*cause(:, iy)/set%sabsh2)
      end do
   end subroutine linear_coefficient

   pure function linear_title() result(title)
      character(len=title_length) :: title
      title = "friction falling linearly with slip"
   end function linear_title

   pure subroutine rational_coefficient(self, cause, mu)
      class(rational_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(friction_set) :: set
      integer :: iy

      do iy = 1, size(mu, 2)
         set = self%set_of_row(iy)
         mu(:, iy) = set%fkin + set%coef1/(1.0_wp + cause(:, iy)/set%sabsh1) &
            & + set%coef2/(1.0_wp + (cause(:, iy)/set%sabsh2)**2)
      end do
   end subroutine rational_coefficient

   pure function rational_title() result(title)
      character(len=title_length) :: title
      title = "friction falling rationally with slip"
   end function rational_title

   pure subroutine exponential_coefficient(self, cause, mu)
      class(exponential_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(friction_set) :: set
      integer :: iy

      do iy = 1, size(mu, 2)
         set = self%set_of_row(iy)
         mu(:, iy) = set%fkin + set%coef1*2.0_wp**(-cause(:, iy)/set%sabsh1) &
            & + set%coef2*2.0_wp**(-cause(:, iy)/set%sabsh2)
      end do
   end subroutine exponential_coefficient

   pure function exponential_title() result(title)
      character(len=title_length) :: title
      title = "friction falling exponentially with slip"
   end function exponential_title
end module contact_friction_slip_laws
