!> Splines and roots: exact reproduction, orders of convergence, smoothing as a filter
program test_spline
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_numeric_b_spline, only : basis_values, knot_interval, not_a_knot_splines, smooth_b_splines
   use contact_numeric_polynomial, only : monotone_cubic_root, quadratic_roots
   use contact_numeric_spline, only : cubic_spline, local_splines, natural_splines, piece_of, smoothing_splines
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Roundings in systems of some hundred equations
   real(wp), parameter :: solved_well = 1.0e-11_wp
   type(test_suite) :: suite

   call suite%start("spline")
   call pieces(suite)
   call exact(suite)
   call convergence(suite)
   call filters(suite)
   call kinks(suite)
   call mirrored(suite)
   call local(suite)
   call small(suite)
   call basis(suite)
   call roots(suite)
   call suite%finish()

contains

   !> Uneven points, with spacings between 0.2 and 1 times `step`
   pure function uneven(n, step) result(s)
      integer, intent(in) :: n
      real(wp), intent(in) :: step
      real(wp) :: s(n)
      integer :: i

      s(1) = -3.0_wp
      do i = 2, n
         s(i) = s(i - 1) + step*(0.6_wp + 0.4_wp*sin(7.0_wp*i))
      end do
   end function uneven

   !> Smoothing is symmetric: the mirror image of a curve gets the mirror image of its spline, also at
   !> kinks and with uneven weights
   subroutine mirrored(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: n = 40
      real(wp) :: s(n), f(n, 1), weights(n)
      logical :: is_kink(n)
      type(cubic_spline), allocatable :: one(:), other(:)
      logical :: solved(2)
      real(wp) :: there, worst(2)
      integer :: i, kind

      s = uneven(n, 1.0_wp)
      f(:, 1) = [(sin(0.7_wp*s(i)) + 0.3_wp*abs(s(i) - s(15)) + 0.05_wp*(-1)**i, i=1, n)]
      weights = [(1.0_wp + 0.5_wp*cos(3.0_wp*i), i=1, n)]
      is_kink = .false.
      is_kink([15, 16, 27]) = .true.
      do kind = 1, 2
         worst(kind) = 0.0_wp
         if (kind == 1) then
            call smoothing_splines(s, f, weights, 0.3_wp, one, solved(1), is_kink)
            call smoothing_splines(-s(n:1:-1), f(n:1:-1, :), weights(n:1:-1), 0.3_wp, other, solved(2), is_kink(n:1:-1))
         else
            call natural_splines(s, f, one, is_kink)
            call natural_splines(-s(n:1:-1), f(n:1:-1, :), other, is_kink(n:1:-1))
            solved = .true.
         end if
         call suite%check(all(solved), "solved")
         do i = 1, 400
            there = s(1) + (s(n) - s(1))*(i - 0.5_wp)/400.0_wp
            worst(kind) = max(worst(kind), abs(one(1)%value(there) - other(1)%value(-there)))
         end do
      end do
      call suite%close_to(worst, [0.0_wp, 0.0_wp], 1.0e-10_wp, "mirror images of smoothed and of natural splines")
   end subroutine mirrored

   !> The piece is the last one that starts at or before an abscissa, for pieces of any length
   subroutine pieces(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), allocatable :: breaks(:)
      real(wp) :: s
      integer :: shape, n, k, missed

      missed = 0
      do shape = 1, 3
         do n = 2, 40
            breaks = [(real(k, wp), k=1, n)]
            if (shape == 2) breaks = breaks**5
            if (shape == 3) breaks = exp(-breaks(n:1:-1))
            do k = -3, 4*n + 3
               s = breaks(1) + (breaks(n) - breaks(1))*k/(4.0_wp*n)
               if (mod(k, 3) == 0) s = breaks(min(max(k/3, 1), n))
               if (piece_of(breaks, s) /= min(max(count(breaks <= s), 1), n - 1)) missed = missed + 1
            end do
         end do
      end do
      call suite%check(missed == 0, "pieces of even and uneven breaks, at breaks, between and beyond them")
   end subroutine pieces

   !> Each family preserves the polynomials with zero penalty
   subroutine exact(suite)
      type(test_suite), intent(inout) :: suite
      type(cubic_spline), allocatable :: f(:)
      real(wp) :: s(40), values(40, 2), between(39)
      logical :: ok

      s = uneven(40, 0.5_wp)
      between = 0.3_wp*s(:39) + 0.7_wp*s(2:)
      values(:, 1) = 1.5_wp - 2.0_wp*s
      values(:, 2) = s
      call smoothing_splines(s, values, 0.1_wp + 0.0_wp*s, 1.0e3_wp, f, ok)
      call suite%check(ok, "smoothing of a line")
      call suite%close_to(f(1)%value(between), 1.5_wp - 2.0_wp*between, solved_well, "a line stays, curvature penalty")
      call suite%close_to(f(2)%slope(between), 1.0_wp + 0.0_wp*between, solved_well, "the second function too")

      values(:, 1) = 1.0_wp + s - 0.5_wp*s**2
      call smooth_b_splines(s, values, 0.1_wp + 0.0_wp*s, 1.0e3_wp, 2.0_wp, f, ok)
      call suite%check(ok, "smoothing of a parabola")
      call suite%close_to(f(1)%value(between), 1.0_wp + between - 0.5_wp*between**2, 1.0e-9_wp, &
         & "a parabola stays, penalty on the third derivative")

      values(:, 1) = 1.0_wp + s - 0.5_wp*s**2 + 0.1_wp*s**3
      call not_a_knot_splines(s, values, f, ok)
      call suite%check(ok, "interpolation of a cubic")
      call suite%close_to(f(1)%value(between), 1.0_wp + between - 0.5_wp*between**2 + 0.1_wp*between**3, 1.0e-10_wp, &
         & "a cubic stays without conditions at the ends")
      call suite%close_to(f(1)%bend(between), -1.0_wp + 0.6_wp*between, 1.0e-9_wp, "and its second derivative")
      call suite%close_to(f(1)%nodes(), values(:, 1), solved_well, "values at the points")
   end subroutine exact

   !> Order 4 in values, 3 in slopes, 2 in second derivatives; natural ends away from the ends
   subroutine convergence(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: not_a_knot(3, 2), natural(3, 2), order(3)
      integer :: level

      do level = 1, 2
         call largest_errors(40*2**level, not_a_knot(:, level), natural(:, level))
      end do
      order = log(not_a_knot(:, 1)/not_a_knot(:, 2))/log(2.0_wp)
      call suite%close_to(order, [4.0_wp, 3.0_wp, 2.0_wp], 0.35_wp, "orders of the interpolating spline")
      order = log(natural(:, 1)/natural(:, 2))/log(2.0_wp)
      call suite%close_to(order, [4.0_wp, 3.0_wp, 2.0_wp], 0.35_wp, "orders of the natural spline inside")
   end subroutine convergence

   subroutine largest_errors(n, not_a_knot, natural)
      integer, intent(in) :: n
      !> Errors of value, slope and bend
      real(wp), intent(out) :: not_a_knot(3), natural(3)
      type(cubic_spline), allocatable :: f(:)
      real(wp) :: s(n), x(10*n)
      logical :: ok
      integer :: i

      s = [(10.0_wp*(i - 1)/(n - 1), i=1, n)]
      x = [(10.0_wp*(i - 0.5_wp)/size(x), i=1, size(x))]
      call not_a_knot_splines(s, reshape(sin(s), [n, 1]), f, ok)
      not_a_knot = [maxval(abs(f(1)%value(x) - sin(x))), maxval(abs(f(1)%slope(x) - cos(x))), &
         & maxval(abs(f(1)%bend(x) + sin(x)))]
      x = 3.0_wp + 0.4_wp*x
      call natural_splines(s, reshape(sin(s), [n, 1]), f)
      natural = [maxval(abs(f(1)%value(x) - sin(x))), maxval(abs(f(1)%slope(x) - cos(x))), &
         & maxval(abs(f(1)%bend(x) + sin(x)))]
   end subroutine largest_errors

   !> A wave is damped by 1/(1 + (L/L')**4) and 1/(1 + (L/L')**6)
   subroutine filters(suite)
      type(test_suite), intent(inout) :: suite
      type(cubic_spline), allocatable :: f(:)
      integer, parameter :: n = 2001
      real(wp) :: s(n), wave(n, 1), cutoff, length, x(5), ratio
      logical :: ok
      integer :: i, k

      s = [(0.1_wp*(i - 1), i=1, n)]
      cutoff = 4.0_wp
      do k = 1, 3
         length = cutoff*2.0_wp**(2 - k)
         ratio = cutoff/length
         wave(:, 1) = cos(2.0_wp*pi*(s - 100.0_wp)/length)
         x = 100.0_wp + length*[-2.0_wp, -1.0_wp, 0.0_wp, 1.0_wp, 2.0_wp]
         call smoothing_splines(s, wave, 0.1_wp + 0.0_wp*s, (cutoff/(2.0_wp*pi))**4, f, ok)
         call suite%close_to(f(1)%value(x), 1.0_wp/(1.0_wp + ratio**4) + 0.0_wp*x, 1.0e-3_wp, "filter of order 4")
         call smooth_b_splines(s, wave, 0.1_wp + 0.0_wp*s, (cutoff/(2.0_wp*pi))**6, 0.05_wp*cutoff, f, ok)
         call suite%close_to(f(1)%value(x), 1.0_wp/(1.0_wp + ratio**6) + 0.0_wp*x, 5.0e-3_wp, "filter of order 6")
      end do
   end subroutine filters

   !> A corner between two lines survives any smoothing when it is marked, and is rounded when it is not
   subroutine kinks(suite)
      type(test_suite), intent(inout) :: suite
      type(cubic_spline), allocatable :: f(:)
      real(wp) :: s(101), values(101, 1), x(4)
      logical :: is_kink(101), ok
      integer :: i

      s = [(0.2_wp*(i - 1) - 10.0_wp, i=1, 101)]
      values(:, 1) = abs(s)
      is_kink = .false.
      is_kink(51) = .true.
      x = [-9.3_wp, -0.1_wp, 0.05_wp, 7.7_wp]
      call smoothing_splines(s, values, 0.2_wp + 0.0_wp*s, 50.0_wp, f, ok, is_kink)
      call suite%close_to(f(1)%value(x), abs(x), 1.0e-9_wp, "corner kept, curvature penalty")
      call suite%close_to(f(1)%value(s(51) + [-1.0e-12_wp, 1.0e-12_wp]), [0.0_wp, 0.0_wp], 1.0e-9_wp, "it stays closed")
      call smooth_b_splines(s, values, 0.2_wp + 0.0_wp*s, 50.0_wp, 1.0_wp, f, ok, is_kink)
      call suite%close_to(f(1)%value(x), abs(x), 1.0e-8_wp, "corner kept, penalty on the third derivative")
      call not_a_knot_splines(s, values, f, ok, is_kink)
      call suite%close_to(f(1)%value(x), abs(x), 1.0e-12_wp, "corner kept, interpolation")
      call smoothing_splines(s, values, 0.2_wp + 0.0_wp*s, 50.0_wp, f, ok)
      call suite%check(f(1)%value(0.0_wp) > 0.5_wp, "a corner that is not marked is rounded")

      ! Neighbouring kinks: sections of one interval are straight
      is_kink(50:53) = .true.
      call smooth_b_splines(s, values, 0.2_wp + 0.0_wp*s, 50.0_wp, 1.0_wp, f, ok, is_kink)
      call suite%check(ok, "kinks in a row")
      call suite%close_to(f(1)%value(0.5_wp*(s(50:52) + s(51:53))), 0.5_wp*(values(50:52, 1) + values(51:53, 1)), &
         & 1.0e-5_wp, "short sections are straight")
   end subroutine kinks

   subroutine small(suite)
      type(test_suite), intent(inout) :: suite
      type(cubic_spline), allocatable :: f(:)
      logical :: ok
      integer :: n
      real(wp), parameter :: s(4) = [0.0_wp, 1.0_wp, 3.0_wp, 4.0_wp], v(4) = [1.0_wp, 2.0_wp, 2.0_wp, 0.0_wp]

      do n = 2, 4
         if (.not. allocated(f)) allocate(f(1))
         call natural_splines(s(:n), reshape(v(:n), [n, 1]), f)
         call suite%close_to(f(1)%value(s(:n)), v(:n), 1.0e-14_wp, "natural spline of few points")
         call not_a_knot_splines(s(:n), reshape(v(:n), [n, 1]), f, ok)
         call suite%close_to(f(1)%value(s(:n)), v(:n), 1.0e-13_wp, "interpolation of few points")
         call smooth_b_splines(s(:n), reshape(v(:n), [n, 1]), 1.0_wp + 0.0_wp*s(:n), 1.0e-6_wp, 0.5_wp, f, ok)
         call suite%check(ok, "smoothing of few points")
      end do
      call suite%close_to(f(1)%value([-5.0_wp, 9.0_wp]), f(1)%value([0.0_wp, 4.0_wp]), 0.0_wp, &
         & "constant beyond the ends")
   end subroutine small

   !> The sum is one; derivatives agree with differences, also in uneven and multiple knots
   subroutine basis(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: t(13) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.5_wp, 1.5_wp, 1.5_wp, 1.5_wp, 2.0_wp, 4.0_wp, &
         & 4.0_wp, 4.0_wp, 4.0_wp]
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: s, b(4), slope(4), bend(4), left(4), right(4)
      integer :: i, j

      do i = 1, 40
         s = 0.1_wp*i - 0.03_wp
         j = knot_interval(t, s)
         call suite%check(t(j) <= s .and. s < t(j + 1), "interval of an abscissa")
         call basis_values(t, j, s, b, slope, bend)
         call basis_values(t, j, s - step, left)
         call basis_values(t, j, s + step, right)
         call suite%close_to(sum(b), 1.0_wp, 1.0e-14_wp, "partition of unity")
         call suite%close_to(slope, (right - left)/(2.0_wp*step), 1.0e-7_wp, "first derivatives")
         call suite%close_to(bend, (right - 2.0_wp*b + left)/step**2, 1.0e-4_wp, "second derivatives")
      end do
      call suite%equal(knot_interval(t, 4.0_wp), 9, "interval of the far end")
      call suite%equal(knot_interval(t, 1.5_wp), 8, "interval after a multiple knot")
   end subroutine basis

   !> Local cubics: parabolas are reproduced, the order is 3, a corner reaches two pieces far, kinks part
   subroutine local(suite)
      type(test_suite), intent(inout) :: suite
      type(cubic_spline) :: f(2), broken(1)
      integer, parameter :: n = 31
      real(wp) :: s(n), x(300), errors(3)
      integer :: i, k

      s = uneven(n, 1.0_wp)
      x = [(s(1) + (s(n) - s(1))*(i - 0.5_wp)/size(x), i=1, size(x))]
      call local_splines(s, reshape([1.0_wp - 3.0_wp*s + 0.5_wp*s**2, abs(s - s(11))], [n, 2]), f)
      call suite%close_to(f(1)%value(x), 1.0_wp - 3.0_wp*x + 0.5_wp*x**2, 1.0e-12_wp, "local: parabola")
      call suite%close_to(f(1)%slope(x), x - 3.0_wp, 1.0e-12_wp, "local: its slope")
      do i = 1, size(x)
         if (x(i) > s(10) .and. x(i) < s(12)) cycle
         call suite%close_to(f(2)%value(x(i)), abs(x(i) - s(11)), 1.0e-12_wp, "local: straight one point away from a corner")
      end do
      call suite%check(abs(f(2)%slope(s(11))) < 0.9_wp, "local: the corner is round")
      call local_splines(s, reshape(abs(s - s(11)), [n, 1]), broken, [(i == 11, i=1, n)])
      call suite%close_to(broken(1)%value(x), abs(x - s(11)), 1.0e-12_wp, "local: a kink stays one")
      call local_splines(s(:2), reshape([2.0_wp, 3.0_wp], [2, 1]), broken)
      call suite%close_to(broken(1)%value(0.5_wp*(s(1) + s(2))), 2.5_wp, 1.0e-14_wp, "local: two points")
      do k = 1, 3
         associate (m => 20*2**(k - 1))
            call local_splines([(10.0_wp*i/m, i=0, m)], reshape([(sin(10.0_wp*i/m), i=0, m)], [m + 1, 1]), broken)
         end associate
         x = [(3.0_wp + 4.0_wp*(i - 0.5_wp)/size(x), i=1, size(x))]
         errors(k) = maxval(abs(broken(1)%value(x) - sin(x)))
      end do
      call suite%check(errors(1)/errors(2) > 7.5_wp .and. errors(2)/errors(3) > 7.5_wp, "local: order 3")
   end subroutine local

   subroutine roots(suite)
      type(test_suite), intent(inout) :: suite
      real(wp) :: x(2), c(0:3)
      integer :: n, i

      call quadratic_roots(1.0_wp, -3.0_wp, 2.0_wp, 0.0_wp, 5.0_wp, x, n)
      call suite%equal(n, 2, "two roots")
      call suite%close_to(x, [1.0_wp, 2.0_wp], 1.0e-15_wp, "their values")
      call quadratic_roots(1.0_wp, -3.0_wp, 2.0_wp, 1.0_wp, 5.0_wp, x, n)
      call suite%equal(n, 1, "a root at the end does not count")
      call quadratic_roots(1.0_wp, -2.0_wp, 1.0_wp, 0.0_wp, 5.0_wp, x, n)
      call suite%equal(n, 1, "a double root counts once")
      call quadratic_roots(1.0e-300_wp, 1.0_wp, -2.0_wp, 0.0_wp, 5.0_wp, x, n)
      call suite%equal(n, 1, "almost linear")
      call suite%close_to(x(1), 2.0_wp, 1.0e-15_wp, "its root")
      call quadratic_roots(1.0e-9_wp, 1.0e3_wp, -1.0_wp, 0.0_wp, 5.0_wp, x, n)
      call suite%close_to(x(1), 1.0e-3_wp, 1.0e-18_wp, "no cancellation")
      call quadratic_roots(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 5.0_wp, x, n)
      call suite%equal(n, 0, "no equation, no root")
      call quadratic_roots(1.0_wp, 0.0_wp, 1.0_wp, -5.0_wp, 5.0_wp, x, n)
      call suite%equal(n, 0, "no real root")

      c = [1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
      do i = -20, 20
         x(1) = 0.05_wp*i
         call suite%close_to(monotone_cubic_root(c, -1.0_wp, 1.0_wp, 1.0_wp + x(1)**3), x(1), 1.0e-5_wp, &
            & "cubic with a flat point")
         call suite%close_to(monotone_cubic_root([0.0_wp, -2.0_wp, 0.3_wp, 0.1_wp], -1.0_wp, 1.0_wp, &
            & x(1)*(-2.0_wp + x(1)*(0.3_wp + 0.1_wp*x(1)))), x(1), 1.0e-15_wp, "decreasing cubic")
      end do
      call suite%close_to(monotone_cubic_root(c, -1.0_wp, 1.0_wp, 7.0_wp), 1.0_wp, 0.0_wp, "beyond the end")
   end subroutine roots
end program test_spline
