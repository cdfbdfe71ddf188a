!> One wheel on one rail: contact patches, their solutions, total forces
!>
!> With a prescribed vertical force the height of the wheelset is searched (contact_wheelrail_force_balance).
!> Where tangential tractions do not change the pressures, only normal problems are solved on the way,
!> with the tangential forces in a fixed ratio to the normal ones; the tangential problem comes last
!> and corrects that ratio. References and grids belong to the height of each trial.
module contact_wheelrail_pair
   use contact_base_constants, only : excluded_distance
   use contact_base_choices, only : contact_location, estimate_choice, force_control, friction_model, motion, time_link, variation
   use contact_base_error, only : add_context, error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_friction_law, only : friction_parameters
   use contact_friction_new_law, only : new_friction_law
   use contact_grid_element_division, only : element
   use contact_numeric_root_search, only : root_search
   use contact_patch_moments, only : link_moments
   use contact_patch_problem, only : patch_problem, patch_state, traction_fields
   use contact_patch_result, only : patch_result
   use contact_patch_solve, only : solve_patch
   use contact_patch_workspace, only : patch_workspace, release_workspace
   use contact_profile_curve, only : profile_curve
   use contact_profile_surface, only : profile_surface, surface_cut
   use contact_wheelrail_carry_over, only : carried_moment, lattice_box, lattice_window, place_on_lattice
   use contact_wheelrail_bodies, only : pair_bodies, place_bodies, rail_section
   use contact_wheelrail_creepage, only : contact_motion, flat_creepage, flat_shift, rigid_motion
   use contact_wheelrail_curved_patch, only : curved_forces, curved_reference, curved_rows, fit_creepages, &
      & new_curved_reference, straight_reference, surface_heights, surface_slip
   use contact_wheelrail_flat_patch, only : patch_frame, patch_grid, undeformed_distance
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   use contact_wheelrail_frame, only : frame
   use contact_wheelrail_gap, only : gap_curve, measure_gap, rail_in_track
   use contact_wheelrail_placement, only : gauge_point, pair_placement, place_pair, rail_motion, side_sign, wheel_motion
   use contact_wheelrail_regions, only : contact_region, find_regions, smallest_gap
   use contact_wheelrail_result, only : pair_patch, pair_result
   use contact_wheelrail_spec, only : wheel_rail_spec
   use contact_wheelrail_variable, only : measure_variable_gap, variable_distance
   implicit none (type, external)
   private

   public :: pair_problem, pair_memory, solve_pair, release_pair

   !> What is asked for a pair
   type :: pair_problem
      type(wheel_rail_spec) :: spec
      !> Prepared profiles in their own coordinates
      type(profile_curve) :: rail, wheel
      !> A rail that varies along the track, a wheel that is out of round; then the profile is that of the first slice
      type(profile_surface), allocatable :: rail_surface, wheel_surface
      !> Settings that all patches share: material, friction, motion, solvers
      type(patch_problem) :: template
      !> Is the vertical force prescribed? Otherwise the height of the wheelset
      logical :: force_prescribed = .false.
      !> What is found besides, member of force_control: nothing, the pitch rate, or the deflection of the rail
      integer :: force = force_control%creepages
      !> Only search for contact?
      logical :: geometry_only = .false.
      !> Start from the previous case?
      logical :: use_previous = .false.
      !> How the case continues the previous one, member of time_link
      integer :: link = time_link%initiate
      !> Power of the interpenetration in the weights of the contact reference
      integer :: weight_power = 2
      !> How friction varies, member of variation, and its law, member of friction_model
      integer :: variation = variation%none, friction_law = friction_model%coulomb
      !> Parameters at control points: angles [rad] or positions along the track [mm], rising
      real(wp), allocatable :: control_point(:)
      type(friction_parameters), allocatable :: control(:)
      !> The rail's part of the compliance of both bodies [-]
      real(wp) :: rail_share = 0.5_wp
      !> Elements of a patch at most
      integer :: most_elements = 20000
   end type pair_problem

   !> Most patches of a pair
   integer, parameter :: most_patches = 10
   !> A ratio is taken over by patches within this distance [mm] and angle [rad]
   real(wp), parameter :: same_place = 5.0_wp, same_angle = 0.2_wp

   !> One patch with its memory
   type :: patch_slot
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      type(patch_result) :: result
      type(contact_region) :: region
      type(frame) :: plane
      !> Curved reference surface; unallocated for a flat patch whose slip is that of its reference
      type(curved_reference), allocatable :: curve
      !> Heights of rail and wheel over that surface [mm], shape (mx, my)
      real(wp), allocatable :: on_rail(:, :), on_wheel(:, :)
      type(contact_motion) :: motion
      !> Place of the contact reference on the lattice of the pair [mm]
      real(wp) :: reference(2) = 0.0_wp
      !> Window of the grid on the lattice, and that of the solution in `state`
      type(lattice_window) :: window, solved_window
      !> Patches of the previous moment that this one continues
      integer, allocatable :: previous(:)
      !> Forces [N] and moment [N mm] on the rail in the axes x, s, n of the plane
      real(wp) :: force(3) = 0.0_wp, moment(3) = 0.0_wp
      !> Force of the pressures on the rail in the axes x, s, n of the plane [N]
      real(wp) :: pressure_force(3) = 0.0_wp
      !> Force of friction in the same axes, relative to the normal force [-]: of the last tangential
      !> solution, or an estimate
      real(wp) :: friction_share(3) = 0.0_wp
   end type patch_slot

   !> Force of friction relative to the normal force that a tangential solution has found, and where
   type :: learned_share
      !> Lateral position [mm] and contact angle [rad]
      real(wp) :: y = 0.0_wp, alpha = 0.0_wp
      real(wp) :: share(3) = 0.0_wp
   end type learned_share

   !> Where the bodies are and what the search for contact found: what the patches of a trial share
   type :: pair_geometry
      !> Shares 1...shares are known. They serve all trials until the next tangential solution, whether
      !> patches come and go or not, so that the force is one function of the height
      integer :: shares = 0
      type(learned_share) :: learned(most_patches)
      type(gap_curve) :: gap
      !> The rail at the wheelset
      type(profile_curve) :: rail_in_track
      !> Sections of bodies that vary; used when `searches_table` or with curved reference surfaces
      type(pair_bodies) :: bodies
      logical :: searches_table = .false.
      type(pair_placement) :: placement
      !> Height at which the gap was measured, and that of first touch [mm]
      real(wp) :: gap_height = 0.0_wp, touch = 0.0_wp
      !> Penetration that carries the prescribed force [mm]: of the last search of this case, or 0
      real(wp) :: penetration = 0.0_wp
      !> Lateral deflection of the rail [mm] and pitch rate of the wheelset [rad/s]: prescribed, or the present trial
      real(wp) :: deflection = 0.0_wp, pitch_rate = 0.0_wp
      !> Top of the canted rail and its gauge point [mm]
      real(wp) :: top_z = 0.0_wp, gauge_y = 0.0_wp
      !> Where the tractions of the previous moment are
      type(carried_moment) :: before
      !> Position of the wheelset along the rail [mm], and the arc length of the rail's profile at its origin [mm]
      real(wp) :: travel = 0.0_wp, profile_origin = 0.0_wp
   end type pair_geometry

   !> What a pair remembers from case to case, and scratch
   type :: pair_memory
      !> Height of the wheelset above a rail without vertical deflection in the previous case [mm]
      real(wp) :: z_ws = 0.0_wp
      logical :: started = .false.
      !> Patches 1...used are those of the last evaluation
      integer :: used = 0
      type(patch_slot), allocatable :: slot(:)
      type(pair_geometry) :: here
      !> Tractions of the last solved case
      type(carried_moment) :: last
      !> Motion of the last case
      integer :: motion = motion%none
   end type pair_memory

   !> Rounds of tangential solutions with a new search for the height
   integer, parameter :: most_rounds = 8
   !> Parts of a blended patch reach this far beyond their bounds, relative to D_COMB
   real(wp), parameter :: part_margin = 0.4_wp
   !> Steps of the force that are due to the grids, relative to the force
   real(wp), parameter :: small_step = 1.0e-4_wp
   !> Forces below this value ask for a wheel that just touches [N]
   real(wp), parameter :: no_force = 1.0e-9_wp
   !> Heights and deflections this far away are out of reach [mm]
   real(wp), parameter :: out_of_sight = 500.0_wp

