!> Origin of results: the group /provenance with the time, a copy of the input, and hashes of input and profiles
!>
!> The time is stored in /provenance/created/seconds, so that comparisons that skip times skip it as well.
module contact_hdf5_provenance
   use, intrinsic :: iso_c_binding, only : c_long, c_null_ptr, c_ptr
   use hdf5, only : h5dcreate_f, h5dget_type_f, h5dopen_f, h5dread_f, h5dwrite_f, h5gcreate_f, h5gopen_f, h5ldelete_f, &
      & h5lexists_f, h5p_dataset_create_f, h5pcreate_f, h5pset_chunk_f, h5pset_deflate_f, h5pset_fletcher32_f, &
      & h5pset_obj_track_times_f, h5screate_simple_f, h5t_fortran_s1, h5tcopy_f, h5tget_size_f, h5tset_size_f, hid_t, &
      & hsize_t, size_t
   use contact_base_error, only : error_type
   use contact_base_kinds, only : wp
   use contact_hdf5_container, only : compression_level, hdf5_container
   use contact_hdf5_scales, only : make_scale
   use contact_hdf5_values, only : write_value
   use contact_output_record, only : item_kind, named_value
   use contact_text_lexer, only : input_lexer
   use contact_text_sha256, only : sha256
   use contact_text_words, only : integer_text, replaced
   implicit none (type, external)
   private

   public :: provenance

   !> Data of the group while the file is open
   type :: provenance
      !> Identifier of the group
      integer(hid_t), private :: group = -1
      !> Folder to which names of files are relative, "" for the current one
      character(len=:), allocatable, private :: folder
      !> Names of the recorded profiles, each enclosed in ":"
      character(len=:), allocatable, private :: known
      integer, private :: profiles = 0
   contains
      !> Begin with the input, or with the record of an interrupted run
      procedure :: start
      procedure :: start_again
      !> Record a profile, at its first use
      procedure :: note_profile
      procedure :: release
   end type provenance

   character(len=*), parameter :: group_name = "provenance", profile_name = "profile_"

