!> Height of the wheelset: prescribed, or that at which the vertical force acts
!>
!> The search itself is that of contact_wheelrail_force_balance. Where tangential tractions do not change the
!> pressures, only normal problems are solved on the way, with the tangential forces in a fixed ratio to the
!> normal ones; the tangential problem comes last and corrects that ratio. References and grids belong to the
!> height of each trial.
module contact_wheelrail_height
   use contact_base_case_status, only : case_status
   use contact_base_choices, only : force_control, motion
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_text_words, only : integer_text, real_text
   use contact_wheelrail_force_balance, only : balance_ending, force_balance
   use contact_wheelrail_geometry, only : measure
   use contact_wheelrail_memory, only : wheel_rail_memory, vertical_force, vertical_slope
   use contact_wheelrail_problem, only : wheel_rail_problem
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_trial, only : evaluate, learn_shares
   implicit none (type, external)
   private

   public :: settle, out_of_sight, small_step

   !> Searches with ratios of friction that are kept, each followed by a tangential solution
   integer, parameter :: rounds_apart = 4

   !> Steps of the force that are due to the grids, relative to the force
   real(wp), parameter :: small_step = 1.0e-4_wp

   !> The deepest first trial [mm]
   real(wp), parameter :: deepest_guess = 5.0_wp

   !> A trial after one that missed the force by less than so many times EPS solves pressures to that part of EPS
   real(wp), parameter :: near_by = 20.0_wp, sharper = 0.05_wp
   !> Least part of the normal forces that pressures are made sharper for
   real(wp), parameter :: smallest = 1.0e-4_wp

   !> Forces below this value ask for a wheel that just touches [N]
   real(wp), parameter :: no_force = 1.0e-9_wp

   !> Where the normal forces are so many times the prescribed force, friction carries nearly all of them
   real(wp), parameter :: mostly_friction = 20.0_wp

   !> Heights and deflections this far away are out of reach [mm]
   real(wp), parameter :: out_of_sight = 500.0_wp

