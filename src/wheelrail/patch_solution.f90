!> Solution of one patch of wheel and rail, and its forces on the rail
module contact_wheelrail_patch_solution
   use contact_base_choices, only : estimate_choice, motion, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_patch_time_steps, only : link_time_steps
   use contact_patch_extrapolation, only : extrapolate
   use contact_patch_problem, only : traction_fields
   use contact_patch_relative_tractions, only : divide_by_pressures, multiply_by_pressures
   use contact_patch_small_step, only : can_step
   use contact_patch_solve, only : solve_patch
   use contact_wheelrail_carry_over, only : carried_step, max_patches
   use contact_wheelrail_curved_patch, only : curved_forces
   use contact_wheelrail_geometry, only : learned_share, wheel_rail_geometry
   use contact_wheelrail_memory, only : make_coarse_workspace, patch_slot, wheel_rail_memory
   use contact_wheelrail_patch_inputs, only : set_up_patch
   use contact_wheelrail_problem, only : wheel_rail_problem
   implicit none (type, external)
   private

   public :: can_skip_tractions, can_step_all, solve_slot, find_forces, update_share

contains

   !> Problem and solution of one patch
   subroutine solve_slot(problem, geometry, number, slot, with_friction, log, error)
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Positions of the bodies, and friction ratios found so far
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Index of the patch
      integer, intent(in) :: number
      !> Region of the patch on entry; problem, solution and forces are set
      type(patch_slot), intent(inout) :: slot
      !> Is the tangential problem solved? It is solved in any case for a patch without known friction ratio if the ratios of others
      !> are known
      logical, intent(in) :: with_friction
      !> Receives the trace of the solvers
      type(log_type), intent(inout) :: log
      !> Allocated if the patch has no result
      type(error_type), allocatable, intent(out) :: error
      logical :: is_new, has_friction, keeps_tractions
      real(wp), allocatable :: ratio(:, :, :)

      call set_up_patch(problem, geometry, number, slot, error)
      if (allocated(error)) return
      is_new = .false.
      if (.not. with_friction .and. problem%template%motion /= motion%none .and. geometry%shares > 0) &
         & call find_share(geometry, slot, is_new)
      has_friction = with_friction .or. is_new
      if (.not. has_friction) slot%problem%motion = motion%none
      slot%problem%defers_displacements = .true.
      slot%friction_share = share_at(problem, geometry, slot)
      if (problem%geometry_only) return

      call link_slot(geometry%before, number, geometry%is_first, geometry%ahead, slot, error)
      if (allocated(error)) return
      keeps_tractions = geometry%keeps_tractions .and. .not. has_friction .and. slot%state%started
      if (keeps_tractions) then
         allocate(ratio(size(slot%state%now%pn, 1), size(slot%state%now%pn, 2), 2))
         ratio(:, :, 1) = slot%state%now%px
         ratio(:, :, 2) = slot%state%now%py
         call divide_by_pressures(slot%state%now%pn, ratio(:, :, 1), ratio(:, :, 2))
      end if
      if (geometry%coarser > 1) then
         call make_coarse_workspace(slot)
         call solve_patch(slot%problem, slot%state, slot%coarse_workspace, log, slot%result, error)
      else
         call solve_patch(slot%problem, slot%state, slot%workspace, log, slot%result, error)
      end if
      if (allocated(error)) return
      call find_forces(slot)
      if (keeps_tractions) call estimate_tractions(ratio, geometry%ahead, slot)
      if (has_friction .and. problem%template%motion /= motion%none .and. slot%result%fn > 0.0_wp) then
         call update_share(slot)
         if (is_new) call add_share(geometry, slot)
      end if
      if (.not. with_friction) slot%shares%estimate = slot%friction_share
   end subroutine solve_slot

   !> Estimate the tractions of a patch whose normal problem is solved, and the ratio of friction to the normal force
   pure subroutine estimate_tractions(ratio, ahead, slot)
      !> Tractions relative to the pressures [-], x and y, shape (mx, my, 2)
      real(wp), intent(in) :: ratio(:, :, :)
      !> See wheel_rail_geometry
      real(wp), intent(in) :: ahead
      type(patch_slot), intent(inout) :: slot

      slot%state%now%px = ratio(:, :, 1)
      slot%state%now%py = ratio(:, :, 2)
      call multiply_by_pressures(slot%state%now%pn, slot%state%now%px, slot%state%now%py)
      ! more accurate than the sum of these tractions
      call slot%shares%extrapolate(ahead, slot%friction_share)
   end subroutine estimate_tractions

   !> Ratio of tangential to normal force of a patch whose tangential problem is solved, for the total forces
   pure subroutine update_share(slot)
      !> With its forces, see `find_forces`
      type(patch_slot), intent(inout) :: slot

      if (slot%result%fn > 0.0_wp) slot%friction_share = (slot%force - slot%pressure_force)/slot%result%fn
   end subroutine update_share

   !> Forces and moments of a solved patch in the axes of its plane
   subroutine find_forces(slot)
      !> Solved patch
      type(patch_slot), intent(inout) :: slot

      if (allocated(slot%curve)) then
         call curved_forces(slot%curve, slot%plane, slot%result, slot%pressure_force, slot%force, slot%moment)
      else
         slot%pressure_force = [0.0_wp, 0.0_wp, slot%result%fn]
         slot%force = [slot%result%fx, slot%result%fy, slot%result%fn]
         slot%moment = [slot%result%mx, slot%result%my, slot%result%mz]
      end if
   end subroutine find_forces

   !> Find the nearest known friction ratio: each one is used by one patch; a patch is new if there is none, or if it replaces two
   !> of them
   subroutine find_share(geometry, slot, is_new)
      type(wheel_rail_geometry), intent(inout) :: geometry
      type(patch_slot), intent(in) :: slot
      logical, intent(out) :: is_new
      real(wp) :: distance, smallest
      integer :: k, nearest, inside

      nearest = 0
      inside = 0
      smallest = 1.0_wp
      do k = 1, geometry%shares
         associate (known => geometry%learned(k))
            if (known%y >= slot%region%box%y(1) .and. known%y <= slot%region%box%y(2)) inside = inside + 1
            distance = known%distance_to(slot%plane%origin(2), slot%plane%roll())
            if (known%is_taken .or. distance >= smallest) cycle
            smallest = distance
            nearest = k
         end associate
      end do
      is_new = nearest == 0 .or. inside > 1
      if (nearest > 0) geometry%learned(nearest)%is_taken = .true.
   end subroutine find_share

   !> Store the friction ratio of a patch, instead of those at positions within its bounds
   subroutine add_share(geometry, slot)
      type(wheel_rail_geometry), intent(inout) :: geometry
      type(patch_slot), intent(in) :: slot
      integer :: k, kept

      kept = 0
      do k = 1, geometry%shares
         associate (known => geometry%learned(k))
            if (known%y >= slot%region%box%y(1) .and. known%y <= slot%region%box%y(2)) cycle
            kept = kept + 1
            geometry%learned(kept) = known
         end associate
      end do
      if (kept == max_patches) then
         geometry%learned(:kept - 1) = geometry%learned(2:kept)
         kept = kept - 1
      end if
      geometry%shares = kept + 1
      geometry%learned(geometry%shares) = learned_share(slot%plane%origin(2), slot%plane%roll(), slot%friction_share, &
         & is_taken=.true.)
   end subroutine add_share

   !> Estimate and previous time step on the grid of this solution
   !>
   !> The last solution is the estimate, within a case, and from the previous case if requested. The previous time step is that of
   !> the previous case in every solution of this one.
   subroutine link_slot(before, number, is_first, ahead, slot, error)
      type(carried_step), intent(in) :: before
      !> Index of the patch
      integer, intent(in) :: number
      !> See wheel_rail_geometry
      logical, intent(in) :: is_first
      real(wp), intent(in) :: ahead
      type(patch_slot), intent(inout) :: slot
      type(error_type), allocatable, intent(out) :: error
      type(traction_fields) :: estimate
      logical :: continues, transient

      associate (problem => slot%problem, state => slot%state)
         transient = problem%motion == motion%shift .or. problem%motion == motion%transient_rolling
         ! without iterations no estimate is needed
         continues = state%started .and. problem%iterates() .and. same_elements(slot)
         if (continues) then
            ! grid of the last solution, in coordinates of the reference of this one
            state%now%grid%xl = problem%grid%xl + (slot%solved_window%first(1) - slot%window%first(1))*problem%grid%dx
            state%now%grid%yl = problem%grid%yl + (slot%solved_window%first(2) - slot%window%first(2))*problem%grid%dy
         end if
         slot%solved_window = slot%window
         problem%estimate = merge(estimate_choice%previous, estimate_choice%fresh, continues)
         state%started = continues
         call link_time_steps(problem, time_link%initiate, state, error)
         if (allocated(error)) return
         if (.not. continues .or. transient) then
            state%earlier%grid%mx = 0
         else if (is_first) then
            call extrapolate(state, ahead)
         end if
         if (transient) then
            estimate = state%now
            call before%hand_over(number, problem, slot%window, state%now)
            state%started = .true.
            call link_time_steps(problem, time_link%continue_all, state, error)
            if (allocated(error)) return
            state%now%division = estimate%division
            state%now%pn = estimate%pn
            state%now%px = estimate%px
            state%now%py = estimate%py
            state%now%pen = estimate%pen
            if (allocated(estimate%rate)) state%now%rate = estimate%rate
         else if (size(slot%previous) > 0) then
            state%before%is_solved = .true.
            state%before%force = before%total_force(number)
         end if
      end associate
   end subroutine link_slot

   !> May a trial that only gives the next height have estimated tractions?
   !>
   !> Those of steady rolling, extrapolated from the last cases: their error is smaller than the deviations of such trials.
   pure logical function can_skip_tractions(problem, memory)
      !> The problem of wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> The geometry says whether the case follows the last one
      type(wheel_rail_memory), intent(in) :: memory

      can_skip_tractions = memory%geometry%follows_last .and. problem%template%motion == motion%steady_rolling &
         & .and. .not. problem%template%model%coupled()
   end function can_skip_tractions

   !> Do all patches allow a linear extrapolation?
   pure logical function can_step_all(memory)
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      can_step_all = .true.
      do k = 1, memory%used
         can_step_all = can_step_all .and. can_step(memory%slot(k)%problem, memory%slot(k)%state)
      end do
   end function can_step_all

   !> Did the last solution have elements of the same size?
   pure logical function same_elements(slot)
      type(patch_slot), intent(in) :: slot
      real(wp), parameter :: same = 1.0e-6_wp

      associate (old => slot%state%now%grid, new => slot%problem%grid)
         same_elements = abs(old%dx - new%dx) < same*new%dx .and. abs(old%dy - new%dy) < same*new%dy
      end associate
   end function same_elements

   !> Ratio of tangential to normal force at a position: known ratios nearby, combined with that of full sliding down the slope
   !>
   !> The weights decrease with the inverse square of the distance and make it a smooth function of the position: the motion of
   !> patches during a height search does not cause jumps of the force.
   pure function share_at(problem, geometry, slot) result(share)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      type(patch_slot), intent(in) :: slot
      real(wp) :: share(3)
      !> Weight of the ratio of full sliding; known ratios have weight 1 at half their range
      real(wp), parameter :: first_weight = 0.01_wp
      !> Lower bound of relative distances in the weights: at the same position only the known ratio counts
      real(wp), parameter :: same_place = 1.0e-6_wp
      integer :: k
      real(wp) :: mu, weight, total, distance

      share = 0.0_wp
      if (problem%template%motion == motion%none) return
      mu = slot%problem%mu
      if (allocated(slot%problem%static_mu)) mu = sum(slot%problem%static_mu)/size(slot%problem%static_mu)
      total = first_weight
      share(2) = total*mu*sin(slot%plane%roll())
      do k = 1, geometry%shares
         associate (known => geometry%learned(k))
            distance = known%distance_to(slot%plane%origin(2), slot%plane%roll())
            weight = (max(0.0_wp, 1.0_wp - distance)/max(distance, same_place))**2
            share = share + weight*known%share
            total = total + weight
         end associate
      end do
      share = share/total
   end function share_at
end module contact_wheelrail_patch_solution
