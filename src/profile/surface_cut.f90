!> A section of a surface across its lines: a curve through the lines, with derivatives along the surface
module contact_profile_surface_cut
   use contact_base_kinds, only : wp
   use contact_numeric_spline, only : cubic_spline, local_splines, natural_splines
   use contact_profile_curve, only : find_visible, profile_curve
   use contact_profile_request, only : profile_side
   implicit none (type, external)
   private

   public :: surface_cut, cut_point, connect_lines

   !> A point of a section, from which the next one is found faster if it is near
   type :: cut_point
      !> Lateral position [mm]; huge: no point yet
      real(wp) :: y = huge(1.0_wp)
      !> Height [mm], derivatives across the profile [-] and along the surface, per mm or rad, and derivatives of both across the
      !> profile
      real(wp) :: z = 0.0_wp, z_y = 0.0_wp, z_u = 0.0_wp, z_yy = 0.0_wp, z_uy = 0.0_wp
      !> Piece of the section, 0 if unknown, distance from its start [mm], and dy/ds
      integer, private :: piece = 0
      real(wp), private :: place = 0.0_wp, y_s = 1.0_wp
   end type cut_point

   !> A section of the surface across u
   type :: surface_cut
      !> Does the surface exist at this position?
      logical :: present = .false.
      !> Its nodes are lines of the surface; index of the first
      type(profile_curve) :: curve
      integer, private :: first_line = 1
      !> Derivatives along u on the lines, as functions of the s of the curve
      type(cubic_spline) :: y_u, z_u
      !> Lateral positions at which the curve is that through all lines [mm]
      real(wp) :: valid(2) = [-huge(1.0_wp), huge(1.0_wp)]
   contains
      !> Point at a coordinate v
      procedure :: on_line
      !> Derivative of the height along u at a fixed lateral position
      procedure :: slope_along
      !> Height of the visible point and its derivatives across and along
      procedure :: at
      !> The same, from a known point
      procedure :: find
   end type surface_cut

   !> Minimum dy/ds for slopes; vertical walls have none
   real(wp), parameter :: vertical = 1.0e-6_wp

