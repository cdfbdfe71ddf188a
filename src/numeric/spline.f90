!> Cubic splines as polynomial pieces: interpolation and smoothing of one or several functions
!>
!> There is no packaged Fortran library of smoothing splines with weights and kinks, so the systems are set up here. See
!> doc/theory/profiles.md.
module contact_numeric_spline
   use contact_base_kinds, only : wp
   use contact_numeric_banded, only : solve_positive_band
   implicit none (type, external)
   private

   public :: cubic_spline, smoothing_splines, natural_splines, local_splines, piece_of

   !> A piecewise cubic function of s
   type :: cubic_spline
      !> Ends of the pieces [mm], strictly increasing
      real(wp), allocatable :: s(:)
      !> Coefficients (0:3, piece) of powers of s - s(piece)
      real(wp), allocatable :: c(:, :)
   contains
      !> Value, first and second derivative; beyond the ends constant as at the nearest end
      procedure :: value => spline_value
      procedure :: slope => spline_slope
      procedure :: bend => spline_bend
      !> Piece that contains an abscissa and position in it, and value and slope there: one search serves several splines on the
      !> same pieces
      procedure :: place => place_in_piece
      procedure :: in_piece
      !> Values at the ends of all pieces, and their smallest and largest value
      procedure :: nodes => spline_nodes
      procedure :: node_range
   end type cubic_spline

