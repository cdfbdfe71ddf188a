!> Tangential contact problem with given traction bounds, and its true residual
!>
!> The slip per step is S(p) = W + dq c + B p, where B is the compliance A (shift, transient rolling) or the difference A - A'
!> between two time steps (steady rolling). For elements that have been in contact for a fraction of the step it contains that
!> fraction of dq c, and in steady rolling the displacement at the edge of contact for A'. In every element of the contact area
!> |p| <= g, and where S /= 0, p = -g S/|S|. As a single equation,
!>
!>     p - P_g(p - r S(p)) = 0
!>
!> with P_g the projection onto the disc of radius g and any r > 0. If the surface yields (contact_tangential_yield), S is the
!> sum of slip and plastic shearing until `finish_slip` separates them, and the return map replaces the projection.
module contact_tangential_problem
   use contact_base_kinds, only : wp
   use contact_base_limits, only : deadline_type
   use contact_base_solver_settings, only : solver_settings
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_numeric_pieces, only : add_long, clear_long, fill_whole, pieces_of
   use contact_tangential_second_order, only : second_order
   use contact_tangential_slip_loops, only : squares
   use contact_tangential_slip_turns, only : turned_residual
   use contact_tangential_yield, only : return_map, yield_data, yield_point
   implicit none (type, external)
   private

   public :: tangential_problem, tangential_solution, prepare_solution
   public :: add_creepages, apply_operator, slip_of, true_residual, contact_residual, divide_elements
   public :: residual_scale, limits_before, finish_slip, at_bound

   !> Tractions above this fraction of the bound are regarded as on it: round-off of a traction scaled to its bound; chosen
   real(wp), parameter :: at_bound = 1.0_wp - 1.0e-12_wp

   !> Data of a tangential problem on a window; constant during the solution
   type :: tangential_problem
      !> Size of the window and sides of the elements [mm]
      integer :: mx = 0, my = 0
      real(wp) :: dx = 1.0_wp, dy = 1.0_wp
      !> Elements in contact, shape (mx, my)
      logical, allocatable :: contact(:, :)
      !> Traction bound g [N/mm2], 0 outside contact, shape (mx, my); includes yield limits without slope
      real(wp), allocatable :: bound(:, :)
      !> Rigid slip and other fixed contributions to the slip per step [mm], without the
      !> unknown creepages, shape (mx, my, 2)
      real(wp), allocatable :: shift(:, :, :)
      !> Steady rolling (B = A - A')? Otherwise B = A
      logical :: steady = .false.
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer :: direction = 1
      !> Rolling towards increasing (+1) or decreasing (-1) y as well, for rolling in an arbitrary direction
      integer :: row_direction = 1
      !> Distance per step [mm]; factor of the unknown creepages
      real(wp) :: dq = 1.0_wp
      !> Fraction of the step for which each element has been in contact, an additional factor of the unknown creepages, shape
      !> (mx, my); unallocated: the whole step everywhere
      real(wp), allocatable :: share(:, :)
      !> Steady rolling with long steps: number of columns from an element to the edge of contact ahead of it, where its
      !> particle entered the contact during the step; 0 for a particle in contact throughout the step, shape (mx, my);
      !> unallocated: 0 everywhere
      integer, allocatable :: edge(:, :)
      !> Number of prescribed forces: 0, 1 (Fx), 2 (Fx, Fy)
      integer :: n_forces = 0
      !> Prescribed forces as sums of tractions over the elements, F/(dx dy) [N/mm2]
      real(wp) :: target(2) = 0.0_wp
      !> Tolerance, limits and parameters of the solvers
      type(solver_settings) :: settings
      !> Deadline of the case
      type(deadline_type) :: deadline
      !> Yield limits; unallocated: the surface does not yield
      type(yield_data), allocatable :: yield
      !> Terms of the leading edge, and weights and turns of the equations: all slip is weighted and turned until `finish_slip` is
      !> called; unallocated: first-order scheme
      type(second_order), allocatable :: second
   contains
      !> Does the traction of a yielding element depend on the plastic displacement?
      procedure :: hardens
   end type tangential_problem

   !> On entry an estimate, on exit the solution
   type :: tangential_solution
      !> Tangential tractions [N/mm2], shape (mx, my, 2)
      real(wp), allocatable :: p(:, :, :)
      !> Slip per step [mm], shape (mx, my, 2)
      real(wp), allocatable :: slip(:, :, :)
      !> Unknown creepages [-] (shifts [mm] for dq = 1); the first n_forces are used
      real(wp) :: creep(2) = 0.0_wp
      !> Element states, shape (mx, my)
      integer, allocatable :: division(:, :)
      !> Distance that particles slip in the step, up to the centres of elements [mm], shape (mx, my); set if allocated
      real(wp), allocatable :: path(:, :)
      !> Sensitivities of relative forces sum(p)/sum(g) to the unknown creepages, 0 if unknown
      real(wp) :: sensitivity(2, 2) = 0.0_wp
      !> Increase of the plastic displacement [mm], shape (mx, my, 2), and yield limit after the step [N/mm2], shape (mx, my);
      !> unallocated if the surface does not yield
      real(wp), allocatable :: plastic(:, :, :), limit(:, :)
   end type tangential_solution

contains

   pure logical function hardens(self)
      class(tangential_problem), intent(in) :: self
      hardens = .false.
      if (allocated(self%yield)) hardens = self%yield%slope /= 0.0_wp
   end function hardens

   !> Allocate a solution for a problem, set to zero; arrays of the right size keep their values
   subroutine prepare_solution(problem, solution)
      !> Size of the window
      type(tangential_problem), intent(in) :: problem
      !> Receives its arrays; arrays of the right size keep their values
      type(tangential_solution), intent(inout) :: solution

      if (allocated(solution%plastic)) deallocate(solution%plastic, solution%limit)
      if (allocated(solution%p)) then
         if (all(shape(solution%division) == [problem%mx, problem%my])) return
         deallocate(solution%p, solution%slip, solution%division)
      end if
      allocate(solution%p(problem%mx, problem%my, 2), solution%slip(problem%mx, problem%my, 2), &
         & solution%division(problem%mx, problem%my))
      call clear_long(size(solution%p), solution%p)
      call clear_long(size(solution%slip), solution%slip)
      call fill_whole(size(solution%division), element%exterior, solution%division)
   end subroutine prepare_solution

   !> Product B p on the whole window
   subroutine apply_operator(problem, operator, p, u)
      !> Determines the operator: steady rolling or a time step
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Their contribution to the slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)

      if (problem%steady) then
         call operator%steady(p, u)
      else
         call operator%tangential(p, u)
      end if
      if (allocated(problem%second)) call problem%second%add_terms(p, u)
   end subroutine apply_operator

   !> Slip per step S = W + dq c + B p [mm], on the whole window
   subroutine slip_of(problem, operator, p, creep, slip)
      !> Rigid slip and the effect of unknown creepages
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :)
      !> Creepages [-]; the first n_forces are used
      real(wp), intent(in) :: creep(2)
      !> Slip per step S [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)

      call apply_operator(problem, operator, p, slip)
      call add_long(size(slip), 1.0_wp, problem%shift, slip)
      call add_creepages(problem, creep, slip)
   end subroutine slip_of

   !> Add the slip per step due to unknown creepages
   pure subroutine add_creepages(problem, creep, slip)
      !> Distance per step, and the number of unknown creepages
      type(tangential_problem), intent(in) :: problem
      !> Creepages [-]; the first n_forces are used
      real(wp), intent(in) :: creep(2)
      !> Slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: slip(:, :, :)
      integer :: k

      do k = 1, problem%n_forces
         if (allocated(problem%share)) then
            slip(:, :, k) = slip(:, :, k) + problem%dq*creep(k)*problem%share
         else
            slip(:, :, k) = slip(:, :, k) + problem%dq*creep(k)
         end if
      end do
   end subroutine add_creepages

   !> Scale r of the slip in the residual [(N/mm2)/mm]: the stiffness of an element, 1/A_xx(0), or larger if the return map
   !> requires it for a decreasing yield limit
   pure real(wp) function residual_scale(problem, operator) result(r)
      !> Bounds, and slopes of the yield limit
      type(tangential_problem), intent(in) :: problem
      !> Prepared; its diagonal coefficients are used
      class(compliance), intent(in) :: operator

      r = 1.0_wp/operator%diagonal(2)
      if (allocated(problem%yield)) r = max(r, -2.0_wp*problem%yield%slope)
   end function residual_scale

   !> Relative residual of the contact conditions and of the prescribed forces
   !>
   !> sqrt(|p - P_g(p - r S)|^2/|g|^2 + |sum p - target|^2/(sum g)^2), g in the first term the lower of the bound of friction
   !> and the yield limit where that changes
   real(wp) function true_residual(problem, p, slip, r) result(residual)
      !> Traction bounds, prescribed forces, yield data
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :), slip(:, :, :)
      !> Scale of the slip, see residual_scale [(N/mm2)/mm]
      real(wp), intent(in) :: r
      real(wp) :: sum_g
      integer :: k

      residual = squared_residual(problem, p, slip, r)
      sum_g = 0.0_wp
      if (problem%n_forces > 0) sum_g = sum(problem%bound, mask=problem%contact)
      do k = 1, problem%n_forces
         if (sum_g > 0.0_wp) residual = residual + ((sum(p(:, :, k)) - problem%target(k))/sum_g)**2
      end do
      residual = sqrt(residual)
   end function true_residual

   !> The part of true_residual that the contact conditions have
   real(wp) function contact_residual(problem, p, slip, r) result(residual)
      !> Traction bounds and yield data
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: p(:, :, :), slip(:, :, :)
      !> Scale of the slip, see residual_scale [(N/mm2)/mm]
      real(wp), intent(in) :: r

      residual = sqrt(squared_residual(problem, p, slip, r))
   end function contact_residual

   !> Its square
   real(wp) function squared_residual(problem, p, slip, r) result(square)
      !> As in contact_residual
      type(tangential_problem), intent(in) :: problem
      real(wp), contiguous, intent(in) :: p(:, :, :), slip(:, :, :)
      real(wp), intent(in) :: r
      real(wp) :: scale, sums(2), total

      if (problem%hardens()) then
         call add_yielding(problem, p, slip, r, total, scale)
      else if (allocated(problem%second)) then
         total = turned_residual(problem%mx, problem%my, problem%second%weight, problem%second%part, problem%second%turns, &
            & problem%contact, problem%direction, p, problem%bound, slip, r)
         scale = sum(problem%bound**2, mask=problem%contact)
      else
         call squares(problem%mx*problem%my, problem%contact, problem%bound, p, slip, r, sums)
         total = sums(1)
         scale = sums(2)
      end if
      square = 0.0_wp
      if (scale > 0.0_wp) square = total/scale
   end function squared_residual

   !> Contribution with the return map instead of the projection, and the sum of squares for its scale
   subroutine add_yielding(problem, p, slip, r, total, scale)
      !> As in contact_residual
      type(tangential_problem), intent(in) :: problem
      real(wp), intent(in) :: p(:, :, :), slip(:, :, :), r
      !> Sums of squares [(N/mm2)2]
      real(wp), intent(out) :: total, scale
      real(wp), allocatable :: before(:, :)
      type(yield_point) :: point
      integer :: ix, iy
      !> Limits far below the friction bound are replaced by this fraction of it: p - r S has no more significant digits
      real(wp), parameter :: min_share = 1.0e-4_wp
      real(wp) :: z(2), length

      before = limits_before(problem, p, slip, r)
      total = 0.0_wp
      scale = 0.0_wp
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) cycle
            z = p(ix, iy, :) - r*slip(ix, iy, :)
            length = sqrt(z(1)**2 + z(2)**2)
            point = returned(problem, length, ix, iy, before(ix, iy), r)
            if (point%state /= element%adhesion) z = z*(point%radius/length)
            total = total + sum((p(ix, iy, :) - z)**2)
            associate (bound => problem%bound(ix, iy))
               scale = scale + max(min(bound, before(ix, iy)), min_share*bound)**2
            end associate
         end do
      end do
   end subroutine add_yielding

   !> Return map of an element
   pure type(yield_point) function returned(problem, length, ix, iy, before, r) result(point)
      type(tangential_problem), intent(in) :: problem
      !> |p - r S|, yield limit before the step [N/mm2]
      real(wp), intent(in) :: length, before
      integer, intent(in) :: ix, iy
      real(wp), intent(in) :: r
      point = return_map(length, problem%bound(ix, iy), before, problem%yield%slope, problem%yield%lowest, r)
   end function returned

   !> Yield limits before the step [N/mm2], shape (mx, my)
   !>
   !> In steady rolling these are the limits of the next upstream elements after the step: each row is followed from its leading
   !> side. Material keeps its limit in gaps between contact areas.
   function limits_before(problem, p, slip, r) result(before)
      !> Yield data and rolling direction
      type(tangential_problem), intent(in) :: problem
      !> Tractions p [N/mm2] and slip per step S [mm], both of shape (mx, my, 2)
      real(wp), intent(in) :: p(:, :, :), slip(:, :, :)
      !> Scale of the slip, see residual_scale [(N/mm2)/mm]
      real(wp), intent(in) :: r
      real(wp), allocatable :: before(:, :)
      integer :: iy

      before = problem%yield%limit
      if (.not. problem%steady) return
      if (pieces_of(problem%mx*problem%my) > 1) then
         !$omp parallel do
         do iy = 1, problem%my
            call follow_row(iy)
         end do
         !$omp end parallel do
      else
         do iy = 1, problem%my
            call follow_row(iy)
         end do
      end if

   contains

      !> Limits of a row, from its leading side on
      subroutine follow_row(iy)
         integer, intent(in) :: iy
         type(yield_point) :: point
         real(wp) :: limit
         integer :: ix, k

         limit = problem%yield%limit(merge(problem%mx, 1, problem%direction > 0), iy)
         do k = 1, problem%mx
            ix = merge(problem%mx + 1 - k, k, problem%direction > 0)
            before(ix, iy) = limit
            if (.not. problem%contact(ix, iy)) cycle
            point = returned(problem, hypot(p(ix, iy, 1) - r*slip(ix, iy, 1), p(ix, iy, 2) - r*slip(ix, iy, 2)), &
               & ix, iy, limit, r)
            limit = point%limit
         end do
      end subroutine follow_row
   end function limits_before

   !> Element states for given tractions and slip: slip if |p - r S| > g
   subroutine divide_elements(problem, p, slip, r, division)
      !> Traction bounds, and the elements in contact
      type(tangential_problem), intent(in) :: problem
      !> Tractions p [N/mm2] and slip per step S [mm], both of shape (mx, my, 2)
      real(wp), intent(in) :: p(:, :, :), slip(:, :, :)
      !> Scale of the slip, see residual_scale [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> Members of element, shape (mx, my)
      integer, intent(inout) :: division(:, :)
      real(wp), allocatable :: before(:, :)
      integer :: iy

      if (problem%hardens()) before = limits_before(problem, p, slip, r)
      if (pieces_of(size(division)) == 1) then
         do iy = 1, problem%my
            call divide_row(iy)
         end do
      else
         !$omp parallel do schedule(dynamic, 8)
         do iy = 1, problem%my
            call divide_row(iy)
         end do
         !$omp end parallel do
      end if

   contains

      !> States of a row
      subroutine divide_row(iy)
         integer, intent(in) :: iy
         type(yield_point) :: point
         real(wp) :: length, scale
         integer :: ix

         do ix = 1, problem%mx
            division(ix, iy) = element%exterior
            if (.not. problem%contact(ix, iy)) cycle
            scale = r
            if (allocated(problem%second)) scale = r*problem%second%weight(ix, iy)
            length = hypot(p(ix, iy, 1) - scale*slip(ix, iy, 1), p(ix, iy, 2) - scale*slip(ix, iy, 2))
            if (allocated(before)) then
               point = returned(problem, length, ix, iy, before(ix, iy), r)
               division(ix, iy) = point%state
            else
               division(ix, iy) = merge(element%slip, element%adhesion, length > problem%bound(ix, iy))
            end if
         end do
      end subroutine divide_row
   end subroutine divide_elements

   !> Separate plastic shearing from slip, in a solution whose slip is the sum of both
   !>
   !> Without slope an element yields if its limit is the bound. With the second-order scheme the slip becomes that at the
   !> centres of elements. Does nothing else if the surface does not yield.
   subroutine finish_slip(problem, r, solution)
      !> Yield data and rolling direction
      type(tangential_problem), intent(in) :: problem
      !> Scale of the slip, see residual_scale [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> Receives plastic displacements, yield limits and element states; the plastic part, weights and turns are removed from
      !> its slip
      type(tangential_solution), intent(inout) :: solution
      real(wp), allocatable :: before(:, :)
      type(yield_point) :: point
      real(wp) :: z(2), length
      integer :: ix, iy

      if (allocated(solution%path)) solution%path = hypot(solution%slip(:, :, 1), solution%slip(:, :, 2))
      if (allocated(problem%second)) call problem%second%centre_slip(problem%contact, solution%division == element%slip, &
         & problem%direction, solution%slip)
      if (.not. allocated(problem%yield)) return
      if (allocated(solution%plastic)) deallocate(solution%plastic, solution%limit)
      allocate(solution%plastic(problem%mx, problem%my, 2), source=0.0_wp)
      before = problem%yield%limit
      if (problem%hardens()) before = limits_before(problem, solution%p, solution%slip, r)
      allocate(solution%limit, source=before)
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) cycle
            if (problem%hardens()) then
               z = solution%p(ix, iy, :) - r*solution%slip(ix, iy, :)
               length = hypot(z(1), z(2))
               point = returned(problem, length, ix, iy, before(ix, iy), r)
               solution%division(ix, iy) = point%state
               solution%limit(ix, iy) = point%limit
               if (point%state == element%slip) solution%plastic(ix, iy, :) = (point%plastic/length)*z
            else if (solution%division(ix, iy) == element%slip .and. before(ix, iy) <= problem%bound(ix, iy)) then
               solution%division(ix, iy) = element%plastic
            end if
            if (solution%division(ix, iy) == element%plastic) then
               solution%plastic(ix, iy, :) = -solution%slip(ix, iy, :)
               solution%slip(ix, iy, :) = 0.0_wp
            else
               solution%slip(ix, iy, :) = solution%slip(ix, iy, :) + solution%plastic(ix, iy, :)
            end if
         end do
      end do
   end subroutine finish_slip
end module contact_tangential_problem
