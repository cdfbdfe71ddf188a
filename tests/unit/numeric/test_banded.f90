!> Systems with band matrices against products with their solutions
program test_banded
   use contact_base_kinds, only : wp
   use contact_numeric_banded, only : solve_band, solve_positive_band
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   integer, allocatable :: seed(:)
   integer :: length, n

   call suite%start("banded")
   call random_seed(size=length)
   allocate(seed(length), source=20261122)
   call random_seed(put=seed)
   deallocate(seed)
   do n = 1, 40
      call check_positive(n, 1 + mod(n, 4))
      call check_any(n, mod(n, 4))
   end do
   call check_refusals()
   call suite%finish()

contains

   !> A band with a dominant diagonal
   subroutine check_positive(n, rows)
      integer, intent(in) :: n, rows
      real(wp) :: full(n, n), band(rows, n), x(n, 2), b(n, 2)
      logical :: solved
      integer :: i, j

      full = 0.0_wp
      band = 0.0_wp
      call random_number(x)
      do j = 1, n
         do i = max(1, j - rows + 1), j
            call random_number(full(i, j))
            full(i, j) = full(i, j) - 0.5_wp
            if (i == j) full(i, j) = rows
            full(j, i) = full(i, j)
            band(rows + i - j, j) = full(i, j)
         end do
      end do
      b = matmul(full, x)
      call solve_positive_band(band, b, solved)
      call suite%check(solved .and. maxval(abs(b - x)) < 1.0e-13_wp, "positive definite")
   end subroutine check_positive

   !> A band whose diagonal is zero here and there, so that rows must be exchanged
   subroutine check_any(n, width)
      integer, intent(in) :: n, width
      real(wp) :: full(n, n), band(3*width + 1, n), x(n, 3), b(n, 3)
      logical :: solved
      integer :: i, j

      full = 0.0_wp
      band = huge(1.0_wp)
      call random_number(x)
      do j = 1, n
         do i = max(1, j - width), min(n, j + width)
            call random_number(full(i, j))
            if (i == j .and. width > 0) full(i, j) = 0.0_wp
            ! far from singular: pairs of rows are exchanged
            if (width > 0 .and. abs(i - j) == 1 .and. max(i, j) == 2*(max(i, j)/2)) full(i, j) = 5.0_wp
            if (i == j .and. (i == n .and. mod(n, 2) == 1)) full(i, j) = 5.0_wp
            band(2*width + 1 + i - j, j) = full(i, j)
         end do
      end do
      b = matmul(full, x)
      call solve_band(band, width, b, solved)
      call suite%check(solved .and. maxval(abs(b - x)) < 1.0e-11_wp, "any band")
   end subroutine check_any

   !> Matrices without a solution
   subroutine check_refusals()
      real(wp) :: upper(2, 2), band(4, 2), b(2, 1)
      logical :: solved

      upper = reshape([0.0_wp, 1.0_wp, 2.0_wp, 1.0_wp], [2, 2])
      b = 1.0_wp
      call solve_positive_band(upper, b, solved)
      call suite%check(.not. solved, "not positive definite")
      band = 0.0_wp
      band(3, 1) = 1.0_wp
      band(2, 2) = 1.0_wp
      call solve_band(band, 1, b, solved)
      call suite%check(.not. solved, "singular")
   end subroutine check_refusals
end program test_banded
