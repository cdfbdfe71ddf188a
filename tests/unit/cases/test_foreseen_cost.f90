!> Cost of an accuracy, foreseen from a solution on few elements: against the search itself
program test_foreseen_cost
   use contact_base_choices, only : force_control, motion, time_link
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_cases_accuracy, only : solve_contact_case
   use contact_cases_accuracy_plan, only : accuracy_law
   use contact_cases_estimate, only : case_cost, estimate_cost
   use contact_cases_foreseen_cost, only : cost_forecast
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_search_model, only : coarse_solution, grid_time, mean_cost, simulate_searches
   use contact_cases_slot, only : open_contact, problem_slot, release_slot
   use contact_cases_spec, only : case_spec
   use contact_test_case_builder, only : creep, grid_case, hertz_case, shift
   use contact_test_harness, only : environment, test_suite
   use contact_test_pair_builder, only : railway_case
   implicit none (type, external)
   !> Result element and contact problem
   integer, parameter :: owner(2) = [1, 1]
   !> Coefficients of x**2 and y**2 [1/mm], and normal force [N]
   real(wp), parameter :: curvature = 1.0e-3_wp, force = 5.0e4_wp
   !> Time of coarse solutions, also on slow machines and with memory checkers [s]
   real(wp), parameter :: unlimited = 1.0e4_wp
   type(test_suite) :: suite

   call suite%start("foreseen_cost")
   call coarse_first_grid(suite)
   call unlike_bodies(suite)
   call series(suite)
   call without_solution(suite)
   call grids_of_wheel(suite)
   call slow_wheel(suite)
   call suite%finish()

