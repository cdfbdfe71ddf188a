!> Compliance from a table of influence coefficients, for example from finite elements
!>
!> Coefficients depend on the offset in x only, or on the offsets in x and y. Rows are transformed in x, and pairs of rows are
!> multiplied individually, so that both cases use the same product. Mirror symmetry in x makes each spectrum real (nn, xx, yy,
!> ny, yn) or imaginary (nx, xn, xy, yx). Approximate inverses are those of half-spaces of the same materials.
module contact_elastic_tabulated
   use contact_base_kinds, only : wp
   use contact_elastic_model, only : elastic_model
   use contact_elastic_moving, only : moving_operator
   use contact_fft_plan, only : fft_plan
   implicit none (type, external)
   private

   public :: tabulated_operator

   !> Directions, in the order of the table
   integer, parameter :: n = 1, x = 2, y = 3

   !> Rows with spectra in x
   type, extends(moving_operator) :: tabulated_operator
      !> Transforms of one row: of the window, and of a complete period
      type(fft_plan), private :: row, period
      !> Index in the table of the first row of the window, minus 1; 0 if all rows are alike
      integer, private :: row_offset = 0
      !> Spectra, scaled for the back transform [mm/(N/mm2)], shape (kx, rows, 9, slices): rows are offsets -(my-1)...my-1 with
      !> one slice for all, or receiving rows 1...my with one slice per loaded row
      real(wp), allocatable, private :: spectrum(:, :, :, :)
      !> Spectra of rows, shape (kx, my)
      complex(wp), allocatable, private :: source(:, :), response(:, :)
   contains
      procedure :: prepare
      procedure :: normal
      procedure :: normal_by_tangential
      procedure :: pair_product
      procedure :: by_normal
      procedure :: release
      procedure :: can_coarsen
      procedure :: has_table
   end type tabulated_operator

