!> A file that is written line by line, and knows whether all of it arrived
!>
!> Streams of the C library: that of gfortran says nothing of a write that failed (12.2), repeats it with a byte too many
!> when the disk has room again, and calls the file closed. A failure here is remembered until the file is closed.
!> Copies of an `output_file` write to the same file; only one of them may close it.
module contact_base_output_file
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_int, c_long, c_loc, c_null_char, c_null_ptr, &
      & c_ptr, c_size_t
   implicit none (type, external)
   private

   public :: output_file, remove_file

   !> A file that is open, or not
   type :: output_file
      private
      type(c_ptr) :: stream = c_null_ptr
   contains
      procedure :: is_open
      !> Open a file for writing; what it held is gone
      procedure :: open_file
      !> Go on with a file: what it holds behind a place is cut off
      procedure :: open_again
      !> Take the standard output; closing leaves it open for others
      procedure :: open_standard_output
      !> Write a text and the end of the line
      procedure :: line
      !> Write a text, or numbers as they stand in memory, without end of line
      generic :: bytes => text_bytes, real_bytes
      procedure, private :: text_bytes
      procedure, private :: real_bytes
      !> Hand everything to the system
      procedure :: flush_now
      !> Bytes in front of what is written next
      procedure :: place
      !> Go on at a place; what stands there is overwritten
      procedure :: go_to
      !> Close, and tell whether all of it arrived
      procedure :: close_file
   end type output_file

   interface
      function open_stream(name, mode, reason, length) result(stream) bind(c, name="contact_open_stream")
         import :: c_char, c_int, c_ptr
         character(kind=c_char), intent(in) :: name(*), mode(*)
         !> Why it was not opened, null-terminated, and its length
         character(kind=c_char), intent(out) :: reason(*)
         integer(c_int), value :: length
         type(c_ptr) :: stream
      end function open_stream

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

      function c_truncate(name, length) result(status) bind(c, name="truncate")
         import :: c_char, c_int, c_long
         character(kind=c_char), intent(in) :: name(*)
         integer(c_long), value :: length
         integer(c_int) :: status
      end function c_truncate

      function c_remove(name) result(status) bind(c, name="unlink")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*)
         integer(c_int) :: status
      end function c_remove
   end interface

   !> Number of the standard output of a process
   integer(c_int), parameter :: standard_output = 1

contains

   pure logical function is_open(self)
      class(output_file), intent(in) :: self
      is_open = c_associated(self%stream)
   end function is_open

   subroutine open_file(self, name, reason)
      class(output_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Why the file could not be opened, one sentence; unallocated when it was
      character(len=:), allocatable, intent(out) :: reason
      character(kind=c_char, len=1) :: message(400)
      integer :: i

      ! e: a process that the host starts does not inherit the file
      self%stream = open_stream(name // c_null_char, "wbe" // c_null_char, message, int(size(message), c_int))
      if (self%is_open()) return
      reason = ""
      do i = 1, size(message)
         if (message(i) == c_null_char) exit
         reason = reason // message(i)
      end do
   end subroutine open_file

   subroutine open_again(self, name, place, done)
      class(output_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Bytes that are kept
      integer(c_long), intent(in) :: place
      !> Is the file open now?
      logical, intent(out) :: done

      character(kind=c_char, len=1) :: message(400)

      done = c_truncate(name // c_null_char, place) == 0
      if (.not. done) return
      self%stream = open_stream(name // c_null_char, "r+be" // c_null_char, message, int(size(message), c_int))
      done = self%is_open()
      call self%go_to(place)
   end subroutine open_again

   subroutine open_standard_output(self)
      class(output_file), intent(inout) :: self
      integer(c_int) :: copy

      copy = dup(standard_output)
      if (copy >= 0) self%stream = fdopen(copy, "w" // c_null_char)
   end subroutine open_standard_output

   subroutine line(self, text)
      class(output_file), intent(in) :: self
      character(len=*), intent(in) :: text
      character(len=len(text) + 1) :: whole

      ! in one call, so that lines of two threads do not mix
      whole = text // new_line("a")
      call self%text_bytes(whole)
   end subroutine line

   subroutine text_bytes(self, text)
      class(output_file), intent(in) :: self
      character(len=*), intent(in), target :: text
      integer(c_size_t) :: ignored

      if (self%is_open() .and. len(text) > 0) ignored = fwrite(c_loc(text), 1_c_size_t, len(text, c_size_t), self%stream)
   end subroutine text_bytes

   subroutine real_bytes(self, values)
      class(output_file), intent(in) :: self
      real(c_double), intent(in), target, contiguous :: values(:)
      integer(c_size_t) :: ignored

      if (self%is_open() .and. size(values) > 0) &
         & ignored = fwrite(c_loc(values), 8_c_size_t, size(values, kind=c_size_t), self%stream)
   end subroutine real_bytes

   subroutine flush_now(self)
      class(output_file), intent(in) :: self
      integer(c_int) :: ignored

      if (self%is_open()) ignored = fflush(self%stream)
   end subroutine flush_now

   integer(c_long) function place(self)
      class(output_file), intent(in) :: self

      place = 0
      if (self%is_open()) place = ftell(self%stream)
   end function place

   subroutine go_to(self, place)
      class(output_file), intent(in) :: self
      !> What the function `place` has told [bytes]
      integer(c_long), intent(in) :: place
      integer(c_int), parameter :: from_the_start = 0
      integer(c_int) :: ignored

      if (self%is_open()) ignored = fseek(self%stream, place, from_the_start)
   end subroutine go_to

   subroutine close_file(self, complete)
      class(output_file), intent(inout) :: self
      !> Did everything that was written since opening arrive? A file that is not open is complete
      logical, intent(out) :: complete
      logical :: failed

      complete = .true.
      if (.not. self%is_open()) return
      ! flushed first: errors of both calls count
      failed = fflush(self%stream) /= 0
      failed = ferror(self%stream) /= 0 .or. failed
      failed = fclose(self%stream) /= 0 .or. failed
      complete = .not. failed
      self%stream = c_null_ptr
   end subroutine close_file

   !> Delete a file; nothing happens when it is not there
   subroutine remove_file(name)
      character(len=*), intent(in) :: name
      integer(c_int) :: ignored

      ignored = c_remove(name // c_null_char)
   end subroutine remove_file
end module contact_base_output_file
