!> Services of the process in which the library runs; see host.c
module contact_capi_host
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_null_char, c_ptr, c_size_t
   implicit none (type, external)
   private

   public :: begin_turn, call_stage, end_turn, find_call, find_current_folder, give_floats_back, hold_floats, is_forked, &
      & note_call

   type :: call_stage_list
      !> Outside of all problems; registered as a user of one; inside it, holding its lock; registered as a calculation
      integer(c_int) :: outside = 0, user = 1, inside = 2, calculation = 3
   end type call_stage_list
   !> Stages of a thread in a problem
   type(call_stage_list), parameter :: call_stage = call_stage_list()

   !> Maximum length of the name of a folder
   integer, parameter :: longest_path = 4096

   interface
      !> Disable floating point traps until the settings of the host are restored
      subroutine hold_floats() bind(c, name="contact_hold_floats")
      end subroutine hold_floats

      subroutine give_floats_back() bind(c, name="contact_give_floats_back")
      end subroutine give_floats_back

      !> Wait until this thread may calculate
      subroutine begin_turn(most) bind(c, name="contact_begin_turn")
         import :: c_int
         !> Maximum number of simultaneous calculations
         integer(c_int), value :: most
      end subroutine begin_turn

      subroutine end_turn() bind(c, name="contact_end_turn")
      end subroutine end_turn

      !> Record the problem of this thread
      subroutine note_call(problem, stage) bind(c, name="contact_note_call")
         import :: c_int, c_ptr
         !> Problem; null outside of all problems
         type(c_ptr), value :: problem
         !> Member of call_stage
         integer(c_int), value :: stage
      end subroutine note_call

      !> Get the problem recorded for this thread
      subroutine find_call(problem, stage) bind(c, name="contact_find_call")
         import :: c_int, c_ptr
         !> Problem; null if the thread is not in a call
         type(c_ptr), intent(out) :: problem
         !> Stage of the call, as recorded by note_call
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

   !> Is this process a fork of one that used the library? It contains the forking thread only.
   logical function is_forked()
      is_forked = is_child() /= 0
   end function is_forked

   !> Current folder; "." if the system does not report it
   subroutine find_current_folder(folder)
      !> Absolute path as reported by the system
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
