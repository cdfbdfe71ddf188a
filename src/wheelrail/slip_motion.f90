!> Derivatives of the creepages of a patch, and of the slip of its elements, with respect to position and velocity of the wheelset
!>
!> Central differences of the formulas: as these are smooth, errors are round-off, 1e-8 of the derivatives. The slip of elements is
!> that of patches which follow the surfaces (D = 3). It changes with the motion of the bodies, with that of the plane, and with the
!> heights of both surfaces over the plane.
module contact_wheelrail_slip_motion
   use contact_base_kinds, only : wp
   use contact_wheelrail_creepage, only : contact_motion, flat_creepage, rigid_motion
   use contact_wheelrail_curved_patch, only : straight_reference, surface_motion
   use contact_wheelrail_displacements, only : coordinate, displaced, jacobian_input
   use contact_wheelrail_frame, only : frame, roll_axes
   use contact_wheelrail_geometry, only : wheel_rail_geometry
   use contact_wheelrail_memory, only : patch_slot
   use contact_wheelrail_placement, only : forward_velocity, rail_motion, wheel_motion, wheel_rail_placement
   use contact_wheelrail_problem, only : share_of_rail, wheel_rail_problem
   use contact_wheelrail_reference_motion, only : reference_motion
   use contact_wheelrail_spec, only : pair_spec
   implicit none (type, external)
   private

   public :: differentiate_slip

   !> Steps of the central differences: displacements [mm], rotations [rad], and velocities relative to the rolling velocity
   real(wp), parameter :: place_step(4) = [1.0e-4_wp, 1.0e-4_wp, 1.0e-7_wp, 1.0e-7_wp], velocity_step = 1.0e-4_wp

   !> Slip of a patch: creepages and spin, and the remainder of each element, shape (mx, my, 2), if it follows the surfaces
   type :: patch_slip
      real(wp) :: creepages(3) = 0.0_wp
      real(wp), allocatable :: extra(:, :, :)
   end type patch_slip

