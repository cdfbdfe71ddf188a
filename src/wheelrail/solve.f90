!> Solution for one wheel on one rail: contact patches and total forces
module contact_wheelrail_solve
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : force_control, is_fastrip, motion, pressure_model, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_patch_derived, only : complete
   use contact_patch_problem, only : patch_problem
   use contact_text_words, only : real_text
   use contact_wheelrail_deflection, only : lower_rail, search_deflection
   use contact_wheelrail_error_estimate, only : estimate_wheel_rail_errors
   use contact_wheelrail_gather, only : gather
   use contact_wheelrail_geometry, only : box_on_lattice, place, wheel_rail_geometry
   use contact_wheelrail_height, only : find_height
   use contact_wheelrail_memory, only : make_slots, wheel_rail_memory
   use contact_wheelrail_pitch_rate, only : search_pitch_rate
   use contact_wheelrail_placement, only : gauge_point
   use contact_wheelrail_problem, only : keeps_lattice, wheel_rail_problem, rate_of_pure_rolling
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: solve_wheel_rail

contains

   !> Solve one case of wheel and rail
   subroutine solve_wheel_rail(problem, memory, log, result, error)
      !> Complete description of the problem
      type(wheel_rail_problem), intent(in) :: problem
      !> State kept from case to case: patches, friction ratios, heights
      type(wheel_rail_memory), intent(inout) :: memory
      !> Receives the trace, and warnings
      type(log_type), intent(inout) :: log
      !> Patches, forces, position, and the status of the case
      type(wheel_rail_result), intent(inout) :: result
      !> Allocated if the case has no result
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: z
      integer :: k

      call make_slots(memory)
      memory%geometry%follows = seeks_height_alone(problem)
      memory%geometry%follows_last = memory%geometry%follows .and. follows_last(problem, memory)
      memory%geometry%follows_height = memory%geometry%follows .and. has_one_height(problem%template)
      if (.not. (problem%use_previous .or. memory%geometry%follows_last)) then
         memory%slot%state%started = .false.
         do k = 1, size(memory%slot)
            call memory%slot(k)%shares%forget()
         end do
         memory%used = 0
         if (.not. problem%refines) memory%geometry%shares = 0
      end if
      call begin_step(problem, memory, log)
      result%status = case_status()
      result%force_evaluations = 0
      result%max_trials = 0
      if (.not. problem%refines) memory%geometry%penetration = 0.0_wp
      if (.not. (memory%started .and. (problem%use_previous .or. problem%refines))) then
         memory%geometry%deflection = 0.0_wp
         memory%geometry%pitch_rate = rate_of_pure_rolling(problem)
      end if
      if (problem%force /= force_control%massless_rail) memory%geometry%deflection = 0.0_wp
      if (problem%force /= force_control%longitudinal_force) memory%geometry%pitch_rate = problem%spec%wheelset%vpitch
      call reset_for_new_rail(problem, memory%geometry)
      if (problem%spec%track%gaught > 0.0_wp) call find_gauge_point(problem, memory%geometry)
      if (problem%geometry_only .or. problem%force == force_control%creepages) then
         call find_height(problem, memory, z, log, result, error)
      else if (problem%force == force_control%longitudinal_force) then
         call search_pitch_rate(problem, memory, z, log, result, error)
      else
         call search_deflection(problem, memory, z, log, result, error)
      end if
      if (allocated(error)) then
         call memory%last%clear()
         call memory%course%forget()
         return
      end if
      if (.not. problem%geometry_only) then
         do k = 1, memory%used
            associate (slot => memory%slot(k))
               call complete(slot%problem, slot%state, slot%workspace, slot%result)
            end associate
         end do
      end if
      call warn_of_direction(problem, memory%geometry%pitch_rate, log)
      call warn_of_slope(problem, memory, log)
      if (problem%in_loop) call memory%course%note(problem%spec%wheelset, merge(problem%spec%wheelset%fz, 0.0_wp, &
         & problem%force_prescribed .and. result%status%is_solved()), memory%geometry%penetration)
      if (problem%in_loop) call note_shares(memory)
      memory%z_ws = z
      memory%started = .true.
      if (.not. problem%geometry_only) call keep_time_step(problem, memory)
      result%smallest_gap = memory%geometry%touch - z
      result%vpitch = memory%geometry%pitch_rate
      result%dy_defl = memory%geometry%deflection
      result%dz_defl = 0.0_wp
      if (problem%force == force_control%massless_rail) call lower_rail(problem, memory, z, result)
      call place(problem, memory%geometry, z, result%dz_defl)
      result%z_ws = z
      if (allocated(result%errors)) deallocate(result%errors)
      if (problem%estimates_errors .and. .not. problem%geometry_only) then
         call estimate_wheel_rail_errors(problem, memory, result, error)
         if (allocated(error)) then
            call memory%last%clear()
            return
         end if
      else if (allocated(memory%slot)) then
         do k = 1, memory%used
            if (allocated(memory%slot(k)%result%errors)) deallocate(memory%slot(k)%result%errors)
         end do
      end if
      call gather(problem, memory, result)
   end subroutine solve_wheel_rail

   !> Reset data that are stored for the rail profile if it has changed
   subroutine reset_for_new_rail(problem, geometry)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(inout) :: geometry

      if (problem%rail%same_as(geometry%known)) return
      geometry%known = problem%rail
      geometry%known_ds = 0.0_wp
      geometry%gauged_height = 0.0_wp
   end subroutine reset_for_new_rail

   !> Find the gauge point of the rail, unless it is that of the last case
   subroutine find_gauge_point(problem, geometry)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_geometry), intent(inout) :: geometry

      associate (cant => problem%spec%track%cant, height => problem%spec%track%gaught)
         if (abs(geometry%gauged_cant - cant) <= 0.0_wp .and. abs(geometry%gauged_height - height) <= 0.0_wp) return
         call gauge_point(problem%rail, cant, height, geometry%top_z, geometry%gauge_y)
         geometry%gauged_cant = cant
         geometry%gauged_height = height
      end associate
   end subroutine find_gauge_point

   !> Is the case one of a loop, with the height as its only unknown?
   pure logical function seeks_height_alone(problem) result(alone)
      type(wheel_rail_problem), intent(in) :: problem

      alone = problem%in_loop .and. problem%force_prescribed .and. .not. problem%geometry_only &
         & .and. problem%force == force_control%creepages
      if (alone) alone = has_one_height(problem%template) .or. problem%template%solves_for_pressure()
   end function seeks_height_alone

   !> Is the last case near enough for its results to be estimates?
   pure logical function follows_last(problem, memory) result(follows)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory

      follows = memory%started .and. problem%template%motion == memory%motion
      if (follows) follows = memory%course%is_near(problem%spec%wheelset)
   end function follows_last

   !> Does the height have a unique solution? FaStrip and ANALYN have jumps of the force, where the last case would decide between
   !> two
   pure logical function has_one_height(template)
      !> Settings common to all patches
      type(patch_problem), intent(in) :: template

      has_one_height = template%pressure /= pressure_model%analyn
      if (allocated(template%simplified)) has_one_height = has_one_height .and. .not. is_fastrip(template%simplified%choice)
   end function has_one_height

   !> Warn of a wheel that rotates against its direction of travel, or does not roll at all
   subroutine warn_of_direction(problem, pitch_rate, log)
      type(wheel_rail_problem), intent(in) :: problem
      !> Pitch rate of the wheelset, prescribed or found [rad/s]
      real(wp), intent(in) :: pitch_rate
      type(log_type), intent(inout) :: log
      character(len=:), allocatable :: travel

      if (.not. any(problem%template%motion == [motion%transient_rolling, motion%steady_rolling])) return
      if (.not. (abs(pitch_rate) > 0.0_wp .or. abs(rate_of_pure_rolling(problem)) > 0.0_wp)) then
         travel = "VS"
         if (problem%spec%roller) travel = "RPITCH"
         call log%warning("rolling without a rolling velocity, " // travel // " = 0 and VPITCH = 0: creepages are relative to the &
            &velocity of sliding, or zero without sliding; a wheel that stands is a case of motion = ""shift""")
         return
      end if
      if (.not. pitch_rate*rate_of_pure_rolling(problem) < 0.0_wp) return
      if (problem%spec%roller) then
         travel = "the roller: with RPITCH = " // real_text(problem%spec%wheelset%rpitch) // " rad/s"
      else
         travel = "the direction of travel: with VS = " // real_text(problem%spec%wheelset%vs) // " mm/s"
      end if
      call log%warning("the wheel turns against " // travel // " it rolls at about VPITCH = " &
         & // real_text(rate_of_pure_rolling(problem)) // " rad/s, and VPITCH = " // real_text(pitch_rate) // " rad/s")
   end subroutine warn_of_direction

   !> Warn of contact beside the top of a roller: planes of patches are level along the track
   subroutine warn_of_slope(problem, memory, log)
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      type(log_type), intent(inout) :: log
      !> Inclination along the track that is not mentioned [rad]: the share of the normal force that FX lacks; chosen
      real(wp), parameter :: level = 0.02_wp
      real(wp) :: slope
      integer :: k

      if (.not. problem%spec%roller) return
      do k = 1, memory%used
         associate (point => memory%slot(k)%plane%origin)
            slope = atan2(point(1), memory%geometry%placement%roller_radius - point(3))
            if (abs(slope) <= level) cycle
            call log%warning("a contact patch is " // real_text(point(1)) // " mm ahead of the axle of the roller, where the &
               &surfaces are inclined by " // real_text(slope) // " rad along the track; patches are level along the track, so &
               &that this share of the normal force is missing from FX(TR)")
            return
         end associate
      end do
   end subroutine warn_of_slope

   !> Set the previous time step, according to the relation to the previous case
   subroutine begin_step(problem, memory, log)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      type(log_type), intent(inout) :: log
      integer :: dropped

      associate (geometry => memory%geometry)
         select case (problem%link)
         case (time_link%initiate)
            call geometry%before%clear()
            geometry%before%travel = 0.0_wp
         case (time_link%repeat_step)
            ! in steady rolling the previous tractions are the present ones
            if (memory%motion == motion%steady_rolling .and. any(problem%template%motion == [motion%shift, &
               & motion%transient_rolling])) geometry%before = memory%last
         case default
            geometry%before = memory%last
            if (problem%link == time_link%continue_normal) call geometry%before%drop_tangential()
         end select
         geometry%travel = problem%spec%wheelset%s
         if (problem%spec%roller) geometry%travel = geometry%before%travel + problem%spec%wheelset%rpitch*problem%spec%track%nomradr
         ! solutions on another lattice are not used as estimates
         if (problem%template%motion /= memory%motion) memory%slot%state%started = .false.
         memory%motion = problem%template%motion
         call geometry%before%set_frame(follows_rail=problem%template%motion == motion%shift)
         if (.not. keeps_lattice(problem)) return
         call geometry%before%drop_other_elements(problem%spec%search%dx, problem%spec%search%ds, dropped)
         if (dropped > 0) call log%warning("the previous case has elements of other sizes; its tractions are not used")
      end associate
   end subroutine begin_step

   !> Store the friction ratios of this case for the next ones
   pure subroutine note_shares(memory)
      type(wheel_rail_memory), intent(inout) :: memory
      integer :: k

      do k = 1, size(memory%slot)
         if (k <= memory%used) then
            call memory%slot(k)%shares%note(memory%slot(k)%friction_share)
         else
            call memory%slot(k)%shares%forget()
         end if
      end do
   end subroutine note_shares

   !> Store the tractions of this case for the next one
   subroutine keep_time_step(problem, memory)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      integer :: k

      call memory%last%start(memory%used, problem%template%motion == motion%shift, memory%geometry%travel)
      do k = 1, memory%used
         associate (slot => memory%slot(k))
            call memory%last%add(k, slot%state%now, slot%reference, box_on_lattice(problem, memory%geometry, slot%region))
         end associate
      end do
   end subroutine keep_time_step
end module contact_wheelrail_solve
