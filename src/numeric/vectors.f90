!> Sums and inner products of long vectors
!>
!> Several partial sums are accumulated alternately, so that the processor can overlap them instead of waiting for the previous
!> addition. The loops are in vectors.c.
module contact_numeric_vectors
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: add, add_four, inner, inner_four

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

      !> Inner products of four vectors with one, the same numbers as by `inner`
      pure subroutine inner_four(n, stride, a, b, sums) bind(c, name="contact_vectors_inner_four")
         import :: c_double, c_int
         !> Length that counts, and that from one of the four to the next
         integer(c_int), value :: n, stride
         !> The four, and the one
         real(c_double), intent(in) :: a(stride, 4), b(n)
         !> The products
         real(c_double), intent(inout) :: sums(4)
      end subroutine inner_four

      !> b := b + factors times four vectors, the same numbers as by `add` in turn
      pure subroutine add_four(n, stride, factor, a, b) bind(c, name="contact_vectors_add_four")
         import :: c_double, c_int
         !> Length that counts, and that from one of the four to the next
         integer(c_int), value :: n, stride
         !> What each of the four is multiplied with
         real(c_double), intent(in) :: factor(4)
         !> What is added
         real(c_double), intent(in) :: a(stride, 4)
         !> What it is added to
         real(c_double), intent(inout) :: b(n)
      end subroutine add_four
   end interface
end module contact_numeric_vectors
