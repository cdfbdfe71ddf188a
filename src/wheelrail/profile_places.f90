!> Positions of points of profiles in the track in the last case
module contact_wheelrail_profile_places
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_frame, only : frame, new_frame
   use contact_wheelrail_placement, only : gauge_point, side_sign
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_spec, only : pair_spec
   implicit none (type, external)
   private

   public :: gauge_places, places_in_track

contains

   !> Positions of points of a profile in the track, y with the sign of the wheel's side; all y, then all z [mm]
   function places_in_track(spec, result, is_wheel, y, z) result(list)
      !> For the side of the track
      class(pair_spec), intent(in) :: spec
      !> Of the last case
      type(wheel_rail_result), intent(in) :: result
      !> Profile of the wheel? Otherwise of the rail
      logical, intent(in) :: is_wheel
      !> Points on the profile [mm]
      real(wp), intent(in) :: y(:), z(:)
      real(wp) :: list(2*size(y))
      type(frame) :: body
      real(wp) :: point(3)
      integer :: i

      if (is_wheel) then
         body = new_frame([result%wheel_x, result%wheel_y, result%wheel_z], result%wheel_roll, result%wheel_yaw)
      else
         body = new_frame([0.0_wp, result%rail_y, result%rail_z], result%rail_roll, 0.0_wp)
      end if
      do i = 1, size(y)
         point = body%to_parent([0.0_wp, y(i), z(i)])
         list(i) = side_sign(spec)*point(2)
         list(size(y) + i) = point(3)
      end do
   end function places_in_track

   !> Innermost point within the gauge height, y, z; offsets of the profile in the track, y, z; point at gauge height, y, z [mm]
   function gauge_places(spec, result, curve) result(list)
      !> Gauge height, cant, and the side of the track
      class(pair_spec), intent(in) :: spec
      !> Of the last case
      type(wheel_rail_result), intent(in) :: result
      !> Profile of the rail
      type(profile_curve), intent(in) :: curve
      real(wp) :: list(6)
      type(profile_curve) :: canted
      real(wp) :: top_z, gauge_y, height, s_at_height

      height = max(spec%track%gaught, 0.0_wp)
      call gauge_point(curve, spec%track%cant, height, top_z, gauge_y)
      canted = curve%seen_from([0.0_wp, 0.0_wp], spec%track%cant)
      s_at_height = first_crossing(canted, top_z + height)
      list(1:2) = [gauge_y, height_at(canted, s_at_height, gauge_y)]
      list(3:4) = [side_sign(spec)*result%rail_y, result%rail_z]
      list(5:6) = [canted%y%value(s_at_height), canted%z%value(s_at_height)]
   end function gauge_places

   !> First arc length at which the profile is above a height (z down)
   pure real(wp) function first_crossing(curve, height) result(s)
      type(profile_curve), intent(in) :: curve
      real(wp), intent(in) :: height
      real(wp) :: low, high
      integer :: i, step

      associate (nodes => curve%z%s)
         s = nodes(1)
         do i = 2, size(nodes)
            if (curve%z%value(nodes(i)) > height) cycle
            low = nodes(i - 1)
            high = nodes(i)
            do step = 1, 60
               s = 0.5_wp*(low + high)
               if (curve%z%value(s) <= height) then
                  high = s
               else
                  low = s
               end if
            end do
            return
         end do
      end associate
   end function first_crossing

   !> Height of the point of the gauge face with a given y: intersection with the gauge height, or the nearest node
   pure real(wp) function height_at(curve, s_at_height, y) result(z)
      type(profile_curve), intent(in) :: curve
      real(wp), intent(in) :: s_at_height, y
      real(wp) :: distance, nearest
      integer :: i

      z = curve%z%value(s_at_height)
      nearest = abs(curve%y%value(s_at_height) - y)
      associate (nodes => curve%z%s)
         do i = 1, size(nodes)
            distance = abs(curve%y%value(nodes(i)) - y)
            if (nodes(i) < s_at_height .or. distance >= nearest) cycle
            nearest = distance
            z = curve%z%value(nodes(i))
         end do
      end associate
   end function height_at
end module contact_wheelrail_profile_places
