!> Loops over the elements of a window for Newton's method for friction, with tractions limited by bounds
!>
!> P is the projection onto the bounds, D its derivative: D v = weight (v - direction direction.v). Fields have n elements and
!> one or two components; threads share long ones by pieces. The loops over a piece are in slip_loops.c.
module contact_tangential_slip_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use contact_base_kinds, only : wp
   use contact_numeric_pieces, only : first_of, length_of, most_pieces, pieces_of
   implicit none (type, external)
   private

   public :: join_parts, jacobian_of_projection, linearise_projection, project_change, squares, step_and_project

   interface
      !> Sums over the contact of |p - P(p - r slip)|**2 and of the bound squared [(N/mm2)2]
      pure subroutine squares_piece(n, stride, contact, bound, p, slip, r, sums) bind(c, name="contact_slip_residual")
         import :: c_double, c_int
         !> Number of elements, and numbers from one component of a field to the other
         integer(c_int), value :: n, stride
         !> Elements that count: logical values
         type(*), intent(in) :: contact(*)
         !> Traction bounds, tractions [N/mm2], slip per step [mm]
         real(c_double), intent(in) :: bound(n), p(*), slip(*)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Both sums
         real(c_double), intent(inout) :: sums(2)
      end subroutine squares_piece

      !> P(p + alpha d), 0 outside of the contact
      pure subroutine step_and_project_piece(n, stride, contact, bound, alpha, p, d, out) bind(c, name="contact_slip_step")
         import :: c_double, c_int
         !> Number of elements, and numbers from one component of a field to the other
         integer(c_int), value :: n, stride
         !> Elements that count: logical values
         type(*), intent(in) :: contact(*)
         !> Traction bounds [N/mm2]
         real(c_double), intent(in) :: bound(n)
         !> Step length
         real(c_double), value :: alpha
         !> Tractions and their change [N/mm2]
         real(c_double), intent(in) :: p(*), d(*)
         !> New tractions [N/mm2]
         real(c_double), intent(inout) :: out(*)
      end subroutine step_and_project_piece

      !> D at p - r slip, and p - P(p - r slip)
      pure subroutine linearise_projection_piece(n, stride, contact, bound, p, slip, r, weight, direction, residual) &
         & bind(c, name="contact_slip_linearise")
         import :: c_double, c_int
         !> Number of elements, and numbers from one component of a field to the other
         integer(c_int), value :: n, stride
         !> Elements that count: logical values
         type(*), intent(in) :: contact(*)
         !> Traction bounds, tractions [N/mm2], slip per step [mm]
         real(c_double), intent(in) :: bound(n), p(*), slip(*)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Weight: 1 in adhesion, 0 outside of the contact; direction: 0 in adhesion; residual [N/mm2]
         real(c_double), intent(inout) :: weight(n), direction(*), residual(*)
      end subroutine linearise_projection_piece

      !> v := D v
      pure subroutine project_change_piece(n, stride, weight, direction, v) bind(c, name="contact_slip_project")
         import :: c_double, c_int
         !> Number of elements, and numbers from one component of a field to the other
         integer(c_int), value :: n, stride
         !> D
         real(c_double), intent(in) :: weight(n), direction(*)
         !> Any field
         real(c_double), intent(inout) :: v(*)
      end subroutine project_change_piece

      !> dp - D(dp - r (change + creep))
      pure subroutine jacobian_of_projection_piece(n, stride, weight, direction, dp, change, r, creep, out) &
         & bind(c, name="contact_slip_jacobian")
         import :: c_double, c_int
         !> Number of elements, and numbers from one component of a field to the other
         integer(c_int), value :: n, stride
         !> D; changes of tractions [N/mm2], and of the slip by them [mm]
         real(c_double), intent(in) :: weight(n), direction(*), dp(*), change(*)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Constant change of the slip [mm]
         real(c_double), intent(in) :: creep(2)
         !> The result [N/mm2]
         real(c_double), intent(inout) :: out(*)
      end subroutine jacobian_of_projection_piece

      !> u := D u / r + v - projected
      pure subroutine join_parts_piece(n, stride, weight, direction, v, projected, r, u) bind(c, name="contact_slip_join")
         import :: c_double, c_int
         !> Number of elements, and numbers from one component of a field to the other
         integer(c_int), value :: n, stride
         !> D; a field, and the part of it that D leaves
         real(c_double), intent(in) :: weight(n), direction(*), v(*), projected(*)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Any field on entry, the joined one on exit
         real(c_double), intent(inout) :: u(*)
      end subroutine join_parts_piece
   end interface

