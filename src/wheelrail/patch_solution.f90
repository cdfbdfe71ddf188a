!> Solution of one patch of a pair, and its forces on the rail
module contact_wheelrail_patch_solution
   use contact_base_choices, only : estimate_choice, motion, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_patch_time_steps, only : link_time_steps
   use contact_patch_problem, only : traction_fields
   use contact_patch_solve, only : solve_patch
   use contact_wheelrail_carry_over, only : carried_step, max_patches
   use contact_wheelrail_curved_patch, only : curved_forces
   use contact_wheelrail_geometry, only : learned_share, wheel_rail_geometry
   use contact_wheelrail_memory, only : patch_slot
   use contact_wheelrail_patch_inputs, only : set_up_patch
   use contact_wheelrail_problem, only : wheel_rail_problem
   implicit none (type, external)
   private

   public :: solve_slot, find_forces

contains

   !> Problem and solution of one patch
   subroutine solve_slot(problem, geometry, number, slot, with_friction, log, error)
      !> What is asked for wheel and rail
      type(wheel_rail_problem), intent(in) :: problem
      !> Where the bodies are, and what is known of friction
      type(wheel_rail_geometry), intent(inout) :: geometry
      !> Number of the patch
      integer, intent(in) :: number
      !> Its region on entry; gets problem, solution and forces
      type(patch_slot), intent(inout) :: slot
      !> Solve the tangential problem, too? It is solved in any case for a patch of which nothing is known while something
      !> is known of others
      logical, intent(in) :: with_friction
      !> Takes the trace of the solvers
      type(log_type), intent(inout) :: log
      !> Allocated when the patch has no result
      type(error_type), allocatable, intent(out) :: error
      logical :: is_new, has_friction

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

      call link_slot(geometry%before, number, slot, error)
      if (allocated(error)) return
      if (geometry%coarser > 1) then
         if (.not. allocated(slot%coarse_workspace)) allocate(slot%coarse_workspace)
         call solve_patch(slot%problem, slot%state, slot%coarse_workspace, log, slot%result, error)
      else
         call solve_patch(slot%problem, slot%state, slot%workspace, log, slot%result, error)
      end if
      if (allocated(error)) return
      call find_forces(slot)
      if (has_friction .and. problem%template%motion /= motion%none .and. slot%result%fn > 0.0_wp) then
         slot%friction_share = (slot%force - slot%pressure_force)/slot%result%fn
         if (is_new) call add_share(geometry, slot)
      end if
   end subroutine solve_slot

   !> Forces and moments of a solved patch in the axes of its plane
   subroutine find_forces(slot)
      !> Solved
      type(patch_slot), intent(inout) :: slot

      if (allocated(slot%curve)) then
         call curved_forces(slot%curve, slot%plane, slot%result, slot%pressure_force, slot%force, slot%moment)
      else
         slot%pressure_force = [0.0_wp, 0.0_wp, slot%result%fn]
         slot%force = [slot%result%fx, slot%result%fy, slot%result%fn]
         slot%moment = [slot%result%mx, slot%result%my, slot%result%mz]
      end if
   end subroutine find_forces

   !> Does the patch continue one whose friction is known? Each of these is continued by one patch; a patch that took the
   !> place of two of them is a new one
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

   !> Learn the friction of a patch, in place of what was known of places within its bounds
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

   !> Estimate and previous time step on the window of this solution
   !>
   !> Within a case, and from a previous case when asked for, the last solution is the estimate. The
   !> previous time step is that of the previous case in every solution of this one.
   subroutine link_slot(before, number, slot, error)
      type(carried_step), intent(in) :: before
      !> Number of the patch
      integer, intent(in) :: number
      type(patch_slot), intent(inout) :: slot
      type(error_type), allocatable, intent(out) :: error
      type(traction_fields) :: estimate
      logical :: continues, transient

      associate (problem => slot%problem, state => slot%state)
         transient = problem%motion == motion%shift .or. problem%motion == motion%transient_rolling
         ! what follows from formulas does not start from anything
         continues = state%started .and. problem%iterates() .and. same_elements(slot)
         if (continues) then
            ! the window of the last solution, seen from the reference of this one
            state%now%grid%xl = problem%grid%xl + (slot%solved_window%first(1) - slot%window%first(1))*problem%grid%dx
            state%now%grid%yl = problem%grid%yl + (slot%solved_window%first(2) - slot%window%first(2))*problem%grid%dy
         end if
         slot%solved_window = slot%window
         problem%estimate = merge(estimate_choice%previous, estimate_choice%fresh, continues)
         state%started = continues
         call link_time_steps(problem, time_link%initiate, state, error)
         if (allocated(error)) return
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

   !> Were the elements of the last solution of the same size?
   pure logical function same_elements(slot)
      type(patch_slot), intent(in) :: slot
      real(wp), parameter :: same = 1.0e-6_wp

      associate (old => slot%state%now%grid, new => slot%problem%grid)
         same_elements = abs(old%dx - new%dx) < same*new%dx .and. abs(old%dy - new%dy) < same*new%dy
      end associate
   end function same_elements

   !> Force of friction relative to the normal force at a place: learned nearby, or that of full sliding down the slope
   !>
   !> Weights by the inverse square of the distance make it a smooth function of the place: patches that move while the
   !> height is searched leave no jump in the force.
   pure function share_at(problem, geometry, slot) result(share)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(in) :: geometry
      type(patch_slot), intent(in) :: slot
      real(wp) :: share(3)
      !> Weight of the first estimate; what was learned weighs 1 halfway to where it ends
      real(wp), parameter :: first_weight = 0.01_wp
      !> Smallest relative distance that weights are made of: at the same place only what was learned there counts
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
