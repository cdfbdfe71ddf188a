!> The surfaces of wheel and rail if one of them varies: a rail along the track, a wheel around its axle
!>
!> Sections of the variable profile are on an equidistant mesh along the track (rail) or around the axle (wheel), with their
!> derivatives along the mesh; between sections, heights are interpolated by cubic Hermite polynomials. A section is computed at its
!> first use: most of them are never used (contact_wheelrail_strip). Bodies that do not vary are evaluated from their profile.
module contact_wheelrail_bodies
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface, surface_cut
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_placement, only : wheel_rail_placement
   use contact_wheelrail_strip, only : lay_out, slice_pair, strip
   use contact_wheelrail_wheel_surface, only : wheel_height, wheel_row
   implicit none (type, external)
   private

   public :: wheel_rail_bodies, strip, place_bodies, search_reach, widest_reach, rail_section, find_rail, find_wheel
   public :: find_rail_row, find_wheel_row, slice_pair

   !> Both surfaces in their present positions
   type :: wheel_rail_bodies
      !> The rail in track coordinates, the wheel in its own
      type(profile_curve) :: rail, wheel
      type(wheel_rail_placement) :: placement
      !> Sections of a variable rail in track coordinates; unallocated for a prismatic rail
      type(strip), allocatable :: rail_strip
      !> Sections of an out-of-round wheel in wheel coordinates, by the angle from its bottom
      type(strip), allocatable :: wheel_strip
      !> See search_spec
      logical :: angle_below_axle = .false.
   end type wheel_rail_bodies

   !> Maximum distance of sections along the surface [mm]
   real(wp), parameter :: furthest_section = 1.0_wp
   !> Range of the contact search along the track to both sides, its upper bound, and additional range of sections, relative to the
   !> wheel's radius
   real(wp), parameter :: reach = 0.125_wp, furthest = 0.5_wp, beyond = 0.035_wp
   !> Slope of the steepest flank in the contact search, dz/dy: 80 degrees
   real(wp), parameter :: steepest_flank = 5.67_wp
   !> Minimum dy/ds of a rail: a steeper surface is regarded as vertical
   real(wp), parameter :: steepest = 1.0e-6_wp

