!> Rules of the search for a prescribed accuracy: cases in which it is impossible, the first grid, the next one, and the tolerance
!>
!> Sizes are given as the number of elements across the contact. An error of C n^-p requires n = (C/error)^(1/p); C of the first
!> grid is a typical value, later it follows from the estimate of the previous grid. See doc/theory/accuracy.md.
module contact_cases_accuracy_plan
   use contact_base_choices, only : estimate_choice, force_control, grid_form, heat_source, is_simplified, kernel_model, &
      & material_model, motion, planform_choice, pressure_model, slip_source, time_link, variation
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : case_limits
   use contact_base_memory, only : bytes_per_element
   use contact_cases_distance, only : distance_form
   use contact_cases_geometry, only : solve_hertz
   use contact_cases_grid_inputs, only : largest_grid
   use contact_cases_spec, only : case_spec, grid_spec
   use contact_elastic_material, only : combine, combined_material
   use contact_friction_new_law, only : friction_model, is_varying_law
   use contact_patch_result, only : hertz_result
   use contact_patch_traction_errors, only : coupled_friction_floor
   use contact_subsurface_points, only : point_selection
   implicit none (type, external)
   private

   public :: accuracy_law, acting_order, contact_sides, expected_across, expected_law, finer_across, first_across, &
      & first_order_alone, is_accuracy, is_near_enough, largest_accuracy, most_elements, most_levels, not_converged, &
      & observed_order, prepare_level, refuse_case, shorten_aspect, sides_of_window, smallest_accuracy, smaller_tolerance, &
      & solver_tolerance, stopping_share

   !> Range of accuracies that can be prescribed
   real(wp), parameter :: smallest_accuracy = 1.0e-6_wp, largest_accuracy = 0.1_wp
   !> Reason of an accuracy that is not reached because solvers end before their tolerance, on two grids
   character(len=*), parameter :: not_converged = "iterations did not converge"
   !> Maximum number of grids of a search
   integer, parameter :: most_levels = 8
   !> Maximum number of elements of a grid without a prescribed limit: some seconds, and 0.4 GB; chosen
   integer(long), parameter :: usual_limit = 250000_long
   !> Factor of the number of elements across if a grid has no estimate, because contact is too few elements wide or was missed
   real(wp), parameter :: without_estimate = 2.5_wp

   !> Typical estimate for n elements across the contact: factor times n^-order; order by which estimates of one contact decrease
   !> from grid to grid; lower bound of estimates, bound/n; part of the accuracy that estimates must meet, below 1 where they are
   !> often smaller than the error, above 1 where they rarely are
   type :: accuracy_law
      real(wp) :: factor = 0.0_wp, order = 2.0_wp, falls = 2.0_wp, bound = 0.0_wp, share = 1.0_wp
   end type accuracy_law
   !> Forces in steady rolling by the first and by the second order, and all other results; from tests/accuracy: upper quartiles of
   !> estimates, and medians of the orders of those that are too large on the first grid (seed 7101; factors of the second order
   !> without spin, and of shifts and pressures: 31001 to 31004 and 41001)
   type(accuracy_law), parameter :: first_order = accuracy_law(0.16_wp, 1.0_wp, 1.0_wp), &
      & second_order = accuracy_law(0.21_wp, 2.0_wp, 2.1_wp), normal_order = accuracy_law(0.22_wp, 2.0_wp, 2.0_wp)
   !> The second order where forces are prescribed, where friction falls with slip, of unlike bodies, of bodies that relax (the same
   !> seeds), and with an elastic layer (kinds layer and layer_spin of seed 77001)
   type(accuracy_law), parameter :: by_forces = accuracy_law(0.45_wp, 2.0_wp, 2.1_wp), &
      & falling = accuracy_law(0.32_wp, 2.0_wp, 2.1_wp, share=1.1_wp), unlike = accuracy_law(0.21_wp, 2.0_wp, 1.2_wp), &
      & relaxing = accuracy_law(0.33_wp, 2.0_wp, 1.5_wp, share=1.15_wp), &
      & layered = accuracy_law(0.33_wp, 2.0_wp, 1.6_wp, share=0.7_wp)
   !> Spin adds this factor for each radian by which the direction of slip turns across the contact; turn if spin is one times the
   !> creepage, its maximum, and turn if creepages or spin follow from the solution [rad] (the same seeds)
   real(wp), parameter :: by_turn = 0.1_wp, turn_of_equal = 2.0_wp, largest_turn = 3.1_wp, usual_turn = 1.0_wp
   !> Unlike bodies: this factor times the ratio of the difference parameter to the coefficient of friction, at most 1; medians of
   !> estimates on 13 to 20 elements (seed 71002 of errors.py)
   real(wp), parameter :: by_difference = 0.4_wp
   !> Value of this ratio from which on errors of unlike bodies decrease with the order of `unlike`; at 0 with that of like bodies;
   !> chosen
   real(wp), parameter :: mostly_driven = 0.5_wp
   !> Transient rolling in steps of a fixed length, errors of which fall with powers of a half to one
   type(accuracy_law), parameter :: in_steps = accuracy_law(0.39_wp, 0.75_wp, 0.75_wp)
   !> Friction that follows temperatures in which the heat of an element is counted twice; of examples/sliding_temperature
   type(accuracy_law), parameter :: heated = accuracy_law(0.033_wp, 0.5_wp, 0.5_wp)

   !> Minimum and maximum number of elements across of the first grid. Fewer give no information on the error; a first grid of more
   !> may waste time
   real(wp), parameter :: least_across = 11.0_wp, most_across = 90.0_wp, most_across_first_order = 45.0_wp
   !> Number of elements across of the first grid relative to the expected number, chosen for the minimum total time of both grids;
   !> number of elements across below which the expected number itself is used, since a second grid takes longer than a smaller
   !> first one saves (seeds 99601 and 99602)
   real(wp), parameter :: first_share = 0.75_wp, quick_across = 28.0_wp
   !> Fraction of the accuracy that the next grid is designed for; fraction at which it is regarded as reached, since estimates may
   !> be too small. Of seeds 99601 and 99602, 312 contacts of twelve kinds
   real(wp), parameter :: aim = 0.65_wp, enough = 0.8_wp
   !> If the error predicted from the previous grid is not larger, both are samples of one error. Their mean is used, in logarithms,
   !> with this weight of the previous grid; fraction of the accuracy at which the mean is sufficient, and maximum fraction for the
   !> estimate alone; of seeds 7101, 88001, 99601 and 99602
   real(wp), parameter :: weight_before = 0.3_wp, enough_of_both = 0.88_wp, enough_alone = 0.9_wp
   !> Minimum and maximum factor of the number of elements across from one grid to the next; chosen
   real(wp), parameter :: least_factor = 1.1_wp, largest_factor = 5.0_wp
   !> Weight of the error predicted from the previous grid: differences of levels may be small by chance
   real(wp), parameter :: share_before = 0.42_wp
   !> Tolerance of the solvers relative to the accuracy, of which a fraction of 0.3 appears in forces; its bounds
   real(wp), parameter :: eps_share = 0.1_wp, largest_eps = 1.0e-3_wp, smallest_eps = 1.0e-8_wp
   !> Maximum fraction of the accuracy for the error of stopped iterations; above it the tolerance is reduced. Chosen
   real(wp), parameter :: stopping_share = 0.25_wp
   !> Coefficient of friction in the expected error of unlike bodies if it is not constant
   real(wp), parameter :: usual_friction = 0.3_wp
   !> Maximum ratio of the sides of elements
   real(wp), parameter :: largest_aspect = 6.0_wp
   !> Fraction of a given potential contact, along each side, that contact is assumed to cover; the same for profiles, which are
   !> given with more space
   real(wp), parameter :: usual_share = 0.75_wp, share_of_profile = 0.52_wp

