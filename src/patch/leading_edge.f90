!> Correction of slip for elements that entered the contact area during the step
!>
!> If the step of rolling is longer than an element, particles next to the leading edge were outside the contact area at the
!> previous time. They slip during the fraction of the step after they passed the edge, and their displacement is relative to that
!> at the edge: S = share (W + dq c) + u - u_edge. The edge is at the centre of the first exterior element, where u_edge is the
!> displacement by the previous tractions in transient rolling, by the present ones in steady rolling.
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

   !> Shares from this value on are regarded as 1
   real(wp), parameter :: whole_step = 0.9999_wp

contains

   !> Correct the fixed part of the slip in elements that entered the contact area during the step
   subroutine correct_leading_edge(problem, state, box, result, workspace, log)
      !> Motion, steps and grid
      type(patch_problem), intent(in) :: problem
      !> Its present time step has the contact area
      type(patch_state), intent(in) :: state
      !> Part of the grid that the tangential problem covers
      type(bounding_box), intent(in) :: box
      !> Rigid slip per step
      type(patch_result), intent(in) :: result
      !> Tangential problem with its rigid slip, and displacements by previous tractions at the edge; shares and edges are set
      type(patch_workspace), intent(inout) :: workspace
      !> Receives a message from flow-trace level 3 on if rows are left out
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
            ! contact reaches the border of the grid: the edge is not known
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
