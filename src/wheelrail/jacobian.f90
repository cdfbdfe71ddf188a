!> Derivatives of the forces of the wheel on the rail with respect to position and velocity of the wheelset
!>
!> Quantities that depend on the position, and their differentiation:
!>
!>    position and angle of the references   search repeated with changed gaps      contact_wheelrail_reference_motion
!>    undeformed distance                    in closed form                         contact_wheelrail_distance_motion
!>    creepages, slip of each element        central differences of their formula   contact_wheelrail_slip_motion
!>    pressures and tractions                linear systems                         contact_patch_derivatives
!>    axes and levers of the forces          in closed form                         this module
!>
!> Contact areas and element divisions are kept. With a prescribed vertical force the height is a function of the other inputs.
module contact_wheelrail_jacobian
   use contact_base_choices, only : contact_location, force_control, motion, variation
   use contact_base_kinds, only : wp
   use contact_patch_derivatives, only : differentiate_patch, obstacle_to_derivatives, patch_derivatives
   use contact_wheelrail_displacements, only : coordinate, displacement_at, jacobian_input, turn_of
   use contact_wheelrail_distance_motion, only : differentiate_distance
   use contact_wheelrail_frame, only : cross, frame
   use contact_wheelrail_memory, only : patch_slot, wheel_rail_memory
   use contact_wheelrail_placement, only : side_sign, wheel_rail_placement
   use contact_wheelrail_problem, only : parameters_at, wheel_rail_problem
   use contact_wheelrail_reference_motion, only : find_reference_motions, reference_motion
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_slip_motion, only : differentiate_slip
   implicit none (type, external)
   private

   public :: differentiate_wheel_rail, jacobian_input, jacobian_row, jacobian_state, wheel_rail_jacobian

   type :: row_list
      !> First component of force on the rail and its moment about the rail marker, in track axes
      integer :: on_rail = 1
      !> First component of force on the rail and its moment about the wheel marker, in wheelset axes
      integer :: on_wheel = 7
      !> Height of the wheelset
      integer :: z = 13
      !> Number of rows
      integer :: count = 13
   end type row_list
   !> Rows of the matrix of derivatives
   type(row_list), parameter :: jacobian_row = row_list()

   type :: state_list
      !> Derivative; one-sided derivative, if a patch appears or vanishes here; no derivative
      integer :: exact = 0, one_sided = 1, none = 2
   end type state_list
   !> Validity of the derivatives
   type(state_list), parameter :: jacobian_state = state_list()

   !> Derivatives of a case
   type :: wheel_rail_jacobian
      !> Member of jacobian_state, with the reason unless it is exact
      integer :: state = 2
      character(len=:), allocatable :: reason
      !> Derivatives for a right-hand pair, with velocities as given in the input: rows of jacobian_row [N], [N mm], [mm] per unit
      !> of the columns of jacobian_input
      real(wp) :: values(13, 10) = 0.0_wp
      !> Maximum relative residual of the linear systems [-]
      real(wp) :: reached = 0.0_wp
   end type wheel_rail_jacobian

   !> Maximum relative residual that is accepted [-]
   real(wp), parameter :: good = 1.0e-4_wp
   !> Step of the contact angle, for friction that depends on it [rad]
   real(wp), parameter :: angle_step = 1.0e-6_wp
   !> Vertical stiffness below this value is regarded as zero [N/mm]
   real(wp), parameter :: no_stiffness = 1.0e-9_wp

