!> Zero-padded real transforms of a rectangular window
!>
!> Rows that are known to be zero are not transformed, and rows of the result that
!> nobody asks for are not transformed back; that leaves about three quarters of the work of
!> a plain two-dimensional transform of the padded window. Spectra are stored transposed,
!> shape (py, kx), so that the second pass runs along contiguous memory: one column after the other into a
!> buffer and back, which is faster than transforms in place, and asks for no memory.
module contact_fft_plan
   use, intrinsic :: iso_c_binding, only : c_associated
   use contact_base_kinds, only : wp
   use contact_fft_library, only : backwards, execute_backward, execute_complex, execute_forward, forwards, &
      & plan_backward, plan_complex, plan_forward, plan_plane
   use contact_fft_kept_plans, only : column_backward, column_forward, plan_kind, plan_set, row_backward, row_forward
   implicit none (type, external)
   private

   public :: fft_plan, kernel_spectrum, good_size, fast_size, largest_fast_size

   !> Even lengths below 129 for which FFTW has short code, measured with estimated plans. A length of 32 takes
   !> less time than 22, 24 or 28, and 64 less than 54
   integer, parameter :: fast_sizes(*) = [2, 4, 6, 8, 10, 12, 14, 16, 20, 32, 40, 48, 56, 64, 72, 80, 96, 112, 128]
   integer, parameter :: largest_fast_size = fast_sizes(size(fast_sizes))

   !> Plans and buffers for one window size; not to be copied
   !>
   !> Whoever owns one calls release before it goes: a finaliser would do that by itself, but gfortran 12
   !> makes programs crash that finalise such components inside arrays of derived types.
   type :: fft_plan
      !> Size of the window and of the padded window
      integer :: mx = 0, my = 0, px = 0, py = 0
      !> Number of frequencies kept in x: px/2 + 1
      integer :: kx = 0
      !> Rows of the window, padded in x, one set for each of two concurrent transforms, shape (px, my, 2)
      real(wp), allocatable, private :: rows(:, :, :)
      !> A transformed column of the spectrum, one for each of two concurrent transforms, shape (py, 2)
      complex(wp), allocatable, private :: column(:, :)
      type(plan_set), private :: plans
   contains
      !> Make plans for a window; keeps them when the size is the same
      procedure :: prepare => prepare_plan
      !> Transform a window, zero-padded
      procedure :: forward => transform_forward
      !> Transform back, unscaled, and cut out the window; destroys the spectrum
      procedure :: backward => transform_backward
      !> Free the plans
      procedure :: release => release_plan
   end type fft_plan