contains

   !> The first grid has few elements, is solved here as in the search, and is sufficient: the number of elements is exact
   subroutine coarse_first_grid(suite)
      type(test_suite), intent(inout) :: suite
      type(case_cost) :: cost
      real(wp) :: elements

      call foresee_one(ball(1.0e-2_wp), cost)
      call solve_one(ball(1.0e-2_wp), elements, suite)
      call suite%close_to(real(cost%elements, wp), elements, 0.0_wp, "the grid that was solved")
      call suite%equal(trim(cost%source), "from a solution on 14 x 14 elements", "how it was found")
   end subroutine coarse_first_grid

   !> Slip at the leading edge that is narrower than elements, in a fivefold range of their number across, 27 and 147
   subroutine unlike_bodies(suite)
      type(test_suite), intent(inout) :: suite
      real(wp), parameter :: creepage(2, 2) = reshape([-2.0e-3_wp, 0.0_wp, 0.0_wp, 2.0e-3_wp], [2, 2])
      type(case_spec) :: spec
      type(case_cost) :: cost
      real(wp) :: elements
      integer :: k

      do k = 1, size(creepage, 2)
         spec = ball(1.0e-3_wp)
         spec%material%gg = [80000.0_wp, 320000.0_wp]
         spec%friction%sets%fstat = 0.18_wp
         spec%friction%sets%fkin = 0.18_wp
         spec%kinematics%cksi = creepage(1, k)
         spec%kinematics%ceta = creepage(2, k)
         call foresee_one(spec, cost)
         call solve_one(spec, elements, suite)
         call suite%check(abs(log(cost%elements/elements)) < log(2.0_wp), "elements of unlike bodies")
         call suite%check(index(cost%source, "from a solution on") == 1, "from a solution")
      end do
   end subroutine unlike_bodies

   !> A shift that continues another one begins on its grid
   subroutine series(suite)
      type(test_suite), intent(inout) :: suite
      type(cost_forecast) :: forecast
      type(case_spec) :: spec
      type(case_cost) :: first, second

      spec = shifted()
      forecast%patience = unlimited
      forecast%left = unlimited
      call forecast%foresee(spec, owner, "", first)
      spec%link = time_link%continue_all
      spec%kinematics%cksi = 0.5_wp*spec%kinematics%cksi
      call forecast%foresee(spec, owner, "", second)
      call suite%check(index(second%source, "from a solution on") == 1, "a case that continues another one")
      call suite%check(second%elements >= nint(0.8_wp*first%elements), "on its grid, or on a finer one")
      ! another contact problem has another history
      call forecast%foresee(spec, owner + 1, "", second)
      call suite%equal(trim(second%source), "typical of such contacts, as the case before was not solved on few elements", &
         & "a case that continues an unknown one")
      call forecast%release()
   end subroutine series

   !> Given grids keep the cost that is typical, and refusals are told, also of cases that continue refused ones
   subroutine without_solution(suite)
      type(test_suite), intent(inout) :: suite
      type(cost_forecast) :: forecast
      type(case_spec) :: spec
      type(case_cost) :: cost, typical

      spec = ball(0.0_wp)
      call foresee_one(spec, cost)
      call estimate_cost(spec, typical)
      call suite%close_to(cost%seconds, typical%seconds, 0.0_wp, "time on a given grid")
      call suite%check(cost%source == "" .and. .not. allocated(cost%refusal), "a given grid")
      spec = shifted()
      spec%has_damping = .true.
      call forecast%foresee(spec, owner, "", cost)
      call suite%check(allocated(cost%refusal), "a case that is refused")
      if (.not. allocated(cost%refusal)) return
      call suite%check(index(cost%refusal, "damping") > 0, "the reason")
      spec%has_damping = .false.
      spec%link = time_link%continue_all
      call forecast%foresee(spec, owner, "", cost)
      call suite%check(allocated(cost%refusal), "a case that continues one that is refused")
      forecast%patience = tiny(1.0_wp)
      call forecast%foresee(ball(1.0e-2_wp), owner, "", cost)
      call suite%equal(trim(cost%source), "typical of such contacts, as there is no estimate on few elements", "no time for one")
      forecast%left = 0.0_wp
      call forecast%foresee(ball(1.0e-2_wp), owner, "", cost)
      call suite%equal(trim(cost%source), "typical of such contacts, as solutions on few elements of the cases before took long", &
         & "no time left")
      call forecast%release()
   end subroutine without_solution

   !> Two grids of a wheel: the first one takes the time of a first grid, the second one that of a grid that starts from another
   subroutine grids_of_wheel(suite)
      type(test_suite), intent(inout) :: suite
      type(case_spec) :: spec
      type(coarse_solution) :: coarse
      type(mean_cost) :: mean
      !> Numbers of elements of both grids; so long that reading takes no time [s]
      real(wp) :: first, second
      real(wp), parameter :: long = 1.0e6_wp

      allocate(spec%wheel_rail)
      spec%iteration%accuracy = 1.0e-3_wp
      coarse%law = accuracy_law(0.21_wp, 2.0_wp, 2.0_wp)
      coarse%estimated = 2.5e-3_wp
      coarse%contact = [8.0_wp, 8.0_wp]
      coarse%sides = [0.4_wp, 0.4_wp]
      coarse%first_sides = coarse%sides
      coarse%areas = [80.0_wp, 20.0_wp]
      first = sum(coarse%areas)/product(coarse%sides)
      coarse%fresh = grid_time(first, long)
      coarse%started = grid_time(2.0_wp*first, 0.5_wp*long)
      call simulate_searches(spec, coarse, mean)
      call suite%equal(mean%grids, 2, "number of grids")
      second = sum(coarse%areas)/product(mean%last_sides)
      call suite%check(second > 2.5_wp*first, "the second one is finer")
      call suite%close_to(exp(mean%seconds/mean%number), coarse%fresh%of_wheel(first) + coarse%started%of_wheel(second), &
         & 1.0e-6_wp*long, "time of both")
      call suite%close_to(coarse%started%of_wheel(2.0_wp*first), 0.5_wp*long, 1.0e-6_wp*long, "time of the grid that was solved")
      ! the first one suffices
      coarse%estimated = 6.0e-4_wp
      call simulate_searches(spec, coarse, mean)
      call suite%equal(mean%grids, 1, "a single grid")
      call suite%close_to(exp(mean%seconds/mean%number), long, 1.0e-6_wp*long, "its time")
   end subroutine grids_of_wheel

   !> A light wheel that climbs the flange, with a longitudinal force: it takes more than ten times what is typical
   subroutine slow_wheel(suite)
      type(test_suite), intent(inout) :: suite
      type(cost_forecast) :: forecast
      type(case_spec) :: spec
      type(case_cost) :: cost, typical

      spec = railway_case(7.3_wp, -7.44e-3_wp)
      spec%iteration%accuracy = 1.0e-3_wp
      spec%force = force_control%longitudinal_force
      associate (pair => spec%wheel_rail)
         pair%wheel_profile%name = environment("CONTACT_SOURCE") // "/examples/profiles/S1002_worn.prw"
         pair%track%cant = 0.05_wp
         pair%wheelset%fz = 6254.0_wp
         pair%wheelset%fx = 1688.0_wp
      end associate
      call estimate_cost(spec, typical)
      forecast%patience = 2.0_wp*typical%seconds*machine_pace()
      call forecast%foresee(spec, owner, "", cost)
      call suite%equal(trim(cost%source), "at least, as a solution on few elements was not finished in this time", "a slow wheel")
      call suite%close_to(cost%seconds, 2.0_wp*typical%seconds, 1.0e-6_wp*typical%seconds, "its time")
      call forecast%release()
   end subroutine slow_wheel

   !> Cost of a single case
   subroutine foresee_one(spec, cost)
      type(case_spec), intent(in) :: spec
      type(case_cost), intent(out) :: cost
      type(cost_forecast) :: forecast

      forecast%patience = unlimited
      forecast%left = unlimited
      call forecast%foresee(spec, owner, "", cost)
      call forecast%release()
   end subroutine foresee_one

   !> Solve a case with its accuracy
   subroutine solve_one(spec, elements, suite)
      type(case_spec), intent(in) :: spec
      !> Number of elements of its grid
      real(wp), intent(out) :: elements
      type(test_suite), intent(inout) :: suite
      type(problem_slot) :: slot
      type(log_type) :: log
      type(case_spec), allocatable :: solved
      type(error_type), allocatable :: error

      elements = 1.0_wp
      call open_contact(slot)
      call solve_contact_case(slot%session, spec, log, slot%result, solved, error)
      call suite%check(.not. allocated(error), "solved")
      if (.not. allocated(error)) then
         call suite%check(slot%result%accuracy%is_met, "to the accuracy")
         elements = product(real(slot%result%accuracy%elements, wp))
      end if
      call release_slot(slot)
   end subroutine solve_one

   !> A ball on a plane in steady rolling
   function ball(accuracy) result(spec)
      !> Required accuracy [-]
      real(wp), intent(in) :: accuracy
      type(case_spec) :: spec

      spec = hertz_case(curvature, curvature, force, 20, 20, 1.2_wp)
      call creep(spec, motion%steady_rolling, ksi=-1.0e-3_wp, mu=0.3_wp)
      spec%material%poiss = 0.3_wp
      spec%material%gg = 80000.0_wp
      spec%iteration%maxout = 100
      spec%iteration%accuracy = accuracy
      spec%rolling%dq = 1.0_wp
      spec%rolling%veloc = 1000.0_wp
   end function ball

   !> The same shifted, in a potential contact that does not depend on the load
   function shifted() result(spec)
      type(case_spec) :: spec

      spec = grid_case(curvature, curvature, force, 20, 20, 1.2_wp, 1.2_wp)
      call shift(spec, 5.0e-3_wp, mu=0.3_wp)
      spec%iteration%accuracy = 1.0e-3_wp
   end function shifted
end program test_foreseen_cost
