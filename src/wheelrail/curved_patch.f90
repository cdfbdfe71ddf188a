!> A contact patch on a curved reference surface
!>
!> The reference curve runs midway between the two undeformed profiles in the section of the track at the contact reference. Rows of
!> elements lie on it at equal distances of the rail's arc length; the reference surface is the curve extruded along the track. Each
!> row has its own axes: x along the track, s along the curve, n normal to it and into the rail. Distances, motions and forces refer
!> to the axes of their row. A plane is the special case of a straight curve.
module contact_wheelrail_curved_patch
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_result, only : patch_result
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_bodies, only : find_rail_row, find_wheel_row, wheel_rail_bodies
   use contact_wheelrail_creepage, only : contact_motion, rigid_motion, velocity_of
   use contact_wheelrail_flat_patch, only : nothing_there
   use contact_wheelrail_frame, only : frame, new_frame
   use contact_wheelrail_region, only : contact_region
   implicit none (type, external)
   private

   public :: curved_reference, curved_rows, new_curved_reference, straight_reference, surface_heights
   public :: surface_motion, surface_slip, fit_creepages, curved_forces

   !> The reference curve at the rows of a grid, in track coordinates
   type :: curved_reference
      !> Position of the section along the track [mm]
      real(wp) :: x = 0.0_wp
      !> Position [mm] and inclination [rad], shape (my)
      real(wp), allocatable :: y(:), z(:), alpha(:)
   contains
      !> Axes of a row, with origin in the section
      procedure :: row_axes
   end type curved_reference

   !> Profiles in the section of a patch, and their opposite positions
   type :: facing_profiles
      type(profile_curve) :: rail, wheel
      real(wp) :: x = 0.0_wp
      !> Arc lengths of opposite points of rail and wheel at the contact reference [mm]
      real(wp) :: s_rail = 0.0_wp, s_wheel = 0.0_wp
   end type facing_profiles

   !> Rows end where the normals of the bodies differ too much: minimum length of the mean of rail's unit normal and wheel's
   !> reversed unit normal
   real(wp), parameter :: min_agreement = 0.9_wp
   !> Range of rows to examine, relative to that of a flat patch
   real(wp), parameter :: wider = 1.2_wp
   !> Additional rows on each side of the region
   integer, parameter :: guard_rows = 2

