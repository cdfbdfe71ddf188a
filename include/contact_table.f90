!> Creep forces from tables, for Fortran: compile this file with your program, and link with -lcontact; see include/contact.h
module contact_table
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_ptr
   implicit none (type, external)
   private

   public :: contact_table_open, contact_table_close, contact_table_force, contact_table_force_derivatives

   !> Results of a look-up: inside; outside of the shapes of the table, replaced by those at its border; an input is not a number
   integer(c_int), parameter, public :: contact_table_inside = 0, contact_table_outside = 1, contact_table_wrong = 2

   !> A contact. Units are free but consistent: N, mm, N/mm2 and 1/mm, or N, m, N/m2 and 1/m
   type, bind(c), public :: contact_table_patch
      !> Normal force, coefficient of friction, modulus of rigidity
      real(c_double) :: fn, mu, gg
      !> Semi-axis along x, extents towards negative and positive y, equal in an ellipse
      real(c_double) :: aa, bneg, bpos
   end type contact_table_patch

   interface
      !> Read a table; the result is null if it cannot be used. Texts end with c_null_char
      function contact_table_open(file, message, message_length) result(table) bind(c)
         import :: c_char, c_int, c_ptr
         character(kind=c_char), intent(in) :: file(*)
         character(kind=c_char), intent(out) :: message(*)
         integer(c_int), value :: message_length
         type(c_ptr) :: table
      end function contact_table_open

      !> Free a table
      subroutine contact_table_close(table) bind(c)
         import :: c_ptr
         type(c_ptr), value :: table
      end subroutine contact_table_close

      !> Fx, Fy, Mz on body 1 for longitudinal and lateral creepage and spin
      function contact_table_force(table, patch, creepage, force) result(answer) bind(c)
         import :: c_double, c_int, c_ptr, contact_table_patch
         type(c_ptr), value :: table
         type(contact_table_patch), intent(in) :: patch
         real(c_double), intent(in) :: creepage(3)
         real(c_double), intent(out) :: force(3)
         integer(c_int) :: answer
      end function contact_table_force

      !> The same with derivatives(j, i) of force i by creepage j
      function contact_table_force_derivatives(table, patch, creepage, force, derivatives) result(answer) bind(c)
         import :: c_double, c_int, c_ptr, contact_table_patch
         type(c_ptr), value :: table
         type(contact_table_patch), intent(in) :: patch
         real(c_double), intent(in) :: creepage(3)
         real(c_double), intent(out) :: force(3), derivatives(3, 3)
         integer(c_int) :: answer
      end function contact_table_force_derivatives
   end interface
end module contact_table
