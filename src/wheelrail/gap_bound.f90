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
   !> Upper bound of the deviation of a spline from its chord [mm]: points are at most half a millimetre apart
   real(wp), parameter :: widest_bulge = 2.0_wp
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
      real(wp) :: rail(size(y)), wheel(size(y)), near, rho, height
      real(wp), allocatable :: profile(:, :), outline(:, :)
      real(wp), allocatable :: bottom(:, :, :)
      logical :: found(size(y)), bounded
      integer :: i, j, first, last, lines(2), range(2)

      if (allocated(bodies%wheel_strip)) then
         call outline_of(bodies%wheel_strip, profile)
      else
         call sample(bodies%wheel, profile)
      end if
      bounded = allocated(profile)
      lines = [1, huge(1)]
      if (bounded) then
         lines = points_over(bodies, profile, y)
         outline = profile(lines(1):lines(2), :)
      end if
      if (allocated(bodies%wheel_strip)) then
         allocate(bottom(bodies%wheel_strip%surface%lines, 4, 2))
         call stretch_hull(bodies%wheel_strip%surface, [1.0_wp, 1.0_wp]*bodies%wheel_strip%origin, bottom(:, :, 1), &
            & bottom(:, :, 2), range(1), range(2))
      end if
      if (.not. allocated(bodies%rail_strip)) then
         call bodies%rail%heights(y, rail, found)
         where (.not. found) rail = no_surface
      end if
      do i = 1, size(edges) - 1
         if (allocated(bodies%rail_strip)) call rail_above(bodies%rail_strip, edges(i:i + 1), y, rail)
         wheel = no_surface
         first = 1
         last = size(y)
         if (bounded) call round_wheel_below(bodies, outline, edges(i:i + 1), y, wheel)
         if (allocated(bodies%wheel_strip)) then
            if (bounded) then
               ! the surface of a roller falls off along the track
               found = rail < no_surface .and. rail + wheel - rounding < far
               first = findloc(found, .true., 1)
               last = findloc(found, .true., 1, back=.true.)
            end if
            if (first > 0) then
               wheel(first:last) = no_surface
               if (bounded) lines = points_over(bodies, profile, y(first:last))
               call varying_wheel_below(bodies, bottom(range(1):range(2), 1, :), lines, edges(i:i + 1), y(first:last), &
                  & wheel(first:last))
            end if
         end if
         near = max(0.0_wp, edges(i), -edges(i + 1))
         do j = 1, size(y)
            low(i, j) = no_surface
            if (.not. (rail(j) < no_surface .and. wheel(j) < no_surface)) cycle
            height = rail(j)
            if (bodies%placement%roller_radius > 0.0_wp) then
               rho = bodies%placement%roller_radius - height
               if (.not. near < rho) cycle
               height = height + bodies%placement%roller_drop(near, height)
            end if
            low(i, j) = height + wheel(j) - rounding
         end do
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

   !> First and last point of a wheel's profile that can be above a lateral range, with some more for the envelope
   pure function points_over(bodies, profile, y) result(range)
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Points of the profile, see `round_wheel_below`
      real(wp), intent(in) :: profile(:, :)
      !> Lateral positions, increasing [mm]
      real(wp), intent(in) :: y(:)
      integer :: range(2)
      logical :: over(size(profile, 1))
      real(wp) :: slack
      integer :: i, columns

      columns = size(profile, 2)
      associate (axes => bodies%placement%wheel%axes, origin => bodies%placement%wheel%origin, r => bodies%placement%wheel_radius)
         ! points are on circles around the axle
         do i = 1, size(over)
            slack = widest_bulge + (abs(axes(2, 1))*widest_sine + abs(axes(2, 3)))*(r + abs(profile(i, columns)))
            over(i) = origin(2) + axes(2, 2)*profile(i, 1) - slack <= y(size(y)) .and. &
               & origin(2) + axes(2, 2)*profile(i, columns - 1) + slack >= y(1)
         end do
      end associate
      range(1) = max(1, findloc(over, .true., 1) - neighbours - 1)
      range(2) = min(size(over), findloc(over, .true., 1, back=.true.) + neighbours + 1)
   end function points_over

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
      pz = -pz
      call lower_envelope(py, pz, sagitta(bodies, range_x), y, below)
   end subroutine round_wheel_below

   !> Lowest positions of an out-of-round wheel over a stretch of the track, as minimum -z
   subroutine varying_wheel_below(bodies, bottom, lines, range_x, y, below)
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Points y, z of the section at the bottom [mm], shape (points, 2); none if there is no section
      real(wp), intent(in) :: bottom(:, :)
      !> First and last line of the surface that are needed
      integer, intent(in) :: lines(2)
      real(wp), intent(in) :: range_x(2), y(:)
      real(wp), intent(inout) :: below(:)
      real(wp), allocatable :: breaks(:), py(:, :), pz(:, :), angle(:)
      real(wp) :: wy(bodies%wheel_strip%surface%lines, 4), wz(bodies%wheel_strip%surface%lines, 4), range(2)
      integer :: i, k, m, first, last, n

      associate (along => bodies%wheel_strip, r => bodies%placement%wheel_radius)
         ! angles at which the lines of the bottom section pass both ends of the stretch
         n = size(bottom, 1)
         allocate(angle(along%surface%lines))
         range = range_x/r
         if (n > 0) then
            range = [huge(1.0_wp), -huge(1.0_wp)]
            do k = 1, stations, stations - 1
               call find_angles(bodies, bottom(:, 1), bottom(:, 2), station(range_x, k), angle(:n))
               range = [min(range(1), asin(minval(angle(:n)))), max(range(2), asin(maxval(angle(:n))))]
            end do
         end if
         call stretch_breaks(along%surface, range + along%origin, breaks)
         do i = 1, size(breaks) - 1
            call stretch_hull(along%surface, breaks(i:i + 1), wy, wz, first, last, lines)
            if (last < first) cycle
            n = last - first + 1
            if (allocated(py)) deallocate(py, pz)
            allocate(py(n, 4*stations), pz(n, 4*stations))
            do k = 1, stations
               call find_angles(bodies, wy(first:last, 1), wz(first:last, 1), station(range_x, k), angle(:n))
               do m = 1, 4
                  call on_circles(bodies, wy(first:last, m), wz(first:last, m), angle(:n)*(wz(first:last, 1) + r) &
                     & /(wz(first:last, m) + r), py(:, (k - 1)*4 + m), pz(:, (k - 1)*4 + m))
               end do
            end do
            pz = -pz
            call lower_envelope(py, pz, sagitta(bodies, range_x), y, below)
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
      real(wp) :: ahead, below
      integer :: i

      associate (axes => bodies%placement%wheel%axes, origin => bodies%placement%wheel%origin, r => bodies%placement%wheel_radius)
         do i = 1, size(y)
            ahead = (r + z(i))*s(i)
            below = (r + z(i))*sqrt(1.0_wp - s(i)**2) - r
            track_y(i) = origin(2) + axes(2, 1)*ahead + axes(2, 2)*y(i) + axes(2, 3)*below
            track_z(i) = origin(3) + axes(3, 1)*ahead + axes(3, 2)*y(i) + axes(3, 3)*below
         end do
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
      real(wp) :: bulge, ends(2), step, share
      integer :: i, j, k, n, first, last

      n = size(y, 1)
      if (n < 2) return
      share = 1.0_wp/size(y, 2)
      my = 0.0_wp
      mz = 0.0_wp
      left = y(:, 1)
      right = y(:, 1)
      top = z(:, 1)
      do k = 1, size(y, 2)
         do i = 1, n
            my(i) = my(i) + y(i, k)
            mz(i) = mz(i) + z(i, k)
            left(i) = min(left(i), y(i, k))
            right(i) = max(right(i), y(i, k))
            top(i) = min(top(i), z(i, k))
         end do
      end do
      my = my*share
      mz = mz*share
      bend(1) = 0.0_wp
      bend(n) = 0.0_wp
      do i = 2, n - 1
         bend(i) = sqrt((my(i - 1) - 2.0_wp*my(i) + my(i + 1))**2 + (mz(i - 1) - 2.0_wp*mz(i) + mz(i + 1))**2)
      end do
      slope(n) = 0.0_wp
      do i = 1, n - 1
         slope(i) = 0.0_wp
         if (abs(mz(i + 1) - mz(i)) < wall*abs(my(i + 1) - my(i))) slope(i) = (mz(i + 1) - mz(i))/(my(i + 1) - my(i))
      end do
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
         bulge = 0.0_wp
         do k = max(1, i - neighbours + 1), min(n, i + neighbours)
            bulge = max(bulge, bend(k))
         end do
         bulge = bulge_share*bulge
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
