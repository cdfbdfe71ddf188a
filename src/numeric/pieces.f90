!> Long vectors in pieces that threads share
!>
!> Pieces do not depend on the number of threads, nor does the order in which their sums are added: results are the same to the last
!> digit whatever the number of threads is. A parallel region requests memory, even one of a single thread; shorter vectors,
!> which are done before threads are awake, are one piece and have none.
module contact_numeric_pieces
   use contact_base_kinds, only : wp
   use contact_numeric_vectors, only : add, clear_numbers, copy_numbers, inner
   implicit none (type, external)
   private

   public :: add_long, clear_long, copy_field, copy_long, copy_whole, divide_long, fill_long, fill_whole, first_of, inner_long, &
      & length_of, most_pieces, pieces_of

   !> Pieces of a vector at most
   integer, parameter :: most_pieces = 64
   !> Numbers of a piece at least, a multiple of those that are taken at once, and of the longest vector that is one piece; chosen
   integer, parameter :: least = 8192, worth_threads = 40000, at_once = 8

contains

   !> Numbers of a piece, but for the last one
   elemental integer function whole_piece(n)
      !> Length of the vector
      integer, intent(in) :: n

      whole_piece = max(least, at_once*((n + at_once*most_pieces - 1)/(at_once*most_pieces)))
   end function whole_piece

   !> Number of pieces; 1: not worth threads
   elemental integer function pieces_of(n) result(pieces)
      !> Length of the vector
      integer, intent(in) :: n

      pieces = 1
      if (n > worth_threads) pieces = (n + whole_piece(n) - 1)/whole_piece(n)
   end function pieces_of

   !> Position of the first number of a piece
   elemental integer function first_of(n, piece)
      !> Length of the vector, and number of the piece
      integer, intent(in) :: n, piece

      first_of = whole_piece(n)*(piece - 1) + 1
   end function first_of

   !> Length of a piece of a vector that has several
   elemental integer function length_of(n, piece)
      !> Length of the vector, and number of the piece
      integer, intent(in) :: n, piece

      length_of = min(whole_piece(n), n + 1 - first_of(n, piece))
   end function length_of

   !> Inner product
   real(wp) function inner_long(n, a, b) result(product)
      !> Length
      integer, intent(in) :: n
      !> The vectors, or one of them twice
      real(wp), intent(in) :: a(n), b(n)
      real(wp) :: part(most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         product = inner(n, a, b)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         part(k) = inner(length_of(n, k), a(first_of(n, k)), b(first_of(n, k)))
      end do
      !$omp end parallel do
      product = sum(part(:pieces_of(n)))
   end function inner_long

   !> b := b + factor a
   subroutine add_long(n, factor, a, b)
      !> Length
      integer, intent(in) :: n
      !> What a is multiplied with
      real(wp), intent(in) :: factor
      !> What is added
      real(wp), intent(in) :: a(n)
      !> What it is added to
      real(wp), intent(inout) :: b(n)
      integer :: k

      if (pieces_of(n) == 1) then
         call add(n, factor, a, b)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         call add(length_of(n, k), factor, a(first_of(n, k)), b(first_of(n, k)))
      end do
      !$omp end parallel do
   end subroutine add_long

   !> b := a
   subroutine copy_long(n, a, b)
      !> Length
      integer, intent(in) :: n
      !> What is copied
      real(wp), intent(in) :: a(n)
      !> Where it is copied to
      real(wp), intent(inout) :: b(n)
      integer :: i, k

      if (pieces_of(n) == 1) then
         call copy_numbers(n, a, b)
         return
      end if
      !$omp parallel do private(i)
      do k = 1, pieces_of(n)
         do i = first_of(n, k), first_of(n, k) + length_of(n, k) - 1
            b(i) = a(i)
         end do
      end do
      !$omp end parallel do
   end subroutine copy_long

   !> Copy a field, which is allocated anew only if its shape changes
   subroutine copy_field(from, to)
      !> Original
      real(wp), contiguous, intent(in) :: from(:, :)
      !> Copy
      real(wp), allocatable, intent(inout) :: to(:, :)

      if (allocated(to)) then
         if (any(shape(to) /= shape(from))) deallocate(to)
      end if
      if (.not. allocated(to)) allocate(to(size(from, 1), size(from, 2)))
      call copy_long(size(from), from, to)
   end subroutine copy_field

   !> v := value
   subroutine fill_long(n, value, v)
      !> Length
      integer, intent(in) :: n
      !> Of all its numbers
      real(wp), intent(in) :: value
      !> The vector
      real(wp), intent(inout) :: v(n)
      integer :: i, k

      if (pieces_of(n) == 1) then
         v = value
         return
      end if
      !$omp parallel do private(i)
      do k = 1, pieces_of(n)
         do i = first_of(n, k), first_of(n, k) + length_of(n, k) - 1
            v(i) = value
         end do
      end do
      !$omp end parallel do
   end subroutine fill_long

   !> v := 0; new memory is cleared by the system when it is first touched, which threads also share
   subroutine clear_long(n, v)
      !> Length
      integer, intent(in) :: n
      !> The vector
      real(wp), intent(inout) :: v(n)

      if (pieces_of(n) == 1) then
         call clear_numbers(n, v)
      else
         call fill_long(n, 0.0_wp, v)
      end if
   end subroutine clear_long

   !> v := value, whole numbers
   subroutine fill_whole(n, value, v)
      !> Length
      integer, intent(in) :: n
      !> Of all its numbers
      integer, intent(in) :: value
      !> The vector
      integer, intent(inout) :: v(n)
      integer :: i, k

      if (pieces_of(n) == 1) then
         v = value
         return
      end if
      !$omp parallel do private(i)
      do k = 1, pieces_of(n)
         do i = first_of(n, k), first_of(n, k) + length_of(n, k) - 1
            v(i) = value
         end do
      end do
      !$omp end parallel do
   end subroutine fill_whole

   !> b := a, whole numbers
   subroutine copy_whole(n, a, b)
      !> Length
      integer, intent(in) :: n
      !> What is copied
      integer, intent(in) :: a(n)
      !> Where it is copied to
      integer, intent(inout) :: b(n)
      integer :: i, k

      if (pieces_of(n) == 1) then
         b = a
         return
      end if
      !$omp parallel do private(i)
      do k = 1, pieces_of(n)
         do i = first_of(n, k), first_of(n, k) + length_of(n, k) - 1
            b(i) = a(i)
         end do
      end do
      !$omp end parallel do
   end subroutine copy_whole

   !> v := v/divisor
   subroutine divide_long(n, divisor, v)
      !> Length
      integer, intent(in) :: n
      !> Not 0
      real(wp), intent(in) :: divisor
      !> The vector
      real(wp), intent(inout) :: v(n)
      integer :: i, k

      if (pieces_of(n) == 1) then
         v = v/divisor
         return
      end if
      !$omp parallel do private(i)
      do k = 1, pieces_of(n)
         do i = first_of(n, k), first_of(n, k) + length_of(n, k) - 1
            v(i) = v(i)/divisor
         end do
      end do
      !$omp end parallel do
   end subroutine divide_long
end module contact_numeric_pieces
