!> Linear systems with a band matrix: a few diagonals, thousands of unknowns, several right-hand sides
!>
!> Implemented here because the usual linear algebra library starts threads in every process that loads it, which these few band
!> systems do not need.
module contact_numeric_banded
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: solve_positive_band, solve_band

contains

   !> Solve a system with a symmetric positive definite matrix, by Cholesky factorisation U'U
   pure subroutine solve_positive_band(band, b, solved)
      !> Upper half: element (i, j), i <= j, in row w + i - j of column j, with w rows and w - 1 superdiagonals; the main
      !> diagonal is the last row; on exit U
      real(wp), intent(inout) :: band(:, :)
      !> Right-hand sides (unknown, function), on exit the solutions
      real(wp), intent(inout) :: b(:, :)
      !> False if the matrix is not numerically positive definite
      logical, intent(out) :: solved
      real(wp) :: rest
      integer :: w, n, i, j, k, l, first

      w = size(band, 1)
      n = size(band, 2)
      solved = .false.
      do j = 1, n
         first = max(1, j - w + 1)
         do i = first, j
            rest = band(w + i - j, j)
            do l = first, i - 1
               rest = rest - band(w + l - i, i)*band(w + l - j, j)
            end do
            if (i < j) then
               band(w + i - j, j) = rest/band(w, i)
            else
               if (.not. rest > 0.0_wp) return
               band(w, j) = sqrt(rest)
            end if
         end do
      end do
      do k = 1, size(b, 2)
         do j = 1, n
            do l = max(1, j - w + 1), j - 1
               b(j, k) = b(j, k) - band(w + l - j, j)*b(l, k)
            end do
            b(j, k) = b(j, k)/band(w, j)
         end do
         do j = n, 1, -1
            b(j, k) = b(j, k)/band(w, j)
            do l = max(1, j - w + 1), j - 1
               b(l, k) = b(l, k) - band(w + l - j, j)*b(j, k)
            end do
         end do
      end do
      solved = .true.
   end subroutine solve_positive_band

   !> Solve a system with a general matrix, by elimination with row exchanges
   pure subroutine solve_band(band, width, b, solved)
      !> Element (i, j), |i - j| <= width, in row 2 width + 1 + i - j of column j; 3 width + 1 rows, of which the first `width`
      !> are filled by row exchanges
      real(wp), intent(inout) :: band(:, :)
      !> Number of diagonals on either side of the main diagonal
      integer, intent(in) :: width
      !> Right-hand sides (unknown, function), on exit the solutions
      real(wp), intent(inout) :: b(:, :)
      !> False if the matrix is singular
      logical, intent(out) :: solved
      real(wp) :: factor, row(size(b, 2)), kept
      integer :: d, n, i, j, k, pivot, last

      d = 2*width + 1
      n = size(band, 2)
      solved = .false.
      band(:width, :) = 0.0_wp
      do k = 1, n
         last = min(n, k + width)
         pivot = k - 1 + maxloc(abs(band(d:d + last - k, k)), 1)
         if (.not. abs(band(d + pivot - k, k)) > 0.0_wp) return
         if (pivot /= k) then
            do j = k, min(n, k + 2*width)
               kept = band(d + k - j, j)
               band(d + k - j, j) = band(d + pivot - j, j)
               band(d + pivot - j, j) = kept
            end do
            row = b(k, :)
            b(k, :) = b(pivot, :)
            b(pivot, :) = row
         end if
         do i = k + 1, last
            factor = band(d + i - k, k)/band(d, k)
            if (abs(factor) <= 0.0_wp) cycle
            do j = k + 1, min(n, k + 2*width)
               band(d + i - j, j) = band(d + i - j, j) - factor*band(d + k - j, j)
            end do
            b(i, :) = b(i, :) - factor*b(k, :)
         end do
      end do
      do k = n, 1, -1
         do j = k + 1, min(n, k + 2*width)
            b(k, :) = b(k, :) - band(d + k - j, j)*b(j, :)
         end do
         b(k, :) = b(k, :)/band(d, k)
      end do
      solved = .true.
   end subroutine solve_band
end module contact_numeric_banded
