!> The linear system of a Newton step: restarted GMRES with a preconditioner and a border for prescribed forces
!>
!> Directions in the range of D are preconditioned by the inverse of the circulant of B, the others are unchanged; border rows
!> by block elimination, see doc/theory/solvers.md.
module contact_tangential_newton_linear
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_numeric_pieces, only : add_long, clear_long, copy_long, divide_long, inner_long, pieces_of
   use contact_numeric_vectors, only : add, add_four, inner, inner_four
   use contact_tangential_newton_jacobian, only : add_radial, apply_d, apply_jacobian, linear_system, most_pieces, &
      & newton_workspace, restart
   use contact_tangential_problem, only : add_creepages, tangential_problem
   use contact_tangential_slip_loops, only : join_parts, project_change
   implicit none (type, external)
   private

   public :: precondition_field, solve_linear

   !> Maximum number of restarts; chosen
   integer, parameter :: max_cycles = 4
   !> A vector that orthogonalisation reduces to less than this fraction of its length is orthogonalised again; chosen
   real(wp), parameter :: shortened = 0.1_wp
   !> Minimum length of a piece of a vector in the orthogonalisation, and minimum vector length for using threads; chosen
   integer, parameter :: least_piece = 1024, worth_threads = 40000
   !> Decay of sums along a row per element, times sqrt(mx), and its maximum; chosen by measurement
   real(wp), parameter :: decay = 0.3_wp, largest_decay = 0.9_wp
   !> Limits below which Schur complements are regarded as singular, absolute for one force, relative for two; round-off
   real(wp), parameter :: singular_one = 1.0e-12_wp, singular_two = 1.0e-14_wp

