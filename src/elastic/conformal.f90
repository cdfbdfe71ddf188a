!> Compliance of a surface that is curved across the rolling direction
!>
!> The corrected coefficients are half-space coefficients times cosines and sines of the difference of inclinations alpha_J -
!> alpha_I, or of half of it. With
!>
!>     cos(a_J - a_I) = cos a_I cos a_J + sin a_I sin a_J,
!>     sin(a_J - a_I) = cos a_I sin a_J - sin a_I cos a_J
!>
!> each term is a convolution between fields that are weighted row by row. Nothing is approximated, no coefficients per row are
!> stored, and transforms can be used for any inclination. Approximate inverses are those of flat bodies.
module contact_elastic_conformal
   use contact_base_kinds, only : wp
   use contact_elastic_model, only : elastic_model
   use contact_elastic_moving, only : moving_operator
   implicit none (type, external)
   private

   public :: conformal_operator

   !> Directions
   integer, parameter :: x = 1, s = 2, n = 3
   !> Kernels of flat bodies
   integer, parameter :: k_nn = 1, k_xx = 2, k_ss = 3, k_xs = 4, k_xn = 5, k_sn = 6
   !> Weights of rows: 1, cosine and sine of the inclination, cosine and sine of half the inclination
   integer, parameter :: one = 1, cosine = 2, sine = 3, half_cosine = 4, half_sine = 5

   !> Contribution to the displacement in direction `to` by tractions in direction `from`: factor times kernel times a function
   !> of the difference of inclinations
   type :: term_type
      integer :: to = 0, from = 0, function_ = one, kernel = k_nn
      real(wp) :: factor = 0.0_wp
   end type term_type

   !> Half-space kernels for rows that are inclined relative to each other
   type, extends(moving_operator) :: conformal_operator
      type(term_type), allocatable, private :: term(:)
      !> Weights of rows, shape (my, 5)
      real(wp), allocatable, private :: weight(:, :)
      !> Spectra of weighted tractions and displacements, shape (py, kx, 5, 3)
      complex(wp), allocatable, private :: source(:, :, :, :), response(:, :, :, :)
      !> Fields on the window, shape (mx, my)
      real(wp), allocatable, private :: field(:, :)
   contains
      procedure :: prepare
      procedure :: normal
      procedure :: normal_by_tangential
      procedure :: pair_product
      procedure :: by_normal
      procedure :: has_table
   end type conformal_operator

