!> The text of a file as a whole, and hashes of texts
module contact_text_file_text
   use, intrinsic :: iso_c_binding, only : c_int
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_guard, only : expect_refusals
   use contact_base_kinds, only : long
   use contact_base_system, only : close_descriptor, open_input, read_input
   use contact_text_words, only : integer_text
   implicit none (type, external)
   private

   public :: add_to_hash, empty_hash, read_text

   !> Hash of an empty text
   integer(long), parameter :: empty_hash = 2166136261_long

contains

   !> All bytes of a file
   subroutine read_text(file, text, error, below)
      !> Path
      character(len=*), intent(in) :: file
      !> The bytes; undefined after an error
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      !> Folder below which the file must be; absent: anywhere
      character(len=*), intent(in), optional :: below
      !> Maximum file size [MB], normally and in a confined run
      integer(long), parameter :: longest = 1000, longest_confined = 100
      character(len=:), allocatable :: reason
      integer(c_int) :: descriptor
      integer :: status
      integer(long) :: length, done, allowed

      call open_input(file, descriptor, length, reason, below)
      if (allocated(reason)) then
         call fatal_error(error, "the file cannot be opened: " // reason, error_kind%file, file)
         return
      end if
      allowed = merge(longest_confined, longest, present(below))
      if (length > 1000000_long*allowed) then
         call fatal_error(error, "the file is larger than " // integer_text(int(allowed)) // " MB", error_kind%file, file)
      else
         call expect_refusals(.true.)
         allocate(character(len=length) :: text, stat=status)
         call expect_refusals(.false.)
         if (status /= 0) then
            call fatal_error(error, "not enough memory for the text of the file", error_kind%memory, file)
         else
            call read_input(descriptor, text, done, reason)
            if (allocated(reason)) then
               call fatal_error(error, "the file cannot be read: " // reason, error_kind%file, file)
            else if (done < length) then
               ! the file was shortened while it was read
               text = text(:done)
            end if
         end if
      end if
      call close_descriptor(descriptor)
   end subroutine read_text

   !> Update a hash (FNV-1a with 32 bits)
   pure subroutine add_to_hash(text, hash)
      !> Bytes to add, in order
      character(len=*), intent(in) :: text
      !> Hash so far; empty_hash at the start
      integer(long), intent(inout) :: hash
      integer(long), parameter :: prime = 16777619_long, mask = 4294967295_long
      integer :: i

      do i = 1, len(text)
         hash = iand(ieor(hash, int(iachar(text(i:i)), long))*prime, mask)
      end do
   end subroutine add_to_hash
end module contact_text_file_text
