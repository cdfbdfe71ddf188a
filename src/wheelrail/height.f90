!> Height of the wheelset: prescribed, or determined by the vertical force
!>
!> The root search is in contact_wheelrail_force_balance. If tangential tractions do not affect the pressures, trials solve normal
!> problems only, with a fixed ratio of tangential to normal forces; the tangential problem is solved last and corrects the ratio.
!> References and grids are those of the height of each trial.
module contact_wheelrail_height
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : force_control, motion
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_first_penetration, only : hertz_penetration, min_penetration
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   use contact_wheelrail_gap, only : gap_curve
   use contact_wheelrail_geometry, only : measure, wheel_rail_geometry
   use contact_wheelrail_height_search, only : height_search, mostly_friction
   use contact_wheelrail_memory, only : sum_of_normal_forces, wheel_rail_memory, vertical_force
   use contact_wheelrail_placement, only : side_sign
   use contact_wheelrail_problem, only : follows_surface, keeps_lattice, load_of, wheel_rail_problem
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_trial, only : evaluate, learn_shares
   implicit none (type, external)
   private

   public :: find_height, contact_reach, small_step

   !> Maximum number of tangential solutions in a search with fixed friction ratios; if one misses the force by less than the
   !> fraction `direct`, the next tangential solution follows after one step, without trials in between
   integer, parameter :: rounds_apart = 6
   real(wp), parameter :: direct = 0.02_wp
   !> Tolerance of the force with estimated friction ratios [-]
   real(wp), parameter :: estimated = 1.0e-3_wp

   !> Steps of the force caused by changes of the grids, relative to the force [-]
   real(wp), parameter :: small_step = 1.0e-4_wp

   !> Maximum penetration of the first trial [mm]
   real(wp), parameter :: deepest_guess = 5.0_wp

   !> Forces below this value are regarded as zero: the wheel just touches the rail [N]
   real(wp), parameter :: no_force = 1.0e-9_wp

   !> Lower bound of the stiffness, relative to force over penetration, for the step that corrects a missed force: a Hertzian
   !> contact has 1.5
   real(wp), parameter :: min_stiffness = 0.1_wp
   !> Maximum reduction factor of the missed force per correction of friction; otherwise the ratio does not converge
   real(wp), parameter :: good_progress = 0.5_wp

   !> Width over which the curvature of the gap across the track is measured, of the order of a patch [mm]; maximum curvature
   !> [1/mm], above which the gap has a kink
   real(wp), parameter :: bend_reach = 2.0_wp, max_bend = 10.0_wp
   !> Minimum curvature of the gap, which may have none [1/mm]
   real(wp), parameter :: min_curvature = 1.0e-8_wp

   !> Number of corrections of an estimate by the width of the contact
   integer, parameter :: rounds_of_width = 3

   !> Distance of heights and deflections beyond which there is no contact [mm]
   real(wp), parameter :: contact_reach = 500.0_wp

