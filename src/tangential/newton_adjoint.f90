!> Derivatives of the tangential forces with respect to slip and bound of each element: the adjoint of Newton's linear system
!>
!> Tractions satisfy J dp = -r D dS + n dg (see `newton_derivative`). A force c'p changes by l'(-r D dS + n dg) with J'l = c:
!> one system per force, regardless of the number of inputs. The transposed convolution B' is B for fields rotated by 180
!> degrees; with the same rotation of D,
!>
!>    l = c + (1 - r B) e,   (1 - D (1 - r B)) e = D c,   D l = e,
!>
!> so that the preconditioner is that of the method itself. With slip that is turned (`contact_tangential_slip_turns`) B T' takes
!> the place of B, T the derivative of the acting slip, of the turned contact as well. Search directions of one force serve
!> the next ones. The part of (1 - r B) e along the tractions, which D takes away and l needs, is kept with each direction.
module contact_tangential_newton_adjoint
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_numeric_vectors, only : add, add_four, inner, inner_four
   use contact_tangential_newton_jacobian, only : apply_d, fit_workspace, linear_system, linearise, new_system, newton_workspace, &
      & restart, weigh_inverse
   use contact_tangential_newton_linear, only : precondition_field
   use contact_tangential_problem, only : apply_operator, slip_of, tangential_problem, tangential_solution
   use contact_tangential_slip_loops, only : jacobian_of_projection
   implicit none (type, external)
   private

   public :: newton_adjoint

   !> Maximum number of products per force
   integer, parameter :: most_products = 120

   !> Unknowns and search directions Z, which are columns of workspace%preconditioned, in the range of D; their images
   !> J Z = Q R, Q orthonormal, are columns of workspace%basis
   type :: search_space
      !> Unknowns, elements in slip, and directions in use
      integer :: n = 0, slips = 0, used = 0
      !> Element of each unknown, and of each element in slip, columns first
      integer, allocatable :: at(:), slip_at(:)
      !> Direction of each unknown and of the tractions of each element in slip, shape (2, :)
      real(wp), allocatable :: along(:, :), traction(:, :)
      !> The triangle R
      real(wp) :: r(restart, restart) = 0.0_wp
   end type search_space

