!> Work that may run out of memory without harm to the process; see guard.c
module contact_base_guard
   use, intrinsic :: iso_c_binding, only : c_funloc, c_funptr, c_int, c_ptr
   implicit none (type, external)
   private

   public :: do_guarded, end_text, expect_refusals, free_left_blocks, guard_end, guarded_work, new_owner, set_owner

   type :: guard_end_list
      !> The work was done
      integer :: done = 0
      !> It was left for want of memory
      integer :: no_memory = 1
      !> A run-time library would have ended the process; most often for want of memory, too
      integer :: gave_up = 2
   end type guard_end_list
   !> How guarded work ended
   type(guard_end_list), parameter :: guard_end = guard_end_list()

   abstract interface
      !> Work under a guard
      subroutine guarded_work(data) bind(c)
         import :: c_ptr
         !> What it works on
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

   !> Do a piece of work that is left where it is when there is no memory for it
   !>
   !> What it was changing then is in no defined state: it must not be read, assigned to or deallocated any more, and
   !> blocks of memory that belong to the owner are freed by `free_left_blocks`.
   subroutine do_guarded(work, data, owner, cause)
      !> What is done under the guard
      procedure(guarded_work) :: work
      !> Handed to the work
      type(c_ptr), intent(in) :: data
      !> Of the blocks that it allocates, from `new_owner`; 0: as before
      integer, intent(in) :: owner
      !> Member of guard_end
      integer, intent(out) :: cause

      cause = int(contact_guard(c_funloc(work), data, int(owner, c_int)))
   end subroutine do_guarded

   !> Why guarded work was left, with blanks behind
   pure function end_text(cause) result(text)
      !> Member of guard_end
      integer, intent(in) :: cause
      character(len=64) :: text

      text = "there is not enough memory"
      if (cause == guard_end%gave_up) text = "a run-time library gave up, most likely for want of memory"
   end function end_text

   !> A number for an owner of blocks of memory
   integer function new_owner()
      new_owner = int(contact_guard_new_owner())
   end function new_owner

   !> Larger blocks that this thread allocates from now on belong to an owner, 0 for none
   subroutine set_owner(owner)
      !> From `new_owner`
      integer, intent(in) :: owner
      call contact_guard_set_owner(int(owner, c_int))
   end subroutine set_owner

   !> Free the larger blocks of an owner whose work was left; nobody may use them any more
   subroutine free_left_blocks(owner)
      !> The one that was given to `do_guarded`
      integer, intent(in) :: owner
      call contact_guard_free(int(owner, c_int))
   end subroutine free_left_blocks

   !> Does the code that follows ask with `stat` whether its memory was had? Then it is not left
   subroutine expect_refusals(expected)
      !> From now on: true where the code looks at `stat` itself, false behind it
      logical, intent(in) :: expected
      call contact_guard_expect(merge(1_c_int, 0_c_int, expected))
   end subroutine expect_refusals
end module contact_base_guard
