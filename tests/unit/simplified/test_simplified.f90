!> Fastsim and FaStrip on an ellipse: linear theory, sliding, mirror images, strip theory, order of
!> convergence, steps in time, hard cases
program test_simplified
   use, intrinsic :: ieee_exceptions, only : ieee_get_halting_mode, ieee_overflow, ieee_set_flag, ieee_set_halting_mode
   use contact_base_choices, only : material_model
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_simplified_fastrip, only : slip_half_length
   use contact_simplified_flexibility, only : ellipse, slope_reduction
   use contact_simplified_kalker, only : creepage_coefficients, kalker_coefficients
   use contact_simplified_problem, only : simplified_problem, simplified_solution
   use contact_test_elliptic_problem, only : claim_sound, elliptic_problem, solved
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: models(3) = [material_model%fastsim_single, material_model%fastsim, material_model%fastrip]
   real(wp), parameter :: gg = 82000.0_wp, nu = 0.28_wp, none(2) = 0.0_wp
   type(test_suite) :: suite

   call suite%start("simplified theory")
   call linear_theory(suite)
   call full_sliding(suite)
   call mirror_images(suite)
   call strip_theory(suite)
   call half_lengths(suite)
   call order(suite)
   call steps_in_time(suite)
   call weaker_slope(suite)
   call hard_cases(suite)
   call suite%finish()

