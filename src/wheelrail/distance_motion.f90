!> Derivatives of the undeformed distance in the elements of a flat patch with respect to the position of the wheelset
!>
!> The height of a surface above a point of the plane changes with the motions of the body and of the plane along the normal of the
!> surface: for a body displaced by v and a plane displaced by u, the height along the normal k of the plane changes by (v -
!> u).n/(k.n), with n the normal of the surface. This is the exact derivative of the distance, without differences.
module contact_wheelrail_distance_motion
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_displacements, only : coordinate, displacement_at
   use contact_wheelrail_flat_patch, only : distance_scratch, nothing_there, start_places
   use contact_wheelrail_frame, only : cross, frame
   use contact_wheelrail_geometry, only : wheel_rail_geometry
   use contact_wheelrail_memory, only : patch_slot
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_reference_motion, only : reference_motion
   use contact_wheelrail_wheel_surface, only : wheel_height
   implicit none (type, external)
   private

   public :: differentiate_distance

contains

   !> Derivatives of the distance in the elements that are in contact, and of the approach
   subroutine differentiate_distance(problem, geometry, slot, motions, distance, approach, heights)
      !> Profiles
      type(wheel_rail_problem), intent(in) :: problem
      !> Position of the bodies
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Solved patch
      type(patch_slot), intent(in) :: slot
      !> Motions of the reference of the patch, one per coordinate
      type(reference_motion), intent(in) :: motions(:)
      !> Change of the undeformed distance [mm per unit], shape (mx, my, coordinates), 0 outside contact
      real(wp), contiguous, intent(inout) :: distance(:, :, :)
      !> Change of the approach [mm per unit]
      real(wp), intent(out) :: approach(:)
      !> Changes of the heights of rail and wheel over the plane [mm per unit], shape (mx, my, 2, coordinates), in contact, where
      !> the bodies overlap, and two elements around, 0 elsewhere; if allocated
      real(wp), allocatable, intent(inout) :: heights(:, :, :, :)
      type(profile_curve) :: section
      type(frame) :: seen
      type(distance_scratch) :: scratch
      real(wp) :: x, s, rail, start(2), point(3), normal(3), lift, wheel_rise(4), rail_rise
      integer :: ix, iy, k, lowest(2)
      logical :: needed(slot%problem%grid%mx, slot%problem%grid%my), found, rolls

      distance = 0.0_wp
      if (allocated(heights)) heights = 0.0_wp
      associate (placement => geometry%placement, plane => slot%plane, grid => slot%problem%grid, h => slot%problem%h, &
         & track_rail => geometry%rail_in_track)
         rolls = placement%roller_radius > 0.0_wp
         lift = 0.0_wp
         if (rolls) lift = plane%origin(3) - track_rail%height(plane%origin(2))
         call start_places(track_rail, slot%region, scratch)
         section = track_rail%seen_from(plane%origin(2:3) - [0.0_wp, lift], plane%roll(), &
            & around=scratch%places(:scratch%n))
         seen = placement%wheel%seen_from_here(plane)
         lowest = minloc(h)
         needed = slot%result%pn > 0.0_wp
         needed(lowest(1), lowest(2)) = .true.
         ! the slip ahead of the leading elements counts, and slopes are differences of heights
         if (allocated(heights)) needed = around(around(needed .or. slot%on_rail < slot%on_wheel)) &
            & .and. min(-slot%on_rail, slot%on_wheel) > -nothing_there
         do iy = 1, grid%my
            if (.not. any(needed(:, iy))) cycle
            s = grid%y(iy)
            start = [problem%wheel%s_at(seen%origin(2) + seen%axes(2, 2)*s), 0.0_wp]
            do ix = 1, grid%mx
               if (.not. needed(ix, iy)) cycle
               x = grid%x(ix)
               call wheel_height(problem%wheel, placement%wheel_radius, seen, x, s, start(1), start(2), found)
               if (.not. found) cycle
               call wheel_normal(problem%wheel, placement%wheel_radius, seen%to_parent([x, s, start(2)]), start(1), normal)
               normal = matmul(placement%wheel%axes, normal)
               point = plane%to_parent([x, s, start(2)])
               do k = 1, coordinate%count
                  wheel_rise(k) = rising(point, normal, displacement_at(placement, k, point), motions(k))
               end do
               ! the distance is the height of the rail's surface minus that of the wheel's
               rail = start(2) + h(ix, iy) - slot%problem%pen
               if (allocated(heights)) rail = slot%on_rail(ix, iy)
               point = plane%to_parent([x, s, rail])
               if (rolls) then
                  normal = roller_normal(track_rail, placement%roller_radius, point)
               else
                  normal = matmul(plane%axes, section_normal(s))
               end if
               do k = 1, coordinate%count
                  rail_rise = rising(point, normal, [0.0_wp, 0.0_wp, 0.0_wp], motions(k))
                  distance(ix, iy, k) = rail_rise - wheel_rise(k)
                  if (allocated(heights)) heights(ix, iy, :, k) = [rail_rise, wheel_rise(k)]
               end do
            end do
         end do
         ! the approach is the maximum overlap
         approach = -distance(lowest(1), lowest(2), :)
      end associate

   contains

      !> Derivative of the height of a surface over the plane
      pure real(wp) function rising(point, normal, v, motion)
         !> Point of the surface in the track [mm], its normal, and its displacement [mm per unit]
         real(wp), intent(in) :: point(3), normal(3), v(3)
         type(reference_motion), intent(in) :: motion
         real(wp) :: u(3)

         u = motion%origin + cross([motion%angle, 0.0_wp, 0.0_wp], point - slot%plane%origin)
         rising = dot_product(v - u, normal)/dot_product(slot%plane%axes(:, 3), normal)
      end function rising

      !> Normal of a prismatic rail in the axes of the plane
      function section_normal(s) result(normal)
         real(wp), intent(in) :: s
         real(wp) :: normal(3)
         real(wp) :: place

         place = section%s_at(s)
         normal = [0.0_wp, -section%z%slope(place), section%y%slope(place)]
      end function section_normal
   end subroutine differentiate_distance

   !> Elements of a set, and those beside them
   pure function around(set) result(wider)
      !> Shape (mx, my)
      logical, intent(in) :: set(:, :)
      logical :: wider(size(set, 1), size(set, 2))
      integer :: mx, my

      mx = size(set, 1)
      my = size(set, 2)
      wider = set
      wider(2:, :) = wider(2:, :) .or. set(:mx - 1, :)
      wider(:mx - 1, :) = wider(:mx - 1, :) .or. set(2:, :)
      wider(:, 2:) = wider(:, 2:) .or. set(:, :my - 1)
      wider(:, :my - 1) = wider(:, :my - 1) .or. set(:, 2:)
   end function around

   !> Normal of the wheel's surface in its own axes, not of unit length
   pure subroutine wheel_normal(wheel, radius, point, place, normal)
      type(profile_curve), intent(in) :: wheel
      !> Radius at the origin of the profile [mm]
      real(wp), intent(in) :: radius
      !> Point of the surface in the wheel's axes [mm], and its arc length on the profile [mm]
      real(wp), intent(in) :: point(3), place
      real(wp), intent(out) :: normal(3)
      real(wp) :: y, z, y_s, z_s, r

      call wheel%point(place, y, z, y_s, z_s)
      r = radius + z
      normal = [point(1)*y_s, -r*z_s, sqrt(r**2 - point(1)**2)*y_s]
   end subroutine wheel_normal

   !> Normal of a roller's surface in the track, not of unit length
   function roller_normal(rail, radius, point) result(normal)
      !> Profile of the roller in the track
      type(profile_curve), intent(in) :: rail
      !> Nominal radius [mm]
      real(wp), intent(in) :: radius
      !> Point of the surface [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: normal(3)
      real(wp) :: y, z, y_s, z_s, rho

      call rail%point(rail%s_at(point(2)), y, z, y_s, z_s)
      rho = radius - z
      normal = [-point(1)*y_s, -rho*z_s, sqrt(rho**2 - point(1)**2)*y_s]
   end function roller_normal
end module contact_wheelrail_distance_motion
