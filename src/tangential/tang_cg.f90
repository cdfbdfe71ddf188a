!> TangCG: conjugate gradients for shifts and transient rolling, with slip directions as unknowns
!>
!> Adhering elements have two unknown components, slipping ones the direction of a traction on the circle |p| = g. The energy on
!> this product of planes and circles is minimised by preconditioned conjugate gradients, interrupted after a few iterations to
!> change the state of elements; Zhao, Vollebregt and Oosterlee (2014). On the circle the second derivative along the tangent t
!> is t.A t + sigma, sigma = -S.n/g, which is included in the product and in the preconditioner. Differs in the preconditioner:
!> an approximate inverse of the 2 by 2 block of kernels rather than of its diagonal blocks, and its output is not divided once
!> more in adhesion.
module contact_tangential_tang_cg
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_tangential_problem, only : slip_of, tangential_problem
   use contact_tangential_sweep, only : trace_iteration, update_watch
   implicit none (type, external)
   private

   public :: tang_cg

   ! tuning parameters as in CONTACT (Zhao, Vollebregt and Oosterlee 2014), unless another origin is given
   !> Maximum number of iterations between two checks of the element states
   integer, parameter :: inner_limit = 4
   !> Relative change of the tractions that triggers a check
   real(wp), parameter :: inner_change = 0.01_wp
   !> Number of slip elements per adhering one above which the preconditioner is omitted, which saves transforms, see
   !> doc/theory/classical_solvers.md
   integer, parameter :: slip_dominates = 3
   !> Products v.Av and v.Az below this fraction of their numerators are treated as zero
   real(wp), parameter :: no_curvature = 1.0e-6_wp
   !> Smaller numerators mean convergence; far above underflow, chosen
   real(wp), parameter :: nothing = 1.0e-200_wp

   !> State of the iteration
   type :: conjugate_gradients
      !> Slip, residual of the unknowns, preconditioned residual, direction and its product; shape (mx, my, 2)
      real(wp), allocatable, dimension(:, :, :) :: slip, r, z, v, q
      !> Second derivative on the circles due to their curvature, shape (mx, my)
      real(wp), allocatable :: sigma(:, :)
      !> Is the preconditioner used? Does a new sequence of directions start?
      logical :: precondition = .true., restart = .true.
   contains
      procedure :: start
      procedure :: choose_preconditioner
      procedure :: set_residual
      procedure :: set_direction
      procedure :: step_length
      procedure :: move_elements
      procedure, private :: apply_preconditioner
      procedure, private :: curve_product
      procedure, private :: release
   end type conjugate_gradients

