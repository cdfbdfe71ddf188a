!> Small displacements of the wheelset, one for each coordinate of its position
!>
!> Right-hand pair: lateral position, height, roll and yaw about the centre of the wheelset, which is rolled first and then yawed.
module contact_wheelrail_displacements
   use contact_base_kinds, only : wp
   use contact_wheelrail_frame, only : cross, frame, roll_axes, yaw_axes
   use contact_wheelrail_placement, only : wheel_rail_placement
   implicit none (type, external)
   private

   public :: coordinate, displaced, displacement_at, jacobian_input, turn_of

   type :: coordinate_list
      !> Lateral position and height [mm], roll and yaw [rad]
      integer :: y = 1, z = 2, roll = 3, yaw = 4
      !> Number of coordinates
      integer :: count = 4
   end type coordinate_list
   !> Coordinates of the wheelset
   type(coordinate_list), parameter :: coordinate = coordinate_list()

   type :: input_list
      !> Position of the wheelset [mm], [rad]; the numbers of `coordinate`
      integer :: y = coordinate%y, z = coordinate%z, roll = coordinate%roll, yaw = coordinate%yaw
      !> Velocities [mm/s], [rad/s]; on a roller `vs` is its pitch rate [rad/s]
      integer :: vs = 5, vy = 6, vroll = 7, vyaw = 8, vpitch = 9
      !> Vertical force [N]
      integer :: fz = 10
      !> Number of inputs
      integer :: count = 10
   end type input_list
   !> Columns of the matrix of derivatives
   type(input_list), parameter :: jacobian_input = input_list()

contains

   !> Placement after a displacement
   pure function displaced(placement, number, step) result(after)
      !> Present placement
      type(wheel_rail_placement), intent(in) :: placement
      !> Member of coordinate; no displacement for any other number
      integer, intent(in) :: number
      !> Displacement [mm] or [rad]
      real(wp), intent(in) :: step
      type(wheel_rail_placement) :: after
      type(frame) :: inner

      after = placement
      inner = placement%wheelset%seen_from_here(placement%wheel)
      associate (set => after%wheelset)
         if (number == coordinate%y) then
            set%origin(2) = set%origin(2) + step
         else if (number == coordinate%z) then
            set%origin(3) = set%origin(3) + step
         else if (number == coordinate%roll) then
            set%axes = matmul(roll_axes(step), set%axes)
         else if (number == coordinate%yaw) then
            set%axes = matmul(set%axes, yaw_axes(step))
         end if
         after%wheel = set%of(inner)
      end associate
   end function displaced

   !> Rotation vector of the wheelset per unit of a displacement, in track axes [rad]
   pure function turn_of(placement, number) result(turn)
      !> Present placement
      type(wheel_rail_placement), intent(in) :: placement
      !> Member of coordinate
      integer, intent(in) :: number
      real(wp) :: turn(3)

      turn = 0.0_wp
      if (number == coordinate%roll) turn(1) = 1.0_wp
      if (number == coordinate%yaw) turn = placement%wheelset%axes(:, 3)
   end function turn_of

   !> Displacement of a point of the wheel per unit [mm]
   pure function displacement_at(placement, number, point) result(v)
      !> Present placement
      type(wheel_rail_placement), intent(in) :: placement
      !> Member of coordinate
      integer, intent(in) :: number
      !> Point in track coordinates [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: v(3)

      v = cross(turn_of(placement, number), point - placement%wheelset%origin)
      if (number == coordinate%y) v(2) = v(2) + 1.0_wp
      if (number == coordinate%z) v(3) = v(3) + 1.0_wp
   end function displacement_at
end module contact_wheelrail_displacements
