!> What is done to rows and columns between their transforms
!>
!> Arguments have their shapes told, so that the compiler knows that lines are contiguous.
module contact_fft_lines
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: copy, multiply_block, multiply_one, multiply_two, put_together, take_apart, turn_both, turn_two

contains

   !> Product of a spectrum with a real one
   pure subroutine multiply_one(n, xx, a)
      !> Length
      integer, intent(in) :: n
      !> The real one
      real(wp), intent(in) :: xx(n)
      !> Becomes the product
      complex(wp), intent(inout) :: a(n)

      a%re = xx*a%re
      a%im = xx*a%im
   end subroutine multiply_one

   !> Product of two spectra with a symmetric 2 by 2 block
   pure subroutine multiply_block(n, xx, yy, xy, a, b)
      !> Length
      integer, intent(in) :: n
      !> The block
      real(wp), intent(in) :: xx(n), yy(n), xy(n)
      !> Become the product
      complex(wp), intent(inout) :: a(n), b(n)
      complex(wp) :: keep
      integer :: k

      do k = 1, n
         keep = a(k)
         a(k) = xx(k)*keep + xy(k)*b(k)
         b(k) = xy(k)*keep + yy(k)*b(k)
      end do
   end subroutine multiply_block

   !> Product of two spectra with one number
   pure subroutine turn_both(n, turn, a, b)
      !> Length
      integer, intent(in) :: n
      !> The number
      complex(wp), intent(in) :: turn
      !> Become the products
      complex(wp), intent(inout) :: a(n), b(n)

      a = turn*a
      b = turn*b
   end subroutine turn_both

   !> Product with a symmetric 2 by 2 block for the transform of two real lines, the first + i times the second
   !>
   !> With s and d the half sum and the half difference of xx and yy it is s z(k) + (d + i xy) conj(z(-k)).
   pure subroutine multiply_two(px, xx, yy, xy, z)
      !> Length
      integer, intent(in) :: px
      !> The block
      real(wp), intent(in) :: xx(px/2 + 1), yy(px/2 + 1), xy(px/2 + 1)
      !> Becomes the product
      complex(wp), intent(inout) :: z(px)
      complex(wp) :: here, there, mixed
      real(wp) :: mean
      integer :: k, j

      do k = 1, px/2 + 1
         j = merge(1, px + 2 - k, k == 1)
         mean = 0.5_wp*(xx(k) + yy(k))
         mixed = cmplx(0.5_wp*(xx(k) - yy(k)), xy(k), wp)
         here = z(k)
         there = z(j)
         z(k) = mean*here + mixed*conjg(there)
         z(j) = mean*there + mixed*conjg(here)
      end do
   end subroutine multiply_two

   !> Such a transform times the spectrum of one more real line
   pure subroutine turn_two(px, factor, z)
      !> Length
      integer, intent(in) :: px
      !> The spectrum
      complex(wp), intent(in) :: factor(px/2 + 1)
      !> Becomes the product
      complex(wp), intent(inout) :: z(px)
      integer :: k

      z(:px/2 + 1) = factor*z(:px/2 + 1)
      do k = 2, (px + 1)/2
         z(px + 2 - k) = conjg(factor(k))*z(px + 2 - k)
      end do
   end subroutine turn_two

   !> Transforms of two rows from half that of the first + i times half the second
   pure subroutine take_apart(px, z, rows, iy, half)
      !> Length, number of all rows, and that of the first one of the two
      integer, intent(in) :: px, rows, iy
      !> Transform of the sum
      complex(wp), intent(in) :: z(px)
      !> Transforms of all rows: gets those of the two
      complex(wp), intent(inout) :: half(rows, px/2 + 1)
      integer :: k, next

      ! where there is no second one, the first is written twice, and right at last
      next = min(iy + 1, rows)
      half(next, 1) = 2.0_wp*z(1)%im
      half(iy, 1) = 2.0_wp*z(1)%re
      do k = 2, px/2 + 1
         half(next, k)%re = z(px + 2 - k)%im + z(k)%im
         half(next, k)%im = z(px + 2 - k)%re - z(k)%re
         half(iy, k)%re = z(k)%re + z(px + 2 - k)%re
         half(iy, k)%im = z(k)%im - z(px + 2 - k)%im
      end do
   end subroutine take_apart

   !> Transform of the first row + i times the second one from theirs; they belong to real values
   pure subroutine put_together(px, rows, iy, half, z)
      !> Length, number of all rows, and that of the first one of the two
      integer, intent(in) :: px, rows, iy
      !> Transforms of all rows
      complex(wp), intent(in) :: half(rows, px/2 + 1)
      !> Gets that of the sum
      complex(wp), intent(inout) :: z(px)
      integer :: k, next

      ! a last row without a companion is its own one, and the imaginary part is left alone
      next = min(iy + 1, rows)
      z(1) = cmplx(half(iy, 1)%re, half(next, 1)%re, wp)
      do k = 2, (px + 1)/2
         z(k)%re = half(iy, k)%re - half(next, k)%im
         z(k)%im = half(iy, k)%im + half(next, k)%re
         z(px + 2 - k)%re = half(iy, k)%re + half(next, k)%im
         z(px + 2 - k)%im = half(next, k)%re - half(iy, k)%im
      end do
      if (px > 1) z(px/2 + 1) = cmplx(half(iy, px/2 + 1)%re, half(next, px/2 + 1)%re, wp)
   end subroutine put_together

   !> Copy a line
   pure subroutine copy(n, from, to)
      !> Length
      integer, intent(in) :: n
      !> What is copied
      complex(wp), intent(in) :: from(n)
      !> Where to
      complex(wp), intent(inout) :: to(n)

      to = from
   end subroutine copy
end module contact_fft_lines
