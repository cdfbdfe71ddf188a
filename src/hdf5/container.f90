!> An HDF5 file of which a complete copy exists at all times: opening and closing, properties, attributes and groups
!>
!> HDF5 writes changes in an unspecified order, so a file that is being written may be unreadable at any moment. It therefore has a
!> temporary name until it is closed. From time to time it is flushed and copied, and the copy is renamed to the name of the
!> results in one step: the file of that name is readable at all times, however the program ends. Small arrays are stored in the
!> headers of their objects, large ones are compressed.
!>
!> A failure is recorded (`failed`) and reported when the file is closed; the calls in between may ignore it.
module contact_hdf5_container
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t
   use hdf5, only : h5acreate_f, h5adelete_f, h5aexists_f, h5awrite_f, h5d_compact_f, h5d_fill_time_never_f, h5eset_auto_f, &
      & h5f_acc_rdwr_f, h5f_close_strong_f, h5f_libver_earliest_f, h5f_libver_v18_f, h5f_scope_local_f, &
      & h5fclose_f, h5fflush_f, h5fopen_f, h5gcreate_f, h5idec_ref_f, h5ldelete_f, h5lexists_f, h5open_f, &
      & h5p_dataset_create_f, h5p_file_access_f, h5p_file_create_f, h5p_group_create_f, h5pcreate_f, &
      & h5pset_chunk_f, h5pset_deflate_f, h5pset_fapl_sec2_f, h5pset_fclose_degree_f, h5pset_fill_time_f, h5pset_fill_value_f, &
      & h5pset_fletcher32_f, h5pset_istore_k_f, h5pset_layout_f, h5pset_libver_bounds_f, h5pset_link_phase_change_f, &
      & h5pset_obj_track_times_f, h5pset_shuffle_f, h5s_scalar_f, h5screate_f, h5t_fortran_s1, h5t_native_double, &
      & h5t_native_integer, h5t_std_i32le, h5tcopy_f, h5tset_size_f, hid_t, hsize_t, size_t
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_output_file, only : output_file, remove_file
   use contact_hdf5_failing_disk, only : close_deleted, write_empty
   use contact_output_finished_file, only : move_file
   implicit none (type, external)
   private

   public :: clock, compression_level, hdf5_container, large, max_chunk, max_text_length

   !> Maximum length of a stored text; longer ones are truncated [characters]
   integer, parameter :: max_text_length = 1000
   !> Arrays of at least this size are stored in chunks with checksums; smaller ones fit in the header of their dataset [bytes]
   integer, parameter :: large = 4096
   !> Maximum number of elements of a chunk: 1 MB of numbers, the size of the chunk cache of each dataset in HDF5
   integer, parameter :: max_chunk = 131072
   !> Suffix of the name of the file that is being written, and of a copy until it is complete
   character(len=*), parameter :: unfinished = ".tmp", incomplete = ".part"
   !> Fill values that HDF5 returns for missing chunks: a NaN whose payload is "contac", and the smallest element state. All chunks
   !> are written, so a file that returns one of them is damaged; a missing value is another NaN
   integer(long), parameter :: lost_number = int(z'7FF8636F6E746163', long)
   integer, parameter :: lost_state = -128
   !> Level of deflate: higher levels take longer and gain little
   integer, parameter :: compression_level = 4

   !> An open file
   type :: hdf5_container
      !> Name of the complete file
      character(len=:), allocatable :: name
      logical :: is_open = .false.
      !> Has any call failed since the file was opened?
      logical :: failed = .false.
      !> Description of what is missing in the file apart from results; unallocated: nothing
      character(len=:), allocatable :: lacking
      !> Identifier of the file
      integer(hid_t) :: file = -1
      !> Creation properties of datasets that are stored in the header of their object
      integer(hid_t) :: compact = -1
      !> Dataspace of a single value
      integer(hid_t) :: scalar = -1
      !> Creation properties of groups
      integer(hid_t), private :: groups = -1
      !> Datatypes of texts by their length; -1 until the first use
      integer(hid_t), private :: texts(max_text_length) = -1
   contains
      !> Create a file; or copy an existing one and continue with the copy
      procedure :: create
      procedure :: reopen
      !> Close a copy that cannot be used, and report it
      procedure :: refuse
      !> Close the file and rename it to its final name
      procedure :: close_file
      !> Publish a copy of what was written so far under the name of the results
      procedure :: publish
      !> Size of the file that is being written [bytes]
      procedure :: bytes_so_far
      !> Groups
      procedure :: new_group
      procedure :: remove_group
      !> Creation properties of a chunked dataset
      procedure :: chunked
      !> Datatype of a text
      procedure :: text_type
      !> Attributes: set a text of any object, an integer of the file; remove one of the file
      procedure :: set_text
      procedure :: describe
      procedure :: set_count
      procedure :: drop_attribute
      !> Check the status of a call of HDF5; release an identifier
      procedure :: check
      procedure :: release
   end type hdf5_container

