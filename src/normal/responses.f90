!> Derivatives of the pressures with respect to changes of the distance of the bodies, at a solution of the normal problem
!>
!> On the contact area A p = pen - h. While the area is kept, pressures change by q with A q = d(pen - h). The systems of
!> several inputs are solved together: search directions are conjugate to each other and serve all of them. Two systems, those
!> with the largest residuals, give two directions at a time, which are transformed as one complex field.
module contact_normal_responses
   use contact_base_kinds, only : wp
   use contact_elastic_compliance, only : compliance
   use contact_elastic_operator, only : normal_inverse_of_two, normal_of_two
   use contact_normal_parts, only : contact_parts, displacement_between
   use contact_numeric_vectors, only : add, add_four, inner, inner_four
   implicit none (type, external)
   private

   public :: pressure_responses

   !> Maximum number of stored search directions
   integer, parameter :: most_kept = 60
   !> A direction of which conjugation to the other of its pair leaves less than this part of its energy is dropped; chosen
   real(wp), parameter :: dependent = 1.0e-6_wp

   !> Elements in contact, search directions and their displacements
   type :: direction_store
      !> Column and row of each element, shape (2, elements)
      integer, allocatable :: place(:, :)
      !> Directions that are in use
      integer :: kept = 0
      !> Directions and their displacements, shape (elements, most_kept)
      real(wp), allocatable :: d(:, :), u(:, :)
      !> Products of both, shape (most_kept)
      real(wp), allocatable :: energy(:)
      !> Two fields on the window and their images, shape (mx, my, 2)
      real(wp), allocatable :: field(:, :, :), image(:, :, :)
   end type direction_store

