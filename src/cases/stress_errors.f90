!> Estimated errors of the largest subsurface stresses, from the tractions of both levels
!>
!> Stresses are linear in the tractions: pressures and tangential tractions of the coarser level, applied separately, give the
!> errors of stresses at the point of the largest one, each with its order. The error of second order, with its sign, follows from
!> the differences of the field over one element. Errors of invariants follow from those of the stresses. See doc/theory/errors.md.
module contact_cases_stress_errors
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_quiet_nan, ieee_value
   use contact_base_choices, only : kernel_model, material_model, motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_grid_element_division, only : bounding_box, contact_box
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_error_kinds, only : sliding_part, trusted
   use contact_patch_order, only : order_of_errors
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_subsurface_invariants, only : stress_invariants
   use contact_subsurface_load, only : new_surface_load, surface_load
   use contact_subsurface_points, only : point_set
   use contact_subsurface_stress, only : subsurface_field
   implicit none (type, external)
   private

   public :: estimate_stress_errors

   !> Minimum depth in sides of a coarse element; stresses at smaller depths are those of the steps between elements; chosen
   real(wp), parameter :: least_depth = 0.5_wp
   !> Exponent of the load of a patch in its stresses, by Hertz's theory
   real(wp), parameter :: peak_power = 1.0_wp/3.0_wp
   !> Error of second order: tractions that are constant on elements act like smeared ones, and their values compensate a part of
   !> it. Fraction of sum(h^2/24 d2(stress)/dx2) that remains; median of random contacts in shifts and rolling, 0.3 to 0.45 by kind
   !> and state of sliding (seeds 81001, 84001, 90001 and 90005, and so below). Number of elements along a direction below which
   !> it increases with their inverse, up to all of it: medians of wheels were 1 with fewer than 6, 0.7 with 6 to 10, and 0.35 with
   !> more than 14 (seeds 51601 and 51611)
   real(wp), parameter :: smeared = 0.35_wp, compensating = 16.0_wp
   !> Scatter of this error with the offset of the grid, and largest usual difference of the error by the levels, over it
   real(wp), parameter :: scatter = 0.35_wp, usual_difference = 1.15_wp
   !> Difference of the two errors of pressures, by the levels and of second order: fraction that is added with its sign, as both
   !> are samples, of which the second scatters less (random contacts, seeds 5601 to 5603); fraction of a larger difference, of
   !> pressures that the coarser level does not resolve, whose sign is unknown
   real(wp), parameter :: level_share = 0.25_wp, unresolved = 0.3_wp
   !> Lower bound of the error of second order: factor of the stress over the number of elements in contact, for points at which
   !> the second derivative vanishes; chosen
   real(wp), parameter :: least_curvature = 0.05_wp
   !> Lower bound, for peaks that are not resolved: the error of the largest pressure over the depth in elements to this power, as
   !> elements carry the load of such a peak, so that only its distribution within the width of an element has an error. Ratio of
   !> the largest equivalent stress to the largest pressure, by Hertz's theory 0.56 to 0.62
   real(wp), parameter :: peak_decrease = 2.0_wp, peak_share = 0.6_wp
   !> Lower bound: fraction of the error of pressures by the levels. Where it exceeds three times that of second order, errors were
   !> 0.3 to 0.5 of it in the median, from 6 to 70 elements across (seeds 51501, 51511, 51601 and 51611)
   real(wp), parameter :: least_by_levels = 0.25_wp
   !> Stresses due to tangential tractions: unknown fraction of their error by the levels; factor of n^-1 times the root of the
   !> fraction in adhesion for steady rolling by the first order: 0.05 was a fifth of the error in stresses at which the levels
   !> agree by chance (seeds 99711 and 99713)
   real(wp), parameter :: unknown_share = 0.3_wp, friction_floor = 0.08_wp
   !> Tractions of different directions have such errors in sliding as well: factor of the part of the bound that cancels. Ratio of
   !> the floor with an interfacial layer to that without
   real(wp), parameter :: turned_share = 0.1_wp, layer_ratio = 1.5_wp
   !> Exponent of the ratio of the error by the levels to the general error, see contact_patch_traction_errors
   real(wp), parameter :: stress_trust = 0.65_wp
   !> Error of the distribution of tangential tractions: factor of their relative error times their stress; of random contacts in
   !> transient rolling (seeds 71002, 71003, 99711 and 99713)
   real(wp), parameter :: distribution_share = 0.5_wp
   !> Order of stresses due to tangential tractions by the first-order scheme in adhesion, where the median of the error was 0.25 to
   !> 0.35 of the difference of the levels, of which 0.4 is taken; the same with an interfacial layer (median 0.56, quartiles 0.34
   !> and 0.78, seeds 5601 to 5603), of which 0.65; in full sliding, where they are the pressures times the coefficient of friction
   real(wp), parameter :: adhesion_order = 1.15_wp, layer_order = 0.85_wp, sliding_order = 2.0_wp
   !> Ratio of the error to the difference of the levels in transient rolling, which has no clean order; of random contacts (seed
   !> 301)
   real(wp), parameter :: unclean = 0.5_wp

   !> Ratio of the error to the root of the sum of squares of its parts by the first-order scheme, as parts of opposite signs
   !> cancel: the median of 5060 stresses of contacts of all kinds is about 0.8; a smaller ratio, as errors that are small by chance
   !> are more frequent than large ones (seeds 99711 and 99713)
   real(wp), parameter :: cancelling = 0.7_wp

   !> Stresses at a point, and their errors: xx, xy, xz, yy, yz, zz [N/mm2]
   type :: stress_change
      !> Stresses, and those due to tangential tractions
      real(wp) :: total(6) = 0.0_wp, friction(6) = 0.0_wp
      !> Errors of second order by the curvature of the field, of all tractions and of pressures; the part of the latter along
      !> directions in which the coarser level has longer elements
      real(wp) :: smeared(6) = 0.0_wp, smeared_normal(6) = 0.0_wp, seen_normal(6) = 0.0_wp
      !> Errors by the levels: of pressures, and of tangential tractions without their error of second order
      real(wp) :: by_normal(6) = 0.0_wp, by_friction(6) = 0.0_wp
   end type stress_change

