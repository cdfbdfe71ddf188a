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
   use contact_numeric_spline, only : cubic_spline, local_splines, natural_splines
   use contact_profile_curve, only : find_visible, profile_curve
   use contact_profile_points, only : chord_lengths
   use contact_profile_request, only : profile_side
   use contact_profile_slices_file, only : slices_list
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
   end type profile_surface

   !> A section of the surface across u
   type :: surface_cut
      !> Does the surface exist at this position?
      logical :: present = .false.
      !> Its nodes are lines of the surface; index of the first
      type(profile_curve) :: curve
      integer, private :: first_line = 1
      !> Derivatives along u on the lines, as functions of the s of the curve
      type(cubic_spline), private :: y_u, z_u
   contains
      !> Point at a coordinate v
      procedure :: on_line
      !> Derivative of the height along u at a fixed lateral position
      procedure :: slope_along
      !> Height of the visible point and its derivatives across and along
      procedure :: at
   end type surface_cut

   !> Distance between lines across the profile [mm]
   real(wp), parameter :: line_distance = 0.5_wp
   !> A surface that deviates by more than this from the slices on both sides gives a warning when it is read [mm]
   real(wp), parameter, public :: large_overshoot = 0.5_wp
   !> Minimum dy/ds for slopes; vertical walls have none
   real(wp), parameter :: vertical = 1.0e-6_wp
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
   subroutine cut(self, position, section, axes)
      class(profile_surface), intent(in) :: self
      !> Position [mm] or [rad]
      real(wp), intent(in) :: position
      !> The section: lines, coordinates and derivatives along u
      type(surface_cut), intent(out) :: section
      !> Axes of the section: origin (y, z) [mm] and roll angle [rad] in the axes of the surface. Splines through shifted and
      !> rolled points equal the shifted and rolled splines
      real(wp), intent(in), optional :: axes(3)
      real(wp) :: u
      real(wp) :: points(self%lines, 4), b(4), slope(4)
      real(wp), allocatable :: s(:)
      type(cubic_spline) :: splines(4)
      logical :: there(self%lines)
      integer :: g, j, k, first, last

      u = given_position(self, position)
      if (self%side == profile_side%wheel .or. abs(u - min(max(u, self%u_range(1)), self%u_range(2))) <= &
         & rounding*(self%u_range(2) - self%u_range(1))) u = min(max(u, self%u_range(1)), self%u_range(2))
      there = .false.
      do g = 1, size(self%groups)
         associate (group => self%groups(g))
            if (u < group%low .or. u > group%high) cycle
            j = knot_interval(group%t, u)
            call basis_values(group%t, j, u, b, slope)
            points(group%first:group%last, :) = 0.0_wp
            do k = 1, 4
               points(group%first:group%last, 1) = points(group%first:group%last, 1) + b(k)*group%y(:, j - 4 + k)
               points(group%first:group%last, 2) = points(group%first:group%last, 2) + b(k)*group%z(:, j - 4 + k)
               points(group%first:group%last, 3) = points(group%first:group%last, 3) + slope(k)*group%y(:, j - 4 + k)
               points(group%first:group%last, 4) = points(group%first:group%last, 4) + slope(k)*group%z(:, j - 4 + k)
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
      if (last - first < 1) return

      s = chord_lengths(points(first:last, 1), points(first:last, 2))
      if (any(s(2:) <= s(:size(s) - 1))) return
      if (present(axes)) call turn(points(first:last, :), axes)
      if (self%side == profile_side%wheel) then
         ! a flat ends in corners that cross the lines, next to which splines would overshoot
         call local_splines(s, points(first:last, :), splines, self%is_kink(first:last))
      else
         call natural_splines(s, points(first:last, :), splines, self%is_kink(first:last))
      end if
      section%curve%side = self%side
      call move_spline(splines(1), section%curve%y)
      call move_spline(splines(2), section%curve%z)
      call move_spline(splines(3), section%y_u)
      call move_spline(splines(4), section%z_u)
      call find_visible(section%curve)
      section%first_line = first
      section%present = .true.
   end subroutine cut

   !> The section at a position; beyond the first and the last slice the nearest one, with zero slope along u
   subroutine continued(self, position, section, axes)
      class(profile_surface), intent(in) :: self
      !> Position [mm] or [rad]
      real(wp), intent(in) :: position
      !> The section; always present
      type(surface_cut), intent(out) :: section
      !> See `cut`
      real(wp), intent(in), optional :: axes(3)
      real(wp) :: u

      u = given_position(self, position)
      call self%cut(min(max(u, self%u_range(1)), self%u_range(2)), section, axes)
      if (.not. section%present .or. (u >= self%u_range(1) .and. u <= self%u_range(2))) return
      section%y_u%c = 0.0_wp
      section%z_u%c = 0.0_wp
   end subroutine continued

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

   pure subroutine move_spline(from, to)
      type(cubic_spline), intent(inout) :: from, to

      call move_alloc(from%s, to%s)
      call move_alloc(from%c, to%c)
   end subroutine move_spline

   !> The point at the second coordinate v of the surface: lines have integer values, starting at 0; between them v is linear in
   !> the arc length
   pure subroutine on_line(self, v, y, z, found)
      class(surface_cut), intent(in) :: self
      !> Second coordinate of the surface [-], from 0
      real(wp), intent(in) :: v
      !> Coordinates [mm]
      real(wp), intent(out) :: y, z
      !> False if the section has no line there
      logical, intent(out) :: found
      real(wp) :: place, s
      integer :: i

      y = 0.0_wp
      z = 0.0_wp
      found = .false.
      if (.not. self%present) return
      associate (nodes => self%curve%y%s)
         place = v - (self%first_line - 1)
         found = place >= 0.0_wp .and. place <= size(nodes) - 1
         if (.not. found) return
         i = min(int(place) + 1, size(nodes) - 1)
         s = nodes(i) + (place - (i - 1))*(nodes(i + 1) - nodes(i))
         y = self%curve%y%value(s)
         z = self%curve%z%value(s)
      end associate
   end subroutine on_line

   !> Height z of the visible point at y, dz/dy and dz/du
   pure subroutine at(self, y, z, z_y, z_u, found, piece, z_yy, z_uy)
      class(surface_cut), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      !> Height [mm], and its derivatives along y [-] and along u, per mm or per rad
      real(wp), intent(out) :: z, z_y, z_u
      !> False if the section has no point with this y
      logical, intent(out) :: found
      !> Piece of the section to be tried first; on exit the piece that contains the point
      integer, intent(inout) :: piece
      !> Derivatives of both along y, per mm
      real(wp), intent(out), optional :: z_yy, z_uy
      real(wp) :: across, y_u, t, bend

      z = 0.0_wp
      z_y = 0.0_wp
      z_u = 0.0_wp
      if (present(z_yy)) z_yy = 0.0_wp
      if (present(z_uy)) z_uy = 0.0_wp
      found = self%present
      if (found) call self%curve%locate(y, piece, t, found)
      if (.not. found) return
      ! all four functions have the same pieces
      associate (cy => self%curve%y%c, cz => self%curve%z%c, cy_u => self%y_u%c, cz_u => self%z_u%c)
         across = cy(1, piece) + t*(2.0_wp*cy(2, piece) + t*3.0_wp*cy(3, piece))
         across = sign(max(abs(across), vertical), across)
         z = cz(0, piece) + t*(cz(1, piece) + t*(cz(2, piece) + t*cz(3, piece)))
         z_y = (cz(1, piece) + t*(2.0_wp*cz(2, piece) + t*3.0_wp*cz(3, piece)))/across
         z_u = cz_u(0, piece) + t*(cz_u(1, piece) + t*(cz_u(2, piece) + t*cz_u(3, piece)))
         y_u = cy_u(0, piece) + t*(cy_u(1, piece) + t*(cy_u(2, piece) + t*cy_u(3, piece)))
         z_u = z_u - z_y*y_u
         if (.not. (present(z_yy) .and. present(z_uy))) return
         ! derivatives along the section, divided by dy/ds
         bend = 2.0_wp*(cz(2, piece) + t*3.0_wp*cz(3, piece) - z_y*(cy(2, piece) + t*3.0_wp*cy(3, piece)))
         z_yy = bend/across**2
         z_uy = (cz_u(1, piece) + t*(2.0_wp*cz_u(2, piece) + t*3.0_wp*cz_u(3, piece)) &
            & - z_y*(cy_u(1, piece) + t*(2.0_wp*cy_u(2, piece) + t*3.0_wp*cy_u(3, piece))))/across - z_yy*y_u
      end associate
   end subroutine at

   !> dz/du at fixed y of the visible point, from the derivatives on the lines: z_u - z_s y_u / y_s; 0 if there is none
   elemental real(wp) function slope_along(self, y) result(slope)
      class(surface_cut), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      real(wp) :: z, z_y
      logical :: found
      integer :: piece

      piece = 0
      call self%at(y, z, z_y, slope, found, piece)
   end function slope_along
end module contact_profile_surface
