!> A prepared profile: smooth functions y(s), z(s) of the arc length, and the inverse s(y)
!>
!> Lateral coordinate y, z downwards, canonical order (contact_profile_points). Rails are viewed from above, wheels from below:
!> of several points with the same y only the visible one is used.
module contact_profile_curve
   use contact_base_kinds, only : long, wp
   use contact_numeric_polynomial, only : quadratic_roots
   use contact_numeric_spline, only : cubic_spline, piece_of
   use contact_profile_request, only : profile_side
   use contact_profile_stretches, only : find_turns, follow_stretch, piece_in_stretch, place_in_piece, place_in_stretch, sorted, &
      & stretch, stretch_between
   implicit none (type, external)
   private

   public :: profile_curve, new_curve, find_visible

   !> A visible part between two values of y, on which y is monotonic in s
   type :: visible_part
      !> Range of y, lower end first
      real(wp) :: low, high
      !> Stretch of the curve to which it belongs
      type(stretch) :: along
   end type visible_part

   !> One profile of a rail or a wheel
   type :: profile_curve
      !> Member of profile_side
      integer :: side = profile_side%rail
      !> Identifier assigned by the store that holds the curve, kept by copies: curves with the same number are identical. 0:
      !> none
      integer(long) :: number = 0
      !> Coordinates [mm] as functions of s [mm], on the same pieces
      type(cubic_spline) :: y, z
      !> Visible parts, in increasing order of y, without overlap
      type(visible_part), allocatable, private :: parts(:)
   contains
      !> Range of s, and visible range of y
      procedure :: s_range
      procedure :: y_range
      !> Arc length s of the visible point with a given y
      procedure :: s_at => place_at
      !> The same, if there is such a point
      procedure :: find => find_point
      !> The same, as piece of the splines and position in it
      procedure :: locate
      !> Both coordinates at s, with slopes
      procedure :: point => point_at
      !> Is there a visible point with this y?
      procedure :: has => has_point
      !> Height of the visible point
      procedure :: height
      !> Heights of visible points, in increasing order of y
      procedure :: heights
      !> Inclination of the surface [rad], positive where it descends towards larger y
      procedure :: inclination
      !> Outward unit normal (y, z)
      procedure :: normal
      !> Hidden fraction of the arc length, 0...1
      procedure :: hidden_part
      !> Number of visible parts, between which y jumps or the curve changes
      procedure :: part_count
      !> The same curve in shifted and rotated axes
      procedure :: seen_from
      !> The point of a rail with the smallest z
      procedure :: top
      !> Is another curve identical, bit by bit?
      procedure :: same_as
   end type profile_curve

   !> Ranges of y shorter than this are treated as vertical [mm]
   real(wp), parameter :: vertical = 1.0e-9_wp

