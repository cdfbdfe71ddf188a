!> What is done to rows and columns between their transforms
!>
!> Arguments have their shapes told, so that the compiler knows that lines are contiguous. What takes time is in lines.c.
module contact_fft_lines
   use, intrinsic :: iso_c_binding, only : c_double, c_double_complex, c_int
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: copy, multiply_block, multiply_one, multiply_opposites, multiply_two, put_together, take_apart, turn_one, turn_two

   interface
      !> Product of a spectrum with a real one
      pure subroutine multiply_one(n, xx, a) bind(c, name="contact_lines_one")
         import :: c_double, c_double_complex, c_int
         !> Length
         integer(c_int), value :: n
         !> The real one
         real(c_double), intent(in) :: xx(n)
         !> Becomes the product
         complex(c_double_complex), intent(inout) :: a(n)
      end subroutine multiply_one

      !> Product of two spectra with a symmetric 2 by 2 block, then with one number
      pure subroutine multiply_block(n, xx, yy, xy, turn, a, b) bind(c, name="contact_lines_block")
         import :: c_double, c_double_complex, c_int
         !> Length
         integer(c_int), value :: n
         !> The block
         real(c_double), intent(in) :: xx(n), yy(n), xy(n)
         !> The number; absent: 1
         complex(c_double_complex), intent(in), optional :: turn
         !> Become the product
         complex(c_double_complex), intent(inout) :: a(n), b(n)
      end subroutine multiply_block

      !> Product of a spectrum with one number
      pure subroutine turn_one(n, turn, a) bind(c, name="contact_lines_turn")
         import :: c_double_complex, c_int
         !> Length
         integer(c_int), value :: n
         !> The number
         complex(c_double_complex), intent(in) :: turn
         !> Becomes the product
         complex(c_double_complex), intent(inout) :: a(n)
      end subroutine turn_one

      !> Product with a symmetric 2 by 2 block for frequencies of the transform of two real fields, the first + i times the second
      !>
      !> With s and d the half sum and the half difference of xx and yy it is s z(k) + (d + i xy) conj(z(-k)).
      pure subroutine multiply_opposites(n, mean, half, mixed, x, y) bind(c, name="contact_lines_opposites")
         import :: c_double, c_double_complex, c_int
         !> Number of frequencies
         integer(c_int), value :: n
         !> s, d and xy
         real(c_double), intent(in) :: mean(n), half(n), mixed(n)
         !> Frequencies, and their opposites in reversed order: become the product
         complex(c_double_complex), intent(inout) :: x(n), y(n)
      end subroutine multiply_opposites

      !> The same product for the transform of two real lines
      pure subroutine multiply_two(px, xx, yy, xy, z) bind(c, name="contact_lines_pair")
         import :: c_double, c_double_complex, c_int
         !> Length
         integer(c_int), value :: px
         !> The block
         real(c_double), intent(in) :: xx(px/2 + 1), yy(px/2 + 1), xy(px/2 + 1)
         !> Becomes the product
         complex(c_double_complex), intent(inout) :: z(px)
      end subroutine multiply_two

      !> Such a transform times the spectrum of one more real line
      pure subroutine turn_two(px, factor, z) bind(c, name="contact_lines_turn_pair")
         import :: c_double_complex, c_int
         !> Length
         integer(c_int), value :: px
         !> The spectrum
         complex(c_double_complex), intent(in) :: factor(px/2 + 1)
         !> Becomes the product
         complex(c_double_complex), intent(inout) :: z(px)
      end subroutine turn_two

      !> All but the first frequency of `take_apart`
      pure subroutine take_both_apart(px, z, rows, both) bind(c, name="contact_lines_apart")
         import :: c_double_complex, c_int
         !> Length
         integer(c_int), value :: px
         !> Transform of the sum
         complex(c_double_complex), intent(in) :: z(px)
         !> Rows in all
         integer(c_int), value :: rows
         !> From the first one of the two on: gets those of both
         complex(c_double_complex), intent(inout) :: both(rows*(px/2) + 2)
      end subroutine take_both_apart

      !> Frequencies of `put_together` that have an opposite
      pure subroutine put_both_together(px, rows, both, z) bind(c, name="contact_lines_together")
         import :: c_double_complex, c_int
         !> Length, rows in all
         integer(c_int), value :: px, rows
         !> From the first one of the two on
         complex(c_double_complex), intent(in) :: both(rows*(px/2) + 2)
         !> Gets the transform of the sum
         complex(c_double_complex), intent(inout) :: z(px)
      end subroutine put_both_together
   end interface

contains

   !> Transforms of two rows from half that of the first + i times half the second
   pure subroutine take_apart(px, z, rows, iy, half)
      !> Length, number of all rows, and that of the first one of the two
      integer, intent(in) :: px, rows, iy
      !> Transform of the sum
      complex(wp), intent(in) :: z(px)
      !> Transforms of all rows: gets those of the two
      complex(wp), intent(inout) :: half(rows, px/2 + 1)
      integer :: k

      half(iy, 1) = 2.0_wp*z(1)%re
      if (iy < rows) then
         half(iy + 1, 1) = 2.0_wp*z(1)%im
         call take_both_apart(px, z, rows, half(iy, 1))
      else
         ! a last row without a companion
         do k = 2, px/2 + 1
            half(iy, k) = z(k) + conjg(z(px + 2 - k))
         end do
      end if
   end subroutine take_apart

   !> Transform of the first row + i times the second one from theirs; they belong to real values
   pure subroutine put_together(px, rows, iy, half, z)
      !> Length, number of all rows, and that of the first one of the two
      integer, intent(in) :: px, rows, iy
      !> Transforms of all rows
      complex(wp), intent(in) :: half(rows, px/2 + 1)
      !> Gets that of the sum
      complex(wp), intent(inout) :: z(px)
      integer :: k

      if (iy < rows) then
         z(1) = cmplx(half(iy, 1)%re, half(iy + 1, 1)%re, wp)
         call put_both_together(px, rows, half(iy, 1), z)
         if (mod(px, 2) == 0) z(px/2 + 1) = cmplx(half(iy, px/2 + 1)%re, half(iy + 1, px/2 + 1)%re, wp)
      else
         ! a last row without a companion
         z(1) = half(iy, 1)%re
         do k = 2, (px + 1)/2
            z(k) = half(iy, k)
            z(px + 2 - k) = conjg(half(iy, k))
         end do
         if (mod(px, 2) == 0) z(px/2 + 1) = half(iy, px/2 + 1)%re
      end if
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
