!> Balance equations of the exact solution of a patch: their residual in a discrete solution is an error with its sign
!>
!> In steady rolling the elastic energy does not change and the compliance is symmetric, so frictional power equals the power of the
!> tractions with creepages and spin. Pressures under a smooth surface satisfy a virial theorem, from a change of scale: their
!> elastic energy is the sum of pressure times distance from a centre times slope of the surface. Both balances need a single level
!> only, and depend on the position of the edges of contact within elements. See doc/theory/errors.md.
module contact_patch_balances
   use contact_base_choices, only : motion
   use contact_base_constants, only : excluded_threshold, nmm_per_joule
   use contact_base_kinds, only : wp
   use contact_numeric_vectors, only : largest_of
   use contact_patch_problem, only : patch_problem, rolling_direction
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: balances_power, error_of_normal_energy, motion_power, normal_energy

   !> Difference of the potential energy to that of pressures on elements three times as long, over its error: 3^2 - 1 for a clean
   !> second order; median of the random contacts of tests/accuracy with 15 to 40 elements
   real(wp), parameter :: potential_ratio = 6.0_wp
   !> A surface is regarded as quadratic if the ratio of virial to energy of distances differs from 2 by less than this; chosen
   real(wp), parameter :: quadratic = 0.1_wp

contains

   !> Does frictional power equal the power of the motion? Not with viscoelastic bodies or a layer that yields, and not with given
   !> pressures that act on the tractions but do not depend on them
   pure logical function balances_power(problem) result(balances)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem

      balances = problem%motion == motion%steady_rolling .and. .not. (allocated(problem%simplified) &
         & .or. allocated(problem%model%memory) .or. problem%remembers_yield .or. allocated(problem%parts) &
         & .or. (problem%model%coupled() .and. .not. problem%couples()))
   end function balances_power

   !> Power of the tractions with creepages, spin and extra slip, dissipation negative [W]; huge if it is not known
   !>
   !> With bodies of different materials, tractions shift the pressures to one side of the contact, where the surface rises: the
   !> power of pressures with this slope is included.
   pure real(wp) function motion_power(problem, result) result(power)
      !> The problem that was solved, steady rolling
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      real(wp) :: slip(2), across
      integer :: ix, iy

      power = 0.0_wp
      do iy = 1, result%grid%my
         across = result%cksi - problem%spin_weight(1)*problem%spin*(result%grid%y(iy) - problem%spin_centre(2))
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            slip = [across, result%ceta + problem%spin_weight(2)*problem%spin*(result%grid%x(ix) - problem%spin_centre(1))]
            if (allocated(problem%extra_slip)) slip = slip + problem%extra_slip(ix, iy, :)
            power = power + result%px(ix, iy)*slip(1) + result%py(ix, iy)*slip(2)
         end do
      end do
      if (problem%couples()) power = power + pressure_times_slope(problem, result)
      if (power < huge(power)) power = power*result%grid%dx*result%grid%dy*result%dq/(nmm_per_joule*result%dt)
   end function motion_power

   !> Sum of pressure times slope of the surface along the rolling direction [N/mm2]; huge if a slope is not known
   pure real(wp) function pressure_times_slope(problem, result)
      !> A problem of bodies with different materials
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      real(wp) :: change
      integer :: ix, iy

      pressure_times_slope = huge(pressure_times_slope)
      if (.not. problem%solves_for_pressure() .or. problem%general_step) return
      pressure_times_slope = 0.0_wp
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            change = slope(result%grid%mx, ix, 1, result%h(1, iy))
            if (abs(change) > excluded_threshold) then
               pressure_times_slope = huge(pressure_times_slope)
               return
            end if
            pressure_times_slope = pressure_times_slope + result%pn(ix, iy)*change
         end do
      end do
      pressure_times_slope = -rolling_direction(problem)*pressure_times_slope/result%grid%dx
   end function pressure_times_slope

   !> Elastic energy of the pressures [J]
   pure real(wp) function normal_energy(result) result(energy)
      !> Solved
      type(patch_result), intent(in) :: result

      energy = result%grid%dx*result%grid%dy/(2.0_wp*nmm_per_joule)*sum(result%pn*result%un)
   end function normal_energy

   !> Error of the elastic energy of the pressures [J]; not known if the surface is not quadratic, or bodies are coupled or
   !> viscoelastic
   pure subroutine error_of_normal_energy(problem, result, coarse, e, is_known)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solutions on the fine and the coarse level
      type(patch_result), intent(in) :: result, coarse
      !> Error with its sign [J]
      real(wp), intent(out) :: e
      !> Is the error known?
      logical, intent(out) :: is_known
      real(wp) :: virial, distances, potential, ratio, energy, change

      e = 0.0_wp
      is_known = problem%solves_for_pressure() .and. .not. (problem%model%coupled() .or. allocated(problem%model%memory) &
         & .or. allocated(problem%parts))
      if (is_known) call distance_sums(result, virial, distances, is_known)
      if (.not. is_known) return
      ratio = virial/max(distances, tiny(ratio))
      is_known = abs(ratio - 2.0_wp) < quadratic
      energy = normal_energy(result)
      change = normal_energy(coarse) - energy
      ! with prescribed approach, the elastic energy equals the potential energy with opposite sign
      e = change/potential_ratio
      if (.not. problem%force_prescribed) return
      potential = (coarse%pen - result%pen)*result%fn/nmm_per_joule - change
      e = (ratio*potential/potential_ratio + energy - virial)/(1.0_wp + ratio)
   end subroutine error_of_normal_energy

   !> Sum of pressure times slope of the surface times position relative to the centre of pressure, and sum of pressure times
   !> distance of the surface above its lowest element
   pure subroutine distance_sums(result, virial, distances, is_known)
      !> Solved
      type(patch_result), intent(in) :: result
      !> Virial and energy of distances [J]
      real(wp), intent(out) :: virial, distances
      !> Are the slopes known in all elements with pressure?
      logical, intent(out) :: is_known
      !> Slopes of a row along x and y [mm per element]
      real(wp) :: slopes(result%grid%mx, 2)
      real(wp) :: centre(2), lowest, load, y
      logical :: covers
      integer :: ix, iy

      virial = 0.0_wp
      distances = 0.0_wp
      load = sum(result%pn)
      is_known = load > 0.0_wp
      if (.not. is_known) return
      centre = 0.0_wp
      do iy = 1, result%grid%my
         y = result%grid%y(iy)
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            centre = centre + result%pn(ix, iy)*[result%grid%x(ix), y]
         end do
      end do
      centre = centre/load
      lowest = minval(result%h)
      ! most surfaces cover the grid: without values that are missing, slopes of whole rows are quick
      covers = largest_of(size(result%h), result%h) <= excluded_threshold
      do iy = 1, result%grid%my
         y = result%grid%y(iy) - centre(2)
         if (largest_of(result%grid%mx, result%pn(:, iy)) <= 0.0_wp) cycle
         call slopes_of_row(result, iy, covers, slopes)
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            is_known = max(abs(slopes(ix, 1)), abs(slopes(ix, 2))) < excluded_threshold
            if (.not. is_known) return
            virial = virial + result%pn(ix, iy)*((result%grid%x(ix) - centre(1))*slopes(ix, 1)/result%grid%dx &
               & + y*slopes(ix, 2)/result%grid%dy)
            distances = distances + result%pn(ix, iy)*(result%h(ix, iy) - lowest)
         end do
      end do
      virial = virial*result%grid%dx*result%grid%dy/nmm_per_joule
      distances = distances*result%grid%dx*result%grid%dy/nmm_per_joule
   end subroutine distance_sums

   !> Slopes of the surface in the elements of a row, see slope
   pure subroutine slopes_of_row(result, iy, covers, slopes)
      !> Solved
      type(patch_result), intent(in) :: result
      !> Row
      integer, intent(in) :: iy
      !> Has every element of the grid a distance?
      logical, intent(in) :: covers
      !> Differences along x and y [mm per element]; huge where they are not known
      real(wp), intent(out) :: slopes(:, :)
      integer :: ix, first, last

      associate (h => result%h, mx => result%grid%mx, my => result%grid%my)
         first = 1
         last = 0
         if (covers) then
            ! as slope does with five values
            first = 3
            last = mx - 2
            do ix = first, last
               slopes(ix, 1) = (8.0_wp*(0.5_wp*(h(ix + 1, iy) - h(ix - 1, iy))) - 0.5_wp*(h(ix + 2, iy) - h(ix - 2, iy)))/6.0_wp
            end do
         end if
         do ix = 1, mx
            if (ix < first .or. ix > last) slopes(ix, 1) = slope(mx, ix, 1, h(1, iy))
         end do
         if (covers .and. iy > 2 .and. iy < my - 1) then
            do ix = 1, mx
               slopes(ix, 2) = (8.0_wp*(0.5_wp*(h(ix, iy + 1) - h(ix, iy - 1))) - 0.5_wp*(h(ix, iy + 2) - h(ix, iy - 2)))/6.0_wp
            end do
         else
            do ix = 1, mx
               slopes(ix, 2) = slope(my, iy, mx, h(ix, 1))
            end do
         end if
      end associate
   end subroutine slopes_of_row

   !> Difference per element at an element of a line: exact for polynomials of degree four, of degree two next to the ends; huge if
   !> it is not known
   pure real(wp) function slope(n, i, step, h)
      !> Number of elements of the line, and the one whose slope is computed
      integer, intent(in) :: n, i
      !> Distance of neighbours of the line in the field
      integer, intent(in) :: step
      !> Field from the first element of the line on, huge where there is no value
      real(wp), intent(in) :: h(1 + (n - 1)*step)
      integer :: at

      slope = huge(slope)
      if (n < 3) return
      ! of the middle one of the three elements that are nearest
      at = 1 + (min(max(i, 2), n - 1) - 1)*step
      if (max(h(at - step), h(at), h(at + step)) > excluded_threshold) return
      if (i == 1) then
         slope = 2.0_wp*(h(at) - h(at - step)) - 0.5_wp*(h(at + step) - h(at - step))
      else if (i == n) then
         slope = 2.0_wp*(h(at + step) - h(at)) - 0.5_wp*(h(at + step) - h(at - step))
      else
         slope = 0.5_wp*(h(at + step) - h(at - step))
         if (i == 2 .or. i == n - 1) return
         if (max(h(at - 2*step), h(at + 2*step)) > excluded_threshold) return
         slope = (8.0_wp*slope - 0.5_wp*(h(at + 2*step) - h(at - 2*step)))/6.0_wp
      end if
   end function slope
end module contact_patch_balances