contains

   !> Smallest even number 2^a 3^b 5^c 7^d (a >= 1) that is at least n, or 1 for n <= 1
   pure integer function good_size(n) result(size)
      !> Number of points that are needed, with those of the padding
      integer, intent(in) :: n
      integer :: rest, factor
      integer, parameter :: primes(4) = [2, 3, 5, 7]

      size = max(1, n)
      if (size == 1) return
      if (mod(size, 2) == 1) size = size + 1
      do
         rest = size
         do factor = 1, 4
            do while (mod(rest, primes(factor)) == 0)
               rest = rest/primes(factor)
            end do
         end do
         if (rest == 1) return
         size = size + 2
      end do
   end function good_size

   !> Even length of at least n that is transformed quickly, or 1 for n <= 1
   pure integer function fast_size(n)
      !> Number of points that are needed, with those of the padding
      integer, intent(in) :: n

      fast_size = good_size(n)
      if (n > 1 .and. n <= largest_fast_size) fast_size = minval(fast_sizes, fast_sizes >= n)
   end function fast_size

   subroutine prepare_plan(self, mx, my, px, py)
      class(fft_plan), intent(inout) :: self
      !> Window and padded window; px even or 1, px >= mx, py >= my
      integer, intent(in) :: mx, my, px, py
      complex(wp), allocatable :: spectrum(:, :)

      if (self%mx == mx .and. self%my == my .and. self%px == px .and. self%py == py &
         & .and. c_associated(self%plans%plan(row_forward))) return
      call self%release()
      self%mx = mx
      self%my = my
      self%px = px
      self%py = py
      self%kx = px/2 + 1
      allocate(self%rows(px, my, 2), source=0.0_wp)
      allocate(self%column(py, 2), source=(0.0_wp, 0.0_wp))
      ! the planner of FFTW is not thread-safe; estimated plans make results reproducible
      !$omp critical (contact_fft_planner)
      call self%plans%take(plan_kind%single, my, px, py)
      if (.not. self%plans%is_kept) then
         allocate(spectrum(py, self%kx), source=(0.0_wp, 0.0_wp))
         self%plans%plan = [plan_forward(px, my, self%rows, 1, px, spectrum, py, 1), &
            & plan_backward(px, my, spectrum, py, 1, self%rows, 1, px), &
            & plan_complex(py, 1, spectrum, 1, py, self%column, 1, py, forwards), &
            & plan_complex(py, 1, spectrum, 1, py, self%column, 1, py, backwards)]
         call self%plans%keep(plan_kind%single, my, px, py)
      end if
      !$omp end critical (contact_fft_planner)
   end subroutine prepare_plan

   subroutine transform_forward(self, field, spectrum, channel)
      class(fft_plan), intent(inout) :: self
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)
      !> Spectrum, shape (py, kx)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      !> 1 or 2: set of buffers; transforms that run at the same time need different ones. Default 1
      integer, intent(in), optional :: channel
      integer :: iy, k, c

      c = 1
      if (present(channel)) c = channel
      do iy = 1, self%my
         self%rows(1:self%mx, iy, c) = field(:, iy)
         self%rows(self%mx + 1:, iy, c) = 0.0_wp
      end do
      call execute_forward(self%plans%plan(row_forward), self%rows(:, :, c), spectrum)
      if (self%py == 1) return
      do k = 1, self%kx
         spectrum(self%my + 1:, k) = (0.0_wp, 0.0_wp)
         call execute_complex(self%plans%plan(column_forward), spectrum(:, k), self%column(:, c))
         spectrum(:, k) = self%column(:, c)
      end do
   end subroutine transform_forward

   subroutine transform_backward(self, spectrum, field, channel)
      class(fft_plan), intent(inout) :: self
      !> Spectrum, shape (py, kx); destroyed
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(inout) :: field(:, :)
      !> 1 or 2: set of buffers. Default 1
      integer, intent(in), optional :: channel
      integer :: iy, k, c

      c = 1
      if (present(channel)) c = channel
      if (self%py > 1) then
         do k = 1, self%kx
            call execute_complex(self%plans%plan(column_backward), spectrum(:, k), self%column(:, c))
            spectrum(:self%my, k) = self%column(:self%my, c)
         end do
      end if
      call execute_backward(self%plans%plan(row_backward), spectrum, self%rows(:, :, c))
      do iy = 1, self%my
         field(:, iy) = self%rows(1:self%mx, iy, c)
      end do
   end subroutine transform_backward

   !> Spectrum of a full period of real values
   subroutine kernel_spectrum(period, spectrum)
      !> One period, shape (px, py); destroyed
      real(wp), contiguous, intent(inout) :: period(:, :)
      !> Spectrum, shape (py, px/2 + 1)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      type(plan_set) :: plans
      complex(wp), allocatable :: by_rows(:, :)

      allocate(by_rows(size(spectrum, 2), size(period, 2)))
      !$omp critical (contact_fft_planner)
      call plans%take(plan_kind%kernel, 0, size(period, 1), size(period, 2))
      if (.not. plans%is_kept) then
         plans%plan(row_forward) = plan_plane(size(period, 2), size(period, 1), period, by_rows)
         call plans%keep(plan_kind%kernel, 0, size(period, 1), size(period, 2))
      end if
      !$omp end critical (contact_fft_planner)
      call execute_forward(plans%plan(row_forward), period, by_rows)
      spectrum = transpose(by_rows)
      call plans%release()
   end subroutine kernel_spectrum

   subroutine release_plan(self)
      class(fft_plan), intent(inout) :: self

      call self%plans%release()
      self%mx = 0
      if (allocated(self%rows)) deallocate(self%rows, self%column)
   end subroutine release_plan

end module contact_fft_plan
