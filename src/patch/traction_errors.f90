!> Errors of the tangential forces, the moment and the creepages, estimated from the differences between a solution and that with
!> elements three times as long
!>
!> For the orders, and the lower bounds of errors, see doc/theory/errors.md.
module contact_patch_traction_errors
   use contact_base_kinds, only : wp
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_kinds, only : is_first, is_long_step, is_second, is_turning, is_unseen, order_of, part_of, &
      & sliding_part, trust_in, trust_in_first, trusted, usual_ratio
   use contact_patch_error_scales, only : first_order, normal_order, resolved, scale_type, unseen
   use contact_patch_quantities, only : error_law, error_scale, total
   use contact_patch_step_errors, only : force_error
   implicit none (type, external)
   private

   public :: bound_friction, by_heat, centred, coupled_friction_floor, errors_in_sliding, friction_floor, growth_of_force, &
      & rough_floor, traction_error, unrelaxed

   !> Rough surfaces, whose heights between element centres no level contains: factors of the standard deviation of heights over the
   !> approach, in normal force and approach, and in forces; of rough profiles of tests/stability/hard_wheels.py, seeds 1 to 3
   real(wp), parameter :: rough_floor(2) = [0.3_wp, 0.06_wp]
   !> Pressures of unlike bodies cause tractions at the leading edge: factor of K k n^-1 in forces with the second-order scheme,
   !> with k = K over the coefficient of friction, at most 1, see doc/theory/second_order.md
   real(wp), parameter :: coupled_friction_floor = 0.15_wp
   !> If these tractions reach the bound next to adhesion, the slip zone at the leading edge is narrower than an element: factor of
   !> k^3 times the root of the fraction in adhesion, times n^-1; of unlike bodies with seed 8101
   real(wp), parameter :: hidden_slip = 0.5_wp
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
   !> The same of forces in steady rolling by the first order unless most of the contact slides: about a third of the usual error
   !> (seeds 81001, 84001, 90001 and 90005, and wheels with seeds 85001, 90101 and 90102)
   real(wp), parameter :: adhesive_floor = 0.15_wp
   !> The same, about the usual error, where the coarse level has no elements in adhesion and shows nothing of it (seeds 90103 and
   !> 97001)
   real(wp), parameter :: lost_floor = 0.35_wp
   !> Order of forces in rolling by the second order, with jitter (same seeds); power and energy have that of the scales
   real(wp), parameter :: force_order = 1.8_wp
   !> Lower bound of the part that sticks for moments by the second order: errors of pressures remain in full sliding (same seeds)
   real(wp), parameter :: least_adhesion = 0.25_wp
   !> Moments by the second order: an error of the position of forces along the longer side has that arm, and moments are relative
   !> to the radius of the area. Mean root of the ratio of the sides in the contacts of the bounds, with the logarithms of semi-axes
   !> from 1 to 8 mm equally probable: exp(log(8)/6). Errors over n^-2 of 402 contacts increase with the power 0.8 to 1.3 of the
   !> root, those of forces with 0 (seeds 99711 to 99714)
   real(wp), parameter :: usual_slender = 1.41_wp
   !> Creepages that are found for prescribed forces: factor of the root of the fraction in adhesion times n^-2 in addition to that
   !> of forces, since a small change of a force near zero or near the bound needs a larger one of the creepage (seeds 31001, 31002
   !> and 31004)
   real(wp), parameter :: creepage_floor = 0.3_wp
   !> Range of the part of the bound that is used, for the ratio of errors of creepages to those of forces
   real(wp), parameter :: least_used = 0.05_wp, most_used = 0.99_wp
   !> General error of a single layer in rolling, whose slip has a length of its own: factor of n^-1 (seed 4001)
   real(wp), parameter :: layer_floor = 0.3_wp
   !> Elements that do not resolve the relaxation of viscoelastic bodies: factor of n^-1, by order (seeds 8101 and 8103; 31003)
   real(wp), parameter :: relaxing_floor(2) = [0.05_wp, 0.07_wp]
   !> Part of the general errors that moments have where both forces are prescribed, by the second order; of random contacts (seed
   !> 3101)
   real(wp), parameter :: moment_alone = 0.5_wp
   !> The first order in steady rolling, of random contacts (seeds 71002, 71003 and 72001). Tractions in adhesion are displaced
   !> along the rolling direction: factor of an element, an arm of the lateral force, times the root of the fraction in adhesion.
   !> Tractions of different directions cause errors in sliding as well: factor of the part of the bound that cancels, a lower
   !> bound of the fraction in adhesion
   real(wp), parameter :: displaced = 0.08_wp, turned_share = 0.35_wp
   !> Lateral creepage for a prescribed force by the first order in steady rolling with spin: tractions are displaced along the
   !> rolling direction, where the spin has another velocity. The error is 0.03 to 0.4, in the median 0.14, of the change along a
   !> step; half of that, of 46 contacts (kind forces, seed 99901)
   real(wp), parameter :: displaced_spin = 0.07_wp
   !> Forces and moment in full sliding, where the error of first order is known: its part that remains, as a change of direction
   !> changes the slip as well; lower bound, factor of n^-2, for contacts in which slip has the same direction everywhere. Of wheels
   !> (seed 62001) and contacts (seed 99411)
   real(wp), parameter :: turned_part = 0.8_wp, sliding_floor = 0.0125_wp
   !> Moment in full sliding: factor of n^-2 and of the ratio of the error of the normal problem to the general one, as the centre
   !> of the pressures has an error of that kind; about a third of that of the approach. Of contacts of seeds 99301 and 99302
   real(wp), parameter :: displaced_centre = 0.045_wp
   !> Forces with the second-order scheme if friction decreases with slip: factor of its relative deviations times n^-2; if the
   !> direction of slip turns: of its turn across the contact times n^-2 (seeds 31001 and 31002)
   real(wp), parameter :: falling_floor = 5.0_wp, turning_floor = 0.1_wp
   !> FX and FY of steady rolling with the second order. Where a part of the contact adheres their error hardly depends on its size:
   !> 0.08 to 0.3 n^-2, in the median 0.13, from 1 to 90 % in adhesion. The lower bound of half of it, as the fraction in adhesion
   !> for which the general error is that; fraction in adhesion from which on this holds. In full sliding only the direction of slip
   !> has errors: 0.01 to 0.16 t n^-2 in 32 contacts with a turn t from 0.05 to pi, in the median 0.05; ratio of the bound to that
   !> with adhesion. Of contacts of seed 99712
   real(wp), parameter :: usual_adhesion = 1.0_wp/3.0_wp, small_adhesion = 0.02_wp, turning_slide = 0.4_wp
   !> Full sliding: part by which forces are shorter, factor of n^-2 and of the part of the bound that cancels, about half of the
   !> usual error; what is added to that part and to the turn for profiles and positions, and to the former in the moment by the
   !> first order (wheels of seed 9981). Moment by the second order of patches of wheel and rail: factor of n^-2 and of the part
   !> that cancels; part that FX has in it by the centre of pressures across the track; relative error of the place of pressures
   !> over that of the approach by details of the profiles. Of wheels of any profiles (seeds 411 to 413)
   real(wp), parameter :: shortened = 0.025_wp, least_turn = 0.02_wp, least_first = 0.06_wp, sliding_moment = 0.25_wp, &
      & centre_share = 0.05_wp, moved_pressures = 0.5_wp
   !> The same moment: slip is smallest at the leading edge, where its direction turns most. Factor of the change of tractions from
   !> the leading elements to the next ones, whose arm is the radius; with the above half of the usual error of 453 sliding patches
   !> (ordinary wheels of seeds 71001 to 71003)
   real(wp), parameter :: leading_share = 0.6_wp
   !> The second order where a part adheres: fraction in adhesion from which on the turn of directions has its full effect, chosen;
   !> of few elements, bound across the force over that of many (seeds 411 to 413)
   real(wp), parameter :: much_adhesion = 0.2_wp, few_across = 0.7_wp
   !> Factor of the lower bounds of few elements if the error by the width of rows is computed, chosen; exponent for errors of rows
   !> on the columns of the coarse level, see trusted (seeds 411 to 413)
   real(wp), parameter :: known_rows = 0.4_wp, rows_trust = 0.5_wp
   !> Change of the approach by details between rows up to which profiles may be smooth; rough ones turn patches as well. Chosen
   !> between wheels of any profiles (seeds 411 to 413: 0.05) and a rough rail (seed 88202 of tests/stability/hard_wheels.py: 0.17)
   real(wp), parameter :: smooth_details = 0.05_wp
   !> Turn of directions over their standard deviation, if they change uniformly across the contact
   real(wp), parameter :: uniform_turn = sqrt(12.0_wp)
   !> Grids of patches of wheel and rail are centred along the track: ratio of their errors by the second order to those of grids at
   !> any offset, fitted to wheels of any profiles and confirmed by those of doc/validation/accuracy_estimates.md
   real(wp), parameter :: centred = 0.75_wp
   !> Full sliding, where the direction turns by d from element to element: its mean over an element is shorter than at the centre,
   !> by d^2/24
   real(wp), parameter :: averaged = 1.0_wp/24.0_wp
   !> Part of the error of the previous step that tractions at a point keep in a step of transient rolling, as those that reach the
   !> bound lose it. Chosen between contacts 286 of seed 95002, order 2, and 394 of seed 99711, order 1
   real(wp), parameter :: kept_share = 1.0_wp/3.0_wp
   !> Line contact in rolling: factor of n^-2, by order. Near full sliding both levels may lose the same elements in adhesion; of
   !> Carter's solution at 20 to 99.5 % of the friction bound, 17 to 101 elements
   real(wp), parameter :: line_floor(2) = [1.5_wp, 0.25_wp]

