!> Estimates of pressures and tractions for the next case of a loop over time
module contact_patch_extrapolation
   use contact_base_kinds, only : wp
   use contact_grid_potential_contact, only : is_same_side
   use contact_patch_problem, only : patch_state, traction_fields
   implicit none (type, external)
   private

   public :: extrapolate

contains

   !> Extrapolate the solution of the last case from those of the last two cases
   !>
   !> Both are on grids that move with the contact. Elements that were not in contact in the last case remain so.
   subroutine extrapolate(state, ahead)
      !> On entry the solution of the last case on the grid of this one, and of the case before on its own grid; on exit the
      !> estimate, and the solution of the last case
      type(patch_state), intent(inout) :: state
      !> Multiple of the difference of the two solutions that is added [-]
      real(wp), intent(in) :: ahead
      type(traction_fields) :: old
      integer :: ix, iy, jx, jy, kx, ky
      real(wp) :: before(3)
      logical :: is_known

      is_known = state%earlier%grid%mx > 0
      if (is_known) is_known = is_same_side(state%now%grid%dx, state%earlier%grid%dx) &
         & .and. is_same_side(state%now%grid%dy, state%earlier%grid%dy)
      old%grid = state%earlier%grid
      old%pen = state%earlier%pen
      call move_alloc(state%earlier%pn, old%pn)
      call move_alloc(state%earlier%px, old%px)
      call move_alloc(state%earlier%py, old%py)
      state%earlier%grid = state%now%grid
      state%earlier%pen = state%now%pen
      state%earlier%pn = state%now%pn
      state%earlier%px = state%now%px
      state%earlier%py = state%now%py
      if (.not. is_known) return
      kx = nint((state%now%grid%xl - old%grid%xl)/old%grid%dx)
      ky = nint((state%now%grid%yl - old%grid%yl)/old%grid%dy)
      associate (now => state%now)
         now%pen = now%pen + ahead*(now%pen - old%pen)
         do iy = 1, now%grid%my
            jy = iy + ky
            do ix = 1, now%grid%mx
               if (.not. now%pn(ix, iy) > 0.0_wp) cycle
               jx = ix + kx
               before = 0.0_wp
               if (min(jx, jy) >= 1 .and. jx <= old%grid%mx .and. jy <= old%grid%my) &
                  & before = [old%pn(jx, jy), old%px(jx, jy), old%py(jx, jy)]
               now%pn(ix, iy) = max(0.0_wp, now%pn(ix, iy) + ahead*(now%pn(ix, iy) - before(1)))
               now%px(ix, iy) = now%px(ix, iy) + ahead*(now%px(ix, iy) - before(2))
               now%py(ix, iy) = now%py(ix, iy) + ahead*(now%py(ix, iy) - before(3))
            end do
         end do
      end associate
   end subroutine extrapolate
end module contact_patch_extrapolation
