!> Operations on rows and columns between their transforms
!>
!> Arguments have explicit shape, so that the compiler knows that lines are contiguous. Time-consuming loops are in lines.c.
module contact_fft_lines
   use, intrinsic :: iso_c_binding, only : c_double, c_double_complex, c_int
   implicit none (type, external)
   private

   public :: multiply_one, multiply_two, turn_two

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

      !> Product with a symmetric 2 by 2 block, for the transform of two real lines, the first + i times the second
      !>
      !> With s and d half the sum and half the difference of xx and yy, it is s z(k) + (d + i xy) conj(z(-k)).
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
   end interface
end module contact_fft_lines
