!> Pitch rate of a wheelset whose longitudinal force is prescribed
module contact_wheelrail_pitch_rate
   use contact_base_choices, only : motion
   use contact_base_constants, only : pi
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_element_division, only : element
   use contact_numeric_root_search, only : root_search
   use contact_patch_result, only : patch_result
   use contact_wheelrail_geometry, only : measure
   use contact_wheelrail_height, only : contact_reach, find_height, small_step
   use contact_wheelrail_memory, only : wheel_rail_memory, total_force
   use contact_wheelrail_problem, only : wheel_rail_problem, rate_of_pure_rolling
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: search_pitch_rate

   !> Minimum change of the creepage, relative to the slip, that shows whether the force can still increase [-]
   real(wp), parameter :: part_of_slip = 0.5_wp

   !> Factor of the first step relative to that by the slope, so that the root lies between the first two points
   real(wp), parameter :: beyond_slope = 1.1_wp
   !> Width of intervals of the pitch rate that are regarded as a point, relative to the rate of rolling
   real(wp), parameter :: fine_rate = 1.0e-10_wp
   !> Tangential stiffness of a circular contact of two equal bodies over G times its radius: 4/(2 - nu) by Mindlin (1949), 2.35 for
   !> steel
   real(wp), parameter :: tangential_stiffness = 2.5_wp