contains

   !> The curve through points on consecutive lines
   !>
   !> The local splines of a wheel are computed near some lines only, if this gives the same curve there: with increasing or
   !> decreasing y of the points no other piece reaches the range of y inside the first and last piece by a margin. A piece exceeds
   !> the range of its ends by less than its chord, as |dy/ds| is at most 1 at its ends, or 3 at kinks.
   subroutine connect_lines(side, first_line, points, is_kink, section, lines)
      !> Member of profile_side
      integer, intent(in) :: side
      !> Index of the first line
      integer, intent(in) :: first_line
      !> y, z [mm] and their derivatives along u, per mm or rad, for each line; shape (lines, 4)
      real(wp), intent(in) :: points(:, :)
      !> Lines at which the slope may jump
      logical, intent(in) :: is_kink(:)
      !> Not present if the points do not form a curve
      type(surface_cut), intent(inout) :: section
      !> First and last line that are needed; default: all
      integer, intent(in), optional :: lines(2)
      real(wp) :: direction, margin
      integer :: n, first, last, i

      n = size(points, 1)
      first = 1
      last = n
      if (present(lines) .and. side == profile_side%wheel) then
         first = min(max(lines(1) - first_line + 1, 1), n)
         last = max(min(lines(2) - first_line + 1, n), 1)
      end if
      if (last - first >= 3 .and. last - first < n - 1) then
         direction = sign(1.0_wp, points(n, 1) - points(1, 1))
         margin = 0.0_wp
         do i = 2, n
            if (.not. direction*(points(i, 1) - points(i - 1, 1)) > 0.0_wp) exit
            margin = max(margin, (points(i, 1) - points(i - 1, 1))**2 + (points(i, 2) - points(i - 1, 2))**2)
         end do
         if (i > n) then
            margin = sqrt(margin)
            call make_curve(side, first_line + first - 1, points(first:last, :), is_kink(first:last), section)
            if (section%present) then
               if (first > 1) call limit(points(first + 1, 1), direction)
               if (last < n) call limit(points(last - 1, 1), -direction)
               if (section%curve%part_count() == 1) return
            end if
         end if
      end if
      section%valid = [-huge(1.0_wp), huge(1.0_wp)]
      call make_curve(side, first_line, points, is_kink, section)

   contains

      !> Limit the range of the section on one side of a point
      subroutine limit(y, towards)
         !> Lateral position of the point [mm]; sign of the direction in which the section is valid
         real(wp), intent(in) :: y, towards

         if (towards > 0.0_wp) then
            section%valid(1) = y + margin
         else
            section%valid(2) = y - margin
         end if
      end subroutine limit
   end subroutine connect_lines

   !> Splines through points
   subroutine make_curve(side, first_line, points, is_kink, section)
      !> See `connect_lines`
      integer, intent(in) :: side, first_line
      real(wp), intent(in) :: points(:, :)
      logical, intent(in) :: is_kink(:)
      type(surface_cut), intent(inout) :: section
      real(wp) :: s(size(points, 1))
      type(cubic_spline) :: splines(4)
      integer :: i

      section%present = .false.
      if (size(s) < 2) return
      s(1) = 0.0_wp
      do i = 2, size(s)
         s(i) = s(i - 1) + sqrt((points(i, 1) - points(i - 1, 1))**2 + (points(i, 2) - points(i - 1, 2))**2)
      end do
      if (any(s(2:) <= s(:size(s) - 1))) return
      if (side == profile_side%wheel) then
         ! a flat ends in corners that cross the lines, next to which splines would overshoot
         call local_splines(s, points, splines, is_kink)
      else
         call natural_splines(s, points, splines, is_kink)
      end if
      section%curve%side = side
      call move_spline(splines(1), section%curve%y)
      call move_spline(splines(2), section%curve%z)
      call move_spline(splines(3), section%y_u)
      call move_spline(splines(4), section%z_u)
      call find_visible(section%curve)
      section%first_line = first_line
      section%present = .true.
   end subroutine make_curve

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
      type(cut_point) :: point

      point%y = y
      point%piece = piece
      call self%find(y, point, found)
      if (found) piece = point%piece
      z = point%z
      z_y = point%z_y
      z_u = point%z_u
      if (present(z_yy)) z_yy = point%z_yy
      if (present(z_uy)) z_uy = point%z_uy
   end subroutine at

   !> The visible point at y
   pure subroutine find(self, y, point, found)
      class(surface_cut), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      !> A known point on entry, the point on exit; unchanged if there is none
      type(cut_point), intent(inout) :: point
      !> False if the section has no point with this y
      logical, intent(out) :: found
      real(wp) :: t
      integer :: piece

      found = self%present
      if (.not. found) return
      t = point%place + (y - point%y)/point%y_s
      call self%curve%locate(y, point%piece, t, found)
      if (.not. found) return
      piece = point%piece
      point%y = y
      ! all four functions have the same pieces
      call evaluate(self%curve%y%c(:, piece), self%curve%z%c(:, piece), self%y_u%c(:, piece), self%z_u%c(:, piece), t, point)
   end subroutine find

   !> Height and derivatives at a place in a piece
   pure subroutine evaluate(cy, cz, cy_u, cz_u, t, point)
      !> Coefficients of the four functions: powers 0 to 3 of the distance from the start of the piece
      real(wp), intent(in) :: cy(0:3), cz(0:3), cy_u(0:3), cz_u(0:3)
      !> Distance from the start of the piece [mm]
      real(wp), intent(in) :: t
      !> All but its lateral position and piece are set
      type(cut_point), intent(inout) :: point
      real(wp) :: across, y_u, bend

      across = cy(1) + t*(2.0_wp*cy(2) + t*3.0_wp*cy(3))
      across = sign(max(abs(across), vertical), across)
      point%place = t
      point%y_s = across
      across = 1.0_wp/across
      point%z = cz(0) + t*(cz(1) + t*(cz(2) + t*cz(3)))
      point%z_y = (cz(1) + t*(2.0_wp*cz(2) + t*3.0_wp*cz(3)))*across
      y_u = cy_u(0) + t*(cy_u(1) + t*(cy_u(2) + t*cy_u(3)))
      point%z_u = cz_u(0) + t*(cz_u(1) + t*(cz_u(2) + t*cz_u(3))) - point%z_y*y_u
      ! derivatives along the section, divided by dy/ds
      bend = 2.0_wp*(cz(2) + t*3.0_wp*cz(3) - point%z_y*(cy(2) + t*3.0_wp*cy(3)))
      point%z_yy = bend*across**2
      point%z_uy = (cz_u(1) + t*(2.0_wp*cz_u(2) + t*3.0_wp*cz_u(3)) &
         & - point%z_y*(cy_u(1) + t*(2.0_wp*cy_u(2) + t*3.0_wp*cy_u(3))))*across - point%z_yy*y_u
   end subroutine evaluate

   !> dz/du at fixed y of the visible point, from the derivatives on the lines: z_u - z_s y_u / y_s; 0 if there is none
   elemental real(wp) function slope_along(self, y) result(slope)
      class(surface_cut), intent(in) :: self
      !> Lateral coordinate [mm]
      real(wp), intent(in) :: y
      type(cut_point) :: point
      logical :: found

      call self%find(y, point, found)
      slope = point%z_u
   end function slope_along
end module contact_profile_surface_cut
