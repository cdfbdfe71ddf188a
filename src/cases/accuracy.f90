!> A contact problem to an accuracy that was asked for: grids in the same window, each finer than the one before
!>
!> The estimate of each grid (contact_patch_error_estimate) tells how many elements the next one needs. Elements, order and
!> tolerance that are chosen go into the specification, so that outputs tell what was solved.
module contact_cases_accuracy
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_accuracy_report, only : accuracy_report
   use contact_base_choices, only : grid_form, motion
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_base_limits, only : wall_clock
   use contact_base_log, only : log_type
   use contact_cases_accuracy_plan, only : accuracy_law, caution, expected_law, finer_across, first_across, is_near_enough, &
      & most_elements, most_levels, not_converged, prepare_level, refuse_case, shorten_aspect, smaller_tolerance, &
      & solver_tolerance, stopping_share, time_is_left
   use contact_cases_approximate_methods, only : approximate_method, choose_method, take_method
   use contact_cases_distance, only : distance_form
   use contact_cases_session, only : contact_session, solve_case
   use contact_cases_spec, only : case_spec, grid_spec, part_source
   use contact_cases_subsurface, only : subsurface_stresses, warn_of_steps
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_patch_error_estimate, only : error_of_forces
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: solve_contact_case

   !> Part of a given window, along each side, that contact takes before anything is known of it
   real(wp), parameter :: usual_share = 0.75_wp
   !> Elements of a side that stand for plane strain, and are not refined
   integer, parameter :: no_direction = 2
   !> A grid that has less than this factor more elements than the one before brings nothing
   real(wp), parameter :: worth = 1.3_wp

