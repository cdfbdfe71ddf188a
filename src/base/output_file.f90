!> A file that is written line by line and reports whether all of it was written
!>
!> Uses streams of the C library. The run-time library of gfortran 12.2 ignores a failed write, repeats it with an extra byte
!> when the disk has room again, and reports the file as closed. Here a failure is remembered until the file is closed. Copies
!> of an `output_file` write to the same file; only one of them may close it.
module contact_base_output_file
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_int, c_long, c_loc, c_null_char, c_null_ptr, &
      & c_ptr, c_size_t
   use contact_base_kinds, only : long
   use contact_base_system, only : close_descriptor, open_output
   implicit none (type, external)
   private

   public :: output_budget, output_file, remove_file

   !> Total size that several files may have together
   type :: output_budget
      !> Bytes allowed, and bytes left; negative after the first request that exceeded it, when nothing is written any more
      integer(long) :: allowed = huge(1_long), left = huge(1_long)
   contains
      !> Request bytes; true if they are available
      procedure :: take
      !> Was more requested than allowed?
      procedure :: is_exceeded
   end type output_budget

   !> Size charged for a file in addition to its content: about one block on disk [bytes]
   integer(long), parameter :: bytes_per_file = 4096

   !> A file, open or closed
   type :: output_file
      private
      type(c_ptr) :: stream = c_null_ptr
      !> Budget of the file; null: unlimited
      type(output_budget), pointer :: budget => null()
   contains
      procedure :: is_open
      !> Open a file for writing; its previous content is lost
      procedure :: open_file
      !> Continue a file: its content beyond a position is cut off
      procedure :: open_again
      !> Use the standard output; closing leaves it open for others
      procedure :: open_standard_output
      !> Charge what is written from now on to a budget
      procedure :: charge_to
      !> Write a text and a line end
      procedure :: line
      !> Write a text, or numbers in binary form, without line end
      generic :: bytes => text_bytes, real_bytes
      procedure, private :: text_bytes
      procedure, private :: real_bytes
      !> Flush the buffer to the system
      procedure :: flush_now
      !> Was some of the output not written?
      procedure :: has_failed
      !> Current position [bytes]
      procedure :: place
      !> Set the position; existing content is overwritten
      procedure :: seek
      !> Close the file, and report whether all of it was written
      procedure :: close_file
   end type output_file

   interface
      function fdopen(descriptor, mode) result(stream) bind(c, name="fdopen")
         import :: c_char, c_int, c_ptr
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: mode(*)
         type(c_ptr) :: stream
      end function fdopen

      function dup(descriptor) result(copy) bind(c, name="dup")
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int) :: copy
      end function dup

      function fwrite(data, size, count, stream) result(written) bind(c, name="fwrite")
         import :: c_ptr, c_size_t
         type(c_ptr), value :: data, stream
         integer(c_size_t), value :: size, count
         integer(c_size_t) :: written
      end function fwrite

      function fflush(stream) result(status) bind(c, name="fflush")
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int) :: status
      end function fflush

      function ferror(stream) result(status) bind(c, name="ferror")
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int) :: status
      end function ferror

      function fclose(stream) result(status) bind(c, name="fclose")
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int) :: status
      end function fclose

      function ftell(stream) result(place) bind(c, name="ftell")
         import :: c_long, c_ptr
         type(c_ptr), value :: stream
         integer(c_long) :: place
      end function ftell

      function fseek(stream, place, from) result(status) bind(c, name="fseek")
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: stream
         integer(c_long), value :: place
         integer(c_int), value :: from
         integer(c_int) :: status
      end function fseek

      function c_remove(name) result(status) bind(c, name="unlink")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*)
         integer(c_int) :: status
      end function c_remove
   end interface

   !> Descriptor of the standard output of a process
   integer(c_int), parameter :: standard_output = 1

