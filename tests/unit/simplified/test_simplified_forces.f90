!> Prescribed forces in the simplified theory: recovered creepages, forces near and beyond the friction bound
program test_simplified_forces
   use contact_base_choices, only : material_model
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_friction_law, only : friction_law, friction_set
   use contact_friction_new_law, only : friction_model, new_friction_law
   use contact_simplified_flexibility, only : slope_reduction
   use contact_simplified_problem, only : simplified_problem, simplified_solution
   use contact_simplified_solve, only : solve_simplified
   use contact_test_elliptic_problem, only : claim_sound, elliptic_problem, solved
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   integer, parameter :: models(2) = [material_model%fastsim_single, material_model%fastsim]
   type(test_suite) :: suite

   call suite%start("simplified theory, forces")
   call one_force(suite)
   call two_forces(suite)
   call strips(suite)
   call out_of_reach(suite)
   call falling_friction(suite)
   call suite%finish()

contains

   !> Longitudinal force prescribed, over the whole range and with all signs
   subroutine one_force(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: forces(7) = [-0.999_wp, -0.9_wp, -0.3_wp, 0.0_wp, 1.0e-3_wp, 0.6_wp, 0.99_wp]
      type(simplified_problem) :: problem, back
      type(simplified_solution) :: solution, again
      type(solve_report) :: report
      integer :: i, j

      do i = 1, size(models)
         do j = 1, size(forces)
            problem = elliptic_problem(6.0_wp, 3.0_wp, 41, 31, [0.0_wp, 2.0e-4_wp], 1.0e-4_wp, models(i))
            problem%n_forces = 1
            problem%force(1) = forces(j)
            problem%eps = 1.0e-9_wp
            if (mod(j, 2) == 0) problem%model%reduction = slope_reduction(0.5_wp, 0.1_wp, 0.6_wp)
            solution = solved(problem, report)
            call suite%check(report%succeeded(), "force reached")
            call suite%close_to(solution%force(1), forces(j), 1.0e-9_wp, "the longitudinal force")
            call suite%check(report%iterations <= 45, "in few marches")
            call claim_sound(suite, problem, solution, "one force")
            if (models(i) == material_model%fastsim) cycle
            back = problem
            back%n_forces = 0
            back%creep = solution%creep
            again = solved(back)
            call suite%close_to(again%force, solution%force, 1.0e-12_wp, "creepage gives the force back")
         end do
      end do
   end subroutine one_force

   !> Both forces, in all directions, with spin
   subroutine two_forces(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: sizes(4) = [0.01_wp, 0.5_wp, 0.9_wp, 0.99_wp], spins(3) = [0.0_wp, 2.0e-4_wp, -1.0e-3_wp]
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      type(solve_report) :: report
      integer :: i, j, k

      do i = 1, size(sizes)
         do j = 0, 7
            do k = 1, size(spins)
               problem = elliptic_problem(6.0_wp, 3.0_wp, 41, 31, [0.0_wp, 0.0_wp], spins(k))
               problem%n_forces = 2
               problem%force = sizes(i)*[cos(0.8_wp*j), sin(0.8_wp*j)]
               problem%eps = 1.0e-8_wp
               solution = solved(problem, report)
               call suite%check(report%succeeded(), "forces reached")
               call suite%close_to(solution%force, problem%force, 1.0e-8_wp, "both forces")
            end do
         end do
      end do
   end subroutine two_forces

   !> Forces of FaStrip jump where a row changes its state: the search ends at the jump and reports it
   subroutine strips(suite)
      type(test_suite), intent(inout) :: suite
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      type(solve_report) :: report
      integer :: j, n

      do n = 1, 2
         do j = 1, 9
            problem = elliptic_problem(6.0_wp, 3.0_wp, 41, 31, [0.0_wp, 1.0e-4_wp], 1.0e-4_wp, material_model%fastrip)
            problem%n_forces = n
            problem%force = [0.1_wp*j, 0.05_wp*j]
            if (n == 2) problem%force = 0.8_wp*problem%force
            problem%eps = 1.0e-8_wp
            solution = solved(problem, report)
            call claim_sound(suite, problem, solution, "FaStrip with forces")
            call suite%close_to(solution%force(:n), problem%force(:n), 0.02_wp, "forces but for a jump")
            call suite%check(report%ended == ending%converged .or. report%residual > problem%eps, "the missed force is reported")
         end do
      end do
   end subroutine strips

   !> Forces beyond the friction bound, or tangential forces without friction
   subroutine out_of_reach(suite)
      type(test_suite), intent(inout) :: suite
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      type(solve_report) :: report
      integer :: n

      do n = 1, 2
         problem = elliptic_problem(6.0_wp, 3.0_wp, 41, 31, [0.0_wp, 0.0_wp], 1.0e-4_wp)
         problem%n_forces = n
         problem%force = [0.8_wp, 0.7_wp]
         if (n == 1) problem%force(1) = 1.05_wp
         solution = solved(problem, report)
         call suite%check(report%ended == ending%stagnated, "a force beyond friction is not reached")
         call claim_sound(suite, problem, solution, "beyond friction")
         problem%force = [0.1_wp, 0.2_wp]
         problem%mu = 0.0_wp
         problem%mu_scal = 0.0_wp
         solution = solved(problem, report)
         call suite%check(report%ended == ending%stagnated, "no friction, no force")
      end do
   end subroutine out_of_reach

   !> Friction that decreases with creepage: the search finds the increasing branch, or reports that there is none
   subroutine falling_friction(suite)
      type(test_suite), intent(inout) :: suite
      type(simplified_problem) :: problem
      type(simplified_solution) :: solution
      type(solve_report) :: report
      class(friction_law), allocatable :: law
      type(error_type), allocatable :: error
      real(wp) :: expected
      integer :: j

      call new_friction_law(friction_model%exponential, [friction_set(fstat=0.3_wp, fkin=0.1_wp, &
         & coef1=0.2_wp, sabsh1=500.0_wp)], law, error)
      call suite%check(.not. allocated(error), "a law of friction")
      problem = elliptic_problem(6.0_wp, 3.0_wp, 41, 31, [0.05_wp, 0.0_wp], 0.0_wp)
      allocate(problem%law, source=law)
      problem%velocity = 2.0e4_wp
      call solve_simplified(problem, solution, report)
      expected = 0.1_wp + 0.2_wp*2.0_wp**(-0.05_wp*2.0e4_wp/500.0_wp)
      call suite%close_to(solution%mu, spread(expected, 1, 31), 1.0e-12_wp, "friction of the rigid slip velocity")
      call suite%close_to(maxval(solution%bound), expected*maxval(problem%pn), 1.0e-9_wp, "bound", relative=.true.)
      problem%n_forces = 1
      do j = 1, 9
         problem%force(1) = -0.1_wp*j
         call solve_simplified(problem, solution, report)
         call claim_sound(suite, problem, solution, "falling friction")
         if (j <= 7) then
            call suite%check(report%succeeded(), "below the maximum a force is found")
            call suite%check(solution%creep(1) < 0.01_wp, "on the rising branch")
         end if
         if (j == 9) call suite%check(report%ended == ending%stagnated, "above the maximum there is none")
      end do
   end subroutine falling_friction
end program test_simplified_forces