contains

   !> Write name, hash and copy of the input
   subroutine start(self, container, input, folder, below)
      class(provenance), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name of the input file, and folder to which names in it are relative
      character(len=*), intent(in) :: input, folder
      !> Folder below which files must be; absent: no restriction
      character(len=*), intent(in), optional :: below
      integer :: status

      self%folder = folder
      self%known = ":"
      call h5gcreate_f(container%file, group_name, self%group, status)
      call container%check(status)
      call write_time(container, self%group)
      call write_input(container, self%group, input, below)
   end subroutine start

   !> Write name, hash and copy of the input into a group
   subroutine write_input(container, group, input, below)
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Name of the input file
      character(len=*), intent(in) :: input
      !> Folder below which the input must be; absent: no restriction
      character(len=*), intent(in), optional :: below
      type(input_lexer) :: lexer
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text

      call lexer%open_file(input, error, below)
      if (allocated(error)) then
         container%lacking = "all results are present, but not the copy of the input: " // error%message
         return
      end if
      call lexer%get_text(text)
      call describe(container, group, "input_", input(index(input, "/", back=.true.) + 1:), text)
      call write_copy(container, group, text)
   end subroutine write_input

   !> Write the time at which the file was created
   subroutine write_time(container, group)
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      integer(hid_t) :: inner
      interface
         function seconds_now(place) result(seconds) bind(c, name="time")
            import :: c_long, c_ptr
            type(c_ptr), value :: place
            integer(c_long) :: seconds
         end function seconds_now
      end interface

      call container%new_group(group, "created", inner)
      if (.not. container%failed) call write_value(named_value("seconds", "seconds since 1970-01-01T00:00:00Z", &
         & "when the file was begun", item_kind%real_number, real(seconds_now(c_null_ptr), wp)), container, inner)
      call container%release(inner)
   end subroutine write_time

   !> Continue with an existing group: the input may have been corrected; profiles are those of the cases so far
   subroutine start_again(self, container, input, folder, below)
      class(provenance), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name of the input file, and folder to which names in it are relative
      character(len=*), intent(in) :: input, folder
      !> Folder below which files must be; absent: no restriction
      character(len=*), intent(in), optional :: below
      character(len=*), parameter :: changed(3) = [character(len=12) :: "input", "input_file", "input_sha256"]
      character(len=:), allocatable :: name
      logical :: is_there
      integer :: k, status

      call h5lexists_f(container%file, group_name, is_there, status)
      call container%check(status)
      if (.not. is_there) then
         ! written by an earlier version
         call self%start(container, input, folder, below)
         return
      end if
      self%folder = folder
      self%known = ":"
      call h5gopen_f(container%file, group_name, self%group, status)
      call container%check(status)
      do k = 1, size(changed)
         call h5lexists_f(self%group, trim(changed(k)), is_there, status)
         if (status >= 0 .and. is_there) call h5ldelete_f(self%group, trim(changed(k)), status)
         call container%check(status)
      end do
      call write_input(container, self%group, input, below)
      do
         call h5lexists_f(self%group, profile_name // integer_text(self%profiles + 1), is_there, status)
         call container%check(status)
         if (container%failed .or. .not. is_there) return
         self%profiles = self%profiles + 1
         call read_name(container, self%group, profile_name // integer_text(self%profiles) // "/file", name)
         self%known = self%known // name // ":"
      end do
   end subroutine start_again

   !> Read a text
   subroutine read_name(container, group, place, text)
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Name of the dataset
      character(len=*), intent(in) :: place
      character(len=:), allocatable, intent(out) :: text
      integer(hid_t) :: data, kind
      integer(hsize_t) :: one(1)
      integer(size_t) :: length
      integer :: status

      one = 1
      text = ""
      call h5dopen_f(group, place, data, status)
      call container%check(status)
      if (container%failed) return
      call h5dget_type_f(data, kind, status)
      call h5tget_size_f(kind, length, status)
      call container%check(status)
      deallocate(text)
      allocate(character(len=length) :: text)
      call h5dread_f(data, kind, text, one, status)
      call container%check(status)
      call container%release(kind)
      call container%release(data)
   end subroutine read_name

   !> Record name and hash of a profile file at its first use
   subroutine note_profile(self, container, name, confined)
      class(provenance), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name as in the input
      character(len=*), intent(in) :: name
      !> Must the file be below the folder of the experiment?
      logical, intent(in) :: confined
      type(input_lexer) :: lexer
      type(error_type), allocatable :: error
      !> `below` is the folder if files are confined to it; otherwise unallocated, which is absent in calls
      character(len=:), allocatable :: below, path, text
      integer(hid_t) :: group

      if (index(self%known, ":" // name // ":") > 0 .or. container%failed .or. self%group < 0) return
      self%known = self%known // name // ":"
      path = replaced(name, "\", "/")
      if (path(:1) /= "/" .and. len(self%folder) > 0) path = self%folder // "/" // path
      if (confined) below = self%folder
      call lexer%open_file(path, error, below)
      if (allocated(error)) then
         container%lacking = "all results are present, but not the hash of " // name // ": " // error%message
         return
      end if
      call lexer%get_text(text)
      self%profiles = self%profiles + 1
      call container%new_group(self%group, profile_name // integer_text(self%profiles), group)
      call describe(container, group, "", name, text)
      call container%release(group)
   end subroutine note_profile

   !> Write name and hash of a file
   subroutine describe(container, group, prefix, name, text)
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Prefix of the names of the datasets
      character(len=*), intent(in) :: prefix
      !> Name of the file, and its content
      character(len=*), intent(in) :: name, text

      call write_text("file", "name of the file", name)
      call write_text("sha256", "hash SHA-256 of its bytes", sha256(text))

   contains

      subroutine write_text(key, title, value)
         character(len=*), intent(in) :: key, title, value

         if (.not. container%failed) call write_value(named_value(prefix // key, "", title, item_kind%text, text=value), &
            & container, group)
      end subroutine write_text
   end subroutine describe

   !> Write all bytes of the input, as one text of its length
   subroutine write_copy(container, group, text)
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      character(len=*), intent(in) :: text
      integer(hid_t) :: data, kind, properties, space
      integer(hsize_t) :: one(1)
      integer :: status

      if (len(text) == 0 .or. container%failed) return
      one = 1
      call h5tcopy_f(h5t_fortran_s1, kind, status)
      call h5tset_size_f(kind, int(len(text), size_t), status)
      call container%check(status)
      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_obj_track_times_f(properties, .false., status)
      call h5pset_chunk_f(properties, 1, one, status)
      call h5pset_fletcher32_f(properties, status)
      call h5pset_deflate_f(properties, compression_level, status)
      call h5screate_simple_f(1, one, space, status)
      call container%check(status)
      call h5dcreate_f(group, "input", kind, space, data, status, dcpl_id=properties)
      call container%check(status)
      call h5dwrite_f(data, kind, text, one, status)
      call container%check(status)
      call container%describe(data, "", "copy of the input file")
      call make_scale(container, data)
      call container%release(data)
      call container%release(space)
      call container%release(properties)
      call container%release(kind)
   end subroutine write_copy

   !> Close the group
   subroutine release(self, container)
      class(provenance), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container

      if (self%group >= 0) call container%release(self%group)
      self%group = -1
   end subroutine release
end module contact_hdf5_provenance
