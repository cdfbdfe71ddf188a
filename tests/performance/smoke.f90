!> A short benchmark that judges counts, not seconds: transforms, products, requests to the heap
program performance_smoke
   use contact_base_choices, only : estimate_choice
   use contact_base_kinds, only : long, wp
   use contact_base_solve_report, only : solve_report
   use contact_bench_measure, only : allocations
   use contact_bench_problems, only : new_line_case, new_normal_case, new_rolling_case, new_table_case, normal_case, &
      & rolling_contacts, session_case, set_table_kind, solve_one, table_creepage, table_kind, table_kinds, tangential_case
   use contact_tangential_classical, only : classical_method, method_name
   use contact_test_harness, only : test_suite
   implicit none (type, external)

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

   do k = classical_method%tang_cg, classical_method%gd_steady
      call sweeps_without_heap(k)
   end do

   call new_line_case(session)
   call solve_one(session)
   call suite%check(session%result%tangential%succeeded() .and. session%result%tangential%products <= 100, &
      & "problem of one row in 100 products " // found(real(session%result%tangential%products, wp)))

   call table_cases()
   do k = 1, size(table_kinds)
      call repeated_cases(table_kinds(k))
   end do
   call normal%release()
   call tangential%release()
   call session%release()
   call suite%finish()

contains

   !> Classical methods ask for memory once per call, not in their iterations
   subroutine sweeps_without_heap(method)
      !> Member of classical_method
      integer, intent(in) :: method
      integer, parameter :: limits(2) = [4, 12]
      integer(long) :: before, requests(2)
      integer :: i, repetition

      call new_rolling_case(rolling_contacts(1), 40, 1.0e-9_wp, tangential)
      tangential%problem%steady = method /= classical_method%tang_cg
      tangential%method = method
      do i = 1, size(limits)
         tangential%problem%settings%maxgs = limits(i)
         ! the first call makes room for the second one
         do repetition = 1, 2
            before = allocations()
            call tangential%run(report)
            requests(i) = allocations() - before
         end do
         call suite%check(report%iterations == limits(i) .or. report%gave_up /= "", "all iterations, " // trim(method_name(method)))
      end do
      if (before < 0) then
         call suite%skip("requests to the heap", "they cannot be counted here")
      else
         call suite%equal(int(requests(2) - requests(1)), 0, "requests of more iterations, " // trim(method_name(method)))
      end if
      call tangential%release()
   end subroutine sweeps_without_heap

   !> Cases of a table: they converge by Newton-Krylov, with few products
   subroutine table_cases()
      integer, parameter :: cases = 60
      real(wp) :: creepage(3), products
      integer :: i, failed

      call new_table_case(11, session)
      call solve_one(session)
      session%spec%estimate = estimate_choice%previous
      products = 0.0_wp
      failed = 0
      do i = 1, cases
         creepage = table_creepage(50*i)
         session%spec%kinematics%cksi = creepage(1)
         session%spec%kinematics%ceta = creepage(2)
         session%spec%kinematics%cphi = creepage(3)
         call solve_one(session)
         products = products + session%result%tangential%products
         if (.not. session%result%tangential%succeeded()) failed = failed + 1
         if (session%result%tangential%gave_up /= "") failed = failed + 1
      end do
      call suite%equal(failed, 0, "cases of a table without success")
      call suite%check(products/cases <= 30.0_wp, "cases of a table: 30 products in the mean " // found(products/cases))
   end subroutine table_cases

   !> Repeated cases work in the arrays of the cases before
   subroutine repeated_cases(kind)
      type(table_kind), intent(in) :: kind
      !> Cases, and those at the beginning that may ask for room
      integer, parameter :: cases = 20, first = 5
      real(wp) :: creepage(3)
      integer :: i
      integer(long) :: before, requests

      call new_table_case(19, session)
      call set_table_kind(kind%name, session)
      before = allocations()
      do i = 1, cases
         creepage = table_creepage(150*i)
         session%spec%kinematics%cksi = creepage(1)
         session%spec%kinematics%ceta = creepage(2)
         session%spec%kinematics%cphi = creepage(3)
         call session%run(report)
         if (i == first) before = allocations()
      end do
      requests = allocations() - before
      if (before < 0) then
         call suite%skip("requests to the heap", "they cannot be counted here")
      else
         call suite%check(requests <= kind%requests*(cases - first), "repeated cases, " // trim(kind%name) // &
            & ": requests to the heap " // found(real(requests, wp)/(cases - first)))
      end if
   end subroutine repeated_cases

   !> "(found 12.3)"
   function found(value) result(text)
      real(wp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write(buffer, "(f0.1)") value
      text = "(found " // trim(buffer) // ")"
   end function found
end program performance_smoke
