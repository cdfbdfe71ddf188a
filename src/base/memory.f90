!> Check of available memory, made before large problems so that they are refused instead of ending the process
module contact_base_memory
   use, intrinsic :: iso_fortran_env, only : int8
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_guard, only : expect_refusals
   use contact_base_kinds, only : long, wp
   implicit none (type, external)
   private

   public :: require_memory, bytes_per_element, megabytes_text

   !> Upper estimate of the memory of a contact problem: about 1200 bytes per element were measured for bodies of the same
   !> material, 1400 for dissimilar bodies
   integer(long), parameter :: bytes_per_element = 1500_long
   !> Smaller problems are not checked; they fit on any system
   integer(long), parameter :: little = 100000000_long

contains

   !> Refuse a problem if the system does not provide the memory it needs
   !>
   !> The memory is requested in one piece and returned. Systems that overcommit memory still refuse impossible requests.
   subroutine require_memory(number, bytes_each, what, error)
      !> Number of items, and memory per item [bytes]
      integer(long), intent(in) :: number, bytes_each
      !> Name of the items, for the message
      character(len=*), intent(in) :: what
      !> Allocated if the system refuses; contains the required memory
      type(error_type), allocatable, intent(out) :: error
      ! volatile, as a compiler may skip an allocation whose memory is not used
      integer(int8), allocatable, volatile :: probe(:)
      character(len=120) :: text
      integer :: status

      if (number <= little/bytes_each) return
      call expect_refusals(.true.)
      allocate(probe(number*bytes_each), stat=status)
      call expect_refusals(.false.)
      if (status == 0) then
         probe(1) = 0_int8
         deallocate(probe)
         return
      end if
      write(text, "(I0, 5A)") number, " ", what, " need about ", trim(megabytes_text(number*bytes_each)), &
         & " of memory, which is not available"
      call fatal_error(error, trim(text), kind=error_kind%memory)
   end subroutine require_memory

   !> A size in words, such as "12 MB", with trailing blanks; below 10 MB with decimals
   pure function megabytes_text(bytes) result(text)
      !> Size [bytes]
      integer(long), intent(in) :: bytes
      character(len=28) :: text
      character(len=24) :: number

      if (bytes >= 10000000_long) then
         write(number, "(I0)") bytes/1000000_long
      else
         write(number, "(F8.6)") real(bytes, wp)/1.0e6_wp
         number = number(:verify(trim(number), "0", back=.true.))
         if (number(len_trim(number):) == ".") number = number(:len_trim(number) - 1)
      end if
      text = trim(number) // " MB"
   end function megabytes_text
end module contact_base_memory
