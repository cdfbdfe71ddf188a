!> Mean stress, equivalent stresses and principal stresses
!>
!> Principal stresses are found by Jacobi rotations. They keep full accuracy relative to the largest stress, where the closed form
!> with a cosine loses half of the digits (nearly equal principal stresses). The loops in C process four points at once.
module contact_subsurface_invariants
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: stress_invariants, principal_stresses

   interface
      !> In invariant_loops.c
      pure subroutine find_invariants(n, stress, mean, mises, tresca, first, second, third) &
         & bind(c, name="contact_stress_invariants")
         import :: c_double, c_int
         implicit none (type, external)
         !> Number of points
         integer(c_int), value :: n
         real(c_double), intent(in) :: stress(6, n)
         !> Mean stress, von Mises, Tresca, principal stresses in descending order
         real(c_double), intent(out) :: mean(n), mises(n), tresca(n), first(n), second(n), third(n)
      end subroutine find_invariants
   end interface

contains

   !> Mean stress, equivalent stresses and principal stresses
   pure subroutine stress_invariants(stress, sighyd, sigvm, sigtr, sigma1, sigma2, sigma3)
      !> Stresses [N/mm2]: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), contiguous, intent(in) :: stress(:, :)
      !> Mean stress, von Mises, Tresca, principal stresses in descending order [N/mm2], shape (n)
      real(wp), contiguous, intent(out) :: sighyd(:), sigvm(:), sigtr(:), sigma1(:), sigma2(:), sigma3(:)

      call find_invariants(size(stress, 2), stress, sighyd, sigvm, sigtr, sigma1, sigma2, sigma3)
   end subroutine stress_invariants

   !> Principal stresses in descending order
   pure function principal_stresses(stress) result(principal)
      !> Stresses [N/mm2]: xx, xy, xz, yy, yz, zz
      real(wp), intent(in) :: stress(6)
      !> Principal stresses [N/mm2]
      real(wp) :: principal(3)
      real(wp) :: mean(1), mises(1), tresca(1), first(1), second(1), third(1)

      call find_invariants(1, stress, mean, mises, tresca, first, second, third)
      principal = [first, second, third]
   end function principal_stresses
end module contact_subsurface_invariants
