!> Scales of the errors of the totals of a patch, and quantities that determine their size, see contact_patch_level_errors
module contact_patch_error_scales
   use contact_base_choices, only : heat_source, motion
   use contact_base_constants, only : excluded_threshold, nmm_per_joule, pi
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_numeric_elliptic, only : complete_elliptic, elliptic_integrals
   use contact_patch_edge_slip, only : edge_slip_error, hidden_adhesion, leading_turn
   use contact_patch_heat_errors, only : error_of_maximum, maximum_error
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_patch_turning, only : turned_round, turns
   implicit none (type, external)
   private

   public :: first_order, mean_friction, normal_order, resolved, rows_error, scale_type, scales, unseen

   !> Order of the normal problem
   real(wp), parameter :: normal_order = 2.0_wp
   !> A single row of elements in contact is up to two elements wide: number of elements as which it counts. With 1.5 the error of
   !> the approach is 0.1 n^-2 of that by Hertz's theory, as with 2 to 40 elements across (wheels of any profiles)
   real(wp), parameter :: single_row = 1.5_wp
   !> Orders of forces in steady rolling for both schemes; the order of the second one is observed from 15 to 45 elements, with
   !> scatter
   real(wp), parameter :: first_order = 1.0_wp, second_order = 1.6_wp
   !> Contact of fewer elements across is not coarsened in that direction, so that the levels do not show its error: factor of the
   !> lower bounds there, which are about half of the usual errors
   real(wp), parameter :: resolved = 6.0_wp, usual = 2.0_wp
   !> Order of the maximum of a field whose peak is resolved; order of temperatures that count the heat of an element twice at its
   !> centre: its contribution decreases with the square root of the element length
   real(wp), parameter :: peak_order = 1.25_wp, counted_twice = 0.5_wp
   !> A grid of few rows represents plane strain if their width exceeds the length of contact by this factor; chosen
   real(wp), parameter :: plane = 4.0_wp
   !> Mean square of the third differences of white noise, relative to that of the noise: 1 + 9 + 9 + 1
   real(wp), parameter :: of_noise = 20.0_wp
   !> Third differences of smooth surfaces, as the standard deviation of noise relative to the approach: at most this times the
   !> number n of elements across contact to this power, if the curvature jumps by its own size at one place of it. The approach is
   !> curvature times (n dy)^2/8, a jump changes one of n third differences by curvature times dy^2: 8/sqrt(of_noise) n^-2.5
   real(wp), parameter :: of_curvature = 8.0_wp/sqrt(of_noise), curvature_power = -2.5_wp
   !> For bodies of different materials, pressures determine where slip reverses: amplification of the solver error of pressures in
   !> the forces, also if an adhesion area of at most this fraction of the contact lies in between. Measured with rollers of
   !> aluminium and steel, EPS from 1e-2 to 1e-5
   real(wp), parameter :: reversal_gain = 130.0_wp, narrow = 0.05_wp
   !> Part of the elements that sticks is taken as at least this: in full sliding directions of slip have errors,
   !> too; of shifts, whose errors in full sliding are half as large as others (seed 8102)
   real(wp), parameter :: least_adhesion = 0.02_wp, least_in_shifts = 0.25_wp

   !> Errors of FX, FY and MZ by few rows of elements, the computed less the exact ones
   type :: rows_error
      !> [N, N mm], or relative to scales
      real(wp) :: value(3) = 0.0_wp
      !> Are they known? Are they those of the columns of the coarse level, at whose ends they depend on single elements?
      logical :: known = .false., scatters = .false.
   end type rows_error

   !> Quantities common to all totals of a patch
   type :: scale_type
      !> Number of elements across the contact in the direction with fewest elements
      real(wp) :: across = 1.0_wp
      !> Maximum frictional force and moment [N, N mm]
      real(wp) :: force = 0.0_wp, moment = 0.0_wp
      !> The larger one of the two creepages; power, or work, if the whole contact slid with the creepages or with the spin [W, J]
      real(wp) :: creep = 0.0_wp, power = 0.0_wp
      !> Fraction of the elements in contact without slip, with a lower bound [-]
      real(wp) :: adhesion = 0.0_wp
      !> The same without lower bound [-]
      real(wp) :: sticking = 0.0_wp
      !> The same on the coarse level [-]
      real(wp) :: coarse_sticking = 1.0_wp
      !> The fraction in adhesion of the present or the previous step of transient rolling that is closer to a half [-]
      real(wp) :: in_step = 0.0_wp
      !> Fraction of the traction bound carried by neighbouring elements between which slip reverses [-]
      real(wp) :: reversal = 0.0_wp
      !> Lower bound of the tangential forces' solver error, relative to that of the pressures [-]
      real(wp) :: gain = 0.0_wp
      !> Maximum difference of the levels in tangential forces, relative to their scale [-]
      real(wp) :: friction = 0.0_wp
      !> The same without the moment [-]
      real(wp) :: forces = 0.0_wp
      !> Is it a patch of wheel and rail, whose position depends on the elements, too?
      logical :: in_pair = .false.
      !> Are both tangential forces prescribed, so that only the moment has an error?
      logical :: is_moment_alone = .false.
      !> FX and FY over the tangential force, magnitudes [-]
      real(wp) :: direction(2) = 0.0_wp
      !> Difference of the levels in the tangential force across it, by which it turns, and along it, over the friction bound [-]
      real(wp) :: turned_force(2) = 0.0_wp
      !> Errors of FX, FY and MZ by few rows of elements, over the maximum frictional force and moment, and those across the force
      !> and along it [-]
      type(rows_error) :: rows
      real(wp) :: turned_rows(2) = 0.0_wp
      !> Sum of tangential tractions relative to the sum of traction bounds [-]
      real(wp) :: used = 0.0_wp
      !> Part of the traction bound that does not contribute to the forces, as tractions have different directions, in steady
      !> rolling and shifts [-]
      real(wp) :: cancelled = 0.0_wp
      !> Moment of the force across the rolling direction with an arm of one element, in rolling, over that of the friction bound
      !> [-]
      real(wp) :: arm = 0.0_wp
      !> Change of the lateral creepage by the spin along a step, over the larger creepage, in steady rolling [-]
      real(wp) :: spin_step = 0.0_wp
      !> Velocity of the spin at the radius of the contact area over that of the creepages, at most 1 [-]
      real(wp) :: swing = 0.0_wp
      !> Root of the ratio of the sides of the contact: arms of the longer one exceed the radius of the area by this factor [-]
      real(wp) :: slender = 1.0_wp
      !> Approach by the pressures of the narrow width alone, over that of the whole contact, relative to a circle: K(0)/K [-]
      real(wp) :: width_share = 1.0_wp
      !> Order of the tangential problem; is it clean, so that levels may be extrapolated? Is it transient rolling?
      real(wp) :: order = 1.0_wp
      logical :: clean = .true., steps = .false.
      !> Length of a step of transient rolling, in elements [-]
      real(wp) :: step = 0.0_wp
      !> Ratio of the relative error of the normal problem by the levels to the typical one with this number of elements, at least 1
      real(wp) :: irregular = 1.0_wp
      !> May the difference of the levels be an unlikely sample of an error that varies with the offset of the grid?
      logical :: jumps = .false.
      !> Ratio of element length to relaxation length of viscoelastic bodies, at most 1; 0: elastic
      real(wp) :: relaxation = 0.0_wp
      !> Number of elements across the contact in the rolling direction
      real(wp) :: along = 1.0_wp
      !> Relative error of the largest pressure [-]
      real(wp) :: peak = 0.0_wp
      !> Order of the highest temperatures
      real(wp) :: heat_order = peak_order
      !> Temperatures of the bodies outside the contact [degC]
      real(wp) :: bulk(2) = 0.0_wp
      !> Error of the highest temperature from the shape of its maximum
      type(maximum_error) :: heat
      !> Relative difference of the levels in the mean coefficient of friction, if it depends on temperature [-]
      real(wp) :: warmed = 0.0_wp
      !> Largest interpenetration of the undeformed surfaces: the approach from first contact on [mm]
      real(wp) :: depth = 0.0_wp
      !> Standard deviation of the heights of a rough surface, relative to the depth [-]
      real(wp) :: roughness = 0.0_wp
      !> Change of the approach by details between rows of elements, relative to the depth [-]
      real(wp) :: hidden = 0.0_wp
      !> Magnitude of the difference parameter K of the materials [-]
      real(wp) :: coupling = 0.0_wp
      !> Ratio of `coupling` to the coefficient of friction, at most 1 [-]
      real(wp) :: driven = 0.0_wp
      !> Geometric mean of the number of elements across the contact in both directions
      real(wp) :: mean_across = 1.0_wp
      !> Square of the number of elements for errors of second order of forces: the narrower direction times the mean of both
      real(wp) :: squared = 1.0_wp
      !> Error of the forces by slip at the leading edge of unlike bodies, by the second order [-]; is it known?
      real(wp) :: edge_slip = 0.0_wp
      logical :: has_edge_slip = .false.
      !> Turn of tractions at the leading edge in full sliding by the second order, in steady rolling, see leading_turn [-]
      real(wp) :: leading = 0.0_wp
      !> Is it a line contact, with elements along x only?
      logical :: is_line = .false.
      !> Root mean square deviation of the coefficient of friction, relative to its mean, if it depends on slip velocity [-]
      real(wp) :: falling = 0.0_wp
      !> Turning of the slip direction across the contact, for the second order in rolling, at most half a turn [rad]
      real(wp) :: turning = 0.0_wp
      !> Its square from element to element, the same, summed over both directions and weighted with tractions, without limit [-]
      real(wp) :: turns = 0.0_wp
      !> Frictional power minus power of the motion; difference of the levels in the power of the motion [W]
      real(wp) :: surplus = 0.0_wp, motion_change = 0.0_wp
      !> Frictional power minus power of the motion on the coarse level [W]
      real(wp) :: coarse_surplus = 0.0_wp
      !> Is the power of the motion known? Does frictional power equal it in the exact solution?
      logical :: has_motion_power = .false., balances = .false.
      !> Errors of the force across it, along it, and of MZ in full sliding by the first order, over the maximum frictional force
      !> and moment: of the directions of tractions, and by the rest of the difference of the levels [-]; are they known?
      real(wp), dimension(3) :: turned = 0.0_wp, not_turned = 0.0_wp
      logical :: has_turned = .false.
      !> Elastic energy of pressures and of tractions, and differences of the levels in them [J]
      real(wp) :: energy(2) = 0.0_wp, energy_change(2) = 0.0_wp
      !> Error of the elastic energy of pressures with its sign [J]; is it known?
      real(wp) :: normal_energy = 0.0_wp
      logical :: has_normal_energy = .false.
   end type scale_type

