!> Forces of a table for creepages that are read: study_table_f TABLE < "FN MU GG AA BNEG BPOS", then creepages
program look_up_forces
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_int, c_null_char, c_ptr
   use, intrinsic :: iso_fortran_env, only : error_unit
   use contact_table, only : contact_table_close, contact_table_force, contact_table_inside, contact_table_open, &
      & contact_table_patch
   implicit none (type, external)
   character(len=500) :: file
   character(kind=c_char) :: message(500)
   type(contact_table_patch) :: patch
   type(c_ptr) :: table
   real(c_double) :: creepage(3), force(3)
   integer(c_int) :: answer
   integer :: status

   call get_command_argument(1, file)
   table = contact_table_open(trim(file) // c_null_char, message, size(message, kind=c_int))
   if (.not. c_associated(table)) then
      write(error_unit, "(*(A))") message
      error stop
   end if
   read(*, *) patch%fn, patch%mu, patch%gg, patch%aa, patch%bneg, patch%bpos
   do
      read(*, *, iostat=status) creepage
      if (status /= 0) exit
      answer = contact_table_force(table, patch, creepage, force)
      if (answer /= contact_table_inside) error stop
      write(*, "(3es25.16e3)") force
   end do
   call contact_table_close(table)
end program look_up_forces
