!> Gauss-Legendre quadrature on the unit interval
module contact_numeric_quadrature
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: gauss_legendre

contains

   !> Abscissae and weights on (0, 1), by Newton's method on the Legendre polynomial
   pure subroutine gauss_legendre(x, w)
      !> Abscissae, increasing, and weights; any number of points, same size
      real(wp), intent(out) :: x(:), w(:)
      real(wp) :: z, step, p, p_before, p_new, slope
      integer :: n, i, k, iteration

      n = size(x)
      do i = 1, n
         z = -cos(pi*(i - 0.25_wp)/(n + 0.5_wp))
         slope = 1.0_wp
         do iteration = 1, 100
            p_before = 0.0_wp
            p = 1.0_wp
            do k = 1, n
               p_new = ((2*k - 1)*z*p - (k - 1)*p_before)/k
               p_before = p
               p = p_new
            end do
            slope = n*(z*p - p_before)/(z**2 - 1.0_wp)
            step = p/slope
            z = z - step
            if (abs(step) < 4.0_wp*epsilon(z)) exit
         end do
         x(i) = 0.5_wp*(1.0_wp + z)
         w(i) = 1.0_wp/((1.0_wp - z**2)*slope**2)
      end do
   end subroutine gauss_legendre
end module contact_numeric_quadrature
