!> Displacements after a step that a few limited pressures shorten, without a product of the whole window
module contact_normal_few_limits
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_normal_problem, only : normal_problem
   use contact_numeric_pieces, only : first_of, length_of, most_pieces, pieces_of
   use contact_numeric_vectors, only : add
   implicit none (type, external)
   private

   public :: add_limits, find_limits, limited_pressures

   !> Maximum number of pressures: their sums take a quarter of the time of a product; measured
   integer, parameter :: most = 16

   !> Elements whose pressures a step would make negative
   type :: limited_pressures
      !> Number of elements, -1 if there are too many, or if coefficients differ from element to element
      integer :: n = -1
      !> Indices of the elements
      integer :: at(2, most) = 0
      !> Changes by the limit [N/mm2], positive
      real(wp) :: change(most) = 0.0_wp
   end type limited_pressures

contains

   !> Find the pressures that a step makes negative
   type(limited_pressures) function find_limits(problem, operator, alpha, d, p) result(limits)
      !> Window
      type(normal_problem), intent(in) :: problem
      !> Operator of the window
      class(compliance), intent(in) :: operator
      !> Length of the step
      real(wp), intent(in) :: alpha
      !> Its direction, and the pressures before it [N/mm2]
      real(wp), intent(in) :: d(problem%mx*problem%my), p(problem%mx*problem%my)
      integer :: n

      if (allocated(problem%parts) .or. .not. operator%has_table() .or. allocated(operator%model%memory)) return
      n = problem%mx*problem%my
      if (pieces_of(n) == 1) then
         call find_in_piece(problem%mx, 1, n, alpha, d, p, limits)
      else
         call find_in_pieces(problem%mx, n, alpha, d, p, limits)
      end if
   end function find_limits

   !> The same in a large window, whose pieces threads share
   subroutine find_in_pieces(mx, n, alpha, d, p, limits)
      !> Elements of a row, and of the window
      integer, intent(in) :: mx, n
      !> See `find_limits`
      real(wp), intent(in) :: alpha, d(n), p(n)
      !> On entry none were found
      type(limited_pressures), intent(inout) :: limits
      type(limited_pressures) :: part(most_pieces)
      integer :: j, k, pieces

      pieces = pieces_of(n)
      !$omp parallel do
      do k = 1, pieces
         associate (i => first_of(n, k))
            call find_in_piece(mx, i, length_of(n, k), alpha, d(i), p(i), part(k))
         end associate
      end do
      !$omp end parallel do
      if (any(part(:pieces)%n < 0)) return
      if (sum(part(:pieces)%n) > most) return
      limits%n = 0
      do k = 1, pieces
         do j = 1, part(k)%n
            limits%n = limits%n + 1
            limits%at(:, limits%n) = part(k)%at(:, j)
            limits%change(limits%n) = part(k)%change(j)
         end do
      end do
   end subroutine find_in_pieces

   !> The same in a piece of the window
   pure subroutine find_in_piece(mx, first, n, alpha, d, p, limits)
      !> Elements of a row; number of the first element of the piece, row by row, and number of its elements
      integer, intent(in) :: mx, first, n
      !> See `find_limits`
      real(wp), intent(in) :: alpha, d(n), p(n)
      !> n = -1 if there are too many
      type(limited_pressures), intent(inout) :: limits
      integer :: k, number

      limits%n = 0
      do k = 1, n
         if (.not. p(k) + alpha*d(k) < 0.0_wp) cycle
         if (limits%n == most) then
            limits%n = -1
            return
         end if
         limits%n = limits%n + 1
         number = first - 1 + k
         limits%at(:, limits%n) = [number - ((number - 1)/mx)*mx, (number - 1)/mx + 1]
         limits%change(limits%n) = -(p(k) + alpha*d(k))
      end do
   end subroutine find_in_piece

   !> Add the displacements due to the limits
   subroutine add_limits(limits, problem, operator, u)
      !> At most a few
      type(limited_pressures), intent(in) :: limits
      !> Window
      type(normal_problem), intent(in) :: problem
      !> Its coefficients extend to all offsets within the window
      class(compliance), intent(in) :: operator
      !> Displacements [mm], shape (mx, my)
      real(wp), intent(inout) :: u(problem%mx, problem%my)
      integer :: iy

      if (limits%n <= 0) return
      if (pieces_of(problem%mx*problem%my) == 1) then
         do iy = 1, problem%my
            call add_to_row(iy)
         end do
      else
         !$omp parallel do
         do iy = 1, problem%my
            call add_to_row(iy)
         end do
         !$omp end parallel do
      end if

   contains

      !> The displacements of a row
      subroutine add_to_row(iy)
         integer, intent(in) :: iy
         integer :: k

         do k = 1, limits%n
            call add(problem%mx, limits%change(k), operator%table%nn(1 - limits%at(1, k), iy - limits%at(2, k)), u(1, iy))
         end do
      end subroutine add_to_row
   end subroutine add_limits
end module contact_normal_few_limits
