!> Normal pressures in closed form
module contact_normal_estimate
   use contact_base_constants, only : pi
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : potential_contact
   implicit none (type, external)
   private

   public :: elliptic_pressure, parabolic_pressure, sdec_pressure

   !> Peak of a parabolic pressure on a line contact, relative to the force divided by semi-axis times half length: 3/8 by
   !> integration
   real(wp), parameter :: parabola_peak = 0.375_wp

contains

   !> Hertz's pressure, a semi-ellipsoid, at the centres of the elements
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

   !> Parabolic pressure on the same area, the traction bound of simplified theory
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

   !> Pressure of the simple double-elliptical contact: two half ellipses joined at their longest row
   pure subroutine sdec_pressure(grid, aa, bneg, bpos, fn, pn)
      !> Centres of the elements
      type(potential_contact), intent(in) :: grid
      !> Semi-axis along x, extents towards negative and positive y from the longest row [mm]
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

   !> Multiply by force/(aa bb); zero for an empty area or negative force
   pure subroutine scale_pressure(force, aa, bb, pn)
      real(wp), intent(in) :: force, aa, bb
      real(wp), intent(inout) :: pn(:, :)

      if (aa <= 0.0_wp .or. bb <= 0.0_wp) return
      pn = pn*(max(0.0_wp, force)/aa/bb)
   end subroutine scale_pressure
end module contact_normal_estimate