contains

   !> Restarted GMRES (Saad and Schultz 1986), preconditioned from the right
   !>
   !> On exit workspace%step contains the correction of the tractions [N/mm2].
   subroutine solve_linear(problem, operator, system, workspace, unbalance, tolerance, correction, preconditionings, reached)
      !> Problem to solve
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Scales; receives the Schur complement of the creepages
      type(linear_system), intent(inout) :: system
      !> On entry weights, directions and residual field; also stores the vectors of the Krylov space
      type(newton_workspace), target, intent(inout) :: workspace
      !> Relative errors of the prescribed forces
      real(wp), intent(in) :: unbalance(2)
      !> Tolerance relative to the right-hand side
      real(wp), intent(in) :: tolerance
      !> Correction of the creepages
      real(wp), intent(out) :: correction(2)
      !> Number of applications of the preconditioner; incremented
      integer, intent(inout) :: preconditionings
      !> Relative residual; the success of a Newton step is measured by the residual of the resulting tractions
      real(wp), intent(out), optional :: reached
      real(wp) :: cs(restart), sn(restart), s(restart + 1), y(restart)
      real(wp) :: start, beta, before, after, t
      integer :: n, m, j, k, cycle_, used

      n = system%n + system%n_forces
      if (system%n_forces > 0) call prepare_border(problem, operator, system, workspace, preconditionings)
      associate (v => workspace%basis, z => workspace%preconditioned, h => workspace%hessenberg, x => workspace%x, b => workspace%b)
         call clear_long(n, x)
         ! b is the negative of the right-hand side
         call copy_long(system%n, workspace%residual, b)
         if (n > system%n) b(system%n + 1:n) = system%g_norm*unbalance(:system%n_forces)
         call copy_long(n, b, v(:, 1))
         start = norm_of(n, b)
         beta = start
         do cycle_ = 1, max_cycles
            if (.not. beta > tolerance*start) exit
            call divide_long(n, merge(-beta, beta, cycle_ == 1), v(:, 1))
            s = 0.0_wp
            s(1) = beta
            used = 0
            do j = 1, restart
               call precondition(problem, operator, system, workspace, v(:n, j), z(:n, j), preconditionings)
               call apply_jacobian(problem, operator, system, workspace, z(:n, j), v(:n, j + 1))
               before = sqrt(inner_long(n, v(:, j + 1), v(:, j + 1)))
               h(:j, j) = 0.0_wp
               after = take_away(n, j, v, workspace%part, h(:j, j))
               if (after < shortened*before) after = take_away(n, j, v, workspace%part, h(:j, j))
               h(j + 1, j) = after
               if (after > 0.0_wp) call divide_long(n, after, v(:, j + 1))
               do k = 1, j - 1
                  t = cs(k)*h(k, j) + sn(k)*h(k + 1, j)
                  h(k + 1, j) = -sn(k)*h(k, j) + cs(k)*h(k + 1, j)
                  h(k, j) = t
               end do
               t = hypot(h(j, j), h(j + 1, j))
               if (.not. t > 0.0_wp) exit
               used = j
               cs(j) = h(j, j)/t
               sn(j) = h(j + 1, j)/t
               h(j, j) = t
               s(j + 1) = -sn(j)*s(j)
               s(j) = cs(j)*s(j)
               if (abs(s(j + 1)) <= tolerance*start .or. .not. after > 0.0_wp) exit
            end do
            if (used == 0) exit
            do k = used, 1, -1
               y(k) = (s(k) - dot_product(h(k, k + 1:used), y(k + 1:used)))/h(k, k)
            end do
            do k = 1, used
               call add_long(n, y(k), z(:, k), x)
            end do
            beta = abs(s(used + 1))
            if (beta <= tolerance*start .or. cycle_ == max_cycles) exit
            call apply_jacobian(problem, operator, system, workspace, x(:n), workspace%work(:n))
            v(:n, 1) = -b(:n) - workspace%work(:n)
            beta = norm_of(n, v(:, 1))
         end do
         if (present(reached)) reached = beta/start
         m = system%n
         call copy_long(m, x, workspace%step)
         correction = 0.0_wp
         do k = 1, system%n_forces
            correction(k) = x(m + k)*system%creep_scale/system%g_norm
         end do
      end associate
   end subroutine solve_linear

   !> Length of a vector; threads share long ones
   real(wp) function norm_of(n, v) result(norm)
      !> Number of components
      integer, intent(in) :: n
      real(wp), intent(in) :: v(n)

      if (pieces_of(n) == 1) then
         norm = norm2(v)
      else
         norm = sqrt(inner_long(n, v, v))
      end if
   end function norm_of

   !> Orthogonalise the next vector against the first j vectors; returns its remaining length
   !>
   !> Processed by pieces, so that a piece of that vector stays in the cache while those of the others are read. The pieces and
   !> the order of their sums do not depend on the number of threads.
   real(wp) function take_away(n, j, v, part, h) result(length)
      !> Length of the vectors in use, and their number
      integer, intent(in) :: n, j
      !> Vectors
      real(wp), contiguous, intent(inout) :: v(:, :)
      !> Workspace, see newton_workspace
      real(wp), contiguous, intent(inout) :: part(:, :)
      !> The components are added here
      real(wp), intent(inout) :: h(:)
      real(wp) :: now(restart)
      integer :: k, one, piece, pieces

      one = max(least_piece, 4*((n + 4*most_pieces - 1)/(4*most_pieces)))
      pieces = (n + one - 1)/one
      ! a parallel region allocates memory, even with a single thread
      if (n <= worth_threads) then
         do piece = 1, pieces
            call find_parts(n, j, size(v, 1), v, one, piece, part(:, piece))
         end do
      else
         !$omp parallel do
         do piece = 1, pieces
            call find_parts(n, j, size(v, 1), v, one, piece, part(:, piece))
         end do
         !$omp end parallel do
      end if
      do k = 1, j
         now(k) = sum(part(k, :pieces))
         h(k) = h(k) + now(k)
      end do
      if (n <= worth_threads) then
         do piece = 1, pieces
            call remove_parts(n, j, size(v, 1), v, one, piece, now, part(restart + 1, piece))
         end do
      else
         !$omp parallel do
         do piece = 1, pieces
            call remove_parts(n, j, size(v, 1), v, one, piece, now, part(restart + 1, piece))
         end do
         !$omp end parallel do
      end if
      length = sqrt(sum(part(restart + 1, :pieces)))
   end function take_away

   !> Inner products of a piece of the next vector with those before it
   subroutine find_parts(n, j, rows, v, one, piece, part)
      !> Length of the vectors that counts, and their number
      integer, intent(in) :: n, j
      !> The vectors, and the length of their columns
      integer, intent(in) :: rows
      real(wp), intent(in) :: v(rows, j + 1)
      !> Length of a piece, and its number
      integer, intent(in) :: one, piece
      !> Inner products
      real(wp), intent(inout) :: part(:)
      integer :: first, k, length

      first = one*(piece - 1) + 1
      length = min(one, n + 1 - first)
      do k = 1, j - 3, 4
         call inner_four(length, rows, v(first, k), v(first, j + 1), part(k:k + 3))
      end do
      do k = 4*(j/4) + 1, j
         part(k) = inner(length, v(first, k), v(first, j + 1))
      end do
   end subroutine find_parts

   !> Subtract the others from a piece of the next vector
   subroutine remove_parts(n, j, rows, v, one, piece, part, left)
      !> Length of the vectors that counts, and their number
      integer, intent(in) :: n, j
      !> The vectors, and the length of their columns
      integer, intent(in) :: rows
      real(wp), intent(inout) :: v(rows, j + 1)
      !> Length of a piece, and its number
      integer, intent(in) :: one, piece
      !> Component along each vector
      real(wp), intent(in) :: part(:)
      !> Square sum of the remainder
      real(wp), intent(out) :: left
      ! an expression as argument would be a block of the heap in each call
      real(wp) :: minus(4)
      integer :: first, k, length

      first = one*(piece - 1) + 1
      length = min(one, n + 1 - first)
      do k = 1, j - 3, 4
         minus = -part(k:k + 3)
         call add_four(length, rows, minus, v(first, k), v(first, j + 1))
      end do
      do k = 4*(j/4) + 1, j
         call add(length, -part(k), v(first, k), v(first, j + 1))
      end do
      left = inner(length, v(first, j + 1), v(first, j + 1))
   end subroutine remove_parts

   !> out := M^-1 v, bordered
   subroutine precondition(problem, operator, system, workspace, v, out, preconditionings)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(inout) :: workspace
      real(wp), contiguous, target, intent(in) :: v(:)
      real(wp), contiguous, target, intent(inout) :: out(:)
      integer, intent(inout) :: preconditionings
      real(wp), pointer, contiguous :: field(:, :, :), u(:, :, :)
      real(wp) :: rest(2), dc(2)
      integer :: k

      field(1:problem%mx, 1:problem%my, 1:2) => v(:system%n)
      u(1:problem%mx, 1:problem%my, 1:2) => out(:system%n)
      call precondition_field(problem, operator, system, workspace, field, u)
      preconditionings = preconditionings + 1
      if (system%n_forces == 0) return
      rest = 0.0_wp
      do k = 1, system%n_forces
         rest(k) = v(system%n + k) - sum(u(:, :, k))*system%g_norm/system%g_sum
      end do
      dc = matmul(system%schur, rest)
      do k = 1, system%n_forces
         call add_long(size(u), -dc(k), workspace%border(:, :, :, k), u)
         out(system%n + k) = dc(k)
      end do
   end subroutine precondition

   !> u := (D C^-1 D / r + 1 - D) v for traction fields, in steady rolling with sums along rows after C^-1
   !>
   !> D has the weights of `weigh_inverse` here.
   !> Weights and turns of the second-order scheme have no part in it: the inverse of turns amplifies angles that alternate from
   !> element to element at the leading edge, and with it GMRES stagnates, see doc/theory/second_order.md.
   subroutine precondition_field(problem, operator, system, workspace, v, u)
      !> Determines the operator: steady rolling or a time step
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Scale of the slip
      type(linear_system), intent(in) :: system
      !> Weights and directions, from `linearise`; its workspace is overwritten
      type(newton_workspace), intent(inout) :: workspace
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: v(:, :, :)
      !> Result, same shape
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      real(wp), allocatable :: whole(:, :, :)

      call copy_long(size(v), v, workspace%trial)
      if (allocated(workspace%point)) then
         call apply_d(workspace, workspace%trial)
      else
         call project_change(size(workspace%weight), workspace%inverse_weight, workspace%direction, workspace%trial)
      end if
      if (allocated(problem%second)) then
         call copy_long(size(v), workspace%trial, workspace%trial_slip)
         call problem%second%leave_stiff(workspace%trial_slip)
         call operator%tangential_inverse(workspace%trial_slip, u)
      else
         call operator%tangential_inverse(workspace%trial, u)
      end if
      if (problem%steady) call sum_along(problem, workspace%weight, u)
      if (allocated(workspace%point)) whole = u/system%r
      call join_parts(problem%mx*problem%my, workspace%inverse_weight, workspace%direction, v, workspace%trial, system%r, u)
      if (allocated(workspace%point)) call add_radial(workspace, whole, u)
      if (allocated(problem%second)) call problem%second%keep_stiff(v, u)
   end subroutine precondition_field

   !> Tractions of steady rolling from their differences between elements in a row, summed from the leading edge
   !>
   !> The sum decays, as the differences are those of an approximate inverse; not in a single row, where the sum is exact.
   subroutine sum_along(problem, weight, u)
      !> Rolling direction and size of the window
      type(tangential_problem), intent(in) :: problem
      !> 0 outside of the contact, where each sum starts anew
      real(wp), contiguous, intent(in) :: weight(:, :)
      !> Differences on entry, tractions on exit, shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: u(:, :, :)
      real(wp) :: kept
      integer :: iy

      kept = 1.0_wp
      if (problem%my > 1) kept = 1.0_wp - min(largest_decay, decay/sqrt(real(problem%mx, wp)))
      if (size(u) <= worth_threads) then
         do iy = 1, problem%my
            call sum_row(problem%mx, problem%direction, kept, weight(:, iy), u(:, iy, 1), u(:, iy, 2))
         end do
      else
         !$omp parallel do
         do iy = 1, problem%my
            call sum_row(problem%mx, problem%direction, kept, weight(:, iy), u(:, iy, 1), u(:, iy, 2))
         end do
         !$omp end parallel do
      end if
   end subroutine sum_along

   !> Sums of both components along one row
   pure subroutine sum_row(n, direction, kept, weight, x, y)
      !> Number of elements, and the rolling direction
      integer, intent(in) :: n, direction
      !> Part of a sum that is kept from element to element, and weights of the row
      real(wp), intent(in) :: kept, weight(n)
      !> Differences on entry, tractions on exit
      real(wp), intent(inout) :: x(n), y(n)
      real(wp) :: sum_x, sum_y
      integer :: ix, k

      sum_x = 0.0_wp
      sum_y = 0.0_wp
      do k = 1, n
         ix = k
         if (direction > 0) ix = n + 1 - k
         if (weight(ix) > 0.0_wp) then
            sum_x = x(ix) + kept*sum_x
            sum_y = y(ix) + kept*sum_y
         else
            sum_x = 0.0_wp
            sum_y = 0.0_wp
         end if
         x(ix) = sum_x
         y(ix) = sum_y
      end do
   end subroutine sum_row

   !> Preconditioned border columns and the inverse of their Schur complement
   subroutine prepare_border(problem, operator, system, workspace, preconditionings)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(inout) :: system
      type(newton_workspace), intent(inout) :: workspace
      integer, intent(inout) :: preconditionings
      integer :: k, j
      real(wp) :: s(2, 2), det, creep(2)

      s = 0.0_wp
      do k = 1, system%n_forces
         workspace%best_slip = 0.0_wp
         creep = 0.0_wp
         creep(k) = system%r*system%creep_scale/system%g_norm
         call add_creepages(problem, creep, workspace%best_slip)
         if (allocated(problem%second)) call workspace%turns%apply(workspace%best_slip)
         call apply_d(workspace, workspace%best_slip)
         call precondition_field(problem, operator, system, workspace, workspace%best_slip, workspace%border(:, :, :, k))
         preconditionings = preconditionings + 1
         do j = 1, system%n_forces
            s(j, k) = -sum(workspace%border(:, :, j, k))*system%g_norm/system%g_sum
         end do
      end do
      system%schur = 0.0_wp
      if (system%n_forces == 1) then
         if (abs(s(1, 1)) > singular_one) system%schur(1, 1) = 1.0_wp/s(1, 1)
      else if (system%n_forces == 2) then
         det = s(1, 1)*s(2, 2) - s(1, 2)*s(2, 1)
         if (abs(det) > singular_two*(s(1, 1)**2 + s(2, 2)**2)) then
            system%schur = reshape([s(2, 2), -s(2, 1), -s(1, 2), s(1, 1)], [2, 2])/det
         else
            do k = 1, 2
               if (abs(s(k, k)) > 0.0_wp) system%schur(k, k) = 1.0_wp/s(k, k)
            end do
         end if
      end if
   end subroutine prepare_border
end module contact_tangential_newton_linear
