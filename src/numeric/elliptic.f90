!> Complete elliptic integrals, as functions of the complementary modulus g
!>
!> In contact mechanics g is the ratio of the semi-axes of an ellipse. Slender ellipses need accuracy near g = 0; hence the
!> argument is g, not the modulus k with k**2 = 1 - g**2.
module contact_numeric_elliptic
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: elliptic_integrals, complete_elliptic

   !> The four integrals over phi = 0...pi/2, with delta = sqrt(1 - k**2 sin(phi)**2)
   type :: elliptic_integrals
      !> First kind: integral of 1/delta
      real(wp) :: k = 0.5_wp*pi
      !> Second kind: integral of delta
      real(wp) :: e = 0.5_wp*pi
      !> Associate B: integral of cos(phi)**2/delta, equal to (E - g**2 K)/k**2
      real(wp) :: b = 0.25_wp*pi
      !> Associate D: integral of sin(phi)**2/delta, equal to (K - E)/k**2
      real(wp) :: d = 0.25_wp*pi
   end type elliptic_integrals

contains

   !> All four integrals to full precision, for any g from the smallest number to 1 and above
   !>
   !> B and D are computed first, as sums of positive terms, so that K = B + D and E = B + g**2 D lose no digits at either end.
   !> K and D grow like log(4/g); g below the smallest normal number is replaced by that number, so that the values are finite.
   elemental function complete_elliptic(g) result(integrals)
      !> Complementary modulus [-], sign ignored
      real(wp), intent(in) :: g
      type(elliptic_integrals) :: integrals
      real(wp) :: gc

      gc = max(abs(g), tiny(1.0_wp))
      call bartky_sums(gc, integrals%b, integrals%d)
      integrals%k = integrals%b + integrals%d
      integrals%e = integrals%b + gc**2*integrals%d
   end function complete_elliptic

   !> Integrals of cos(phi)**2 and of sin(phi)**2 over sqrt(cos(phi)**2 + g**2 sin(phi)**2), phi = 0...pi/2.
   !>
   !> Arithmetic-geometric mean with the transformation of Bartky, after Bulirsch (1965), procedure cel2. Convergence is
   !> quadratic. Both integrals have the same sequence of means.
   elemental subroutine bartky_sums(g, of_cosine, of_sine)
      !> Complementary modulus [-], positive
      real(wp), intent(in) :: g
      !> The integrals
      real(wp), intent(out) :: of_cosine, of_sine
      real(wp), parameter :: close_enough = 1.0e-9_wp
      integer, parameter :: max_steps = 40
      real(wp) :: mean, previous_mean, kc, aa(2), bb(2), cc(2)
      integer :: step

      mean = 1.0_wp
      kc = g
      cc = [1.0_wp, 0.0_wp]
      aa = 1.0_wp
      bb = [0.0_wp, 1.0_wp]
      do step = 1, max_steps
         bb = 2.0_wp*(cc*kc + bb)
         cc = aa
         previous_mean = mean
         mean = mean + kc
         aa = aa + bb/mean
         if (abs(previous_mean - kc) <= close_enough*previous_mean) exit
         kc = 2.0_wp*sqrt(kc)*sqrt(previous_mean)
      end do
      of_cosine = 0.25_wp*pi*aa(1)/mean
      of_sine = 0.25_wp*pi*aa(2)/mean
   end subroutine bartky_sums
end module contact_numeric_elliptic
