!> Estimated errors of the totals of a solved patch: discretisation, solvers, and contact cut off at the border
!>
!> The same contact is solved on elements three times as long (contact_patch_coarse_level), starting from the mean tractions of the
!> solution. The difference of the totals on both levels, divided by 3^p - 1, estimates the discretisation error where its order p
!> is clean. It is not clean because edges of contact have arbitrary positions within elements: the difference of two levels may be
!> small by accident. The estimate is therefore bounded below by a fraction of the typical error with this number of elements; see
!> doc/theory/errors.md.
module contact_patch_error_estimate
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_quiet_nan, ieee_value
   use contact_base_choices, only : motion
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : element
   use contact_patch_between_rows, only : section_details
   use contact_patch_balances, only : balances_power, error_of_normal_energy, motion_power, normal_energy
   use contact_patch_coarse_level, only : coarsen_patch, coarsening
   use contact_patch_error_kinds, only : is_first, is_sliding, is_turning, sliding_part
   use contact_patch_error_scales, only : mean_friction, normal_order, rows_error, scale_type, scales
   use contact_patch_level_errors, only : error_of, irregularity, scale_of, share_of_residual
   use contact_patch_order, only : order_of_errors
   use contact_patch_peak, only : peak_of
   use contact_patch_peak_errors, only : error_of_peak, is_peak_cut_off
   use contact_patch_problem, only : patch_problem, patch_state, traction_fields
   use contact_patch_quantities, only : error_law, error_scale, total, total_list
   use contact_patch_result, only : patch_result
   use contact_patch_sliding_errors, only : find_direction_errors
   use contact_patch_solve, only : solve_patch
   use contact_patch_traction_errors, only : errors_in_sliding, traction_error
   use contact_patch_workspace, only : patch_workspace, release_workspace
   implicit none (type, external)
   private

   public :: add_error_of_load, coarse_level, compare_levels, error_of_forces, estimate_errors, moment_power, normal_stiffness, &
      & release_coarse_level, solve_coarse_level

   !> The coarse level, kept from case to case for its arrays and spectra
   type :: coarse_level
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      type(patch_result) :: result
      !> Log without screen and file: nothing is reported about the coarse solution
      type(log_type) :: log
   end type coarse_level

   !> Exponent of the normal force to which the moment is proportional, by Hertz's theory with fixed creepages
   real(wp), parameter :: moment_power = 4.0_wp/3.0_wp
   !> Reason why there is no estimate when the coarse level failed
   character(len=*), parameter :: no_solution = "the coarser level has no solution"

