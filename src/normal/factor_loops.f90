!> Cholesky factorisation of a small symmetric matrix, and substitution with its factor
!>
!> The matrix is the lower triangle of an array whose first dimension may exceed the number of rows. The loops are in
!> factor_loops.c.
module contact_normal_factor_loops
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   implicit none (type, external)
   private

   public :: factorize, solve_backward, solve_forward

   interface
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
      integer(c_int) function factorize(n, first, stride, a, row) bind(c, name="contact_factor_factorize")
         import :: c_double, c_int
         !> Number of rows, number of leading columns that already belong to the factor, and first dimension of the array
         integer(c_int), value :: n, first, stride
         !> Lower triangle of the matrix on entry, of its factor on exit
         real(c_double), intent(inout) :: a(stride, n)
         !> Workspace
         real(c_double), intent(inout) :: row(n)
      end function factorize
   end interface
end module contact_normal_factor_loops
