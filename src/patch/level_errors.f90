!> Errors of totals, estimated from the differences between a solution and that with elements three times as long
!>
!> For the orders, and the lower bounds of errors, see doc/theory/errors.md.
module contact_patch_level_errors
   use contact_base_kinds, only : wp
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_kinds, only : is_first, is_long_step, is_turning, is_unseen, order_of, part_of, sliding_part, trust_in, &
      & trusted
   use contact_patch_error_scales, only : first_order, normal_order, resolved, scale_type, unseen
   use contact_patch_quantities, only : error_law, error_scale, total
   use contact_patch_result, only : error_estimate
   use contact_patch_step_errors, only : energy_of_forces, energy_of_steps, power_error
   use contact_patch_traction_errors, only : bound_friction, by_heat, centred, friction_floor, rough_floor, traction_error, &
      & unrelaxed
   implicit none (type, external)
   private

   public :: error_of, irregularity, scale_of, share_of_residual

   !> Order of totals that change by steps of single elements
   real(wp), parameter :: jump_order = 1.0_wp
   !> Order of frictional power with the first-order scheme: its error decreases to 1/(1 + 1.65) with elements of a third; median of
   !> tests/accuracy
   real(wp), parameter :: power_order = 0.89_wp
   !> Creepages that are found for prescribed forces, of fewer elements across than `resolved`: factor of n^-2 of the larger one; of
   !> the hard cases of tests/stability
   real(wp), parameter :: few_creepage = 0.5_wp
   !> Power: factor of n^-order of the power of full sliding; factor of n^-2 and adhesion in steady rolling; with a layer, factor of
   !> n^-1. Energy of tractions with a layer: factor of the root of the fraction in adhesion times n^-1; half of the usual error
   !> from 2 to 95 % in adhesion (seeds 99711 and 99713)
   real(wp), parameter :: power_floor = 0.1_wp, adhesive_power_floor = 2.5_wp, layer_power_floor = 1.0_wp, &
      & layer_energy_floor = 0.8_wp
   !> Work of friction in shifts: usual error over n^-2 of the work of full sliding, if slip has the same direction everywhere, if
   !> it does not, and where little slips, so that single elements count; part of the bound that cancels from which on the second
   !> holds; fractions in adhesion between which the last one becomes valid; exponent of the ratio of the error by the levels to
   !> it, see trusted; ratio of the error of the normal problem to its lower bound up to which that is usual. Of random contacts
   !> (kinds shift and shifts, seeds 61001, 61002 and 97001; the first of seeds 77101 and 99822)
   real(wp), parameter :: work_floor(3) = [0.04_wp, 0.105_wp, 0.1_wp], turned_work = 0.3_wp, little_slip(2) = [0.75_wp, 0.85_wp], &
      & work_trust = 0.25_wp, usual_irregularity = 2.0_wp
   !> Full sliding in a shift: largest part of the bound that cancels if slip has the same direction everywhere; chosen
   real(wp), parameter :: one_direction = 0.1_wp
   !> Highest temperature: factors of n^-1 and n^-2 of its rise above that of the body, by order; factor of n^-2 for each radian by
   !> which the slip direction turns, by the second order; of random contacts (seeds 71002 and 81002). n is that of the slip area,
   !> in full sliding by the first order along the rolling direction: the usual error by the second order is 2 n^-2 of the rise
   !> (seeds 71 and 73). Smallest part that slips, by order, chosen: with 0.1 a wheel of which 3 of 207 elements slip
   !> (86 of 95001, first order) had 0.09 of its error
   real(wp), parameter :: temperature_floor(2) = [0.4_wp, 0.7_wp], turning_temperature_floor = 0.15_wp, &
      & least_slip(2) = [0.02_wp, 0.05_wp]
   !> The same by the pressures: the heat of a row of elements is in proportion to them. Fraction of the relative error of the
   !> largest pressure; of wheels (seeds 51601 and 51611)
   real(wp), parameter :: heat_of_peak = 0.7_wp
   !> Power of the motion with spin, by the second order: factor of the turn of the slip direction times n^-2 (seed 71002)
   real(wp), parameter :: turning_power_floor = 0.03_wp
   !> Frictional power by the second order: the surplus of a single grid is small by chance at some offsets. Factor of n^-2, and
   !> exponent of the fraction in adhesion: half of the rms over offsets from 1 to 95 % in adhesion (seed 99712)
   real(wp), parameter :: sticking_power(2) = [3.0_wp, 1.2_wp]
   !> Frictional power in full sliding, by the second order: factor of n^-2, and of the turn of the slip direction times n^-2, half
   !> of the usual error (seed 99712)
   real(wp), parameter :: sliding_power_floor = 0.01_wp, sliding_power_turn = 0.02_wp
   !> Frictional power of viscoelastic bodies by the second order: usual error over n^-2 in full sliding, its increase for each
   !> radian by which the slip direction turns, factor and exponent of the fraction in adhesion; number of elements per row in slip
   !> below which the latter increases with its square; lower bound of the ratio of the error by the levels to it, and its exponent,
   !> as both are hardly correlated. Of 105 contacts (kind viscoelastic, seed 77201, and seed 99822)
   real(wp), parameter :: relaxing_power(4) = [0.06_wp, 0.035_wp, 2.3_wp, 1.2_wp], narrow_slip = 2.2_wp, relaxing_ratio = 0.5_wp, &
      & relaxing_trust = 0.3_wp
   !> Approach; area; energy of pressures. Exponent of the approach in Hertz's normal force
   real(wp), parameter :: normal_floor = 0.15_wp, area_floor = 0.2_wp, energy_floor = 0.07_wp, hertz_power = 1.5_wp
   !> Elastic energy if the error of the part due to pressures is known with its sign: unknown error over n^-2, and fraction of the
   !> error of the part due to tractions by the levels. General error over n^-2 of the part due to pressures
   real(wp), parameter :: unknown_energy = 0.02_wp, unknown_share = 0.3_wp, usual_energy = 0.055_wp
   !> Energy of tractions: factor of the root of the fraction in adhesion times n^-order. In steady rolling by the first order a
   !> third of the usual error: factor of the root of the fraction in adhesion times n^-1; in sliding, of the root of the part of
   !> the bound that cancels, less than the usual error of 0.07. Ratio where both forces are prescribed. Order in full sliding. Of
   !> random contacts of tests/accuracy (seeds 71002, 71003, 84001 and 90005; in sliding 99711 and 99713)
   real(wp), parameter :: traction_energy = 0.1_wp, adhesive_energy = 0.3_wp, turned_energy = 0.05_wp, &
      & energy_with_forces = 0.5_wp, sliding_order = 1.5_wp
   !> Change of the power of the motion between the levels: fraction that has the sign of the error, and fraction of unknown sign;
   !> of random contacts of tests/accuracy (seeds 1001 and 1002)
   real(wp), parameter :: signed = 0.5_wp, unsigned = 0.8_wp
   !> Exponent of the ratio of an error of the energy of pressures by the levels to the general error, see trusted
   real(wp), parameter :: energy_trust = 0.65_wp
   !> Difference parameter K from which on this exponent is 1: between the contacts of seeds 99711 to 99714, with K up to
   !> 0.12, whose estimates were too large only, and those of the test hard_coupling with K = 0.5, where it has to be 1
   real(wp), parameter :: strong_coupling = 0.25_wp
   !> The parts of the elastic energy usually have errors of opposite signs: median of their sum over the root of squares
   real(wp), parameter :: opposite = 0.45_wp
   !> Ratio of the error of the forces to the residual, measured between tolerances of 1e-2 and 1e-4; with an interfacial layer, in
   !> which errors of the slip add up along the contact, about the median of 40 values from 0.13 to 20 (seed 26112 of asked.py)
   real(wp), parameter :: residual_share = 0.3_wp, layer_residual_share = 3.0_wp

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
      ! a constant in the undeformed distance changes the approach only
      if (row%name == "pen") unit = scale%depth
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
      !> Lower bound relative to the reference value [-], and one in the unit of the total, whose value may be zero
      real(wp) :: floor, least
      real(wp) :: stopping, unit

      stopping = maxval(errors%stopping)
      unit = scale_of(row, scale)
      floor = 0.0_wp
      least = 0.0_wp
      select case (row%law)
      case (error_law%normal)
         e = difference/(coarsening**normal_order - 1.0_wp)
         floor = normal_floor*scale%width_share/scale%across**2
         ! by Hertz's theory the force changes with this power of the approach
         if (row%name == "fn") floor = hertz_power*floor
         floor = max(floor + rough_floor(1)*scale%roughness, scale%hidden)
         stopping = errors%stopping(1)
      case (error_law%friction, error_law%creepage)
         call bound_friction(row, difference, unit, scale, e, floor)
         if (row%law == error_law%creepage .and. scale%across < resolved) floor = max(floor, few_creepage/scale%across**2)
      case (error_law%power)
         e = error_of_power(scale, difference, unit)
         least = power_of_roughness(scale)*max(scale%power, unit)
      case (error_law%energy)
         e = error_of_energy(scale) + (stopping + errors%window)*unit
         return
      case (error_law%peak)
         call bound_temperature(row, difference, scale, e, least)
      case default
         e = difference/(coarsening**jump_order - 1.0_wp)
         floor = unseen(scale)*area_floor/scale%across
      end select
      e = max(e, floor*unit, least) + (stopping + errors%window)*unit
   end function error_of

   !> Error of the highest temperature, and its lower bound [degC]
   pure subroutine bound_temperature(row, difference, scale, e, floor)
      !> Temperature of body 1 or 2, or the higher one
      type(total), intent(in) :: row
      !> Difference between the levels [degC]
      real(wp), intent(in) :: difference
      type(scale_type), intent(in) :: scale
      !> Error by the levels, or by the shape of the maximum, and lower bound [degC]
      real(wp), intent(out) :: e, floor
      real(wp) :: bulk, slipping, sliding

      if (scale%jumps) then
         slipping = max(least_slip(2), 1.0_wp - scale%sticking)
         floor = unseen(scale)*(temperature_floor(2) + turning_temperature_floor*scale%turning)/(scale%mean_across*slipping)**2
         floor = max(scale%heat%rise*max(floor, heat_of_peak*scale%peak), scale%heat%usual)
         e = scale%heat%computed
         if (scale%heat_order < first_order) e = max(e, difference/(coarsening**scale%heat_order - 1.0_wp))
         return
      end if
      select case (row%name)
      case ("max_temp1")
         bulk = scale%bulk(1)
      case ("max_temp2")
         bulk = scale%bulk(2)
      case default
         bulk = maxval(scale%bulk)
      end select
      slipping = max(least_slip(1), 1.0_wp - scale%sticking)
      ! in full sliding tractions of first order have errors along the rolling direction only
      sliding = sliding_part(scale%sticking)
      floor = temperature_floor(1)/slipping*(sliding*unseen(scale, scale%along)/scale%along &
         & + (1.0_wp - sliding)*unseen(scale)/scale%mean_across)
      floor = abs(row%value - bulk)*max(floor, heat_of_peak*scale%peak)
      e = difference/(coarsening**scale%heat_order - 1.0_wp)
   end subroutine bound_temperature

   !> General error of frictional power in full sliding by the second order, times n^2, relative to it
   pure real(wp) function turned_power(scale) result(floor)
      type(scale_type), intent(in) :: scale

      floor = sliding_power_floor + sliding_power_turn*scale%turning
   end function turned_power

   !> Error of frictional power on rough surfaces by the second order, over the power of full sliding: as that of the forces
   !>
   !> In full sliding pressures in other places change the power only if slip varies across the contact. Without spin it does not.
   pure real(wp) function power_of_roughness(scale) result(floor)
      type(scale_type), intent(in) :: scale

      floor = 0.0_wp
      if (scale%order <= first_order) return
      floor = rough_floor(2)*scale%roughness
      if (is_turning(scale)) floor = floor*min(1.0_wp, scale%turning)
   end function power_of_roughness

   !> Ratio of the error of the normal problem to the general error for this number of elements, at least 1
   pure real(wp) function irregularity(row, difference, scale) result(ratio)
      !> Normal force or approach of the finer level
      type(total), intent(in) :: row
      !> Difference between the levels
      real(wp), intent(in) :: difference
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      ratio = max(1.0_wp, difference/(coarsening**normal_order - 1.0_wp)*scale%across**2 &
         & /(normal_floor*scale%width_share*max(scale_of(row, scale), tiny(ratio))))
   end function irregularity

   !> Error of frictional power or work without contributions of solvers and window, in its unit
   pure real(wp) function error_of_power(scale, difference, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Difference between the levels, and the power itself, positive
      real(wp), intent(in) :: difference, unit
      real(wp) :: floor, full_power, heat

      full_power = max(scale%power, unit, tiny(unit))
      heat = by_heat(scale, part_of(scale, scale%order), difference, unit)
      if (is_long_step(scale)) then
         e = heat + power_error(unit/full_power, difference/full_power, scale%friction, scale%in_step, scale%mean_across, &
            & scale%step)*full_power
         return
      end if
      if (scale%clean .and. .not. scale%steps .and. scale%order >= normal_order) then
         e = error_of_work(scale, difference, full_power)
         return
      end if
      if (scale%balances .and. .not. (scale%coupling > 0.0_wp .and. scale%jumps)) then
         e = heat + error_by_balance(scale, unit)
         return
      end if
      if (scale%relaxation > 0.0_wp .and. scale%jumps .and. .not. scale%coupling > 0.0_wp) then
         e = heat + error_of_relaxing(scale, difference/full_power)*full_power
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
      if (scale%jumps) e = trusted(e, floor, trust_in(scale))
      e = max(e + heat, floor)
      ! for unlike bodies the balance includes errors of pressures that hardly affect power with the second-order scheme
      if (scale%balances) e = sqrt(e*(heat + error_by_balance(scale, unit)))
   end function error_of_power

   !> Error of frictional power of viscoelastic bodies in steady rolling by the second order, over the power of full sliding
   !>
   !> The power of the motion does not contain what pressures lose by relaxation, so that its change between the levels and
   !> that of the rest have a common part of opposite signs. Only the change of the sum says something, and little of it: on the
   !> coarse level elements may be as long as the bodies roll while they relax.
   pure real(wp) function error_of_relaxing(scale, difference) result(e)
      type(scale_type), intent(in) :: scale
      !> Difference between the levels, over the power of full sliding
      real(wp), intent(in) :: difference
      real(wp) :: usual, slipping

      slipping = max(1.0_wp, scale%mean_across*(1.0_wp - scale%sticking))
      usual = (relaxing_power(1) + relaxing_power(2)*scale%turning + relaxing_power(3)*scale%sticking**relaxing_power(4) &
         & *max(1.0_wp, narrow_slip/slipping)**2)/scale%mean_across**2
      e = max(usual*max(relaxing_ratio, part_of(scale, scale%order)*difference/usual)**relaxing_trust, &
         & sqrt(scale%adhesion)*unrelaxed(scale))
   end function error_of_relaxing

   !> Error of the work of friction in a shift without contributions of solvers and window [J]
   !>
   !> Forces and elastic energy have larger errors, most of which cancel in the work, and the levels show little of the rest. In
   !> full sliding in one direction the work of the motion is exact, and the rest is twice the energy of the tractions.
   pure real(wp) function error_of_work(scale, difference, full_work) result(e)
      type(scale_type), intent(in) :: scale
      !> Difference between the levels, and work in full sliding, positive [J]
      real(wp), intent(in) :: difference, full_work
      real(wp) :: floor, sticks

      if (sliding_part(scale%sticking) >= 1.0_wp .and. scale%cancelled < one_direction) then
         e = 2.0_wp*error_of_energy(scale)*abs(scale%energy(2))/max(sum(scale%energy), tiny(e))
         return
      end if
      floor = work_floor(1) + (work_floor(2) - work_floor(1))*min(1.0_wp, scale%cancelled/turned_work)
      sticks = min(1.0_wp, max(0.0_wp, (scale%sticking - little_slip(1))/(little_slip(2) - little_slip(1))))
      floor = (floor + sticks*(work_floor(3) - floor))*max(1.0_wp, scale%irregular/usual_irregularity)/scale%across**2
      e = max(floor, trusted(part_of(scale, scale%order)*difference/full_work, floor, work_trust))*full_work
   end function error_of_work

   !> Error of frictional power in steady rolling [W]: the difference of the power of the motion and frictional power, with its
   !> sign, and the error of the power of the motion
   pure real(wp) function error_by_balance(scale, unit) result(e)
      type(scale_type), intent(in) :: scale
      !> Frictional power, positive [W]
      real(wp), intent(in) :: unit
      real(wp) :: floor, by_levels

      if (is_turning(scale)) then
         floor = turned_power(scale)/scale%squared
         if (scale%in_pair) floor = centred*floor
      else
         floor = hypot(friction_floor(scale, scale%adhesion, .true.), turning_power_floor*scale%turning/scale%mean_across**2)
      end if
      floor = floor*max(scale%power, unit)
      by_levels = part_of(scale, order_of(scale))*abs(scale%motion_change)
      if (scale%jumps) by_levels = trusted(by_levels, floor, trust_in(scale))
      e = hypot(scale%surplus - sign(signed*by_levels, scale%motion_change), max(floor, unsigned*by_levels))
      ! a surplus that jumps with the offset of the grid may be small by chance: that of the coarser level is another sample of it
      if (scale%jumps) e = max(e, trusted(part_of(scale, order_of(scale))*abs(scale%coarse_surplus), floor, trust_in(scale)), &
         & sticking_power(1)*scale%sticking**sticking_power(2)/scale%mean_across**2*max(scale%power, unit))
   end function error_by_balance

   !> Error of the elastic energy without contributions of solvers and window [J]
   !>
   !> The energy of tractions follows that of the pressures, which bound them: a relative error of the latter is one of the whole
   !> energy. The rest of the change between the levels in the energy of tractions has the order of the tangential problem. The
   !> signs of both errors vary between cases.
   pure real(wp) function error_of_energy(scale) result(e)
      type(scale_type), intent(in) :: scale
      real(wp) :: whole, parts(2), floor(2), general, order, more

      whole = 1.0_wp
      if (scale%energy(1) > 0.0_wp) whole = whole + scale%energy(2)/scale%energy(1)
      order = scale%order
      if (is_first(scale)) order = (1.0_wp - sliding_part(scale%sticking))*order + sliding_part(scale%sticking)*sliding_order
      ! a layer has a length of its own in slip, but tractions in adhesion have errors of first order
      parts = -[whole*scale%energy_change(1)/(coarsening**normal_order - 1.0_wp), &
         & (scale%energy_change(2) - (whole - 1.0_wp)*scale%energy_change(1)) &
         & *merge(1.0_wp/(coarsening**order - 1.0_wp), part_of(scale, order), is_layer(scale))]
      ! in steps the levels have errors of the same sign, so their difference is not an estimate
      if (scale%steps) parts(2) = 0.0_wp
      floor = [abs(whole*scale%energy(1))*scale%across**(-2), abs(scale%energy(2))*floor_of_traction_energy(scale)]
      more = merge(energy_of_steps(scale%sticking), energy_of_forces, is_long_step(scale))*traction_error(scale) &
         & *abs(scale%energy(2))
      if (is_layer(scale)) more = more + layer_energy_floor*sqrt(scale%adhesion)*abs(scale%energy(2))/scale%mean_across
      if (scale%has_normal_energy .and. scale%across >= resolved) then
         ! the error changes its sign with the offset of the grid: at least half of its root mean square
         e = max(usual_energy*floor(1), hypot(whole*scale%normal_energy + parts(2), &
            & unknown_energy*floor(1) + floor(2) + unknown_share*abs(parts(2)) + more))
         return
      end if
      general = energy_floor*scale%irregular*floor(1)
      ! tractions of dissimilar bodies change their pressures within an element or two; the levels show it
      parts(1) = sign(trusted(abs(parts(1)), general, energy_trust + (1.0_wp - energy_trust) &
         & *min(1.0_wp, scale%coupling/strong_coupling)), parts(1))
      e = hypot(parts(1), parts(2))
      if (scale%clean .and. abs(parts(2)) > 0.0_wp) e = max(opposite*e, abs(abs(parts(1)) - abs(parts(2))))
      e = max(e, general + merge(1.0_wp, 2.0_wp, is_first(scale))*floor(2) + more)
   end function error_of_energy

   !> Lower bound of the error of the energy of tractions, relative to it
   pure real(wp) function floor_of_traction_energy(scale) result(floor)
      type(scale_type), intent(in) :: scale

      if (is_first(scale)) then
         floor = (adhesive_energy*sqrt(scale%sticking) + turned_energy*sqrt(scale%cancelled)*sliding_part(scale%sticking)) &
            & /scale%mean_across
         if (scale%is_moment_alone) floor = energy_with_forces*floor
      else
         floor = traction_energy*sqrt(scale%adhesion)*scale%across**(-scale%order)
      end if
   end function floor_of_traction_energy

   !> Is it steady rolling by the first order with an interfacial layer?
   pure logical function is_layer(scale)
      type(scale_type), intent(in) :: scale

      is_layer = scale%order < normal_order .and. .not. (scale%clean .or. scale%steps)
   end function is_layer
end module contact_patch_level_errors