contains

   !> Factor of lower bounds for errors that the levels do not show, as a direction has few elements [-]
   pure real(wp) function unseen(scale, across)
      !> Number of elements across
      type(scale_type), intent(in) :: scale
      !> The same of the direction that matters; default: that of the fewest elements
      real(wp), intent(in), optional :: across
      real(wp) :: n

      n = scale%across
      if (present(across)) n = across
      unseen = merge(usual, 1.0_wp, n < resolved)
   end function unseen

   !> Mean coefficient of friction, weighted with pressure [-]
   pure real(wp) function mean_friction(result) result(mu)
      !> Solution, with contact
      type(patch_result), intent(in) :: result

      mu = sum(result%mu*result%pn)/max(sum(result%pn), tiny(mu))
   end function mean_friction

   !> Root mean square deviation of the coefficient of friction, weighted with pressure, relative to its mean [-]
   pure real(wp) function deviation_of_friction(result) result(deviation)
      !> Solution, with contact
      type(patch_result), intent(in) :: result
      real(wp) :: mean

      mean = mean_friction(result)
      deviation = sqrt(sum((result%mu - mean)**2*result%pn)/max(sum(result%pn), tiny(mean)))/max(mean, tiny(mean))
   end function deviation_of_friction

   !> Compute the scales of a solution
   pure function scales(problem, order, result) result(scale)
      type(patch_problem), intent(in) :: problem
      !> Order of the scheme of the tangential problem, 1 or 2
      integer, intent(in) :: order
      type(patch_result), intent(in) :: result
      type(scale_type) :: scale
      type(bounding_box) :: box
      type(elliptic_integrals) :: integrals
      real(wp) :: extent(2)
      integer :: across(2)

      box = contact_box(result%division)
      across = [box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1]
      scale%across = max(single_row, real(minval(across), wp))
      extent = across*[result%grid%dx, result%grid%dy]
      scale%mean_across = sqrt(real(product(across), wp))
      scale%along = max(single_row, across(1)*abs(cos(problem%chi)) + across(2)*abs(sin(problem%chi)))
      scale%slender = sqrt(maxval(extent)/minval(extent))
      if (result%grid%my < 3 .and. extent(2) > plane*extent(1)) then
         scale%is_line = .true.
         scale%across = across(1)
         scale%mean_across = scale%across
      else if (result%grid%mx < 3 .and. extent(1) > plane*extent(2)) then
         scale%across = across(2)
         scale%mean_across = scale%across
      end if
      if (result%grid%mx >= 3 .and. result%grid%my >= 3) then
         integrals = complete_elliptic(minval(extent)/maxval(extent))
         scale%width_share = 0.5_wp*pi/integrals%k
      end if
      scale%squared = scale%across*scale%mean_across
      scale%swing = abs(result%cphi)*sqrt(result%contact_area()/pi)
      scale%swing = scale%swing/max(scale%swing, hypot(result%cksi, result%ceta), tiny(extent))
      scale%force = result%friction_bound()
      scale%moment = scale%force*sqrt(result%contact_area()/pi)
      scale%creep = max(abs(result%cksi), abs(result%ceta))
      scale%power = max(scale%force*hypot(result%cksi, result%ceta), scale%moment*abs(result%cphi))*result%dq/ &
         & (nmm_per_joule*result%dt)
      scale%sticking = real(result%nadh, wp)/result%ncon
      if (order == 1) scale%sticking = scale%sticking + real(hidden_adhesion(problem, result), wp)/result%ncon
      scale%adhesion = max(merge(least_in_shifts, least_adhesion, problem%motion == motion%shift), scale%sticking)
      if (problem%model%coupled()) then
         scale%coupling = abs(problem%model%material%ak)
         scale%driven = scale%coupling/max(mean_friction(result), scale%coupling)
      end if
      scale%depth = max(0.0_wp, result%pen - minval(problem%h))
      ! third differences that begin up to three elements ahead of the contact have a part in it; pressures by formula do not
      ! follow from the distance
      if (.not. allocated(problem%given_pressure)) then
         associate (mx => result%grid%mx, my => result%grid%my)
            scale%roughness = max(roughness(mx*my, [box%ix0, box%ix1], [max(1, box%iy0 - 3), min(my - 3, box%iy1)], [1, mx], &
               & problem%h, result%division, across(2), scale%depth), &
               & roughness(mx*my, [box%iy0, box%iy1], [max(1, box%ix0 - 3), min(mx - 3, box%ix1)], [mx, 1], &
               & problem%h, result%division, across(1), scale%depth))
         end associate
      end if
      if (scale%force > 0.0_wp) then
         scale%used = result%grid%dx*result%grid%dy*sum(hypot(result%px, result%py))/scale%force
         scale%reversal = result%grid%dx*result%grid%dy*turned_round(result, 0)/scale%force
         if (scale%coupling > 0.0_wp) scale%gain = reversal_gain*min(1.0_wp, scale%across*result%grid%dx*result%grid%dy &
            & *turned_round(result, ceiling(narrow*scale%across))/scale%force)
      end if
      scale%direction = abs([result%fx, result%fy])/max(hypot(result%fx, result%fy), tiny(extent))
      scale%is_moment_alone = problem%n_forces == 2
      if (any(problem%motion == [motion%steady_rolling, motion%shift]) .and. scale%force > 0.0_wp) scale%cancelled &
         & = sqrt(max(0.0_wp, scale%used**2 - (result%fx**2 + result%fy**2)/scale%force**2))
      if (problem%motion == motion%steady_rolling .and. scale%force > 0.0_wp) then
         scale%arm = abs(result%fy*cos(problem%chi) - result%fx*sin(problem%chi))*result%dq/max(scale%moment, tiny(extent))
         scale%spin_step = abs(result%cphi)*result%dq/max(scale%creep, tiny(extent))
      end if
      scale%order = normal_order
      if (problem%motion == motion%steady_rolling) scale%order = merge(second_order, first_order, order == 2)
      if (any(problem%motion == [motion%steady_rolling, motion%transient_rolling]) .and. order == 2 .and. scale%force > 0.0_wp) &
         & scale%turns = result%grid%dx*result%grid%dy*turns(result)/scale%force
      scale%turning = min(pi, scale%mean_across*sqrt(scale%turns))
      scale%has_edge_slip = problem%motion == motion%steady_rolling .and. order == 2 .and. scale%coupling > 0.0_wp
      if (scale%has_edge_slip) scale%edge_slip = edge_slip_error(problem, result)
      if (problem%motion == motion%steady_rolling .and. order == 2) scale%leading = leading_turn(problem, result)
      if (problem%motion == motion%transient_rolling) call add_step(order, result, scale)
      ! with the first order a time step is longer than some elements and shorter than others, and a layer adds a length scale
      scale%clean = order == 2 .or. .not. (problem%motion == motion%transient_rolling .or. problem%model%layer > 0.0_wp)
      ! tractions are singular at prescribed edges
      if (problem%motion == motion%shift) scale%clean = .not. any(problem%h > excluded_threshold)
      if (allocated(problem%thermal)) then
         scale%bulk = problem%thermal%bulk
         if (problem%thermal%source == heat_source%established) scale%heat_order = counted_twice
         scale%heat = error_of_maximum(problem, result)
      end if
      if (allocated(problem%friction)) then
         if (problem%friction%driver() == friction_driver%slip_speed) scale%falling = deviation_of_friction(result)
      end if
      scale%jumps = scale%clean .and. scale%order > first_order .and. .not. scale%steps
      if (allocated(problem%model%memory)) then
         associate (memory => problem%model%memory)
            if (any(memory%length > 0.0_wp)) scale%relaxation = min(1.0_wp, result%grid%dx/minval(memory%length, &
               & mask=memory%length > 0.0_wp))
         end associate
      end if
   end function scales

   !> What a step of transient rolling has in addition
   pure subroutine add_step(order, result, scale)
      !> Order of the scheme of the tangential problem, 1 or 2
      integer, intent(in) :: order
      !> Solution
      type(patch_result), intent(in) :: result
      !> With the fraction in adhesion; components of steps are set
      type(scale_type), intent(inout) :: scale

      scale%steps = .true.
      scale%order = merge(second_order, first_order, order == 2)
      scale%step = result%dq/result%grid%dx
      scale%in_step = scale%adhesion
      if (.not. allocated(result%errors)) return
      associate (before => result%errors%adhered_before)
         if (before >= 0.0_wp .and. abs(before - 0.5_wp) < abs(scale%in_step - 0.5_wp)) scale%in_step = before
      end associate
   end subroutine add_step

   !> Standard deviation of the heights of a rough surface along one direction of a grid, relative to the depth [-]
   !>
   !> From third differences in and beside the contact, which vanish for parabolas. The largest contribution of a curvature that
   !> varies across the contact is subtracted, so that the result is 0 for surfaces that the elements resolve.
   pure real(wp) function roughness(npot, lines, n, step, h, division, across, depth)
      !> Number of elements
      integer, intent(in) :: npot
      !> First and last line along the direction that is in contact; first and last element of a line at which third differences
      !> begin
      integer, intent(in) :: lines(2), n(2)
      !> Distance of neighbours in the fields, from line to line and along a line
      integer, intent(in) :: step(2)
      !> Undeformed distance [mm] and element states
      real(wp), intent(in) :: h(0:npot - 1)
      integer, intent(in) :: division(0:npot - 1)
      !> Number of elements across contact in this direction
      integer, intent(in) :: across
      !> Largest interpenetration of the undeformed surfaces [mm]
      real(wp), intent(in) :: depth
      real(wp) :: squares
      integer :: i, k, at, count

      count = 0
      squares = 0.0_wp
      do k = n(1), n(2)
         do i = lines(1), lines(2)
            at = (i - 1)*step(1) + (k - 1)*step(2)
            if (max(division(at), division(at + step(2)), division(at + 2*step(2)), division(at + 3*step(2))) &
               & < element%adhesion) cycle
            if (max(h(at), h(at + step(2)), h(at + 2*step(2)), h(at + 3*step(2))) > excluded_threshold) cycle
            squares = squares + (h(at + 3*step(2)) - 3.0_wp*(h(at + 2*step(2)) - h(at + step(2))) - h(at))**2
            count = count + 1
         end do
      end do
      roughness = 0.0_wp
      if (count > 0) roughness = max(0.0_wp, sqrt(squares/(of_noise*count))/max(depth, tiny(depth)) &
         & - of_curvature*real(across, wp)**curvature_power)
   end function roughness
end module contact_patch_error_scales
