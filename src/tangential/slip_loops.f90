!> Loops over the elements of a window for Newton's method for friction, with tractions limited by bounds
!>
!> P is the projection onto the bounds, D its derivative: D v = weight (v - direction direction.v). Fields have n elements and
!> one or two components. The loops are in slip_loops.c.
module contact_tangential_slip_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: join_parts, jacobian_of_projection, linearise_projection, project_change, squares, step_and_project

   interface
      !> Sums over the contact of |p - P(p - r slip)|**2 and of the bound squared [(N/mm2)2]
      pure subroutine squares(n, contact, bound, p, slip, r, sums) bind(c, name="contact_slip_residual")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Elements in contact, as logicals
         type(*), intent(in) :: contact(*)
         !> Traction bounds, tractions [N/mm2], slip per step [mm]
         real(c_double), intent(in) :: bound(n), p(n, 2), slip(n, 2)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Both sums
         real(c_double), intent(inout) :: sums(2)
      end subroutine squares

      !> P(p + alpha d), 0 outside the contact
      pure subroutine step_and_project(n, contact, bound, alpha, p, d, out) bind(c, name="contact_slip_step")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Elements in contact, as logicals
         type(*), intent(in) :: contact(*)
         !> Traction bounds [N/mm2]
         real(c_double), intent(in) :: bound(n)
         !> Step length
         real(c_double), value :: alpha
         !> Tractions and their change [N/mm2]
         real(c_double), intent(in) :: p(n, 2), d(n, 2)
         !> New tractions [N/mm2]
         real(c_double), intent(inout) :: out(n, 2)
      end subroutine step_and_project

      !> D at p - r slip, and p - P(p - r slip)
      pure subroutine linearise_projection(n, contact, bound, p, slip, r, weight, direction, residual) &
         & bind(c, name="contact_slip_linearise")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Elements in contact, as logicals
         type(*), intent(in) :: contact(*)
         !> Traction bounds, tractions [N/mm2], slip per step [mm]
         real(c_double), intent(in) :: bound(n), p(n, 2), slip(n, 2)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Weight: 1 in adhesion, 0 outside the contact; direction: 0 in adhesion; residual [N/mm2]
         real(c_double), intent(inout) :: weight(n), direction(n, 2), residual(n, 2)
      end subroutine linearise_projection

      !> v := D v
      pure subroutine project_change(n, weight, direction, v) bind(c, name="contact_slip_project")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> D
         real(c_double), intent(in) :: weight(n), direction(n, 2)
         !> Field to project
         real(c_double), intent(inout) :: v(n, 2)
      end subroutine project_change

      !> dp - D(dp - r (change + creep))
      pure subroutine jacobian_of_projection(n, weight, direction, dp, change, r, creep, out) bind(c, name="contact_slip_jacobian")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> D; changes of tractions [N/mm2], and corresponding changes of the slip [mm]
         real(c_double), intent(in) :: weight(n), direction(n, 2), dp(n, 2), change(n, 2)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> Constant change of the slip [mm]
         real(c_double), intent(in) :: creep(2)
         !> Result [N/mm2]
         real(c_double), intent(inout) :: out(n, 2)
      end subroutine jacobian_of_projection

      !> u := D u / r + v - projected
      pure subroutine join_parts(n, weight, direction, v, projected, r, u) bind(c, name="contact_slip_join")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> D; a field, and its projection by D
         real(c_double), intent(in) :: weight(n), direction(n, 2), v(n, 2), projected(n, 2)
         !> Scale of the slip [(N/mm2)/mm]
         real(c_double), value :: r
         !> On entry a field, on exit the result
         real(c_double), intent(inout) :: u(n, 2)
      end subroutine join_parts
   end interface
end module contact_tangential_slip_loops
