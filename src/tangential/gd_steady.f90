!> GDsteady: descent along weighted residuals in steady rolling, all products by transforms
!>
!> The residual of the unknowns that are left (slip in adhesion, its part along the tangent in
!> slip) is taken as a change of the increments p(i) - p(i + 1), since in increments the
!> operator is symmetric positive definite. Row by row, from the leading edge, increments
!> become tractions that keep slip elements on their circles; a line search on the weighted
!> residual follows. An experimental method of CONTACT (Vollebregt). Simplified: the weight of
!> slip elements, the share of the angle between p and -S that one element removes by turning
!> S, is taken in its limit for small angles, C_tt/(C_tt + sigma).
module contact_tangential_gd_steady
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_base_solve_report, only : ending, solve_report
   use contact_elastic_compliance, only : compliance
   use contact_grid_element_division, only : element
   use contact_tangential_problem, only : residual_scale, slip_of, tangential_problem, true_residual
   use contact_tangential_sweep, only : trace_iteration, update_watch
   implicit none (type, external)
   private

   public :: gd_steady

   type :: projection_list
      !> All of a change is carried downstream
      integer :: trail = 1
      !> A fraction of it
      integer :: keep = 2
      !> It is taken back after some elements
      integer :: down = 3
   end type projection_list
   !> How increments of adhering elements become tractions
   type(projection_list), parameter :: projection = projection_list()

   !> Relative tolerance and evaluations of the line search
   real(wp), parameter :: line_tolerance = 1.0e-3_wp
   integer, parameter :: line_limit = 99
   !> Tolerance of the updates from then on, where they are small and the residual is not
   real(wp), parameter :: sharper = 0.3_wp
   !> Iterations without a smaller residual that count as stagnation
   integer, parameter :: patience = 30

