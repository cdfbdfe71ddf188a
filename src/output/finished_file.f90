!> Files that exist only when complete: written under a temporary name, renamed at the end
module contact_output_finished_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long
   implicit none (type, external)
   private

   public :: case_file_name, close_completely, finished_file, move_file

   !> A file in the making
   type :: finished_file
      !> Unit to write to, 0 when not open
      integer :: unit = 0
      !> Final and temporary name
      character(len=:), allocatable :: name, temporary
   contains
      !> Start a file under a temporary name
      procedure :: start => start_file
      !> Close the file and give it its name, or remove it when writing went wrong
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

   !> What tells the files of cases apart: [_reNNN].<case>[<patch letter>], with blanks behind
   pure function case_mark(case_text, result_element, patch) result(mark)
      character(len=*), intent(in) :: case_text
      integer, intent(in) :: result_element, patch
      character(len=len(case_text) + 16) :: mark

      mark = ""
      if (result_element > 0) write(mark, '(A, I0.3)') "_re", result_element
      if (patch > 0 .and. patch <= 26) then
         mark = trim(mark) // "." // trim(case_text) // achar(iachar("a") + patch - 1)
      else if (case_text /= "") then
         mark = trim(mark) // "." // case_text
      end if
   end function case_mark

   !> Name of a file that belongs to one case: <base>[_reNNN].<case>[<patch letter>].<extension>
   pure function case_file_name(base, case_text, extension, result_element, patch) result(name)
      !> Folder and name of the experiment
      character(len=*), intent(in) :: base
      !> Number of the case as it shall appear; empty to leave it out
      character(len=*), intent(in) :: case_text
      !> Extension without dot
      character(len=*), intent(in) :: extension
      !> Result element and contact patch (1 = a), 0 for none
      integer, intent(in) :: result_element, patch
      character(len=len(base) + len_trim(case_mark(case_text, result_element, patch)) + 1 + len(extension)) :: name

      name = base // trim(case_mark(case_text, result_element, patch)) // "." // extension
   end function case_file_name

   !> Open a temporary file in the folder of the final one
   subroutine start_file(self, name, error, binary)
      class(finished_file), intent(inout) :: self
      !> Final name
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      !> Bytes instead of lines? Default false
      logical, intent(in), optional :: binary
      integer :: status
      logical :: bytes
      character(len=200) :: message

      bytes = .false.
      if (present(binary)) bytes = binary
      self%name = name
      self%temporary = name // ".tmp"
      if (bytes) then
         open(newunit=self%unit, file=self%temporary, status="replace", action="write", access="stream", form="unformatted", &
            & iostat=status, iomsg=message)
      else
         open(newunit=self%unit, file=self%temporary, status="replace", action="write", iostat=status, iomsg=message)
      end if
      if (status == 0) return
      self%unit = 0
      call fatal_error(error, "cannot write the file: " // trim(message), error_kind%file, file=name)
   end subroutine start_file

   !> Close and rename; with a status other than 0 the temporary file is removed and the error says why
   subroutine finish_file(self, status, error)
      class(finished_file), intent(inout) :: self
      !> I/O status of the write statements, 0 for success
      integer, intent(in) :: status
      type(error_type), allocatable, intent(out) :: error
      integer :: closed, unit
      type(error_type), allocatable :: incomplete

      if (self%unit == 0) return
      closed = status
      if (status == 0) then
         call close_completely(self%unit, self%temporary, incomplete)
         closed = merge(1, 0, allocated(incomplete))
         if (closed == 0) closed = move_file(self%temporary, self%name)
      else
         close(self%unit, status="delete", iostat=unit)
      end if
      self%unit = 0
      if (closed == 0) return
      if (status == 0) then
         open(newunit=unit, file=self%temporary, iostat=closed)
         if (closed == 0) close(unit, status="delete", iostat=closed)
      end if
      call fatal_error(error, "the file could not be completed, it was not written", error_kind%file, file=self%name)
   end subroutine finish_file

   !> Close a file and see whether all of it reached the disk
   !>
   !> The I/O library of gfortran 12 says nothing when the disk is full; lengths tell.
   subroutine close_completely(unit, name, error)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      integer(long) :: written, arrived
      integer :: status

      flush(unit, iostat=status)
      inquire(unit=unit, size=written)
      close(unit, iostat=status)
      inquire(file=name, size=arrived)
      if (status == 0 .and. arrived >= written) return
      call fatal_error(error, "the file is not complete; is the disk full?", error_kind%file, name)
   end subroutine close_completely

   !> Rename a file; where the system refuses to replace, the old one is deleted first
   integer function move_file(from, to) result(status)
      character(len=*), intent(in) :: from, to
      integer :: unit, ignored

      status = int(c_rename(from // c_null_char, to // c_null_char))
      if (status == 0) return
      open(newunit=unit, file=to, status="old", iostat=ignored)
      if (ignored == 0) close(unit, status="delete", iostat=ignored)
      status = int(c_rename(from // c_null_char, to // c_null_char))
   end function move_file
end module contact_output_finished_file