contains

   !> Error of a force, moment or creepage by the levels, and its lower bound
   pure subroutine bound_friction(row, difference, unit, scale, e, floor)
      !> Total of the finer level, with law and scale
      type(total), intent(in) :: row
      !> Difference between the levels, and reference value of the relative error, in its unit
      real(wp), intent(in) :: difference, unit
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Error by the levels in its unit, and lower bound relative to the reference value [-]
      real(wp), intent(out) :: e, floor
      real(wp) :: part, adhesion, heat, largest, turned
      logical :: is_force, is_moment

      is_force = row%law == error_law%friction
      is_moment = row%scale == error_scale%moment
      if (is_force .and. (scale%has_turned .or. (is_turning(scale) .and. (scale%in_pair .or. .not. is_moment)))) then
         call bound_sliding(row, difference, unit, scale, e, floor)
         return
      end if
      part = part_of(scale, merge(force_order, order_of(scale), scale%order > first_order .and. order_of(scale) < normal_order))
      if (is_unseen(scale)) part = 0.0_wp
      e = part*difference
      if (is_long_step(scale)) e = force_error(difference/max(unit, tiny(unit)), scale%in_step, scale%mean_across, &
         & .not. is_force)*unit
      heat = by_heat(scale, part, difference, unit)
      ! in full sliding the moment has the error of the centre of pressures, which forces do not have
      largest = merge(scale%forces, scale%friction, is_turning(scale) .and. .not. is_moment)
      if (is_force) e = max(e, other_component*part*largest*unit)
      adhesion = scale%adhesion
      if (is_force .and. .not. is_moment .and. is_second(scale)) then
         adhesion = usual_adhesion*min(1.0_wp, scale%sticking/small_adhesion)
         if (scale%coupling > 0.0_wp .or. scale%relaxation > 0.0_wp) adhesion = max(adhesion, scale%adhesion)
      end if
      if (is_moment .and. scale%order > first_order) adhesion = max(least_adhesion, adhesion)
      if ((is_force .or. scale%is_moment_alone) .and. is_first(scale)) adhesion = max(adhesion, turned_share*scale%cancelled)
      floor = driven_floor(scale, adhesion)
      if (is_second(scale) .and. is_force .and. .not. is_moment) floor = along_force(row, scale)*floor
      turned = turning_floor*scale%turning/scale%squared
      ! in sliding less, with a continuous change
      if (is_second(scale) .and. .not. is_moment) turned = turned*(turning_slide + (1.0_wp - turning_slide) &
         & *min(1.0_wp, scale%sticking/much_adhesion))
      ! independent errors
      floor = hypot(floor, turned)
      if (is_force .and. scale%rows%known) floor = known_rows*floor
      if (scale%in_pair .and. is_second(scale)) floor = centred*floor
      if (is_moment .and. scale%order > first_order .and. .not. (scale%is_line .or. scale%in_pair)) &
         & floor = floor*scale%slender/usual_slender
      if (scale%is_moment_alone .and. is_force) floor = floor*merge(sqrt(min(1.0_wp, scale%used)), moment_alone, is_first(scale))
      if (is_moment .and. is_first(scale)) floor = max(floor, displaced*sqrt(scale%sticking)*scale%arm)
      if (scale%is_moment_alone .and. .not. is_force .and. is_first(scale)) &
         & floor = floor*max(1.0_wp, change_of_creepage(scale%used))
      if (row%name == "ceta" .and. is_first(scale)) floor = max(floor, displaced_spin*scale%spin_step)
      if (.not. is_force .and. scale%jumps) floor = floor + creepage_floor*sqrt(scale%adhesion)/scale%squared
      if (scale%jumps) then
         e = unit*trusted(e/max(unit, tiny(unit)), floor, trust_in(scale))
      else if (is_force .and. is_first(scale)) then
         e = unit*trusted(e/max(unit, tiny(unit)), usual_ratio*floor, trust_in_first(scale))
      end if
      if (is_force .and. scale%rows%known) e = hypot(e, by_rows(rows_of(row, scale), floor, scale)*unit)
      ! not with the exponent: it does not jump with the offset of the grid
      e = e + heat
      if (is_force) floor = max(floor, scale%reversal*share_of_reversal(scale))
      floor = max(floor, force_of_details(scale))
      if (scale%is_line .and. scale%order < normal_order) floor = max(floor, &
         & merge(line_floor(2), line_floor(1), scale%order > first_order)/scale%across**2)
   end subroutine bound_friction

   !> Relative change of the creepage per change of the force over the friction bound
   pure real(wp) function change_of_creepage(used) result(ratio)
      !> Part u of the friction bound that is used
      real(wp), intent(in) :: used
      real(wp) :: u

      u = min(max(used, least_used), most_used)
      ratio = 1.0_wp/(u*growth_of_force(u))
   end function change_of_creepage

   !> Relative change of the tangential force over that of the creepage, by the theory of Vermeulen and Johnson: the creepage is in
   !> proportion to 1 - (1 - u)^(1/3)
   pure real(wp) function growth_of_force(used) result(growth)
      !> Part u of the friction bound that is used, above 0 and at most 1
      real(wp), intent(in) :: used
      real(wp) :: root

      root = (1.0_wp - used)**(1.0_wp/3.0_wp)
      growth = 3.0_wp*root**2*(1.0_wp - root)/used
   end function growth_of_force

   !> Error of forces by heights that no level contains, of rough surfaces and between rows of elements, over the friction bound
   pure real(wp) function force_of_details(scale) result(floor)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      ! of few rows; more show such details, which change approach and forces in the same ratio. Computed rows include most of them
      floor = 0.0_wp
      if (scale%across < resolved) floor = merge(1.0_wp, 1.0_wp/rough_floor(1), scale%rows%known)*rough_floor(2)*scale%hidden
      floor = max(floor, rough_floor(2)*scale%roughness)
   end function force_of_details

   !> Change of the approach by heights that no level contains, of few rows also by those between rows of elements [-]
   pure real(wp) function details_of(scale) result(details)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      details = scale%roughness
      if (scale%across < resolved .and. .not. scale%rows%known) details = max(details, scale%hidden)
   end function details_of

   !> Error of FX and FY in full sliding with spin by that of the centre of the pressures of few elements: the spin has another
   !> velocity there, which turns the slip. Over the friction bound
   pure real(wp) function centre_of_few(scale) result(floor)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      floor = 0.0_wp
      if (scale%across < resolved) &
         & floor = scale%swing*displaced_centre*scale%irregular/scale%across**2
   end function centre_of_few

   !> Error by few rows of elements, less if it scatters
   elemental real(wp) function by_rows(value, floor, scale) result(e)
      !> Computed error, and lower bound
      real(wp), intent(in) :: value, floor
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      e = abs(value)
      if (scale%rows%scatters) e = trusted(e, floor, rows_trust)
   end function by_rows

   !> Error of a force or moment by few rows of elements, relative to its scale
   pure real(wp) function rows_of(row, scale) result(e)
      !> Force or moment
      type(total), intent(in) :: row
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      select case (row%name)
      case ("fx", "fx_rel")
         e = scale%rows%value(1)
      case ("fy", "fy_rel")
         e = scale%rows%value(2)
      case default
         e = scale%rows%value(3)
      end select
   end function rows_of

   !> Factor of the bound of FX or FY by the second order where a part adheres. Few elements do not show their error, which is that
   !> of the area in contact, thus mostly along the force
   pure real(wp) function along_force(row, scale) result(factor)
      !> Force
      type(total), intent(in) :: row
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      factor = 1.0_wp
      if (scale%across >= resolved) return
      factor = norm2([unseen(scale), few_across]*scale%direction)
      if (any(row%name == ["fy    ", "fy_rel"])) factor = norm2([few_across, unseen(scale)]*scale%direction)
   end function along_force

   !> Errors of the force in full sliding of like elastic bodies in steady rolling, over the friction bound: across it, and along it
   !>
   !> Errors of the directions of slip turn the force, and shorten it where these directions differ.
   pure function errors_in_sliding(scale) result(errors)
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      real(wp) :: errors(2), usual(2), turn
      integer :: k

      turn = scale%turning
      ! by the first order, which does not count it, as that of a uniform change across the contact
      if (scale%has_turned) turn = uniform_turn*scale%cancelled
      usual = [turning_slide*turning_floor*(least_turn + turn), &
         & unseen(scale)*shortened*(least_turn + scale%cancelled)]*scale%irregular/scale%squared
      if (scale%in_pair .and. scale%across >= resolved) usual = centred*usual
      usual(1) = max(usual(1), centre_of_few(scale))
      if (scale%rows%known) usual = known_rows*usual
      if (scale%has_turned) then
         if (.not. scale%in_pair) usual(1) = max(usual(1), sliding_floor/scale%squared)
         errors = hypot(turned_part*scale%turned(1:2), scale%not_turned(1:2))
      else
         errors = part_of(scale, normal_order)*abs(scale%turned_force)
         do k = 1, size(errors)
            errors(k) = trusted(errors(k), usual(k), trust_in(scale))
         end do
      end if
      if (scale%rows%known) errors = hypot(errors, by_rows(scale%turned_rows, usual, scale))
      ! pressures in other places matter where directions differ
      errors = max(errors, usual, [0.0_wp, averaged*scale%turns], &
         & moved_pressures*details_of(scale)*scale%cancelled*[1.0_wp, scale%cancelled], &
         & rough_floor(2)*max(scale%roughness, scale%hidden - smooth_details))
   end function errors_in_sliding

   !> Error of a force or moment in full sliding of like elastic bodies in steady rolling, and its lower bound
   pure subroutine bound_sliding(row, difference, unit, scale, e, floor)
      !> Total of the finer level
      type(total), intent(in) :: row
      !> Difference between the levels, and reference value of the relative error, in its unit
      real(wp), intent(in) :: difference, unit
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Error in its unit, and lower bound relative to the reference value [-]
      real(wp), intent(out) :: e, floor
      real(wp) :: errors(2)

      errors = errors_in_sliding(scale)
      floor = scale%reversal*share_of_reversal(scale)
      if (row%scale == error_scale%moment) then
         if (scale%in_pair) then
            floor = unseen(scale)*sliding_moment*(merge(least_first, least_turn, scale%has_turned) &
               & + scale%cancelled + centre_share*scale%direction(1)) &
               & *scale%irregular/scale%squared
            if (scale%across >= resolved) floor = centred*floor
            ! independent errors
            floor = hypot(floor, leading_share*scale%leading)
            if (scale%rows%known) floor = known_rows*floor
            floor = max(floor, rough_floor(2)*details_of(scale))
         else
            floor = max(other_component*maxval(errors), displaced_centre*scale%irregular/scale%across**2)
         end if
         if (scale%has_turned) then
            e = hypot(turned_part*scale%turned(3), scale%not_turned(3))*unit
         else
            e = unit*trusted(part_of(scale, normal_order)*difference/max(unit, tiny(unit)), floor, trust_in(scale))
         end if
         if (scale%rows%known) e = hypot(e, by_rows(scale%rows%value(3), floor, scale)*unit)
      else
         ! the error of the direction is across the force
         if (any(row%name == ["fx    ", "fx_rel"])) errors = errors(2:1:-1)
         e = unit*norm2(errors*scale%direction)
      end if
      e = e + by_heat(scale, part_of(scale, normal_order), difference, unit)
   end subroutine bound_sliding

   !> Error of forces as a fraction of the force of an element at which slip reverses
   pure real(wp) function share_of_reversal(scale) result(share)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      share = reversal_share
      if (scale%coupling > 0.0_wp .or. scale%order <= first_order) return
      share = merge(reversal_by_spin, reversal_in_shifts, scale%order < normal_order)
   end function share_of_reversal

   !> Additional error if friction follows temperatures, whose errors have another order
   pure real(wp) function by_heat(scale, part, difference, unit) result(e)
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Ratio that is included already
      real(wp), intent(in) :: part
      !> Difference between the levels, and reference value of the relative error
      real(wp), intent(in) :: difference, unit

      e = max(0.0_wp, 1.0_wp/(coarsening**scale%heat_order - 1.0_wp) - part)*min(difference, scale%warmed*unit)
   end function by_heat

   !> Typical relative error of tangential forces with this number of elements
   pure real(wp) function friction_floor(scale, adhesion, in_power) result(floor)
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Fraction of the elements that sticks, with a lower bound [-]
      real(wp), intent(in) :: adhesion
      !> Is it that of the forces as it appears in frictional power?
      logical, intent(in) :: in_power
      real(wp) :: least

      if (scale%order <= first_order) then
         floor = merge(rolling_floor(1), layer_floor, scale%clean .or. scale%steps)
         least = 0.0_wp
         if (is_first(scale) .and. .not. (in_power .or. scale%is_moment_alone)) then
            ! bodies that relax have such errors in sliding as well
            if (scale%relaxation > 0.0_wp) floor = adhesive_floor
            floor = adhesive_floor + sliding_part(scale%sticking)*(floor - adhesive_floor)
            least = merge(adhesive_floor, lost_floor, scale%coarse_sticking > 0.0_wp)*sqrt(scale%sticking/adhesion)
         end if
         floor = max(floor, least)/scale%mean_across
      else
         floor = merge(rolling_floor(2), shift_floor, scale%order < normal_order)
         floor = merge(balance_floor/scale%mean_across**2, floor/scale%squared, in_power)
      end if
      floor = max(sqrt(adhesion)*floor, sqrt(scale%adhesion)*unrelaxed(scale))
      if (scale%order > first_order) floor = hypot(floor, falling_floor*scale%falling/scale%squared)
      if (is_unseen(scale)) floor = floor*scale%irregular
   end function friction_floor

   !> First-order contribution of elements that do not resolve the relaxation of the bodies, over the root of the fraction in
   !> adhesion
   pure real(wp) function unrelaxed(scale) result(floor)
      !> See type scale_type
      type(scale_type), intent(in) :: scale

      floor = merge(relaxing_floor(2), relaxing_floor(1), scale%order > first_order)*scale%relaxation/scale%mean_across
   end function unrelaxed

   !> The same with what pressures of unlike bodies bring in, of first order by both schemes
   pure real(wp) function driven_floor(scale, adhesion) result(floor)
      !> See type scale_type
      type(scale_type), intent(in) :: scale
      !> Fraction of the elements that sticks, with a lower bound [-]
      real(wp), intent(in) :: adhesion

      floor = friction_floor(scale, adhesion, .false.)
      if (scale%order >= normal_order) return
      floor = max(floor, coupled_friction_floor*scale%coupling*scale%driven/scale%across)
      if (scale%has_edge_slip) then
         floor = max(floor, scale%edge_slip)
      else
         floor = max(floor, hidden_slip*scale%driven**3*sqrt(scale%sticking)/scale%mean_across)
      end if
   end function driven_floor

   !> Relative error of tangential tractions in cases in which levels show little of it at a single point: in sliding and transient
   !> rolling, and if friction follows temperatures; zero otherwise
   pure real(wp) function traction_error(scale) result(e)
      !> See type scale_type; with differences of the levels
      type(scale_type), intent(in) :: scale

      e = scale%warmed/(coarsening**scale%heat_order - 1.0_wp)
      if (.not. scale%used > 0.0_wp) return
      ! errors of forces are relative to the friction bound, of which the tractions use a part
      if (is_unseen(scale)) e = e + driven_floor(scale, scale%adhesion)/scale%used
      ! tractions that reach the bound within the step lose the error they had
      if (is_long_step(scale)) e = e + ((1.0_wp - kept_share)*force_error(scale%friction, scale%adhesion, scale%mean_across) &
         & + kept_share*force_error(scale%friction, scale%in_step, scale%mean_across))/scale%used
   end function traction_error

end module contact_patch_traction_errors
