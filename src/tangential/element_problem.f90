!> Contact conditions of one element with all other elements fixed
!>
!> With the compliance C of the element on itself and the slip S0 without its own traction: find |p| <= g such that S0 + C p =
!> -sigma p, sigma >= 0, and sigma = 0 unless |p| = g. For a symmetric positive definite C this is the minimum of a quadratic
!> function on a disc. It exists, is unique and requires one scalar root (the "secular equation" of trust-region methods, Moré
!> and Sorensen 1983). Instead of a search through the element states, the state follows from the exact solution; relaxation is
!> applied afterwards.
!>
!> In an element that yields, S0 + C p = -m p/|p| with |p| = t + k m (contact_tangential_yield), which is the same problem with
!> another scalar function. For a decreasing limit, k < 0, there may be several solutions; the one with the smallest plastic
!> displacement is taken, which is reached first when the load increases from zero.
module contact_tangential_element_problem
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_tangential_yield, only : yield_point
   implicit none (type, external)
   private

   public :: element_compliance, solve_element, solve_yielding_element, relax_element

   !> Symmetric compliance of one element on itself [mm/(N/mm2)]
   type :: element_compliance
      real(wp) :: xx = 1.0_wp, yy = 1.0_wp, xy = 0.0_wp
   end type element_compliance

   !> Smaller bounds are treated as zero [N/mm2]
   real(wp), parameter :: no_bound = 1.0e-200_wp

   !> The element problem in the principal axes of the compliance
   type :: principal_problem
      !> Compliances [mm/(N/mm2)], -S0 [mm] and its length
      real(wp) :: lambda(2), b(2), length
      !> Direction of the first axis
      real(wp) :: cosine, sine
   end type principal_problem

