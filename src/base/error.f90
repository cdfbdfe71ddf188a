!> Errors: a message, the position in the input, and the context in which they occurred
!>
!> An unallocated error means success. Rooms below the command line never stop and never print; they allocate an error and
!> return.
module contact_base_error
   implicit none (type, external)
   private

   public :: error_type, error_kind, fatal_error, add_context, full_text

   type :: error_kind_list
      !> The text or a value of the input is invalid
      integer :: input = 1
      !> A file cannot be opened, read or written
      integer :: file = 2
      !> Known to the input format, but not implemented in this version
      integer :: unsupported = 3
      !> Memory could not be allocated
      integer :: memory = 4
      !> A program fault: NaN from finite input, a broken invariant
      integer :: internal = 5
      !> Cases did not converge, and the caller requested this to be an error
      integer :: not_converged = 6
      !> A limit on elements or memory is exceeded
      integer :: limit = 7
      !> The time limit was reached
      integer :: time = 8
      !> The files are in use by another run
      integer :: locked = 9
      !> The run was interrupted before its last case
      integer :: interrupted = 10
   end type error_kind_list
   !> Names of the kinds of failure
   type(error_kind_list), parameter :: error_kind = error_kind_list()

   !> An error; unallocated means success
   type :: error_type
      !> Member of error_kind
      integer :: kind = 0
      !> One sentence with the offending value and the accepted ones
      character(len=:), allocatable :: message
      !> Name of the input file; unallocated if the input came from a call
      character(len=:), allocatable :: file
      !> Position in that file, 0 if unknown
      integer :: line = 0, column = 0
      !> Context, innermost first: "tangential solve, case 7"
      character(len=:), allocatable :: trail
   end type error_type

contains

   !> Create an error
   subroutine fatal_error(error, message, kind, file, line, column)
      !> The new error; replaces an earlier one
      type(error_type), allocatable, intent(out) :: error
      !> One sentence for the user, without the position: what is wrong, the value found, and what is accepted
      character(len=*), intent(in) :: message
      !> Member of error_kind; default input
      integer, intent(in), optional :: kind
      !> File concerned, as the user named it; absent: none
      character(len=*), intent(in), optional :: file
      !> Position in the file, from 1; absent: unknown
      integer, intent(in), optional :: line, column

      allocate(error)
      error%message = message
      error%kind = error_kind%input
      if (present(kind)) error%kind = kind
      if (present(file)) error%file = file
      if (present(line)) error%line = line
      if (present(column)) error%column = column
   end subroutine fatal_error

   !> Append a context to an error; does nothing on success
   subroutine add_context(error, context)
      !> Unallocated on success
      type(error_type), allocatable, intent(inout) :: error
      !> Context, such as "case 3"; appended to earlier ones
      character(len=*), intent(in) :: context

      if (.not. allocated(error)) return
      if (allocated(error%trail)) then
         error%trail = error%trail // ", " // context
      else
         error%trail = context
      end if
   end subroutine add_context

   !> Position, message and context of an error on one line. Control characters, such as those in a name from a damaged file,
   !> are replaced by question marks.
   pure subroutine join_parts(error, text)
      type(error_type), intent(in) :: error
      character(len=:), allocatable, intent(out) :: text
      !> Longest file name shown in full; systems allow up to 4096 bytes
      integer, parameter :: longest_name = 1000
      integer :: k, length

      text = ""
      if (allocated(error%file)) then
         length = len(error%file)
         if (length <= longest_name) then
            text = error%file
         else
            text = error%file(:longest_name/2) // "..." // error%file(length - longest_name/2 + 1:)
         end if
         if (error%line > 0) then
            text = text // ":" // trim(digits_of(error%line))
            if (error%column > 0) text = text // ":" // trim(digits_of(error%column))
         end if
         text = text // ": "
      end if
      if (allocated(error%message)) text = text // error%message
      if (allocated(error%trail)) text = text // " (" // error%trail // ")"
      do k = 1, len(text)
         if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) text(k:k) = "?"
      end do
   end subroutine join_parts

   !> A number in decimal digits; a formatted transfer takes ten times as long, and programs with many warnings make many of them
   pure function digits_of(number) result(text)
      !> Positive
      integer, intent(in) :: number
      character(len=24) :: text
      integer :: rest, k

      text = ""
      rest = number
      do k = 1, range(number) + 1
         text = achar(iachar("0") + mod(rest, 10)) // text(:len(text) - 1)
         rest = rest/10
         if (rest == 0) exit
      end do
   end function digits_of

   !> Length of the text of an error
   pure integer function full_length(error) result(length)
      type(error_type), intent(in) :: error
      character(len=:), allocatable :: parts

      call join_parts(error, parts)
      length = len(parts)
   end function full_length

   !> "file:line:column: message (trail)", the form compilers print
   pure function full_text(error) result(text)
      !> Error to describe
      type(error_type), intent(in) :: error
      character(len=full_length(error)) :: text
      character(len=:), allocatable :: parts

      call join_parts(error, parts)
      text = parts
   end function full_text
end module contact_base_error
