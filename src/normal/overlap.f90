!> The part of the potential contact area in which the undeformed bodies overlap at a prescribed approach
!>
!> Pressures move the surfaces apart in all elements if no coefficient is negative. Elements outside of the overlap are then
!> never in contact, and the normal problem may be solved in a window around it.
module contact_normal_overlap
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_normal_problem, only : normal_problem
   implicit none (type, external)
   private

   public :: overlap_window, window_near, window_type

   !> A window of elements within a larger one
   type :: window_type
      !> Size in elements; 0 if there is none
      integer :: mx = 0, my = 0
      !> Numbers of elements of the larger window before it
      integer :: before_x = 0, before_y = 0
   contains
      !> Cut a problem out of a larger one
      procedure :: cut
      !> Cut out a field, and set the larger field to one that was cut out, zero elsewhere
      procedure :: part_of
      procedure :: put_back
   end type window_type

   !> A window with a larger fraction of the elements is not worth its own coefficients; chosen
   real(wp), parameter :: much_smaller = 0.6_wp, somewhat_smaller = 0.75_wp
   !> Sides are multiples of this number, so that the window is the same for similar approaches; chosen
   integer, parameter :: unit_side = 8
   !> The same for a window around estimated pressures, with its margin on each side in elements; chosen
   integer, parameter :: unit_near = 4, margin = 2

contains

   !> Window around the overlap; of size 0 if it does not contain all contact, or is not much smaller
   type(window_type) function overlap_window(problem, operator, pen) result(window)
      !> Undeformed distance; the approach must be prescribed
      type(normal_problem), intent(in) :: problem
      !> Its coefficients are checked
      class(compliance), intent(in) :: operator
      !> Approach [mm]
      real(wp), intent(in) :: pen
      integer :: first(2), last(2), iy

      if (problem%force_prescribed .or. problem%follows .or. allocated(problem%parts)) return
      if (.not. operator%has_table() .or. allocated(operator%model%memory)) return
      first = huge(1)
      last = 0
      do iy = 1, problem%my
         associate (row => problem%h(:, iy) < pen)
            if (.not. any(row)) cycle
            first = min(first, [findloc(row, .true., 1), iy])
            last = max(last, [findloc(row, .true., 1, back=.true.), iy])
         end associate
      end do
      if (last(1) == 0) return
      window = window_around(problem, first, last, unit_side, much_smaller)
      if (window%mx == 0) return
      if (.not. all(operator%table%nn >= 0.0_wp)) window = window_type()
   end function overlap_window

   !> Window around estimated pressures; of size 0 if it is not much smaller than that of the problem
   type(window_type) function window_near(problem, operator, p) result(window)
      !> One of a sequence of problems, with a prescribed approach
      type(normal_problem), intent(in) :: problem
      !> Prepared for the window of the problem
      class(compliance), intent(in) :: operator
      !> Estimated pressures [N/mm2], shape (mx, my)
      real(wp), intent(in) :: p(:, :)
      integer :: first(2), last(2), ix, iy

      if (problem%force_prescribed .or. .not. problem%follows .or. allocated(problem%parts)) return
      if (.not. operator%has_table() .or. allocated(operator%model%memory) .or. allocated(operator%model%inclination)) return
      first = huge(1)
      last = 0
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. p(ix, iy) > 0.0_wp) cycle
            first = min(first, [ix, iy])
            last = max(last, [ix, iy])
         end do
      end do
      if (last(1) == 0) return
      window = window_around(problem, max(1, first - margin), min([problem%mx, problem%my], last + margin), unit_near, &
         & somewhat_smaller)
   end function window_near

   !> Window around a range of elements; of size 0 if it is not smaller than a fraction of the larger window
   pure type(window_type) function window_around(problem, first, last, unit, fraction) result(window)
      !> Problem on the larger window
      type(normal_problem), intent(in) :: problem
      !> First and last column and row
      integer, intent(in) :: first(2), last(2)
      !> The sides are multiples of this number of elements
      integer, intent(in) :: unit
      !> Fraction of the elements [-]
      real(wp), intent(in) :: fraction
      integer :: from(2), to(2)

      from = first
      to = last
      call fit_side(problem%mx, unit, from(1), to(1))
      call fit_side(problem%my, unit, from(2), to(2))
      if (real(to(1) - from(1) + 1, wp)*(to(2) - from(2) + 1) > fraction*problem%mx*problem%my) return
      window = window_type(to(1) - from(1) + 1, to(2) - from(2) + 1, from(1) - 1, from(2) - 1)
   end function window_around

   !> Extend a range of elements to a multiple of a unit, within the larger window
   pure subroutine fit_side(n, unit, first, last)
      !> Number of elements of the larger window, and the unit
      integer, intent(in) :: n, unit
      !> First and last element
      integer, intent(inout) :: first, last
      integer :: length

      length = min(n, unit*((last - first + unit)/unit))
      first = max(1, min(first, n - length + 1))
      last = first + length - 1
   end subroutine fit_side

   pure function part_of(self, whole) result(part)
      class(window_type), intent(in) :: self
      !> Field on the larger window
      real(wp), intent(in) :: whole(:, :)
      real(wp) :: part(self%mx, self%my)

      part = whole(self%before_x + 1:self%before_x + self%mx, self%before_y + 1:self%before_y + self%my)
   end function part_of

   pure subroutine put_back(self, part, whole)
      class(window_type), intent(in) :: self
      !> Field on this window
      real(wp), intent(in) :: part(:, :)
      !> Field on the larger window
      real(wp), intent(inout) :: whole(:, :)

      whole = 0.0_wp
      whole(self%before_x + 1:self%before_x + self%mx, self%before_y + 1:self%before_y + self%my) = part
   end subroutine put_back

   subroutine cut(self, whole, part)
      class(window_type), intent(in) :: self
      !> Problem on the larger window
      type(normal_problem), intent(in) :: whole
      !> Receives size, distances, and limits
      type(normal_problem), intent(inout) :: part

      part%mx = self%mx
      part%my = self%my
      part%dx = whole%dx
      part%dy = whole%dy
      part%h = self%part_of(whole%h)
      part%force_prescribed = .false.
      part%eps = whole%eps
      part%maxgs = whole%maxgs
      part%deadline = whole%deadline
   end subroutine cut
end module contact_normal_overlap