contains

   !> Derivatives at the last solution
   subroutine differentiate_wheel_rail(problem, memory, result, jacobian)
      !> The problem that was solved
      type(wheel_rail_problem), intent(in) :: problem
      !> The solution; work space of its patches is used
      type(wheel_rail_memory), intent(inout) :: memory
      !> Forces, height and status of that solution
      type(wheel_rail_result), intent(in) :: result
      !> The derivatives are set, or the reason why there are none
      type(wheel_rail_jacobian), intent(inout) :: jacobian
      type(reference_motion), allocatable :: motions(:, :)
      real(wp) :: slope
      integer :: k
      logical :: is_smooth

      jacobian%values = 0.0_wp
      jacobian%reached = 0.0_wp
      jacobian%state = jacobian_state%none
      call find_obstacle(problem, memory, result, jacobian%reason)
      if (len(jacobian%reason) > 0) return
      call find_reference_motions(problem, memory%geometry, result%z_ws, motions, is_smooth)
      if (size(motions, 1) /= memory%used) then
         jacobian%reason = "the number of contact patches or of their parts changes with every motion of the wheelset"
         return
      end if
      do k = 1, memory%used
         call add_patch(problem, memory, k, motions(k, :), jacobian)
      end do
      call add_place_of_wheel(memory, result, jacobian%values)
      jacobian%values(jacobian_row%z, jacobian_input%z) = 1.0_wp
      ! on the left side of the track, lateral positions and angles have the opposite sign
      associate (v => jacobian%values, input => jacobian_input)
         v(:, [input%y, input%roll, input%yaw]) = side_sign(problem%spec)*v(:, [input%y, input%roll, input%yaw])
         if (problem%force_prescribed) then
            slope = v(jacobian_row%on_rail + 2, input%z)
            if (.not. abs(slope) > no_stiffness) then
               jacobian%reason = "the vertical force does not change with the height"
               return
            end if
            v(jacobian_row%on_rail + 2, input%fz) = -1.0_wp
            v = v - matmul(v(:, input%z:input%z), v(jacobian_row%on_rail + 2:jacobian_row%on_rail + 2, :))/slope
            v(:, input%z) = 0.0_wp
            ! the row of the prescribed force
            v(jacobian_row%on_rail + 2, :) = 0.0_wp
            v(jacobian_row%on_rail + 2, input%fz) = 1.0_wp
         end if
      end associate
      jacobian%state = jacobian_state%exact
      if (.not. is_smooth) then
         jacobian%state = jacobian_state%one_sided
         jacobian%reason = "a contact patch, or a part of one, appears or vanishes here: derivatives are one-sided"
      else if (jacobian%reached > good) then
         jacobian%state = jacobian_state%none
         jacobian%reason = "the linear systems were not solved"
      end if
   end subroutine differentiate_wheel_rail

   !> Reason why there are no derivatives; blank if there are
   subroutine find_obstacle(problem, memory, result, reason)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      type(wheel_rail_result), intent(in) :: result
      character(len=:), allocatable, intent(out) :: reason

      reason = ""
      if (problem%geometry_only) then
         reason = "the case is a contact search without solution"
      else if (.not. result%status%is_solved()) then
         reason = "the calculation did not end with a solution"
      else if (problem%force /= force_control%creepages) then
         reason = "derivatives are not available for a prescribed longitudinal force and a rail on springs"
      else if (memory%geometry%searches_table .or. problem%spec%search%location == contact_location%conformal) then
         reason = "derivatives are not available for bodies that vary, and curved patches"
      else if (problem%variation == variation%by_angle .and. memory%used > 0) then
         if (allocated(memory%slot(1)%problem%friction)) reason = "derivatives are not available for friction laws that vary"
      end if
      if (len(reason) > 0) return
      if (memory%used == 0) then
         reason = "wheel and rail do not touch"
         return
      end if
      call obstacle_to_derivatives(memory%slot(1)%problem, reason)
      if (len(reason) > 0) reason = "derivatives are not available for " // reason
   end subroutine find_obstacle

   !> Add the contribution of one patch
   subroutine add_patch(problem, memory, number, motions, jacobian)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), target, intent(inout) :: memory
      integer, intent(in) :: number
      !> Motion of its reference per unit of each coordinate
      type(reference_motion), intent(in) :: motions(:)
      type(wheel_rail_jacobian), intent(inout) :: jacobian
      type(patch_derivatives) :: d
      real(wp), allocatable :: distance(:, :, :), heights(:, :, :, :), slip(:, :, :, :)
      real(wp) :: approach(4), creepage(3, 10), force(3), moment(3), change(6), turn(3), friction, lever(3)
      integer :: k

      associate (slot => memory%slot(number), geometry => memory%geometry)
         allocate(distance(slot%problem%grid%mx, slot%problem%grid%my, coordinate%count))
         if (allocated(slot%curve)) allocate(heights(slot%problem%grid%mx, slot%problem%grid%my, 2, coordinate%count))
         call differentiate_distance(problem, geometry, slot, motions, distance, approach, heights)
         call add_interactions(slot, motions, distance)
         creepage = 0.0_wp
         if (slot%problem%motion == motion%steady_rolling) &
            & call differentiate_slip(problem, geometry, slot, motions, approach, heights, creepage, slip)
         call differentiate_patch(slot%problem, distance, slot%workspace, slot%result, d, slip)
         jacobian%reached = max(jacobian%reached, d%reached)
         friction = 0.0_wp
         if (problem%variation == variation%by_angle .and. slot%problem%motion /= motion%none) &
            & friction = (friction_at(slot%plane%roll() + angle_step) - friction_at(slot%plane%roll() - angle_step)) &
            & /(2.0_wp*angle_step)
         force = matmul(slot%plane%axes, slot%force)
         moment = matmul(slot%plane%axes, slot%moment)
         do k = 1, jacobian_input%vpitch
            change = matmul(d%by_creepage, creepage(:, k))
            if (allocated(slip)) change = change + d%by_slip(:, k)
            turn = 0.0_wp
            lever = 0.0_wp
            if (k <= coordinate%count) then
               change = change + d%by_distance(:, k) + d%by_friction*friction*motions(k)%angle
               turn(1) = motions(k)%angle
               lever = motions(k)%origin
            end if
            call add_column(geometry%placement, slot%plane, matmul(slot%plane%axes, change(1:3)) + cross(turn, force), &
               & matmul(slot%plane%axes, change(4:6)) + cross(turn, moment), force, lever, jacobian%values(:, k))
         end do
      end associate

   contains

      !> Coefficient of friction at a contact angle
      real(wp) function friction_at(angle) result(mu)
         !> Contact angle [rad]
         real(wp), intent(in) :: angle

         associate (set => parameters_at(problem, angle))
            mu = set%fstat
         end associate
      end function friction_at
   end subroutine add_patch

   !> Add the change of displacements by pressures that is due to interaction factors between parts
   subroutine add_interactions(slot, motions, distance)
      type(patch_slot), intent(inout) :: slot
      type(reference_motion), intent(in) :: motions(:)
      !> Change of the undeformed distance, to which equivalent changes of displacements are added [mm per unit]
      real(wp), contiguous, intent(inout) :: distance(:, :, :)
      real(wp), allocatable :: kept(:, :), u(:, :)
      integer :: k

      if (.not. allocated(slot%problem%parts)) return
      kept = slot%problem%parts%interaction
      allocate(u, mold=slot%result%pn)
      do k = 1, coordinate%count
         if (.not. allocated(motions(k)%interaction)) cycle
         slot%problem%parts%interaction = motions(k)%interaction
         call slot%problem%parts%displacement(slot%workspace%window, slot%result%pn, u)
         distance(:, :, k) = distance(:, :, k) + u
      end do
      slot%problem%parts%interaction = kept
   end subroutine add_interactions

   !> Add the changes of force and moment of a patch, in track axes, to a column
   subroutine add_column(placement, plane, force, moment, old_force, shift, column)
      type(wheel_rail_placement), intent(in) :: placement
      type(frame), intent(in) :: plane
      !> Changes of force and moment about the reference [N, N mm per unit]
      real(wp), intent(in) :: force(3), moment(3)
      !> Force of the patch [N], and motion of its reference [mm per unit]
      real(wp), intent(in) :: old_force(3), shift(3)
      real(wp), intent(inout) :: column(:)
      real(wp) :: about(3)

      associate (rail => jacobian_row%on_rail, wheel => jacobian_row%on_wheel)
         column(rail:rail + 2) = column(rail:rail + 2) + force
         about = moment + cross(shift, old_force) + cross(plane%origin - placement%rail%origin, force)
         column(rail + 3:rail + 5) = column(rail + 3:rail + 5) + about
         about = moment + cross(shift, old_force) + cross(plane%origin - placement%wheel%origin, force)
         column(wheel:wheel + 2) = column(wheel:wheel + 2) + matmul(force, placement%wheelset%axes)
         column(wheel + 3:wheel + 5) = column(wheel + 3:wheel + 5) + matmul(about, placement%wheelset%axes)
      end associate
   end subroutine add_column

   !> Rows of the wheel: add the motion of its marker and the rotation of the wheelset's axes
   subroutine add_place_of_wheel(memory, result, values)
      type(wheel_rail_memory), intent(in) :: memory
      type(wheel_rail_result), intent(in) :: result
      real(wp), intent(inout) :: values(:, :)
      real(wp) :: force(3), moment(3), turn(3), marker(3)
      integer :: k

      associate (placement => memory%geometry%placement, row => jacobian_row%on_wheel)
         force = result%force_track
         moment = matmul(placement%wheelset%axes, result%moment_wheel)
         do k = 1, coordinate%count
            turn = turn_of(placement, k)
            marker = displacement_at(placement, k, placement%wheel%origin)
            ! a vector with components v'A changes by v'(w x A) = (v x w)'A
            values(row:row + 2, k) = values(row:row + 2, k) + matmul(cross(force, turn), placement%wheelset%axes)
            values(row + 3:row + 5, k) = values(row + 3:row + 5, k) &
               & + matmul(cross(moment, turn) - cross(marker, force), placement%wheelset%axes)
         end do
      end associate
   end subroutine add_place_of_wheel
end module contact_wheelrail_jacobian