contains

   !> Index of the piece that contains s; the first and the last piece extend to infinity
   !>
   !> As points of profiles are nearly evenly spaced, the search starts at the piece expected for even spacing, doubles its
   !> steps until they enclose s, and bisects.
   pure integer function piece_of(breaks, s) result(piece)
      !> Ends of the pieces, increasing; at least two
      real(wp), intent(in) :: breaks(:)
      !> Abscissa, in the unit of the ends
      real(wp), intent(in) :: s
      integer :: high, middle, n, step

      n = size(breaks)
      piece = 1
      high = n
      if (n == 2) return
      middle = 1 + int(min(max((s - breaks(1))/(breaks(n) - breaks(1)), 0.0_wp), 1.0_wp)*(n - 1))
      middle = min(max(middle, 1), n - 1)
      step = 1
      if (s < breaks(middle)) then
         high = middle
         do while (high > 1)
            piece = max(1, high - step)
            if (.not. s < breaks(piece)) exit
            high = piece
            step = 2*step
         end do
      else
         piece = middle
         do while (piece < n - 1)
            high = min(n, piece + step)
            if (s < breaks(high)) exit
            piece = min(high, n - 1)
            step = 2*step
         end do
      end if
      do while (high - piece > 1)
         middle = (piece + high)/2
         if (s < breaks(middle)) then
            high = middle
         else
            piece = middle
         end if
      end do
   end function piece_of

   elemental real(wp) function spline_value(self, s) result(value)
      class(cubic_spline), intent(in) :: self
      !> Argument [mm]
      real(wp), intent(in) :: s
      real(wp) :: t
      integer :: j

      call place_in_piece(self, s, j, t)
      value = self%c(0, j) + t*(self%c(1, j) + t*(self%c(2, j) + t*self%c(3, j)))
   end function spline_value

   elemental real(wp) function spline_slope(self, s) result(slope)
      class(cubic_spline), intent(in) :: self
      !> Argument [mm]
      real(wp), intent(in) :: s
      real(wp) :: t
      integer :: j

      call place_in_piece(self, s, j, t)
      slope = self%c(1, j) + t*(2.0_wp*self%c(2, j) + t*3.0_wp*self%c(3, j))
   end function spline_slope

   elemental real(wp) function spline_bend(self, s) result(bend)
      class(cubic_spline), intent(in) :: self
      !> Argument [mm]
      real(wp), intent(in) :: s
      real(wp) :: t
      integer :: j

      call place_in_piece(self, s, j, t)
      bend = 2.0_wp*self%c(2, j) + 6.0_wp*t*self%c(3, j)
   end function spline_bend

   pure function spline_nodes(self) result(values)
      class(cubic_spline), intent(in) :: self
      real(wp) :: values(size(self%s))

      values(:size(self%s) - 1) = self%c(0, :)
      values(size(self%s)) = self%value(self%s(size(self%s)))
   end function spline_nodes

   pure function node_range(self) result(range)
      class(cubic_spline), intent(in) :: self
      real(wp) :: range(2)
      real(wp) :: low, high
      integer :: k

      low = self%value(self%s(size(self%s)))
      high = low
      do k = 1, size(self%c, 2)
         low = min(low, self%c(0, k))
         high = max(high, self%c(0, k))
      end do
      range = [low, high]
   end function node_range

   !> Piece and position in it; the position is limited to the range of the spline
   pure subroutine place_in_piece(self, s, piece, t)
      class(cubic_spline), intent(in) :: self
      !> Argument [mm]
      real(wp), intent(in) :: s
      !> Index of the piece, from 1
      integer, intent(out) :: piece
      !> Distance from the start of the piece [mm]
      real(wp), intent(out) :: t

      piece = piece_of(self%s, s)
      t = min(max(s, self%s(1)), self%s(size(self%s))) - self%s(piece)
   end subroutine place_in_piece

   pure subroutine in_piece(self, piece, t, value, slope)
      class(cubic_spline), intent(in) :: self
      !> Piece from place_in_piece
      integer, intent(in) :: piece
      !> Distance from the start of the piece [mm]
      real(wp), intent(in) :: t
      !> Value, and derivative with respect to s
      real(wp), intent(out) :: value, slope

      value = self%c(0, piece) + t*(self%c(1, piece) + t*(self%c(2, piece) + t*self%c(3, piece)))
      slope = self%c(1, piece) + t*(2.0_wp*self%c(2, piece) + t*3.0_wp*self%c(3, piece))
   end subroutine in_piece

   !> Natural splines through all points, several functions at once
   !>
   !> Solves the equations of `smoothing_splines` without smoothing. Sections of varying profiles need thousands of them: one
   !> elimination for all functions takes a third of the time of separate systems.
   pure subroutine natural_splines(s, f, splines, is_kink)
      !> Abscissae of the points [mm], strictly increasing, at least two
      real(wp), intent(in) :: s(:)
      !> Values (point, function)
      real(wp), intent(in) :: f(:, :)
      !> One spline per function
      type(cubic_spline), intent(out) :: splines(:)
      !> Points where the slope may jump; the ends need not be marked
      logical, intent(in), optional :: is_kink(:)
      !> Half the second derivatives and slopes of the chords of some functions, functions first
      integer, parameter :: together = 4
      real(wp) :: b(together, size(s)), chord(together, size(s) - 1)
      !> Lengths of the pieces, and factors of the elimination
      real(wp) :: h(size(s) - 1), upper(size(s)), pivot(size(s))
      logical :: free(size(s))
      integer :: n, i, j, k, last

      n = size(s)
      h = s(2:) - s(:n - 1)
      free = .true.
      free(1) = .false.
      free(n) = .false.
      if (present(is_kink)) free = free .and. .not. is_kink
      upper(1) = 0.0_wp
      pivot(1) = 0.0_wp
      do j = 2, n
         upper(j) = 0.0_wp
         pivot(j) = 0.0_wp
         if (.not. free(j)) cycle
         pivot(j) = 1.0_wp/(2.0_wp*(h(j - 1) + h(j)) - h(j - 1)*upper(j - 1))
         upper(j) = h(j)*pivot(j)
      end do
      do i = 1, size(splines), together
         last = min(together, size(splines) - i + 1)
         chord = 0.0_wp
         do j = 1, n - 1
            do k = 1, last
               chord(k, j) = (f(j + 1, i + k - 1) - f(j, i + k - 1))/h(j)
            end do
         end do
         b(:, 1) = 0.0_wp
         b(:, n) = 0.0_wp
         do j = 2, n - 1
            b(:, j) = (3.0_wp*(chord(:, j) - chord(:, j - 1)) - h(j - 1)*b(:, j - 1))*pivot(j)
         end do
         do j = n - 1, 2, -1
            b(:, j) = b(:, j) - upper(j)*b(:, j + 1)
         end do
         do k = 1, last
            call make_pieces(s, h, f(:, i + k - 1), b(k, :), splines(i + k - 1))
         end do
      end do
   end subroutine natural_splines

   !> Smoothing splines of several functions on the same points
   !>
   !> Each minimises sum(w (f(s_i) - f_i)**2) + lambda integral(f''**2) with natural ends (Reinsch 1967). Unknowns are half the
   !> second derivatives b; the equations are (R + 2/3 lambda Q' W**-1 Q) b = Q' f, with five diagonals, and the smoothed values
   !> are f - 2/3 lambda W**-1 Q b. At a kink the second derivative is zero on both sides and the slope is free, so that
   !> sections between kinks share only the point; its equation is b = 0.
   subroutine smoothing_splines(s, f, weights, lambda, splines, solved, is_kink)
      !> Abscissae of the points [mm], strictly increasing, at least two
      real(wp), intent(in) :: s(:)
      !> Values (point, function)
      real(wp), intent(in) :: f(:, :)
      !> Weights of the points, positive
      real(wp), intent(in) :: weights(:)
      !> Weight of the curvature, positive; for zero use `natural_splines`
      real(wp), intent(in) :: lambda
      !> One spline per function
      type(cubic_spline), allocatable, intent(out) :: splines(:)
      !> False if the matrix is not numerically positive definite
      logical, intent(out) :: solved
      !> Points where the slope may jump; the ends need not be marked
      logical, intent(in), optional :: is_kink(:)
      !> Band of the matrix, main diagonal in row 3
      real(wp), allocatable :: band(:, :), b(:, :), a(:, :), q(:, :)
      real(wp) :: h(size(s) - 1), strength(size(s))
      logical :: free(size(s))
      integer :: n, j, k

      n = size(s)
      h = s(2:) - s(:n - 1)
      free = .true.
      free(1) = .false.
      free(n) = .false.
      if (present(is_kink)) free = free .and. .not. is_kink
      strength = 2.0_wp/3.0_wp*lambda/weights

      ! column j of Q: rows j-1, j, j+1
      allocate(q(-1:1, n), band(3, n), b(n, size(f, 2)))
      q = 0.0_wp
      band = 0.0_wp
      b = 0.0_wp
      do j = 2, n - 1
         if (.not. free(j)) cycle
         q(:, j) = [3.0_wp/h(j - 1), -3.0_wp/h(j - 1) - 3.0_wp/h(j), 3.0_wp/h(j)]
         b(j, :) = q(-1, j)*f(j - 1, :) + q(0, j)*f(j, :) + q(1, j)*f(j + 1, :)
      end do
      band(3, :) = merge(0.0_wp, 1.0_wp, free)
      do j = 2, n - 1
         if (.not. free(j)) cycle
         band(3, j) = 2.0_wp*(h(j - 1) + h(j)) + sum(strength(j - 1:j + 1)*q(:, j)**2)
         if (free(j - 1)) band(2, j) = h(j - 1) + strength(j - 1)*q(0, j - 1)*q(-1, j) + strength(j)*q(1, j - 1)*q(0, j)
         if (free(max(1, j - 2))) band(1, j) = strength(j - 1)*q(1, j - 2)*q(-1, j)
      end do
      call solve_positive_band(band, b, solved)
      if (.not. solved) return

      a = f
      do j = 2, n - 1
         do k = -1, 1
            a(j + k, :) = a(j + k, :) - strength(j + k)*q(k, j)*b(j, :)
         end do
      end do
      allocate(splines(size(f, 2)))
      do k = 1, size(splines)
         call make_pieces(s, h, a(:, k), b(:, k), splines(k))
      end do
   end subroutine smoothing_splines

   !> Cubic Hermite splines with slopes of parabolas through three points (Overhauser 1968), each piece depending on four points
   !>
   !> Third order instead of fourth as for a natural spline, but a corner between points affects only two pieces on either side.
   pure subroutine local_splines(s, f, splines, is_kink)
      !> Abscissae of the points [mm], strictly increasing, at least two
      real(wp), intent(in) :: s(:)
      !> Values (point, function)
      real(wp), intent(in) :: f(:, :)
      !> One spline per function
      type(cubic_spline), intent(out) :: splines(:)
      !> Points where the slope may jump; the ends need not be marked
      logical, intent(in), optional :: is_kink(:)
      real(wp) :: h(size(s) - 1), chord(size(s) - 1), slope(size(s)), left, right
      logical :: ends(size(s))
      integer :: n, i, k

      n = size(s)
      h = s(2:) - s(:n - 1)
      ends = .false.
      if (present(is_kink)) ends = is_kink
      ends(1) = .true.
      ends(n) = .true.
      slope(1) = 0.0_wp
      slope(n) = 0.0_wp
      do k = 1, size(splines)
         allocate(splines(k)%s(n), splines(k)%c(0:3, n - 1))
         splines(k)%s(:) = s
         do i = 1, n - 1
            chord(i) = (f(i + 1, k) - f(i, k))/h(i)
         end do
         do i = 2, n - 1
            slope(i) = (h(i)*chord(i - 1) + h(i - 1)*chord(i))/(h(i - 1) + h(i))
         end do
         do i = 1, n - 1
            left = slope(i)
            right = slope(i + 1)
            if (ends(i) .or. ends(i + 1)) then
               ! at an end the parabola of the other point is extended; between two ends the piece is straight
               if (ends(i)) left = chord(i)
               if (ends(i + 1)) right = chord(i)
               if (ends(i) .and. .not. ends(i + 1)) left = 2.0_wp*chord(i) - right
               if (ends(i + 1) .and. .not. ends(i)) right = 2.0_wp*chord(i) - left
            end if
            splines(k)%c(0, i) = f(i, k)
            splines(k)%c(1, i) = left
            splines(k)%c(2, i) = (3.0_wp*chord(i) - 2.0_wp*left - right)/h(i)
            splines(k)%c(3, i) = (left + right - 2.0_wp*chord(i))/h(i)**2
         end do
      end do
   end subroutine local_splines

   !> Pieces from values and half second derivatives
   pure subroutine make_pieces(s, h, a, b, spline)
      real(wp), intent(in) :: s(:), h(:), a(:), b(:)
      type(cubic_spline), intent(out) :: spline
      integer :: n, i

      n = size(s)
      allocate(spline%s(n), spline%c(0:3, n - 1))
      spline%s(:) = s
      do i = 1, n - 1
         spline%c(0, i) = a(i)
         spline%c(1, i) = (a(i + 1) - a(i))/h(i) - (2.0_wp*b(i) + b(i + 1))*h(i)/3.0_wp
         spline%c(2, i) = b(i)
         spline%c(3, i) = (b(i + 1) - b(i))/(3.0_wp*h(i))
      end do
   end subroutine make_pieces
end module contact_numeric_spline
