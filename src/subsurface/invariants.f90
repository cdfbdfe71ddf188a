!> Mean stress, equivalent stresses and principal stresses
module contact_subsurface_invariants
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: stress_invariants, principal_stresses

contains

   !> Mean stress, equivalent stresses and principal stresses
   pure subroutine stress_invariants(stress, sighyd, sigvm, sigtr, sigma1, sigma2, sigma3)
      !> Stresses [N/mm2]: xx, xy, xz, yy, yz, zz, shape (6, n)
      real(wp), contiguous, intent(in) :: stress(:, :)
      !> Mean stress, von Mises, Tresca, principal stresses in descending order [N/mm2], shape (n)
      real(wp), contiguous, intent(out) :: sighyd(:), sigvm(:), sigtr(:), sigma1(:), sigma2(:), sigma3(:)
      real(wp) :: s(6), principal(3)
      integer :: point

      do point = 1, size(stress, 2)
         s = stress(:, point)
         sighyd(point) = (s(1) + s(4) + s(6))/3.0_wp
         ! from differences, which do not suffer from cancellation as the squares of the stresses do
         sigvm(point) = sqrt(0.5_wp*((s(1) - s(4))**2 + (s(4) - s(6))**2 + (s(6) - s(1))**2) &
            & + 3.0_wp*(s(2)**2 + s(3)**2 + s(5)**2))
         principal = principal_stresses(s)
         sigma1(point) = principal(1)
         sigma2(point) = principal(2)
         sigma3(point) = principal(3)
         sigtr(point) = principal(1) - principal(3)
      end do
   end subroutine stress_invariants

   !> Principal stresses in descending order, by Jacobi rotations
   !>
   !> Rotations keep full accuracy relative to the largest stress, where the closed form with a cosine loses half of the digits
   !> (nearly equal principal stresses). For 3 by 3 matrices they are three times faster than LAPACK's dsyev, which is designed
   !> for large ones.
   pure function principal_stresses(stress) result(principal)
      !> Stresses [N/mm2]: xx, xy, xz, yy, yz, zz
      real(wp), intent(in) :: stress(6)
      !> Principal stresses [N/mm2]
      real(wp) :: principal(3)
      integer, parameter :: max_sweeps = 20
      !> Entries whose squares might underflow; the matrix is scaled so that its largest entry is 1
      real(wp), parameter :: negligible = 1.0e-100_wp
      real(wp) :: a(3, 3), c, s, t, theta, scale, row
      integer :: p, q, r, sweep

      scale = maxval(abs(stress))
      principal = 0.0_wp
      if (.not. scale > 0.0_wp) return
      a(:, 1) = stress(1:3)/scale
      a(:, 2) = [stress(2), stress(4), stress(5)]/scale
      a(:, 3) = [stress(3), stress(5), stress(6)]/scale
      do sweep = 1, max_sweeps
         if (is_diagonal(a)) exit
         do p = 1, 2
            do q = p + 1, 3
               if (abs(a(p, q)) < negligible) cycle
               r = 6 - p - q
               theta = 0.5_wp*(a(q, q) - a(p, p))
               t = a(p, q)/(theta + sign(sqrt(theta**2 + a(p, q)**2), theta))
               c = 1.0_wp/sqrt(1.0_wp + t**2)
               s = t*c
               a(p, p) = a(p, p) - t*a(p, q)
               a(q, q) = a(q, q) + t*a(p, q)
               a(p, q) = 0.0_wp
               a(q, p) = 0.0_wp
               row = a(p, r)
               a(p, r) = c*row - s*a(q, r)
               a(q, r) = s*row + c*a(q, r)
               a(r, p) = a(p, r)
               a(r, q) = a(q, r)
            end do
         end do
      end do
      principal(1) = max(a(1, 1), a(2, 2), a(3, 3))
      principal(3) = min(a(1, 1), a(2, 2), a(3, 3))
      principal(2) = max(min(a(1, 1), a(2, 2)), min(max(a(1, 1), a(2, 2)), a(3, 3)))
      principal = scale*principal
   end function principal_stresses

   !> Are off-diagonal entries too small to change the eigenvalues?
   !>
   !> They change them by their squares divided by the differences of the eigenvalues, and at most by their own magnitude.
   pure logical function is_diagonal(a) result(diagonal)
      !> Symmetric; the largest entry is about 1
      real(wp), intent(in) :: a(3, 3)
      !> Fraction of the machine precision that is insignificant
      real(wp), parameter :: converged = 0.01_wp
      integer :: p, q

      diagonal = .true.
      do p = 1, 2
         do q = p + 1, 3
            diagonal = diagonal .and. min(abs(a(p, q)), a(p, q)**2/max(abs(a(p, p) - a(q, q)), tiny(1.0_wp))) &
               & < converged*epsilon(1.0_wp)
         end do
      end do
   end function is_diagonal
end module contact_subsurface_invariants
