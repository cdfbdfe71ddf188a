!> Compliance of two half-spaces on a window of elements: products by fast Fourier transforms
!>
!> Kernels of half-spaces are even or odd in each coordinate. Their spectra are therefore real (nn, xx, yy, xy) or imaginary
!> (xn, yn), and one real array per kernel is stored. In steady rolling the displacement difference between two time steps has
!> the same kernel times 1 - exp(i kappa dx): a factor per column of the spectrum.
!>
!> Small windows transform both tangential fields at once (contact_fft_paired). In this case xx and yy contain half the sum and half
!> the difference of the spectra, and the difference between two time steps is taken before the transform. Approximate inverses
!> have a shorter period: padding by a quarter of the window is as good as by a whole one.
module contact_elastic_operator
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_elastic_coefficients, only : fill_coefficients, own_coefficients
   use contact_elastic_compliance, only : compliance
   use contact_elastic_model, only : elastic_model
   use contact_elastic_spectra, only : invert_block, make_spectrum, replace_by_mean, spectrum_floor
   use contact_fft_paired, only : paired_plan
   use contact_fft_plan, only : fast_line_size, fast_size, fft_plan, largest_fast_size
   implicit none (type, external)
   private

   public :: elastic_operator, normal_inverse_of_two, normal_of_two, padded_size

   !> Contains plans, spectra and workspace; its table extends to offsets of half the padded window
   type, extends(compliance) :: elastic_operator
      type(fft_plan) :: plan
      !> For approximate inverses, on a shorter period
      type(fft_plan), private :: normal_inverse_plan, inverse_plan
      !> Both fields at once on small windows, for products and for inverses
      type(paired_plan), private :: pair, inverse_pair, normal_inverse_pair
      !> Has the table of the window that is prepared next been set already?
      logical :: is_filled = .false.
      !> Is the window small? False for children that use the spectra xx and yy by themselves
      logical :: small = .false.
      !> Spectra divided by the padded size, real parts; xn, yn: imaginary parts [mm/(N/mm2)]
      real(wp), allocatable :: nn(:, :), xx(:, :), yy(:, :), xy(:, :), xn(:, :), yn(:, :)
      !> Inverse of the 2 by 2 tangential symbol, and of the normal symbol; circulant
      real(wp), allocatable, private :: ixx(:, :), iyy(:, :), ixy(:, :), inn(:, :)
      !> 1 - exp(i direction kappa), shape (kx)
      complex(wp), allocatable :: difference(:)
      complex(wp), allocatable :: s1(:, :), s2(:, :)
      integer, private :: direction = 0
      logical, private :: has_normal = .false., has_tangential = .false., has_coupling = .false.
   contains
      procedure :: prepare
      procedure :: normal
      procedure :: tangential
      procedure :: steady
      procedure :: normal_inverse
      procedure :: tangential_inverse
      procedure :: normal_by_tangential
      procedure :: tangential_by_normal
      procedure :: steady_by_normal
      procedure :: release
      !> Compute the spectra of all kernels
      procedure :: need_all
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
      integer :: px, py, period(2), k
      complex(wp) :: turn
      logical :: same

      same = self%is_for(model, dx, dy, mx, my)
      if (.not. same) then
         period = padded_size(mx, my)
         px = period(1)
         py = period(2)
         if (.not. self%is_filled) call fill_coefficients(self%table, model, dx, dy, px/2, py/2)
         self%is_filled = .false.
         self%diagonal = own_coefficients(self%table, model)
         call self%plan%prepare(mx, my, px, py)
         self%small = my > 1 .and. max(px, py) <= largest_fast_size
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
         if (allocated(self%difference)) deallocate(self%difference)
         allocate(self%difference(self%plan%kx))
         do k = 1, self%plan%kx
            turn = exp(cmplx(0.0_wp, direction*2.0_wp*pi*(k - 1)/self%plan%px, wp))
            self%difference(k) = 1.0_wp - turn
         end do
      end if
   end subroutine prepare

   !> Size of the padded window: one more element along x than for a plain product, for the shifted kernel of steady rolling
   pure function padded_size(mx, my) result(period)
      !> Size of the window
      integer, intent(in) :: mx, my
      integer :: period(2)

      period(1) = merge(fast_line_size(2*mx + 1), fast_size(2*mx + 1), my == 1)
      period(2) = merge(1, fast_size(2*my), my == 1)
   end function padded_size

   !> Compute the spectra for the normal problem, on first use
   subroutine need_normal(self)
      class(elastic_operator), intent(inout) :: self
      real(wp) :: scale, smallest
      integer :: px, py

      if (self%has_normal) return
      call pad_a_little(self, px, py)
      call self%normal_inverse_plan%prepare(self%mx, self%my, px, py)
      associate (t => self%table)
         call make_spectrum(t%nx, t%ny, t%nn, .false., .false., self%plan%px, self%plan%py, self%nn)
         call make_spectrum(t%nx, t%ny, t%nn, .false., .false., px, py, self%inn)
      end associate
      scale = 1.0_wp/(real(px, wp)*real(py, wp))
      smallest = spectrum_floor*maxval(abs(self%inn))/scale
      self%inn = scale/max(self%inn/scale, smallest)
      self%has_normal = .true.
   end subroutine need_normal

   !> Period for an approximate inverse: a quarter more elements than the window
   pure subroutine pad_a_little(self, px, py)
      class(elastic_operator), intent(in) :: self
      integer, intent(out) :: px, py
      integer :: n

      n = self%mx + (self%mx + 3)/4
      px = min(self%plan%px, merge(fast_line_size(n), fast_size(n), self%my == 1))
      py = 1
      if (self%my > 1) py = min(self%plan%py, fast_size(self%my + (self%my + 3)/4))
   end subroutine pad_a_little

   !> Compute the spectra for the tangential problem, on first use
   subroutine need_tangential(self)
      class(elastic_operator), intent(inout) :: self
      integer :: px, py

      if (self%has_tangential) return
      call self%complete()
      call pad_a_little(self, px, py)
      call tangential_spectra(self, self%plan%px, self%plan%py, self%xx, self%yy, self%xy)
      if (px == self%plan%px .and. py == self%plan%py) then
         self%ixx = self%xx
         self%iyy = self%yy
         self%ixy = self%xy
      else
         call tangential_spectra(self, px, py, self%ixx, self%iyy, self%ixy)
      end if
      call invert_block(real(px, wp)*real(py, wp), self%ixx, self%iyy, self%ixy)
      if (self%small) then
         call self%pair%prepare(self%mx, self%my, self%plan%px, self%plan%py)
         call self%inverse_pair%prepare(self%mx, self%my, px, py)
         call replace_by_mean(self%xx, self%yy)
         call replace_by_mean(self%ixx, self%iyy)
      else
         call self%inverse_plan%prepare(self%mx, self%my, px, py)
      end if
      self%has_tangential = .true.
   end subroutine need_tangential

   !> Spectra xx, yy, xy for given periods
   subroutine tangential_spectra(self, px, py, xx, yy, xy)
      class(elastic_operator), intent(in) :: self
      integer, intent(in) :: px, py
      real(wp), allocatable, intent(inout) :: xx(:, :), yy(:, :), xy(:, :)

      associate (t => self%table)
         call make_spectrum(t%nx, t%ny, t%xx, .false., .false., px, py, xx)
         call make_spectrum(t%nx, t%ny, t%yy, .false., .false., px, py, yy)
         call make_spectrum(t%nx, t%ny, t%xy, .true., .true., px, py, xy)
      end associate
   end subroutine tangential_spectra

   !> Compute the spectra of the coupling between pressures and tangential displacements, on first use
   subroutine need_coupling(self)
      class(elastic_operator), intent(inout) :: self

      if (self%has_coupling) return
      call self%complete()
      associate (t => self%table, px => self%plan%px, py => self%plan%py)
         call make_spectrum(t%nx, t%ny, t%xn, .true., .false., px, py, self%xn)
         call make_spectrum(t%nx, t%ny, t%yn, .false., .true., px, py, self%yn)
      end associate
      self%has_coupling = .true.
   end subroutine need_coupling

   subroutine need_all(self)
      class(elastic_operator), intent(inout) :: self

      call need_normal(self)
      call need_tangential(self)
      if (allocated(self%table%xn)) call need_coupling(self)
   end subroutine need_all

   subroutine normal(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Normal displacement differences [mm]
      real(wp), contiguous, intent(inout) :: u(:, :)

      call need_normal(self)
      call self%plan%convolve(self%nn, p, u)
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
      call self%normal_inverse_plan%convolve(self%inn, r, z)
      self%transforms = self%transforms + 2
   end subroutine normal_inverse

   !> Normal displacements by two fields of pressures; on small windows in the time of one
   subroutine normal_of_two(operator, p, u)
      !> Prepared for the window, of any kind
      class(compliance), intent(inout) :: operator
      !> Pressures [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Normal displacement differences [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      integer :: k

      select type (operator)
      type is (elastic_operator)
         if (operator%small) then
            call need_normal(operator)
            call operator%pair%prepare(operator%mx, operator%my, operator%plan%px, operator%plan%py)
            call operator%pair%convolve_even(operator%nn, p, u)
            operator%products = operator%products + 2
            operator%transforms = operator%transforms + 4
            return
         end if
      end select
      do k = 1, 2
         call operator%normal(p(:, :, k), u(:, :, k))
      end do
   end subroutine normal_of_two

   !> Approximate inverse of the normal product for two fields; on small windows in the time of one
   subroutine normal_inverse_of_two(operator, r, z)
      !> Prepared for the window, of any kind
      class(compliance), intent(inout) :: operator
      !> Displacements [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: r(:, :, :)
      !> Pressures [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: z(:, :, :)
      integer :: k

      select type (operator)
      type is (elastic_operator)
         if (operator%small) then
            call need_normal(operator)
            associate (plan => operator%normal_inverse_plan)
               call operator%normal_inverse_pair%prepare(operator%mx, operator%my, plan%px, plan%py)
            end associate
            call operator%normal_inverse_pair%convolve_even(operator%inn, r, z)
            operator%transforms = operator%transforms + 4
            return
         end if
      end select
      do k = 1, 2
         call operator%normal_inverse(r(:, :, k), z(:, :, k))
      end do
   end subroutine normal_inverse_of_two

   subroutine tangential(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Tangential tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Tangential displacement differences [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)

      call need_tangential(self)
      if (self%small) then
         call self%pair%convolve(self%xx, self%yy, self%xy, p, u, ahead=0)
      else
         call self%plan%convolve_pair(self%xx, self%yy, self%xy, p, u)
      end if
      self%transforms = self%transforms + 4
      self%products = self%products + 1
   end subroutine tangential

   subroutine steady(self, p, u)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)

      call need_tangential(self)
      if (self%small) then
         call self%pair%convolve(self%xx, self%yy, self%xy, p, u, ahead=self%direction)
      else
         call self%plan%convolve_pair(self%xx, self%yy, self%xy, p, u, self%difference)
      end if
      self%transforms = self%transforms + 4
      self%products = self%products + 1
   end subroutine steady

   subroutine tangential_inverse(self, r, z)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: r(:, :, :)
      real(wp), contiguous, intent(inout) :: z(:, :, :)

      call need_tangential(self)
      if (self%small) then
         call self%inverse_pair%convolve(self%ixx, self%iyy, self%ixy, r, z, ahead=0)
      else
         call self%inverse_plan%convolve_pair(self%ixx, self%iyy, self%ixy, r, z)
      end if
      self%transforms = self%transforms + 4
   end subroutine tangential_inverse

   subroutine normal_by_tangential(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Tangential tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Normal displacement differences [mm], shape (mx, my)
      real(wp), contiguous, intent(inout) :: u(:, :)
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)
      integer :: l

      call need_coupling(self)
      call self%plan%forward(p(:, :, 1), self%s1)
      call self%plan%forward(p(:, :, 2), self%s2)
      if (self%plan%is_shared()) then
         !$omp parallel do
         do l = 1, self%plan%kx
            call multiply(l)
         end do
         !$omp end parallel do
      else
         do l = 1, self%plan%kx
            call multiply(l)
         end do
      end if
      call self%plan%backward(self%s1, u)
      self%products = self%products + 1
      self%transforms = self%transforms + 3

   contains

      !> Product of a column of the spectra: c_nx = -c_xn, c_ny = -c_yn
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s1(:, l) = -i*(self%xn(:, l)*self%s1(:, l) + self%yn(:, l)*self%s2(:, l))
      end subroutine multiply
   end subroutine normal_by_tangential

   subroutine tangential_by_normal(self, p, u)
      class(elastic_operator), intent(inout) :: self
      !> Pressures [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Tangential displacement differences [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)
      integer :: l

      call need_coupling(self)
      call self%plan%forward(p, self%s1)
      if (self%plan%is_shared()) then
         !$omp parallel do
         do l = 1, self%plan%kx
            call multiply(l)
         end do
         !$omp end parallel do
      else
         do l = 1, self%plan%kx
            call multiply(l)
         end do
      end if
      call self%plan%backward(self%s1, u(:, :, 1))
      call self%plan%backward(self%s2, u(:, :, 2))
      self%products = self%products + 1
      self%transforms = self%transforms + 3

   contains

      !> Products of a column of the spectrum
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s2(:, l) = i*self%yn(:, l)*self%s1(:, l)
         self%s1(:, l) = i*self%xn(:, l)*self%s1(:, l)
      end subroutine multiply
   end subroutine tangential_by_normal

   subroutine steady_by_normal(self, p, u)
      class(elastic_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)
      integer :: l

      call need_coupling(self)
      call self%plan%forward(p, self%s1)
      if (self%plan%is_shared()) then
         !$omp parallel do
         do l = 1, self%plan%kx
            call multiply(l)
         end do
         !$omp end parallel do
      else
         do l = 1, self%plan%kx
            call multiply(l)
         end do
      end if
      call self%plan%backward(self%s1, u(:, :, 1))
      call self%plan%backward(self%s2, u(:, :, 2))
      self%products = self%products + 1
      self%transforms = self%transforms + 3

   contains

      !> Products of a column of the spectrum
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s2(:, l) = i*self%difference(l)*self%yn(:, l)*self%s1(:, l)
         self%s1(:, l) = i*self%difference(l)*self%xn(:, l)*self%s1(:, l)
      end subroutine multiply
   end subroutine steady_by_normal

   subroutine release(self)
      class(elastic_operator), intent(inout) :: self
      call self%plan%release()
      call self%pair%release()
      call self%inverse_pair%release()
      call self%normal_inverse_pair%release()
      call self%normal_inverse_plan%release()
      call self%inverse_plan%release()
      self%mx = 0
   end subroutine release

end module contact_elastic_operator
