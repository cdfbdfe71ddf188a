!> System services that Fortran lacks: opening files of the expected kind only, locks, leftover files of ended runs
!>
!> Implemented in system.c. Descriptors are those of the system.
module contact_base_system
   use, intrinsic :: iso_c_binding, only : c_char, c_funloc, c_funptr, c_int, c_long, c_long_long, c_loc, c_null_char, c_ptr
   use contact_base_kinds, only : long
   implicit none (type, external)
   private

   public :: close_descriptor, divert_to_memory, file_stamp, lock_experiment, lock_state, open_input, open_output, read_input
   public :: remove_leftovers, find_real_path, is_same_file, stamp_of, unlock_experiment

   !> Identity of an unchanged file: device, file number, length, times of the last change of content and of status
   type :: file_stamp
      integer(c_long_long), private :: numbers(5) = 0
      !> Is the file old enough that a later change would have another time? Clocks of file systems are coarse
      logical, private :: is_conclusive = .false.
   contains
      !> Is the file unchanged since an earlier stamp? False if that stamp was taken too soon after a change
      procedure :: is_unchanged_since
   end type file_stamp

   !> Outcome of taking a lock
   type :: lock_state_list
      integer :: ours = 0
      !> Held by another run
      integer :: held = 1
      !> The folder or its file system does not support locks
      integer :: impossible = 2
   end type lock_state_list
   !> Names of these outcomes
   type(lock_state_list), parameter :: lock_state = lock_state_list()

   !> Results of system.c in place of a descriptor
   integer(c_int), parameter :: of_another_kind = -2, outside = -3, held = -4, link = -5
   !> Maximum lengths of a system message, and of the description of the holder of a lock
   integer, parameter :: longest_sentence = 120, longest_holder = 200

   abstract interface
      !> May a file whose name has this rest be deleted? Non-zero: yes
      function name_test(rest, length) result(answer) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         integer(c_int), value :: length
         character(kind=c_char), intent(in) :: rest(length)
         integer(c_int) :: answer
      end function name_test
   end interface

   interface
      function contact_open_input(folder, name, confined, length, cause) result(file) bind(c)
         import :: c_char, c_int, c_long_long
         character(kind=c_char), intent(in) :: folder(*), name(*)
         integer(c_int), value :: confined
         integer(c_long_long), intent(out) :: length
         integer(c_int), intent(out) :: cause
         integer(c_int) :: file
      end function contact_open_input

      function contact_read(file, buffer, length, cause) result(done) bind(c)
         import :: c_int, c_long_long, c_ptr
         integer(c_int), value :: file
         type(c_ptr), value :: buffer
         integer(c_long_long), value :: length
         integer(c_int), intent(out) :: cause
         integer(c_long_long) :: done
      end function contact_read

      function contact_stamp(name, numbers, age) result(state) bind(c)
         import :: c_char, c_int, c_long_long
         character(kind=c_char), intent(in) :: name(*)
         integer(c_long_long), intent(out) :: numbers(5), age
         integer(c_int) :: state
      end function contact_stamp

      function contact_open_output(name, confined, keep, cause) result(file) bind(c)
         import :: c_char, c_int, c_long
         character(kind=c_char), intent(in) :: name(*)
         integer(c_int), value :: confined
         integer(c_long), value :: keep
         integer(c_int), intent(out) :: cause
         integer(c_int) :: file
      end function contact_open_output

      subroutine close_descriptor(file) bind(c, name="contact_close")
         import :: c_int
         !> Descriptor from `open_input`, `open_output` or the C library
         integer(c_int), value :: file
      end subroutine close_descriptor

      !> From now on a file is written into memory, which is released when it is closed; ineffective on other systems than Linux
      subroutine divert_to_memory(file) bind(c, name="contact_divert")
         import :: c_int
         !> Descriptor of an open file whose content is not needed any more
         integer(c_int), value :: file
      end subroutine divert_to_memory

      subroutine contact_explain(cause, text, length) bind(c)
         import :: c_char, c_int
         integer(c_int), value :: cause, length
         character(kind=c_char), intent(out) :: text(*)
      end subroutine contact_explain

      function contact_lock(name, holder, length, cause) result(file) bind(c)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*)
         character(kind=c_char), intent(out) :: holder(*)
         integer(c_int), value :: length
         integer(c_int), intent(out) :: cause
         integer(c_int) :: file
      end function contact_lock

      !> Release a lock; the name is null-terminated
      subroutine unlock_experiment(file, name) bind(c, name="contact_unlock")
         import :: c_char, c_int
         !> Descriptor from `lock_experiment`
         integer(c_int), value :: file
         !> Path of the lock file, which is deleted
         character(kind=c_char), intent(in) :: name(*)
      end subroutine unlock_experiment

      function contact_real_path(name, path, length) bind(c) result(used)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*)
         character(kind=c_char), intent(out) :: path(*)
         integer(c_int), value :: length
         integer(c_int) :: used
      end function contact_real_path

      subroutine contact_clean(folder, start, is_ours) bind(c)
         import :: c_char, c_funptr
         character(kind=c_char), intent(in) :: folder(*), start(*)
         type(c_funptr), value :: is_ours
      end subroutine contact_clean
   end interface

