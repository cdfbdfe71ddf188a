!> An axis of a table: cubic B-splines on knots that need not be equidistant, stored as polynomials
module contact_tables_axis
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_kinds, only : wp
   use contact_numeric_b_spline, only : basis_values
   implicit none (type, external)
   private

   public :: spline_axis, make_axis, find_basis

   !> Number of basis functions that are non-zero in an interval
   integer, parameter, public :: order = 4
   !> Buckets per interval, used to find the interval of an argument; chosen so that one or two steps remain
   integer, parameter :: buckets_per_interval = 4
   !> Least width of an interval, and inverse of the largest knot; those of a table are about 1
   real(wp), parameter :: shortest = 1.0e-9_wp

   !> An axis. If it has a single coefficient, nothing varies along it
   type :: spline_axis
      !> Number of coefficients along the axis
      integer :: count = 1
      !> Range of the argument
      real(wp) :: low = 0.0_wp, high = 0.0_wp
      !> Buckets per unit of the argument, and the interval in which each bucket starts
      real(wp), private :: buckets_per_unit = 0.0_wp
      integer, allocatable, private :: bucket(:)
      !> Starts of the intervals; the last value is the end of the last interval
      real(wp), allocatable, private :: start(:)
      !> Basis functions of each interval, by powers of the distance from its start, shape (functions, powers, intervals)
      real(wp), allocatable, private :: powers(:, :, :)
   end type spline_axis

contains

   !> Create an axis; `is_good` is false if the knots are not finite and increasing, or differ in magnitude from those of a table
   subroutine make_axis(axis, count, knots, is_good)
      !> Receives range, intervals and polynomials
      type(spline_axis), intent(inout) :: axis
      !> Number of coefficients along the axis: 1, or at least 4
      integer, intent(in) :: count
      !> Knots, 4 more than coefficients; unused for a single coefficient
      real(wp), intent(in) :: knots(:)
      !> Is the axis valid?
      logical, intent(out) :: is_good
      real(wp), dimension(order) :: bend, bend_at_end, value, slope
      real(wp) :: width
      integer :: intervals, j, k

      axis%count = count
      is_good = count == 1
      if (is_good .or. count < order .or. size(knots) /= count + order) return
      intervals = count - order + 1
      axis%start = knots(order:count + 1)
      is_good = all(ieee_is_finite(knots))
      if (is_good) is_good = all(abs(knots) <= 1.0_wp/shortest)
      if (.not. is_good) return
      is_good = all(knots(2:) >= knots(:size(knots) - 1)) .and. all(axis%start(2:) - axis%start(:intervals) >= shortest)
      if (.not. is_good) return
      axis%low = axis%start(1)
      axis%high = axis%start(intervals + 1)
      allocate(axis%powers(order, order, intervals))
      do j = 1, intervals
         width = axis%start(j + 1) - axis%start(j)
         call basis_values(knots, j + order - 1, axis%start(j + 1), value, slope, bend_at_end)
         call basis_values(knots, j + order - 1, axis%start(j), value, slope, bend)
         axis%powers(:, 1, j) = value
         axis%powers(:, 2, j) = slope
         axis%powers(:, 3, j) = 0.5_wp*bend
         axis%powers(:, 4, j) = (bend_at_end - bend)/(6.0_wp*width)
      end do
      allocate(axis%bucket(buckets_per_interval*intervals))
      axis%buckets_per_unit = size(axis%bucket)/(axis%high - axis%low)
      j = 1
      do k = 1, size(axis%bucket)
         do while (axis%start(j + 1) <= axis%low + (k - 1)/axis%buckets_per_unit .and. j < intervals)
            j = j + 1
         end do
         axis%bucket(k) = j
      end do
   end subroutine make_axis

   !> Basis functions and their slopes at an argument; for an axis with a single coefficient only the first is non-zero
   pure subroutine find_basis(axis, place, first, value, slope)
      !> From make_axis
      type(spline_axis), intent(in) :: axis
      !> Argument; limited to the range of the axis
      real(wp), intent(in) :: place
      !> Coefficient of the first function
      integer, intent(out) :: first
      !> Functions and their slopes
      real(wp), intent(out) :: value(order), slope(order)
      real(wp) :: at, d
      integer :: k

      if (axis%count == 1) then
         first = 1
         value = 0.0_wp
         value(1) = 1.0_wp
         slope = 0.0_wp
         return
      end if
      at = min(max(place, axis%low), axis%high)
      k = min(int((at - axis%low)*axis%buckets_per_unit) + 1, size(axis%bucket))
      first = axis%bucket(k)
      do while (at >= axis%start(first + 1) .and. first < size(axis%start) - 1)
         first = first + 1
      end do
      ! correction for round-off in the index of a bucket
      if (at < axis%start(first) .and. first > 1) first = first - 1
      d = at - axis%start(first)
      associate (p => axis%powers(:, :, first))
         value = p(:, 1) + d*(p(:, 2) + d*(p(:, 3) + d*p(:, 4)))
         slope = p(:, 2) + d*(2.0_wp*p(:, 3) + 3.0_wp*d*p(:, 4))
      end associate
   end subroutine find_basis
end module contact_tables_axis
