!> Zero-padded transforms of two real fields at once, as real and imaginary part of one complex field
!>
!> For windows that fit into the caches this takes about half the time of two real transforms, as FFTW has vector code for
!> complex transforms only. Both passes go from one array to another, so that nothing is copied and the padding of the forward
!> arrays remains zero. Rows are transformed in small groups that fill a vector register, so that a plan serves any number of rows.
module contact_fft_paired
   use, intrinsic :: iso_c_binding, only : c_associated
   use contact_base_kinds, only : wp
   use contact_fft_library, only : backwards, execute_complex, forwards, lanes, plan_complex
   use contact_fft_kept_plans, only : line_backward, line_forward, plan_kind, plan_set
   implicit none (type, external)
   private

   public :: paired_plan

   !> Number of rows that are transformed together
   integer, parameter :: together = max(2, lanes)

   !> Plans and buffers for one window size; must not be copied, see fft_plan
   type :: paired_plan
      !> Size of the window and of the padded window
      integer :: mx = 0, my = 0, px = 0, py = 0
      !> Rows of the window, padded in x, for the forward and the backward transform, shape (px, my rounded up to a multiple of
      !> `together`)
      complex(wp), allocatable, private :: rows(:, :), rows_back(:, :)
      !> Spectrum of the first field + i times the second, shape (py, px)
      complex(wp), allocatable :: spectrum(:, :)
      !> Rows after the transform in x, transposed and padded in y, shape (py rounded up to a multiple of `together`, px)
      complex(wp), allocatable, private :: columns(:, :), columns_back(:, :)
      !> For `together` rows, and for all columns; neither depends on the number of rows of the window
      type(plan_set), private :: row_plans, column_plans
   contains
      !> Make plans for a window; existing plans of the same size are kept
      procedure :: prepare
      !> Transform two fields to the spectrum
      procedure :: forward
      !> Transform the spectrum back, unscaled, and cut out the window
      procedure :: backward
      !> Free the plans
      procedure :: release
   end type paired_plan

contains

   subroutine prepare(self, mx, my, px, py)
      class(paired_plan), intent(inout) :: self
      !> Window and padded window; px >= mx, py >= my
      integer, intent(in) :: mx, my, px, py
      integer :: rows, length

      if (self%mx == mx .and. self%my == my .and. self%px == px .and. self%py == py &
         & .and. c_associated(self%row_plans%plan(line_forward))) return
      call self%release()
      self%mx = mx
      self%my = my
      self%px = px
      self%py = py
      rows = in_groups(my)
      length = in_groups(py)
      allocate(self%rows(px, rows), self%columns(length, px), source=(0.0_wp, 0.0_wp))
      allocate(self%rows_back(px, rows), self%columns_back(length, px), self%spectrum(py, px))
      ! read by the last group, without effect
      self%columns_back(py + 1:, :) = 0.0_wp
      ! the planner of FFTW is not thread-safe; estimated plans make results reproducible
      !$omp critical (contact_fft_planner)
      call self%row_plans%take(plan_kind%paired_rows, together, px, py)
      if (.not. self%row_plans%is_kept) then
         self%row_plans%plan = [plan_complex(px, together, self%rows, 1, px, self%columns, length, 1, forwards), &
            & plan_complex(px, together, self%columns_back, length, 1, self%rows_back, 1, px, backwards)]
         call self%row_plans%keep(plan_kind%paired_rows, together, px, py)
      end if
      call self%column_plans%take(plan_kind%paired_columns, 0, px, py)
      if (.not. self%column_plans%is_kept) then
         self%column_plans%plan = [plan_complex(py, px, self%columns, 1, length, self%spectrum, 1, py, forwards), &
            & plan_complex(py, px, self%spectrum, 1, py, self%columns_back, 1, length, backwards)]
         call self%column_plans%keep(plan_kind%paired_columns, 0, px, py)
      end if
      !$omp end critical (contact_fft_planner)
   end subroutine prepare

   !> Number of lines, rounded up to whole groups
   pure integer function in_groups(lines)
      integer, intent(in) :: lines

      in_groups = together*((lines + together - 1)/together)
   end function in_groups

   subroutine forward(self, fields, ahead)
      class(paired_plan), intent(inout) :: self
      !> Two fields on the window, shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: fields(:, :, :)
      !> +1, -1: transform the differences with the next or previous column; the padding exceeds one column
      integer, intent(in), optional :: ahead
      complex(wp) :: previous, here
      integer :: ix, iy

      do iy = 1, self%my
         do ix = 1, self%mx
            self%rows(ix, iy) = cmplx(fields(ix, iy, 1), fields(ix, iy, 2), wp)
         end do
         self%rows(self%mx + 1, iy) = 0.0_wp
         self%rows(self%px, iy) = 0.0_wp
         if (.not. present(ahead)) cycle
         if (ahead > 0) then
            self%rows(self%px, iy) = -self%rows(1, iy)
            do ix = 1, self%mx
               self%rows(ix, iy) = self%rows(ix, iy) - self%rows(ix + 1, iy)
            end do
         else
            previous = 0.0_wp
            do ix = 1, self%mx + 1
               here = self%rows(ix, iy)
               self%rows(ix, iy) = here - previous
               previous = here
            end do
         end if
      end do
      do iy = 1, self%my, together
         call execute_complex(self%row_plans%plan(line_forward), self%rows(1, iy), self%columns(iy, 1))
      end do
      call execute_complex(self%column_plans%plan(line_forward), self%columns, self%spectrum)
   end subroutine forward

   subroutine backward(self, fields)
      class(paired_plan), intent(inout) :: self
      !> Real and imaginary part on the window, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: fields(:, :, :)
      integer :: ix, iy

      call execute_complex(self%column_plans%plan(line_backward), self%spectrum, self%columns_back)
      do iy = 1, self%my, together
         call execute_complex(self%row_plans%plan(line_backward), self%columns_back(iy, 1), self%rows_back(1, iy))
      end do
      do iy = 1, self%my
         do ix = 1, self%mx
            fields(ix, iy, 1) = real(self%rows_back(ix, iy))
            fields(ix, iy, 2) = aimag(self%rows_back(ix, iy))
         end do
      end do
   end subroutine backward

   subroutine release(self)
      class(paired_plan), intent(inout) :: self

      call self%row_plans%release()
      call self%column_plans%release()
      self%mx = 0
      if (allocated(self%rows)) deallocate(self%rows, self%rows_back, self%columns, self%columns_back, self%spectrum)
   end subroutine release
end module contact_fft_paired
