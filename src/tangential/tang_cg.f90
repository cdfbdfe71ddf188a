!> TangCG: conjugate gradients for shifts and transient rolling, slip directions as unknowns
!>
!> Adhering elements have two unknown components, slipping ones the direction of a traction on
!> the circle |p| = g. The energy on this product of planes and circles is minimised by
!> preconditioned conjugate gradients, interrupted every few iterations to move elements
!> between adhesion and slip; Zhao, Vollebregt and Oosterlee (2014). On the circle the second
!> derivative along the tangent t is t.A t + sigma, sigma = -S.n/g, which enters product and
!> preconditioner. Differs in the preconditioner: an approximate inverse of the 2 by 2 block of
!> kernels, not of its diagonal blocks, and its output is not divided once more in adhesion.
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

   !> Most iterations between two checks of the element states
   integer, parameter :: inner_limit = 4
   !> Changes of the tractions that call for a check, relative
   real(wp), parameter :: inner_change = 0.01_wp
   !> Numerators below this value mean that nothing is left to do
   real(wp), parameter :: nothing = 1.0e-200_wp

contains

   !> Iterate from given tractions; they stay admissible whatever happens
   subroutine tang_cg(problem, operator, eps, creep, p, state, report, log)
      type(tangential_problem), intent(in) :: problem
      class(compliance), intent(inout) :: operator
      !> Tolerance of the updates
      real(wp), intent(in) :: eps
      real(wp), intent(in) :: creep(2)
      !> Tractions [N/mm2], shape (mx, my, 2); admissible estimate on entry
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      !> Element states; from the tractions on entry
      integer, contiguous, intent(inout) :: state(:, :)
      !> Gets ended, iterations
      type(solve_report), intent(inout) :: report
      type(log_type), intent(inout) :: log
      type(update_watch) :: watch
      real(wp), allocatable, dimension(:, :, :) :: slip, r, z, v, q, before, at_check
      real(wp), allocatable :: sigma(:, :)
      real(wp) :: alpha, beta, vq, zq, rv, moved, size_p, step
      integer :: n_contact, n_slip, inner, ended, iterations
      logical :: precondition, restart, check

      allocate(slip, r, z, v, q, before, at_check, mold=p)
      allocate(sigma(problem%mx, problem%my))
      n_contact = count(problem%contact)
      watch = update_watch(eps=eps, n_contact=n_contact, largest_bound=maxval(problem%bound), &
         & deadline=problem%deadline)
      precondition = .true.
      restart = .true.
      v = 0.0_wp
      q = 0.0_wp
      at_check = p
      inner = 0
      moved = 0.0_wp
      size_p = norm(sum(p**2))
      call slip_of(problem, operator, p, creep, slip)
      call release(restart)
      restart = .true.
      call set_residual()
      ended = ending%not_started
      iterations = 0
      do
         n_slip = count(state == element%slip)
         if (precondition .and. ((n_slip > 3*(n_contact - n_slip) .and. problem%my > 1) &
            & .or. iterations >= problem%maxgs/2)) then
            precondition = .false.
            restart = .true.
         end if
         call apply_preconditioner()
         ! q still belongs to the previous direction
         beta = 0.0_wp
         if (.not. restart) then
            zq = sum(z*q)
            vq = sum(v*q)
            if (abs(zq) > nothing .and. abs(vq) > 1.0e-6_wp*abs(zq)) beta = -zq/vq
         end if
         v = z + beta*v
         restart = .false.

         call operator%tangential(v, q)
         call curve_product()
         rv = sum(r*v)
         vq = sum(v*q)
         alpha = 0.0_wp
         if (abs(rv) > nothing) then
            alpha = 1.0_wp
            ! a direction of negative curvature is followed as far as one of positive curvature
            if (abs(vq) > 1.0e-6_wp*abs(rv)) alpha = rv/abs(vq)
         end if
         before = p
         call take_step()
         iterations = iterations + 1
         inner = inner + 1
         step = norm(sum((p - before)**2))
         moved = moved + step
         size_p = norm(sum(p**2))
         check = inner >= inner_limit .or. step <= eps*size_p .or. moved > inner_change*size_p
         if (.not. check) then
            r = r - alpha*q
            if (iterations < problem%maxgs) cycle
         end if

         restart = move_elements()
         inner = 0
         moved = 0.0_wp
         watch%updates = iterations - 1
         call watch%judge(sum((p - before)**2), sum(p**2), problem%maxgs, ended)
         call trace_iteration(log, watch, "TangCG", state)
         if (ended == ending%diverged .and. iterations < problem%maxgs) then
            p = at_check
            exit
         end if
         at_check = p
         if (ended == ending%converged .and. restart) ended = ending%not_started
         if (ended /= ending%not_started .or. iterations >= problem%maxgs) exit
         call set_residual()
      end do
      if (ended == ending%not_started) ended = ending%iteration_limit
      report%ended = ended
      report%iterations = iterations

   contains

      !> Root mean square over the contact area
      pure real(wp) function norm(squares)
         real(wp), intent(in) :: squares
         norm = sqrt(squares/(2*max(1, n_contact)))
      end function norm

      !> Residual of the unknowns that are left, and sigma
      subroutine set_residual()
         integer :: ix, iy
         real(wp) :: n(2), t(2)

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
      end subroutine set_residual

      !> Keep what slip elements can use: the component along the tangent
      subroutine tangent_part(field)
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
      end subroutine tangent_part

      subroutine apply_preconditioner()
         integer :: ix, iy, k
         real(wp) :: c

         if (precondition) then
            call operator%tangential_inverse(r, z)
         else
            do k = 1, 2
               z(:, :, k) = r(:, :, k)/operator%diagonal(k + 1)
            end do
         end if
         do k = 1, 2
            c = operator%diagonal(k + 1)
            do iy = 1, problem%my
               do ix = 1, problem%mx
                  z(ix, iy, k) = z(ix, iy, k)*(c/(c + abs(sigma(ix, iy))))
               end do
            end do
         end do
         call tangent_part(z)
      end subroutine apply_preconditioner

      !> From A v to the product with the second derivative
      subroutine curve_product()
         integer :: k

         call tangent_part(q)
         do k = 1, 2
            q(:, :, k) = q(:, :, k) + sigma*v(:, :, k)
         end do
      end subroutine curve_product

      subroutine take_step()
         integer :: ix, iy

         p = p + alpha*v
         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (state(ix, iy) == element%slip) call rescale(ix, iy)
            end do
         end do
      end subroutine take_step

      !> Bring the traction of a slip element to the bound
      subroutine rescale(ix, iy)
         integer, intent(in) :: ix, iy
         real(wp) :: length

         length = hypot(p(ix, iy, 1), p(ix, iy, 2))
         if (length > 0.0_wp) p(ix, iy, :) = p(ix, iy, :)*(problem%bound(ix, iy)/length)
      end subroutine rescale

      !> Adhesion to slip beyond the bound, slip to adhesion where slip and traction agree
      logical function move_elements() result(any_moved)
         integer :: ix, iy

         any_moved = .false.
         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (state(ix, iy) /= element%adhesion) cycle
               if (hypot(p(ix, iy, 1), p(ix, iy, 2)) > problem%bound(ix, iy)) then
                  any_moved = .true.
                  state(ix, iy) = element%slip
                  call rescale(ix, iy)
               end if
            end do
         end do
         call slip_of(problem, operator, p, creep, slip)
         call release(any_moved)
      end function move_elements

      !> Slip to adhesion where the slip does not oppose the traction
      subroutine release(any_moved)
         logical, intent(inout) :: any_moved
         integer :: ix, iy

         do iy = 1, problem%my
            do ix = 1, problem%mx
               if (state(ix, iy) /= element%slip) cycle
               if (dot_product(slip(ix, iy, :), p(ix, iy, :)) <= 0.0_wp) cycle
               state(ix, iy) = element%adhesion
               any_moved = .true.
            end do
         end do
      end subroutine release

   end subroutine tang_cg
end module contact_tangential_tang_cg
