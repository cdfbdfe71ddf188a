!> Creepages of a flat contact patch between two moving bodies
!>
!> Slip is the velocity of the rail (body 1) minus that of the wheel (body 2) at the contact reference, divided by the rolling
!> velocity V; see doc/theory/wheel_rail.md. All vectors are in track axes: x along the track, y to the right, z down.
module contact_wheelrail_creepage
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_wheelrail_frame, only : cross
   implicit none (type, external)
   private

   public :: rigid_motion, contact_motion, velocity_of, flat_creepage, flat_shift

   !> Motion of a rigid body
   type :: rigid_motion
      !> A point of the body [mm] and its velocity [mm/s]
      real(wp) :: origin(3) = 0.0_wp, velocity(3) = 0.0_wp
      !> Angular velocity [rad/s]
      real(wp) :: rotation(3) = 0.0_wp
   end type rigid_motion

   !> Relative motion in a patch
   type :: contact_motion
      !> Creepages [-] and spin [rad/mm]; in a shift, displacements [mm] and rotation [rad]
      real(wp) :: cksi = 0.0_wp, ceta = 0.0_wp, cphi = 0.0_wp
      !> Rolling velocity [mm/s], 1 in a shift
      real(wp) :: veloc = 1.0_wp
      !> Rolling direction [rad]: 0 forward, pi backward
      real(wp) :: chi = 0.0_wp
   end type contact_motion

   !> Velocities below this value are regarded as standstill [mm/s]
   real(wp), parameter :: standstill = 1.0e-6_wp

contains

   !> Velocity of a point of the body [mm/s]
   pure function velocity_of(motion, point) result(v)
      !> Velocity and angular velocity of the body
      type(rigid_motion), intent(in) :: motion
      !> Point in track coordinates [mm]
      real(wp), intent(in) :: point(3)
      real(wp) :: v(3)

      v = motion%velocity + cross(motion%rotation, point - motion%origin)
   end function velocity_of

   !> Creepages in rolling
   !>
   !> V is the mean of the velocities of translation and of the wheel's circumference; on a roller it is that with which the
   !> surfaces pass through the contact, the mean of the two circumferential velocities if the wheel stays above the roller. If the
   !> wheel neither travels nor turns, V is the sliding velocity.
   pure function flat_creepage(rail, wheel, spin_axis, pitch_rate, on_rail, on_wheel, delta, roller) result(motion)
      !> Motion of rail (or roller) and wheel
      type(rigid_motion), intent(in) :: rail, wheel
      !> Unit vector of the wheelset's axle, and pitch rate about it [rad/s], which is included in the rotation of the wheel
      real(wp), intent(in) :: spin_axis(3), pitch_rate
      !> Contact reference on the two bodies [mm]
      real(wp), intent(in) :: on_rail(3), on_wheel(3)
      !> Contact angle [rad]
      real(wp), intent(in) :: delta
      !> Does the wheel run on a roller? Otherwise on a track
      logical, intent(in) :: roller
      type(contact_motion) :: motion
      real(wp) :: p(3), q(3), circumference(3), translation, carried

      p = in_contact_axes(velocity_of(rail, on_rail), delta)
      q = in_contact_axes(velocity_of(wheel, on_wheel), delta)
      circumference = in_contact_axes(cross(pitch_rate*spin_axis, on_wheel - wheel%origin), delta)
      translation = q(1) - p(1) - circumference(1)
      if (roller) then
         carried = q(1) - circumference(1)
         motion%veloc = abs(0.5_wp*(p(1) + q(1)) - velocity_on_roller(rail, wheel, p(1), carried, on_rail, on_wheel))
         if (circumference(1) > 0.0_wp) motion%chi = pi
      else
         motion%veloc = 0.5_wp*(abs(translation) + abs(circumference(1)))
         ! the larger velocity determines the direction
         if (abs(translation) >= abs(circumference(1))) then
            if (translation < 0.0_wp) motion%chi = pi
         else if (circumference(1) > 0.0_wp) then
            motion%chi = pi
         end if
      end if
      ! without rolling the surfaces slide everywhere: the limit of slow rolling, with finite creepages
      if (motion%veloc < standstill) motion%veloc = norm2(p(1:2) - q(1:2))
      if (motion%veloc < standstill) return
      motion%cksi = (p(1) - q(1))/motion%veloc
      motion%ceta = (p(2) - q(2))/motion%veloc
      motion%cphi = normal_part(rail%rotation - wheel%rotation, delta)/motion%veloc
   end function flat_creepage

   !> Longitudinal velocity of the contact on a roller, between those of the two axles [mm/s]
   pure real(wp) function velocity_on_roller(roller, wheel, surface, carried, on_roller, on_wheel) result(velocity)
      !> Motion of both bodies, with their axles as origins
      type(rigid_motion), intent(in) :: roller, wheel
      !> Longitudinal velocity of the roller's surface, and of the wheel without its rotation about the axle [mm/s]
      real(wp), intent(in) :: surface, carried
      !> Contact reference on the two bodies [mm]
      real(wp), intent(in) :: on_roller(3), on_wheel(3)
      real(wp) :: radius(2), axle

      radius = [norm2(on_roller([1, 3]) - roller%origin([1, 3])), norm2(on_wheel([1, 3]) - wheel%origin([1, 3]))]
      ! without the rotation about the axle
      axle = surface - roller%rotation(2)*(on_roller(3) - roller%origin(3))
      velocity = axle + (carried - axle)*radius(1)/sum(radius)
   end function velocity_on_roller

   !> Shift of one step, from displacements and rotations
   pure function flat_shift(rail, wheel, on_rail, on_wheel, delta) result(motion)
      !> Displacements [mm] and rotations [rad]
      type(rigid_motion), intent(in) :: rail, wheel
      !> Contact reference on the two bodies [mm]
      real(wp), intent(in) :: on_rail(3), on_wheel(3)
      !> Contact angle [rad]
      real(wp), intent(in) :: delta
      type(contact_motion) :: motion
      real(wp) :: slip(3)

      slip = in_contact_axes(velocity_of(rail, on_rail) - velocity_of(wheel, on_wheel), delta)
      motion%cksi = slip(1)
      motion%ceta = slip(2)
      motion%cphi = normal_part(rail%rotation - wheel%rotation, delta)
   end function flat_shift

   !> Components along x, s, n of a plane that is rolled by delta
   pure function in_contact_axes(v, delta) result(c)
      real(wp), intent(in) :: v(3)
      real(wp), intent(in) :: delta
      real(wp) :: c(3)

      c = [v(1), cos(delta)*v(2) + sin(delta)*v(3), cos(delta)*v(3) - sin(delta)*v(2)]
   end function in_contact_axes

   pure real(wp) function normal_part(v, delta)
      real(wp), intent(in) :: v(3), delta
      normal_part = cos(delta)*v(3) - sin(delta)*v(2)
   end function normal_part
end module contact_wheelrail_creepage
