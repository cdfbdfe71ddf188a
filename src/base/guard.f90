!> Work that may run out of memory without ending the process; see guard.c
module contact_base_guard
   use, intrinsic :: iso_c_binding, only : c_funloc, c_funptr, c_int, c_ptr
   implicit none (type, external)
   private

   public :: cause_text, do_guarded, expect_refusals, free_left_blocks, guard_end, guarded_work, new_owner, set_owner

   type :: guard_end_list
      !> The work was done
      integer :: done = 0
      !> It was abandoned for lack of memory
      integer :: no_memory = 1
      !> A run-time library would have ended the process, mostly also for lack of memory
      integer :: gave_up = 2
   end type guard_end_list
   !> How guarded work ended
   type(guard_end_list), parameter :: guard_end = guard_end_list()

   abstract interface
      !> Work under a guard
      subroutine guarded_work(data) bind(c)
         import :: c_ptr
         !> Data of the work
         type(c_ptr), value :: data
      end subroutine guarded_work
   end interface

   interface
      function contact_guard(work, data, owner) result(cause) bind(c, name="contact_guard")
         import :: c_funptr, c_int, c_ptr
         type(c_funptr), value :: work
         type(c_ptr), value :: data
         integer(c_int), value :: owner
         integer(c_int) :: cause
      end function contact_guard

      function contact_guard_new_owner() result(owner) bind(c, name="contact_guard_new_owner")
         import :: c_int
         integer(c_int) :: owner
      end function contact_guard_new_owner

      subroutine contact_guard_set_owner(owner) bind(c, name="contact_guard_set_owner")
         import :: c_int
         integer(c_int), value :: owner
      end subroutine contact_guard_set_owner

      subroutine contact_guard_free(owner) bind(c, name="contact_guard_free")
         import :: c_int
         integer(c_int), value :: owner
      end subroutine contact_guard_free

      subroutine contact_guard_expect(refusals) bind(c, name="contact_guard_expect")
         import :: c_int
         integer(c_int), value :: refusals
      end subroutine contact_guard_expect
   end interface

contains

   !> Run work that is abandoned if there is not enough memory for it
   !>
   !> Data that abandoned work was changing is in an undefined state: it must not be read, assigned to or deallocated.
   !> `free_left_blocks` frees the memory blocks of its owner.
   subroutine do_guarded(work, data, owner, cause)
      !> Work to run under the guard
      procedure(guarded_work) :: work
      !> Passed to the work
      type(c_ptr), intent(in) :: data
      !> Owner of the blocks that the work allocates, from `new_owner`; 0: unchanged
      integer, intent(in) :: owner
      !> Member of guard_end
      integer, intent(out) :: cause

      cause = int(contact_guard(c_funloc(work), data, int(owner, c_int)))
   end subroutine do_guarded

   !> Why guarded work was abandoned, padded with blanks
   pure function cause_text(cause) result(text)
      !> Member of guard_end
      integer, intent(in) :: cause
      character(len=64) :: text

      text = "there is not enough memory"
      if (cause == guard_end%gave_up) text = "a run-time library failed, most likely for lack of memory"
   end function cause_text

   !> A new identifier for an owner of memory blocks
   integer function new_owner()
      new_owner = int(contact_guard_new_owner())
   end function new_owner

   !> Set the owner of the larger blocks that this thread allocates from now on; 0 for none
   subroutine set_owner(owner)
      !> From `new_owner`
      integer, intent(in) :: owner
      call contact_guard_set_owner(int(owner, c_int))
   end subroutine set_owner

   !> Free the larger blocks of an owner whose work was abandoned; they must not be used any more
   subroutine free_left_blocks(owner)
      !> Owner that was passed to `do_guarded`
      integer, intent(in) :: owner
      call contact_guard_free(int(owner, c_int))
   end subroutine free_left_blocks

   !> Does the code that follows check `stat` of its allocations? Then a failed one does not abandon the work
   subroutine expect_refusals(expected)
      !> True before code that checks `stat`, false after it
      logical, intent(in) :: expected
      call contact_guard_expect(merge(1_c_int, 0_c_int, expected))
   end subroutine expect_refusals
end module contact_base_guard
