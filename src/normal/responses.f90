!> Derivatives of the pressures with respect to changes of the distance of the bodies, at a solution of the normal problem
!>
!> On the contact area A p = pen - h. For a fixed area pressures change by q with A q = d(pen - h). The systems of several
!> inputs share their conjugate search directions: each one starts from the best combination of the existing ones, and smooth
!> changes of the distance have most directions in common.
module contact_normal_responses
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_normal_few_elements, only : area_factor
   use contact_normal_parts, only : contact_parts, displacement_between
   implicit none (type, external)
   private

   public :: pressure_responses

   !> Maximum number of stored search directions
   integer, parameter :: most_kept = 60

contains

   !> Solve A q = displacement on the contact area for several displacements
   subroutine pressure_responses(operator, factor, parts, p, displacement, tolerance, max_iterations, response, reached)
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Possibly the factor of the contact area
      type(area_factor), intent(inout) :: factor
      !> Parts with reduced interaction; unallocated: full interaction
      type(contact_parts), allocatable, intent(in) :: parts
      !> Pressures of the solution [N/mm2], shape (mx, my); positive in contact
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Changes of pen - h [mm per unit], shape (mx, my, cases)
      real(wp), contiguous, intent(in) :: displacement(:, :, :)
      !> Tolerance of the residuals relative to the displacements, root mean square over the contact area
      real(wp), intent(in) :: tolerance
      !> Maximum number of products per displacement
      integer, intent(in) :: max_iterations
      !> Changes of the pressures [N/mm2 per unit], zero outside the contact area; same shape as `displacement`
      real(wp), contiguous, intent(inout) :: response(:, :, :)
      !> Largest relative residual
      real(wp), intent(out) :: reached
      real(wp), allocatable :: d(:, :), u(:, :), q(:), r(:), field(:, :), image(:, :)
      real(wp) :: curvature(most_kept), start, share
      logical, allocatable :: contact(:, :)
      logical :: found
      integer :: i, j, k, kept, n

      reached = 0.0_wp
      found = .false.
      if (.not. allocated(parts)) call factor%pressure_responses(operator, p, displacement, response, found)
      if (found) return
      contact = p > 0.0_wp
      n = count(contact)
      response = 0.0_wp
      if (n == 0) return
      allocate(d(n, most_kept), u(n, most_kept), field(size(p, 1), size(p, 2)), image(size(p, 1), size(p, 2)))
      kept = 0
      do j = 1, size(displacement, 3)
         r = pack(displacement(:, :, j), contact)
         start = norm2(r)
         if (.not. start > 0.0_wp) cycle
         allocate(q(n), source=0.0_wp)
         do i = 1, kept
            share = dot_product(d(:, i), r)/curvature(i)
            q = q + share*d(:, i)
            r = r - share*u(:, i)
         end do
         do k = 1, max_iterations
            if (norm2(r) <= tolerance*start) exit
            if (kept == most_kept) kept = 0
            field = unpack(r, contact, 0.0_wp)
            call operator%normal_inverse(field, image)
            kept = kept + 1
            d(:, kept) = pack(image, contact)
            do i = 1, kept - 1
               d(:, kept) = d(:, kept) - (dot_product(u(:, i), d(:, kept))/curvature(i))*d(:, i)
            end do
            field = unpack(d(:, kept), contact, 0.0_wp)
            call displacement_between(parts, operator, field, image)
            u(:, kept) = pack(image, contact)
            curvature(kept) = dot_product(d(:, kept), u(:, kept))
            if (.not. curvature(kept) > 0.0_wp) then
               kept = kept - 1
               exit
            end if
            share = dot_product(d(:, kept), r)/curvature(kept)
            q = q + share*d(:, kept)
            r = r - share*u(:, kept)
         end do
         reached = max(reached, norm2(r)/start)
         response(:, :, j) = unpack(q, contact, 0.0_wp)
         deallocate(q)
      end do
   end subroutine pressure_responses
end module contact_normal_responses
