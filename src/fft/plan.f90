!> Zero-padded real transforms of a rectangular window, and convolutions based on them
!>
!> Two rows are transformed at once, as real and imaginary part of a complex row, and four such lines together. Zero rows are not
!> transformed forward, and rows that are not needed are not transformed back. A convolution processes the spectrum four columns at
!> a time (transform, multiply by the kernel, transform back), so that the complete spectrum is never stored. Results do not depend
!> on the number of threads. A window of one row is transformed by the library, and both fields of a pair at once.
module contact_fft_plan
   use contact_base_kinds, only : wp
   use contact_fft_four_lines, only : columns_at_once, four_columns_backward, four_columns_forward, four_columns_one, &
      & four_columns_two, four_rows_backward, four_rows_forward, line_factors, rows_at_once, work_size
   use contact_fft_lines, only : multiply_one
   use contact_fft_one_row, only : one_row
   use contact_fft_sizes, only : fast_line_size, fast_size, good_size, largest_fast_size
   !$ use omp_lib, only : omp_get_active_level, omp_get_max_active_levels, omp_get_max_threads
   implicit none (type, external)
   private

   public :: fft_plan, kernel_spectrum, good_size, fast_line_size, fast_size, largest_fast_size

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
      !> Rows of one or two fields after their transform, space for (4, my, 2, (kx + 3)/4), in the arrangement of four_lines
      complex(wp), allocatable, private :: half(:)
      !> Steps of the transforms of rows and columns, and their workspace, one column per thread
      type(line_factors), private :: rows, columns
      real(wp), allocatable, private :: work(:, :)
      !> A window of one row
      type(one_row), private :: row
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
      !> Is the padded window so large that threads share its lines?
      procedure :: is_shared
      !> Free the plans
      procedure :: release => release_plan
   end type fft_plan

