!> GDsteady: descent along weighted residuals in steady rolling, all products by transforms
!>
!> The residual of the remaining unknowns (slip in adhesion, its tangential component in slip) is used as a change of the
!> increments p(i) - p(i + 1), as the operator is symmetric positive definite for increments. Row by row from the leading edge,
!> increments are converted to tractions that keep slip elements on their circles; a line search on the weighted residual
!> follows. An experimental method of CONTACT (Vollebregt). Simplified: the weight of slip elements, the fraction of the angle
!> between p and -S that one element removes by rotating S, is used in its limit for small angles, C_tt/(C_tt + sigma).
module contact_tangential_gd_steady
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_numeric_minimum_search, only : minimum_search
   use contact_tangential_problem, only : at_bound, contact_residual, residual_scale, slip_of, tangential_problem
   use contact_tangential_sweep, only : trace_iteration, update_watch
   implicit none (type, external)
   private

   public :: gd_steady

   type :: projection_list
      !> The whole change is carried downstream
      integer :: trail = 1
      !> A fraction of the change is carried downstream
      integer :: keep = 2
      !> The change is reversed after some elements
      integer :: down = 3
   end type projection_list
   !> Conversion of increments of adhering elements to tractions
   type(projection_list), parameter :: projection = projection_list()

   ! tuning parameters as in CONTACT (Vollebregt), unless another origin is given
   !> FDECAY above which the whole change is carried downstream, and below which none
   real(wp), parameter :: all_carried = 0.999_wp, none_carried = 0.001_wp
   !> Number of iterations with the other projection after one with poor progress
   integer, parameter :: iterations_down = 2
   !> Maximum ratio of a weight to the one downstream
   real(wp), parameter :: weight_growth = 50.0_wp
   !> Maximum change of tractions in slip, relative to the bound
   real(wp), parameter :: largest_turn = 1000.0_wp
   !> First step of the line search relative to the estimated one, and its relative tolerance
   real(wp), parameter :: first_share = 0.6_wp, line_tolerance = 1.0e-3_wp
   !> Limits of the estimated step; chosen
   real(wp), parameter :: smallest_step = 1.0e-3_wp, largest_step = 1.0e3_wp
   !> Estimated step if the residual and its change are orthogonal; chosen
   real(wp), parameter :: blind_step = 0.5_wp
   !> If the residual decreases by less than `slow` per iteration, updates are regarded as larger by slow over the progress, and
   !> by `stuck_factor` below `stuck`
   real(wp), parameter :: slow = 0.1_wp, stuck = 1.0e-3_wp, stuck_factor = 100.0_wp
   !> Factor of the tolerance of the updates after they became small while the residual did not; chosen
   real(wp), parameter :: sharper = 0.3_wp
   !> Number of iterations without a residual below this fraction of the smallest one that is regarded as stagnation; chosen
   real(wp), parameter :: is_smaller = 0.999_wp
   integer, parameter :: patience = 30

   !> State of the descent
   type :: descent
      !> Slip, residual, direction and the slip that it changes, before the step [mm or N/mm2], shape (mx, my, 2)
      real(wp), allocatable, dimension(:, :, :) :: slip, r, v, q
      !> Weights of the residual, shape (mx, my)
      real(wp), allocatable :: weight(:, :)
      !> Compliance of an element on itself minus that carried one element downstream [mm/(N/mm2)]
      real(wp) :: own(2) = 1.0_wp
      !> Member of projection; fraction carried downstream, number of elements after which it is reversed
      integer :: mode = 0, span = 1
      real(wp) :: fraction = 1.0_wp
      !> Number of remaining iterations with the other projection
      integer :: iterations_left = 0
      !> Relative decrease of the residual in the last iteration
      real(wp) :: progress = 1.0_wp
      !> Step of the previous iteration
      real(wp) :: last_step = 0.0_wp
   contains
      procedure :: start
      procedure :: set_weights
      procedure :: set_residual
      !> Weighted square sum of the residual
      procedure :: square
      procedure :: choose_projection
      procedure :: set_direction
      procedure :: find_step
      procedure, private :: estimated_step
      procedure :: take_step
      procedure :: move_elements
   end type descent