contains

   !> Axes of a row
   pure function row_axes(self, iy) result(axes)
      class(curved_reference), intent(in) :: self
      !> Index of the row, from 1
      integer, intent(in) :: iy
      type(frame) :: axes

      axes = new_frame([self%x, self%y(iy), self%z(iy)], self%alpha(iy), 0.0_wp)
   end function row_axes

   !> Choose the rows that cover a region, instead of those of the flat patch; columns and positions of rows do not change
   subroutine curved_rows(rail, bodies, region, plane, grid)
      !> The rail in track coordinates in the section of the reference
      type(profile_curve), intent(in) :: rail
      !> Sections and positions of rail and wheel
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Interpenetration to be covered by the rows
      type(contact_region), intent(in) :: region
      !> Contact reference
      type(frame), intent(in) :: plane
      !> Grid of the flat patch on entry, of the curved one on exit
      type(potential_contact), intent(inout) :: grid
      type(facing_profiles) :: facing
      real(wp) :: point(2), normal(2)
      integer :: centre, first, last, lowest, highest, iy

      facing = find_opposite_points(rail, bodies, plane)
      ! rows are numbered as in the flat patch, possibly with negative numbers
      centre = nint(0.5_wp - grid%yl/grid%dy)
      first = min(centre - 1, ceiling(centre + wider*(1 - centre)))
      last = max(centre + 1, floor(centre + wider*(grid%my - centre)))
      lowest = centre - 1
      highest = centre + 1
      do iy = first, last
         call middle(bodies, facing, grid%y(iy), point, normal)
         if (point(1) < region%box%y(1) .or. point(1) > region%box%y(2)) cycle
         if (norm2(normal) <= min_agreement) cycle
         lowest = min(lowest, iy - guard_rows)
         highest = max(highest, iy + guard_rows)
      end do
      grid%yl = grid%yl + (lowest - 1)*grid%dy
      grid%my = highest - lowest + 1
   end subroutine curved_rows

   !> The reference curve at the rows of a grid
   function new_curved_reference(rail, bodies, plane, grid) result(curve)
      !> The rail in track coordinates in the section of the reference
      type(profile_curve), intent(in) :: rail
      !> Sections and positions of rail and wheel
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Contact reference
      type(frame), intent(in) :: plane
      !> Grid with the rows
      type(potential_contact), intent(in) :: grid
      type(curved_reference) :: curve
      type(facing_profiles) :: facing
      real(wp) :: point(2), normal(2)
      integer :: iy

      facing = find_opposite_points(rail, bodies, plane)
      curve%x = plane%origin(1)
      allocate(curve%y(grid%my), curve%z(grid%my), curve%alpha(grid%my))
      do iy = 1, grid%my
         call middle(bodies, facing, grid%y(iy), point, normal)
         curve%y(iy) = point(1)
         curve%z(iy) = point(2)
         curve%alpha(iy) = atan2(normal(1), -normal(2))
      end do
   end function new_curved_reference

   !> The reference of a plane
   function straight_reference(plane, grid) result(curve)
      !> Plane with axes x and s
      type(frame), intent(in) :: plane
      !> Grid with the rows
      type(potential_contact), intent(in) :: grid
      type(curved_reference) :: curve
      integer :: iy

      curve%x = plane%origin(1)
      curve%y = plane%origin(2) + plane%axes(2, 2)*[(grid%y(iy), iy=1, grid%my)]
      curve%z = plane%origin(3) + plane%axes(3, 2)*[(grid%y(iy), iy=1, grid%my)]
      allocate(curve%alpha(grid%my), source=plane%roll())
   end function straight_reference

   !> Profiles in the section of a patch: the point of the wheel vertically above the reference is opposite to it
   function find_opposite_points(rail, bodies, plane) result(facing)
      type(profile_curve), intent(in) :: rail
      type(wheel_rail_bodies), intent(in) :: bodies
      type(frame), intent(in) :: plane
      type(facing_profiles) :: facing
      real(wp) :: seen(3)

      facing%x = plane%origin(1)
      facing%rail = rail
      facing%wheel = bodies%wheel
      facing%s_rail = rail%s_at(plane%origin(2))
      seen = bodies%placement%wheel%to_local(plane%origin)
      facing%s_wheel = bodies%wheel%s_at(seen(2))
   end function find_opposite_points

   !> Midpoint between the profiles and mean of their normals, upwards, as functions of the rail's arc length
   !>
   !> The length of the mean of two unit normals decreases with the angle between them.
   subroutine middle(bodies, facing, s, point, normal)
      type(wheel_rail_bodies), intent(in) :: bodies
      type(facing_profiles), intent(in) :: facing
      !> Arc length from the contact reference [mm]
      real(wp), intent(in) :: s
      !> Components y, z: midpoint [mm] and mean normal [-]
      real(wp), intent(out) :: point(2), normal(2)
      real(wp) :: on_rail(2), out_of_rail(2), on_wheel(2), out_of_wheel(2)

      call point_of_rail(facing, bodies%placement%roller_radius, s, on_rail, out_of_rail)
      call point_of_wheel(facing, bodies, s, on_wheel, out_of_wheel)
      point = 0.5_wp*(on_rail + on_wheel)
      normal = 0.5_wp*(out_of_rail - out_of_wheel)
   end subroutine middle

   !> Point of the rail's (roller's) section and its unit normal out of the rail; the section is extended straight beyond its ends
   subroutine point_of_rail(facing, roller_radius, s, point, normal)
      type(facing_profiles), intent(in) :: facing
      real(wp), intent(in) :: roller_radius
      !> Arc length from the contact reference [mm]
      real(wp), intent(in) :: s
      real(wp), intent(out) :: point(2), normal(2)
      real(wp) :: range(2), place, tangent(2), rho, zeta

      range = facing%rail%s_range()
      place = min(max(facing%s_rail + s, range(1)), range(2))
      point = [facing%rail%y%value(place), facing%rail%z%value(place)]
      tangent = [facing%rail%y%slope(place), facing%rail%z%slope(place)]
      if (roller_radius > 0.0_wp) then
         rho = roller_radius - point(2)
         zeta = sqrt(max(tiny(rho), rho**2 - facing%x**2))
         point(2) = roller_radius - zeta
         tangent(2) = tangent(2)*rho/zeta
      end if
      tangent = tangent/norm2(tangent)
      point = point + tangent*(facing%s_rail + s - place)
      normal = [tangent(2), -tangent(1)]
   end subroutine point_of_rail

   !> Point of the wheel in the section, opposite to a point of the rail, and the component of its unit normal in the section
   subroutine point_of_wheel(facing, bodies, s, point, normal)
      type(facing_profiles), intent(in) :: facing
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Arc length on the rail from the contact reference [mm]; that of the wheel has the opposite direction
      real(wp), intent(in) :: s
      real(wp), intent(out) :: point(2), normal(2)
      real(wp) :: range(2), reached, place, beyond, local(3), tangent(2), across(2), radius, track(3), out(3)
      integer :: step

      range = facing%wheel%s_range()
      reached = facing%s_wheel - s/length_in_section(facing, bodies, facing%s_wheel)
      reached = facing%s_wheel - s/length_in_section(facing, bodies, 0.5_wp*(facing%s_wheel + reached))
      place = min(max(reached, range(1)), range(2))
      beyond = reached - place
      tangent = [facing%wheel%y%slope(place), facing%wheel%z%slope(place)]
      tangent = tangent/norm2(tangent)
      across = facing%wheel%normal(place)
      local(1) = 0.0_wp
      local(2) = facing%wheel%y%value(place) + tangent(1)*beyond
      associate (wheel => bodies%placement%wheel, r0 => bodies%placement%wheel_radius)
         radius = r0 + facing%wheel%z%value(place) + tangent(2)*beyond
         do step = 1, 4
            ! intersection of the circle of this point with the section
            local(3) = sqrt(max(tiny(radius), radius**2 - local(1)**2)) - r0
            local(1) = (facing%x - wheel%origin(1) - wheel%axes(1, 2)*local(2) - wheel%axes(1, 3)*local(3))/wheel%axes(1, 1)
         end do
         local(3) = sqrt(max(tiny(radius), radius**2 - local(1)**2)) - r0
         track = wheel%to_parent(local)
         out = matmul(wheel%axes, [across(2)*local(1)/radius, across(1), across(2)*(local(3) + r0)/radius])
      end associate
      point = track(2:3)
      normal = out(2:3)
   end subroutine point_of_wheel

   !> Arc length of the wheel's section across the track per arc length of its profile: above 1 for a yawed wheel, whose section is
   !> oblique
   pure real(wp) function length_in_section(facing, bodies, place) result(length)
      type(facing_profiles), intent(in) :: facing
      type(wheel_rail_bodies), intent(in) :: bodies
      !> Position on the profile [mm]
      real(wp), intent(in) :: place
      real(wp) :: along(3), around(3), range(2), s

      range = facing%wheel%s_range()
      s = min(max(place, range(1)), range(2))
      along = [0.0_wp, facing%wheel%y%slope(s), facing%wheel%z%slope(s)]
      along = matmul(bodies%placement%wheel%axes, along/norm2(along))
      around = bodies%placement%wheel%axes(:, 1)
      length = norm2(along(2:) - along(1)/around(1)*around(2:))
   end function length_in_section

   !> Heights of rail and wheel above the reference surface, along the normals of its rows [mm]
   subroutine surface_heights(bodies, curve, grid, rail, wheel)
      !> Sections and positions of rail and wheel
      type(wheel_rail_bodies), intent(inout) :: bodies
      !> Positions and normals of the rows
      type(curved_reference), intent(in) :: curve
      !> Columns and rows
      type(potential_contact), intent(in) :: grid
      !> Heights, shape (mx, my); far apart where a surface is missing
      real(wp), allocatable, intent(out) :: rail(:, :), wheel(:, :)
      type(frame) :: row, seen
      real(wp) :: x(grid%mx), n(grid%mx)
      logical :: found(grid%mx), prismatic
      integer :: ix, iy

      allocate(rail(grid%mx, grid%my), wheel(grid%mx, grid%my))
      prismatic = .not. allocated(bodies%rail_strip) .and. .not. bodies%placement%roller_radius > 0.0_wp
      x = [(grid%x(ix), ix=1, grid%mx)]
      do iy = 1, grid%my
         row = curve%row_axes(iy)
         if (prismatic) then
            call find_rail_row(bodies, row, x(:1), 0.0_wp, n(:1), found(:1))
            rail(:, iy) = merge(n(1), nothing_there, found(1))
         else
            call find_rail_row(bodies, row, x, 0.0_wp, n, found)
            rail(:, iy) = merge(n, nothing_there, found)
         end if
         seen = bodies%placement%wheel%seen_from_here(row)
         call find_wheel_row(bodies, seen, x, 0.0_wp, n, found)
         wheel(:, iy) = merge(n, -nothing_there, found)
      end do
   end subroutine surface_heights

   !> Slip element by element on a reference surface: creepages that approximate it best, and the remainder
   subroutine surface_motion(rail, wheel, curve, grid, on_rail, on_wheel, inside, rail_share, forward, motion, slip)
      !> Motion of the bodies in track axes
      type(rigid_motion), intent(in) :: rail, wheel
      !> Positions and normals of the rows
      type(curved_reference), intent(in) :: curve
      !> Columns and rows
      type(potential_contact), intent(in) :: grid
      !> Heights of the surfaces [mm], shape (mx, my)
      real(wp), intent(in) :: on_rail(:, :), on_wheel(:, :)
      !> Elements that determine the creepages, shape (mx, my)
      logical, intent(in) :: inside(:, :)
      !> Fraction of the compliance due to the rail [-]
      real(wp), intent(in) :: rail_share
      !> Forward velocity, which is the rolling velocity on a track [mm/s]; 0 to keep that of the contact reference
      real(wp), intent(in) :: forward
      !> On entry the motion at the contact reference, on return that of the elements
      type(contact_motion), intent(inout) :: motion
      !> Remainder [-], shape (mx, my, 2)
      real(wp), allocatable, intent(out) :: slip(:, :, :)
      real(wp) :: before

      before = motion%veloc
      if (forward > 0.0_wp) motion%veloc = forward
      call surface_slip(rail, wheel, curve, grid, on_rail, on_wheel, rail_share, slip)
      if (.not. motion%veloc > 0.0_wp) then
         slip = 0.0_wp
         return
      end if
      slip = slip/motion%veloc
      motion%cphi = motion%cphi*before/motion%veloc
      call fit_creepages(grid, inside, slip, motion)
   end subroutine surface_motion

   !> Velocity of the rail minus that of the wheel at opposite points of the undeformed surfaces, in the axes of the rows
   !>
   !> Particles slide along the deformed surface. It lies between the undeformed surfaces, in the ratio of the compliances, and its
   !> slopes rotate x and s: the velocity normal to the reference contributes to the slip.
   subroutine surface_slip(rail, wheel, curve, grid, on_rail, on_wheel, rail_share, slip)
      !> Motion of the bodies in track axes
      type(rigid_motion), intent(in) :: rail, wheel
      !> Positions and normals of the rows
      type(curved_reference), intent(in) :: curve
      !> Columns and rows
      type(potential_contact), intent(in) :: grid
      !> Heights of the surfaces [mm], shape (mx, my)
      real(wp), intent(in) :: on_rail(:, :), on_wheel(:, :)
      !> Fraction of the compliance due to the rail [-]
      real(wp), intent(in) :: rail_share
      !> Components along x and s [mm/s], or [mm] for displacements, shape (mx, my, 2)
      real(wp), allocatable, intent(out) :: slip(:, :, :)
      type(frame) :: row
      real(wp) :: relative(3), slope(2)
      integer :: ix, iy

      allocate(slip(grid%mx, grid%my, 2))
      do iy = 1, grid%my
         row = curve%row_axes(iy)
         do ix = 1, grid%mx
            relative = velocity_of(rail, row%to_parent([grid%x(ix), 0.0_wp, on_rail(ix, iy)])) &
               & - velocity_of(wheel, row%to_parent([grid%x(ix), 0.0_wp, on_wheel(ix, iy)]))
            relative = matmul(relative, row%axes)
            slope(1) = interface_slope(on_rail(:, iy), on_wheel(:, iy), ix, grid%dx)
            slope(2) = interface_slope(on_rail(ix, :), on_wheel(ix, :), iy, grid%dy)
            slip(ix, iy, :) = (relative(:2) + slope*relative(3))/sqrt(1.0_wp + slope**2)
         end do
      end do

   contains

      !> Slope of the deformed surface along a line of elements
      pure real(wp) function interface_slope(rail, wheel, i, step) result(slope)
         !> Heights of the undeformed surfaces along the line, index of the element, distance of elements [mm]
         real(wp), intent(in) :: rail(:), wheel(:)
         integer, intent(in) :: i
         real(wp), intent(in) :: step

         slope = (1.0_wp - rail_share)*slope_of(rail, i, step) + rail_share*slope_of(wheel, i, step)
      end function interface_slope

      !> Slope of a surface along a line of elements; zero at its end
      pure real(wp) function slope_of(n, i, step) result(slope)
         real(wp), intent(in) :: n(:), step
         integer, intent(in) :: i
         integer :: low, high

         low = max(1, i - 1)
         high = min(size(n), i + 1)
         slope = 0.0_wp
         if (low == high) return
         if (max(abs(n(low)), abs(n(high))) >= nothing_there) return
         slope = (n(high) - n(low))/((high - low)*step)
      end function slope_of
   end subroutine surface_slip

   !> Creepages and spin that describe the slip in the area of interpenetration best, and the remainder
   !>
   !> Least squares of w_x - (cksi - cphi s) and w_s - (ceta + cphi x).
   subroutine fit_creepages(grid, inside, slip, motion)
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Elements in the area of interpenetration, shape (mx, my)
      logical, intent(in) :: inside(:, :)
      !> Slip relative to the rolling velocity on entry, remainder on exit [-], shape (mx, my, 2)
      real(wp), intent(inout) :: slip(:, :, :)
      !> Creepages and spin; the spin on entry is that of the contact reference, and is kept if there are too few elements
      type(contact_motion), intent(inout) :: motion
      real(wp) :: n, mean(4), moment, spread, x, s
      integer :: ix, iy

      n = count(inside)
      if (n > 0.0_wp) then
         mean = 0.0_wp
         do iy = 1, grid%my
            do ix = 1, grid%mx
               if (inside(ix, iy)) mean = mean + [grid%x(ix), grid%y(iy), slip(ix, iy, 1), slip(ix, iy, 2)]/n
            end do
         end do
         moment = 0.0_wp
         spread = 0.0_wp
         do iy = 1, grid%my
            do ix = 1, grid%mx
               if (.not. inside(ix, iy)) cycle
               x = grid%x(ix) - mean(1)
               s = grid%y(iy) - mean(2)
               moment = moment + x*(slip(ix, iy, 2) - mean(4)) - s*(slip(ix, iy, 1) - mean(3))
               spread = spread + x**2 + s**2
            end do
         end do
         if (spread > 0.0_wp) motion%cphi = moment/spread
         motion%cksi = mean(3) + motion%cphi*mean(2)
         motion%ceta = mean(4) - motion%cphi*mean(1)
      end if
      do iy = 1, grid%my
         do ix = 1, grid%mx
            slip(ix, iy, 1) = slip(ix, iy, 1) - (motion%cksi - motion%cphi*grid%y(iy))
            slip(ix, iy, 2) = slip(ix, iy, 2) - (motion%ceta + motion%cphi*grid%x(ix))
         end do
      end do
   end subroutine fit_creepages

   !> Forces and moment on the rail in the axes of the contact reference, as sums over rows with different axes
   pure subroutine curved_forces(curve, plane, contact, pressure_force, force, moment)
      !> Positions and normals of the rows
      type(curved_reference), intent(in) :: curve
      !> Contact reference and its axes
      type(frame), intent(in) :: plane
      !> Solved patch on the grid of the curve
      type(patch_result), intent(in) :: contact
      !> Forces of the pressures, and of all tractions [N]
      real(wp), intent(out) :: pressure_force(3), force(3)
      !> Moment about the contact reference [N mm]
      real(wp), intent(out) :: moment(3)
      type(frame) :: row
      real(wp) :: traction(3), one(3), place(3), area
      integer :: ix, iy

      area = contact%grid%dx*contact%grid%dy
      pressure_force = 0.0_wp
      force = 0.0_wp
      moment = 0.0_wp
      do iy = 1, contact%grid%my
         row = plane%seen_from_here(curve%row_axes(iy))
         pressure_force = pressure_force + row%axes(:, 3)*area*sum(contact%pn(:, iy))
         do ix = 1, contact%grid%mx
            if (contact%division(ix, iy) == element%exterior) cycle
            traction = [contact%px(ix, iy), contact%py(ix, iy), contact%pn(ix, iy)]
            one = area*matmul(row%axes, traction)
            place = row%to_parent([contact%grid%x(ix), 0.0_wp, 0.0_wp])
            force = force + one
            moment = moment + [place(2)*one(3) - place(3)*one(2), place(3)*one(1) - place(1)*one(3), &
               & place(1)*one(2) - place(2)*one(1)]
         end do
      end do
   end subroutine curved_forces
end module contact_wheelrail_curved_patch