contains

   !> Solve one case of a pair
   subroutine solve_pair(problem, memory, log, result, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      type(log_type), intent(inout) :: log
      type(pair_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: z

      if (.not. allocated(memory%slot)) allocate(memory%slot(most_patches))
      if (.not. problem%use_previous) then
         memory%slot%state%started = .false.
         memory%used = 0
         memory%here%shares = 0
      end if
      call begin_step(problem, memory, log)
      result%solved = .false.
      result%force_evaluations = 0
      memory%here%penetration = 0.0_wp
      if (.not. (memory%started .and. problem%use_previous)) then
         memory%here%deflection = 0.0_wp
         memory%here%pitch_rate = rate_of_pure_rolling(problem)
      end if
      if (problem%force /= force_control%massless_rail) memory%here%deflection = 0.0_wp
      if (problem%force /= force_control%longitudinal_force) memory%here%pitch_rate = problem%spec%wheelset%vpitch
      if (problem%spec%track%gaught > 0.0_wp) &
         & call gauge_point(problem%rail, problem%spec%track%cant, problem%spec%track%gaught, memory%here%top_z, &
         & memory%here%gauge_y)
      if (problem%geometry_only .or. problem%force == force_control%creepages) then
         call settle(problem, memory, z, log, result, error)
      else if (problem%force == force_control%longitudinal_force) then
         call search_pitch_rate(problem, memory, z, log, result, error)
      else
         call search_deflection(problem, memory, z, log, result, error)
      end if
      if (allocated(error)) then
         call memory%last%clear()
         return
      end if
      memory%z_ws = z
      memory%started = .true.
      if (.not. problem%geometry_only) call keep_moment(problem, memory)
      result%smallest_gap = memory%here%touch - z
      result%vpitch = memory%here%pitch_rate
      result%dy_defl = memory%here%deflection
      result%dz_defl = 0.0_wp
      if (problem%force == force_control%massless_rail) call lower_rail(problem, memory, z, result)
      call place(problem, memory, z, result%dz_defl)
      result%z_ws = z
      call gather(problem, memory, result)
   end subroutine solve_pair

   !> Pitch rate at which the circumference of the wheel is as fast as the rail [rad/s]
   pure real(wp) function rate_of_pure_rolling(problem) result(rate)
      type(pair_problem), intent(in) :: problem

      associate (pair => problem%spec)
         if (pair%roller) then
            rate = -pair%wheelset%rpitch*pair%track%nomradr/pair%wheelset%nomradw
         else
            rate = -pair%wheelset%vs/pair%wheelset%nomradw
         end if
      end associate
   end function rate_of_pure_rolling

   !> Gap between the bodies, and the height of first touch
   subroutine measure(problem, memory, z)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      !> Height of the wheelset [mm]
      real(wp), intent(in) :: z

      call place(problem, memory, z)
      memory%here%rail_in_track = rail_at(problem, memory%here%placement, 0.0_wp)
      memory%here%profile_origin = memory%here%rail_in_track%s_at(memory%here%placement%rail%origin(2))
      memory%here%searches_table = allocated(problem%rail_surface) .or. allocated(problem%wheel_surface) &
         & .or. any(problem%spec%search%location == [contact_location%grid, contact_location%steep_grid])
      if (memory%here%searches_table .or. follows_surface(problem)) then
         memory%here%bodies%rail = memory%here%rail_in_track
         memory%here%bodies%wheel = problem%wheel
         memory%here%bodies%placement = memory%here%placement
         call place_bodies(memory%here%bodies, problem%spec%wheelset%s, problem%spec%wheelset%pitch, &
            & problem%spec%search%dx, problem%rail_surface, problem%wheel_surface)
      end if
      if (memory%here%searches_table) then
         call measure_variable_gap(memory%here%bodies, problem%spec%search%ds, allocated(problem%wheel_surface) &
            & .or. any(problem%spec%search%location == [contact_location%grid, contact_location%steep_grid]), memory%here%gap)
      else
         call measure_gap(memory%here%rail_in_track, problem%wheel, memory%here%placement, problem%spec%search%ds, memory%here%gap)
      end if
      memory%here%gap_height = z
      memory%here%touch = z + smallest_gap(memory%here%gap)
   end subroutine measure

   !> Height and contact for the present deflection of the rail and the present pitch rate
   subroutine settle(problem, memory, z, log, result, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm]
      real(wp), intent(out) :: z
      type(log_type), intent(inout) :: log
      type(pair_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: target, spring
      logical :: height_is_unknown

      result%solved = .false.
      height_is_unknown = problem%force_prescribed .or. problem%force == force_control%massless_rail
      z = problem%spec%wheelset%z
      if (height_is_unknown) then
         z = 0.0_wp
         if (memory%started) z = memory%z_ws
      end if
      call measure(problem, memory, z)
      if (.not. height_is_unknown) then
         call evaluate(problem, memory, z, with_friction=.true., log=log, error=error)
         result%solved = .not. allocated(error)
         return
      end if
      if (memory%here%touch - z > out_of_sight) then
         memory%used = 0
         z = memory%here%touch
         call log%warning("wheel and rail do not meet: their lateral positions are apart")
         return
      end if
      associate (touch => memory%here%touch, rail => problem%spec%rail)
         if (problem%force_prescribed) then
            spring = 0.0_wp
            target = problem%spec%wheelset%fz
         else
            ! the rail's springs give way by what the wheel does not penetrate
            spring = rail%kz
            target = rail%kz*(problem%spec%wheelset%z - touch) - rail%fz
         end if
         if (target > no_force) then
            call balance_forces(problem, memory, target, spring, z, log, result, error)
         else
            memory%used = 0
            result%solved = .true.
            z = touch
            if (.not. problem%force_prescribed) z = problem%spec%wheelset%z - rail%fz/rail%kz
         end if
      end associate
   end subroutine settle

   !> Vertical deflection of a rail on springs: everything moves down with it
   subroutine lower_rail(problem, memory, z, result)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection on entry, above the track on exit [mm]
      real(wp), intent(inout) :: z
      type(pair_result), intent(inout) :: result
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

   !> Search the lateral deflection of a rail on springs
   !>
   !> The lateral force falls when the rail gives way, and the force of the spring rises.
   subroutine search_deflection(problem, memory, z, log, result, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm]
      real(wp), intent(out) :: z
      type(log_type), intent(inout) :: log
      type(pair_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      type(root_search) :: search
      type(log_type) :: silent
      real(wp) :: first, step, tolerance, residual
      character(len=12) :: missed

      first = memory%here%deflection
      associate (rail => problem%spec%rail)
         call settle(problem, memory, z, silent, result, error)
         if (allocated(error)) return
         residual = unbalanced()
         step = rail%first_step
         if (rail%ky > 0.0_wp) step = min(step, 1.05_wp*abs(residual)/rail%ky)
         tolerance = problem%template%eps*max(abs(rail%fy), norm2(total_force(memory)))
         call search%start(first, step, tolerance)
         search%resolution = 1.0e-8_wp
         if (rail%ky > 0.0_wp) search%resolution = min(search%resolution, 0.1_wp*tolerance/rail%ky)
         do
            call search%answer(residual, abs(search%x - first) > out_of_sight)
            if (search%finished) exit
            memory%here%deflection = search%x
            call settle(problem, memory, z, silent, result, error)
            if (allocated(error)) return
            residual = unbalanced()
         end do
         memory%here%deflection = search%best
         call settle(problem, memory, z, log, result, error)
         if (allocated(error)) return
         residual = unbalanced()
         if (abs(residual) <= max(tolerance, small_step*norm2(total_force(memory)))) return
         result%solved = .false.
         write(missed, '(es10.2)') residual
         if (search%bracketed) then
            call log%warning("the lateral force on the rail misses that of its spring by " // trim(adjustl(missed)) // &
               & " N: it jumps where contact patches appear, join or separate")
         else
            call log%warning("the lateral force on the rail misses that of its spring by " // trim(adjustl(missed)) // &
               & " N: no deflection balances them")
         end if
      end associate

   contains

      !> Lateral force that neither the spring nor the static force takes [N], right-hand pair
      real(wp) function unbalanced()
         real(wp) :: force(3)
         force = total_force(memory)
         unbalanced = force(2) + side_sign(problem%spec)*problem%spec%rail%fy - problem%spec%rail%ky*memory%here%deflection
      end function unbalanced
   end subroutine search_deflection

   !> Search the pitch rate at which the prescribed longitudinal force acts
   !>
   !> A wheel that turns faster about the axis to the right drags the rail forward.
   subroutine search_pitch_rate(problem, memory, z, log, result, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      !> Height of the wheelset [mm]
      real(wp), intent(out) :: z
      type(log_type), intent(inout) :: log
      type(pair_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      type(root_search) :: search
      type(log_type) :: silent
      real(wp) :: slope, tolerance, residual, moving
      character(len=12) :: wanted, missed

      call settle(problem, memory, z, silent, result, error)
      if (allocated(error)) return
      residual = missing()
      slope = force_per_pitch_rate(memory)
      tolerance = problem%template%eps*max(abs(problem%spec%wheelset%fx), norm2(total_force(memory)))
      if (memory%used > 0 .and. slope > 0.0_wp) then
         call search%start(memory%here%pitch_rate, 1.1_wp*abs(residual)/slope, tolerance)
         moving = maxval(memory%slot(:memory%used)%motion%veloc)/memory%here%placement%wheel_radius
         search%resolution = 1.0e-10_wp*moving
         do
            call search%answer(residual, slides_fully(memory))
            if (search%finished) exit
            memory%here%pitch_rate = search%x
            call settle(problem, memory, z, silent, result, error)
            if (allocated(error)) return
            residual = missing()
         end do
         memory%here%pitch_rate = search%best
      end if
      call settle(problem, memory, z, log, result, error)
      if (allocated(error)) return
      residual = missing()
      if (abs(residual) <= max(tolerance, small_step*norm2(total_force(memory)))) return
      result%solved = .false.
      write(wanted, '(es10.3)') problem%spec%wheelset%fx
      write(missed, '(es10.2)') -residual
      if (memory%used == 0) then
         call log%warning("the longitudinal force " // trim(adjustl(wanted)) // " N needs contact, and there is none")
      else if (search%bracketed) then
         call log%warning("the longitudinal force " // trim(adjustl(wanted)) // " N is missed by " // trim(adjustl(missed)) // &
            & " N: the force jumps over it")
      else
         call log%warning("the longitudinal force " // trim(adjustl(wanted)) // " N is missed by " // trim(adjustl(missed)) // &
            & " N: the whole contact slides, friction cannot do more")
      end if

   contains

      !> Longitudinal force in wheelset axes that is missing [N]
      real(wp) function missing()
         missing = problem%spec%wheelset%fx - dot_product(total_force(memory), memory%here%placement%wheelset%axes(:, 1))
      end function missing
   end subroutine search_pitch_rate

   !> Order of magnitude of the change of the longitudinal force with the pitch rate, without slip [N s/rad]
   !>
   !> A contact area pi a**2 holds 2.5 G a per mm of rigid displacement, which comes about in a shift, in a
   !> step of transient rolling, or in rolling over the length a.
   real(wp) function force_per_pitch_rate(memory) result(slope)
      type(pair_memory), intent(in) :: memory
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: a, length
      integer :: k

      slope = 0.0_wp
      do k = 1, memory%used
         associate (patch => memory%slot(k)%problem, contact => memory%slot(k)%result)
            a = sqrt(contact%ncon*patch%grid%dx*patch%grid%dy/pi)
            length = 1.0_wp
            if (patch%motion == motion%transient_rolling) length = patch%dq
            if (patch%motion == motion%steady_rolling) length = a
            slope = slope + 2.5_wp*patch%model%material%gg*a*length*memory%here%placement%wheel_radius &
               & /max(patch%veloc, epsilon(1.0_wp))
         end associate
      end do
   end function force_per_pitch_rate

   !> Do all contact elements slip?
   pure logical function slides_fully(memory)
      type(pair_memory), intent(in) :: memory
      integer :: k

      slides_fully = .true.
      do k = 1, memory%used
         if (any(memory%slot(k)%state%now%division == element%adhesion)) slides_fully = .false.
      end do
   end function slides_fully

   !> What the case continues from, according to its link to the previous one
   subroutine begin_step(problem, memory, log)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      type(log_type), intent(inout) :: log
      integer :: dropped

      associate (here => memory%here)
         select case (problem%link)
         case (time_link%initiate)
            call here%before%clear()
            here%before%travel = 0.0_wp
         case (time_link%repeat_step)
            continue
         case default
            here%before = memory%last
            if (problem%link == time_link%continue_normal) call here%before%drop_tangential()
         end select
         here%travel = problem%spec%wheelset%s
         if (problem%spec%roller) here%travel = here%before%travel + problem%spec%wheelset%rpitch*problem%spec%track%nomradr
         ! solutions on another lattice are no estimates
         if (problem%template%motion /= memory%motion) memory%slot%state%started = .false.
         memory%motion = problem%template%motion
         call here%before%set_frame(follows_rail=problem%template%motion == motion%shift)
         if (.not. keeps_lattice(problem)) return
         call here%before%drop_other_elements(problem%spec%search%dx, problem%spec%search%ds, dropped)
         if (dropped > 0) call log%warning("the tractions of the previous case stand on other elements and are not continued")
      end associate
   end subroutine begin_step

   !> Do the elements stand on the lattice of the pair, as a transient motion needs it?
   pure logical function keeps_lattice(problem) result(keeps)
      type(pair_problem), intent(in) :: problem
      keeps = problem%template%motion == motion%shift .or. problem%template%motion == motion%transient_rolling
   end function keeps_lattice

   !> Keep the tractions of this case for the next one
   subroutine keep_moment(problem, memory)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      integer :: k

      call memory%last%start(memory%used, problem%template%motion == motion%shift, memory%here%travel)
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            call memory%last%add(k, slot%state%now, slot%reference, box_on_lattice(problem, memory%here, slot%region))
         end associate
      end do
   end subroutine keep_moment

   !> Position along the track, relative to the origin of the lattice [mm]
   pure real(wp) function lattice_x(problem, here, x)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      !> In the track [mm]
      real(wp), intent(in) :: x

      lattice_x = x
      if (problem%template%motion == motion%shift) lattice_x = x + here%travel
   end function lattice_x

   !> Bounds of a region on the lattice
   function box_on_lattice(problem, here, region) result(box)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      type(contact_region), intent(in) :: region
      type(lattice_box) :: box
      real(wp) :: s(2)

      box%x = [lattice_x(problem, here, region%box%x(1)), lattice_x(problem, here, region%box%x(2))]
      s = here%rail_in_track%s_at(region%box%y) - here%profile_origin
      box%s = [minval(s), maxval(s)]
   end function box_on_lattice

   !> Do distances and slip of a patch follow a reference surface row by row?
   pure logical function follows_surface(problem) result(follows)
      type(pair_problem), intent(in) :: problem
      follows = any(problem%spec%search%location == [contact_location%conformal, contact_location%locus_extended])
   end function follows_surface

   !> The rail's profile in track coordinates at a place along it; of a variable one within its slices
   function rail_at(problem, placement, x) result(curve)
      type(pair_problem), intent(in) :: problem
      type(pair_placement), intent(in) :: placement
      !> From the wheelset on [mm]
      real(wp), intent(in) :: x
      type(profile_curve) :: curve
      type(surface_cut) :: section
      real(wp) :: u

      if (allocated(problem%rail_surface)) then
         associate (range => problem%rail_surface%u_range)
            u = min(max(problem%spec%wheelset%s + x, range(1)), range(2))
         end associate
         call rail_section(problem%rail_surface, placement, u, section)
         if (section%present) then
            curve = section%curve
            return
         end if
      end if
      curve = rail_in_track(problem%rail, placement)
   end function rail_at

   !> Free what the memory holds outside Fortran's own
   subroutine release_pair(memory)
      type(pair_memory), intent(inout) :: memory
      integer :: k

      if (.not. allocated(memory%slot)) return
      do k = 1, size(memory%slot)
         call release_workspace(memory%slot(k)%workspace)
      end do
   end subroutine release_pair

   !> Put the wheelset at a height
   subroutine place(problem, memory, z, dz)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      real(wp), intent(in) :: z
      !> Vertical deflection of the rail [mm], default 0
      real(wp), intent(in), optional :: dz
      real(wp) :: deflection(2)

      deflection = [memory%here%deflection, 0.0_wp]
      if (present(dz)) deflection(2) = dz
      call place_pair(problem%spec, problem%wheel, memory%here%top_z, memory%here%gauge_y, z, deflection, &
         & memory%here%placement)
   end subroutine place

   !> Search the height at which the vertical force acts
   subroutine balance_forces(problem, memory, target, spring, z, log, result, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      !> Prescribed force [N]: of the contact, and of a spring that is free of force at first touch, with its stiffness [N/mm]
      real(wp), intent(in) :: target, spring
      !> Height found [mm]
      real(wp), intent(out) :: z
      type(log_type), intent(inout) :: log
      type(pair_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      type(force_balance) :: balance
      real(wp) :: force, trial, guess, touch, slope
      logical :: separate
      integer :: round

      touch = memory%here%touch
      ! friction decouples from the pressures for bodies that are alike
      separate = problem%template%motion /= motion%none .and. .not. problem%template%model%coupled()
      guess = touch + penetration_guess(problem, memory, touch, target)
      if (spring > 0.0_wp) guess = min(guess, touch + target/spring)
      if (problem%use_previous .and. memory%started .and. memory%z_ws > touch) guess = memory%z_ws
      if (memory%here%penetration > 0.0_wp) guess = touch + memory%here%penetration
      do round = 1, most_rounds
         call balance%start(target, problem%template%eps, touch, touch + 1.1_wp*memory%here%placement%wheel_radius, &
            & problem%template%maxnr)
         do while (balance%ended == balance_ending%running)
            trial = balance%next_trial(guess)
            call evaluate(problem, memory, trial, with_friction=.not. separate, log=log, error=error)
            if (allocated(error)) return
            force = vertical_force(memory) + spring*(trial - touch)
            slope = vertical_slope(memory) + spring
            call balance%record(trial, force, slope)
            result%force_evaluations = result%force_evaluations + 1
            call trace_trial(log, result%force_evaluations, trial, force, slope)
         end do
         z = balance%z
         if (.not. separate) exit
         ! the tangential problem at the height found corrects the lateral forces
         call evaluate(problem, memory, z, with_friction=.true., log=log, error=error)
         if (allocated(error)) return
         call learn_shares(memory)
         force = vertical_force(memory) + spring*(z - touch)
         slope = vertical_slope(memory) + spring
         result%force_evaluations = result%force_evaluations + 1
         call trace_trial(log, result%force_evaluations, z, force, slope)
         if (abs(force - target) <= balance%tolerance) exit
         ! a force that was not reached is not mended by friction, but for the small steps of the grids
         if (balance%ended /= balance_ending%reached .and. abs(balance%force - target) > small_step*target) exit
         guess = z + (target - force)/max(slope, 0.1_wp*target/max(z - touch, 1.0e-6_wp))
         if (guess <= touch) guess = z
      end do
      if (.not. separate .and. abs(balance%force - force) > 0.0_wp) then
         ! the last trial need not be the best one
         call evaluate(problem, memory, z, with_friction=.true., log=log, error=error)
         if (allocated(error)) return
      end if
      memory%here%penetration = z - touch
      result%force_error = vertical_force(memory) + spring*(z - touch) - target
      ! grids follow the contact in whole elements, which leaves small steps in the force
      result%solved = abs(result%force_error) <= max(balance%tolerance, small_step*target)
      if (.not. result%solved) call complain(balance, target, result%force_error, log)
   end subroutine balance_forces

   !> Line of the flow trace
   subroutine trace_trial(log, number, z, force, slope)
      type(log_type), intent(inout) :: log
      integer, intent(in) :: number
      real(wp), intent(in) :: z, force, slope
      character(len=100) :: line

      if (.not. log%shows(1)) return
      write(line, '(4x,i6,a,f12.4,es12.4,a,es12.3)') number, ", NR,  z_ws, Fz: ", z, force, ", dFz/dz:", slope
      call log%trace(1, trim(line))
   end subroutine trace_trial

   !> Say why the force was not reached
   subroutine complain(balance, target, force_error, log)
      type(force_balance), intent(in) :: balance
      real(wp), intent(in) :: target, force_error
      type(log_type), intent(inout) :: log
      character(len=12) :: wanted, missed
      character(len=:), allocatable :: why

      write(wanted, '(es10.3)') target
      write(missed, '(es10.2)') force_error
      select case (balance%ended)
      case (balance_ending%jump)
         why = "the force jumps over it where contact patches join or separate"
      case (balance_ending%out_of_reach)
         why = "it is out of reach"
      case (balance_ending%trial_limit)
         why = "all MAXNR trials were used"
      case default
         why = "the lateral forces do not settle"
      end select
      call log%warning("the vertical force " // trim(adjustl(wanted)) // " N is missed by " // trim(adjustl(missed)) // &
         & " N: " // why)
   end subroutine complain

   !> Penetration by Hertz's theory for the place of first touch [mm]
   real(wp) function penetration_guess(problem, memory, touch, force) result(pen)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(in) :: memory
      real(wp), intent(in) :: touch, force
      real(wp) :: a, b, bend, modulus
      integer :: i, k

      associate (gap => memory%here%gap)
         i = minloc(gap%gap, dim=1)
         a = gap%kappa
         b = a
         ! the curvature over a width as large as a patch
         k = max(1, nint(2.0_wp/gap%dy))
         if (i - k >= 1 .and. i + k <= gap%n) then
            bend = (gap%gap(i - k) - 2.0_wp*gap%gap(i) + gap%gap(i + k))/(k*gap%dy)**2
            if (bend > 0.0_wp .and. bend < 10.0_wp) b = 0.5_wp*bend
         end if
      end associate
      modulus = problem%template%model%material%gg/(1.0_wp - problem%template%model%material%nu)
      ! a sphere with the mean of the curvatures
      pen = (0.75_wp*force*sqrt(2.0_wp*max(sqrt(a*b), 1.0e-8_wp))/modulus)**(2.0_wp/3.0_wp)
      pen = min(max(pen, 1.0e-6_wp), 5.0_wp + 0.0_wp*touch)
   end function penetration_guess

   !> Force on the rail in track axes [N], friction from the last tangential solution
   pure function total_force(memory) result(force)
      type(pair_memory), intent(in) :: memory
      real(wp) :: force(3)
      integer :: k

      force = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            force = force + matmul(slot%plane%axes, slot%pressure_force + slot%friction_share*slot%result%fn)
         end associate
      end do
   end function total_force

   !> Vertical force on the rail [N], friction from the last tangential solution
   pure real(wp) function vertical_force(memory) result(force)
      type(pair_memory), intent(in) :: memory
      real(wp) :: all(3)

      all = total_force(memory)
      force = all(3)
   end function vertical_force

   !> Derivative of the vertical force to the height, from the contact stiffness where it is known [N/mm]
   pure real(wp) function vertical_slope(memory) result(slope)
      type(pair_memory), intent(in) :: memory
      integer :: k

      slope = 0.0_wp
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            ! the normal force changes by the stiffness, the vertical one along with it
            if (slot%result%fn > 0.0_wp) slope = slope + slot%plane%axes(3, 3)*slot%result%sensitivity(1, 1) &
               & *dot_product(slot%plane%axes(3, :), slot%pressure_force/slot%result%fn + slot%friction_share)
         end associate
      end do
   end function vertical_slope

   !> Patches and their solutions at a height
   subroutine evaluate(problem, memory, z, with_friction, log, error)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(inout) :: memory
      real(wp), intent(in) :: z
      !> Solve the tangential problems, too?
      logical, intent(in) :: with_friction
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(contact_region), allocatable :: regions(:), misses(:)
      type(lattice_box), allocatable :: boxes(:)
      integer :: k, n

      call place(problem, memory, z)
      memory%here%bodies%placement = memory%here%placement
      call find_regions(memory%here%gap, z - memory%here%gap_height, problem%spec%search, problem%weight_power, regions, misses)
      n = size(regions)
      if (n > most_patches) then
         call log%warning("more than 10 contact patches; the ones with the smallest weight are left out")
         do while (n > most_patches)
            k = minloc(regions%weight, dim=1)
            regions = [regions(:k - 1), regions(k + 1:)]
            n = n - 1
         end do
      end if
      call match_slots(memory, regions)
      memory%used = n
      allocate(boxes(n))
      do k = 1, n
         boxes(k) = box_on_lattice(problem, memory%here, regions(k))
      end do
      call memory%here%before%share_out(boxes)
      do k = 1, n
         memory%slot(k)%region = regions(k)
         memory%slot(k)%previous = memory%here%before%sources(k)
         call solve_slot(problem, memory%here, k, memory%slot(k), with_friction, log, error)
         if (allocated(error)) then
            call add_context(error, "contact patch " // achar(iachar("0") + mod(k, 10)))
            return
         end if
      end do
   end subroutine evaluate

   !> Bring the slots into the order of the regions, so that each one continues its own solution
   subroutine match_slots(memory, regions)
      type(pair_memory), intent(inout) :: memory
      type(contact_region), intent(in) :: regions(:)
      integer :: k, j, best
      real(wp) :: overlap, largest

      do k = 1, size(regions)
         best = 0
         largest = 0.0_wp
         do j = k, memory%used
            associate (old => memory%slot(j)%region%box%y, new => regions(k)%box%y)
               overlap = min(old(2), new(2)) - max(old(1), new(1))
            end associate
            if (overlap <= largest) cycle
            largest = overlap
            best = j
         end do
         if (best > k) then
            call exchange(memory%slot(k), memory%slot(best))
         else if (best == 0) then
            memory%slot(k)%state%started = .false.
         end if
      end do
   end subroutine match_slots

   !> Two slots change their memories
   subroutine exchange(a, b)
      type(patch_slot), intent(inout) :: a, b
      type(patch_state) :: state
      type(lattice_window) :: window

      state = a%state
      a%state = b%state
      b%state = state
      window = a%solved_window
      a%solved_window = b%solved_window
      b%solved_window = window
   end subroutine exchange

   !> Force of friction relative to the normal force at a place: learned there, or that of full sliding down the slope
   pure function share_at(problem, here, slot) result(share)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      type(patch_slot), intent(in) :: slot
      real(wp) :: share(3)
      integer :: k
      real(wp) :: nearest, mu

      share = 0.0_wp
      if (problem%template%motion == motion%none) return
      mu = slot%problem%mu
      if (allocated(slot%problem%static_mu)) mu = sum(slot%problem%static_mu)/size(slot%problem%static_mu)
      share(2) = mu*sin(slot%plane%roll())
      nearest = same_place
      do k = 1, here%shares
         associate (known => here%learned(k))
            if (abs(known%y - slot%plane%origin(2)) > nearest .or. abs(known%alpha - slot%plane%roll()) > same_angle) cycle
            nearest = abs(known%y - slot%plane%origin(2))
            share = known%share
         end associate
      end do
   end function share_at

   !> Remember the forces of friction of all patches
   subroutine learn_shares(memory)
      type(pair_memory), intent(inout) :: memory
      integer :: k

      memory%here%shares = memory%used
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            memory%here%learned(k) = learned_share(slot%plane%origin(2), slot%plane%roll(), slot%friction_share)
         end associate
      end do
   end subroutine learn_shares

   !> Grid, undeformed distance, creepages and solution of one patch
   subroutine solve_slot(problem, here, number, slot, with_friction, log, error)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      !> Number of the patch
      integer, intent(in) :: number
      type(patch_slot), intent(inout) :: slot
      logical, intent(in) :: with_friction
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(profile_curve) :: rail
      real(wp), allocatable :: h(:, :)
      real(wp) :: approach

      rail = here%rail_in_track
      if (allocated(problem%rail_surface)) rail = rail_at(problem, here%placement, slot%region%x)
      slot%plane = patch_frame(rail, here%placement, slot%region)
      call move_alloc(slot%problem%h, h)
      slot%problem = problem%template
      if (allocated(slot%curve)) deallocate(slot%curve)
      slot%reference = [lattice_x(problem, here, slot%region%x), rail%s_at(slot%region%y) - here%profile_origin]
      if (keeps_lattice(problem)) then
         call patch_grid(rail, problem%spec%search, slot%region, slot%plane, slot%reference, huge(1), slot%problem%grid)
      else
         ! the reference is the centre of an element
         call patch_grid(rail, problem%spec%search, slot%region, slot%plane, [0.0_wp, 0.0_wp], problem%most_elements, &
            & slot%problem%grid)
      end if
      if (problem%spec%search%location == contact_location%conformal) &
         & call curved_rows(rail, here%bodies, slot%region, slot%plane, slot%problem%grid)
      if (keeps_lattice(problem)) then
         slot%window = place_on_lattice(slot%problem%grid, slot%reference)
         call here%before%widen(number, slot%window, slot%problem%grid)
      else
         slot%window = place_on_lattice(slot%problem%grid, [0.0_wp, 0.0_wp])
      end if
      if (follows_surface(problem)) then
         call follow_surface(problem, here, rail, slot, h, approach)
      else if (here%searches_table) then
         call variable_distance(here%bodies, slot%plane, slot%problem%grid, h, approach)
      else
         call undeformed_distance(rail, problem%wheel, here%placement, slot%plane, slot%problem%grid, h, approach)
      end if
      call move_alloc(h, slot%problem%h)
      slot%problem%force_prescribed = .false.
      slot%problem%pen = approach
      if (size(slot%region%part) > 1) call divide_patch(problem, slot)
      slot%problem%n_forces = 0
      if (problem%geometry_only) slot%problem%motion = motion%none
      call set_patch_friction(problem, slot, error)
      if (allocated(error)) return
      call set_motion(problem, here, slot, approach)
      if (.not. with_friction) slot%problem%motion = motion%none
      slot%friction_share = share_at(problem, here, slot)
      if (problem%geometry_only) return

      call link_slot(here%before, number, slot, error)
      if (allocated(error)) return
      call solve_patch(slot%problem, slot%state, slot%workspace, log, slot%result, error)
      if (allocated(error)) return
      if (allocated(slot%curve)) then
         call curved_forces(slot%curve, slot%plane, slot%result, slot%pressure_force, slot%force, slot%moment)
      else
         slot%pressure_force = [0.0_wp, 0.0_wp, slot%result%fn]
         slot%force = [slot%result%fx, slot%result%fy, slot%result%fn]
         slot%moment = [slot%result%mx, slot%result%my, slot%result%mz]
      end if
      if (with_friction .and. problem%template%motion /= motion%none .and. slot%result%fn > 0.0_wp) then
         slot%friction_share = (slot%force - slot%pressure_force)/slot%result%fn
      end if
   end subroutine solve_slot

   !> Estimate and previous moment on the window of this solution
   !>
   !> Within a case, and from a previous case when asked for, the last solution is the estimate. The
   !> previous moment is that of the previous case in every solution of this one.
   subroutine link_slot(before, number, slot, error)
      type(carried_moment), intent(in) :: before
      !> Number of the patch
      integer, intent(in) :: number
      type(patch_slot), intent(inout) :: slot
      type(error_type), allocatable, intent(out) :: error
      type(traction_fields) :: estimate
      logical :: continues, transient

      associate (problem => slot%problem, state => slot%state)
         transient = problem%motion == motion%shift .or. problem%motion == motion%transient_rolling
         continues = state%started .and. same_elements(slot)
         if (continues) then
            ! the window of the last solution, seen from the reference of this one
            state%now%grid%xl = problem%grid%xl + (slot%solved_window%first(1) - slot%window%first(1))*problem%grid%dx
            state%now%grid%yl = problem%grid%yl + (slot%solved_window%first(2) - slot%window%first(2))*problem%grid%dy
         end if
         slot%solved_window = slot%window
         problem%estimate = merge(estimate_choice%previous, estimate_choice%fresh, continues)
         state%started = continues
         call link_moments(problem, time_link%initiate, state, error)
         if (allocated(error)) return
         if (transient) then
            estimate = state%now
            call before%hand_over(number, problem, slot%window, state%now)
            state%started = .true.
            call link_moments(problem, time_link%continue_all, state, error)
            if (allocated(error)) return
            state%now%division = estimate%division
            state%now%pn = estimate%pn
            state%now%px = estimate%px
            state%now%py = estimate%py
            state%now%pen = estimate%pen
         else if (size(slot%previous) > 0) then
            state%before%is_solved = .true.
            state%before%force = before%total_force(number)
         end if
      end associate
   end subroutine link_slot

   !> Reference surface of a patch at the rows of its grid, and the undeformed distance along its normals
   subroutine follow_surface(problem, here, rail, slot, h, approach)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      !> The rail in track coordinates in the section of the reference
      type(profile_curve), intent(in) :: rail
      !> With its grid
      type(patch_slot), intent(inout) :: slot
      !> Undeformed distance [mm] with its minimum at zero, shape (mx, my)
      real(wp), allocatable, intent(inout) :: h(:, :)
      !> Largest interpenetration along normals [mm]
      real(wp), intent(out) :: approach
      integer :: iy

      associate (patch => slot%problem)
         if (problem%spec%search%location == contact_location%conformal) then
            slot%curve = new_curved_reference(rail, here%bodies, slot%plane, patch%grid)
         else
            slot%curve = straight_reference(slot%plane, patch%grid)
         end if
         call surface_heights(here%bodies, slot%curve, patch%grid, slot%on_rail, slot%on_wheel)
         h = slot%on_rail - slot%on_wheel
         approach = -minval(h)
         h = h + approach
         if (allocated(patch%model%inclination)) then
            patch%model%inclination%s = [(patch%grid%y(iy), iy=1, patch%grid%my)]
            patch%model%inclination%alpha = slot%curve%alpha
         end if
      end associate
   end subroutine follow_surface

   !> Elements of the parts of a blended patch; what is outside of all parts cannot make contact
   subroutine divide_patch(problem, slot)
      type(pair_problem), intent(in) :: problem
      type(patch_slot), intent(inout) :: slot
      real(wp) :: margin, y
      integer :: ix, iy, k

      allocate(slot%problem%parts)
      associate (parts => slot%problem%parts, grid => slot%problem%grid, plane => slot%plane)
         margin = part_margin*problem%spec%search%d_comb
         allocate(parts%label(grid%mx, grid%my), source=0)
         parts%interaction = slot%region%interaction
         do iy = 1, grid%my
            y = plane%origin(2) + cos(plane%roll())*grid%y(iy)
            if (allocated(slot%curve)) y = slot%curve%y(iy)
            do ix = 1, grid%mx
               do k = 1, size(slot%region%part)
                  associate (box => slot%region%part(k))
                     if (y < box%y(1) - margin .or. y > box%y(2) + margin) cycle
                     if (plane%origin(1) + grid%x(ix) < box%x(1) - margin) cycle
                     if (plane%origin(1) + grid%x(ix) > box%x(2) + margin) cycle
                  end associate
                  parts%label(ix, iy) = k
                  exit
               end do
               if (parts%label(ix, iy) == 0) slot%problem%h(ix, iy) = excluded_distance
            end do
         end do
      end associate
   end subroutine divide_patch

   !> Friction of the patch: where it varies, that of the contact angle or of the place along the track
   subroutine set_patch_friction(problem, slot, error)
      type(pair_problem), intent(in) :: problem
      type(patch_slot), intent(inout) :: slot
      type(error_type), allocatable, intent(out) :: error
      type(friction_parameters) :: here
      integer :: iy

      associate (patch => slot%problem)
         if (allocated(patch%static_mu)) deallocate(patch%static_mu)
         if (friction_by_row(problem) .and. problem%template%motion /= motion%none) then
            call new_friction_law(problem%friction_law, [(parameters_at(problem, slot%curve%alpha(iy)), iy=1, patch%grid%my)], &
               & patch%friction, error)
            if (allocated(error)) return
            patch%mu = 1.0_wp
            patch%static_mu = patch%friction%sets%static
            return
         end if
         if (problem%variation /= variation%none .and. problem%template%motion /= motion%none) then
            if (problem%variation == variation%by_angle) then
               here = parameters_at(problem, slot%plane%roll())
            else
               here = parameters_at(problem, problem%spec%wheelset%s)
            end if
            patch%mu = here%static
            if (problem%friction_law /= friction_model%coulomb) then
               call new_friction_law(problem%friction_law, [here], patch%friction, error)
               if (allocated(error)) return
            end if
         end if
         if (allocated(patch%friction)) allocate(patch%static_mu(patch%grid%my), source=patch%mu)
      end associate
   end subroutine set_patch_friction

   !> Does friction follow the inclination of the rail within a patch?
   pure logical function friction_by_row(problem) result(by_row)
      type(pair_problem), intent(in) :: problem
      by_row = problem%variation == variation%by_angle .and. problem%spec%search%location == contact_location%conformal
   end function friction_by_row

   !> Parameters between control points, by linear interpolation; constant beyond them
   pure function parameters_at(problem, position) result(here)
      type(pair_problem), intent(in) :: problem
      !> [rad] or [mm]
      real(wp), intent(in) :: position
      type(friction_parameters) :: here
      real(wp) :: t
      integer :: k, n

      n = size(problem%control_point)
      k = count(problem%control_point <= position)
      if (k == 0 .or. n == 1) then
         here = problem%control(1)
         return
      end if
      here = problem%control(min(k, n))
      if (k >= n) return
      t = (position - problem%control_point(k))/(problem%control_point(k + 1) - problem%control_point(k))
      associate (a => problem%control(k), b => problem%control(k + 1))
         here%static = (1.0_wp - t)*a%static + t*b%static
         here%kinetic = (1.0_wp - t)*a%kinetic + t*b%kinetic
         here%term = (1.0_wp - t)*a%term + t*b%term
         here%half_speed = (1.0_wp - t)*a%half_speed + t*b%half_speed
         here%onset = (1.0_wp - t)*a%onset + t*b%onset
         here%range = (1.0_wp - t)*a%range + t*b%range
      end associate
   end function parameters_at

   !> Were the elements of the last solution of the same size?
   pure logical function same_elements(slot)
      type(patch_slot), intent(in) :: slot
      real(wp), parameter :: same = 1.0e-6_wp

      associate (old => slot%state%now%grid, new => slot%problem%grid)
         same_elements = abs(old%dx - new%dx) < same*new%dx .and. abs(old%dy - new%dy) < same*new%dy
      end associate
   end function same_elements

   !> Creepages of a patch from the motion of the bodies
   subroutine set_motion(problem, here, slot, approach)
      type(pair_problem), intent(in) :: problem
      type(pair_geometry), intent(in) :: here
      type(patch_slot), intent(inout) :: slot
      real(wp), intent(in) :: approach
      type(rigid_motion) :: rail, wheel
      real(wp) :: on_wheel(3), pitch_rate

      pitch_rate = here%pitch_rate
      rail = rail_motion(problem%spec, here%placement)
      wheel = wheel_motion(problem%spec, here%placement, pitch_rate)
      associate (plane => slot%plane)
         on_wheel = plane%origin + approach*plane%axes(:, 3)
         if (problem%template%motion == motion%shift) then
            slot%motion = flat_shift(rail, wheel, plane%origin, on_wheel, plane%roll())
         else
            slot%motion = flat_creepage(rail, wheel, here%placement%wheelset%axes(:, 2), pitch_rate, plane%origin, on_wheel, &
               & plane%roll(), problem%spec%roller)
         end if
      end associate
      if (allocated(slot%curve)) call set_surface_slip(problem, rail, wheel, slot)
      associate (patch => slot%problem)
         patch%creep = [slot%motion%cksi, slot%motion%ceta]
         patch%spin = slot%motion%cphi
         patch%spin_centre = 0.0_wp
         patch%chi = 0.0_wp
         patch%dq = 1.0_wp
         patch%veloc = 1.0_wp
         patch%spin_offset = 0.0_wp
         if (patch%motion == motion%transient_rolling .or. patch%motion == motion%steady_rolling) then
            patch%chi = slot%motion%chi
            patch%veloc = max(slot%motion%veloc, tiny(1.0_wp))
            patch%dq = problem%spec%search%dqrel*patch%grid%dx
            if (patch%motion == motion%steady_rolling) patch%dq = patch%grid%dx
            patch%spin_offset = 1.0_wp/6.0_wp
         end if
         ! as in module 3: a layer that yields follows its particles, simplified theory starts anew at each edge
         patch%corrects_leading_edge = patch%motion == motion%transient_rolling .and. patch%dq > 1.01_wp*patch%grid%dx &
            & .and. .not. allocated(patch%simplified) .and. .not. patch%remembers_yield
      end associate
   end subroutine set_motion

   !> Slip element by element on a reference surface: creepages that describe it best, and the remainder
   subroutine set_surface_slip(problem, rail, wheel, slot)
      type(pair_problem), intent(in) :: problem
      type(rigid_motion), intent(in) :: rail, wheel
      !> With the motion at the contact reference on entry
      type(patch_slot), intent(inout) :: slot
      real(wp) :: before

      associate (patch => slot%problem)
         before = slot%motion%veloc
         ! on the track the rolling velocity is the forward one, unless the wheel turns on the spot
         if (problem%template%motion /= motion%shift .and. .not. problem%spec%roller &
            & .and. abs(problem%spec%wheelset%vs) > 0.0_wp) slot%motion%veloc = abs(problem%spec%wheelset%vs)
         call surface_slip(rail, wheel, slot%curve, patch%grid, slot%on_rail, slot%on_wheel, problem%rail_share, &
            & patch%extra_slip)
         if (.not. slot%motion%veloc > 0.0_wp) then
            patch%extra_slip = 0.0_wp
            return
         end if
         patch%extra_slip = patch%extra_slip/slot%motion%veloc
         slot%motion%cphi = slot%motion%cphi*before/slot%motion%veloc
         call fit_creepages(patch%grid, slot%on_rail < slot%on_wheel, patch%extra_slip, slot%motion)
      end associate
   end subroutine set_surface_slip

   !> Collect the patches and sum up their forces
   subroutine gather(problem, memory, result)
      type(pair_problem), intent(in) :: problem
      type(pair_memory), intent(in) :: memory
      type(pair_result), intent(inout) :: result
      real(wp) :: force(3), moment(3), axes(3, 3), local(3)
      integer :: k

      associate (p => memory%here%placement, material => problem%template%model%material)
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
            call describe_patch(memory%here, memory%slot(k), result%patches(k))
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
         result%force_wheelset = matmul(result%force_track, p%wheelset%axes)
         result%moment_wheel = matmul(result%moment_wheel, p%wheelset%axes)
      end associate
   end subroutine gather

   pure function cross(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)
      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> Place and forces of one patch
   subroutine describe_patch(here, slot, patch)
      type(pair_geometry), intent(in) :: here
      type(patch_slot), intent(in) :: slot
      type(pair_patch), intent(inout) :: patch
      real(wp) :: local(3)
      type(frame) :: seen

      patch%previous = slot%previous
      patch%grid_reference = 0.0_wp
      if (slot%problem%motion == motion%shift .or. slot%problem%motion == motion%transient_rolling) &
         & patch%grid_reference = slot%reference

      patch%x = slot%plane%origin(1)
      patch%y = slot%plane%origin(2)
      patch%z = slot%plane%origin(3)
      patch%delta = slot%plane%roll()
      seen = here%placement%rail%seen_from_here(slot%plane)
      patch%y_rail = seen%origin(2)
      patch%z_rail = seen%origin(3)
      patch%delta_rail = seen%roll()
      local = here%placement%wheel%to_local(slot%plane%origin)
      patch%x_wheel = local(1)
      patch%y_wheel = local(2)
      patch%z_wheel = local(3)
      patch%contact = slot%result
      patch%force = slot%force
      patch%moment = slot%moment
      patch%tilde_fn = slot%result%fn
   end subroutine describe_patch
end module contact_wheelrail_pair