contains

   !> The table contains coefficients of flat bodies, which do not describe this compliance
   pure logical function has_table(self)
      class(conformal_operator), intent(in) :: self
      has_table = self%mx < 0
   end function has_table

   subroutine prepare(self, model, dx, dy, mx, my, direction, y_first)
      class(conformal_operator), intent(inout) :: self
      type(elastic_model), intent(in) :: model
      real(wp), intent(in) :: dx, dy
      integer, intent(in) :: mx, my, direction
      real(wp), intent(in), optional :: y_first
      real(wp) :: alpha
      integer :: iy

      if (.not. self%is_for(model, dx, dy, mx, my)) then
         if (allocated(self%source)) deallocate(self%source, self%response, self%field, self%weight)
      end if
      call self%elastic_operator%prepare(model, dx, dy, mx, my, direction, y_first)
      ! the terms require all spectra and test which ones exist
      call self%complete()
      self%small = .false.
      if (.not. allocated(self%source)) then
         allocate(self%source(self%plan%py, self%plan%kx, 5, 3), self%response(self%plan%py, self%plan%kx, 5, 3))
         allocate(self%field(mx, my), self%weight(my, 5))
      end if
      do iy = 1, my
         alpha = model%inclination%angle(self%y_first + (iy - 1)*dy)
         self%weight(iy, :) = [1.0_wp, cos(alpha), sin(alpha), cos(0.5_wp*alpha), sin(0.5_wp*alpha)]
      end do
      call make_terms(self, model%inclination%variant)
   end subroutine prepare

   !> Terms of the corrected matrix of a variant
   subroutine make_terms(self, variant)
      class(conformal_operator), intent(inout) :: self
      integer, intent(in) :: variant
      !> Kernels and signs of the matrix of flat bodies; rows: to, columns: from
      integer, parameter :: kernel(3, 3) = reshape([k_xx, k_xs, k_xn, k_xs, k_ss, k_sn, k_xn, k_sn, k_nn], [3, 3])
      real(wp), parameter :: sign_(3, 3) = reshape([real(wp) :: 1, 1, -1, 1, 1, -1, 1, 1, 1], [3, 3])
      !> Rotation by the difference of inclinations
      integer, parameter :: turn(2:3, 2:3) = reshape([cosine, sine, sine, cosine], [2, 2])
      real(wp), parameter :: turn_sign(2:3, 2:3) = reshape([1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      integer :: i, j, m

      if (allocated(self%term)) deallocate(self%term)
      allocate(self%term(0))
      select case (variant)
      case (1, 2)
         ! A R
         do i = x, n
            call add(i, x, one, kernel(i, x), sign_(i, x))
            do j = s, n
               if (variant == 2 .and. i == x .and. j == n) cycle
               do m = s, n
                  call add(i, j, turn(m, j), kernel(i, m), sign_(i, m)*turn_sign(m, j))
               end do
            end do
         end do
         if (variant == 2) call add(x, n, one, k_xn, 1.0_wp)
      case (3)
         ! R A
         do j = x, n
            call add(x, j, one, kernel(x, j), sign_(x, j))
            do i = s, n
               do m = s, n
                  call add(i, j, turn(i, m), kernel(m, j), sign_(m, j)*turn_sign(i, m))
               end do
            end do
         end do
      case default
         ! R A R with half the angle each; the mean and half the difference of ss and nn rotate differently
         call add(x, x, one, k_xx, 1.0_wp)
         call add(x, s, half_cosine, k_xs, 1.0_wp)
         call add(x, s, half_sine, k_xn, 1.0_wp)
         call add(s, x, half_cosine, k_xs, 1.0_wp)
         call add(s, x, half_sine, k_xn, 1.0_wp)
         call add(x, n, half_cosine, k_xn, 1.0_wp)
         call add(x, n, half_sine, k_xs, -1.0_wp)
         call add(n, x, half_cosine, k_xn, -1.0_wp)
         call add(n, x, half_sine, k_xs, 1.0_wp)
         do i = s, n
            call add(i, i, one, k_ss, merge(0.5_wp, -0.5_wp, i == s))
            call add(i, i, one, k_nn, merge(-0.5_wp, 0.5_wp, i == s))
            call add(i, i, cosine, k_ss, 0.5_wp)
            call add(i, i, cosine, k_nn, 0.5_wp)
            call add(i, i, sine, k_sn, 1.0_wp)
            j = s + n - i
            call add(i, j, cosine, k_sn, merge(1.0_wp, -1.0_wp, i == s))
            call add(i, j, sine, k_ss, merge(-0.5_wp, 0.5_wp, i == s))
            call add(i, j, sine, k_nn, merge(-0.5_wp, 0.5_wp, i == s))
         end do
      end select

   contains

      subroutine add(to, from, function_, k, factor)
         integer, intent(in) :: to, from, function_, k
         real(wp), intent(in) :: factor

         if (k >= k_xn .and. .not. allocated(self%table%xn)) return
         self%term = [self%term, term_type(to, from, function_, k, factor)]
      end subroutine add
   end subroutine make_terms

   !> Displacements in given directions due to tractions in given directions
   subroutine product(self, from, p, to, u, change)
      class(conformal_operator), intent(inout) :: self
      !> Directions; fields of shape (mx, my, number of directions)
      integer, intent(in) :: from(:), to(:)
      real(wp), intent(in) :: p(:, :, :)
      real(wp), intent(inout) :: u(:, :, :)
      !> Difference between two time steps of steady rolling?
      logical, intent(in) :: change
      logical :: sent(5, 3), met(5, 3)
      integer :: i, j, k, w, iy, pair(2)

      call self%need_all()
      sent = .false.
      met = .false.
      do k = 1, size(self%term)
         associate (t => self%term(k))
            if (.not. (any(from == t%from) .and. any(to == t%to))) cycle
            pair = weights(t%function_)
            sent(pair, t%from) = .true.
            met(pair, t%to) = .true.
         end associate
      end do
      do j = 1, size(from)
         do w = 1, 5
            if (.not. sent(w, from(j))) cycle
            do iy = 1, self%my
               self%field(:, iy) = self%weight(iy, w)*p(:, iy, j)
            end do
            call self%plan%forward(self%field, self%source(:, :, w, from(j)))
            self%transforms = self%transforms + 1
         end do
      end do
      do i = 1, size(to)
         do w = 1, 5
            if (met(w, to(i))) self%response(:, :, w, to(i)) = 0.0_wp
         end do
      end do
      do k = 1, size(self%term)
         associate (t => self%term(k))
            if (.not. (any(from == t%from) .and. any(to == t%to))) cycle
            select case (t%function_)
            case (one)
               call convolve(self, t, t%factor, one, one)
            case (cosine, half_cosine)
               call convolve(self, t, t%factor, t%function_, t%function_)
               call convolve(self, t, t%factor, t%function_ + 1, t%function_ + 1)
            case default
               call convolve(self, t, t%factor, t%function_, t%function_ - 1)
               call convolve(self, t, -t%factor, t%function_ - 1, t%function_)
            end select
         end associate
      end do
      do i = 1, size(to)
         u(:, :, i) = 0.0_wp
         do w = 1, 5
            if (.not. met(w, to(i))) cycle
            if (change) then
               do k = 1, self%plan%kx
                  self%response(:, k, w, to(i)) = self%difference(k)*self%response(:, k, w, to(i))
               end do
            end if
            call self%plan%backward(self%response(:, :, w, to(i)), self%field)
            self%transforms = self%transforms + 1
            do iy = 1, self%my
               u(:, iy, i) = u(:, iy, i) + self%weight(iy, w)*self%field(:, iy)
            end do
         end do
      end do
      self%products = self%products + 1
   end subroutine product

   !> Row weights on both sides for a function of the difference of inclinations
   pure function weights(function_) result(pair)
      integer, intent(in) :: function_
      integer :: pair(2)

      pair = [function_, function_]
      if (function_ == cosine .or. function_ == half_cosine) pair(2) = function_ + 1
      if (function_ == sine .or. function_ == half_sine) pair(2) = function_ - 1
   end function weights

   !> Add the convolution of a weighted traction to a displacement that is weighted afterwards
   subroutine convolve(self, term, factor, weight_from, weight_to)
      class(conformal_operator), intent(inout) :: self
      type(term_type), intent(in) :: term
      real(wp), intent(in) :: factor
      integer, intent(in) :: weight_from, weight_to
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)

      associate (p => self%source(:, :, weight_from, term%from), u => self%response(:, :, weight_to, term%to))
         select case (term%kernel)
         case (k_nn)
            u = u + factor*self%nn*p
         case (k_xx)
            u = u + factor*self%xx*p
         case (k_ss)
            u = u + factor*self%yy*p
         case (k_xs)
            u = u + factor*self%xy*p
         case (k_xn)
            u = u + i*factor*self%xn*p
         case default
            u = u + i*factor*self%yn*p
         end select
      end associate
   end subroutine convolve

   subroutine normal(self, p, u)
      class(conformal_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :)
      real(wp), allocatable :: all_u(:, :, :)

      allocate(all_u(self%mx, self%my, 1))
      call product(self, [n], reshape(p, [self%mx, self%my, 1]), [n], all_u, .false.)
      u = all_u(:, :, 1)
   end subroutine normal

   subroutine normal_by_tangential(self, p, u)
      class(conformal_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :)
      real(wp), allocatable :: all_u(:, :, :)

      allocate(all_u(self%mx, self%my, 1))
      call product(self, [x, s], p, [n], all_u, .false.)
      u = all_u(:, :, 1)
   end subroutine normal_by_tangential

   subroutine pair_product(self, p, u, change)
      class(conformal_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      logical, intent(in) :: change
      call product(self, [x, s], p, [x, s], u, change)
   end subroutine pair_product

   subroutine by_normal(self, p, u, change)
      class(conformal_operator), intent(inout) :: self
      real(wp), contiguous, intent(in) :: p(:, :)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      logical, intent(in) :: change
      call product(self, [n], reshape(p, [self%mx, self%my, 1]), [x, s], u, change)
   end subroutine by_normal
end module contact_elastic_conformal
