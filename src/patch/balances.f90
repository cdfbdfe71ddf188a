!> Sums that the exact solution of a patch fulfils: what is left of them in a discrete one is an error with its sign
!>
!> In steady rolling no energy stays behind: friction takes what creepages and spin do, as the compliance is symmetric. Pressures
!> under a smooth surface fulfil a theorem of virial, from lengths that grow: their elastic energy is the sum of pressures times
!> the distance from a centre times the slope of the surface. Both need one level only, and see where edges of contact lie within
!> elements. See doc/theory/errors.md.
module contact_patch_balances
   use contact_base_choices, only : motion
   use contact_base_constants, only : excluded_threshold, nmm_per_joule
   use contact_base_kinds, only : wp
   use contact_patch_problem, only : patch_problem, rolling_direction
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: balances_power, error_of_normal_energy, motion_power, normal_energy

   !> What the potential energy of pressures on elements three times as long differs by, over its error: 3^2 - 1 if the order were
   !> clean; median of the random contacts of tests/accuracy on 15 to 40 elements
   real(wp), parameter :: potential_ratio = 6.0_wp
   !> Surfaces count as quadratic whose virial over their energy of distances differs from 2 by less; chosen
   real(wp), parameter :: quadratic = 0.1_wp

contains

   !> Does friction take all the power that the motion gives? Not where bodies relax or layers yield, and where given pressures
   !> drive tractions that do not drive them
   pure logical function balances_power(problem) result(balances)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem

      balances = problem%motion == motion%steady_rolling .and. .not. (allocated(problem%simplified) &
         & .or. allocated(problem%model%memory) .or. problem%model%layer > 0.0_wp .or. problem%remembers_yield &
         & .or. allocated(problem%parts) .or. (problem%model%coupled() .and. .not. problem%couples()))
   end function balances_power

   !> Power of the tractions with creepages, spin and extra slip, dissipation negative [W]; huge where it is not known
   !>
   !> Tractions of unlike bodies push pressures to one side of the contact, where the surfaces climb: that takes power, too.
   pure real(wp) function motion_power(problem, result) result(power)
      !> In steady rolling
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
      if (problem%couples()) power = power + climbing(problem, result)
      if (power < huge(power)) power = power*result%grid%dx*result%grid%dy*result%dq/(nmm_per_joule*result%dt)
   end function motion_power

   !> Sum of pressures times the slope of the surface along rolling [N/mm2], huge where a slope is not known
   pure real(wp) function climbing(problem, result)
      !> Of coupled bodies
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      real(wp) :: change
      integer :: ix, iy

      climbing = huge(climbing)
      if (.not. problem%solves_for_pressure() .or. problem%general_step) return
      climbing = 0.0_wp
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (.not. result%pn(ix, iy) > 0.0_wp) cycle
            change = slope(result%h(:, iy), ix)
            if (abs(change) > excluded_threshold) then
               climbing = huge(climbing)
               return
            end if
            climbing = climbing + result%pn(ix, iy)*change
         end do
      end do
      climbing = -rolling_direction(problem)*climbing/result%grid%dx
   end function climbing

   !> Part of the elastic energy that pressures have [J]
   pure real(wp) function normal_energy(result) result(energy)
      !> Solved
      type(patch_result), intent(in) :: result

      energy = result%grid%dx*result%grid%dy/(2.0_wp*nmm_per_joule)*sum(result%pn*result%un)
   end function normal_energy

   !> Error of that part, with its sign [J]; not known where the surface is not quadratic, or bodies are coupled or relax
   pure subroutine error_of_normal_energy(problem, result, coarse, e, is_known)
      !> The problem that was solved
      type(patch_problem), intent(in) :: problem
      !> Solved, on both levels
      type(patch_result), intent(in) :: result, coarse
      !> With its sign [J]
      real(wp), intent(out) :: e
      !> Does the theorem hold?
      logical, intent(out) :: is_known
      real(wp) :: virial, distances, potential, ratio

      e = 0.0_wp
      is_known = problem%solves_for_pressure() .and. .not. (problem%model%coupled() .or. allocated(problem%model%memory) &
         & .or. allocated(problem%parts))
      if (is_known) call distance_sums(result, virial, distances, is_known)
      if (.not. is_known) return
      ratio = virial/max(distances, tiny(ratio))
      is_known = abs(ratio - 2.0_wp) < quadratic
      ! with the approach given, the elastic energy is the potential energy itself, with the other sign
      e = (normal_energy(coarse) - normal_energy(result))/potential_ratio
      if (.not. problem%force_prescribed) return
      potential = (coarse%pen - result%pen)*result%fn/nmm_per_joule - (normal_energy(coarse) - normal_energy(result))
      e = (ratio*potential/potential_ratio + normal_energy(result) - virial)/(1.0_wp + ratio)
   end subroutine error_of_normal_energy

   !> Sums of pressures times the slope of the surface along the way from their centre, and times the distance of the surface above
   !> its lowest element
   pure subroutine distance_sums(result, virial, distances, is_known)
      !> Solved
      type(patch_result), intent(in) :: result
      !> [J]
      real(wp), intent(out) :: virial, distances
      !> Are the slopes known wherever there is pressure?
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

   !> Change per element at a place of a line: exact for polynomials of degree four, next to the ends of degree two; huge where
   !> it is not known
   pure real(wp) function slope(line, i)
      !> Values, huge where there is none
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
