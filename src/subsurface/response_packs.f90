!> Spectra of the responses at one depth, in packs
!>
!> The 27 responses, nine fields by three tractions, are even or odd in each coordinate. The part of a real field that is even
!> or odd in x and in y has a spectrum that is real or imaginary and even or odd in the second frequency. Up to four responses
!> of different symmetry are therefore obtained from one real transform of their sum, and half of the real or imaginary parts is
!> sufficient.
module contact_subsurface_response_packs
   use, intrinsic :: iso_c_binding, only : c_double, c_double_complex, c_int
   use contact_base_kinds, only : wp
   use contact_fft_plan, only : fft_plan
   use contact_subsurface_element_field, only : odd_in_x, odd_in_y
   implicit none (type, external)
   private

   public :: add_products, choose_packs, group, n_parts, response_pack, transform_pack

   !> Symmetries: even in x and y, odd in x, odd in y, odd in both
   integer, parameter :: n_parts = 4

   !> Responses transformed together, one of each symmetry
   type :: response_pack
      !> Group of the fields
      integer :: group = 0
      !> Index of the field within the group, and traction; 0: none
      integer :: field(n_parts) = 0, load(n_parts) = 0
   end type response_pack

   !> Groups of fields processed together, to save memory: displacements, normal and shear stresses
   integer, parameter :: group(3, 3) = reshape([1, 2, 3,  4, 7, 9,  5, 6, 8], [3, 3])

   interface
      !> Product of a column of a response and one of a traction; in pack_products.c
      pure subroutine multiply_column(n, half, factor, other_half, flags, traction, product) bind(c, name="contact_pack_product")
         import :: c_double, c_double_complex, c_int
         !> Length of the column, and number of stored factors
         integer(c_int), value :: n, half
         !> Factors; the remaining ones are the same in reverse order, times other_half
         real(c_double), intent(in) :: factor(half)
         real(c_double), value :: other_half
         !> 1 or 0: multiply by i; add to the present values
         integer(c_int), intent(in) :: flags(2)
         complex(c_double_complex), intent(in) :: traction(n)
         complex(c_double_complex), intent(inout) :: product(n)
      end subroutine multiply_column
   end interface

