!> Refuses specifications with values that cannot be used in the computation, before it starts
!>
!> The reader of input files checks more, and reports the position in the file; this check serves all other callers, so that NaN and
!> infinity are never used silently.
module contact_cases_numbers
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : force_control, motion, normal_control, pressure_model, slip_source
   use contact_base_error, only : error_type, fatal_error
   use contact_base_kinds, only : wp
   use contact_text_bounds, only : check_number
   use contact_cases_spec, only : case_spec
   use contact_text_words, only : real_text
   implicit none (type, external)
   private

   public :: min_value, check_numbers, require_finite, require_nonzero, require_positive

   !> Curvatures [1/mm], lengths [mm] and ratios [-] below this value are regarded as missing
   real(wp), parameter :: min_value = 1.0e-20_wp

contains

   !> Report the first value in use that is not finite, or has an invalid sign
   subroutine check_numbers(spec, error)
      type(case_spec), intent(in) :: spec
      type(error_type), allocatable, intent(out) :: error

      call check_number("GG1", spec%material%gg(1), error)
      call check_number("GG2", spec%material%gg(2), error)
      call check_number("POISS1", spec%material%poiss(1), error)
      call check_number("POISS2", spec%material%poiss(2), error)
      if (spec%pressure == pressure_model%thin_sheet) call check_number("FLXZ", spec%material%flxz, error)
      call check_number("EPS", spec%iteration%eps, error)
      if (spec%normal == normal_control%force) then
         call check_number("FN", spec%kinematics%fn, error)
      else
         call check_number("PEN", spec%kinematics%pen, error)
      end if
      if (spec%motion /= motion%none) call check_friction(spec, error)
   end subroutine check_numbers

   !> Check the values of problems with friction
   subroutine check_friction(spec, error)
      type(case_spec), intent(in) :: spec
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(error)) return
      associate (kin => spec%kinematics)
         if (spec%force == force_control%creepages) then
            call check_number("CKSI", kin%cksi, error)
         else
            call check_number("FX", kin%fx, error)
         end if
         if (spec%force == force_control%fx_and_fy) then
            call check_number("FY", kin%fy, error)
         else
            call check_number("CETA", kin%ceta, error)
         end if
         call check_number("CPHI", kin%cphi, error)
         call check_number("SPINXO", kin%spinxo, error)
         call check_number("SPINYO", kin%spinyo, error)
      end associate
      if (spec%motion /= motion%shift) then
         call check_number("CHI", spec%rolling%chi, error)
         call check_number("DQ", spec%rolling%dq, error)
         call check_number("VELOC", spec%rolling%veloc, error)
         call check_number("FACPHI", spec%rolling%facphi, error)
      end if
      if (allocated(error)) return
      if (.not. allocated(spec%friction%sets)) then
         call fatal_error(error, "no coefficient of friction has been given")
         return
      end if
      ! the static coefficient of laws with falling friction may be zero, as the kinetic one
      call check_number("FKIN", spec%friction%sets(1)%fstat, error, "FSTAT")
      if (allocated(error)) return
      if (spec%slip_source /= slip_source%given) return
      if (.not. allocated(spec%extra_slip)) return
      if (.not. all(ieee_is_finite(spec%extra_slip))) &
         & call fatal_error(error, "the extra rigid slip must be finite in all elements")
   end subroutine check_friction

   !> Report a value that is infinite or NaN; an earlier error is kept
   subroutine require_finite(name, value, error)
      !> Name for the message
      character(len=*), intent(in) :: name
      !> Value in its unit
      real(wp), intent(in) :: value
      !> Allocated if there is an error
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(error) .or. ieee_is_finite(value)) return
      call fatal_error(error, "the " // name // " must be a finite number")
   end subroutine require_finite

   !> Report a value that is zero or close to zero, infinite or NaN
   subroutine require_nonzero(name, value, error)
      !> Name for the message
      character(len=*), intent(in) :: name
      !> Value in its unit
      real(wp), intent(in) :: value
      !> Allocated if there is an error
      type(error_type), allocatable, intent(inout) :: error

      call require_finite(name, value, error)
      if (allocated(error)) return
      if (abs(value) > min_value) return
      call fatal_error(error, "the " // name // " must not be zero")
   end subroutine require_nonzero

   !> Report a value that is not clearly positive, infinite or NaN
   subroutine require_positive(name, value, error)
      !> Name for the message
      character(len=*), intent(in) :: name
      !> Value in its unit
      real(wp), intent(in) :: value
      !> Allocated if there is an error
      type(error_type), allocatable, intent(inout) :: error

      call require_finite(name, value, error)
      if (allocated(error)) return
      if (value > min_value) return
      call fatal_error(error, "the " // name // " must be positive, it is " // real_text(value))
   end subroutine require_positive
end module contact_cases_numbers
