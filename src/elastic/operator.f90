!> The compliance of two half-spaces on a window of elements: products by fast transforms
!>
!> The one operator that all iterative methods see. Kernels of half-spaces are even or odd in
!> each coordinate, so their spectra are real (nn, xx, yy, xy) or imaginary (xn, yn) and one
!> real array per kernel is kept. In steady rolling the displacement difference between two
!> moments is the same kernel times 1 - exp(i kappa dx): a factor per column of the spectrum.
module contact_elastic_operator
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_elastic_halfspace, only : fill_table
   use contact_elastic_model, only : elastic_model
   use contact_fft_plan, only : fft_plan, good_size
   implicit none (type, external)
   private

   public :: elastic_operator

   !> Holds plans, spectra and scratch; its table reaches to offsets of half the padded window
   type, extends(compliance) :: elastic_operator
      type(fft_plan) :: plan
      !> Spectra over padded size, real parts; xn, yn: imaginary parts [mm/(N/mm2)]
      real(wp), allocatable, private :: nn(:, :), xx(:, :), yy(:, :), xy(:, :), xn(:, :), yn(:, :)
      !> Inverse of the 2 by 2 tangential symbol and of the normal symbol, circulant
      real(wp), allocatable, private :: ixx(:, :), iyy(:, :), ixy(:, :), inn(:, :)
      !> 1 - exp(i direction kappa), shape (kx)
      complex(wp), allocatable, private :: difference(:)
      !> Inverse of the damped difference, shape (kx)
      complex(wp), allocatable, private :: sum_up(:)
      complex(wp), allocatable, private :: s1(:, :), s2(:, :)
      integer, private :: direction = 0
      logical, private :: has_normal = .false., has_tangential = .false., has_coupling = .false.
   contains
      procedure :: prepare
      procedure :: normal
      procedure :: tangential
      procedure :: steady
      procedure :: normal_inverse
      procedure :: tangential_inverse
      procedure :: steady_inverse
      procedure :: normal_by_tangential
      procedure :: tangential_by_normal
      procedure :: steady_by_normal
      procedure :: release
      procedure, private :: make_spectra
      procedure, private :: pair_product
   end type elastic_operator