contains

   !> Create a file
   subroutine create(self, name, error)
      class(hdf5_container), intent(inout) :: self
      !> Name of the complete file
      character(len=*), intent(in) :: name
      !> Allocated if the file cannot be written
      type(error_type), allocatable, intent(out) :: error

      call open_unfinished(self, name, .false., error)
   end subroutine create

   !> Continue a file: a copy of it becomes the file that is written
   subroutine reopen(self, name, error)
      class(hdf5_container), intent(inout) :: self
      !> Name of the complete file
      character(len=*), intent(in) :: name
      !> Allocated if the file cannot be read or written
      type(error_type), allocatable, intent(out) :: error
      integer :: status

      call copy_bytes(name, name // unfinished, status)
      if (status == 0) then
         call open_unfinished(self, name, .true., error)
      else
         self%name = name
         call self%refuse(error)
      end if
   end subroutine reopen

   !> Close a reopened file whose content is not as expected; the file of the final name is unchanged
   subroutine refuse(self, error)
      class(hdf5_container), intent(inout) :: self
      !> Always allocated
      type(error_type), allocatable, intent(out) :: error

      if (self%is_open) call close_deleted(self%file)
      self%is_open = .false.
      call remove_file(self%name // unfinished)
      call fatal_error(error, "the file cannot be read to continue it", error_kind%file, self%name)
   end subroutine refuse

   !> Create or open the file under its temporary name
   subroutine open_unfinished(self, name, again, error)
      class(hdf5_container), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Open the existing file?
      logical, intent(in) :: again
      type(error_type), allocatable, intent(out) :: error
      integer(hid_t) :: access, creation
      integer :: status

      self%name = name
      if (allocated(self%lacking)) deallocate(self%lacking)
      call leave_exit_alone()
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5pcreate_f(h5p_file_access_f, access, status)
      ! `close_deleted` relies on this driver, which writes by a descriptor of the system
      call h5pset_fapl_sec2_f(access, status)
      ! objects that are still open after a failure are closed with the file
      call h5pset_fclose_degree_f(access, h5f_close_strong_f, status)
      ! newer layouts mark a file as open, and refuse it after a program was killed. The group of all cases has the oldest layout:
      ! in groups of newer layouts, Octave scans all names for each name
      call h5pset_libver_bounds_f(access, h5f_libver_earliest_f, h5f_libver_v18_f, status)
      call h5pcreate_f(h5p_file_create_f, creation, status)
      call h5pset_istore_k_f(creation, 8, status)
      status = 0
      if (.not. again) call write_empty(name // unfinished, creation, access, status)
      if (status >= 0) call h5fopen_f(name // unfinished, h5f_acc_rdwr_f, self%file, status, access)
      call self%check(status)
      call self%release(creation)
      call self%release(access)
      self%is_open = .not. self%failed
      if (self%is_open) call make_properties(self)
      if (.not. self%failed) return
      if (self%is_open) call close_deleted(self%file)
      self%is_open = .false.
      call remove_file(name // unfinished)
      call fatal_error(error, "the file cannot be written", error_kind%file, name)
   end subroutine open_unfinished

   !> Create the properties shared by most objects of the file
   subroutine make_properties(self)
      class(hdf5_container), intent(inout) :: self
      integer :: status

      call use_small_headers(self%file, status)
      call self%check(status)
      call h5screate_f(h5s_scalar_f, self%scalar, status)
      call h5pcreate_f(h5p_group_create_f, self%groups, status)
      call h5pset_link_phase_change_f(self%groups, 100, 50, status)
      call h5pset_obj_track_times_f(self%groups, .false., status)
      call h5pcreate_f(h5p_dataset_create_f, self%compact, status)
      call h5pset_obj_track_times_f(self%compact, .false., status)
      call h5pset_layout_f(self%compact, h5d_compact_f, status)
      call h5pset_fill_time_f(self%compact, h5d_fill_time_never_f, status)
   end subroutine make_properties

   !> Disable the clean-up of the HDF5 library at the exit of the process: after a failed write it would write again, and crash the
   !> host
   subroutine leave_exit_alone()
      interface
         function dont_atexit() result(status) bind(c, name="H5dont_atexit")
            import :: c_int
            integer(c_int) :: status
         end function dont_atexit
      end interface
      integer(c_int) :: ignored

      ! fails if the library is in use already; then the choice of its other user applies
      ignored = dont_atexit()
   end subroutine leave_exit_alone

   !> Create all further objects in the layout of HDF5 1.8, whose headers are smaller than those of the oldest
   subroutine use_small_headers(file, status)
      integer(hid_t), intent(in) :: file
      integer, intent(out) :: status
      interface
         function set_bounds(file, lowest, highest) result(status) bind(c, name="H5Fset_libver_bounds")
            import :: c_int, c_int64_t
            integer(c_int64_t), value :: file
            integer(c_int), value :: lowest, highest
            integer(c_int) :: status
         end function set_bounds
      end interface

      status = set_bounds(int(file, c_int64_t), int(h5f_libver_v18_f, c_int), int(h5f_libver_v18_f, c_int))
   end subroutine use_small_headers

   !> Close the file and rename it to its final name
   subroutine close_file(self, error)
      class(hdf5_container), intent(inout) :: self
      !> Allocated if any call has failed since the file was opened
      type(error_type), allocatable, intent(out) :: error
      integer :: k, status

      status = 0
      do k = 1, max_text_length
         if (self%texts(k) >= 0) call self%release(self%texts(k))
      end do
      call self%release(self%scalar)
      call self%release(self%groups)
      call self%release(self%compact)
      ! a failure is known before the file is closed
      if (.not. self%failed) call h5fflush_f(self%file, h5f_scope_local_f, status)
      call self%check(status)
      if (self%failed) then
         call close_deleted(self%file)
      else
         call h5fclose_f(self%file, status)
         call self%check(status)
      end if
      self%is_open = .false.
      if (.not. self%failed) call self%check(-abs(move_file(self%name // unfinished, self%name)))
      if (.not. self%failed) then
         if (allocated(self%lacking)) call fatal_error(error, self%lacking, error_kind%file, self%name)
         return
      end if
      ! the file of the final name is the last complete copy
      call remove_file(self%name // unfinished)
      call fatal_error(error, "cases are missing, because a write failed; is the disk full?", &
         & error_kind%file, self%name)
   end subroutine close_file

   !> Flush the file and copy it; the complete copy is renamed to the name of the results
   subroutine publish(self)
      class(hdf5_container), intent(inout) :: self
      integer :: status

      if (self%failed) return
      call h5fflush_f(self%file, h5f_scope_local_f, status)
      call self%check(status)
      if (self%failed) return
      call copy_bytes(self%name // unfinished, self%name // incomplete, status)
      if (status == 0) status = move_file(self%name // incomplete, self%name)
      if (status /= 0) call remove_file(self%name // incomplete)
      call self%check(-abs(status))
   end subroutine publish

   !> Copy a file
   subroutine copy_bytes(from, to, status)
      character(len=*), intent(in) :: from, to
      !> 0 if the copy is complete
      integer, intent(out) :: status
      integer, parameter :: piece = 2**20
      character(len=:), allocatable :: buffer, reason
      type(output_file) :: copy
      integer :: source
      integer(long) :: left
      logical :: complete

      inquire(file=from, size=left)
      open(newunit=source, file=from, access="stream", action="read", status="old", iostat=status)
      if (status /= 0) return
      call copy%open_file(to, reason)
      do while (status == 0 .and. left > 0)
         allocate(character(len=int(min(left, int(piece, long)))) :: buffer)
         read(source, iostat=status) buffer
         call copy%bytes(buffer)
         left = left - len(buffer)
         deallocate(buffer)
      end do
      close(source)
      call copy%close_file(complete)
      if (allocated(reason) .or. .not. complete) status = 1
   end subroutine copy_bytes

   !> Size of the file that is being written [bytes]
   integer(long) function bytes_so_far(self) result(bytes)
      class(hdf5_container), intent(in) :: self

      inquire(file=self%name // unfinished, size=bytes)
      bytes = max(bytes, 0_long)
   end function bytes_so_far

   !> Create a group
   subroutine new_group(self, parent, name, group)
      class(hdf5_container), intent(inout) :: self
      !> Parent group; `self%file` for the top level
      integer(hid_t), intent(in) :: parent
      !> Name within the parent group
      character(len=*), intent(in) :: name
      !> The open group
      integer(hid_t), intent(out) :: group
      integer :: status

      call h5gcreate_f(parent, name, group, status, gcpl_id=self%groups)
      call self%check(status)
   end subroutine new_group

   !> Remove a group of the top level; nothing if there is none of that name
   subroutine remove_group(self, name)
      class(hdf5_container), intent(inout) :: self
      !> Name without slash
      character(len=*), intent(in) :: name
      integer :: status
      logical :: is_there

      call h5lexists_f(self%file, name, is_there, status)
      if (status >= 0 .and. is_there) call h5ldelete_f(self%file, name, status)
      call self%check(status)
   end subroutine remove_group

   !> Creation properties of a chunked dataset with checksums
   subroutine chunked(self, chunk, properties, compressed, states)
      class(hdf5_container), intent(inout) :: self
      !> Shape of a chunk
      integer(hsize_t), intent(in) :: chunk(:)
      !> Property list, to be released by the caller
      integer(hid_t), intent(out) :: properties
      !> Compress the chunks? Are the values element states? Otherwise numbers
      logical, intent(in) :: compressed, states
      integer :: status

      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_obj_track_times_f(properties, .false., status)
      if (states) then
         call h5pset_fill_value_f(properties, h5t_native_integer, lost_state, status)
      else
         call h5pset_fill_value_f(properties, h5t_native_double, transfer(lost_number, 0.0_wp), status)
      end if
      call h5pset_chunk_f(properties, size(chunk), chunk, status)
      ! checksum of the uncompressed values, so that a damaged filter mask is detected as well
      call h5pset_fletcher32_f(properties, status)
      if (compressed) then
         call h5pset_shuffle_f(properties, status)
         call h5pset_deflate_f(properties, compression_level, status)
      end if
      call self%check(status)
   end subroutine chunked

   !> Datatype of a text of fixed length
   integer(hid_t) function text_type(self, length) result(kind)
      class(hdf5_container), intent(inout) :: self
      !> Length [characters]
      integer, intent(in) :: length
      integer :: n, status

      n = min(max(1, length), max_text_length)
      if (self%texts(n) < 0) then
         call h5tcopy_f(h5t_fortran_s1, self%texts(n), status)
         call h5tset_size_f(self%texts(n), int(n, size_t), status)
         call self%check(status)
      end if
      kind = self%texts(n)
   end function text_type

   !> Set a text as an attribute of an object
   subroutine set_text(self, object, name, value)
      class(hdf5_container), intent(inout) :: self
      !> Group or dataset, or `self%file`
      integer(hid_t), intent(in) :: object
      !> Name of the attribute, and its content
      character(len=*), intent(in) :: name, value
      integer(hid_t) :: attribute, kind
      integer(hsize_t) :: one(1)
      integer :: status

      one = 1
      kind = self%text_type(max(1, len(value)))
      call h5acreate_f(object, name, kind, self%scalar, attribute, status)
      call self%check(status)
      if (len(value) > 0) call h5awrite_f(attribute, kind, value, one, status)
      call self%release(attribute)
   end subroutine set_text

   !> Set the description and the unit of an object
   subroutine describe(self, object, unit, title)
      class(hdf5_container), intent(inout) :: self
      !> Dataset
      integer(hid_t), intent(in) :: object
      !> Unit, "-" for a ratio (written as 1, as in the conventions that the file follows), "" for none; and description
      character(len=*), intent(in) :: unit, title

      if (unit == "-") then
         call self%set_text(object, "units", "1")
      else if (len(unit) > 0) then
         call self%set_text(object, "units", unit)
      end if
      if (len(title) > 0) call self%set_text(object, "long_name", title)
   end subroutine describe

   !> Set an integer attribute of the file, replacing one of that name
   subroutine set_count(self, name, value)
      class(hdf5_container), intent(inout) :: self
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> New value
      integer, intent(in) :: value
      integer(hid_t) :: attribute
      integer(hsize_t) :: one(1)
      integer :: status

      if (self%failed) return
      call self%drop_attribute(name)
      one = 1
      call h5acreate_f(self%file, name, h5t_std_i32le, self%scalar, attribute, status)
      call self%check(status)
      call h5awrite_f(attribute, h5t_native_integer, value, one, status)
      call self%check(status)
      call self%release(attribute)
   end subroutine set_count

   !> Remove an attribute of the file; nothing if there is none of that name
   subroutine drop_attribute(self, name)
      class(hdf5_container), intent(inout) :: self
      !> Name as in the file
      character(len=*), intent(in) :: name
      logical :: is_there
      integer :: status

      call h5aexists_f(self%file, name, is_there, status)
      if (status >= 0 .and. is_there) call h5adelete_f(self%file, name, status)
      call self%check(status)
   end subroutine drop_attribute

   !> Time since an arbitrary origin [s]
   real(wp) function clock() result(seconds)
      integer(long) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function clock

   !> Record whether a call failed
   subroutine check(self, status)
      class(hdf5_container), intent(inout) :: self
      !> Status returned by HDF5, negative for a failure
      integer, intent(in) :: status
      if (status < 0) self%failed = .true.
   end subroutine check

   !> Close an object. Buffered data of it are written, so this can fail as writing can
   subroutine release(self, id)
      class(hdf5_container), intent(inout) :: self
      !> Identifier of the object
      integer(hid_t), intent(in) :: id
      integer :: count, status

      call h5idec_ref_f(id, count, status)
      call self%check(status)
   end subroutine release
end module contact_hdf5_container
