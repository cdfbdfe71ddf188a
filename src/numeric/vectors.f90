!> Sums and inner products of long vectors
!>
!> Several sums in turn, which a processor adds at once: one after the other each addition waits for the one before. The loops are
!> in vectors.c.
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
         !> The vectors, or one of them twice
         real(c_double), intent(in) :: a(n), b(n)
      end function inner

      !> b := b + factor a
      pure subroutine add(n, factor, a, b) bind(c, name="contact_vectors_add")
         import :: c_double, c_int
         !> Length
         integer(c_int), value :: n
         !> What a is multiplied with
         real(c_double), value :: factor
         !> What is added
         real(c_double), intent(in) :: a(n)
         !> What it is added to
         real(c_double), intent(inout) :: b(n)
      end subroutine add
   end interface
end module contact_numeric_vectors
