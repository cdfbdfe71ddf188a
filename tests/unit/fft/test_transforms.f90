!> Transforms of padded windows agree with the sums that define them, for all libraries
program transforms
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_fft_paired, only : paired_plan
   use contact_fft_plan, only : fft_plan, kernel_spectrum
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   !> Windows and padded windows: squares, lines, odd lengths, primes; all factors of lengths first and last, more and less than
   !> half a line, incomplete groups of rows and columns
   integer, parameter :: sizes(4, 13) = reshape([3, 5, 6, 10, 8, 8, 16, 16, 1, 7, 1, 14, 9, 1, 18, 1, 6, 11, 14, 22, 13, 4, 26, 9, &
      & 20, 17, 40, 35, 31, 24, 64, 48, 50, 11, 64, 30, 12, 9, 90, 72, 30, 3, 30, 8, 9, 12, 50, 27, 5, 16, 24, 32], [4, 13])
   !> Round-off of sums of some hundred terms of order one
   real(wp), parameter :: tolerance = 2.0e-13_wp
   integer :: k

   call suite%start("transforms")
   do k = 1, size(sizes, 2)
      call compare(sizes(1, k), sizes(2, k), sizes(3, k), sizes(4, k))
   end do
   call suite%finish()

contains

   !> A field without symmetry
   pure function field_of(mx, my) result(field)
      integer, intent(in) :: mx, my
      real(wp) :: field(mx, my)
      integer :: ix, iy

      do iy = 1, my
         do ix = 1, mx
            field(ix, iy) = sin(1.3_wp*ix + 0.7_wp*iy*iy) + 0.2_wp*ix
         end do
      end do
   end function field_of

   !> Coefficient of a padded window by its definition
   pure complex(wp) function coefficient(field, px, py, jx, jy)
      real(wp), intent(in) :: field(:, :)
      integer, intent(in) :: px, py, jx, jy
      integer :: ix, iy

      coefficient = 0.0_wp
      do iy = 0, size(field, 2) - 1
         do ix = 0, size(field, 1) - 1
            coefficient = coefficient + field(ix + 1, iy + 1) &
               & *exp(cmplx(0.0_wp, -2.0_wp*pi*(real(ix*jx, wp)/px + real(iy*jy, wp)/py), wp))
         end do
      end do
   end function coefficient

   subroutine compare(mx, my, px, py)
      integer, intent(in) :: mx, my, px, py
      type(fft_plan) :: plan
      complex(wp), allocatable :: spectrum(:, :), kernel(:, :)
      real(wp), allocatable :: field(:, :), back(:, :), period(:, :)
      character(len=40) :: name
      real(wp) :: error
      integer :: jx, jy

      write(name, "(4(I0, 1X))") mx, my, px, py
      field = field_of(mx, my)
      allocate(spectrum(py, px/2 + 1), kernel(py, px/2 + 1), back(mx, my), period(px, py))
      call plan%prepare(mx, my, px, py)
      call plan%forward(field, spectrum)
      error = 0.0_wp
      do jy = 0, py - 1
         do jx = 0, px/2
            error = max(error, abs(spectrum(jy + 1, jx + 1) - coefficient(field, px, py, jx, jy)))
         end do
      end do
      call suite%close_to(error, 0.0_wp, tolerance*mx*my, "forward " // name)
      period = 0.0_wp
      period(1:mx, 1:my) = field
      call kernel_spectrum(period, kernel)
      call suite%close_to(maxval(abs(kernel - spectrum)), 0.0_wp, tolerance*mx*my, "kernel " // name)
      call plan%backward(spectrum, back)
      call suite%close_to(maxval(abs(back/(real(px, wp)*py) - field)), 0.0_wp, tolerance, "back again " // name)
      call compare_products(plan, field, spectrum, name)
      if (min(px, py) > 1) call compare_pairs(plan, field, name)
      call plan%release()
   end subroutine compare

   !> Products with kernels, whose spectra are real and even, are those of the spectra
   subroutine compare_products(plan, field, spectrum, name)
      type(fft_plan), intent(inout) :: plan
      !> A field and its spectrum
      real(wp), contiguous, intent(in) :: field(:, :)
      complex(wp), contiguous, intent(in) :: spectrum(:, :)
      character(len=*), intent(in) :: name
      real(wp), allocatable :: block(:, :, :), expected(:, :), fields(:, :, :), products(:, :, :)
      complex(wp), allocatable :: factor(:), other(:, :), turned(:, :)
      real(wp) :: angle
      integer :: k, l, n

      allocate(block(plan%py, plan%kx, 3), factor(plan%kx), other(plan%py, plan%kx), expected(plan%mx, plan%my))
      do k = 1, plan%kx
         factor(k) = exp(cmplx(0.0_wp, 2.0_wp*pi*(k - 1)/plan%px, wp))
         do l = 1, plan%py
            angle = 2.0_wp*pi*(l - 1)/plan%py
            block(l, k, :) = [2.0_wp + cos(angle)/k, 3.0_wp + cos(2.0_wp*angle)/k, 0.5_wp/k + 0.1_wp*cos(3.0_wp*angle)]
         end do
      end do
      allocate(fields(plan%mx, plan%my, 2), products(plan%mx, plan%my, 2))
      fields(:, :, 1) = field
      fields(:, :, 2) = 1.0_wp - field**2
      call plan%forward(fields(:, :, 2), other)
      turned = block(:, :, 1)*spectrum
      call plan%backward(turned, expected)
      call plan%convolve(block(:, :, 1), field, products(:, :, 1))
      call suite%close_to(maxval(abs(products(:, :, 1) - expected))/maxval(abs(expected)), 0.0_wp, tolerance, "product " // name)
      do n = 1, 4
         ! with and without a factor, both fields
         turned = block(:, :, merge(1, 3, n < 3))*spectrum + block(:, :, merge(3, 2, n < 3))*other
         if (mod(n, 2) == 0) then
            do k = 1, plan%kx
               turned(:, k) = factor(k)*turned(:, k)
            end do
            call plan%convolve_pair(block(:, :, 1), block(:, :, 2), block(:, :, 3), fields, products, factor)
         else
            call plan%convolve_pair(block(:, :, 1), block(:, :, 2), block(:, :, 3), fields, products)
         end if
         call plan%backward(turned, expected)
         call suite%close_to(maxval(abs(products(:, :, merge(1, 2, n < 3)) - expected))/maxval(abs(expected)), 0.0_wp, tolerance, &
            & "product of two " // name)
      end do
   end subroutine compare_products

   !> Products of both fields in one complex transform are those of two real ones
   subroutine compare_pairs(plan, field, name)
      type(fft_plan), intent(inout) :: plan
      real(wp), contiguous, intent(in) :: field(:, :)
      character(len=*), intent(in) :: name
      type(paired_plan) :: pair
      real(wp), allocatable :: block(:, :, :), fields(:, :, :), expected(:, :, :), products(:, :, :), mean(:, :), difference(:, :)
      complex(wp), allocatable :: factor(:)
      real(wp) :: x, y
      integer :: ahead, k, l

      allocate(block(plan%py, plan%kx, 3), factor(plan%kx), fields(plan%mx, plan%my, 2))
      fields(:, :, 1) = field
      fields(:, :, 2) = 1.0_wp - field**2
      allocate(expected, products, mold=fields)
      do k = 1, plan%kx
         x = 2.0_wp*pi*(k - 1)/plan%px
         do l = 1, plan%py
            y = 2.0_wp*pi*(l - 1)/plan%py
            block(l, k, :) = [2.0_wp + cos(y)*cos(2.0_wp*x), 3.0_wp + cos(2.0_wp*y) + 0.5_wp*cos(x), sin(y)*sin(x)]
         end do
      end do
      mean = 0.5_wp*(block(:, :, 1) + block(:, :, 2))
      difference = 0.5_wp*(block(:, :, 1) - block(:, :, 2))
      call pair%prepare(plan%mx, plan%my, plan%px, plan%py)
      do ahead = -1, 1
         ! differences need two columns of padding
         if (ahead /= 0 .and. plan%px < plan%mx + 2) cycle
         do k = 1, plan%kx
            factor(k) = 1.0_wp
            if (ahead /= 0) factor(k) = 1.0_wp - exp(cmplx(0.0_wp, ahead*2.0_wp*pi*(k - 1)/plan%px, wp))
         end do
         call plan%convolve_pair(block(:, :, 1), block(:, :, 2), block(:, :, 3), fields, expected, factor)
         call pair%convolve(mean, difference, block(:, :, 3), fields, products, ahead)
         call suite%close_to(maxval(abs(products - expected))/maxval(abs(expected)), 0.0_wp, tolerance, "pair " // name)
      end do
      do k = 1, 2
         call plan%convolve(block(:, :, 1), fields(:, :, k), expected(:, :, k))
      end do
      call pair%convolve_even(block(:, :, 1), fields, products)
      call suite%close_to(maxval(abs(products - expected))/maxval(abs(expected)), 0.0_wp, tolerance, "even pair " // name)
      call pair%release()
   end subroutine compare_pairs
end program transforms