contains

   !> A file that would exceed the budget is cut off there, and no other file gets the rest
   logical function take(self, bytes) result(granted)
      class(output_budget), intent(inout) :: self
      !> Number of bytes to write
      integer(long), intent(in) :: bytes

      granted = bytes <= self%left
      self%left = merge(self%left - bytes, -1_long, granted)
   end function take

   pure logical function is_exceeded(self)
      class(output_budget), intent(in) :: self
      is_exceeded = self%left < 0
   end function is_exceeded

   subroutine charge_to(self, budget)
      class(output_file), intent(inout) :: self
      !> Null: unlimited
      type(output_budget), pointer, intent(in) :: budget
      logical :: ignored

      self%budget => budget
      if (associated(budget)) ignored = budget%take(bytes_per_file)
   end subroutine charge_to

   !> May this number of bytes be written to the file?
   logical function may_write(file, bytes)
      class(output_file), intent(in) :: file
      integer(long), intent(in) :: bytes

      may_write = file%is_open()
      if (may_write .and. associated(file%budget)) may_write = file%budget%take(bytes)
   end function may_write

   pure logical function is_open(self)
      class(output_file), intent(in) :: self
      is_open = c_associated(self%stream)
   end function is_open

   subroutine open_file(self, name, reason, confined)
      class(output_file), intent(inout) :: self
      !> Path of the file, as the user gave it
      character(len=*), intent(in) :: name
      !> Why the file could not be opened, one sentence; unallocated on success
      character(len=:), allocatable, intent(out) :: reason
      !> Require a regular file that is not a symbolic link? Default: no
      logical, intent(in), optional :: confined

      call open_stream(self, name, "w" // c_null_char, reason, confined)
   end subroutine open_file

   !> Open the stream of a file, new or after the content that is kept
   subroutine open_stream(self, name, mode, reason, confined, keep)
      class(output_file), intent(inout) :: self
      !> Name; mode of the stream, null-terminated
      character(len=*), intent(in) :: name, mode
      character(len=:), allocatable, intent(out) :: reason
      logical, intent(in), optional :: confined
      !> As for open_output
      integer(c_long), intent(in), optional :: keep
      integer(c_int) :: descriptor
      logical :: is_confined

      is_confined = .false.
      if (present(confined)) is_confined = confined
      call open_output(name, is_confined, descriptor, reason, keep)
      if (allocated(reason)) return
      self%stream = fdopen(descriptor, mode)
      if (self%is_open()) return
      call close_descriptor(descriptor)
      reason = "there is not enough memory for it"
   end subroutine open_stream

   subroutine open_again(self, name, place, reason, confined)
      class(output_file), intent(inout) :: self
      !> Path of an existing file
      character(len=*), intent(in) :: name
      !> Number of bytes kept
      integer(c_long), intent(in) :: place
      !> As for open_file
      character(len=:), allocatable, intent(out) :: reason
      !> As for open_file
      logical, intent(in), optional :: confined

      call open_stream(self, name, "r+" // c_null_char, reason, confined, place)
      if (self%is_open()) call self%seek(place)
   end subroutine open_again

   subroutine open_standard_output(self)
      class(output_file), intent(inout) :: self
      integer(c_int) :: copy

      copy = dup(standard_output)
      if (copy >= 0) self%stream = fdopen(copy, "w" // c_null_char)
   end subroutine open_standard_output

   subroutine line(self, text)
      class(output_file), intent(in) :: self
      !> The line, without line end
      character(len=*), intent(in) :: text
      !> Longer lines are assembled on the heap, as stacks may be small
      integer, parameter :: usual = 1000
      character(len=usual + 1) :: whole
      character(len=:), allocatable :: longer

      ! a single call, so that lines of two threads do not mix
      if (len(text) <= usual) then
         whole(:len(text)) = text
         whole(len(text) + 1:len(text) + 1) = new_line("a")
         call self%text_bytes(whole(:len(text) + 1))
      else
         longer = text // new_line("a")
         call self%text_bytes(longer)
      end if
   end subroutine line

   subroutine text_bytes(self, text)
      class(output_file), intent(in) :: self
      !> Written unchanged, without line end
      character(len=*), intent(in) :: text

      if (len(text) == 0) return
      if (may_write(self, len(text, long))) call write_text(self, text)
   end subroutine text_bytes

   subroutine write_text(file, text)
      !> An open file
      class(output_file), intent(in) :: file
      character(len=*), intent(in), target :: text
      integer(c_size_t) :: ignored

      ignored = fwrite(c_loc(text), 1_c_size_t, len(text, c_size_t), file%stream)
   end subroutine write_text

   subroutine real_bytes(self, values)
      class(output_file), intent(in) :: self
      !> Written as 8 bytes each, in the byte order of the machine
      real(c_double), intent(in), target, contiguous :: values(:)
      integer(c_size_t) :: ignored

      if (size(values) == 0) return
      if (may_write(self, 8*size(values, kind=long))) &
         & ignored = fwrite(c_loc(values), 8_c_size_t, size(values, kind=c_size_t), self%stream)
   end subroutine real_bytes

   subroutine flush_now(self)
      class(output_file), intent(in) :: self
      integer(c_int) :: ignored

      if (self%is_open()) ignored = fflush(self%stream)
   end subroutine flush_now

   logical function has_failed(self)
      class(output_file), intent(in) :: self

      has_failed = .false.
      if (.not. self%is_open()) return
      if (fflush(self%stream) /= 0) has_failed = .true.
      if (ferror(self%stream) /= 0) has_failed = .true.
   end function has_failed

   integer(c_long) function place(self)
      class(output_file), intent(in) :: self

      place = 0
      if (self%is_open()) place = ftell(self%stream)
   end function place

   subroutine seek(self, place)
      class(output_file), intent(in) :: self
      !> Position from the function `place` [bytes]
      integer(c_long), intent(in) :: place
      integer(c_int), parameter :: from_the_start = 0
      integer(c_int) :: ignored

      if (self%is_open()) ignored = fseek(self%stream, place, from_the_start)
   end subroutine seek

   subroutine close_file(self, complete)
      class(output_file), intent(inout) :: self
      !> Was everything since opening written? True for a file that is not open
      logical, intent(out) :: complete
      logical :: failed

      complete = .true.
      if (.not. self%is_open()) return
      failed = .false.
      if (associated(self%budget)) failed = self%budget%is_exceeded()
      ! flushed first, so that errors of both calls are detected
      failed = fflush(self%stream) /= 0 .or. failed
      failed = ferror(self%stream) /= 0 .or. failed
      failed = fclose(self%stream) /= 0 .or. failed
      complete = .not. failed
      self%stream = c_null_ptr
   end subroutine close_file

   !> Delete a file, if it exists
   subroutine remove_file(name)
      !> Path of the file
      character(len=*), intent(in) :: name
      integer(c_int) :: ignored

      ignored = c_remove(name // c_null_char)
   end subroutine remove_file
end module contact_base_output_file