contains

   !> Prepare the sections for a case. `bodies%rail`, `bodies%wheel` and `bodies%placement` are set already
   !>
   !> The distance of sections is that of elements: a wheel flat or a joint that is described by closely spaced slices is visible in
   !> the pressures, and is smoothed by coarser sections (5 % of the maximum pressure of `wheelflat` for 1 mm).
   subroutine place_bodies(bodies, s_ws, pitch, dx, rail_surface, wheel_surface)
      !> Profiles and placement on entry; sections and their range are set
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Position of the wheelset along the track [mm]; pitch angle of the wheel [rad]
      real(wp), intent(in) :: s_ws, pitch
      !> Size of the elements along the track [mm]
      real(wp), intent(in) :: dx
      !> Allocated for bodies that vary
      type(profile_surface), intent(in), allocatable :: rail_surface, wheel_surface
      real(wp), parameter :: no_axes(3) = 0.0_wp
      real(wp) :: distance, turned
      integer :: n

      distance = min(furthest_section, dx)
      n = ceiling((widest_reach(bodies) + beyond*bodies%placement%wheel_radius)/distance)
      call lay_out(bodies%rail_strip, rail_surface, n, bodies%placement%wheel%origin(1), distance, s_ws, &
         & track_axes(bodies%placement), fixed=.false.)
      ! With positive pitch the point at the bottom was ahead of it at zero pitch, at a negative angle
      turned = 2.0_wp*pi*anint(pitch/(2.0_wp*pi)) - pitch
      call lay_out(bodies%wheel_strip, wheel_surface, n, 0.0_wp, distance/bodies%placement%wheel_radius, &
         & turned, no_axes, fixed=.true.)
   end subroutine place_bodies

   !> Range of the contact search along the track, to both sides of the axle [mm]: on the flank of a yawed wheel, contact is ahead
   !> of or behind the axle by radius times slope times yaw
   pure real(wp) function search_reach(bodies) result(length)
      !> After `place_bodies`
      type(wheel_rail_bodies), intent(in) :: bodies

      associate (yaw => abs(bodies%placement%wheel%yaw()))
         length = max(reach, min(furthest, steepest_flank*tan(min(yaw, 1.0_wp))))*bodies%placement%wheel_radius
      end associate
   end function search_reach

   !> Maximum range of the contact search along the track [mm]
   pure real(wp) function widest_reach(bodies) result(length)
      !> After `place_bodies`
      type(wheel_rail_bodies), intent(in) :: bodies
      length = furthest*bodies%placement%wheel_radius
   end function widest_reach

   !> Origin (y, z) and roll angle of the track in rail coordinates
   pure function track_axes(placement) result(axes)
      type(wheel_rail_placement), intent(in) :: placement
      real(wp) :: axes(3)
      real(wp) :: angle

      angle = placement%rail%roll()
      associate (o => placement%rail%origin)
         axes = [-cos(angle)*o(2) - sin(angle)*o(3), sin(angle)*o(2) - cos(angle)*o(3), -angle]
      end associate
   end function track_axes

   !> Section of a variable rail in track coordinates
   subroutine rail_section(surface, placement, u, section)
      !> Surface through the slices of the rail
      type(profile_surface), intent(in) :: surface
      !> Position and orientation of the rail in the track
      type(wheel_rail_placement), intent(in) :: placement
      !> Position along the track [mm]
      real(wp), intent(in) :: u
      !> Section; `present` is false in gaps between slices
      type(surface_cut), intent(out) :: section

      call surface%continued(u, section, track_axes(placement))
   end subroutine rail_section

   !> Height n of the rail above a point (x, s) of a plane; of the track itself if the plane is the default frame
   !>
   !> On the line along n the surface is found by Newton's method, with the slope across the rail.
   subroutine find_rail(bodies, plane, x, s, n, found)
      !> After `place_bodies`; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Plane in track coordinates
      type(frame), intent(in) :: plane
      !> Position in the plane [mm]
      real(wp), intent(in) :: x, s
      !> Estimate on entry, solution on exit [mm]
      real(wp), intent(inout) :: n
      !> Does the line along n intersect the rail?
      logical, intent(out) :: found
      real(wp) :: point(3), z, z_y, correction, rho, place, along, across, facing
      logical :: vertical
      integer :: step
      !> Tolerance of a step [mm]; with the approximate slope the remaining error is a thousandth of it
      real(wp), parameter :: tolerance = 1.0e-7_wp

      ! on a vertical line no iteration is needed
      vertical = all(abs(plane%axes(1:2, 3)) <= 0.0_wp)
      do step = 1, 30
         point = plane%to_parent([x, s, n])
         if (allocated(bodies%rail_strip)) then
            call bodies%rail_strip%at(point(1), point(2), z, z_y, found)
         else
            call bodies%rail%find(point(2), place, found)
            if (found) then
               call bodies%rail%point(place, along, z, across, z_y)
               z_y = z_y/max(across, steepest)
            end if
         end if
         if (.not. found) return
         if (bodies%placement%roller_radius > 0.0_wp) then
            rho = bodies%placement%roller_radius - z
            found = abs(point(1)) < rho
            if (.not. found) return
            z = z + bodies%placement%roller_drop(point(1), z)
         end if
         facing = plane%axes(3, 3) - z_y*plane%axes(2, 3)
         correction = (z - point(3))/facing
         n = n + correction
         if (vertical .or. abs(correction) <= tolerance) then
            ! a surface that faces away from the plane is not in contact
            found = facing > 0.0_wp
            return
         end if
      end do
      found = .false.
   end subroutine find_rail

   !> Heights n of the rail above a row of points (x, s) of a plane; the estimate for each point is extrapolated from the last three
   subroutine find_rail_row(bodies, plane, x, s, n, found)
      !> After `place_bodies`; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Plane in track coordinates
      type(frame), intent(in) :: plane
      !> Positions in the plane [mm], x equidistant
      real(wp), intent(in) :: x(:), s
      !> Height above each point [mm]
      real(wp), intent(out) :: n(:)
      !> Does the line along n intersect the rail?
      logical, intent(out) :: found(:)
      real(wp) :: recent(3)
      integer :: i, known

      recent = 0.0_wp
      known = 0
      if (size(x) > 1 .and. .not. allocated(bodies%rail_strip) .and. .not. bodies%placement%roller_radius > 0.0_wp &
         & .and. all(abs(plane%axes(2:3, 1)) <= 0.0_wp)) then
         ! a surface that does not vary along the track is evaluated once, unless the estimate of a point depends on the last one
         n(1) = 0.0_wp
         call find_rail(bodies, plane, x(1), s, n(1), found(1))
         if (found(1)) call find_rail(bodies, plane, x(1), s, n(1), found(1))
         n(2:) = n(1)
         found(2:) = found(1)
         return
      end if
      do i = 1, size(x)
         n(i) = estimate(recent, known)
         call find_rail(bodies, plane, x(i), s, n(i), found(i))
         call keep(recent, known, n(i), found(i))
      end do
   end subroutine find_rail_row

   !> Height n of the wheel above a point (x, s) of a plane
   subroutine find_wheel(bodies, seen, x, s, place, n, found)
      !> After `place_bodies`; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> The plane in wheel coordinates
      type(frame), intent(in) :: seen
      !> Position in the plane [mm]
      real(wp), intent(in) :: x, s
      !> Position on the profile of a round wheel, and height [mm]: estimates on entry, solution on exit
      real(wp), intent(inout) :: place, n
      !> Does the line along n intersect the wheel?
      logical, intent(out) :: found
      real(wp) :: base(3), q(3), k(3), rho, angle, z, z_y, z_around, around, correction
      integer :: step
      !> Length along the surface of the last step of Newton's method [mm]; the remaining error is its square over the radius of
      !> curvature
      real(wp), parameter :: short_way = 3.0e-5_wp

      associate (radius => bodies%placement%wheel_radius)
         if (.not. allocated(bodies%wheel_strip)) then
            call wheel_height(bodies%wheel, radius, seen, x, s, place, n, found)
            return
         end if
         k = seen%axes(:, 3)
         base = seen%origin + seen%axes(:, 1)*x + seen%axes(:, 2)*s + [0.0_wp, 0.0_wp, radius]
         do step = 1, 30
            q = base + k*n
            rho = sqrt(q(1)**2 + q(3)**2)
            ! below the axle the simpler function is twice as fast
            if (q(3) > 0.0_wp) then
               angle = atan(q(1)/q(3))
            else
               angle = atan2(q(1), q(3))
            end if
            call bodies%wheel_strip%at(angle, q(2), z, z_y, found, z_around)
            if (.not. found) return
            ! equation: radius + z - rho = 0
            around = (k(1)*q(3) - k(3)*q(1))/rho
            correction = (radius + z - rho)/((k(1)*q(1) + k(3)*q(3))/rho - z_y*k(2) - z_around*around/rho)
            n = n + correction
            if (correction**2*(k(2)**2 + around**2) <= short_way**2) return
         end do
         found = .false.
      end associate
   end subroutine find_wheel

   !> Heights n of the wheel above a row of points (x, s) of a plane
   subroutine find_wheel_row(bodies, seen, x, s, n, found)
      !> After `place_bodies`; sections are computed as needed
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> The plane in wheel coordinates
      type(frame), intent(in) :: seen
      !> Positions in the plane [mm], x equidistant
      real(wp), intent(in) :: x(:), s
      !> Height above each point [mm]
      real(wp), intent(out) :: n(:)
      !> Does the line along n intersect the wheel?
      logical, intent(out) :: found(:)
      real(wp) :: start(2), recent(3), place(size(x))
      integer :: i, known

      start = [bodies%wheel%s_at(seen%origin(2) + seen%axes(2, 1)*x(1) + seen%axes(2, 2)*s), 0.0_wp]
      if (.not. allocated(bodies%wheel_strip)) then
         call wheel_row(bodies%wheel, bodies%placement%wheel_radius, seen, x, s, start, place, n, found)
         return
      end if
      recent = 0.0_wp
      known = 0
      do i = 1, size(x)
         n(i) = estimate(recent, known)
         call find_wheel(bodies, seen, x(i), s, start(1), n(i), found(i))
         call keep(recent, known, n(i), found(i))
      end do
   end subroutine find_wheel_row

   !> Estimate of the next height in a row, from the parabola through the last three
   pure real(wp) function estimate(recent, known)
      !> Heights, the last one first, and their number
      real(wp), intent(in) :: recent(3)
      integer, intent(in) :: known

      select case (known)
      case (0)
         estimate = 0.0_wp
      case (1, 2)
         estimate = recent(1)
      case default
         estimate = 3.0_wp*(recent(1) - recent(2)) + recent(3)
      end select
   end function estimate

   !> Store a height; a point without surface starts a new row
   pure subroutine keep(recent, known, height, found)
      real(wp), intent(inout) :: recent(3)
      integer, intent(inout) :: known
      real(wp), intent(in) :: height
      logical, intent(in) :: found

      recent = [height, recent(:2)]
      known = merge(min(known + 1, 3), 0, found)
   end subroutine keep
end module contact_wheelrail_bodies
