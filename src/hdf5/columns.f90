!> Totals over all cases, or all patches, as columns that grow by rows: /cases/<name> and /patches/<name>
!>
!> Rows are buffered and written in blocks. A value that a case does not have is NaN in its row.
module contact_hdf5_columns
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use hdf5, only : h5dcreate_f, h5dget_space_f, h5dopen_f, h5dread_f, h5dset_extent_f, h5dwrite_f, h5gcreate_f, &
      & h5gget_obj_info_idx_f, h5gn_members_f, h5gopen_f, h5s_select_set_f, h5s_unlimited_f, h5screate_simple_f, &
      & h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5sselect_hyperslab_f, h5t_ieee_f64le, h5t_native_double, &
      & hid_t, hsize_t
   use contact_base_kinds, only : wp
   use contact_hdf5_container, only : hdf5_container
   use contact_hdf5_scales, only : attach_scales, make_scale
   use contact_output_record, only : item_kind, name_length, named_value
   implicit none (type, external)
   private

   public :: column_table

   !> Maximum number of buffered rows, and rows of a chunk on disk
   integer, parameter :: max_rows = 4096, chunk_rows = 64
   !> Column that identifies the rows
   character(len=*), parameter :: row_name = "case"
   !> Initial number of allocated columns
   integer, parameter :: usual_columns = 64

   !> One column
   type :: column
      character(len=name_length) :: name
      integer(hid_t) :: id = -1
   end type column

   !> Columns of a table, which have the same rows
   type :: column_table
      integer(hid_t), private :: group = -1
      !> Number of columns
      integer, private :: used = 0
      type(column), allocatable, private :: columns(:)
      !> Buffered values, shape (max_rows, columns)
      real(wp), allocatable, private :: pending(:, :)
      !> Number of rows on disk, and of buffered rows
      integer :: written = 0
      integer, private :: waiting = 0
   contains
      !> Create an empty table, or open an existing one
      procedure :: create
      procedure :: reopen
      !> Number of rows
      procedure :: rows
      !> Begin a row; set a value of it
      procedure :: next_row
      procedure :: put
      !> Write the buffered rows
      procedure :: write_rows
      !> Read a column; remove rows at the end
      procedure :: read_column
      procedure :: cut
      procedure :: release
   end type column_table