contains

   !> Derivatives of weighted sums of tractions with respect to the rigid slip and the bound of each element, at a solution
   !>
   !> Not for prescribed forces and yield limits with a slope, which have other systems.
   subroutine newton_adjoint(problem, operator, tolerance, workspace, solution, weight, by_slip, by_bound, by_angle, &
      & reached)
      !> Problem that was solved, with given creepages
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem; the same for all elements, without memory
      class(compliance), intent(inout) :: operator
      !> Tolerance of the linear systems, relative to their right-hand sides [-]
      real(wp), intent(in) :: tolerance
      !> Workspace of the size of the window, allocated here
      type(newton_workspace), intent(inout) :: workspace
      !> Solution at which the derivatives are taken
      type(tangential_solution), intent(in) :: solution
      !> Weights c of the sums, shape (mx, my, 2, sums)
      real(wp), contiguous, intent(in) :: weight(:, :, :, :)
      !> Derivatives of the sums with respect to the slip per step, unit of the weights times (N/mm2)/mm, shape (mx, my, 2,
      !> sums)
      real(wp), contiguous, intent(inout) :: by_slip(:, :, :, :)
      !> Derivatives with respect to the traction bound, unit of the weights, shape (mx, my, sums)
      real(wp), contiguous, intent(inout) :: by_bound(:, :, :)
      !> Derivatives with respect to the angle by which the slip of an element is turned, unit of the weights times N/mm2, shape
      !> (mx, my, sums)
      real(wp), contiguous, intent(inout) :: by_angle(:, :, :)
      !> Largest relative residual
      real(wp), intent(out) :: reached
      type(linear_system) :: system
      type(search_space) :: space
      type(tangential_solution) :: at
      type(tangential_problem) :: turned
      real(wp) :: left
      integer :: j, k, mx, my

      by_slip = 0.0_wp
      by_bound = 0.0_wp
      by_angle = 0.0_wp
      reached = 0.0_wp
      if (.not. any(problem%bound > 0.0_wp)) return
      mx = problem%mx
      my = problem%my
      call fit_workspace(workspace, mx, my)
      system = new_system(problem, operator)
      at = solution
      call slip_of(problem, operator, at%p, at%creep, at%slip)
      call linearise(problem, system, at, workspace)
      workspace%weight = workspace%weight(mx:1:-1, my:1:-1)
      call weigh_inverse(problem, workspace)
      workspace%direction = workspace%direction(mx:1:-1, my:1:-1, :)
      turned = problem
      if (allocated(turned%second)) then
         call turned%second%turn_round(mx, my)
         call workspace%turns%turn_round()
      end if
      call number_unknowns(mx*my, workspace%weight, workspace%direction, space)
      do j = 1, size(weight, 4)
         workspace%best_slip = weight(mx:1:-1, my:1:-1, :, j)
         workspace%residual = workspace%best_slip
         call apply_d(workspace, workspace%residual)
         call solve(turned, operator, system, workspace, space, tolerance, left)
         reached = max(reached, left)
         ! l = c + e - r B e, turned back; e has no part along tractions of elements in slip
         call add_along_tractions(space, mx*my, workspace%x, workspace%best_slip, workspace%residual)
         by_bound(:, :, j) = workspace%residual(mx:1:-1, my:1:-1, 1)
         if (allocated(turned%second)) then
            call workspace%turns%apply_transposed(workspace%step)
            do k = 1, workspace%turns%n
               associate (i => workspace%turns%at(2, k) - 1)
                  by_angle(mx - mod(i, mx), my - i/mx, j) = -system%r*workspace%turns%angle(k)
               end associate
            end do
         end if
         by_slip(:, :, :, j) = -system%r*workspace%step(mx:1:-1, my:1:-1, :)
      end do
   end subroutine newton_adjoint

   !> The unknowns of the systems: both components in adhesion, that across the traction in slip
   subroutine number_unknowns(elements, weight, direction, space)
      !> Elements of the window
      integer, intent(in) :: elements
      !> D: weights and directions
      real(wp), intent(in) :: weight(elements), direction(elements, 2)
      type(search_space), intent(inout) :: space
      integer :: k, n

      allocate(space%at(2*elements), space%along(2, 2*elements), space%slip_at(elements), space%traction(2, elements))
      n = 0
      do k = 1, elements
         if (.not. weight(k) > 0.0_wp) cycle
         if (all(abs(direction(k, :)) <= 0.0_wp)) then
            space%at(n + 1:n + 2) = k
            space%along(:, n + 1) = [1.0_wp, 0.0_wp]
            space%along(:, n + 2) = [0.0_wp, 1.0_wp]
            n = n + 2
         else
            n = n + 1
            space%at(n) = k
            space%along(:, n) = [-direction(k, 2), direction(k, 1)]
            space%slips = space%slips + 1
            space%slip_at(space%slips) = k
            space%traction(:, space%slips) = direction(k, :)
         end if
      end do
      space%n = n
   end subroutine number_unknowns

   !> Components of a field along directions of some elements
   pure subroutine gather(n, at, along, elements, field, v)
      !> Number of components
      integer, intent(in) :: n
      !> Elements, and directions in them
      integer, intent(in) :: at(:)
      real(wp), contiguous, intent(in) :: along(:, :)
      !> Elements of the window
      integer, intent(in) :: elements
      real(wp), intent(in) :: field(elements, 2)
      !> The components
      real(wp), contiguous, intent(inout) :: v(:)
      integer :: k

      do k = 1, n
         v(k) = along(1, k)*field(at(k), 1) + along(2, k)*field(at(k), 2)
      end do
   end subroutine gather

   !> A field from its unknowns
   pure subroutine spread_out(space, v, elements, field)
      type(search_space), intent(in) :: space
      real(wp), contiguous, intent(in) :: v(:)
      !> Elements of the window
      integer, intent(in) :: elements
      real(wp), intent(inout) :: field(elements, 2)
      integer :: k

      field = 0.0_wp
      do k = 1, space%n
         associate (at => space%at(k))
            field(at, 1) = field(at, 1) + v(k)*space%along(1, k)
            field(at, 2) = field(at, 2) + v(k)*space%along(2, k)
         end associate
      end do
   end subroutine spread_out

   !> (c - r B e) n in elements in slip, n the direction of the tractions
   pure subroutine add_along_tractions(space, elements, x, weight, along)
      type(search_space), intent(in) :: space
      !> Elements of the window
      integer, intent(in) :: elements
      !> Unknowns, followed by the components of -r B e along tractions
      real(wp), contiguous, intent(in) :: x(:)
      !> c
      real(wp), intent(in) :: weight(elements, 2)
      !> The result in its first component, 0 in other elements
      real(wp), intent(inout) :: along(elements, 2)
      integer :: k

      along(:, 1) = 0.0_wp
      do k = 1, space%slips
         associate (at => space%slip_at(k), n => space%traction(:, k))
            along(at, 1) = x(space%n + k) + (n(1)*weight(at, 1) + n(2)*weight(at, 2))
         end associate
      end do
   end subroutine add_along_tractions

   !> Take the parts along orthonormal vectors off a vector, four at a time
   subroutine project(n, q, k, v, share)
      !> Length of the vectors, and their number
      integer, intent(in) :: n, k
      real(wp), contiguous, intent(in) :: q(:, :)
      real(wp), contiguous, intent(inout) :: v(:)
      !> Components along the columns
      real(wp), contiguous, intent(inout) :: share(:)
      ! an expression as argument would be a block of the heap in each call
      real(wp) :: minus(4)
      integer :: j

      do j = 1, k - 3, 4
         call inner_four(n, size(q, 1), q(:, j:j + 3), v, share(j:j + 3))
         minus = -share(j:j + 3)
         call add_four(n, size(q, 1), minus, q(:, j:j + 3), v)
      end do
      do j = 4*(k/4) + 1, k
         share(j) = inner(n, q(:, j), v)
         call add(n, -share(j), q(:, j), v)
      end do
   end subroutine project

   !> Solve J step = residual by minimal residuals, reusing the directions of earlier systems
   subroutine solve(problem, operator, system, workspace, space, tolerance, reached)
      !> Turned by half a turn
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      !> The right-hand side in `residual`, which is overwritten, the solution in `step`; in `x` the unknowns, and behind them
      !> what -r B step is along the tractions of the elements in slip
      type(newton_workspace), intent(inout) :: workspace
      type(search_space), intent(inout) :: space
      real(wp), intent(in) :: tolerance
      real(wp), intent(out) :: reached
      real(wp) :: share(restart), start, now, h
      integer :: k, n, elements, product

      n = space%n
      elements = problem%mx*problem%my
      associate (q => workspace%basis, z => workspace%preconditioned, left => workspace%b, x => workspace%x)
         x = 0.0_wp
         share = 0.0_wp
         call gather(n, space%at, space%along, elements, workspace%residual, left)
         start = sqrt(inner(n, left, left))
         reached = 0.0_wp
         if (start > 0.0_wp) then
            call project(n, q, space%used, left, share)
            now = sqrt(inner(n, left, left))
            do product = 1, most_products
               if (.not. now > tolerance*start) exit
               if (space%used == restart) then
                  call add_up()
                  space%used = 0
               end if
               k = space%used + 1
               call spread_out(space, left, elements, workspace%residual)
               call precondition_field(problem, operator, system, workspace, workspace%residual, workspace%step)
               call gather(n, space%at, space%along, elements, workspace%step, z(:, k))
               workspace%trial_slip = workspace%step
               if (allocated(problem%second)) call workspace%turns%apply_transposed(workspace%trial_slip)
               call apply_operator(problem, operator, workspace%trial_slip, workspace%trial)
               call jacobian_of_projection(elements, workspace%weight, workspace%direction, workspace%step, workspace%trial, &
                  & system%r, [0.0_wp, 0.0_wp], workspace%residual)
               call gather(n, space%at, space%along, elements, workspace%residual, q(:, k))
               call gather(space%slips, space%slip_at, space%traction, elements, workspace%trial, z(n + 1:, k))
               z(n + 1:n + space%slips, k) = -system%r*z(n + 1:n + space%slips, k)
               space%r(:k, k) = 0.0_wp
               call project(n, q, k - 1, q(:, k), space%r(:, k))
               h = sqrt(inner(n, q(:, k), q(:, k)))
               if (.not. h > 0.0_wp) exit
               space%r(k, k) = h
               q(:n, k) = q(:n, k)/h
               space%used = k
               share(k) = inner(n, q(:, k), left)
               call add(n, -share(k), q(:, k), left)
               now = sqrt(inner(n, left, left))
            end do
            call add_up()
            reached = now/start
         end if
         call spread_out(space, x, elements, workspace%step)
      end associate

   contains

      !> x := x + Z R^-1 share
      subroutine add_up()
         real(wp) :: y(restart)
         integer :: i

         do i = space%used, 1, -1
            y(i) = (share(i) - dot_product(space%r(i, i + 1:space%used), y(i + 1:space%used)))/space%r(i, i)
            call add(n + space%slips, y(i), workspace%preconditioned(:, i), workspace%x)
         end do
      end subroutine add_up
   end subroutine solve
end module contact_tangential_newton_adjoint
