!> One HDF5 file per experiment: inputs, totals, fields and how they were obtained, case by case
!>
!> Layout, see doc/user/results.md:
!>
!>     /cases/<name>, /patches/<name>     totals as columns over all cases and patches
!>     /case_0001/inputs/<group>/<name>
!>     /case_0001/patch_1/totals/<name>, solver/<name>, fields/<name>, grid/<name>, subsurface/block_1/<name>
!>
!> Groups and fields that are as they were in the case before are stored once and linked.
!>
!> HDF5 writes what has changed in an order of its own, so a file that is being written may be unreadable at any moment.
!> It has therefore a name of its own until it is closed. From time to time it is brought up to date and copied, and the
!> copy takes the name of the results in one step: under that name stands a readable file at all times, however
!> violently the program ends. Small arrays lie in the heads of their objects, large ones are compressed.
module contact_hdf5_file
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t
   use hdf5, only : h5acreate_f, h5adelete_f, h5aexists_f, h5awrite_f, h5d_compact_f, h5d_fill_time_never_f, h5dcreate_f, &
      & h5dget_space_f, h5dopen_f, h5dread_f, h5dset_extent_f, h5dwrite_f, h5eset_auto_f, h5f_acc_rdwr_f, &
      & h5f_acc_trunc_f, h5f_close_strong_f, h5f_libver_earliest_f, h5fopen_f, h5gget_obj_info_idx_f, h5gn_members_f, &
      & h5gopen_f, h5ldelete_f, h5lexists_f, h5sget_simple_extent_dims_f, &
      & h5f_libver_v18_f, h5f_scope_local_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5gcreate_f, h5idec_ref_f, h5lcreate_hard_f, &
      & h5olink_f, h5open_f, h5p_dataset_create_f, h5p_file_access_f, &
      & h5p_file_create_f, h5p_group_create_f, h5pcopy_f, h5pcreate_f, h5pset_chunk_f, h5pset_deflate_f, h5pset_fclose_degree_f, &
      & h5pset_fletcher32_f, &
      & h5pset_fill_time_f, h5pset_fill_value_f, h5pset_istore_k_f, h5pset_layout_f, &
      & h5pset_libver_bounds_f, h5pset_link_phase_change_f, h5pset_obj_track_times_f, h5pset_shuffle_f, h5s_scalar_f, &
      & h5s_select_set_f, h5s_unlimited_f, h5screate_f, h5screate_simple_f, h5sselect_hyperslab_f, &
      & h5t_fortran_s1, h5t_ieee_f64le, h5t_native_double, h5t_native_integer, h5t_std_i32le, h5t_std_i8le, &
      & h5tcopy_f, h5tset_size_f, hid_t, hsize_t, size_t
   use contact_base_error, only : error_kind, error_type, fatal_error
   use contact_base_kinds, only : long, wp
   use contact_base_output_file, only : output_file, remove_file
   use contact_output_finished_file, only : move_file
   use contact_output_record, only : record_writer
   implicit none (type, external)
   private

   public :: hdf5_file

   !> Number of this layout
   integer, parameter :: layout = 1
   !> Longest name of a value, unit, description
   integer, parameter :: name_length = 32, unit_length = 16, title_length = 80
   !> Rows of the columns that are kept back at most, and rows of a chunk
   integer, parameter :: most_rows = 4096, chunk_rows = 64
   !> Added to the name of the file that is being written, and of a copy until it is complete
   character(len=*), parameter :: unfinished = ".tmp", incomplete = ".part"
   !> What HDF5 gives where it does not find a piece of an array: a NaN that says "contac" and the smallest element state. Every
   !> piece is written, so a reader that meets one of them has a damaged file; what a row does not have is another NaN
   integer(long), parameter :: lost_number = int(z'7FF8636F6E746163', long)
   integer, parameter :: lost_state = -128
   !> Arrays of at least this size are compressed [bytes]; elements of a chunk at most
   integer, parameter :: large = 4096, most_of_a_chunk = 131072
   !> A usual and cheap level of deflate
   integer, parameter :: effort = 4
   !> The readable file is brought up to date after this many times the time that a copy takes; after the fewer when
   !> that is longer than the time [s]
   real(wp), parameter :: waits_per_copy = 50.0_wp, fewer_waits = 20.0_wp, usual_wait = 1.0_wp

   !> Groups inside each other at most
   integer, parameter :: deepest = 8
   !> Longest text
   integer, parameter :: longest_text = 1000

   type :: item_kind_list
      integer :: real_number = 1, real_numbers = 2, whole = 3, text = 4, flag = 5
   end type item_kind_list
   type(item_kind_list), parameter :: item_kind = item_kind_list()

   !> One named value
   type :: item
      character(len=name_length) :: name
      character(len=unit_length) :: unit
      character(len=title_length) :: title
      !> Member of item_kind
      integer :: kind = 0
      real(wp) :: value = 0.0_wp
      real(wp), allocatable :: values(:)
      character(len=:), allocatable :: text
   end type item

   !> A group or field that was written and can be linked again
   type :: kept_object
      !> Place in a case, such as "1/0/patch_1/fields/pn"
      character(len=:), allocatable :: place
      !> Open object
      integer(hid_t) :: id = -1
      !> What it holds: values of a field and their shape, or items of a group
      real(wp), allocatable :: values(:)
      integer(hsize_t), allocatable :: dims(:)
      type(item), allocatable :: items(:)
   end type kept_object

   !> One column of totals over all cases or patches
   type :: column
      character(len=name_length) :: name
      integer(hid_t) :: id = -1
   end type column

   !> Columns with the same rows
   type :: column_table
      integer(hid_t) :: group = -1
      integer :: used = 0
      type(column), allocatable :: columns(:)
      !> Values that are not on disk yet, shape (most_rows, columns)
      real(wp), allocatable :: pending(:, :)
      !> Rows on disk, and rows in pending
      integer :: written = 0, waiting = 0
   end type column_table

   !> The file
   type, extends(record_writer) :: hdf5_file
      character(len=:), allocatable :: name
      logical :: is_open = .false.
      !> Did anything go wrong?
      logical :: failed = .false.
      integer(hid_t), private :: file = -1
      !> Creation properties: file, groups, datasets in their head
      integer(hid_t), private :: groups = -1, small = -1, bare = -1
      integer(hid_t), private :: scalar = -1
      !> Types of texts by length; -1 when not made yet
      integer(hid_t), private :: texts(longest_text) = -1
      !> The group in the making
      integer(hid_t), private :: here = -1
      !> The groups around it
      integer(hid_t), private :: around(deepest) = -1
      integer, private :: depth = 0
      !> Its place among kept objects
      character(len=:), allocatable, private :: place
      !> The group of values in the making
      character(len=:), allocatable, private :: leaf
      logical, private :: as_columns = .false., only_texts = .false.
      integer, private :: count_items = 0
      type(item), allocatable, private :: items(:)
      !> Objects of the cases before; the one found last, because they come in the same order
      integer, private :: kept_count = 0, last_kept = 0
      type(kept_object), allocatable, private :: kept(:)
      !> Totals of cases and of patches; which of them is open
      type(column_table), private :: cases, patches
      logical, private :: in_patch = .false.
      real(wp), private :: last_copy = 0.0_wp, wait = 0.0_wp
   contains
      procedure :: open_file
      !> Go on with a file, its rows of /cases and /patches
      procedure :: open_again
      procedure :: rows
      procedure :: cut
      procedure :: close_file
      !> Begin and end a case
      procedure :: begin_case
      procedure :: end_case
      !> Begin and end a group of groups in the case
      procedure :: enter
      procedure :: leave
      !> A row of the columns of cases, or of patches
      procedure :: begin_row
      !> An array over the elements, shape (mx, my), or the points of a block, shape (nx, ny, nz)
      procedure :: field
      procedure :: division
      procedure :: block
      procedure :: open_group
      procedure :: close_group
      !> Instead of close_group: the values become attributes of the file
      procedure :: close_attributes
      !> Bring the readable file up to date
      procedure :: renew
      !> Size of the file in the making [bytes]
      procedure :: bytes_so_far
      procedure :: number
      procedure :: numbers
      procedure :: count => whole_number
      procedure :: text
      procedure :: flag
      procedure, private :: find_kept
      procedure, private :: text_type
      procedure, private :: describe
      procedure, private :: set_count
      !> Remove an attribute of the file
      procedure :: drop_attribute
      procedure, private :: check
      procedure, private :: release
   end type hdf5_file