contains

   !> Traction and state of one element, without relaxation
   pure subroutine solve_element(c, s0, g, p, state)
      !> Coefficients of the element on itself
      type(element_compliance), intent(in) :: c
      !> Slip without the element's own traction [mm]
      real(wp), intent(in) :: s0(2)
      !> Traction bound [N/mm2]
      real(wp), intent(in) :: g
      !> Traction [N/mm2]
      real(wp), intent(out) :: p(2)
      !> element%adhesion or element%slip
      integer, intent(out) :: state
      type(principal_problem) :: axes
      logical :: found

      state = element%adhesion
      p = 0.0_wp
      if (.not. any(abs(s0) > 0.0_wp)) return
      state = element%slip
      if (g <= no_bound) return
      if (.not. is_positive(c)) then
         p = -(g/hypot(s0(1), s0(2)))*s0
         return
      end if
      p = adhering(c, s0)
      if (hypot(p(1), p(2)) <= g) then
         state = element%adhesion
         return
      end if
      axes = principal_axes(c, s0)
      call find_traction(axes, g, 0.0_wp, p, found)
   end subroutine solve_element

   !> Solve the problem of an element that may yield
   pure subroutine solve_yielding_element(c, s0, g, before, slope, lowest, p, point)
      !> Coefficients of the element on itself
      type(element_compliance), intent(in) :: c
      !> Slip without the element's own traction [mm]
      real(wp), intent(in) :: s0(2)
      !> Traction bound and yield limit before the step [N/mm2]
      real(wp), intent(in) :: g, before
      !> Slope and lower limit as in yield_data
      real(wp), intent(in) :: slope, lowest
      !> Traction [N/mm2]
      real(wp), intent(out) :: p(2)
      !> State, plastic displacement and yield limit after the step; no derivatives
      type(yield_point), intent(out) :: point
      type(principal_problem) :: axes
      real(wp) :: m
      logical :: found

      point%limit = before
      call solve_element(c, s0, min(g, before), p, point%state)
      if (point%state == element%adhesion .or. before >= g) return
      if (.not. is_positive(c)) return

      axes = principal_axes(c, s0)
      point%state = element%plastic
      call find_traction(axes, before, slope, p, found)
      if (slope > 0.0_wp .and. hypot(p(1), p(2)) > g) then
         ! hardened up to the friction bound; the remainder is slip
         call find_traction(axes, g, 0.0_wp, p, found)
         point%state = element%slip
         point%limit = g
         point%plastic = (g - before)/slope
         return
      end if
      if (slope < 0.0_wp .and. (.not. found .or. hypot(p(1), p(2)) < lowest)) &
         & call find_traction(axes, min(lowest, before), 0.0_wp, p, found)
      m = hypot(s0(1) + c%xx*p(1) + c%xy*p(2), s0(2) + c%xy*p(1) + c%yy*p(2))
      point%plastic = m
      point%limit = hypot(p(1), p(2))
   end subroutine solve_yielding_element

   pure logical function is_positive(c)
      type(element_compliance), intent(in) :: c
      is_positive = c%xx > 0.0_wp .and. c%xx*c%yy - c%xy**2 > 0.0_wp
   end function is_positive

   !> Traction for which the element does not slip [N/mm2]
   pure function adhering(c, s0) result(p)
      type(element_compliance), intent(in) :: c
      real(wp), intent(in) :: s0(2)
      real(wp) :: p(2)
      p = -[c%yy*s0(1) - c%xy*s0(2), c%xx*s0(2) - c%xy*s0(1)]/(c%xx*c%yy - c%xy**2)
   end function adhering

   pure type(principal_problem) function principal_axes(c, s0) result(axes)
      type(element_compliance), intent(in) :: c
      real(wp), intent(in) :: s0(2)
      real(wp) :: angle, n

      axes%cosine = 1.0_wp
      axes%sine = 0.0_wp
      axes%lambda = [c%xx, c%yy]
      if (c%xy /= 0.0_wp) then
         angle = 0.5_wp*atan2(2.0_wp*c%xy, c%xx - c%yy)
         axes%cosine = cos(angle)
         axes%sine = sin(angle)
         n = hypot(0.5_wp*(c%xx - c%yy), c%xy)
         axes%lambda = 0.5_wp*(c%xx + c%yy) + [n, -n]
      end if
      axes%b = -[axes%cosine*s0(1) + axes%sine*s0(2), axes%cosine*s0(2) - axes%sine*s0(1)]
      axes%length = hypot(s0(1), s0(2))
   end function principal_axes

   !> Traction with |p| = limit + slope*m, m = |S0 + C p|, if that for adhesion exceeds the limit
   !>
   !> With m = sigma |p| and p = -(C + sigma)**-1 S0 the condition is 1/|p(sigma)| + slope/limit*sigma = 1/limit. The left-hand
   !> side is concave and too small at sigma = 0, so that Newton's method increases monotonically from any lower bound to the
   !> smallest root; if there is no root the derivative vanishes on the way.
   pure subroutine find_traction(axes, limit, slope, p, found)
      type(principal_problem), intent(in) :: axes
      !> Limit [N/mm2], above 0
      real(wp), intent(in) :: limit
      !> Slope [N/mm3]
      real(wp), intent(in) :: slope
      !> Traction [N/mm2]
      real(wp), intent(out) :: p(2)
      logical, intent(out) :: found
      real(wp) :: sigma, n, target, rise
      integer :: trial
      integer, parameter :: max_trials = 40
      !> A traction that exceeds the limit by less than this fraction is on it: some round-off errors
      real(wp), parameter :: on_bound = 1.0e-14_wp

      found = .false.
      sigma = 0.0_wp
      ! |p| <= |S0|/(lambda + sigma) with the larger lambda
      rise = 1.0_wp + slope*axes%length/limit
      if (rise > 0.0_wp) sigma = max(0.0_wp, axes%length/limit - maxval(axes%lambda))/rise
      do trial = 1, max_trials
         p = axes%b/(axes%lambda + sigma)
         n = hypot(p(1), p(2))
         target = 1.0_wp - slope*sigma
         found = n*target - limit <= on_bound*limit
         if (found) exit
         rise = sum((p/n)**2/(axes%lambda + sigma)) + slope*n/limit
         if (.not. rise > 0.0_wp) exit
         sigma = sigma + (n*target/limit - 1.0_wp)/rise
      end do
      if (slope == 0.0_wp) p = p*(limit/n)
      p = [axes%cosine*p(1) - axes%sine*p(2), axes%sine*p(1) + axes%cosine*p(2)]
   end subroutine find_traction

   !> Move a fraction of the way from the old traction to the new one: along a straight line in adhesion, along the circle in
   !> slip. Admissible if the old traction is.
   pure subroutine relax_element(old, g, omegah, omegas, state, p)
      !> Traction before the relaxation [N/mm2]
      real(wp), intent(in) :: old(2)
      !> Traction bound [N/mm2]
      real(wp), intent(in) :: g
      !> Relaxation in adhesion and in slip [-]
      real(wp), intent(in) :: omegah, omegas
      !> Member of element: adhesion or slip
      integer, intent(in) :: state
      !> Solution of the element on entry, relaxed on exit
      real(wp), intent(inout) :: p(2)
      real(wp) :: length, turn

      if (state == element%adhesion) then
         if (omegah == 1.0_wp) return
         p = old + omegah*(p - old)
         length = hypot(p(1), p(2))
         if (length > g) p = p*(g/length)
      else
         if (omegas == 1.0_wp .or. all(old == 0.0_wp) .or. all(p == 0.0_wp)) return
         turn = atan2(p(2), p(1)) - atan2(old(2), old(1))
         if (turn > pi) turn = turn - 2.0_wp*pi
         if (turn <= -pi) turn = turn + 2.0_wp*pi
         turn = (omegas - 1.0_wp)*turn
         p = [cos(turn)*p(1) - sin(turn)*p(2), sin(turn)*p(1) + cos(turn)*p(2)]
      end if
   end subroutine relax_element
end module contact_tangential_element_problem