contains

   subroutine prepare(self, model, dx, dy, mx, my, direction, y_first)
      class(elastic_operator), intent(inout) :: self
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Rolling in direction of increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Lateral position of the centres of the first row [mm]; default 0
      real(wp), intent(in), optional :: y_first
      integer :: px, py, k
      complex(wp) :: turn
      logical :: same
      !> Decay of the preconditioner per element is this over sqrt(mx), chosen by measurement
      real(wp), parameter :: decay = 0.5_wp

      same = self%mx == mx .and. self%my == my .and. self%dx == dx .and. self%dy == dy .and. self%model%same_as(model)
      if (.not. same) then
         ! one element more than a plain product needs: the shifted kernel of steady rolling
         px = good_size(2*mx + 1)
         py = merge(1, good_size(2*my), my == 1)
         call fill_table(self%table, model%material, dx, dy, px/2, py/2)
         self%diagonal = [self%table%nn(0, 0), self%table%xx(0, 0), self%table%yy(0, 0)]
         call self%plan%prepare(mx, my, px, py)
         self%has_normal = .false.
         self%has_tangential = .false.
         self%has_coupling = .false.
         self%direction = 0
         if (allocated(self%s1)) then
            if (any(shape(self%s1) /= [py, px/2 + 1])) deallocate(self%s1, self%s2)
         end if
         if (.not. allocated(self%s1)) allocate(self%s1(py, px/2 + 1), self%s2(py, px/2 + 1))
      end if
      self%mx = mx
      self%my = my
      self%dx = dx
      self%dy = dy
      self%y_first = 0.0_wp
      if (present(y_first)) self%y_first = y_first
      if (.not. same) self%model = model
      if (self%direction /= direction) then
         self%direction = direction
         if (allocated(self%difference)) deallocate(self%difference, self%sum_up)
         allocate(self%difference(self%plan%kx), self%sum_up(self%plan%kx))
         do k = 1, self%plan%kx
            turn = exp(cmplx(0.0_wp, direction*2.0_wp*pi*(k - 1)/self%plan%px, wp))
            self%difference(k) = 1.0_wp - turn
            self%sum_up(k) = 1.0_wp/(1.0_wp - (1.0_wp - min(0.9_wp, decay/sqrt(real(mx, wp))))*turn)
         end do
      end if
   end subroutine prepare

   !> Spectrum of one kernel, scaled for the back transform; even or odd in x and y
   subroutine make_spectra(self, kernel, even, spectrum, inverse)
      class(elastic_operator), intent(inout) :: self
      !> Coefficients, offsets -nx:nx, -ny:ny
      real(wp), intent(in) :: kernel(-self%table%nx:, -self%table%ny:)
      !> Even-even or odd-odd (real spectrum), or else odd in one coordinate (imaginary spectrum)
      logical, intent(in) :: even
      real(wp), allocatable, intent(inout) :: spectrum(:, :)
      !> 1/spectrum, scaled likewise, when asked for
      real(wp), allocatable, intent(inout), optional :: inverse(:, :)
      real(wp), allocatable :: period(:, :)
      complex(wp), allocatable :: transform(:, :)
      integer :: k, l, px, py
      real(wp) :: scale, smallest

      px = self%plan%px
      py = self%plan%py
      allocate(period(px, py), transform(py, self%plan%kx))
      do l = 1, py
         do k = 1, px
            period(k, l) = kernel(wrapped(k, px), wrapped(l, py))
         end do
      end do
      call self%plan%kernel_spectrum(period, transform)
      scale = 1.0_wp/(real(px, wp)*real(py, wp))
      if (allocated(spectrum)) then
         if (any(shape(spectrum) /= shape(transform))) deallocate(spectrum)
      end if
      if (.not. allocated(spectrum)) allocate(spectrum(py, self%plan%kx))
      if (even) then
         spectrum = scale*real(transform)
      else
         spectrum = scale*aimag(transform)
      end if
      if (.not. present(inverse)) return
      if (allocated(inverse)) then
         if (any(shape(inverse) /= shape(transform))) deallocate(inverse)
      end if
      if (.not. allocated(inverse)) allocate(inverse(py, self%plan%kx))
      ! a complete period has a positive spectrum; the floor guards extreme shapes only
      smallest = 1.0e-10_wp*maxval(abs(spectrum))/scale
      inverse = scale/max(spectrum/scale, smallest)
   end subroutine make_spectra

   !> Offset that belongs to position k of a period of length n
   pure integer function wrapped(k, n) result(offset)
      integer, intent(in) :: k, n
      offset = k - 1
      if (offset > n/2) offset = offset - n
   end function wrapped

   !> An odd kernel vanishes at half the period, where offsets +n and -n coincide
   subroutine clear_half_period(self, kernel, in_x, in_y)
      class(elastic_operator), intent(in) :: self
      !> Coefficients, offsets -nx:nx, -ny:ny
      real(wp), intent(inout) :: kernel(-self%table%nx:, -self%table%ny:)
      !> Coordinates in which the kernel is odd
      logical, intent(in) :: in_x, in_y
      integer :: hx, hy

      hx = self%plan%px/2
      hy = self%plan%py/2
      if (in_x .and. hx > 0) kernel([-hx, hx], :) = 0.0_wp
      if (in_y .and. hy > 0) kernel(:, [-hy, hy]) = 0.0_wp
   end subroutine clear_half_period

   !> Spectra for the normal problem, on first use
   subroutine need_normal(self)
      class(elastic_operator), intent(inout) :: self
      if (self%has_normal) return
      call self%make_spectra(self%table%nn, .true., self%nn, self%inn)
      self%has_normal = .true.
   end subroutine need_normal

   !> Spectra for the tangential problem, on first use
   subroutine need_tangential(self)
      class(elastic_operator), intent(inout) :: self
      real(wp), allocatable :: odd(:, :)
      real(wp) :: det, floor_, scale
      integer :: k, l

      if (self%has_tangential) return
      call self%make_spectra(self%table%xx, .true., self%xx)
      call self%make_spectra(self%table%yy, .true., self%yy)
      odd = self%table%xy
      call clear_half_period(self, odd, in_x=.true., in_y=.true.)
      call self%make_spectra(odd, .true., self%xy)
      if (allocated(self%ixx)) then
         if (any(shape(self%ixx) /= shape(self%xx))) deallocate(self%ixx, self%iyy, self%ixy)
      end if
      if (.not. allocated(self%ixx)) allocate(self%ixx, self%iyy, self%ixy, mold=self%xx)
      scale = 1.0_wp/(real(self%plan%px, wp)*real(self%plan%py, wp))
      floor_ = 1.0e-10_wp*maxval(abs(self%xx))*maxval(abs(self%yy))
      do l = 1, self%plan%kx
         do k = 1, self%plan%py
            det = max(self%xx(k, l)*self%yy(k, l) - self%xy(k, l)**2, floor_)
            self%ixx(k, l) = scale**2*self%yy(k, l)/det
            self%iyy(k, l) = scale**2*self%xx(k, l)/det
            self%ixy(k, l) = -scale**2*self%xy(k, l)/det
         end do
      end do
      self%has_tangential = .true.
   end subroutine need_tangential

   !> Spectra of the coupling between pressures and tangential displacements, on first use
   subroutine need_coupling(self)
      class(elastic_operator), intent(inout) :: self
      real(wp), allocatable :: odd(:, :)

      if (self%has_coupling) return
      odd = self%table%xn
      call clear_half_period(self, odd, in_x=.true., in_y=.false.)
      call self%make_spectra(odd, .false., self%xn)
      odd = self%table%yn
      call clear_half_period(self, odd, in_x=.false., in_y=.true.)
      call self%make_spectra(odd, .false., self%yn)
      self%has_coupling = .true.
   end subroutine need_coupling

   subroutine normal(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Normal displacement differences [mm]
      real(wp), contiguous, intent(inout) :: u(:, :)

      call need_normal(self)
      call self%plan%forward(p, self%s1, 1)
      call scale_spectrum(self%nn, self%s1)
      call self%plan%backward(self%s1, u, 1)
      self%products = self%products + 1
      self%transforms = self%transforms + 2
   end subroutine normal

   subroutine normal_inverse(self, r, z)
      class(elastic_operator), intent(inout) :: self
      !> Displacements [mm], shape (mx, my)
      real(wp), contiguous, intent(in) :: r(:, :)
      !> Pressures [N/mm2]
      real(wp), contiguous, intent(inout) :: z(:, :)

      call need_normal(self)
      call self%plan%forward(r, self%s1, 1)
      call scale_spectrum(self%inn, self%s1)
      call self%plan%backward(self%s1, z, 1)
      self%transforms = self%transforms + 2
   end subroutine normal_inverse

   subroutine tangential(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Tangential tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Tangential displacement differences [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)

      call need_tangential(self)
      call self%pair_product(self%xx, self%yy, self%xy, p, u)
      self%products = self%products + 1
   end subroutine tangential

   subroutine steady(self, p, u)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)

      call need_tangential(self)
      call self%pair_product(self%xx, self%yy, self%xy, p, u, self%difference)
      self%products = self%products + 1
   end subroutine steady

   subroutine tangential_inverse(self, r, z)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: r(:, :, :)
      real(wp), contiguous, intent(inout) :: z(:, :, :)

      call need_tangential(self)
      call self%pair_product(self%ixx, self%iyy, self%ixy, r, z)
   end subroutine tangential_inverse

   subroutine steady_inverse(self, r, z)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: r(:, :, :)
      real(wp), contiguous, intent(inout) :: z(:, :, :)

      call need_tangential(self)
      call self%pair_product(self%ixx, self%iyy, self%ixy, r, z, self%sum_up)
   end subroutine steady_inverse

   !> Product with a symmetric 2 by 2 block of real spectra, times a factor per column
   subroutine pair_product(self, axx, ayy, axy, p, u, factor)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: axx(:, :), ayy(:, :), axy(:, :)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      complex(wp), contiguous, intent(in), optional :: factor(:)
      integer :: k, l
      complex(wp) :: a, b, turn
      logical :: large

      ! two transforms side by side; small windows are done before threads are awake
      large = size(axx) > 20000
      if (large) then
         !$omp parallel sections
         !$omp section
         call self%plan%forward(p(:, :, 1), self%s1, 1)
         !$omp section
         call self%plan%forward(p(:, :, 2), self%s2, 2)
         !$omp end parallel sections
      else
         call self%plan%forward(p(:, :, 1), self%s1)
         call self%plan%forward(p(:, :, 2), self%s2)
      end if
      do l = 1, self%plan%kx
         turn = 1.0_wp
         if (present(factor)) turn = factor(l)
         do k = 1, self%plan%py
            a = turn*self%s1(k, l)
            b = turn*self%s2(k, l)
            self%s1(k, l) = axx(k, l)*a + axy(k, l)*b
            self%s2(k, l) = axy(k, l)*a + ayy(k, l)*b
         end do
      end do
      if (large) then
         !$omp parallel sections
         !$omp section
         call self%plan%backward(self%s1, u(:, :, 1), 1)
         !$omp section
         call self%plan%backward(self%s2, u(:, :, 2), 2)
         !$omp end parallel sections
      else
         call self%plan%backward(self%s1, u(:, :, 1))
         call self%plan%backward(self%s2, u(:, :, 2))
      end if
      self%transforms = self%transforms + 4
   end subroutine pair_product

   subroutine normal_by_tangential(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Tangential tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Normal displacement differences [mm], shape (mx, my)
      real(wp), contiguous, intent(inout) :: u(:, :)
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)

      call need_coupling(self)
      call self%plan%forward(p(:, :, 1), self%s1, 1)
      call self%plan%forward(p(:, :, 2), self%s2, 2)
      ! c_nx = -c_xn, c_ny = -c_yn
      self%s1 = -i*(self%xn*self%s1 + self%yn*self%s2)
      call self%plan%backward(self%s1, u, 1)
      self%products = self%products + 1
      self%transforms = self%transforms + 3
   end subroutine normal_by_tangential

   subroutine tangential_by_normal(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Tangential displacement differences [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)

      call need_coupling(self)
      call self%plan%forward(p, self%s1, 1)
      self%s2 = i*self%yn*self%s1
      self%s1 = i*self%xn*self%s1
      call self%plan%backward(self%s1, u(:, :, 1), 1)
      call self%plan%backward(self%s2, u(:, :, 2), 2)
      self%products = self%products + 1
      self%transforms = self%transforms + 3
   end subroutine tangential_by_normal

   subroutine steady_by_normal(self, p, u)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)
      integer :: l

      call need_coupling(self)
      call self%plan%forward(p, self%s1, 1)
      do l = 1, self%plan%kx
         self%s2(:, l) = i*self%difference(l)*self%yn(:, l)*self%s1(:, l)
         self%s1(:, l) = i*self%difference(l)*self%xn(:, l)*self%s1(:, l)
      end do
      call self%plan%backward(self%s1, u(:, :, 1), 1)
      call self%plan%backward(self%s2, u(:, :, 2), 2)
      self%products = self%products + 1
      self%transforms = self%transforms + 3
   end subroutine steady_by_normal

   subroutine release(self)
      class(elastic_operator), intent(inout) :: self
      call self%plan%release()
      self%mx = 0
   end subroutine release

   subroutine scale_spectrum(factor, spectrum)
      real(wp), contiguous, intent(in) :: factor(:, :)
      complex(wp), contiguous, intent(inout) :: spectrum(:, :)
      integer :: l

      do l = 1, size(factor, 2)
         spectrum(:, l) = factor(:, l)*spectrum(:, l)
      end do
   end subroutine scale_spectrum
end module contact_elastic_operator