contains

   !> There are no coefficients for larger elements
   pure logical function can_coarsen(self)
      class(tabulated_operator), intent(in) :: self
      can_coarsen = self%mx < 0
   end function can_coarsen

   !> The table of the parent contains the coefficients of half-spaces
   pure logical function has_table(self)
      class(tabulated_operator), intent(in) :: self
      has_table = self%mx < 0
   end function has_table

   subroutine prepare(self, model, dx, dy, mx, my, direction, y_first)
      class(tabulated_operator), intent(inout) :: self
      type(elastic_model), intent(in) :: model
      real(wp), intent(in) :: dx, dy
      integer, intent(in) :: mx, my, direction
      real(wp), intent(in), optional :: y_first
      integer :: offset
      logical :: same

      offset = 0
      if (present(y_first) .and. size(model%tabulated%c, 4) > 1) offset = nint((y_first - model%tabulated%y_first)/dy)
      offset = max(0, min(offset, size(model%tabulated%c, 4) - my))
      same = self%is_for(model, dx, dy, mx, my) .and. offset == self%row_offset .and. allocated(self%spectrum)
      call self%elastic_operator%prepare(model, dx, dy, mx, my, direction, y_first)
      if (same) return
      self%row_offset = offset
      call make_spectra(self)
   end subroutine prepare

   !> Compute the spectra of the rows of the window
   subroutine make_spectra(self)
      class(tabulated_operator), intent(inout) :: self
      complex(wp), allocatable :: s(:, :)
      real(wp), allocatable :: values(:, :)
      integer :: slices, rows, slice, r, b, k, l, highest

      associate (t => self%model%tabulated, px => self%plan%px, kx => self%plan%kx)
         call self%row%prepare(self%mx, 1, px, 1)
         call self%period%prepare(px, 1, px, 1)
         slices = merge(self%my, 1, size(t%c, 4) > 1)
         rows = merge(self%my, 2*self%my - 1, slices > 1)
         if (allocated(self%spectrum)) deallocate(self%spectrum, self%source, self%response)
         allocate(self%spectrum(kx, rows, 9, slices), self%source(kx, self%my), self%response(kx, self%my))
         allocate(s(1, kx), values(px, 1))
         ! one more column than the window has, for the shifted kernel of steady rolling
         highest = min(self%mx, t%nx)
         do slice = 1, slices
            do b = 1, 9
               do r = 1, rows
                  l = r - merge(slice, self%my, slices > 1)
                  self%spectrum(:, r, b, slice) = 0.0_wp
                  if (abs(l) > t%ny) cycle
                  values = 0.0_wp
                  do k = 0, highest
                     values(1 + k, 1) = t%c(k, l, b, slice + self%row_offset)
                  end do
                  if (l == 0 .and. b == 1) values(1, 1) = values(1, 1) + self%model%sheet
                  if (l == 0 .and. (b == 5 .or. b == 9)) values(1, 1) = values(1, 1) + self%model%layer
                  do k = 1, highest
                     values(px + 1 - k, 1) = merge(-1.0_wp, 1.0_wp, is_odd(b))*values(1 + k, 1)
                  end do
                  call self%period%forward(values, s)
                  if (is_odd(b)) then
                     self%spectrum(:, r, b, slice) = aimag(s(1, :))/px
                  else
                     self%spectrum(:, r, b, slice) = real(s(1, :))/px
                  end if
               end do
            end do
         end do
         self%diagonal = 0.0_wp
         do b = 1, 3
            self%diagonal(b) = sum(t%c(0, 0, 4*b - 3, self%row_offset + 1:self%row_offset + slices))/slices
         end do
         self%diagonal(1) = self%diagonal(1) + self%model%sheet
         self%diagonal(2:3) = self%diagonal(2:3) + self%model%layer
      end associate
   end subroutine make_spectra

   !> Does a block, in the order nn nx ny xn xx xy yn yx yy, change sign with x?
   pure logical function is_odd(block)
      integer, intent(in) :: block
      is_odd = block == 2 .or. block == 4 .or. block == 6 .or. block == 8
   end function is_odd

   !> Add the displacements in direction i due to the transformed tractions in direction j
   subroutine add_block(self, i, j)
      class(tabulated_operator), intent(inout) :: self
      integer, intent(in) :: i, j
      complex(wp) :: factor
      integer :: iy, jy, b, k

      b = 3*(i - 1) + j
      factor = merge((0.0_wp, 1.0_wp), (1.0_wp, 0.0_wp), is_odd(b))
      if (is_odd(b)) self%source = factor*self%source
      !$omp parallel do private(jy, k) if (self%my > 40)
      do iy = 1, self%my
         do jy = 1, self%my
            if (size(self%spectrum, 4) > 1) then
               do k = 1, size(self%source, 1)
                  self%response(k, iy) = self%response(k, iy) + self%spectrum(k, iy, b, jy)*self%source(k, jy)
               end do
            else
               do k = 1, size(self%source, 1)
                  self%response(k, iy) = self%response(k, iy) + self%spectrum(k, iy - jy + self%my, b, 1)*self%source(k, jy)
               end do
            end if
         end do
      end do
      if (is_odd(b)) self%source = conjg(factor)*self%source
   end subroutine add_block

   subroutine send(self, p)
      class(tabulated_operator), intent(inout) :: self
      !> Shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      complex(wp), allocatable :: s(:, :)
      integer :: iy

      allocate(s(1, self%plan%kx))
      do iy = 1, self%my
         call self%row%forward(p(:, iy:iy), s)
         self%source(:, iy) = s(1, :)
      end do
      self%transforms = self%transforms + 1
   end subroutine send

   !> Get a displacement field from its transform, or its difference between two time steps
   subroutine fetch(self, u, change)
      class(tabulated_operator), intent(inout) :: self
      real(wp), contiguous, intent(inout) :: u(:, :)
      logical, intent(in) :: change
      complex(wp), allocatable :: s(:, :)
      integer :: iy

      allocate(s(1, self%plan%kx))
      do iy = 1, self%my
         s(1, :) = self%response(:, iy)
         if (change) s(1, :) = self%difference*s(1, :)
         call self%row%backward(s, u(:, iy:iy))
      end do
      self%transforms = self%transforms + 1
   end subroutine fetch

   subroutine normal(self, p, u)
      class(tabulated_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :)

      self%response = 0.0_wp
      call send(self, p)
      call add_block(self, n, n)
      call fetch(self, u, .false.)
      self%products = self%products + 1
   end subroutine normal

   subroutine pair_product(self, p, u, change)
      class(tabulated_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      logical, intent(in) :: change
      integer :: i, j

      do i = x, y
         self%response = 0.0_wp
         do j = x, y
            call send(self, p(:, :, j - 1))
            call add_block(self, i, j)
         end do
         call fetch(self, u(:, :, i - 1), change)
      end do
      self%products = self%products + 1
   end subroutine pair_product

   subroutine normal_by_tangential(self, p, u)
      class(tabulated_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :)
      integer :: j

      self%response = 0.0_wp
      do j = x, y
         call send(self, p(:, :, j - 1))
         call add_block(self, n, j)
      end do
      call fetch(self, u, .false.)
      self%products = self%products + 1
   end subroutine normal_by_tangential

   subroutine by_normal(self, p, u, change)
      class(tabulated_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      logical, intent(in) :: change
      integer :: i

      call send(self, p)
      do i = x, y
         self%response = 0.0_wp
         call add_block(self, i, n)
         call fetch(self, u(:, :, i - 1), change)
      end do
      self%products = self%products + 1
   end subroutine by_normal

   subroutine release(self)
      class(tabulated_operator), intent(inout) :: self

      call self%elastic_operator%release()
      call self%row%release()
      call self%period%release()
   end subroutine release
end module contact_elastic_tabulated
