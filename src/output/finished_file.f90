!> Files that exist only if complete: written under a temporary name, renamed at the end
module contact_output_finished_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_long, c_null_char
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_limits, only : case_limits
   use contact_base_output_file, only : output_file, remove_file
   implicit none (type, external)
   private

   public :: case_file_name, close_result, finished_file, move_file, open_result, open_result_again

   !> A file being written
   type, extends(output_file) :: finished_file
      !> Final name and temporary name
      character(len=:), allocatable :: name, temporary
   contains
      !> Start a file under a temporary name
      procedure :: start => start_file
      !> Close the file and rename it, or remove it if writing failed
      procedure :: finish => finish_file
   end type finished_file

   interface
      !> rename of the C library: replaces an existing file in one step
      function c_rename(from, to) result(status) bind(c, name="rename")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: from(*), to(*)
         integer(c_int) :: status
      end function c_rename
   end interface

contains

   !> Part of the file name that identifies the case: [_reNNN[_cpN]].<case>[<patch letter>], padded with blanks
   !>
   !> The case number has at least four digits; in the name of a .subs file six from 10000 on, and it is omitted from a million on.
   pure function case_mark(case_number, extension, result_element, contact_problem, patch) result(mark)
      integer, intent(in) :: case_number
      character(len=*), intent(in) :: extension
      integer, intent(in) :: result_element, contact_problem, patch
      character(len=32) :: mark
      character(len=12) :: number

      write(number, "(I0.4)") case_number
      if (extension == "subs" .and. case_number > 9999) write(number, "(I6.6)") case_number
      if (extension == "subs" .and. case_number > 999999) number = ""
      mark = ""
      if (result_element > 0) write(mark, "(A, I0.3)") "_re", result_element
      if (contact_problem > 1) write(mark, "(2A, I0)") trim(mark), "_cp", contact_problem
      if (patch > 0 .and. patch <= 26) number = trim(number) // achar(iachar("a") + patch - 1)
      if (number /= "") mark = trim(mark) // "." // number
   end function case_mark

   !> Name of a file of one case: <base>[_reNNN[_cpN]].<case>[<patch letter>].<extension>
   pure function case_file_name(base, case_number, extension, result_element, contact_problem, patch) result(name)
      !> Folder and name of the experiment
      character(len=*), intent(in) :: base
      !> Case number, from 1
      integer, intent(in) :: case_number
      !> Extension without dot
      character(len=*), intent(in) :: extension
      !> Result element, 0 for none, contact problem in it, from 1, and contact patch (1 = a), 0 for none
      integer, intent(in) :: result_element, contact_problem, patch
      character(len=len(base) + len_trim(case_mark(case_number, extension, result_element, contact_problem, patch)) + 1 &
         & + len(extension)) :: name

      name = base // trim(case_mark(case_number, extension, result_element, contact_problem, patch)) // "." // extension
   end function case_file_name

   !> Open a temporary file in the folder of the final one
   subroutine start_file(self, name, error, limits)
      class(finished_file), intent(inout) :: self
      !> Final name
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      type(case_limits), intent(in), optional :: limits

      self%name = name
      self%temporary = name // ".tmp"
      call open_result(self, self%temporary, name, error, limits)
      ! it may exist, empty, if there was no memory for its stream
      if (allocated(error)) call remove_file(self%temporary)
   end subroutine start_file

   !> Close and rename; if writing failed at any time, the temporary file is removed and the error reports it
   subroutine finish_file(self, error)
      class(finished_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      logical :: complete

      if (.not. self%is_open()) return
      call self%close_file(complete)
      if (complete) complete = move_file(self%temporary, self%name) == 0
      if (complete) return
      call remove_file(self%temporary)
      call fatal_error(error, "the file could not be completed, it was not written", error_kind%file, file=self%name)
   end subroutine finish_file

   !> Open a file of results, or report why this is impossible
   subroutine open_result(file, path, name, error, limits)
      class(output_file), intent(inout) :: file
      !> Name to open, and name for the message
      character(len=*), intent(in) :: path, name
      type(error_type), allocatable, intent(out) :: error
      !> Confinement of the run and limit of its output; absent: none
      type(case_limits), intent(in), optional :: limits
      character(len=:), allocatable :: reason

      if (present(limits)) then
         call file%open_file(path, reason, limits%confined)
         if (.not. allocated(reason)) call file%charge_to(limits%output)
      else
         call file%open_file(path, reason)
      end if
      if (allocated(reason)) call fatal_error(error, "the file cannot be written: " // reason, error_kind%file, name)
   end subroutine open_result

   !> Continue a file of results at a position, or report why this is impossible
   subroutine open_result_again(file, name, place, error, limits)
      class(output_file), intent(inout) :: file
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Number of bytes that are kept
      integer(c_long), intent(in) :: place
      type(error_type), allocatable, intent(out) :: error
      type(case_limits), intent(in) :: limits
      character(len=:), allocatable :: reason

      call file%open_again(name, place, reason, limits%confined)
      if (.not. allocated(reason)) call file%charge_to(limits%output)
      if (allocated(reason)) call fatal_error(error, "the file cannot be opened to continue it: " // reason, &
         & error_kind%file, name)
   end subroutine open_result_again

   !> Close a file of results and check that it was written completely
   subroutine close_result(file, name, error)
      class(output_file), intent(inout) :: file
      !> Path of the file, for the message
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      logical :: complete

      call file%close_file(complete)
      if (.not. complete) call fatal_error(error, "the file is not complete; is the disk full?", error_kind%file, name)
   end subroutine close_result

   !> Rename a file; if the system does not replace an existing file, that file is renamed first, and restored if this does not
   !> help
   integer function move_file(from, to) result(status)
      !> Old and new path
      character(len=*), intent(in) :: from, to
      character(len=*), parameter :: aside = ".old"
      integer :: ignored, unit

      status = int(c_rename(from // c_null_char, to // c_null_char))
      if (status == 0) return
      ! a folder of that name is not renamed
      open(newunit=unit, file=to, status="old", action="readwrite", iostat=ignored)
      if (ignored /= 0) return
      close(unit, iostat=ignored)
      if (c_rename(to // c_null_char, to // aside // c_null_char) /= 0) return
      status = int(c_rename(from // c_null_char, to // c_null_char))
      if (status /= 0) then
         ignored = int(c_rename(to // aside // c_null_char, to // c_null_char))
      else
         call remove_file(to // aside)
      end if
   end function move_file
end module contact_output_finished_file
