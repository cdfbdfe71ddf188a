!> Is there memory for what comes? Asked before large problems, so that they are refused and nobody is ended by them
module contact_base_memory
   use, intrinsic :: iso_fortran_env, only : int8
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_guard, only : expect_refusals
   use contact_base_kinds, only : long
   implicit none (type, external)
   private

   public :: require_memory, bytes_per_element

   !> What a contact problem takes at its largest: about 1200 bytes per element were measured for homogeneous, 1400 for
   !> dissimilar bodies
   integer(long), parameter :: bytes_per_element = 1500_long
   !> Below this nobody asks; it is had where anything can be computed
   integer(long), parameter :: little = 100000000_long

contains

   !> Refuse a problem when the system does not give the memory it needs
   !>
   !> The memory is asked for at once and given back. Systems that promise more than they have still refuse what cannot be.
   subroutine require_memory(number, bytes_each, what, error)
      !> Number of things, bytes for each of them
      integer(long), intent(in) :: number, bytes_each
      !> What they are, for the message
      character(len=*), intent(in) :: what
      !> Allocated when the system refuses; names what needs how much
      type(error_type), allocatable, intent(out) :: error
      ! a compiler may take an allocation for granted that is not used
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
      write(text, "(I0, 3A, I0, A)") number, " ", what, " need about ", number*bytes_each/1000000_long, &
         & " MB of memory, which is not there"
      call fatal_error(error, trim(text), kind=error_kind%memory)
   end subroutine require_memory
end module contact_base_memory