contains

   subroutine prepare_plan(self, mx, my, px, py)
      class(fft_plan), intent(inout) :: self
      !> Window and padded window; px even or 1, px >= mx, py >= my
      integer, intent(in) :: mx, my, px, py

      if (self%mx == mx .and. self%my == my .and. self%px == px .and. self%py == py .and. allocated(self%half)) return
      call clear(self)
      self%mx = mx
      self%my = my
      self%px = px
      self%py = py
      self%kx = px/2 + 1
      if (py == 1) then
         allocate(self%half(2*self%kx))
         call self%row%prepare(mx, px)
         return
      end if
      allocate(self%half(2*my*columns_at_once*blocks_of_columns(self)))
      call self%rows%prepare(px)
      call self%columns%prepare(py)
      call fit_workspace(self, 1)
   end subroutine prepare_plan

   !> Number of blocks of four frequencies in x
   pure integer function blocks_of_columns(self) result(blocks)
      type(fft_plan), intent(in) :: self

      blocks = (self%kx + columns_at_once - 1)/columns_at_once
   end function blocks_of_columns

   !> Allocate workspace for a number of threads
   subroutine fit_workspace(self, threads)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: threads

      if (allocated(self%work)) then
         if (size(self%work, 2) >= threads) return
         deallocate(self%work)
      end if
      allocate(self%work(work_size(max(self%px, self%py)), threads))
   end subroutine fit_workspace

   subroutine transform_forward(self, field, spectrum)
      class(fft_plan), intent(inout) :: self
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)
      !> Spectrum, shape (py, kx)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      integer :: stage, t, threads

      if (self%py == 1) then
         call self%row%forward(field, spectrum)
         return
      end if
      threads = threads_of(self)
      do stage = 1, 2
         if (threads == 1) then
            call share_of_forward(self, stage, 1, 1, field, spectrum)
         else
            !$omp parallel do num_threads(threads) schedule(static, 1)
            do t = 1, threads
               call share_of_forward(self, stage, t, threads, field, spectrum)
            end do
            !$omp end parallel do
         end if
      end do
   end subroutine transform_forward

   !> What falls to one of some threads
   subroutine share_of_forward(self, stage, t, threads, field, spectrum)
      type(fft_plan), intent(inout) :: self
      !> 1: rows, 2: columns
      integer, intent(in) :: stage, t, threads
      real(wp), contiguous, intent(in) :: field(:, :)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      integer :: first, k, last

      if (stage == 1) then
         call find_share(self%my, rows_at_once, t, threads, first, last)
         call transform_rows(self, t, first, last, self%my, field, self%half)
         return
      end if
      call find_share(self%kx, columns_at_once, t, threads, first, last)
      do k = first, last, columns_at_once
         call transform_columns(self, t, k, self%half, spectrum(:, k:))
      end do
   end subroutine share_of_forward

   subroutine transform_backward(self, spectrum, field)
      class(fft_plan), intent(inout) :: self
      !> Spectrum, shape (py, kx)
      complex(wp), contiguous, intent(in) :: spectrum(:, :)
      !> Window, shape (mx, my)
      real(wp), contiguous, intent(inout) :: field(:, :)
      integer :: stage, t, threads

      if (self%py == 1) then
         call self%row%backward(spectrum, field)
         return
      end if
      threads = threads_of(self)
      do stage = 1, 2
         if (threads == 1) then
            call share_of_backward(self, stage, 1, 1, spectrum, field)
         else
            !$omp parallel do num_threads(threads) schedule(static, 1)
            do t = 1, threads
               call share_of_backward(self, stage, t, threads, spectrum, field)
            end do
            !$omp end parallel do
         end if
      end do
   end subroutine transform_backward

   !> What falls to one of some threads
   subroutine share_of_backward(self, stage, t, threads, spectrum, field)
      type(fft_plan), intent(inout) :: self
      !> 1: columns, 2: rows
      integer, intent(in) :: stage, t, threads
      complex(wp), contiguous, intent(in) :: spectrum(:, :)
      real(wp), contiguous, intent(inout) :: field(:, :)
      integer :: first, k, last

      if (stage == 2) then
         call find_share(self%my, rows_at_once, t, threads, first, last)
         call transform_rows_back(self, t, first, last, self%my, self%half, field)
         return
      end if
      call find_share(self%kx, columns_at_once, t, threads, first, last)
      do k = first, last, columns_at_once
         call four_columns_backward(self%columns%steps, self%columns%positions, self%columns%factors, self%my, &
            & min(columns_at_once, self%kx + 1 - k), spectrum(:, k), self%half(1 + self%my*(k - 1)), self%work(:, t))
      end do
   end subroutine share_of_backward

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
      complex(wp) :: columns(self%py, columns_at_once)
      integer :: first, k, l, last

      if (self%py == 1) then
         if (t > 1 .or. stage > 1) return
         call self%row%forward(quarter, self%half)
         do k = 1, self%kx
            call fold(1, self%half(k), imaginary, sign_y, spectrum(:, k))
         end do
         return
      end if
      if (stage == 1) then
         call find_share(self%my, rows_at_once, t, threads, first, last)
         call transform_rows(self, t, first, last, self%my, quarter, self%half)
         return
      end if
      call find_share(self%kx, columns_at_once, t, threads, first, last)
      do k = first, last, columns_at_once
         call transform_columns(self, t, k, self%half, columns)
         do l = k, min(k + columns_at_once - 1, last)
            call fold(self%py, columns(:, l - k + 1), imaginary, sign_y, spectrum(:, l))
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

      if (self%py == 1) then
         call self%row%forward(field, self%half)
         call multiply_one(self%kx, kernel, self%half)
         call self%row%backward(self%half, product)
      else
         call make_product(self, 1, field, product, kernel)
      end if
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
         call self%row%multiply(fields, products, xx, yy, xy, factor)
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

   !> Do threads share the lines? Loops over lines have a copy without a directive for one thread: a parallel region, even of one
   !> thread (a false if clause), asks libgomp for memory
   pure logical function is_shared(self)
      class(fft_plan), intent(in) :: self

      is_shared = self%px*self%py > worth_threads
   end function is_shared

   !> Number of threads that share the lines; they have workspace
   integer function threads_of(self) result(threads)
      type(fft_plan), intent(inout) :: self

      threads = 1
      if (self%is_shared()) then
         !$ threads = omp_get_max_threads()
         ! threads that transform fields of their own do not share the lines of one
         !$ if (omp_get_active_level() >= omp_get_max_active_levels()) threads = 1
      end if
      if (self%py > 1) call fit_workspace(self, threads)
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
         call find_share(self%kx, columns_at_once, t, threads, first, last)
         call multiply_columns(self, t, first, last, n, self%half, xx, yy, xy, factor)
         return
      end if
      call find_share(n*self%my, rows_at_once, t, threads, first, last)
      if (stage == 1) call transform_rows(self, t, first, last, n*self%my, fields, self%half)
      if (stage == 3) call transform_rows_back(self, t, first, last, n*self%my, self%half, products)
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
   subroutine multiply_columns(self, t, first, last, n, half, xx, yy, xy, factor)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: t, first, last, n
      !> Rows of all fields after their transform
      complex(wp), intent(inout) :: half(n*self%my, columns_at_once*blocks_of_columns(self))
      real(wp), intent(in) :: xx(self%py, self%kx)
      real(wp), intent(in), optional :: yy(self%py, self%kx), xy(self%py, self%kx)
      complex(wp), intent(in), optional :: factor(self%kx)
      integer :: columns, k

      associate (plan => self%columns)
         do k = first, last, columns_at_once
            columns = min(columns_at_once, last + 1 - k)
            if (n == 1) then
               call four_columns_one(plan%steps, plan%positions, plan%factors, self%my, columns, xx(:, k), half(:, k), &
                  & self%work(:, t))
            else if (present(factor)) then
               call four_columns_two(plan%steps, plan%positions, plan%factors, self%my, columns, xx(:, k), yy(:, k), &
                  & xy(:, k), factor(k:), half(:, k), self%work(:, t))
            else
               call four_columns_two(plan%steps, plan%positions, plan%factors, self%my, columns, xx(:, k), yy(:, k), &
                  & xy(:, k), half=half(:, k), work=self%work(:, t))
            end if
         end do
      end associate
   end subroutine multiply_columns

   !> Transform the columns that start at k
   subroutine transform_columns(self, t, k, half, spectrum)
      type(fft_plan), intent(inout) :: self
      !> Thread
      integer, intent(in) :: t, k
      !> Rows of one field after their transform
      complex(wp), intent(in) :: half(self%my, columns_at_once*blocks_of_columns(self))
      !> Receives these columns
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)

      call four_columns_forward(self%columns%steps, self%columns%positions, self%columns%factors, self%my, &
         & min(columns_at_once, self%kx + 1 - k), half(:, k), spectrum, self%work(:, t))
   end subroutine transform_columns

   !> Transform rows first to last
   subroutine transform_rows(self, t, first, last, rows, field, half)
      type(fft_plan), intent(inout) :: self
      !> Thread
      integer, intent(in) :: t
      !> The first is 1, 9, 17 ...; number of all rows
      integer, intent(in) :: first, last, rows
      real(wp), intent(in) :: field(self%mx, rows)
      !> Rows after their transform
      complex(wp), intent(inout) :: half(columns_at_once, rows, blocks_of_columns(self))
      integer :: iy

      do iy = first, last, rows_at_once
         call four_rows_forward(self%rows%steps, self%rows%positions, self%rows%factors, self%mx, &
            & min(rows_at_once, rows + 1 - iy), rows, field(:, iy), half(1, iy, 1), self%work(:, t))
      end do
   end subroutine transform_rows

   !> Transform rows first to last back
   subroutine transform_rows_back(self, t, first, last, rows, half, field)
      type(fft_plan), intent(inout) :: self
      integer, intent(in) :: t, first, last, rows
      complex(wp), intent(in) :: half(columns_at_once, rows, blocks_of_columns(self))
      real(wp), intent(inout) :: field(self%mx, rows)
      integer :: iy

      do iy = first, last, rows_at_once
         call four_rows_backward(self%rows%steps, self%rows%positions, self%rows%factors, self%mx, &
            & min(rows_at_once, rows + 1 - iy), rows, half(1, iy, 1), field(:, iy), self%work(:, t))
      end do
   end subroutine transform_rows_back

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

      call clear(self)
      call self%rows%release()
      call self%columns%release()
   end subroutine release_plan

   !> Free buffers and plans of the library; tables of the lengths are kept for another window of the same lengths
   subroutine clear(self)
      class(fft_plan), intent(inout) :: self

      call self%row%release()
      self%mx = 0
      if (allocated(self%half)) deallocate(self%half)
      if (allocated(self%work)) deallocate(self%work)
   end subroutine clear
end module contact_fft_plan
