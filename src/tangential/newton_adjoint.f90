!> Derivatives of the tangential forces with respect to slip and bound of each element: the adjoint of Newton's linear system
!>
!> Tractions satisfy J dp = -r D dS + n dg (see `newton_derivative`). A force c'p changes by l'(-r D dS + n dg) with J'l = c:
!> one system per force, regardless of the number of inputs. The transposed convolution B' is B for fields rotated by 180
!> degrees; with the same rotation of D,
!>
!>    l = c + (1 - r B) e,   (1 - D (1 - r B)) e = D c,   D l = e,
!>
!> so that the preconditioner is that of the method itself. With turned slip (`contact_tangential_slip_turns`) B T' replaces B,
!> where T is the derivative of the acting slip, also for the rotated contact. Search directions of one force are reused for the
!> next ones.
module contact_tangential_newton_adjoint
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_tangential_newton_jacobian, only : apply_d, fit_workspace, linear_system, linearise, new_system, newton_workspace, &
      & restart
   use contact_tangential_newton_linear, only : precondition_field
   use contact_tangential_problem, only : apply_operator, slip_of, tangential_problem, tangential_solution
   implicit none (type, external)
   private

   public :: newton_adjoint

   !> Maximum number of products per force
   integer, parameter :: most_products = 120

   !> Search directions and their images, J Z = Q R with orthonormal Q, all in the range of D
   type :: search_space
      !> Number of unknowns, and number of directions in use
      integer :: n = 0, used = 0
      !> Column, row and component of each unknown, shape (3, n), and its direction, shape (2, n)
      integer, allocatable :: place(:, :)
      real(wp), allocatable :: along(:, :)
      !> Z and Q, shape (n, restart)
      real(wp), allocatable :: z(:, :), q(:, :)
      !> Remainder of the right-hand side, and the solution
      real(wp), allocatable :: left(:), x(:)
      !> Triangular factor R
      real(wp) :: r(restart, restart) = 0.0_wp
   end type search_space

