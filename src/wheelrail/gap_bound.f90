!> Lower bounds of the gap between two bodies over stretches of the track
!>
!> If a profile varies the gap is a surface, and its values at mesh points do not bound it in between. Here it is bounded from below
!> over stretches of the track: lines of a surface lie within the hulls of their control points (contact_profile_surface_hull),
!> circles of a wheel within three of their points and a sagitta. Across the profile, bodies are polygons of these points; the
!> deviation of splines from chords is estimated from second differences, with a factor of four.
module contact_wheelrail_gap_bound
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface_hull, only : stretch_breaks, stretch_hull
   use contact_wheelrail_bodies, only : wheel_rail_bodies, strip
   use contact_wheelrail_gap, only : no_surface
   implicit none (type, external)
   private

   public :: bound_gap, rail_extent

   !> Maximum length of chords of a profile that does not vary [mm]
   real(wp), parameter :: longest_chord = 0.5_wp
   !> Deviation of a spline from its chord, relative to the second difference of points: an eighth for parabolas
   real(wp), parameter :: bulge_share = 0.5_wp
   !> Number of neighbours whose second differences are included
   integer, parameter :: neighbours = 3
   !> Chords steeper than this are regarded as walls, with the heights of their ends only [-]
   real(wp), parameter :: wall = 20.0_wp
   !> Number of points per circle in a stretch
   integer, parameter :: stations = 3
   !> Bound of the errors of heights by interpolation between sections and by round-off [mm]
   real(wp), parameter :: rounding = 1.0e-5_wp

   !> Sine of the maximum angle from the bottom of a wheel at which its circles are examined: beyond it they are far above the rail
   real(wp), parameter :: widest_sine = 0.9_wp
   !> Contribution of roll and yaw to this sine, and minimum radius of a circle relative to the nominal radius; both sufficient for
   !> a railway wheel
   real(wp), parameter :: added_sine = 0.1_wp, min_radius = 0.9_wp

