!> Products of two real fields on a small window with kernels: both fields in one complex transform, padded with zeros
!>
!> With X = F(a + i b), s and d half the sum and half the difference of the spectra xx and yy, the product with a symmetric block
!> of kernels is s X(k) + (d + i xy) conj(X(-k)). Columns of opposite frequencies are therefore transformed together; the spectrum
!> is not stored. The loops are in pair_bodies.h, the transforms are those of contact_fft_four_lines.
module contact_fft_paired
   use, intrinsic :: iso_c_binding, only : c_double, c_double_complex, c_int
   use contact_base_kinds, only : wp
   use contact_fft_four_lines, only : columns_at_once, line_factors, line_steps, work_size
   implicit none (type, external)
   private

   public :: paired_plan

   !> Tables and buffers for one window size
   type :: paired_plan
      !> Size of the window and of the padded window; px is even
      integer :: mx = 0, my = 0, px = 0, py = 0
      !> Steps of the transforms of rows and columns
      type(line_factors), private :: rows, columns
      !> Where the transform of a row has the frequencies of the columns, from 0: of four columns, then of their opposites; the last
      !> four are completed by the two columns that are their own opposites, and by -1
      integer(c_int), allocatable, private :: places(:)
      !> Rows after their transform, four columns at once, and workspace
      real(wp), allocatable, private :: half(:), work(:)
   contains
      !> Prepare for a window; tables of the same size are kept
      procedure :: prepare
      !> Product with a symmetric block of kernels
      procedure :: convolve
      !> Product of both fields with one kernel
      procedure :: convolve_even
      !> Free the tables
      procedure :: release
   end type paired_plan

   interface
      !> Product of two fields with a kernel, or with a block of them
      subroutine four_pair(x_steps, x_positions, x_factors, y_steps, y_positions, y_factors, places, mx, my, ahead, mean, &
         & difference, mixed, fields, products, half, work) bind(c, name="contact_four_pair")
         import :: c_double, c_double_complex, c_int, line_steps
         implicit none (type, external)
         !> Steps of the transforms along x and y, positions of the frequencies, and factors between the steps
         type(line_steps), intent(in) :: x_steps
         integer(c_int), intent(in) :: x_positions(*)
         complex(c_double_complex), intent(in) :: x_factors(*)
         type(line_steps), intent(in) :: y_steps
         integer(c_int), intent(in) :: y_positions(*)
         complex(c_double_complex), intent(in) :: y_factors(*)
         !> See paired_plan
         integer(c_int), intent(in) :: places(*)
         !> Size of the window, and +1, -1: differences with the next or previous column are transformed, 0: the fields
         integer(c_int), value :: mx, my, ahead
         !> s, d and xy, shape (py, px/2 + 1); absent: s is the kernel, even
         real(c_double), intent(in) :: mean(*)
         real(c_double), intent(in), optional :: difference(*), mixed(*)
         !> Shape (mx, my, 2)
         real(c_double), intent(in) :: fields(*)
         !> The same shape
         real(c_double), intent(inout) :: products(*)
         !> See paired_plan
         real(c_double), intent(inout) :: half(*), work(*)
      end subroutine four_pair
   end interface

contains

   subroutine prepare(self, mx, my, px, py)
      class(paired_plan), intent(inout) :: self
      !> Window and padded window; px >= mx, py >= my, px even
      integer, intent(in) :: mx, my, px, py

      if (self%mx == mx .and. self%my == my .and. self%px == px .and. self%py == py) return
      call self%release()
      self%mx = mx
      self%my = my
      self%px = px
      self%py = py
      call self%rows%prepare(px)
      call self%columns%prepare(py)
      call find_places(self)
      allocate(self%half(2*size(self%places)*columns_at_once*((my + columns_at_once - 1)/columns_at_once)))
      allocate(self%work(work_size(max(px, py))))
   end subroutine prepare

   !> Order of the columns
   subroutine find_places(self)
      type(paired_plan), intent(inout) :: self
      integer :: at, k, pairs

      pairs = self%px/2 - 1
      allocate(self%places(0:2*columns_at_once*(pairs/columns_at_once + 1) - 1))
      self%places = -1
      do k = 1, pairs + 1
         at = 2*columns_at_once*((k - 1)/columns_at_once) + mod(k - 1, columns_at_once)
         ! after the pairs the columns of frequencies 0 and px/2
         self%places(at) = self%rows%positions(merge(k, 0, k <= pairs))
         self%places(at + columns_at_once) = self%rows%positions(self%px - k)
      end do
   end subroutine find_places

   subroutine convolve(self, mean, difference, mixed, fields, products, ahead)
      class(paired_plan), intent(inout) :: self
      !> Spectra s, d, even in both coordinates, and xy, odd in both, shape (py, px/2 + 1)
      real(wp), contiguous, intent(in) :: mean(:, :), difference(:, :), mixed(:, :)
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: fields(:, :, :)
      !> Unscaled, the same shape
      real(wp), contiguous, intent(inout) :: products(:, :, :)
      !> +1, -1: multiply the differences with the next or previous column; the padding exceeds one column. 0: the fields
      integer, intent(in) :: ahead

      call four_pair(self%rows%steps, self%rows%positions, self%rows%factors, self%columns%steps, self%columns%positions, &
         & self%columns%factors, self%places, self%mx, self%my, ahead, mean, difference, mixed, fields, products, self%half, &
         & self%work)
   end subroutine convolve

   subroutine convolve_even(self, kernel, fields, products)
      class(paired_plan), intent(inout) :: self
      !> Spectrum, even in both coordinates, shape (py, px/2 + 1)
      real(wp), contiguous, intent(in) :: kernel(:, :)
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: fields(:, :, :)
      !> Unscaled, the same shape
      real(wp), contiguous, intent(inout) :: products(:, :, :)

      call four_pair(self%rows%steps, self%rows%positions, self%rows%factors, self%columns%steps, self%columns%positions, &
         & self%columns%factors, self%places, self%mx, self%my, 0, mean=kernel, fields=fields, products=products, &
         & half=self%half, work=self%work)
   end subroutine convolve_even

   subroutine release(self)
      class(paired_plan), intent(inout) :: self

      call self%rows%release()
      call self%columns%release()
      self%mx = 0
      if (allocated(self%places)) deallocate(self%places, self%half, self%work)
   end subroutine release
end module contact_fft_paired