contains

   !> Iterate from given tractions; they remain admissible in all cases
   subroutine gd_steady(problem, operator, eps, creep, p, state, report, log)
      !> Rigid slip, bounds, number of iterations
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the updates, relative to the tractions [-]; at the end the contact conditions hold within the tolerance of
      !> the settings
      real(wp), intent(in) :: eps
      !> Creepages [-]
      real(wp), intent(in) :: creep(2)
      !> Tractions [N/mm2], shape (mx, my, 2); on entry an admissible estimate
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      !> Element states, shape (mx, my); on entry those of the tractions
      integer, contiguous, intent(inout) :: state(:, :)
      !> Receives ended, iterations; "stagnated" requests another method
      type(solve_report), intent(inout) :: report
      !> Receives a line per iteration from flow-trace level 5 on
      type(log_type), intent(inout) :: log
      type(update_watch) :: watch
      type(descent) :: self
      real(wp), allocatable, dimension(:, :, :) :: before, best
      real(wp) :: old_square, least, scale
      integer :: iteration, since_best
      logical :: moved

      call self%start(problem, operator)
      allocate(before, mold=p)
      best = p
      watch = update_watch(eps=eps, n_contact=count(problem%contact), largest_bound=maxval(problem%bound), &
         & deadline=problem%deadline)
      scale = residual_scale(problem, operator)
      call slip_of(problem, operator, p, creep, self%slip)
      least = huge(1.0_wp)
      since_best = 0
      report%ended = ending%not_started
      do iteration = 1, problem%settings%maxgs
         report%iterations = iteration
         call self%set_weights(problem, p, state)
         call self%set_residual(problem, p, state)
         old_square = self%square()
         if (old_square < is_smaller*least) then
            least = old_square
            since_best = 0
            best = p
         else
            since_best = since_best + 1
            if (since_best > patience) then
               report%ended = ending%stagnated
               exit
            end if
         end if
         if (.not. old_square > 0.0_wp) then
            report%ended = ending%converged
            exit
         end if
         call self%choose_projection(problem)
         call self%set_direction(problem, p, state)
         call operator%steady(self%v, self%q)
         call self%find_step(p, state)
         before = p
         call self%take_step(problem, state, p)
         call slip_of(problem, operator, p, creep, self%slip)
         call self%move_elements(problem, p, state, moved)
         call self%set_residual(problem, p, state)
         self%progress = max(0.0_wp, 1.0_wp - sqrt(self%square()/old_square))
         call watch%check_update(sum(((p - before)*doubt(self%progress))**2), sum(p**2), problem%settings%maxgs, report%ended)
         call trace_iteration(log, watch, "GDsteady", state)
         if (report%ended == ending%converged .and. moved) report%ended = ending%not_started
         ! small updates do not imply a small residual; whether forces are met is checked by the caller
         if (report%ended == ending%converged) then
            if (contact_residual(problem, p, self%slip, scale) > problem%settings%eps) then
               report%ended = ending%not_started
               watch%eps = sharper*watch%eps
            end if
         end if
         if (report%ended /= ending%not_started) exit
      end do
      if (report%ended /= ending%converged) then
         p = best
         if (report%ended /= ending%iteration_limit) report%ended = ending%stagnated
      end if
   end subroutine gd_steady

   !> Factor of updates that are small because the method makes little progress
   pure real(wp) function doubt(progress)
      !> Relative decrease of the residual [-]
      real(wp), intent(in) :: progress

      doubt = 1.0_wp
      if (progress < slow) doubt = slow/max(stuck, progress)
      if (progress < stuck) doubt = stuck_factor
   end function doubt

   !> Allocate for a problem
   subroutine start(self, problem, operator)
      class(descent), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(in) :: operator

      associate (mx => problem%mx, my => problem%my)
         allocate(self%slip(mx, my, 2), self%r(mx, my, 2), self%v(mx, my, 2), self%q(mx, my, 2), self%weight(mx, my))
      end associate
      self%own = operator%diagonal(2:3) - [operator%table%xx(1, 0), operator%table%yy(1, 0)]
   end subroutine start

   !> Weights of the residual per element
   subroutine set_weights(self, problem, p, state)
      class(descent), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      integer :: ix, iy, i0, i1, length
      real(wp) :: n(2), sigma, ctt, previous

      call downstream_range(problem, i0, i1)
      associate (weight => self%weight, given => problem%settings)
         do iy = 1, problem%my
            length = 0
            previous = given%d_ifc
            do ix = i0, i1, problem%direction
               select case (state(ix, iy))
               case (element%adhesion)
                  length = length + 1
                  weight(ix, iy) = given%d_ifc + (length - 1)*given%d_lin
                  if (given%d_lin > 0.0_wp) weight(ix, iy) = min(weight(ix, iy), given%d_cns)
                  if (given%d_lin < 0.0_wp) weight(ix, iy) = max(weight(ix, iy), given%d_cns)
                  weight(ix, iy) = min(weight(ix, iy), weight_growth*previous)
                  previous = weight(ix, iy)
               case (element%slip)
                  length = 0
                  previous = given%d_ifc
                  weight(ix, iy) = 0.0_wp
                  if (problem%bound(ix, iy) <= 0.0_wp) cycle
                  n = p(ix, iy, :)/problem%bound(ix, iy)
                  sigma = max(0.0_wp, -dot_product(n, self%slip(ix, iy, :))/problem%bound(ix, iy))
                  ctt = self%own(1)*n(2)**2 + self%own(2)*n(1)**2
                  weight(ix, iy) = given%d_slp*(ctt/(ctt + sigma))**given%pow_s
               case default
                  length = 0
                  previous = given%d_ifc
                  weight(ix, iy) = 0.0_wp
               end select
            end do
         end do
      end associate
   end subroutine set_weights

   !> First and last column from the trailing to the leading side
   pure subroutine downstream_range(problem, i0, i1)
      type(tangential_problem), intent(in) :: problem
      integer, intent(out) :: i0, i1
      i0 = merge(1, problem%mx, problem%direction > 0)
      i1 = problem%mx + 1 - i0
   end subroutine downstream_range

   !> Residual: minus the slip in adhesion, minus its tangential component in slip
   subroutine set_residual(self, problem, p, state)
      class(descent), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      real(wp) :: t(2)
      integer :: ix, iy

      associate (r => self%r, s => self%slip)
         do iy = 1, problem%my
            do ix = 1, problem%mx
               r(ix, iy, :) = 0.0_wp
               if (state(ix, iy) == element%adhesion) then
                  r(ix, iy, :) = -s(ix, iy, :)
               else if (state(ix, iy) == element%slip .and. problem%bound(ix, iy) > 0.0_wp) then
                  t = [-p(ix, iy, 2), p(ix, iy, 1)]/problem%bound(ix, iy)
                  ! where slip and traction have the same direction the element is about to adhere
                  if (dot_product(p(ix, iy, :), s(ix, iy, :)) > 0.0_wp) then
                     r(ix, iy, :) = -s(ix, iy, :)
                  else
                     r(ix, iy, :) = -dot_product(t, s(ix, iy, :))*t
                  end if
               end if
            end do
         end do
      end associate
   end subroutine set_residual

   !> Weighted square sum of the residual
   pure real(wp) function square(self)
      class(descent), intent(in) :: self
      integer :: k

      square = 0.0_wp
      do k = 1, 2
         square = square + sum((self%r(:, :, k)*self%weight)**2)
      end do
   end function square

   !> Select the projection of the settings, or for two iterations another one after poor progress
   subroutine choose_projection(self, problem)
      class(descent), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem

      associate (given => problem%settings)
         self%fraction = given%fdecay
         self%span = 1
         self%mode = projection%keep
         if (given%fdecay > all_carried) self%mode = projection%trail
         if (given%fdecay < none_carried) then
            self%mode = projection%down
            self%span = max(1, nint(-given%fdecay))
         end if
         if (self%progress <= given%betath .and. self%iterations_left == 0) self%iterations_left = iterations_down
         if (self%iterations_left > 0) then
            self%iterations_left = self%iterations_left - 1
            self%mode = projection%down
            self%span = max(1, given%kdowfb)
         end if
      end associate
   end subroutine choose_projection

   !> Convert the residual, as changes of increments, to changes of traction
   subroutine set_direction(self, problem, p, state)
      class(descent), intent(inout) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      integer :: ix, iy, i0, i1, ahead, source
      real(wp) :: delta(2), upstream(2), t(2), size_v

      call downstream_range(problem, i0, i1)
      associate (v => self%v, r => self%r, weight => self%weight, bound => problem%bound)
         do iy = 1, problem%my
            upstream = 0.0_wp
            do ix = i1, i0, -problem%direction
               if (state(ix, iy) == element%exterior .or. &
                  & (state(ix, iy) == element%slip .and. bound(ix, iy) <= 0.0_wp)) then
                  v(ix, iy, :) = 0.0_wp
                  upstream = 0.0_wp
                  cycle
               end if
               delta = weight(ix, iy)*r(ix, iy, :)/self%own
               if (state(ix, iy) == element%slip) then
                  t = [-p(ix, iy, 2), p(ix, iy, 1)]/bound(ix, iy)
                  delta = dot_product(t, delta)*t
                  size_v = norm2(delta)
                  if (size_v > largest_turn*bound(ix, iy)) delta = delta*(largest_turn*bound(ix, iy)/size_v)
                  v(ix, iy, :) = delta
               else
                  select case (self%mode)
                  case (projection%trail)
                     v(ix, iy, :) = upstream + delta
                  case (projection%keep)
                     v(ix, iy, :) = self%fraction*upstream + delta
                  case default
                     ahead = ix + self%span*problem%direction
                     source = 0
                     if (ahead >= 1 .and. ahead <= problem%mx) source = state(ahead, iy)
                     v(ix, iy, :) = upstream + delta
                     if (source == element%adhesion) &
                        & v(ix, iy, :) = v(ix, iy, :) - weight(ahead, iy)*r(ahead, iy, :)/self%own
                  end select
               end if
               upstream = v(ix, iy, :)
               if (state(ix, iy) == element%slip) upstream = 0.0_wp
            end do
         end do
      end associate
   end subroutine set_direction

   !> Line search; the step is stored in last_step
   subroutine find_step(self, p, state)
      class(descent), intent(inout) :: self
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(in) :: state(:, :)
      type(minimum_search) :: search

      call search%start(first_share*self%estimated_step(), line_tolerance)
      do while (.not. search%finished)
         call search%update(square_after(search%x, p, self%slip, self%v, self%q, self%weight, state))
      end do
      self%last_step = search%best
   end subroutine find_step

   !> Optimal step if directions and bounds were constant
   pure real(wp) function estimated_step(self) result(step)
      class(descent), intent(in) :: self
      real(wp) :: rq, qq
      integer :: ix, iy

      rq = 0.0_wp
      qq = 0.0_wp
      do iy = 1, size(self%weight, 2)
         do ix = 1, size(self%weight, 1)
            rq = rq + self%weight(ix, iy)**2*dot_product(self%r(ix, iy, :), self%q(ix, iy, :))
            qq = qq + self%weight(ix, iy)**2*dot_product(self%q(ix, iy, :), self%q(ix, iy, :))
         end do
      end do
      step = blind_step
      if (abs(rq) > 0.0_wp .and. qq > 0.0_wp) step = max(smallest_step, min(largest_step, abs(rq)/qq))
      if (self%last_step > 0.0_wp) step = 0.5_wp*(step + self%last_step)
   end function estimated_step

   !> Weighted residual after a step, with slip extrapolated linearly; the arrays are those of a descent
   pure real(wp) function square_after(step, p, slip, v, q, weight, state) result(value)
      real(wp), intent(in) :: step
      !> Tractions before the step [N/mm2], slip [mm], and their changes for a unit step
      real(wp), contiguous, intent(in) :: p(:, :, :), slip(:, :, :), v(:, :, :), q(:, :, :)
      real(wp), contiguous, intent(in) :: weight(:, :)
      integer, contiguous, intent(in) :: state(:, :)
      real(wp) :: z(2), s(2), n(2), length, normal
      integer :: ix, iy

      value = 0.0_wp
      do iy = 1, size(weight, 2)
         do ix = 1, size(weight, 1)
            if (weight(ix, iy) <= 0.0_wp) cycle
            s = slip(ix, iy, :) + step*q(ix, iy, :)
            if (state(ix, iy) == element%slip) then
               z = p(ix, iy, :) + step*v(ix, iy, :)
               length = hypot(z(1), z(2))
               if (length > 0.0_wp) then
                  n = z/length
                  normal = dot_product(n, s)
                  if (normal <= 0.0_wp) s = s - normal*n
               end if
            end if
            value = value + weight(ix, iy)**2*dot_product(s, s)
         end do
      end do
   end function square_after

   !> Tractions after the step: on the circles in slip, within them in adhesion
   subroutine take_step(self, problem, state, p)
      class(descent), intent(in) :: self
      type(tangential_problem), intent(in) :: problem
      !> Element states, and tractions [N/mm2]
      integer, contiguous, intent(in) :: state(:, :)
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      real(wp) :: length, z(2)
      integer :: ix, iy

      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (state(ix, iy) == element%exterior) cycle
            z = p(ix, iy, :) + self%last_step*self%v(ix, iy, :)
            length = hypot(z(1), z(2))
            if (length > problem%bound(ix, iy) .or. &
               & (state(ix, iy) == element%slip .and. length > 0.0_wp)) z = z*(problem%bound(ix, iy)/length)
            p(ix, iy, :) = z
         end do
      end do
   end subroutine take_step

   !> Change adhesion to slip at the bound, slip to adhesion where slip and traction have the same direction
   subroutine move_elements(self, problem, p, state, any_moved)
      class(descent), intent(in) :: self
      type(tangential_problem), intent(in) :: problem
      !> Tractions [N/mm2] and element states
      real(wp), contiguous, intent(in) :: p(:, :, :)
      integer, contiguous, intent(inout) :: state(:, :)
      logical, intent(out) :: any_moved
      integer :: ix, iy

      any_moved = .false.
      do iy = 1, problem%my
         do ix = 1, problem%mx
            if (state(ix, iy) == element%adhesion) then
               if (hypot(p(ix, iy, 1), p(ix, iy, 2)) < at_bound*problem%bound(ix, iy)) cycle
               ! at the bound with slip in the direction of the traction it returns by itself
               if (dot_product(self%slip(ix, iy, :), p(ix, iy, :)) > 0.0_wp) cycle
               state(ix, iy) = element%slip
               any_moved = .true.
            else if (state(ix, iy) == element%slip) then
               if (dot_product(self%slip(ix, iy, :), p(ix, iy, :)) <= 0.0_wp) cycle
               state(ix, iy) = element%adhesion
               any_moved = .true.
            end if
         end do
      end do
   end subroutine move_elements
end module contact_tangential_gd_steady
