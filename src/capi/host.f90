!> What the library asks the process that it lives in; see host.c
module contact_capi_host
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_null_char, c_ptr, c_size_t
   implicit none (type, external)
   private

   public :: begin_turn, call_stage, end_turn, find_call, find_current_folder, give_floats_back, hold_floats, is_forked, &
      & note_call

   type :: call_stage_list
      !> Outside of all problems, counted as a user of one, alone in it, counted as a calculation
      integer(c_int) :: outside = 0, user = 1, inside = 2, calculation = 3
   end type call_stage_list
   !> How far a thread is inside a problem
   type(call_stage_list), parameter :: call_stage = call_stage_list()

   !> Letters of the longest name of a folder
   integer, parameter :: longest_path = 4096

   interface
      !> No floating point operation traps until the settings of the host are given back
      subroutine hold_floats() bind(c, name="contact_hold_floats")
      end subroutine hold_floats

      subroutine give_floats_back() bind(c, name="contact_give_floats_back")
      end subroutine give_floats_back

      !> Wait for the turn of this thread to calculate
      subroutine begin_turn(most) bind(c, name="contact_begin_turn")
         import :: c_int
         !> Calculations that may run at the same time
         integer(c_int), value :: most
      end subroutine begin_turn

      subroutine end_turn() bind(c, name="contact_end_turn")
      end subroutine end_turn

      !> Remember the problem that this thread is inside
      subroutine note_call(problem, stage) bind(c, name="contact_note_call")
         import :: c_int, c_ptr
         !> Null outside of all problems
         type(c_ptr), value :: problem
         !> Member of call_stage
         integer(c_int), value :: stage
      end subroutine note_call

      !> What was remembered of this thread
      subroutine find_call(problem, stage) bind(c, name="contact_find_call")
         import :: c_int, c_ptr
         !> Null when the thread is in no call
         type(c_ptr), intent(out) :: problem
         !> How far the call has come, as remember_call was told
         integer(c_int), intent(out) :: stage
      end subroutine find_call

      function is_child() result(answer) bind(c, name="contact_is_child")
         import :: c_int
         integer(c_int) :: answer
      end function is_child

      function getcwd(buffer, length) result(answer) bind(c, name="getcwd")
         import :: c_char, c_ptr, c_size_t
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: length
         type(c_ptr) :: answer
      end function getcwd
   end interface

contains

   !> Is this process a fork of one that had the library? Only the forking thread is in it.
   logical function is_forked()
      is_forked = is_child() /= 0
   end function is_forked

   !> The current folder; "." when the system does not tell it
   subroutine find_current_folder(folder)
      !> Absolute, as the system has it
      character(len=:), allocatable, intent(out) :: folder
      character(kind=c_char) :: letters(longest_path)
      integer :: i

      folder = "."
      if (.not. c_associated(getcwd(letters, int(longest_path, c_size_t)))) return
      folder = ""
      do i = 1, longest_path
         if (letters(i) == c_null_char) exit
         folder = folder // letters(i)
      end do
   end subroutine find_current_folder
end module contact_capi_host
