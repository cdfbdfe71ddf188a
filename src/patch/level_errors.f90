!> Errors of totals, estimated from the differences between a solution and that with elements three times as long
!>
!> For the orders, and the lower bounds of errors, see doc/theory/errors.md.
module contact_patch_level_errors
   use contact_base_kinds, only : wp
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_scales, only : first_order, normal_order, scale_type
   use contact_patch_peak, only : peak_of
   use contact_patch_quantities, only : error_law, error_scale, total
   use contact_patch_result, only : error_estimate, patch_result
   use contact_patch_step_errors, only : energy_of_forces, force_error, power_error
   implicit none (type, external)
   private

   public :: coupled_friction_floor, error_of, error_of_peak, irregularity, scale_of, share_of_residual, traction_error, trusted

   !> Order of totals that change by steps of single elements
   real(wp), parameter :: jump_order = 1.0_wp
   !> Order of frictional power with the first-order scheme: its error decreases to 1/(1 + 1.65) with elements of a third; median of
   !> tests/accuracy
   real(wp), parameter :: power_order = 0.89_wp
   !> Contact of fewer elements across is not resolved, and is not coarsened in that direction: relative error of any total, times
   !> n^-2, of the hard cases of tests/stability; the same of normal force and approach, of second patches of wheels with 3 to 5
   !> elements across (seed 31101). That of forces times the root of the fraction in adhesion, which is taken as at least the last
   real(wp), parameter :: resolved = 6.0_wp, unresolved_floor = 0.5_wp, unresolved_normal = 0.2_wp, unresolved_adhesion = 0.1_wp
   !> Rough surfaces, whose heights between element centres no level contains: factors of the standard deviation of heights over the
   !> approach, in normal force and approach, and in forces; of rough profiles of tests/stability/hard_wheels.py, seeds 1 to 3
   real(wp), parameter :: rough_floor(2) = [0.3_wp, 0.06_wp]
   !> Tractions of unlike bodies increase pressures within regions that elements do not resolve: factor of the difference parameter
   !> K times n^-2 in the largest pressure; of the hard cases
   real(wp), parameter :: coupled_floor = 4.0_wp
   !> Pressures of unlike bodies cause tractions at the leading edge: factor of K k n^-1 in forces with the second-order scheme,
   !> with k = K over the coefficient of friction, at most 1, see doc/theory/second_order.md
   real(wp), parameter :: coupled_friction_floor = 0.15_wp
   !> If these tractions reach the bound next to adhesion, the slip zone at the leading edge is narrower than an element: factor of
   !> k^3 times the root of the fraction in adhesion, times n^-1; of unlike bodies with seed 8101
   real(wp), parameter :: hidden_slip = 0.5_wp
   !> The relative second difference of a smooth peak over an element is 4 n^-2 for n elements across. The excess above this
   !> multiple of n^-2 belongs to a peak that is not resolved, whose error is this fraction of the excess; chosen with the hard
   !> cases of tests/stability
   real(wp), parameter :: smooth_bend = 12.0_wp, unresolved = 0.15_wp
   !> Minimum error of tangential forces and moment, as a fraction of the largest of their errors
   real(wp), parameter :: other_component = 0.2_wp
   !> Where slip reverses its direction without adhesion in between, the position is not resolved: error of forces as a fraction of
   !> the force of an element there. Root mean square over positions of the grid, two rollers of aluminium and steel; by the second
   !> order in rolling of like bodies with spin (seeds 31001 and 31002); in shifts of like bodies, where single elements at the
   !> edge of the region that slips back cause it (kind shifts, seed 7101)
   real(wp), parameter :: reversal_share = 0.7_wp, reversal_by_spin = 0.3_wp, reversal_in_shifts = 0.18_wp
   !> Errors in general, of n elements across: factor of n^-order, by order; of random contacts of tests/accuracy, those of shifts
   !> with seed 5301, those of the second order in rolling with seeds 11611 and 11612. Forces of steady rolling; of shifts;
   !> power of steady rolling by the second order
   real(wp), parameter :: rolling_floor(2) = [0.05_wp, 0.12_wp], shift_floor = 0.12_wp, balance_floor = 0.24_wp
   !> Order of forces in rolling by the second order, with jitter (same seeds); power and energy have that of the scales
   real(wp), parameter :: force_order = 1.8_wp
   !> Lower bound of the part that sticks for moments by the second order: errors of pressures remain in full sliding (same seeds)
   real(wp), parameter :: least_adhesion = 0.25_wp
   !> Creepages that are found for prescribed forces: factor of the root of the fraction in adhesion times n^-2 in addition to that
   !> of forces, since a small change of a force near zero or near the bound needs a larger one of the creepage (seeds 31001, 31002
   !> and 31004)
   real(wp), parameter :: creepage_floor = 0.3_wp
   !> The same of a single layer in rolling, whose slip has a length of its own: factor of n^-1 (seed 4001)
   real(wp), parameter :: layer_floor = 0.3_wp
   !> Elements that do not resolve the relaxation of viscoelastic bodies: factor of n^-1, by order (seeds 8101 and 8103; 31003)
   real(wp), parameter :: relaxing_floor(2) = [0.05_wp, 0.07_wp]
   !> Part of these that moments have where both forces are prescribed; of random contacts (seed 3101)
   real(wp), parameter :: moment_alone = 0.5_wp
   !> Power: factor of n^-order of the power of full sliding; factor of n^-2 and adhesion in steady rolling; with a layer, factor of
   !> n^-1, in that case also of the energy of tractions
   real(wp), parameter :: power_floor = 0.1_wp, adhesive_power_floor = 2.5_wp, layer_power_floor = 1.0_wp
   !> Normal force; largest pressure, half the rms over offsets of a Hertzian peak; area; energies of pressures and of tractions
   real(wp), parameter :: normal_floor = 0.15_wp, peak_floor = 0.15_wp, area_floor = 0.2_wp, energy_floor(2) = [0.07_wp, 0.2_wp]
   !> Elastic energy if the error of the part due to pressures is known with its sign. Unknown error: factors of n^-2 of that part
   !> and of n^-order of the part due to tractions, and fraction of the error of the latter by the levels. General error over n^-2
   !> of the part due to pressures. Of random contacts of tests/accuracy
   real(wp), parameter :: unknown_energy(2) = [0.02_wp, 0.1_wp], unknown_share = 0.3_wp, usual_energy = 0.055_wp
   !> Change of the power of the motion between the levels: fraction that has the sign of the error, and fraction of unknown sign;
   !> of random contacts of tests/accuracy (seeds 1001 and 1002)
   real(wp), parameter :: signed = 0.5_wp, unsigned = 0.8_wp
   !> Forces with the second-order scheme if friction decreases with slip: factor of its relative deviations times n^-2; if the
   !> direction of slip turns: of its turn across the contact times n^-2 (seeds 31001 and 31002)
   real(wp), parameter :: falling_floor = 5.0_wp, turning_floor = 0.1_wp
   !> Exponent of the ratio of an error by the levels to the general error, if larger than 1: of an error that jumps with the offset
   !> of the grid the levels are two samples, and the general error is that usual for this number of elements. For forces and power
   !> with the second-order scheme, and for the peak, of like and of unlike bodies
   real(wp), parameter :: trust(2) = [0.7_wp, 0.8_wp], peak_trust(2) = [0.65_wp, 0.75_wp]
   !> Number of elements across for which the coarse level, with a third of them, resolves the shape of a peak; with fewer, its
   !> difference is larger than its order predicts, and the exponent is smaller; of viscoelastic bodies and bumpy profiles (seeds 55
   !> and 5301)
   real(wp), parameter :: clear_peak = 20.0_wp
   !> The parts of the elastic energy usually have errors of opposite signs: median of their sum over the root of squares
   real(wp), parameter :: opposite = 0.45_wp
   !> Ratio of the error of the forces to the residual, measured between tolerances of 1e-2 and 1e-4; with an interfacial layer, in
   !> which errors of the slip add up along the contact, about the median of 40 values from 0.13 to 20 (seed 26112 of asked.py)
   real(wp), parameter :: residual_share = 0.3_wp, layer_residual_share = 3.0_wp
   !> Line contact in rolling: factor of n^-2, by order. Near full sliding both levels may lose the same elements in adhesion; of
   !> Carter's solution at 20 to 99.5 % of the friction bound, 17 to 101 elements
   real(wp), parameter :: line_floor(2) = [1.5_wp, 0.25_wp]

