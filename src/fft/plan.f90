!> Zero-padded real transforms of a rectangular window, and convolutions based on them
!>
!> Two rows are transformed at once, as real and imaginary part of a complex row: FFTW has vector code for complex transforms
!> only. Zero rows are not transformed forward, and rows that are not needed are not transformed back. A convolution processes
!> the spectrum column by column (transform, multiply by the kernel, transform back), so that the complete spectrum is never
!> stored. Each row and each column is transformed independently, so that results do not depend on the number of threads.
module contact_fft_plan
   use, intrinsic :: iso_c_binding, only : c_associated, c_ptr
   use contact_base_kinds, only : wp
   use contact_fft_kept_plans, only : line_backward, line_forward, plan_kind, plan_set
   use contact_fft_library, only : backwards, destroy, execute_complex, forwards, lanes, plan_complex
   use contact_fft_lines, only : copy, multiply_block, multiply_one, multiply_two, put_together, separate_rows, turn_two
   use contact_fft_sizes, only : fast_size, good_size, largest_fast_size
   !$ use omp_lib, only : omp_get_max_threads
   implicit none (type, external)
   private

   public :: fft_plan, kernel_spectrum, good_size, fast_size, largest_fast_size, start_planner

   !> Padded windows of more elements are shared among threads; smaller ones are done before threads are awake
   integer, parameter :: worth_threads = 40000

   !> Plans and buffers for one window size; must not be copied
   !>
   !> The owner must call release. A finaliser would do this automatically, but programs compiled by gfortran 12 crash when they
   !> finalise such components inside arrays of derived types.
   type :: fft_plan
      !> Size of the window and of the padded window
      integer :: mx = 0, my = 0, px = 0, py = 0
      !> Number of frequencies kept in x: px/2 + 1
      integer :: kx = 0
      !> Rows of one or two fields after their transform, space for (my, 2, kx)
      complex(wp), allocatable, private :: half(:)
      !> Pairs of rows: padded, transformed, and transformed back, shape (px, lanes, 3, threads)
      complex(wp), allocatable, private :: row(:, :, :, :)
      !> Columns: padded, those of two fields transformed, and transformed back, shape (py, lanes, 4, threads)
      complex(wp), allocatable, private :: column(:, :, :, :)
      type(plan_set), private :: rows, columns
   contains
      !> Make plans for a window; existing plans of the same size are kept
      procedure :: prepare => prepare_plan
      !> Transform a window, zero-padded; back, unscaled, the window cut out, the spectrum kept
      procedure :: forward => transform_forward
      procedure :: backward => transform_backward
      !> Transform a quarter of a kernel
      procedure :: transform_quarter
      !> Products with a kernel whose spectrum is real, of two fields with a symmetric 2 by 2 block of them
      procedure :: convolve
      procedure :: convolve_pair
      !> Free the plans
      procedure :: release => release_plan
   end type fft_plan

