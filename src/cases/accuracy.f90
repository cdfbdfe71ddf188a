!> A contact problem solved to a prescribed accuracy: grids in the same window, each finer than the one before
!>
!> The estimate of each grid (contact_patch_error_estimate) determines the number of elements of the next. Cases that continue one
!> another are solved on the same elements (contact_cases_accuracy_series). Chosen elements, order and tolerance are set in the
!> specification, so that outputs describe what was solved.
module contact_cases_accuracy
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_accuracy_report, only : accuracy_report, longest_reason
   use contact_base_choices, only : motion
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_base_log, only : log_type
   use contact_cases_accuracy_grid, only : across_contact, is_cut_off, is_worth, level_grid, next_counts, no_direction, &
      & set_elements, stay_below
   use contact_cases_accuracy_level, only : first_grid, held_solution, keeps_axes, solve_level, use_curvatures
   use contact_cases_accuracy_plan, only : accuracy_law, acting_order, expected_law, first_order_alone, is_near_enough, &
      & most_elements, most_levels, not_converged, observed_order, prepare_level, refuse_case, &
      & smaller_tolerance, solver_tolerance, stopping_share
   use contact_cases_accuracy_series, only : has_history
   use contact_cases_accuracy_time, only : has_outer_iterations, time_is_left
   use contact_cases_approximate_methods, only : approximate_method, choose_method, use_method
   use contact_cases_distance, only : distance_form
   use contact_cases_session, only : contact_session, solve_case
   use contact_cases_spec, only : case_spec, part_source
   use contact_cases_subsurface, only : subsurface_stresses, warn_of_subsurface
   use contact_patch_error_estimate, only : error_of_forces
   use contact_patch_order, only : order_of_errors
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: refuse_contact, series_share, solve_contact_case

   !> A finer grid of a case that continues others is designed for this fraction of the accuracy: later cases may need it, and each
   !> repetition solves all cases again; chosen
   real(wp), parameter :: series_share = 0.85_wp
   !> Maximum ratio of the numbers of elements of two grids if the first one shows that the potential contact cuts off too much of
   !> the contact; chosen
   real(wp), parameter :: confirming = 4.0_wp
   !> Reason of an accuracy that is not reached although finer elements were tried
   character(len=*), parameter :: no_progress = "finer elements did not help"

