!> Friction that falls with the slip velocity: piecewise linear, rational, exponential
!>
!> mu(s) = mu_kinetic + the sum of two terms that have fallen to one half at their velocity s_h:
!>
!>     linear       c max(0, 1 - s/(2 s_h))
!>     rational     c1/(1 + s/s_h1) + c2/(1 + (s/s_h2)**2)
!>     exponential  c 2**(-s/s_h)
!>
!> See Vollebregt and Schuttelaars (2012) for what they do to contact problems.
module contact_friction_slip_laws
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_law
   implicit none (type, external)
   private

   public :: exponential_law, linear_law, rational_law

   type, extends(friction_law) :: linear_law
   contains
      procedure :: coefficient => linear_coefficient
   end type linear_law

   type, extends(friction_law) :: rational_law
   contains
      procedure :: coefficient => rational_coefficient
   end type rational_law

   type, extends(friction_law) :: exponential_law
   contains
      procedure :: coefficient => exponential_coefficient
   end type exponential_law

contains

   pure subroutine linear_coefficient(self, cause, mu)
      class(linear_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      integer :: iy

      do iy = 1, size(mu, 2)
         associate (set => self%sets(self%set_of_row(iy)))
            mu(:, iy) = set%kinetic + set%term(1)*max(0.0_wp, 1.0_wp - 0.5_wp*cause(:, iy)/set%half_speed(1)) &
               & + set%term(2)*max(0.0_wp, 1.0_wp - 0.5_wp*cause(:, iy)/set%half_speed(2))
         end associate
      end do
   end subroutine linear_coefficient

   pure subroutine rational_coefficient(self, cause, mu)
      class(rational_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      integer :: iy

      do iy = 1, size(mu, 2)
         associate (set => self%sets(self%set_of_row(iy)))
            mu(:, iy) = set%kinetic + set%term(1)/(1.0_wp + cause(:, iy)/set%half_speed(1)) &
               & + set%term(2)/(1.0_wp + (cause(:, iy)/set%half_speed(2))**2)
         end associate
      end do
   end subroutine rational_coefficient

   pure subroutine exponential_coefficient(self, cause, mu)
      class(exponential_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      integer :: iy

      do iy = 1, size(mu, 2)
         associate (set => self%sets(self%set_of_row(iy)))
            mu(:, iy) = set%kinetic + set%term(1)*2.0_wp**(-cause(:, iy)/set%half_speed(1)) &
               & + set%term(2)*2.0_wp**(-cause(:, iy)/set%half_speed(2))
         end associate
      end do
   end subroutine exponential_coefficient
end module contact_friction_slip_laws
