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

   public :: coarse_solution, mean_cost, search_contact, search_pair

   !> Estimates of finer grids over those that decrease with the expected order from the coarse grid: median, and standard deviation
   !> of the logarithm; of 206 contacts and 24 wheels (seeds 98001 to 98003 of tests/accuracy/cost.py)
   real(wp), parameter :: usual_ratio = 0.9_wp, scatter = 0.25_wp
   !> Deviations of an estimate, in standard deviations, with equal probability and a standard deviation of 1
   real(wp), parameter, public :: deviations(3) = [-1.22_wp, 0.0_wp, 1.22_wp]
   !> Time per element of second and later grids over that of the first one, since iterations start from the grid before, and plans
   !> and memory are there (the same seeds)
   real(wp), parameter :: later_grids = 0.65_wp

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
      !> Wheels: areas of the grids of all patches [mm2], and index of the patch with the largest normal force
      real(wp), allocatable :: areas(:)
      integer :: main = 1
   end type coarse_solution

   !> Sums over several searches
   type :: mean_cost
      !> Number of searches
      integer :: number = 0
      !> Logarithms of the number of elements of the last grid, for wheels of the largest patch, and of the time of the case [s]
      real(wp) :: elements = 0.0_wp, seconds = 0.0_wp
      !> Has the last search reached the maximum number of elements?
      logical :: is_limited = .false.
   contains
      !> Include a search
      procedure :: add
   end type mean_cost

contains

   pure subroutine add(self, elements, seconds)
      class(mean_cost), intent(inout) :: self
      !> Elements of the last grid, and time of the case [s]
      real(wp), intent(in) :: elements, seconds

      self%number = self%number + 1
      self%elements = self%elements + log(elements)
      self%seconds = self%seconds + log(max(seconds, tiny(seconds)))
   end subroutine add

   !> Search for the grid of a contact
   subroutine search_contact(spec, coarse, problem, result, deviation, grid, mean)
      type(case_spec), intent(in) :: spec
      !> Coarse solution of the case
      type(coarse_solution), intent(in) :: coarse
      !> Problem of the coarse solution, and its result
      type(patch_problem), intent(in) :: problem
      type(patch_result), intent(in) :: result
      !> Deviations of the estimates of the first and the second grid, in standard deviations
      real(wp), intent(in) :: deviation(2)
      !> On entry the first grid, on return the last one
      type(level_grid), intent(inout) :: grid
      !> Includes this search on return
      type(mean_cost), intent(inout) :: mean
      real(wp) :: e, before, expected, work, sides(2)
      integer :: counts(2), level

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
      call mean%add(product(real(grid%counts, wp)), input_time(spec)*machine_pace() + coarse%rate*work)
   end subroutine search_contact

   !> Search for the elements of a wheel on a rail
   subroutine search_pair(spec, coarse, first, deviation, mean)
      type(case_spec), intent(in) :: spec
      !> Coarse solution of the case
      type(coarse_solution), intent(in) :: coarse
      !> Sides of the first elements [mm]
      real(wp), intent(in) :: first(2)
      !> Deviations of the estimates of the first and the second size, in standard deviations
      real(wp), intent(in) :: deviation(2)
      !> Includes this search on return
      type(mean_cost), intent(inout) :: mean
      real(wp) :: e, before, expected, work, most, sides(2), next(2), patches(size(coarse%areas))
      integer :: level

      most = min(most_elements(spec%limits), real(spec%iteration%npot_max, wp))
      before = 0.0_wp
      expected = 0.0_wp
      work = 0.0_wp
      sides = first
      do level = 1, most_levels
         patches = coarse%areas/product(sides)
         mean%is_limited = maxval(patches) > most
         work = work + merge(1.0_wp, later_grids, level == 1)*sum(min(patches, most))
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
      call mean%add(min(most, maxval(patches)), input_time(spec)*machine_pace() + coarse%rate*work)
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
