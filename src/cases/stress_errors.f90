!> Estimated errors of the largest subsurface stresses, from the tractions of both levels
!>
!> Stresses are linear in the tractions: pressures and tangential tractions of the coarser level, applied separately, give the
!> errors of stresses at the point of the largest one, each with its order. Errors of invariants follow from those of the stresses.
!> See doc/theory/errors.md.
module contact_cases_stress_errors
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_choices, only : kernel_model, material_model, motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_order, only : order_of_errors
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_patch_traction_errors, only : sliding_part, trusted
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
   !> General errors, with n^2 elements in contact: factor of n^-2 times the stress, and factor of n^-2 times the stress due to
   !> tangential tractions; of random contacts of tests/accuracy (seeds 302, 304 and 82001)
   real(wp), parameter :: stress_floor = 0.15_wp, friction_floor = 0.2_wp
   !> Ratio of the latter with an interfacial layer, whose tractions have errors of first order, to that without; of random contacts
   !> (seeds 71002, 71003 and 81002)
   real(wp), parameter :: layer_share = 3.0_wp
   !> Exponent of the ratio of the error by the levels to the general error, see contact_patch_traction_errors
   real(wp), parameter :: stress_trust = 0.65_wp
   !> Error of the distribution of tangential tractions: factor of their relative error times their stress; of random contacts in
   !> transient rolling (seeds 71002 and 71003, and the steps of the test further_errors)
   real(wp), parameter :: distribution_share = 0.35_wp
   !> Order of tangential tractions in full sliding by the first-order scheme, between that in adhesion and the second; of random
   !> contacts (seeds 71002 and 71003)
   real(wp), parameter :: sliding_order = 1.5_wp
   !> Ratio of the error to the difference of the levels in transient rolling, which has no clean order; of random contacts (seed
   !> 301)
   real(wp), parameter :: unclean = 0.5_wp

   !> Stresses at a point, and their errors by the levels: xx, xy, xz, yy, yz, zz [N/mm2]
   type :: stress_change
      !> Due to pressures, and due to tangential tractions
      real(wp) :: normal(6) = 0.0_wp, friction(6) = 0.0_wp
      !> Errors of these by the levels
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
      real(wp) :: place(3, 2), largest(2)
      integer :: k, known
      logical :: is_seen

      if (.not. (allocated(result%errors) .and. allocated(result%subsurface))) return
      call result%totals(list)
      known = size(result%errors%value)
      allocate(values(list%length), source=ieee_value(1.0_wp, ieee_quiet_nan))
      values(:known) = result%errors%value
      if (result%errors%reason == "") then
         do k = 1, 2
            call find_largest(result, k == 2, place(:, k), largest(k))
            is_seen = largest(k) > 0.0_wp .and. abs(place(3, k)) >= least_depth*max(coarse%grid%dx, coarse%grid%dy)
            if (.not. is_seen) cycle
            ! both maxima are often at the same point
            if (k == 1 .or. any(place(:, k) /= place(:, 1))) &
               & call compare_stresses(spec, coarse, result, mirrored(place(:, k), left), change)
            values(list%place_of(names(k))) = error_of_largest(change, result, &
               & spec%material_model == material_model%interfacial_layer, k == 2) &
               & + (maxval(result%errors%stopping) + result%errors%window)*largest(k)
         end do
      end if
      call move_alloc(values, result%errors%value)
   end subroutine estimate_stress_errors

   !> The largest equivalent stress, and its position
   pure subroutine find_largest(result, by_tresca, place, largest)
      !> Result with stresses
      type(patch_result), intent(in) :: result
      !> By Tresca? Otherwise by von Mises
      logical, intent(in) :: by_tresca
      !> Position [mm], and stress [N/mm2]; negative if there is no point
      real(wp), intent(out) :: place(3), largest
      integer :: i, k
      real(wp) :: value

      largest = -1.0_wp
      place = 0.0_wp
      do k = 1, size(result%subsurface)
         associate (block => result%subsurface(k))
            do i = 1, size(block%sigvm)
               value = merge(block%sigtr(i), block%sigvm(i), by_tresca)
               if (.not. value > largest) cycle
               largest = value
               place = block%position(:, i)
            end do
         end associate
      end do
   end subroutine find_largest

   !> A point in the axes of the solution of a patch, which is for the right side of the track
   pure function mirrored(place, left)
      !> Position [mm]
      real(wp), intent(in) :: place(3)
      !> Is the patch on the left side? Default: no
      logical, intent(in), optional :: left
      real(wp) :: mirrored(3)

      mirrored = place
      if (.not. present(left)) return
      if (left) mirrored(2) = -place(2)
   end function mirrored

   !> Error of the largest equivalent stress without contributions of solvers and window [N/mm2]: from the differences of the levels
   !> due to pressures and due to tangential tractions, whose signs differ from point to point, or the general error for this
   !> number of elements; root of the sum of squares with the effect of an error of the tractions that the levels do not show
   real(wp) function error_of_largest(change, result, has_layer, by_tresca) result(e)
      type(stress_change), intent(in) :: change
      !> Result with errors
      type(patch_result), intent(in) :: result
      logical, intent(in) :: has_layer, by_tresca
      real(wp) :: largest, general, friction

      largest = equivalent(change%normal + change%friction, by_tresca)
      friction = equivalent(change%friction, by_tresca)
      general = (stress_floor*largest + friction_floor*friction*merge(layer_share, 1.0_wp, has_layer))/result%ncon
      e = hypot(equivalent(change%normal + change%friction + change%by_normal, by_tresca) - largest, &
         & equivalent(change%normal + change%friction + change%by_friction, by_tresca) - largest)
      e = hypot(max(trusted(e, general, stress_trust), general), max(distribution_share*result%errors%traction*friction, &
         & abs(equivalent(change%normal + (1.0_wp + result%errors%traction)*change%friction, by_tresca) - largest)))
   end function error_of_largest

   !> Stresses at a point, and their errors from the differences to those of the coarser level
   subroutine compare_stresses(spec, coarse, result, place, change)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: coarse, result
      !> Position [mm]
      real(wp), intent(in) :: place(3)
      type(stress_change), intent(out) :: change
      !> Stresses of the coarser level
      real(wp) :: normal(6), friction(6), load

      change%normal = stress_of(spec, result, place, 0.0_wp)
      change%friction = stress_of(spec, result, place, 1.0_wp) - change%normal
      ! a patch of wheel and rail whose total force is prescribed has another load on the coarser level
      load = 1.0_wp
      if (spec%normal == normal_control%force .and. coarse%fn > 0.0_wp) load = (result%fn/coarse%fn)**peak_power
      normal = load*stress_of(spec, coarse, place, 0.0_wp)
      friction = load*stress_of(spec, coarse, place, 1.0_wp) - normal
      change%by_normal = (normal - change%normal)/(coarsening**2 - 1.0_wp)
      change%by_friction = share_of_friction(result, spec%material_model == material_model%interfacial_layer) &
         & *(friction - change%friction)
   end subroutine compare_stresses

   !> Ratio of the error to the difference of the levels for stresses due to tangential tractions
   pure real(wp) function share_of_friction(result, has_layer) result(share)
      type(patch_result), intent(in) :: result
      !> Is there an interfacial layer, whose errors are of first order in sliding, too?
      logical, intent(in) :: has_layer
      real(wp) :: slides

      share = 1.0_wp/(coarsening**2 - 1.0_wp)
      if (result%motion == motion%steady_rolling .and. order_of_errors(result%tangential) /= 2) then
         slides = 0.0_wp
         if (.not. has_layer) slides = sliding_part(real(result%nadh, wp)/max(1, result%ncon))
         share = (1.0_wp - slides)/(coarsening - 1.0_wp) + slides/(coarsening**sliding_order - 1.0_wp)
      end if
      ! with the second order, the coarser level is solved with another scheme
      if (result%motion == motion%transient_rolling) share = merge(0.0_wp, unclean, order_of_errors(result%tangential) == 2)
   end function share_of_friction

   !> Stresses at a point due to the tractions of a level [N/mm2]
   function stress_of(spec, level, place, friction) result(stress)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: level
      !> Position [mm]
      real(wp), intent(in) :: place(3)
      !> Factor of the tangential tractions: 1, or 0 for pressures alone
      real(wp), intent(in) :: friction
      real(wp) :: stress(6)
      type(surface_load) :: load
      real(wp) :: displacement(3, 1), values(6, 1)

      call new_surface_load(load, level%grid, level%pn, friction*level%px, friction*level%py, spec%material%gg, &
         & spec%material%poiss, spec%kernel == kernel_model%bilinear)
      call subsurface_field(load, point_set([place(1)], [place(2)], [place(3)]), displacement, values)
      stress = values(:, 1)
   end function stress_of

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