contains

   !> Create an empty table
   subroutine create(self, container, name)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name of its group
      character(len=*), intent(in) :: name
      integer :: status

      call h5gcreate_f(container%file, name, self%group, status)
      call container%check(status)
      allocate(self%columns(usual_columns), self%pending(max_rows, usual_columns))
   end subroutine create

   !> Open the columns of an existing table
   subroutine reopen(self, container, name)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name of its group
      character(len=*), intent(in) :: name
      character(len=name_length) :: title
      integer(hsize_t) :: limit(1), rows(1)
      integer(hid_t) :: space
      integer :: k, kind, n, rank, status

      call h5gopen_f(container%file, name, self%group, status)
      call container%check(status)
      call h5gn_members_f(container%file, name, n, status)
      call container%check(status)
      if (container%failed) return
      allocate(self%columns(max(usual_columns, n)), self%pending(max_rows, max(usual_columns, n)))
      do k = 1, n
         call h5gget_obj_info_idx_f(container%file, name, k - 1, title, kind, status)
         call container%check(status)
         if (container%failed) return
         self%columns(k)%name = title
         call h5dopen_f(self%group, trim(title), self%columns(k)%id, status)
         call container%check(status)
         if (container%failed) return
         self%used = k
         call h5dget_space_f(self%columns(k)%id, space, status)
         call h5sget_simple_extent_ndims_f(space, rank, status)
         call container%check(status)
         rows = 0
         ! in a damaged file, any object may have the name of a column
         if (rank == 1) call h5sget_simple_extent_dims_f(space, rows, limit, status)
         call container%check(status)
         call container%release(space)
         if (rank /= 1 .or. rows(1) > huge(1) .or. (k > 1 .and. self%written /= rows(1))) container%failed = .true.
         if (container%failed) return
         self%written = int(rows(1))
      end do
   end subroutine reopen

   !> Number of rows, on disk and buffered
   pure integer function rows(self)
      class(column_table), intent(in) :: self

      rows = self%written + self%waiting
   end function rows

   !> Begin a row
   subroutine next_row(self, container)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container

      if (self%waiting == max_rows) call self%write_rows(container)
      self%waiting = self%waiting + 1
      self%pending(self%waiting, :) = ieee_value(0.0_wp, ieee_quiet_nan)
   end subroutine next_row

   !> Set a value of the last row; texts and arrays have no columns
   subroutine put(self, container, value)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Value with name, unit and title
      type(named_value), intent(in) :: value
      integer :: k

      if (value%kind == item_kind%text .or. value%kind == item_kind%real_numbers) return
      do k = 1, self%used
         if (self%columns(k)%name == value%name) exit
      end do
      if (k > self%used) call new_column(self, container, value)
      self%pending(self%waiting, k) = value%value
   end subroutine put

   !> Add a column; its earlier rows are NaN
   subroutine new_column(self, container, value)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name, unit and description of the column
      type(named_value), intent(in) :: value
      real(wp), allocatable :: earlier(:), wider(:, :)
      type(column), allocatable :: longer(:)
      integer(hid_t) :: properties, space
      integer(hsize_t) :: dims(1), limit(1)
      integer :: k, status

      if (self%used == size(self%columns)) then
         allocate(longer(2*self%used), wider(max_rows, 2*self%used))
         longer(:self%used) = self%columns
         wider = ieee_value(0.0_wp, ieee_quiet_nan)
         wider(:, :self%used) = self%pending
         call move_alloc(longer, self%columns)
         call move_alloc(wider, self%pending)
      end if
      self%used = self%used + 1
      associate (new => self%columns(self%used))
         new%name = value%name
         dims = self%written
         limit = h5s_unlimited_f
         ! compressed also because the checksum of zeros is zero: a damaged address of a chunk that points to zeros is detected
         call container%chunked([int(chunk_rows, hsize_t)], properties, compressed=.true., states=.false.)
         call h5screate_simple_f(1, dims, space, status, limit)
         call h5dcreate_f(self%group, trim(value%name), h5t_ieee_f64le, space, new%id, status, dcpl_id=properties)
         call container%check(status)
         if (self%written > 0) then
            allocate(earlier(self%written), source=ieee_value(0.0_wp, ieee_quiet_nan))
            call h5dwrite_f(new%id, h5t_native_double, earlier, dims, status)
            call container%check(status)
         end if
         call container%release(space)
         call container%release(properties)
         call container%describe(new%id, trim(value%unit), trim(value%title))
         ! rows are identified by the number of their case, which is written first
         if (value%name == row_name) call make_scale(container, new%id)
         do k = 1, self%used - 1
            if (self%columns(k)%name == row_name) call attach_scales(container, new%id, [self%columns(k)%id])
         end do
      end associate
   end subroutine new_column

   !> Write the buffered rows
   subroutine write_rows(self, container)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      integer(hid_t) :: memory, space
      integer(hsize_t) :: first(1), length(1), total(1)
      integer :: k, status

      if (self%waiting == 0 .or. container%failed) return
      first = self%written
      length = self%waiting
      total = self%written + self%waiting
      call h5screate_simple_f(1, length, memory, status)
      do k = 1, self%used
         call h5dset_extent_f(self%columns(k)%id, total, status)
         call container%check(status)
         call h5dget_space_f(self%columns(k)%id, space, status)
         call h5sselect_hyperslab_f(space, h5s_select_set_f, first, length, status)
         call h5dwrite_f(self%columns(k)%id, h5t_native_double, self%pending(:self%waiting, k), length, status, memory, space)
         call container%check(status)
         call container%release(space)
      end do
      call container%release(memory)
      self%written = self%written + self%waiting
      self%waiting = 0
   end subroutine write_rows

   !> Read a column
   subroutine read_column(self, container, name, values)
      class(column_table), intent(in) :: self
      type(hdf5_container), intent(inout) :: container
      !> Name as in the file
      character(len=*), intent(in) :: name
      !> Values of all rows on disk; 0 if there is no such column, which is a failure of the container
      real(wp), intent(out), contiguous :: values(:)
      integer(hsize_t) :: total(1)
      integer :: k, status

      values = 0.0_wp
      total = size(values)
      status = -1
      do k = 1, self%used
         if (self%columns(k)%name == name) call h5dread_f(self%columns(k)%id, h5t_native_double, values, total, status)
      end do
      call container%check(status)
   end subroutine read_column

   !> Remove all rows after the first `rows`
   subroutine cut(self, container, rows)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      !> Number of rows that are kept, at most those on disk
      integer, intent(in) :: rows
      integer(hsize_t) :: total(1)
      integer :: k, status

      total = rows
      do k = 1, self%used
         if (self%written == rows) exit
         call h5dset_extent_f(self%columns(k)%id, total, status)
         call container%check(status)
      end do
      self%written = rows
   end subroutine cut

   !> Close all columns
   subroutine release(self, container)
      class(column_table), intent(inout) :: self
      type(hdf5_container), intent(inout) :: container
      integer :: k

      do k = 1, self%used
         call container%release(self%columns(k)%id)
      end do
      call container%release(self%group)
   end subroutine release
end module contact_hdf5_columns
