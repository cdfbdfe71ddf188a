!> Displacements of particles at the previous time, by convolution with a shifted kernel
!>
!> The particle now at x was at x + (shift_x, shift_y) in the frame of the previous tractions; the kernel is sampled at that
!> point. It has no symmetry, so its spectra are complex.
module contact_elastic_previous
   use contact_base_kinds, only : wp
   use contact_elastic_coefficients, only : fill_shifted_coefficients
   use contact_elastic_halfspace, only : kernel_table
   use contact_elastic_model, only : elastic_model
   use contact_fft_plan, only : fft_plan, good_size, kernel_spectrum
   implicit none (type, external)
   private

   public :: previous_operator

   !> Spectra of a shifted kernel on a window; kept while the parameters are unchanged
   type :: previous_operator
      integer :: mx = 0, my = 0
      real(wp) :: dx = 0.0_wp, dy = 0.0_wp, shift_x = 0.0_wp, shift_y = 0.0_wp
      type(elastic_model) :: model
      integer :: transforms = 0
      type(fft_plan), private :: plan
      complex(wp), allocatable, private :: xx(:, :), yy(:, :), xy(:, :), xn(:, :), yn(:, :)
      complex(wp), allocatable, private :: sx(:, :), sy(:, :), sn(:, :), s(:, :)
   contains
      !> Set window, model and shift
      procedure :: prepare
      !> Free the plans
      procedure :: release
      !> Tangential displacements u_t' due to all tractions
      procedure :: tangential
   end type previous_operator

contains

   subroutine release(self)
      class(previous_operator), intent(inout) :: self
      call self%plan%release()
      self%mx = 0
   end subroutine release

   subroutine prepare(self, model, dx, dy, mx, my, shift_x, shift_y)
      class(previous_operator), intent(inout) :: self
      !> Elastic model of the bodies
      type(elastic_model), intent(in) :: model
      !> Sides of the elements [mm]
      real(wp), intent(in) :: dx, dy
      !> Size of the window
      integer, intent(in) :: mx, my
      !> Shift of the observation points [mm]
      real(wp), intent(in) :: shift_x, shift_y
      type(kernel_table) :: table

      if (self%mx == mx .and. self%my == my .and. self%dx == dx .and. self%dy == dy .and. self%shift_x == shift_x &
         & .and. self%shift_y == shift_y .and. self%model%same_as(model)) return
      call self%plan%prepare(mx, my, good_size(2*mx), merge(1, good_size(2*my), my == 1))
      call fill_shifted_coefficients(table, model, dx, dy, self%plan%px/2, self%plan%py/2, shift_x, shift_y)
      call spectrum_of(self%plan, table, table%xx, self%xx)
      call spectrum_of(self%plan, table, table%yy, self%yy)
      call spectrum_of(self%plan, table, table%xy, self%xy)
      if (model%coupled()) then
         call spectrum_of(self%plan, table, table%xn, self%xn)
         call spectrum_of(self%plan, table, table%yn, self%yn)
      end if
      if (allocated(self%sx)) deallocate(self%sx, self%sy, self%sn, self%s)
      allocate(self%sx, self%sy, self%sn, self%s, mold=self%xx)
      self%mx = mx
      self%my = my
      self%dx = dx
      self%dy = dy
      self%shift_x = shift_x
      self%shift_y = shift_y
      self%model = model
   end subroutine prepare

   !> Spectrum of one shifted kernel, scaled for the back transform
   subroutine spectrum_of(plan, table, kernel, spectrum)
      type(fft_plan), intent(in) :: plan
      type(kernel_table), intent(in) :: table
      real(wp), intent(in) :: kernel(-table%nx:, -table%ny:)
      complex(wp), allocatable, intent(inout) :: spectrum(:, :)
      real(wp), allocatable :: period(:, :)
      integer :: k, l, i, j

      allocate(period(plan%px, plan%py))
      do l = 1, plan%py
         j = l - 1
         if (j > plan%py/2) j = j - plan%py
         do k = 1, plan%px
            i = k - 1
            if (i > plan%px/2) i = i - plan%px
            period(k, l) = kernel(i, j)
         end do
      end do
      if (allocated(spectrum)) deallocate(spectrum)
      allocate(spectrum(plan%py, plan%kx))
      call kernel_spectrum(period, spectrum)
      spectrum = spectrum/(real(plan%px, wp)*real(plan%py, wp))
   end subroutine spectrum_of

   subroutine tangential(self, px, py, pn, ux, uy)
      class(previous_operator), intent(inout) :: self
      !> Tractions [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: px(:, :), py(:, :), pn(:, :)
      !> Displacement differences [mm], shape (mx, my)
      real(wp), contiguous, intent(inout) :: ux(:, :), uy(:, :)
      integer :: l

      call self%plan%forward(px, self%sx)
      call self%plan%forward(py, self%sy)
      self%transforms = self%transforms + 4
      if (self%model%coupled()) then
         call self%plan%forward(pn, self%sn)
         self%transforms = self%transforms + 1
      end if
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
      call self%plan%backward(self%s, ux)
      call self%plan%backward(self%sy, uy)

   contains

      !> Products of a column of the spectra
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s(:, l) = self%xx(:, l)*self%sx(:, l) + self%xy(:, l)*self%sy(:, l)
         self%sy(:, l) = self%xy(:, l)*self%sx(:, l) + self%yy(:, l)*self%sy(:, l)
         if (.not. self%model%coupled()) return
         self%s(:, l) = self%s(:, l) + self%xn(:, l)*self%sn(:, l)
         self%sy(:, l) = self%sy(:, l) + self%yn(:, l)*self%sn(:, l)
      end subroutine multiply
   end subroutine tangential
end module contact_elastic_previous
