!> Transforms of rows and columns of real fields, eight rows or four columns at once
!>
!> Of a product with a kernel these are the steps: rows forward, columns forward, multiply, columns back, rows back. The loops are
!> in four_lines.c. Results do not depend on how the rows and columns are divided, if blocks of rows start at 1, 9, 17 ...
module contact_fft_four_lines
   use, intrinsic :: iso_c_binding, only : c_double, c_double_complex, c_int
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: line_factors, line_steps, work_size, columns_at_once, rows_at_once
   public :: four_columns_backward, four_columns_forward, four_columns_one, four_columns_two, four_rows_backward, four_rows_forward

   integer, parameter :: rows_at_once = 8, columns_at_once = 4
   !> Factors of lengths with a step of their own, in the order of the steps, which is the fastest
   integer, parameter :: steps(*) = [4, 3, 5, 7]
   !> What remains of a power of two is done last
   integer, parameter :: last_steps(*) = [8, 2]
   !> Largest number of steps: one for each factor of the largest integer
   integer, parameter :: most_steps = 32

   !> Steps of the transform of one length, as in four_lines.c
   type, bind(c) :: line_steps
      !> Length, and number of steps
      integer(c_int) :: n = 0, count = 0
      !> Factors of the length in the order of the steps forward, then 0
      integer(c_int) :: radices(most_steps) = 0
      !> Where the factors of a step start, from 0, counting real numbers
      integer(c_int) :: starts(most_steps) = 0
   end type line_steps

   !> The same with its tables
   type :: line_factors
      type(line_steps) :: steps
      !> Positions of frequencies 0...n - 1 after a transform, from 0
      integer(c_int), allocatable :: positions(:)
      !> For each step of r: r - 1 factors for each position, then the roots of unity of order r if r has no step of its own
      complex(wp), allocatable :: factors(:)
   contains
      !> Prepare transforms of a length
      procedure :: prepare
      !> Free the tables: components of plans in arrays of derived types are not released without it
      procedure :: release
   end type line_factors

   abstract interface
      !> Transform of some columns
      subroutine columns_transform(steps, positions, factors, my, columns, from, to, work) bind(c)
         import :: c_double, c_double_complex, c_int, line_steps
         implicit none (type, external)
         !> Components of line_factors for the padded length
         type(line_steps), intent(in) :: steps
         integer(c_int), intent(in) :: positions(*)
         complex(c_double_complex), intent(in) :: factors(*)
         !> Length of the columns, and their number, 4 at most
         integer(c_int), value :: my, columns
         !> Forward: rows after their transform, from the first of these columns on; back: the spectrum
         complex(c_double_complex), intent(in) :: from(*)
         !> The other one of these, and workspace
         complex(c_double_complex), intent(inout) :: to(*)
         real(c_double), intent(inout) :: work(*)
      end subroutine columns_transform
   end interface

   procedure(columns_transform), bind(c, name="contact_four_columns_forward") :: four_columns_forward
   procedure(columns_transform), bind(c, name="contact_four_columns_backward") :: four_columns_backward

   interface
      !> Transforms of up to eight rows, of which the first is row iy
      subroutine four_rows_forward(steps, positions, factors, mx, rows, all_rows, field, half, work) &
         & bind(c, name="contact_four_rows_forward")
         import :: c_double, c_double_complex, c_int, line_steps
         implicit none (type, external)
         !> Steps for the padded length
         type(line_steps), intent(in) :: steps
         !> Positions of the frequencies
         integer(c_int), intent(in) :: positions(*)
         !> Factors between the steps
         complex(c_double_complex), intent(in) :: factors(*)
         !> Length of the rows, their number, 8 at most, and that of all rows
         integer(c_int), value :: mx, rows, all_rows
         !> Rows, shape (mx, all_rows), from the first of them on
         real(c_double), intent(in) :: field(*)
         !> Receives their transforms, shape (4, all_rows, (px/2 + 4)/4), from the first of them on: real parts of four
         !> frequencies, and their imaginary parts
         complex(c_double_complex), intent(inout) :: half(*)
         !> Workspace, of work_size
         real(c_double), intent(inout) :: work(*)
      end subroutine four_rows_forward

      !> The same back
      subroutine four_rows_backward(steps, positions, factors, mx, rows, all_rows, half, field, work) &
         & bind(c, name="contact_four_rows_backward")
         import :: c_double, c_double_complex, c_int, line_steps
         implicit none (type, external)
         !> Steps for the padded length
         type(line_steps), intent(in) :: steps
         !> Positions of the frequencies
         integer(c_int), intent(in) :: positions(*)
         !> Factors between the steps
         complex(c_double_complex), intent(in) :: factors(*)
         !> Length of the rows, their number, 8 at most, and that of all rows
         integer(c_int), value :: mx, rows, all_rows
         !> Transforms, from the first of these rows on
         complex(c_double_complex), intent(in) :: half(*)
         !> Receives the rows, and workspace
         real(c_double), intent(inout) :: field(*), work(*)
      end subroutine four_rows_backward

      !> Transform some columns, multiply them by a real spectrum, and transform them back
      subroutine four_columns_one(steps, positions, factors, my, columns, xx, half, work) &
         & bind(c, name="contact_four_columns_one")
         import :: c_double, c_double_complex, c_int, line_steps
         implicit none (type, external)
         !> Steps for the padded length
         type(line_steps), intent(in) :: steps
         !> Positions of the frequencies
         integer(c_int), intent(in) :: positions(*)
         !> Factors between the steps
         complex(c_double_complex), intent(in) :: factors(*)
         !> Length of the columns, and their number, 4 at most
         integer(c_int), value :: my, columns
         !> Spectrum of the kernel, shape (py, columns)
         real(c_double), intent(in) :: xx(*)
         !> Rows after their transform, from the first of these columns on; on exit before their transform back
         complex(c_double_complex), intent(inout) :: half(*)
         !> Workspace, of work_size
         real(c_double), intent(inout) :: work(*)
      end subroutine four_columns_one

      !> The same for two fields and a symmetric 2 by 2 block
      subroutine four_columns_two(steps, positions, factors, my, columns, xx, yy, xy, turn, half, work) &
         & bind(c, name="contact_four_columns_two")
         import :: c_double, c_double_complex, c_int, line_steps
         implicit none (type, external)
         !> Steps for the padded length
         type(line_steps), intent(in) :: steps
         !> Positions of the frequencies
         integer(c_int), intent(in) :: positions(*)
         !> Factors between the steps
         complex(c_double_complex), intent(in) :: factors(*)
         !> Length of the columns, and their number, 4 at most
         integer(c_int), value :: my, columns
         !> Spectra of the block, shape (py, columns)
         real(c_double), intent(in) :: xx(*), yy(*), xy(*)
         !> Scalar for each column; absent: 1
         complex(c_double_complex), intent(in), optional :: turn(*)
         !> Rows of both fields after their transform, from the first of these columns on; on exit before their transform back
         complex(c_double_complex), intent(inout) :: half(*)
         !> Workspace, of work_size
         real(c_double), intent(inout) :: work(*)
      end subroutine four_columns_two
   end interface

