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
      real(wp) :: slip(2)
      integer :: ix, iy

      power = 0.0_wp
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            slip = [result%cksi - problem%spin_weight(1)*problem%spin*(result%grid%y(iy) - problem%spin_centre(2)), &
               & result%ceta + problem%spin_weight(2)*problem%spin*(result%grid%x(ix) - problem%spin_centre(1))]
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
            change = slope(result%h(:, iy), ix)
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
      real(wp) :: virial, distances, potential, ratio

      e = 0.0_wp
      is_known = problem%solves_for_pressure() .and. .not. (problem%model%coupled() .or. allocated(problem%model%memory) &
         & .or. allocated(problem%parts))
      if (is_known) call distance_sums(result, virial, distances, is_known)
      if (.not. is_known) return
      ratio = virial/max(distances, tiny(ratio))
      is_known = abs(ratio - 2.0_wp) < quadratic
      ! with prescribed approach, the elastic energy equals the potential energy with opposite sign
      e = (normal_energy(coarse) - normal_energy(result))/potential_ratio
      if (.not. problem%force_prescribed) return
      potential = (coarse%pen - result%pen)*result%fn/nmm_per_joule - (normal_energy(coarse) - normal_energy(result))
      e = (ratio*potential/potential_ratio + normal_energy(result) - virial)/(1.0_wp + ratio)
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
      real(wp) :: centre(2), slopes(2), lowest, load
      integer :: ix, iy

      virial = 0.0_wp
      distances = 0.0_wp
      load = sum(result%pn)
      is_known = load > 0.0_wp
      if (.not. is_known) return
      centre = 0.0_wp
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            centre = centre + result%pn(ix, iy)*[result%grid%x(ix), result%grid%y(iy)]
         end do
      end do
      centre = centre/load
      lowest = minval(result%h)
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            slopes = [slope(result%h(:, iy), ix), slope(result%h(ix, :), iy)]
            is_known = all(abs(slopes) < excluded_threshold)
            if (.not. is_known) return
            virial = virial + result%pn(ix, iy)*((result%grid%x(ix) - centre(1))*slopes(1)/result%grid%dx &
               & + (result%grid%y(iy) - centre(2))*slopes(2)/result%grid%dy)
            distances = distances + result%pn(ix, iy)*(result%h(ix, iy) - lowest)
         end do
      end do
      virial = virial*result%grid%dx*result%grid%dy/nmm_per_joule
      distances = distances*result%grid%dx*result%grid%dy/nmm_per_joule
   end subroutine distance_sums

   !> Difference per element at an element of a line: exact for polynomials of degree four, of degree two next to the ends; huge if
   !> it is not known
   pure real(wp) function slope(line, i)
      !> Values along the line, huge if there are none
      real(wp), intent(in) :: line(:)
      integer, intent(in) :: i
      integer :: n

      n = size(line)
      slope = huge(slope)
      if (n < 3) return
      if (maxval(line(max(1, min(i, n - 1) - 1):min(n, max(i, 2) + 1))) > excluded_threshold) return
      if (i == 1) then
         slope = 2.0_wp*(line(2) - line(1)) - 0.5_wp*(line(3) - line(1))
      else if (i == n) then
         slope = 2.0_wp*(line(n) - line(n - 1)) - 0.5_wp*(line(n) - line(n - 2))
      else
         slope = 0.5_wp*(line(i + 1) - line(i - 1))
         if (i == 2 .or. i == n - 1) return
         if (max(line(i - 2), line(i + 2)) > excluded_threshold) return
         slope = (8.0_wp*slope - 0.5_wp*(line(i + 2) - line(i - 2)))/6.0_wp
      end if
   end function slope
end module contact_patch_balances
