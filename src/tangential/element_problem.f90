!> The contact conditions of one element when all other elements are frozen
!>
!> With the compliance C of the element on itself and the slip S0 it would have without its own
!> traction: find |p| <= g such that S0 + C p = -sigma p, sigma >= 0, and sigma = 0 unless
!> |p| = g. For a symmetric positive definite C this is the minimum of a quadratic function on a
!> disc; it exists, is unique and needs one scalar root (the "secular equation" of trust-region
!> methods, Moré and Sorensen 1983). Differs from a search through the element states: the state
!> follows from the exact solution, relaxation comes afterwards.
module contact_tangential_element_problem
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   implicit none (type, external)
   private

   public :: element_compliance, solve_element, relax_element

   !> Symmetric compliance of one element on itself [mm/(N/mm2)]
   type :: element_compliance
      real(wp) :: xx = 1.0_wp, yy = 1.0_wp, xy = 0.0_wp
   end type element_compliance

   !> Bounds below this value count as zero [N/mm2]
   real(wp), parameter :: no_bound = 1.0e-200_wp

contains

   !> Traction and state of one element, without relaxation
   pure subroutine solve_element(c, s0, g, p, state)
      type(element_compliance), intent(in) :: c
      !> Slip without the element's own traction [mm]
      real(wp), intent(in) :: s0(2)
      !> Traction bound [N/mm2]
      real(wp), intent(in) :: g
      !> Traction [N/mm2]
      real(wp), intent(out) :: p(2)
      !> element%adhesion or element%slip
      integer, intent(out) :: state
      real(wp) :: det, b(2), lambda(2), sigma, n, cosine, sine, angle, length, slope
      integer :: trial
      integer, parameter :: max_trials = 40

      state = element%adhesion
      p = 0.0_wp
      length = hypot(s0(1), s0(2))
      if (.not. length > 0.0_wp) return
      state = element%slip
      if (g <= no_bound) return

      det = c%xx*c%yy - c%xy**2
      if (.not. (c%xx > 0.0_wp .and. det > 0.0_wp)) then
         p = -(g/length)*s0
         return
      end if
      p = -[c%yy*s0(1) - c%xy*s0(2), c%xx*s0(2) - c%xy*s0(1)]/det
      if (hypot(p(1), p(2)) <= g) then
         state = element%adhesion
         return
      end if

      ! principal axes
      cosine = 1.0_wp
      sine = 0.0_wp
      lambda = [c%xx, c%yy]
      if (c%xy /= 0.0_wp) then
         angle = 0.5_wp*atan2(2.0_wp*c%xy, c%xx - c%yy)
         cosine = cos(angle)
         sine = sin(angle)
         n = hypot(0.5_wp*(c%xx - c%yy), c%xy)
         lambda = 0.5_wp*(c%xx + c%yy) + [n, -n]
      end if
      b = -[cosine*s0(1) + sine*s0(2), cosine*s0(2) - sine*s0(1)]

      ! |p(sigma)| = g; Newton on 1/|p| rises monotonically from a lower bound
      sigma = max(0.0_wp, length/g - maxval(lambda))
      do trial = 1, max_trials
         p = b/(lambda + sigma)
         n = hypot(p(1), p(2))
         if (n - g <= 1.0e-14_wp*g) exit
         slope = sum((p/n)**2/(lambda + sigma))
         sigma = sigma + (n - g)/(g*slope)
      end do
      p = p*(g/n)
      p = [cosine*p(1) - sine*p(2), sine*p(1) + cosine*p(2)]
   end subroutine solve_element

   !> Move from the old traction part of the way to the new one: along the line in adhesion,
   !> along the circle in slip. Admissible whenever the old traction is.
   pure subroutine relax_element(old, g, omegah, omegas, state, p)
      real(wp), intent(in) :: old(2)
      !> Traction bound [N/mm2]
      real(wp), intent(in) :: g
      !> Relaxation in adhesion and in slip [-]
      real(wp), intent(in) :: omegah, omegas
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
