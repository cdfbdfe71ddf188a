!> Linearised contact conditions: the derivative D of the projection or of the return map, and the Jacobian
!>
!> In an element D is the derivative of the projection: the identity if |z| <= g, z = p - r S, and (g/|z|)(1 - n n'), n = z/|z|,
!> otherwise; the Jacobian is J dp = dp - D(dp - r B dp). If the yield limit has a slope, the return map replaces the
!> projection: D has a radial part, and in steady rolling the limit carries changes downstream along each row.
module contact_tangential_newton_jacobian
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_numeric_pieces, only : copy_long, first_of, length_of, pieces_of
   use contact_tangential_problem, only : add_creepages, apply_operator, limits_before, residual_scale, &
      & tangential_problem, tangential_solution
   use contact_tangential_slip_loops, only : jacobian_of_projection, linearise_projection, project_change
   use contact_tangential_slip_turns, only : slip_turns
   use contact_tangential_yield, only : return_map, yield_point
   implicit none (type, external)
   private

   public :: apply_d, apply_jacobian, add_radial, differentiate_return_map, fit_workspace, linear_system, linearise, &
      & most_pieces, new_system, newton_workspace, restart, weigh_inverse

   !> Maximum dimension of the Krylov space before a restart; chosen
   integer, parameter :: restart = 40
   !> Maximum number of pieces of vectors in the orthogonalisation; chosen
   integer, parameter :: most_pieces = 64

   !> Workspace for one window size, without meaning between calls
   type :: newton_workspace
      integer :: mx = 0, my = 0
      !> Krylov basis, and the same after preconditioning, shapes (2 mx my + 2, restart + 1), (..., restart)
      real(wp), allocatable :: basis(:, :), preconditioned(:, :)
      !> The Jacobian in that basis, shape (restart + 1, restart), and sums over pieces of vectors, shape (restart + 1,
      !> most_pieces); allocated, as stacks may be small
      real(wp), allocatable :: hessenberg(:, :), part(:, :)
      !> Solution, right-hand side and workspace of the linear system, shape (2 mx my + 2)
      real(wp), allocatable :: x(:), b(:), work(:)
      !> Weight g/|z| (1 in adhesion, 0 outside contact) and direction n (0 in adhesion)
      real(wp), allocatable :: weight(:, :), direction(:, :, :)
      !> Weight in the preconditioner, see `weigh_inverse`
      real(wp), allocatable :: inverse_weight(:, :)
      !> Trial tractions and slip, residual, and two fields of workspace
      real(wp), allocatable :: trial(:, :, :), trial_slip(:, :, :), residual(:, :, :), step(:, :, :), best_slip(:, :, :)
      !> Border columns after preconditioning
      real(wp), allocatable :: border(:, :, :, :)
      !> Linearised return map, shape (mx, my); unallocated if the yield limit has no slope
      type(yield_point), allocatable :: point(:, :)
      !> Linearised turns of the slip, for the second-order scheme
      type(slip_turns) :: turns
   end type newton_workspace

   !> A linearised system with its scales
   type :: linear_system
      !> Number of unknown creepages
      integer :: n_forces = 0
      !> Number of traction unknowns
      integer :: n = 0
      !> 1/A_xx(0) [(N/mm2)/mm]
      real(wp) :: r = 1.0_wp
      !> Scales of tractions |g| and sums of g, and of the creepages
      real(wp) :: g_norm = 1.0_wp, g_sum = 1.0_wp, creep_scale = 1.0_wp
      !> Inverse of the Schur complement of the preconditioner
      real(wp) :: schur(2, 2) = 0.0_wp
   end type linear_system

contains

   !> Scales of a problem; those of the creepages and the Schur complement are set by the caller
   type(linear_system) function new_system(problem, operator) result(system)
      !> Problem whose size, forces and bounds determine the scales
      type(tangential_problem), intent(in) :: problem
      !> Operator whose diagonal coefficients determine the scale of the slip
      class(compliance), intent(in) :: operator

      system%n = 2*problem%mx*problem%my
      system%r = residual_scale(problem, operator)
      system%g_norm = sqrt(sum(problem%bound**2))
      system%g_sum = sum(problem%bound)
   end function new_system

   !> Allocate workspace for a window; kept if the size is unchanged
   subroutine fit_workspace(workspace, mx, my)
      !> Receives its arrays
      type(newton_workspace), intent(inout) :: workspace
      !> Size of the window in elements
      integer, intent(in) :: mx, my

      if (workspace%mx == mx .and. workspace%my == my) return
      if (allocated(workspace%basis)) then
         deallocate(workspace%basis, workspace%preconditioned, workspace%x, workspace%b, workspace%work)
         deallocate(workspace%weight, workspace%inverse_weight, workspace%direction, workspace%trial, workspace%trial_slip)
         deallocate(workspace%residual, workspace%step, workspace%best_slip, workspace%border)
      end if
      ! memory is touched only when a vector is first used
      allocate(workspace%basis(2*mx*my + 2, restart + 1), workspace%preconditioned(2*mx*my + 2, restart))
      if (.not. allocated(workspace%hessenberg)) &
         & allocate(workspace%hessenberg(restart + 1, restart), workspace%part(restart + 1, most_pieces))
      allocate(workspace%x(2*mx*my + 2), workspace%b(2*mx*my + 2), workspace%work(2*mx*my + 2))
      allocate(workspace%weight(mx, my), workspace%inverse_weight(mx, my), workspace%direction(mx, my, 2))
      allocate(workspace%trial(mx, my, 2), workspace%trial_slip(mx, my, 2))
      allocate(workspace%residual(mx, my, 2), workspace%step(mx, my, 2), workspace%best_slip(mx, my, 2))
      allocate(workspace%border(mx, my, 2, 2))
      workspace%mx = mx
      workspace%my = my
   end subroutine fit_workspace

   !> Weights and directions of D, and the residual field, at the current tractions
   subroutine linearise(problem, system, solution, workspace)
      !> Bounds, yield data, and elements in contact
      type(tangential_problem), intent(in) :: problem
      !> Scale of the slip, and those of tractions and creepages
      type(linear_system), intent(in) :: system
      !> Tractions and slip at which the derivatives are taken
      type(tangential_solution), intent(in) :: solution
      !> Receives weights, directions and the residual field
      type(newton_workspace), intent(inout) :: workspace

      if (allocated(workspace%point)) deallocate(workspace%point)
      if (problem%hardens()) then
         call linearise_return_map(problem, system, solution, workspace)
         call weigh_inverse(problem, workspace)
         return
      end if
      call copy_long(size(solution%slip), solution%slip, workspace%trial_slip)
      if (allocated(problem%second)) then
         call workspace%turns%linearise(problem%mx, problem%my, problem%second%weight, problem%second%part, problem%second%turns, &
            & problem%contact, problem%direction, solution%p, problem%bound, solution%slip, system%r)
         call workspace%turns%act(workspace%trial_slip)
      end if
      call linearise_projection(problem%mx*problem%my, problem%contact, problem%bound, solution%p, workspace%trial_slip, system%r, &
         & workspace%weight, workspace%direction, workspace%residual)
      call weigh_inverse(problem, workspace)
   end subroutine linearise

   !> Weights of the preconditioner, from those of D
   !>
   !> The change of slip per step of steady rolling is small for tractions that vary slowly along a row, that of a single step is
   !> large for tractions that vary slowly. A square and a root of the weights of D keep the eigenvalues of such tractions near 1.
   subroutine weigh_inverse(problem, workspace)
      !> Steady rolling or a time step
      type(tangential_problem), intent(in) :: problem
      !> Weights of D, and those of the preconditioner
      type(newton_workspace), intent(inout) :: workspace

      if (allocated(workspace%point)) then
         call copy_long(size(workspace%weight), workspace%weight, workspace%inverse_weight)
      else
         call weigh(size(workspace%weight), problem%steady, workspace%weight, workspace%inverse_weight)
      end if
   end subroutine weigh_inverse

   !> Squares or roots of weights
   subroutine weigh(n, squared, weight, weighed)
      !> Number of elements
      integer, intent(in) :: n
      !> Squares; otherwise roots
      logical, intent(in) :: squared
      !> Weights, and their squares or roots
      real(wp), intent(in) :: weight(n)
      real(wp), intent(inout) :: weighed(n)
      integer :: k

      if (pieces_of(n) == 1) then
         call weigh_piece(n, squared, weight, weighed)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         call weigh_piece(length_of(n, k), squared, weight(first_of(n, k)), weighed(first_of(n, k)))
      end do
      !$omp end parallel do
   end subroutine weigh

   !> The same for a piece
   pure subroutine weigh_piece(n, squared, weight, weighed)
      integer, intent(in) :: n
      logical, intent(in) :: squared
      real(wp), intent(in) :: weight(n)
      real(wp), intent(inout) :: weighed(n)

      if (squared) then
         weighed = weight**2
      else
         weighed = sqrt(weight)
      end if
   end subroutine weigh_piece

   !> The same if the yield limit has a slope
   subroutine linearise_return_map(problem, system, solution, workspace)
      type(tangential_problem), intent(in) :: problem
      type(linear_system), intent(in) :: system
      type(tangential_solution), intent(in) :: solution
      type(newton_workspace), intent(inout) :: workspace
      real(wp), allocatable :: before(:, :)
      integer :: iy

      before = limits_before(problem, solution%p, solution%slip, system%r)
      allocate(workspace%point(problem%mx, problem%my))
      if (pieces_of(problem%mx*problem%my) > 1) then
         !$omp parallel do
         do iy = 1, problem%my
            call linearise_row(iy)
         end do
         !$omp end parallel do
      else
         do iy = 1, problem%my
            call linearise_row(iy)
         end do
      end if

   contains

      !> Weights, directions and residuals of a row
      subroutine linearise_row(iy)
         integer, intent(in) :: iy
         integer :: ix
         real(wp) :: z(2), length

         workspace%weight(:, iy) = 0.0_wp
         workspace%direction(:, iy, :) = 0.0_wp
         workspace%residual(:, iy, :) = 0.0_wp
         do ix = 1, problem%mx
            if (.not. problem%contact(ix, iy)) cycle
            z = solution%p(ix, iy, :) - system%r*solution%slip(ix, iy, :)
            length = sqrt(z(1)**2 + z(2)**2)
            associate (point => workspace%point(ix, iy))
               point = return_map(length, problem%bound(ix, iy), before(ix, iy), problem%yield%slope, &
                  & problem%yield%lowest, system%r)
               workspace%weight(ix, iy) = 1.0_wp
               if (point%state /= element%adhesion) then
                  workspace%weight(ix, iy) = point%radius/length
                  workspace%direction(ix, iy, :) = z/length
                  z = z*(point%radius/length)
               end if
            end associate
            workspace%residual(ix, iy, :) = solution%p(ix, iy, :) - z
         end do
      end subroutine linearise_row
   end subroutine linearise_return_map

   !> v := v + n radial n.w, the radial part of the derivative of the return map
   subroutine add_radial(workspace, w, v)
      !> Radial parts n, from `linearise`
      type(newton_workspace), intent(in) :: workspace
      !> Field whose part along n is taken, shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: w(:, :, :)
      !> Field to which the part is added, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: v(:, :, :)
      integer :: iy

      if (pieces_of(size(workspace%weight)) > 1) then
         !$omp parallel do
         do iy = 1, size(v, 2)
            call add_row(iy)
         end do
         !$omp end parallel do
      else
         do iy = 1, size(v, 2)
            call add_row(iy)
         end do
      end if

   contains

      !> A row of the field
      subroutine add_row(iy)
         integer, intent(in) :: iy
         integer :: ix
         real(wp) :: c

         do ix = 1, size(v, 1)
            c = workspace%direction(ix, iy, 1)*w(ix, iy, 1) + workspace%direction(ix, iy, 2)*w(ix, iy, 2)
            v(ix, iy, :) = v(ix, iy, :) + workspace%point(ix, iy)%radius_by_length*c*workspace%direction(ix, iy, :)
         end do
      end subroutine add_row
   end subroutine add_radial

   !> Change of the returned tractions due to changes of z = p - r S and of the bound
   !>
   !> In steady rolling the changes of the yield limits are carried downstream.
   subroutine differentiate_return_map(problem, workspace, z, out, bound)
      !> Bounds, yield data, and the rolling direction
      type(tangential_problem), intent(in) :: problem
      !> Weights and directions, from `linearise`
      type(newton_workspace), intent(in) :: workspace
      !> Changes of p - r S [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: z(:, :, :)
      !> Changes of the tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: out(:, :, :)
      !> Changes of the traction bound [N/mm2], shape (mx, my); absent: none
      real(wp), contiguous, intent(in), optional :: bound(:, :)
      integer :: iy

      if (pieces_of(problem%mx*problem%my) > 1) then
         !$omp parallel do
         do iy = 1, problem%my
            call differentiate_row(problem, workspace, iy, z, out, bound)
         end do
         !$omp end parallel do
      else
         do iy = 1, problem%my
            call differentiate_row(problem, workspace, iy, z, out, bound)
         end do
      end if
   end subroutine differentiate_return_map

   !> Changes of the returned tractions of a row
   pure subroutine differentiate_row(problem, workspace, iy, z, out, bound)
      !> See `differentiate_return_map`
      type(tangential_problem), intent(in) :: problem
      type(newton_workspace), intent(in) :: workspace
      !> The row
      integer, intent(in) :: iy
      real(wp), contiguous, intent(in) :: z(:, :, :)
      real(wp), contiguous, intent(inout) :: out(:, :, :)
      real(wp), contiguous, intent(in), optional :: bound(:, :)
      integer :: ix, k
      real(wp) :: c, g, limit, n(2)

      limit = 0.0_wp
      do k = 1, problem%mx
         ix = merge(problem%mx + 1 - k, k, problem%direction > 0)
         n = workspace%direction(ix, iy, :)
         c = sum(n*z(ix, iy, :))
         associate (point => workspace%point(ix, iy))
            g = 0.0_wp
            if (present(bound)) then
               if (point%state == element%slip) g = bound(ix, iy)
            end if
            out(ix, iy, :) = workspace%weight(ix, iy)*(z(ix, iy, :) - c*n) &
               & + (point%radius_by_length*c + point%radius_by_limit*limit + g)*n
            if (problem%steady) then
               limit = point%limit_by_length*c + point%limit_by_limit*limit
               ! the limit has increased to the bound
               if (point%plastic > 0.0_wp) limit = limit + g
            end if
         end associate
      end do
   end subroutine differentiate_row

   !> v := D v
   subroutine apply_d(workspace, v)
      !> Weights and directions, from `linearise`
      type(newton_workspace), intent(in) :: workspace
      !> Field of two components, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: v(:, :, :)
      real(wp), allocatable :: whole(:, :, :)

      if (allocated(workspace%point)) whole = v
      call project_change(size(workspace%weight), workspace%weight, workspace%direction, v)
      if (allocated(workspace%point)) call add_radial(workspace, whole, v)
   end subroutine apply_d

   !> out := J y, y = (tractions, creepages), both scaled
   subroutine apply_jacobian(problem, operator, system, workspace, y, out)
      !> Problem to solve
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Scales of tractions, slip and creepages
      type(linear_system), intent(in) :: system
      !> Weights and directions, from `linearise`; its workspace is overwritten
      type(newton_workspace), intent(inout) :: workspace
      !> Scaled tractions, then scaled unknown creepages; shape (2 mx my + n_forces)
      real(wp), contiguous, target, intent(in) :: y(:)
      !> Scaled residuals of the contact conditions, then of the forces; same shape
      real(wp), contiguous, target, intent(out) :: out(:)
      real(wp), pointer, contiguous :: dp(:, :, :), res(:, :, :)
      real(wp) :: creep(2)
      integer :: k

      dp(1:problem%mx, 1:problem%my, 1:2) => y(:system%n)
      res(1:problem%mx, 1:problem%my, 1:2) => out(:system%n)
      call apply_operator(problem, operator, dp, workspace%trial)
      creep = 0.0_wp
      do k = 1, system%n_forces
         creep(k) = system%creep_scale*y(system%n + k)/system%g_norm
      end do
      if (allocated(problem%share) .or. allocated(problem%second)) then
         call add_creepages(problem, creep, workspace%trial)
         creep = 0.0_wp
      end if
      if (allocated(problem%second)) call workspace%turns%apply(workspace%trial)
      creep = problem%dq*creep
      if (allocated(workspace%point)) then
         do k = 1, 2
            workspace%trial(:, :, k) = dp(:, :, k) - system%r*(workspace%trial(:, :, k) + creep(k))
         end do
         call differentiate_return_map(problem, workspace, workspace%trial, res)
         res = dp - res
      else
         call jacobian_of_projection(problem%mx*problem%my, workspace%weight, workspace%direction, dp, workspace%trial, system%r, &
            & creep, res)
      end if
      do k = 1, system%n_forces
         out(system%n + k) = sum(dp(:, :, k))*system%g_norm/system%g_sum
      end do
   end subroutine apply_jacobian
end module contact_tangential_newton_jacobian