contains

   !> Forces at vanishing creepage, extrapolated to elements of no size, are Kalker's
   subroutine linear_theory(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: ratios(5) = [0.05_wp, 0.3_wp, 1.0_wp, 2.5_wp, 20.0_wp], small = 1.0e-12_wp
      type(creepage_coefficients) :: c
      real(wp) :: aa, bb, size_, force(2)
      integer :: i

      do i = 1, size(ratios)
         aa = 4.0_wp*sqrt(ratios(i))
         bb = 4.0_wp/sqrt(ratios(i))
         size_ = gg*aa*bb*small/(0.3_wp*1.0e5_wp)
         c = kalker_coefficients(aa, bb, nu)
         force = extrapolated(aa, bb, [small, 0.0_wp], 0.0_wp, material_model%fastsim)
         call suite%close_to(force/size_, [-c%c11, 0.0_wp], 1.0e-3_wp*c%c11, "Fastsim, C11")
         force = extrapolated(aa, bb, [0.0_wp, small], 0.0_wp, material_model%fastsim)
         call suite%close_to(force/size_, [0.0_wp, -c%c22], 1.0e-3_wp*c%c22, "Fastsim, C22")
         force = extrapolated(aa, bb, none, small, material_model%fastsim)
         call suite%close_to(force/size_, sqrt(aa*bb)*[0.0_wp, -c%c23], 3.0e-3_wp*sqrt(aa*bb)*c%c23, "Fastsim, C23")
         force = extrapolated(aa, bb, [small, 0.0_wp], 0.0_wp, material_model%fastrip)
         call suite%close_to(force/size_, [-c%c11, 0.0_wp], 2.0e-2_wp*c%c11, "FaStrip, C11")
         force = extrapolated(aa, bb, [0.0_wp, small], 0.0_wp, material_model%fastrip)
         call suite%close_to(force/size_, [0.0_wp, -c%c22], 2.0e-2_wp*c%c22, "FaStrip, C22")
      end do
   end subroutine linear_theory

   !> Relative forces on grids of two sizes, extrapolated with order 1
   function extrapolated(aa, bb, creep, spin, model) result(force)
      real(wp), intent(in) :: aa, bb, creep(2), spin
      integer, intent(in) :: model
      real(wp) :: force(2)
      type(simplified_solution) :: coarse, fine

      coarse = solved(elliptic_problem(aa, bb, 200, 200, creep, spin, model))
      fine = solved(elliptic_problem(aa, bb, 400, 400, creep, spin, model))
      force = 2.0_wp*fine%force - coarse%force
   end function extrapolated

   !> Large creepage: every element on the bound, against the slip
   subroutine full_sliding(suite)
      type(test_suite), intent(inout) :: suite
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      real(wp) :: total
      integer :: i

      do i = 1, size(models)
         problem = elliptic_problem(6.0_wp, 3.0_wp, 60, 50, [0.6_wp, 0.8_wp], 0.0_wp, models(i))
         solution = solved(problem)
         total = sum(problem%pn)*problem%dx*problem%dy/problem%fn
         call suite%close_to(solution%force, -total*[0.6_wp, 0.8_wp], 1.0e-9_wp, "sliding")
         call suite%check(solution%sliding, "no adhesion")
         call claim_sound(suite, problem, solution, "sliding")
      end do
   end subroutine full_sliding

   !> Rolling in the opposite direction, and lateral mirror image
   subroutine mirror_images(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: creep(2) = [4.0e-4_wp, -7.0e-4_wp], spin = 3.0e-4_wp, rounding = 1.0e-12_wp
      type(simplified_solution) :: one, two
      integer :: i

      do i = 1, size(models)
         one = solved(elliptic_problem(6.0_wp, 3.0_wp, 64, 48, creep, spin, models(i)))
         call suite%check(any(one%division == element%slip) .and. any(one%division == element%adhesion), "partial slip")
         two = solved(elliptic_problem(6.0_wp, 3.0_wp, 64, 48, [-creep(1), creep(2)], -spin, models(i), direction=-1))
         call suite%check(all(one%division == two%division(64:1:-1, :)), "rolling the other way: element division")
         call suite%check(maxval(abs(one%p(:, :, 1) + two%p(64:1:-1, :, 1))) <= rounding*maxval(one%bound) &
            & .and. maxval(abs(one%p(:, :, 2) - two%p(64:1:-1, :, 2))) <= rounding*maxval(one%bound), &
            & "rolling the other way: tractions")
         two = solved(elliptic_problem(6.0_wp, 3.0_wp, 64, 48, [creep(1), -creep(2)], -spin, models(i)))
         call suite%check(maxval(abs(one%p(:, :, 1) - two%p(:, 48:1:-1, 1))) <= rounding*maxval(one%bound) &
            & .and. maxval(abs(one%p(:, :, 2) + two%p(:, 48:1:-1, 2))) <= rounding*maxval(one%bound), &
            & "lateral mirror image: tractions")
      end do
   end subroutine mirror_images

   !> A long narrow contact across the rolling direction: Carter (1926) for longitudinal creepage
   subroutine strip_theory(suite)
      type(test_suite), intent(inout) :: suite
      !> Slip area as a fraction of the length
      real(wp), parameter :: d = 0.4_wp
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      real(wp) :: p0, creep, x, worst, expected, relative
      integer :: ix

      p0 = 1.5_wp*1.0e5_wp/(pi*1.0_wp*1.0e4_wp)
      creep = -2.0_wp*(1.0_wp - nu)*0.3_wp*p0/gg*d
      problem = elliptic_problem(1.0_wp, 1.0e4_wp, 400, 101, [creep, 0.0_wp], 0.0_wp, material_model%fastrip)
      solution = solved(problem)
      ! the row in the middle, with the full pressure
      worst = 0.0_wp
      do ix = 1, 400
         x = problem%x(ix)
         expected = sqrt(1.0_wp - x**2)
         if (x > -1.0_wp + 2.0_wp*d) expected = expected - sqrt(max(0.0_wp, (1.0_wp - d)**2 - (x - d)**2))
         worst = max(worst, abs(solution%p(ix, 51, 1)/(0.3_wp*p0) - expected))
      end do
      ! the area of the elements in contact differs from the ellipse by less than 1 %
      call suite%close_to(worst, 0.0_wp, 0.03_wp, "tractions of Carter")
      relative = sum(solution%p(:, 51, 1))/sum(solution%bound(:, 51))
      call suite%close_to(relative, 1.0_wp - (1.0_wp - d)**2, 5.0e-3_wp, "force of Carter")
      call suite%close_to(real(count(solution%division(:, 51) == element%slip), wp)/400.0_wp, d, 0.01_wp, "slip area of Carter")
   end subroutine strip_theory

   !> The quadratic equation of strip theory, also where its usual form divides by zero
   subroutine half_lengths(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: near = 1.0_wp - 1.0e-9_wp

      call suite%close_to(slip_half_length(2.0_wp, 0.2_wp, 0.1_wp, 0.0_wp, 0.0_wp), 0.25_wp, 1.0e-14_wp, "longitudinal")
      call suite%close_to(slip_half_length(2.0_wp, 0.2_wp, 0.0_wp, 0.1_wp, 0.0_wp), 0.25_wp, 1.0e-14_wp, "lateral")
      call suite%close_to(slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.2_wp, 0.5_wp), &
         & (sqrt(0.04_wp + 0.75_wp*0.09_wp) + 0.1_wp)/0.75_wp, 1.0e-14_wp, "with spin")
      call suite%close_to(slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.2_wp, -0.5_wp), &
         & (sqrt(0.04_wp + 0.75_wp*0.09_wp) - 0.1_wp)/0.75_wp, 1.0e-14_wp, "with spin against the creepage")
      call suite%close_to(slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.2_wp, -1.0_wp), &
         & slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.2_wp, -near), 1.0e-8_wp, "regular where spin is -1")
      call suite%check(slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.2_wp, 1.0_wp) > 1.0e9_wp, "spin of 1: full sliding")
      call suite%check(slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.0_wp, 1.0_wp) > 1.0e9_wp, "without lateral creepage too")
      call suite%check(slip_half_length(1.0_wp, 0.0_wp, 0.3_wp, 0.2_wp, 5.0_wp) > 1.0e9_wp, "large spin: full sliding")
      call suite%close_to(slip_half_length(1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.7_wp), 0.0_wp, 0.0_wp, "no creepage")
   end subroutine half_lengths

   !> Forces converge with the first power of the size of the elements
   subroutine order(suite)
      type(test_suite), intent(inout) :: suite
      type(simplified_solution) :: solution
      real(wp) :: force(4), observed
      integer :: i

      do i = 1, 4
         solution = solved(elliptic_problem(6.0_wp, 3.0_wp, 50*2**i, 50*2**i, [5.0e-4_wp, -8.0e-4_wp], 3.0e-4_wp))
         force(i) = solution%force(2)
      end do
      observed = log(abs(force(2) - force(1))/abs(force(4) - force(3)))/log(4.0_wp)
      call suite%check(observed > 0.75_wp .and. observed < 1.35_wp, "order 1 of Fastsim")
   end subroutine order

   !> Steps in time: repeated steps by one element end in steady rolling; no motion, no change
   subroutine steps_in_time(suite)
      type(test_suite), intent(inout) :: suite
      integer, parameter :: mx = 40, my = 30
      type(simplified_problem) :: problem
      type(simplified_solution) :: steady, step
      integer :: i

      problem = elliptic_problem(6.0_wp, 3.0_wp, mx, my, [5.0e-4_wp, -8.0e-4_wp], 3.0e-4_wp)
      steady = solved(problem)
      problem%steady = .false.
      allocate(problem%before(mx, my, 2), source=0.0_wp)
      do i = 1, mx
         step = solved(problem)
         problem%before(:mx - 1, :, :) = step%p(2:, :, :)
         problem%before(mx, :, :) = 0.0_wp
      end do
      call suite%check(maxval(abs(step%p - steady%p)) <= 1.0e-12_wp*maxval(steady%bound), "steps end in steady rolling")
      call suite%check(all(step%division == steady%division), "with the same element division")

      problem%shift = .true.
      problem%creep = [1.0e-2_wp, 5.0e-3_wp]
      problem%spin = 0.0_wp
      problem%dq = 1.0_wp
      problem%before = 0.0_wp
      step = solved(problem)
      call claim_sound(suite, problem, step, "shift")
      call suite%check(any(step%division == element%adhesion) .and. any(step%division == element%slip), "partial slip in a shift")
      problem%before = step%p
      problem%creep = 0.0_wp
      steady = solved(problem)
      call suite%check(maxval(abs(steady%p - step%p)) <= 1.0e-12_wp*maxval(step%bound), "no motion, no change")
   end subroutine steps_in_time

   !> Slope reduction weakens small forces, by k0 at vanishing creepage, and does not change the limit
   subroutine weaker_slope(suite)
      type(test_suite), intent(inout) :: suite
      type(simplified_problem) :: problem
      type(simplified_solution) :: full, reduced
      integer :: i

      do i = 1, size(models)
         problem = elliptic_problem(6.0_wp, 3.0_wp, 100, 60, [1.0e-9_wp, 0.0_wp], 0.0_wp, models(i))
         full = solved(problem)
         problem%model%reduction = slope_reduction(0.5_wp, 0.1_wp, 0.6_wp)
         reduced = solved(problem)
         call suite%close_to(reduced%force(1)/full%force(1), 0.5_wp, 0.02_wp, "initial slope")
         problem%creep(1) = 50.0_wp
         reduced = solved(problem)
         call suite%close_to(reduced%force(1), -1.0_wp, 3.0e-3_wp, "limit of the force")
      end do
   end subroutine weaker_slope

   !> Any valid input gives finite results
   subroutine hard_cases(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: sizes(7) = [0.0_wp, 1.0e-300_wp, 1.0e-20_wp, 1.0e-4_wp, 1.0_wp, 1.0e20_wp, 1.0e290_wp]
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      integer :: i, j, k
      logical :: traps

      ! squares of huge displacements overflow, and that is provided for; debug builds are not to stop there
      call ieee_get_halting_mode(ieee_overflow, traps)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      do i = 1, size(models)
         do j = 1, size(sizes)
            do k = 1, size(sizes)
               problem = elliptic_problem(6.0_wp, 3.0_wp, 15, 11, [sizes(j), -0.5_wp*sizes(j)], sizes(k), models(i))
               call claim_sound(suite, problem, solved(problem), "any creepage and spin")
            end do
         end do
         problem = elliptic_problem(6.0_wp, 3.0_wp, 31, 21, none, 0.0_wp, models(i))
         solution = solved(problem)
         call suite%check(all(abs(solution%p) <= 0.0_wp) .and. .not. any(solution%division == element%slip), &
            & "no creepage: no traction, no slip")
         call shapes(suite, 1, 1, 1.0_wp, models(i))
         call shapes(suite, 1, 9, 1.0_wp, models(i))
         call shapes(suite, 33, 1, 0.01_wp, models(i))
         call shapes(suite, 33, 31, 50.0_wp, models(i))
         call shapes(suite, 33, 31, 0.02_wp, models(i))
         problem = elliptic_problem(6.0_wp, 3.0_wp, 31, 21, [1.0e-3_wp, 0.0_wp], 1.0e-4_wp, models(i))
         problem%mu = 0.0_wp
         problem%mu_scal = 0.0_wp
         solution = solved(problem)
         call suite%check(all(abs(solution%p) <= 0.0_wp), "no friction, no traction")
      end do
      call ieee_set_flag(ieee_overflow, .false.)
      call ieee_set_halting_mode(ieee_overflow, traps)
   end subroutine hard_cases

   subroutine shapes(suite, mx, my, ratio, model)
      type(test_suite), intent(inout) :: suite
      integer, intent(in) :: mx, my, model
      !> a/b
      real(wp), intent(in) :: ratio
      type(simplified_problem) :: problem

      problem = elliptic_problem(3.0_wp*sqrt(ratio), 3.0_wp/sqrt(ratio), mx, my, [3.0e-4_wp, 5.0e-4_wp], 2.0e-4_wp, model)
      call claim_sound(suite, problem, solved(problem), "few elements, narrow ellipses")
      problem%model%hertz = ellipse()
      call claim_sound(suite, problem, solved(problem), "without Hertz's ellipse")
   end subroutine shapes
end program test_simplified