contains

   !> Free the memory that the level holds outside Fortran
   subroutine release_coarse_level(level)
      !> Its plans are freed; it may be used again
      type(coarse_level), intent(inout) :: level

      call release_workspace(level%workspace)
   end subroutine release_coarse_level

   !> Estimate the errors of all totals of a single patch
   subroutine estimate_errors(problem, state, link, order, level, result, error)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Its solution, and the previous time step
      type(patch_state), intent(in) :: state
      !> Relation to the previous case, member of time_link
      integer, intent(in) :: link
      !> Order of the scheme of the tangential problem, 1 or 2
      integer, intent(in) :: order
      !> Work space
      type(coarse_level), intent(inout) :: level
      !> Solution; `errors` is set
      type(patch_result), intent(inout) :: result
      !> Allocated if the time limit is exceeded
      type(error_type), allocatable, intent(out) :: error

      call solve_coarse_level(problem, state, link, level, result, error)
      if (.not. allocated(error)) call compare_levels(problem, order, level, result)
   end subroutine estimate_errors

   !> Solve the coarse level of a solved patch
   subroutine solve_coarse_level(problem, state, link, level, result, error)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Its solution, and the previous time step
      type(patch_state), intent(in) :: state
      !> Relation to the previous case, member of time_link
      integer, intent(in) :: link
      !> The coarse problem and its result are stored
      type(coarse_level), intent(inout) :: level
      !> Solution; `errors` is set, without values, and with a reason if there is no coarse level
      type(patch_result), intent(inout) :: result
      !> Allocated if the time limit is exceeded
      type(error_type), allocatable, intent(out) :: error
      type(total_list) :: list

      if (.not. allocated(result%errors)) allocate(result%errors)
      call result%totals(list)
      associate (errors => result%errors)
         if (allocated(errors%value)) deallocate(errors%value)
         allocate(errors%value(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
         errors%ncon = 0
         errors%adhered_before = adhesion_before(state%before)
         errors%stopping = max(0.0_wp, [share_of_residual(.false.)*result%normal%residual, &
            & share_of_residual(problem%model%layer > 0.0_wp)*result%tangential%residual])
         errors%window = cut_off(problem, result)
         call coarsen_patch(problem, state, link, result, level%problem, level%state, errors%reason)
         if (errors%reason == "") then
            call solve_patch(level%problem, level%state, level%workspace, level%log, level%result, error)
            if (allocated(error)) then
               if (error%kind == error_kind%time) return
               deallocate(error)
               errors%reason = no_solution
            else if (.not. level%result%status%has_result() .or. level%result%ncon == 0 &
               & .or. .not. level%result%has_finite_totals()) then
               errors%reason = no_solution
            end if
         end if
         level%state%started = errors%reason == ""
         if (errors%reason == "") errors%ncon = level%result%ncon
      end associate
   end subroutine solve_coarse_level

   !> Fraction of the elements in contact that adhered at the previous time step, negative if there were no tractions [-]
   pure real(wp) function adhesion_before(before) result(part)
      !> Previous time step, without fields if there was none
      type(traction_fields), intent(in) :: before

      part = -1.0_wp
      if (.not. (allocated(before%division) .and. allocated(before%px) .and. allocated(before%py))) return
      if (.not. (any(abs(before%px) > 0.0_wp) .or. any(abs(before%py) > 0.0_wp))) return
      part = real(count(before%division == element%adhesion), wp)/max(1, count(before%division > element%exterior))
   end function adhesion_before

   !> Errors from the totals on both levels
   subroutine compare_levels(problem, order, level, result, approach_change, details, rows)
      type(patch_problem), intent(in) :: problem
      !> See estimate_errors
      integer, intent(in) :: order
      !> Solved coarse level
      type(coarse_level), intent(in) :: level
      !> Values in `errors` are set, unless there is a reason against it
      type(patch_result), intent(inout) :: result
      !> Change of the approach of the coarse level that keeps a prescribed total force [mm]; absent for a single patch
      real(wp), intent(in), optional :: approach_change
      !> Pressures with the details between rows of elements; absent if the distance is known at the elements only
      type(section_details), intent(in), optional :: details
      !> Errors by few rows [N, N mm]; absent: not known
      type(rows_error), intent(in), optional :: rows
      type(total_list) :: fine, coarse
      type(scale_type) :: scale
      real(wp) :: load, difference, coarse_energy, parts(2)
      integer :: k

      if (result%errors%reason /= "") return
      call result%totals(fine)
      call level%result%totals(coarse)
      load = 1.0_wp
      if (present(approach_change)) then
         load = max(0.0_wp, 1.0_wp + normal_stiffness(result)*approach_change/level%result%fn)
         do k = 1, coarse%length
            coarse%rows(k)%value = coarse%rows(k)%value*load**power_of_load(coarse%rows(k))
         end do
         associate (pen => coarse%rows(coarse%place_of("pen"))%value)
            pen = level%result%pen + approach_change
         end associate
      end if
      scale = scales(problem, order, result)
      scale%in_pair = present(details)
      if (present(details)) scale%hidden = abs(details%approach)/max(scale%depth, tiny(load))
      scale%coarse_sticking = real(level%result%nadh, wp)/level%result%ncon
      scale%energy(1) = normal_energy(result)
      scale%energy(2) = result%elastic_energy - scale%energy(1)
      coarse_energy = normal_energy(level%result)
      scale%energy_change(1) = scale%energy(1) - load**(5.0_wp/3.0_wp)*coarse_energy
      scale%energy_change(2) = scale%energy(2) - load**(5.0_wp/3.0_wp)*(level%result%elastic_energy - coarse_energy)
      if (.not. present(approach_change)) &
         & call error_of_normal_energy(problem, result, level%result, scale%normal_energy, scale%has_normal_energy)
      call compare_powers(problem, result, level, load, scale)
      if (allocated(problem%thermal) .and. allocated(problem%friction)) then
         if (problem%friction%driver() == friction_driver%temperature) &
            & scale%warmed = abs(mean_friction(level%result) - mean_friction(result))/max(mean_friction(result), tiny(load))
      end if
      call compare_directions(problem, result, level, load, scale)
      result%errors%stopping(2) = max(result%errors%stopping(2), scale%gain*result%errors%stopping(1))
      do k = 1, fine%length
         difference = difference_of(fine, coarse, k)
         if (difference < 0.0_wp) cycle
         if (fine%rows(k)%law == error_law%normal) scale%irregular = max(scale%irregular, &
            & irregularity(fine%rows(k), difference, scale))
         if (fine%rows(k)%law /= error_law%friction) cycle
         if (.not. scale_of(fine%rows(k), scale) > 0.0_wp) cycle
         difference = difference/scale_of(fine%rows(k), scale)
         scale%friction = max(scale%friction, difference)
         if (fine%rows(k)%scale /= error_scale%moment) scale%forces = max(scale%forces, difference)
      end do
      scale%peak = error_of_peak(problem, result, scale, &
         & load**power_of_load(fine%rows(fine%place_of("pmax")))*peak_of(level%result%pn), details)/max(result%pmax, tiny(load))
      scale%turned_force = turned_force(fine, coarse)/max(scale%force, tiny(load))
      if (present(rows)) then
         scale%rows = rows
         scale%rows%value = rows%value/max([scale%force, scale%force, scale%moment], tiny(load))
         scale%turned_rows = to_force(scale%rows%value(1:2), [result%fx, result%fy]/max(hypot(result%fx, result%fy), tiny(load)))
      end if
      result%errors%traction = traction_error(scale)
      result%errors%cancelled = scale%cancelled
      result%errors%has_turned = scale%has_turned .or. is_turning(scale)
      if (result%errors%has_turned) then
         parts = scale%force*(errors_in_sliding(scale) + maxval(result%errors%stopping) + result%errors%window)
         result%errors%turned = parts(1)
         result%errors%shortened = parts(2)
      end if
      do k = 1, fine%length
         if (is_given(problem, fine%rows(k)%name, present(approach_change))) cycle
         difference = difference_of(fine, coarse, k)
         if (difference < 0.0_wp) cycle
         if (fine%rows(k)%name == "pmax") then
            if (.not. is_peak_cut_off(problem, result)) result%errors%value(k) = scale%peak*result%pmax
         else
            result%errors%value(k) = error_of(fine%rows(k), difference, scale, result%errors)
         end if
      end do
      result%errors%traction = max(result%errors%traction, error_of_directions(fine, scale, result%errors%value))
   end subroutine compare_levels

   !> Error of the tractions at a point in nearly full sliding by the first order: that of their directions, where these differ,
   !> as FX and FY show it [-]
   pure real(wp) function error_of_directions(list, scale, errors) result(e)
      !> Totals, scales, and errors of the totals, NaN for those without
      type(total_list), intent(in) :: list
      type(scale_type), intent(in) :: scale
      real(wp), intent(in) :: errors(:)
      real(wp) :: parts(2)

      e = 0.0_wp
      if (.not. (is_first(scale) .and. scale%force > 0.0_wp)) return
      parts = errors([list%place_of("fx"), list%place_of("fy")])
      if (any(ieee_is_nan(parts))) return
      e = sliding_part(scale%sticking)*scale%cancelled*maxval(parts)/scale%force
   end function error_of_directions

   !> Difference of a total between the levels, in its unit; -1: it has no error, or the coarse level lacks it, as it has no damping
   pure real(wp) function difference_of(fine, coarse, row) result(difference)
      !> Totals of both levels
      type(total_list), intent(in) :: fine, coarse
      !> Index in the list of the finer level
      integer, intent(in) :: row
      integer :: place

      difference = -1.0_wp
      if (fine%rows(row)%law == error_law%none) return
      place = coarse%place_of(fine%rows(row)%name, row)
      if (coarse%rows(place)%name == fine%rows(row)%name) difference = abs(fine%rows(row)%value - coarse%rows(place)%value)
   end function difference_of

   !> Difference of the tangential force between the levels: across it, and along it [N]
   pure function turned_force(fine, coarse) result(change)
      !> Totals of both levels
      type(total_list), intent(in) :: fine, coarse
      real(wp) :: change(2), force(2)

      force = [fine%rows(fine%place_of("fx"))%value, fine%rows(fine%place_of("fy"))%value]
      change = to_force(force - [coarse%rows(coarse%place_of("fx"))%value, coarse%rows(coarse%place_of("fy"))%value], &
         & force/max(norm2(force), tiny(force)))
   end function turned_force

   !> Components of a vector across and along a direction
   pure function to_force(vector, along) result(parts)
      !> Vector; direction of unit length
      real(wp), intent(in) :: vector(2), along(2)
      real(wp) :: parts(2)

      parts = [along(1)*vector(2) - along(2)*vector(1), dot_product(along, vector)]
   end function to_force

   !> Power of the motion on both levels, compared with frictional power, in steady rolling
   pure subroutine compare_powers(problem, result, level, load, scale)
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      !> Solved
      type(coarse_level), intent(in) :: level
      !> Ratio of the normal force to that of the coarse level [-]
      real(wp), intent(in) :: load
      !> The components that concern power are set
      type(scale_type), intent(inout) :: scale
      real(wp) :: power(2)

      if (problem%motion /= motion%steady_rolling .or. allocated(problem%simplified)) return
      power = [motion_power(problem, result), load*motion_power(level%problem, level%result)]
      scale%has_motion_power = all(power < huge(load))
      if (.not. scale%has_motion_power) return
      scale%balances = balances_power(problem)
      scale%motion_change = power(1) - power(2)
      scale%surplus = result%friction_power - power(1)
      scale%coarse_surplus = load*level%result%friction_power - power(2)
   end subroutine compare_powers

   !> Errors of the directions of tractions in full sliding, and the rest of the difference of the levels, of second order
   pure subroutine compare_directions(problem, result, level, load, scale)
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      !> Solved
      type(coarse_level), intent(in) :: level
      !> Ratio of the normal force to that of the coarse level [-]
      real(wp), intent(in) :: load
      !> The components that concern directions are set
      type(scale_type), intent(inout) :: scale
      !> Largest fraction of the bound without a resolved direction of slip; chosen
      real(wp), parameter :: most_unresolved = 0.01_wp
      real(wp), dimension(3) :: unit, fine, coarse, change, ratio
      real(wp) :: unresolved, coarse_unresolved

      scale%has_turned = is_sliding(scale)
      if (.not. scale%has_turned) return
      unit = max([scale%force, scale%force, scale%moment], tiny(load))
      ratio = load**[1.0_wp, 1.0_wp, moment_power]
      call find_direction_errors(problem, result, fine, unresolved)
      scale%has_turned = unresolved <= most_unresolved
      if (.not. scale%has_turned) return
      call find_direction_errors(level%problem, level%result, coarse, coarse_unresolved)
      change = ratio*([level%result%fx, level%result%fy, level%result%mz] - coarse) - ([result%fx, result%fy, result%mz] - fine)
      scale%turned = fine/unit
      scale%not_turned = change/((coarsening**normal_order - 1.0_wp)*unit)
      fine(1:2) = [result%fx, result%fy]/max(hypot(result%fx, result%fy), tiny(load))
      scale%turned(1:2) = to_force(scale%turned(1:2), fine(1:2))
      scale%not_turned(1:2) = to_force(scale%not_turned(1:2), fine(1:2))
   end subroutine compare_directions

   !> Derivative of the normal force with respect to the approach: computed, or by Hertz's theory [N/mm]
   pure real(wp) function normal_stiffness(result) result(stiffness)
      !> Solved
      type(patch_result), intent(in) :: result
      !> FN is proportional to this power of the approach
      real(wp), parameter :: hertz_power = 1.5_wp

      stiffness = result%sensitivity(1, 1)
      if (.not. stiffness > 0.0_wp) stiffness = hertz_power*result%fn/max(result%pen - minval(result%h), tiny(stiffness))
   end function normal_stiffness

   !> Add the effect of an error of the normal force of a patch by the balance of forces, an independent error of all totals
   subroutine add_error_of_load(load, result)
      !> Relative error of the normal force [-]
      real(wp), intent(in) :: load
      !> Values in `errors` are increased, except that of the approach, whose error is known
      type(patch_result), intent(inout) :: result
      type(total_list) :: list
      integer :: k

      call result%totals(list)
      do k = 1, list%length
         if (list%rows(k)%name == "pen") cycle
         ! without estimate it remains so
         result%errors%value(k) = hypot(result%errors%value(k), load*power_of_load(list%rows(k))*list%rows(k)%value)
      end do
   end subroutine add_error_of_load

   !> Exponent of the normal force to which a total is proportional, by Hertz's theory with fixed creepages [-]
   pure real(wp) function power_of_load(row) result(power)
      type(total), intent(in) :: row

      select case (row%law)
      case (error_law%normal, error_law%power)
         power = 1.0_wp
      case (error_law%friction)
         power = 0.0_wp
         if (row%scale == error_scale%force) power = 1.0_wp
         if (row%scale == error_scale%moment) power = moment_power
      case (error_law%energy)
         power = 5.0_wp/3.0_wp
      case (error_law%peak)
         power = 1.0_wp/3.0_wp
      case (error_law%area)
         power = 2.0_wp/3.0_wp
      case default
         power = 0.0_wp
      end select
   end function power_of_load

   !> Is a total prescribed?
   pure logical function is_given(problem, name, in_pair) result(given)
      type(patch_problem), intent(in) :: problem
      character(len=*), intent(in) :: name
      !> Is it a patch of wheel and rail whose height is determined by a force?
      logical, intent(in) :: in_pair

      select case (name)
      case ("fn")
         ! pressures by formula are scaled to the force
         given = allocated(problem%given_pressure) .or. (problem%force_prescribed .and. problem%solves_for_pressure())
      case ("pen")
         given = .not. (in_pair .or. (problem%force_prescribed .and. problem%solves_for_pressure()))
      case ("cksi", "shift_x")
         given = problem%n_forces < 1
      case ("ceta", "shift_y")
         given = problem%n_forces < 2
      case ("fx", "fx_rel")
         given = problem%n_forces >= 1 .or. problem%motion == motion%none
      case ("fy", "fy_rel")
         given = problem%n_forces >= 2 .or. problem%motion == motion%none
      case ("mz", "friction_power", "friction_work")
         given = problem%motion == motion%none
      case default
         given = .false.
      end select
   end function is_given

   !> Largest estimated error of the normal force or the approach, the tangential forces, their moment, and creepages that are
   !> found, each relative to its scale [-]; negative without estimate
   pure real(wp) function error_of_forces(problem, result) result(e)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solution with estimated errors
      type(patch_result), intent(in) :: result
      type(total_list) :: list
      type(scale_type) :: scale
      integer :: k

      e = -1.0_wp
      if (.not. allocated(result%errors)) return
      if (result%errors%reason /= "") return
      call result%totals(list)
      scale = scales(problem, order_of_errors(result%tangential), result)
      do k = 1, list%length
         if (all(list%rows(k)%law /= [error_law%normal, error_law%friction, error_law%creepage])) cycle
         ! without estimate for one of them
         if (ieee_is_nan(result%errors%value(k)) .or. .not. scale_of(list%rows(k), scale) > 0.0_wp) cycle
         ! relative forces repeat the forces, with a scale of 1
         e = max(e, result%errors%value(k)/scale_of(list%rows(k), scale))
      end do
   end function error_of_forces

   !> Fraction of the normal force that contact beyond the border would carry [-]
   pure real(wp) function cut_off(problem, result) result(part)
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(in) :: result
      real(wp) :: beyond
      integer :: mx, my

      part = 0.0_wp
      if (allocated(problem%given_pressure) .or. .not. any(result%border%side)) return
      mx = result%grid%mx
      my = result%grid%my
      beyond = 0.0_wp
      if (result%border%side(1)) beyond = beyond + sum(result%pn(1, :))
      if (result%border%side(2)) beyond = beyond + sum(result%pn(mx, :))
      if (result%border%side(3)) beyond = beyond + sum(result%pn(:, 1))
      if (result%border%side(4)) beyond = beyond + sum(result%pn(:, my))
      part = beyond/sum(result%pn)
   end function cut_off
end module contact_patch_error_estimate
