!> Estimated errors of the totals of a solved patch: of the elements, of the solvers, and of the window
!>
!> The same contact is solved with elements three times as long (contact_patch_coarse_level), from the mean tractions of the
!> solution. What the totals of both differ by, divided by 3^p - 1, is the error of the elements where its order p is clean. It
!> is not where edges of contact lie anywhere within elements: the difference of two levels may be small by accident. The
!> estimate is therefore not less than a part of the error that contacts of so many elements have in general; see
!> doc/theory/errors.md.
module contact_patch_error_estimate
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_choices, only : motion
   use contact_base_constants, only : excluded_threshold, nmm_per_joule, pi
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_patch_coarse_level, only : coarsen_patch, coarsening
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_quantities, only : error_law, total, total_list
   use contact_patch_result, only : error_estimate, patch_result
   use contact_patch_solve, only : solve_patch
   use contact_patch_workspace, only : patch_workspace, release_workspace
   implicit none (type, external)
   private

   public :: coarse_level, compare_levels, error_of_forces, estimate_errors, normal_stiffness, release_coarse_level, &
      & solve_coarse_level

   !> The coarse level, kept from case to case for its arrays and spectra
   type :: coarse_level
      type(patch_problem) :: problem
      type(patch_state) :: state
      type(patch_workspace) :: workspace
      type(patch_result) :: result
      !> Without screen and file: the coarse solution has nothing to tell
      type(log_type) :: log
   end type coarse_level

   !> What is common to all totals of a patch
   type :: scale_type
      !> Elements across the contact in the direction that has fewest
      real(wp) :: across = 1.0_wp
      !> Force and moment that friction bears at most [N, N mm]
      real(wp) :: force = 0.0_wp, moment = 0.0_wp
      !> Larger one of the two creepages; power, or work, if all of the contact slid with it [W, J]
      real(wp) :: creep = 0.0_wp, power = 0.0_wp
      !> Part of the elements in contact that does not slip [-]
      real(wp) :: adhesion = 0.0_wp
      !> Differences of the levels in tangential forces, relative to the largest one [-]
      real(wp) :: friction = 0.0_wp
      !> Order of the tangential problem; is it clean, so that levels may be extrapolated?
      real(wp) :: order = 1.0_wp
      logical :: clean = .true.
      !> Difference parameter K of unlike bodies [-]
      real(wp) :: coupling = 0.0_wp
      !> Parts of the elastic energy, of pressures and of tractions, and what the levels differ by in them [J]
      real(wp) :: energy(2) = 0.0_wp, energy_change(2) = 0.0_wp
   end type scale_type

   !> Why there is no estimate after a failure of the coarse level
   character(len=*), parameter :: no_solution = "the coarser level has no solution"
   !> Order of the normal problem, of the highest temperature, and of what jumps with single elements
   real(wp), parameter :: normal_order = 2.0_wp, peak_order = 1.5_wp, jump_order = 1.0_wp
   !> Of frictional power with the first order: its error falls to 1/(1 + 1.65) with elements of a third; median of tests/accuracy
   real(wp), parameter :: power_order = 0.89_wp
   !> The same with the second order: factor of n^-2 that power is not estimated below; median of tests/accuracy
   real(wp), parameter :: rolling_power_floor = 0.4_wp
   !> Contact of fewer elements across is not resolved, and in that direction not coarsened either: any total is off by this times
   !> n^-2; of the hard cases of tests/stability
   real(wp), parameter :: resolved = 6.0_wp, unresolved_floor = 0.5_wp
   !> Tractions of unlike bodies pull pressures up where elements do not see it: factor of the difference parameter K times n^-2 in
   !> the largest pressure; of the hard cases
   real(wp), parameter :: coupled_floor = 4.0_wp
   !> Few rows of elements stand for plane strain where they are longer than the contact by this factor; chosen
   real(wp), parameter :: plane = 4.0_wp
   !> A peak of pressures bends by 4 n^-2 of itself over an element of a contact of n; what it bends beyond this multiple is a peak
   !> that elements do not resolve, and off by this part of the bend; chosen with the hard cases of tests/stability
   real(wp), parameter :: smooth_bend = 12.0_wp, unresolved = 0.15_wp
   !> Of forces in steady rolling by both schemes; the second one shows this order from 15 to 45 elements on, with its jitter
   real(wp), parameter :: first_order = 1.0_wp, second_order = 1.6_wp
   !> Errors of tangential forces and moment are at least this part of the largest of them
   real(wp), parameter :: other_component = 0.2_wp
   !> Errors in general, of n elements across: factor of n^-order. Medians of tests/accuracy over random contacts
   real(wp), parameter :: normal_floor = 0.15_wp, friction_floor(2) = [0.05_wp, 0.05_wp], rolling_floor = 0.15_wp, &
      & power_floor = 0.1_wp, peak_floor = 0.3_wp, area_floor = 0.2_wp, energy_floor(2) = [0.2_wp, 0.3_wp]
   !> Part of a residual that shows in forces; measured between tolerances of 1e-2 and 1e-4
   real(wp), parameter :: residual_share = 0.3_wp

