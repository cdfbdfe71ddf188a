!> How a failure reads: one sentence, the place it came from, the trail it took
!>
!> An unallocated error means success. Rooms below the command line never stop
!> and never print; they allocate an error and return.
module contact_base_error
   implicit none (type, external)
   private

   public :: error_type, error_kind, fatal_error, add_context, full_text

   type :: error_kind_list
      !> The text or the numbers of an input cannot be used
      integer :: input = 1
      !> A file cannot be opened, read or written
      integer :: file = 2
      !> Known to the format but not built in this version
      integer :: unsupported = 3
      !> Memory cannot be had
      integer :: memory = 4
      !> A program fault: NaN from finite input, broken invariants
      integer :: internal = 5
      !> Cases did not converge, and the caller asked to be told by a failure
      integer :: not_converged = 6
      !> More elements or memory than a limit allows
      integer :: limit = 7
      !> The time that was allowed ran out
      integer :: time = 8
      !> Another run is at work on the same files
      integer :: locked = 9
      !> The run was asked to end before its last case
      integer :: interrupted = 10
   end type error_kind_list
   !> Names of the kinds of failure
   type(error_kind_list), parameter :: error_kind = error_kind_list()

   !> One failure; unallocated means success
   type :: error_type
      !> Member of error_kind
      integer :: kind = 0
      !> One sentence with the offending value and what would have been accepted
      character(len=:), allocatable :: message
      !> Where the input came from; unallocated when it was a call
      character(len=:), allocatable :: file
      !> Position in that file, 0 when unknown
      integer :: line = 0, column = 0
      !> Innermost first: "tangential solve, case 7"
      character(len=:), allocatable :: trail
   end type error_type

contains

   !> Allocate an error
   subroutine fatal_error(error, message, kind, file, line, column)
      !> The error that is made; what was allocated before is replaced
      type(error_type), allocatable, intent(out) :: error
      !> One sentence for the user, without place: what is wrong, what stands there, what would be accepted
      character(len=*), intent(in) :: message
      !> Member of error_kind; default input
      integer, intent(in), optional :: kind
      !> File that the sentence is about, as the user named it; absent: none
      character(len=*), intent(in), optional :: file
      !> Place in the file, from 1; absent: not known
      integer, intent(in), optional :: line, column

      allocate(error)
      error%message = message
      error%kind = error_kind%input
      if (present(kind)) error%kind = kind
      if (present(file)) error%file = file
      if (present(line)) error%line = line
      if (present(column)) error%column = column
   end subroutine fatal_error

   !> Add a station to the trail of an error; does nothing on success
   subroutine add_context(error, station)
      !> Unallocated on success: nothing is done then
      type(error_type), allocatable, intent(inout) :: error
      !> Where the error passed, such as "case 3", put behind those passed before
      character(len=*), intent(in) :: station

      if (.not. allocated(error)) return
      if (allocated(error%trail)) then
         error%trail = error%trail // ", " // station
      else
         error%trail = station
      end if
   end subroutine add_context

   !> Place, message and trail of an error in one text of one line: control characters, as of a name that a
   !> damaged file gives, become question marks
   pure subroutine join_parts(error, text)
      type(error_type), intent(in) :: error
      character(len=:), allocatable, intent(out) :: text
      !> Longest name of a file that is told as a whole, of which systems take 4096 bytes at most
      integer, parameter :: longest_name = 1000
      character(len=24) :: place
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
            write(place, "(I0)") error%line
            text = text // ":" // trim(place)
            if (error%column > 0) then
               write(place, "(I0)") error%column
               text = text // ":" // trim(place)
            end if
         end if
         text = text // ": "
      end if
      if (allocated(error%message)) text = text // error%message
      if (allocated(error%trail)) text = text // " (" // error%trail // ")"
      do k = 1, len(text)
         if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) text(k:k) = "?"
      end do
   end subroutine join_parts

   !> Length of the text of an error
   pure integer function full_length(error) result(length)
      type(error_type), intent(in) :: error
      character(len=:), allocatable :: parts

      call join_parts(error, parts)
      length = len(parts)
   end function full_length

   !> "file:line:column: message (trail)", the form compilers print
   pure function full_text(error) result(text)
      !> An error that has happened
      type(error_type), intent(in) :: error
      character(len=full_length(error)) :: text
      character(len=:), allocatable :: parts

      call join_parts(error, parts)
      text = parts
   end function full_text
end module contact_base_error
