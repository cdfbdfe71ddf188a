!> Contact that reaches the end of a profile, and ends of profiles that are in contact outside the patches
!>
!> A profile is unknown beyond its last point: contact that would continue there is cut off, and its pressures are those at a sharp
!> edge. The contact search finds positions where the surfaces can have a common tangent plane. The edge at the end of the wheel's
!> profile does not need one: ahead of or behind the axle, the edge of a yawed wheel may be within the rail outside all patches.
module contact_wheelrail_profile_ends
   use contact_base_choices, only : force_control
   use contact_base_constants, only : excluded_threshold, pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_numeric_vectors, only : largest_of
   use contact_patch_result, only : border_contact
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface_hull, only : stretch_hull
   use contact_wheelrail_bodies, only : slice_pair
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap_bound, only : rail_extent
   use contact_wheelrail_geometry, only : wheel_rail_geometry, rail_at
   use contact_wheelrail_memory, only : wheel_rail_memory, patch_slot
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_result, only : buried_end
   implicit none (type, external)
   private

   public :: depth_within, find_buried_ends, find_spot_beside, mark_profile_ends

   !> Undeformed distances above this value mean that a surface is missing [mm]; those above excluded_threshold that the element is
   !> excluded from contact
   real(wp), parameter :: missing = 500.0_wp

