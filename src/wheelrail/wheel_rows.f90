!> Heights of a round wheel over the rows of a patch
!>
!> Along a row the wheel's surface is close to a polynomial: heights computed at a few points give those of all elements. If the
!> last terms of the polynomial are not small, as with profiles whose curvature varies from point to point, all heights are computed
!> directly.
module contact_wheelrail_wheel_rows
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_wheel_loops, only : spread_polynomial, together
   use contact_wheelrail_wheel_surface, only : row_from_estimates, wheel_height, wheel_row
   implicit none (type, external)
   private

   public :: wheel_rows

   !> Number of points of a row for a polynomial: the number computed at a time
   integer, parameter :: terms = together
   !> Maximum of the last two terms of a polynomial that is as accurate as the heights themselves [mm]
   real(wp), parameter :: negligible = 1.0e-10_wp
   !> Coefficients of the powers (first index) of each Chebyshev polynomial, and of the highest power of the last two
   real(wp), parameter :: chebyshev(terms, terms) = reshape(real([ &
      & 1, 0, 0, 0, 0, 0, 0, 0,   0, 1, 0, 0, 0, 0, 0, 0,   -1, 0, 2, 0, 0, 0, 0, 0,   0, -3, 0, 4, 0, 0, 0, 0, &
      & 1, 0, -8, 0, 8, 0, 0, 0,  0, 5, 0, -20, 0, 16, 0, 0,  -1, 0, 18, 0, -48, 0, 32, 0,  0, -7, 0, 56, 0, -112, 0, 64], wp), &
      & [terms, terms])
   real(wp), parameter :: chebyshev_end(2) = [chebyshev(terms - 1, terms - 1), chebyshev(terms, terms)]
   !> Number of consecutive rows without such a polynomial, after which none is tried
   integer, parameter :: patience = 5
   !> Maximum number of stored rows, for quadratic extrapolation
   integer, parameter :: remembered = 3

   !> Consecutive rows of a patch at even distances; its arrays are reused for further patches
   type :: wheel_rows
      private
      !> First and last point along a row [mm], and number of points
      real(wp) :: ends(2) = 0.0_wp
      integer :: points = 0
      !> Points at which heights are computed [mm]: all, or `terms`
      real(wp) :: nodes(terms) = 0.0_wp
      integer :: few = 0
      !> Positions on the profile (1...terms) and heights of previous rows at the nodes [mm], the last row first, and number of
      !> known rows
      real(wp) :: rows(2*terms, remembered) = 0.0_wp
      integer :: known = 0
      !> Initial values of the first point of a row: position on the profile and height [mm]
      real(wp) :: start(2) = 0.0_wp
      !> Number of consecutive rows without a polynomial so far
      integer :: failures = 0
      !> All points, their positions on the profile, and the previous rows as in `rows`: for rows without polynomials. The arrays
      !> may be larger than the number of points of this patch
      real(wp), allocatable :: x(:), place(:), all_rows(:, :)
      !> Workspace: positions and heights of one row
      real(wp), allocatable :: row(:)
      logical, allocatable :: found(:)
      !> Do they belong to this patch?
      logical :: has_all = .false.
   contains
      !> Prepare for the first row
      procedure :: begin
      !> Compute the heights of a row
      procedure :: find
   end type wheel_rows

