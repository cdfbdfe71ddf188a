!> Estimated errors of wheel and rail: errors of the patches, and their effect on forces and height
!>
!> The coarse level of each patch has the same approach as the fine one. If the vertical force is prescribed, the height at which
!> the coarse patches together carry it is different; the difference is determined by the stiffness of all patches, and is itself
!> the difference of the heights on both levels. Errors of the undeformed distance, of profiles and of the positions of the patches
!> are not included.
module contact_wheelrail_error_estimate
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_choices, only : motion, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_patch_error_estimate, only : compare_levels, normal_stiffness, solve_coarse_level
   use contact_patch_quantities, only : total_list
   use contact_wheelrail_memory, only : patch_slot, wheel_rail_memory
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: estimate_wheel_rail_errors

contains

   !> Estimate the errors of all patches, and of the totals of wheel and rail
   subroutine estimate_wheel_rail_errors(problem, memory, result, error)
      !> The problem that was solved
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches; `errors` of their results is set
      type(wheel_rail_memory), intent(inout) :: memory
      !> `errors` is set
      type(wheel_rail_result), intent(inout) :: result
      !> Allocated if the time limit is exceeded
      type(error_type), allocatable, intent(out) :: error
      !> Missing vertical force of the coarse patches [N], its derivative with respect to the height [N/mm], change of the height
      !> [mm]
      real(wp) :: missing, stiffness, change
      logical :: has_history
      integer :: k

      result%errors = error_values(result, problem)
      has_history = problem%link /= time_link%initiate .and. (problem%template%motion == motion%shift &
         & .or. problem%template%motion == motion%transient_rolling)
      missing = 0.0_wp
      stiffness = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (.not. allocated(slot%coarse)) allocate(slot%coarse)
            slot%coarse%state%started = .false.
            call solve_coarse_level(slot%problem, slot%state, problem%link, slot%coarse, slot%result, error)
            if (allocated(error)) return
            if (has_history) slot%result%errors%reason = &
               & "transient cases of wheel and rail have no history on a coarser level"
            if (slot%result%errors%reason /= "") cycle
            missing = missing + vertical(slot, slot%result%fn) - vertical(slot, slot%coarse%result%fn)
            stiffness = stiffness + slot%plane%axes(3, 3)*vertical(slot, normal_stiffness(slot%result))
         end associate
      end do
      change = 0.0_wp
      if (problem%force_prescribed .and. stiffness > 0.0_wp) change = missing/stiffness
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (problem%force_prescribed) then
               call compare_levels(slot%problem, max(1, slot%result%tangential%order), slot%coarse, slot%result, &
                  & change*slot%plane%axes(3, 3))
            else
               call compare_levels(slot%problem, max(1, slot%result%tangential%order), slot%coarse, slot%result)
            end if
         end associate
      end do
      call add_up(problem, memory, result)
   end subroutine estimate_wheel_rail_errors

   !> Array for the errors of all totals, NaN: not known
   function error_values(result, problem) result(values)
      type(wheel_rail_result), intent(in) :: result
      type(wheel_rail_problem), intent(in) :: problem
      real(wp), allocatable :: values(:)
      type(total_list) :: list

      call result%totals(problem%spec, list)
      allocate(values(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
   end function error_values

   !> Vertical force on the rail for a given normal force of a patch; friction is scaled with it
   pure real(wp) function vertical(slot, fn)
      type(patch_slot), intent(in) :: slot
      !> Normal force [N], or stiffness [N/mm]
      real(wp), intent(in) :: fn

      vertical = 0.0_wp
      if (slot%result%fn > 0.0_wp) vertical = fn*dot_product(slot%plane%axes(3, :), slot%force/slot%result%fn)
   end function vertical

   !> Errors of forces and moments of all patches: errors of the patches are added
   subroutine add_up(problem, memory, result)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      type(wheel_rail_result), intent(inout) :: result
      type(total_list) :: pair, patch
      real(wp) :: force(3), on_rail(3), on_wheel(3), local(3), turned(3), spin(3), height
      integer :: k, first

      if (memory%used == 0) return
      force = 0.0_wp
      on_rail = 0.0_wp
      on_wheel = 0.0_wp
      height = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (slot%result%errors%reason /= "") return
            call slot%result%totals(patch)
            associate (value => slot%result%errors%value)
               local = [value(patch%place_of("fx")), value(patch%place_of("fy")), value(patch%place_of("fn"))]
               ! without relative motion there are no tangential forces and no errors of them
               where (.not. local >= 0.0_wp) local = 0.0_wp
               turned = matmul(abs(slot%plane%axes), local)
               force = force + turned
               local = [0.0_wp, 0.0_wp, value(patch%place_of("mz"))]
               where (.not. local >= 0.0_wp) local = 0.0_wp
               spin = matmul(abs(slot%plane%axes), local)
               on_rail = on_rail + spin + with_lever(slot%plane%origin - memory%geometry%placement%rail%origin, turned)
               on_wheel = on_wheel + spin + with_lever(slot%plane%origin - memory%geometry%placement%wheel%origin, turned)
               if (problem%force_prescribed) height = max(height, value(patch%place_of("pen"))/abs(slot%plane%axes(3, 3)))
            end associate
         end associate
      end do
      call result%totals(problem%spec, pair)
      first = pair%place_of("fx_tr")
      result%errors(first:first + 1) = force(1:2)
      if (.not. problem%force_prescribed) result%errors(first + 2) = force(3)
      first = pair%place_of("fx_ws")
      result%errors(first:first + 2) = matmul(abs(transpose(memory%geometry%placement%wheelset%axes)), force)
      first = pair%place_of("mx_r_tr")
      result%errors(first:first + 2) = on_rail
      first = pair%place_of("mx_w_ws")
      result%errors(first:first + 2) = matmul(abs(transpose(memory%geometry%placement%wheelset%axes)), on_wheel)
      if (problem%force_prescribed) result%errors(pair%place_of("z_ws")) = height
   end subroutine add_up

   !> Maximum moment of errors of forces with unknown signs [N mm]
   pure function with_lever(lever, force) result(moment)
      !> Position relative to the reference of the moment [mm]
      real(wp), intent(in) :: lever(3)
      !> Errors of the force components, not negative [N]
      real(wp), intent(in) :: force(3)
      real(wp) :: moment(3)

      moment = abs(cshift(lever, 1))*cshift(force, 2) + abs(cshift(lever, 2))*cshift(force, 1)
   end function with_lever
end module contact_wheelrail_error_estimate
