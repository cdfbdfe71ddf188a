!> Cubic B-splines: basis, interpolation at given sites, smoothing with a penalty on the third derivative
module contact_numeric_b_spline
   use contact_base_kinds, only : wp
   use contact_numeric_banded, only : solve_band, solve_positive_band
   use contact_numeric_spline, only : cubic_spline, piece_of
   implicit none (type, external)
   private

   public :: basis_values, knot_interval, interpolation_knots, interpolate_sites, not_a_knot_splines
   public :: smooth_b_splines, pieces_from_b_spline

   !> Weight of the conditions that keep sections straight, relative to the largest sum of squares: large enough to keep them
   !> straight, small enough to solve the system; chosen
   real(wp), parameter :: straightness = 1.0e6_wp

contains

   !> The interval j with t(j) <= s < t(j+1), among those with four basis functions
   pure integer function knot_interval(t, s) result(j)
      !> Knots, not decreasing; at least eight
      real(wp), intent(in) :: t(:)
      !> Argument of the spline, in the unit of the knots
      real(wp), intent(in) :: s

      j = piece_of(t(4:size(t) - 3), s) + 3
      ! at the far end and in multiple knots: move back to a non-empty interval
      do while (t(j + 1) <= t(j) .and. j > 4)
         j = j - 1
      end do
   end function knot_interval

   !> The four basis functions j-3...j that are non-zero in interval j, and two derivatives
   !>
   !> Recurrence of de Boor and Cox. If s is outside the interval, its polynomials are extended.
   pure subroutine basis_values(t, j, s, b, slope, bend)
      !> Knots, not decreasing, in any unit
      real(wp), intent(in) :: t(:)
      !> Interval from `knot_interval`
      integer, intent(in) :: j
      !> Argument of the spline, in the unit of the knots
      real(wp), intent(in) :: s
      !> Values of the four basis functions [-], lowest knots first
      real(wp), intent(out) :: b(4)
      !> First and second derivatives
      real(wp), intent(out), optional :: slope(4), bend(4)
      real(wp) :: lower(4), saved, term
      integer :: degree, k

      b = 0.0_wp
      b(1) = 1.0_wp
      do degree = 1, 3
         lower = b
         saved = 0.0_wp
         do k = 1, degree
            term = lower(k)/(t(j + k) - t(j + k - degree))
            b(k) = saved + (t(j + k) - s)*term
            saved = (s - t(j + k - degree))*term
         end do
         b(degree + 1) = saved
         if (degree == 1 .and. present(bend)) bend = differences(t, j, 3, differences(t, j, 2, b))
         if (degree == 2 .and. present(slope)) slope = differences(t, j, 3, b)
      end do
   end subroutine basis_values

   !> Derivatives of the basis functions of a degree, from functions of the next lower degree, padded with zeros
   pure function differences(t, j, degree, lower) result(slope)
      real(wp), intent(in) :: t(:)
      integer, intent(in) :: j, degree
      !> `degree` values of the lower functions, or their derivatives
      real(wp), intent(in) :: lower(4)
      real(wp) :: slope(4), term
      integer :: k

      slope = 0.0_wp
      do k = 1, degree
         term = real(degree, wp)*lower(k)/(t(j + k) - t(j + k - degree))
         slope(k) = slope(k) - term
         slope(k + 1) = slope(k + 1) + term
      end do
   end function differences

   !> Knots for interpolation at sites: the second and the last but one are omitted ("not a knot"), and the end knots are
   !> repeated beyond each end at the last spacing
   pure function interpolation_knots(sites) result(t)
      !> Strictly increasing, at least four
      real(wp), intent(in) :: sites(:)
      real(wp) :: t(size(sites) + 4)
      integer :: n, k

      n = size(sites)
      t(4) = sites(1)
      t(5:n) = sites(3:n - 2)
      t(n + 1) = sites(n)
      do k = 1, 3
         t(4 - k) = sites(1) - k*(sites(2) - sites(1))
         t(n + 1 + k) = sites(n) + k*(sites(n) - sites(n - 1))
      end do
   end function interpolation_knots

   !> Coefficients of the spline on given knots through given values at the sites
   subroutine interpolate_sites(t, sites, values, solved)
      !> Knots, four more than sites
      real(wp), intent(in) :: t(:)
      !> Abscissae of the values, increasing, one in the support of each basis function
      real(wp), intent(in) :: sites(:)
      !> On entry the values (site, function), on exit the coefficients
      real(wp), intent(inout) :: values(:, :)
      !> False if sites and knots do not match
      logical, intent(out) :: solved
      real(wp), allocatable :: band(:, :)
      real(wp) :: b(4)
      integer, parameter :: width = 3
      integer :: n, i, j, k

      n = size(sites)
      allocate(band(3*width + 1, n))
      band = 0.0_wp
      do i = 1, n
         j = knot_interval(t, sites(i))
         call basis_values(t, j, sites(i), b)
         do k = 1, 4
            ! row i, column j - 4 + k; vanishing values may lie outside the band
            if (abs(i - (j - 4 + k)) <= width) band(2*width + 1 + i - (j - 4 + k), j - 4 + k) = b(k)
         end do
      end do
      call solve_band(band, width, values, solved)
   end subroutine interpolate_sites

   !> Interpolating splines without end conditions, one per function; sections of three points are parabolas, sections of two
   !> points straight lines
   subroutine not_a_knot_splines(s, f, splines, solved, is_kink)
      !> Abscissae of the points [mm], strictly increasing, at least two
      real(wp), intent(in) :: s(:)
      !> Values (point, function)
      real(wp), intent(in) :: f(:, :)
      !> One per function, all on the same pieces
      type(cubic_spline), allocatable, intent(out) :: splines(:)
      !> False if the system is singular
      logical, intent(out) :: solved
      !> Points where the slope may jump
      logical, intent(in), optional :: is_kink(:)
      type(cubic_spline) :: section
      real(wp), allocatable :: t(:), coefficients(:, :)
      integer :: first, last, n, m, k

      n = size(s)
      allocate(splines(size(f, 2)))
      do k = 1, size(splines)
         splines(k)%s = s
         allocate(splines(k)%c(0:3, n - 1))
      end do
      first = 1
      do last = 2, n
         if (last < n) then
            if (.not. present(is_kink)) cycle
            if (.not. is_kink(last)) cycle
         end if
         m = last - first + 1
         if (m < 4) then
            do k = 1, size(splines)
               call few_points(s(first:last), f(first:last, k), splines(k)%c(:, first:last - 1))
            end do
         else
            t = interpolation_knots(s(first:last))
            coefficients = f(first:last, :)
            call interpolate_sites(t, s(first:last), coefficients, solved)
            if (.not. solved) return
            do k = 1, size(splines)
               call pieces_from_b_spline(t, coefficients(:, k), s(first:last), section)
               splines(k)%c(:, first:last - 1) = section%c
            end do
         end if
         first = last
      end do
      solved = .true.
   end subroutine not_a_knot_splines

   !> The polynomial through two or three points, as pieces
   pure subroutine few_points(s, f, c)
      real(wp), intent(in) :: s(:), f(:)
      real(wp), intent(out) :: c(0:, :)
      real(wp) :: first, second, curve
      integer :: j

      first = (f(2) - f(1))/(s(2) - s(1))
      curve = 0.0_wp
      if (size(s) == 3) then
         second = (f(3) - f(2))/(s(3) - s(2))
         curve = (second - first)/(s(3) - s(1))
      end if
      c = 0.0_wp
      do j = 1, size(s) - 1
         c(0, j) = f(j)
         c(1, j) = first + curve*(2.0_wp*s(j) - s(1) - s(2))
         c(2, j) = curve
      end do
   end subroutine few_points

   !> Convert a B-spline to polynomial pieces between given ends, none of which may straddle a knot
   pure subroutine pieces_from_b_spline(t, coefficients, breaks, spline)
      !> Knots, not decreasing
      real(wp), intent(in) :: t(:)
      !> Coefficients of the basis functions, four fewer than knots
      real(wp), intent(in) :: coefficients(:)
      !> Ends of the pieces, increasing; include every knot between the first and the last
      real(wp), intent(in) :: breaks(:)
      !> The same function as polynomial pieces
      type(cubic_spline), intent(out) :: spline
      real(wp) :: b(4), slope(4), h, start(2), finish(2), chord
      integer :: i, j

      allocate(spline%s(size(breaks)), spline%c(0:3, size(breaks) - 1))
      spline%s(:) = breaks
      do i = 1, size(breaks) - 1
         h = breaks(i + 1) - breaks(i)
         j = knot_interval(t, breaks(i) + 0.5_wp*h)
         call basis_values(t, j, breaks(i), b, slope)
         start = [dot_product(b, coefficients(j - 3:j)), dot_product(slope, coefficients(j - 3:j))]
         call basis_values(t, j, breaks(i + 1), b, slope)
         finish = [dot_product(b, coefficients(j - 3:j)), dot_product(slope, coefficients(j - 3:j))]
         chord = (finish(1) - start(1))/h
         spline%c(:, i) = [start(1), start(2), (3.0_wp*chord - 2.0_wp*start(2) - finish(2))/h, &
            & (start(2) + finish(2) - 2.0_wp*chord)/h**2]
      end do
   end subroutine pieces_from_b_spline

   !> Smoothing B-splines of several functions on the same points
   !>
   !> Each minimises sum(w (f(s_i) - f_i)**2) + lambda integral(f'''**2). Knots are evenly spaced in each section between kinks,
   !> threefold at kinks (continuous, free slope) and fourfold at the ends. The third derivative is constant between knots. A
   !> section of one interval is kept straight.
   subroutine smooth_b_splines(s, f, weights, lambda, spacing, splines, solved, is_kink)
      !> Abscissae of the points [mm], strictly increasing, at least two
      real(wp), intent(in) :: s(:)
      !> Values (point, function)
      real(wp), intent(in) :: f(:, :)
      !> Weights of the points, positive
      real(wp), intent(in) :: weights(:)
      !> Weight of the third derivative, positive
      real(wp), intent(in) :: lambda
      !> Maximum distance between knots [mm], positive
      real(wp), intent(in) :: spacing
      !> One per function, all on the same pieces
      type(cubic_spline), allocatable, intent(out) :: splines(:)
      !> False if the matrix is not numerically positive definite
      logical, intent(out) :: solved
      !> Points where the slope may jump
      logical, intent(in), optional :: is_kink(:)
      real(wp), allocatable :: t(:), breaks(:), band(:, :), c(:, :)
      logical, allocatable :: is_straight(:)
      real(wp) :: row(4), stiffness
      integer :: n, i, j, k

      call section_knots(s, spacing, breaks, t, is_straight, is_kink)
      n = size(t) - 4
      allocate(band(4, n), c(n, size(f, 2)))
      band = 0.0_wp
      c = 0.0_wp
      do i = 1, size(s)
         j = knot_interval(t, s(i))
         call basis_values(t, j, s(i), row)
         call add_square(band, j, row, weights(i))
         do k = 1, 4
            c(j - 4 + k, :) = c(j - 4 + k, :) + weights(i)*row(k)*f(i, :)
         end do
      end do
      stiffness = straightness*maxval(band(4, :))
      k = 0
      do j = 4, n
         if (t(j + 1) <= t(j)) cycle
         k = k + 1
         if (is_straight(k)) then
            call add_square(band, j, [-2.0_wp, 3.0_wp, 0.0_wp, -1.0_wp]/3.0_wp, stiffness)
            call add_square(band, j, [-1.0_wp, 0.0_wp, 3.0_wp, -2.0_wp]/3.0_wp, stiffness)
         else
            call add_square(band, j, third_derivative(t, j), lambda*(t(j + 1) - t(j)))
         end if
      end do
      call solve_positive_band(band, c, solved)
      if (.not. solved) return
      allocate(splines(size(f, 2)))
      do k = 1, size(splines)
         call pieces_from_b_spline(t, c(:, k), breaks, splines(k))
      end do
   end subroutine smooth_b_splines

   !> Knots of all sections
   pure subroutine section_knots(s, spacing, breaks, t, is_straight, is_kink)
      real(wp), intent(in) :: s(:), spacing
      !> Distinct knots, and all of them with their multiplicity
      real(wp), allocatable, intent(out) :: breaks(:), t(:)
      !> Is the interval a section by itself?
      logical, allocatable, intent(out) :: is_straight(:)
      logical, intent(in), optional :: is_kink(:)
      real(wp) :: length
      integer :: first, last, n, k, times

      breaks = [s(1)]
      t = [s(1), s(1), s(1), s(1)]
      allocate(is_straight(0))
      first = 1
      do last = 2, size(s)
         if (last < size(s)) then
            if (.not. present(is_kink)) cycle
            if (.not. is_kink(last)) cycle
         end if
         length = s(last) - s(first)
         n = max(1, min(ceiling(length/spacing), last - first))
         do k = 1, n - 1
            breaks = [breaks, s(first) + length*k/n]
            t = [t, s(first) + length*k/n]
         end do
         breaks = [breaks, s(last)]
         times = merge(4, 3, last == size(s))
         t = [t, spread(s(last), 1, times)]
         is_straight = [is_straight, spread(n == 1, 1, n)]
         first = last
      end do
   end subroutine section_knots

   !> Constant third derivative in interval j, as a linear combination of four coefficients
   pure function third_derivative(t, j) result(row)
      real(wp), intent(in) :: t(:)
      integer, intent(in) :: j
      real(wp) :: row(4)

      row = differences(t, j, 3, differences(t, j, 2, differences(t, j, 1, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])))
   end function third_derivative

   !> Add weight times the square of a linear form of coefficients j-3...j to the upper band
   pure subroutine add_square(band, j, row, weight)
      real(wp), intent(inout) :: band(:, :)
      integer, intent(in) :: j
      real(wp), intent(in) :: row(4), weight
      integer :: k, l

      do l = 1, 4
         do k = 1, l
            band(4 + k - l, j - 4 + l) = band(4 + k - l, j - 4 + l) + weight*row(k)*row(l)
         end do
      end do
   end subroutine add_square
end module contact_numeric_b_spline
