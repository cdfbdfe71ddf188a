!> A contact of few elements that moves, grows and shrinks: the factor that is kept gives the pressures of conjugate gradients
program test_few_elements
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : solve_report
   use contact_elastic_material, only : combine
   use contact_elastic_model, only : elastic_model
   use contact_elastic_operator, only : elastic_operator
   use contact_normal_conjugate_gradient, only : normal_problem, normal_workspace, release_normal, solve_normal
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   real(wp), parameter :: side = 0.1_wp, half_turn = 3.14159265358979324_wp
   integer, parameter :: steps = 60
   type(test_suite) :: suite
   type(normal_workspace) :: workspace
   type(elastic_operator) :: operator
   type(elastic_model) :: model
   real(wp), allocatable :: p(:, :)
   !> Number of small steps, and of those after which the kept factor is compared with a new one
   integer, parameter :: small_steps = 800, between = 50
   !> Derivatives of the pressures for two materials [N/mm3], and the coefficient of an element on itself for the first one
   real(wp), allocatable :: stiffer(:, :), softer(:, :)
   real(wp) :: turn, own
   integer :: k, by_factor

   call suite%start("contacts of few elements")
   model%material = combine([0.28_wp, 0.28_wp], [82000.0_wp, 82000.0_wp])
   by_factor = 0
   do k = 1, steps
      turn = 2.0_wp*half_turn*k/steps
      ! the window goes along with the contact now and then, and changes its size
      call solve(17 + mod(k/7, 3), 15 + mod(k/5, 2), 8.3_wp + 0.9_wp*cos(turn) + mod(k/9, 2), 7.6_wp + 0.7_wp*sin(2.0_wp*turn), &
         & 0.020_wp + 0.012_wp*sin(3.0_wp*turn))
   end do
   call suite%check(by_factor > steps/2, "most of the contacts are solved by the factor")
   ! a factor that was changed by hundreds of elements is as accurate as a new one
   do k = 1, small_steps
      turn = 40.0_wp*half_turn*k/small_steps
      call follow(8.5_wp + 1.3_wp*cos(turn), 8.5_wp + 1.1_wp*sin(0.7_wp*turn), 0.022_wp + 0.01_wp*sin(1.3_wp*turn), &
         & mod(k, between) == 0)
   end do
   ! another material needs another factorisation
   call differentiate(stiffer)
   model%material = combine([0.28_wp, 0.28_wp], [41000.0_wp, 82000.0_wp])
   own = operator%table%nn(0, 0)
   call operator%prepare(model, side, side, size(p, 1), size(p, 2), 1)
   call differentiate(softer)
   call suite%close_to(reshape(softer*operator%table%nn(0, 0), [size(p)]), reshape(stiffer*own, [size(p)]), &
      & 1.0e-10_wp*maxval(stiffer*own), "derivatives for the present material")
   call solve(17, 15, 8.3_wp, 7.6_wp, 0.02_wp)
   call release_normal(workspace)
   call operator%release()
   deallocate(p)
   call suite%finish()

contains

   !> One contact of a sequence of small steps
   subroutine follow(x, y, pen, is_compared)
      !> Position of the lowest point in elements, and approach [mm]
      real(wp), intent(in) :: x, y, pen
      !> Are the pressures compared with those of a new factor?
      logical, intent(in) :: is_compared
      type(normal_problem) :: problem
      type(normal_workspace) :: fresh
      type(solve_report) :: report
      real(wp), allocatable :: expected(:, :)
      real(wp) :: approach

      call describe(17, 17, x, y, problem)
      problem%follows = .true.
      approach = pen
      call operator%prepare(model, side, side, problem%mx, problem%my, 1)
      if (any(shape(p) /= [problem%mx, problem%my])) then
         deallocate(p)
         allocate(p(problem%mx, problem%my), source=0.0_wp)
         where (problem%h < 0.5_wp*pen) p = 1.0_wp
      end if
      if (is_compared) expected = p
      call solve_normal(problem, operator, workspace, p, approach, report)
      call suite%check(report%method == "Cholesky", "small steps are solved by the factor")
      if (.not. is_compared) return
      report = solve_report()
      call solve_normal(problem, operator, fresh, expected, approach, report)
      call suite%close_to(reshape(p, [size(p)]), reshape(expected, [size(p)]), 1.0e-11_wp*maxval(expected), &
         & "pressures by a changed factor and by a new one")
      call release_normal(fresh)
   end subroutine follow

   !> Derivative of the last pressures by the kept factor
   subroutine differentiate(q)
      !> [N/mm3]
      real(wp), allocatable, intent(out) :: q(:, :)
      logical :: found

      allocate(q, mold=p)
      call workspace%factor%pressure_derivative(operator, p, count(p > 0.0_wp), q, found)
      call suite%check(found, "the factor gives the derivative")
   end subroutine differentiate

   !> Paraboloid over a window
   subroutine describe(mx, my, x, y, problem)
      !> Size of the window, and position of the lowest point in elements
      integer, intent(in) :: mx, my
      real(wp), intent(in) :: x, y
      type(normal_problem), intent(inout) :: problem
      integer :: ix, iy

      problem%mx = mx
      problem%my = my
      problem%dx = side
      problem%dy = side
      problem%eps = 1.0e-9_wp
      problem%force_prescribed = .false.
      allocate(problem%h(mx, my))
      do iy = 1, my
         do ix = 1, mx
            problem%h(ix, iy) = 8.0e-4_wp*((ix - x)**2 + 1.5_wp*(iy - y)**2)
         end do
      end do
   end subroutine describe

   !> One contact with the factor of those before it as estimate and without
   subroutine solve(mx, my, x, y, pen)
      !> Size of the window, and position of the lowest point in elements
      integer, intent(in) :: mx, my
      real(wp), intent(in) :: x, y
      !> Approach [mm]
      real(wp), intent(in) :: pen
      type(normal_problem) :: problem
      type(normal_workspace) :: fresh
      type(elastic_operator) :: new
      type(solve_report) :: report
      real(wp) :: expected(mx, my), approach

      call describe(mx, my, x, y, problem)
      call operator%prepare(model, side, side, mx, my, 1)
      expected = 0.0_wp
      approach = pen
      call new%prepare(model, side, side, mx, my, 1)
      call suite%check(all(abs(new%table%nn - operator%table%nn) <= 0.0_wp), "coefficients do not depend on windows before")
      call solve_normal(problem, new, fresh, expected, approach, report)
      call suite%check(report%succeeded() .and. report%method == "NormCG", "conjugate gradients converge")
      call release_normal(fresh)
      call new%release()
      if (.not. allocated(p)) p = expected
      if (any(shape(p) /= [mx, my])) p = expected
      ! last pressures where the window is the same; otherwise the area is nearly right
      problem%follows = .true.
      report = solve_report()
      call solve_normal(problem, operator, workspace, p, approach, report)
      call suite%check(report%succeeded(), "the kept factor converges")
      if (report%method == "Cholesky") by_factor = by_factor + 1
      call suite%close_to(reshape(p, [mx*my]), reshape(expected, [mx*my]), 1.0e-6_wp*maxval(expected), "the same pressures")
   end subroutine solve
end program test_few_elements
