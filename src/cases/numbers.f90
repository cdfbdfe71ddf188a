!> Refuses specifications whose numbers cannot be computed with, before anything is computed
!>
!> The reader of input files checks more, and at the place in the file; this is the door for
!> everybody else, so that NaN and infinities never travel silently.
module contact_cases_numbers
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : force_control, motion, normal_control, slip_source
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_cases_geometry, only : require_finite, require_positive
   use contact_cases_spec, only : case_spec
   implicit none (type, external)
   private

   public :: check_numbers

contains

   !> Complain about the first number in use that is not finite, or has a sign without a meaning
   subroutine check_numbers(spec, error)
      type(case_spec), intent(in) :: spec
      type(error_type), allocatable, intent(out) :: error

      call require_positive("modulus of rigidity GG1", spec%material%gg(1), error)
      call require_positive("modulus of rigidity GG2", spec%material%gg(2), error)
      call require_finite("Poisson ratio POISS1", spec%material%poiss(1), error)
      call require_finite("Poisson ratio POISS2", spec%material%poiss(2), error)
      if (allocated(error)) return
      if (any(spec%material%poiss <= -1.0_wp .or. spec%material%poiss > 0.5_wp)) then
         call fatal_error(error, "Poisson ratios must be above -1 and at most 0.5")
         return
      end if
      call require_positive("tolerance EPS", spec%iteration%eps, error)
      if (spec%normal == normal_control%force) then
         call require_finite("normal force FN", spec%kinematics%fn, error)
      else
         call require_finite("approach PEN", spec%kinematics%pen, error)
      end if
      if (spec%motion /= motion%none) call check_friction(spec, error)
   end subroutine check_numbers

   !> Numbers of problems with friction
   subroutine check_friction(spec, error)
      type(case_spec), intent(in) :: spec
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(error)) return
      associate (kin => spec%kinematics)
         if (spec%force == force_control%creepages) then
            call require_finite("creepage or shift CKSI", kin%cksi, error)
         else
            call require_finite("tangential force FX", kin%fx, error)
         end if
         if (spec%force == force_control%fx_and_fy) then
            call require_finite("tangential force FY", kin%fy, error)
         else
            call require_finite("creepage or shift CETA", kin%ceta, error)
         end if
         call require_finite("spin CPHI", kin%cphi, error)
         call require_finite("spin centre SPINXO", kin%spinxo, error)
         call require_finite("spin centre SPINYO", kin%spinyo, error)
      end associate
      if (spec%motion /= motion%shift) then
         call require_finite("rolling direction CHI", spec%rolling%chi, error)
         call require_positive("rolling step DQ", spec%rolling%dq, error)
         call require_finite("rolling velocity VELOC", spec%rolling%veloc, error)
         call require_finite("offset FACPHI of the spin", spec%rolling%facphi, error)
      end if
      if (allocated(error)) return
      if (.not. allocated(spec%friction%sets)) then
         call fatal_error(error, "no coefficient of friction has been given")
         return
      end if
      call require_finite("coefficient of friction FSTAT", spec%friction%sets(1)%fstat, error)
      if (allocated(error)) return
      if (spec%friction%sets(1)%fstat < 0.0_wp) then
         call fatal_error(error, "the coefficient of friction FSTAT must not be negative")
         return
      end if
      if (spec%slip_source /= slip_source%given .and. spec%slip_source /= slip_source%keep) return
      if (.not. allocated(spec%extra_slip)) return
      if (.not. all(ieee_is_finite(spec%extra_slip))) &
         & call fatal_error(error, "the extra rigid slip must be finite in all elements")
   end subroutine check_friction
end module contact_cases_numbers
