!> What the errors of the totals of a patch are relative to, and what decides about their size, see contact_patch_level_errors
module contact_patch_error_scales
   use contact_base_choices, only : heat_source, motion
   use contact_base_constants, only : excluded_threshold, nmm_per_joule, pi
   use contact_base_kinds, only : wp
   use contact_friction_law, only : friction_driver
   use contact_grid_element_division, only : bounding_box, contact_box, element
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   use contact_patch_turning, only : turned_round, turns
   implicit none (type, external)
   private

   public :: first_order, mean_friction, normal_order, scale_type, scales

   !> Order of the normal problem
   real(wp), parameter :: normal_order = 2.0_wp
   !> Of forces in steady rolling by both schemes; the second one shows this order from 15 to 45 elements on, with its jitter
   real(wp), parameter :: first_order = 1.0_wp, second_order = 1.6_wp
   !> Of the largest of a field whose peak elements resolve; of temperatures that count the heat of an element twice at its
   !> centre: its share falls with the root of the element
   real(wp), parameter :: peak_order = 1.25_wp, counted_twice = 0.5_wp
   !> Few rows of elements stand for plane strain where they are longer than the contact by this factor; chosen
   real(wp), parameter :: plane = 4.0_wp
   !> Part of the alternation of a rough surface that peaks between centres of elements have; that of noise is the root of 15 of its
   !> standard deviation; chosen with tests/stability/hard_wheels.py
   real(wp), parameter :: roughness_share = 0.25_wp
   !> Of unlike bodies, pressures decide where slip turns round: what an error of stopping of pressures becomes in forces then, also
   !> with adhesion over this part of the contact in between. Measured with rollers of aluminium and steel, EPS from 1e-2 to 1e-5
   real(wp), parameter :: reversal_gain = 130.0_wp, narrow = 0.05_wp
   !> Part of the elements that sticks is taken as at least this: in full sliding directions of slip have errors,
   !> too; of shifts, whose errors in full sliding are half as large as others (seed 8102)
   real(wp), parameter :: least_adhesion = 0.02_wp, least_in_shifts = 0.25_wp

   !> What is common to all totals of a patch
   type :: scale_type
      !> Elements across the contact in the direction that has fewest
      real(wp) :: across = 1.0_wp
      !> Force and moment that friction bears at most [N, N mm]
      real(wp) :: force = 0.0_wp, moment = 0.0_wp
      !> Larger one of the two creepages; power, or work, if all of the contact slid with it and with the spin [W, J]
      real(wp) :: creep = 0.0_wp, power = 0.0_wp
      !> Part of the elements in contact that does not slip [-]
      real(wp) :: adhesion = 0.0_wp
      !> The same, where it may be zero [-]
      real(wp) :: sticking = 0.0_wp
      !> Part of the friction bound that elements carry where slip turns round from one to the next [-]
      real(wp) :: reversal = 0.0_wp
      !> What an error of stopping of pressures becomes in tangential forces, at least
      real(wp) :: gain = 0.0_wp
      !> Differences of the levels in tangential forces, relative to the largest one [-]
      real(wp) :: friction = 0.0_wp
      !> Are both forces prescribed, so that the moment alone has an error?
      logical :: is_moment_alone = .false.
      !> Tangential tractions over what friction bears [-]
      real(wp) :: used = 0.0_wp
      !> Order of the tangential problem; is it clean, so that levels may be extrapolated? Does it go in steps of transient rolling?
      real(wp) :: order = 1.0_wp
      logical :: clean = .true., steps = .false.
      !> Length of a step of transient rolling [elements]
      real(wp) :: step = 0.0_wp
      !> Relative error of the normal problem by the levels, over that of so many elements in general, at least 1
      real(wp) :: irregular = 1.0_wp
      !> May what the levels tell be a rare sample of an error that jumps with the offset of the grid?
      logical :: jumps = .false.
      !> Length of an element over that of relaxation of viscoelastic bodies, at most 1; 0: elastic
      real(wp) :: relaxation = 0.0_wp
      !> Of the highest temperatures
      real(wp) :: heat_order = peak_order
      !> Difference of the levels in the mean coefficient of friction, relative to it, where it follows temperatures [-]
      real(wp) :: warmed = 0.0_wp
      !> How far a rough surface may rise between centres of elements, over the approach [-]
      real(wp) :: roughness = 0.0_wp
      !> Difference parameter K of unlike bodies [-]
      real(wp) :: coupling = 0.0_wp
      !> The same over the coefficient of friction, at most 1 [-]
      real(wp) :: driven = 0.0_wp
      !> Elements along each side of a square of as many as in the box around the contact
      real(wp) :: mean_across = 1.0_wp
      !> Root of the mean square of the deviations of the coefficient of friction, over its mean, where it follows slip [-]
      real(wp) :: falling = 0.0_wp
      !> How far slip turns across the contact, by the second order of steady rolling, at most half a turn [rad]
      real(wp) :: turning = 0.0_wp
      !> Power that the motion gives and friction does not take, and what the levels differ by in that of the motion [W]
      real(wp) :: surplus = 0.0_wp, motion_change = 0.0_wp
      !> The first of these of the coarser level [W]
      real(wp) :: coarse_surplus = 0.0_wp
      !> Is the power of the motion known? Does friction take all of it in the exact solution?
      logical :: has_motion_power = .false., balances = .false.
      !> Parts of the elastic energy, of pressures and of tractions, and what the levels differ by in them [J]
      real(wp) :: energy(2) = 0.0_wp, energy_change(2) = 0.0_wp
      !> Error of the part of pressures with its sign [J]; is it known?
      real(wp) :: normal_energy = 0.0_wp
      logical :: has_normal_energy = .false.
   end type scale_type

