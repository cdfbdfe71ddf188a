!> Blocks of memory released by the calculations of an owner, kept for its next one; see kept_blocks.c
module contact_base_kept_blocks
   use, intrinsic :: iso_c_binding, only : c_associated, c_null_ptr, c_ptr
   implicit none (type, external)
   private

   public :: kept_blocks

   !> The kept blocks of an owner; not to be copied
   type :: kept_blocks
      type(c_ptr), private :: place = c_null_ptr
   contains
      !> This thread allocates its blocks from here, and releases them to here, until `stop_using`
      procedure :: use_them
      !> This thread uses the heap again
      procedure, nopass :: stop_using
      !> The same as `use_them` between calculations; nothing before the second one
      procedure :: use_again
      !> Release all blocks to the heap
      procedure :: release
   end type kept_blocks

   interface
      function contact_kept_new() result(place) bind(c, name="contact_kept_new")
         import :: c_ptr
         type(c_ptr) :: place
      end function contact_kept_new

      subroutine contact_kept_free(place) bind(c, name="contact_kept_free")
         import :: c_ptr
         type(c_ptr), value :: place
      end subroutine contact_kept_free

      subroutine contact_guard_use_blocks(place) bind(c, name="contact_guard_use_blocks")
         import :: c_ptr
         type(c_ptr), value :: place
      end subroutine contact_guard_use_blocks

      subroutine contact_guard_use_blocks_again(place) bind(c, name="contact_guard_use_blocks_again")
         import :: c_ptr
         type(c_ptr), value :: place
      end subroutine contact_guard_use_blocks_again
   end interface

contains

   subroutine use_them(self)
      class(kept_blocks), intent(inout) :: self

      if (.not. c_associated(self%place)) self%place = contact_kept_new()
      call contact_guard_use_blocks(self%place)
   end subroutine use_them

   subroutine use_again(self)
      class(kept_blocks), intent(in) :: self

      call contact_guard_use_blocks_again(self%place)
   end subroutine use_again

   subroutine stop_using()
      call contact_guard_use_blocks(c_null_ptr)
   end subroutine stop_using

   subroutine release(self)
      class(kept_blocks), intent(inout) :: self

      call contact_kept_free(self%place)
      self%place = c_null_ptr
   end subroutine release
end module contact_base_kept_blocks
