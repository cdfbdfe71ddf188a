!> Errors of transient rolling with steps longer than elements, where the difference of levels is a poor indicator
!>
!> At fixed step, errors decrease with a power 1/2 to 1 of the element length, as tractions start anew in a strip of the length of
!> the step ahead of the previous contact area. On the coarse level the step has a third of the number of elements, and the
!> difference of the levels may be small by accident. It is therefore combined with the typical error for this number of elements, a
!> function of the fraction of the contact in adhesion. Constants are fitted to random contacts with steps of 0.06 to 0.5 of the
!> semi-axis, from the first step to the eighth (tests/accuracy/errors.py --kinds steps); see doc/theory/errors.md.
module contact_patch_step_errors
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: energy_of_forces, energy_of_steps, force_error, power_error

   !> Typical error of forces times n: in full adhesion or full sliding, and the addition with equal areas of both; medians of 132
   !> contacts (kind transient, seeds 99711 to 99714)
   real(wp), parameter :: force_floor = 0.1_wp, force_border = 0.4_wp
   !> Lower bound of the difference of levels, relative to the typical error, and exponent of it: differences are hardly correlated
   !> with errors (same contacts)
   real(wp), parameter :: least_ratio = 0.4_wp, difference_power = 0.3_wp
   !> The same exponent for creepages; chosen with the test hard_friction, where a creepage is a hundredth of its error
   real(wp), parameter :: creepage_power = 0.6_wp
   !> Power relative to that of full sliding: factor of n^-1, lower bound of the power and its exponent; factor of the difference of
   !> levels, a lower bound of the error
   real(wp), parameter :: power_floor = 0.4_wp, least_power = 0.01_wp, power_exponent = 0.7_wp, power_share = 0.2_wp
   !> Ratio of the relative error of the elastic energy of tractions to that of the tractions; the same in long steps in full
   !> adhesion and in sliding, where tractions are larger at all positions; largest fraction in adhesion with the latter (kinds
   !> transient and steps, seeds 61001, 61002 and 95001)
   real(wp), parameter :: energy_of_forces = 0.6_wp, adhesive_energy = 0.5_wp, sliding_energy = 1.7_wp, slides = 0.4_wp

contains

   !> Relative error of tangential forces: weighted geometric mean of the difference of levels and the typical error
   pure real(wp) function force_error(estimate, adhesion, across, is_creepage) result(e)
      !> Difference of the levels relative to the maximum frictional force [-]
      real(wp), intent(in) :: estimate
      !> Fraction of the elements in contact that are in adhesion [-]
      real(wp), intent(in) :: adhesion
      !> Number of elements across the contact
      real(wp), intent(in) :: across
      !> Is it for a creepage, which may be much smaller than its error? Default: no
      logical, intent(in), optional :: is_creepage
      real(wp) :: power

      power = difference_power
      if (present(is_creepage)) power = merge(creepage_power, difference_power, is_creepage)
      e = usual_error(adhesion, across)*max(estimate/usual_error(adhesion, across), least_ratio)**power
   end function force_error

   !> Typical relative error of tangential forces with this number of elements
   pure real(wp) function usual_error(adhesion, across) result(e)
      !> See force_error
      real(wp), intent(in) :: adhesion, across

      e = (force_floor + 4.0_wp*force_border*adhesion*(1.0_wp - adhesion))/across
   end function usual_error

   !> Ratio of the relative error of the elastic energy of tractions to that of the tractions in long steps
   pure real(wp) function energy_of_steps(sticking) result(ratio)
      !> Fraction of the elements in contact that are in adhesion [-]
      real(wp), intent(in) :: sticking

      ratio = adhesive_energy + (sliding_energy - adhesive_energy)*min(1.0_wp, (1.0_wp - sticking)/(1.0_wp - slides))
   end function energy_of_steps

   !> Error of frictional power, relative to that of full sliding
   pure real(wp) function power_error(power, difference, estimate, adhesion, across, elements) result(e)
      !> Power, and difference of the levels, both relative to the power of full sliding [-]
      real(wp), intent(in) :: power, difference
      !> See force_error
      real(wp), intent(in) :: estimate, adhesion, across
      !> Length of the step, in elements [-]
      real(wp), intent(in) :: elements
      real(wp) :: irregular

      irregular = max(1.0_wp, force_error(estimate, adhesion, across)/usual_error(adhesion, across))
      e = max(irregular*power_floor*(power + least_power)**power_exponent*sqrt(elements)/across, power_share*difference)
   end function power_error
end module contact_patch_step_errors