contains

   !> Iterate from given tractions; they remain admissible in all cases
   subroutine tang_cg(problem, operator, eps, creep, p, state, report, log)
      !> Rigid slip, bounds, number of iterations
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window of the problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the updates, relative to the tractions [-]
      real(wp), intent(in) :: eps
      !> Creepages [-], or shifts [mm]
      real(wp), intent(in) :: creep(2)
      !> Tractions [N/mm2], shape (mx, my, 2); on entry an admissible estimate
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      !> Element states, shape (mx, my); on entry those of the tractions
      integer, contiguous, intent(inout) :: state(:, :)
      !> Receives ended, iterations
      type(solve_report), intent(inout) :: report
      !> Receives a line per iteration from flow-trace level 5 on
      type(log_type), intent(inout) :: log
      type(update_watch) :: watch
      type(conjugate_gradients) :: self
      real(wp), allocatable, dimension(:, :, :) :: before, at_check
      real(wp) :: alpha, moved, size_p, step
      integer :: inner, ended, iterations, limit
      logical :: check

      call self%start(problem)
      allocate(before, mold=p)
      at_check = p
      limit = problem%settings%maxgs
      watch = update_watch(eps=eps, n_contact=count(problem%contact), largest_bound=maxval(problem%bound), &
         & deadline=problem%deadline)
      inner = 0
      moved = 0.0_wp
      call slip_of(problem, operator, p, creep, self%slip)
      call self%release(problem, p, state)
      self%restart = .true.
      call self%set_residual(problem, p, state)
      ended = ending%not_started
      iterations = 0
      do
         call self%choose_preconditioner(problem, state, watch%n_contact, iterations)
         call self%set_direction(problem, operator, p, state)
         call operator%tangential(self%v, self%q)
         call self%curve_product(problem, p, state)
         alpha = self%step_length()
         before = p
         call take_step(problem, state, alpha, self%v, p)
         iterations = iterations + 1
         inner = inner + 1
         step = watch%mean(sum((p - before)**2))
         moved = moved + step
         size_p = watch%mean(sum(p**2))
         check = inner >= inner_limit .or. step <= eps*size_p .or. moved > inner_change*size_p
         if (.not. check) then
            self%r = self%r - alpha*self%q
            if (iterations < limit) cycle
         end if

         call self%move_elements(problem, operator, creep, p, state)
         inner = 0
         moved = 0.0_wp
         watch%updates = iterations - 1
         call watch%check_update(sum((p - before)**2), sum(p**2), limit, ended)
         call trace_iteration(log, watch, "TangCG", state)
         if (ended == ending%diverged .and. iterations < limit) then
            p = at_check
            exit
         end if
         at_check = p
         if (ended == ending%converged .and. self%restart) ended = ending%not_started
         if (ended /= ending%not_started .or. iterations >= limit) exit
         call self%set_residual(problem, p, state)
      end do
      if (ended == ending%not_started) ended = ending%iteration_limit
      report%ended = ended
      report%iterations = iterations
   end subroutine tang_cg

   !> Allocate for a problem
   subroutine start(self, problem)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem

      associate (mx => problem%mx, my => problem%my)
         allocate(self%slip(mx, my, 2), self%r(mx, my, 2), self%z(mx, my, 2), self%sigma(mx, my))
         allocate(self%v(mx, my, 2), self%q(mx, my, 2), source=0.0_wp)
      end associate
   end subroutine start

   !> Omit the preconditioner if slip dominates, and in the second half of all iterations
   subroutine choose_preconditioner(self, problem, state, n_contact, iterations)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Element states
      integer, contiguous, intent(in) :: state(:, :)
      !> Number of elements in contact, and of iterations so far
      integer, intent(in) :: n_contact, iterations
      integer :: n_slip

      if (.not. self%precondition) return
      n_slip = count(state == element%slip)
      if ((n_slip > slip_dominates*(n_contact - n_slip) .and. problem%my > 1) &
         & .or. iterations >= problem%settings%maxgs/2) then
         self%precondition = .false.
         self%restart = .true.
      end if
   end subroutine choose_preconditioner

   !> Residual of the remaining unknowns, and sigma
   subroutine set_residual(self, problem, p, state)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      integer :: ix, iy
      real(wp) :: n(2), t(2)

      associate (r => self%r, sigma => self%sigma, slip => self%slip)
         do iy = 1, problem%my
            do ix = 1, problem%mx
               sigma(ix, iy) = 0.0_wp
               select case (state(ix, iy))
               case (element%adhesion)
                  r(ix, iy, :) = -slip(ix, iy, :)
               case (element%slip)
                  r(ix, iy, :) = 0.0_wp
                  if (problem%bound(ix, iy) <= 0.0_wp) cycle
                  n = p(ix, iy, :)/problem%bound(ix, iy)
                  t = [-n(2), n(1)]
                  r(ix, iy, :) = -dot_product(t, slip(ix, iy, :))*t
                  sigma(ix, iy) = -dot_product(n, slip(ix, iy, :))/problem%bound(ix, iy)
               case default
                  r(ix, iy, :) = 0.0_wp
               end select
            end do
         end do
      end associate
   end subroutine set_residual

   !> Compute the next direction; q is still the product of the previous one
   subroutine set_direction(self, problem, operator, p, state)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      real(wp) :: beta, vq, zq

      call self%apply_preconditioner(problem, operator, p, state)
      beta = 0.0_wp
      if (.not. self%restart) then
         zq = sum(self%z*self%q)
         vq = sum(self%v*self%q)
         if (abs(zq) > nothing .and. abs(vq) > no_curvature*abs(zq)) beta = -zq/vq
      end if
      self%v = self%z + beta*self%v
      self%restart = .false.
   end subroutine set_direction

   !> Step length along the direction
   pure real(wp) function step_length(self) result(alpha)
      class(conjugate_gradients), intent(in) :: self
      real(wp) :: rv, vq

      rv = sum(self%r*self%v)
      vq = sum(self%v*self%q)
      alpha = 0.0_wp
      if (abs(rv) > nothing) then
         alpha = 1.0_wp
         ! a direction of negative curvature is followed as far as one of positive curvature
         if (abs(vq) > no_curvature*abs(rv)) alpha = rv/abs(vq)
      end if
   end function step_length

   !> Compute z from r: approximate inverse of the compliance, reduced where the circles are curved
   subroutine apply_preconditioner(self, problem, operator, p, state)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      integer :: ix, iy, k
      real(wp) :: c

      if (self%precondition) then
         call operator%tangential_inverse(self%r, self%z)
      else
         do k = 1, 2
            self%z(:, :, k) = self%r(:, :, k)/operator%diagonal(k + 1)
         end do
      end if
      do k = 1, 2
         c = operator%diagonal(k + 1)
         do iy = 1, problem%my
            do ix = 1, problem%mx
               self%z(ix, iy, k) = self%z(ix, iy, k)*(c/(c + abs(self%sigma(ix, iy))))
            end do
         end do
      end do
      call keep_tangent_part(problem, p, state, self%z)
   end subroutine apply_preconditioner

   !> Convert q from A v to the product with the second derivative
   subroutine curve_product(self, problem, p, state)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      integer :: k

      call keep_tangent_part(problem, p, state, self%q)
      do k = 1, 2
         self%q(:, :, k) = self%q(:, :, k) + self%sigma*self%v(:, :, k)
      end do
   end subroutine curve_product

   !> Project a field to the unknowns: in slip the component along the tangent
   pure subroutine keep_tangent_part(problem, p, state, field)
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      real(wp), contiguous, intent(inout) :: field(:, :, :)
      integer :: ix, iy
      real(wp) :: t(2)

      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (state(ix, iy) == element%adhesion) cycle
            if (state(ix, iy) == element%exterior .or. problem%bound(ix, iy) <= 0.0_wp) then
               field(ix, iy, :) = 0.0_wp
            else
               t = [-p(ix, iy, 2), p(ix, iy, 1)]/problem%bound(ix, iy)
               field(ix, iy, :) = dot_product(t, field(ix, iy, :))*t
            end if
         end do
      end do
   end subroutine keep_tangent_part

   !> Tractions after a step; those of slip elements are returned to their circles
   pure subroutine take_step(problem, state, alpha, v, p)
      type(tangential_problem), intent(in) :: problem
      !> Element states
      integer, contiguous, intent(in) :: state(:, :)
      !> Step length and direction [N/mm2]
      real(wp), intent(in) :: alpha
      real(wp), contiguous, intent(in) :: v(:, :, :)
      !> Tractions [N/mm2]
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      integer :: ix, iy

      p = p + alpha*v
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (state(ix, iy) == element%slip) call rescale(problem%bound(ix, iy), p(ix, iy, :))
         end do
      end do
   end subroutine take_step

   !> Scale a traction to its bound
   pure subroutine rescale(bound, p)
      !> Traction bound [N/mm2]
      real(wp), intent(in) :: bound
      real(wp), intent(inout) :: p(:)
      real(wp) :: length

      length = hypot(p(1), p(2))
      if (length > 0.0_wp) p = p*(bound/length)
   end subroutine rescale

   !> Change adhesion to slip beyond the bound, slip to adhesion where slip and traction have the same direction; updates the
   !> slip
   subroutine move_elements(self, problem, operator, creep, p, state)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      !> Creepages [-], or shifts [mm]
      real(wp), intent(in) :: creep(2)
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      integer, contiguous, intent(inout) :: state(:, :)
      integer :: ix, iy

      self%restart = .false.
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (state(ix, iy) /= element%adhesion) cycle
            if (hypot(p(ix, iy, 1), p(ix, iy, 2)) > problem%bound(ix, iy)) then
               self%restart = .true.
               state(ix, iy) = element%slip
               call rescale(problem%bound(ix, iy), p(ix, iy, :))
            end if
         end do
      end do
      call slip_of(problem, operator, p, creep, self%slip)
      call self%release(problem, p, state)
   end subroutine move_elements

   !> Change slip to adhesion where the slip does not oppose the traction; a changed division triggers a restart
   subroutine release(self, problem, p, state)
      class(conjugate_gradients), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(inout) :: state(:, :)
      integer :: ix, iy

      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (state(ix, iy) /= element%slip) cycle
            if (dot_product(self%slip(ix, iy, :), p(ix, iy, :)) <= 0.0_wp) cycle
            state(ix, iy) = element%adhesion
            self%restart = .true.
         end do
      end do
   end subroutine release
end module contact_tangential_tang_cg
