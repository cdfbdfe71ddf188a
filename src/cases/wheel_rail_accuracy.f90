!> A wheel on a rail solved to a prescribed accuracy: smaller elements from one solution to the next
!>
!> As contact_cases_accuracy, but the sides of the elements, DX and DS, are chosen, since windows follow from the geometry.
module contact_cases_wheel_rail_accuracy
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_choices, only : motion, normal_control
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_base_log, only : log_type
   use contact_cases_accuracy_grid, only : across_contact
   use contact_cases_accuracy_plan, only : accuracy_law, expected_law, finer_across, first_across, first_order_alone, &
      & is_near_enough, most_elements, most_levels, not_converged, observed_order, prepare_level, &
      & refuse_case, shorten_aspect, solver_tolerance
   use contact_cases_accuracy_time, only : most_in_time, time_is_left
   use contact_cases_approximate_methods, only : approximate_method, choose_method
   use contact_cases_estimate, only : typical_half_side, usual_margin
   use contact_cases_spec, only : case_spec
   use contact_cases_subsurface, only : subsurface_stresses, warn_of_subsurface
   use contact_cases_wheel_rail_session, only : solve_wheel_rail_case, wheel_rail_session
   use contact_patch_error_estimate, only : error_of_forces
   use contact_patch_order, only : order_of_errors
   use contact_patch_quantities, only : total_list
   use contact_text_words, only : real_text
   use contact_wheelrail_memory, only : wheel_rail_memory
   use contact_wheelrail_result, only : wheel_rail_result
   use contact_wheelrail_spec, only : wheel_rail_spec
   implicit none (type, external)
   private

   public :: error_of_pair, first_sides, is_worth_while, lowest_order_of_errors, smaller_sides, solve_wheel_on_rail

   !> Vertical force for the first size of elements if none is prescribed [N]
   real(wp), parameter :: usual_force = 6.0e4_wp
   !> Relative error assumed for a patch of too few elements for an estimate
   real(wp), parameter :: error_of_few = 0.3_wp
   !> Minimum ratio of old to new sides; smaller reductions are not tried
   real(wp), parameter :: worth = 1.15_wp
   !> Ratio of the next sides to the present ones without any patch
   real(wp), parameter :: without_patches = 0.4_wp
   !> Minimum ratio of the sides to the next ones, where limits allow it; chosen, above `worth`
   real(wp), parameter :: least_ratio = 1.2_wp

