!> Errors of totals from what they differ by between a solution and that with elements three times as long
!>
!> Orders, and what errors are not below: see doc/theory/errors.md.
module contact_patch_level_errors
   use contact_base_kinds, only : wp
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_scales, only : first_order, normal_order, scale_type
   use contact_patch_peak, only : peak_of
   use contact_patch_quantities, only : error_law, total
   use contact_patch_result, only : error_estimate, patch_result
   use contact_patch_step_errors, only : energy_of_forces, force_error, power_error
   implicit none (type, external)
   private

   public :: coupled_friction_floor, error_of, error_of_peak, irregularity, residual_share, scale_of, traction_error, trusted

   !> Order of what jumps with single elements
   real(wp), parameter :: jump_order = 1.0_wp
   !> Of frictional power with the first order: its error falls to 1/(1 + 1.65) with elements of a third; median of tests/accuracy
   real(wp), parameter :: power_order = 0.89_wp
   !> Contact of fewer elements across is not resolved, and in that direction not coarsened either: any total is off by this times
   !> n^-2; of the hard cases of tests/stability
   real(wp), parameter :: resolved = 6.0_wp, unresolved_floor = 0.5_wp
   !> Tractions of unlike bodies pull pressures up where elements do not see it: factor of the difference parameter K times n^-2 in
   !> the largest pressure; of the hard cases
   real(wp), parameter :: coupled_floor = 4.0_wp
   !> Pressures of unlike bodies drive tractions at the leading edge: factor of K k n^-1 in forces by the second order, with k = K
   !> over the coefficient of friction, at most 1, see doc/theory/second_order.md
   real(wp), parameter :: coupled_friction_floor = 0.15_wp
   !> Where they reach the bound beside adhesion, the zone of slip ahead is narrower than elements: factor of k^3 times the root of
   !> the part that sticks, times n^-1; of unlike bodies with seed 8101
   real(wp), parameter :: hidden_slip = 0.5_wp
   !> A peak of pressures bends by 4 n^-2 of itself over an element of a contact of n; what it bends beyond this multiple is a peak
   !> that elements do not resolve, and off by this part of the bend; chosen with the hard cases of tests/stability
   real(wp), parameter :: smooth_bend = 12.0_wp, unresolved = 0.15_wp
   !> Errors of tangential forces and moment are at least this part of the largest of them
   real(wp), parameter :: other_component = 0.2_wp
   !> Where slip turns round without adhesion in between, elements do not see where: forces are off by this part of what an
   !> element carries there. Root of the mean square over positions of the grid, two rollers of aluminium and steel; in shifts of
   !> like bodies, where single elements at the edge of what slips back do so (kind shifts, seed 7101)
   real(wp), parameter :: reversal_share = 0.7_wp, reversal_in_shifts = 0.18_wp
   !> Errors in general, of n elements across: factor of n^-order, by order; of random contacts of tests/accuracy, those of shifts
   !> with seed 5301. Forces of steady rolling; of shifts
   real(wp), parameter :: rolling_floor(2) = [0.05_wp, 0.24_wp], shift_floor = 0.12_wp
   !> The same of a single layer in rolling, whose slip has a length of its own: factor of n^-1 (seed 4001)
   real(wp), parameter :: layer_floor = 0.3_wp
   !> Elements that do not resolve the relaxation of viscoelastic bodies: factor of n^-1, by order (seeds 8101 and 8103)
   real(wp), parameter :: relaxing_floor(2) = [0.05_wp, 0.15_wp]
   !> Part of these that moments have where both forces are prescribed; of random contacts (seed 3101)
   real(wp), parameter :: moment_alone = 0.5_wp
   !> Power: factor of n^-order of the power of full sliding; and of n^-2 and adhesion in steady rolling; with a layer, of n^-1,
   !> there also of the energy of tractions
   real(wp), parameter :: power_floor = 0.1_wp, adhesive_power_floor = 2.5_wp, layer_power_floor = 1.0_wp
   !> Normal force; largest pressure, half the rms over offsets of a Hertzian peak; area; energy of pressures and of tractions
   real(wp), parameter :: normal_floor = 0.15_wp, peak_floor = 0.15_wp, area_floor = 0.2_wp, energy_floor(2) = [0.07_wp, 0.2_wp]
   !> Elastic energy where the error of the part of pressures is known with its sign: what is not known, factors of n^-2 of that
   !> part and of n^-order of that of tractions, and part of the error of that by the levels; error in general over n^-2 of the
   !> part of pressures; of random contacts of tests/accuracy
   real(wp), parameter :: unknown_energy(2) = [0.02_wp, 0.1_wp], unknown_share = 0.3_wp, usual_energy = 0.055_wp
   !> What levels tell of the power of the motion: part that has their sign, and part that has not; of random contacts of
   !> tests/accuracy (seeds 1001 and 1002)
   real(wp), parameter :: signed = 0.5_wp, unsigned = 0.8_wp
   !> Forces by the second order where friction falls with slip: factor of its relative deviations times n^-2 (seeds 1001 and 1002);
   !> where slip turns, of its turn across the contact times n^-2 (seed 2001)
   real(wp), parameter :: falling_floor = 6.0_wp, turning_floor = 0.15_wp
   !> What differences of levels tell above the errors in general counts with this power: two samples of an error that jumps with
   !> the offset of the grid, against the usual one of so many elements. Of forces and power by the second order, and of the peak,
   !> of like and of unlike bodies
   real(wp), parameter :: trust(2) = [0.7_wp, 0.8_wp], peak_trust(2) = [0.65_wp, 0.75_wp]
   !> Elements across on which the coarse level of a third of them sees what a peak is like; with fewer its difference is larger
   !> than its order says, and counts with a smaller power; of viscoelastic bodies and bumpy profiles (seeds 55 and 5301)
   real(wp), parameter :: clear_peak = 20.0_wp
   !> Parts of the elastic energy have errors of opposite signs more often than not: median of their sum over the root of squares
   real(wp), parameter :: opposite = 0.45_wp
   !> Part of a residual that shows in forces; measured between tolerances of 1e-2 and 1e-4
   real(wp), parameter :: residual_share = 0.3_wp