contains

   !> Open a regular file for reading; other kinds, such as a FIFO or a device, are refused without waiting
   subroutine open_input(name, file, length, reason, below)
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Descriptor, to be closed by `close_descriptor`
      integer(c_int), intent(out) :: file
      !> Length of the file [bytes]
      integer(long), intent(out) :: length
      !> Why the file was not opened, one sentence; unallocated on success
      character(len=:), allocatable, intent(out) :: reason
      !> Folder, "" for the current one, below which the file must be, also if reached by symbolic links; absent: anywhere
      character(len=*), intent(in), optional :: below
      integer(c_long_long) :: bytes
      integer(c_int) :: cause
      integer :: skipped

      bytes = 0
      if (present(below)) then
         file = outside
         skipped = len(below)
         if (name(:min(skipped, len(name))) == below) then
            if (skipped > 0) skipped = skipped + max(0, verify(name(skipped + 1:) // ".", "/") - 1)
            file = contact_open_input(below // c_null_char, name(skipped + 1:) // c_null_char, 1_c_int, bytes, cause)
         end if
      else
         file = contact_open_input(c_null_char, name // c_null_char, 0_c_int, bytes, cause)
      end if
      length = int(bytes, long)
      if (file >= 0) return
      if (file == outside) then
         reason = "it is not below the folder of the experiment; a confined run follows no '..', no absolute name and no link " &
            & // "that leaves it"
      else if (file == link) then
         reason = "there is a symbolic link in its name; this system cannot resolve links (openat2 is missing), so that " &
            & // "a confined run follows none"
      else
         call describe_failure(file, cause, reason)
      end if
   end subroutine open_input

   !> Stamp of a file; a missing file never equals an earlier one
   type(file_stamp) function stamp_of(name) result(stamp)
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Clock resolution of file systems that record fractions of a second, and of the others [ns]
      integer(c_long_long), parameter :: tick = 100000000_c_long_long, coarse_tick = 2000000000_c_long_long
      integer(c_long_long), parameter :: second = 1000000000_c_long_long
      integer(c_long_long) :: age

      if (contact_stamp(name // c_null_char, stamp%numbers, age) /= 0) return
      stamp%is_conclusive = age > merge(coarse_tick, tick, modulo(stamp%numbers(5), second) == 0)
   end function stamp_of

   !> The path of an existing file after all links, from the root on
   subroutine find_real_path(name, path)
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Empty if there is no such file
      character(len=:), allocatable, intent(out) :: path
      integer, parameter :: longest = 4096
      character(len=longest) :: buffer
      integer(c_int) :: length

      length = contact_real_path(name // c_null_char, buffer, int(longest, c_int))
      path = buffer(:length)
   end subroutine find_real_path

   !> Do two paths lead to one existing file, for instance by a link?
   logical function is_same_file(name, other)
      !> Paths of the files
      character(len=*), intent(in) :: name, other
      type(file_stamp) :: stamp

      stamp = stamp_of(name)
      is_same_file = .false.
      if (any(stamp%numbers /= 0)) is_same_file = same_identity(stamp, stamp_of(other))
   end function is_same_file

   !> Are device and file number equal?
   pure logical function same_identity(stamp, other)
      type(file_stamp), intent(in) :: stamp, other
      same_identity = all(stamp%numbers(:2) == other%numbers(:2))
   end function same_identity

   pure logical function is_unchanged_since(self, earlier)
      class(file_stamp), intent(in) :: self
      !> Stamp taken before the file was read
      type(file_stamp), intent(in) :: earlier

      is_unchanged_since = earlier%is_conclusive .and. all(self%numbers == earlier%numbers)
   end function is_unchanged_since

   !> Why a file was not opened
   subroutine describe_failure(file, cause, reason)
      !> Failure in place of a descriptor, and errno
      integer(c_int), intent(in) :: file, cause
      character(len=:), allocatable, intent(out) :: reason
      character(len=longest_sentence) :: sentence

      if (file == of_another_kind) then
         reason = "it is not a regular file but a folder, link, FIFO, socket or device"
      else
         call contact_explain(cause, sentence, int(len(sentence), c_int))
         reason = trim(sentence)
      end if
   end subroutine describe_failure

   !> Read an open file from its current position
   subroutine read_input(file, text, done, reason)
      !> Descriptor from `open_input`
      integer(c_int), intent(in) :: file
      !> Receives the bytes, from its first character on
      character(len=*), intent(inout), target :: text
      !> Number of bytes read; less than the length of the text if the file ended
      integer(long), intent(out) :: done
      !> Why the file cannot be read; unallocated on success
      character(len=:), allocatable, intent(out) :: reason
      integer(c_int) :: cause

      done = int(contact_read(file, c_loc(text), len(text, c_long_long), cause), long)
      if (done < 0) call describe_failure(-1_c_int, cause, reason)
   end subroutine read_input

   !> Open a file for writing; its content is lost, or the part beyond `keep`
   subroutine open_output(name, confined, file, reason, keep)
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Require a regular file that is not a symbolic link?
      logical, intent(in) :: confined
      !> Descriptor, to be closed by `close_descriptor`
      integer(c_int), intent(out) :: file
      !> Why the file was not opened, one sentence; unallocated on success
      character(len=:), allocatable, intent(out) :: reason
      !> Number of bytes kept of an existing file; absent: a new file
      integer(c_long), intent(in), optional :: keep
      integer(c_long) :: kept
      integer(c_int) :: cause

      kept = -1_c_long
      if (present(keep)) kept = keep
      file = contact_open_output(name // c_null_char, merge(1_c_int, 0_c_int, confined), kept, cause)
      if (file < 0) call describe_failure(file, cause, reason)
   end subroutine open_output

   !> Take the lock of an experiment, which the system releases when this process ends for whatever reason
   subroutine lock_experiment(name, file, state, what)
      !> Name of the lock file
      character(len=*), intent(in) :: name
      !> Descriptor of the lock, for `unlock_experiment`
      integer(c_int), intent(out) :: file
      !> Member of lock_state
      integer, intent(out) :: state
      !> Holder of the lock, or why there is none; unallocated if the lock was taken
      character(len=:), allocatable, intent(out) :: what
      character(len=longest_holder) :: holder
      integer(c_int) :: cause

      file = contact_lock(name // c_null_char, holder, int(len(holder), c_int), cause)
      if (file >= 0) then
         state = lock_state%ours
      else if (file == held) then
         state = lock_state%held
         what = trim(holder)
         if (len(what) == 0) what = "a process that did not give its name"
      else
         state = lock_state%impossible
         call describe_failure(file, cause, what)
      end if
   end subroutine lock_experiment

   !> Delete files left by an ended run
   subroutine remove_leftovers(folder, start, is_leftover)
      !> "" for the current folder
      character(len=*), intent(in) :: folder
      !> First part of their names
      character(len=*), intent(in) :: start
      !> Decides from the rest of a name whether a file is a leftover
      procedure(name_test) :: is_leftover

      call contact_clean(folder // c_null_char, start // c_null_char, c_funloc(is_leftover))
   end subroutine remove_leftovers
end module contact_base_system
