!> Results of wheel and rail in the coordinates of the bodies: frames, forces, centre of pressure
!>
!> All results refer to a pair on the right side of the track, as everywhere below input and output.
module contact_wheelrail_body_frames
   use contact_base_kinds, only : wp
   use contact_wheelrail_frame, only : cross, frame, new_frame, roll_axes
   use contact_wheelrail_result, only : wheel_rail_patch, wheel_rail_result
   use contact_wheelrail_spec, only : pair_spec
   implicit none (type, external)
   private

   public :: body_frames, forces_in_bodies, frames_of, pressure_centre

   !> Frames of rail, wheelset and wheel in track coordinates
   type :: body_frames
      type(frame) :: rail, wheelset, wheel
      !> Wheel in wheelset coordinates
      type(frame) :: wheel_in_set
   end type body_frames

   !> Lower bound of the sum of pressures in the denominator of the centre of pressure [N/mm2]
   real(wp), parameter :: min_pressure = 1.0e-10_wp

contains

   !> Frames of the last solution
   pure function frames_of(pair, result) result(frames)
      !> For the position of the wheelset and its side of the track
      class(pair_spec), intent(in) :: pair
      !> For the markers
      type(wheel_rail_result), intent(in) :: result
      type(body_frames) :: frames
      real(wp) :: s

      s = merge(-1.0_wp, 1.0_wp, pair%left)
      associate (w => pair%wheelset)
         frames%rail = new_frame([0.0_wp, result%rail_y, result%rail_z], result%rail_roll, 0.0_wp)
         frames%wheelset = new_frame([w%x, s*w%y, result%z_ws - w%nomradw], s*w%roll, s*w%yaw)
         frames%wheel = new_frame([result%wheel_x, result%wheel_y, result%wheel_z], result%wheel_roll, result%wheel_yaw)
         frames%wheel_in_set = frames%wheelset%seen_from_here(frames%wheel)
      end associate
   end function frames_of

   !> x and y in the track of the centre of pressure; each row of a curved patch has its own position
   pure function pressure_centre(patch) result(centre)
      !> Patch with pressures
      type(wheel_rail_patch), intent(in) :: patch
      !> Centre of pressure [mm]
      real(wp) :: centre(2)
      real(wp) :: weight, x, y, row_y
      integer :: ix, iy

      weight = min_pressure
      x = 0.0_wp
      y = 0.0_wp
      associate (grid => patch%contact%grid, pn => patch%contact%pn)
         do iy = 1, grid%my
            row_y = grid%y(iy)*cos(patch%delta)
            if (allocated(patch%curve)) row_y = patch%curve(1, iy) - patch%y
            do ix = 1, grid%mx
               weight = weight + pn(ix, iy)
               x = x + pn(ix, iy)*grid%x(ix)
               y = y + pn(ix, iy)*row_y
            end do
         end do
      end associate
      centre = [patch%x + x/weight, patch%y + y/weight]
   end function pressure_centre

   !> Force on the rail and its moment, about the rail marker in track and rail axes, about the wheel marker in wheelset and wheel
   !> axes; including damping
   pure function forces_in_bodies(patch, frames) result(list)
      !> Patch with force and moment
      type(wheel_rail_patch), intent(in) :: patch
      !> See frames_of
      type(body_frames), intent(in) :: frames
      !> Four times force [N] and moment [N mm]: rail marker in track and rail axes, wheel marker in wheelset and wheel axes
      real(wp) :: list(24)
      real(wp) :: axes(3, 3), force(3), moment(3), about_rail(3), about_wheel(3)

      axes = roll_axes(patch%delta)
      force = patch%force
      if (allocated(patch%contact%damping)) force = force + patch%contact%damping([2, 3, 1])
      force = matmul(axes, force)
      moment = matmul(axes, patch%moment)
      about_rail = moment + cross([patch%x, patch%y, patch%z] - frames%rail%origin, force)
      about_wheel = moment + cross([patch%x, patch%y, patch%z] - frames%wheel%origin, force)
      list(1:6) = [force, about_rail]
      list(7:12) = [matmul(force, frames%wheelset%axes), matmul(about_wheel, frames%wheelset%axes)]
      list(13:18) = [matmul(force, frames%rail%axes), matmul(about_rail, frames%rail%axes)]
      list(19:24) = [matmul(force, frames%wheel%axes), matmul(about_wheel, frames%wheel%axes)]
   end function forces_in_bodies
end module contact_wheelrail_body_frames
