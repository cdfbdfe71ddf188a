!> Transforms of a window of one row, zero-padded, by the library of transforms; both fields of a pair at once
module contact_fft_one_row
   use contact_base_kinds, only : wp
   use contact_fft_kept_plans, only : line_backward, line_forward, plan_set
   use contact_fft_library, only : backwards, execute_complex, forwards, plan_complex
   use contact_fft_lines, only : multiply_two, turn_two
   implicit none (type, external)
   private

   public :: one_row

   !> Plans and buffers for one length; must not be copied, and the owner must call release
   type :: one_row
      !> Elements of the row and of the padded row, and number of frequencies kept
      integer, private :: mx = 0, px = 0, kx = 0
      !> The row padded, transformed, and transformed back, shape (px, 3)
      complex(wp), allocatable, private :: line(:, :)
      type(plan_set), private :: plans
   contains
      !> Make plans for a length
      procedure :: prepare => prepare_row
      !> Transform a row; back, unscaled, from a spectrum that is kept
      procedure :: forward => transform_row
      procedure :: backward => transform_row_back
      !> Product of two fields with a symmetric block
      procedure :: multiply => multiply_rows
      !> Free the plans
      procedure :: release => release_row
   end type one_row

contains

   subroutine prepare_row(self, mx, px)
      class(one_row), intent(inout) :: self
      !> Elements of the row and of the padded row
      integer, intent(in) :: mx, px

      self%mx = mx
      self%px = px
      self%kx = px/2 + 1
      allocate(self%line(px, 3))
      self%line = 0.0_wp
      ! the planner of FFTW is not thread-safe; estimated plans make results reproducible
      !$omp critical (contact_fft_planner)
      call self%plans%take(px)
      if (.not. self%plans%is_kept) then
         self%plans%plan(line_forward) = plan_complex(px, 1, self%line(:, 1), 1, px, self%line(:, 2), 1, px, forwards)
         self%plans%plan(line_backward) = plan_complex(px, 1, self%line(:, 1), 1, px, self%line(:, 2), 1, px, backwards)
         call self%plans%keep(px)
      end if
      !$omp end critical (contact_fft_planner)
   end subroutine prepare_row

   subroutine transform_row(self, field, spectrum)
      class(one_row), intent(inout) :: self
      !> Row, and its spectrum
      real(wp), intent(in) :: field(self%mx)
      !> Shape (kx)
      complex(wp), intent(inout) :: spectrum(self%kx)

      self%line(:self%mx, 1) = field
      call execute_complex(self%plans%plan(line_forward), self%line(:, 1), self%line(:, 2))
      spectrum = self%line(:self%kx, 2)
   end subroutine transform_row

   subroutine transform_row_back(self, spectrum, field)
      class(one_row), intent(inout) :: self
      !> Of real values
      complex(wp), intent(in) :: spectrum(self%kx)
      !> Row
      real(wp), intent(inout) :: field(self%mx)
      integer :: k

      self%line(:self%kx, 2) = spectrum
      do k = 2, (self%px + 1)/2
         self%line(self%px + 2 - k, 2) = conjg(spectrum(k))
      end do
      call execute_complex(self%plans%plan(line_backward), self%line(:, 2), self%line(:, 3))
      field = self%line(:self%mx, 3)%re
   end subroutine transform_row_back

   !> Their transform need not be separated
   subroutine multiply_rows(self, fields, products, xx, yy, xy, factor)
      class(one_row), intent(inout) :: self
      !> Two rows
      real(wp), intent(in) :: fields(self%mx, 2)
      !> Products of the rows and the block
      real(wp), intent(inout) :: products(self%mx, 2)
      !> Spectra of the block, scaled for the back transform, shape (1, kx)
      real(wp), contiguous, intent(in) :: xx(:, :), yy(:, :), xy(:, :)
      !> Additional factor per frequency; absent: 1
      complex(wp), contiguous, intent(in), optional :: factor(:)
      integer :: ix

      associate (row => self%line(:, 1), done => self%line(:, 2), back => self%line(:, 3))
         do ix = 1, self%mx
            row(ix) = cmplx(fields(ix, 1), fields(ix, 2), wp)
         end do
         call execute_complex(self%plans%plan(line_forward), row, done)
         call multiply_two(self%px, xx, yy, xy, done)
         if (present(factor)) call turn_two(self%px, factor, done)
         call execute_complex(self%plans%plan(line_backward), done, back)
         do ix = 1, self%mx
            products(ix, 1) = back(ix)%re
            products(ix, 2) = back(ix)%im
         end do
      end associate
   end subroutine multiply_rows

   subroutine release_row(self)
      class(one_row), intent(inout) :: self

      call self%plans%release()
      if (allocated(self%line)) deallocate(self%line)
   end subroutine release_row
end module contact_fft_one_row
