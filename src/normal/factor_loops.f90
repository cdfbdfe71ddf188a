!> Cholesky factorisation of a small symmetric matrix, changes of its factor, and substitution with it
!>
!> The matrix is the lower triangle of an array whose first dimension may exceed the number of rows. The loops are in
!> factor_loops.c.
module contact_normal_factor_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: append_row, area_box, factorize, largest_violation, remove_row, solve_backward, solve_forward

   interface
      !> Number of elements with pressure, and the window around them
      pure subroutine area_box(mx, my, p, n, box) bind(c, name="contact_factor_box")
         import :: c_double, c_int
         !> Size of the field
         integer(c_int), value :: mx, my
         !> Pressures [N/mm2]
         real(c_double), intent(in) :: p(mx, my)
         !> Number of elements
         integer(c_int), intent(out) :: n
         !> First and last column, first and last row; a first one beyond the last one if there are none
         integer(c_int), intent(out) :: box(2, 2)
      end subroutine area_box

      !> Solve L x = b
      pure subroutine solve_forward(n, stride, lower, x) bind(c, name="contact_factor_forward")
         import :: c_double, c_int
         !> Number of rows, and first dimension of the array
         integer(c_int), value :: n, stride
         !> The factor L in its lower triangle
         real(c_double), intent(in) :: lower(stride, n)
         !> b on entry, x on exit
         real(c_double), intent(inout) :: x(n)
      end subroutine solve_forward

      !> Solve with the transpose of L
      pure subroutine solve_backward(n, stride, lower, x) bind(c, name="contact_factor_backward")
         import :: c_double, c_int
         !> Number of rows, and first dimension of the array
         integer(c_int), value :: n, stride
         !> The factor L in its lower triangle
         real(c_double), intent(in) :: lower(stride, n)
         !> Right-hand side on entry, solution on exit
         real(c_double), intent(inout) :: x(n)
      end subroutine solve_backward

      !> Factor of a positive definite matrix, in place; 0 if the matrix is not positive definite, otherwise 1
      integer(c_int) function factorize(n, stride, a, row) bind(c, name="contact_factor_factorize")
         import :: c_double, c_int
         !> Number of rows, and first dimension of the array
         integer(c_int), value :: n, stride
         !> Lower triangle of the matrix on entry, of its factor on exit
         real(c_double), intent(inout) :: a(stride, n)
         !> Workspace
         real(c_double), intent(inout) :: row(n)
      end function factorize

      !> Factor of a matrix without one of its rows and columns, in place: those behind it move up
      pure subroutine remove_row(n, removed, stride, a, v, w) bind(c, name="contact_factor_remove")
         import :: c_double, c_int
         !> Number of rows before, index of the one to be removed, and first dimension of the array
         integer(c_int), value :: n, removed, stride
         !> Lower triangle of the factor
         real(c_double), intent(inout) :: a(stride, n)
         !> Workspace
         real(c_double), intent(inout) :: v(n)
         !> Two solutions of L w = b, which become those without this row
         real(c_double), intent(inout) :: w(stride, 2)
      end subroutine remove_row

      !> Factor of a matrix with another row and column behind the others, in place; 0 if it is not positive definite, otherwise 1
      integer(c_int) function append_row(n, stride, a, row, w, b) bind(c, name="contact_factor_append")
         import :: c_double, c_int
         !> Number of rows before, and first dimension of the array
         integer(c_int), value :: n, stride
         !> Lower triangle of the factor
         real(c_double), intent(inout) :: a(stride, n + 1)
         !> Row of the matrix, the last number on its diagonal; overwritten
         real(c_double), intent(inout) :: row(n + 1)
         !> Two solutions of L w = b, which become those with this row
         real(c_double), intent(inout) :: w(stride, 2)
         !> Right-hand sides of this row
         real(c_double), intent(in) :: b(2)
      end function append_row

      !> Largest violation of the contact conditions [mm]: distance or overlap of the deformed bodies where there is pressure,
      !> overlap elsewhere
      pure real(c_double) function largest_violation(n, pen, h, u, p) bind(c, name="contact_factor_violation")
         import :: c_double, c_int
         !> Number of elements
         integer(c_int), value :: n
         !> Approach [mm]
         real(c_double), value :: pen
         !> Distance of the undeformed bodies and displacements [mm], and pressures [N/mm2]; displacements count where there is
         !> pressure, or where the undeformed bodies overlap
         real(c_double), intent(in) :: h(n), u(n), p(n)
      end function largest_violation
   end interface
end module contact_normal_factor_loops
