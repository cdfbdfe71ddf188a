!> Loops over the elements of a window between two products of conjugate gradients
!>
!> Each of them passes memory once. Fields come as vectors of n elements. The loops are in gradient_loops.c.
module contact_normal_gradient_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: choose_free, go_along, mean_gap, mean_of_free, project, residuals, turn_direction

   interface
      !> Mean of the distances after deformation, over elements with pressure; 0 where there is none
      pure real(c_double) function mean_gap(n, h, u, p) bind(c, name="contact_gradient_mean_gap")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Undeformed distances, displacements [mm], and pressures [N/mm2]
         real(c_double), intent(in) :: h(n), u(n), p(n)
      end function mean_gap

      !> Residuals pen - h - u, without what is negative where there is no pressure; the largest violation of the contact
      !> conditions, which is no number if one of them is
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

      !> Elements that have pressure or want it, and may have it; the residual becomes 0 in the others
      pure subroutine choose_free(n, p, h, highest, free, r) bind(c, name="contact_gradient_choose_free")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Pressures [N/mm2], undeformed distances [mm]
         real(c_double), intent(in) :: p(n), h(n)
         !> Distance below which contact is possible [mm]
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

      !> A field less its mean, and 0 where an element is not free; inner products of what it becomes
      pure subroutine project(n, free, mean, v, r, s, products) bind(c, name="contact_gradient_project")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> 1 where an element is free, 0 elsewhere
         real(c_double), intent(in) :: free(n)
         !> Mean that is taken away; 0 for none
         real(c_double), value :: mean
         !> The field
         real(c_double), intent(inout) :: v(n)
         !> What it is multiplied with
         real(c_double), intent(in) :: r(n), s(n)
         !> Products with r and s
         real(c_double), intent(inout) :: products(2)
      end subroutine project

      !> The next direction before it is projected, d := z + beta d; the residual becomes the previous one
      pure subroutine turn_direction(n, beta, z, r, d, previous) bind(c, name="contact_gradient_turn")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Share of the direction before
         real(c_double), value :: beta
         !> Preconditioned residual, and residual
         real(c_double), intent(in) :: z(n), r(n)
         !> Direction, and the previous residual
         real(c_double), intent(inout) :: d(n), previous(n)
      end subroutine turn_direction

      !> p := p + alpha d, but what falls below zero is cut off; the lowest value before that, or 0
      real(c_double) function go_along(n, alpha, d, p) bind(c, name="contact_gradient_go_along")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Length of the step
         real(c_double), value :: alpha
         !> Direction
         real(c_double), intent(in) :: d(n)
         !> Pressures [N/mm2]
         real(c_double), intent(inout) :: p(n)
      end function go_along
   end interface
end module contact_normal_gradient_loops
