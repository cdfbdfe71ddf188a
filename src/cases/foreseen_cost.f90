!> Cost of a case with a prescribed accuracy, foreseen from a solution of the case on few elements
!>
!> The first grid of a search is known before. If it is coarse, it is solved here; otherwise a coarser one, from whose solution the
!> search is simulated. See doc/theory/accuracy.md. Cases that cannot be solved in this way keep the cost by typical errors of
!> contact_cases_estimate.
module contact_cases_foreseen_cost
   use contact_base_choices, only : motion
   use contact_base_error, only : error_kind, error_type
   use contact_base_kinds, only : long, wp
   use contact_base_limits, only : wall_clock
   use contact_base_log, only : log_type
   use contact_base_memory, only : bytes_per_element
   use contact_cases_accuracy, only : refuse_contact, series_share
   use contact_cases_accuracy_grid, only : across_contact, level_grid, next_counts, no_direction
   use contact_cases_accuracy_level, only : first_grid, keeps_axes, solve_level
   use contact_cases_accuracy_plan, only : expected_law, first_across, first_order_alone, prepare_level, refuse_case, &
      & solver_tolerance
   use contact_cases_accuracy_series, only : has_history
   use contact_cases_approximate_methods, only : approximate_method, choose_method
   use contact_cases_estimate, only : case_cost, estimate_cost
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_search_model, only : coarse_solution, grid_time, later_grids, mean_cost, simulate_searches
   use contact_cases_slot, only : open_contact, open_wheel_rail, problem_slot, release_slot
   use contact_cases_spec, only : case_spec
   use contact_cases_subsurface, only : stress_memory
   use contact_cases_wheel_rail_accuracy, only : error_of_pair, first_sides, lowest_order_of_errors
   use contact_cases_wheel_rail_session, only : check_files, solve_wheel_rail_case, wheel_rail_session
   use contact_grid_potential_contact, only : potential_contact
   use contact_patch_error_estimate, only : error_of_forces
   use contact_patch_order, only : order_of_errors
   use contact_text_words, only : integer_text
   use contact_wheelrail_memory, only : wheel_rail_memory
   use contact_wheelrail_result, only : wheel_rail_result
   implicit none (type, external)
   private

   public :: cost_forecast

   !> Maximum number of elements across the contact of the coarse solution; chosen: with 14 or 17 estimates scatter more
   real(wp), parameter :: coarse_across = 20.0_wp
   !> Maximum number of coarse grids, each finer than the one before, if contact is too narrow for an estimate; chosen
   integer, parameter :: most_trials = 3
   !> Maximum ratio of the numbers of elements of both coarse solutions of a wheel, of which the second one starts from the first;
   !> chosen
   real(wp), parameter :: most_more = 2.0_wp
   !> A contact problem of an experiment
   type :: foreseen_problem
      !> Result element and number of the contact problem
      integer :: owner(2) = 0
      !> Sessions of the coarse solutions
      type(problem_slot) :: slot
      !> Do they hold a coarse solution of the last case, which the next one may continue? Will a run refuse the last case?
      logical :: is_solved = .false., is_refused = .false.
      !> Time that a coarse solution of the last case exceeded [s], 0 if none did
      real(wp) :: exceeded = 0.0_wp
      !> Grid of the cases that the next one may continue, as expected
      type(level_grid) :: series
   end type foreseen_problem

   !> Forecasts of the cases of an experiment, one after the other
   type :: cost_forecast
      !> Maximum time of a coarse solution, and time that is left for those of all cases [s]; chosen
      real(wp) :: patience = 0.5_wp, left = 3.0_wp
      type(foreseen_problem), allocatable, private :: problems(:)
   contains
      !> Estimate the cost of the next case
      procedure :: foresee
      !> Free the memory of the sessions
      procedure :: release
   end type cost_forecast