contains

   !> Prepare for rows over the same points
   pure subroutine begin(self, ends, points, start)
      class(wheel_rows), intent(inout) :: self
      !> First and last point along the track [mm]
      real(wp), intent(in) :: ends(2)
      !> Number of points, at even distances
      integer, intent(in) :: points
      !> Position on the profile and height near the first point [mm]
      real(wp), intent(in) :: start(2)
      integer :: i
      !> Points at which heights are computed, relative to the middle and half the length of a row
      real(wp), parameter :: places(terms) = [(-cos(pi*i/(terms - 1)), i=0, terms - 1)]

      self%ends = ends
      self%points = points
      self%start = start
      self%few = min(points, terms)
      self%known = 0
      self%rows = 0.0_wp
      self%failures = 0
      self%has_all = .false.
      if (points > terms) then
         self%nodes = 0.5_wp*(ends(1) + ends(2)) + 0.5_wp*(ends(2) - ends(1))*places
      else
         do i = 1, points
            self%nodes(i) = point_at(self, i)
         end do
      end if
   end subroutine begin

   !> Position of a point along the track [mm]
   pure real(wp) function point_at(self, i)
      type(wheel_rows), intent(in) :: self
      integer, intent(in) :: i
      point_at = self%ends(1) + (i - 1)*((self%ends(2) - self%ends(1))/max(1, self%points - 1))
   end function point_at

   !> Heights of the wheel's surface over the next row of the plane
   pure subroutine find(self, wheel, radius, seen, s, missing, n)
      class(wheel_rows), intent(inout) :: self
      !> Profile of a round wheel in its own coordinates
      type(profile_curve), intent(in) :: wheel
      !> Radius of the wheel at the origin of its profile [mm]
      real(wp), intent(in) :: radius
      !> The plane in the axes of the wheel
      type(frame), intent(in) :: seen
      !> Position of the row [mm]
      real(wp), intent(in) :: s
      !> Height if the line along n does not meet the wheel
      real(wp), intent(in) :: missing
      !> Height over each point [mm]
      real(wp), contiguous, intent(out) :: n(:)
      real(wp) :: some(2*terms), last(2)
      logical :: some_found(terms)
      integer :: i, j
      !> Weights of sums whose first and last terms are halved
      real(wp), parameter :: ends_half(0:terms - 1) = [0.5_wp, (1.0_wp, i=1, terms - 2), 0.5_wp]
      !> Coefficients of Chebyshev polynomials (first index) through heights at the points of `begin`
      real(wp), parameter :: factors(terms, terms) = reshape([((2.0_wp/(terms - 1)*ends_half(i)*ends_half(j) &
         & *cos(pi*i*(terms - 1 - j)/(terms - 1)), i=0, terms - 1), j=0, terms - 1)], [terms, terms])
      !> Coefficients of the powers through heights there
      real(wp), parameter :: powers(terms, terms) = matmul(chebyshev, factors)

      if (self%failures >= patience) then
         call find_all(self, wheel, radius, seen, s, n)
      else
         call find_nodes(self, wheel, radius, seen, s, some, some_found)
         if (self%points == self%few) then
            do i = 1, self%few
               n(i) = merge(some(terms + i), missing, some_found(i))
            end do
            return
         end if
         associate (some_places => some(:terms), some_n => some(terms + 1:))
            if (all(some_found)) then
               call spread_polynomial(powers, some_n, self%points, n, last)
               if (sum(last/chebyshev_end) <= negligible .and. is_inside(wheel, some_places)) then
                  self%failures = 0
                  return
               end if
            end if
            call make_room(self)
            if (all(some_found)) then
               self%failures = self%failures + 1
               call spread_polynomial(powers, some_places, self%points, self%place, last)
               call row_from_estimates(wheel, radius, seen, self%x(:self%points), s, self%place(:self%points), n, &
                  & self%found(:self%points))
            else
               call wheel_row(wheel, radius, seen, self%x(:self%points), s, self%start, self%place(:self%points), n, &
                  & self%found(:self%points))
            end if
         end associate
         if (self%failures == patience) then
            self%known = 0
            call keep_all(self, n)
         end if
      end if
      do i = 1, self%points
         if (.not. self%found(i)) n(i) = missing
      end do
   end subroutine find

   !> Heights at the nodes, estimated from previous rows if there are any
   pure subroutine find_nodes(self, wheel, radius, seen, s, some, found)
      type(wheel_rows), intent(inout) :: self
      !> See `find`
      type(profile_curve), intent(in) :: wheel
      real(wp), intent(in) :: radius
      type(frame), intent(in) :: seen
      real(wp), intent(in) :: s
      !> Position on the profile (1...terms) and height at each node [mm], set if found
      real(wp), intent(out) :: some(2*terms)
      logical, intent(out) :: found(terms)
      integer :: i

      associate (m => self%few, place => some(:terms), n => some(terms + 1:))
         found = .true.
         if (self%known > 0) then
            call estimate(2*terms, self%rows, self%known, some)
            call row_from_estimates(wheel, radius, seen, self%nodes(:m), s, place(:m), n(:m), found(:m))
         else
            some = 0.0_wp
            place(1) = self%start(1)
            n(1) = self%start(2)
            call wheel_height(wheel, radius, seen, self%nodes(1), s, place(1), n(1), found(1))
            if (found(1)) self%start = [place(1), n(1)]
            ! the others are estimated by the circle of the wheel
            do i = 2, m
               place(i) = self%start(1)
               n(i) = self%start(2) - 0.5_wp*(self%nodes(i)**2 - self%nodes(1)**2)/radius
            end do
            call row_from_estimates(wheel, radius, seen, self%nodes(2:m), s, place(2:m), n(2:m), found(2:m))
         end if
         if (found(1)) self%start = [place(1), n(1)]
         call keep(2*terms, some, all(found), self%rows, self%known)
      end associate
   end subroutine find_nodes

   !> Heights at all points, estimated from previous rows if there are any
   pure subroutine find_all(self, wheel, radius, seen, s, n)
      type(wheel_rows), intent(inout) :: self
      !> See `find`
      type(profile_curve), intent(in) :: wheel
      real(wp), intent(in) :: radius
      type(frame), intent(in) :: seen
      real(wp), intent(in) :: s
      !> Height of each point [mm], set if found
      real(wp), intent(out) :: n(:)

      associate (m => self%points)
         if (self%known > 0) then
            call estimate(2*m, self%all_rows, self%known, self%row)
            self%place(:m) = self%row(:m)
            n = self%row(m + 1:2*m)
            call row_from_estimates(wheel, radius, seen, self%x(:m), s, self%place(:m), n, self%found(:m))
         else
            call wheel_row(wheel, radius, seen, self%x(:m), s, self%start, self%place(:m), n, self%found(:m))
         end if
      end associate
      if (self%found(1)) self%start = [self%place(1), n(1)]
      call keep_all(self, n)
   end subroutine find_all

   !> Store a row with all points
   pure subroutine keep_all(self, n)
      !> With the positions on the profile
      type(wheel_rows), intent(inout) :: self
      !> Height of each point [mm]
      real(wp), intent(in) :: n(:)

      self%row(:self%points) = self%place(:self%points)
      self%row(self%points + 1:2*self%points) = n
      call keep(2*self%points, self%row, all(self%found(:self%points)), self%all_rows, self%known)
   end subroutine keep_all

   !> Allocate the arrays for all points
   pure subroutine make_room(self)
      type(wheel_rows), intent(inout) :: self
      integer :: i

      if (self%has_all) return
      self%has_all = .true.
      if (allocated(self%x)) then
         if (size(self%x) < self%points) deallocate(self%x, self%place, self%found, self%all_rows, &
            & self%row)
      end if
      if (.not. allocated(self%x)) allocate(self%x(self%points), self%place(self%points), self%found(self%points), &
         & self%all_rows(2*self%points, remembered), self%row(2*self%points))
      do i = 1, self%points
         self%x(i) = point_at(self, i)
      end do
      self%all_rows(:2*self%points, :) = 0.0_wp
   end subroutine make_room

   !> Estimate positions and heights of the next row, from the previous ones
   pure subroutine estimate(n, rows, known, row)
      !> Number of positions and heights of a row
      integer, intent(in) :: n
      !> Positions, then heights, of previous rows [mm], the last row first, shape (2 points, remembered)
      real(wp), contiguous, intent(in) :: rows(:, :)
      !> Number of previous rows
      integer, intent(in) :: known
      !> Positions, then heights [mm]
      real(wp), intent(out) :: row(n)
      integer :: i

      select case (known)
      case (1)
         do i = 1, n
            row(i) = rows(i, 1)
         end do
      case (2)
         do i = 1, n
            row(i) = 2.0_wp*rows(i, 1) - rows(i, 2)
         end do
      case default
         do i = 1, n
            row(i) = 3.0_wp*(rows(i, 1) - rows(i, 2)) + rows(i, 3)
         end do
      end select
   end subroutine estimate

   !> Store a row; if some of its points were not found, the list of rows is cleared
   pure subroutine keep(n, row, found, rows, known)
      !> Number of positions and heights of a row
      integer, intent(in) :: n
      !> Positions, then heights [mm]
      real(wp), intent(in) :: row(n)
      !> Were all points found?
      logical, intent(in) :: found
      !> See `estimate`
      real(wp), contiguous, intent(inout) :: rows(:, :)
      integer, intent(inout) :: known
      integer :: i

      known = merge(min(known + 1, remembered), 0, found)
      if (.not. found) return
      do i = 1, n
         rows(i, 3) = rows(i, 2)
         rows(i, 2) = rows(i, 1)
         rows(i, 1) = row(i)
      end do
   end subroutine keep

   !> Are all positions between those at the nodes on the profile as well?
   pure logical function is_inside(wheel, place)
      type(profile_curve), intent(in) :: wheel
      !> Positions at the nodes [mm]
      real(wp), intent(in) :: place(terms)
      real(wp) :: ends(2), low, high

      ends = wheel%s_range()
      low = minval(place)
      high = maxval(place)
      is_inside = 2.0_wp*low - high >= ends(1) .and. 2.0_wp*high - low <= ends(2)
   end function is_inside
end module contact_wheelrail_wheel_rows