contains

   !> What the error of a total is relative to, in its unit
   pure real(wp) function scale_of(row, scale) result(unit)
      !> Of the finer level, with value and law
      type(total), intent(in) :: row
      !> See scales
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
      !> The total of the finer level
      type(total), intent(in) :: row
      !> Between the levels
      real(wp), intent(in) :: difference
      !> See scales
      type(scale_type), intent(in) :: scale
      !> Its relative parts
      type(error_estimate), intent(in) :: errors
      real(wp) :: floor, part, stopping, unit

      stopping = maxval(errors%stopping)
      unit = scale_of(row, scale)
      select case (row%law)
      case (error_law%normal)
         e = difference/(coarsening**normal_order - 1.0_wp)
         floor = normal_floor/scale%across**2 + scale%roughness
         stopping = errors%stopping(1)
      case (error_law%friction, error_law%creepage)
         part = part_of(scale, scale%order)
         if (is_unseen(scale)) part = 0.0_wp
         e = part*difference
         if (is_long_step(scale)) e = force_error(difference/max(unit, tiny(unit)), scale%adhesion, scale%mean_across)*unit
         e = e + by_heat(scale, part, difference, unit)
         if (row%law == error_law%friction) e = max(e, other_component*part*scale%friction*unit)
         floor = driven_floor(scale) + turning_floor*scale%turning/scale%mean_across**2
         if (scale%is_moment_alone .and. row%law == error_law%friction) floor = moment_alone*floor
         if (scale%jumps) e = unit*trusted(e/max(unit, tiny(unit)), floor, trust_in(scale))
         if (row%law == error_law%friction) floor = max(floor, scale%reversal &
            & *merge(reversal_share, reversal_in_shifts, scale%order < normal_order .or. scale%coupling > 0.0_wp))
      case (error_law%power)
         e = error_of_power(scale, difference, unit)
         floor = 0.0_wp
      case (error_law%energy)
         e = error_of_energy(scale) + (stopping + errors%window)*unit
         return
      case (error_law%peak)
         e = difference/(coarsening**scale%heat_order - 1.0_wp)
         floor = 0.0_wp
      case default
         e = difference/(coarsening**jump_order - 1.0_wp)
         floor = area_floor/scale%across
      end select
      if (scale%across < resolved) floor = max(floor, unresolved_floor/scale%across**2)
      e = max(e, floor*unit) + (stopping + errors%window)*unit
   end function error_of

   !> Part of the difference of the levels that is the error of the finer one, where there is an order
   pure real(wp) function part_of(scale, order) result(part)
      type(scale_type), intent(in) :: scale
      !> Of the error
      real(wp), intent(in) :: order

      part = 1.0_wp
      if (scale%clean) part = 1.0_wp/(coarsening**order - 1.0_wp)
   end function part_of

   !> Error beyond that part of the difference of the levels, where friction follows temperatures whose errors have another order
   pure real(wp) function by_heat(scale, part, difference, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> That counts already
      real(wp), intent(in) :: part
      !> Between the levels, and what it is relative to
      real(wp), intent(in) :: difference, unit

      e = max(0.0_wp, 1.0_wp/(coarsening**scale%heat_order - 1.0_wp) - part)*min(difference, scale%warmed*unit)
   end function by_heat

   !> Relative error of tangential forces of so many elements in general
   pure real(wp) function friction_floor(scale) result(floor)
      type(scale_type), intent(in) :: scale

      if (scale%order <= first_order) then
         floor = merge(rolling_floor(1), layer_floor, scale%clean .or. scale%steps)/scale%mean_across
      else
         floor = merge(rolling_floor(2), shift_floor, scale%order < normal_order)/scale%mean_across**2
      end if
      floor = sqrt(scale%adhesion)*max(floor, unrelaxed(scale))
      if (scale%order > first_order) floor = floor + falling_floor*scale%falling/scale%mean_across**2
      if (is_unseen(scale)) floor = floor*scale%irregular
   end function friction_floor

   !> Its part of first order by elements that do not resolve the relaxation of the bodies, over the root of the part that sticks
   pure real(wp) function unrelaxed(scale) result(floor)
      type(scale_type), intent(in) :: scale

      floor = merge(relaxing_floor(2), relaxing_floor(1), scale%order > first_order)*scale%relaxation/scale%mean_across
   end function unrelaxed

   !> The same with what pressures of unlike bodies bring in, of first order by both schemes
   pure real(wp) function driven_floor(scale) result(floor)
      type(scale_type), intent(in) :: scale

      floor = friction_floor(scale)
      if (scale%order < normal_order) floor = max(floor, coupled_friction_floor*scale%coupling*scale%driven/scale%across, &
         & hidden_slip*scale%driven**3*sqrt(scale%sticking)/scale%mean_across)
   end function driven_floor

   !> Is it a step of transient rolling that the second order is not made for?
   pure logical function is_long_step(scale)
      type(scale_type), intent(in) :: scale

      is_long_step = scale%steps .and. scale%order <= first_order
   end function is_long_step

   !> Relative error of tangential tractions, where levels tell little of it at a single point: in transient rolling, and where
   !> friction follows temperatures; zero otherwise
   pure real(wp) function traction_error(scale) result(e)
      !> See scales, with differences of the levels
      type(scale_type), intent(in) :: scale

      e = scale%warmed/(coarsening**scale%heat_order - 1.0_wp)
      if (is_unseen(scale)) e = e + driven_floor(scale)
      if (is_long_step(scale)) e = e + force_error(scale%friction, scale%adhesion, scale%mean_across)
   end function traction_error

   !> Do the levels tell nothing about tractions? Steps of one element are no steps of one element on a coarser level
   pure logical function is_unseen(scale)
      type(scale_type), intent(in) :: scale

      is_unseen = scale%steps .and. scale%order > first_order
   end function is_unseen

   !> How much larger the error of the normal problem is than that of so many elements in general, at least 1
   pure real(wp) function irregularity(row, difference, scale) result(ratio)
      !> Normal force or approach of the finer level
      type(total), intent(in) :: row
      !> Between the levels
      real(wp), intent(in) :: difference
      !> See scales
      type(scale_type), intent(in) :: scale

      ratio = max(1.0_wp, difference/(coarsening**normal_order - 1.0_wp)*scale%across**2 &
         & /(normal_floor*max(abs(row%value), tiny(ratio))))
   end function irregularity

   !> Power with which differences of levels count in forces and power, see trusted
   pure real(wp) function trust_in(scale) result(power)
      type(scale_type), intent(in) :: scale

      power = merge(trust(2), trust(1), scale%coupling > 0.0_wp)
   end function trust_in

   !> What differences of levels tell, and the error of so many elements in general, together
   pure real(wp) function trusted(told, floor, power) result(e)
      !> By the levels, and in general
      real(wp), intent(in) :: told, floor
      !> Of what is told above the general error
      real(wp), intent(in) :: power

      e = told
      if (told > floor .and. floor > 0.0_wp) e = floor*(told/floor)**power
   end function trusted

   !> Error of frictional power or work without that of solvers and window, in its unit
   pure real(wp) function error_of_power(scale, difference, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Between the levels, and power itself, positive
      real(wp), intent(in) :: difference, unit
      real(wp) :: floor, full_power, heat

      full_power = max(scale%power, unit, tiny(unit))
      heat = by_heat(scale, part_of(scale, scale%order), difference, unit)
      if (is_long_step(scale)) then
         e = heat + power_error(unit/full_power, difference/full_power, scale%friction, scale%adhesion, scale%mean_across, &
            & scale%step)*full_power
         return
      end if
      if (scale%balances .and. .not. (scale%coupling > 0.0_wp .and. scale%jumps)) then
         e = heat + error_by_balance(scale, unit)
         return
      end if
      e = difference
      ! the power of the motion and what remains may change by as much with opposite signs
      if (scale%has_motion_power .and. .not. scale%balances) &
         & e = hypot(scale%motion_change, scale%surplus - scale%coarse_surplus)
      e = part_of(scale, merge(power_order, scale%order, scale%order <= first_order))*e
      if (is_unseen(scale)) e = 0.0_wp
      floor = power_floor*sqrt(scale%adhesion)/scale%across**nint(scale%order)
      if (scale%order < normal_order .and. (scale%clean .or. .not. scale%steps)) floor = floor + scale%adhesion* &
         & merge(adhesive_power_floor/scale%across**2, layer_power_floor/scale%across, scale%clean)
      floor = max(floor, sqrt(scale%adhesion)*unrelaxed(scale))*full_power
      e = e + heat
      if (scale%jumps) e = trusted(e, floor, trust_in(scale))
      e = max(e, floor)
      ! of unlike bodies the balance tells errors of pressures, too, that hardly show in power by the second order
      if (scale%balances) e = sqrt(e*(heat + error_by_balance(scale, unit)))
   end function error_of_power

   !> Error of frictional power in steady rolling [W]: what friction does not take of the power of the motion, with its sign, and
   !> the error of that power
   pure real(wp) function error_by_balance(scale, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Frictional power, positive [W]
      real(wp), intent(in) :: unit
      real(wp) :: floor, told

      floor = friction_floor(scale)*max(scale%power, unit)
      told = part_of(scale, scale%order)*abs(scale%motion_change)
      if (scale%jumps) told = trusted(told, floor, trust_in(scale))
      e = hypot(scale%surplus - sign(signed*told, scale%motion_change), max(floor, unsigned*told))
      ! a surplus that jumps with the offset of the grid may be small by accident: that of the coarser level is another sample of it
      if (scale%jumps) e = max(e, part_of(scale, scale%order)*abs(scale%coarse_surplus))
   end function error_by_balance

   !> Error of the elastic energy without that of solvers and window [J]: those of its parts, whose signs differ from case to case
   pure real(wp) function error_of_energy(scale) result(e)
      type(scale_type), intent(in) :: scale
      real(wp) :: parts(2), floor(2), more

      parts = -[scale%energy_change(1)/(coarsening**normal_order - 1.0_wp), part_of(scale, scale%order)*scale%energy_change(2)]
      if (is_unseen(scale)) parts(2) = 0.0_wp
      floor = abs(scale%energy)*[scale%across**(-2), sqrt(scale%adhesion)*scale%across**(-scale%order)]
      more = 0.0_wp
      if (scale%order < normal_order .and. .not. (scale%clean .or. scale%steps)) &
         & more = layer_power_floor*scale%adhesion*abs(scale%energy(2))/scale%across
      if (scale%used > 0.0_wp) more = more + energy_of_forces*traction_error(scale)/scale%used*abs(scale%energy(2))
      if (scale%has_normal_energy .and. scale%across >= resolved) then
         ! the error changes its sign with the offset of the grid: not less than half of its root of the mean square
         e = max(usual_energy*floor(1), hypot(scale%normal_energy + parts(2), &
            & dot_product(unknown_energy, floor) + unknown_share*abs(parts(2)) + more))
         return
      end if
      e = hypot(parts(1), parts(2))
      if (scale%clean .and. abs(parts(2)) > 0.0_wp) e = max(opposite*e, abs(abs(parts(1)) - abs(parts(2))))
      e = max(e, dot_product(energy_floor, [scale%irregular, 1.0_wp]*floor) + more)
   end function error_of_energy

   !> Error of the largest pressure: pressures have an error, and order 1 takes it at a centre of an element, below the peak
   pure real(wp) function error_of_peak(result, scale, coarse_peak) result(e)
      !> Solved, with the parts of the error
      type(patch_result), intent(in) :: result
      !> See scales
      type(scale_type), intent(in) :: scale
      !> Peak of the pressures of the coarse level [N/mm2]
      real(wp), intent(in) :: coarse_peak
      real(wp) :: peak, floor

      peak = peak_of(result%pn)
      floor = peak_floor/scale%across**2
      e = abs(peak - result%pmax + (peak - coarse_peak)/(coarsening**normal_order - 1.0_wp))/result%pmax
      e = trusted(e, floor, merge(peak_trust(2), peak_trust(1), scale%coupling > 0.0_wp) &
         & *min(1.0_wp, scale%across/clear_peak)**3)
      floor = max(floor, coupled_floor*scale%coupling/scale%across**2)
      if (scale%across < resolved) floor = floor + unresolved_floor/scale%across**2
      e = max(e, floor, unresolved*(largest_bend(result%pn)/result%pmax - smooth_bend/scale%across**2))
      e = (e + result%errors%stopping(1) + result%errors%window)*result%pmax
   end function error_of_peak

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
end module contact_patch_level_errors
