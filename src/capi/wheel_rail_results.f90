!> Entries that hand out results of wheel on rail (module 1)
!>
!> Inside, everything is that of a right-hand pair; for a wheel on the left side of the track lateral
!> components are mirrored on the way out.
module contact_capi_wheel_rail_results
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_capi_arguments, only : give, give_list, give_zeros, integer_of
   use contact_capi_library, only : entry_type
   use contact_capi_problem, only : library_problem
   use contact_capi_registry, only : enter, leave, scope
   use contact_control_units, only : orientation, outward, quantity, quantity_type
   use contact_wheelrail_body_frames, only : body_frames, forces_in_bodies, frames_of, pressure_centre
   implicit none (type, external)
   private

   public :: cntc_getwheelsetposition, cntc_getwheelsetvelocity, cntc_getnumcontactpatches, cntc_getcontactlocation
   public :: cntc_getglobalforces

contains

   !> Position of the wheelset, with the height that was found
   subroutine cntc_getwheelsetposition(ire, lenarr, rvalues) bind(c, name="inside_cntc_getwheelsetposition")
      integer(c_int), intent(in), optional :: ire, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem

      call enter(entry_type("cntc_getWheelsetPosition", integer_of(ire)), scope%wheel_rail, problem)
      if (.not. associated(problem)) return
      associate (w => problem%stored%wheelset, length => outward(problem%units, quantity%length), &
         & angle => outward(problem%units, quantity%angle))
         call give_list([(w%s + w%x)*length, w%y*length, w%z*length, w%roll*angle, w%yaw*angle, w%pitch*angle], lenarr, rvalues)
      end associate
      call leave(problem)
   end subroutine cntc_getwheelsetposition

   !> Velocity of the wheelset, with the pitch rate that was found
   subroutine cntc_getwheelsetvelocity(ire, lenarr, rvalues) bind(c, name="inside_cntc_getwheelsetvelocity")
      integer(c_int), intent(in), optional :: ire, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem

      call enter(entry_type("cntc_getWheelsetVelocity", integer_of(ire)), scope%wheel_rail, problem)
      if (.not. associated(problem)) return
      associate (w => problem%stored%wheelset, velocity => outward(problem%units, quantity%velocity), &
         & angle => outward(problem%units, quantity%angle))
         call give_list([w%vs*velocity, w%vy*velocity, w%vz*velocity, w%vroll*angle, w%vyaw*angle, w%vpitch*angle], lenarr, &
            & rvalues)
      end associate
      call leave(problem)
   end subroutine cntc_getwheelsetvelocity

   !> Number of contact patches
   subroutine cntc_getnumcontactpatches(ire, npatch) bind(c, name="inside_cntc_getnumcontactpatches")
      integer(c_int), intent(in), optional :: ire
      integer(c_int), intent(inout), optional :: npatch
      type(library_problem), pointer :: problem

      call enter(entry_type("cntc_getNumContactPatches", integer_of(ire)), scope%wheel_rail, problem)
      if (.not. associated(problem)) return
      call give(size(problem%wheel_rail_result%patches), npatch)
      call leave(problem)
   end subroutine cntc_getnumcontactpatches

   !> Where a patch is, in track, rail, wheel and wheelset, and where these are
   subroutine cntc_getcontactlocation(ire, icp, lenarr, rvalues) bind(c, name="inside_cntc_getcontactlocation")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      real(wp) :: list(38), kept(29)
      type(quantity_type) :: unit(38)
      integer :: sign(38)

      this = entry_type("cntc_getContactLocation", integer_of(ire), integer_of(icp))
      call enter(this, scope%wheel_rail_patch, problem)
      if (.not. associated(problem)) return
      call locate(problem, this%icp, list)
      unit = quantity%length
      unit([4, 9, 14, 24, 25, 28, 33, 37, 38]) = quantity%angle
      sign = orientation%none
      sign([2, 4, 6, 9, 11, 14, 16, 22, 24, 25, 26, 28, 31, 33, 35, 37, 38]) = orientation%side
      list = list*outward(problem%units, unit, sign, problem%spec%wheel_rail%left)
      ! the 29th value has no meaning and is left alone
      if (min(38, integer_of(lenarr)) >= 29 .and. present(rvalues)) then
         kept = real(rvalues(:29), wp)
         list(29) = kept(29)
      end if
      call give_list(list, lenarr, rvalues)
      call leave(problem)
   end subroutine cntc_getcontactlocation

   !> The values in internal units, for a right-hand pair
   subroutine locate(problem, number, list)
      type(library_problem), intent(in) :: problem
      integer, intent(in) :: number
      real(wp), intent(out) :: list(38)
      type(body_frames) :: frames
      real(wp) :: centre(2), in_set(3)

      list = 0.0_wp
      associate (result => problem%wheel_rail_result, patch => problem%wheel_rail_result%patches(number), &
         & pair => problem%wheel_rail%problem)
         frames = frames_of(pair%spec, result)
         list(1:4) = [patch%x, patch%y, patch%z, patch%delta]
         list(5:9) = [patch%x, patch%y_rail, patch%z_rail, pair%rail%s_at(patch%y_rail), patch%delta_rail]
         list(10:14) = [patch%x_wheel, patch%y_wheel, patch%z_wheel, pair%wheel%s_at(patch%y_wheel), &
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

   !> Forces and moments of one patch, or of all of them with -1, in four systems of axes
   subroutine cntc_getglobalforces(ire, icp, lenarr, rvalues) bind(c, name="inside_cntc_getglobalforces")
      integer(c_int), intent(in), optional :: ire, icp, lenarr
      real(c_double), intent(inout), optional :: rvalues(*)
      type(library_problem), pointer :: problem
      type(entry_type) :: this
      type(body_frames) :: frames
      real(wp) :: list(24)
      type(quantity_type) :: unit(6)
      integer, parameter :: sign(6) = [orientation%along, orientation%across, orientation%along, orientation%across, &
         & orientation%along, orientation%across]
      integer :: k, first, last

      this = entry_type("cntc_getGlobalForces", integer_of(ire), integer_of(icp))
      call enter(this, scope%wheel_rail_any, problem)
      if (.not. associated(problem)) return
      first = 1
      last = size(problem%wheel_rail_result%patches)
      if (this%icp > 0) then
         first = this%icp
         last = this%icp
      end if
      list = 0.0_wp
      if (problem%has_result) frames = frames_of(problem%wheel_rail%problem%spec, problem%wheel_rail_result)
      do k = first, last
         list = list + forces_in_bodies(problem%wheel_rail_result%patches(k), frames)
      end do
      unit = [quantity%force, quantity%force, quantity%force, quantity%moment, quantity%moment, quantity%moment]
      do k = 0, 18, 6
         list(k + 1:k + 6) = list(k + 1:k + 6)*outward(problem%units, unit, sign, problem%spec%wheel_rail%left)
      end do
      call give_list(list, lenarr, rvalues)
      call give_zeros(25, lenarr, rvalues)
      call leave(problem)
   end subroutine cntc_getglobalforces
end module contact_capi_wheel_rail_results