contains

   !> Free what the level holds outside Fortran's memory
   subroutine release_coarse_level(level)
      !> Its plans are freed; may be used again
      type(coarse_level), intent(inout) :: level

      call release_workspace(level%workspace)
   end subroutine release_coarse_level

   !> Estimate the errors of all totals of a patch that stands for itself
   subroutine estimate_errors(problem, state, link, order, level, result, error)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Its solution, and the previous time step
      type(patch_state), intent(in) :: state
      !> How the case continues the one before, member of time_link
      integer, intent(in) :: link
      !> Order of the scheme of the tangential problem, 1 or 2
      integer, intent(in) :: order
      !> Scratch
      type(coarse_level), intent(inout) :: level
      !> Solved; gets `errors`
      type(patch_result), intent(inout) :: result
      !> Allocated when time is up
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
      !> How the case continues the one before, member of time_link
      integer, intent(in) :: link
      !> Gets the coarse problem and its result
      type(coarse_level), intent(inout) :: level
      !> Solved; gets `errors`, without values, and with a reason where there is no coarse level
      type(patch_result), intent(inout) :: result
      !> Allocated when time is up
      type(error_type), allocatable, intent(out) :: error
      type(total_list) :: list

      if (.not. allocated(result%errors)) allocate(result%errors)
      call result%totals(list)
      associate (errors => result%errors)
         if (allocated(errors%value)) deallocate(errors%value)
         allocate(errors%value(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
         errors%ncon = 0
         errors%stopping = residual_share*max(0.0_wp, [result%normal%residual, result%tangential%residual])
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

   !> Errors from the totals of both levels
   subroutine compare_levels(problem, order, level, result, approach_change)
      type(patch_problem), intent(in) :: problem
      !> See estimate_errors
      integer, intent(in) :: order
      !> Solved
      type(coarse_level), intent(in) :: level
      !> Gets values in `errors`, where there is no reason against them
      type(patch_result), intent(inout) :: result
      !> Change of the approach of the coarse level that keeps a prescribed total force [mm]; absent: the problem is complete
      real(wp), intent(in), optional :: approach_change
      type(total_list) :: fine, coarse
      type(scale_type) :: scale
      real(wp) :: load, difference
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
      scale%energy = energies(result)
      scale%energy_change = scale%energy - load**(5.0_wp/3.0_wp)*energies(level%result)
      do k = 1, fine%length
         if (fine%rows(k)%law /= error_law%friction) cycle
         if (scale_of(fine%rows(k), scale) > 0.0_wp) scale%friction = max(scale%friction, &
            & abs(fine%rows(k)%value - coarse%rows(k)%value)/scale_of(fine%rows(k), scale))
      end do
      do k = 1, fine%length
         if (fine%rows(k)%law == error_law%none .or. is_given(problem, fine%rows(k)%name, present(approach_change))) cycle
         difference = abs(fine%rows(k)%value - coarse%rows(k)%value)
         if (fine%rows(k)%name == "pmax") then
            result%errors%value(k) = error_of_peak(result, scale, load**power_of_load(fine%rows(k))*peak_of(level%result%pn))
         else
            result%errors%value(k) = error_of(fine%rows(k), difference, scale, result%errors)
         end if
      end do
   end subroutine compare_levels

   !> Change of the normal force with the approach: computed, or by Hertz's theory [N/mm]
   pure real(wp) function normal_stiffness(result) result(stiffness)
      !> Solved
      type(patch_result), intent(in) :: result
      !> FN is in proportion to the approach to this power
      real(wp), parameter :: hertz_power = 1.5_wp

      stiffness = result%sensitivity(1, 1)
      if (.not. stiffness > 0.0_wp) stiffness = hertz_power*result%fn/max(result%pen - minval(result%h), tiny(stiffness))
   end function normal_stiffness

   !> Power of the normal force that a total is in proportion to, by Hertz's theory with fixed creepages
   pure real(wp) function power_of_load(row) result(power)
      type(total), intent(in) :: row

      select case (row%law)
      case (error_law%normal, error_law%power)
         power = 1.0_wp
      case (error_law%friction)
         power = 0.0_wp
         if (row%unit == "N") power = 1.0_wp
         if (row%unit == "N mm") power = 4.0_wp/3.0_wp
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
      !> Is it a patch of wheel and rail whose height follows from a force?
      logical, intent(in) :: in_pair

      select case (name)
      case ("fn")
         given = problem%force_prescribed .and. problem%solves_for_pressure()
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

   !> Largest estimated error of the normal force or the approach, of the tangential forces, their moment, and creepages that are
   !> found, each relative to its scale [-]; negative where there is no estimate
   pure real(wp) function error_of_forces(problem, result) result(e)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solved, with errors
      type(patch_result), intent(in) :: result
      type(total_list) :: list
      type(scale_type) :: scale
      integer :: k

      e = -1.0_wp
      if (.not. allocated(result%errors)) return
      if (result%errors%reason /= "") return
      call result%totals(list)
      scale = scales(problem, max(1, result%tangential%order), result)
      do k = 1, list%length
         if (all(list%rows(k)%law /= [error_law%normal, error_law%friction, error_law%creepage])) cycle
         ! NaN, where there is no estimate of one of them, is no maximum
         if (.not. (result%errors%value(k) >= 0.0_wp .and. scale_of(list%rows(k), scale) > 0.0_wp)) cycle
         ! relative forces are forces a second time, with a scale of 1
         e = max(e, result%errors%value(k)/scale_of(list%rows(k), scale))
      end do
   end function error_of_forces

   !> What totals are compared with
   pure function scales(problem, order, result) result(scale)
      type(patch_problem), intent(in) :: problem
      integer, intent(in) :: order
      type(patch_result), intent(in) :: result
      type(scale_type) :: scale
      type(bounding_box) :: box
      real(wp) :: extent(2)
      integer :: across(2)

      box = contact_box(result%division)
      across = [box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1]
      scale%across = minval(across)
      extent = across*[result%grid%dx, result%grid%dy]
      if (result%grid%my < 3 .and. extent(2) > plane*extent(1)) scale%across = across(1)
      if (result%grid%mx < 3 .and. extent(1) > plane*extent(2)) scale%across = across(2)
      scale%force = result%grid%dx*result%grid%dy*sum(result%mu*result%pn)
      scale%moment = scale%force*sqrt(result%contact_area()/pi)
      scale%creep = max(abs(result%cksi), abs(result%ceta))
      scale%power = scale%force*hypot(result%cksi, result%ceta)*result%dq/(nmm_per_joule*result%dt)
      scale%adhesion = real(result%nadh, wp)/result%ncon
      scale%order = normal_order
      if (problem%motion == motion%steady_rolling) scale%order = merge(second_order, first_order, order == 2)
      if (problem%motion == motion%transient_rolling) scale%order = 1.0_wp
      ! a step in time is longer than some elements and shorter than others; a layer adds a length of its own
      scale%clean = problem%motion /= motion%transient_rolling .and. .not. problem%model%layer > 0.0_wp
      ! tractions are singular at edges that are given
      if (problem%motion == motion%shift) scale%clean = .not. any(problem%h > excluded_threshold)
      if (problem%model%coupled()) scale%coupling = abs(problem%model%material%ak)
   end function scales

   !> What the error of a total is relative to, in its unit
   pure real(wp) function scale_of(row, scale) result(unit)
      type(total), intent(in) :: row
      type(scale_type), intent(in) :: scale

      unit = abs(row%value)
      if (row%law == error_law%creepage) unit = scale%creep
      if (row%law /= error_law%friction) return
      unit = 1.0_wp
      if (row%unit == "N") unit = scale%force
      if (row%unit == "N mm") unit = scale%moment
   end function scale_of

   !> Error of one total in its unit
   pure real(wp) function error_of(row, difference, scale, errors) result(e)
      type(total), intent(in) :: row
      !> Between the levels
      real(wp), intent(in) :: difference
      type(scale_type), intent(in) :: scale
      !> Its relative parts
      type(error_estimate), intent(in) :: errors
      real(wp) :: floor, order, part, stopping
      integer :: power

      stopping = maxval(errors%stopping)
      part = 1.0_wp
      select case (row%law)
      case (error_law%normal)
         part = 1.0_wp/(coarsening**normal_order - 1.0_wp)
         floor = normal_floor/scale%across**2
         stopping = errors%stopping(1)
      case (error_law%friction, error_law%power, error_law%creepage)
         order = scale%order
         power = nint(order)
         floor = friction_floor(power)
         if (order < normal_order .and. power == 2) floor = rolling_floor
         if (row%law == error_law%power) floor = merge(rolling_power_floor, power_floor, order < normal_order .and. power == 2) &
            & *max(scale%power, abs(row%value))/max(abs(row%value), tiny(floor))
         floor = floor*sqrt(scale%adhesion)/scale%across**power
         if (row%law == error_law%power .and. power == 1) order = power_order
         if (scale%clean) part = 1.0_wp/(coarsening**order - 1.0_wp)
         if (row%law == error_law%friction) floor = max(floor, other_component*part*scale%friction)
      case (error_law%energy)
         e = error_of_energy(scale) + (stopping + errors%window)*scale_of(row, scale)
         return
      case (error_law%peak)
         part = 1.0_wp/(coarsening**peak_order - 1.0_wp)
         floor = 0.0_wp
      case default
         part = 1.0_wp/(coarsening**jump_order - 1.0_wp)
         floor = area_floor/scale%across
      end select
      if (scale%across < resolved) floor = max(floor, unresolved_floor/scale%across**2)
      e = max(part*difference, floor*scale_of(row, scale)) &
         & + (stopping + errors%window)*scale_of(row, scale)
   end function error_of

   !> Error of the elastic energy without that of solvers and window [J]: those of its parts, whose signs differ from case to case
   pure real(wp) function error_of_energy(scale) result(e)
      type(scale_type), intent(in) :: scale
      real(wp) :: part

      part = 1.0_wp
      if (scale%clean) part = 1.0_wp/(coarsening**scale%order - 1.0_wp)
      e = hypot(scale%energy_change(1)/(coarsening**normal_order - 1.0_wp), part*scale%energy_change(2))
      e = max(e, energy_floor(1)*abs(scale%energy(1))/scale%across**2 &
         & + energy_floor(2)*sqrt(scale%adhesion)*abs(scale%energy(2))/scale%across**scale%order)
   end function error_of_energy

   !> Parts of the elastic energy [J]: of pressures, and of tractions
   pure function energies(result) result(energy)
      type(patch_result), intent(in) :: result
      real(wp) :: energy(2)

      energy(1) = result%grid%dx*result%grid%dy/(2.0_wp*nmm_per_joule)*sum(result%pn*result%un)
      energy(2) = result%elastic_energy - energy(1)
   end function energies

   !> Error of the largest pressure: it is taken at a centre of an element, below the peak, and pressures have an error of their own
   pure real(wp) function error_of_peak(result, scale, coarse_peak) result(e)
      !> Solved, with the parts of the error
      type(patch_result), intent(in) :: result
      type(scale_type), intent(in) :: scale
      !> Peak of the pressures of the coarse level [N/mm2]
      real(wp), intent(in) :: coarse_peak
      real(wp) :: peak, floor

      peak = peak_of(result%pn)
      floor = coupled_floor*scale%coupling/scale%across**2
      if (scale%across < resolved) floor = floor + unresolved_floor/scale%across**2
      e = max(abs(peak - result%pmax + (peak - coarse_peak)/(coarsening**normal_order - 1.0_wp)), &
         & peak_floor*(peak - result%pmax), floor*result%pmax, &
         & unresolved*(largest_bend(result%pn) - smooth_bend*result%pmax/scale%across**2)) &
         & + (result%errors%stopping(1) + result%errors%window)*result%pmax
   end function error_of_peak

   !> Peak of the parabolas through the largest value and its neighbours
   pure real(wp) function peak_of(field) result(peak)
      !> Shape (mx, my)
      real(wp), intent(in) :: field(:, :)
      integer :: at(2)

      at = maxloc(field)
      peak = field(at(1), at(2))
      if (at(1) > 1 .and. at(1) < size(field, 1)) peak = peak + rise(field(at(1) - 1:at(1) + 1, at(2)))
      if (at(2) > 1 .and. at(2) < size(field, 2)) peak = peak + rise(field(at(1), at(2) - 1:at(2) + 1))
   end function peak_of

   !> How much the largest value is above the mean of its neighbours, twice, in the direction where that is more
   pure real(wp) function largest_bend(field) result(bend)
      !> Shape (mx, my); zero is ahead of the first and behind the last value
      real(wp), intent(in) :: field(:, :)
      integer :: at(2)

      at = maxloc(field)
      bend = 0.0_wp
      if (size(field, 1) >= 3) bend = 2.0_wp*field(at(1), at(2)) - beside_of(field(:, at(2)), at(1))
      if (size(field, 2) >= 3) bend = max(bend, 2.0_wp*field(at(1), at(2)) - beside_of(field(at(1), :), at(2)))
   end function largest_bend

   !> Sum of the values on both sides of a place
   pure real(wp) function beside_of(line, i) result(sum_beside)
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i

      sum_beside = 0.0_wp
      if (i > 1) sum_beside = line(i - 1)
      if (i < size(line)) sum_beside = sum_beside + line(i + 1)
   end function beside_of

   !> How far the parabola through three values rises above the one in the middle
   pure real(wp) function rise(value)
      !> The largest in the middle
      real(wp), intent(in) :: value(3)
      real(wp) :: bend

      bend = 2.0_wp*value(2) - value(1) - value(3)
      rise = 0.0_wp
      if (bend > 0.0_wp) rise = (value(3) - value(1))**2/(8.0_wp*bend)
   end function rise

   !> Part of the load that contact beyond the window would carry
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