contains

   !> Height and contact for the present deflection of the rail and the present pitch rate
   subroutine settle(problem, memory, z, log, result, error)
      !> What is asked: height or force, profiles, friction
      type(wheel_rail_problem), intent(in) :: problem
      !> Solved patches of the height that is found; estimates of former searches help
      type(wheel_rail_memory), intent(inout) :: memory
      !> Height of the wheelset above a rail without vertical deflection [mm]
      real(wp), intent(out) :: z
      !> Takes a line per trial, and warnings
      type(log_type), intent(inout) :: log
      !> Says whether force and friction were found
      type(wheel_rail_result), intent(inout) :: result
      !> Allocated when a trial has no result
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: target, spring
      character(len=12) :: wanted, touching
      logical :: height_is_unknown

      result%status = case_status()
      height_is_unknown = problem%force_prescribed .or. problem%force == force_control%massless_rail
      z = problem%spec%wheelset%z
      if (height_is_unknown) then
         z = 0.0_wp
         ! a case that starts anew does not depend on those before it
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
      if (memory%geometry%touch - z > out_of_sight) then
         memory%used = 0
         call result%status%miss_force("vertical force", problem%spec%wheelset%fz, 0.0_wp, &
            & "wheel and rail do not meet: their lateral positions are apart")
         call log%warning(result%status%reason)
         return
      end if
      associate (touch => memory%geometry%touch, rail => problem%spec%rail)
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
            z = touch
            if (.not. problem%force_prescribed) z = problem%spec%wheelset%z - rail%fz/rail%kz
            if (problem%force_prescribed .and. target < -no_force) then
               call result%status%miss_force("vertical force", target, 0.0_wp, "FZ < 0 pulls at the wheel, which contact &
                  &cannot: the wheel stands at first touch without any force")
               call log%warning(result%status%reason)
            end if
         end if
      end associate
   end subroutine settle

   !> Search the height at which the vertical force acts
   !>
   !> First without friction in the trials: the forces of friction follow the normal ones in the ratio of the last tangential
   !> solution, which is corrected at every height found. Where that does not lead to the force, a new search begins with
   !> friction in every trial; what it says is final.
   subroutine balance_forces(problem, memory, target, spring, z, log, result, error)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(inout) :: memory
      !> Prescribed force [N]: of the contact, and of a spring that is free of force at first touch, with its stiffness [N/mm]
      real(wp), intent(in) :: target, spring
      !> Height found [mm]
      real(wp), intent(out) :: z
      type(log_type), intent(inout) :: log
      type(wheel_rail_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      type(force_balance) :: balance
      character(len=:), allocatable :: why
      character(len=8) :: missed
      real(wp) :: force, first_guess, guess, touch, bottom, slope, miss, last_miss
      !> What the last trial missed the force by, relative to it; the force relative to the normal forces where friction carries
      !> nearly all of these, otherwise 1
      real(wp) :: off, small
      logical :: separate
      integer :: round, trials

      touch = memory%geometry%touch
      ! friction decouples from the pressures for bodies that are alike
      separate = problem%template%motion /= motion%none .and. .not. problem%template%model%coupled()
      guess = penetration_guess(problem, memory, target)
      if (spring > 0.0_wp) guess = min(guess, target/spring)
      call refuse_soft_bodies(memory%geometry%placement%wheel_radius, target, guess, error)
      if (allocated(error)) return
      guess = touch + min(guess, deepest_guess)
      if (problem%use_previous .and. memory%started .and. memory%z_ws > touch) guess = memory%z_ws
      if (memory%geometry%penetration > 0.0_wp) guess = touch + memory%geometry%penetration
      if (problem%geometry_only) then
         ! there are no forces to tell a better height
         z = guess
         call evaluate(problem, memory, z, with_friction=.false., log=log, error=error)
         return
      end if
      first_guess = guess
      bottom = touch
      trials = 0
      last_miss = huge(last_miss)
      off = huge(off)
      small = 1.0_wp
      do round = 1, rounds_apart
         if (.not. separate) exit
         call search(with_friction=.false., max_trials=problem%template%settings%maxnr/2 - trials)
         if (allocated(error)) return
         if (balance%ended /= balance_ending%reached .and. abs(balance%force - target) > small_step*target) then
            separate = .false.
            guess = balance%z
            if (balance%has_high) guess = balance%next_trial(guess)
            if (balance%ended == balance_ending%out_of_reach) guess = first_guess
            exit
         end if
         ! the tangential problem at the height found corrects the lateral forces
         call try_height(z, with_friction=.true.)
         if (allocated(error)) return
         call learn_shares(memory)
         miss = abs(force - target)
         if (miss <= balance%tolerance) exit
         guess = z + (target - force)/max(slope, 0.1_wp*target/max(z - touch, 1.0e-6_wp))
         if (guess <= bottom) guess = z
         ! on steep flanks friction carries so much of the force that its ratio does not settle by itself
         separate = round < rounds_apart .and. miss < 0.5_wp*last_miss .and. trials < problem%template%settings%maxnr/2
         last_miss = miss
      end do
      if (.not. separate) then
         ! one trial is left for a last look at the best height
         call search(with_friction=.true., max_trials=problem%template%settings%maxnr - trials - 1)
         if (allocated(error)) return
         if (abs(balance%force - force) > 0.0_wp) then
            call try_height(z, with_friction=.true.)
            if (allocated(error)) return
         end if
      end if
      call log%speak()
      memory%geometry%penetration = z - touch
      result%force_evaluations = result%force_evaluations + trials
      result%max_trials = max(result%max_trials, trials)
      result%force_error = vertical_force(memory) + spring*(z - touch) - target
      ! grids follow the contact in whole elements, which leaves small steps in the force
      if (abs(result%force_error) > max(balance%tolerance, small_step*target)) then
         call explain(balance, target, sum_of_normal_forces(memory), why)
         call result%status%miss_force("vertical force", target, target + result%force_error, why)
         call log%warning(result%status%reason)
      else if (abs(result%force_error) > balance%tolerance) then
         write(missed, "(ES8.1)") abs(result%force_error)/target
         call log%warning("the vertical force is met within " // trim(adjustl(missed)) // " of what is asked for, not within EPS: &
            &grids follow the contact in whole elements, and the force has steps of that size")
      end if

   contains

      !> A search from a bracket of its own, from `guess` on; its best height is z
      subroutine search(with_friction, max_trials)
         logical, intent(in) :: with_friction
         integer, intent(in) :: max_trials
         integer :: before, k

         before = trials
         call bracket(with_friction, max_trials)
         if (allocated(error) .or. balance%ended /= balance_ending%above_touch) return
         ! Elements overlap before the mesh of the gap does, by less than its width shows: the regions of the first touch stay
         ! while the wheel is lifted off
         memory%geometry%lowest_for_regions = touch + 2.0_wp*balance%resolution
         bottom = touch - 1.0e-6_wp
         do k = 1, memory%used
            bottom = min(bottom, touch - 6.0_wp*memory%slot(k)%result%pen)
         end do
         guess = touch
         call bracket(with_friction, max_trials - (trials - before))
      end subroutine search

      !> A search between two heights
      subroutine bracket(with_friction, max_trials)
         logical, intent(in) :: with_friction
         integer, intent(in) :: max_trials
         real(wp) :: trial

         call balance%start(target, problem%template%settings%eps, bottom, touch + 1.1_wp*memory%geometry%placement%wheel_radius, &
            & max(1, max_trials), forces_are_estimates=.not. with_friction)
         do while (balance%ended == balance_ending%running)
            trial = balance%next_trial(guess)
            call try_height(trial, with_friction)
            if (allocated(error)) return
            call balance%record(trial, force, slope, memory%used)
         end do
         z = balance%z
      end subroutine bracket

      !> Force and slope at a height; only the warnings of the last trial, or of one that fails, are those of the case
      subroutine try_height(z, with_friction)
         real(wp), intent(in) :: z
         logical, intent(in) :: with_friction

         call log%hold()
         ! pressures within EPS of the last ones would be taken for those of this height
         memory%geometry%pressure_eps = 1.0_wp
         if (off > problem%template%settings%eps .and. off*small < near_by*problem%template%settings%eps) &
            & memory%geometry%pressure_eps = sharper*small
         call evaluate(problem, memory, z, with_friction, log, error)
         trials = trials + 1
         memory%geometry%pressure_eps = 1.0_wp
         if (allocated(error)) then
            call log%speak()
            return
         end if
         force = vertical_force(memory) + spring*(z - touch)
         off = abs(force - target)/target
         ! a small difference of large forces needs sharper ones
         small = 1.0_wp
         if (sum_of_normal_forces(memory) > mostly_friction*target) &
            & small = max(smallest, target/sum_of_normal_forces(memory))
         slope = vertical_slope(memory) + spring
         call trace_trial(log, result%force_evaluations + trials, z, force, slope)
      end subroutine try_height
   end subroutine balance_forces

   !> Line of the flow trace
   subroutine trace_trial(log, number, z, force, slope)
      type(log_type), intent(inout) :: log
      integer, intent(in) :: number
      real(wp), intent(in) :: z, force, slope
      character(len=100) :: line

      if (.not. log%shows(1)) return
      write(line, "(4X,I6,A,F12.4,ES12.4,A,ES12.3)") number, ", NR,  z_ws, Fz: ", z, force, ", dFz/dz:", slope
      call log%trace(1, trim(line))
   end subroutine trace_trial

   !> Normal forces of all patches [N]
   pure real(wp) function sum_of_normal_forces(memory) result(total)
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      total = 0.0_wp
      do k = 1, memory%used
         total = total + memory%slot(k)%result%fn
      end do
   end function sum_of_normal_forces

   !> Say why the force was not reached
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
               why = why // "change their place or their angle"
            end if
         case (balance_ending%above_touch)
            why = "more acts at the first touch already"
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

   !> Penetration by Hertz's theory for the place of first touch [mm]
   real(wp) function penetration_guess(problem, memory, force) result(pen)
      type(wheel_rail_problem), intent(in) :: problem
      type(wheel_rail_memory), intent(in) :: memory
      real(wp), intent(in) :: force
      real(wp) :: a, b, bend, modulus
      integer :: i, k

      associate (gap => memory%geometry%gap)
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
      pen = max(pen, 1.0e-6_wp)
   end function penetration_guess

   !> Refuse bodies so soft that the search would go on to contacts of the size of the wheel
   subroutine refuse_soft_bodies(radius, force, penetration, error)
      !> Of the wheel [mm]
      real(wp), intent(in) :: radius
      !> Prescribed force [N], and the penetration that Hertz's theory expects [mm]
      real(wp), intent(in) :: force, penetration
      type(error_type), allocatable, intent(out) :: error

      if (penetration <= radius) return
      call fatal_error(error, "a vertical force of " // real_text(force) // " N would press wheel and rail about " // &
         & real_text(penetration) // " mm into each other by Hertz's theory, more than the radius of the wheel, " // &
         & real_text(radius) // " mm; expected stiffer bodies (GG) or a smaller force", error_kind%input)
   end subroutine refuse_soft_bodies
end module contact_wheelrail_height
