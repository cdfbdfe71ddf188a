!> Results of wheel and rail for callers (module 1)
!>
!> Internally, the wheel is on the right side of the track; for a wheel on the left side lateral components are mirrored on output.
module contact_capi_wheel_rail_results
   use, intrinsic :: iso_c_binding, only : c_double
   use contact_base_kinds, only : wp
   use contact_capi_caller, only : caller
   use contact_capi_problem, only : library_problem
   use contact_control_units, only : orientation, outward, quantity, quantity_type
   use contact_wheelrail_body_frames, only : forces_in_bodies, pressure_centre
   implicit none (type, external)
   private

   public :: get_forces, get_location, get_wheelset_position, get_wheelset_velocity

contains

   !> Get the position of the wheelset, with the computed height
   subroutine get_wheelset_position(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem

      associate (w => problem%stored%wheelset, length => outward(problem%units, quantity%length), &
         & angle => outward(problem%units, quantity%angle))
         call a%set_result(1, [(w%s + w%x)*length, w%y*length, w%z*length, w%roll*angle, w%yaw*angle, w%pitch*angle])
      end associate
   end subroutine get_wheelset_position

   !> Get the velocity of the wheelset, with the computed pitch rate
   subroutine get_wheelset_velocity(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem

      associate (w => problem%stored%wheelset, velocity => outward(problem%units, quantity%velocity), &
         & angle => outward(problem%units, quantity%angle))
         call a%set_result(1, [w%vs*velocity, w%vy*velocity, w%vz*velocity, w%vroll*angle, w%vyaw*angle, w%vpitch*angle])
      end associate
   end subroutine get_wheelset_velocity

   !> Get the position of a patch in track, rail, wheel and wheelset coordinates, and the positions of these
   subroutine get_location(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem
      real(wp) :: list(38)
      type(quantity_type) :: unit(38)
      integer :: sign(38)
      real(c_double), pointer :: buffer(:)

      call locate(problem, a%call_of%icp, list)
      unit = quantity%length
      unit([4, 9, 14, 24, 25, 28, 33, 37, 38]) = quantity%angle
      sign = orientation%none
      sign([2, 4, 6, 9, 11, 14, 16, 22, 24, 25, 26, 28, 31, 33, 35, 37, 38]) = orientation%side
      list = list*outward(problem%units, unit, sign, problem%bodies%left)
      ! the 29th value is not used, and is left unchanged
      buffer => a%numbers_at(1)
      if (size(buffer) >= 29) list(29) = buffer(29)
      call a%set_result(1, list)
   end subroutine get_location

   !> The values in internal units, for a wheel on the right side of the track
   subroutine locate(problem, number, list)
      type(library_problem), intent(in) :: problem
      integer, intent(in) :: number
      real(wp), intent(out) :: list(38)
      real(wp) :: centre(2), in_set(3)

      list = 0.0_wp
      associate (result => problem%wheel_rail_result, patch => problem%wheel_rail_result%patches(number), &
         & frames => problem%bodies%frames)
         list(1:4) = [patch%x, patch%y, patch%z, patch%delta]
         list(5:9) = [patch%x, patch%y_rail, patch%z_rail, problem%bodies%along(1, number), patch%delta_rail]
         list(10:14) = [patch%x_wheel, patch%y_wheel, patch%z_wheel, problem%bodies%along(2, number), &
            & patch%delta - result%wheel_roll]
         centre = pressure_centre(patch)
         list(15:16) = centre
         list(18:19) = [result%dy_defl, result%dz_defl]
         list(21:25) = [result%wheel_x, result%wheel_y, result%wheel_z, result%wheel_roll, result%wheel_yaw]
         list(26:28) = [result%rail_y, result%rail_z, result%rail_roll]
         in_set = frames%wheelset%to_local([patch%x, patch%y, patch%z])
         list(30:32) = in_set
         list(33) = patch%delta - frames%wheelset%roll()
         list(34:36) = frames%wheel_in_set%origin
         list(37:38) = [frames%wheel_in_set%roll(), frames%wheel_in_set%yaw()]
      end associate
   end subroutine locate

   !> Get forces and moments of one patch, or of all of them (-1), in four coordinate systems
   subroutine get_forces(a, problem)
      type(caller), intent(in) :: a
      type(library_problem), intent(in) :: problem
      real(wp) :: list(24)
      type(quantity_type) :: unit(6)
      integer, parameter :: sign(6) = [orientation%along, orientation%across, orientation%along, orientation%across, &
         & orientation%along, orientation%across]
      integer :: k, first, last

      first = 1
      last = size(problem%wheel_rail_result%patches)
      if (a%call_of%icp > 0) then
         first = a%call_of%icp
         last = a%call_of%icp
      end if
      list = 0.0_wp
      do k = first, last
         list = list + forces_in_bodies(problem%wheel_rail_result%patches(k), problem%bodies%frames)
      end do
      unit = [quantity%force, quantity%force, quantity%force, quantity%moment, quantity%moment, quantity%moment]
      do k = 0, 18, 6
         list(k + 1:k + 6) = list(k + 1:k + 6)*outward(problem%units, unit, sign, problem%bodies%left)
      end do
      call a%set_result(1, list, fills=.true.)
   end subroutine get_forces
end module contact_capi_wheel_rail_results