contains

   !> Find the ends of the profiles that contact reaches: a surface is missing in the next element along y, and an end is nearby; if
   !> no end is near, the surface continues but is hidden
   subroutine mark_profile_ends(problem, geometry, slot, border)
      !> Profiles of rail and wheel
      type(wheel_rail_problem), intent(in) :: problem
      !> Positions of the bodies
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Solved patch
      type(patch_slot), intent(in) :: slot
      !> `surface_end`, `hidden` and `pressure` are set; body 1 is the rail
      type(border_contact), intent(inout) :: border
      !> Maximum distance of the end from the centre of the element without surface, in elements
      real(wp), parameter :: nearest = 2.0_wp
      real(wp) :: ends(2, 2, 2), distance(2, 2)
      integer :: found(2), ix, iy, next, side
      logical :: known

      if (slot%result%ncon == 0) return
      known = .false.
      associate (grid => slot%problem%grid, h => slot%problem%h, result => slot%result)
         if (.not. (has_missing(h) .or. any(result%division(:, [1, grid%my]) /= element%exterior))) return
         do iy = 1, grid%my
            do ix = 1, grid%mx
               if (result%division(ix, iy) == element%exterior) cycle
               do side = -1, 1, 2
                  next = iy + side
                  if (next >= 1 .and. next <= grid%my) then
                     if (h(ix, next) < missing .or. h(ix, next) > excluded_threshold) cycle
                  end if
                  if (.not. known) call find_ends(problem, geometry, slot%plane%origin, ends)
                  known = .true.
                  distance = norm2(ends - in_sections(geometry, point_of(slot, ix, next)), dim=1)
                  found = minloc(distance)
                  if (distance(found(1), found(2)) <= nearest*grid%dy) then
                     border%surface_end(found(1), found(2)) = .true.
                  else if (next >= 1 .and. next <= grid%my) then
                     border%hidden = .true.
                  else
                     cycle
                  end if
                  border%pressure = max(border%pressure, result%pn(ix, iy))
               end do
            end do
         end do
      end associate
   end subroutine mark_profile_ends

   !> Is a surface missing in an element?
   pure logical function has_missing(h)
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), contiguous, intent(in) :: h(:, :)

      has_missing = largest_of(size(h), h) >= missing
   end function has_missing

   !> Find ends of the wheel's profile that are within the rail outside all patches
   !>
   !> The circle of each end is sampled as far as it may be below the top of the rail, and refined at its deepest point.
   subroutine find_buried_ends(problem, memory, buried)
      !> Profiles of rail and wheel
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      !> Ends at the lower and at the higher y
      type(buried_end), intent(out) :: buried(2)

      if (has_own_section(problem)) then
         call search_ends(problem, memory, section_at(problem, memory%geometry, 0.0_wp), buried)
      else
         call search_ends(problem, memory, memory%geometry%rail_in_track, buried)
      end if
   end subroutine find_buried_ends

   !> Find the ends within the rail, starting from the section of the rail at the axle
   subroutine search_ends(problem, memory, rail, buried)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      !> Section of the rail in track coordinates
      type(profile_curve), intent(in) :: rail
      type(buried_end), intent(inout) :: buried(2)
      !> Maximum angle to both sides [rad]; steps on a prismatic rail and on one that varies [mm]; number of points per refinement,
      !> and number of refinements
      real(wp), parameter :: furthest = pi/6.0_wp, fine = 1.0_wp, coarse = 5.0_wp
      integer, parameter :: parts = 10, rounds = 3
      !> Depths below this value are round-off [mm]
      real(wp), parameter :: least = 1.0e-5_wp
      type(profile_curve) :: section
      type(slice_pair) :: slices
      real(wp) :: end(2), middle, half, step, top, y_range(2), angle, reach
      integer :: i, k, n, round

      associate (geometry => memory%geometry, wheel => memory%geometry%placement%wheel, &
         & r0 => memory%geometry%placement%wheel_radius)
         y_range = rail%z%node_range()
         top = y_range(1)
         y_range = rail%y_range()
         step = fine
         if (allocated(geometry%bodies%rail_strip)) then
            call rail_extent(geometry%bodies%rail_strip, wheel%origin(1) + [-1.0_wp, 1.0_wp]*furthest*r0, y_range, top)
            if (y_range(2) < y_range(1)) return
            step = coarse
         end if
         do k = 1, 2
            end = wheel_end(problem, geometry, k, 0.0_wp)
            ! height of the axle at this end, and radius times cosine of the angle from the lowest point
            middle = atan2(wheel%axes(3, 1), wheel%axes(3, 3))
            reach = hypot(wheel%axes(3, 1), wheel%axes(3, 3))*(r0 + end(2))
            half = (top - (wheel%origin(3) + wheel%axes(3, 2)*end(1) - wheel%axes(3, 3)*r0))/reach
            if (half >= 1.0_wp) cycle
            half = min(furthest, acos(max(half, 0.0_wp)))
            if (.not. passes(y_range)) cycle
            n = ceiling(half*(r0 + end(2))/step)
            buried(k)%depth = -huge(1.0_wp)
            angle = middle
            call sample_circle(half/max(n, 1), n)
            do round = 1, rounds
               middle = angle
               call sample_circle(half/max(n, 1)/parts**round, parts)
            end do
            if (buried(k)%depth < least) then
               buried(k)%depth = 0.0_wp
            else
               do i = 1, memory%used
                  if (holds(memory%slot(i), buried(k)%place)) buried(k)%depth = 0.0_wp
               end do
            end if
         end do
      end associate

   contains

      !> Is the circle within the lateral range of the rail?
      logical function passes(y_range)
         !> Lateral range of the rail [mm]
         real(wp), intent(in) :: y_range(2)
         real(wp) :: y(3), place(3)
         integer :: m

         do m = -1, 1
            call find_on_circle(problem, memory%geometry, k, middle + m*half, end, place)
            y(m + 2) = place(2)
         end do
         passes = maxval(y) > y_range(1) .and. minval(y) < y_range(2)
      end function passes

      !> Find the deepest one of points at equal angles on both sides of the middle
      subroutine sample_circle(step, count)
         !> Angle between points [rad]
         real(wp), intent(in) :: step
         integer, intent(in) :: count
         real(wp) :: place(3), depth
         integer :: m

         do m = -count, count
            call find_on_circle(problem, memory%geometry, k, middle + m*step, end, place)
            if (allocated(problem%rail_surface)) then
               section = section_at(problem, memory%geometry, place(1))
               depth = depth_within(section, in_rail_section(memory%geometry, place))
            else
               depth = depth_within(rail, in_rail_section(memory%geometry, place))
            end if
            if (depth <= buried(k)%depth) cycle
            if (depth > 0.0_wp .and. allocated(memory%geometry%bodies%rail_strip)) then
               associate (z => section%height(place(2)))
                  if (place(3) - z < slices%overshoot(memory%geometry%bodies%rail_strip, place(1), place(2), z)) cycle
               end associate
            end if
            buried(k) = buried_end(depth, place)
            angle = middle + m*step
         end do
      end subroutine sample_circle
   end subroutine search_ends

   !> Point on the circle of an end of the wheel's profile, in track coordinates [mm]
   subroutine find_on_circle(problem, geometry, k, angle, end, place)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      !> End of the profile, 1 or 2
      integer, intent(in) :: k
      !> Angle from the lowest point of the wheel [rad]
      real(wp), intent(in) :: angle
      !> The end in coordinates of the profile [mm]; updated if the wheel varies
      real(wp), intent(inout) :: end(2)
      real(wp), intent(out) :: place(3)
      real(wp) :: radius

      if (allocated(problem%wheel_surface)) end = wheel_end(problem, geometry, k, angle)
      radius = geometry%placement%wheel_radius + end(2)
      place = geometry%placement%wheel%to_parent([radius*sin(angle), end(1), radius*cos(angle) - geometry%placement%wheel_radius])
   end subroutine find_on_circle

   !> Find overlap outside all patches: where the gap has several minima along the track, the contact search keeps the lowest one at
   !> each lateral position
   subroutine find_spot_beside(problem, memory, beside)
      !> Profiles of rail and wheel
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      !> The overlap with maximum vertical depth
      type(buried_end), intent(out) :: beside
      !> Depths below this value are round-off [mm]
      real(wp), parameter :: least = 1.0e-5_wp
      type(profile_curve) :: rail
      real(wp) :: depth, place(3), before, behind
      integer :: i, j, k

      associate (gap => memory%geometry%gap)
         depth = memory%z_ws - memory%geometry%gap_height - gap%far
         if (depth > least) then
            rail = section_at(problem, memory%geometry, gap%far_place(1))
            place = [gap%far_place, rail%height(gap%far_place(2))]
            if (.not. any([(holds(memory%slot(i), place), i=1, memory%used)])) &
               & beside = buried_end(depth, place, beyond_reach=.true.)
         end if
         if (.not. allocated(gap%unweighed)) return
         do j = 1, gap%n
            do k = 1, size(gap%x_table)
               associate (g => gap%unweighed(k, j))
                  depth = memory%z_ws - memory%geometry%gap_height - g
                  if (depth <= max(least, beside%depth)) cycle
                  before = gap%unweighed(max(1, k - 1), j)
                  behind = gap%unweighed(min(size(gap%x_table), k + 1), j)
                  if (before < g .or. behind <= g .and. k < size(gap%x_table)) cycle
               end associate
               place = [gap%x_table(k), gap%y(j), gap%z(j)]
               if (any([(holds(memory%slot(i), place), i=1, memory%used)])) cycle
               beside = buried_end(depth, place)
            end do
         end do
      end associate
   end subroutine find_spot_beside

   !> Depth of a point below the surface of a section of the rail [mm]; negative above it, and where there is no surface above
   pure function depth_within(rail, point) result(depth)
      !> Section of the rail in track coordinates
      type(profile_curve), intent(in) :: rail
      !> Coordinates y and z [mm]
      real(wp), intent(in) :: point(2)
      real(wp) :: depth
      !> Number of Newton steps from the nearest chord to the nearest point
      integer, parameter :: steps = 4
      real(wp) :: s, y(2), z(2), t, distance, least, nearest, y_s, z_s, side
      integer :: i
      logical :: found

      depth = -huge(depth)
      call rail%find(point(1), s, found)
      if (.not. found) return
      depth = point(2) - rail%z%value(s)
      if (depth <= 0.0_wp) return
      least = huge(least)
      nearest = s
      associate (nodes => rail%y%s)
         y(2) = rail%y%value(nodes(1))
         z(2) = rail%z%value(nodes(1))
         do i = 2, size(nodes)
            y(1) = y(2)
            z(1) = z(2)
            y(2) = rail%y%value(nodes(i))
            z(2) = rail%z%value(nodes(i))
            t = (point(1) - y(1))*(y(2) - y(1)) + (point(2) - z(1))*(z(2) - z(1))
            t = t/max(tiny(t), (y(2) - y(1))**2 + (z(2) - z(1))**2)
            t = max(0.0_wp, min(1.0_wp, t))
            distance = hypot(point(1) - y(1) - t*(y(2) - y(1)), point(2) - z(1) - t*(z(2) - z(1)))
            if (distance >= least) cycle
            least = distance
            nearest = nodes(i - 1) + t*(nodes(i) - nodes(i - 1))
         end do
         do i = 1, steps
            call rail%point(nearest, y(1), z(1), y_s, z_s)
            nearest = nearest + ((point(1) - y(1))*y_s + (point(2) - z(1))*z_s)/max(tiny(t), y_s**2 + z_s**2)
            nearest = max(nodes(1), min(nodes(size(nodes)), nearest))
         end do
      end associate
      call rail%point(nearest, y(1), z(1), y_s, z_s)
      ! the material is to the right of the curve, below it where y increases; a point to its left is below an overhang
      side = (point(2) - z(1))*y_s - (point(1) - y(1))*z_s
      depth = sign(min(least, hypot(point(1) - y(1), point(2) - z(1))), side)
   end function depth_within

   !> Is a point within the range of surfaces that is covered by the elements of a patch?
   pure logical function holds(slot, point)
      type(patch_slot), intent(in) :: slot
      !> Point in track coordinates [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: local(3)

      local = slot%plane%to_local(point)
      associate (grid => slot%problem%grid)
         holds = abs(local(1) - grid%xl - 0.5_wp*grid%mx*grid%dx) <= (0.5_wp*grid%mx + 1.0_wp)*grid%dx
         if (.not. holds) return
         if (allocated(slot%curve)) then
            holds = any(hypot(slot%curve%y - point(2), slot%curve%z - point(3)) <= 2.0_wp*grid%dy)
         else
            holds = abs(local(2) - grid%yl - 0.5_wp*grid%my*grid%dy) <= (0.5_wp*grid%my + 1.0_wp)*grid%dy
         end if
      end associate
   end function holds

   !> Ends of the sections of rail and wheel, each in the coordinates of `in_sections` [mm]: (y z, low and high end, rail and wheel)
   subroutine find_ends(problem, geometry, point, ends)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Position of the sections of bodies that vary, in track coordinates [mm]
      real(wp), intent(in) :: point(3)
      real(wp), intent(out) :: ends(2, 2, 2)
      type(profile_curve) :: rail
      real(wp) :: local(3)
      integer :: k

      rail = section_at(problem, geometry, point(1))
      local = geometry%placement%wheel%to_local(point)
      do k = 1, 2
         ends(:, k, 1) = end_of(rail, k)
         ends(:, k, 2) = wheel_end(problem, geometry, k, atan2(local(1), local(3) + geometry%placement%wheel_radius))
      end do
   end subroutine find_ends

   !> Does the present section of the rail differ from that of the gap?
   pure logical function has_own_section(problem)
      type(wheel_rail_problem), intent(in) :: problem
      has_own_section = allocated(problem%rail_surface) .or. problem%force == force_control%massless_rail
   end function has_own_section

   !> Section of the rail in its present position, in track coordinates: springs may have lowered it since the gap was measured
   function section_at(problem, geometry, x) result(rail)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Position in track coordinates [mm]; not used for a prismatic rail
      real(wp), intent(in) :: x
      type(profile_curve) :: rail

      if (has_own_section(problem)) then
         rail = rail_at(problem, geometry%placement, x)
      else
         rail = geometry%rail_in_track
      end if
   end function section_at

   !> Point of the track in the coordinates of the sections of rail and wheel through it, for both ends [mm]: (y z, both ends, rail
   !> and wheel)
   pure function in_sections(geometry, point) result(sections)
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Point in track coordinates [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: sections(2, 2, 2)
      real(wp) :: local(3)

      sections(:, :, 1) = spread(in_rail_section(geometry, point), 2, 2)
      local = geometry%placement%wheel%to_local(point)
      associate (r0 => geometry%placement%wheel_radius)
         sections(:, :, 2) = spread([local(2), hypot(local(1), local(3) + r0) - r0], 2, 2)
      end associate
   end function in_sections

   !> Point of the track in the coordinates of the rail's section; for a roller, in the half plane through its axle
   pure function in_rail_section(geometry, point) result(section)
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Point in track coordinates [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: section(2)

      section = point(2:3)
      associate (r => geometry%placement%roller_radius)
         if (r > 0.0_wp) section(2) = r - hypot(point(1), r - point(3))
      end associate
   end function in_rail_section

   !> Coordinates y and z of an end of the wheel's profile [mm], in the section at an angle
   function wheel_end(problem, geometry, k, angle) result(point)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      !> See `end_of`
      integer, intent(in) :: k
      !> Angle from the lowest point of the wheel [rad]; not used for a round wheel
      real(wp), intent(in) :: angle
      real(wp) :: point(2)
      real(wp), allocatable :: y(:, :), z(:, :)
      integer :: first, last

      if (.not. allocated(problem%wheel_surface)) then
         point = end_of(problem%wheel, k)
         return
      end if
      allocate(y(problem%wheel_surface%lines, 4), z(problem%wheel_surface%lines, 4))
      call stretch_hull(problem%wheel_surface, [1.0_wp, 1.0_wp]*(angle + geometry%bodies%wheel_strip%origin), y, z, first, last)
      if (last < first) then
         point = end_of(problem%wheel, k)
      else if ((y(first, 1) <= y(last, 1)) .eqv. k == 1) then
         point = [y(first, 1), z(first, 1)]
      else
         point = [y(last, 1), z(last, 1)]
      end if
   end function wheel_end

   !> Coordinates y and z of an end of a profile [mm]
   pure function end_of(curve, k) result(point)
      type(profile_curve), intent(in) :: curve
      !> 1: end at the lower y, 2: end at the higher y
      integer, intent(in) :: k
      real(wp) :: point(2)
      real(wp) :: range(2), y(2), z(2), slope(2)
      integer :: i

      range = curve%s_range()
      do i = 1, 2
         call curve%point(range(i), y(i), z(i), slope(1), slope(2))
      end do
      i = merge(k, 3 - k, y(1) <= y(2))
      point = [y(i), z(i)]
   end function end_of

   !> Centre of an element on the reference surface, in track coordinates [mm]
   pure function point_of(slot, ix, iy) result(point)
      type(patch_slot), intent(in) :: slot
      !> Column and row; the row may lie one outside the grid
      integer, intent(in) :: ix, iy
      real(wp) :: point(3)
      type(frame) :: row
      integer :: inside

      if (allocated(slot%curve)) then
         inside = min(max(iy, 1), slot%problem%grid%my)
         row = slot%curve%row_axes(inside)
         point = row%to_parent([slot%problem%grid%x(ix), (iy - inside)*slot%problem%grid%dy, 0.0_wp])
      else
         point = slot%plane%to_parent([slot%problem%grid%x(ix), slot%problem%grid%y(iy), 0.0_wp])
      end if
   end function point_of
end module contact_wheelrail_profile_ends
