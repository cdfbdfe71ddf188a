!> Errors of transient rolling in steps that are longer than elements, where levels tell little
!>
!> At a fixed step errors fall with a power of the length of the elements of a half to one, as tractions start anew in a strip as
!> long as the step ahead of what was in contact before. On the coarse level the step is a third as many elements long, and the
!> difference of the levels may be small by accident. So errors of so many elements in general stand beside it, which the part of
!> the contact that sticks foretells. Numbers are of random contacts with steps of 0.06 to 0.5 of the half length, from the first
!> step to the eighth (tests/accuracy/errors.py --kinds steps); see doc/theory/errors.md.
module contact_patch_step_errors
   use contact_base_kinds, only : wp
   implicit none (type, external)
   private

   public :: energy_of_forces, force_error, power_error

   !> Errors of forces over n^-1: where all sticks or slips, and what half of each adds
   real(wp), parameter :: force_floor = 0.2_wp, force_border = 0.7_wp
   !> What the levels tell counts as at least this part of the error in general
   real(wp), parameter :: least_told = 0.2_wp
   !> Power over that of full sliding: factor of n^-1; its power over that of full sliding, with a least part, and the exponent;
   !> part of what the levels differ by that counts at least
   real(wp), parameter :: power_floor = 0.4_wp, least_power = 0.01_wp, power_exponent = 0.7_wp, power_told = 0.2_wp
   !> Relative error of the elastic energy of tractions over that of tractions themselves
   real(wp), parameter :: energy_of_forces = 0.6_wp

contains

   !> Relative error of tangential forces: what the levels tell and the error in general, in the mean of their logarithms
   pure real(wp) function force_error(told, adhesion, across) result(e)
      !> Difference of the levels over the friction bound [-]
      real(wp), intent(in) :: told
      !> Part of the elements in contact that sticks [-]
      real(wp), intent(in) :: adhesion
      !> Elements across the contact
      real(wp), intent(in) :: across

      e = usual_error(adhesion, across)*sqrt(max(told/usual_error(adhesion, across), least_told))
   end function force_error

   !> Relative error of tangential forces of so many elements in general
   pure real(wp) function usual_error(adhesion, across) result(e)
      !> See force_error
      real(wp), intent(in) :: adhesion, across

      e = (force_floor + 4.0_wp*force_border*adhesion*(1.0_wp - adhesion))/across
   end function usual_error

   !> Error of frictional power, over that of full sliding
   pure real(wp) function power_error(power, difference, told, adhesion, across, elements) result(e)
      !> Power, and what the levels differ by, both over that of full sliding [-]
      real(wp), intent(in) :: power, difference
      !> See force_error
      real(wp), intent(in) :: told, adhesion, across
      !> Length of the step [elements]
      real(wp), intent(in) :: elements
      real(wp) :: irregular

      irregular = max(1.0_wp, force_error(told, adhesion, across)/usual_error(adhesion, across))
      e = max(irregular*power_floor*(power + least_power)**power_exponent*sqrt(elements)/across, power_told*difference)
   end function power_error
end module contact_patch_step_errors