contains

   !> Is another curve identical, bit by bit?
   pure logical function same_as(self, other)
      class(profile_curve), intent(in) :: self
      !> Curve to compare with
      type(profile_curve), intent(in) :: other

      same_as = self%number > 0 .and. self%number == other%number
      if (same_as) return
      same_as = allocated(self%y%c) .and. allocated(other%y%c)
      if (same_as) same_as = all(shape(self%y%c) == shape(other%y%c))
      if (same_as) same_as = all(self%y%s == other%y%s) .and. all(self%y%c == other%y%c) .and. all(self%z%c == other%z%c)
   end function same_as

   !> Create a curve from its coordinates
   function new_curve(side, y, z) result(curve)
      !> Member of profile_side
      integer, intent(in) :: side
      !> Coordinates on the same pieces
      type(cubic_spline), intent(in) :: y, z
      type(profile_curve) :: curve

      curve%side = side
      curve%y = y
      curve%z = z
      call find_visible(curve)
   end function new_curve

   !> Split the curve where y reverses, and keep the visible part at each y
   subroutine find_visible(curve, around)
      !> Splines on entry; visible parts are set
      type(profile_curve), intent(inout) :: curve
      !> Arc lengths s [mm]: only stretches that contain one of them are considered; default: all
      real(wp), intent(in), optional :: around(:)
      real(wp), allocatable :: turns(:), ends(:), low(:), high(:)
      type(stretch), allocatable :: stretches(:)
      real(wp) :: middle, best, here
      integer :: i, j, n, chosen, previous

      call find_turns(curve%y, turns)
      n = size(turns) - 1
      if (allocated(curve%parts)) deallocate(curve%parts)
      if (n == 1) then
         call mark_all_visible(curve)
         return
      end if
      allocate(low(n), high(n))
      low = min(curve%y%value(turns(:n)), curve%y%value(turns(2:)))
      high = max(curve%y%value(turns(:n)), curve%y%value(turns(2:)))
      allocate(stretches(n))
      do j = 1, n
         stretches(j) = stretch_between(curve%y, turns(j), turns(j + 1))
      end do
      if (present(around)) then
         do j = 1, n
            if (any(around >= turns(j) .and. around <= turns(j + 1))) cycle
            ! an empty range of y contains no point
            low(j) = huge(low)
            high(j) = -huge(high)
         end do
      end if
      ends = sorted([pack(low, low <= high), pack(high, low <= high)])
      allocate(curve%parts(0))
      previous = 0
      do i = 1, size(ends) - 1
         if (ends(i + 1) - ends(i) <= vertical) cycle
         middle = 0.5_wp*(ends(i) + ends(i + 1))
         chosen = 0
         best = 0.0_wp
         do j = 1, n
            if (low(j) > middle .or. high(j) < middle) cycle
            here = curve%z%value(place_in_stretch(curve%y, stretches(j), middle))
            if (curve%side == profile_side%wheel) here = -here
            if (chosen /= 0 .and. here >= best) cycle
            chosen = j
            best = here
         end do
         if (chosen == 0) then
            previous = 0
            cycle
         end if
         if (chosen == previous) then
            curve%parts(size(curve%parts))%high = ends(i + 1)
         else
            curve%parts = [curve%parts, visible_part(ends(i), ends(i + 1), stretches(chosen))]
            call close_gap(curve%parts)
         end if
         previous = chosen
      end do
   end subroutine find_visible

   !> Mark a curve on which y is monotonic as visible throughout
   subroutine mark_all_visible(curve)
      type(profile_curve), intent(inout) :: curve
      type(stretch) :: along
      real(wp) :: y(2)

      associate (nodes => curve%y%s)
         along = stretch_between(curve%y, nodes(1), nodes(size(nodes)))
         y = curve%y%value([nodes(1), nodes(size(nodes))])
      end associate
      allocate(curve%parts(merge(1, 0, abs(y(2) - y(1)) > vertical)))
      curve%parts = visible_part(minval(y), maxval(y), along)
   end subroutine mark_all_visible

   !> Close a gap in y before the last part if it is not wider than a vertical stretch
   pure subroutine close_gap(parts)
      type(visible_part), intent(inout) :: parts(:)
      integer :: n

      n = size(parts)
      if (n < 2) return
      if (parts(n)%low - parts(n - 1)%high <= 100.0_wp*vertical) parts(n)%low = parts(n - 1)%high
   end subroutine close_gap

   pure function s_range(self) result(range)
      class(profile_curve), intent(in) :: self
      real(wp) :: range(2)

      range = [self%y%s(1), self%y%s(size(self%y%s))]
   end function s_range

   pure function y_range(self) result(range)
      class(profile_curve), intent(in) :: self
      real(wp) :: range(2)

      range = [self%parts(1)%low, self%parts(size(self%parts))%high]
   end function y_range

   !> Index of the visible part with a given y; 0 if there is none
   pure integer function part_of(self, y) result(part)
      type(profile_curve), intent(in) :: self
      real(wp), intent(in) :: y
      integer :: low, high, middle

      low = 1
      high = size(self%parts)
      part = 0
      do while (low <= high)
         middle = (low + high)/2
         if (y < self%parts(middle)%low) then
            high = middle - 1
         else if (y > self%parts(middle)%high) then
            low = middle + 1
         else
            part = middle
            return
         end if
      end do
   end function part_of

   !> Beyond the visible range of y the value at its nearer end; in a gap between visible parts that of the part below
   elemental real(wp) function place_at(self, y) result(s)
      class(profile_curve), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      integer :: part, k

      part = part_of(self, y)
      if (part == 0) then
         part = 1
         do k = 2, size(self%parts)
            if (self%parts(k)%low > y) exit
            part = k
         end do
      end if
      associate (p => self%parts(part))
         s = place_in_stretch(self%y, p%along, min(max(y, p%low), p%high))
      end associate
   end function place_at

   !> Arc length of the visible point with a given y
   pure subroutine find_point(self, y, s, found)
      class(profile_curve), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      !> Unchanged if there is no visible point
      real(wp), intent(inout) :: s
      !> Is there a visible point?
      logical, intent(out) :: found
      integer :: part

      part = part_of(self, y)
      found = part > 0
      if (found) s = place_in_stretch(self%y, self%parts(part)%along, y)
   end subroutine find_point

   !> Piece of the splines that contains the visible point with a given y, and the position in it
   pure subroutine locate(self, y, piece, place, found)
      class(profile_curve), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      !> Estimate on entry, 0 if it is unknown; unchanged if there is no visible point
      integer, intent(inout) :: piece
      !> Distance from the start of the piece [mm], estimate on entry
      real(wp), intent(inout) :: place
      !> Is there a visible point?
      logical, intent(out) :: found
      integer :: part

      part = part_of(self, y)
      found = part > 0
      if (found) call follow_stretch(self%y, self%parts(part)%along, y, piece, place)
   end subroutine locate

   !> Coordinates at an arc length, with slopes; beyond the ends those of the nearest end
   pure subroutine point_at(self, s, y, z, y_s, z_s)
      class(profile_curve), intent(in) :: self
      !> Arc length [mm]
      real(wp), intent(in) :: s
      !> Coordinates [mm], slopes [-]
      real(wp), intent(out) :: y, z, y_s, z_s
      real(wp) :: t
      integer :: j

      call self%y%place(s, j, t)
      call self%y%in_piece(j, t, y, y_s)
      call self%z%in_piece(j, t, z, z_s)
   end subroutine point_at

   elemental logical function has_point(self, y) result(has)
      class(profile_curve), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y

      has = part_of(self, y) > 0
   end function has_point

   elemental real(wp) function height(self, y)
      class(profile_curve), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y

      height = self%z%value(self%s_at(y))
   end function height

   !> Heights of visible points in increasing order of y; the search for parts and pieces continues from point to point
   pure subroutine heights(self, y, z, found)
      class(profile_curve), intent(in) :: self
      !> Increasing
      real(wp), intent(in) :: y(:)
      !> 0 where there is no visible point
      real(wp), intent(out) :: z(:)
      !> Is there a visible point? Shape of y
      logical, intent(out) :: found(:)
      real(wp) :: slope
      integer :: i, part, piece

      part = 1
      piece = 0
      z = 0.0_wp
      found = .false.
      do i = 1, size(y)
         do while (part <= size(self%parts))
            if (y(i) <= self%parts(part)%high) exit
            part = part + 1
            piece = 0
         end do
         if (part > size(self%parts)) return
         if (y(i) < self%parts(part)%low) cycle
         found(i) = .true.
         associate (along => self%parts(part)%along)
            if (piece == 0) then
               piece = piece_in_stretch(self%y, along, y(i))
            else if (along%rises) then
               do while (piece < along%last)
                  if (self%y%c(0, piece + 1) >= y(i)) exit
                  piece = piece + 1
               end do
            else
               do while (piece > along%first)
                  if (self%y%c(0, piece) >= y(i)) exit
                  piece = piece - 1
               end do
            end if
            call self%z%in_piece(piece, place_in_piece(self%y, along, piece, y(i)), z(i), slope)
         end associate
      end do
   end subroutine heights

   elemental real(wp) function inclination(self, s)
      class(profile_curve), intent(in) :: self
      !> Arc length [mm]
      real(wp), intent(in) :: s

      if (self%side == profile_side%rail) then
         inclination = atan2(self%z%slope(s), self%y%slope(s))
      else
         inclination = atan2(-self%z%slope(s), -self%y%slope(s))
      end if
   end function inclination

   pure function normal(self, s) result(n)
      class(profile_curve), intent(in) :: self
      !> Arc length [mm]
      real(wp), intent(in) :: s
      !> Components along y and z
      real(wp) :: n(2)

      n = [self%z%slope(s), -self%y%slope(s)]
      n = n/norm2(n)
   end function normal

   pure integer function part_count(self)
      class(profile_curve), intent(in) :: self

      part_count = size(self%parts)
   end function part_count

   pure real(wp) function hidden_part(self) result(hidden)
      class(profile_curve), intent(in) :: self
      real(wp) :: range(2), seen
      integer :: k

      seen = 0.0_wp
      do k = 1, size(self%parts)
         associate (p => self%parts(k))
            seen = seen + abs(place_in_stretch(self%y, p%along, p%high) - place_in_stretch(self%y, p%along, p%low))
         end associate
      end do
      range = self%s_range()
      hidden = max(0.0_wp, 1.0_wp - seen/(range(2) - range(1)))
   end function hidden_part

   !> The curve in axes with another origin, rolled by an angle: lateral coordinate along the rolled y axis, height along the
   !> rolled z axis. The pieces are transformed, not fitted again.
   function seen_from(self, origin, angle, range, around) result(curve)
      class(profile_curve), intent(in) :: self
      !> Origin (y, z) [mm] and roll angle [rad] of the new axes, in those of the curve
      real(wp), intent(in) :: origin(2), angle
      !> Restrict the curve to the pieces that overlap this range of s
      real(wp), intent(in), optional :: range(2)
      !> Arc lengths s: only stretches reached from one of them without a reversal of the new lateral coordinate are visible.
      !> Default: the topmost ones
      real(wp), intent(in), optional :: around(:)
      type(profile_curve) :: curve
      type(cubic_spline) :: y, z
      integer :: first, last

      first = 1
      last = size(self%y%s) - 1
      if (present(range)) then
         first = piece_of(self%y%s, range(1))
         last = piece_of(self%y%s, range(2))
      end if
      y%s = self%y%s(first:last + 1)
      z%s = y%s
      allocate(y%c(0:3, last - first + 1), z%c(0:3, last - first + 1))
      y%c(:, :) = cos(angle)*self%y%c(:, first:last) + sin(angle)*self%z%c(:, first:last)
      z%c(:, :) = cos(angle)*self%z%c(:, first:last) - sin(angle)*self%y%c(:, first:last)
      y%c(0, :) = y%c(0, :) - (cos(angle)*origin(1) + sin(angle)*origin(2))
      z%c(0, :) = z%c(0, :) - (cos(angle)*origin(2) - sin(angle)*origin(1))
      curve%side = self%side
      curve%y = y
      curve%z = z
      call find_visible(curve, around)
   end function seen_from

   !> Arc length s and height z of the point with the smallest z
   pure subroutine top(self, s, z)
      class(profile_curve), intent(in) :: self
      !> Arc length, and coordinate z, down [mm]
      real(wp), intent(out) :: s, z
      real(wp) :: roots(2), places(3)
      integer :: i, k, n

      s = self%z%s(size(self%z%s))
      z = self%z%value(s)
      do i = 1, size(self%z%s) - 1
         call quadratic_roots(3.0_wp*self%z%c(3, i), 2.0_wp*self%z%c(2, i), self%z%c(1, i), 0.0_wp, &
            & self%z%s(i + 1) - self%z%s(i), roots, n)
         places = self%z%s(i) + [0.0_wp, roots]
         do k = 1, n + 1
            if (self%z%value(places(k)) >= z) cycle
            s = places(k)
            z = self%z%value(s)
         end do
      end do
   end subroutine top

end module contact_profile_curve
