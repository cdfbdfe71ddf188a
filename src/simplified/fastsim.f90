!> Kalker's algorithm Fastsim: tangential tractions on a Winkler foundation, in one sweep from the leading edge
!>
!> With u = L p and the slip per step S = u - u' + W, where u' is the displacement of the same particle one step before: adhesion if
!> |p| <= g, otherwise |p| = g opposite to the slip. The trial traction for zero slip, (u' - W)/L, is scaled back to the bound
!> (Kalker 1982). First order in the step.
module contact_simplified_fastsim
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element, set_states
   use contact_numeric_vectors, only : clear_numbers
   implicit none (type, external)
   private

   public :: march_fastsim, step_fastsim

   !> Number of rows that are processed together, so that their square roots and divisions overlap
   integer, parameter :: rows_at_once = 16

contains

   !> Steady rolling, one element per step, through each row from the leading edge
   !>
   !> A particle that was outside the contact area one step before has zero displacement.
   pure subroutine march_fastsim(contact, bound, shift, flx, direction, p, slip, division)
      !> Elements in contact, shape (mx, my)
      logical, contiguous, intent(in) :: contact(:, :)
      !> Traction bound [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: bound(:, :)
      !> Rigid slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: shift(:, :, :)
      !> Flexibility along x and y [mm3/N]
      real(wp), intent(in) :: flx(2)
      !> Rolling towards increasing (+1) or decreasing (-1) x
      integer, intent(in) :: direction
      !> Tractions [N/mm2], slip per step [mm], both of shape (mx, my, 2); element states
      real(wp), contiguous, intent(inout) :: p(:, :, :), slip(:, :, :)
      !> Element states, shape (mx, my)
      integer, contiguous, intent(inout) :: division(:, :)
      real(wp), dimension(rows_at_once) :: ux, uy
      integer :: mx, my, first, last, ix, iy, k, start, finish

      call clear_numbers(size(p), p)
      call clear_numbers(size(slip), slip)
      call set_states(size(division), element%exterior, division)
      mx = size(contact, 1)
      my = size(contact, 2)
      start = merge(mx, 1, direction > 0)
      finish = merge(1, mx, direction > 0)
      do first = 1, my, rows_at_once
         last = min(first + rows_at_once - 1, my)
         ux = 0.0_wp
         uy = 0.0_wp
         do ix = start, finish, -direction
            do iy = first, last
               k = iy - first + 1
               if (contact(ix, iy)) then
                  call touch(bound(ix, iy), shift(ix, iy, 1), shift(ix, iy, 2), flx, ux(k), uy(k), p(ix, iy, 1), &
                     & p(ix, iy, 2), slip(ix, iy, 1), slip(ix, iy, 2), division(ix, iy))
               else
                  ux(k) = 0.0_wp
                  uy(k) = 0.0_wp
               end if
            end do
         end do
      end do
   end subroutine march_fastsim

   !> One time step, from the tractions of the same particles one step before
   !>
   !> The previous displacements are computed with the present flexibilities, so that without motion nothing changes.
   pure subroutine step_fastsim(contact, bound, shift, flx, before, p, slip, division)
      !> Elements in contact, shape (mx, my)
      logical, contiguous, intent(in) :: contact(:, :)
      !> Traction bound [N/mm2], shape (mx, my), and rigid slip per step [mm], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: bound(:, :), shift(:, :, :)
      !> Flexibility along x and y [mm3/N]
      real(wp), intent(in) :: flx(2)
      !> Tractions one step before [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(in) :: before(:, :, :)
      !> Tractions [N/mm2] and slip per step [mm], both of shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: p(:, :, :), slip(:, :, :)
      !> Element states, shape (mx, my)
      integer, contiguous, intent(inout) :: division(:, :)
      real(wp) :: ux, uy
      integer :: ix, iy

      p = 0.0_wp
      slip = 0.0_wp
      division = element%exterior
      do iy = 1, size(contact, 2)
         do ix = 1, size(contact, 1)
            if (.not. contact(ix, iy)) cycle
            ux = flx(1)*before(ix, iy, 1)
            uy = flx(2)*before(ix, iy, 2)
            call touch(bound(ix, iy), shift(ix, iy, 1), shift(ix, iy, 2), flx, ux, uy, p(ix, iy, 1), p(ix, iy, 2), &
               & slip(ix, iy, 1), slip(ix, iy, 2), division(ix, iy))
         end do
      end do
   end subroutine step_fastsim

   !> One element in contact: adhesion, or slip with the traction on the bound
   pure subroutine touch(bound, wx, wy, flx, ux, uy, px, py, sx, sy, state)
      real(wp), intent(in) :: bound, wx, wy, flx(2)
      !> Displacement [mm]: one step before on entry, present on exit
      real(wp), intent(inout) :: ux, uy
      real(wp), intent(inout) :: px, py, sx, sy
      integer, intent(inout) :: state
      !> Largest length of a vector whose square cannot overflow
      real(wp), parameter :: too_long = 1.0e150_wp
      real(wp) :: tx, ty, length, largest

      tx = ux - wx
      ty = uy - wy
      px = tx/flx(1)
      py = ty/flx(2)
      length = sqrt(px**2 + py**2)
      ux = tx
      uy = ty
      sx = 0.0_wp
      sy = 0.0_wp
      state = element%adhesion
      if (length <= bound) return
      state = element%slip
      if (.not. length < too_long) then
         largest = max(abs(tx), abs(ty))
         px = (tx/largest)/flx(1)
         py = (ty/largest)/flx(2)
         length = sqrt(px**2 + py**2)
      end if
      px = px*(bound/length)
      py = py*(bound/length)
      ux = flx(1)*px
      uy = flx(2)*py
      sx = ux - tx
      sy = uy - ty
   end subroutine touch
end module contact_simplified_fastsim