contains

   !> Find height and contact for the present deflection of the rail and the present pitch rate
   subroutine find_height(problem, memory, z, log, result, error)
      !> The problem: height or force, profiles, friction
      type(wheel_rail_problem), intent(in) :: problem
      !> Patches are solved at the height found; results of earlier searches serve as estimates
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm]
      real(wp), intent(out) :: z
      !> Receives a line per trial, and warnings
      type(log_type), intent(inout) :: log
      !> Its status: whether force and friction were found
      type(wheel_rail_result), intent(inout) :: result
      !> Allocated if a trial has no result
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: target, spring
      character(len=12) :: wanted, touching
      character(len=:), allocatable :: reason
      logical :: height_is_unknown

      result%status = case_status()
      height_is_unknown = problem%force_prescribed .or. problem%force == force_control%massless_rail
      z = problem%spec%wheelset%z
      if (height_is_unknown) then
         z = 0.0_wp
         ! a case that starts anew does not depend on previous cases
         if (memory%started .and. problem%use_previous) z = memory%z_ws
      end if
      call measure(problem, memory%geometry, z)
      memory%geometry%lowest_for_regions = -huge(z)
      if (.not. height_is_unknown) then
         if (z - memory%geometry%touch > memory%geometry%placement%wheel_radius) then
            write(wanted, "(ES10.3)") z
            write(touching, "(F12.4)") memory%geometry%touch
            call fatal_error(error, "Z_WS = " // trim(adjustl(wanted)) // " mm presses the wheel deeper into the rail than its &
               &radius; it touches the rail at Z_WS = " // trim(adjustl(touching)) // " mm")
            return
         end if
         call evaluate(problem, memory, z, with_friction=.true., log=log, error=error)
         return
      end if
      if (memory%geometry%touch - z > contact_reach) then
         memory%used = 0
         if (problem%force_prescribed) then
            call explain_gap(problem, memory%geometry, reason)
            call result%status%record_missed_force("vertical force", problem%spec%wheelset%fz, 0.0_wp, reason)
            call log%warning(result%status%reason)
         else
            z = problem%spec%wheelset%z - problem%spec%rail%fz/problem%spec%rail%kz
         end if
         return
      end if
      associate (touch => memory%geometry%touch, rail => problem%spec%rail)
         if (problem%force_prescribed) then
            spring = 0.0_wp
            target = problem%spec%wheelset%fz
         else
            ! the rail's springs deflect by the difference between height and penetration
            spring = rail%kz
            target = rail%kz*(problem%spec%wheelset%z - touch) - rail%fz
         end if
         if (target > no_force) then
            call balance_forces(problem, memory, target, spring, z, log, result, error)
         else
            memory%used = 0
            z = touch
            if (.not. problem%force_prescribed) z = problem%spec%wheelset%z - rail%fz/rail%kz
            if (problem%force_prescribed .and. target < -no_force) then
               call result%status%record_missed_force("vertical force", target, 0.0_wp, "FZ < 0 pulls at the wheel, which contact &
                  &cannot: the wheel is placed at first contact, without force")
               call log%warning(result%status%reason)
            end if
         end if
      end associate
   end subroutine find_height

   !> Reason why wheel and rail do not meet at any height
   subroutine explain_gap(problem, geometry, reason)
      type(wheel_rail_problem), intent(in) :: problem
      !> With the placement, and the deflection of a rail on springs
      type(wheel_rail_geometry), intent(in) :: geometry
      character(len=:), allocatable, intent(out) :: reason

      reason = "wheel and rail do not meet: "
      associate (ahead => geometry%placement%wheel%origin(1), radius => geometry%placement%roller_radius)
         if (problem%spec%roller .and. abs(ahead) > radius) then
            reason = reason // "the wheel is " // real_text(ahead) // " mm ahead of the axle of the roller, whose radius is " // &
               & real_text(radius) // " mm"
            return
         end if
      end associate
      reason = reason // "their lateral positions are apart"
      if (abs(geometry%deflection) > 0.0_wp) reason = reason // ", with a rail on springs at DY_DEFL = " // &
         & real_text(side_sign(problem%spec)*geometry%deflection) // " mm"
   end subroutine explain_gap

   !> Find the height at which the vertical force acts
   !>
   !> At first without friction in the trials: tangential forces are in the ratio of the last tangential solution to the normal
   !> forces; the ratio is corrected at every height found. If this does not converge, a new search includes friction in every
   !> trial; its result is final.
   subroutine balance_forces(problem, memory, target, spring, z, log, result, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      !> Prescribed total force [N] of the contact and of a spring without force at first touch; stiffness of this spring [N/mm]
      real(wp), intent(in) :: target, spring
      !> Height found [mm]
      real(wp), intent(out) :: z
      type(log_type), intent(inout) :: log
      type(wheel_rail_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      type(height_search) :: search
      logical :: is_settled
      integer :: coarser

      call search%begin(memory, target, spring, result%force_evaluations)
      search%guess = penetration_guess(problem, memory, target)
      if (spring > 0.0_wp) search%guess = min(search%guess, target/spring)
      call refuse_soft_bodies(memory%geometry%placement%wheel_radius, target, search%guess, error)
      if (allocated(error)) return
      search%guess = search%touch + min(search%guess, deepest_guess)
      if (problem%use_previous .and. memory%started .and. memory%z_ws > search%touch) search%guess = memory%z_ws
      if (memory%geometry%penetration > 0.0_wp) search%guess = search%touch + memory%geometry%penetration
      z = search%guess
      if (problem%geometry_only) then
         ! without forces there is no better height
         call evaluate(problem, memory, z, with_friction=.false., log=log, error=error)
         return
      end if
      is_settled = .false.
      search%is_sharp = memory%geometry%follows
      if (memory%geometry%follows_height) then
         if (memory%geometry%follows_last) &
            & search%guess = search%touch + memory%course%penetration(problem%spec%wheelset, target)
         call search%follow(problem, memory, memory%course%stiffer, memory%course%first_miss, memory%course%sway, &
            & is_settled, log, error)
         if (.not. allocated(error) .and. is_settled) call learn_shares(memory)
      end if
      if (.not. (is_settled .or. allocated(error))) then
         coarser = coarsening(problem, memory, search%guess - search%touch)
         if (coarser > 1) call search%approach(problem, memory, coarser, log)
         call search_apart(problem, memory, search, is_settled, log, error)
      end if
      if (.not. allocated(error) .and. .not. is_settled) call search_together(problem, memory, search, log, error)
      z = search%z
      if (allocated(error)) return
      call log%write_held()
      memory%geometry%penetration = z - search%touch
      result%force_evaluations = result%force_evaluations + search%trials
      result%max_trials = max(result%max_trials, search%trials)
      result%force_error = vertical_force(memory) + spring*(z - search%touch) - target
      call report_missed_force(memory, search, log, result)
   end subroutine balance_forces

   !> Search without friction in the trials, with tangential solutions at the heights found
   subroutine search_apart(problem, memory, search, is_settled, log, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      !> After `begin`, with the first estimate; on exit the next estimate
      type(height_search), intent(inout) :: search
      !> Was the force found? Otherwise friction must be included in every trial
      logical, intent(out) :: is_settled
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: first_guess, miss, last_miss, last_z, last_force, stiffer
      integer :: round

      ! tangential tractions do not affect the pressures of similar bodies; with simplified theory they are cheap to compute
      is_settled = problem%template%motion /= motion%none .and. .not. problem%template%model%coupled() &
         & .and. .not. allocated(problem%template%simplified)
      if (.not. is_settled) return
      first_guess = search%guess
      last_miss = huge(last_miss)
      last_z = 0.0_wp
      last_force = 0.0_wp
      stiffer = 1.0_wp
      associate (maxnr => problem%template%settings%maxnr, eps => problem%template%settings%eps, target => search%target, &
         & balance => search%balance)
         do round = 1, rounds_apart
            if (last_miss > direct*target) then
               call search%run(problem, memory, .false., max(eps, estimated), maxnr/2 - search%trials, log, error)
               if (allocated(error)) return
               if (balance%ended /= balance_ending%reached .and. abs(balance%force - target) > small_step*target) then
                  is_settled = .false.
                  search%guess = balance%z
                  if (balance%has_high) search%guess = balance%next_trial(search%guess)
                  if (balance%ended == balance_ending%out_of_reach) search%guess = first_guess
                  return
               end if
            else
               search%z = search%guess
            end if
            ! the tangential problem at the height found corrects the friction ratios
            call search%try(problem, memory, search%z, .true., log, error)
            if (allocated(error)) return
            call learn_shares(memory)
            miss = abs(search%force - target)
            balance%tolerance = eps*target
            if (miss <= balance%tolerance) then
               call search%end_exactly(problem, memory, stiffer, log)
               return
            end if
            if (round > 1) call search%compare_stiffness(search%z, last_z, last_force, stiffer)
            search%guess = search%z + (target - search%force) &
               & /max(stiffer*search%stiffness, min_stiffness*target/max(search%z - search%touch, min_penetration))
            if (search%guess <= search%bottom) search%guess = search%z
            ! on steep flanks friction carries a large part of the force, and its ratio does not converge
            is_settled = round < rounds_apart .and. miss < good_progress*last_miss .and. search%trials < maxnr/2
            if (.not. is_settled) return
            last_miss = miss
            last_z = search%z
            last_force = search%force
         end do
      end associate
   end subroutine search_apart

   !> Search with friction in every trial
   subroutine search_together(problem, memory, search, log, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      !> After `begin`, with the first estimate
      type(height_search), intent(inout) :: search
      type(log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error

      ! one trial is reserved for the final solution at the best height
      associate (settings => problem%template%settings)
         call search%run(problem, memory, .true., settings%eps, settings%maxnr - search%trials - 1, log, error)
      end associate
      if (allocated(error)) return
      if (abs(search%balance%force - search%force) > 0.0_wp) call search%try(problem, memory, search%z, .true., log, error)
      if (.not. allocated(error)) call search%end_exactly(problem, memory, 1.0_wp, log)
   end subroutine search_together

   !> Warn of a missed force; the case has failed if the deviation exceeds the effect of the grids
   subroutine report_missed_force(memory, search, log, result)
      type(wheel_rail_memory), intent(in) :: memory
      !> Finished search
      type(height_search), intent(in) :: search
      type(log_type), intent(inout) :: log
      !> Result with `force_error`; its status is set
      type(wheel_rail_result), intent(inout) :: result
      character(len=:), allocatable :: why
      character(len=8) :: missed

      associate (target => search%target, tolerance => search%balance%tolerance)
         ! grids change by whole elements, which causes small steps in the force
         if (abs(result%force_error) > max(tolerance, small_step*target)) then
            call explain(search%balance, target, sum_of_normal_forces(memory), why)
            call result%status%record_missed_force("vertical force", target, target + result%force_error, why)
            call log%warning(result%status%reason)
         else if (abs(result%force_error) > tolerance) then
            write(missed, "(ES8.1)") abs(result%force_error)/target
            call log%warning("the vertical force is met within " // trim(adjustl(missed)) // " of the prescribed value, not within &
               &EPS: grids follow the contact in whole elements, and the force has steps of that size")
         end if
      end associate
   end subroutine report_missed_force

   !> Reason why the force was not reached
   pure subroutine explain(balance, target, normal_forces, why)
      type(force_balance), intent(in) :: balance
      !> Prescribed force, and the sum of the normal forces of all patches [N]
      real(wp), intent(in) :: target, normal_forces
      character(len=:), allocatable, intent(out) :: why

      associate (low => balance%low, high => balance%high)
         select case (balance%ended)
         case (balance_ending%jump)
            why = "it jumps from " // real_text(low%force) // " to " // real_text(high%force) // " N at a penetration of " &
               & // real_text(high%z - balance%touch) // " mm, where contact patches "
            if (low%patches /= high%patches) then
               why = why // "join or separate (" // integer_text(low%patches) // ", then " // integer_text(high%patches) // ")"
            else
               why = why // "change their position or angle, or elements enter them"
            end if
         case (balance_ending%above_touch)
            why = "it is exceeded at first touch"
         case (balance_ending%out_of_reach)
            why = "it is out of reach"
         case default
            why = "all MAXNR trials were used"
            if (balance%has_high) why = why // "; " // real_text(low%force) // " and " // real_text(high%force) &
               & // " N act at penetrations of " // real_text(low%z - balance%touch) // " and " &
               & // real_text(high%z - balance%touch) // " mm"
         end select
      end associate
      if (normal_forces > mostly_friction*target) why = why // "; friction carries the wheel: of normal forces of " &
         & // real_text(normal_forces) // " N next to nothing remains"
   end subroutine explain

   !> Penetration by Hertz's theory at the position of first touch [mm]
   real(wp) function penetration_guess(problem, memory, force) result(pen)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      real(wp), intent(in) :: force
      real(wp) :: curvature(2), load
      integer :: lowest, round

      curvature = curvatures(memory%geometry%gap)
      load = load_of(problem, force)
      pen = hertz_penetration(load, sqrt(curvature(1)*curvature(2)))
      if (.not. problem%in_loop) return
      ! curvature over the width of the contact
      lowest = minloc(memory%geometry%gap%gap, dim=1)
      do round = 1, rounds_of_width
         pen = hertz_penetration(load, sqrt(curvature(1)*bend_over(memory%geometry%gap, lowest, 0.5_wp*pen)))
      end do
   end function penetration_guess

   !> Half the second derivative of the parabola that has the width of the gap at a given opening [1/mm]
   pure real(wp) function bend_over(gap, lowest, opening) result(bend)
      type(gap_curve), intent(in) :: gap
      !> Index of the mesh point with the smallest gap
      integer, intent(in) :: lowest
      !> Difference of the gap to its minimum [mm]
      real(wp), intent(in) :: opening
      integer :: i, side
      real(wp) :: width, level

      level = gap%gap(lowest) + opening
      width = 0.0_wp
      do side = -1, 1, 2
         i = lowest
         do while (i > 1 .and. i < gap%n)
            if (gap%gap(i + side) > level) exit
            i = i + side
         end do
         width = width + abs(gap%y(i) - gap%y(lowest))
         if (i > 1 .and. i < gap%n) width = width + gap%dy*(level - gap%gap(i))/(gap%gap(i + side) - gap%gap(i))
      end do
      ! a gap with its minimum at an end has no width
      bend = max_bend
      if (width > 0.0_wp) bend = min(max_bend, opening/(0.5_wp*width)**2)
   end function bend_over

   !> Factor by which elements may be enlarged in a search for an estimate
   !>
   !> No such search is needed with results of the previous case, or of an earlier search of this one.
   integer function coarsening(problem, memory, penetration) result(coarser)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      !> Estimated penetration [mm]
      real(wp), intent(in) :: penetration
      !> Minimum number of elements across the overlap of the bodies, and maximum factor
      real(wp), parameter :: enough = 14.0_wp
      real(wp), parameter :: largest = 6.0_wp

      coarser = 1
      if (memory%geometry%follows .or. memory%geometry%penetration > 0.0_wp .or. problem%use_previous) return
      if (keeps_lattice(problem) .or. follows_surface(problem) .or. .not. problem%template%model%is_flat()) return
      associate (search => problem%spec%search, half => sqrt(penetration/max(curvatures(memory%geometry%gap), min_curvature)))
         coarser = int(max(1.0_wp, min(largest, 2.0_wp*minval(half/[search%dx, search%ds])/enough)))
      end associate
   end function coarsening

   !> Half the second derivatives of the gap at its minimum, along and across the track [1/mm]
   pure function curvatures(gap) result(curvature)
      type(gap_curve), intent(in) :: gap
      real(wp) :: curvature(2), bend
      integer :: i, k

      i = minloc(gap%gap, dim=1)
      curvature = gap%kappa
      k = max(1, nint(bend_reach/gap%dy))
      if (i - k < 1 .or. i + k > gap%n) return
      bend = (gap%gap(i - k) - 2.0_wp*gap%gap(i) + gap%gap(i + k))/(k*gap%dy)**2
      if (bend > 0.0_wp .and. bend < max_bend) curvature(2) = 0.5_wp*bend
   end function curvatures

   !> Refuse bodies so soft that the contact would be as large as the wheel
   subroutine refuse_soft_bodies(radius, force, penetration, error)
      !> Radius of the wheel [mm]
      real(wp), intent(in) :: radius
      !> Prescribed force [N], and penetration by Hertz's theory [mm]
      real(wp), intent(in) :: force, penetration
      type(error_type), allocatable, intent(out) :: error

      if (penetration <= radius) return
      call fatal_error(error, "a vertical force of " // real_text(force) // " N would press wheel and rail about " // &
         & real_text(penetration) // " mm into each other by Hertz's theory, more than the radius of the wheel, " // &
         & real_text(radius) // " mm; expected stiffer bodies (GG) or a smaller force", error_kind%input)
   end subroutine refuse_soft_bodies
end module contact_wheelrail_height
