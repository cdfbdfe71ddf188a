!> The local model: small creepage without slip, full sliding, mirror symmetry, and how near it is to the solution
program test_local_estimate
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_elastic_material, only : combine
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_tangential_local_estimate, only : estimate_locally
   use contact_tangential_nested, only : nested_workspace, release_nested, solve_newton_krylov
   use contact_tangential_problem, only : prepare_solution, tangential_problem, tangential_solution
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: n = 21
   real(wp), parameter :: dx = 0.1_wp
   type(test_suite) :: suite
   type(elastic_operator) :: operator
   type(tangential_problem) :: problem
   real(wp) :: scratch(n, n, 2), mirrored(n, n, 2)
   integer :: level, ix, iy
   !> Rigid slip per step [mm]: hardly any slip, partial slip, full sliding
   real(wp), parameter :: slips(3) = [1.0e-7_wp, 3.0e-5_wp, 1.0e-2_wp]

   call suite%start("local estimate")
   problem%mx = n
   problem%my = n
   problem%dx = dx
   problem%dy = dx
   problem%dq = dx
   problem%steady = .true.
   problem%settings%eps = 1.0e-8_wp
   allocate(problem%contact(n, n), problem%bound(n, n), problem%shift(n, n, 2))
   do iy = 1, n
      do ix = 1, n
         problem%bound(ix, iy) = 100.0_wp*sqrt(max(0.0_wp, 1.0_wp - ((ix - 11)**2 + (iy - 11)**2)/100.0_wp))
      end do
   end do
   problem%contact = problem%bound > 0.0_wp
   call operator%prepare(elastic_model(combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])), dx, dx, n, n, 1)
   do level = 1, size(slips)
      call rolling(slips(level))
   end do
   call a_shift()
   call operator%release()
   call suite%finish()

contains

   !> Rolling both ways
   subroutine rolling(slip)
      real(wp), intent(in) :: slip
      real(wp), allocatable :: p(:, :, :)
      real(wp) :: solved
      integer :: k

      problem%direction = 1
      problem%shift(:, :, 1) = slip
      problem%shift(:, :, 2) = 0.5_wp*slip
      allocate(p, mold=scratch)
      call estimate_locally(problem, operator, p, scratch)
      call suite%check(all(hypot(p(:, :, 1), p(:, :, 2)) <= problem%bound*(1.0_wp + 1.0e-12_wp)), "inside the bound")
      call suite%check(all(p(:, :, 1) <= 0.0_wp .and. p(:, :, 2) <= 0.0_wp), "tractions oppose the slip")
      problem%direction = -1
      call estimate_locally(problem, operator, mirrored, scratch)
      do k = 1, n
         call suite%close_to(reshape(mirrored(k, :, :), [2*n]), reshape(p(n + 1 - k, :, :), [2*n]), 1.0e-9_wp, &
            & "rolling the other way is the mirror image")
      end do
      problem%direction = 1
      solved = force_of_solution()
      call suite%close_to(sum(p(:, :, 1)), solved, merge(1.0e-3_wp, 0.2_wp, slip > 1.0e-3_wp), "near the force of the solution", &
         & relative=.true.)
   end subroutine rolling

   !> Without slip, every element of a shift has the same traction
   subroutine a_shift()
      real(wp), allocatable :: p(:, :, :)
      logical :: inner(n, n)

      problem%steady = .false.
      problem%shift(:, :, 1) = -5.0e-4_wp
      problem%shift(:, :, 2) = 0.0_wp
      allocate(p, mold=scratch)
      call estimate_locally(problem, operator, p, scratch)
      inner = problem%bound > p(:, :, 1)*(1.0_wp + 1.0e-9_wp)
      call suite%check(any(inner) .and. any(problem%contact .and. .not. inner), "a shift with elements of both kinds")
      call suite%close_to(maxval(p(:, :, 1), inner), minval(p(:, :, 1), inner), 1.0e-9_wp, "the same traction in all that adhere")
      problem%steady = .true.
   end subroutine a_shift

   real(wp) function force_of_solution()
      type(tangential_solution) :: solution
      type(nested_workspace) :: workspace
      type(solve_report) :: report

      call prepare_solution(problem, solution)
      call solve_newton_krylov(problem, operator, workspace, solution, report)
      call suite%check(report%succeeded(), "the tangential problem converges")
      force_of_solution = sum(solution%p(:, :, 1))
      call release_nested(workspace)
   end function force_of_solution
end program test_local_estimate