contains

   !> Sums over the contact of |p - P(p - r slip)|**2 and of the bound squared [(N/mm2)2]
   subroutine squares(n, contact, bound, p, slip, r, sums)
      !> Number of elements
      integer, intent(in) :: n
      !> Elements that count
      logical, intent(in) :: contact(n)
      !> Traction bounds, tractions [N/mm2], slip per step [mm]
      real(wp), intent(in) :: bound(n), p(n, 2), slip(n, 2)
      !> Scale of the slip [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> Both sums
      real(wp), intent(inout) :: sums(2)
      real(wp) :: part(2, most_pieces)
      integer :: k

      if (pieces_of(n) == 1) then
         call squares_piece(n, n, contact, bound, p, slip, r, sums)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call squares_piece(length_of(n, k), n, contact(i), bound(i), p(i, 1), slip(i, 1), r, part(:, k))
         end associate
      end do
      !$omp end parallel do
      sums = sum(part(:, :pieces_of(n)), dim=2)
   end subroutine squares

   !> P(p + alpha d), 0 outside of the contact
   subroutine step_and_project(n, contact, bound, alpha, p, d, out)
      !> Number of elements
      integer, intent(in) :: n
      !> Elements that count
      logical, intent(in) :: contact(n)
      !> Traction bounds [N/mm2]
      real(wp), intent(in) :: bound(n)
      !> Length of the step
      real(wp), intent(in) :: alpha
      !> Tractions and their change [N/mm2]
      real(wp), intent(in) :: p(n, 2), d(n, 2)
      !> New tractions [N/mm2]
      real(wp), intent(inout) :: out(n, 2)
      integer :: k

      if (pieces_of(n) == 1) then
         call step_and_project_piece(n, n, contact, bound, alpha, p, d, out)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call step_and_project_piece(length_of(n, k), n, contact(i), bound(i), alpha, p(i, 1), d(i, 1), out(i, 1))
         end associate
      end do
      !$omp end parallel do
   end subroutine step_and_project

   !> D at p - r slip, and p - P(p - r slip)
   subroutine linearise_projection(n, contact, bound, p, slip, r, weight, direction, residual)
      !> Number of elements
      integer, intent(in) :: n
      !> Elements that count
      logical, intent(in) :: contact(n)
      !> Traction bounds, tractions [N/mm2], slip per step [mm]
      real(wp), intent(in) :: bound(n), p(n, 2), slip(n, 2)
      !> Scale of the slip [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> Weight: 1 in adhesion, 0 outside of the contact; direction: 0 in adhesion; residual [N/mm2]
      real(wp), intent(inout) :: weight(n), direction(n, 2), residual(n, 2)
      integer :: k

      if (pieces_of(n) == 1) then
         call linearise_projection_piece(n, n, contact, bound, p, slip, r, weight, direction, residual)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call linearise_projection_piece(length_of(n, k), n, contact(i), bound(i), p(i, 1), slip(i, 1), r, weight(i), &
               & direction(i, 1), residual(i, 1))
         end associate
      end do
      !$omp end parallel do
   end subroutine linearise_projection

   !> v := D v
   subroutine project_change(n, weight, direction, v)
      !> Number of elements
      integer, intent(in) :: n
      !> D
      real(wp), intent(in) :: weight(n), direction(n, 2)
      !> Any field
      real(wp), intent(inout) :: v(n, 2)
      integer :: k

      if (pieces_of(n) == 1) then
         call project_change_piece(n, n, weight, direction, v)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call project_change_piece(length_of(n, k), n, weight(i), direction(i, 1), v(i, 1))
         end associate
      end do
      !$omp end parallel do
   end subroutine project_change

   !> dp - D(dp - r (change + creep))
   subroutine jacobian_of_projection(n, weight, direction, dp, change, r, creep, out)
      !> Number of elements
      integer, intent(in) :: n
      !> D; changes of tractions [N/mm2], and of the slip by them [mm]
      real(wp), intent(in) :: weight(n), direction(n, 2), dp(n, 2), change(n, 2)
      !> Scale of the slip [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> The same change of the slip in all elements [mm]
      real(wp), intent(in) :: creep(2)
      !> The result [N/mm2]
      real(wp), intent(inout) :: out(n, 2)
      integer :: k

      if (pieces_of(n) == 1) then
         call jacobian_of_projection_piece(n, n, weight, direction, dp, change, r, creep, out)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call jacobian_of_projection_piece(length_of(n, k), n, weight(i), direction(i, 1), dp(i, 1), change(i, 1), r, creep, &
               & out(i, 1))
         end associate
      end do
      !$omp end parallel do
   end subroutine jacobian_of_projection

   !> u := D u / r + v - projected
   subroutine join_parts(n, weight, direction, v, projected, r, u)
      !> Number of elements
      integer, intent(in) :: n
      !> D; a field, and the part of it that D leaves
      real(wp), intent(in) :: weight(n), direction(n, 2), v(n, 2), projected(n, 2)
      !> Scale of the slip [(N/mm2)/mm]
      real(wp), intent(in) :: r
      !> Any field on entry, the joined one on exit
      real(wp), intent(inout) :: u(n, 2)
      integer :: k

      if (pieces_of(n) == 1) then
         call join_parts_piece(n, n, weight, direction, v, projected, r, u)
         return
      end if
      !$omp parallel do
      do k = 1, pieces_of(n)
         associate (i => first_of(n, k))
            call join_parts_piece(length_of(n, k), n, weight(i), direction(i, 1), v(i, 1), projected(i, 1), r, u(i, 1))
         end associate
      end do
      !$omp end parallel do
   end subroutine join_parts
end module contact_tangential_slip_loops
