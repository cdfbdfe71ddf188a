!> A file that is diverted to memory is not written to any more, although it is still open
program test_diverted_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_size_t
   use contact_base_kinds, only : long
   use contact_base_system, only : close_descriptor, divert_to_memory, open_output
   use contact_test_harness, only : test_suite
   implicit none (type, external)
   interface
      function write_bytes(file, text, length) result(done) bind(c, name="write")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: file
         integer(c_size_t), value :: length
         character(kind=c_char), intent(in) :: text(length)
         !> Number of bytes, -1 for a failure
         integer(c_size_t) :: done
      end function write_bytes
   end interface
   character(len=*), parameter :: name = "diverted.txt", full = "/dev/full"
   type(test_suite) :: suite
   character(len=:), allocatable :: reason
   integer(c_int) :: file
   integer(long) :: bytes
   logical :: has_full

   call suite%start("diverted_file")
   call open_output(name, .false., file, reason)
   call suite%check(.not. allocated(reason), "the file is open")
   call suite%equal(int(write_bytes(file, "before", 6_c_size_t)), 6, "bytes before")
   call divert_to_memory(file)
   call suite%equal(int(write_bytes(file, "and after", 9_c_size_t)), 9, "bytes after")
   call close_descriptor(file)
   inquire(file=name, size=bytes)
   call suite%equal(int(bytes), 6, "only the first ones are in the file")

   inquire(file=full, exist=has_full)
   if (has_full) then
      call open_output(full, .false., file, reason)
      call suite%equal(int(write_bytes(file, "x", 1_c_size_t)), -1, "a full disk")
      call divert_to_memory(file)
      call suite%equal(int(write_bytes(file, "x", 1_c_size_t)), 1, "does not refuse them any more")
      call close_descriptor(file)
   else
      call suite%skip("a full disk", "there is no " // full)
   end if
   call suite%finish()
end program test_diverted_file