contains

   !> Make the file
   subroutine open_file(self, name, experiment, version, error)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Name of the experiment, and of the program that writes
      character(len=*), intent(in) :: experiment, version
      type(error_type), allocatable, intent(out) :: error

      call open_under(self, name, .false., error)
      if (allocated(error)) return
      call start_table(self%cases, "cases")
      call start_table(self%patches, "patches")
      call self%describe(self%file, "title", "results of CONTACT")
      call self%describe(self%file, "experiment", experiment)
      call self%describe(self%file, "program", version)
      call self%describe(self%file, "axes", "datasets of fields have the shape (my, mx) in C, h5py and NumPy")
      call self%set_count("layout", layout)

   contains

      subroutine start_table(table, group)
         type(column_table), intent(inout) :: table
         character(len=*), intent(in) :: group
         integer :: status

         call h5gcreate_f(self%file, group, table%group, status)
         call self%check(status)
         allocate(table%columns(64), table%pending(most_rows, 64))
      end subroutine start_table
   end subroutine open_file

   !> Go on with a file of results: a copy of it becomes the one that is written
   subroutine open_again(self, name, error)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      integer :: status

      call copy_bytes(name, name // unfinished, status)
      if (status == 0) call open_under(self, name, .true., error)
      if (allocated(error)) return
      if (status == 0) then
         call open_table(self, "cases", self%cases)
         call open_table(self, "patches", self%patches)
         if (.not. self%failed) return
         call h5fclose_f(self%file, status)
         self%is_open = .false.
      end if
      call remove_file(name // unfinished)
      call fatal_error(error, "the file cannot be read to go on with it", error_kind%file, name)
   end subroutine open_again

   !> The columns of a table that is there
   subroutine open_table(self, group, table)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: group
      type(column_table), intent(inout) :: table
      character(len=name_length) :: name
      integer(hsize_t) :: most(1), rows(1)
      integer(hid_t) :: space
      integer :: k, kind, n, status

      call h5gopen_f(self%file, group, table%group, status)
      call self%check(status)
      call h5gn_members_f(self%file, group, n, status)
      call self%check(status)
      if (self%failed) return
      allocate(table%columns(max(64, n)), table%pending(most_rows, max(64, n)))
      do k = 1, n
         call h5gget_obj_info_idx_f(self%file, group, k - 1, name, kind, status)
         call self%check(status)
         if (self%failed) return
         table%columns(k)%name = name
         call h5dopen_f(table%group, trim(name), table%columns(k)%id, status)
         call self%check(status)
         if (self%failed) return
         table%used = k
         call h5dget_space_f(table%columns(k)%id, space, status)
         call h5sget_simple_extent_dims_f(space, rows, most, status)
         call self%check(status)
         call self%release(space)
         if (k > 1 .and. table%written /= rows(1)) self%failed = .true.
         table%written = int(rows(1))
      end do
   end subroutine open_table

   !> Number of rows of a table
   pure integer function rows(self, patch)
      class(hdf5_file), intent(in) :: self
      !> Of that of patches, or of cases?
      logical, intent(in) :: patch

      rows = self%cases%written + self%cases%waiting
      if (patch) rows = self%patches%written + self%patches%waiting
   end function rows

   !> Leave out what was written behind some rows
   subroutine cut(self, cases, patches, name_of)
      class(hdf5_file), intent(inout) :: self
      !> Rows that stay
      integer, intent(in) :: cases, patches
      interface
         !> Name of the group of a case
         function name_of(case_number, result_element, contact_problem) result(name)
            integer, intent(in) :: case_number, result_element, contact_problem
            character(len=48) :: name
         end function name_of
      end interface
      character(len=48) :: name
      real(wp), allocatable :: columns(:, :)
      integer :: k, status
      logical :: is_there

      if (self%cases%written > cases) then
         allocate(columns(self%cases%written, 3))
         call read_column(self, self%cases, "case", columns(:, 1))
         call read_column(self, self%cases, "result_element", columns(:, 2))
         call read_column(self, self%cases, "contact_problem", columns(:, 3))
         do k = cases + 1, self%cases%written
            if (self%failed) return
            name = name_of(nint(columns(k, 1)), nint(columns(k, 2)), nint(columns(k, 3)))
            call h5lexists_f(self%file, trim(name), is_there, status)
            if (status >= 0 .and. is_there) call h5ldelete_f(self%file, trim(name), status)
            call self%check(status)
         end do
      end if
      call cut_table(self%cases, cases)
      call cut_table(self%patches, patches)

   contains

      subroutine cut_table(table, rows)
         type(column_table), intent(inout) :: table
         integer, intent(in) :: rows
         integer(hsize_t) :: total(1)

         total = rows
         do k = 1, table%used
            if (table%written == rows) exit
            call h5dset_extent_f(table%columns(k)%id, total, status)
            call self%check(status)
         end do
         table%written = rows
      end subroutine cut_table
   end subroutine cut

   !> A column of a table
   subroutine read_column(self, table, name, values)
      class(hdf5_file), intent(inout) :: self
      type(column_table), intent(in) :: table
      character(len=*), intent(in) :: name
      !> As many as there are rows on disk
      real(wp), intent(out), contiguous :: values(:)
      integer(hsize_t) :: total(1)
      integer :: k, status

      values = 0.0_wp
      total = size(values)
      status = -1
      do k = 1, table%used
         if (table%columns(k)%name == name) call h5dread_f(table%columns(k)%id, h5t_native_double, values, total, status)
      end do
      call self%check(status)
   end subroutine read_column

   !> Make a file under its name in the making, or open the one that is there
   subroutine open_under(self, name, again, error)
      class(hdf5_file), intent(inout) :: self
      !> Name in the end
      character(len=*), intent(in) :: name
      logical, intent(in) :: again
      type(error_type), allocatable, intent(out) :: error
      integer(hid_t) :: access, creation
      integer :: status

      self%name = name
      call leave_exit_alone()
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5pcreate_f(h5p_file_access_f, access, status)
      ! closing the file closes what a failure left open in it
      call h5pset_fclose_degree_f(access, h5f_close_strong_f, status)
      ! newer layouts mark an open file, and refuse it after the end of a program that was killed. The group of all cases
      ! has the oldest layout: of the newer ones Octave looks through all names for each name
      call h5pset_libver_bounds_f(access, h5f_libver_earliest_f, h5f_libver_v18_f, status)
      call h5pcreate_f(h5p_file_create_f, creation, status)
      call h5pset_istore_k_f(creation, 8, status)
      if (again) then
         call h5fopen_f(name // unfinished, h5f_acc_rdwr_f, self%file, status, access)
      else
         call h5fcreate_f(name // unfinished, h5f_acc_trunc_f, self%file, status, creation, access)
      end if
      call self%check(status)
      call self%release(creation)
      call self%release(access)
      if (self%failed) then
         call remove_file(name // unfinished)
         call fatal_error(error, "the file cannot be written", error_kind%file, name)
         return
      end if
      self%is_open = .true.
      call use_small_headers(self%file, status)
      call self%check(status)
      call h5screate_f(h5s_scalar_f, self%scalar, status)
      call h5pcreate_f(h5p_group_create_f, self%groups, status)
      call h5pset_link_phase_change_f(self%groups, 100, 50, status)
      call h5pset_obj_track_times_f(self%groups, .false., status)
      call h5pcreate_f(h5p_dataset_create_f, self%small, status)
      call h5pset_obj_track_times_f(self%small, .false., status)
      call h5pset_layout_f(self%small, h5d_compact_f, status)
      call h5pset_fill_time_f(self%small, h5d_fill_time_never_f, status)
      call h5pcopy_f(self%small, self%bare, status)
      call set_no_attributes(self%bare)
      allocate(self%items(100), self%kept(50))
      self%last_copy = clock()
      if (.not. self%failed) return
      call h5fclose_f(self%file, status)
      self%is_open = .false.
      call remove_file(name // unfinished)
      call fatal_error(error, "the file cannot be written", error_kind%file, name)
   end subroutine open_under

   !> Keep the library from ending itself when the process exits: after a write that failed it would write again, and crash the host
   subroutine leave_exit_alone()
      interface
         function dont_atexit() result(status) bind(c, name="H5dont_atexit")
            import :: c_int
            integer(c_int) :: status
         end function dont_atexit
      end interface
      integer(c_int) :: ignored

      ! fails when the library is in use already; then whoever uses it has chosen
      ignored = dont_atexit()
   end subroutine leave_exit_alone

   !> Objects that are made from now on have the layout of HDF5 1.8, with smaller heads than the oldest
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

   !> No room for attributes in the head of small datasets without any
   subroutine set_no_attributes(properties)
      integer(hid_t), intent(in) :: properties
      interface
         function set_hint(list, minimise) result(status) bind(c, name="H5Pset_dset_no_attrs_hint")
            import :: c_int, c_int64_t
            integer(c_int64_t), value :: list
            integer(c_int), value :: minimise
            integer(c_int) :: status
         end function set_hint
      end interface
      integer(c_int) :: ignored

      ignored = set_hint(int(properties, c_int64_t), 1_c_int)
   end subroutine set_no_attributes

   !> An integer as an attribute of the file; replaced when it is there
   subroutine set_count(self, name, value)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
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

   !> Remove an attribute of the file; nothing happens when it is not there
   subroutine drop_attribute(self, name)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical :: is_there
      integer :: status

      call h5aexists_f(self%file, name, is_there, status)
      if (status >= 0 .and. is_there) call h5adelete_f(self%file, name, status)
      call self%check(status)
   end subroutine drop_attribute

   !> The values of the group become attributes of the file
   subroutine close_attributes(self)
      class(hdf5_file), intent(inout) :: self
      integer :: i

      do i = 1, self%count_items
         if (self%failed) return
         associate (this => self%items(i))
            if (this%kind == item_kind%text) then
               call self%drop_attribute(trim(this%name))
               call self%describe(self%file, trim(this%name), this%text)
            else
               call self%set_count(trim(this%name), nint(this%value))
            end if
         end associate
      end do
   end subroutine close_attributes

   integer(long) function bytes_so_far(self) result(bytes)
      class(hdf5_file), intent(in) :: self

      inquire(file=self%name // unfinished, size=bytes)
      bytes = max(bytes, 0_long)
   end function bytes_so_far

   !> Bring the readable file up to date
   subroutine renew(self)
      class(hdf5_file), intent(inout) :: self
      real(wp) :: before, took

      before = clock()
      call write_rows(self, self%cases)
      call write_rows(self, self%patches)
      call renew_copy(self)
      self%last_copy = clock()
      took = self%last_copy - before
      self%wait = min(waits_per_copy*took, max(usual_wait, fewer_waits*took))
   end subroutine renew

   !> Write what is left and close
   subroutine close_file(self, error)
      class(hdf5_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      integer :: k, status

      if (.not. self%is_open) return
      call write_rows(self, self%cases)
      call write_rows(self, self%patches)
      do k = 1, self%kept_count
         if (self%kept(k)%id >= 0) call self%release(self%kept(k)%id)
      end do
      do k = 1, longest_text
         if (self%texts(k) >= 0) call self%release(self%texts(k))
      end do
      call close_table(self, self%cases)
      call close_table(self, self%patches)
      call self%release(self%scalar)
      call self%release(self%groups)
      call self%release(self%small)
      call self%release(self%bare)
      call h5fclose_f(self%file, status)
      call self%check(status)
      self%is_open = .false.
      if (.not. self%failed) call self%check(-abs(move_file(self%name // unfinished, self%name)))
      if (.not. self%failed) return
      ! what stands under the name is the last copy that was complete
      call remove_file(self%name // unfinished)
      call fatal_error(error, "cases are missing, because a write failed; is the disk full?", &
         & error_kind%file, self%name)
   end subroutine close_file

   subroutine close_table(self, table)
      class(hdf5_file), intent(inout) :: self
      type(column_table), intent(inout) :: table
      integer :: k

      do k = 1, table%used
         call self%release(table%columns(k)%id)
      end do
      call self%release(table%group)
   end subroutine close_table

   !> Remember that something went wrong
   subroutine check(self, status)
      class(hdf5_file), intent(inout) :: self
      integer, intent(in) :: status
      if (status < 0) self%failed = .true.
   end subroutine check

   !> Give an identifier back. What an object kept in memory is written now, so this fails as writing does
   subroutine release(self, id)
      class(hdf5_file), intent(inout) :: self
      integer(hid_t), intent(in) :: id
      integer :: count, status

      call h5idec_ref_f(id, count, status)
      call self%check(status)
   end subroutine release

   !> Begin a case
   subroutine begin_case(self, name, slot)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> Name of the contact problem to which the case belongs, as objects are kept for each
      character(len=*), intent(in) :: slot
      integer :: status

      call h5gcreate_f(self%file, name, self%here, status, gcpl_id=self%groups)
      call self%check(status)
      self%place = slot
   end subroutine begin_case

   !> End a case; the readable file has it now or soon
   subroutine end_case(self, finished)
      class(hdf5_file), intent(inout) :: self
      !> Cases of the run that are finished
      integer, intent(in) :: finished

      call self%release(self%here)
      if (clock() - self%last_copy < self%wait) return
      call self%set_count("cases_finished", finished)
      call self%renew()
   end subroutine end_case

   !> Time since some moment [s]
   real(wp) function clock() result(seconds)
      integer(long) :: ticks, rate

      call system_clock(ticks, rate)
      seconds = real(ticks, wp)/real(rate, wp)
   end function clock

   !> Bring the file up to date and copy it; the copy takes the name of the results when it is complete
   subroutine renew_copy(self)
      class(hdf5_file), intent(inout) :: self
      integer :: status

      if (self%failed) return
      call h5fflush_f(self%file, h5f_scope_local_f, status)
      call self%check(status)
      if (self%failed) return
      call copy_bytes(self%name // unfinished, self%name // incomplete, status)
      if (status == 0) status = move_file(self%name // incomplete, self%name)
      if (status /= 0) call remove_file(self%name // incomplete)
      call self%check(-abs(status))
   end subroutine renew_copy

   !> Copy a file
   subroutine copy_bytes(from, to, status)
      character(len=*), intent(in) :: from, to
      !> 0 when all of it has arrived
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

   !> Go into a new group of the case
   subroutine enter(self, name)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(hid_t) :: inner
      integer :: status

      call h5gcreate_f(self%here, name, inner, status, gcpl_id=self%groups)
      call self%check(status)
      self%depth = self%depth + 1
      self%around(self%depth) = self%here
      self%here = inner
      self%place = self%place // "/" // name
   end subroutine enter

   !> Back to the group around it
   subroutine leave(self)
      class(hdf5_file), intent(inout) :: self

      call self%release(self%here)
      self%here = self%around(self%depth)
      self%depth = self%depth - 1
      self%place = self%place(:index(self%place, "/", back=.true.) - 1)
   end subroutine leave

   !> Begin a row of the columns of cases, or of those of patches
   subroutine begin_row(self, patch)
      class(hdf5_file), intent(inout) :: self
      logical, intent(in) :: patch

      self%in_patch = patch
      if (patch) then
         call next_row(self, self%patches)
      else
         call next_row(self, self%cases)
      end if
   end subroutine begin_row

   !> Make room for a row
   subroutine next_row(self, table)
      class(hdf5_file), intent(inout) :: self
      type(column_table), intent(inout) :: table

      if (table%waiting == most_rows) call write_rows(self, table)
      table%waiting = table%waiting + 1
      table%pending(table%waiting, :) = ieee_value(0.0_wp, ieee_quiet_nan)
   end subroutine next_row

   !> Begin a group of values
   subroutine open_group(self, name, columns, brief)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(in), optional :: columns, brief

      self%leaf = name
      self%only_texts = .false.
      if (present(brief)) self%only_texts = brief
      self%as_columns = .false.
      if (present(columns)) self%as_columns = columns
      self%count_items = 0
   end subroutine open_group

   !> Write the group of values; what is as in the case before is linked, as a whole or one by one
   !>
   !> An empty name is that of values which are columns only.
   subroutine close_group(self)
      class(hdf5_file), intent(inout) :: self
      type(item), allocatable :: same(:)
      integer(hid_t) :: group
      integer :: i, k, status

      if (self%as_columns) then
         do i = 1, self%count_items
            if (self%in_patch) then
               call put(self, self%patches, self%items(i))
            else
               call put(self, self%cases, self%items(i))
            end if
         end do
      end if
      if (len(self%leaf) == 0 .or. self%failed) return
      if (self%only_texts) then
         k = 0
         do i = 1, self%count_items
            if (self%items(i)%kind /= item_kind%text) cycle
            k = k + 1
            if (i > k) self%items(k) = self%items(i)
         end do
         self%count_items = k
      end if
      call self%find_kept(self%place // "/" // self%leaf, k)
      if (allocated(self%kept(k)%items)) then
         if (same_items(self%kept(k)%items, self%items(:self%count_items))) then
            call h5olink_f(self%kept(k)%id, self%here, self%leaf, status)
            call self%check(status)
            return
         end if
      end if
      call h5gcreate_f(self%here, self%leaf, group, status, gcpl_id=self%groups)
      call self%check(status)
      do i = 1, self%count_items
         if (allocated(self%kept(k)%items)) then
            if (i <= size(self%kept(k)%items)) then
               if (same_item(self%kept(k)%items(i), self%items(i))) then
                  call h5lcreate_hard_f(self%kept(k)%id, trim(self%items(i)%name), group, trim(self%items(i)%name), status)
                  call self%check(status)
                  cycle
               end if
            end if
         end if
         call write_item(self, group, self%items(i))
      end do
      allocate(same(self%count_items))
      same = self%items(:self%count_items)
      call move_alloc(same, self%kept(k)%items)
      if (self%kept(k)%id >= 0) call self%release(self%kept(k)%id)
      self%kept(k)%id = group
   end subroutine close_group

   !> Have two groups the same names and values?
   pure logical function same_items(old, new) result(same)
      type(item), intent(in) :: old(:), new(:)
      integer :: i

      same = .false.
      if (size(old) /= size(new)) return
      do i = 1, size(new)
         if (.not. same_item(old(i), new(i))) return
      end do
      same = .true.
   end function same_items

   !> Have two values the same name and value?
   pure logical function same_item(old, new) result(same)
      type(item), intent(in) :: old, new

      same = .false.
      if (old%name /= new%name .or. old%kind /= new%kind) return
      if (.not. same_number(old%value, new%value)) return
      if (allocated(new%values)) then
         if (size(old%values) /= size(new%values)) return
         if (.not. all(same_number(old%values, new%values))) return
      end if
      if (allocated(new%text)) then
         if (len(old%text) /= len(new%text)) return
         if (old%text /= new%text) return
      end if
      same = .true.
   end function same_item

   !> Equal bit by bit
   elemental logical function same_number(a, b) result(same)
      real(wp), intent(in) :: a, b
      same = transfer(a, 0_long) == transfer(b, 0_long)
   end function same_number

   !> The place of an object among the kept ones; a new one when it is not there
   subroutine find_kept(self, place, k)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: place
      integer, intent(out) :: k
      type(kept_object), allocatable :: longer(:)
      integer :: i

      do i = 0, self%kept_count - 1
         k = modulo(self%last_kept + i, self%kept_count) + 1
         if (self%kept(k)%place /= place) cycle
         self%last_kept = k
         return
      end do
      if (self%kept_count == size(self%kept)) then
         allocate(longer(2*self%kept_count))
         do i = 1, self%kept_count
            longer(i)%id = self%kept(i)%id
            call move_alloc(self%kept(i)%place, longer(i)%place)
            call move_alloc(self%kept(i)%values, longer(i)%values)
            call move_alloc(self%kept(i)%dims, longer(i)%dims)
            call move_alloc(self%kept(i)%items, longer(i)%items)
         end do
         call move_alloc(longer, self%kept)
      end if
      self%kept_count = self%kept_count + 1
      k = self%kept_count
      self%kept(k)%place = place
      self%last_kept = k
   end subroutine find_kept

   !> Write one value as a dataset of its group
   subroutine write_item(self, group, this)
      class(hdf5_file), intent(inout) :: self
      integer(hid_t), intent(in) :: group
      type(item), intent(in), target :: this
      integer(hid_t) :: data, kind, properties, space
      integer(hsize_t) :: dims(1)
      integer :: status
      logical :: described

      described = .not. self%as_columns .and. len_trim(this%unit) > 0
      properties = self%bare
      if (described) properties = self%small
      dims = 1
      space = self%scalar
      select case (this%kind)
      case (item_kind%real_number)
         kind = h5t_ieee_f64le
      case (item_kind%real_numbers)
         kind = h5t_ieee_f64le
         dims = size(this%values, kind=hsize_t)
         call h5screate_simple_f(1, dims, space, status)
         if (size(this%values)*8 >= large) then
            ! too large for a head, whose checksum would cover them
            call h5pcreate_f(h5p_dataset_create_f, properties, status)
            call h5pset_obj_track_times_f(properties, .false., status)
            call h5pset_chunk_f(properties, 1, min(dims, int(most_of_a_chunk, hsize_t)), status)
            call h5pset_fletcher32_f(properties, status)
            call h5pset_fill_value_f(properties, h5t_native_double, transfer(lost_number, 0.0_wp), status)
            call self%check(status)
         end if
      case (item_kind%whole)
         kind = h5t_std_i32le
      case (item_kind%flag)
         kind = h5t_std_i8le
      case default
         kind = self%text_type(len(this%text))
      end select
      call h5dcreate_f(group, trim(this%name), kind, space, data, status, dcpl_id=properties)
      call self%check(status)
      if (all(properties /= [self%bare, self%small])) call self%release(properties)
      select case (this%kind)
      case (item_kind%real_number)
         call h5dwrite_f(data, h5t_native_double, this%value, dims, status)
      case (item_kind%real_numbers)
         if (size(this%values) > 0) call h5dwrite_f(data, h5t_native_double, this%values, dims, status)
         call self%release(space)
      case (item_kind%whole, item_kind%flag)
         call h5dwrite_f(data, h5t_native_integer, nint(this%value), dims, status)
      case default
         call h5dwrite_f(data, kind, this%text, dims, status)
      end select
      call self%check(status)
      if (described) then
         call self%describe(data, "units", trim(this%unit))
         call self%describe(data, "long_name", trim(this%title))
      end if
      call self%release(data)
   end subroutine write_item

   !> A text as an attribute
   subroutine describe(self, object, name, value)
      class(hdf5_file), intent(inout) :: self
      integer(hid_t), intent(in) :: object
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
   end subroutine describe

   !> Type of a text of fixed length
   integer(hid_t) function text_type(self, length) result(kind)
      class(hdf5_file), intent(inout) :: self
      integer, intent(in) :: length
      integer :: n, status

      n = min(max(1, length), longest_text)
      if (self%texts(n) < 0) then
         call h5tcopy_f(h5t_fortran_s1, self%texts(n), status)
         call h5tset_size_f(self%texts(n), int(n, size_t), status)
         call self%check(status)
      end if
      kind = self%texts(n)
   end function text_type

   !> Add a value to the group
   subroutine add_item(self, name, unit, title, kind, value, values, text)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title
      integer, intent(in) :: kind
      real(wp), intent(in) :: value
      real(wp), intent(in), optional :: values(:)
      character(len=*), intent(in), optional :: text
      type(item), allocatable :: longer(:)

      if (self%count_items == size(self%items)) then
         allocate(longer(2*self%count_items))
         longer(:self%count_items) = self%items
         call move_alloc(longer, self%items)
      end if
      self%count_items = self%count_items + 1
      associate (this => self%items(self%count_items))
         this%name = name
         this%unit = unit
         this%title = title
         this%kind = kind
         this%value = value
         if (allocated(this%values)) deallocate(this%values)
         if (allocated(this%text)) deallocate(this%text)
         if (present(values)) this%values = values
         if (present(text)) this%text = text(:min(len(text), longest_text))
      end associate
   end subroutine add_item

   subroutine number(self, name, unit, title, value)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title
      real(wp), intent(in) :: value
      call add_item(self, name, unit, title, item_kind%real_number, value)
   end subroutine number

   subroutine numbers(self, name, unit, title, values)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title
      real(wp), intent(in) :: values(:)
      call add_item(self, name, unit, title, item_kind%real_numbers, 0.0_wp, values)
   end subroutine numbers

   subroutine whole_number(self, name, title, value)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, title
      integer, intent(in) :: value
      call add_item(self, name, "", title, item_kind%whole, real(value, wp))
   end subroutine whole_number

   subroutine text(self, name, title, value)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, title, value

      if (len(value) > 0) then
         call add_item(self, name, "", title, item_kind%text, 0.0_wp, text=value)
      else
         call add_item(self, name, "", title, item_kind%text, 0.0_wp, text=" ")
      end if
   end subroutine text

   subroutine flag(self, name, title, value)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, title
      logical, intent(in) :: value
      call add_item(self, name, "", title, item_kind%flag, merge(1.0_wp, 0.0_wp, value))
   end subroutine flag

   !> Put a value into the last row of a table; texts have no columns
   subroutine put(self, table, this)
      class(hdf5_file), intent(inout) :: self
      type(column_table), intent(inout) :: table
      type(item), intent(in) :: this
      integer :: k

      if (this%kind == item_kind%text .or. this%kind == item_kind%real_numbers) return
      do k = 1, table%used
         if (table%columns(k)%name == this%name) exit
      end do
      if (k > table%used) call new_column(self, table, this)
      table%pending(table%waiting, k) = this%value
   end subroutine put

   !> A column that did not appear before; earlier rows are NaN
   subroutine new_column(self, table, this)
      class(hdf5_file), intent(inout) :: self
      type(column_table), intent(inout) :: table
      type(item), intent(in) :: this
      real(wp), allocatable :: earlier(:), wider(:, :)
      type(column), allocatable :: longer(:)
      integer(hid_t) :: properties, space
      integer(hsize_t) :: chunk(1), dims(1), most(1)
      integer :: status

      if (table%used == size(table%columns)) then
         allocate(longer(2*table%used), wider(most_rows, 2*table%used))
         longer(:table%used) = table%columns
         wider = ieee_value(0.0_wp, ieee_quiet_nan)
         wider(:, :table%used) = table%pending
         call move_alloc(longer, table%columns)
         call move_alloc(wider, table%pending)
      end if
      table%used = table%used + 1
      associate (new => table%columns(table%used))
         new%name = this%name
         chunk = chunk_rows
         dims = table%written
         most = h5s_unlimited_f
         call h5pcreate_f(h5p_dataset_create_f, properties, status)
         call h5pset_obj_track_times_f(properties, .false., status)
         call h5pset_chunk_f(properties, 1, chunk, status)
         call h5pset_fletcher32_f(properties, status)
         call h5pset_fill_value_f(properties, h5t_native_double, transfer(lost_number, 0.0_wp), status)
         call h5screate_simple_f(1, dims, space, status, most)
         call h5dcreate_f(table%group, trim(this%name), h5t_ieee_f64le, space, new%id, status, dcpl_id=properties)
         call self%check(status)
         if (table%written > 0) then
            allocate(earlier(table%written), source=ieee_value(0.0_wp, ieee_quiet_nan))
            call h5dwrite_f(new%id, h5t_native_double, earlier, dims, status)
            call self%check(status)
         end if
         call self%release(space)
         call self%release(properties)
         if (len_trim(this%unit) > 0) call self%describe(new%id, "units", trim(this%unit))
         call self%describe(new%id, "long_name", trim(this%title))
      end associate
   end subroutine new_column

   !> Write the rows that wait
   subroutine write_rows(self, table)
      class(hdf5_file), intent(inout) :: self
      type(column_table), intent(inout) :: table
      integer(hid_t) :: memory, space
      integer(hsize_t) :: first(1), length(1), total(1)
      integer :: k, status

      if (table%waiting == 0 .or. self%failed) return
      first = table%written
      length = table%waiting
      total = table%written + table%waiting
      call h5screate_simple_f(1, length, memory, status)
      do k = 1, table%used
         call h5dset_extent_f(table%columns(k)%id, total, status)
         call self%check(status)
         call h5dget_space_f(table%columns(k)%id, space, status)
         call h5sselect_hyperslab_f(space, h5s_select_set_f, first, length, status)
         call h5dwrite_f(table%columns(k)%id, h5t_native_double, table%pending(:table%waiting, k), length, status, memory, space)
         call self%check(status)
         call self%release(space)
      end do
      call self%release(memory)
      table%written = table%written + table%waiting
      table%waiting = 0
   end subroutine write_rows

   !> An array over the elements
   subroutine field(self, name, unit, title, values)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title
      !> Shape (mx, my)
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(hsize_t) :: dims(2)

      dims = shape(values, kind=hsize_t)
      call write_array(self, name, unit, title, values, dims, h5t_ieee_f64le, .true.)
   end subroutine field

   !> Element states
   subroutine division(self, name, title, states)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, title
      !> Shape (mx, my)
      integer, intent(in) :: states(:, :)
      real(wp), allocatable :: values(:, :)
      integer(hsize_t) :: dims(2)

      values = real(states, wp)
      dims = shape(values, kind=hsize_t)
      call write_array(self, name, "-", title, values, dims, h5t_std_i8le, .true.)
   end subroutine division

   !> An array over the points of a block
   subroutine block(self, name, unit, title, values, nx, ny, nz)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title
      !> Size nx ny nz, x fastest
      real(wp), intent(in), contiguous :: values(:)
      integer, intent(in) :: nx, ny, nz
      integer(hsize_t) :: dims(3)

      dims = int([nx, ny, nz], hsize_t)
      call write_array(self, name, unit, title, values, dims, h5t_ieee_f64le, .false.)
   end subroutine block

   !> Write an array, or link the one of the case before when it is the same
   subroutine write_array(self, name, unit, title, values, dims, kind, keep)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title
      integer(hsize_t), intent(in) :: dims(:)
      real(wp), intent(in), target :: values(product(dims))
      !> Type on disk
      integer(hid_t), intent(in) :: kind
      !> Look for the same array in the case before?
      logical, intent(in) :: keep
      integer(hid_t) :: data, properties, space
      integer(hsize_t) :: chunk(size(dims))
      integer :: k, status

      if (self%failed) return
      k = 0
      if (keep) then
         call self%find_kept(self%place // "/" // name, k)
         if (allocated(self%kept(k)%values)) then
            if (all(self%kept(k)%dims == dims)) then
               if (all(same_number(self%kept(k)%values, values))) then
                  call h5olink_f(self%kept(k)%id, self%here, name, status)
                  call self%check(status)
                  return
               end if
            end if
         end if
      end if
      properties = self%small
      if (8*size(values) >= large) then
         chunk = dims
         if (product(chunk) > most_of_a_chunk) &
            & chunk(size(chunk)) = max(1_hsize_t, most_of_a_chunk/product(chunk(:size(chunk) - 1)))
         call h5pcreate_f(h5p_dataset_create_f, properties, status)
         call h5pset_obj_track_times_f(properties, .false., status)
         if (kind == h5t_std_i8le) then
            call h5pset_fill_value_f(properties, h5t_native_integer, lost_state, status)
         else
            call h5pset_fill_value_f(properties, h5t_native_double, transfer(lost_number, 0.0_wp), status)
         end if
         call h5pset_chunk_f(properties, size(dims), chunk, status)
         ! of the values themselves: a damaged mask of the filters behind it is seen too
         call h5pset_fletcher32_f(properties, status)
         call h5pset_shuffle_f(properties, status)
         call h5pset_deflate_f(properties, effort, status)
      end if
      call h5screate_simple_f(size(dims), dims, space, status)
      call h5dcreate_f(self%here, name, kind, space, data, status, dcpl_id=properties)
      call self%check(status)
      call h5dwrite_f(data, h5t_native_double, values, [size(values, kind=hsize_t)], status)
      call self%check(status)
      if (len(unit) > 0) call self%describe(data, "units", unit)
      call self%describe(data, "long_name", title)
      call self%release(space)
      if (properties /= self%small) call self%release(properties)
      if (k > 0) then
         self%kept(k)%values = values
         self%kept(k)%dims = dims
         if (self%kept(k)%id >= 0) call self%release(self%kept(k)%id)
         self%kept(k)%id = data
      else
         call self%release(data)
      end if
   end subroutine write_array
end module contact_hdf5_file