contains

   !> Ratio of the error of the tangential forces to the residual of their solver
   pure real(wp) function share_of_residual(has_layer) result(share)
      !> Is there an interfacial layer?
      logical, intent(in) :: has_layer

      share = merge(layer_residual_share, residual_share, has_layer)
   end function share_of_residual

   !> Reference value of the relative error of a total, in its unit
   pure real(wp) function scale_of(row, scale) result(unit)
      !> Total of the finer level, with value and law
      type(total), intent(in) :: row
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      unit = abs(row%value)
      if (row%law == error_law%creepage) unit = scale%creep
      select case (row%scale)
      case (error_scale%force)
         unit = scale%force
      case (error_scale%moment)
         unit = scale%moment
      case (error_scale%ratio)
         unit = 1.0_wp
      end select
   end function scale_of

   !> Error of one total in its unit
   pure real(wp) function error_of(row, difference, scale, errors) result(e)
      !> Total of the finer level
      type(total), intent(in) :: row
      !> Difference between the levels
      real(wp), intent(in) :: difference
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Relative contributions to the error: solvers and window
      type(error_estimate), intent(in) :: errors
      real(wp) :: floor, part, stopping, unit

      stopping = maxval(errors%stopping)
      unit = scale_of(row, scale)
      select case (row%law)
      case (error_law%normal)
         e = difference/(coarsening**normal_order - 1.0_wp)
         floor = normal_floor/scale%across**2 + rough_floor(1)*scale%roughness
         stopping = errors%stopping(1)
      case (error_law%friction, error_law%creepage)
         part = part_of(scale, merge(force_order, scale%order, scale%order > first_order .and. scale%order < normal_order))
         if (is_unseen(scale)) part = 0.0_wp
         e = part*difference
         if (is_long_step(scale)) e = force_error(difference/max(unit, tiny(unit)), scale%adhesion, scale%mean_across)*unit
         e = e + by_heat(scale, part, difference, unit)
         if (row%law == error_law%friction) e = max(e, other_component*part*scale%friction*unit)
         floor = scale%adhesion
         if (row%scale == error_scale%moment .and. scale%order > first_order) floor = max(least_adhesion, floor)
         floor = driven_floor(scale, floor) + turning_floor*scale%turning/scale%mean_across**2
         if (scale%is_moment_alone .and. row%law == error_law%friction) floor = moment_alone*floor
         if (row%law == error_law%creepage .and. scale%jumps) floor = floor &
            & + creepage_floor*sqrt(scale%adhesion)/scale%mean_across**2
         if (scale%jumps) e = unit*trusted(e/max(unit, tiny(unit)), floor, trust_in(scale))
         if (row%law == error_law%friction) floor = max(floor, scale%reversal*share_of_reversal(scale))
         floor = max(floor, rough_floor(2)*scale%roughness)
         if (scale%is_line .and. scale%order < normal_order) floor = max(floor, &
            & merge(line_floor(2), line_floor(1), scale%order > first_order)/scale%across**2)
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
      if (scale%across < resolved) floor = max(floor, floor_of_few(row%law, scale))
      e = max(e, floor*unit) + (stopping + errors%window)*unit
   end function error_of

   !> Relative error of a total if contact is few elements wide
   pure real(wp) function floor_of_few(law, scale) result(floor)
      !> Member of error_law
      integer, intent(in) :: law
      type(scale_type), intent(in) :: scale

      floor = unresolved_floor
      if (law == error_law%normal) floor = unresolved_normal
      if (law == error_law%friction) floor = floor*sqrt(max(unresolved_adhesion, scale%sticking))
      floor = floor/scale%across**2
   end function floor_of_few

   !> Error of forces as a fraction of the force of an element at which slip reverses
   pure real(wp) function share_of_reversal(scale) result(share)
      type(scale_type), intent(in) :: scale

      share = reversal_share
      if (scale%coupling > 0.0_wp .or. scale%order <= first_order) return
      share = merge(reversal_by_spin, reversal_in_shifts, scale%order < normal_order)
   end function share_of_reversal

   !> Ratio of the error of the finer level to the difference of the levels; 1 if errors have no clean order
   pure real(wp) function part_of(scale, order) result(part)
      type(scale_type), intent(in) :: scale
      !> Order of the error
      real(wp), intent(in) :: order

      part = 1.0_wp
      if (scale%clean) part = 1.0_wp/(coarsening**order - 1.0_wp)
   end function part_of

   !> Additional error if friction follows temperatures, whose errors have another order
   pure real(wp) function by_heat(scale, part, difference, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Ratio that is included already
      real(wp), intent(in) :: part
      !> Difference between the levels, and reference value of the relative error
      real(wp), intent(in) :: difference, unit

      e = max(0.0_wp, 1.0_wp/(coarsening**scale%heat_order - 1.0_wp) - part)*min(difference, scale%warmed*unit)
   end function by_heat

   !> Typical relative error of tangential forces with this number of elements
   pure real(wp) function friction_floor(scale, adhesion, in_power) result(floor)
      type(scale_type), intent(in) :: scale
      !> Fraction of the elements that sticks, with a lower bound [-]
      real(wp), intent(in) :: adhesion
      !> Is it that of the forces as it appears in frictional power?
      logical, intent(in) :: in_power

      if (scale%order <= first_order) then
         floor = merge(rolling_floor(1), layer_floor, scale%clean .or. scale%steps)/scale%mean_across
      else
         floor = merge(rolling_floor(2), shift_floor, scale%order < normal_order)
         if (in_power) floor = balance_floor
         floor = floor/scale%mean_across**2
      end if
      floor = max(sqrt(adhesion)*floor, sqrt(scale%adhesion)*unrelaxed(scale))
      if (scale%order > first_order) floor = floor + falling_floor*scale%falling/scale%mean_across**2
      if (is_unseen(scale)) floor = floor*scale%irregular
   end function friction_floor

   !> First-order contribution of elements that do not resolve the relaxation of the bodies, over the root of the fraction in
   !> adhesion
   pure real(wp) function unrelaxed(scale) result(floor)
      type(scale_type), intent(in) :: scale

      floor = merge(relaxing_floor(2), relaxing_floor(1), scale%order > first_order)*scale%relaxation/scale%mean_across
   end function unrelaxed

   !> The same with what pressures of unlike bodies bring in, of first order by both schemes
   pure real(wp) function driven_floor(scale, adhesion) result(floor)
      type(scale_type), intent(in) :: scale
      !> Fraction of the elements that sticks, with a lower bound [-]
      real(wp), intent(in) :: adhesion

      floor = friction_floor(scale, adhesion, .false.)
      if (scale%order < normal_order) floor = max(floor, coupled_friction_floor*scale%coupling*scale%driven/scale%across, &
         & hidden_slip*scale%driven**3*sqrt(scale%sticking)/scale%mean_across)
   end function driven_floor

   !> Is it a step of transient rolling for which the second-order scheme is not suited?
   pure logical function is_long_step(scale)
      type(scale_type), intent(in) :: scale

      is_long_step = scale%steps .and. scale%order <= first_order
   end function is_long_step

   !> Relative error of tangential tractions in cases in which levels show little of it at a single point: in transient rolling, and
   !> if friction follows temperatures; zero otherwise
   pure real(wp) function traction_error(scale) result(e)
      !> See type scale_type; with differences of the levels
      type(scale_type), intent(in) :: scale

      e = scale%warmed/(coarsening**scale%heat_order - 1.0_wp)
      if (is_unseen(scale)) e = e + driven_floor(scale, scale%adhesion)
      if (is_long_step(scale)) e = e + force_error(scale%friction, scale%adhesion, scale%mean_across)
   end function traction_error

   !> Are tractions of both levels not comparable? Steps of one element are not steps of one element on a coarser level
   pure logical function is_unseen(scale)
      type(scale_type), intent(in) :: scale

      is_unseen = scale%steps .and. scale%order > first_order
   end function is_unseen

   !> Ratio of the error of the normal problem to the general error for this number of elements, at least 1
   pure real(wp) function irregularity(row, difference, scale) result(ratio)
      !> Normal force or approach of the finer level
      type(total), intent(in) :: row
      !> Difference between the levels
      real(wp), intent(in) :: difference
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      ratio = max(1.0_wp, difference/(coarsening**normal_order - 1.0_wp)*scale%across**2 &
         & /(normal_floor*max(abs(row%value), tiny(ratio))))
   end function irregularity

   !> Exponent for the differences of levels of forces and power, see trusted
   pure real(wp) function trust_in(scale) result(power)
      type(scale_type), intent(in) :: scale

      power = merge(trust(2), trust(1), scale%coupling > 0.0_wp)
   end function trust_in

   !> Error from the differences of levels and the general error
   pure real(wp) function trusted(by_levels, floor, power) result(e)
      !> Error by the levels, and general error
      real(wp), intent(in) :: by_levels, floor
      !> Exponent of the ratio of both, if larger than 1
      real(wp), intent(in) :: power

      e = by_levels
      if (by_levels > floor .and. floor > 0.0_wp) e = floor*(by_levels/floor)**power
   end function trusted

   !> Error of frictional power or work without contributions of solvers and window, in its unit
   pure real(wp) function error_of_power(scale, difference, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Difference between the levels, and the power itself, positive
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
      ! the power of the motion and the residual power may change by equal amounts of opposite signs
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
      ! for unlike bodies the balance includes errors of pressures that hardly affect power with the second-order scheme
      if (scale%balances) e = sqrt(e*(heat + error_by_balance(scale, unit)))
   end function error_of_power

   !> Error of frictional power in steady rolling [W]: the difference of the power of the motion and frictional power, with its
   !> sign, and the error of the power of the motion
   pure real(wp) function error_by_balance(scale, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Frictional power, positive [W]
      real(wp), intent(in) :: unit
      real(wp) :: floor, by_levels

      floor = friction_floor(scale, scale%adhesion, .true.)*max(scale%power, unit)
      by_levels = part_of(scale, scale%order)*abs(scale%motion_change)
      if (scale%jumps) by_levels = trusted(by_levels, floor, trust_in(scale))
      e = hypot(scale%surplus - sign(signed*by_levels, scale%motion_change), max(floor, unsigned*by_levels))
      ! a surplus that jumps with the offset of the grid may be small by chance: that of the coarser level is another sample of it
      if (scale%jumps) e = max(e, part_of(scale, scale%order)*abs(scale%coarse_surplus))
   end function error_by_balance

   !> Error of the elastic energy without contributions of solvers and window [J]: errors of its parts, whose signs vary between
   !> cases
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
         ! the error changes its sign with the offset of the grid: at least half of its root mean square
         e = max(usual_energy*floor(1), hypot(scale%normal_energy + parts(2), &
            & dot_product(unknown_energy, floor) + unknown_share*abs(parts(2)) + more))
         return
      end if
      e = hypot(parts(1), parts(2))
      if (scale%clean .and. abs(parts(2)) > 0.0_wp) e = max(opposite*e, abs(abs(parts(1)) - abs(parts(2))))
      e = max(e, dot_product(energy_floor, [scale%irregular, 1.0_wp]*floor) + more)
   end function error_of_energy

   !> Error of the largest pressure: the error of pressures, and with order 1 the difference between the peak and the nearest
   !> element centre
   pure real(wp) function error_of_peak(result, scale, coarse_peak) result(e)
      !> Solved patch, with the contributions of solvers and window
      type(patch_result), intent(in) :: result
      !> See type scale_type
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

   !> Second difference at the largest value: twice its excess over the mean of its neighbours, in the direction in which it is
   !> larger
   pure real(wp) function largest_bend(field) result(bend)
      !> Shape (mx, my); zero before the first and after the last value
      real(wp), intent(in) :: field(:, :)
      integer :: at(2)

      at = maxloc(field)
      bend = 0.0_wp
      if (size(field, 1) >= 3) bend = 2.0_wp*field(at(1), at(2)) - beside_of(field(:, at(2)), at(1))
      if (size(field, 2) >= 3) bend = max(bend, 2.0_wp*field(at(1), at(2)) - beside_of(field(at(1), :), at(2)))
   end function largest_bend

   !> Sum of the values on both sides of index i
   pure real(wp) function beside_of(line, i) result(sum_beside)
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i

      sum_beside = 0.0_wp
      if (i > 1) sum_beside = line(i - 1)
      if (i < size(line)) sum_beside = sum_beside + line(i + 1)
   end function beside_of
end module contact_patch_level_errors
