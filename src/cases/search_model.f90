!> The search for an accuracy as it is expected after a solution on few elements
!>
!> The rules are those of the search itself. The estimate of the coarse grid is known, those of finer ones are extrapolated. They
!> scatter, so that several searches are simulated, and the mean of the logarithms of their costs is taken: it is within a factor of
!> two of a search with one grid and of one with two.
module contact_cases_search_model
   use contact_base_kinds, only : wp
   use contact_cases_accuracy_grid, only : is_worth, level_grid, next_counts, stay_below
   use contact_cases_accuracy_plan, only : accuracy_law, is_near_enough, most_elements, most_levels, observed_order
   use contact_cases_accuracy_time, only : input_time
   use contact_cases_machine_pace, only : machine_pace
   use contact_cases_spec, only : case_spec
   use contact_cases_wheel_rail_accuracy, only : is_worth_while, smaller_sides
   use contact_patch_edge_slip, only : edge_slip_error
   use contact_patch_problem, only : patch_problem
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: coarse_solution, grid_time, later_grids, mean_cost, simulate_searches

   !> Estimates of finer grids over those that decrease with the expected order from the coarse grid: median, and standard deviation
   !> of the logarithm; of 206 contacts and 24 wheels (seeds 98001 to 98003 of tests/accuracy/cost.py)
   real(wp), parameter :: usual_ratio = 0.9_wp, scatter = 0.25_wp
   !> Deviations of an estimate, in standard deviations, with equal probability and a standard deviation of 1
   real(wp), parameter :: deviations(3) = [-1.22_wp, 0.0_wp, 1.22_wp]
   !> Time per element of second and later grids over that of the first one, since iterations start from the grid before, and plans
   !> and memory are there (the same seeds); of wheels if it was not measured
   real(wp), parameter :: later_grids = 0.65_wp
   !> Exponent of the number of elements in the time of a wheel: the search for contact does not depend on it, and estimates of few
   !> rows need a second solution. Instructions of ten wheels of any profiles on 20 to 56 elements across, 0.75 to 1.03 (seed 96111)
   real(wp), parameter :: wheel_power = 0.85_wp

   !> Time of a grid that was solved
   type :: grid_time
      !> Number of elements of all patches, and time [s]
      real(wp) :: elements = 1.0_wp, seconds = 0.0_wp
   contains
      !> Time of another grid
      procedure :: of_wheel
   end type grid_time

   !> A contact as it is known from its coarse solution
   type :: coarse_solution
      !> Typical errors of its kind
      type(accuracy_law) :: law
      !> Estimated error [-], negative for none, and time per element [s]
      real(wp) :: estimated = -1.0_wp, rate = 0.0_wp
      !> Sides of the contact, for wheels of the patch with the largest normal force, and of the elements [mm]
      real(wp) :: contact(2) = 0.0_wp, sides(2) = 0.0_wp
      !> Its grid; for wheels the numbers of elements of this patch only
      type(level_grid) :: grid
      !> Numbers of elements that must not change, 0 for others
      integer :: fixed(2) = 0
      !> Number of cases that are solved on each later grid
      integer :: cases = 1
      !> Part of the accuracy that later grids are designed for
      real(wp) :: designed = 1.0_wp
      !> First grid of the search
      type(level_grid) :: first
      !> Wheels: times of a first grid, and of one that starts from the elements before
      type(grid_time) :: fresh, started
      !> Sides of the first elements of the search [mm]; areas of the grids of all patches [mm2], and index of the patch with
      !> the largest normal force
      real(wp) :: first_sides(2) = 0.0_wp
      real(wp), allocatable :: areas(:)
      integer :: main = 1
   end type coarse_solution

   !> Sums over several searches
   type :: mean_cost
      !> Number of searches
      integer :: number = 0
      !> Logarithms of the number of elements of the last grid, for wheels of the largest patch, and of the time of the case [s]
      real(wp) :: elements = 0.0_wp, seconds = 0.0_wp
      !> Largest number of grids
      integer :: grids = 0
      !> Last grid of the last search; for wheels sides of the last elements [mm]
      type(level_grid) :: last
      real(wp) :: last_sides(2) = 0.0_wp
      !> Has the last search reached the maximum number of elements?
      logical :: is_limited = .false.
   contains
      !> Include a search
      procedure :: add
   end type mean_cost

