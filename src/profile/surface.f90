!> A variable profile: a surface through slices, which can be cut at any position along the track or around the wheel
!>
!> Each slice is divided at its features into parts, and each part into the same number of equal intervals in all slices. Points
!> with the same number form a line along u: a cubic spline in u over the slices that contain it. A cut evaluates the lines at
!> its position and forms a curve of them. As interpolations along and across the lines commute, this is the tensor-product
!> spline. Across wheels local cubics are used between the lines, as in the original program.
module contact_profile_surface
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_numeric_b_spline, only : basis_values, interpolate_sites, interpolation_knots, knot_interval
   use contact_profile_curve, only : profile_curve
   use contact_profile_request, only : profile_side
   use contact_profile_slices_file, only : slices_list
   use contact_profile_surface_cut, only : connect_lines, surface_cut
   use contact_text_words, only : integer_text, real_text
   implicit none (type, external)
   private

   public :: profile_surface, surface_cut, line_group, new_surface

   !> Lines that exist in the same contiguous sequence of slices
   type :: line_group
      !> Range of u, and of line numbers
      real(wp) :: low, high
      integer :: first, last
      !> Knots in u, and coefficients of y and z (line, coefficient)
      real(wp), allocatable :: t(:), y(:, :), z(:, :)
   end type line_group

   !> The surface
   type :: profile_surface
      !> Member of profile_side
      integer :: side = profile_side%rail
      !> First and last position: [mm] along the track, [rad] around the wheel
      real(wp) :: u_range(2) = 0.0_wp
      !> Positions of the slices
      real(wp), allocatable :: slices(:)
      !> Number of lines; lines at kinks
      integer :: lines = 0
      logical, allocatable, private :: is_kink(:)
      type(line_group), allocatable :: groups(:)
   contains
      !> The section at a position
      procedure :: cut
      !> The same, but a rail beyond its ends, and a wheel where it is not given, continue with the nearest slice
      procedure :: continued
      !> Fraction of a stretch of rail outside the range of the slices
      procedure :: part_beyond
      !> Is it the same surface as another one?
      procedure :: same_as
   end type profile_surface

   !> Distance between lines across the profile [mm]
   real(wp), parameter :: line_distance = 0.5_wp
   !> A surface that deviates by more than this from the slices on both sides gives a warning when it is read [mm]
   real(wp), parameter, public :: large_overshoot = 0.5_wp
   !> Tolerance at the ends of the range, relative to its length
   real(wp), parameter :: rounding = 1.0e-9_wp
   !> Minimum number of slices for a spline along u
   integer, parameter :: min_slices = 4

   !> Features less than this before the start of a slice are at its start [mm]; -1 means absent
   real(wp), parameter :: at_start = 1.0e-6_wp