contains

   !> Derivatives with respect to all inputs in steady rolling
   !>
   !> Long because the internal procedures for displacements, velocities and slip share its arguments.
   subroutine differentiate_slip(problem, geometry, slot, motions, approach, heights, creepage, extra)
      !> Velocities of the bodies
      type(wheel_rail_problem), intent(in) :: problem
      !> Position of the bodies
      type(wheel_rail_geometry), intent(in) :: geometry
      !> Solved patch
      type(patch_slot), intent(in) :: slot
      !> Motions of the reference of the patch, one per coordinate
      type(reference_motion), intent(in) :: motions(:)
      !> Changes of the approach by each coordinate [mm per unit]
      real(wp), intent(in) :: approach(:)
      !> Changes of the heights of rail and wheel, see `differentiate_distance`; unallocated if the slip is that of the reference
      real(wp), allocatable, intent(in) :: heights(:, :, :, :)
      !> Changes of CKSI, CETA, CPHI, shape (3, inputs)
      real(wp), intent(inout) :: creepage(:, :)
      !> Changes of the extra slip, shape (mx, my, 2, inputs); unallocated without `heights`
      real(wp), allocatable, intent(out) :: extra(:, :, :, :)
      type(pair_spec), allocatable :: spec
      real(wp) :: step, pitch_rate
      integer :: k

      allocate(spec, source=problem%spec)
      pitch_rate = geometry%pitch_rate
      if (allocated(heights)) allocate(extra(size(heights, 1), size(heights, 2), 2, jacobian_input%count), source=0.0_wp)
      do k = 1, coordinate%count
         step = place_step(k)
         call set_column(k, step, slip_at(k, -step), slip_at(k, step))
      end do
      do k = jacobian_input%vs, jacobian_input%vpitch
         step = velocity_step*max(slot%motion%veloc, 1.0_wp)
         if (k >= jacobian_input%vroll .or. (k == jacobian_input%vs .and. spec%roller)) &
            & step = step/geometry%placement%wheel_radius
         call set_column(k, step, slip_with(k, -step), slip_with(k, step))
      end do

   contains

      !> Central difference by an input
      subroutine set_column(number, step, low, high)
         integer, intent(in) :: number
         real(wp), intent(in) :: step
         type(patch_slip), intent(in) :: low, high

         creepage(:, number) = (high%creepages - low%creepages)/(2.0_wp*step)
         if (allocated(extra)) extra(:, :, :, number) = (high%extra - low%extra)/(2.0_wp*step)
      end subroutine set_column

      !> Slip after a displacement
      function slip_at(number, step) result(slip)
         integer, intent(in) :: number
         real(wp), intent(in) :: step
         type(patch_slip) :: slip
         type(frame) :: plane
         real(wp), allocatable :: on_rail(:, :), on_wheel(:, :)

         associate (motion => motions(number))
            plane%origin = slot%plane%origin + step*motion%origin
            plane%axes = matmul(roll_axes(step*motion%angle), slot%plane%axes)
         end associate
         if (allocated(heights)) then
            on_rail = slot%on_rail + step*heights(:, :, 1, number)
            on_wheel = slot%on_wheel + step*heights(:, :, 2, number)
         end if
         slip = slip_of(displaced(geometry%placement, number, step), plane, slot%problem%pen + step*approach(number), on_rail, &
            & on_wheel)
      end function slip_at

      !> Slip with another velocity
      function slip_with(number, step) result(slip)
         integer, intent(in) :: number
         real(wp), intent(in) :: step
         type(patch_slip) :: slip

         associate (w => spec%wheelset, old => problem%spec%wheelset, input => jacobian_input)
            if (number == input%vs .and. spec%roller) then
               w%rpitch = old%rpitch + step
            else if (number == input%vs) then
               w%vs = old%vs + step
            end if
            if (number == input%vy) w%vy = old%vy + step
            if (number == input%vroll) w%vroll = old%vroll + step
            if (number == input%vyaw) w%vyaw = old%vyaw + step
            if (number == input%vpitch) pitch_rate = geometry%pitch_rate + step
            slip = slip_of(geometry%placement, slot%plane, slot%problem%pen, slot%on_rail, slot%on_wheel)
            w%vs = old%vs
            w%rpitch = old%rpitch
            w%vy = old%vy
            w%vroll = old%vroll
            w%vyaw = old%vyaw
            pitch_rate = geometry%pitch_rate
         end associate
      end function slip_with

      !> Slip as in `set_motion` of contact_wheelrail_patch_inputs
      function slip_of(placement, plane, approach, on_rail, on_wheel) result(slip)
         type(wheel_rail_placement), intent(in) :: placement
         type(frame), intent(in) :: plane
         real(wp), intent(in) :: approach
         !> Heights of the surfaces [mm], shape (mx, my); not used without `heights`
         real(wp), allocatable, intent(in) :: on_rail(:, :), on_wheel(:, :)
         type(patch_slip) :: slip
         type(rigid_motion) :: rail, wheel
         type(contact_motion) :: motion

         rail = rail_motion(spec, placement)
         wheel = wheel_motion(spec, placement, pitch_rate)
         motion = flat_creepage(rail, wheel, placement%wheelset%axes(:, 2), pitch_rate, plane%origin, &
            & plane%origin + approach*plane%axes(:, 3), plane%roll(), spec%roller)
         if (allocated(heights)) then
            associate (grid => slot%problem%grid)
               ! creepages are those of the same elements
               call surface_motion(rail, wheel, straight_reference(plane, grid), grid, on_rail, on_wheel, &
                  & slot%on_rail < slot%on_wheel, share_of_rail(problem, approach, motion%veloc), forward_velocity(spec), &
                  & motion, slip%extra)
            end associate
         end if
         slip%creepages = [motion%cksi, motion%ceta, motion%cphi]
      end function slip_of
   end subroutine differentiate_slip
end module contact_wheelrail_slip_motion
