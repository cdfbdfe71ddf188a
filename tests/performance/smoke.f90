!> A short benchmark that judges counts, not seconds: transforms, products, requests to the heap
program performance_smoke
   use contact_base_choices, only : estimate_choice
   use contact_base_kinds, only : long, wp
   use contact_base_solve_report, only : solve_report
   use contact_bench_measure, only : allocations
   use contact_bench_problems, only : new_line_case, new_normal_case, new_rolling_case, new_table_case, normal_case, &
      & rolling_contacts, session_case, solve_one, table_creepage, tangential_case
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   !> Requests to the heap of one case of a table that are accepted
   integer(long), parameter :: most_requests = 400_long
   type(test_suite) :: suite
   type(normal_case) :: normal
   type(tangential_case) :: tangential
   type(session_case) :: session
   type(solve_report) :: report
   integer :: k, control
   logical :: by_force

   call suite%start("performance")

   ! on a free boundary: 20 pairs to 1e-4, 45 to 1e-8, independent of the grid
   do k = 1, 2
      do control = 1, 2
         by_force = control == 1
         call new_normal_case(78*k, by_force, 1.0e-4_wp, normal)
         call normal%run(report)
         call suite%check(report%succeeded() .and. report%fft_pairs <= 20.0_wp, "normal problem to 1e-4 in 20 pairs " // &
            & found(report%fft_pairs))
         call new_normal_case(78*k, by_force, 1.0e-8_wp, normal)
         call normal%run(report)
         call suite%check(report%succeeded() .and. report%fft_pairs <= 45.0_wp, "normal problem to 1e-8 in 45 pairs " // &
            & found(report%fft_pairs))
      end do
   end do

   ! 100 products at 17k elements; here 4k, to be quick in debug builds too
   do k = 1, size(rolling_contacts)
      call new_rolling_case(rolling_contacts(k), 80, 1.0e-6_wp, tangential)
      call tangential%run(report)
      call suite%check(report%succeeded() .and. report%products <= 100, "rolling, " // trim(rolling_contacts(k)%name) // &
         & ": 100 products " // found(real(report%products, wp)))
   end do

   call new_line_case(session)
   call solve_one(session)
   call suite%check(session%result%tangential%succeeded() .and. session%result%tangential%products <= 100, &
      & "problem of one row in 100 products " // found(real(session%result%tangential%products, wp)))

   call table_cases()
   call normal%release()
   call tangential%release()
   call session%release()
   call suite%finish()

contains

   !> Cases of a table: they converge by Newton-Krylov, with few products
   subroutine table_cases()
      integer, parameter :: cases = 60
      real(wp) :: creepage(3), products
      integer :: i, failed
      integer(long) :: before, requests

      call new_table_case(11, session)
      call solve_one(session)
      session%spec%estimate = estimate_choice%previous
      products = 0.0_wp
      failed = 0
      requests = 0
      do i = 1, cases
         creepage = table_creepage(50*i)
         session%spec%kinematics%cksi = creepage(1)
         session%spec%kinematics%ceta = creepage(2)
         session%spec%kinematics%cphi = creepage(3)
         before = allocations()
         call solve_one(session)
         if (i > 5) requests = requests + allocations() - before
         products = products + session%result%tangential%products
         if (.not. session%result%tangential%succeeded()) failed = failed + 1
         if (allocated(session%result%tangential%gave_up)) failed = failed + 1
      end do
      call suite%equal(failed, 0, "cases of a table without success")
      call suite%check(products/cases <= 30.0_wp, "cases of a table: 30 products in the mean " // found(products/cases))
      if (before < 0) then
         call suite%skip("requests to the heap", "they cannot be counted here")
      else
         ! names in reports and estimates of pressures are left; arrays of the solvers are not
         call suite%check(requests/(cases - 5) <= most_requests, "cases of a table: few requests to the heap " // &
            & found(real(requests, wp)/(cases - 5)))
      end if
   end subroutine table_cases

   !> "(found 12.3)"
   function found(value) result(text)
      real(wp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write(buffer, '(f0.1)') value
      text = "(found " // trim(buffer) // ")"
   end function found
end program performance_smoke