contains

   !> Solve one case: as specified, or with the grid required by its accuracy
   subroutine solve_contact_case(session, spec, log, result, solved, error, folder)
      type(contact_session), intent(inout) :: session
      !> Complete specification
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      !> Result, with `accuracy` if one is prescribed
      type(patch_result), intent(inout) :: result
      !> The case with the elements, the order and EPS chosen for its accuracy; unallocated if none is prescribed
      type(case_spec), allocatable, intent(out) :: solved
      type(error_type), allocatable, intent(out) :: error
      !> Folder to which names of files are relative; default the current one
      character(len=*), intent(in), optional :: folder
      type(approximate_method) :: chosen

      if (.not. (abs(spec%iteration%accuracy) > 0.0_wp .and. spec%solve)) then
         if (allocated(result%accuracy)) deallocate(result%accuracy)
         call session%series%clear()
         call solve_case(session, spec, log, result, error, folder)
         return
      end if
      call refuse_contact(session, spec, error)
      if (allocated(error)) return
      call log%defer()
      if (spec%iteration%allows_approximate) call choose_method(spec, chosen)
      if (chosen%found) then
         call session%series%clear()
         call approximate(session, chosen, spec, log, result, solved, error, folder)
      else
         call refine(session, spec, trim(chosen%words), log, result, solved, error, folder)
      end if
      if (.not. allocated(error) .and. spec%has_stress .and. result%status%has_result()) then
         call subsurface_stresses(solved, result, error)
         if (.not. allocated(error)) call warn_of_subsurface(solved, result, log)
      end if
      call log%write_deferred()
      session%curvatures = 0.0_wp
      if (allocated(session%problem%hertz)) session%curvatures = [session%problem%hertz%a1, session%problem%hertz%b1]
      ! the next case has another grid
      session%problem%has_geometry = .false.
   end subroutine solve_contact_case

   !> Refuse a case for which no grid can be chosen, with the reason
   subroutine refuse_contact(session, spec, error)
      !> With data of the previous case
      type(contact_session), intent(in) :: session
      !> Case of module 3 with an accuracy
      type(case_spec), intent(in) :: spec
      !> Allocated if the case is refused
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: cannot = "an accuracy is required, but the grid cannot be chosen with "
      !> Maximum sine of an angle of rolling that is regarded as along x
      real(wp), parameter :: along_x = 0.01_wp

      call refuse_case(spec, error)
      if (allocated(error)) return
      if (spec%grid%needs_geometry() .and. spec%geometry%form == distance_form%elementwise) then
         call fatal_error(error, cannot // "undeformed distances that are given element by element", error_kind%unsupported)
      else if (keeps_axes(spec) .and. .not. maxval(session%curvatures) > 0.0_wp) then
         call fatal_error(error, cannot // "the semi-axes of a case without an accuracy. Curvatures do, or semi-axes that are &
            &given again", error_kind%unsupported)
      else if (any(spec%motion == [motion%steady_rolling, motion%transient_rolling]) &
         & .and. abs(sin(spec%rolling%chi)) > along_x) then
         call fatal_error(error, cannot // "rolling that is not along x", error_kind%unsupported)
      else
         call session%series%refuse(spec, error)
      end if
   end subroutine refuse_contact

   !> Solve a case by a simplified method whose error is known
   subroutine approximate(session, chosen, spec, log, result, solved, error, folder)
      type(contact_session), intent(inout) :: session
      !> The method
      type(approximate_method), intent(in) :: chosen
      type(case_spec), intent(in) :: spec
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      !> The case as it was solved
      type(case_spec), allocatable, intent(out) :: solved
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: folder
      type(accuracy_report) :: report
      type(case_spec) :: level
      real(wp) :: began

      report%required = spec%iteration%accuracy
      report%eps = solver_tolerance(report%required)
      report%method = chosen%words
      level = spec
      call prepare_level(report%eps, level)
      level%parts%grid = part_source%given
      level%parts%geometry = part_source%given
      if (keeps_axes(spec)) call use_curvatures(session%curvatures, level%grid)
      call use_method(chosen, level)
      level%estimates_errors = .false.
      began = wall_clock()
      call solve_case(session, level, log, result, error, folder)
      if (allocated(error)) return
      report%levels = 1
      report%seconds = wall_clock() - began
      report%last_seconds = report%seconds
      if (result%status%is_solved()) then
         report%estimated = chosen%method%error
      else
         report%reason = not_converged
      end if
      level = spec
      call use_method(chosen, level)
      call complete_report(session, level, result, report, solved, log)
      result%accuracy%order = 0
      call leave_errors(result)
   end subroutine approximate

   !> Totals of a simplified method have no estimates: refining elements would show its discretisation error only
   subroutine leave_errors(result)
      type(patch_result), intent(inout) :: result
      type(total_list) :: list

      call result%totals(list)
      if (allocated(result%errors)) deallocate(result%errors)
      allocate(result%errors)
      allocate(result%errors%value(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
      result%errors%reason = "a simplified method was chosen; its error is given with the accuracy"
   end subroutine leave_errors

   !> Refine the grid until the estimate is small enough, or no finer grid is possible
   subroutine refine(session, spec, method, log, result, solved, error, folder)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      !> Why no simplified method is chosen, if they are allowed; otherwise ""
      character(len=*), intent(in) :: method
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      !> The case as it was solved
      type(case_spec), allocatable, intent(out) :: solved
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: folder
      type(accuracy_report) :: report
      type(patch_result), allocatable :: best
      type(accuracy_law) :: law
      type(level_grid) :: grid, next, last
      type(held_solution) :: held
      real(wp) :: expected, before, most
      !> Estimate and number of elements of each grid
      real(wp) :: trail(2, most_levels)
      integer :: fixed(2), cases
      logical :: is_solved, near, tightened

      report%required = spec%iteration%accuracy
      report%method = method
      law = expected_law(spec)
      fixed = merge([spec%grid%mx, spec%grid%my], 0, [spec%grid%mx, spec%grid%my] <= no_direction)
      call first_grid(session, spec, law, fixed, grid)
      ! the error of the previous case on the same grid is another sample of the error of this one
      expected = session%series%sample(spec, grid)
      before = 0.0_wp
      do while (report%levels < most_levels)
         report%eps = grid%eps
         call solve_level(session, spec, grid, report%levels > 0, log, result, is_solved, report%last_seconds, error, folder)
         if (allocated(error)) then
            if (.not. (error%kind == error_kind%time .and. allocated(best))) then
               call session%series%clear()
               return
            end if
            report%reason = "the time limit was reached on " // integer_text(grid%counts(1)) // " x " // &
               & integer_text(grid%counts(2)) // " elements"
            deallocate(error)
            ! later cases continue from the solution that is the result
            call held%restore(session)
            result = best
            report%estimated = before
            grid = last
            report%eps = grid%eps
            exit
         end if
         report%levels = report%levels + 1
         report%seconds = report%seconds + report%last_seconds
         ! a finer grid needs the previous cases on it, too; on the first grid they may have been solved already
         cases = merge(session%series%before(spec) + 1, 1, report%levels == 1)
         if (.not. result%status%has_result()) exit
         report%estimated = -1.0_wp
         if (is_solved) report%estimated = error_of_forces(session%problem, result)
         if (result%ncon == 0 .and. report%levels > 1) report%estimated = 0.0_wp
         grid%lengths = [result%grid%mx*result%grid%dx, result%grid%my*result%grid%dy]
         next = grid
         call tighten(result, report, next%eps, tightened)
         near = is_near_enough(report%estimated, expected, report%required, law%share)
         if (near .and. .not. tightened) exit
         if (report%levels > 1 .and. .not. is_solved) exit
         if (spec%motion == motion%steady_rolling .and. order_of_errors(result%tangential) /= 2) law = first_order_alone(law)
         if (.not. near) call next_counts([result%grid%dx, result%grid%dy], [result%grid%mx, result%grid%my], &
            & across_contact(result), report%estimated, observed_order(law, report%estimated, before, expected), &
            & merge(series_share, 1.0_wp, has_history(spec))*law%share*report%required, fixed, next%counts)
         most = most_elements(spec%limits)
         ! whether the potential contact cuts off too much is decided on the second grid, which need not be much finer
         if (is_cut_off(result, report%required, most, fixed)) most = min(most, &
            & confirming*product(real(grid%counts, wp)))
         call stay_below(most, fixed, next%counts)
         trail(:, report%levels) = [report%estimated, product(real(grid%counts, wp))]
         report%reason = obstacle(spec, result, report, trail(:, :report%levels), next%counts, fixed, tightened, cases)
         if (report%reason /= "") exit
         expected = 0.0_wp
         before = report%estimated
         if (report%estimated >= 0.0_wp) expected = report%estimated*(minval(real(grid%counts, wp)/next%counts))**law%falls
         best = result
         call held%hold(session)
         last = grid
         grid = next
      end do
      call session%series%take(spec, grid, report%estimated)
      if (.not. result%status%has_result()) call session%series%clear()
      if (report%reason == "" .and. .not. is_solved) report%reason = not_converged
      if (len_trim(report%reason) > 0 .and. allocated(best)) call keep_better(best, before, report, result)
      call complete_report(session, spec, result, report, solved, log)
   end subroutine refine

   !> Reason against another grid, blank if there is none
   function obstacle(spec, result, report, trail, counts, fixed, tightened, cases) result(reason)
      !> Case, with its limits
      type(case_spec), intent(in) :: spec
      !> Result of the last grid
      type(patch_result), intent(in) :: result
      !> Report, with the prescribed accuracy and the time of the last grid
      type(accuracy_report), intent(in) :: report
      !> Estimate, negative for none, and number of elements of each grid so far, shape (2, grids)
      real(wp), intent(in) :: trail(:, :)
      !> Numbers of elements of the next grid; those that must not change, 0 for others
      integer, intent(in) :: counts(2), fixed(2)
      !> Does the next grid have a smaller tolerance?
      logical, intent(in) :: tightened
      !> Number of cases that are solved on the next grid
      integer, intent(in) :: cases
      character(len=longest_reason) :: reason

      reason = ""
      if (size(trail, 2) > 1 .and. is_cut_off(result, report%required, most_elements(spec%limits), fixed)) then
         reason = "the potential contact cuts off a part of the contact"
      else if (has_stalled(trail, fixed) .and. .not. has_outer_iterations(spec)) then
         ! unlike bodies may slip in an area narrower than elements, with the same error until elements are as narrow
         reason = no_progress
      else if (.not. (tightened .or. is_worth([result%grid%mx, result%grid%my], counts))) then
         reason = "more than " // integer_text(int(most_elements(spec%limits))) // " elements are not allowed"
         if (all(fixed > 0)) reason = "one or two elements along both sides represent plane strain and are kept"
      else if (.not. time_is_left(spec%limits, cases*report%last_seconds, &
         & product(real(counts, wp))/trail(2, size(trail, 2)))) then
         reason = "there is no time left for " // integer_text(counts(1)) // " x " // integer_text(counts(2)) // " elements"
      end if
   end function obstacle

   !> Have estimates hardly decreased on the last three grids, although elements have become much smaller?
   pure logical function has_stalled(trail, fixed)
      !> Estimate, negative for none, and number of elements of each grid so far, shape (2, grids)
      real(wp), intent(in) :: trail(:, :)
      !> Numbers of elements that must not change, 0 for others
      integer, intent(in) :: fixed(2)
      !> Minimum factor of the number of elements across, and of the estimate. An error of the order 1/2, the lowest one, decreases
      !> to 0.7 with twice the number
      real(wp), parameter :: least_growth = 2.0_wp, no_decrease = 0.8_wp
      real(wp) :: growth
      integer :: k

      k = size(trail, 2)
      has_stalled = .false.
      if (k < 3) return
      growth = trail(2, k)/trail(2, k - 2)
      if (all(fixed == 0)) growth = sqrt(growth)
      has_stalled = growth >= least_growth .and. minval(trail(1, k - 2:k)) > 0.0_wp &
         & .and. trail(1, k) > no_decrease*maxval(trail(1, k - 2:k - 1))
   end function has_stalled

   !> Reduce the tolerance of the next grid, or of the same one, if iterations stopped too early for the accuracy
   subroutine tighten(result, report, eps, tightened)
      !> Result of the present grid, with its errors
      type(patch_result), intent(in) :: result
      !> Report, with the prescribed accuracy
      type(accuracy_report), intent(in) :: report
      !> On entry the present tolerance, on return the new one
      real(wp), intent(inout) :: eps
      !> Was it reduced?
      logical, intent(out) :: tightened
      real(wp) :: part

      tightened = .false.
      if (.not. allocated(result%errors)) return
      part = maxval(result%errors%stopping)/report%required
      if (part <= stopping_share) return
      eps = smaller_tolerance(eps, stopping_share/part)
      tightened = eps < report%eps
   end subroutine tighten

   !> Keep the grid with the smaller estimate at the end of a search that stopped too early
   subroutine keep_better(best, before, report, result)
      !> Result of the grid before the last, and its estimated error; negative if not solved
      type(patch_result), intent(in) :: best
      real(wp), intent(in) :: before
      type(accuracy_report), intent(inout) :: report
      !> Result of the last grid, which may be missing
      type(patch_result), intent(inout) :: result

      if (before < 0.0_wp) return
      if (report%estimated >= 0.0_wp .and. report%estimated <= before .and. allocated(result%errors)) return
      result = best
      report%estimated = before
   end subroutine keep_better

   !> Report the choices; a warning if the accuracy was not reached
   subroutine complete_report(session, spec, result, report, solved, log)
      !> With the curvatures of the previous case
      type(contact_session), intent(in) :: session
      !> The case as specified
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(inout) :: result
      type(accuracy_report), intent(inout) :: report
      !> The case with the choices
      type(case_spec), allocatable, intent(out) :: solved
      type(log_type), intent(inout) :: log

      report%elements = [result%grid%mx, result%grid%my]
      report%sides = [result%grid%dx, result%grid%dy]
      report%order = result%tangential%order
      report%is_met = report%estimated >= 0.0_wp .and. report%estimated <= report%required
      if (report%is_met) then
         report%reason = ""
      else if (report%reason == "") then
         report%reason = no_progress
         if (allocated(result%errors)) then
            if (result%errors%reason /= "") report%reason = "there is no estimate: " // result%errors%reason
         end if
      end if
      allocate(solved, source=spec)
      if (keeps_axes(spec)) call use_curvatures(session%curvatures, solved%grid)
      call set_elements(solved%grid, report%elements, report%elements*report%sides)
      solved%iteration%eps = report%eps
      solved%iteration%order = acting_order(spec)
      solved%estimates_errors = .true.
      if (spec%motion == motion%steady_rolling) solved%rolling%dq = result%dq
      result%accuracy = report
      if (.not. report%is_met) call log%warning("the required accuracy was not reached: " // trim(report%reason))
   end subroutine complete_report
end module contact_cases_accuracy