contains

   !> Size of the work space for transforms of a length, including room to align it
   pure integer function work_size(n)
      !> The longest length
      integer, intent(in) :: n

      ! three buffers of real and imaginary parts of four lines
      work_size = 3*2*columns_at_once*n + 2*columns_at_once
   end function work_size

   subroutine prepare(self, n)
      class(line_factors), intent(inout) :: self
      !> Length
      integer, intent(in) :: n
      complex(wp) :: roots(0:n - 1)
      integer :: at, j, k, length, p, r

      if (self%steps%n == n) return
      self%steps%n = n
      call find_steps(n, self%steps%radices, self%steps%count)
      call find_roots(n, roots)
      if (allocated(self%factors)) deallocate(self%factors, self%positions)
      allocate(self%factors(count_factors(self%steps)), self%positions(0:n - 1))
      at = 0
      length = n
      do k = 1, self%steps%count
         r = self%steps%radices(k)
         self%steps%starts(k) = 2*at
         do p = 0, length/r - 1
            do j = 1, r - 1
               at = at + 1
               self%factors(at) = roots(p*j*(n/length))
            end do
         end do
         if (.not. has_own_step(r)) then
            self%factors(at + 1:at + r) = roots(0:n - 1:n/r)
            at = at + r
         end if
         length = length/r
      end do
      do k = 0, n - 1
         self%positions(k) = position_of(k, self%steps)
      end do
   end subroutine prepare

   subroutine release(self)
      class(line_factors), intent(inout) :: self

      self%steps%n = 0
      if (allocated(self%factors)) deallocate(self%factors, self%positions)
   end subroutine release

   !> Position of a frequency after a transform, from 0: the first digit of the frequency is the last one of its position
   pure integer(c_int) function position_of(frequency, steps) result(position)
      integer, intent(in) :: frequency
      type(line_steps), intent(in) :: steps
      integer :: k, length, rest

      position = 0
      rest = frequency
      length = steps%n
      do k = 1, steps%count
         length = length/steps%radices(k)
         position = position + length*mod(rest, steps%radices(k))
         rest = rest/steps%radices(k)
      end do
   end function position_of

   !> Roots of unity of order n, clockwise
   pure subroutine find_roots(n, roots)
      integer, intent(in) :: n
      complex(wp), intent(out) :: roots(0:n - 1)
      real(wp) :: angle
      integer :: k, quarter

      quarter = n/4
      if (4*quarter < n) then
         do k = 0, n - 1
            angle = 2.0_wp*pi*k/n
            roots(k) = cmplx(cos(angle), -sin(angle), wp)
         end do
         return
      end if
      ! an eighth of the circle and its mirror images
      do k = 0, quarter/2
         angle = 2.0_wp*pi*k/n
         roots(k) = cmplx(cos(angle), -sin(angle), wp)
         if (k > 0) roots(quarter - k) = cmplx(sin(angle), -cos(angle), wp)
      end do
      do k = quarter, n - 1
         roots(k) = cmplx(roots(k - quarter)%im, -roots(k - quarter)%re, wp)
      end do
   end subroutine find_roots

   !> Is there a step for this factor?
   pure logical function has_own_step(r)
      integer, intent(in) :: r
      has_own_step = any(steps == r) .or. any(last_steps == r)
   end function has_own_step

   !> Number of factors between the steps
   pure integer function count_factors(steps) result(total)
      type(line_steps), intent(in) :: steps
      integer :: k, length

      total = 0
      length = steps%n
      do k = 1, steps%count
         total = total + (steps%radices(k) - 1)*(length/steps%radices(k))
         if (.not. has_own_step(steps%radices(k))) total = total + steps%radices(k)
         length = length/steps%radices(k)
      end do
   end function count_factors

   !> Factors of a length in the order of the steps
   pure subroutine find_steps(n, radices, k)
      integer, intent(in) :: n
      integer(c_int), intent(out) :: radices(most_steps)
      !> Their number
      integer(c_int), intent(out) :: k
      integer :: candidate, last, r, rest

      radices = 0
      last = 1
      ! 2 or 8 where the power of two is odd
      if (mod(trailz(n), 2) == 1) last = merge(last_steps(1), last_steps(2), mod(n, last_steps(1)) == 0)
      rest = n/last
      k = 0
      candidate = 1
      do while (rest > 1)
         ! after the known steps any integer, of which only primes are left
         r = maxval(steps) + candidate - size(steps)
         if (candidate <= size(steps)) r = steps(candidate)
         if (mod(rest, r) == 0) then
            k = k + 1
            radices(k) = r
            rest = rest/r
         else
            candidate = candidate + 1
         end if
      end do
      if (last == 1) return
      k = k + 1
      radices(k) = last
   end subroutine find_steps
end module contact_fft_four_lines