contains

   !> Estimate the errors of the largest equivalent stresses at the points of a case; NaN for points too close to the surface
   subroutine estimate_stress_errors(spec, coarse, result, left)
      !> Case, with its bodies and points
      type(case_spec), intent(in) :: spec
      !> Solution on elements three times as long
      type(patch_result), intent(in) :: coarse
      !> Result with stresses; errors of the largest ones are added to its errors
      type(patch_result), intent(inout) :: result
      !> Does the patch belong to a wheel on the left side, see subsurface_stresses? Default: no
      logical, intent(in), optional :: left
      !> Maximum by von Mises, and by Tresca
      character(len=*), parameter :: names(2) = [character(len=10) :: "max_mises", "max_tresca"]
      type(total_list) :: list
      real(wp), allocatable :: values(:)
      ! positions of the largest equivalent stresses
      type(stress_change) :: change
      real(wp) :: place(3, 2), stress(6, 2), largest(2), peak, side
      integer :: k, known
      logical :: is_seen

      if (.not. (allocated(result%errors) .and. allocated(result%subsurface))) return
      call result%totals(list)
      known = size(result%errors%value)
      allocate(values(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
      values(:known) = result%errors%value
      if (result%errors%reason == "") then
         peak = 0.0_wp
         ! without an estimate of the largest pressure, or without contact, there is no bound
         if (result%pmax > 0.0_wp .and. .not. ieee_is_nan(values(list%place_of("pmax")))) &
            & peak = peak_share*values(list%place_of("pmax"))
         side = max(result%grid%dx, result%grid%dy)
         do k = 1, 2
            call find_largest(result, k == 2, place(:, k), stress(:, k), largest(k))
            if (present(left)) then
               if (left) call mirror(place(:, k), stress(:, k))
            end if
            is_seen = largest(k) > 0.0_wp .and. abs(place(3, k)) >= least_depth*max(coarse%grid%dx, coarse%grid%dy)
            if (.not. is_seen) cycle
            ! both maxima are often at the same point
            if (k == 1 .or. any(place(:, k) /= place(:, 1))) &
               & call compare_stresses(spec, coarse, result, place(:, k), stress(:, k), change)
            values(list%place_of(names(k))) = max(peak*min(1.0_wp, side/abs(place(3, k)))**peak_decrease, &
               & error_of_largest(change, result, spec%material_model == material_model%interfacial_layer, k == 2)) &
               & + (maxval(result%errors%stopping) + result%errors%window)*largest(k)
         end do
      end if
      call move_alloc(values, result%errors%value)
   end subroutine estimate_stress_errors

   !> The largest equivalent stress, its position and components
   pure subroutine find_largest(result, by_tresca, place, stress, largest)
      !> Result with stresses
      type(patch_result), intent(in) :: result
      !> By Tresca? Otherwise by von Mises
      logical, intent(in) :: by_tresca
      !> Position [mm]; xx, xy, xz, yy, yz, zz and equivalent stress [N/mm2], the latter negative if there is no point
      real(wp), intent(out) :: place(3), stress(6), largest
      integer :: i, k
      real(wp) :: value

      largest = -1.0_wp
      place = 0.0_wp
      stress = 0.0_wp
      do k = 1, size(result%subsurface)
         associate (block => result%subsurface(k))
            do i = 1, size(block%sigvm)
               value = merge(block%sigtr(i), block%sigvm(i), by_tresca)
               if (.not. value > largest) cycle
               largest = value
               place = block%position(:, i)
               stress = block%stress(:, i)
            end do
         end associate
      end do
   end subroutine find_largest

   !> A point of a wheel on the left side in the axes of its solution, which is for the right side of the track
   pure subroutine mirror(place, stress)
      !> Position [mm]
      real(wp), intent(inout) :: place(3)
      !> xx, xy, xz, yy, yz, zz [N/mm2]
      real(wp), intent(inout) :: stress(6)

      place(2) = -place(2)
      stress([2, 5]) = -stress([2, 5])
   end subroutine mirror

   !> Error of the largest equivalent stress without contributions of solvers and window [N/mm2]: the errors by the curvature of the
   !> field and by the levels with their signs, and their unknown parts; root of the sum of squares with the effect of an error of
   !> the tractions that the levels do not show
   real(wp) function error_of_largest(change, result, has_layer, by_tresca) result(e)
      type(stress_change), intent(in) :: change
      !> Result with errors
      type(patch_result), intent(in) :: result
      logical, intent(in) :: has_layer, by_tresca
      real(wp) :: largest, friction, smooth, smooth_normal, usual, floor, unknown, excess, uniform, known(6)

      largest = equivalent(change%total, by_tresca)
      friction = equivalent(change%friction, by_tresca)
      smooth = equivalent(change%total + change%smeared, by_tresca) - largest
      smooth_normal = equivalent(change%total + change%smeared_normal, by_tresca) - largest
      usual = max(abs(smooth), abs(smooth_normal), least_curvature*largest/result%ncon)
      floor = floor_of_friction(result, has_layer)*friction
      excess = abs(equivalent(change%total + change%by_normal, by_tresca) &
         & - equivalent(change%total + change%seen_normal, by_tresca))
      unknown = scatter*usual + unresolved*max(0.0_wp, excess - usual_difference*usual) + floor &
         & + unknown_share*abs(equivalent(change%total + change%by_friction, by_tresca) - largest)
      known = change%smeared + level_share*(change%by_normal - change%seen_normal) + change%by_friction
      e = hypot(equivalent(change%total + known, by_tresca) - largest, unknown)
      e = max(trusted(e, usual_difference*usual + floor, stress_trust), &
         & least_by_levels*abs(equivalent(change%total + change%by_normal, by_tresca) - largest))
      ! in transient rolling errors are those of the strip that was not in contact before, and vary across the contact; the
      ! coefficient of friction changes all tractions
      uniform = 0.0_wp
      if (result%motion /= motion%transient_rolling) &
         & uniform = abs(equivalent(change%total + result%errors%traction*change%friction, by_tresca) - largest)
      e = hypot(e, max(distribution_share*result%errors%traction*friction, uniform))
      if (order_of_errors(result%tangential) /= 2) e = cancelling*e
   end function error_of_largest

   !> Lower bound of the error of stresses due to tangential tractions, relative to them
   pure real(wp) function floor_of_friction(result, has_layer) result(floor)
      !> Result with errors
      type(patch_result), intent(in) :: result
      !> Is there an interfacial layer?
      logical, intent(in) :: has_layer

      floor = 0.0_wp
      if (result%motion /= motion%steady_rolling .or. order_of_errors(result%tangential) == 2) return
      floor = friction_floor*merge(layer_ratio, 1.0_wp, has_layer)*sqrt(first_order_part(result)/result%ncon)
   end function floor_of_friction

   !> Part of the tangential tractions with errors of first order in steady rolling by this order: those in adhesion, and those of
   !> different directions, as the fraction in adhesion with the same errors [-]
   pure real(wp) function first_order_part(result) result(part)
      !> Result with errors
      type(patch_result), intent(in) :: result

      part = max(real(result%nadh, wp)/max(1, result%ncon), turned_share*result%errors%cancelled)
   end function first_order_part

   !> Stresses at a point, and their errors from the differences to those of the coarser level and from the curvature of its field
   subroutine compare_stresses(spec, coarse, result, place, stress, change)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: coarse, result
      !> Position [mm], and stresses there [N/mm2]
      real(wp), intent(in) :: place(3), stress(6)
      type(stress_change), intent(out) :: change
      !> Stresses at the point and one element before and after it, along x and along y, due to pressures and to all tractions
      real(wp) :: normal(6, 5), total(6, 5), places(3, 5)
      !> The same of the coarser level at the point
      real(wp) :: coarse_normal(6, 1), coarse_total(6, 1)
      !> Directions in which its elements are longer: 1, otherwise 0
      real(wp) :: seen(2)
      real(wp) :: load, part(2), difference(6)
      type(bounding_box) :: box

      places = spread(place, 2, 5)
      places(1, 2:3) = place(1) + [-1.0_wp, 1.0_wp]*result%grid%dx
      places(2, 4:5) = place(2) + [-1.0_wp, 1.0_wp]*result%grid%dy
      call find_stresses(spec, result, places, 0.0_wp, normal)
      total(:, 1) = stress
      call find_stresses(spec, result, places(:, 2:), 1.0_wp, total(:, 2:))
      call find_stresses(spec, coarse, places(:, 1:1), 0.0_wp, coarse_normal)
      call find_stresses(spec, coarse, places(:, 1:1), 1.0_wp, coarse_total)
      change%total = stress
      change%friction = stress - normal(:, 1)
      ! a patch of wheel and rail whose total force is prescribed has another load on the coarser level
      load = 1.0_wp
      if (spec%normal == normal_control%force .and. coarse%fn > 0.0_wp) load = (result%fn/coarse%fn)**peak_power
      box = contact_box(result%division)
      part = min(1.0_wp, smeared*max(1.0_wp, compensating/[box%ix1 - box%ix0 + 1, box%iy1 - box%iy0 + 1]))
      seen = merge(1.0_wp, 0.0_wp, [coarse%grid%dx > 2.0_wp*result%grid%dx, coarse%grid%dy > 2.0_wp*result%grid%dy])
      change%smeared = smearing(total, part)
      change%smeared_normal = smearing(normal, part)
      change%seen_normal = smearing(normal, seen*part)
      change%by_normal = (load*coarse_normal(:, 1) - normal(:, 1))/(coarsening**2 - 1.0_wp)
      difference = load*(coarse_total(:, 1) - coarse_normal(:, 1)) - change%friction &
         & - (coarsening**2 - 1.0_wp)*smearing(total - normal, seen*part)
      change%by_friction = share_of_friction(result, spec%material_model == material_model%interfacial_layer)*difference
   end subroutine compare_stresses

   !> Error of second order by the curvature of the field [N/mm2]
   pure function smearing(stress, part)
      !> Stresses at the point, and one element before and after it, along x and along y [N/mm2]
      real(wp), intent(in) :: stress(6, 5)
      !> Parts of the effect that remain, along x and along y
      real(wp), intent(in) :: part(2)
      real(wp) :: smearing(6)

      smearing = (part(1)*(stress(:, 2) - 2.0_wp*stress(:, 1) + stress(:, 3)) &
         & + part(2)*(stress(:, 4) - 2.0_wp*stress(:, 1) + stress(:, 5)))/24.0_wp
   end function smearing

   !> Ratio of the error to the difference of the levels for stresses due to tangential tractions
   pure real(wp) function share_of_friction(result, has_layer) result(share)
      type(patch_result), intent(in) :: result
      !> Is there an interfacial layer, whose errors are of first order in sliding, too?
      logical, intent(in) :: has_layer
      real(wp) :: slides

      share = 1.0_wp/(coarsening**2 - 1.0_wp)
      if (result%motion == motion%steady_rolling .and. order_of_errors(result%tangential) /= 2) then
         slides = 0.0_wp
         if (.not. has_layer) slides = sliding_part(first_order_part(result))
         share = (1.0_wp - slides)/(coarsening**merge(layer_order, adhesion_order, has_layer) - 1.0_wp) &
            & + slides/(coarsening**sliding_order - 1.0_wp)
      end if
      ! with the second order, the coarser level is solved with another scheme
      if (result%motion == motion%transient_rolling) share = merge(0.0_wp, unclean, order_of_errors(result%tangential) == 2)
   end function share_of_friction

   !> Stresses due to the tractions of a level
   subroutine find_stresses(spec, level, places, friction, stress)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: level
      !> Positions [mm], shape (3, n)
      real(wp), intent(in) :: places(:, :)
      !> Factor of the tangential tractions: 1, or 0 for pressures alone
      real(wp), intent(in) :: friction
      !> xx, xy, xz, yy, yz, zz [N/mm2], shape (6, n)
      real(wp), intent(out) :: stress(:, :)
      type(surface_load) :: load
      real(wp) :: displacement(3, 1), values(6, 1)
      integer :: k

      call new_surface_load(load, level%grid, level%pn, friction*level%px, friction*level%py, spec%material%gg, &
         & spec%material%poiss, spec%kernel == kernel_model%bilinear)
      do k = 1, size(places, 2)
         call subsurface_field(load, point_set([places(1, k)], [places(2, k)], [places(3, k)]), displacement, values)
         stress(:, k) = values(:, 1)
      end do
   end subroutine find_stresses

   !> Equivalent stress by Tresca, or by von Mises [N/mm2]
   real(wp) function equivalent(stress, by_tresca)
      !> xx, xy, xz, yy, yz, zz [N/mm2]
      real(wp), intent(in) :: stress(6)
      logical, intent(in) :: by_tresca
      real(wp), dimension(1) :: mean, mises, tresca, first, second, third

      call stress_invariants(reshape(stress, [6, 1]), mean, mises, tresca, first, second, third)
      equivalent = merge(tresca(1), mises(1), by_tresca)
   end function equivalent
end module contact_cases_stress_errors
