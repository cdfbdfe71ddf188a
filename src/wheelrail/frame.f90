!> Positions and orientations of bodies: origins, axes, and transformations between coordinates
!>
!> Right-handed systems with x forward, y to the right, z down. Roll, pitch and yaw are rotations about x, y and z by angles in rad,
!> with the right-hand rule.
module contact_wheelrail_frame
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: cross, frame, new_frame, roll_axes, yaw_axes

   !> A coordinate system in its parent system
   type :: frame
      !> Origin [mm] in the parent
      real(wp) :: origin(3) = 0.0_wp
      !> Unit vectors of the axes in the parent, one per column
      real(wp) :: axes(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
   contains
      !> Coordinates in the parent system of a point given in this system
      procedure :: to_parent
      !> Coordinates in this system of a point given in the parent system
      procedure :: to_local
      !> A frame given in this system, in the parent system
      procedure :: of
      !> A frame given in the parent system, in this system
      procedure :: seen_from_here
      !> Roll and yaw angle of axes that were first rolled and then yawed
      procedure :: roll
      procedure :: yaw
   end type frame

contains

   !> A frame that is first rolled and then yawed about its rolled axis
   pure function new_frame(origin, roll, yaw) result(new)
      !> Origin in the parent system [mm]
      real(wp), intent(in) :: origin(3)
      !> Roll and yaw angle [rad]
      real(wp), intent(in) :: roll, yaw
      type(frame) :: new
      real(wp) :: rolled(3, 3), yawed(3, 3)

      rolled = roll_axes(roll)
      yawed = yaw_axes(yaw)
      new%origin = origin
      new%axes = matmul(rolled, yawed)
   end function new_frame

   !> Axes that are rolled by an angle
   pure function roll_axes(angle) result(axes)
      !> Angle about x [rad]
      real(wp), intent(in) :: angle
      real(wp) :: axes(3, 3)

      axes(:, 1) = [1.0_wp, 0.0_wp, 0.0_wp]
      axes(:, 2) = [0.0_wp, cos(angle), sin(angle)]
      axes(:, 3) = [0.0_wp, -sin(angle), cos(angle)]
   end function roll_axes

   !> Axes that are yawed by an angle
   pure function yaw_axes(angle) result(axes)
      !> Angle about z [rad]
      real(wp), intent(in) :: angle
      real(wp) :: axes(3, 3)

      axes(:, 1) = [cos(angle), sin(angle), 0.0_wp]
      axes(:, 2) = [-sin(angle), cos(angle), 0.0_wp]
      axes(:, 3) = [0.0_wp, 0.0_wp, 1.0_wp]
   end function yaw_axes

   pure function to_parent(self, point) result(parent)
      class(frame), intent(in) :: self
      !> Coordinates in the axes of the frame [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: parent(3)

      parent = self%origin + matmul(self%axes, point)
   end function to_parent

   pure function to_local(self, point) result(local)
      class(frame), intent(in) :: self
      !> Coordinates in the parent system [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: local(3)

      local = matmul(point - self%origin, self%axes)
   end function to_local

   pure function of(self, inner) result(outer)
      class(frame), intent(in) :: self
      !> Frame given in this system
      type(frame), intent(in) :: inner
      type(frame) :: outer

      outer%origin = self%to_parent(inner%origin)
      outer%axes = matmul(self%axes, inner%axes)
   end function of

   pure function seen_from_here(self, other) result(inner)
      class(frame), intent(in) :: self
      !> Frame given in the parent system
      type(frame), intent(in) :: other
      type(frame) :: inner

      inner%origin = self%to_local(other%origin)
      inner%axes = matmul(transpose(self%axes), other%axes)
   end function seen_from_here

   pure real(wp) function roll(self)
      class(frame), intent(in) :: self
      roll = atan2(self%axes(3, 2), self%axes(2, 2))
   end function roll

   pure real(wp) function yaw(self)
      class(frame), intent(in) :: self
      yaw = asin(max(-1.0_wp, min(1.0_wp, -self%axes(1, 2))))
   end function yaw

   !> Vector product a x b
   pure function cross(a, b) result(c)
      !> Components in the same axes
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)

      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross
end module contact_wheelrail_frame