contains

   !> Create the surface from prepared slices
   subroutine new_surface(side, list, curves, file, surface, error)
      !> Member of profile_side
      integer, intent(in) :: side
      !> Positions of the slices, features and kinks
      type(slices_list), intent(in) :: list
      !> One per slice
      type(profile_curve), intent(in) :: curves(:)
      !> Name of the slices file, for messages
      character(len=*), intent(in) :: file
      !> Splines through the points of all slices
      type(profile_surface), intent(out) :: surface
      !> Gives the file, and the slice that does not match the others
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: features(:, :), y(:, :), z(:, :), u(:)
      integer, allocatable :: first_line(:)
      integer :: slices, parts, f, k

      slices = size(curves)
      if (slices < min_slices) then
         call fatal_error(error, "there are " // integer_text(slices) // " slices; a surface needs at least " // &
            & integer_text(min_slices), file=file)
         return
      end if
      parts = size(list%features, 1) - 1
      u = [(list%slices(k)%u, k=1, slices)]
      surface%side = side
      surface%u_range = [u(1), u(slices)]
      surface%slices = u
      call limit_features(list, curves, file, features, error)
      if (allocated(error)) return

      ! indices of the lines at features
      allocate(first_line(parts + 1))
      first_line(1) = 1
      do f = 1, parts
         first_line(f + 1) = first_line(f) + 1 + int(longest_part(features, f)/line_distance)
      end do
      surface%lines = first_line(parts + 1)
      allocate(surface%is_kink(surface%lines), y(slices, surface%lines), z(slices, surface%lines))
      surface%is_kink = .false.
      surface%is_kink(pack(first_line, list%is_kink)) = .true.
      do k = 1, slices
         call sample(curves(k), features(:, k), first_line, y(k, :), z(k, :))
      end do

      allocate(surface%groups(0))
      do f = 1, parts + 1
         call add_groups(surface, features(f, :) >= 0.0_wp, first_line(f), first_line(f))
         if (allocated(error)) return
         if (f > parts) exit
         if (first_line(f + 1) - first_line(f) < 2) cycle
         call add_groups(surface, features(f, :) >= 0.0_wp .and. features(f + 1, :) >= 0.0_wp, first_line(f) + 1, &
            & first_line(f + 1) - 1)
         if (allocated(error)) return
      end do

   contains

      !> Add a group for each contiguous sequence of slices that contain the lines
      subroutine add_groups(surface, there, first, last)
         type(profile_surface), intent(inout) :: surface
         logical, intent(in) :: there(:)
         integer, intent(in) :: first, last
         type(line_group) :: group
         integer :: a, b

         a = 1
         do while (a <= slices)
            if (.not. there(a)) then
               a = a + 1
               cycle
            end if
            b = a
            do while (b < slices)
               if (.not. there(b + 1)) exit
               b = b + 1
            end do
            if (b - a + 1 < min_slices) then
               call fatal_error(error, "a part of the profile exists in the slices " // integer_text(a) // " to " // &
                  & integer_text(b) // " only; it must exist in at least " // integer_text(min_slices) // &
                  & " consecutive slices", file=file, line=list%slices(a)%line)
               return
            end if
            group%low = u(a)
            group%high = u(b)
            group%first = first
            group%last = last
            group%y = y(a:b, first:last)
            group%z = z(a:b, first:last)
            call spline_along(u(a:b), list%approximating, group)
            group%y = transpose(group%y)
            group%z = transpose(group%z)
            surface%groups = [surface%groups, group]
            a = b + 1
         end do
      end subroutine add_groups
   end subroutine new_surface

   !> Features limited to the end of each slice; -1 where a feature is absent
   subroutine limit_features(list, curves, file, features, error)
      type(slices_list), intent(in) :: list
      type(profile_curve), intent(in) :: curves(:)
      character(len=*), intent(in) :: file
      real(wp), allocatable, intent(out) :: features(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: range(2)
      integer :: k, last

      features = list%features
      do k = 1, size(curves)
         range = curves(k)%s_range()
         last = findloc(features(:, k) > -at_start, .true., 1, back=.true.)
         where (features(:, k) > -at_start)
            features(:, k) = max(0.0_wp, features(:, k))
         else where
            features(:, k) = -1.0_wp
         end where
         features(last, k) = min(features(last, k), range(2) - range(1))
         if (features(last, k) > features(last - 1, k)) cycle
         call fatal_error(error, "slice " // integer_text(k) // " is " // real_text(range(2) - range(1)) // " mm long, but the &
            &last but one of its features is at " // real_text(features(last - 1, k)) // " mm", file=file, &
            & line=list%slices(k)%line)
         return
      end do
   end subroutine limit_features

   pure real(wp) function longest_part(features, part) result(length)
      real(wp), intent(in) :: features(:, :)
      integer, intent(in) :: part
      integer :: k

      length = 0.0_wp
      do k = 1, size(features, 2)
         if (min(features(part, k), features(part + 1, k)) < 0.0_wp) cycle
         length = max(length, features(part + 1, k) - features(part, k))
      end do
   end function longest_part

   !> Points of a slice on all its lines
   pure subroutine sample(curve, features, first_line, y, z)
      type(profile_curve), intent(in) :: curve
      real(wp), intent(in) :: features(:)
      integer, intent(in) :: first_line(:)
      real(wp), intent(out) :: y(:), z(:)
      real(wp) :: range(2), s
      integer :: p, j

      y = 0.0_wp
      z = 0.0_wp
      range = curve%s_range()
      do p = 1, size(features) - 1
         if (min(features(p), features(p + 1)) < 0.0_wp) cycle
         do j = first_line(p), first_line(p + 1)
            s = features(p) + (features(p + 1) - features(p))*real(j - first_line(p), wp)/(first_line(p + 1) - first_line(p))
            y(j) = curve%y%value(range(1) + s)
            z(j) = curve%z%value(range(1) + s)
         end do
      end do
   end subroutine sample

   !> Coefficients along u from the points of the slices
   !>
   !> For approximation the points are the control points, with an additional one at each end by linear extrapolation from the
   !> last two: a slice has weight four sixths, each of its neighbours one sixth.
   subroutine spline_along(u, approximating, group)
      real(wp), intent(in) :: u(:)
      logical, intent(in) :: approximating
      !> On entry the points (slice, line), on exit the coefficients (coefficient, line)
      type(line_group), intent(inout) :: group
      logical :: solved
      integer :: n, k

      n = size(u)
      if (.not. approximating) then
         group%t = interpolation_knots(u)
         ! sites increase and determine the knots, so that the systems are not singular
         call interpolate_sites(group%t, u, group%y, solved)
         call interpolate_sites(group%t, u, group%z, solved)
         return
      end if
      group%t = [u(1) - [(k*(u(2) - u(1)), k=3, 1, -1)], u, u(n) + [(k*(u(n) - u(n - 1)), k=1, 3)]]
      group%y = with_phantoms(u, group%y)
      group%z = with_phantoms(u, group%z)
   end subroutine spline_along

   pure function with_phantoms(u, points) result(longer)
      real(wp), intent(in) :: u(:), points(:, :)
      real(wp) :: longer(size(points, 1) + 2, size(points, 2))
      integer :: n

      n = size(u)
      longer(2:n + 1, :) = points
      longer(1, :) = 2.0_wp*points(1, :) - points(2, :)
      longer(n + 2, :) = 2.0_wp*points(n, :) - points(n - 1, :)
   end function with_phantoms

   !> The section at a position; `section%present` is false where there is no surface
   !>
   !> Angles around a wheel are taken modulo one turn. A wheel that is not given all around is continued beyond its first and
   !> last slice; a rail ends there.
   subroutine cut(self, position, section, axes, lines)
      class(profile_surface), intent(in) :: self
      !> Position [mm] or [rad]
      real(wp), intent(in) :: position
      !> The section: lines, coordinates and derivatives along u
      type(surface_cut), intent(out) :: section
      !> Axes of the section: origin (y, z) [mm] and roll angle [rad] in the axes of the surface. Splines through shifted and
      !> rolled points equal the shifted and rolled splines
      real(wp), intent(in), optional :: axes(3)
      !> First and last line that are needed: see `connect_lines`
      integer, intent(in), optional :: lines(2)
      real(wp) :: u
      real(wp) :: points(self%lines, 4), b(4), slope(4)
      logical :: there(self%lines)
      integer :: g, i, j, k, first, last

      u = given_position(self, position)
      if (self%side == profile_side%wheel .or. abs(u - min(max(u, self%u_range(1)), self%u_range(2))) <= &
         & rounding*(self%u_range(2) - self%u_range(1))) u = min(max(u, self%u_range(1)), self%u_range(2))
      there = .false.
      do g = 1, size(self%groups)
         associate (group => self%groups(g))
            if (u < group%low .or. u > group%high) cycle
            j = knot_interval(group%t, u)
            call basis_values(group%t, j, u, b, slope)
            do k = 1, group%last - group%first + 1
               i = group%first + k - 1
               points(i, 1) = b(1)*group%y(k, j - 3) + b(2)*group%y(k, j - 2) + b(3)*group%y(k, j - 1) + b(4)*group%y(k, j)
               points(i, 2) = b(1)*group%z(k, j - 3) + b(2)*group%z(k, j - 2) + b(3)*group%z(k, j - 1) + b(4)*group%z(k, j)
               points(i, 3) = slope(1)*group%y(k, j - 3) + slope(2)*group%y(k, j - 2) + slope(3)*group%y(k, j - 1) &
                  & + slope(4)*group%y(k, j)
               points(i, 4) = slope(1)*group%z(k, j - 3) + slope(2)*group%z(k, j - 2) + slope(3)*group%z(k, j - 1) &
                  & + slope(4)*group%z(k, j)
            end do
            there(group%first:group%last) = .true.
         end associate
      end do
      first = findloc(there, .true., 1)
      if (first == 0) return
      ! a feature line may continue where both adjacent parts have ended
      last = first
      do while (last < self%lines)
         if (.not. there(last + 1)) exit
         last = last + 1
      end do
      if (present(axes)) call turn(points(first:last, :), axes)
      call connect_lines(self%side, first, points(first:last, :), self%is_kink(first:last), section, lines)
   end subroutine cut

   !> The section at a position; beyond the first and the last slice the nearest one, with zero slope along u
   subroutine continued(self, position, section, axes, lines)
      class(profile_surface), intent(in) :: self
      !> Position [mm] or [rad]
      real(wp), intent(in) :: position
      !> The section; always present
      type(surface_cut), intent(out) :: section
      !> See `cut`
      real(wp), intent(in), optional :: axes(3)
      !> See `cut`
      integer, intent(in), optional :: lines(2)
      real(wp) :: u

      u = given_position(self, position)
      call self%cut(min(max(u, self%u_range(1)), self%u_range(2)), section, axes, lines)
      if (.not. section%present .or. (u >= self%u_range(1) .and. u <= self%u_range(2))) return
      section%y_u%c = 0.0_wp
      section%z_u%c = 0.0_wp
   end subroutine continued

   !> Is a surface equal to another one?
   pure logical function same_as(self, other)
      class(profile_surface), intent(in) :: self
      !> Any surface
      type(profile_surface), intent(in) :: other
      integer :: g

      same_as = self%side == other%side .and. self%lines == other%lines .and. allocated(self%groups) .and. allocated(other%groups)
      if (same_as) same_as = size(self%groups) == size(other%groups) .and. size(self%slices) == size(other%slices)
      if (same_as) same_as = all(self%is_kink .eqv. other%is_kink) .and. all(self%slices == other%slices) &
         & .and. all(self%u_range == other%u_range)
      if (.not. same_as) return
      do g = 1, size(self%groups)
         associate (one => self%groups(g), two => other%groups(g))
            same_as = one%first == two%first .and. one%last == two%last .and. all(shape(one%y) == shape(two%y))
            if (same_as) same_as = one%low == two%low .and. one%high == two%high .and. all(one%t == two%t)
            if (same_as) same_as = all(one%y == two%y) .and. all(one%z == two%z)
         end associate
         if (.not. same_as) return
      end do
   end function same_as

   !> Fraction of a stretch of rail before the first or after the last slice, 0...1
   pure real(wp) function part_beyond(self, range) result(part)
      class(profile_surface), intent(in) :: self
      !> Increasing [mm]
      real(wp), intent(in) :: range(2)

      part = 1.0_wp - max(0.0_wp, min(range(2), self%u_range(2)) - max(range(1), self%u_range(1)))/(range(2) - range(1))
      if (part <= rounding) part = 0.0_wp
   end function part_beyond

   !> A position along the rail, or an angle within half a turn
   pure real(wp) function given_position(self, position) result(u)
      class(profile_surface), intent(in) :: self
      !> [mm] or [rad]
      real(wp), intent(in) :: position

      u = position
      if (self%side == profile_side%wheel) u = u - 2.0_wp*pi*nint(u/(2.0_wp*pi))
   end function given_position

   !> Transform points (y, z) and their derivatives along u (y, z) to other axes
   pure subroutine turn(points, axes)
      real(wp), intent(inout) :: points(:, :)
      !> See `cut`
      real(wp), intent(in) :: axes(3)
      real(wp) :: y(size(points, 1)), c, s
      integer :: k

      if (all(abs(axes) <= 0.0_wp)) return
      c = cos(axes(3))
      s = sin(axes(3))
      points(:, 1) = points(:, 1) - axes(1)
      points(:, 2) = points(:, 2) - axes(2)
      do k = 1, 3, 2
         y = points(:, k)
         points(:, k) = c*y + s*points(:, k + 1)
         points(:, k + 1) = c*points(:, k + 1) - s*y
      end do
   end subroutine turn
end module contact_profile_surface