contains

   !> Mean coefficient of friction, weighted with pressures [-]
   pure real(wp) function mean_friction(result) result(mu)
      !> Solved, in contact
      type(patch_result), intent(in) :: result

      mu = sum(result%mu*result%pn)/max(sum(result%pn), tiny(mu))
   end function mean_friction

   !> Root of the mean square of its deviations, weighted with pressures, over the mean [-]
   pure real(wp) function deviation_of_friction(result) result(deviation)
      !> Solved, in contact
      type(patch_result), intent(in) :: result
      real(wp) :: mean

      mean = mean_friction(result)
      deviation = sqrt(sum((result%mu - mean)**2*result%pn)/max(sum(result%pn), tiny(mean)))/max(mean, tiny(mean))
   end function deviation_of_friction

   !> What totals are compared with
   pure function scales(problem, order, result) result(scale)
      type(patch_problem), intent(in) :: problem
      !> Of the scheme of the tangential problem, 1 or 2
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
      scale%mean_across = sqrt(real(product(across), wp))
      if (result%grid%my < 3 .and. extent(2) > plane*extent(1)) then
         scale%across = across(1)
         scale%mean_across = scale%across
      else if (result%grid%mx < 3 .and. extent(1) > plane*extent(2)) then
         scale%across = across(2)
         scale%mean_across = scale%across
      end if
      scale%force = result%grid%dx*result%grid%dy*sum(result%mu*result%pn)
      scale%moment = scale%force*sqrt(result%contact_area()/pi)
      scale%creep = max(abs(result%cksi), abs(result%ceta))
      scale%power = max(scale%force*hypot(result%cksi, result%ceta), scale%moment*abs(result%cphi))*result%dq/ &
         & (nmm_per_joule*result%dt)
      scale%sticking = real(result%nadh, wp)/result%ncon
      scale%adhesion = max(merge(least_in_shifts, least_adhesion, problem%motion == motion%shift), scale%sticking)
      if (problem%model%coupled()) then
         scale%coupling = abs(problem%model%material%ak)
         scale%driven = scale%coupling/max(mean_friction(result), scale%coupling)
      end if
      scale%roughness = roughness_share*max(alternation(problem%h, result%division), &
         & alternation(transpose(problem%h), transpose(result%division)))/max(abs(result%pen), tiny(extent))
      if (scale%force > 0.0_wp) then
         scale%used = result%grid%dx*result%grid%dy*sum(hypot(result%px, result%py))/scale%force
         scale%reversal = result%grid%dx*result%grid%dy*turned_round(result, 0)/scale%force
         if (scale%coupling > 0.0_wp) scale%gain = reversal_gain*min(1.0_wp, scale%across*result%grid%dx*result%grid%dy &
            & *turned_round(result, ceiling(narrow*scale%across))/scale%force)
      end if
      scale%is_moment_alone = problem%n_forces == 2
      scale%order = normal_order
      if (problem%motion == motion%steady_rolling) scale%order = merge(second_order, first_order, order == 2)
      if (problem%motion == motion%steady_rolling .and. order == 2) scale%turning = min(pi, scale%mean_across &
         & *sqrt(result%grid%dx*result%grid%dy*turns(result)/max(scale%force, tiny(extent))))
      scale%steps = problem%motion == motion%transient_rolling
      if (scale%steps) scale%order = merge(second_order, first_order, order == 2)
      if (scale%steps) scale%step = result%dq/result%grid%dx
      ! a step in time is longer than some elements and shorter than others; a layer adds a length of its own
      scale%clean = (problem%motion /= motion%transient_rolling .or. order == 2) .and. .not. problem%model%layer > 0.0_wp
      ! tractions are singular at edges that are given
      if (problem%motion == motion%shift) scale%clean = .not. any(problem%h > excluded_threshold)
      if (allocated(problem%thermal)) then
         if (problem%thermal%source == heat_source%established) scale%heat_order = counted_twice
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

   !> Noise of the undeformed distance along x, where contact has a part [mm]: root of the mean product of third differences of
   !> neighbours, whose signs alternate; zero for what is smooth, as these have the same sign, and for waves of a few elements, as
   !> those of next neighbours do not
   pure real(wp) function alternation(h, division) result(noise)
      !> [mm], and states of the elements; shape (mx, my)
      real(wp), intent(in) :: h(:, :)
      integer, intent(in) :: division(:, :)
      !> Product of third differences of next neighbours over that of neighbours, for white noise
      real(wp), parameter :: ratio = 0.4_wp
      real(wp) :: third(3), alike(2)
      integer :: ix, iy, n

      n = 0
      alike = 0.0_wp
      do iy = 1, size(h, 2)
         do ix = 2, size(h, 1) - 4
            if (all(division(ix - 1:ix + 4, iy) < element%adhesion)) cycle
            if (any(h(ix - 1:ix + 4, iy) > excluded_threshold)) cycle
            third = h(ix + 2:ix + 4, iy) - 3.0_wp*(h(ix + 1:ix + 3, iy) - h(ix:ix + 2, iy)) - h(ix - 1:ix + 1, iy)
            alike = alike + third(1)*[-third(2), third(3)/ratio]
            n = n + 1
         end do
      end do
      noise = 0.0_wp
      if (n > 0) noise = sqrt(max(0.0_wp, minval(alike)/n))
   end function alternation
end module contact_patch_error_scales
