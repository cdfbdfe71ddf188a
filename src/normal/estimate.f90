!> Normal pressures in closed form, and a first guess of the contact area for the solvers
module contact_normal_estimate
   use contact_base_choices, only : normal_control
   use contact_base_constants, only : excluded_threshold, pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   implicit none (type, external)
   private

   public :: elliptic_pressure, parabolic_pressure, sdec_pressure, guess_contact

   !> Part of the penetration below which a point of the undeformed surfaces is taken for contact [-]
   real(wp), parameter :: contact_level = 0.6_wp

   !> Force of a row of elements as a function of its penetration: G dy/(1 - nu) times `row_factor` times the penetration to the
   !> power of 1.08, whose inverse is 0.926. A fit to line contacts; an estimate needs no more
   real(wp), parameter :: row_power = 1.08_wp, inverse_power = 0.926_wp, row_excess = 0.08_wp
   !> Its factor: level, share at the reference width [mm], loss with the logarithm of the width, power of the radius along x
   real(wp), parameter :: row_level = 0.6_wp, row_share = 0.35_wp, row_loss = 0.05_wp, row_width = 200.0_wp, radius_power = 0.1_wp
   !> Peak of a parabola of pressure over a line contact, relative to the force over the area of a semi-axis times the half
   !> length: 3/8 by integration
   real(wp), parameter :: parabola_peak = 0.375_wp