contains

   !> Derivatives of weighted sums of tractions with respect to the rigid slip and the bound of each element, at a solution
   !>
   !> Not for prescribed forces and yield limits with a slope, which have other systems.
   subroutine newton_adjoint(problem, operator, tolerance, workspace, solution, weight, by_slip, by_bound, reached)
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
      !> Largest relative residual
      real(wp), intent(out) :: reached
      type(linear_system) :: system
      type(search_space) :: space
      type(tangential_solution) :: at
      type(tangential_problem) :: turned
      real(wp), allocatable :: direction(:, :, :)
      real(wp) :: left
      integer :: j, mx, my

      by_slip = 0.0_wp
      by_bound = 0.0_wp
      reached = 0.0_wp
      if (.not. any(problem%bound > 0.0_wp)) return
      mx = problem%mx
      my = problem%my
      call fit_workspace(workspace, mx, my)
      system = new_system(problem, operator)
      at = solution
      call slip_of(problem, operator, at%p, at%creep, at%slip)
      call linearise(problem, system, at, workspace)
      direction = workspace%direction
      workspace%weight = workspace%weight(mx:1:-1, my:1:-1)
      workspace%direction = workspace%direction(mx:1:-1, my:1:-1, :)
      turned = problem
      if (allocated(turned%second)) then
         call turned%second%turn_round(mx, my)
         call workspace%turns%turn_round()
      end if
      call number_unknowns(workspace, space)
      do j = 1, size(weight, 4)
         workspace%residual = weight(mx:1:-1, my:1:-1, :, j)
         call apply_d(workspace, workspace%residual)
         call solve(turned, operator, system, workspace, space, tolerance, left)
         reached = max(reached, left)
         ! l = c + e - r B e, rotated back
         call weighted_responses(turned, operator, system, workspace, workspace%step)
         by_slip(:, :, :, j) = -system%r*workspace%trial_slip(mx:1:-1, my:1:-1, :)
         by_bound(:, :, j) = sum((weight(:, :, :, j) + workspace%trial(mx:1:-1, my:1:-1, :))*direction, dim=3)
      end do
   end subroutine newton_adjoint

   !> trial_slip := T' e, trial := e - r B T' e
   subroutine weighted_responses(problem, operator, system, workspace, e)
      !> Rotated by 180 degrees
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      type(newton_workspace), intent(inout) :: workspace
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: e(:, :, :)

      workspace%trial_slip = e
      if (allocated(problem%second)) call workspace%turns%apply_transposed(workspace%trial_slip)
      call apply_operator(problem, operator, workspace%trial_slip, workspace%trial)
      workspace%trial = e - system%r*workspace%trial
   end subroutine weighted_responses

   !> Number the unknowns of the systems: both components in adhesion, the component perpendicular to the traction in slip
   subroutine number_unknowns(workspace, space)
      !> Weights and directions
      type(newton_workspace), intent(in) :: workspace
      type(search_space), intent(inout) :: space
      integer :: ix, iy, mx, my, n

      mx = size(workspace%weight, 1)
      my = size(workspace%weight, 2)
      allocate(space%place(3, 2*mx*my), space%along(2, 2*mx*my))
      n = 0
      do iy = 1, my
         do ix = 1, mx
            if (.not. workspace%weight(ix, iy) > 0.0_wp) cycle
            associate (direction => workspace%direction(ix, iy, :))
               if (all(abs(direction) <= 0.0_wp)) then
                  space%place(:, n + 1) = [ix, iy, 1]
                  space%place(:, n + 2) = [ix, iy, 2]
                  space%along(:, n + 1) = [1.0_wp, 0.0_wp]
                  space%along(:, n + 2) = [0.0_wp, 1.0_wp]
                  n = n + 2
               else
                  n = n + 1
                  space%place(:, n) = [ix, iy, 1]
                  space%along(:, n) = [-direction(2), direction(1)]
               end if
            end associate
         end do
      end do
      space%n = n
      allocate(space%q(n, restart), space%z(n, restart), space%left(n), space%x(n))
   end subroutine number_unknowns

   !> Extract the unknowns from a field
   pure subroutine gather(space, field, v)
      type(search_space), intent(in) :: space
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: field(:, :, :)
      real(wp), contiguous, intent(inout) :: v(:)
      integer :: k

      do k = 1, space%n
         associate (ix => space%place(1, k), iy => space%place(2, k))
            v(k) = space%along(1, k)*field(ix, iy, 1) + space%along(2, k)*field(ix, iy, 2)
         end associate
      end do
   end subroutine gather

   !> Set a field from its unknowns
   pure subroutine spread_out(space, v, field)
      type(search_space), intent(in) :: space
      real(wp), contiguous, intent(in) :: v(:)
      !> Shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: field(:, :, :)
      integer :: k

      field = 0.0_wp
      do k = 1, space%n
         associate (ix => space%place(1, k), iy => space%place(2, k))
            field(ix, iy, :) = field(ix, iy, :) + v(k)*space%along(:, k)
         end associate
      end do
   end subroutine spread_out

   !> Remove the components along orthonormal vectors from a vector, four at a time
   pure subroutine project(q, k, v, share)
      !> The first k columns are used
      real(wp), contiguous, intent(in) :: q(:, :)
      integer, intent(in) :: k
      real(wp), contiguous, intent(inout) :: v(:)
      !> Components along the columns
      real(wp), contiguous, intent(inout) :: share(:)
      real(wp) :: h(4)
      integer :: i, j

      do j = 1, k - 3, 4
         h = 0.0_wp
         do i = 1, size(v)
            h(1) = h(1) + q(i, j)*v(i)
            h(2) = h(2) + q(i, j + 1)*v(i)
            h(3) = h(3) + q(i, j + 2)*v(i)
            h(4) = h(4) + q(i, j + 3)*v(i)
         end do
         do i = 1, size(v)
            v(i) = v(i) - (h(1)*q(i, j) + h(2)*q(i, j + 1) + h(3)*q(i, j + 2) + h(4)*q(i, j + 3))
         end do
         share(j:j + 3) = h
      end do
      do j = 4*(k/4) + 1, k
         share(j) = dot_product(q(:, j), v)
         v = v - share(j)*q(:, j)
      end do
   end subroutine project

   !> Solve J step = residual by minimal residuals, reusing the directions of earlier systems
   subroutine solve(problem, operator, system, workspace, space, tolerance, reached)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      type(linear_system), intent(in) :: system
      !> Right-hand side in `residual`, which is overwritten; solution in `step`
      type(newton_workspace), intent(inout) :: workspace
      type(search_space), intent(inout) :: space
      real(wp), intent(in) :: tolerance
      real(wp), intent(out) :: reached
      real(wp) :: share(restart), start, now, h
      integer :: k, product

      associate (q => space%q, z => space%z, left => space%left)
         space%x = 0.0_wp
         share = 0.0_wp
         call gather(space, workspace%residual, left)
         start = norm2(left)
         reached = 0.0_wp
         if (start > 0.0_wp) then
            call project(q, space%used, left, share)
            now = norm2(left)
            do product = 1, most_products
               if (.not. now > tolerance*start) exit
               if (space%used == restart) then
                  call add_up()
                  space%used = 0
               end if
               k = space%used + 1
               call spread_out(space, left, workspace%residual)
               call precondition_field(problem, operator, system, workspace, workspace%residual, workspace%step)
               call gather(space, workspace%step, z(:, k))
               call weighted_responses(problem, operator, system, workspace, workspace%step)
               call apply_d(workspace, workspace%trial)
               workspace%step = workspace%step - workspace%trial
               call gather(space, workspace%step, q(:, k))
               space%r(:k, k) = 0.0_wp
               call project(q, k - 1, q(:, k), space%r(:, k))
               h = norm2(q(:, k))
               if (.not. h > 0.0_wp) exit
               space%r(k, k) = h
               q(:, k) = q(:, k)/h
               space%used = k
               share(k) = dot_product(q(:, k), left)
               left = left - share(k)*q(:, k)
               now = norm2(left)
            end do
            call add_up()
            reached = now/start
         end if
         call spread_out(space, space%x, workspace%step)
      end associate

   contains

      !> x := x + Z R^-1 share
      subroutine add_up()
         real(wp) :: y(restart)
         integer :: i

         do i = space%used, 1, -1
            y(i) = (share(i) - dot_product(space%r(i, i + 1:space%used), y(i + 1:space%used)))/space%r(i, i)
            space%x = space%x + y(i)*space%z(:, i)
         end do
      end subroutine add_up
   end subroutine solve
end module contact_tangential_newton_adjoint
