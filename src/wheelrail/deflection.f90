!> Deflection of a rail on springs under the forces of the wheel
module contact_wheelrail_deflection
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_numeric_root_search, only : root_search
   use contact_wheelrail_height, only : contact_reach, find_height, small_step
   use contact_wheelrail_memory, only : wheel_rail_memory, total_force, vertical_force
   use contact_wheelrail_placement, only : side_sign
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: search_deflection, lower_rail

   !> Length of the first step relative to the deflection of the spring alone: beyond 1, so that the root is between the first two
   !> points
   real(wp), parameter :: beyond_spring = 1.05_wp
   !> Width of a bracket of the deflection that is regarded as a point [mm], and its contribution to the tolerance of the force
   real(wp), parameter :: fine_deflection = 1.0e-8_wp, part_of_tolerance = 0.1_wp

contains

   !> Find the lateral deflection of a rail on springs
   !>
   !> With increasing deflection the lateral contact force decreases and the force of the spring increases.
   subroutine search_deflection(problem, memory, z, log, result, error)
      !> The problem; stiffness of the spring and static force
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; those of the last one are kept
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm]
      real(wp), intent(out) :: z
      !> Receives a warning if no deflection balances the forces
      type(log_type), intent(inout) :: log
      !> Its status: whether the forces are in balance
      type(wheel_rail_result), intent(inout) :: result
      !> Allocated if a trial has no result
      type(error_type), allocatable, intent(out) :: error
      type(root_search) :: search
      type(log_type) :: silent
      real(wp) :: first, step, tolerance, residual

      first = memory%geometry%deflection
      associate (rail => problem%spec%rail)
         call find_height(problem, memory, z, silent, result, error)
         if (allocated(error)) return
         residual = unbalanced()
         step = rail%first_step
         if (rail%ky > 0.0_wp) step = min(step, beyond_spring*abs(residual)/rail%ky)
         tolerance = problem%template%settings%eps*max(abs(rail%fy), norm2(total_force(memory)))
         call search%start(first, step, tolerance)
         search%resolution = fine_deflection
         if (rail%ky > 0.0_wp) search%resolution = min(search%resolution, part_of_tolerance*tolerance/rail%ky)
         do
            call search%update(residual, abs(search%x - first) > contact_reach)
            if (search%finished) exit
            memory%geometry%deflection = search%x
            call find_height(problem, memory, z, silent, result, error)
            if (allocated(error)) return
            residual = unbalanced()
         end do
         memory%geometry%deflection = search%best
         call find_height(problem, memory, z, log, result, error)
         if (allocated(error)) return
         residual = unbalanced()
         if (abs(residual) <= max(tolerance, small_step*norm2(total_force(memory)))) return
         associate (s => side_sign(problem%spec))
            call result%status%record_missed_force("lateral force of the rail's spring", s*spring_force(), &
               & s*(spring_force() + residual) + 0.0_wp, &  ! no negative zero
               & trim(merge("it jumps where contact patches appear, join or separate", &
               &            "no deflection balances them                            ", search%bracketed)))
         end associate
         call log%warning(result%status%reason)
      end associate

   contains

      !> Lateral force carried by the spring and the static force [N], for the right side of the track
      real(wp) function spring_force()
         spring_force = problem%spec%rail%ky*memory%geometry%deflection - side_sign(problem%spec)*problem%spec%rail%fy
      end function spring_force

      !> Lateral contact force minus force of the spring and static force [N], for the right side of the track
      real(wp) function unbalanced()
         real(wp) :: force(3)
         force = total_force(memory)
         unbalanced = force(2) - spring_force()
      end function unbalanced
   end subroutine search_deflection

   !> Vertical deflection of a rail on springs: rail and wheelset move down together
   subroutine lower_rail(problem, memory, z, result)
      !> Stiffness of the vertical spring and static force
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection on entry, above the track on exit [mm]
      real(wp), intent(inout) :: z
      !> The deflection is set
      type(wheel_rail_result), intent(inout) :: result
      integer :: k

      if (.not. problem%force_prescribed) then
         result%dz_defl = problem%spec%wheelset%z - z
      else if (problem%spec%rail%kz > 0.0_wp) then
         result%dz_defl = (vertical_force(memory) + problem%spec%rail%fz)/problem%spec%rail%kz
      end if
      z = z + result%dz_defl
      do k = 1, memory%used
         memory%slot(k)%plane%origin(3) = memory%slot(k)%plane%origin(3) + result%dz_defl
         if (allocated(memory%slot(k)%curve)) memory%slot(k)%curve%z = memory%slot(k)%curve%z + result%dz_defl
      end do
   end subroutine lower_rail
end module contact_wheelrail_deflection