contains

   !> Lower bound of the vertical gap [mm], at each lateral position over each stretch of the track
   !>
   !> A wheel that varies is first bounded by the round wheel that contains it. If the gap of that one is large enough, the bound is
   !> not refined.
   subroutine bound_gap(bodies, edges, y, far, low)
      !> Sections and positions of rail and wheel
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Ends of the stretches, increasing, and equidistant lateral positions, in track coordinates [mm]
      real(wp), intent(in) :: edges(:), y(:)
      !> Gaps above this value need not be known [mm]
      real(wp), intent(in) :: far
      !> Lower bounds, shape (stretches, lateral positions); `no_surface` where one body is missing
      real(wp), intent(out) :: low(:, :)
      real(wp) :: rail(size(y)), wheel(size(y)), near, rho(size(y))
      real(wp), allocatable :: profile(:, :), outline(:, :)
      logical :: found(size(y))
      integer :: i

      if (allocated(bodies%wheel_strip)) then
         call outline_of(bodies%wheel_strip, outline)
      else
         call sample(bodies%wheel, profile)
      end if
      if (.not. allocated(bodies%rail_strip)) then
         call bodies%rail%heights(y, rail, found)
         where (.not. found) rail = no_surface
      end if
      do i = 1, size(edges) - 1
         if (allocated(bodies%rail_strip)) call rail_above(bodies%rail_strip, edges(i:i + 1), y, rail)
         wheel = no_surface
         if (.not. allocated(bodies%wheel_strip)) then
            call round_wheel_below(bodies, profile, edges(i:i + 1), y, wheel)
         else if (.not. allocated(outline)) then
            call varying_wheel_below(bodies, edges(i:i + 1), y, wheel)
         else
            call round_wheel_below(bodies, outline, edges(i:i + 1), y, wheel)
            ! the surface of a roller falls off along the track
            if (any(rail < no_surface .and. rail + wheel - rounding < far)) then
               wheel = no_surface
               call varying_wheel_below(bodies, edges(i:i + 1), y, wheel)
            end if
         end if
         low(i, :) = rail
         if (bodies%placement%roller_radius > 0.0_wp) then
            near = max(0.0_wp, edges(i), -edges(i + 1))
            rho = bodies%placement%roller_radius - rail
            where (rail < no_surface .and. near < rho)
               low(i, :) = bodies%placement%roller_radius - sqrt(max(0.0_wp, rho**2 - near**2))
            else where
               low(i, :) = no_surface
            end where
         end if
         where (low(i, :) < no_surface .and. wheel < no_surface)
            low(i, :) = low(i, :) + wheel - rounding
         else where
            low(i, :) = no_surface
         end where
      end do
   end subroutine bound_gap

   !> Box that contains a stretch of a rail that varies
   subroutine rail_extent(along, range_x, range_y, top)
      !> Sections of the rail
      type(strip), intent(in) :: along
      !> Ends of the stretch of the track [mm]
      real(wp), intent(in) :: range_x(2)
      !> Lateral range in track coordinates [mm]; the second value is below the first one if there is no rail
      real(wp), intent(out) :: range_y(2)
      !> Minimum z [mm]
      real(wp), intent(out) :: top
      real(wp), allocatable :: breaks(:)
      real(wp) :: y(along%surface%lines, 4), z(along%surface%lines, 4)
      integer :: i, first, last

      range_y = [huge(1.0_wp), -huge(1.0_wp)]
      top = huge(top)
      call stretch_breaks(along%surface, range_x + along%origin, breaks)
      do i = 1, size(breaks) - 1
         call stretch_hull(along%surface, breaks(i:i + 1), y, z, first, last)
         if (last < first) cycle
         call see_from(along%axes, y(first:last, :), z(first:last, :))
         range_y = [min(range_y(1), minval(y(first:last, :))), max(range_y(2), maxval(y(first:last, :)))]
         top = min(top, minval(z(first:last, :)))
      end do
   end subroutine rail_extent

   !> Highest positions of a rail that varies, over a stretch of the track: minimum z, as z is down
   subroutine rail_above(along, range_x, y, rail)
      type(strip), intent(in) :: along
      !> Ends of the stretch, lateral positions [mm]
      real(wp), intent(in) :: range_x(2), y(:)
      real(wp), intent(out) :: rail(:)
      real(wp), allocatable :: breaks(:)
      real(wp) :: py(along%surface%lines, 4), pz(along%surface%lines, 4)
      integer :: i, first, last

      rail = no_surface
      call stretch_breaks(along%surface, range_x + along%origin, breaks)
      do i = 1, size(breaks) - 1
         call stretch_hull(along%surface, breaks(i:i + 1), py, pz, first, last)
         if (last < first) cycle
         call see_from(along%axes, py(first:last, :), pz(first:last, :))
         call lower_envelope(py(first:last, :), pz(first:last, :), 0.0_wp, y, rail)
      end do
   end subroutine rail_above

   !> The round wheel that contains a varying one: for each line its range, and its maximum radius
   subroutine outline_of(along, outline)
      !> Sections of the wheel
      type(strip), intent(in) :: along
      !> Points y, z and y, z for each line, shape (lines, 4) [mm]; unallocated unless all lines are complete
      real(wp), allocatable, intent(out) :: outline(:, :)
      integer :: g, j

      allocate(outline(along%surface%lines, 4))
      outline(:, 1) = huge(1.0_wp)
      outline(:, 2) = -huge(1.0_wp)
      outline(:, 3) = -huge(1.0_wp)
      ! a spline lies within the hull of its control points
      do g = 1, size(along%surface%groups)
         associate (group => along%surface%groups(g))
            do j = 1, size(group%y, 2)
               outline(group%first:group%last, 1) = min(outline(group%first:group%last, 1), group%y(:, j))
               outline(group%first:group%last, 3) = max(outline(group%first:group%last, 3), group%y(:, j))
               outline(group%first:group%last, 2) = max(outline(group%first:group%last, 2), group%z(:, j))
            end do
         end associate
      end do
      outline(:, 4) = outline(:, 2)
      if (any(outline(:, 1) > outline(:, 3))) deallocate(outline)
   end subroutine outline_of

   !> Lowest positions of a round wheel over a stretch of the track, as minimum -z
   subroutine round_wheel_below(bodies, profile, range_x, y, below)
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Points y, z of its profile [mm], one or two per row: shape (points, 2) or (points, 4)
      real(wp), intent(in) :: profile(:, :)
      real(wp), intent(in) :: range_x(2), y(:)
      real(wp), intent(inout) :: below(:)
      real(wp), dimension(size(profile, 1), stations*size(profile, 2)/2) :: py, pz
      real(wp) :: angle(size(profile, 1))
      integer :: i, k, n

      n = 0
      do i = 1, size(profile, 2), 2
         do k = 1, stations
            n = n + 1
            call find_angles(bodies, profile(:, i), profile(:, i + 1), station(range_x, k), angle)
            call on_circles(bodies, profile(:, i), profile(:, i + 1), angle, py(:, n), pz(:, n))
         end do
      end do
      call lower_envelope(py, -pz, sagitta(bodies, range_x), y, below)
   end subroutine round_wheel_below

   !> Lowest positions of an out-of-round wheel over a stretch of the track, as minimum -z
   subroutine varying_wheel_below(bodies, range_x, y, below)
      type(wheel_rail_bodies), intent(in) :: bodies
      real(wp), intent(in) :: range_x(2), y(:)
      real(wp), intent(inout) :: below(:)
      real(wp), allocatable :: breaks(:), py(:, :), pz(:, :), angle(:)
      real(wp) :: wy(bodies%wheel_strip%surface%lines, 4), wz(bodies%wheel_strip%surface%lines, 4), range(2)
      integer :: i, k, m, first, last

      associate (along => bodies%wheel_strip, lines => bodies%wheel_strip%surface%lines)
         ! angles at which the lines of the bottom section pass both ends of the stretch
         allocate(py(lines, 4*stations), pz(lines, 4*stations), angle(lines))
         range = range_x/bodies%placement%wheel_radius
         call stretch_hull(along%surface, [1.0_wp, 1.0_wp]*along%origin, wy, wz, first, last)
         if (last >= first) then
            range = [huge(1.0_wp), -huge(1.0_wp)]
            do k = 1, stations, stations - 1
               call find_angles(bodies, wy(first:last, 1), wz(first:last, 1), station(range_x, k), angle(first:last))
               range = [min(range(1), asin(minval(angle(first:last)))), max(range(2), asin(maxval(angle(first:last))))]
            end do
         end if
         call stretch_breaks(along%surface, range + along%origin, breaks)
         do i = 1, size(breaks) - 1
            call stretch_hull(along%surface, breaks(i:i + 1), wy, wz, first, last)
            if (last < first) cycle
            do k = 1, stations
               call find_angles(bodies, wy(first:last, 1), wz(first:last, 1), station(range_x, k), angle(first:last))
               do m = 1, 4
                  call on_circles(bodies, wy(first:last, m), wz(first:last, m), angle(first:last)*(wz(first:last, 1) &
                     & + bodies%placement%wheel_radius)/(wz(first:last, m) + bodies%placement%wheel_radius), &
                     & py(first:last, (k - 1)*4 + m), pz(first:last, (k - 1)*4 + m))
               end do
            end do
            call lower_envelope(py(first:last, :), -pz(first:last, :), sagitta(bodies, range_x), y, below)
         end do
      end associate
   end subroutine varying_wheel_below

   !> Angles at which the circles of a wheel's profile pass a position along the track
   subroutine find_angles(bodies, y, z, x, s)
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Points of the profile, and the position [mm]
      real(wp), intent(in) :: y(:), z(:), x
      !> Sine of the angle from the bottom of the wheel
      real(wp), intent(out) :: s(:)
      !> Number of iterations; each one reduces the error by the product of roll and yaw
      integer, parameter :: steps = 3
      integer :: step

      associate (axes => bodies%placement%wheel%axes, origin => bodies%placement%wheel%origin, r => bodies%placement%wheel_radius)
         s = (x - origin(1) - axes(1, 2)*y - axes(1, 3)*z)/(axes(1, 1)*(r + z))
         s = max(-widest_sine, min(widest_sine, s))
         if (.not. abs(axes(1, 3)) > 0.0_wp) return
         do step = 1, steps
            s = (x - origin(1) - axes(1, 2)*y - axes(1, 3)*((r + z)*sqrt(1.0_wp - s**2) - r))/(axes(1, 1)*(r + z))
            s = max(-widest_sine, min(widest_sine, s))
         end do
      end associate
   end subroutine find_angles

   !> Points on the circles of a wheel's profile, in track coordinates
   subroutine on_circles(bodies, y, z, s, track_y, track_z)
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Points of the profile [mm], and sine of the angle from the bottom [-]
      real(wp), intent(in) :: y(:), z(:), s(:)
      !> Track coordinates y and z of the points [mm]
      real(wp), intent(out) :: track_y(:), track_z(:)

      associate (axes => bodies%placement%wheel%axes, origin => bodies%placement%wheel%origin, r => bodies%placement%wheel_radius)
         track_y = origin(2) + axes(2, 1)*(r + z)*s + axes(2, 2)*y + axes(2, 3)*((r + z)*sqrt(1.0_wp - s**2) - r)
         track_z = origin(3) + axes(3, 1)*(r + z)*s + axes(3, 2)*y + axes(3, 3)*((r + z)*sqrt(1.0_wp - s**2) - r)
      end associate
   end subroutine on_circles

   !> Position of a point on a stretch [mm]
   pure real(wp) function station(range_x, k)
      real(wp), intent(in) :: range_x(2)
      integer, intent(in) :: k
      station = range_x(1) + (k - 1)*(range_x(2) - range_x(1))/(stations - 1)
   end function station

   !> Sagitta of circles of the wheel below the chords between points [mm]
   real(wp) function sagitta(bodies, range_x)
      type(wheel_rail_bodies), intent(in) :: bodies
      real(wp), intent(in) :: range_x(2)
      real(wp) :: s

      associate (r => bodies%placement%wheel_radius, x => bodies%placement%wheel%origin(1))
         s = min(widest_sine, maxval(abs(range_x - x))/r + added_sine)
         sagitta = ((range_x(2) - range_x(1))/(stations - 1))**2/(8.0_wp*min_radius*r*sqrt(1.0_wp - s**2)**3)
      end associate
   end function sagitta

   !> Points of a profile that does not vary, with short chords
   subroutine sample(curve, points)
      type(profile_curve), intent(in) :: curve
      !> Points y, z, shape (points, 2) [mm]
      real(wp), allocatable, intent(out) :: points(:, :)
      real(wp), allocatable :: s(:)
      integer :: i, k, n, parts

      associate (nodes => curve%y%s)
         n = 1
         do i = 2, size(nodes)
            n = n + ceiling((nodes(i) - nodes(i - 1))/longest_chord)
         end do
         allocate(s(n))
         s(1) = nodes(1)
         n = 1
         do i = 2, size(nodes)
            parts = ceiling((nodes(i) - nodes(i - 1))/longest_chord)
            s(n + 1:n + parts) = nodes(i - 1) + [(k*(nodes(i) - nodes(i - 1))/parts, k=1, parts)]
            n = n + parts
         end do
      end associate
      points = reshape([curve%y%value(s), curve%z%value(s)], [n, 2])
   end subroutine sample

   !> Transform points to other axes: origin (y, z) and roll angle, see `cut` of a surface
   pure subroutine see_from(axes, y, z)
      real(wp), intent(in) :: axes(3)
      real(wp), intent(inout) :: y(:, :), z(:, :)
      real(wp) :: before(size(y, 1), size(y, 2))

      before = y - axes(1)
      z = z - axes(2)
      y = cos(axes(3))*before + sin(axes(3))*z
      z = cos(axes(3))*z - sin(axes(3))*before
   end subroutine see_from

   !> Update the minimum z at lateral positions with a surface
   pure subroutine lower_envelope(y, z, extra, places, low)
      !> Control points, shape (points across, control points of each) [mm]
      real(wp), intent(in) :: y(:, :), z(:, :)
      !> Maximum distance of the surface from the hull of the control points [mm]
      real(wp), intent(in) :: extra
      !> Equidistant lateral positions [mm]
      real(wp), intent(in) :: places(:)
      real(wp), intent(inout) :: low(:)
      real(wp), dimension(size(y, 1)) :: my, mz, bend, left, right, top, slope, least
      real(wp) :: bulge, ends(2), step
      integer :: i, j, k, n, first, last

      n = size(y, 1)
      if (n < 2) return
      my = 0.0_wp
      mz = 0.0_wp
      left = y(:, 1)
      right = y(:, 1)
      top = z(:, 1)
      do k = 1, size(y, 2)
         my = my + y(:, k)
         mz = mz + z(:, k)
         left = min(left, y(:, k))
         right = max(right, y(:, k))
         top = min(top, z(:, k))
      end do
      my = my/size(y, 2)
      mz = mz/size(y, 2)
      bend = 0.0_wp
      bend(2:n - 1) = sqrt((my(:n - 2) - 2.0_wp*my(2:n - 1) + my(3:))**2 + (mz(:n - 2) - 2.0_wp*mz(2:n - 1) + mz(3:))**2)
      slope = 0.0_wp
      where (abs(mz(2:) - mz(:n - 1)) < wall*abs(my(2:) - my(:n - 1))) slope(:n - 1) = (mz(2:) - mz(:n - 1))/(my(2:) - my(:n - 1))
      least = huge(1.0_wp)
      do k = 1, size(y, 2)
         do i = 1, n - 1
            least(i) = min(least(i), z(i, k) - mz(i) - slope(i)*(y(i, k) - my(i)), &
               & z(i + 1, k) - mz(i) - slope(i)*(y(i + 1, k) - my(i)))
         end do
      end do
      step = 1.0_wp
      if (size(places) > 1) step = places(2) - places(1)
      do i = 1, n - 1
         bulge = bulge_share*maxval(bend(max(1, i - neighbours + 1):min(n, i + neighbours)))
         ends = [min(left(i), left(i + 1)) - bulge, max(right(i), right(i + 1)) + bulge]
         first = max(1, ceiling((ends(1) - places(1))/step) + 1)
         last = min(size(places), floor((ends(2) - places(1))/step) + 1)
         if (first > last) cycle
         if (abs(mz(i + 1) - mz(i)) >= wall*abs(my(i + 1) - my(i))) then
            low(first:last) = min(low(first:last), min(top(i), top(i + 1)) - bulge - extra)
            cycle
         end if
         least(i) = least(i) - bulge*sqrt(1.0_wp + slope(i)**2) - extra
         do j = first, last
            low(j) = min(low(j), mz(i) + slope(i)*(places(j) - my(i)) + least(i))
         end do
      end do
   end subroutine lower_envelope
end module contact_wheelrail_gap_bound
