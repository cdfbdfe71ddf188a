!> Estimated errors of totals that are zero
program test_level_errors
   use, intrinsic :: ieee_exceptions, only : ieee_get_flag, ieee_invalid, ieee_overflow, ieee_set_flag
   use contact_base_kinds, only : wp
   use contact_patch_error_scales, only : scale_type
   use contact_patch_level_errors, only : error_of
   use contact_patch_quantities, only : error_law, total
   use contact_patch_result, only : error_estimate
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   type(test_suite) :: suite
   type(scale_type) :: scale
   type(error_estimate) :: errors

   call suite%start("errors from levels")
   scale%across = 20.0_wp
   scale%mean_across = 20.0_wp
   scale%order = 2.0_wp
   scale%jumps = .true.
   scale%sticking = 1.0_wp
   scale%adhesion = 1.0_wp
   scale%power = 100.0_wp
   scale%roughness = 0.5_wp
   scale%heat%rise = 20.0_wp
   call check_zero(total(name="friction_power", law=error_law%power), 0.01_wp*scale%power)
   call check_zero(total(name="max_temp1", law=error_law%peak), 1.0e-3_wp*scale%heat%rise)
   call suite%finish()

contains

   !> A total may be zero, as power where all elements adhere, or a temperature in degC: its error is not, and nothing overflows
   subroutine check_zero(row, least)
      !> The total
      type(total), intent(in) :: row
      !> Lower bound of its error, in its unit
      real(wp), intent(in) :: least
      real(wp) :: e
      logical :: raised(2)

      call ieee_set_flag([ieee_overflow, ieee_invalid], .false.)
      e = error_of(row, 0.0_wp, scale, errors)
      call ieee_get_flag([ieee_overflow, ieee_invalid], raised)
      call suite%check(.not. any(raised), trim(row%name) // " of zero: no overflow")
      call suite%check(e > least .and. e < huge(e), trim(row%name) // " of zero: its error is not zero")
   end subroutine check_zero
end program test_level_errors
