!> Derivative of the pressures with respect to the approach, at a solution of the normal problem
!>
!> On the contact area the pressures satisfy A p = pen - h, so that their derivative q for a fixed area satisfies A q = 1, and
!> dFn/dpen is dx dy times the sum of q. Elements that come into contact have zero pressure and contribute nothing to first
!> order. (The sum of q is the most accurate quantity: its error is quadratic in that of q.)
module contact_normal_stiffness
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_normal_parts, only : contact_parts, displacement_between
   implicit none (type, external)
   private

   public :: pressure_derivative

contains

   !> Solve A q = 1 on the contact area by preconditioned conjugate gradients
   subroutine pressure_derivative(operator, parts, contact, tolerance, max_iterations, q, reached, from_estimate)
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Parts with reduced interaction; unallocated: full interaction
      type(contact_parts), allocatable, intent(in) :: parts
      !> Elements in contact, shape (mx, my)
      logical, contiguous, intent(in) :: contact(:, :)
      !> Tolerance of the residual relative to 1, root mean square over the contact area
      real(wp), intent(in) :: tolerance
      !> Maximum number of iterations; the best solution so far is then returned
      integer, intent(in) :: max_iterations
      !> Derivative of the pressures [N/mm3], zero outside the contact area
      real(wp), contiguous, intent(inout) :: q(:, :)
      !> Residual
      real(wp), intent(out) :: reached
      !> Is q an estimate on entry? Default: no
      logical, intent(in), optional :: from_estimate
      real(wp), allocatable :: r(:, :), z(:, :), d(:, :), u(:, :)
      real(wp) :: rz, previous, curvature, start
      integer :: k
      logical :: has_estimate

      has_estimate = .false.
      if (present(from_estimate)) has_estimate = from_estimate
      if (has_estimate) then
         where (.not. contact) q = 0.0_wp
      else
         q = 0.0_wp
      end if
      reached = 0.0_wp
      if (.not. any(contact)) return
      allocate(r(size(q, 1), size(q, 2)), z(size(q, 1), size(q, 2)), d(size(q, 1), size(q, 2)), u(size(q, 1), size(q, 2)))
      r = merge(1.0_wp, 0.0_wp, contact)
      start = norm2(r)
      reached = 1.0_wp
      if (has_estimate) then
         call displacement_between(parts, operator, q, u)
         ! the sum of q is accurate to second order if the residual is orthogonal to it
         curvature = sum(q*u)
         rz = 0.0_wp
         if (curvature > 0.0_wp) rz = sum(q)/curvature
         q = rz*q
         r = merge(r - rz*u, 0.0_wp, contact)
         reached = norm2(r)/start
         if (reached <= tolerance) return
      end if
      previous = 0.0_wp
      do k = 1, max_iterations
         call operator%normal_inverse(r, z)
         where (.not. contact) z = 0.0_wp
         rz = sum(r*z)
         if (.not. rz > 0.0_wp) exit
         if (k == 1) then
            d = z
         else
            d = z + (rz/previous)*d
         end if
         previous = rz
         call displacement_between(parts, operator, d, u)
         curvature = sum(d*u)
         if (.not. curvature > 0.0_wp) exit
         q = q + (rz/curvature)*d
         r = r - (rz/curvature)*u
         where (.not. contact) r = 0.0_wp
         reached = norm2(r)/start
         if (reached <= tolerance) exit
      end do
   end subroutine pressure_derivative
end module contact_normal_stiffness
