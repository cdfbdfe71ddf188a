!> Result of wheel and rail from the solutions of the patches
module contact_wheelrail_gather
   use contact_base_choices, only : contact_location, motion
   use contact_base_kinds, only : wp
   use contact_patch_border, only : find_border
   use contact_patch_result, only : copy_result
   use contact_wheelrail_frame, only : cross, frame
   use contact_wheelrail_geometry, only : wheel_rail_geometry
   use contact_wheelrail_memory, only : wheel_rail_memory, patch_slot
   use contact_wheelrail_problem, only : friction_by_row, wheel_rail_problem
   use contact_wheelrail_profile_ends, only : find_buried_ends, find_spot_beside, mark_profile_ends
   use contact_wheelrail_result, only : buried_end, wheel_rail_patch, wheel_rail_result
   implicit none (type, external)
   private

   public :: gather

contains

   !> Collect the patches and sum their forces
   subroutine gather(problem, memory, result)
      !> Placement and prescribed quantities
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches, and positions of the bodies
      type(wheel_rail_memory), intent(inout) :: memory
      !> Patches, forces, moments, penetrations and status are set
      type(wheel_rail_result), intent(inout) :: result
      real(wp) :: force(3), moment(3), axes(3, 3), local(3)
      integer :: k

      associate (p => memory%geometry%placement, material => problem%template%model%material)
         result%gg = material%gg
         result%nu = material%nu
         result%ak = material%ak
         result%rail_y = p%rail%origin(2)
         result%rail_z = p%rail%origin(3)
         result%rail_roll = p%rail%roll()
         result%wheel_x = p%wheel%origin(1)
         result%wheel_y = p%wheel%origin(2)
         result%wheel_z = p%wheel%origin(3)
         result%wheel_roll = p%wheel%roll()
         result%wheel_yaw = p%wheel%yaw()
         local = p%wheelset%to_local(p%wheel%origin)
         result%wheel_offset = local(2)
         result%force_track = 0.0_wp
         result%moment_rail = 0.0_wp
         result%moment_wheel = 0.0_wp
         if (allocated(result%patches)) then
            if (size(result%patches) /= memory%used) deallocate(result%patches)
         end if
         if (.not. allocated(result%patches)) allocate(result%patches(memory%used))
         do k = 1, memory%used
            call describe_patch(memory%geometry, memory%slot(k), result%patches(k))
            if (.not. problem%geometry_only) then
               call find_border(memory%slot(k)%problem, result%patches(k)%contact)
               call mark_profile_ends(problem, memory%geometry, memory%slot(k), result%patches(k)%contact%border)
               call result%status%include(memory%slot(k)%result%status, "contact patch " // achar(iachar("0") + mod(k, 10)) &
                  & // ": ")
            end if
            if (allocated(result%patches(k)%curve)) deallocate(result%patches(k)%curve)
            if (problem%spec%search%location == contact_location%conformal) then
               associate (curve => memory%slot(k)%curve)
                  result%patches(k)%curve = transpose(reshape([curve%y, curve%z, curve%alpha], [size(curve%y), 3]))
               end associate
            end if
            result%patches(k)%friction_varies = friction_by_row(problem)
            axes = memory%slot(k)%plane%axes
            force = matmul(axes, result%patches(k)%force)
            moment = matmul(axes, result%patches(k)%moment)
            result%force_track = result%force_track + force
            result%moment_rail = result%moment_rail + moment + cross(memory%slot(k)%plane%origin - p%rail%origin, force)
            result%moment_wheel = result%moment_wheel + moment + cross(memory%slot(k)%plane%origin - p%wheel%origin, force)
         end do
         result%buried = buried_end()
         result%beside = buried_end()
         if (.not. problem%geometry_only) then
            call find_buried_ends(problem, memory, result%buried)
            call find_spot_beside(problem, memory, result%beside)
         end if
         result%force_wheelset = matmul(result%force_track, p%wheelset%axes)
         result%moment_wheel = matmul(result%moment_wheel, p%wheelset%axes)
      end associate
   end subroutine gather

   !> Position and forces of one patch
   subroutine describe_patch(geometry, slot, patch)
      type(wheel_rail_geometry), intent(in) :: geometry
      type(patch_slot), intent(inout) :: slot
      type(wheel_rail_patch), intent(inout) :: patch
      real(wp) :: local(3)
      type(frame) :: seen

      patch%previous = slot%previous
      if (allocated(patch%friction)) deallocate(patch%friction)
      if (allocated(slot%friction)) allocate(patch%friction, source=slot%friction)
      patch%grid_reference = 0.0_wp
      if (slot%problem%motion == motion%shift .or. slot%problem%motion == motion%transient_rolling) &
         & patch%grid_reference = slot%reference

      patch%x = slot%plane%origin(1)
      patch%y = slot%plane%origin(2)
      patch%z = slot%plane%origin(3)
      patch%delta = slot%plane%roll()
      seen = geometry%placement%rail%seen_from_here(slot%plane)
      patch%y_rail = seen%origin(2)
      patch%z_rail = seen%origin(3)
      patch%delta_rail = seen%roll()
      local = geometry%placement%wheel%to_local(slot%plane%origin)
      patch%x_wheel = local(1)
      patch%y_wheel = local(2)
      patch%z_wheel = local(3)
      call copy_result(slot%result, patch%contact)
      patch%force = slot%force
      patch%moment = slot%moment
      patch%tilde_fn = slot%result%fn
   end subroutine describe_patch
end module contact_wheelrail_gather
