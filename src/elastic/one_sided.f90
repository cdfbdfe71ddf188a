!> Compliance with memory in x: the same for all elements, but not symmetric in x
!>
!> Products use complex spectra. The approximate inverses are those of the symmetric part, computed by the parent from the same
!> table: the real parts of the spectra.
module contact_elastic_one_sided
   use contact_base_kinds, only : wp
   use contact_elastic_halfspace, only : middle_of_table
   use contact_elastic_model, only : elastic_model
   use contact_elastic_moving, only : moving_operator
   use contact_elastic_operator, only : padded_size
   use contact_fft_plan, only : kernel_spectrum
   implicit none (type, external)
   private

   public :: one_sided_operator, share_table

   !> Compliance of viscoelastic bodies
   type, extends(moving_operator) :: one_sided_operator
      !> Spectra, shape (py, kx), scaled for the back transform: nn, xx, yy, xy, xn, yn [mm/(N/mm2)]
      complex(wp), allocatable, private :: kernel(:, :, :)
      complex(wp), allocatable, private :: sn(:, :), mixed(:, :)
   contains
      procedure :: prepare
      procedure :: normal
      procedure :: normal_by_tangential
      procedure :: pair_product
      procedure :: by_normal
   end type one_sided_operator

contains

   !> Take the coefficients of a window that is prepared next from an operator of the same bodies and elements
   !>
   !> Quadratures of the memory take longer than all products on small windows. They begin at the end of the table, so the
   !> coefficients of both differ by round-off.
   pure subroutine share_table(from, mx, my, to)
      !> Operator that is prepared, of a larger window; nothing is done if its table is too small
      class(one_sided_operator), intent(in) :: from
      !> Size of the window to be prepared
      integer, intent(in) :: mx, my
      !> Its operator; `prepare` must follow for the same bodies and elements
      class(one_sided_operator), intent(inout) :: to
      integer :: n(2)

      n = padded_size(mx, my)/2
      if (to%is_for(from%model, from%dx, from%dy, mx, my) .or. n(1) > from%table%nx .or. n(2) > from%table%ny) return
      call middle_of_table(from%table, n, to%table)
      to%is_filled = .true.
   end subroutine share_table

   subroutine prepare(self, model, dx, dy, mx, my, direction, y_first)
      class(one_sided_operator), intent(inout) :: self
      type(elastic_model), intent(in) :: model
      real(wp), intent(in) :: dx, dy
      integer, intent(in) :: mx, my, direction
      real(wp), intent(in), optional :: y_first

      if (.not. self%is_for(model, dx, dy, mx, my)) then
         if (allocated(self%kernel)) deallocate(self%kernel)
      end if
      call self%elastic_operator%prepare(model, dx, dy, mx, my, direction, y_first)
      self%small = .false.
   end subroutine prepare

   !> Compute all spectra, on first use
   subroutine need_spectra(self)
      class(one_sided_operator), intent(inout) :: self
      integer :: n

      if (allocated(self%kernel)) return
      n = merge(6, 4, allocated(self%table%xn))
      allocate(self%kernel(self%plan%py, self%plan%kx, n))
      call one(self%table%nn, self%kernel(:, :, 1))
      call one(self%table%xx, self%kernel(:, :, 2))
      call one(self%table%yy, self%kernel(:, :, 3))
      call one(self%table%xy, self%kernel(:, :, 4), odd=.true.)
      if (n > 4) then
         call one(self%table%xn, self%kernel(:, :, 5))
         call one(self%table%yn, self%kernel(:, :, 6), odd=.true.)
      end if
      if (allocated(self%sn)) deallocate(self%sn, self%mixed)
      allocate(self%sn(self%plan%py, self%plan%kx), self%mixed(self%plan%py, self%plan%kx))

   contains

      !> Spectrum of one kernel
      subroutine one(coefficients, spectrum, odd)
         !> Offsets -nx:nx, -ny:ny
         real(wp), intent(in) :: coefficients(-self%table%nx:, -self%table%ny:)
         complex(wp), contiguous, intent(inout) :: spectrum(:, :)
         !> Odd in y: zero at half the period, where offsets +n and -n coincide
         logical, intent(in), optional :: odd
         real(wp), allocatable :: period(:, :)
         integer :: k, l, i, j

         allocate(period(self%plan%px, self%plan%py))
         do l = 1, self%plan%py
            j = l - 1
            if (j > self%plan%py/2) j = j - self%plan%py
            do k = 1, self%plan%px
               i = k - 1
               if (i > self%plan%px/2) i = i - self%plan%px
               period(k, l) = coefficients(i, j)
            end do
         end do
         if (present(odd) .and. self%plan%py > 1) period(:, self%plan%py/2 + 1) = 0.0_wp
         call kernel_spectrum(period, spectrum)
         spectrum = spectrum/(real(self%plan%px, wp)*real(self%plan%py, wp))
      end subroutine one
   end subroutine need_spectra

   subroutine normal(self, p, u)
      class(one_sided_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :)
      integer :: l

      call need_spectra(self)
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
      call self%plan%backward(self%s1, u)
      self%products = self%products + 1
      self%transforms = self%transforms + 2

   contains

      !> Product of a column of the spectrum
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s1(:, l) = self%kernel(:, l, 1)*self%s1(:, l)
      end subroutine multiply
   end subroutine normal

   !> Both tangential components of the displacements or of their change per step
   subroutine pair_product(self, p, u, change)
      class(one_sided_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      logical, intent(in) :: change
      integer :: l

      call need_spectra(self)
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
      call self%plan%backward(self%mixed, u(:, :, 1))
      call self%plan%backward(self%s2, u(:, :, 2))
      self%products = self%products + 1
      self%transforms = self%transforms + 4

   contains

      !> Product of a column of the spectra, optionally with the difference to the next element ahead
      subroutine multiply(l)
         integer, intent(in) :: l

         associate (kernel => self%kernel(:, l, :), s1 => self%s1(:, l), s2 => self%s2(:, l), mixed => self%mixed(:, l))
            mixed = kernel(:, 2)*s1 + kernel(:, 4)*s2
            s2 = kernel(:, 4)*s1 + kernel(:, 3)*s2
            if (.not. change) return
            mixed = self%difference(l)*mixed
            s2 = self%difference(l)*s2
         end associate
      end subroutine multiply
   end subroutine pair_product

   subroutine normal_by_tangential(self, p, u)
      class(one_sided_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :)
      integer :: l

      call need_spectra(self)
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

      !> Product of a column of the spectra
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s1(:, l) = -(self%kernel(:, l, 5)*self%s1(:, l) + self%kernel(:, l, 6)*self%s2(:, l))
      end subroutine multiply
   end subroutine normal_by_tangential

   !> Tangential displacements due to pressures, or their change per step
   subroutine by_normal(self, p, u, change)
      class(one_sided_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      logical, intent(in) :: change
      integer :: l

      call need_spectra(self)
      call self%plan%forward(p, self%sn)
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

      !> Product of a column of the spectra, optionally with the difference to the next element ahead
      subroutine multiply(l)
         integer, intent(in) :: l

         self%s1(:, l) = self%kernel(:, l, 5)*self%sn(:, l)
         self%s2(:, l) = self%kernel(:, l, 6)*self%sn(:, l)
         if (.not. change) return
         self%s1(:, l) = self%difference(l)*self%s1(:, l)
         self%s2(:, l) = self%difference(l)*self%s2(:, l)
      end subroutine multiply
   end subroutine by_normal
end module contact_elastic_one_sided
