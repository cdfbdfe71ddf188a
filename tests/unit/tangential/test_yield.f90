!> Plastic shearing in the tangential room: return map, element problems, solvers against each other
program test_yield
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : solve_report
   use contact_elastic_material, only : combined_material
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_grid_element_division, only : element
   use contact_tangential_classical, only : classical_method, solve_classical
   use contact_tangential_element_problem, only : element_compliance, solve_yielding_element
   use contact_tangential_nested, only : nested_workspace, release_nested, solve_newton_krylov, traction_derivative
   use contact_tangential_problem, only : residual_scale, tangential_problem, tangential_solution
   use contact_tangential_yield, only : return_map, yield_point
   use contact_test_harness, only : test_suite
   implicit none (type, external)

   real(wp), parameter :: mu = 0.3_wp, pressure = 1000.0_wp, modulus = 82000.0_wp
   real(wp), parameter :: aa = 4.0_wp, bb = 3.0_wp
   !> Slopes: soft, hard, very hard, falling, falling fast [N/mm3]
   real(wp), parameter :: slopes(5) = [800.0_wp, 20000.0_wp, 4.0e6_wp, -400.0_wp, -2000.0_wp]
   type(test_suite) :: suite
   type(log_type) :: log

   call suite%start("plastic shearing")
   call return_maps()
   call element_problems()
   call falling_limits()
   call solvers_agree()
   call no_effect()
   call mirrored()
   call perfectly_plastic()
   call derivatives()
   call hard_cases()
   call suite%finish()

