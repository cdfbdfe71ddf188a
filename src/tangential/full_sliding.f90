!> Prescribed forces above the friction bound: the whole contact slides, and all tractions are at their bounds
!>
!> No creepage gives more force than the sum of the bounds. Instead of a search that cannot succeed, the creepages are set so
!> large that all elements slide in the direction that gives most of the prescribed force.
module contact_tangential_full_sliding
   use contact_base_kinds, only : wp
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_tangential_problem, only : apply_operator, finish_slip, prepare_solution, residual_scale, slip_of, &
      & tangential_problem, tangential_solution, true_residual
   implicit none (type, external)
   private

   public :: is_beyond_friction, slide_fully

   !> Slip due to creepages, relative to that due to tractions and given rigid slip
   real(wp), parameter :: far_out = 100.0_wp
   !> Number of passes for the directions of sliding
   integer, parameter :: passes = 3

contains

   !> Do the prescribed tangential forces exceed the traction bounds?
   pure logical function is_beyond_friction(problem) result(beyond)
      !> Traction bounds and prescribed forces
      type(tangential_problem), intent(in) :: problem

      beyond = .false.
      ! limits that increase with plastic displacement are not known in advance
      if (problem%n_forces == 0 .or. problem%hardens()) return
      beyond = norm2(problem%target(:problem%n_forces)) > (1.0_wp + problem%settings%eps)*sum(problem%bound, mask=problem%contact)
   end function is_beyond_friction

   !> Set the tractions to their bounds, opposite to slip in the direction of the forces
   subroutine slide_fully(problem, operator, solution, report)
      !> Traction bounds and prescribed forces
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> On exit the solution; values on entry are ignored
      type(tangential_solution), intent(inout) :: solution
      !> Receives ended, iterations, residual
      type(solve_report), intent(inout) :: report
      real(wp) :: direction(2), slip, length
      integer :: ix, iy, k, products_before

      call prepare_solution(problem, solution)
      products_before = operator%products
      direction = 0.0_wp
      direction(:problem%n_forces) = problem%target(:problem%n_forces)/norm2(problem%target(:problem%n_forces))
      do k = 1, 2
         solution%p(:, :, k) = merge(direction(k)*problem%bound, 0.0_wp, problem%contact)
      end do
      call apply_operator(problem, operator, solution%p, solution%slip)
      slip = max(maxval(abs(solution%slip)), maxval(abs(problem%shift)), tiny(slip))
      solution%creep(:problem%n_forces) = -far_out*slip/problem%dq*direction(:problem%n_forces)
      do k = 1, passes
         call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (.not. problem%contact(ix, iy)) cycle
               length = hypot(solution%slip(ix, iy, 1), solution%slip(ix, iy, 2))
               solution%p(ix, iy, :) = -problem%bound(ix, iy)/max(length, tiny(length))*solution%slip(ix, iy, :)
            end do
         end do
      end do
      call slip_of(problem, operator, solution%p, solution%creep, solution%slip)
      solution%division = merge(element%slip, element%exterior, problem%contact)
      solution%sensitivity = 0.0_wp
      report%method = "full sliding"
      report%gave_up = ""
      report%iterations = passes
      report%products = report%products + operator%products - products_before
      report%residual = true_residual(problem, solution%p, solution%slip, residual_scale(problem, operator))
      report%tolerance = problem%settings%eps
      report%ended = ending%beyond_friction
      call finish_slip(problem, residual_scale(problem, operator), solution)
   end subroutine slide_fully
end module contact_tangential_full_sliding
