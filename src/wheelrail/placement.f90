!> Positions and motions of rail and wheel in the track
!>
!> All quantities refer to a right-hand pair: for the left side of the track, lateral positions, roll and yaw and their rates change
!> sign on input.
module contact_wheelrail_placement
   use contact_base_kinds, only : wp
   use contact_profile_curve, only : profile_curve
   use contact_wheelrail_creepage, only : rigid_motion
   use contact_wheelrail_frame, only : frame, new_frame
   use contact_wheelrail_spec, only : pair_spec
   implicit none (type, external)
   private

   public :: wheel_rail_placement, forward_velocity, gauge_point, place_wheel_rail, rail_motion, wheel_motion, side_sign

   !> Frames in track coordinates
   type :: wheel_rail_placement
      !> Rail (or roller profile), wheelset and wheel
      type(frame) :: rail, wheelset, wheel
      !> Nominal radius of the wheel at the origin of its profile [mm]
      real(wp) :: wheel_radius = 460.0_wp
      !> Nominal radius of the roller [mm]; 0 on a track
      real(wp) :: roller_radius = 0.0_wp
   contains
      !> Vertical distance of a roller's surface below its top; 0 on a track
      procedure :: roller_drop
      !> Least height above the axle of a roller that is used
      procedure :: lowest_on_roller
   end type wheel_rail_placement

   !> This height relative to the radius: points beside the roller would have none
   real(wp), parameter :: lowest_part = 0.01_wp

