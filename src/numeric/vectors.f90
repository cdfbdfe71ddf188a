!> Sums, inner products, extrema and copies of long vectors
!>
!> Several partial sums are accumulated alternately, so that the processor can overlap them instead of waiting for the previous
!> addition. The loops are in vectors.c.
module contact_numeric_vectors
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: add, add_four, clear_numbers, copy_numbers, inner, inner_four, largest_difference, largest_of, smallest_of

   !> Numbers that are copied or set by one call of the C library: it uses string instructions for more than two kilobytes, whose
   !> start takes as long as copying that number
   integer, parameter :: part = 128

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

      !> Smallest number, infinity if there is none; NaN are ignored
      pure real(c_double) function smallest_of(n, a) bind(c, name="contact_vectors_smallest")
         import :: c_double, c_int
         !> Length
         integer(c_int), value :: n
         !> Numbers
         real(c_double), intent(in) :: a(n)
      end function smallest_of

      !> Largest number, -infinity if there is none; NaN are ignored
      pure real(c_double) function largest_of(n, a) bind(c, name="contact_vectors_largest")
         import :: c_double, c_int
         !> Length
         integer(c_int), value :: n
         !> Numbers
         real(c_double), intent(in) :: a(n)
      end function largest_of

      !> Largest magnitude of the differences of two vectors; NaN are ignored
      pure real(c_double) function largest_difference(n, a, b) bind(c, name="contact_vectors_farthest")
         import :: c_double, c_int
         !> Length
         integer(c_int), value :: n
         !> Vectors
         real(c_double), intent(in) :: a(n), b(n)
      end function largest_difference
   end interface

contains

   !> Copy contiguous numbers
   !>
   !> Arrays of two dimensions are copied at once instead of column by column.
   pure subroutine copy_numbers(n, from, to)
      !> Length
      integer, intent(in) :: n
      !> Original
      real(wp), intent(in) :: from(n)
      !> Copy
      real(wp), intent(inout) :: to(n)

      integer :: i

      do i = 1, n, part
         to(i:min(i + part - 1, n)) = from(i:min(i + part - 1, n))
      end do
   end subroutine copy_numbers

   !> Set contiguous numbers to zero, see `copy_numbers`
   pure subroutine clear_numbers(n, to)
      !> Length
      integer, intent(in) :: n
      !> Numbers
      real(wp), intent(inout) :: to(n)

      integer :: i

      do i = 1, n, part
         to(i:min(i + part - 1, n)) = 0.0_wp
      end do
   end subroutine clear_numbers
end module contact_numeric_vectors
