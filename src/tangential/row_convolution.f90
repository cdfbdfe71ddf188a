!> Displacements of one row due to the loads of all rows, by transforms along the rows
!>
!> The spectra of the loads are kept and updated when a row has been processed, so that a row requires one transform of length 2
!> mx.
module contact_tangential_row_convolution
   use contact_base_kinds, only : wp
   use contact_elastic_halfspace, only : kernel_table
   use contact_fft_plan, only : fft_plan, good_size
   implicit none (type, external)
   private

   public :: row_convolution

   type :: row_convolution
      integer, private :: mx = 0, my = 0
      !> Number of rows of displacements computed so far
      integer :: rows = 0
      type(fft_plan), private :: plan
      !> Spectra by row distance, shape (kx, 0:my - 1); xy: imaginary part
      real(wp), allocatable, private :: axx(:, :), ayy(:, :), axy(:, :)
      !> Spectra of a shifted table, shape (kx, 1 - my:my - 1); unallocated without one
      complex(wp), allocatable, private :: gxx(:, :), gyy(:, :), gxy(:, :)
      !> Spectra of the loads, real and imaginary part, shape (kx, 2, my)
      real(wp), allocatable, private :: load_re(:, :, :), load_im(:, :, :)
      real(wp), allocatable, private :: sum_re(:, :), sum_im(:, :), field(:, :)
      complex(wp), allocatable, private :: spectrum(:, :)
      !> Rows with loads: rows without contact are skipped
      logical, allocatable, private :: loaded(:)
   contains
      procedure :: prepare
      procedure :: release
      !> Set the loads of a row
      procedure :: set_row
      !> Displacements of a row
      procedure :: displace
   end type row_convolution