contains

   !> Solve one case: as specified, or with the elements required by its accuracy
   subroutine solve_wheel_on_rail(session, spec, folder, log, result, solved, error)
      type(wheel_rail_session), intent(inout) :: session
      !> Complete specification of a case of module 1
      type(case_spec), intent(in) :: spec
      !> Folder to which names of profile files are relative, "" for the current one
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      !> Result, with `accuracy` if one is prescribed
      type(wheel_rail_result), intent(inout) :: result
      !> The case with DX, DS, the order and EPS chosen for its accuracy; unallocated if none is prescribed
      type(case_spec), allocatable, intent(out) :: solved
      type(error_type), allocatable, intent(out) :: error
      integer :: k

      if (.not. (abs(spec%iteration%accuracy) > 0.0_wp .and. spec%solve)) then
         if (allocated(result%accuracy)) deallocate(result%accuracy)
         call solve_wheel_rail_case(session, spec, folder, log, result, error)
         return
      end if
      call refuse_case(spec, error)
      if (allocated(error)) return
      call log%defer()
      call refine(session, spec, folder, log, result, solved, error)
      session%problem%refines = .false.
      ! the next case is compared with the case as specified
      session%problem%spec%search%dx = spec%wheel_rail%search%dx
      session%problem%spec%search%ds = spec%wheel_rail%search%ds
      if (.not. allocated(error) .and. spec%has_stress) then
         do k = 1, size(result%patches)
            call subsurface_stresses(solved, result%patches(k)%contact, error, spec%wheel_rail%left)
            if (allocated(error)) exit
            call warn_of_subsurface(solved, result%patches(k)%contact, log)
         end do
      end if
      call log%write_deferred()
      ! solutions on these elements cannot be initial estimates for the elements of the next case
      if (allocated(session%memory%slot)) session%memory%slot%state%started = .false.
   end subroutine solve_wheel_on_rail

   !> Reduce the elements until the estimate is small enough, or no smaller ones are possible
   subroutine refine(session, spec, folder, log, result, solved, error)
      type(wheel_rail_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      character(len=*), intent(in) :: folder
      type(log_type), intent(inout) :: log
      type(wheel_rail_result), intent(inout) :: result
      !> The case as it was solved
      type(case_spec), allocatable, intent(out) :: solved
      type(error_type), allocatable, intent(out) :: error
      type(accuracy_report) :: report
      type(wheel_rail_result), allocatable :: best
      type(case_spec) :: level
      type(accuracy_law) :: law
      type(approximate_method) :: chosen
      real(wp) :: sides(2), next(2), expected, before, began

      report%required = spec%iteration%accuracy
      report%eps = solver_tolerance(report%required)
      if (spec%iteration%allows_approximate) call choose_method(spec, chosen)
      report%method = chosen%words
      law = expected_law(spec)
      level = spec
      call prepare_level(report%eps, level)
      sides = first_sides(spec, min(first_across(law, report%required), sqrt(most_in_time(spec))/usual_margin))
      expected = 0.0_wp
      before = -1.0_wp
      do while (report%levels < most_levels)
         began = wall_clock()
         level%wheel_rail%search%dx = sides(1)
         level%wheel_rail%search%ds = sides(2)
         ! the search for the height starts from that of the elements before, if it was found
         session%problem%refines = report%levels > 0 .and. result%status%is_solved()
         if (allocated(session%memory%slot)) session%memory%slot%state%started = .false.
         call log%defer()
         call solve_wheel_rail_case(session, level, folder, log, result, error)
         if (allocated(error)) then
            if (.not. (error%kind == error_kind%time .and. allocated(best))) return
            report%reason = "the time limit was reached with elements of " // real_text(sides(1)) // " x " // &
               & real_text(sides(2)) // " mm"
            report%estimated = -1.0_wp
            deallocate(error)
            exit
         end if
         report%levels = report%levels + 1
         report%last_seconds = wall_clock() - began
         report%seconds = report%seconds + report%last_seconds
         if (.not. result%status%has_result()) exit
         report%estimated = -1.0_wp
         if (result%status%is_solved()) report%estimated = error_of_pair(session%memory, level%wheel_rail, result)
         report%order = order_of(session%memory)
         report%sides = sides
         if (is_near_enough(report%estimated, expected, report%required, law%share)) exit
         if (report%levels > 1 .and. .not. result%status%is_solved()) exit
         if (spec%motion == motion%steady_rolling .and. lowest_order_of_errors(session%memory) /= 2) law = first_order_alone(law)
         call next_sides(spec, session%memory, law%share*report%required, report%estimated, &
            & observed_order(law, report%estimated, before, expected), sides, next)
         if (.not. is_worth_while(sides, next)) then
            report%reason = "smaller elements would be more than NPOT_MAX or the limits allow"
            exit
         end if
         if (.not. time_is_left(spec%limits, report%last_seconds, product(sides/next))) then
            report%reason = "there is no time left for elements of " // real_text(next(1)) // " x " // real_text(next(2)) // " mm"
            exit
         end if
         expected = 0.0_wp
         if (report%estimated >= 0.0_wp) expected = report%estimated*minval(next/sides)**law%falls
         before = report%estimated
         best = result
         sides = next
      end do
      if (report%reason == "" .and. .not. result%status%is_solved()) report%reason = not_converged
      if (len_trim(report%reason) > 0 .and. before >= 0.0_wp) then
         if (report%estimated < 0.0_wp .or. report%estimated > before) then
            result = best
            report%estimated = before
         end if
      end if
      call complete_report(spec, sides, result, report, solved, log)
   end subroutine refine

   !> Sides of the elements of a grid before the first solution [mm]
   pure function first_sides(spec, across) result(sides)
      !> Case
      type(case_spec), intent(in) :: spec
      !> Number of elements across a typical contact
      real(wp), intent(in) :: across
      real(wp) :: sides(2), force

      force = usual_force
      if (spec%normal == normal_control%force) force = spec%wheel_rail%wheelset%fz
      sides = 2.0_wp*typical_half_side(spec, force)/across
      if (.not. sides(1) > 0.0_wp) sides = [spec%wheel_rail%search%dx, spec%wheel_rail%search%ds]
   end function first_sides

   !> Estimated relative error of wheel and rail; negative without contact
   !>
   !> The largest one of: the errors of the patches, weighted by their loads; those of the forces on the rail, which include
   !> errors of the angles of the patches; that of the height, which is larger than that of the approach on a flank.
   pure real(wp) function error_of_pair(memory, spec, pair) result(e)
      !> Solved patches, with errors
      type(wheel_rail_memory), intent(in) :: memory
      !> Profiles and positions that were solved
      type(wheel_rail_spec), intent(in) :: spec
      !> Totals of wheel and rail, with errors
      type(wheel_rail_result), intent(in) :: pair
      real(wp) :: load, part
      integer :: k

      load = sum(memory%slot(:memory%used)%result%fn)
      e = -1.0_wp
      if (.not. load > 0.0_wp) return
      e = 0.0_wp
      do k = 1, memory%used
         part = error_of_forces(memory%slot(k)%problem, memory%slot(k)%result)
         if (part < 0.0_wp) part = error_of_few
         e = e + part*memory%slot(k)%result%fn/load
      end do
      e = max(e, error_of_totals(memory, spec, pair))
   end function error_of_pair

   !> Largest relative error of the forces on the rail and of the height
   !>
   !> Lateral and longitudinal forces are relative to the friction bound of all patches, the height to the largest approach.
   pure real(wp) function error_of_totals(memory, spec, pair) result(e)
      type(wheel_rail_memory), intent(in) :: memory
      type(wheel_rail_spec), intent(in) :: spec
      type(wheel_rail_result), intent(in) :: pair
      type(total_list) :: list
      character(len=5), parameter :: names(4) = ["fx_tr", "fy_tr", "fz_tr", "z_ws "]
      real(wp) :: scale(size(names))
      integer :: k, place

      e = 0.0_wp
      if (.not. allocated(pair%errors)) return
      scale = 0.0_wp
      do k = 1, memory%used
         associate (patch => memory%slot(k)%result)
            scale(4) = max(scale(4), patch%pen)
            scale(1) = scale(1) + patch%friction_bound()
         end associate
      end do
      call pair%totals(spec, list)
      scale(2:3) = [scale(1), abs(list%rows(list%place_of(names(3)))%value)]
      do k = 1, size(names)
         place = list%place_of(names(k))
         ! without estimate for one of them; a prescribed one has no error
         if (ieee_is_nan(pair%errors(place)) .or. .not. scale(k) > 0.0_wp) cycle
         e = max(e, pair%errors(place)/scale(k))
      end do
   end function error_of_totals

   !> Lowest order of the discretisation of the patches
   pure integer function order_of(memory) result(order)
      type(wheel_rail_memory), intent(in) :: memory

      order = 0
      if (memory%used > 0) order = minval(memory%slot(:memory%used)%result%tangential%order)
   end function order_of

   !> Lowest order of the errors of the patches
   pure integer function lowest_order_of_errors(memory) result(order)
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      integer :: k

      order = 2
      do k = 1, memory%used
         order = min(order, order_of_errors(memory%slot(k)%result%tangential))
      end do
   end function lowest_order_of_errors

   !> Sides of the next elements, from the patch with the largest normal force
   pure subroutine next_sides(spec, memory, required, estimated, order, sides, next)
      !> Case, with its limits
      type(case_spec), intent(in) :: spec
      type(wheel_rail_memory), intent(in) :: memory
      !> Accuracy that the estimate must meet, and the present estimate, negative for none [-]
      real(wp), intent(in) :: required, estimated
      !> Order of the error
      real(wp), intent(in) :: order
      !> Present sides [mm]
      real(wp), intent(in) :: sides(2)
      !> Next sides [mm]
      real(wp), intent(out) :: next(2)
      real(wp) :: elements(memory%used), sizes(2, memory%used)
      integer :: k

      next = without_patches*sides
      if (memory%used == 0) return
      do k = 1, memory%used
         associate (grid => memory%slot(k)%result%grid)
            elements(k) = real(grid%npot(), wp)
            sizes(:, k) = [grid%dx, grid%dy]
         end associate
      end do
      k = maxloc(memory%slot(:memory%used)%result%fn, dim=1)
      next = sides
      associate (result => memory%slot(k)%result)
         if (result%ncon == 0) return
         call smaller_sides(spec, k, across_contact(result), elements, sizes, required, estimated, order, sides, next)
      end associate
   end subroutine next_sides

   !> Are the next sides sufficiently smaller?
   pure logical function is_worth_while(sides, next)
      !> Present and next sides [mm]
      real(wp), intent(in) :: sides(2), next(2)

      is_worth_while = product(sides/next) >= worth**2
   end function is_worth_while

   !> The same as next_sides from sizes
   pure subroutine smaller_sides(spec, main, across, elements, sizes, required, estimated, order, sides, next)
      !> Case, with its limits
      type(case_spec), intent(in) :: spec
      !> Index of the patch with the largest normal force
      integer, intent(in) :: main
      !> Its number of elements across the contact along x and y
      real(wp), intent(in) :: across(2)
      !> Numbers of elements of all patches, and their sides [mm], shape (2, patches)
      real(wp), intent(in) :: elements(:), sizes(:, :)
      !> Accuracy that the estimate must meet, and the present estimate, negative for none [-]
      real(wp), intent(in) :: required, estimated
      !> Order of the error
      real(wp), intent(in) :: order
      !> Present sides as requested [mm], those of elements are larger if there are too many
      real(wp), intent(in) :: sides(2)
      !> Next sides [mm]
      real(wp), intent(out) :: next(2)
      real(wp) :: most, number
      integer :: k

      most = min(most_elements(spec%limits), real(spec%iteration%npot_max, wp))
      call shorten_aspect(across*sizes(:, main), finer_across(minval(across), estimated, required, order), next)
      next = min(next, sides)
      ! a few elements across need a small step in one direction only, which alone is not worth another grid
      next = next*min(1.0_wp, sqrt(product(sides/next))/least_ratio)
      do k = 1, size(elements)
         number = elements(k)*product(sizes(:, k)/next)
         if (number > most) next = min(sides, next*sqrt(number/most))
      end do
   end subroutine smaller_sides

   !> Report the choices; a warning if the accuracy was not reached
   subroutine complete_report(spec, sides, result, report, solved, log)
      !> The case as specified
      type(case_spec), intent(in) :: spec
      !> Sides of the last elements [mm]
      real(wp), intent(in) :: sides(2)
      type(wheel_rail_result), intent(inout) :: result
      type(accuracy_report), intent(inout) :: report
      !> The case with the choices
      type(case_spec), allocatable, intent(out) :: solved
      type(log_type), intent(inout) :: log

      report%is_met = report%estimated >= 0.0_wp .and. report%estimated <= report%required
      if (size(result%patches) == 0) report%reason = "wheel and rail do not touch"
      if (report%is_met) then
         report%reason = ""
      else if (report%reason == "") then
         report%reason = "smaller elements did not help"
      end if
      if (.not. report%sides(1) > 0.0_wp) report%sides = sides
      allocate(solved, source=spec)
      solved%wheel_rail%search%dx = report%sides(1)
      solved%wheel_rail%search%ds = report%sides(2)
      solved%iteration%eps = report%eps
      solved%iteration%order = 2
      solved%estimates_errors = .true.
      result%accuracy = report
      if (.not. report%is_met) call log%warning("the required accuracy was not reached: " // trim(report%reason))
   end subroutine complete_report
end module contact_cases_wheel_rail_accuracy