contains

   !> Iterate from given tractions; they stay admissible whatever happens
   subroutine gd_steady(problem, operator, eps, creep, p, state, report, log)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the updates and, with given creepages, of the true residual
      real(wp), intent(in) :: eps
      real(wp), intent(in) :: creep(2)
      !> Tractions [N/mm2], shape (mx, my, 2); admissible estimate on entry
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      !> Element states; from the tractions on entry
      integer, contiguous, intent(inout) :: state(:, :)
      !> Gets ended, iterations; stagnated asks for another method
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout) :: log
      type(update_watch) :: watch
      real(wp), allocatable, dimension(:, :, :) :: slip, r, v, q, before, best
      real(wp), allocatable :: weight(:, :)
      !> Compliance of an element on itself, its change carried one element downstream [mm/(N/mm2)]
      real(wp) :: own(2)
      real(wp) :: alpha, alpha0, usual, f, progress, old_size, new_size, least, factor, scale
      integer :: k, iteration, mode, held, since_best
      logical :: moved

      allocate(slip, r, v, q, before, best, mold=p)
      allocate(weight(problem%mx, problem%my))
      own = operator%diagonal(2:3) - [operator%table%xx(1, 0), operator%table%yy(1, 0)]
      watch = update_watch(eps=eps, n_contact=count(problem%contact), largest_bound=maxval(problem%bound), &
         & deadline=problem%deadline)
      scale = residual_scale(problem, operator)
      call slip_of(problem, operator, p, creep, slip)
      usual = 0.0_wp
      held = 0
      progress = 1.0_wp
      least = huge(1.0_wp)
      since_best = 0
      best = p
      report%ended = ending%not_started
      do iteration = 1, problem%maxgs
         report%iterations = iteration
         call set_weights()
         call residual(p, slip, r)
         old_size = sum((r*spread(weight, 3, 2))**2)
         if (old_size < 0.999_wp*least) then
            least = old_size
            since_best = 0
            best = p
         else
            since_best = since_best + 1
            if (since_best > patience) then
               report%ended = ending%stagnated
               exit
            end if
         end if
         if (.not. old_size > 0.0_wp) then
            report%ended = ending%converged
            exit
         end if
         call choose_projection()
         call make_direction()
         call operator%steady(v, q)
         call scale_of_step()
         call search_line()
         before = p
         call trial_tractions(alpha, p)
         call slip_of(problem, operator, p, creep, slip)
         moved = move_elements()
         call residual(p, slip, r)
         new_size = sum((r*spread(weight, 3, 2))**2)
         progress = max(0.0_wp, 1.0_wp - sqrt(new_size/old_size))
         factor = 1.0_wp
         if (progress < 0.1_wp) factor = 0.1_wp/max(1.0e-3_wp, progress)
         if (progress < 1.0e-3_wp) factor = 100.0_wp
         call watch%judge(sum(((p - before)*factor)**2), sum(p**2), problem%maxgs, report%ended)
         call trace_iteration(log, watch, "GDsteady", state)
         if (report%ended == ending%converged .and. moved) report%ended = ending%not_started
         ! small updates are no small residual; prescribed forces are missed until the end
         if (report%ended == ending%converged .and. problem%n_forces == 0) then
            if (true_residual(problem, p, slip, scale) > eps) then
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

   contains

      !> Weights of the residual per element
      subroutine set_weights()
         integer :: ix, iy, i0, i1, length
         real(wp) :: n(2), sigma, ctt, previous

         call downstream_range(i0, i1)
         do iy = 1, problem%my
            length = 0
            previous = problem%d_ifc
            do ix = i0, i1, problem%direction
               select case (state(ix, iy))
               case (element%adhesion)
                  length = length + 1
                  weight(ix, iy) = problem%d_ifc + (length - 1)*problem%d_lin
                  if (problem%d_lin > 0.0_wp) weight(ix, iy) = min(weight(ix, iy), problem%d_cns)
                  if (problem%d_lin < 0.0_wp) weight(ix, iy) = max(weight(ix, iy), problem%d_cns)
                  weight(ix, iy) = min(weight(ix, iy), 50.0_wp*previous)
                  previous = weight(ix, iy)
               case (element%slip)
                  length = 0
                  previous = problem%d_ifc
                  weight(ix, iy) = 0.0_wp
                  if (problem%bound(ix, iy) <= 0.0_wp) cycle
                  n = p(ix, iy, :)/problem%bound(ix, iy)
                  sigma = max(0.0_wp, -dot_product(n, slip(ix, iy, :))/problem%bound(ix, iy))
                  ctt = own(1)*n(2)**2 + own(2)*n(1)**2
                  weight(ix, iy) = problem%d_slp*(ctt/(ctt + sigma))**problem%pow_s
               case default
                  length = 0
                  previous = problem%d_ifc
                  weight(ix, iy) = 0.0_wp
               end select
            end do
         end do
      end subroutine set_weights

      !> First and last column from trailing to leading side
      pure subroutine downstream_range(i0, i1)
         integer, intent(out) :: i0, i1
         i0 = merge(1, problem%mx, problem%direction > 0)
         i1 = problem%mx + 1 - i0
      end subroutine downstream_range

      !> Slip in adhesion, its part along the tangent in slip, negative, for given tractions
      subroutine residual(at, s, res)
         real(wp), contiguous, intent(in) :: at(:, :, :), s(:, :, :)
         real(wp), contiguous, intent(inout) :: res(:, :, :)
         real(wp) :: t(2)
         integer :: ix, iy

         do iy = 1, problem%my
            do ix = 1, problem%mx
               res(ix, iy, :) = 0.0_wp
               if (state(ix, iy) == element%adhesion) then
                  res(ix, iy, :) = -s(ix, iy, :)
               else if (state(ix, iy) == element%slip .and. problem%bound(ix, iy) > 0.0_wp) then
                  t = [-at(ix, iy, 2), at(ix, iy, 1)]/problem%bound(ix, iy)
                  ! where slip and traction agree the element is about to adhere
                  if (dot_product(at(ix, iy, :), s(ix, iy, :)) > 0.0_wp) then
                     res(ix, iy, :) = -s(ix, iy, :)
                  else
                     res(ix, iy, :) = -dot_product(t, s(ix, iy, :))*t
                  end if
               end if
            end do
         end do
      end subroutine residual

      !> The projection asked for; for two iterations another one when progress was poor
      subroutine choose_projection()
         f = problem%fdecay
         k = 1
         mode = projection%keep
         if (f > 0.999_wp) mode = projection%trail
         if (f < 0.001_wp) then
            mode = projection%down
            k = max(1, nint(-f))
         end if
         if (progress <= problem%betath .and. held == 0) held = 2
         if (held > 0) then
            held = held - 1
            mode = projection%down
            k = max(1, problem%kdowfb)
         end if
      end subroutine choose_projection

      !> Changes of traction that follow from the residual as changes of increments
      subroutine make_direction()
         integer :: ix, iy, i0, i1, ahead, source
         real(wp) :: delta(2), upstream(2), t(2), size_v

         call downstream_range(i0, i1)
         do iy = 1, problem%my
            upstream = 0.0_wp
            do ix = i1, i0, -problem%direction
               if (state(ix, iy) == element%exterior .or. &
                  & (state(ix, iy) == element%slip .and. problem%bound(ix, iy) <= 0.0_wp)) then
                  v(ix, iy, :) = 0.0_wp
                  upstream = 0.0_wp
                  cycle
               end if
               delta = weight(ix, iy)*r(ix, iy, :)/own
               if (state(ix, iy) == element%slip) then
                  t = [-p(ix, iy, 2), p(ix, iy, 1)]/problem%bound(ix, iy)
                  delta = dot_product(t, delta)*t
                  size_v = norm2(delta)
                  if (size_v > 1000.0_wp*problem%bound(ix, iy)) delta = delta*(1000.0_wp*problem%bound(ix, iy)/size_v)
                  v(ix, iy, :) = delta
               else
                  select case (mode)
                  case (projection%trail)
                     v(ix, iy, :) = upstream + delta
                  case (projection%keep)
                     v(ix, iy, :) = f*upstream + delta
                  case default
                     ahead = ix + k*problem%direction
                     source = 0
                     if (ahead >= 1 .and. ahead <= problem%mx) source = state(ahead, iy)
                     v(ix, iy, :) = upstream + delta
                     if (source == element%adhesion) &
                        & v(ix, iy, :) = v(ix, iy, :) - weight(ahead, iy)*r(ahead, iy, :)/own
                  end select
               end if
               upstream = v(ix, iy, :)
               if (state(ix, iy) == element%slip) upstream = 0.0_wp
            end do
         end do
      end subroutine make_direction

      !> Length of the step that would be best without changes of direction and bound
      subroutine scale_of_step()
         real(wp) :: rq, qq
         integer :: ix, iy

         rq = 0.0_wp
         qq = 0.0_wp
         do iy = 1, problem%my
            do ix = 1, problem%mx
               rq = rq + weight(ix, iy)**2*dot_product(r(ix, iy, :), q(ix, iy, :))
               qq = qq + weight(ix, iy)**2*dot_product(q(ix, iy, :), q(ix, iy, :))
            end do
         end do
         alpha0 = 0.5_wp
         if (abs(rq) > 0.0_wp .and. qq > 0.0_wp) alpha0 = max(1.0e-3_wp, min(1.0e3_wp, abs(rq)/qq))
         if (usual > 0.0_wp) alpha0 = 0.5_wp*(alpha0 + usual)
      end subroutine scale_of_step

      !> Tractions after a step: on the circles in slip, within them in adhesion
      subroutine trial_tractions(step, at)
         real(wp), intent(in) :: step
         real(wp), contiguous, intent(inout) :: at(:, :, :)
         real(wp) :: length, z(2)
         integer :: ix, iy

         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (state(ix, iy) == element%exterior) cycle
               z = p(ix, iy, :) + step*v(ix, iy, :)
               length = hypot(z(1), z(2))
               if (length > problem%bound(ix, iy) .or. &
                  & (state(ix, iy) == element%slip .and. length > 0.0_wp)) z = z*(problem%bound(ix, iy)/length)
               at(ix, iy, :) = z
            end do
         end do
      end subroutine trial_tractions

      !> Weighted residual after a step, slip continued linearly
      real(wp) function objective(step) result(value)
         real(wp), intent(in) :: step
         real(wp) :: z(2), s(2), n(2), length, normal
         integer :: ix, iy

         value = 0.0_wp
         do iy = 1, problem%my
            do ix = 1, problem%mx
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
      end function objective

      !> Bracket a minimum of the objective, then Brent's method
      subroutine search_line()
         real(wp) :: a, b, c, x, w, y, fx, fw, fy, fa, fb, u, fu, d, e, middle, tol, num, den, old_e
         real(wp), parameter :: golden = 0.381966_wp
         integer :: evaluation

         a = 0.0_wp
         fa = objective(a)
         b = 0.6_wp*alpha0
         fb = objective(b)
         evaluation = 2
         if (fb >= fa) then
            c = b
            do while (fb >= fa .and. evaluation < 25)
               c = b
               b = b/3.0_wp
               fb = objective(b)
               evaluation = evaluation + 1
            end do
         else
            c = 3.0_wp*b
            fu = objective(c)
            do while (fu < fb .and. evaluation < 25)
               a = b
               b = c
               fb = fu
               c = 3.0_wp*b
               fu = objective(c)
               evaluation = evaluation + 1
            end do
         end if
         x = b
         w = b
         y = b
         fx = fb
         fw = fb
         fy = fb
         d = 0.0_wp
         e = 0.0_wp
         do while (evaluation < line_limit)
            middle = 0.5_wp*(a + c)
            tol = line_tolerance*abs(x) + tiny(1.0_wp)
            if (abs(x - middle) <= 2.0_wp*tol - 0.5_wp*(c - a)) exit
            num = 0.0_wp
            den = 0.0_wp
            old_e = e
            if (abs(e) > tol) then
               num = (x - y)**2*(fx - fw) - (x - w)**2*(fx - fy)
               den = 2.0_wp*((x - y)*(fx - fw) - (x - w)*(fx - fy))
               if (den > 0.0_wp) num = -num
               den = abs(den)
               e = d
            end if
            if (den > 0.0_wp .and. abs(num) < abs(0.5_wp*den*old_e) .and. num > den*(a - x) .and. num < den*(c - x)) then
               d = num/den
            else
               e = merge(c - x, a - x, x < middle)
               d = golden*e
            end if
            u = x + merge(d, sign(tol, d), abs(d) >= tol)
            fu = objective(u)
            evaluation = evaluation + 1
            if (fu <= fx) then
               if (u >= x) a = x
               if (u < x) c = x
               y = w
               fy = fw
               w = x
               fw = fx
               x = u
               fx = fu
            else
               if (u < x) a = u
               if (u >= x) c = u
               if (fu <= fw .or. w == x) then
                  y = w
                  fy = fw
                  w = u
                  fw = fu
               else if (fu <= fy .or. y == x .or. y == w) then
                  y = u
                  fy = fu
               end if
            end if
         end do
         alpha = x
         usual = alpha
      end subroutine search_line

      !> Adhesion to slip at the bound, slip to adhesion where slip and traction agree
      logical function move_elements() result(any_moved)
         integer :: ix, iy

         any_moved = .false.
         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (state(ix, iy) == element%adhesion) then
                  if (hypot(p(ix, iy, 1), p(ix, iy, 2)) < (1.0_wp - 1.0e-12_wp)*problem%bound(ix, iy)) cycle
                  ! at the bound with slip along the traction it comes back by itself
                  if (dot_product(slip(ix, iy, :), p(ix, iy, :)) > 0.0_wp) cycle
                  state(ix, iy) = element%slip
                  any_moved = .true.
               else if (state(ix, iy) == element%slip) then
                  if (dot_product(slip(ix, iy, :), p(ix, iy, :)) <= 0.0_wp) cycle
                  state(ix, iy) = element%adhesion
                  any_moved = .true.
               end if
            end do
         end do
      end function move_elements
   end subroutine gd_steady
end module contact_tangential_gd_steady