contains

   !> Solve A q = displacement on the contact area for several displacements
   subroutine pressure_responses(operator, parts, p, displacement, tolerance, max_directions, response, reached)
      !> Prepared for the window
      class(compliance), intent(inout) :: operator
      !> Parts that act on each other with less than full strength; unallocated: everything acts fully
      type(contact_parts), allocatable, intent(in) :: parts
      !> Pressures of the solution [N/mm2], shape (mx, my); positive in contact
      real(wp), contiguous, intent(in) :: p(:, :)
      !> Changes of pen - h [mm per unit], shape (mx, my, cases)
      real(wp), contiguous, intent(in) :: displacement(:, :, :)
      !> Tolerance of the residuals relative to the displacements, root mean square over the contact area
      real(wp), intent(in) :: tolerance
      !> Search directions for one displacement at most
      integer, intent(in) :: max_directions
      !> Changes of the pressures [N/mm2 per unit], zero outside the contact area; of the shape of `displacement`
      real(wp), contiguous, intent(inout) :: response(:, :, :)
      !> Largest relative residual
      real(wp), intent(out) :: reached
      type(direction_store) :: store
      real(wp), allocatable :: q(:, :), r(:, :), start(:), now(:)
      integer :: cases, j, k, n, old, pair(2), step

      reached = 0.0_wp
      response = 0.0_wp
      call note_contact(p, store)
      n = size(store%place, 2)
      cases = size(displacement, 3)
      if (n == 0) return
      allocate(store%d(n, most_kept), store%u(n, most_kept), store%energy(most_kept))
      allocate(store%field(size(p, 1), size(p, 2), 2), store%image(size(p, 1), size(p, 2), 2), source=0.0_wp)
      allocate(q(n, cases), source=0.0_wp)
      allocate(r(n, cases), start(cases), now(cases))
      do j = 1, cases
         call gather(store%place, displacement(:, :, j), r(:, j))
         start(j) = norm2(r(:, j))
         now(j) = merge(1.0_wp, 0.0_wp, start(j) > 0.0_wp)
      end do
      do step = 1, max_directions*cases
         pair(1) = maxloc(now, dim=1)
         if (.not. now(pair(1)) > tolerance) exit
         pair(2) = next_largest(now, pair(1))
         old = store%kept
         if (old + 2 > most_kept) old = 0
         store%kept = old
         call add_directions(operator, parts, r, pair, store)
         if (store%kept == old) exit
         do j = 1, cases
            if (.not. start(j) > 0.0_wp) cycle
            do k = old + 1, store%kept
               associate (share => inner(n, store%d(:, k), r(:, j))/store%energy(k))
                  call add(n, share, store%d(:, k), q(:, j))
                  call add(n, -share, store%u(:, k), r(:, j))
               end associate
            end do
            now(j) = sqrt(inner(n, r(:, j), r(:, j)))/start(j)
         end do
      end do
      reached = maxval(now)
      do j = 1, cases
         call spread_out(store%place, q(:, j), response(:, :, j))
      end do
   end subroutine pressure_responses

   !> Positions of the elements with pressure
   subroutine note_contact(p, store)
      !> [N/mm2], shape (mx, my)
      real(wp), contiguous, intent(in) :: p(:, :)
      type(direction_store), intent(inout) :: store
      integer :: ix, iy, n

      allocate(store%place(2, count(p > 0.0_wp)))
      n = 0
      do iy = 1, size(p, 2)
         do ix = 1, size(p, 1)
            if (.not. p(ix, iy) > 0.0_wp) cycle
            n = n + 1
            store%place(:, n) = [ix, iy]
         end do
      end do
   end subroutine note_contact

   !> Values of a field at positions
   pure subroutine gather(place, field, v)
      !> Column and row, shape (2, n)
      integer, contiguous, intent(in) :: place(:, :)
      !> Shape (mx, my)
      real(wp), contiguous, intent(in) :: field(:, :)
      !> Shape (n)
      real(wp), contiguous, intent(inout) :: v(:)
      integer :: k

      do k = 1, size(place, 2)
         v(k) = field(place(1, k), place(2, k))
      end do
   end subroutine gather

   !> Store values at positions in a field
   pure subroutine spread_out(place, v, field)
      !> Column and row, shape (2, n)
      integer, contiguous, intent(in) :: place(:, :)
      !> Shape (n)
      real(wp), contiguous, intent(in) :: v(:)
      !> Shape (mx, my); other elements stay what they are
      real(wp), contiguous, intent(inout) :: field(:, :)
      integer :: k

      do k = 1, size(place, 2)
         field(place(1, k), place(2, k)) = v(k)
      end do
   end subroutine spread_out

   !> The system with the largest residual but one, 0 if there is none
   pure integer function next_largest(residual, largest) result(next)
      real(wp), intent(in) :: residual(:)
      !> The first one
      integer, intent(in) :: largest
      integer :: j

      next = 0
      do j = 1, size(residual)
         if (j == largest .or. .not. residual(j) > 0.0_wp) cycle
         if (next > 0) then
            if (residual(j) <= residual(next)) cycle
         end if
         next = j
      end do
   end function next_largest

   !> Directions from the residuals of one or two systems, conjugate to those that are kept and to each other
   subroutine add_directions(operator, parts, r, systems, store)
      class(compliance), intent(inout) :: operator
      type(contact_parts), allocatable, intent(in) :: parts
      !> Residuals, shape (elements, cases)
      real(wp), contiguous, intent(in) :: r(:, :)
      !> Numbers of the systems, the second one 0 for one system only
      integer, intent(in) :: systems(2)
      type(direction_store), intent(inout) :: store
      real(wp) :: before, share
      integer :: i, k, n, number

      n = size(r, 1)
      number = merge(2, 1, systems(2) > 0)
      associate (d => store%d, u => store%u, energy => store%energy)
         ! outside of the contact both fields are zero
         if (number == 1) store%field(:, :, 2) = 0.0_wp
         do i = 1, number
            call spread_out(store%place, r(:, systems(i)), store%field(:, :, i))
         end do
         call normal_inverse_of_two(operator, store%field, store%image)
         do i = 1, number
            k = store%kept + i
            call gather(store%place, store%image(:, :, i), d(:, k))
            call make_conjugate(n, store%kept, u, energy, d, k)
            call spread_out(store%place, d(:, k), store%field(:, :, i))
         end do
         if (allocated(parts)) then
            do i = 1, number
               call displacement_between(parts, operator, store%field(:, :, i), store%image(:, :, i))
            end do
         else
            call normal_of_two(operator, store%field, store%image)
         end if
         do i = 1, number
            call gather(store%place, store%image(:, :, i), u(:, store%kept + i))
         end do
         k = store%kept + 1
         energy(k) = inner(n, d(:, k), u(:, k))
         if (.not. energy(k) > 0.0_wp) return
         store%kept = k
         if (number == 1) return
         before = inner(n, d(:, k + 1), u(:, k + 1))
         share = inner(n, u(:, k), d(:, k + 1))/energy(k)
         call add(n, -share, d(:, k), d(:, k + 1))
         call add(n, -share, u(:, k), u(:, k + 1))
         energy(k + 1) = inner(n, d(:, k + 1), u(:, k + 1))
         if (energy(k + 1) > dependent*before) store%kept = k + 1
      end associate
   end subroutine add_directions

   !> Take off a direction what is not conjugate to the first ones
   subroutine make_conjugate(n, kept, u, energy, d, k)
      !> Elements, and number of directions before
      integer, intent(in) :: n, kept
      !> Their displacements, and products of both
      real(wp), contiguous, intent(in) :: u(:, :), energy(:)
      !> All directions, and which one is changed
      real(wp), contiguous, intent(inout) :: d(:, :)
      integer, intent(in) :: k
      real(wp) :: share(4)
      integer :: i

      do i = 1, kept - 3, 4
         call inner_four(n, n, u(:, i:i + 3), d(:, k), share)
         call add_four(n, n, -share/energy(i:i + 3), d(:, i:i + 3), d(:, k))
      end do
      do i = 4*(kept/4) + 1, kept
         call add(n, -inner(n, u(:, i), d(:, k))/energy(i), d(:, i), d(:, k))
      end do
   end subroutine make_conjugate
end module contact_normal_responses
