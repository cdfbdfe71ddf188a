!> Status of the solution of a patch, from the reports of its iterations and from the prescribed forces
module contact_patch_status
   use contact_base_case_status, only : case_status, missed_iteration
   use contact_base_choices, only : motion
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: derive_status

contains

   !> Set the status of a patch whose totals are known
   subroutine derive_status(problem, outer, result)
      !> Prescribed forces and tolerances
      type(patch_problem), intent(in) :: problem
      !> Outer iteration between pressures and tractions
      type(solve_report), intent(in) :: outer
      !> Its status is set
      type(patch_result), intent(inout) :: result

      result%status = case_status()
      call result%status%record_iteration(missed_iteration%normal, "normal problem", result%normal)
      call check_forces(problem, result)
      if (.not. result%tangential%succeeded() .and. result%status%iteration /= missed_iteration%force) &
         & call result%status%record_iteration(missed_iteration%tangential, "tangential problem", result%tangential)
      if (allocated(result%friction)) call result%status%record_iteration(missed_iteration%outer, "friction law", result%friction)
      call result%status%record_iteration(missed_iteration%outer, "pressures and tractions", outer)
   end subroutine derive_status

   !> Check whether the prescribed tangential forces were reached
   subroutine check_forces(problem, result)
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(inout) :: result
      character(len=2), parameter :: name(2) = ["FX", "FY"]
      !> Maximum deviation of a force, in multiples of the tolerance, relative to the maximum possible force
      real(wp), parameter :: allowed = 2.0_wp
      !> Maximum possible force [N]
      real(wp) :: bound
      character(len=24) :: largest
      real(wp) :: requested(2), found(2)
      integer :: k, n

      n = problem%n_forces
      if (n == 0 .or. problem%motion == motion%none .or. result%ncon == 0) return
      bound = result%friction_bound()
      requested = problem%force*result%mu_scal*result%fn
      found = [result%fx, result%fy]
      do k = 1, n
         if (abs(found(k) - requested(k)) <= allowed*problem%settings%eps*bound) cycle
         if (norm2(requested(:n)) >= bound) then
            write(largest, "(G0.6)") bound
            call result%status%record_missed_force(name(k), requested(k), found(k), "friction gives no more than " // &
               & trim(largest) // " N")
         else if (result%nadh + result%nplast == 0) then
            call result%status%record_missed_force(name(k), requested(k), found(k), "all elements slide")
         else
            call result%status%record_missed_force(name(k), requested(k), found(k), "the search for the creepage ended before")
         end if
      end do
   end subroutine check_forces
end module contact_patch_status
