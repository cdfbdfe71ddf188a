!> A series of cases whose next grid is not completed: the solution that is reported is the one that later cases continue
program test_accuracy_series
   use contact_base_choices, only : time_link
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : wp
   use contact_cases_accuracy_level, only : held_solution
   use contact_cases_spec, only : case_spec
   use contact_test_case_builder, only : grid_case, shift, test_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   !> Elements along each side, and displacement [mm]
   integer, parameter :: across = 18
   real(wp), parameter :: length = 1.0_wp, displacement = 2.0e-3_wp
   type(test_suite) :: suite

   call suite%start("accuracy_series")
   call times_out(suite)
   call suite%finish()

contains

   !> The second grid exceeds its time; the next case gives what it gives without the second grid
   subroutine times_out(suite)
      type(test_suite), intent(inout) :: suite
      type(test_case) :: direct, case
      type(held_solution) :: held
      type(error_type), allocatable :: error
      real(wp) :: first

      call start(direct, suite)
      call start(case, suite)
      first = case%result%fx
      call held%hold(case%session)

      case%spec = shifted(2*across)
      case%spec%limits%deadline%seconds = tiny(1.0_wp)
      call case%spec%limits%deadline%start()
      call case%try(error)
      call suite%check(allocated(error), "a grid without time has no solution")
      if (.not. allocated(error)) return
      call suite%check(error%kind == error_kind%time, "because of its time")
      call suite%check(case%result%ncon == 0, "and leaves no tractions")

      call held%restore(case%session)
      call go_on(direct, suite)
      call go_on(case, suite)
      call suite%check(abs(direct%result%fx - first) > 1.0e-3_wp*abs(first), "the next case changes the force")
      call suite%close_to(case%result%fx, direct%result%fx, 1.0e-12_wp*abs(first), "force of the next case")
      call suite%check(allocated(case%result%errors), "it has estimated errors")
      if (.not. (allocated(case%result%errors) .and. allocated(direct%result%errors))) return
      call suite%check(case%result%errors%reason == "", "the coarse level continues, too")
      call suite%check(maxval(abs(case%result%errors%value - direct%result%errors%value), &
         & mask=direct%result%errors%value > 0.0_wp) <= 1.0e-9_wp*abs(first), "with the same estimates")
   end subroutine times_out

   !> The first case of the series
   subroutine start(case, suite)
      type(test_case), intent(inout) :: case
      type(test_suite), intent(inout) :: suite

      case%spec = shifted(across)
      call case%run(suite, "the first case")
   end subroutine start

   !> The next one, shifted back
   subroutine go_on(case, suite)
      type(test_case), intent(inout) :: case
      type(test_suite), intent(inout) :: suite

      case%spec = shifted(across)
      case%spec%kinematics%cksi = -0.5_wp*displacement
      case%spec%link = time_link%continue_all
      call case%run(suite, "the next case")
   end subroutine go_on

   !> A sphere that is shifted, with estimated errors
   function shifted(n) result(spec)
      !> Elements along each side
      integer, intent(in) :: n
      type(case_spec) :: spec

      spec = grid_case(0.01_wp, 0.01_wp, 600.0_wp, n, n, length/n, length/n)
      call shift(spec, displacement, 0.0_wp, 0.3_wp)
      spec%estimates_errors = .true.
   end function shifted
end program test_accuracy_series