contains

   !> Start the planner of the library, which takes FFTW some tenths of a millisecond: for who prepares a loop over time
   subroutine start_planner()
      complex(wp) :: from(2), to(2)
      type(c_ptr) :: plan

      !$omp critical (contact_fft_planner)
      plan = plan_complex(2, 1, from, 1, 2, to, 1, 2, forwards)
      call destroy(plan)
      !$omp end critical (contact_fft_planner)
   end subroutine start_planner

   subroutine prepare_plan(self, mx, my, px, py)
      class(fft_plan), intent(inout) :: self
      !> Window and padded window; px even or 1, px >= mx, py >= my
      integer, intent(in) :: mx, my, px, py

      if (self%mx == mx .and. self%my == my .and. self%px == px .and. self%py == py &
         & .and. c_associated(self%rows%plan(line_forward))) return
      call self%release()
      self%mx = mx
      self%my = my
      self%px = px
      self%py = py
      self%kx = px/2 + 1
      allocate(self%half(2*my*self%kx))
      call fit_buffers(self, 1)
      call get_line_plans(self%rows, self%row(:, :, 1, 1), self%row(:, :, 2, 1))
      call get_line_plans(self%columns, self%column(:, :, 1, 1), self%column(:, :, 2, 1))
   end subroutine prepare_plan

   !> Allocate buffers for a number of threads; their padding remains zero
   subroutine fit_buffers(self, threads)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: threads

      if (allocated(self%row)) then
         if (size(self%row, 4) >= threads) return
         deallocate(self%row, self%column)
      end if
      allocate(self%row(self%px, min(lanes, (self%my + 1)/2), 3, threads), source=(0.0_wp, 0.0_wp))
      allocate(self%column(self%py, min(lanes, self%kx), 4, threads), source=(0.0_wp, 0.0_wp))
   end subroutine fit_buffers

   !> Plans for lines, from one buffer to another of the same shape
   subroutine get_line_plans(plans, from, to)
      type(plan_set), intent(inout) :: plans
      complex(wp), contiguous, intent(inout) :: from(:, :), to(:, :)
      integer :: n, many

      n = size(from, 1)
      many = size(from, 2)
      ! the planner of FFTW is not thread-safe; estimated plans make results reproducible
      !$omp critical (contact_fft_planner)
      call plans%take(plan_kind%lines, many, n, 1)
      if (.not. plans%is_kept) then
         plans%plan(line_forward) = plan_complex(n, many, from, 1, n, to, 1, n, forwards)
         plans%plan(line_backward) = plan_complex(n, many, from, 1, n, to, 1, n, backwards)
         call plans%keep(plan_kind%lines, many, n, 1)
      end if
      !$omp end critical (contact_fft_planner)
   end subroutine get_line_plans

   subroutine transform_forward(self, field, spectrum)
      class(fft_plan), intent(inout) :: self
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)
      !> Spectrum, shape (py, kx)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      integer :: k, l, n

      if (self%py == 1) then
         call rows_forward(self, 1, 1, 1, 1, field, spectrum)
         return
      end if
      call rows_forward(self, 1, 1, self%my, self%my, field, self%half)
      n = size(self%column, 2)
      do k = 1, self%kx, n
         call columns_forward(self, 1, k, 1, 1, self%half)
         do l = k, min(k + n - 1, self%kx)
            spectrum(:, l) = self%column(:, l - k + 1, 2, 1)
         end do
      end do
   end subroutine transform_forward

   subroutine transform_backward(self, spectrum, field)
      class(fft_plan), intent(inout) :: self
      !> Spectrum, shape (py, kx)
      complex(wp), contiguous, intent(in) :: spectrum(:, :)
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(inout) :: field(:, :)
      integer :: k, l, n

      if (self%py == 1) then
         call rows_backward(self, 1, 1, 1, 1, spectrum, field)
         return
      end if
      n = size(self%column, 2)
      do k = 1, self%kx, n
         do l = k, min(k + n - 1, self%kx)
            self%column(:, l - k + 1, 2, 1) = spectrum(:, l)
         end do
         call columns_backward(self, 1, k, 1, 1, self%half)
      end do
      call rows_backward(self, 1, 1, self%my, self%my, self%half, field)
   end subroutine transform_backward

   !> Real or imaginary parts of a transform, those of opposite frequencies in y added
   subroutine transform_quarter(self, quarter, imaginary, sign_y, spectrum)
      class(fft_plan), intent(inout) :: self
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(in) :: quarter(:, :)
      !> Imaginary parts, else real ones
      logical, intent(in) :: imaginary
      !> Factor of the opposite frequencies
      real(wp), intent(in) :: sign_y
      !> Shape (py, kx)
      real(wp), contiguous, intent(inout) :: spectrum(:, :)
      integer :: stage, t, threads

      threads = threads_of(self)
      do stage = 1, 2
         if (threads == 1) then
            call share_of_quarter(self, stage, 1, 1, quarter, imaginary, sign_y, spectrum)
         else
            !$omp parallel do num_threads(threads) schedule(static, 1)
            do t = 1, threads
               call share_of_quarter(self, stage, t, threads, quarter, imaginary, sign_y, spectrum)
            end do
            !$omp end parallel do
         end if
      end do
   end subroutine transform_quarter

   !> What falls to one of some threads
   subroutine share_of_quarter(self, stage, t, threads, quarter, imaginary, sign_y, spectrum)
      type(fft_plan), intent(inout) :: self
      !> 1: rows, 2: columns
      integer, intent(in) :: stage, t, threads
      real(wp), intent(in) :: quarter(self%mx, self%my)
      logical, intent(in) :: imaginary
      real(wp), intent(in) :: sign_y
      real(wp), intent(inout) :: spectrum(self%py, self%kx)
      integer :: first, k, l, last

      if (stage == 1) then
         call find_share(self%my, 2*size(self%row, 2), t, threads, first, last)
         call rows_forward(self, t, first, last, self%my, quarter, self%half)
         return
      end if
      call find_share(self%kx, size(self%column, 2), t, threads, first, last)
      do k = first, last, size(self%column, 2)
         if (self%py > 1) call columns_forward(self, t, k, 1, 1, self%half)
         do l = k, min(k + size(self%column, 2) - 1, last)
            if (self%py == 1) self%column(1, l - k + 1, 2, t) = self%half(l)
            call fold(self%py, self%column(:, l - k + 1, 2, t), imaginary, sign_y, spectrum(:, l))
         end do
      end do
   end subroutine share_of_quarter

   !> Real or imaginary parts of a column and those of its opposite frequencies
   pure subroutine fold(n, column, imaginary, sign_y, folded)
      integer, intent(in) :: n
      complex(wp), intent(in) :: column(n)
      logical, intent(in) :: imaginary
      real(wp), intent(in) :: sign_y
      real(wp), intent(inout) :: folded(n)
      real(wp) :: part(n)

      part = column%re
      if (imaginary) part = column%im
      folded(1) = (1.0_wp + sign_y)*part(1)
      folded(2:) = part(2:) + sign_y*part(n:2:-1)
   end subroutine fold

   subroutine convolve(self, kernel, field, product)
      class(fft_plan), intent(inout) :: self
      !> Spectrum of the kernel, scaled for the back transform, shape (py, kx)
      real(wp), contiguous, intent(in) :: kernel(:, :)
      !> Field, shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)
      !> Product of the field and the kernel, same shape
      real(wp), contiguous, intent(inout) :: product(:, :)

      call make_product(self, 1, field, product, kernel)
   end subroutine convolve

   subroutine convolve_pair(self, xx, yy, xy, fields, products, factor)
      class(fft_plan), intent(inout) :: self
      !> Spectra of the block, scaled for the back transform, shape (py, kx)
      real(wp), contiguous, intent(in) :: xx(:, :), yy(:, :), xy(:, :)
      !> Two fields, shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: fields(:, :, :)
      !> Product of the fields and the block, same shape
      real(wp), contiguous, intent(inout) :: products(:, :, :)
      !> Additional factor per column of the spectrum, shape (kx); absent: 1
      complex(wp), contiguous, intent(in), optional :: factor(:)

      if (self%py == 1) then
         call multiply_lines(self, fields, products, xx, yy, xy, factor)
      else
         call make_product(self, 2, fields, products, xx, yy, xy, factor)
      end if
   end subroutine convolve_pair

   !> Rows forward, columns, rows back; in each stage the lines are shared among the threads
   subroutine make_product(self, n, fields, products, xx, yy, xy, factor)
      type(fft_plan), intent(inout) :: self
      !> Number of fields, 1 or 2
      integer, intent(in) :: n
      !> Rows of all fields
      real(wp), intent(in) :: fields(self%mx, n*self%my)
      real(wp), intent(inout) :: products(self%mx, n*self%my)
      real(wp), contiguous, intent(in) :: xx(:, :)
      !> Present for two fields
      real(wp), contiguous, intent(in), optional :: yy(:, :), xy(:, :)
      complex(wp), contiguous, intent(in), optional :: factor(:)
      integer :: stage, t, threads

      threads = threads_of(self)
      do stage = 1, 3
         if (threads == 1) then
            call share_of_stage(self, stage, 1, 1, n, fields, products, xx, yy, xy, factor)
         else
            !$omp parallel do num_threads(threads) schedule(static, 1)
            do t = 1, threads
               call share_of_stage(self, stage, t, threads, n, fields, products, xx, yy, xy, factor)
            end do
            !$omp end parallel do
         end if
      end do
   end subroutine make_product

   !> Number of threads that share the lines; they have buffers
   integer function threads_of(self) result(threads)
      type(fft_plan), intent(inout) :: self

      threads = 1
      !$ if (self%px*self%py > worth_threads) threads = omp_get_max_threads()
      call fit_buffers(self, threads)
   end function threads_of

   !> What falls to one of some threads
   subroutine share_of_stage(self, stage, t, threads, n, fields, products, xx, yy, xy, factor)
      type(fft_plan), intent(inout) :: self
      !> Stage 1: rows forward, 2: columns, 3: rows back
      integer, intent(in) :: stage, t, threads, n
      real(wp), intent(in) :: fields(self%mx, n*self%my)
      real(wp), intent(inout) :: products(self%mx, n*self%my)
      real(wp), contiguous, intent(in) :: xx(:, :)
      real(wp), contiguous, intent(in), optional :: yy(:, :), xy(:, :)
      complex(wp), contiguous, intent(in), optional :: factor(:)
      integer :: first, last

      if (stage == 2) then
         call find_share(self%kx, size(self%column, 2), t, threads, first, last)
         if (self%py > 1) then
            call multiply_columns(self, t, first, last, n, xx, yy, xy, factor)
         else if (t == 1) then
            call multiply_one(self%kx, xx, self%half)
         end if
         return
      end if
      call find_share(n*self%my, 2*size(self%row, 2), t, threads, first, last)
      if (stage == 1) call rows_forward(self, t, first, last, n*self%my, fields, self%half)
      if (stage == 3) call rows_backward(self, t, first, last, n*self%my, self%half, products)
   end subroutine share_of_stage

   !> Lines of a thread, in whole blocks that are transformed together
   pure subroutine find_share(lines, block_size, t, threads, first, last)
      integer, intent(in) :: lines, block_size, t, threads
      integer, intent(out) :: first, last
      integer :: blocks

      blocks = (lines + block_size - 1)/block_size
      first = 1 + block_size*((t - 1)*blocks/threads)
      last = min(lines, block_size*(t*blocks/threads))
   end subroutine find_share

   !> Transform columns first to last, multiply, and transform back
   subroutine multiply_columns(self, t, first, last, n, xx, yy, xy, factor)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: t, first, last, n
      real(wp), contiguous, intent(in) :: xx(:, :)
      real(wp), contiguous, intent(in), optional :: yy(:, :), xy(:, :)
      complex(wp), contiguous, intent(in), optional :: factor(:)
      integer :: f, k, l

      do k = first, last, size(self%column, 2)
         do f = 1, n
            call columns_forward(self, t, k, f, n, self%half)
         end do
         do l = k, min(k + size(self%column, 2) - 1, last)
            associate (a => self%column(:, l - k + 1, 2, t), b => self%column(:, l - k + 1, 3, t))
               if (n == 1) then
                  call multiply_one(self%py, xx(:, l), a)
               else if (present(factor)) then
                  call multiply_block(self%py, xx(:, l), yy(:, l), xy(:, l), factor(l), a, b)
               else
                  call multiply_block(self%py, xx(:, l), yy(:, l), xy(:, l), a=a, b=b)
               end if
            end associate
         end do
         do f = 1, n
            call columns_backward(self, t, k, f, n, self%half)
         end do
      end do
   end subroutine multiply_columns

   !> Product of two fields on a window of one row: their transform need not be separated
   subroutine multiply_lines(self, fields, products, xx, yy, xy, factor)
      type(fft_plan), intent(inout) :: self
      real(wp), intent(in) :: fields(self%mx, 2)
      real(wp), intent(inout) :: products(self%mx, 2)
      real(wp), contiguous, intent(in) :: xx(:, :), yy(:, :), xy(:, :)
      complex(wp), contiguous, intent(in), optional :: factor(:)
      integer :: ix

      associate (row => self%row(:, 1, 1, 1), done => self%row(:, 1, 2, 1), back => self%row(:, 1, 3, 1))
         do ix = 1, self%mx
            row(ix) = cmplx(fields(ix, 1), fields(ix, 2), wp)
         end do
         call execute_complex(self%rows%plan(line_forward), row, done)
         call multiply_two(self%px, xx, yy, xy, done)
         if (present(factor)) call turn_two(self%px, factor, done)
         call execute_complex(self%rows%plan(line_backward), done, back)
         do ix = 1, self%mx
            products(ix, 1) = back(ix)%re
            products(ix, 2) = back(ix)%im
         end do
      end associate
   end subroutine multiply_lines

   !> Transform rows first to last, two at once
   subroutine rows_forward(self, t, first, last, rows, field, half)
      type(fft_plan), intent(inout) :: self
      !> Thread
      integer, intent(in) :: t
      !> The first is odd; number of all rows
      integer, intent(in) :: first, last, rows
      real(wp), intent(in) :: field(self%mx, rows)
      !> Rows after their transform
      complex(wp), intent(inout) :: half(rows, self%kx)
      integer :: iy, jy, ix, l

      associate (row => self%row(:, :, 1, t))
         do iy = first, last, 2*size(row, 2)
            do l = 1, size(row, 2)
               jy = iy + 2*(l - 1)
               if (jy < rows) then
                  do ix = 1, self%mx
                     row(ix, l) = cmplx(0.5_wp*field(ix, jy), 0.5_wp*field(ix, jy + 1), wp)
                  end do
               else
                  ! an odd last row has no partner
                  row(:self%mx, l) = 0.0_wp
                  if (jy == rows) row(:self%mx, l)%re = 0.5_wp*field(:, jy)
               end if
            end do
            call execute_complex(self%rows%plan(line_forward), row, self%row(:, :, 2, t))
            do l = 1, size(row, 2)
               jy = iy + 2*(l - 1)
               if (jy <= rows) call separate_rows(self%px, self%row(:, l, 2, t), rows, jy, half)
            end do
         end do
      end associate
   end subroutine rows_forward

   !> Transform rows first to last back, two at once
   subroutine rows_backward(self, t, first, last, rows, half, field)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: t, first, last, rows
      complex(wp), intent(in) :: half(rows, self%kx)
      real(wp), intent(inout) :: field(self%mx, rows)
      integer :: iy, jy, ix, l

      associate (row => self%row(:, :, 3, t))
         do iy = first, last, 2*size(row, 2)
            do l = 1, size(row, 2)
               jy = iy + 2*(l - 1)
               if (jy <= rows) call put_together(self%px, rows, jy, half, self%row(:, l, 2, t))
            end do
            call execute_complex(self%rows%plan(line_backward), self%row(:, :, 2, t), row)
            do l = 1, size(row, 2)
               jy = iy + 2*(l - 1)
               if (jy > rows) exit
               do ix = 1, self%mx
                  field(ix, jy) = row(ix, l)%re
               end do
               if (jy == rows) exit
               do ix = 1, self%mx
                  field(ix, jy + 1) = row(ix, l)%im
               end do
            end do
         end do
      end associate
   end subroutine rows_backward

   !> Transform the columns of the block that starts at k, of field f of n
   subroutine columns_forward(self, t, k, f, n, half)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: t, k, f, n
      complex(wp), intent(in) :: half(self%my, n, self%kx)
      integer :: l

      do l = k, min(k + size(self%column, 2) - 1, self%kx)
         call copy(self%my, half(:, f, l), self%column(:, l - k + 1, 1, t))
      end do
      call execute_complex(self%columns%plan(line_forward), self%column(:, :, 1, t), self%column(:, :, 1 + f, t))
   end subroutine columns_forward

   !> Transform the columns back
   subroutine columns_backward(self, t, k, f, n, half)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: t, k, f, n
      complex(wp), intent(inout) :: half(self%my, n, self%kx)
      integer :: l

      call execute_complex(self%columns%plan(line_backward), self%column(:, :, 1 + f, t), self%column(:, :, 4, t))
      do l = k, min(k + size(self%column, 2) - 1, self%kx)
         call copy(self%my, self%column(:, l - k + 1, 4, t), half(:, f, l))
      end do
   end subroutine columns_backward

   !> Spectrum of a full period of real values
   subroutine kernel_spectrum(period, spectrum)
      !> One period, shape (px, py)
      real(wp), contiguous, intent(in) :: period(:, :)
      !> Spectrum, shape (py, px/2 + 1)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      type(fft_plan) :: plan

      call plan%prepare(size(period, 1), size(period, 2), size(period, 1), size(period, 2))
      call plan%forward(period, spectrum)
      call plan%release()
   end subroutine kernel_spectrum

   subroutine release_plan(self)
      class(fft_plan), intent(inout) :: self

      call self%rows%release()
      call self%columns%release()
      self%mx = 0
      if (allocated(self%half)) deallocate(self%half, self%row, self%column)
   end subroutine release_plan
end module contact_fft_plan