contains

   !> Refuse a case whose accuracy cannot be reached by choosing a grid, with the reason
   subroutine refuse_case(spec, error)
      !> Case with an accuracy
      type(case_spec), intent(in) :: spec
      !> Allocated if the case is refused
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: why
      character(len=12) :: text

      if (.not. is_accuracy(spec%iteration%accuracy)) then
         write(text, "(ES9.2)") spec%iteration%accuracy
         call fatal_error(error, "the required accuracy, " // trim(adjustl(text)) // ", is not between 1e-6 and 0.1", &
            & error_kind%input)
         return
      end if
      why = ""
      if (spec%motion == motion%transient_rolling .and. (allocated(spec%wheel_rail) &
         & .or. spec%material_model /= material_model%elastic)) then
         why = "transient rolling of wheels on rails, of bodies that relax, or with a layer: the reliability of its error &
            &estimates was not measured"
      else if (allocated(spec%wheel_rail) .and. spec%motion == motion%shift .and. spec%link /= time_link%initiate) then
         why = "a shift of a wheel that continues the case before: its history is stored on the elements of that case"
      else if (spec%kernel == kernel_model%tabulated) then
         why = "influence coefficients of a file: they belong to one size of elements"
      else if (is_simplified(spec%material_model) .and. spec%motion /= motion%none) then
         why = "simplified theory: its own error is not known"
      else if (all(spec%pressure /= [pressure_model%full, pressure_model%thin_sheet])) then
         why = "pressures by formula: their own error is not known"
      else if (spec%has_plasticity()) then
         why = "a layer that yields"
      else if (spec%has_damping) then
         why = "damping: it needs the forces of the case before"
      else if (spec%slip_source == slip_source%given .and. spec%motion /= motion%none) then
         why = "rigid slip that is given element by element"
      else if (.not. allocated(spec%wheel_rail) .and. spec%grid%needs_geometry() &
         & .and. spec%geometry%planform /= planform_choice%unrestricted) then
         why = "a planform: its border lies within elements, and the error of its place has no estimate"
      else if (spec%variation == variation%by_row .and. .not. allocated(spec%wheel_rail) .and. spec%motion /= motion%none) then
         why = "friction that is given row by row"
      else if (spec%has_stress .and. allocated(spec%subsurface%blocks)) then
         if (any(spec%subsurface%blocks%selection == point_selection%ranges &
            & .or. spec%subsurface%blocks%selection == point_selection%lists)) why = &
            & "stresses below columns and rows of the grid: coordinates, or all elements, do"
      end if
      if (why /= "") call fatal_error(error, "an accuracy is required, but the grid cannot be chosen with " // why, &
         & error_kind%unsupported)
   end subroutine refuse_case

   !> Is a number a valid accuracy, or 0 for none?
   pure logical function is_accuracy(number)
      !> Largest relative error of the forces [-]
      real(wp), intent(in) :: number

      is_accuracy = abs(number) <= 0.0_wp .or. (number >= smallest_accuracy .and. number <= largest_accuracy)
   end function is_accuracy

   !> Set the choices common to all levels
   pure subroutine prepare_level(eps, level)
      !> Tolerance of the solvers
      real(wp), intent(in) :: eps
      !> The case; its elements are set by the caller
      type(case_spec), intent(inout) :: level

      level%iteration%accuracy = 0.0_wp
      level%iteration%eps = eps
      level%iteration%order = acting_order(level)
      level%estimates_errors = .true.
      level%has_stress = .false.
      ! each level is independent of previous cases
      level%link = time_link%initiate
      level%estimate = estimate_choice%fresh
   end subroutine prepare_level

   !> Order of the scheme: prescribed steps of transient rolling have the length of an element on one grid only
   pure integer function acting_order(spec) result(order)
      type(case_spec), intent(in) :: spec

      order = merge(1, 2, spec%motion == motion%transient_rolling)
   end function acting_order

   !> Typical error of a case before it is solved
   type(accuracy_law) function expected_law(spec) result(law)
      type(case_spec), intent(in) :: spec
      type(combined_material) :: material
      real(wp) :: driven

      law = normal_order
      if (spec%motion == motion%transient_rolling) law = in_steps
      if (spec%motion /= motion%steady_rolling) return
      law = first_order
      if (spec%has_heat .and. spec%heat%source == heat_source%established &
         & .and. spec%friction_law == friction_model%temperature) then
         law = heated
         return
      end if
      if (spec%kernel == kernel_model%piecewise_constant .and. any(spec%material_model == [material_model%elastic, &
         & material_model%viscoelastic, material_model%interfacial_layer]) .and. spec%pressure == pressure_model%full) &
         & law = second_order
      material = combine(spec%material%poiss, spec%material%gg)
      driven = min(1.0_wp, abs(material%ak)/max(expected_friction(spec), tiny(driven)))
      if (law%order > first_order%order) then
         if (is_varying_law(spec%friction_law)) law = falling
         if (spec%force /= force_control%creepages) law = by_forces
         if (material%coupled()) law = unlike
         if (spec%material_model == material_model%viscoelastic) law = relaxing
         if (spec%material_model == material_model%interfacial_layer) law = layered
         law%factor = law%factor + by_turn*expected_turn(spec)
         if (material%coupled()) then
            law%factor = law%factor + by_difference*driven
            law%falls = second_order%falls + (unlike%falls - second_order%falls)*min(1.0_wp, driven/mostly_driven)
         end if
      end if
      if (material%coupled()) law%bound = coupled_friction_floor*abs(material%ak)*driven
   end function expected_law

   !> Coefficient of friction of a case with a single constant one, the usual one for others [-]
   pure real(wp) function expected_friction(spec) result(mu)
      type(case_spec), intent(in) :: spec

      mu = usual_friction
      if (spec%friction_law /= friction_model%coulomb .or. .not. allocated(spec%friction%sets)) return
      if (size(spec%friction%sets) == 1) mu = spec%friction%sets(1)%fkin
   end function expected_friction

   !> Turn of the direction of slip across the contact, from creepages and spin [rad]
   real(wp) function expected_turn(spec) result(turn)
      type(case_spec), intent(in) :: spec
      real(wp) :: spin

      turn = usual_turn
      if (allocated(spec%wheel_rail)) return
      spin = abs(spec%kinematics%cphi)*mean_half_side(spec)
      if (spec%force /= force_control%creepages .and. spin > 0.0_wp) return
      turn = 0.0_wp
      if (spin > 0.0_wp) turn = min(largest_turn, turn_of_equal*spin/max(hypot(spec%kinematics%cksi, spec%kinematics%ceta), &
         & tiny(spin)))
   end function expected_turn

   !> Geometric mean of the half sides of the contact before the first solution [mm]; 0 if unknown
   real(wp) function mean_half_side(spec) result(side)
      type(case_spec), intent(in) :: spec
      real(wp) :: sides(2)

      side = 0.0_wp
      if (spec%grid%is_line_contact()) return
      call contact_sides(spec, sides)
      side = 0.5_wp*sqrt(product(sides))
   end function mean_half_side

   !> Sides of the contact before the first solution: of Hertz's ellipse if there is one, otherwise of the usual part of the
   !> potential contact [mm]; 0 if unknown
   subroutine contact_sides(spec, sides)
      type(case_spec), intent(in) :: spec
      !> Along x and y [mm]
      real(wp), intent(out) :: sides(2)
      type(hertz_result), allocatable :: hertz
      type(error_type), allocatable :: error
      type(combined_material) :: material
      type(grid_spec) :: ellipse

      sides = usual_share*sides_of_window(spec%grid)
      if (spec%grid%needs_geometry() .and. spec%geometry%form == distance_form%profile) sides = sides*share_of_profile/usual_share
      ellipse = spec%grid
      if (spec%grid%needs_geometry()) then
         if (spec%geometry%form /= distance_form%quadratic .or. spec%geometry%planform /= planform_choice%unrestricted &
            & .or. any(abs(spec%geometry%b([2, 4, 5, 6])) > 0.0_wp)) return
         if (spec%material_model == material_model%viscoelastic .or. spec%pressure /= pressure_model%full) return
         ellipse%form = grid_form%hertz_curvatures
         ellipse%a1 = spec%geometry%b(1)
         ellipse%b1 = spec%geometry%b(3)
      end if
      material = combine(spec%material%poiss, spec%material%gg)
      call solve_hertz(ellipse, spec%normal, spec%kinematics%fn, spec%kinematics%pen, material%gg, material%nu, hertz, error)
      if (allocated(error) .or. .not. allocated(hertz)) return
      if (.not. min(hertz%aa, hertz%bb) > 0.0_wp) return
      sides = 2.0_wp*[hertz%aa, hertz%bb]
      if (spec%grid%needs_geometry()) sides = min(sides, sides_of_window(spec%grid))
   end subroutine contact_sides

   !> Sides of a given potential contact; 0 if it follows from Hertz's solution
   pure function sides_of_window(grid) result(lengths)
      !> Grid of the case
      type(grid_spec), intent(in) :: grid
      !> Sides [mm]
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

   !> The same for the first-order scheme
   pure type(accuracy_law) function first_order_alone(law) result(lower)
      !> Expected error of the scheme that was not used
      type(accuracy_law), intent(in) :: law

      lower = law
      lower%order = min(law%order, first_order%order)
      lower%falls = min(law%falls, first_order%falls)
   end function first_order_alone

   !> Number of elements across the contact of the first grid
   pure real(wp) function first_across(law, required) result(across)
      !> Expected error
      type(accuracy_law), intent(in) :: law
      !> Accuracy [-]
      real(wp), intent(in) :: required
      real(wp) :: goal

      goal = aim*law%share*required
      across = (law%factor/goal)**(1.0_wp/law%order)
      across = max(min(across, max(quick_across, first_share*across)), law%bound/goal)
      across = min(across, merge(most_across, most_across_first_order, law%order > 1.0_wp))
      across = usual_number(max(least_across, across))
   end function first_across

   !> Number of elements across the contact of the grid that is sufficient for the typical error
   pure real(wp) function expected_across(law, required) result(across)
      !> Expected error
      type(accuracy_law), intent(in) :: law
      !> Accuracy [-]
      real(wp), intent(in) :: required
      real(wp) :: goal

      goal = aim*law%share*required
      across = max(first_across(law, required), (law%factor/goal)**(1.0_wp/law%order), law%bound/goal)
   end function expected_across

   !> Is an estimate small enough? None above the accuracy is, whatever the share
   pure logical function is_near_enough(estimated, expected, required, share)
      !> Estimate of this grid, negative for none; and error predicted from the previous grid, 0 for none [-]
      real(wp), intent(in) :: estimated, expected
      !> Accuracy [-]
      real(wp), intent(in) :: required
      !> Part of the accuracy that estimates must meet, see accuracy_law; default: 1
      real(wp), intent(in), optional :: share
      real(wp) :: goal

      goal = required
      if (present(share)) goal = share*required
      is_near_enough = estimated >= 0.0_wp .and. estimated <= required
      if (.not. is_near_enough .or. max(estimated, share_before*expected) <= enough*goal) return
      is_near_enough = estimated > 0.0_wp .and. expected > 0.0_wp
      if (.not. is_near_enough) return
      is_near_enough = estimated <= enough_alone*goal .and. share_before*expected <= enough*goal &
         & .and. estimated**(1.0_wp - weight_before)*expected**weight_before <= enough_of_both*goal
   end function is_near_enough

   !> Order observed between the estimates of two grids, limited to the range from one to the expected order
   pure real(wp) function observed_order(law, estimated, before, expected) result(order)
      !> Expected error
      type(accuracy_law), intent(in) :: law
      !> Estimates of this grid and of the previous one, not positive for none; and error of this grid predicted from the latter [-]
      real(wp), intent(in) :: estimated, before, expected

      order = law%falls
      if (.not. (min(estimated, expected) > 0.0_wp .and. before > expected)) return
      order = min(law%falls, max(first_order%falls, law%falls*log(before/estimated)/log(before/expected)))
   end function observed_order

   !> Number of elements across the contact that is expected to be sufficient
   pure real(wp) function finer_across(across, estimated, required, order) result(finer)
      !> Number of elements across of the present grid
      real(wp), intent(in) :: across
      !> Its estimate, negative for none [-]
      real(wp), intent(in) :: estimated
      !> Accuracy [-]
      real(wp), intent(in) :: required
      !> Order of the error
      real(wp), intent(in) :: order

      finer = without_estimate
      if (estimated >= 0.0_wp) finer = min(largest_factor, max(least_factor, (estimated/(aim*required))**(1.0_wp/order)))
      finer = usual_number(finer*across)
   end function finer_across

   !> The next number of a series with a fixed ratio: similar cases share plans of transforms and influence coefficients
   pure real(wp) function usual_number(number) result(usual)
      !> Positive
      real(wp), intent(in) :: number
      !> A number of the series, and number of its terms per factor of two
      real(wp), parameter :: first = 10.0_wp, in_octave = 16.0_wp
      !> Tolerance of equality, in steps of the series
      real(wp), parameter :: slack = 0.1_wp

      usual = anint(first*2.0_wp**(ceiling(in_octave*log(number/first)/log(2.0_wp) - slack)/in_octave))
   end function usual_number

   !> Maximum number of elements of the grid of a case
   pure real(wp) function most_elements(limits) result(most)
      !> Limits of the case: elements, memory, time
      type(case_limits), intent(in) :: limits

      most = real(usual_limit, wp)
      if (limits%elements < huge(1_long)) most = real(min(int(largest_grid, long), limits%elements), wp)
      most = min(most, real(limits%bytes, wp)/real(bytes_per_element, wp))
   end function most_elements

   !> Tolerance of the solvers for an accuracy
   pure real(wp) function solver_tolerance(required) result(eps)
      !> Largest relative error of the forces [-]
      real(wp), intent(in) :: required

      eps = min(largest_eps, max(smallest_eps, eps_share*required))
   end function solver_tolerance

   !> A smaller tolerance, bounded by the smallest reasonable one
   pure real(wp) function smaller_tolerance(eps, factor) result(smaller)
      !> Present tolerance, and its factor [-]
      real(wp), intent(in) :: eps, factor

      smaller = min(eps, max(smallest_eps, factor*eps))
   end function smaller_tolerance

   !> Sides of elements for equal numbers of elements along both sides of the contact, with a limited ratio
   pure subroutine shorten_aspect(lengths, across, sides)
      !> Sides of the contact [mm]
      real(wp), intent(in) :: lengths(2)
      !> Number of elements across
      real(wp), intent(in) :: across
      !> Sides of the elements [mm]
      real(wp), intent(out) :: sides(2)

      sides = lengths/across
      sides = min(sides, largest_aspect*minval(sides))
   end subroutine shorten_aspect
end module contact_cases_accuracy_plan