contains

   !> Solve one case: as it is, or with the grid that its accuracy needs
   subroutine solve_contact_case(session, spec, log, result, error, folder)
      type(contact_session), intent(inout) :: session
      !> Complete specification; where an accuracy is asked for, on return with the elements, the order and EPS that were chosen
      type(case_spec), intent(inout) :: spec
      type(log_type), intent(inout) :: log
      !> Gets `accuracy` where one was asked for
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      !> Folder to which names of files are relative; default the current one
      character(len=*), intent(in), optional :: folder
      type(approximate_method) :: chosen

      if (.not. (abs(spec%iteration%accuracy) > 0.0_wp .and. spec%solve)) then
         if (allocated(result%accuracy)) deallocate(result%accuracy)
         call solve_case(session, spec, log, result, error, folder)
         return
      end if
      call refuse_contact(session, spec, error)
      if (allocated(error)) return
      call log%note()
      if (spec%iteration%allows_approximate) call choose_method(spec, chosen)
      if (chosen%found) then
         call approximate(session, chosen, spec, log, result, error, folder)
      else
         call refine(session, spec, trim(chosen%words), log, result, error, folder)
      end if
      if (.not. allocated(error) .and. spec%has_stress .and. result%status%has_result()) then
         call subsurface_stresses(spec, result, error)
         if (.not. allocated(error)) call warn_of_steps(result, log)
      end if
      call log%publish()
      session%curvatures = 0.0_wp
      if (allocated(session%problem%hertz)) session%curvatures = [session%problem%hertz%a1, session%problem%hertz%b1]
      ! the next case lays out its own grid
      session%problem%has_geometry = .false.
   end subroutine solve_contact_case

   !> Refuse a case whose grid cannot be chosen, by name
   subroutine refuse_contact(session, spec, error)
      !> With what the case before has left
      type(contact_session), intent(in) :: session
      !> Of module 3, with an accuracy
      type(case_spec), intent(in) :: spec
      !> Allocated when it does not go
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: cannot = "an accuracy was asked for, but the grid cannot be chosen with "
      !> Sine of an angle of rolling that is one along x
      real(wp), parameter :: along_x = 0.01_wp

      call refuse_case(spec, error)
      if (allocated(error)) return
      if (spec%grid%needs_geometry() .and. spec%geometry%form == distance_form%elementwise) then
         call fatal_error(error, cannot // "undeformed distances that are given element by element", error_kind%unsupported)
      else if (keeps_axes(spec) .and. .not. maxval(session%curvatures) > 0.0_wp) then
         call fatal_error(error, cannot // "the semi-axes of a case without an accuracy. Curvatures do, or semi-axes that are &
            &given again", error_kind%unsupported)
      else if (spec%motion == motion%steady_rolling .and. abs(sin(spec%rolling%chi)) > along_x) then
         call fatal_error(error, cannot // "rolling that is not along x", error_kind%unsupported)
      end if
   end subroutine refuse_contact

   !> Are there semi-axes that belong to the load of a case before? The curvatures that followed from them are kept
   pure logical function keeps_axes(spec)
      type(case_spec), intent(in) :: spec

      keeps_axes = any(spec%grid%form == [grid_form%hertz_axes, grid_form%hertz_line]) .and. .not. spec%has_new_geometry()
   end function keeps_axes

   !> Curvatures in place of semi-axes
   pure subroutine take_curvatures(curvatures, grid)
      !> Of x**2 and y**2 [1/mm]
      real(wp), intent(in) :: curvatures(2)
      type(grid_spec), intent(inout) :: grid

      grid%a1 = curvatures(1)
      grid%b1 = curvatures(2)
      grid%form = merge(grid_form%hertz_line_curvature, grid_form%hertz_curvatures, grid%is_line_contact())
   end subroutine take_curvatures

   !> Solve a case by a simplified method whose error is known
   subroutine approximate(session, chosen, spec, log, result, error, folder)
      type(contact_session), intent(inout) :: session
      !> The method
      type(approximate_method), intent(in) :: chosen
      type(case_spec), intent(inout) :: spec
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: folder
      type(accuracy_report) :: report
      type(case_spec) :: level
      real(wp) :: began

      report%asked = spec%iteration%accuracy
      report%eps = solver_tolerance(report%asked)
      report%method = chosen%words
      level = spec
      call prepare_level(report%eps, level)
      level%parts%grid = part_source%given
      level%parts%geometry = part_source%given
      if (keeps_axes(spec)) call take_curvatures(session%curvatures, level%grid)
      call take_method(chosen, level)
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
      call take_method(chosen, spec)
      call tell_report(spec, level, result, report, log)
      result%accuracy%order = 0
      call leave_errors(result)
   end subroutine approximate

   !> No total of a simplified method has an estimate: elements would tell of the method's own limit only
   subroutine leave_errors(result)
      type(patch_result), intent(inout) :: result
      type(total_list) :: list

      call result%totals(list)
      if (allocated(result%errors)) deallocate(result%errors)
      allocate(result%errors)
      allocate(result%errors%value(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
      result%errors%reason = "a simplified method was chosen; its error is told with the accuracy"
   end subroutine leave_errors

   !> From grid to grid until the estimate is small enough, or no finer one can be had
   subroutine refine(session, spec, method, log, result, error, folder)
      type(contact_session), intent(inout) :: session
      type(case_spec), intent(inout) :: spec
      !> Why no simplified method is chosen, where they are allowed; "" where they are not
      character(len=*), intent(in) :: method
      type(log_type), intent(inout) :: log
      type(patch_result), intent(inout) :: result
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: folder
      type(accuracy_report) :: report
      type(patch_result), allocatable :: best
      type(case_spec) :: level
      type(accuracy_law) :: law
      real(wp) :: lengths(2), began, expected
      integer :: counts(2), next(2), fixed(2), acting
      logical :: tightened

      report%asked = spec%iteration%accuracy
      report%eps = solver_tolerance(report%asked)
      report%method = method
      law = expected_law(spec)
      level = spec
      call prepare_level(report%eps, level)
      level%parts%grid = part_source%given
      level%parts%geometry = part_source%given
      if (keeps_axes(spec)) call take_curvatures(session%curvatures, level%grid)
      fixed = merge([spec%grid%mx, spec%grid%my], 0, [spec%grid%mx, spec%grid%my] <= no_direction)
      call first_counts(spec%grid, first_across(law, report%asked), lengths, counts)
      where (fixed > 0) counts = fixed
      call stay_below(most_elements(spec%limits), fixed, counts)
      expected = 0.0_wp
      do while (report%levels < most_levels)
         began = wall_clock()
         call set_elements(level%grid, counts, lengths)
         if (lengths(1) > 0.0_wp .and. spec%motion == motion%steady_rolling) level%rolling%dq = lengths(1)/counts(1)
         call log%note()
         call solve_case(session, level, log, result, error, folder)
         if (allocated(error)) then
            if (error%kind == error_kind%time .and. allocated(best)) then
               report%reason = "the time limit was reached on " // integer_text(counts(1)) // " x " // integer_text(counts(2)) // &
                  & " elements"
               report%estimated = -1.0_wp
               deallocate(error)
               exit
            end if
            return
         end if
         report%levels = report%levels + 1
         report%last_seconds = wall_clock() - began
         report%seconds = report%seconds + report%last_seconds
         if (.not. result%status%has_result()) exit
         acting = result%tangential%order
         report%estimated = -1.0_wp
         if (result%status%is_solved()) report%estimated = caution(spec)*error_of_forces(session%problem, result)
         if (result%ncon == 0 .and. report%levels > 1) report%estimated = 0.0_wp
         lengths = [result%grid%mx*result%grid%dx, result%grid%my*result%grid%dy]
         if (is_near_enough(report%estimated, expected, report%asked)) exit
         if (report%levels > 1 .and. .not. result%status%is_solved()) exit
         if (spec%motion == motion%steady_rolling) law%order = min(law%order, merge(law%order, 1.0_wp, acting == 2))
         call tighten(spec, result, report, level, tightened)
         call next_counts(result, report, law%order, fixed, next)
         call stay_below(most_elements(spec%limits), fixed, next)
         if (.not. (tightened .or. is_worth(counts, next))) then
            report%reason = "more than " // integer_text(product(next)) // " elements are not allowed"
            exit
         end if
         if (.not. time_is_left(spec%limits, report%last_seconds, product(real(next, wp)/counts))) then
            report%reason = "there is no time left for " // integer_text(next(1)) // " x " // integer_text(next(2)) // " elements"
            exit
         end if
         expected = 0.0_wp
         if (report%estimated >= 0.0_wp) expected = report%estimated*(minval(real(counts, wp)/next))**law%order
         best = result
         counts = next
      end do
      if (report%reason == "" .and. .not. result%status%is_solved()) report%reason = not_converged
      if (len_trim(report%reason) > 0 .and. allocated(best)) call keep_better(session, caution(spec), best, report, result)
      call tell_report(spec, level, result, report, log)
   end subroutine refine

   !> A smaller tolerance for the next grid, where iterations stopped too early for what is asked
   subroutine tighten(spec, result, report, level, tightened)
      type(case_spec), intent(in) :: spec
      !> Of the present grid, with its errors
      type(patch_result), intent(in) :: result
      !> Gets the tolerance
      type(accuracy_report), intent(inout) :: report
      !> The same
      type(case_spec), intent(inout) :: level
      !> Is it smaller?
      logical, intent(out) :: tightened
      real(wp) :: eps, part

      tightened = .false.
      if (.not. allocated(result%errors)) return
      part = caution(spec)*maxval(result%errors%stopping)/report%asked
      if (part <= stopping_share) return
      eps = smaller_tolerance(report%eps, stopping_share/part)
      tightened = eps < report%eps
      report%eps = eps
      call prepare_level(eps, level)
   end subroutine tighten

   !> Sides of a window that is given; 0 where it follows from Hertz's solution
   pure function sides_of_window(grid) result(lengths)
      !> As the case describes it
      type(grid_spec), intent(in) :: grid
      !> [mm]
      real(wp) :: lengths(2)

      lengths = 0.0_wp
      select case (grid%form)
      case (grid_form%corner_and_sides, grid_form%centre_and_sides)
         lengths = [grid%mx*grid%dx, grid%my*grid%dy]
      case (grid_form%corners)
         lengths = [grid%xh - grid%xl, grid%yh - grid%yl]
      case (grid_form%centres)
         lengths = [grid%mx*(grid%xcm - grid%xc1)/max(1, grid%mx - 1), grid%my*(grid%ycm - grid%yc1)/max(1, grid%my - 1)]
      end select
   end function sides_of_window

   !> Elements along both sides of the window of the first grid
   pure subroutine first_counts(grid, across, lengths, counts)
      type(grid_spec), intent(in) :: grid
      !> Elements across the contact
      real(wp), intent(in) :: across
      !> Sides of the window [mm], 0 where they are not known yet
      real(wp), intent(out) :: lengths(2)
      !> Elements along x and y
      integer, intent(out) :: counts(2)
      real(wp) :: sides(2)

      lengths = sides_of_window(grid)
      if (maxval(lengths) > 0.0_wp) then
         call shorten_aspect(usual_share*lengths, across, sides)
         counts = ceiling(lengths/sides)
      else
         counts = ceiling(across*max(1.0_wp, grid%scale))
      end if
   end subroutine first_counts

   !> Elements of the next grid, from where contact is
   pure subroutine next_counts(result, report, order, fixed, counts)
      !> Of the present grid
      type(patch_result), intent(in) :: result
      !> Its estimate, and what is asked
      type(accuracy_report), intent(in) :: report
      !> Of the error
      real(wp), intent(in) :: order
      !> Numbers that stay, 0 for others
      integer, intent(in) :: fixed(2)
      !> Elements along x and y
      integer, intent(out) :: counts(2)
      type(bounding_box) :: box
      real(wp) :: across(2), sides(2), size(2)

      across = real([result%grid%mx, result%grid%my], wp)
      size = [result%grid%dx, result%grid%dy]
      if (result%ncon > 0) then
         box = contact_box(result%division)
         across = real([box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1], wp)
      end if
      if (any(fixed > 0)) across = maxval(across, mask=fixed == 0)
      call shorten_aspect(across*size, finer_across(minval(across), report%estimated, report%asked, order), sides)
      ! a direction with many elements already keeps them
      sides = min(sides, size)
      counts = ceiling([result%grid%mx, result%grid%my]*size/sides)
      where (fixed > 0) counts = fixed
   end subroutine next_counts

   !> Fewer elements where there are more than allowed
   pure subroutine stay_below(most, fixed, counts)
      !> Allowed in all
      real(wp), intent(in) :: most
      !> Numbers that stay, 0 for others
      integer, intent(in) :: fixed(2)
      !> Elements along x and y
      integer, intent(inout) :: counts(2)
      real(wp) :: ratio

      ratio = most/(real(counts(1), wp)*real(counts(2), wp))
      if (ratio >= 1.0_wp) return
      if (all(fixed == 0)) ratio = sqrt(ratio)
      where (fixed == 0) counts = max(1, int(ratio*counts))
   end subroutine stay_below

   !> Has the next grid enough more elements?
   pure logical function is_worth(counts, next)
      !> Elements of both grids
      integer, intent(in) :: counts(2), next(2)

      is_worth = real(next(1), wp)*next(2) >= worth*real(counts(1), wp)*counts(2)
   end function is_worth

   !> The numbers of elements of a grid, in the same window
   pure subroutine set_elements(grid, counts, lengths)
      !> As the case describes it
      type(grid_spec), intent(inout) :: grid
      !> Elements along x and y
      integer, intent(in) :: counts(2)
      !> Sides of the window [mm]; not used where it follows from Hertz's solution
      real(wp), intent(in) :: lengths(2)
      real(wp) :: corner(2), sides(2)

      sides = lengths/counts
      select case (grid%form)
      case (grid_form%corner_and_sides)
         grid%dx = sides(1)
         grid%dy = sides(2)
      case (grid_form%centre_and_sides)
         corner = [grid%xc1 - 0.5_wp*grid%dx, grid%yc1 - 0.5_wp*grid%dy]
         grid%dx = sides(1)
         grid%dy = sides(2)
         grid%xc1 = corner(1) + 0.5_wp*sides(1)
         grid%yc1 = corner(2) + 0.5_wp*sides(2)
      case (grid_form%centres)
         corner = 0.5_wp*[grid%xc1 + grid%xcm - lengths(1), grid%yc1 + grid%ycm - lengths(2)]
         grid%xc1 = corner(1) + 0.5_wp*sides(1)
         grid%yc1 = corner(2) + 0.5_wp*sides(2)
         grid%xcm = grid%xc1 + (counts(1) - 1)*sides(1)
         grid%ycm = grid%yc1 + (counts(2) - 1)*sides(2)
      end select
      grid%mx = counts(1)
      grid%my = counts(2)
   end subroutine set_elements

   !> Of the grids of a search that ended too early keep the one with the smaller estimate
   subroutine keep_better(session, factor, best, report, result)
      type(contact_session), intent(in) :: session
      !> Of estimates
      real(wp), intent(in) :: factor
      !> The grid before the last
      type(patch_result), intent(in) :: best
      type(accuracy_report), intent(inout) :: report
      !> The last one, which may have no result
      type(patch_result), intent(inout) :: result
      real(wp) :: before

      before = -1.0_wp
      if (best%status%is_solved()) before = factor*error_of_forces(session%problem, best)
      if (before < 0.0_wp) return
      if (report%estimated >= 0.0_wp .and. report%estimated <= before .and. allocated(result%errors)) return
      result = best
      report%estimated = before
   end subroutine keep_better

   !> Put what was chosen into specification and result; a warning where the accuracy was not reached
   subroutine tell_report(spec, level, result, report, log)
      type(case_spec), intent(inout) :: spec
      !> As the last grid was solved
      type(case_spec), intent(inout) :: level
      type(patch_result), intent(inout) :: result
      type(accuracy_report), intent(inout) :: report
      type(log_type), intent(inout) :: log

      report%elements = [result%grid%mx, result%grid%my]
      report%sides = [result%grid%dx, result%grid%dy]
      report%order = result%tangential%order
      report%is_met = report%estimated >= 0.0_wp .and. report%estimated <= report%asked
      if (report%is_met) then
         report%reason = ""
      else if (report%reason == "") then
         report%reason = "finer elements did not help"
         if (allocated(result%errors)) then
            if (result%errors%reason /= "") report%reason = "there is no estimate: " // result%errors%reason
         end if
      end if
      call set_elements(level%grid, report%elements, report%elements*report%sides)
      spec%grid = level%grid
      spec%iteration%eps = report%eps
      spec%iteration%order = 2
      spec%estimates_errors = .true.
      if (spec%motion == motion%steady_rolling) spec%rolling%dq = result%dq
      result%accuracy = report
      if (.not. report%is_met) call log%warning("the accuracy that was asked for was not reached: " // trim(report%reason))
   end subroutine tell_report
end module contact_cases_accuracy
