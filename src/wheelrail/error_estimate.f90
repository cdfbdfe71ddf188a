!> Estimated errors of wheel and rail: errors of the patches, and their effect on forces and height
!>
!> The coarse level of each patch has the same approach as the fine one. If the vertical force is prescribed, the height at which
!> the coarse patches together carry it is different; the difference is determined by the stiffness of all patches, and is itself
!> the difference of the heights on both levels. Details of the profiles between rows of elements are included, and their effect on
!> the angles of patches, see contact_wheelrail_section_distance; other errors of profiles and positions of patches are not.
module contact_wheelrail_error_estimate
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_quiet_nan, ieee_value
   use contact_base_choices, only : force_control, motion, time_link
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_patch_between_rows, only : section_details
   use contact_patch_error_estimate, only : add_error_of_load, compare_levels, normal_stiffness, solve_coarse_level
   use contact_patch_error_scales, only : rows_error
   use contact_patch_finer_rows, only : find_errors_of_rows
   use contact_patch_order, only : order_of_errors
   use contact_patch_quantities, only : total_list
   use contact_patch_traction_errors, only : growth_of_force
   use contact_wheelrail_carry_over, only : max_patches
   use contact_wheelrail_memory, only : make_coarse_level, patch_slot, total_force, wheel_rail_memory
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_section_distance, only : find_details
   implicit none (type, external)
   private

   public :: estimate_wheel_rail_errors

   !> Vertical error of the place of a patch over the error of its approach: the mesh of the search and the profiles; measured with
   !> sliding wheels (seed 62001)
   real(wp), parameter :: misplaced = 1.75_wp

   !> Errors of the forces and moments of wheel and rail, in track coordinates
   type :: pair_error
      !> Of the force on the rail [N], and of the moments about the reference of the rail and of the wheel [N mm]
      real(wp), dimension(3) :: force = 0.0_wp, on_rail = 0.0_wp, on_wheel = 0.0_wp
      !> Of the normal forces by errors of friction and of angles, as the vertical force is prescribed; relative [-]
      real(wp) :: load(max_patches) = 0.0_wp
      !> Of the creepages by the pitch rate, as the longitudinal force is prescribed; relative [-]
      real(wp) :: creepage(max_patches) = 0.0_wp
      !> Of the tangential force of the first patch, along x and y of its plane [N]
      real(wp) :: friction(2) = 0.0_wp
   contains
      !> Add an independent error
      procedure :: add
   end type pair_error

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
      type(section_details) :: details(max_patches)
      !> Errors of the angles of the patches [rad]
      real(wp) :: turn(max_patches)
      type(rows_error) :: rows
      logical :: has_history
      integer :: k

      result%errors = error_values(result, problem)
      has_history = problem%link /= time_link%initiate .and. (problem%template%motion == motion%shift &
         & .or. problem%template%motion == motion%transient_rolling)
      missing = 0.0_wp
      stiffness = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            call make_coarse_level(slot)
            slot%coarse%state%started = .false.
            call solve_coarse_level(slot%problem, slot%state, problem%link, slot%coarse, slot%result, error)
            if (allocated(error)) return
            if (has_history) slot%result%errors%reason = &
               & "transient cases of wheel and rail have no history on a coarser level"
            if (slot%result%errors%reason /= "") cycle
            missing = missing + vertical(slot, slot%result%fn) - vertical(slot, slot%coarse%result%fn)
            stiffness = stiffness + stiffness_of(slot)
         end associate
      end do
      change = 0.0_wp
      if (problem%force_prescribed .and. stiffness > 0.0_wp) change = missing/stiffness
      call find_details(problem, memory, details, turn)
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (slot%result%errors%reason /= "") cycle
            if (.not. allocated(details(k)%h)) allocate(details(k)%h(0))
            call find_errors_of_rows(slot%problem, slot%state, slot%coarse, slot%result, details(k)%column, details(k)%h, &
               & slot%rows, rows, error)
            if (allocated(error)) return
            if (problem%force_prescribed) then
               call compare_levels(slot%problem, order_of_errors(slot%result%tangential), slot%coarse, slot%result, &
                  & change*slot%plane%axes(3, 3), details=details(k), rows=rows)
            else
               call compare_levels(slot%problem, order_of_errors(slot%result%tangential), slot%coarse, slot%result, &
                  & details=details(k), rows=rows)
            end if
         end associate
      end do
      call add_up(problem, memory, turn, result)
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

   !> Derivative of the vertical force of a patch with respect to the height [N/mm]
   pure real(wp) function stiffness_of(slot) result(stiffness)
      type(patch_slot), intent(in) :: slot

      stiffness = slot%plane%axes(3, 3)*vertical(slot, normal_stiffness(slot%result))
   end function stiffness_of

   !> Errors of forces and moments of all patches
   subroutine add_up(problem, memory, turn, result)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      !> Errors of the angles of the patches [rad]
      real(wp), intent(in) :: turn(:)
      type(wheel_rail_result), intent(inout) :: result
      type(total_list) :: pair, patch
      type(pair_error) :: e
      real(wp), parameter :: none(3) = 0.0_wp
      real(wp) :: local(3), moment(3), spin, height, stiffness, total
      integer :: k, i, first

      if (memory%used == 0) return
      height = 0.0_wp
      total = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            if (slot%result%errors%reason /= "") return
            call slot%result%totals(patch)
            associate (value => slot%result%errors%value)
               local = [value(patch%place_of("fx")), value(patch%place_of("fy")), value(patch%place_of("fn"))]
               spin = value(patch%place_of("mz"))
               if (slot%result%errors%has_turned) then
                  call add_turned_force(problem, memory, k, e)
                  local(1:2) = 0.0_wp
               end if
               ! without relative motion there are no tangential forces and no errors of them
               do i = 1, 3
                  if (.not. ieee_is_nan(local(i))) call add_force(problem, memory, k, i, local(i), e)
               end do
               if (ieee_is_nan(spin)) spin = 0.0_wp
               moment = spin*slot%plane%axes(:, 3)
               call e%add(problem%force_prescribed, none, moment, moment)
               if (abs(turn(k)) > 0.0_wp) call add_turn(problem, memory, k, turn(k), e)
               call add_place(problem, memory, k, value(patch%place_of("pen")), e)
               ! the height follows from the approaches of all patches, each weighted with its stiffness
               stiffness = stiffness_of(slot)
               total = total + stiffness
               height = height + stiffness*value(patch%place_of("pen"))/abs(slot%plane%axes(3, 3))
               local = turned_force(slot, turn(k))
               height = height + abs(local(3))
            end associate
         end associate
      end do
      do k = 1, memory%used
         associate (result => memory%slot(k)%result)
            if (e%load(k) > 0.0_wp) call add_error_of_load(e%load(k), result)
            call result%totals(patch)
            associate (power => result%errors%value(patch%place_of("friction_power")))
               power = hypot(power, e%creepage(k)*result%friction_power)
            end associate
         end associate
      end do
      call result%totals(problem%spec, pair)
      first = pair%place_of("fx_tr")
      result%errors(first:first + 1) = e%force(1:2)
      if (.not. problem%force_prescribed) result%errors(first + 2) = e%force(3)
      first = pair%place_of("fx_ws")
      result%errors(first:first + 2) = matmul(abs(transpose(memory%geometry%placement%wheelset%axes)), e%force)
      if (keeps_longitudinal_force(problem)) then
         result%errors(first) = ieee_value(height, ieee_quiet_nan)
         associate (along => result%errors(pair%place_of("fx_tr")))
            along = along + abs(problem%spec%wheelset%fx &
               & - dot_product(total_force(memory), memory%geometry%placement%wheelset%axes(:, 1)))
         end associate
         ! the error of FX of a single patch follows from that of FY
         if (memory%used == 1) then
            associate (value => memory%slot(1)%result%errors%value)
               value(patch%place_of("fx"):patch%place_of("fy")) = e%friction
            end associate
         end if
      end if
      first = pair%place_of("mx_r_tr")
      result%errors(first:first + 2) = e%on_rail
      first = pair%place_of("mx_w_ws")
      result%errors(first:first + 2) = matmul(abs(transpose(memory%geometry%placement%wheelset%axes)), e%on_wheel)
      if (problem%force_prescribed .and. total > 0.0_wp) result%errors(pair%place_of("z_ws")) = height/total
   end subroutine add_up

   !> Is the longitudinal force prescribed, so that errors change the pitch rate instead?
   pure logical function keeps_longitudinal_force(problem) result(keeps)
      type(wheel_rail_problem), intent(in) :: problem

      keeps = problem%force == force_control%longitudinal_force
   end function keeps_longitudinal_force

   !> Change of the force on the rail if a patch turns about the track's direction [N]
   pure function turned_force(slot, turn) result(change)
      type(patch_slot), intent(in) :: slot
      !> Angle [rad]
      real(wp), intent(in) :: turn
      real(wp) :: change(3)

      change = cross([turn, 0.0_wp, 0.0_wp], matmul(slot%plane%axes, slot%force))
   end function turned_force

   !> Add the effect of an error of the angle of a patch
   pure subroutine add_turn(problem, memory, k, turn, e)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      !> Patch, and error [rad]
      integer, intent(in) :: k
      real(wp), intent(in) :: turn
      type(pair_error), intent(inout) :: e
      real(wp) :: change(3, memory%used)

      change = 0.0_wp
      change(:, k) = turned_force(memory%slot(k), turn)
      call add_change(problem, memory, change, .true., e)
   end subroutine add_turn

   !> Add the effect of an error of one force of a patch
   pure subroutine add_force(problem, memory, k, component, error, e)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      !> Patch; component of its force: 1, 2 tangential, 3 normal
      integer, intent(in) :: k, component
      !> Error of this component [N]
      real(wp), intent(in) :: error
      type(pair_error), intent(inout) :: e
      real(wp) :: change(3, memory%used)

      change = 0.0_wp
      associate (slot => memory%slot(k))
         change(:, k) = error*slot%plane%axes(:, component)
         ! friction changes in proportion to the normal force
         if (problem%force_prescribed .and. component == 3 .and. slot%result%fn > 0.0_wp) &
            & change(:, k) = error*matmul(slot%plane%axes, slot%force/slot%result%fn)
      end associate
      call add_change(problem, memory, change, component /= 3, e)
   end subroutine add_force

   !> Add the effect of the errors of the force of a patch that slides, across and along it
   pure subroutine add_turned_force(problem, memory, k, e)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      !> Patch
      integer, intent(in) :: k
      type(pair_error), intent(inout) :: e
      real(wp) :: change(3, memory%used), along(2)

      associate (slot => memory%slot(k))
         along = slot%force(1:2)/max(norm2(slot%force(1:2)), tiny(along))
         change = 0.0_wp
         change(:, k) = slot%result%errors%turned*matmul(slot%plane%axes(:, 1:2), [-along(2), along(1)])
         call add_change(problem, memory, change, .true., e)
         change = 0.0_wp
         change(:, k) = slot%result%errors%shortened*matmul(slot%plane%axes(:, 1:2), along)
         call add_change(problem, memory, change, .true., e)
      end associate
   end subroutine add_turned_force

   !> Add the effect of an error of the place of a patch, by which its rolling radius and creepage change
   subroutine add_place(problem, memory, k, approach, e)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      !> Patch
      integer, intent(in) :: k
      !> Error of its approach [mm]; NaN: not known
      real(wp), intent(in) :: approach
      type(pair_error), intent(inout) :: e
      real(wp) :: change(3, memory%used)

      if (ieee_is_nan(approach)) return
      change = 0.0_wp
      change(:, k) = misplaced*approach/memory%geometry%placement%wheel_radius*change_by_pitch(memory%slot(k))
      call add_change(problem, memory, change, .true., e)
   end subroutine add_place

   !> Change of the force of a patch with the longitudinal creepage [N]
   !>
   !> Force and creepage have the same direction by the theory of Vermeulen and Johnson. In full sliding the force turns only.
   pure function change_by_pitch(slot) result(change)
      type(patch_slot), intent(in) :: slot
      real(wp) :: change(3), along(2), friction, growth

      change = 0.0_wp
      friction = norm2(slot%force(1:2))
      if (.not. (friction > 0.0_wp .and. slot%result%fn > 0.0_wp)) return
      along = slot%force(1:2)/friction
      growth = 0.0_wp
      if (.not. slot%result%errors%has_turned) &
         & growth = growth_of_force(min(1.0_wp, friction/(slot%result%mu_scal*slot%result%fn)))
      change = matmul(slot%plane%axes(:, 1:2), growth*along(1)*along + along(2)*[along(2), -along(1)])*friction/creep_of(slot)
   end function change_by_pitch

   !> Size of the creepages, with that of the spin at the radius of the contact area [-]
   pure real(wp) function creep_of(slot) result(creep)
      type(patch_slot), intent(in) :: slot

      associate (result => slot%result)
         creep = max(sqrt(result%cksi**2 + result%ceta**2 + result%cphi**2*result%contact_area()/pi), tiny(creep))
      end associate
   end function creep_of

   !> Add the effect of errors of the forces of patches. If the vertical force is prescribed, the height changes until all patches
   !> carry it again, so that other patches are loaded or unloaded; a single patch keeps its normal force but for the vertical
   !> part of friction. If the longitudinal force is prescribed, the pitch rate changes until it is reached
   pure subroutine add_change(problem, memory, error, loads, e)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      !> Errors of the forces on the rail [N], shape (3, patches)
      real(wp), intent(in) :: error(:, :)
      !> Do changes of the normal forces count? Errors of normal forces include them
      logical, intent(in) :: loads
      type(pair_error), intent(inout) :: e
      real(wp), dimension(3, memory%used) :: change, per_height, per_pitch
      real(wp), dimension(3) :: force, on_rail, on_wheel
      real(wp) :: height, pitch
      integer :: m

      change = error
      if (problem%force_prescribed) then
         do m = 1, memory%used
            associate (slot => memory%slot(m))
               per_height(:, m) = 0.0_wp
               if (.not. slot%result%fn > 0.0_wp) cycle
               per_height(:, m) = normal_stiffness(slot%result)*slot%plane%axes(3, 3) &
                  & *matmul(slot%plane%axes, slot%force/slot%result%fn)
            end associate
         end do
         height = 0.0_wp
         if (sum(per_height(3, :)) > 0.0_wp) height = -sum(change(3, :))/sum(per_height(3, :))
         change = change + height*per_height
         do m = 1, memory%used
            associate (slot => memory%slot(m))
               if (loads .and. slot%result%fn > 0.0_wp) e%load(m) = hypot(e%load(m), &
                  & height*normal_stiffness(slot%result)*slot%plane%axes(3, 3)/slot%result%fn)
            end associate
         end do
      end if
      if (keeps_longitudinal_force(problem)) then
         do m = 1, memory%used
            per_pitch(:, m) = change_by_pitch(memory%slot(m))
         end do
         associate (along => memory%geometry%placement%wheelset%axes(:, 1))
            pitch = dot_product(along, sum(per_pitch, dim=2))
            if (abs(pitch) > 0.0_wp) then
               pitch = dot_product(along, sum(change, dim=2))/pitch
               change = change - pitch*per_pitch
               do m = 1, memory%used
                  e%creepage(m) = hypot(e%creepage(m), pitch/creep_of(memory%slot(m)))
               end do
            end if
         end associate
      end if
      e%friction = hypot(e%friction, matmul(change(:, 1), memory%slot(1)%plane%axes(:, 1:2)))
      on_rail = 0.0_wp
      on_wheel = 0.0_wp
      do m = 1, memory%used
         force = change(:, m)
         associate (origin => memory%slot(m)%plane%origin, placement => memory%geometry%placement)
            on_rail = on_rail + cross(origin - placement%rail%origin, force)
            on_wheel = on_wheel + cross(origin - placement%wheel%origin, force)
         end associate
      end do
      force = sum(change, dim=2)
      call e%add(problem%force_prescribed, force, on_rail, on_wheel)
   end subroutine add_change

   !> Add an independent error
   pure subroutine add(self, in_balance, force, on_rail, on_wheel)
      class(pair_error), intent(inout) :: self
      !> Is the vertical force prescribed? Otherwise errors of the normal forces of all patches have the same sign, and absolute
      !> values are added
      logical, intent(in) :: in_balance
      !> Effect on the force [N], and on the moments [N mm]
      real(wp), intent(in) :: force(3), on_rail(3), on_wheel(3)

      if (in_balance) then
         self%force = hypot(self%force, force)
         self%on_rail = hypot(self%on_rail, on_rail)
         self%on_wheel = hypot(self%on_wheel, on_wheel)
      else
         self%force = self%force + abs(force)
         self%on_rail = self%on_rail + abs(on_rail)
         self%on_wheel = self%on_wheel + abs(on_wheel)
      end if
   end subroutine add

   !> Vector product
   pure function cross(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)

      c = cshift(a, 1)*cshift(b, 2) - cshift(a, 2)*cshift(b, 1)
   end function cross
end module contact_wheelrail_error_estimate