contains

   !> Spectra of the coefficients
   subroutine prepare(self, table, mx, my, direction, shifted)
      class(row_convolution), intent(inout) :: self
      !> Influence coefficients [mm/(N/mm2)]
      type(kernel_table), intent(in) :: table
      !> Columns and rows of the window
      integer, intent(in) :: mx, my
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Coefficients to subtract, of the same particles at the previous time
      type(kernel_table), intent(in), optional :: shifted
      type(fft_plan) :: whole_period
      integer :: l, px
      real(wp) :: scale

      self%mx = mx
      self%my = my
      self%rows = 0
      px = good_size(2*(mx + 1))
      call self%plan%prepare(mx + 1, 1, px, 1)
      call whole_period%prepare(px, 1, px, 1)
      call allocate_spectra(self, present(shifted))
      scale = 1.0_wp/px
      do l = 0, my - 1
         call row_spectrum(table%xx(-mx:mx, l))
         self%axx(:, l) = scale*real(self%spectrum(1, :))
         call row_spectrum(table%yy(-mx:mx, l))
         self%ayy(:, l) = scale*real(self%spectrum(1, :))
         call row_spectrum(table%xy(-mx:mx, l))
         self%axy(:, l) = scale*aimag(self%spectrum(1, :))
      end do
      if (present(shifted)) then
         do l = 1 - my, my - 1
            call row_spectrum(table%xx(-mx:mx, l) - shifted%xx(-mx:mx, l), mirror=1.0_wp)
            self%gxx(:, l) = scale*self%spectrum(1, :)
            call row_spectrum(table%yy(-mx:mx, l) - shifted%yy(-mx:mx, l), mirror=1.0_wp)
            self%gyy(:, l) = scale*self%spectrum(1, :)
            call row_spectrum(table%xy(-mx:mx, l) - shifted%xy(-mx:mx, l), mirror=-1.0_wp)
            self%gxy(:, l) = scale*self%spectrum(1, :)
         end do
      end if
      call whole_period%release()

   contains

      !> Spectrum of the coefficients for one row distance; with mirror: reversed, with this sign, for rolling towards
      !> decreasing x
      subroutine row_spectrum(c, mirror)
         real(wp), intent(in) :: c(-mx:mx)
         real(wp), intent(in), optional :: mirror
         real(wp) :: period(px, 1)
         integer :: k

         period = 0.0_wp
         do k = -mx, mx
            period(1 + modulo(k, px), 1) = c(k)
         end do
         if (present(mirror)) then
            if (direction < 0) then
               do k = -mx, mx
                  period(1 + modulo(-k, px), 1) = mirror*c(k)
               end do
            end if
         end if
         call whole_period%forward(period, self%spectrum)
      end subroutine row_spectrum
   end subroutine prepare

   subroutine allocate_spectra(self, general)
      class(row_convolution), intent(inout) :: self
      !> Also allocate those for a shifted table?
      logical, intent(in) :: general
      integer :: kx

      kx = self%plan%kx
      if (allocated(self%axx)) deallocate(self%axx, self%ayy, self%axy, self%load_re, self%load_im, &
         & self%sum_re, self%sum_im, self%field, self%spectrum, self%loaded)
      if (allocated(self%gxx)) deallocate(self%gxx, self%gyy, self%gxy)
      associate (my => self%my)
         allocate(self%axx(kx, 0:my - 1), self%ayy(kx, 0:my - 1), self%axy(kx, 0:my - 1))
         allocate(self%load_re(kx, 2, my), self%load_im(kx, 2, my), source=0.0_wp)
         allocate(self%sum_re(kx, 2), self%sum_im(kx, 2), self%field(self%mx + 1, 1))
         allocate(self%spectrum(1, kx), self%loaded(my))
         if (general) allocate(self%gxx(kx, 1 - my:my - 1), self%gyy(kx, 1 - my:my - 1), &
            & self%gxy(kx, 1 - my:my - 1))
      end associate
      self%loaded = .false.
   end subroutine allocate_spectra

   !> Free the plan
   subroutine release(self)
      class(row_convolution), intent(inout) :: self
      call self%plan%release()
   end subroutine release

   !> Set the loads of a row
   subroutine set_row(self, iy, load, loaded)
      class(row_convolution), intent(inout) :: self
      !> Row
      integer, intent(in) :: iy
      !> Tractions or increments [N/mm2], shape (0:mx, 2): column 0 is behind the window
      real(wp), intent(in) :: load(:, :)
      !> Are there elements in contact in the row? Otherwise it is skipped
      logical, intent(in) :: loaded
      integer :: k

      self%loaded(iy) = loaded
      if (.not. loaded) return
      do k = 1, 2
         self%field(:, 1) = load(:, k)
         call self%plan%forward(self%field, self%spectrum)
         self%load_re(:, k, iy) = real(self%spectrum(1, :))
         self%load_im(:, k, iy) = aimag(self%spectrum(1, :))
      end do
   end subroutine set_row

   !> Displacements of a row due to the loads of all rows
   subroutine displace(self, iy, u)
      class(row_convolution), intent(inout) :: self
      !> Row
      integer, intent(in) :: iy
      !> Displacements [mm], shape (mx, 2)
      real(wp), intent(out) :: u(:, :)
      integer :: l, k
      real(wp) :: sign_

      self%sum_re = 0.0_wp
      self%sum_im = 0.0_wp
      do l = 1, self%my
         if (.not. self%loaded(l)) cycle
         if (allocated(self%gxx)) then
            call add_general(self%gxx(:, iy - l), self%gyy(:, iy - l), self%gxy(:, iy - l), &
               & self%load_re(:, :, l), self%load_im(:, :, l), self%sum_re, self%sum_im)
         else
            ! the coefficients xy change sign with the row distance
            sign_ = sign(1.0_wp, real(iy - l, wp))
            call add_even(self%axx(:, abs(iy - l)), self%ayy(:, abs(iy - l)), self%axy(:, abs(iy - l)), &
               & sign_, self%load_re(:, :, l), self%load_im(:, :, l), self%sum_re, self%sum_im)
         end if
      end do
      do k = 1, 2
         self%spectrum(1, :) = cmplx(self%sum_re(:, k), self%sum_im(:, k), wp)
         call self%plan%backward(self%spectrum, self%field)
         u(:, k) = self%field(2:, 1)
      end do
      self%rows = self%rows + 1
   end subroutine displace

   !> Add the displacements due to one row to the sums; real spectra xx, yy, imaginary spectrum xy
   pure subroutine add_even(axx, ayy, axy, sign_, re, im, sum_re, sum_im)
      real(wp), contiguous, intent(in) :: axx(:), ayy(:), axy(:)
      real(wp), intent(in) :: sign_
      real(wp), contiguous, intent(in) :: re(:, :), im(:, :)
      real(wp), contiguous, intent(inout) :: sum_re(:, :), sum_im(:, :)
      integer :: k

      do k = 1, size(axx)
         sum_re(k, 1) = sum_re(k, 1) + axx(k)*re(k, 1) - sign_*axy(k)*im(k, 2)
         sum_im(k, 1) = sum_im(k, 1) + axx(k)*im(k, 1) + sign_*axy(k)*re(k, 2)
         sum_re(k, 2) = sum_re(k, 2) + ayy(k)*re(k, 2) - sign_*axy(k)*im(k, 1)
         sum_im(k, 2) = sum_im(k, 2) + ayy(k)*im(k, 2) + sign_*axy(k)*re(k, 1)
      end do
   end subroutine add_even

   !> The same for complex spectra
   pure subroutine add_general(gxx, gyy, gxy, re, im, sum_re, sum_im)
      complex(wp), contiguous, intent(in) :: gxx(:), gyy(:), gxy(:)
      real(wp), contiguous, intent(in) :: re(:, :), im(:, :)
      real(wp), contiguous, intent(inout) :: sum_re(:, :), sum_im(:, :)
      complex(wp) :: a, b, u
      integer :: k

      do k = 1, size(gxx)
         a = cmplx(re(k, 1), im(k, 1), wp)
         b = cmplx(re(k, 2), im(k, 2), wp)
         u = gxx(k)*a + gxy(k)*b
         sum_re(k, 1) = sum_re(k, 1) + real(u)
         sum_im(k, 1) = sum_im(k, 1) + aimag(u)
         u = gxy(k)*a + gyy(k)*b
         sum_re(k, 2) = sum_re(k, 2) + real(u)
         sum_im(k, 2) = sum_im(k, 2) + aimag(u)
      end do
   end subroutine add_general
end module contact_tangential_row_convolution