contains

   !> The map inverts m -> |p|(m) + r m, and its derivatives are those of differences
   subroutine return_maps()
      type(yield_point) :: point, ahead
      real(wp) :: g, before, slope, lowest, r, m, radius, length, worst, worst_slope
      real(wp), parameter :: h = 1.0e-6_wp
      integer :: trial

      worst = 0.0_wp
      worst_slope = 0.0_wp
      do trial = 1, 1000
         g = 0.1_wp + number(5*trial)
         before = 0.1_wp + number(5*trial + 1)
         slope = 4.0_wp*(number(5*trial + 2) - 0.5_wp)
         lowest = 0.1_wp*before
         r = 0.2_wp + max(0.0_wp, -1.5_wp*slope) + number(5*trial + 3)
         m = number(5*trial + 4)
         radius = g
         if (before < g) radius = min(g, max(lowest, before + slope*m))
         length = radius + r*m
         point = return_map(length, g, before, slope, lowest, r)
         worst = max(worst, abs(point%radius - radius))
         if (point%state == element%plastic) worst = max(worst, abs(point%plastic - m))
         if (point%state == element%plastic .and. radius > lowest) &
            & worst = max(worst, abs(point%limit - before - slope*m))
         ahead = return_map(length + h, g, before, slope, lowest, r)
         worst_slope = max(worst_slope, defect(ahead, point, h, point%radius_by_length, point%limit_by_length))
         ahead = return_map(length, g, before + h, slope, lowest, r)
         worst_slope = max(worst_slope, defect(ahead, point, h, point%radius_by_limit, point%limit_by_limit))
      end do
      call suite%check(worst < 1.0e-12_wp, "return map: |p| as a function of the plastic displacement")
      call suite%check(worst_slope < 1.0e-4_wp, "return map: derivatives")
   end subroutine return_maps

   !> Largest error of the derivatives, from a point a small distance h ahead
   pure real(wp) function defect(ahead, point, h, radius, limit)
      type(yield_point), intent(in) :: ahead, point
      real(wp), intent(in) :: h, radius, limit

      defect = 0.0_wp
      ! finite differences across a corner are meaningless
      if (ahead%state /= point%state .or. (point%plastic > 0.0_wp .neqv. ahead%plastic > 0.0_wp)) return
      if (point%limit_by_limit <= 0.0_wp .neqv. ahead%limit_by_limit <= 0.0_wp) return
      defect = max(abs((ahead%radius - point%radius)/h - radius), abs((ahead%limit - point%limit)/h - limit))
   end function defect

   !> Conditions of one element, by definition
   subroutine element_problems()
      type(element_compliance) :: c
      type(yield_point) :: point
      real(wp) :: s0(2), p(2), d(2), g, before, slope, lowest, worst, worst_direction
      integer :: trial, states(3)
      logical :: right

      worst = 0.0_wp
      worst_direction = 0.0_wp
      states = 0
      right = .true.
      do trial = 1, 3000
         c = element_compliance(0.5_wp + number(9*trial), 0.5_wp + number(9*trial + 1), 0.0_wp)
         if (mod(trial, 3) == 0) c%xy = 0.4_wp*(number(9*trial + 2) - 0.5_wp)
         s0 = 2.0_wp*[number(9*trial + 3), number(9*trial + 4)] - 1.0_wp
         g = 2.0_wp*number(9*trial + 5)
         before = 0.01_wp + number(9*trial + 6)
         slope = 6.0_wp*(number(9*trial + 7) - 0.5_wp)
         lowest = 0.2_wp*before
         call solve_yielding_element(c, s0, g, before, slope, lowest, p, point)
         d = s0 + [c%xx*p(1) + c%xy*p(2), c%xy*p(1) + c%yy*p(2)]
         states(point%state) = states(point%state) + 1
         if (point%state == element%adhesion) then
            worst = max(worst, norm2(d))
            right = right .and. norm2(p) <= min(g, before)
            cycle
         end if
         ! the remainder opposes the traction
         worst_direction = max(worst_direction, abs(d(1)*p(2) - d(2)*p(1)), dot_product(d, p))
         if (point%state == element%plastic) then
            worst = max(worst, abs(point%plastic - norm2(d)), abs(point%limit - norm2(p)), &
               & abs(norm2(p) - max(lowest, before + slope*norm2(d))))
            right = right .and. before < g .and. norm2(p) <= g*(1.0_wp + 1.0e-12_wp)
         else
            worst = max(worst, abs(norm2(p) - g), abs(point%limit - before - slope*point%plastic))
            right = right .and. point%plastic <= norm2(d)*(1.0_wp + 1.0e-10_wp)
         end if
      end do
      print "(a, 3i6)", "  adhering, slipping, yielding elements:", states
      call suite%check(worst < 1.0e-10_wp, "element problems: hardening and softening laws")
      call suite%check(worst_direction < 1.0e-10_wp, "element problems: plastic displacement along the traction")
      call suite%check(right, "element problems: bounds")
      call suite%check(all(states > 100), "element problems: all states occur")
   end subroutine element_problems

   !> Of several solutions the one with the smallest plastic displacement is taken
   subroutine falling_limits()
      type(yield_point) :: point
      real(wp) :: p(2)

      ! c = 1, limit 1, slope -2: beyond |S0| = 1 the element drops to the lowest limit at once
      call solve_yielding_element(element_compliance(), [-0.999_wp, 0.0_wp], 5.0_wp, 1.0_wp, -2.0_wp, 0.1_wp, p, point)
      call suite%equal(point%state, element%adhesion, "below the limit the element adheres, though it could yield")
      call solve_yielding_element(element_compliance(), [-1.001_wp, 0.0_wp], 5.0_wp, 1.0_wp, -2.0_wp, 0.1_wp, p, point)
      call suite%equal(point%state, element%plastic, "beyond it, it yields")
      call suite%close_to(p(1), 0.1_wp, 1.0e-12_wp, "down to the lowest limit")
      ! slope -1/2: one element is stable, |p| = (1 - |S0|/2)/(1 - 1/2)
      call solve_yielding_element(element_compliance(), [0.0_wp, -1.2_wp], 5.0_wp, 1.0_wp, -0.5_wp, 0.1_wp, p, point)
      call suite%close_to(p(2), (1.0_wp - 0.5_wp*1.2_wp)/0.5_wp, 1.0e-12_wp, "slow softening: closed form")
      call solve_yielding_element(element_compliance(), [-3.0_wp, 0.0_wp], 0.5_wp, 1.0_wp, -0.5_wp, 0.1_wp, p, point)
      call suite%equal(point%state, element%slip, "where friction is weaker than the layer, the element slips")
      call suite%close_to(point%limit, 1.0_wp, 0.0_wp, "and keeps its limit")
   end subroutine falling_limits

   !> Newton-Krylov and Gauss-Seidel methods on rolling and shifts, with and without forces
   subroutine solvers_agree()
      type(tangential_problem) :: problem
      type(elastic_operator) :: operator
      type(tangential_solution) :: newton, other
      integer :: k, forces, kind
      character(len=48) :: what

      do kind = 1, 3
         do k = 1, size(slopes)
            do forces = 0, 2
               if (forces > 0 .and. kind == 2) cycle
               write(what, "(a, es9.1, a, i1)") trim(merge("shift ", merge("chi=0 ", "chi=pi", kind == 2), kind == 1)) &
                  & // ", slope", slopes(k), ", F=", forces
               call ellipse(20, kind > 1, merge(-1, 1, kind == 3), problem, operator)
               call make_yield(problem, 120.0_wp, slopes(k))
               problem%n_forces = forces
               ! with a decreasing limit the force has a maximum over the creepage: start where it increases
               if (forces > 0) problem%shift(:, :, :forces) = spin_part(problem, forces)
               problem%target = [-0.35_wp, 0.15_wp]*sum(problem%bound)
               call solve(problem, operator, 0, newton, what)
               call solve(problem, operator, classical_method%convex_gs, other, what)
               call compare(what // " ConvexGS", newton, other)
               if (.not. problem%steady) cycle
               call solve(problem, operator, classical_method%steady_gs, other, what)
               call compare(what // " SteadyGS", newton, other)
            end do
         end do
      end do
      call operator%release()
   end subroutine solvers_agree

   !> A limit that is never reached: the same solution as without
   subroutine no_effect()
      type(tangential_problem) :: problem
      type(elastic_operator) :: operator
      type(tangential_solution) :: plain, strong
      integer :: kind, method
      integer, parameter :: methods(3) = [0, classical_method%steady_gs, classical_method%convex_gs]

      do kind = 1, 2
         do method = 1, size(methods)
            call ellipse(20, kind == 2, 1, problem, operator)
            call solve(problem, operator, methods(method), plain, "plain")
            call suite%check(.not. allocated(plain%plastic), "no yielding: nothing is stored")
            call make_yield(problem, 1.0e9_wp, 1000.0_wp)
            call solve(problem, operator, methods(method), strong, "strong layer")
            call suite%check(maxval(abs(strong%p - plain%p)) <= 1.0e-6_wp*maxval(problem%bound), &
               & "unreachable limit: tractions unchanged")
            call suite%check(maxval(abs(strong%plastic)) <= 0.0_wp, "unreachable limit: no plastic displacement")
         end do
      end do
      call operator%release()
   end subroutine no_effect

   !> Rolling to the other side is the mirror image
   subroutine mirrored()
      type(tangential_problem) :: problem
      type(elastic_operator) :: operator
      type(tangential_solution) :: one, other
      integer, parameter :: methods(3) = [0, classical_method%steady_gs, classical_method%convex_gs]
      integer :: method, m

      do method = 1, size(methods)
         call ellipse(16, .true., 1, problem, operator)
         call make_yield(problem, 120.0_wp, 20000.0_wp)
         call solve(problem, operator, methods(method), one, "chi=0")
         problem%direction = -1
         m = problem%mx
         problem%shift = problem%shift(m:1:-1, :, :)
         problem%shift(:, :, 1) = -problem%shift(:, :, 1)
         call operator%prepare(elastic_model(combined_material(modulus, 0.28_wp, 0.0_wp)), problem%dx, problem%dy, problem%mx, &
            & problem%my, -1)
         call solve(problem, operator, methods(method), other, "mirrored")
         other%p = other%p(m:1:-1, :, :)
         other%p(:, :, 1) = -other%p(:, :, 1)
         other%limit = other%limit(m:1:-1, :)
         other%plastic = other%plastic(m:1:-1, :, :)
         other%plastic(:, :, 1) = -other%plastic(:, :, 1)
         call compare("mirror image", one, other)
      end do
      call operator%release()
   end subroutine mirrored

   !> No slope: friction with the lower bound; the small slopes of both signs are close to it
   subroutine perfectly_plastic()
      type(tangential_problem) :: problem
      type(elastic_operator) :: operator
      type(tangential_solution) :: perfect, friction, nearly
      real(wp), allocatable :: bound(:, :)
      integer :: kind

      do kind = 1, 2
         call ellipse(20, kind == 2, 1, problem, operator)
         bound = problem%bound
         problem%bound = min(bound, 120.0_wp)
         call solve(problem, operator, 0, friction, "friction with lower bound")
         call make_yield(problem, 120.0_wp, 0.0_wp)
         call solve(problem, operator, 0, perfect, "perfectly plastic")
         call suite%check(all(abs(perfect%p - friction%p) <= 0.0_wp), "perfectly plastic: tractions of the lower bound")
         call suite%check(all(abs(perfect%slip - perfect%plastic - friction%slip) <= 0.0_wp), &
            & "perfectly plastic: slip and plastic shearing make up the slip")
         call suite%check(all((perfect%division == element%plastic) .eqv. &
            & (friction%division == element%slip .and. bound > 120.0_wp)), "perfectly plastic: yields where friction is stronger")
         problem%bound = bound
         call make_yield(problem, 120.0_wp, 1.0e-3_wp)
         call solve(problem, operator, 0, nearly, "hardly hardening")
         call suite%check(maxval(abs(nearly%p - perfect%p)) < 1.0e-3_wp*120.0_wp, "small slope: nearly perfectly plastic")
         call make_yield(problem, 120.0_wp, -1.0e-3_wp)
         call solve(problem, operator, 0, nearly, "hardly softening")
         call suite%check(maxval(abs(nearly%p - perfect%p)) < 1.0e-3_wp*120.0_wp, "small negative slope: nearly perfectly plastic")
      end do
      call operator%release()
   end subroutine perfectly_plastic

   !> Derivatives by creepage and bound, against differences of solutions
   subroutine derivatives()
      type(tangential_problem) :: problem
      type(elastic_operator) :: operator
      type(tangential_solution) :: here, ahead
      type(nested_workspace) :: workspace
      real(wp), allocatable :: shift(:, :, :), bound(:, :), change(:, :, :)
      real(wp) :: reached, h
      integer :: kind, k

      do kind = 1, 2
         do k = 1, 4
            call ellipse(20, kind == 2, 1, problem, operator)
            problem%settings%eps = 1.0e-11_wp
            call make_yield(problem, 120.0_wp, slopes(k))
            call solve(problem, operator, 0, here, "derivative")
            allocate(shift(problem%mx, problem%my, 2), source=0.0_wp)
            allocate(bound(problem%mx, problem%my), source=0.0_wp)
            allocate(change, source=shift)
            shift(:, :, 1) = problem%dq
            call traction_derivative(problem, operator, 1.0e-9_wp, workspace, here, shift, bound, change, reached)
            h = 1.0e-8_wp
            problem%shift = problem%shift + h*shift
            call solve(problem, operator, 0, ahead, "ahead")
            call differ("by creepage", change, here, ahead, h)
            problem%shift = problem%shift - h*shift
            shift = 0.0_wp
            bound = problem%bound
            call traction_derivative(problem, operator, 1.0e-9_wp, workspace, here, shift, bound, change, reached)
            h = 1.0e-6_wp
            problem%bound = (1.0_wp + h)*bound
            call solve(problem, operator, 0, ahead, "ahead")
            call differ("by bound", change, here, ahead, h)
            deallocate(shift, bound, change)
         end do
      end do
      call release_nested(workspace)
      call operator%release()

   end subroutine derivatives

   !> Change of the force by derivative and by difference
   subroutine differ(what, change, here, ahead, h)
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: change(:, :, :)
      type(tangential_solution), intent(in) :: here, ahead
      real(wp), intent(in) :: h
      real(wp) :: total(2), expected(2)

      total = [sum(change(:, :, 1)), sum(change(:, :, 2))]
      expected = [sum(ahead%p(:, :, 1) - here%p(:, :, 1)), sum(ahead%p(:, :, 2) - here%p(:, :, 2))]/h
      print "(6x, 2a, 4es14.6)", "derivative ", what, total, expected
      call suite%check(norm2(total - expected) <= 1.0e-4_wp*norm2(expected), "derivative of the force " // what)
   end subroutine differ

   !> One element, one row, very weak layers, fast softening, several contact areas in a row
   subroutine hard_cases()
      type(tangential_problem) :: problem
      type(elastic_operator) :: operator
      type(tangential_solution) :: newton, other
      integer :: k

      do k = 1, 5
         call ellipse(20, mod(k, 2) == 0, 1, problem, operator)
         select case (k)
         case (1)
            call ellipse(1, .false., 1, problem, operator)
         case (2)
            call ellipse(1, .true., -1, problem, operator)
         case (3)
            call ellipse(40, .false., 1, problem, operator, rows=1)
         case (4)
            ! two leading edges per row
            problem%contact(9:11, :) = .false.
            problem%bound(9:11, :) = 0.0_wp
         end select
         call make_yield(problem, merge(1.0e-3_wp, 60.0_wp, k == 5), 3000.0_wp)
         call solve(problem, operator, 0, newton, "hard case")
         call solve(problem, operator, merge(classical_method%steady_gs, classical_method%convex_gs, problem%steady), other, &
            & "hard case")
         call compare("hard case", newton, other)
         call make_yield(problem, 60.0_wp, -1.0e7_wp)
         call solve(problem, operator, classical_method%convex_gs, other, "drops at once")
         call suite%check(all(other%limit >= 5.999999_wp), "softening ends at a tenth of the limit")
      end do
      call operator%release()
   end subroutine hard_cases

   !> Elliptical contact with creepage, spin and parabolic bounds
   subroutine ellipse(n, steady, direction, problem, operator, rows)
      !> Elements over the long side
      integer, intent(in) :: n
      logical, intent(in) :: steady
      integer, intent(in) :: direction
      type(tangential_problem), intent(out) :: problem
      type(elastic_operator), intent(inout) :: operator
      !> Rows; default in proportion
      integer, intent(in), optional :: rows
      integer :: ix, iy
      real(wp) :: x, y, h, creep(3)

      problem%mx = n
      problem%my = max(1, nint(n*bb/aa))
      if (present(rows)) problem%my = rows
      problem%dx = 2.0_wp*aa/n
      problem%dy = 2.0_wp*bb/problem%my
      problem%steady = steady
      problem%direction = direction
      problem%dq = merge(problem%dx, 1.0_wp, steady)
      problem%settings%eps = 1.0e-8_wp
      problem%settings%maxgs = 9999
      problem%settings%maxnr = 100
      creep = [0.004_wp, -0.002_wp, 0.0002_wp]
      if (.not. steady) creep = 4.0_wp*creep
      allocate(problem%contact(n, problem%my), problem%bound(n, problem%my), problem%shift(n, problem%my, 2))
      do iy = 1, problem%my
         do ix = 1, n
            x = (ix - 0.5_wp)*problem%dx - aa
            y = (iy - 0.5_wp)*problem%dy - bb
            h = 1.0_wp - (x/aa)**2 - (y/bb)**2
            problem%contact(ix, iy) = h > 0.0_wp
            problem%bound(ix, iy) = mu*pressure*max(0.0_wp, h)
            problem%shift(ix, iy, :) = problem%dq*[creep(1) - creep(3)*y, creep(2) + creep(3)*x]
         end do
      end do
      call operator%prepare(elastic_model(combined_material(modulus, 0.28_wp, 0.0_wp)), problem%dx, problem%dy, n, &
         & problem%my, direction)
   end subroutine ellipse

   !> Rigid slip without the creepages that are to be found
   pure function spin_part(problem, forces) result(shift)
      type(tangential_problem), intent(in) :: problem
      integer, intent(in) :: forces
      real(wp) :: shift(problem%mx, problem%my, forces)
      integer :: k

      do k = 1, forces
         shift(:, :, k) = problem%shift(:, :, k) - sum(problem%shift(:, :, k))/size(problem%contact)
      end do
   end function spin_part

   subroutine make_yield(problem, limit, slope)
      type(tangential_problem), intent(inout) :: problem
      real(wp), intent(in) :: limit, slope

      if (allocated(problem%yield)) deallocate(problem%yield)
      allocate(problem%yield)
      allocate(problem%yield%limit(problem%mx, problem%my), source=limit)
      problem%yield%slope = slope
      problem%yield%lowest = 0.1_wp*limit
   end subroutine make_yield

   !> Solve without an estimate by Newton-Krylov (0) or a classical method
   subroutine solve(problem, operator, method, solution, what)
      type(tangential_problem), intent(inout) :: problem
      type(elastic_operator), intent(inout) :: operator
      integer, intent(in) :: method
      type(tangential_solution), intent(out) :: solution
      character(len=*), intent(in) :: what
      type(nested_workspace) :: workspace
      type(solve_report) :: report
      integer :: start, finish, rate

      call system_clock(start, rate)
      if (method == 0) then
         allocate(solution%p(problem%mx, problem%my, 2), solution%slip(problem%mx, problem%my, 2), source=0.0_wp)
         allocate(solution%division(problem%mx, problem%my), source=element%exterior)
         call solve_newton_krylov(problem, operator, workspace, solution, report, log)
         call release_nested(workspace)
      else
         call solve_classical(problem, operator, method, solution, report, log)
      end if
      call system_clock(finish)
      print "(2x, a32, 1x, a14, i5, i6, f8.3, es9.1, 2f10.6, 3i5, 2es13.5)", what, report%method, report%iterations, &
         & report%products, real(finish - start, wp)/rate, report%residual, sum(solution%p(:, :, 1))/sum(problem%bound), &
         & sum(solution%p(:, :, 2))/sum(problem%bound), count(solution%division == element%adhesion), &
         & count(solution%division == element%slip), count(solution%division == element%plastic), solution%creep
      call suite%check(report%succeeded(), what // ": " // trim(report%method) // " converges")
   end subroutine solve

   !> Tractions, plastic displacements and limits agree
   subroutine compare(what, one, other)
      character(len=*), intent(in) :: what
      type(tangential_solution), intent(in) :: one, other
      real(wp) :: dp, du, dt

      dp = maxval(abs(one%p - other%p))/maxval(abs(one%p))
      du = maxval(abs(one%plastic - other%plastic))/max(maxval(abs(one%plastic)), tiny(du))
      dt = maxval(abs(one%limit - other%limit))/maxval(one%limit)
      print "(6x, a, 3es10.2)", "differences:", dp, du, dt
      call suite%check(max(dp, dt) < 2.0e-5_wp .and. du < 1.0e-3_wp, what // ": the same solution")
   end subroutine compare

   !> Reproducible numbers between 0 and 1
   pure real(wp) function number(k)
      integer, intent(in) :: k
      number = modulo(sin(12.9898_wp*k + 1.0_wp)*43758.5453_wp, 1.0_wp)
   end function number
end program test_yield