contains

   !> Time of a grid of a wheel [s]
   pure real(wp) function of_wheel(self, elements) result(seconds)
      class(grid_time), intent(in) :: self
      !> Number of its elements
      real(wp), intent(in) :: elements

      seconds = self%seconds*(elements/self%elements)**wheel_power
   end function of_wheel

   pure subroutine add(self, elements, seconds, grids)
      class(mean_cost), intent(inout) :: self
      !> Elements of the last grid, and time of the case [s]
      real(wp), intent(in) :: elements, seconds
      !> Number of grids
      integer, intent(in) :: grids

      self%number = self%number + 1
      self%grids = max(self%grids, grids)
      self%elements = self%elements + log(elements)
      self%seconds = self%seconds + log(max(seconds, tiny(seconds)))
   end subroutine add

   !> Searches for the elements of a case, with deviations and, at last, without
   subroutine simulate_searches(spec, coarse, mean, problem, result)
      type(case_spec), intent(in) :: spec
      !> Coarse solution of the case
      type(coarse_solution), intent(in) :: coarse
      !> Sums over all searches
      type(mean_cost), intent(out) :: mean
      !> Problem of the coarse solution, and its result; of contacts only
      type(patch_problem), intent(in), optional :: problem
      type(patch_result), intent(in), optional :: result
      integer :: k, n

      do k = 1, size(deviations)
         do n = 1, size(deviations)
            call search([deviations(k), deviations(n)])
         end do
      end do
      call search([0.0_wp, 0.0_wp])

   contains

      subroutine search(deviation)
         !> Deviations of the estimates of the first and the second grid, in standard deviations
         real(wp), intent(in) :: deviation(2)

         if (allocated(coarse%areas)) then
            call search_pair(spec, coarse, deviation, mean)
         else
            call search_contact(spec, coarse, problem, result, deviation, mean)
         end if
      end subroutine search
   end subroutine simulate_searches

   !> Search for the grid of a contact
   subroutine search_contact(spec, coarse, problem, result, deviation, mean)
      type(case_spec), intent(in) :: spec
      !> Coarse solution of the case
      type(coarse_solution), intent(in) :: coarse
      !> Problem of the coarse solution, and its result
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(in) :: result
      !> Deviations of the estimates of the first and the second grid, in standard deviations
      real(wp), intent(in) :: deviation(2)
      !> Includes this search on return
      type(mean_cost), intent(inout) :: mean
      type(level_grid) :: grid
      real(wp) :: e, before, expected, work, sides(2)
      integer :: counts(2), level

      grid = coarse%first
      before = 0.0_wp
      expected = 0.0_wp
      work = 0.0_wp
      mean%is_limited = .false.
      do level = 1, most_levels
         work = work + merge(1.0_wp, coarse%cases*later_grids, level == 1)*product(real(grid%counts, wp))
         sides = grid%lengths/grid%counts
         e = coarse%estimated
         if (any(grid%counts /= coarse%grid%counts)) then
            e = extrapolated(coarse, sides)
            if (coarse%law%bound > 0.0_wp) e = max(e, edge_slip_error(problem, result, &
               & real(grid%counts(1), wp)/coarse%grid%counts(1)))
            e = e*exp(scatter*sum(deviation, mask=level == [1, 2]))
         end if
         if (is_near_enough(e, expected, spec%iteration%accuracy, coarse%law%share)) exit
         call next_counts(sides, grid%counts, coarse%contact/sides, e, observed_order(coarse%law, e, before, expected), &
            & coarse%designed*coarse%law%share*spec%iteration%accuracy, coarse%fixed, counts)
         mean%is_limited = product(real(counts, wp)) > most_elements(spec%limits)
         call stay_below(most_elements(spec%limits), coarse%fixed, counts)
         if (.not. is_worth(grid%counts, counts)) exit
         expected = e*minval(real(grid%counts, wp)/counts)**coarse%law%falls
         before = e
         grid%counts = counts
      end do
      mean%last = grid
      call mean%add(product(real(grid%counts, wp)), input_time(spec)*machine_pace() + coarse%rate*work, min(level, most_levels))
   end subroutine search_contact

   !> Search for the elements of a wheel on a rail
   subroutine search_pair(spec, coarse, deviation, mean)
      type(case_spec), intent(in) :: spec
      !> Coarse solution of the case
      type(coarse_solution), intent(in) :: coarse
      !> Deviations of the estimates of the first and the second size, in standard deviations
      real(wp), intent(in) :: deviation(2)
      !> Includes this search on return
      type(mean_cost), intent(inout) :: mean
      real(wp) :: e, before, expected, seconds, most, sides(2), next(2), patches(size(coarse%areas))
      integer :: level

      most = min(most_elements(spec%limits), real(spec%iteration%npot_max, wp))
      before = 0.0_wp
      expected = 0.0_wp
      seconds = 0.0_wp
      sides = coarse%first_sides
      do level = 1, most_levels
         patches = coarse%areas/product(sides)
         mean%is_limited = maxval(patches) > most
         if (level == 1) seconds = coarse%fresh%of_wheel(sum(min(patches, most)))
         if (level > 1) seconds = seconds + coarse%started%of_wheel(sum(min(patches, most)))
         e = coarse%estimated
         if (any(abs(sides - coarse%sides) > 0.0_wp)) &
            & e = extrapolated(coarse, sides)*exp(scatter*sum(deviation, mask=level == [1, 2]))
         if (is_near_enough(e, expected, spec%iteration%accuracy, coarse%law%share)) exit
         call smaller_sides(spec, coarse%main, coarse%contact/sides, patches, spread(sides, 2, size(patches)), &
            & coarse%law%share*spec%iteration%accuracy, e, observed_order(coarse%law, e, before, expected), sides, next)
         if (.not. is_worth_while(sides, next)) exit
         expected = e*minval(next/sides)**coarse%law%falls
         before = e
         sides = next
      end do
      mean%last_sides = sides
      call mean%add(min(most, maxval(patches)), input_time(spec)*machine_pace() + seconds, min(level, most_levels))
   end subroutine search_pair

   !> Estimate of a finer grid, which follows from the direction with fewer elements
   pure real(wp) function extrapolated(coarse, sides) result(e)
      !> Coarse solution of the case
      type(coarse_solution), intent(in) :: coarse
      !> Sides of the elements of the finer grid [mm]
      real(wp), intent(in) :: sides(2)
      real(wp) :: across, before

      across = minval(coarse%contact/sides, mask=coarse%fixed == 0)
      before = minval(coarse%contact/coarse%sides, mask=coarse%fixed == 0)
      e = max(usual_ratio*coarse%estimated*(before/across)**coarse%law%order, coarse%law%bound/across)
   end function extrapolated
end module contact_cases_search_model