contains

   !> Find the pitch rate that gives the prescribed longitudinal force
   !>
   !> A wheel that turns faster about the axis to the right drives the rail forward. If all of the contact slides, the force is
   !> constant; the search ends there only if friction acts in the direction of the missing force, otherwise it has not reached the
   !> rate at which slip reverses.
   subroutine search_pitch_rate(problem, memory, z, log, result, error)
      !> Problem, with the prescribed longitudinal force
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches of the trials; on return those of the last one
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset [mm]
      real(wp), intent(out) :: z
      !> Receives a warning if no rate gives the force
      type(log_type), intent(inout) :: log
      !> Status, with whether the force was found
      type(wheel_rail_result), intent(inout) :: result
      !> Allocated if a trial has no result
      type(error_type), allocatable, intent(out) :: error
      type(root_search) :: search
      type(log_type) :: silent
      real(wp) :: slope, tolerance, residual, moving

      if (.not. (memory%started .and. (problem%use_previous .or. problem%refines))) call roll_at_contact(problem, memory)
      call find_height(problem, memory, z, silent, result, error)
      if (allocated(error)) return
      residual = missing()
      slope = force_per_pitch_rate(memory)
      tolerance = problem%template%settings%eps*max(abs(problem%spec%wheelset%fx), norm2(total_force(memory)))
      if (memory%used > 0 .and. slope > 0.0_wp) then
         call search%start(memory%geometry%pitch_rate, beyond_slope*abs(residual)/slope, tolerance)
         moving = maxval(memory%slot(:memory%used)%motion%veloc)/memory%geometry%placement%wheel_radius
         search%resolution = fine_rate*moving
         ! if spin gives slip of different directions, the force changes although all of the contact slides
         search%reach = part_of_slip*largest_slip(memory)*moving
         do
            call search%update(residual, slides_fully(memory) .and. friction_along(memory)*residual > 0.0_wp)
            if (search%finished) exit
            memory%geometry%pitch_rate = search%x
            call find_height(problem, memory, z, silent, result, error)
            if (allocated(error)) return
            residual = missing()
         end do
         memory%geometry%pitch_rate = search%best
      end if
      call find_height(problem, memory, z, log, result, error)
      if (allocated(error)) return
      residual = missing()
      if (abs(residual) <= max(tolerance, small_step*norm2(total_force(memory)))) return
      call result%status%record_missed_force("longitudinal force", problem%spec%wheelset%fx, problem%spec%wheelset%fx - residual, &
         & trim(reason()))
      call log%warning(result%status%reason)

   contains

      !> Reason why the force is not reached, padded with blanks
      character(len=56) function reason()
         if (memory%used == 0) then
            reason = "it needs contact, and there is none"
         else if (search%bracketed) then
            reason = "the force jumps over it"
         else
            reason = "the whole contact slides, friction cannot do more"
         end if
      end function reason

      !> Missing longitudinal force, in wheelset axes [N]
      real(wp) function missing()
         missing = problem%spec%wheelset%fx - dot_product(total_force(memory), memory%geometry%placement%wheelset%axes(:, 1))
      end function missing
   end subroutine search_pitch_rate

   !> Initial rate, at which the circumferential velocity of the wheel equals that of the rail at the point of first touch
   subroutine roll_at_contact(problem, memory)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      real(wp) :: on_wheel(3), z, radius, on_roller
      integer :: i

      z = merge(memory%z_ws, 0.0_wp, memory%started .and. problem%use_previous)
      call measure(problem, memory%geometry, z)
      if (memory%geometry%touch - z > contact_reach) return
      associate (gap => memory%geometry%gap, placement => memory%geometry%placement)
         i = minloc(gap%gap, dim=1)
         on_wheel = placement%wheel%to_local([gap%x(i), gap%y(i), gap%z(i) + placement%roller_drop(gap%x(i), gap%z(i)) &
            & - gap%gap(i)])
         radius = (placement%wheel_radius + on_wheel(3))/problem%spec%wheelset%nomradw
         on_roller = 1.0_wp
         if (problem%spec%roller) on_roller = 1.0_wp - gap%z(i)/placement%roller_radius
         if (radius > 0.0_wp .and. on_roller > 0.0_wp) &
            & memory%geometry%pitch_rate = rate_of_pure_rolling(problem)*on_roller/radius
      end associate
   end subroutine roll_at_contact

   !> Radius of a circle with the area of contact [mm]
   pure real(wp) function contact_radius(contact)
      type(patch_result), intent(in) :: contact

      contact_radius = sqrt(contact%ncon*contact%grid%dx*contact%grid%dy/pi)
   end function contact_radius

   !> Order of magnitude of the derivative of the longitudinal force with respect to the pitch rate, without slip [N s/rad]
   !>
   !> The stiffness of a contact area pi a**2 is 2.5 G a; the rigid displacement is that of a shift, of a step of transient rolling,
   !> or of rolling over the length a.
   real(wp) function force_per_pitch_rate(memory) result(slope)
      type(wheel_rail_memory), intent(in) :: memory
      real(wp) :: a, length
      integer :: k

      slope = 0.0_wp
      do k = 1, memory%used
         associate (patch => memory%slot(k)%problem, contact => memory%slot(k)%result)
            a = contact_radius(contact)
            length = 1.0_wp
            if (patch%motion == motion%transient_rolling) length = patch%dq
            if (patch%motion == motion%steady_rolling) length = a
            slope = slope + tangential_stiffness*patch%model%material%gg*a*length*memory%geometry%placement%wheel_radius &
               & /max(patch%veloc, epsilon(1.0_wp))
         end associate
      end do
   end function force_per_pitch_rate

   !> Order of magnitude of the largest slip in the contact, relative to the rolling velocity [-]
   pure real(wp) function largest_slip(memory) result(slip)
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      slip = 0.0_wp
      do k = 1, memory%used
         associate (contact => memory%slot(k)%result)
            slip = max(slip, norm2([contact%cksi, contact%ceta]) + abs(contact%cphi)*contact_radius(contact))
         end associate
      end do
   end function largest_slip

   !> Force of friction on the rail along the wheelset's x axis [N]
   pure real(wp) function friction_along(memory) result(force)
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      force = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            force = force + slot%result%fn*dot_product(matmul(slot%plane%axes, slot%friction_share), &
               & memory%geometry%placement%wheelset%axes(:, 1))
         end associate
      end do
   end function friction_along

   !> Do all contact elements slip?
   pure logical function slides_fully(memory)
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      slides_fully = .true.
      do k = 1, memory%used
         if (any(memory%slot(k)%state%now%division == element%adhesion)) slides_fully = .false.
      end do
   end function slides_fully
end module contact_wheelrail_pitch_rate
