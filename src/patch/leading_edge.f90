!> Elements that entered the contact area during the step
!>
!> When the step of rolling is longer than an element, particles next to the leading edge were still outside the
!> contact a step ago. They slip during the part of the step since they passed the edge, and what
!> they have been displaced by is counted from there: S = share (W + dq c) + u - u_edge. The edge is at the centre of
!> the first exterior element, where u_edge is the displacement by the previous tractions in transient rolling, by
!> the present ones in steady rolling.
module contact_patch_leading_edge
   use contact_base_kinds, only : wp
   use contact_base_log, only : log_type
   use contact_grid_element_division, only : bounding_box, element
   use contact_patch_problem, only : patch_problem, patch_state, rolling_direction
   use contact_patch_result, only : patch_result
   use contact_patch_workspace, only : patch_workspace
   implicit none (type, external)
   private

   public :: correct_leading_edge

   !> Shares above this count as 1
   real(wp), parameter :: whole_step = 0.9999_wp

contains

   !> Change the fixed part of the slip where elements entered late
   subroutine correct_leading_edge(problem, state, box, result, workspace, log)
      !> Motion, steps and grid
      type(patch_problem), intent(in) :: problem
      !> now: the present contact area
      type(patch_state), intent(in) :: state
      !> Part of the grid of the tangential problem
      type(bounding_box), intent(in) :: box
      !> Rigid slip per step
      type(patch_result), intent(in) :: result
      !> Tangential problem with its shift; displacements at the edge by previous tractions are known. Gets shares and edges
      type(patch_workspace), intent(inout) :: workspace
      !> Told from flow-trace level 3 on which rows are left out
      type(log_type), intent(inout) :: log
      real(wp) :: share
      integer :: iy, k, ix, edge, hidden
      character(len=12) :: text

      associate (t => workspace%tangential)
         workspace%share = 1.0_wp
         if (t%steady) allocate(t%edge(t%mx, t%my), source=0)
      end associate
      hidden = 0
      do iy = box%iy0, box%iy1
         edge = 0
         if (state%now%division(merge(problem%grid%mx, 1, rolling_direction(problem) > 0), iy) > element%exterior) &
            & hidden = hidden + 1
         do k = 1, problem%grid%mx
            ix = merge(problem%grid%mx + 1 - k, k, rolling_direction(problem) > 0)
            if (state%now%division(ix, iy) == element%exterior) then
               edge = ix
               cycle
            end if
            ! contact up to the border of the grid: nothing is known about the edge
            if (edge == 0) cycle
            share = abs(ix - edge)*problem%grid%dx/problem%dq
            if (share >= whole_step) cycle
            associate (t => workspace%tangential, jx => ix - box%ix0 + 1, jy => iy - box%iy0 + 1)
               workspace%share(jx, jy) = share
               t%shift(jx, jy, :) = share*[result%wx(ix, iy), result%wy(ix, iy)]
               if (t%steady) then
                  t%edge(jx, jy) = abs(ix - edge)
               else
                  t%shift(jx, jy, :) = t%shift(jx, jy, :) - workspace%edge_displacement(edge, iy, :)
               end if
            end associate
         end do
      end do
      if (problem%n_forces > 0) workspace%tangential%share = workspace%share
      if (hidden == 0) return
      write(text, "(I0)") hidden
      call log%trace(3, "      Tang: contact up to the border of the grid, no leading-edge correction in rows : " // trim(text))
   end subroutine correct_leading_edge
end module contact_patch_leading_edge
