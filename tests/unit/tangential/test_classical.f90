!> The classical tangential solvers against each other and against known cases
program test_classical
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_value
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_halfspace, only : fill_shifted_table, kernel_table
   use contact_elastic_material, only : combined_material
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_grid_element_division, only : element
   use contact_tangential_classical, only : classical_method, method_name, solve_classical
   use contact_tangential_element_problem, only : element_compliance, solve_element
   use contact_tangential_problem, only : apply_operator, contact_residual, residual_scale, tangential_problem, &
      & tangential_solution
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   !> Friction coefficient and normal force of all cases
   real(wp), parameter :: mu = 0.3_wp, fn = 82000.0_wp
   integer, parameter :: rolling(3) = [classical_method%steady_gs, classical_method%convex_gs, classical_method%gd_steady]
   type(test_suite) :: suite
   type(log_type) :: log

   call suite%start("classical tangential solvers")
   call element_problems()
   call known_values()
   call steady_solvers_agree()
   call gd_steady_means_the_residual()
   call shift_solvers_agree()
   call shapes()
   call mirrored()
   call forces_rolling()
   call forces_shift()
   call limits()
   call hostile_input()
   call suite%finish()

contains

   !> Elliptical contact of semi-axes 8 by 4 mm, pressure given, cropped to the contact
   subroutine ellipse(n, creep, direction, steady, problem, operator, scale, rows)
      !> Elements over the long side
      integer, intent(in) :: n
      !> Creepages xi, eta, phi
      real(wp), intent(in) :: creep(3)
      integer, intent(in) :: direction
      logical, intent(in) :: steady
      type(tangential_problem), intent(out) :: problem
      type(elastic_operator), intent(inout) :: operator
      !> Size of the window relative to the axes
      real(wp), intent(in) :: scale
      integer, intent(in), optional :: rows
      real(wp), parameter :: aa = 8.0_wp, bb = 4.0_wp, pi = acos(-1.0_wp)
      real(wp) :: x, y, h
      integer :: ix, iy
      logical, allocatable :: inside(:, :)
      integer :: x0, x1, y0, y1, m

      m = n
      if (present(rows)) m = rows
      problem%dx = 2.0_wp*aa*scale/n
      problem%dy = 2.0_wp*bb*scale/m
      problem%dq = merge(problem%dx, 1.0_wp, steady)
      problem%steady = steady
      problem%direction = direction
      problem%settings%eps = 1.0e-6_wp
      allocate(inside(n, m))
      do iy = 1, m
         do ix = 1, n
            x = (ix - 0.5_wp)*problem%dx - aa*scale
            y = (iy - 0.5_wp)*problem%dy - bb*scale
            inside(ix, iy) = (x/aa)**2 + (y/bb)**2 < 1.0_wp
         end do
      end do
      x0 = findloc(any(inside, 2), .true., 1)
      x1 = findloc(any(inside, 2), .true., 1, back=.true.)
      y0 = findloc(any(inside, 1), .true., 1)
      y1 = findloc(any(inside, 1), .true., 1, back=.true.)
      problem%mx = x1 - x0 + 1
      problem%my = y1 - y0 + 1
      problem%contact = inside(x0:x1, y0:y1)
      allocate(problem%bound(problem%mx, problem%my), source=0.0_wp)
      allocate(problem%shift(problem%mx, problem%my, 2), source=0.0_wp)
      do iy = 1, problem%my
         do ix = 1, problem%mx
            x = (ix + x0 - 1.5_wp)*problem%dx - aa*scale
            y = (iy + y0 - 1.5_wp)*problem%dy - bb*scale
            h = max(0.0_wp, 1.0_wp - (x/aa)**2 - (y/bb)**2)
            if (problem%contact(ix, iy)) problem%bound(ix, iy) = mu*1.5_wp*fn/(pi*aa*bb)*sqrt(h)
            problem%shift(ix, iy, 1) = problem%dq*(creep(1) - creep(3)*y)
            problem%shift(ix, iy, 2) = problem%dq*(creep(2) + creep(3)*x)
            if (steady) problem%shift(ix, iy, 2) = problem%shift(ix, iy, 2) &
               & + problem%dq*creep(3)*direction*problem%dq/6.0_wp
         end do
      end do
      call operator%prepare(elastic_model(combined_material(82000.0_wp, 0.28_wp, 0.0_wp)), problem%dx, problem%dy, &
         & problem%mx, problem%my, direction)
   end subroutine ellipse

   !> Relative force: sum of tractions over sum of bounds
   pure function force(problem, solution) result(f)
      type(tangential_problem), intent(in) :: problem
      type(tangential_solution), intent(in) :: solution
      real(wp) :: f(2)
      f = [sum(solution%p(:, :, 1)), sum(solution%p(:, :, 2))]/sum(problem%bound)
   end function force

   !> Solve without an estimate
   subroutine solve(problem, operator, method, solution, report, what)
      type(tangential_problem), intent(in) :: problem
      type(elastic_operator), intent(inout) :: operator
      integer, intent(in) :: method
      type(tangential_solution), intent(out) :: solution
      type(solve_report), intent(out) :: report
      character(len=*), intent(in) :: what
      real(wp) :: f(2)

      call solve_classical(problem, operator, method, solution, report, log)
      f = 0.0_wp
      if (sum(problem%bound) > 0.0_wp) f = force(problem, solution)
      print "(a, a24, 1x, a9, i5, i6, f8.0, es10.2, 2f10.6, i6, 2es14.6, i3)", "  ", what, method_name(method), report%iterations, &
         & report%products, report%fft_pairs, report%residual, f, count(solution%division == element%adhesion), &
         & solution%creep, report%ended
      call suite%check(all(hypot(solution%p(:, :, 1), solution%p(:, :, 2)) <= problem%bound*(1.0_wp + 1e-12_wp)), &
         & what // ", " // method_name(method) // ": admissible")
      if (report%gave_up /= "") print "(6x, 2a)", "gave up: ", trim(report%gave_up)
   end subroutine solve

   !> Conditions of one element, by definition
   subroutine element_problems()
      type(element_compliance) :: c
      real(wp) :: s0(2), p(2), s(2), g, u(6)
      integer :: trial, state

      do trial = 1, 300
         call pseudo_random(trial, u)
         c = element_compliance(0.5_wp + u(1), 0.5_wp + u(2), 0.4_wp*(u(3) - 0.5_wp))
         if (mod(trial, 3) == 0) c%xy = 0.0_wp
         s0 = u(4:5) - 0.5_wp
         g = 10.0_wp**(8.0_wp*u(6) - 7.0_wp)
         call solve_element(c, s0, g, p, state)
         s = s0 + [c%xx*p(1) + c%xy*p(2), c%xy*p(1) + c%yy*p(2)]
         if (state == element%adhesion) then
            call suite%check(norm2(s) < 1e-13_wp .and. norm2(p) <= g, "adhesion: no slip, within the bound")
         else
            call suite%check(abs(norm2(p) - g) <= 1e-13_wp*g .and. abs(p(1)*s(2) - p(2)*s(1)) <= 1e-12_wp*g &
               & .and. dot_product(p, s) <= 0.0_wp, "slip: at the bound, opposite to the slip")
         end if
      end do
      call solve_element(c, [0.1_wp, 0.0_wp], 0.0_wp, p, state)
      call suite%check(all(p == 0.0_wp) .and. state == element%slip, "no bound: slip without traction")
      call solve_element(c, [0.0_wp, 0.0_wp], 0.0_wp, p, state)
      call suite%check(all(p == 0.0_wp) .and. state == element%adhesion, "no creepage and no tractions: adhesion")
   end subroutine element_problems

   !> Repeatable numbers between 0 and 1
   pure subroutine pseudo_random(seed, u)
      integer, intent(in) :: seed
      real(wp), intent(out) :: u(:)
      integer :: i
      real(wp) :: z

      do i = 1, size(u)
         z = sin(12.9898_wp*seed + 78.233_wp*i)*43758.5453_wp
         u(i) = z - floor(z)
      end do
   end subroutine pseudo_random

   !> Values of independent prototypes: the geometry of the example fastsim
   subroutine known_values()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(solve_report) :: report
      integer :: k
      real(wp) :: f(2)

      call ellipse(44, [0.0_wp, -6.25e-4_wp, 6.25e-4_wp], 1, .true., problem, operator, 1.1_wp)
      do k = 1, 3
         call solve(problem, operator, rolling(k), solution, report, "fastsim 44x44")
         f = force(problem, solution)
         call suite%check(report%succeeded(), "fastsim: " // method_name(rolling(k)) // " converges")
         print "(a, f10.6, i5)", "   Fy/(mu Fn) = ", f(2)*sum(problem%bound)*problem%dx*problem%dy/(mu*fn), &
            & count(solution%division == element%adhesion)
         call suite%close_to(f(2)*sum(problem%bound)*problem%dx*problem%dy/(mu*fn), -0.60992_wp, 1.0e-4_wp, &
            & "fastsim: Fy by " // method_name(rolling(k)))
         call suite%check(abs(count(solution%division == element%adhesion) - 348) <= 2, &
            & "fastsim: adhering elements by " // method_name(rolling(k)))
      end do
      call operator%release()
   end subroutine known_values

   subroutine steady_solvers_agree()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution, reference
      type(elastic_operator) :: operator
      type(solve_report) :: report
      type(kernel_table) :: shifted
      real(wp), parameter :: cases(3, 5) = reshape([5e-4_wp, 0.0_wp, 0.0_wp, 0.0_wp, 5e-4_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, 6e-4_wp, 1e-3_wp, -7e-4_wp, 3e-4_wp, 1e-5_wp, 1e-5_wp, 0.0_wp], [3, 5])
      character(len=16) :: what
      integer :: i, k

      do i = 1, 5
         call ellipse(20, cases(:, i), 1, .true., problem, operator, 1.02_wp)
         problem%settings%eps = 1.0e-7_wp
         write(what, "(a, i0)") "creepages ", i
         call solve(problem, operator, classical_method%steady_gs, reference, report, what)
         call suite%check(report%ended == ending%converged, "SteadyGS converges, " // what)
         call suite%check(report%residual < 1.0e-5_wp, "SteadyGS solves, " // what)
         do k = 2, 3
            call solve(problem, operator, rolling(k), solution, report, what)
            call suite%check(report%residual < 1.0e-5_wp, method_name(rolling(k)) // " solves, " // what)
            call suite%close_to(reshape(solution%p, [size(solution%p)]), reshape(reference%p, [size(solution%p)]), &
               & merge(1.0e-3_wp, 2.0e-2_wp, k == 2), method_name(rolling(k)) // " as SteadyGS, " // what)
         end do
      end do
      ! one element per step, given as a shifted table
      call fill_shifted_table(shifted, combined_material(82000.0_wp, 0.28_wp, 0.0_wp), problem%dx, problem%dy, &
         & problem%mx + 1, problem%my, problem%dx, 0.0_wp)
      solution%p = 0.0_wp
      call solve_classical(problem, operator, classical_method%convex_gs, solution, report, log, shifted)
      call suite%close_to(reshape(solution%p, [size(solution%p)]), reshape(reference%p, [size(solution%p)]), &
         & 1.0e-3_wp, "ConvexGS with a shifted table")
      ! an oblique direction: only the conditions can be checked
      call fill_shifted_table(shifted, combined_material(82000.0_wp, 0.28_wp, 0.0_wp), problem%dx, problem%dy, &
         & problem%mx + 1, problem%my, problem%dx*0.9_wp, 0.4_wp*problem%dx)
      call solve_classical(problem, operator, classical_method%convex_gs, solution, report, log, shifted)
      print "(a, i5, es10.2)", "   oblique", report%iterations, report%residual
      call suite%check(report%ended == ending%converged .and. report%residual < 1.0e-4_wp, "ConvexGS, oblique direction")
      call operator%release()
   end subroutine steady_solvers_agree

   !> Converged GDsteady: the true residual is within the tolerance, at tolerances of all sizes; with prescribed forces that of
   !> the contact conditions, where forces are met within the tolerance as well
   subroutine gd_steady_means_the_residual()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(solve_report) :: report
      real(wp), parameter :: cases(3, 3) = reshape([5e-4_wp, 2e-4_wp, 1e-4_wp, 1e-3_wp, -7e-4_wp, 3e-4_wp, 5e-5_wp, 2e-4_wp, &
         & -1e-4_wp], [3, 3])
      real(wp) :: residual
      integer :: i, k, n_forces, converged(0:2)

      converged = 0
      do i = 1, size(cases, 2)
         call ellipse(20, cases(:, i), 1, .true., problem, operator, 1.02_wp)
         do n_forces = 0, 2
            problem%n_forces = n_forces
            problem%target = [0.6_wp, -0.3_wp]*0.2_wp*i*sum(problem%bound, mask=problem%contact)
            do k = 2, 12
               problem%settings%eps = 10.0_wp**(-0.5_wp*k)
               call solve(problem, operator, classical_method%gd_steady, solution, report, "tolerances")
               if (report%ended /= ending%converged) cycle
               converged(n_forces) = converged(n_forces) + 1
               residual = contact_residual(problem, solution%p, solution%slip, residual_scale(problem, operator))
               call suite%check(residual <= problem%settings%eps, "GDsteady: converged means the residual")
               call suite%check(report%residual <= 1.5_wp*problem%settings%eps, "GDsteady: forces are met")
            end do
         end do
      end do
      print "(a, 3i5)", "   GDsteady converged", converged
      call suite%check(all(converged > 20), "GDsteady converges")
   end subroutine gd_steady_means_the_residual

   subroutine shift_solvers_agree()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution, reference
      type(elastic_operator) :: operator
      type(solve_report) :: report
      real(wp), parameter :: cases(3, 4) = reshape([5e-3_wp, 0.0_wp, 0.0_wp, -3e-3_wp, 8e-3_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, 2e-3_wp, 3e-3_wp, 1e-3_wp, 1e-3_wp], [3, 4])
      character(len=16) :: what
      integer :: i

      do i = 1, 4
         call ellipse(24, cases(:, i), 1, .false., problem, operator, 1.02_wp)
         problem%settings%eps = 1.0e-7_wp
         problem%settings%omegah = 1.0_wp
         write(what, "(a, i0)") "shift ", i
         call solve(problem, operator, classical_method%convex_gs, reference, report, what)
         call suite%check(report%succeeded() .and. report%residual < 1.0e-5_wp, "ConvexGS solves, " // what)
         call solve(problem, operator, classical_method%tang_cg, solution, report, what)
         call suite%check(report%succeeded() .and. report%residual < 1.0e-5_wp, "TangCG solves, " // what)
         call suite%close_to(reshape(solution%p, [size(solution%p)]), reshape(reference%p, [size(solution%p)]), &
            & 2.0e-3_wp, "TangCG as ConvexGS, " // what)
      end do
      call operator%release()
   end subroutine shift_solvers_agree

   !> One element, one row, one column, rows with gaps, bounds of zero
   subroutine shapes()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution, reference
      type(elastic_operator) :: operator
      type(solve_report) :: report
      integer :: k, n, m, i
      integer, parameter :: sizes(2, 5) = reshape([1, 1, 30, 1, 1, 12, 9, 3, 2, 2], [2, 5])
      character(len=24) :: what
      logical :: steady

      do i = 1, 5
         n = sizes(1, i)
         m = sizes(2, i)
         do k = 1, 4
            steady = k /= classical_method%tang_cg
            call ellipse(n, [4e-4_wp, 2e-4_wp, 1e-4_wp], 1, steady, problem, operator, 1.0_wp, m)
            write(what, "(i0, a, i0)") n, " x ", m
            call solve(problem, operator, k, solution, report, trim(what))
            call suite%check(report%succeeded() .and. report%residual < 1.0e-4_wp, method_name(k) // " solves " // trim(what))
         end do
      end do
      do k = 1, 4
         steady = k /= classical_method%tang_cg
         call ellipse(20, [4e-4_wp, 2e-4_wp, 1e-4_wp], 1, steady, problem, operator, 1.0_wp)
         ! two runs per row, and elements without a bound
         problem%contact(9:10, :) = .false.
         problem%bound(9:10, :) = 0.0_wp
         problem%bound(3:4, 5:7) = 0.0_wp
         call solve(problem, operator, k, solution, report, "gaps")
         call suite%check(report%succeeded() .and. report%residual < 1.0e-4_wp, method_name(k) // " solves gaps")
         if (k == 2) reference = solution
         if (k > 2) call suite%close_to(reshape(solution%p, [size(solution%p)]), &
            & reshape(reference%p, [size(solution%p)]), 1.0e-2_wp, method_name(k) // " as SteadyGS, gaps")
      end do
      problem%contact = .false.
      problem%bound = 0.0_wp
      call solve(problem, operator, 2, solution, report, "nothing")
      call suite%check(report%ended == ending%not_started .and. all(solution%p == 0.0_wp), "no contact")
      call operator%release()
   end subroutine shapes

   !> Rolling towards decreasing x is the mirror image
   subroutine mirrored()
      type(tangential_problem) :: problem, image
      type(tangential_solution) :: solution, other
      type(elastic_operator) :: operator
      type(solve_report) :: report
      integer :: k

      do k = 2, 4
         call ellipse(21, [3e-4_wp, -4e-4_wp, 5e-4_wp], 1, .true., problem, operator, 1.02_wp)
         call solve(problem, operator, k, solution, report, "plain")
         call ellipse(21, [-3e-4_wp, -4e-4_wp, -5e-4_wp], -1, .true., image, operator, 1.02_wp)
         call solve(image, operator, k, other, report, "mirrored")
         call suite%close_to(reshape(other%p(image%mx:1:-1, :, 1), [size(problem%bound)]), &
            & reshape(-solution%p(:, :, 1), [size(problem%bound)]), 1.0e-6_wp, method_name(k) // ": px mirrored")
         call suite%close_to(reshape(other%p(image%mx:1:-1, :, 2), [size(problem%bound)]), &
            & reshape(solution%p(:, :, 2), [size(problem%bound)]), 1.0e-6_wp, method_name(k) // ": py mirrored")
      end do
      call operator%release()
   end subroutine mirrored

   !> Prescribed forces in rolling
   subroutine forces_rolling()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(solve_report) :: report
      real(wp), parameter :: targets(2, 5) = reshape([-0.2_wp, 0.0_wp, 0.5_wp, -0.4_wp, -0.99_wp, 0.0_wp, &
         & 0.7_wp, 0.7_wp, 0.0_wp, 0.0_wp], [2, 5])
      integer :: i, n, k
      real(wp) :: f(2)
      character(len=30) :: what

      do i = 1, 5
         do n = 1, 2
            do k = 1, 3
               call ellipse(20, [0.0_wp, 0.0_wp, merge(2.0e-4_wp, 0.0_wp, i /= 3)], 1, .true., problem, operator, 1.02_wp)
               problem%n_forces = n
               problem%settings%eps = 1.0e-5_wp
               problem%target = targets(:, i)*sum(problem%bound)
               if (n == 1) problem%target(2) = 0.0_wp
               write(what, "(a, i0, a, i0)") "force ", i, ", F=", n
               call solve(problem, operator, rolling(k), solution, report, trim(what))
               f = force(problem, solution)
               call suite%check(report%succeeded(), method_name(rolling(k)) // " converges, " // trim(what))
               call suite%close_to(f(:n), targets(:n, i), 1.0e-5_wp, method_name(rolling(k)) // " gets the force, " // trim(what))
               call suite%check(solution%sensitivity(1, 1) < 0.0_wp, "falling force, " // trim(what))
               call suite%check(report%residual < 1.0e-3_wp, method_name(rolling(k)) // " solves, " // trim(what))
            end do
         end do
      end do
      call operator%release()
   end subroutine forces_rolling

   !> Prescribed forces in a shift: Cattaneo and Mindlin's solution for an ellipse
   subroutine forces_shift()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(solve_report) :: report
      real(wp), parameter :: targets(2, 4) = reshape([-0.2_wp, 0.0_wp, 0.5_wp, -0.4_wp, -0.99_wp, 0.0_wp, &
         & 0.7_wp, 0.7_wp], [2, 4])
      integer, parameter :: methods(2) = [classical_method%tang_cg, classical_method%convex_gs]
      integer :: i, n, k
      real(wp) :: f(2)
      character(len=30) :: what

      do i = 1, 4
         do n = 1, 2
            do k = 1, 2
               call ellipse(24, [0.0_wp, 0.0_wp, 0.0_wp], 1, .false., problem, operator, 1.02_wp)
               problem%n_forces = n
               problem%settings%eps = 1.0e-5_wp
               problem%target = targets(:, i)*sum(problem%bound)
               if (n == 1) problem%target(2) = 0.0_wp
               write(what, "(a, i0, a, i0)") "shift force ", i, ", F=", n
               call solve(problem, operator, methods(k), solution, report, trim(what))
               f = force(problem, solution)
               call suite%check(report%succeeded(), method_name(methods(k)) // " converges, " // trim(what))
               call suite%close_to(f(:n), targets(:n, i), 1.0e-5_wp, method_name(methods(k)) // " gets the force, " // trim(what))
               call suite%check(report%residual < 1.0e-3_wp, method_name(methods(k)) // " solves, " // trim(what))
            end do
         end do
      end do
      call operator%release()
   end subroutine forces_shift

   !> Full sliding, full adhesion, no creepage
   subroutine limits()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(solve_report) :: report
      real(wp), allocatable :: u(:, :, :)
      integer :: k
      logical :: steady

      do k = 1, 4
         steady = k /= classical_method%tang_cg
         call ellipse(20, [3.0_wp, 4.0_wp, 0.0_wp], 1, steady, problem, operator, 1.02_wp)
         call solve(problem, operator, k, solution, report, "full sliding")
         call suite%check(report%succeeded(), method_name(k) // " converges in full sliding")
         call suite%close_to(force(problem, solution), [-0.6_wp, -0.8_wp], merge(1.0e-3_wp, 1.0e-2_wp, k == 1), &
            & method_name(k) // ": force in full sliding")
         call suite%equal(count(solution%division == element%adhesion), 0, method_name(k) // ": no adhesion")

         call ellipse(20, [1.0e-4_wp, 2.0e-4_wp, 1.0e-5_wp], 1, steady, problem, operator, 1.02_wp)
         where (problem%contact) problem%bound = 1.0e9_wp
         problem%settings%eps = 1.0e-8_wp
         call solve(problem, operator, k, solution, report, "full adhesion")
         call suite%check(report%succeeded(), method_name(k) // " converges in full adhesion")
         allocate(u, mold=problem%shift)
         call apply_operator(problem, operator, solution%p, u)
         u = u + problem%shift
         call suite%check(maxval(abs(u), spread(problem%contact, 3, 2)) < 1.0e-5_wp*maxval(abs(problem%shift)), &
            & method_name(k) // ": no slip in full adhesion")
         deallocate(u)

         call ellipse(20, [0.0_wp, 0.0_wp, 0.0_wp], 1, steady, problem, operator, 1.02_wp)
         call solve(problem, operator, k, solution, report, "no creepage")
         call suite%check(report%succeeded() .and. all(solution%p == 0.0_wp), method_name(k) // ": no tractions without creepage")
      end do
      call operator%release()
   end subroutine limits

   !> Infinite input ends at once, finite and admissible
   subroutine hostile_input()
      type(tangential_problem) :: problem
      type(tangential_solution) :: solution
      type(elastic_operator) :: operator
      type(solve_report) :: report
      integer :: k

      do k = 1, 4
         call ellipse(12, [1e-3_wp, 0.0_wp, 0.0_wp], 1, k /= 1, problem, operator, 1.02_wp)
         problem%shift(4, 5, 1) = ieee_value(1.0_wp, ieee_positive_inf)
         call solve_classical(problem, operator, k, solution, report, log)
         call suite%check(report%ended == ending%diverged .and. all(solution%p == 0.0_wp), method_name(k) // ": infinite shift")
         call ellipse(12, [1e-3_wp, 0.0_wp, 0.0_wp], 1, k /= 1, problem, operator, 1.02_wp)
         problem%settings%maxgs = 2
         call solve_classical(problem, operator, k, solution, report, log)
         call suite%check(.not. report%succeeded(), method_name(k) // ": iteration limit is reported")
      end do
      call operator%release()
   end subroutine hostile_input
end program test_classical