contains

   !> Arrange the responses to non-zero tractions in packs
   pure subroutine choose_packs(acts, packs)
      !> Non-zero tractions
      logical, intent(in) :: acts(3)
      !> Each response is in one of them
      type(response_pack), allocatable, intent(out) :: packs(:)
      type(response_pack) :: pack
      logical :: done(size(group, 1), 3)
      integer :: f, g, part, t

      allocate(packs(0))
      do g = 1, size(group, 2)
         do t = 1, 3
            done(:, t) = .not. acts(t)
         end do
         do while (.not. all(done))
            pack = response_pack(group=g)
            do t = 1, 3
               do f = 1, size(group, 1)
                  part = 1 + merge(1, 0, odd_in_x(group(f, g), t)) + merge(2, 0, odd_in_y(group(f, g), t))
                  if (done(f, t) .or. pack%field(part) > 0) cycle
                  pack%field(part) = f
                  pack%load(part) = t
                  done(f, t) = .true.
               end do
            end do
            packs = [packs, pack]
         end do
      end do
   end subroutine choose_packs

   !> Spectra of the responses of a pack
   subroutine transform_pack(pack, response, plan, period, packed, factor)
      !> Responses of the pack
      type(response_pack), intent(in) :: pack
      !> Responses for differences 0...nx, 0...ny
      real(wp), contiguous, intent(in) :: response(0:, 0:, :, :)
      !> Plan for transforms of full periods
      type(fft_plan), intent(inout) :: plan
      !> Workspace: a period, shape (px, py)
      real(wp), contiguous, intent(inout) :: period(:, :)
      !> Workspace: its spectrum, shape (py, px/2 + 1)
      complex(wp), contiguous, intent(inout) :: packed(:, :)
      !> Real or imaginary parts of the spectra, shape (py/2 + 1, px/2 + 1, 4); 0 for absent symmetries
      real(wp), contiguous, intent(out) :: factor(:, :, :)
      integer :: f, part, t

      period = 0.0_wp
      do part = 1, n_parts
         if (pack%field(part) == 0) cycle
         f = group(pack%field(part), pack%group)
         t = pack%load(part)
         call add_to_period(response(:, :, f, t), odd_in_x(f, t), odd_in_y(f, t), period)
      end do
      call plan%forward(period, packed)
      do part = 1, n_parts
         factor(:, :, part) = 0.0_wp
         if (pack%field(part) > 0) call extract_part(packed, is_odd_in_x(part), is_odd_in_y(part), factor(:, :, part))
      end do
   end subroutine transform_pack

   !> Is a part odd in x?
   elemental logical function is_odd_in_x(part)
      integer, intent(in) :: part
      is_odd_in_x = mod(part - 1, 2) == 1
   end function is_odd_in_x

   !> Is a part odd in y?
   elemental logical function is_odd_in_y(part)
      integer, intent(in) :: part
      is_odd_in_y = part > 2
   end function is_odd_in_y

   !> Add the products of the responses of a pack and their tractions to the spectra of the fields
   pure subroutine add_products(pack, factor, spectrum, product, has_begun)
      !> Responses of the pack
      type(response_pack), intent(in) :: pack
      !> Real or imaginary parts of the spectra of the responses, shape (py/2 + 1, px/2 + 1, 4)
      real(wp), contiguous, intent(in) :: factor(:, :, :)
      !> Spectra of the tractions, shape (py, px/2 + 1, 3)
      complex(wp), contiguous, intent(in) :: spectrum(:, :, :)
      !> Spectra of the fields of the group, shape (py, px/2 + 1, 3)
      complex(wp), contiguous, intent(inout) :: product(:, :, :)
      !> Which of them contain values already; the others are overwritten
      logical, intent(inout) :: has_begun(:)
      integer :: part

      do part = 1, n_parts
         associate (field => pack%field(part))
            if (field == 0) cycle
            call add_product(factor(:, :, part), is_odd_in_x(part), is_odd_in_y(part), has_begun(field), &
               & spectrum(:, :, pack%load(part)), product(:, :, field))
            has_begun(field) = .true.
         end associate
      end do
   end subroutine add_products

   !> Extend a response to negative differences and add it to a full period
   pure subroutine add_to_period(response, odd_x, odd_y, period)
      !> Response for differences 0...nx, 0...ny
      real(wp), contiguous, intent(in) :: response(0:, 0:)
      logical, intent(in) :: odd_x, odd_y
      !> One period, shape (px, py); difference 0 is at (1, 1)
      real(wp), contiguous, intent(inout) :: period(:, :)
      real(wp) :: row(0:ubound(response, 1)), sx, sy
      integer :: k, l, nx, px

      nx = ubound(response, 1)
      px = size(period, 1)
      sx = merge(-1.0_wp, 1.0_wp, odd_x)
      sy = merge(-1.0_wp, 1.0_wp, odd_y)
      do l = 0, ubound(response, 2)
         row = response(:, l)
         ! an odd response is zero where it changes sign
         if (odd_x) row(0) = 0.0_wp
         if (odd_y .and. l == 0) cycle
         period(1:nx + 1, l + 1) = period(1:nx + 1, l + 1) + row
         do k = 1, nx
            period(px + 1 - k, l + 1) = period(px + 1 - k, l + 1) + sx*row(k)
         end do
         if (l == 0) cycle
         row = sy*row
         period(1:nx + 1, size(period, 2) + 1 - l) = period(1:nx + 1, size(period, 2) + 1 - l) + row
         do k = 1, nx
            period(px + 1 - k, size(period, 2) + 1 - l) = period(px + 1 - k, size(period, 2) + 1 - l) + sx*row(k)
         end do
      end do
   end subroutine add_to_period

   !> Extract one part from a spectrum of several responses
   pure subroutine extract_part(packed, odd_x, odd_y, factor)
      !> Spectrum of a sum of responses, shape (py, px/2 + 1)
      complex(wp), contiguous, intent(in) :: packed(:, :)
      !> Symmetry of the part
      logical, intent(in) :: odd_x, odd_y
      !> Its real or imaginary part, shape (py/2 + 1, px/2 + 1)
      real(wp), contiguous, intent(out) :: factor(:, :)
      real(wp) :: turned
      integer :: half, k, py

      py = size(packed, 1)
      half = size(factor, 1)
      turned = merge(-0.5_wp, 0.5_wp, odd_y)
      do k = 1, size(packed, 2)
         if (odd_x .eqv. odd_y) then
            factor(1, k) = (0.5_wp + turned)*real(packed(1, k))
            factor(2:, k) = 0.5_wp*real(packed(2:half, k)) + turned*real(packed(py:py + 2 - half:-1, k))
         else
            factor(1, k) = (0.5_wp + turned)*aimag(packed(1, k))
            factor(2:, k) = 0.5_wp*aimag(packed(2:half, k)) + turned*aimag(packed(py:py + 2 - half:-1, k))
         end if
      end do
   end subroutine extract_part

   !> Product of a response and a traction, which replaces a field or is added to it
   pure subroutine add_product(factor, odd_x, odd_y, is_added, traction, product)
      !> Real or imaginary part of the spectrum of the response, shape (py/2 + 1, px/2 + 1)
      real(wp), contiguous, intent(in) :: factor(:, :)
      !> Its symmetry
      logical, intent(in) :: odd_x, odd_y
      !> Is it added to the present values?
      logical, intent(in) :: is_added
      !> Spectra of the traction and of the field, shape (py, px/2 + 1)
      complex(wp), contiguous, intent(in) :: traction(:, :)
      complex(wp), contiguous, intent(inout) :: product(:, :)
      integer :: flags(2), k

      flags = merge(1, 0, [odd_x .neqv. odd_y, is_added])
      do k = 1, size(traction, 2)
         call multiply_column(size(traction, 1), size(factor, 1), factor(:, k), merge(-1.0_wp, 1.0_wp, odd_y), flags, &
            & traction(:, k), product(:, k))
      end do
   end subroutine add_product
end module contact_subsurface_response_packs
