!> Estimated errors of the largest stresses below the surface, from the tractions of both levels
!>
!> Stresses are linear in the tractions: what pressures and tangential tractions of the coarser level make of the stresses at the
!> point of the largest one tells the errors of both, each with its order. Errors of invariants follow from those of the stresses.
!> See doc/theory/errors.md.
module contact_cases_stress_errors
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use contact_base_choices, only : kernel_model, motion, normal_control
   use contact_base_kinds, only : wp
   use contact_cases_spec, only : case_spec
   use contact_patch_coarse_level, only : coarsening
   use contact_patch_quantities, only : total_list
   use contact_patch_result, only : patch_result
   use contact_subsurface_invariants, only : stress_invariants
   use contact_subsurface_load, only : new_surface_load, surface_load
   use contact_subsurface_points, only : point_set
   use contact_subsurface_stress, only : subsurface_field
   implicit none (type, external)
   private

   public :: estimate_stress_errors

   !> Stresses at points less deep than this many sides of a coarse element are those of the steps between elements; chosen
   real(wp), parameter :: least_depth = 0.5_wp
   !> Stresses are in proportion to this power of the load of a patch, by Hertz's theory
   real(wp), parameter :: peak_power = 1.0_wp/3.0_wp
   !> Not less than this times n^-2 of the stress, n elements across; of random contacts of tests/accuracy
   real(wp), parameter :: stress_floor = 0.05_wp

contains

   !> Errors of the largest equivalent stresses at the points of a case; NaN where they lie too near to the surface
   subroutine estimate_stress_errors(spec, coarse, result, left)
      !> Bodies and points
      type(case_spec), intent(in) :: spec
      !> Solution on elements three times as long
      type(patch_result), intent(in) :: coarse
      !> With stresses; its errors get those of the largest ones
      type(patch_result), intent(inout) :: result
      !> Does the patch belong to a wheel on the left side, see subsurface_stresses? Default: no
      logical, intent(in), optional :: left
      !> By von Mises, and by Tresca
      character(len=*), parameter :: names(2) = [character(len=10) :: "max_mises", "max_tresca"]
      type(total_list) :: list
      real(wp), allocatable :: values(:)
      !> Stress by both levels, that of the coarser one as far as it is an error, at the place of the largest equivalent one
      real(wp) :: stress(6), change(6), place(3, 2), largest(2)
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
            ! both are often largest at the same point
            if (k == 1 .or. any(place(:, k) /= place(:, 1))) &
               & call compare_stresses(spec, coarse, result, mirrored(place(:, k), left), stress, change)
            values(list%place_of(names(k))) = abs(equivalent(stress + change, k == 2) - largest(k)) &
               & + (stress_floor/result%ncon + maxval(result%errors%stopping) + result%errors%window)*largest(k)
         end do
      end if
      call move_alloc(values, result%errors%value)
   end subroutine estimate_stress_errors

   !> The largest equivalent stress, and its place
   pure subroutine find_largest(result, by_tresca, place, largest)
      !> With stresses
      type(patch_result), intent(in) :: result
      !> By Tresca, or by von Mises?
      logical, intent(in) :: by_tresca
      !> [mm], [N/mm2]; negative where there is no point
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

   !> A point as the solution of a patch has it, which knows the right side of the track only
   pure function mirrored(place, left)
      !> [mm]
      real(wp), intent(in) :: place(3)
      !> Default: no
      logical, intent(in), optional :: left
      real(wp) :: mirrored(3)

      mirrored = place
      if (.not. present(left)) return
      if (left) mirrored(2) = -place(2)
   end function mirrored

   !> Stress at a point, and the part of its difference to that of the coarser level that is its error [N/mm2]
   subroutine compare_stresses(spec, coarse, result, place, stress, change)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: coarse, result
      !> [mm]
      real(wp), intent(in) :: place(3)
      !> xx, xy, xz, yy, yz, zz
      real(wp), intent(out) :: stress(6), change(6)
      !> By pressures, fine and coarse; by all tractions of the coarser level
      real(wp) :: normal(6, 2), total(6), load

      normal(:, 1) = stress_of(spec, result, place, 0.0_wp)
      stress = stress_of(spec, result, place, 1.0_wp)
      ! a patch of wheel and rail whose total force is given has another load on the coarser level
      load = 1.0_wp
      if (spec%normal == normal_control%force .and. coarse%fn > 0.0_wp) load = (result%fn/coarse%fn)**peak_power
      normal(:, 2) = load*stress_of(spec, coarse, place, 0.0_wp)
      total = load*stress_of(spec, coarse, place, 1.0_wp)
      change = (normal(:, 2) - normal(:, 1))/(coarsening**2 - 1.0_wp) &
         & + share_of_friction(result)*((total - normal(:, 2)) - (stress - normal(:, 1)))
   end subroutine compare_stresses

   !> Part of the difference of the levels that is the error of the stresses by tangential tractions: the difference itself where
   !> their problem has no clean order
   pure real(wp) function share_of_friction(result) result(share)
      type(patch_result), intent(in) :: result

      share = 1.0_wp
      if (result%motion == motion%shift .or. result%tangential%order == 2) share = 1.0_wp/(coarsening**2 - 1.0_wp)
      if (result%motion == motion%steady_rolling .and. result%tangential%order /= 2) share = 1.0_wp/(coarsening - 1.0_wp)
   end function share_of_friction

   !> Stresses at a point by the tractions of a level [N/mm2]
   function stress_of(spec, level, place, friction) result(stress)
      type(case_spec), intent(in) :: spec
      type(patch_result), intent(in) :: level
      !> [mm]
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
