!> Error of forces in full sliding by the first order in steady rolling, with its sign, from a single solution
!>
!> Tractions in sliding are the pressures times the coefficient of friction, in the direction of slip, so the error of first order
!> is that of this direction. The scheme takes the elastic slip half a step ahead of the element, and the rigid slip at an offset
!> of its own. See doc/theory/errors.md.
module contact_patch_sliding_errors
   use contact_base_kinds, only : wp
   use contact_grid_element_division, only : element
   use contact_patch_order, only : spin_offset_of
   use contact_patch_problem, only : patch_problem, rolling_direction
   use contact_patch_result, only : patch_result
   implicit none (type, external)
   private

   public :: find_direction_errors

   !> The elastic slip is a difference over a step, thus the slip at this offset [steps]
   real(wp), parameter :: middle = 0.5_wp
   !> Largest error of the slip over the slip for which its direction is resolved; near a pole of the slip it is not, and errors of
   !> opposite elements cancel; a single element may otherwise turn by half a circle (wheel 12 of seed 99301). Chosen
   real(wp), parameter :: resolved_turn = 0.5_wp

contains

   !> Error of first order of FX, FY and MZ on body 1, the computed less the exact ones, and the part that is not resolved
   pure subroutine find_direction_errors(problem, result, e, unresolved)
      !> The problem that was solved by the first order, steady rolling in full sliding
      type(patch_problem), intent(in) :: problem
      !> Solved
      type(patch_result), intent(in) :: result
      !> Errors [N, N, N mm]
      real(wp), intent(out) :: e(3)
      !> Fraction of the traction bound carried by elements whose direction of slip is not resolved [-]
      real(wp), intent(out) :: unresolved
      real(wp) :: slip(2), exact(2), change(2), offset, bound
      integer :: ix, iy, ahead, behind, direction

      e = 0.0_wp
      unresolved = 0.0_wp
      direction = rolling_direction(problem)
      offset = spin_offset_of(problem, result%tangential)
      do iy = 1, result%grid%my
         do ix = 1, result%grid%mx
            if (result%division(ix, iy) /= element%slip) cycle
            ! differences along the rolling direction; at an edge of the contact to the element inside
            ahead = neighbour(ix + direction)
            behind = neighbour(ix - direction)
            if (ahead == behind) cycle
            ! elastic and rigid slip, each with its offset
            change(1) = middle*(result%sx(ahead, iy) - result%sx(behind, iy)) &
               & + (offset - middle)*(result%wx(ahead, iy) - result%wx(behind, iy))
            change(2) = middle*(result%sy(ahead, iy) - result%sy(behind, iy)) &
               & + (offset - middle)*(result%wy(ahead, iy) - result%wy(behind, iy))
            change = change*result%dq/(result%grid%dx*abs(ahead - behind))
            slip = [result%sx(ix, iy), result%sy(ix, iy)]
            bound = result%mu(ix, iy)*result%pn(ix, iy)
            if (.not. resolved_turn*norm2(slip) > norm2(change)) then
               unresolved = unresolved + bound
               cycle
            end if
            exact = slip - change
            ! tractions oppose the slip
            change = bound*(exact/norm2(exact) - slip/norm2(slip))
            e = e + [change, result%grid%x(ix)*change(2) - result%grid%y(iy)*change(1)]
         end do
      end do
      e = result%grid%dx*result%grid%dy*e
      unresolved = unresolved/max(sum(result%mu*result%pn), tiny(unresolved))

   contains

      !> An element of the same row, or the present one if that does not slip
      pure integer function neighbour(jx)
         integer, intent(in) :: jx

         neighbour = ix
         if (jx < 1 .or. jx > result%grid%mx) return
         if (result%division(jx, iy) == element%slip) neighbour = jx
      end function neighbour
   end subroutine find_direction_errors
end module contact_patch_sliding_errors