contains

   !> Hertz's pressure, a semi-ellipsoid, at the centres of the elements.
   !>
   !> A line contact has the same semi-ellipse in each row with |y| <= bb.
   pure subroutine elliptic_pressure(grid, aa, bb, line_contact, fn, pn)
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Semi-axes [mm]; zero: no contact
      real(wp), intent(in) :: aa, bb
      !> Is bb half the length of a line contact?
      logical, intent(in) :: line_contact
      !> Normal force [N]
      real(wp), intent(in) :: fn
      !> Pressure [N/mm2], shape (mx, my), zero outside
      real(wp), intent(out) :: pn(:, :)

      call inverted_paraboloid(grid, aa, bb, line_contact, pn)
      pn = sqrt(pn)
      if (line_contact) then
         call scale_pressure(fn/pi, aa, bb, pn)
      else
         call scale_pressure(1.5_wp*fn/pi, aa, bb, pn)
      end if
   end subroutine elliptic_pressure

   !> Paraboloid of pressure over the same area, the traction bound of the simplified theory
   pure subroutine parabolic_pressure(grid, aa, bb, line_contact, fn, pn)
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Semi-axes [mm]; zero: no contact
      real(wp), intent(in) :: aa, bb
      !> Is bb half the length of a line contact?
      logical, intent(in) :: line_contact
      !> Normal force [N]
      real(wp), intent(in) :: fn
      !> Pressure [N/mm2], shape (mx, my), zero outside
      real(wp), intent(out) :: pn(:, :)

      call inverted_paraboloid(grid, aa, bb, line_contact, pn)
      if (line_contact) then
         call scale_pressure(parabola_peak*fn, aa, bb, pn)
      else
         call scale_pressure(2.0_wp*fn/pi, aa, bb, pn)
      end if
   end subroutine parabolic_pressure

   !> Pressure of the simple double-elliptical contact: two half ellipses joined at their widest row
   pure subroutine sdec_pressure(grid, aa, bneg, bpos, fn, pn)
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Semi-axis along x, extents towards negative and positive y from the widest row [mm]
      real(wp), intent(in) :: aa, bneg, bpos
      !> Normal force [N]
      real(wp), intent(in) :: fn
      !> Pressure [N/mm2], shape (mx, my), zero outside
      real(wp), intent(out) :: pn(:, :)
      real(wp) :: bb, y, y0, side, row
      integer :: ix, iy

      pn = 0.0_wp
      if (aa <= 0.0_wp .or. bneg <= 0.0_wp .or. bpos <= 0.0_wp) return
      bb = 0.5_wp*(bneg + bpos)
      y0 = 0.5_wp*(bneg - bpos)
      do iy = 1, grid%my
         y = grid%y(iy) - y0
         side = merge(bpos, bneg, y > 0.0_wp)
         row = 1.0_wp - (y/side)**2
         do ix = 1, grid%mx
            pn(ix, iy) = sqrt(max(0.0_wp, row - (grid%x(ix)/aa)**2))
         end do
      end do
      call scale_pressure(1.5_wp*fn/pi, aa, bb, pn)
   end subroutine sdec_pressure

   !> max(0, 1 - (x/aa)**2 - (y/bb)**2), without the last term in the rows of a line contact
   pure subroutine inverted_paraboloid(grid, aa, bb, line_contact, height)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: aa, bb
      logical, intent(in) :: line_contact
      !> Height [-], shape (mx, my)
      real(wp), intent(out) :: height(:, :)
      real(wp) :: row
      integer :: ix, iy

      height = 0.0_wp
      if (aa <= 0.0_wp .or. bb <= 0.0_wp) return
      do iy = 1, grid%my
         if (line_contact) then
            row = merge(1.0_wp, 0.0_wp, abs(grid%y(iy)) <= bb)
         else
            row = 1.0_wp - (grid%y(iy)/bb)**2
         end if
         do ix = 1, grid%mx
            height(ix, iy) = max(0.0_wp, row - (grid%x(ix)/aa)**2)
         end do
      end do
   end subroutine inverted_paraboloid

   !> Multiply by force/(aa bb); nothing to do for an empty area or negative force
   pure subroutine scale_pressure(force, aa, bb, pn)
      real(wp), intent(in) :: force, aa, bb
      real(wp), intent(inout) :: pn(:, :)

      if (aa <= 0.0_wp .or. bb <= 0.0_wp) return
      pn = pn*(max(0.0_wp, force)/aa/bb)
   end subroutine scale_pressure

   !> First guess of the contact area from the undeformed distance alone.
   !>
   !> Contact is where the surfaces would overlap by more than a fixed part of the penetration.
   !> A prescribed force is first turned into a penetration: rows of one element by a power law
   !> fitted to line contacts, other grids by the law of a circular punch of the area that
   !> belongs to the penetration, solved by bisection. With a positive force at least the
   !> closest element is in contact; excluded elements never are.
   pure subroutine guess_contact(grid, h, control, fn, pen, gg, nu, radius, contact, approach, stiffness)
      !> Centres and sides of the elements
      type(potential_contact), intent(in) :: grid
      !> Undeformed distance [mm], shape (mx, my)
      real(wp), intent(in) :: h(:, :)
      !> Member of normal_control
      integer, intent(in) :: control
      !> Prescribed normal force [N] or approach [mm]
      real(wp), intent(in) :: fn, pen
      !> Combined modulus of rigidity [N/mm2] and Poisson ratio [-]
      real(wp), intent(in) :: gg, nu
      !> Radius of curvature along x [mm], for single rows only; not positive: unknown
      real(wp), intent(in) :: radius
      !> Elements guessed to be in contact, shape (mx, my)
      logical, intent(out) :: contact(:, :)
      !> The prescribed approach, or the one guessed from the force [mm]
      real(wp), intent(out) :: approach
      !> Estimate of the derivative of the force to the approach [N/mm], 0 when there is no contact
      real(wp), intent(out) :: stiffness
      real(wp) :: closest, penetration

      contact = .false.
      approach = pen
      stiffness = 0.0_wp
      if (size(h) == 0) return
      closest = minval(h)
      if (closest >= excluded_threshold) return
      if (control == normal_control%approach) then
         penetration = pen - closest
      else if (fn <= 0.0_wp) then
         penetration = 0.0_wp
         approach = closest
      else
         if (grid%my == 1) then
            penetration = penetration_of_row(grid%dy, fn, gg, nu, radius)
         else
            penetration = penetration_of_area(grid, h, closest, fn, gg, nu)
         end if
         approach = closest + penetration
      end if
      if (penetration <= 0.0_wp) return
      contact = h - closest < contact_level*penetration .and. h < excluded_threshold
      if (grid%my == 1) then
         stiffness = row_stiffness(grid%dy, gg, nu, radius, penetration)
      else
         ! The area grows with the penetration, so the force grows like its power 3/2
         stiffness = 1.5_wp*area_stiffness(grid, gg, nu, count(contact))
      end if
   end subroutine guess_contact

   !> Penetration of a line contact [mm], a power law of the force per length
   pure function penetration_of_row(dy, fn, gg, nu, radius) result(penetration)
      !> Width of the row [mm]
      real(wp), intent(in) :: dy
      real(wp), intent(in) :: fn, gg, nu, radius
      real(wp) :: penetration

      penetration = (fn*(1.0_wp - nu)/(gg*dy*row_factor(dy, radius)))**inverse_power
   end function penetration_of_row

   !> Derivative of the force to the penetration [N/mm] for the same law
   pure function row_stiffness(dy, gg, nu, radius, penetration) result(stiffness)
      real(wp), intent(in) :: dy, gg, nu, radius, penetration
      real(wp) :: stiffness

      stiffness = row_power*gg*dy*row_factor(dy, radius)*penetration**row_excess/(1.0_wp - nu)
   end function row_stiffness

   !> Factor of the law for rows: weakly dependent on their width and on the curvature
   pure function row_factor(dy, radius) result(factor)
      real(wp), intent(in) :: dy, radius
      real(wp) :: factor
      !> Keeps the law positive for rows of any width
      real(wp), parameter :: least = 0.05_wp

      factor = row_level*max(least, row_share - row_loss*log(dy/row_width))
      if (radius > 0.0_wp) factor = factor*radius**radius_power
   end function row_factor

   !> Penetration [mm] at which the area that belongs to it carries the force
   pure function penetration_of_area(grid, h, closest, fn, gg, nu) result(penetration)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: h(:, :), closest, fn, gg, nu
      real(wp) :: penetration
      integer, parameter :: max_steps = 50
      !> Width of the bracket, as a part of the force, that is good enough
      real(wp), parameter :: good_enough = 0.01_wp
      real(wp) :: low, high, middle, force_low, force_high, force
      integer :: step

      ! One element, the least that can be in contact, carries the force at the upper end
      low = 0.0_wp
      force_low = 0.0_wp
      high = fn/area_stiffness(grid, gg, nu, 1)
      force_high = high*area_stiffness(grid, gg, nu, max(1, count(h - closest < contact_level*high)))
      do step = 1, max_steps
         if (force_high - force_low <= good_enough*fn) exit
         middle = 0.5_wp*(low + high)
         force = middle*area_stiffness(grid, gg, nu, max(1, count(h - closest < contact_level*middle)))
         if (force < fn) then
            low = middle
            force_low = force
         else
            high = middle
            force_high = force
         end if
      end do
      penetration = high
   end function penetration_of_area

   !> Force per penetration [N/mm] of a circular punch as large as n elements, reduced by a fitted factor
   pure function area_stiffness(grid, gg, nu, n) result(stiffness)
      type(potential_contact), intent(in) :: grid
      real(wp), intent(in) :: gg, nu
      integer, intent(in) :: n
      real(wp) :: stiffness

      stiffness = gg*sqrt(grid%dx*grid%dy*real(n, wp))/(0.75_wp*sqrt(pi)*(1.0_wp - nu))
   end function area_stiffness
end module contact_normal_estimate
