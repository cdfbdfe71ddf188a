!> Operations on rows and columns between their transforms
!>
!> Arguments have explicit shape, so that the compiler knows that lines are contiguous. Time-consuming loops are in lines.c.
module contact_fft_lines
   use, intrinsic :: iso_c_binding, only : c_double, c_double_complex, c_int
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: copy, multiply_block, multiply_one, multiply_opposites, multiply_two, put_together, separate_rows, turn_one, turn_two

   interface
      !> Product of a complex spectrum and a real one
      pure subroutine multiply_one(n, xx, a) bind(c, name="contact_lines_one")
         import :: c_double, c_double_complex, c_int
         !> Length
         integer(c_int), value :: n
         !> Real spectrum
         real(c_double), intent(in) :: xx(n)
         !> On exit the product
         complex(c_double_complex), intent(inout) :: a(n)
      end subroutine multiply_one

      !> Product of two spectra with a symmetric 2 by 2 block, then with a scalar
      pure subroutine multiply_block(n, xx, yy, xy, turn, a, b) bind(c, name="contact_lines_block")
         import :: c_double, c_double_complex, c_int
         !> Length
         integer(c_int), value :: n
         !> Entries of the block
         real(c_double), intent(in) :: xx(n), yy(n), xy(n)
         !> Scalar; absent: 1
         complex(c_double_complex), intent(in), optional :: turn
         !> On exit the product
         complex(c_double_complex), intent(inout) :: a(n), b(n)
      end subroutine multiply_block

      !> Product of a spectrum with a scalar
      pure subroutine turn_one(n, turn, a) bind(c, name="contact_lines_turn")
         import :: c_double_complex, c_int
         !> Length
         integer(c_int), value :: n
         !> Scalar
         complex(c_double_complex), intent(in) :: turn
         !> On exit the product
         complex(c_double_complex), intent(inout) :: a(n)
      end subroutine turn_one

      !> Product with a symmetric 2 by 2 block, for frequencies of the transform of two real fields, the first + i times the
      !> second
      !>
      !> With s and d half the sum and half the difference of xx and yy, it is s z(k) + (d + i xy) conj(z(-k)).
      pure subroutine multiply_opposites(n, mean, half, mixed, x, y) bind(c, name="contact_lines_opposites")
         import :: c_double, c_double_complex, c_int
         !> Number of frequencies
         integer(c_int), value :: n
         !> s, d and xy
         real(c_double), intent(in) :: mean(n), half(n), mixed(n)
         !> Frequencies k, and -k in reversed order; on exit the product
         complex(c_double_complex), intent(inout) :: x(n), y(n)
      end subroutine multiply_opposites

      !> The same product for the transform of two real lines
      pure subroutine multiply_two(px, xx, yy, xy, z) bind(c, name="contact_lines_pair")
         import :: c_double, c_double_complex, c_int
         !> Length
         integer(c_int), value :: px
         !> Entries of the block
         real(c_double), intent(in) :: xx(px/2 + 1), yy(px/2 + 1), xy(px/2 + 1)
         !> On exit the product
         complex(c_double_complex), intent(inout) :: z(px)
      end subroutine multiply_two

      !> Product of such a transform and the spectrum of another real line
      pure subroutine turn_two(px, factor, z) bind(c, name="contact_lines_turn_pair")
         import :: c_double_complex, c_int
         !> Length
         integer(c_int), value :: px
         !> Spectrum of the real line
         complex(c_double_complex), intent(in) :: factor(px/2 + 1)
         !> On exit the product
         complex(c_double_complex), intent(inout) :: z(px)
      end subroutine turn_two

      !> All frequencies of `separate_rows` except the first
      pure subroutine separate_both(px, z, rows, both) bind(c, name="contact_lines_apart")
         import :: c_double_complex, c_int
         !> Length
         integer(c_int), value :: px
         !> Transform of the first row + i times the second
         complex(c_double_complex), intent(in) :: z(px)
         !> Number of all rows
         integer(c_int), value :: rows
         !> Starting at the first of the two rows; receives the transforms of both
         complex(c_double_complex), intent(inout) :: both(rows*(px/2) + 2)
      end subroutine separate_both

      !> Frequencies of `put_together` that have a conjugate partner
      pure subroutine put_both_together(px, rows, both, z) bind(c, name="contact_lines_together")
         import :: c_double_complex, c_int
         !> Length, number of all rows
         integer(c_int), value :: px, rows
         !> Starting at the first of the two rows
         complex(c_double_complex), intent(in) :: both(rows*(px/2) + 2)
         !> Receives the transform of the first row + i times the second
         complex(c_double_complex), intent(inout) :: z(px)
      end subroutine put_both_together
   end interface

contains

   !> Transforms of two rows, from half that of the first + i times the second
   pure subroutine separate_rows(px, z, rows, iy, half)
      !> Length, number of all rows, index of the first of the two
      integer, intent(in) :: px, rows, iy
      !> Transform of the first row + i times the second
      complex(wp), intent(in) :: z(px)
      !> Transforms of all rows; those of the two are set
      complex(wp), intent(inout) :: half(rows, px/2 + 1)
      integer :: k

      half(iy, 1) = 2.0_wp*z(1)%re
      if (iy < rows) then
         half(iy + 1, 1) = 2.0_wp*z(1)%im
         call separate_both(px, z, rows, half(iy, 1))
      else
         ! a last row without a partner
         do k = 2, px/2 + 1
            half(iy, k) = z(k) + conjg(z(px + 2 - k))
         end do
      end if
   end subroutine separate_rows

   !> Transform of the first row + i times the second, from the transforms of both; these belong to real values
   pure subroutine put_together(px, rows, iy, half, z)
      !> Length, number of all rows, index of the first of the two
      integer, intent(in) :: px, rows, iy
      !> Transforms of all rows
      complex(wp), intent(in) :: half(rows, px/2 + 1)
      !> Receives the transform of the first row + i times the second
      complex(wp), intent(inout) :: z(px)
      integer :: k

      if (iy < rows) then
         z(1) = cmplx(half(iy, 1)%re, half(iy + 1, 1)%re, wp)
         call put_both_together(px, rows, half(iy, 1), z)
         if (mod(px, 2) == 0) z(px/2 + 1) = cmplx(half(iy, px/2 + 1)%re, half(iy + 1, px/2 + 1)%re, wp)
      else
         ! a last row without a partner
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
      !> Source
      complex(wp), intent(in) :: from(n)
      !> Target
      complex(wp), intent(inout) :: to(n)

      to = from
   end subroutine copy
end module contact_fft_lines
