!> Roots of polynomials of low degree on an interval
module contact_numeric_polynomial
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: quadratic_roots, monotone_cubic_root

   !> If the divisor is smaller than this fraction the quotient might overflow: the root is outside any interval
   real(wp), parameter :: overflows = 1.0e-200_wp

contains

   !> Real roots of c + b x + a x**2 strictly within an interval, in increasing order
   pure subroutine quadratic_roots(a, b, c, low, high, roots, n)
      !> Coefficients of x**2, x and 1; any of them may be zero
      real(wp), intent(in) :: a, b, c
      !> Ends of the interval
      real(wp), intent(in) :: low, high
      !> The first n are set
      real(wp), intent(out) :: roots(2)
      !> Number of roots found, 0 to 2; a double root counts once
      integer, intent(out) :: n
      real(wp) :: discriminant, q, candidates(2)
      integer :: k

      roots = 0.0_wp
      n = 0
      discriminant = b**2 - 4.0_wp*a*c
      if (discriminant < 0.0_wp) return
      ! without cancellation: the larger root first, the other from the product of both
      q = -0.5_wp*(b + sign(sqrt(discriminant), b))
      candidates = high
      if (abs(a) > overflows*abs(q)) candidates(1) = q/a
      if (q /= 0.0_wp) candidates(2) = c/q
      if (candidates(1) > candidates(2)) candidates = candidates([2, 1])
      do k = 1, 2
         if (candidates(k) <= low .or. candidates(k) >= high) cycle
         if (n == 1) then
            if (candidates(k) == roots(1)) cycle
         end if
         n = n + 1
         roots(n) = candidates(k)
      end do
   end subroutine quadratic_roots

   !> Argument at which a cubic that is monotonic on [low, high] has a given value, by Newton's method within a bracket
   !>
   !> A step that leaves the bracket, or does not halve the previous one, is replaced by bisection. If the value is outside the
   !> range of the cubic, the nearer end is returned.
   pure real(wp) function monotone_cubic_root(c, low, high, value) result(x)
      !> Coefficients of the powers 0 to 3
      real(wp), intent(in) :: c(0:3)
      !> Ends of the interval, and the given value
      real(wp), intent(in) :: low, high, value
      real(wp) :: a, b, residual, slope, step, direction, from_low, from_high, bend, precision
      logical :: newton
      integer :: k
      !> Bisection alone halves the bracket 60 times; Newton's method needs about five steps
      integer, parameter :: max_steps = 60

      a = low
      b = high
      from_low = value - cubic(c, low)
      from_high = value - cubic(c, high)
      direction = sign(1.0_wp, from_low - from_high)
      if (direction*from_low <= 0.0_wp) then
         x = low
         return
      else if (direction*from_high >= 0.0_wp) then
         x = high
         return
      end if
      x = low + (high - low)*from_low/(from_low - from_high)
      precision = 4.0_wp*epsilon(1.0_wp)*max(abs(low), abs(high))
      bend = abs(c(2)) + 3.0_wp*abs(c(3))*max(abs(low), abs(high))
      do k = 1, max_steps
         residual = direction*(cubic(c, x) - value)
         if (residual == 0.0_wp) return
         if (residual > 0.0_wp) then
            b = x
         else
            a = x
         end if
         slope = direction*(c(1) + x*(2.0_wp*c(2) + 3.0_wp*x*c(3)))
         step = 0.5_wp*(a + b) - x
         newton = .false.
         if (abs(residual) < slope*(b - a)) then
            newton = x - residual/slope > a .and. x - residual/slope < b
            if (newton) step = -residual/slope
         end if
         x = x + step
         if (abs(step) <= precision) return
         ! the remaining error after a Newton step is at most bend/slope times its square; doubled for the change of the slope
         ! itself
         if (newton .and. 2.0_wp*bend*step**2 <= precision*slope) return
      end do
   end function monotone_cubic_root

   pure real(wp) function cubic(c, x)
      real(wp), intent(in) :: c(0:3), x

      cubic = c(0) + x*(c(1) + x*(c(2) + x*c(3)))
   end function cubic
end module contact_numeric_polynomial
