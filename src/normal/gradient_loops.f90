!> Loops over the elements of a window, used by conjugate gradients between two products
!>
!> Each loop reads memory once. Fields are passed as vectors of n elements. The loops are in gradient_loops.c.
module contact_normal_gradient_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: choose_free, go_along, mean_gap, mean_of_free, project, residuals, turn_direction

   interface
      !> Mean of the deformed distance over elements with pressure; 0 if there are none
      pure real(c_double) function mean_gap(n, h, u, p) bind(c, name="contact_gradient_mean_gap")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Undeformed distances, displacements [mm], and pressures [N/mm2]
         real(c_double), intent(in) :: h(n), u(n), p(n)
      end function mean_gap

      !> Residuals pen - h - u, set to zero where negative without pressure; returns the largest violation of the contact
      !> conditions, NaN if one of them is NaN
      real(c_double) function residuals(n, pen, h, u, p, r) bind(c, name="contact_gradient_residuals")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Approach [mm]
         real(c_double), value :: pen
         !> Undeformed distances, displacements [mm], and pressures [N/mm2]
         real(c_double), intent(in) :: h(n), u(n), p(n)
         !> Residuals [mm]
         real(c_double), intent(inout) :: r(n)
      end function residuals

      !> Select the elements that have pressure or overlap, and where contact is possible; the residual is set to 0 in the
      !> others
      pure subroutine choose_free(n, p, h, highest, free, r) bind(c, name="contact_gradient_choose_free")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Pressures [N/mm2], undeformed distances [mm]
         real(c_double), intent(in) :: p(n), h(n)
         !> Upper limit of the distance for possible contact [mm]
         real(c_double), value :: highest
         !> 1 where an element is free, 0 elsewhere
         real(c_double), intent(inout) :: free(n)
         !> Residuals [mm]
         real(c_double), intent(inout) :: r(n)
      end subroutine choose_free

      !> Mean of a field over the free elements
      pure real(c_double) function mean_of_free(n, free, v) bind(c, name="contact_gradient_mean")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> 1 where an element is free, 0 elsewhere; the field
         real(c_double), intent(in) :: free(n), v(n)
      end function mean_of_free

      !> Subtract the mean from a field and set it to 0 in elements that are not free; compute inner products of the result
      pure subroutine project(n, free, mean, v, r, s, products) bind(c, name="contact_gradient_project")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> 1 where an element is free, 0 elsewhere
         real(c_double), intent(in) :: free(n)
         !> Mean to subtract; 0: none
         real(c_double), value :: mean
         !> Field to project
         real(c_double), intent(inout) :: v(n)
         !> Fields for the inner products
         real(c_double), intent(in) :: r(n), s(n)
         !> Products with r and s
         real(c_double), intent(inout) :: products(2)
      end subroutine project

      !> The next direction before projection, d := z + beta d; the residual is saved as the previous one
      pure subroutine turn_direction(n, beta, z, r, d, previous) bind(c, name="contact_gradient_turn")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Weight of the previous direction
         real(c_double), value :: beta
         !> Preconditioned residual, and residual
         real(c_double), intent(in) :: z(n), r(n)
         !> Direction, and the previous residual
         real(c_double), intent(inout) :: d(n), previous(n)
      end subroutine turn_direction

      !> p := max(0, p + alpha d); returns the smallest value before the limit, or 0
      real(c_double) function go_along(n, alpha, d, p) bind(c, name="contact_gradient_go_along")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Step length
         real(c_double), value :: alpha
         !> Direction
         real(c_double), intent(in) :: d(n)
         !> Pressures [N/mm2]
         real(c_double), intent(inout) :: p(n)
      end function go_along
   end interface
end module contact_normal_gradient_loops