contains

   !> Vertical distance of a roller's surface below its top at a longitudinal position [mm]; 0 on a track
   pure real(wp) function roller_drop(self, x, z) result(drop)
      class(wheel_rail_placement), intent(in) :: self
      !> Longitudinal position, and height of its profile there [mm]
      real(wp), intent(in) :: x, z
      real(wp) :: rho

      drop = 0.0_wp
      if (.not. self%roller_radius > 0.0_wp) return
      rho = self%roller_radius - z
      ! without cancellation, which would leave 1e-7 mm of a radius of 1e9 mm
      if (rho > 0.0_wp) drop = min(x**2, rho**2)/(rho + sqrt(max(0.0_wp, rho**2 - x**2)))
   end function roller_drop

   !> Least height above the axle of a roller that is used [mm]; 0 on a track
   pure real(wp) function lowest_on_roller(self) result(lowest)
      class(wheel_rail_placement), intent(in) :: self

      lowest = lowest_part*self%roller_radius
   end function lowest_on_roller

   !> -1 for the left side of the track, 1 for the right one
   pure real(wp) function side_sign(wheel_rail)
      !> Its side of the track counts
      class(pair_spec), intent(in) :: wheel_rail
      side_sign = merge(-1.0_wp, 1.0_wp, wheel_rail%left)
   end function side_sign

   !> Forward velocity of the wheelset, which is the rolling velocity on a track [mm/s]; 0 on a roller
   pure real(wp) function forward_velocity(wheel_rail)
      !> Its velocity counts
      class(pair_spec), intent(in) :: wheel_rail
      forward_velocity = merge(0.0_wp, abs(wheel_rail%wheelset%vs), wheel_rail%roller)
   end function forward_velocity

   !> Top of the canted rail and its gauge point
   !>
   !> The gauge face begins where the profile, followed from its gauge-side end, is less than the gauge height below the top; the
   !> gauge point is the innermost point above that height.
   subroutine gauge_point(rail, cant, height, top_z, gauge_y)
      !> Profile in the rail's own coordinates
      type(profile_curve), intent(in) :: rail
      !> Cant [rad] and gauge height [mm]
      real(wp), intent(in) :: cant, height
      !> z of the top and y of the gauge point [mm], in axes parallel to the track with origin at the profile's origin
      real(wp), intent(out) :: top_z, gauge_y
      type(profile_curve) :: canted
      real(wp) :: s_top, s, low, high, y
      integer :: i, first

      canted = rail%seen_from([0.0_wp, 0.0_wp], cant)
      call canted%top(s_top, top_z)
      associate (nodes => canted%z%s)
         first = size(nodes)
         do i = 1, size(nodes)
            if (canted%z%value(nodes(i)) - top_z <= height .or. nodes(i) >= s_top) then
               first = i
               exit
            end if
         end do
         s = nodes(first)
         if (first > 1) then
            ! find the intersection with the gauge line by bisection: z is monotone between two points
            low = nodes(first - 1)
            high = nodes(first)
            do while (high - low > 4.0_wp*spacing(max(abs(low), abs(high))))
               s = 0.5_wp*(low + high)
               if (s <= low .or. s >= high) exit
               if (canted%z%value(s) - top_z <= height) then
                  high = s
               else
                  low = s
               end if
            end do
            s = high
         end if
         gauge_y = canted%y%value(s)
         do i = first, size(nodes)
            if (nodes(i) > s_top) exit
            y = innermost(canted, nodes(i), s)
            gauge_y = min(gauge_y, y)
         end do
      end associate
   end subroutine gauge_point

   !> Minimum y near a point of the profile, from a given position on
   pure real(wp) function innermost(curve, s, start) result(y)
      type(profile_curve), intent(in) :: curve
      real(wp), intent(in) :: s, start
      real(wp) :: place, slope
      integer :: step

      place = max(s, start)
      do step = 1, 20
         slope = curve%y%bend(place)
         if (.not. slope > 0.0_wp) exit
         place = place - curve%y%slope(place)/slope
         if (abs(place - s) > 1.0_wp .or. place < start) exit
      end do
      y = curve%y%value(max(s, start))
      if (abs(place - s) <= 1.0_wp .and. place >= start) y = min(y, curve%y%value(place))
   end function innermost

   !> Frames of wheel and rail for a given height of the wheelset
   subroutine place_wheel_rail(wheel_rail, wheel, top_z, gauge_y, z_ws, deflection, placement)
      !> Track, deviations of the rail, and position of the wheelset, as they were given for the side of the track
      class(pair_spec), intent(in) :: wheel_rail
      !> Profile of the wheel in its own coordinates; its radius is measured there
      type(profile_curve), intent(in) :: wheel
      !> Results of gauge_point; not used with absolute placement
      real(wp), intent(in) :: top_z, gauge_y
      !> Height of the wheelset [mm], z down
      real(wp), intent(in) :: z_ws
      !> Lateral and vertical deflection of a massless rail [mm], for a right-hand pair
      real(wp), intent(in) :: deflection(2)
      !> Frames of rail, wheelset and wheel in track coordinates, for a right-hand pair
      type(wheel_rail_placement), intent(out) :: placement
      type(frame) :: wheel_in_set
      real(wp) :: s, y, z, tape

      s = side_sign(wheel_rail)
      associate (track => wheel_rail%track, deviation => wheel_rail%rail, w => wheel_rail%wheelset)
         if (track%gaught > 0.0_wp) then
            y = 0.5_wp*track%gaugwd - gauge_y + s*deviation%dy
            z = deviation%dz
            if (.not. wheel_rail%roller) z = z - top_z
         else
            y = s*(track%raily0 + deviation%dy)
            z = track%railz0 + deviation%dz
         end if
         placement%rail = new_frame([0.0_wp, y + deflection(1), z + deflection(2)], -track%cant + s*deviation%roll, 0.0_wp)
         if (wheel_rail%roller) placement%roller_radius = track%nomradr

         placement%wheelset = new_frame([w%x, s*w%y, z_ws - w%nomradw], s*w%roll, s*w%yaw)
         tape = 0.0_wp
         if (w%has_tape()) tape = wheel%height(w%ytape)
         wheel_in_set = new_frame([w%flexible(1), 0.5_wp*w%fbdist - w%fbpos + s*w%flexible(2), &
            & w%nomradw - tape + w%flexible(3)], s*w%flexible(4), s*w%flexible(5))
         placement%wheel = placement%wheelset%of(wheel_in_set)
         placement%wheel_radius = w%nomradw - tape
      end associate
   end subroutine place_wheel_rail

   !> Motion of the rail, or of the roller about its axle; the roll rate is about the origin of the rail profile, as the roll is
   pure function rail_motion(wheel_rail, placement) result(motion)
      !> Velocities of rail and roller, as they were given
      class(pair_spec), intent(in) :: wheel_rail
      !> Where the bodies are
      type(wheel_rail_placement), intent(in) :: placement
      type(rigid_motion) :: motion
      real(wp) :: s, yaw_rate

      s = side_sign(wheel_rail)
      associate (rail => wheel_rail%rail)
         if (wheel_rail%roller) then
            yaw_rate = -s*placement%roller_radius*wheel_rail%wheelset%rpitch*wheel_rail%track%curvature
            motion%origin = [0.0_wp, placement%rail%origin(2), placement%roller_radius]
            motion%rotation = [s*rail%vroll, wheel_rail%wheelset%rpitch, yaw_rate]
            ! yaw about the centre of the track; roll from the origin of the profile to the axle
            motion%velocity = [-yaw_rate*placement%rail%origin(2), &
               & s*rail%vy - s*rail%vroll*(placement%roller_radius - placement%rail%origin(3)), rail%vz]
         else
            yaw_rate = -s*wheel_rail%wheelset%vs*wheel_rail%track%curvature
            motion%origin = placement%rail%origin
            motion%rotation = [s*rail%vroll, 0.0_wp, yaw_rate]
            motion%velocity = [-yaw_rate*placement%rail%origin(2), s*rail%vy, rail%vz]
         end if
      end associate
   end function rail_motion

   !> Motion of the wheel: that of the wheelset plus the rates of its flexible deviations, about the origin of the wheel profile
   pure function wheel_motion(wheel_rail, placement, pitch_rate) result(motion)
      !> Velocities of wheelset and wheel, as they were given
      class(pair_spec), intent(in) :: wheel_rail
      !> Where the bodies are
      type(wheel_rail_placement), intent(in) :: placement
      !> Pitch rate of the wheelset [rad/s]
      real(wp), intent(in) :: pitch_rate
      type(rigid_motion) :: motion
      real(wp) :: s, lever(3), flexible(3)

      s = side_sign(wheel_rail)
      associate (w => wheel_rail%wheelset, axes => placement%wheelset%axes)
         motion%origin = placement%wheelset%origin
         motion%rotation = matmul(axes, [s*w%vroll, pitch_rate, s*w%vyaw])
         motion%velocity = [merge(0.0_wp, w%vs, wheel_rail%roller), s*w%vy, w%vz]
         if (.not. any(abs(w%flexible_rate) > 0.0_wp)) return
         ! flexible deviations and their rates refer to the origin of the wheel profile
         lever = placement%wheel%origin - placement%wheelset%origin
         flexible = matmul(axes, [s*w%flexible_rate(4), w%flexible_rate(6), s*w%flexible_rate(5)])
         motion%rotation = motion%rotation + flexible
         motion%velocity = motion%velocity + matmul(axes, [w%flexible_rate(1), s*w%flexible_rate(2), w%flexible_rate(3)]) &
            & - [flexible(2)*lever(3) - flexible(3)*lever(2), flexible(3)*lever(1) - flexible(1)*lever(3), &
            & flexible(1)*lever(2) - flexible(2)*lever(1)]
      end associate
   end function wheel_motion
end module contact_wheelrail_placement