contains

   !> Estimate the cost of a case; of one with an accuracy from a coarse solution
   subroutine foresee(self, spec, owner, folder, cost)
      class(cost_forecast), intent(inout) :: self
      !> Case that can be computed
      type(case_spec), intent(in) :: spec
      !> Result element and contact problem
      integer, intent(in) :: owner(2)
      !> Folder to which names of files are relative, "" for the current one
      character(len=*), intent(in) :: folder
      !> Cost: elements, seconds and bytes; or why a run refuses the case
      type(case_cost), intent(out) :: cost
      type(approximate_method) :: chosen
      type(error_type), allocatable :: refusal
      character(len=:), allocatable :: why
      real(wp) :: began
      integer :: k

      call estimate_cost(spec, cost)
      call find_problem(self, owner, k)
      associate (problem => self%problems(k))
         if (spec%iteration%allows_approximate) call choose_method(spec, chosen)
         if (chosen%found .or. .not. (spec%iteration%accuracy > 0.0_wp .and. spec%solve)) then
            if (spec%solve) problem%is_solved = .false.
            return
         end if
         call refuse_to_run(problem, spec, refusal)
         problem%is_refused = allocated(refusal)
         if (problem%is_refused) then
            problem%is_solved = .false.
            cost%refusal = refusal%message
            return
         end if
         began = wall_clock()
         problem%exceeded = 0.0_wp
         why = ""
         if (.not. self%left > 0.0_wp) then
            why = "as solutions on few elements of the cases before took long"
         else if (allocated(spec%wheel_rail)) then
            call foresee_pair(problem, spec, folder, min(self%patience, self%left), cost)
         else if (needs_case_before(spec) .and. .not. problem%is_solved) then
            why = "as the case before was not solved on few elements"
         else
            call foresee_contact(problem, spec, folder, min(self%patience, self%left), cost)
         end if
         if (cost%source == "" .and. why == "") why = "as there is no estimate on few elements"
         problem%is_solved = why == "" .and. .not. allocated(spec%wheel_rail)
         self%left = self%left - (wall_clock() - began)
         if (why /= "") cost%source = "typical of such contacts, " // why
         if (problem%exceeded > machine_pace()*cost%seconds) then
            cost%seconds = problem%exceeded/machine_pace()
            cost%source = "at least, as a solution on few elements was not finished in this time"
         end if
      end associate
   end subroutine foresee

   !> Find a problem by its owner, or make a new one
   subroutine find_problem(self, owner, place)
      class(cost_forecast), intent(inout) :: self
      !> Result element and contact problem
      integer, intent(in) :: owner(2)
      !> Its index
      integer, intent(out) :: place
      type(foreseen_problem), allocatable :: more(:)

      if (.not. allocated(self%problems)) allocate(self%problems(0))
      do place = 1, size(self%problems)
         if (all(self%problems(place)%owner == owner)) return
      end do
      allocate(more(place))
      more(:place - 1) = self%problems
      more(place)%owner = owner
      call move_alloc(more, self%problems)
   end subroutine find_problem

   !> Why a run refuses a case with its accuracy, as far as it is known without solving the cases before
   subroutine refuse_to_run(problem, spec, refusal)
      type(foreseen_problem), intent(inout) :: problem
      type(case_spec), intent(in) :: spec
      !> Allocated if it does
      type(error_type), allocatable, intent(out) :: refusal

      if (allocated(spec%wheel_rail)) then
         call open_wheel_rail(problem%slot)
         call refuse_case(spec, refusal)
      else
         call open_contact(problem%slot)
         if (needs_case_before(spec) .and. .not. (problem%is_solved .or. problem%is_refused)) then
            call refuse_case(spec, refusal)
         else
            call refuse_contact(problem%slot%session, spec, refusal)
         end if
      end if
   end subroutine refuse_to_run

   !> Does the solution depend on the case before, or the contact on its semi-axes?
   pure logical function needs_case_before(spec)
      type(case_spec), intent(in) :: spec

      needs_case_before = has_history(spec) .or. keeps_axes(spec)
   end function needs_case_before

   subroutine release(self)
      class(cost_forecast), intent(inout) :: self
      integer :: k

      if (.not. allocated(self%problems)) return
      do k = 1, size(self%problems)
         call release_slot(self%problems(k)%slot)
      end do
   end subroutine release

   !> The cost of a contact
   subroutine foresee_contact(self, spec, folder, patience, cost)
      type(foreseen_problem), intent(inout) :: self
      type(case_spec), intent(in) :: spec
      !> Folder to which names of files are relative
      character(len=*), intent(in) :: folder
      !> Maximum time of the coarse solution [s]
      real(wp), intent(in) :: patience
      !> Unchanged if there is no coarse solution
      type(case_cost), intent(inout) :: cost
      type(coarse_solution) :: coarse
      type(mean_cost) :: mean

      coarse%law = expected_law(spec)
      coarse%fixed = merge([spec%grid%mx, spec%grid%my], 0, [spec%grid%mx, spec%grid%my] <= no_direction)
      coarse%cases = self%slot%session%series%before(spec) + 1
      if (has_history(spec)) coarse%designed = series_share
      call first_grid(self%slot%session, spec, coarse%law, coarse%fixed, coarse%first)
      if (has_history(spec)) coarse%first = self%series
      call solve_coarse(self%slot, spec, folder, patience, coarse, self%exceeded)
      if (.not. coarse%estimated >= 0.0_wp) return
      associate (first => coarse%first)
         first%lengths = coarse%grid%lengths
         ! too few elements for an estimate
         if (product(real(first%counts, wp)) < product(real(coarse%grid%counts, wp))) first%counts = coarse%grid%counts
      end associate
      call simulate_searches(spec, coarse, mean, self%slot%session%problem, self%slot%result)
      self%series = mean%last
      call set_cost(spec, coarse, mean, cost)
   end subroutine foresee_contact

   !> Solve a contact on few elements; without estimate if that fails
   subroutine solve_coarse(slot, spec, folder, patience, coarse, exceeded)
      !> Sessions; that of contacts holds the solution
      type(problem_slot), intent(inout) :: slot
      type(case_spec), intent(in) :: spec
      !> Folder to which names of files are relative
      character(len=*), intent(in) :: folder
      !> Maximum time [s]
      real(wp), intent(in) :: patience
      !> On entry with the typical errors, on return with the solution
      type(coarse_solution), intent(inout) :: coarse
      !> Unchanged, or the maximum time if it was exceeded [s]
      real(wp), intent(inout) :: exceeded
      type(case_spec) :: level
      type(log_type) :: log
      type(error_type), allocatable :: error
      real(wp) :: began(2), ended(2), seconds, sides(2)
      integer :: k, counts(2)
      logical :: is_solved

      level = spec
      level%limits%deadline%seconds = min(level%limits%deadline%seconds, patience)
      call level%limits%deadline%start()
      associate (session => slot%session, result => slot%result)
         call first_grid(session, spec, coarse%law, coarse%fixed, coarse%grid, coarse_across)
         do k = 1, most_trials
            call read_clocks(began)
            call solve_level(session, level, coarse%grid, .false., log, result, is_solved, seconds, error, folder)
            call read_clocks(ended)
            if (ran_out_of_time(error)) exceeded = level%limits%deadline%seconds
            if (allocated(error)) exit
            if (.not. is_solved .or. result%ncon == 0) exit
            coarse%estimated = error_of_forces(session%problem, result)
            sides = [result%grid%dx, result%grid%dy]
            counts = [result%grid%mx, result%grid%my]
            if (coarse%estimated >= 0.0_wp .or. has_history(spec)) exit
            call next_counts(sides, counts, across_contact(result), coarse%estimated, coarse%law%falls, &
               & spec%iteration%accuracy, coarse%fixed, coarse%grid%counts)
         end do
         if (.not. coarse%estimated >= 0.0_wp) then
            call session%series%clear()
            return
         end if
         coarse%grid%counts = counts
         coarse%grid%lengths = counts*sides
         coarse%sides = sides
         coarse%contact = across_contact(result)*sides
         coarse%rate = minval(ended - began)/product(real(counts, wp))
         if (spec%motion == motion%steady_rolling .and. order_of_errors(result%tangential) /= 2) &
            & coarse%law = first_order_alone(coarse%law)
         call session%series%take(spec, coarse%grid, coarse%estimated)
         session%curvatures = 0.0_wp
         if (allocated(session%problem%hertz)) session%curvatures = [session%problem%hertz%a1, session%problem%hertz%b1]
      end associate
   end subroutine solve_coarse

   !> The cost of a wheel on a rail
   subroutine foresee_pair(self, spec, folder, patience, cost)
      type(foreseen_problem), intent(inout) :: self
      type(case_spec), intent(in) :: spec
      !> Folder to which names of files are relative
      character(len=*), intent(in) :: folder
      !> Maximum time of the coarse solution [s]
      real(wp), intent(in) :: patience
      !> Unchanged if there is no coarse solution
      type(case_cost), intent(inout) :: cost
      type(coarse_solution) :: coarse
      type(mean_cost) :: mean
      type(grid_time) :: time
      real(wp) :: began

      began = wall_clock()
      coarse%law = expected_law(spec)
      coarse%first_sides = first_sides(spec, first_across(coarse%law, spec%iteration%accuracy))
      coarse%sides = max(coarse%first_sides, first_sides(spec, coarse_across))
      associate (session => self%slot%wheel_rail, result => self%slot%wheel_rail_result)
         call solve_pair(session, spec, folder, patience, coarse%sides, .false., result, time, self%exceeded)
         if (.not. time%seconds > 0.0_wp) return
         call take_pair(session%memory, spec, result, coarse)
         if (.not. coarse%estimated >= 0.0_wp) return
         coarse%fresh = time
         coarse%started = grid_time(time%elements, later_grids*time%seconds)
         call simulate_searches(spec, coarse, mean)
         if (mean%grids > 1) then
            call solve_pair(session, spec, folder, patience - (wall_clock() - began), &
               & sides_between(coarse%sides, mean%last_sides), .true., result, time, self%exceeded)
            if (time%seconds > 0.0_wp) coarse%started = time
            call simulate_searches(spec, coarse, mean)
         end if
      end associate
      call set_cost(spec, coarse, mean, cost)
   end subroutine foresee_pair

   !> Solve a wheel on a rail with few elements
   subroutine solve_pair(session, spec, folder, patience, sides, refines, result, time, exceeded)
      type(wheel_rail_session), intent(inout) :: session
      type(case_spec), intent(in) :: spec
      !> Folder to which names of files are relative
      character(len=*), intent(in) :: folder
      !> Maximum time [s]
      real(wp), intent(in) :: patience
      !> Sides of the elements [mm]
      real(wp), intent(in) :: sides(2)
      !> Does it start from the elements before, as in a search?
      logical, intent(in) :: refines
      !> Result, with errors
      type(wheel_rail_result), intent(inout) :: result
      !> Number of elements and time; none if the solution failed
      type(grid_time), intent(out) :: time
      !> Unchanged, or the maximum time if it was exceeded [s]
      real(wp), intent(inout) :: exceeded
      type(case_spec) :: level
      type(log_type) :: log
      type(error_type), allocatable :: error
      real(wp) :: began(2), ended(2)
      integer :: k

      level = spec
      call prepare_level(solver_tolerance(spec%iteration%accuracy), level)
      level%wheel_rail%search%dx = sides(1)
      level%wheel_rail%search%ds = sides(2)
      level%limits%deadline%seconds = min(level%limits%deadline%seconds, patience)
      if (allocated(session%memory%slot)) session%memory%slot%state%started = .false.
      ! the time of files is expected separately
      call check_files(session, spec, folder, log, error)
      if (allocated(error)) return
      call level%limits%deadline%start()
      session%problem%refines = refines
      call read_clocks(began)
      call solve_wheel_rail_case(session, level, folder, log, result, error)
      call read_clocks(ended)
      session%problem%refines = .false.
      if (ran_out_of_time(error)) exceeded = level%limits%deadline%seconds
      if (allocated(error)) return
      if (.not. result%status%is_solved() .or. session%memory%used == 0) return
      time%elements = 0.0_wp
      do k = 1, session%memory%used
         time%elements = time%elements + area_of(session%memory%slot(k)%result%grid)/product(sides)
      end do
      time%seconds = minval(ended - began)
   end subroutine solve_pair

   !> Was a solution ended by its time limit?
   pure logical function ran_out_of_time(error)
      !> Error of the solution, unallocated for none
      type(error_type), allocatable, intent(in) :: error

      ran_out_of_time = .false.
      if (allocated(error)) ran_out_of_time = error%kind == error_kind%time
   end function ran_out_of_time

   !> Area of a grid [mm2]
   pure real(wp) function area_of(grid) result(area)
      type(potential_contact), intent(in) :: grid

      area = real(grid%npot(), wp)*grid%dx*grid%dy
   end function area_of

   !> What a search can be simulated from after a coarse solution
   subroutine take_pair(memory, spec, result, coarse)
      !> Solved patches
      type(wheel_rail_memory), intent(in) :: memory
      type(case_spec), intent(in) :: spec
      !> The solution
      type(wheel_rail_result), intent(in) :: result
      !> On entry with the typical errors, on return with the solution
      type(coarse_solution), intent(inout) :: coarse
      integer :: k

      coarse%estimated = error_of_pair(memory, spec%wheel_rail, result)
      allocate(coarse%areas(memory%used))
      do k = 1, memory%used
         coarse%areas(k) = area_of(memory%slot(k)%result%grid)
      end do
      coarse%main = maxloc(memory%slot(:memory%used)%result%fn, dim=1)
      associate (patch => memory%slot(coarse%main)%result)
         coarse%contact = across_contact(patch)*[patch%grid%dx, patch%grid%dy]
         coarse%grid%counts = [patch%grid%mx, patch%grid%my]
      end associate
      if (spec%motion == motion%steady_rolling .and. lowest_order_of_errors(memory) /= 2) &
         & coarse%law = first_order_alone(coarse%law)
   end subroutine take_pair

   !> Sides on the way from coarse elements to the last ones of a search, with a limited number of elements
   pure function sides_between(sides, last) result(between)
      !> Sides of the coarse and the last elements [mm]
      real(wp), intent(in) :: sides(2), last(2)
      !> Their sides [mm]
      real(wp) :: between(2)
      real(wp) :: more

      more = product(sides/last)
      between = last
      if (more > most_more) between = sides*(last/sides)**(log(most_more)/log(more))
   end function sides_between

   !> Elapsed time, and processor time, which is less if other processes run, but more if threads wait actively [s]
   subroutine read_clocks(clocks)
      !> Both times since fixed instants
      real(wp), intent(out) :: clocks(2)

      clocks(1) = wall_clock()
      call cpu_time(clocks(2))
   end subroutine read_clocks

   !> Set the cost to the mean of searches
   subroutine set_cost(spec, coarse, mean, cost)
      type(case_spec), intent(in) :: spec
      type(coarse_solution), intent(in) :: coarse
      !> Sums of logarithms; the last search without deviations
      type(mean_cost), intent(in) :: mean
      type(case_cost), intent(inout) :: cost
      type(potential_contact) :: grid
      real(wp) :: n

      n = exp(mean%elements/mean%number)
      cost%elements = nint(n, long)
      cost%at_most = mean%is_limited
      grid%mx = nint(sqrt(n))
      grid%my = grid%mx
      cost%bytes = n*bytes_per_element + real(stress_memory(spec, grid), wp)
      ! in units of the machine of the tables
      cost%seconds = exp(mean%seconds/mean%number)/machine_pace()
      cost%source = "from a solution on " // integer_text(coarse%grid%counts(1)) // " x " // integer_text(coarse%grid%counts(2)) &
         & // " elements"
   end subroutine set_cost
end module contact_cases_foreseen_cost
