!> Initial estimate of tractions by a local model
!>
!> As in Kalker's simplified theory (1973), displacements are assumed proportional to the local tractions, u = L p. Without
!> slip, tractions in steady rolling increase by -W/L per element from the leading edge, and are limited by the bound; in a
!> shift the elements are independent. The flexibility L is the mean of that for tractions proportional to the bound.
module contact_tangential_local_estimate
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_tangential_problem, only : tangential_problem
   implicit none (type, external)
   private

   public :: estimate_locally

contains

   !> Tractions for given creepages
   subroutine estimate_locally(problem, operator, p, scratch)
      !> Problem with friction in at least one element
      type(tangential_problem), intent(in) :: problem
      !> Prepared for the window and the rolling direction of the problem
      class(compliance), intent(inout) :: operator
      !> Tractions [N/mm2], shape (mx, my, 2)
      real(wp), contiguous, intent(inout) :: p(:, :, :)
      !> Workspace, same shape
      real(wp), contiguous, intent(inout) :: scratch(:, :, :)
      real(wp) :: stiffness(2), q(2), length
      integer :: ix, iy, k
      !> Tractions that increase up to the trailing edge cause smaller displacements: factor from the force of full adhesion,
      !> measured
      real(wp), parameter :: growing = 2.0_wp

      do k = 1, 2
         p(:, :, k) = problem%bound
      end do
      call operator%tangential(p, scratch)
      do k = 1, 2
         stiffness(k) = sum(problem%bound**2)/sum(scratch(:, :, k)*problem%bound)
      end do
      if (problem%steady) stiffness = growing*stiffness
      do iy = 1, problem%my
         q = 0.0_wp
         do k = 1, problem%mx
            ix = merge(problem%mx + 1 - k, k, problem%direction > 0)
            if (.not. problem%steady) q = 0.0_wp
            q = q - stiffness*problem%shift(ix, iy, :)
            length = sqrt(q(1)**2 + q(2)**2)
            if (length > problem%bound(ix, iy)) q = q*(problem%bound(ix, iy)/length)
            p(ix, iy, :) = q
         end do
      end do
   end subroutine estimate_locally
end module contact_tangential_local_estimate
