!> Spectra of influence coefficients on a period of elements, and their products with transforms of fields
!>
!> Kernels that are even or odd in each coordinate have real or imaginary spectra: one real array each. The pairs of spectra for
!> small windows are described in contact_elastic_operator.
module contact_elastic_spectra
   use contact_base_kinds, only : wp
   use contact_fft_plan, only : fft_plan
   implicit none (type, external)
   private

   public :: invert_block, make_spectrum, spectrum_floor, replace_by_mean

   !> Lower bound of spectra used as divisors, relative to their maximum. A complete period has a positive spectrum; the bound
   !> protects against round-off for elements of extreme aspect ratio
   real(wp), parameter :: spectrum_floor = 1.0e-10_wp
   !> Elements of a period that are worth threads, at least; chosen
   integer, parameter :: worth_threads = 40000

contains

   !> Spectrum of a kernel on a period, scaled for the back transform: real if the kernel is even or odd in both coordinates,
   !> otherwise the imaginary part
   !>
   !> A zero-padded quarter of the period is transformed; its mirror images have the same spectrum with opposite frequencies.
   subroutine make_spectrum(nx, ny, kernel, odd_x, odd_y, px, py, spectrum)
      !> Maximum offsets of the coefficients
      integer, intent(in) :: nx, ny
      !> Coefficients at these offsets, receiving minus loaded element [mm/(N/mm2)]; with memory the part that is even or odd in
      !> x is used
      real(wp), intent(in) :: kernel(-nx:, -ny:)
      !> Is the kernel odd in x, y? Otherwise it is even
      logical, intent(in) :: odd_x, odd_y
      !> Length of the period, even or 1
      integer, intent(in) :: px, py
      !> Shape (py, px/2 + 1)
      real(wp), allocatable, intent(inout) :: spectrum(:, :)
      type(fft_plan) :: plan
      real(wp), allocatable :: quarter(:, :)
      integer :: k, l
      real(wp) :: scale, sign_x

      sign_x = merge(-1.0_wp, 1.0_wp, odd_x)
      scale = 2.0_wp/(real(px, wp)*real(py, wp))
      allocate(quarter(0:px/2, 0:py/2))
      if (px*py > worth_threads) then
         !$omp parallel do
         do l = 0, py/2
            call set_column(l)
         end do
         !$omp end parallel do
      else
         do l = 0, py/2
            call set_column(l)
         end do
      end if
      ! what is its own mirror image counts half; an odd kernel vanishes there
      do k = 0, px/2, max(1, px/2)
         quarter(k, :) = merge(0.0_wp, 0.5_wp, odd_x)*quarter(k, :)
      end do
      do l = 0, py/2, max(1, py/2)
         quarter(:, l) = merge(0.0_wp, 0.5_wp, odd_y)*quarter(:, l)
      end do
      if (allocated(spectrum)) then
         if (any(shape(spectrum) /= [py, px/2 + 1])) deallocate(spectrum)
      end if
      if (.not. allocated(spectrum)) allocate(spectrum(py, px/2 + 1))
      call plan%prepare(px/2 + 1, py/2 + 1, px, py)
      call plan%transform_quarter(quarter, odd_x .neqv. odd_y, merge(-1.0_wp, 1.0_wp, odd_y), spectrum)
      call plan%release()

   contains

      !> The quarter at one offset in y
      subroutine set_column(l)
         integer, intent(in) :: l
         integer :: k

         do k = 0, px/2
            quarter(k, l) = 0.5_wp*scale*(kernel(k, l) + sign_x*kernel(-k, l))
         end do
      end subroutine set_column
   end subroutine make_spectrum

   !> Spectra of the inverse of a block
   pure subroutine invert_block(elements, xx, yy, xy)
      !> Number of elements of a period, by which spectra are divided for the back transform
      real(wp), intent(in) :: elements
      !> On entry spectra, on exit those of the inverse; shape (py, px/2 + 1)
      real(wp), contiguous, intent(inout) :: xx(:, :), yy(:, :), xy(:, :)
      real(wp) :: det, floor_, keep, scale
      integer :: k, l

      scale = 1.0_wp/elements
      floor_ = spectrum_floor*maxval(abs(xx))*maxval(abs(yy))
      do l = 1, size(xx, 2)
         do k = 1, size(xx, 1)
            det = max(xx(k, l)*yy(k, l) - xy(k, l)**2, floor_)
            keep = xx(k, l)
            xx(k, l) = scale**2*yy(k, l)/det
            yy(k, l) = scale**2*keep/det
            xy(k, l) = -scale**2*xy(k, l)/det
         end do
      end do
   end subroutine invert_block

   !> Replace two spectra by half their sum and half their difference
   elemental subroutine replace_by_mean(xx, yy)
      !> On entry spectra, on exit half their sum and half their difference
      real(wp), intent(inout) :: xx, yy
      real(wp) :: difference

      difference = 0.5_wp*(xx - yy)
      xx = 0.5_wp*(xx + yy)
      yy = difference
   end subroutine replace_by_mean
end module contact_elastic_spectra
