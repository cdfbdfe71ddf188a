!> Sums and inner products of long vectors
!>
!> Several partial sums are accumulated alternately, so that the processor can overlap them instead of waiting for the previous
!> addition. The loops are in vectors.c.
module contact_numeric_vectors
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: add, inner

   interface
      !> Inner product, of vectors whose squares neither overflow nor vanish
      pure real(c_double) function inner(n, a, b) bind(c, name="contact_vectors_inner")
         import :: c_double, c_int
         !> Length
         integer(c_int), value :: n
         !> Vectors, or the same one twice
         real(c_double), intent(in) :: a(n), b(n)
      end function inner

      !> b := b + factor a
      pure subroutine add(n, factor, a, b) bind(c, name="contact_vectors_add")
         import :: c_double, c_int
         !> Length
         integer(c_int), value :: n
         !> Multiplies a
         real(c_double), value :: factor
         !> Vector to add
         real(c_double), intent(in) :: a(n)
         !> Vector that is changed
         real(c_double), intent(inout) :: b(n)
      end subroutine add
   end interface
end module contact_numeric_vectors
