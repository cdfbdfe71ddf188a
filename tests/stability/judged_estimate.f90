!> Estimated errors of hard cases against true ones, without grids finer than that of the case
!>
!> The case is solved with elements three times as long, by the coarse level of the estimates, and the errors of that solution are
!> estimated: from a level nine times as coarse. The true errors follow from the solution of the case itself.
module judged_estimate
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use contact_base_choices, only : time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_patch_error_estimate, only : coarse_level, estimate_errors, release_coarse_level, solve_coarse_level
   use contact_patch_quantities, only : error_law, error_scale, total_list
   use contact_patch_problem, only : patch_problem, patch_state
   use contact_patch_result, only : patch_result
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   private

   public :: judge_estimate

   !> An estimate below this fraction of the true error is wrong
   real(wp), parameter :: least = 0.1_wp
   !> Relative errors below these values are ignored: round-off, and tolerances of the cases
   real(wp), parameter :: small = 1.0e-4_wp

contains

   !> Solve a solved case on elements three times as long, and judge the errors that are estimated there
   subroutine judge_estimate(suite, problem, state, result, name)
      type(test_suite), intent(inout) :: suite
      !> A problem without a previous one, and its solution
      type(patch_problem), intent(in) :: problem
      type(patch_state), intent(in) :: state
      type(patch_result), intent(in) :: result
      character(len=*), intent(in) :: name
      type(coarse_level) :: level, lower
      type(patch_result) :: fine
      type(total_list) :: exact, found
      type(error_type), allocatable :: error
      character(len=160) :: text
      real(wp) :: scale, bound, true_error
      integer :: k

      if (.not. result%status%is_solved() .or. result%ncon == 0) return
      fine = result
      call solve_coarse_level(problem, state, time_link%initiate, level, fine, error)
      if (.not. allocated(error) .and. fine%errors%reason == "") then
         call estimate_errors(level%problem, level%state, time_link%initiate, max(1, level%result%tangential%order), lower, &
            & level%result, error)
         if (.not. allocated(error) .and. level%result%errors%reason == "") then
            call result%totals(exact)
            call level%result%totals(found)
            bound = result%grid%dx*result%grid%dy*sum(result%mu*result%pn)
            do k = 1, found%length
               associate (row => found%rows(k), estimate => level%result%errors%value(k))
                  if (.not. ieee_is_finite(estimate) .or. row%law == error_law%area .or. row%law == error_law%power) cycle
                  scale = abs(exact%rows(k)%value)
                  if (row%law == error_law%creepage) scale = max(abs(result%cksi), abs(result%ceta))
                  if (row%law == error_law%friction) then
                     scale = 1.0_wp
                     if (row%scale == error_scale%force) scale = bound
                     if (row%scale == error_scale%moment) scale = bound*sqrt(result%contact_area())
                  end if
                  true_error = abs(row%value - exact%rows(k)%value)
                  if (true_error <= small*scale) cycle
                  write(text, "(3a, es9.2, a, es9.2, a, es9.2)") name, ": estimated error of ", trim(row%name), estimate, " of ", &
                     & row%value, ", true ", true_error
                  call suite%check(estimate >= least*true_error, trim(text))
               end associate
            end do
         end if
      end if
      call release_coarse_level(lower)
      call release_coarse_level(level)
   end subroutine judge_estimate
end module judged_estimate
