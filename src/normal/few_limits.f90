!> Displacements after a step that a few limited pressures shorten, without a product of the whole window
module contact_normal_few_limits
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_normal_problem, only : normal_problem
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
   pure type(limited_pressures) function find_limits(problem, operator, alpha, d, p) result(limits)
      !> Window
      type(normal_problem), intent(in) :: problem
      !> Operator of the window
      class(compliance), intent(in) :: operator
      !> Length of the step
      real(wp), intent(in) :: alpha
      !> Its direction, and the pressures before it [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: d(:, :), p(:, :)
      integer :: ix, iy

      if (allocated(problem%parts) .or. .not. operator%has_table() .or. allocated(operator%model%memory)) return
      limits%n = 0
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. p(ix, iy) + alpha*d(ix, iy) < 0.0_wp) cycle
            if (limits%n == most) then
               limits%n = -1
               return
            end if
            limits%n = limits%n + 1
            limits%at(:, limits%n) = [ix, iy]
            limits%change(limits%n) = -(p(ix, iy) + alpha*d(ix, iy))
         end do
      end do
   end function find_limits

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
      integer :: iy, k

      do k = 1, limits%n
         do iy = 1, problem%my
            call add(problem%mx, limits%change(k), operator%table%nn(1 - limits%at(1, k), iy - limits%at(2, k)), u(1, iy))
         end do
      end do
   end subroutine add_limits
end module contact_normal_few_limits
