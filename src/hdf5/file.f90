!> One HDF5 file per experiment: inputs, totals, fields and the methods that gave them, case by case
!>
!> Layout, see doc/user/results.md:
!>
!>     /cases/<name>, /patches/<name>     totals as columns over all cases and patches
!>     /case_0001/inputs/<group>/<name>
!>     /case_0001/patch_1/totals/<name>, solver/<name>, fields/<name>, grid/<name>, subsurface/block_1/<name>
!>     /case_0001/patch_1/x_element, y_element        dimension scales of the fields; those of a block are its x, y, z
!>
!> Every array has dimension scales: for columns the numbers of the cases; a list without another scale is its own.
!>
!> Groups and fields that are unchanged since the previous case are stored once and linked.
!>
!> The file itself is `container`, the columns are `columns`, the values of a group `values`, and objects that can be linked `kept`;
!> none of them depends on the content of a case.
module contact_hdf5_file
   use hdf5, only : h5lcreate_hard_f, h5t_ieee_f64le, h5t_std_i8le, hid_t, hsize_t
   use contact_base_error, only : error_type
   use contact_base_kinds, only : long, wp
   use contact_hdf5_columns, only : column_table
   use contact_hdf5_container, only : clock, hdf5_container
   use contact_hdf5_kept, only : kept_list
   use contact_hdf5_values, only : is_same, value_list, write_array, write_value
   use contact_output_record, only : named_value, record_writer
   implicit none (type, external)
   private

   public :: hdf5_file

   !> Conventions of units and flags
   character(len=*), parameter :: conventions = "CF-1.11"
   !> Number of this layout
   integer, parameter :: layout = 1
   !> Ratio of the time between two copies to the time of the last copy: 2 % of the time is used for copies, and up to 5 % if
   !> nothing new would be readable for longer than the usual wait [s]; chosen
   real(wp), parameter :: waits_per_copy = 50.0_wp, fewer_waits = 20.0_wp, usual_wait = 1.0_wp
   !> Maximum depth of nested groups; a case has 3
   integer, parameter :: max_depth = 8

   !> The file
   type, extends(record_writer) :: hdf5_file
      type(hdf5_container) :: container
      !> Totals of cases and of patches; is the open row that of a patch?
      type(column_table), private :: cases, patches
      logical, private :: in_patch = .false.
      !> Objects of previous cases
      type(kept_list), private :: kept
      !> The open group, its parent groups and their number, and its path among kept objects
      integer(hid_t), private :: group = -1
      integer(hid_t), private :: parents(max_depth) = -1
      integer, private :: depth = 0
      character(len=:), allocatable, private :: place
      !> Name and values of the open group of values; are they columns, are only texts stored with the columns?
      character(len=:), allocatable, private :: leaf
      type(value_list), private :: values
      logical, private :: as_columns = .false., only_texts = .false.
      !> Is the first list of numbers in the group the dimension scale of the others?
      logical, private :: is_table = .false.
      !> Dimension scales of the next arrays, in the order of their dimensions
      integer(hid_t), private :: scales(3) = -1
      !> Time of the last copy, and minimum time until the next one [s]
      real(wp), private :: last_copy = 0.0_wp, wait = 0.0_wp
   contains
      !> Create a file; or continue a file after given rows of /cases and /patches
      procedure :: make_file
      procedure :: open_again
      procedure :: rows
      procedure :: cut
      procedure :: finish_file
      !> Remove the unfinished file; the file of the final name is unchanged
      procedure :: abandon
      procedure :: is_open
      !> Begin and end a case
      procedure :: begin_case
      procedure :: end_case
      !> Open and close a group of groups in the case
      procedure :: enter
      procedure :: leave
      !> Begin a row of the columns of cases, or of patches
      procedure :: begin_row
      !> Write an array over the elements, shape (mx, my), or over the points of a block, shape (nx, ny, nz)
      procedure :: field
      procedure :: division
      procedure :: block
      !> Write the coordinates along a dimension of the next arrays
      procedure :: scale
      procedure :: open_group
      !> Declare the lists of the open group as columns of a table
      procedure :: make_table
      procedure :: close_group
      !> Replaces close_group: the values become attributes of the file
      procedure :: close_attributes
      !> Update the readable file
      procedure :: renew
      !> Size of the unfinished file [bytes]
      procedure :: bytes_so_far
      procedure :: write_item
   end type hdf5_file

contains

   !> Create the file
   subroutine make_file(self, name, experiment, version, error)
      class(hdf5_file), intent(inout) :: self
      !> Name of the file
      character(len=*), intent(in) :: name
      !> Name of the experiment, and of the program that writes the file
      character(len=*), intent(in) :: experiment, version
      !> Allocated if the file cannot be written
      type(error_type), allocatable, intent(out) :: error

      call self%container%create(name, error)
      self%last_copy = clock()
      if (allocated(error)) return
      call self%cases%create(self%container, "cases")
      call self%patches%create(self%container, "patches")
      associate (this => self%container)
         call this%set_text(this%file, "title", "results of CONTACT")
         call this%set_text(this%file, "experiment", experiment)
         call this%set_text(this%file, "program", version)
         call this%set_text(this%file, "source", version)
         call this%set_text(this%file, "Conventions", conventions)
         call this%set_text(this%file, "axes", "datasets of fields have the shape (my, mx) in C, h5py and NumPy")
         call this%set_count("layout", layout)
      end associate
   end subroutine make_file

   !> Continue a file of results
   subroutine open_again(self, name, error)
      class(hdf5_file), intent(inout) :: self
      !> Name of the file
      character(len=*), intent(in) :: name
      !> Allocated if the file cannot be read or written
      type(error_type), allocatable, intent(out) :: error

      call self%container%reopen(name, error)
      self%last_copy = clock()
      if (allocated(error)) return
      call self%cases%reopen(self%container, "cases")
      call self%patches%reopen(self%container, "patches")
      if (self%container%failed) call self%container%refuse(error)
   end subroutine open_again

   !> Number of rows of a table
   pure integer function rows(self, patch)
      class(hdf5_file), intent(in) :: self
      !> Rows of the table of patches? Otherwise of cases
      logical, intent(in) :: patch

      rows = self%cases%rows()
      if (patch) rows = self%patches%rows()
   end function rows

   !> Remove data that were written after given rows
   subroutine cut(self, cases, patches, name_of)
      class(hdf5_file), intent(inout) :: self
      !> Number of rows that are kept
      integer, intent(in) :: cases, patches
      interface
         !> Name of the group of a case
         function name_of(case_number, result_element, contact_problem) result(name)
            integer, intent(in) :: case_number, result_element, contact_problem
            character(len=48) :: name
         end function name_of
      end interface
      real(wp), allocatable :: columns(:, :)
      integer :: k

      associate (file => self%container, table => self%cases)
         if (table%written > cases) then
            allocate(columns(table%written, 3))
            call table%read_column(file, "case", columns(:, 1))
            call table%read_column(file, "result_element", columns(:, 2))
            call table%read_column(file, "contact_problem", columns(:, 3))
            do k = cases + 1, table%written
               if (file%failed) return
               call file%remove_group(trim(name_of(nint(columns(k, 1)), nint(columns(k, 2)), nint(columns(k, 3)))))
            end do
         end if
         call table%cut(file, cases)
         call self%patches%cut(file, patches)
      end associate
   end subroutine cut

   !> Write buffered data and close
   subroutine finish_file(self, error)
      class(hdf5_file), intent(inout) :: self
      !> Allocated if any call has failed
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%container%is_open) return
      call self%cases%write_rows(self%container)
      call self%patches%write_rows(self%container)
      call self%kept%release(self%container)
      call self%cases%release(self%container)
      call self%patches%release(self%container)
      call self%container%close_file(error)
   end subroutine finish_file

   !> Remove the unfinished file
   subroutine abandon(self)
      class(hdf5_file), intent(inout) :: self
      type(error_type), allocatable :: ignored

      self%container%failed = .true.
      call self%finish_file(ignored)
   end subroutine abandon

   !> Is a file open?
   pure logical function is_open(self)
      class(hdf5_file), intent(in) :: self
      is_open = self%container%is_open
   end function is_open

   !> Make the values of the group attributes of the file
   subroutine close_attributes(self)
      class(hdf5_file), intent(inout) :: self

      call self%values%write_attributes(self%container)
   end subroutine close_attributes

   !> Size of the unfinished file [bytes]
   integer(long) function bytes_so_far(self) result(bytes)
      class(hdf5_file), intent(in) :: self
      bytes = self%container%bytes_so_far()
   end function bytes_so_far

   !> Update the readable file
   subroutine renew(self)
      class(hdf5_file), intent(inout) :: self
      real(wp) :: before, took

      before = clock()
      call self%cases%write_rows(self%container)
      call self%patches%write_rows(self%container)
      call self%container%publish()
      self%last_copy = clock()
      took = self%last_copy - before
      self%wait = min(waits_per_copy*took, max(usual_wait, fewer_waits*took))
   end subroutine renew

   !> Begin a case
   subroutine begin_case(self, name, slot)
      class(hdf5_file), intent(inout) :: self
      !> Name of its group
      character(len=*), intent(in) :: name
      !> Name of the contact problem to which the case belongs; objects are kept for each
      character(len=*), intent(in) :: slot

      call self%container%new_group(self%container%file, name, self%group)
      self%place = slot
   end subroutine begin_case

   !> End a case; the readable file is updated now or later
   subroutine end_case(self, finished)
      class(hdf5_file), intent(inout) :: self
      !> Number of finished cases of the run
      integer, intent(in) :: finished

      call self%container%release(self%group)
      if (clock() - self%last_copy < self%wait) return
      call self%container%set_count("cases_finished", finished)
      call self%renew()
   end subroutine end_case

   !> Open a new group of the case
   subroutine enter(self, name)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name !! Without slash
      integer(hid_t) :: inner

      call self%container%new_group(self%group, name, inner)
      self%depth = self%depth + 1
      self%parents(self%depth) = self%group
      self%group = inner
      self%place = self%place // "/" // name
   end subroutine enter

   !> Return to the parent group
   subroutine leave(self)
      class(hdf5_file), intent(inout) :: self

      call self%container%release(self%group)
      self%group = self%parents(self%depth)
      self%depth = self%depth - 1
      self%place = self%place(:index(self%place, "/", back=.true.) - 1)
   end subroutine leave

   !> Begin a row of the columns of cases, or of patches
   subroutine begin_row(self, patch)
      class(hdf5_file), intent(inout) :: self
      logical, intent(in) :: patch !! Of the patches instead of the cases?

      self%in_patch = patch
      if (patch) then
         call self%patches%next_row(self%container)
      else
         call self%cases%next_row(self%container)
      end if
   end subroutine begin_row

   !> Begin a group of values
   subroutine open_group(self, name, columns, brief)
      class(hdf5_file), intent(inout) :: self
      !> Name; empty for values that are columns only
      character(len=*), intent(in) :: name
      !> Are the values columns of totals too? Are numbers stored as columns only? Default: no, no
      logical, intent(in), optional :: columns, brief

      self%leaf = name
      self%only_texts = .false.
      if (present(brief)) self%only_texts = brief
      self%as_columns = .false.
      if (present(columns)) self%as_columns = columns
      self%is_table = .false.
      self%values%count = 0
   end subroutine open_group

   !> The first list of numbers in the open group is the dimension scale of the others, which have the same length
   subroutine make_table(self)
      class(hdf5_file), intent(inout) :: self

      self%is_table = .true.
   end subroutine make_table

   !> Write the group of values; values that are unchanged since the previous case are linked, together or one by one
   subroutine close_group(self)
      class(hdf5_file), intent(inout) :: self
      integer(hid_t) :: along, group
      integer :: i, k, known, status

      if (self%as_columns) then
         do i = 1, self%values%count
            if (self%in_patch) then
               call self%patches%put(self%container, self%values%items(i))
            else
               call self%cases%put(self%container, self%values%items(i))
            end if
         end do
      end if
      if (len(self%leaf) == 0 .or. self%container%failed) return
      if (self%only_texts) call self%values%keep_texts()
      call self%kept%find(self%place // "/" // self%leaf, k)
      associate (before => self%kept%objects(k))
         known = 0
         if (allocated(before%group)) then
            if (before%group%equals(self%values)) then
               call before%link(self%container, self%group, self%leaf)
               return
            end if
            if (.not. self%is_table) known = before%group%count
         end if
         along = -1
         call self%container%new_group(self%group, self%leaf, group)
         do i = 1, self%values%count
            associate (this => self%values%items(i))
               if (i <= known) then
                  if (is_same(before%group%items(i), this)) then
                     call h5lcreate_hard_f(before%id, trim(this%name), group, trim(this%name), status)
                     call self%container%check(status)
                     cycle
                  end if
               end if
               if (self%is_table) then
                  call write_value(this, self%container, group, along)
               else
                  call write_value(this, self%container, group)
               end if
            end associate
         end do
         if (along >= 0) call self%container%release(along)
         if (.not. allocated(before%group)) allocate(before%group)
         before%group%count = self%values%count
         before%group%items = self%values%items(:self%values%count)
         call self%kept%replace(self%container, k, group)
      end associate
   end subroutine close_group

   subroutine write_item(self, item)
      class(hdf5_file), intent(inout) :: self
      type(named_value), intent(in) :: item

      call self%values%add(item)
   end subroutine write_item

   !> Write the coordinates along a dimension of the next arrays, as a dataset of the open group
   subroutine scale(self, dimension, name, unit, title, values)
      class(hdf5_file), intent(inout) :: self
      !> Index of the dimension, 1 for the one that varies fastest
      integer, intent(in) :: dimension
      !> Name, unit and description
      character(len=*), intent(in) :: name, unit, title
      !> Coordinates
      real(wp), intent(in) :: values(:)
      integer(hsize_t) :: dims(1)
      integer(hid_t) :: none(0)

      dims = size(values, kind=hsize_t)
      call self%kept%write(self%container, self%group, self%place, name, unit, title, values, dims, h5t_ieee_f64le, none, &
         & self%scales(dimension))
   end subroutine scale

   !> Write an array over the elements
   subroutine field(self, name, unit, title, values)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title !! Of the dataset; its unit, and in words what it is
      !> Values, shape (mx, my)
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(hsize_t) :: dims(2)

      dims = shape(values, kind=hsize_t)
      call self%kept%write(self%container, self%group, self%place, name, unit, title, values, dims, h5t_ieee_f64le, &
         & self%scales(:2))
   end subroutine field

   !> Write element states
   subroutine division(self, name, title, states)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, title !! Of the dataset, and in words what it is
      !> States, shape (mx, my)
      integer, intent(in) :: states(:, :)
      real(wp), allocatable :: values(:, :)
      integer(hsize_t) :: dims(2)

      values = real(states, wp)
      dims = shape(values, kind=hsize_t)
      call self%kept%write(self%container, self%group, self%place, name, "", title, values, dims, h5t_std_i8le, self%scales(:2))
   end subroutine division

   !> Write an array over the points of a block
   subroutine block(self, name, unit, title, values, nx, ny, nz)
      class(hdf5_file), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, title !! Of the dataset; its unit, and in words what it is
      !> Values, shape (nx ny nz), x fastest
      real(wp), intent(in), contiguous :: values(:)
      !> Number of points in each direction
      integer, intent(in) :: nx, ny, nz
      integer(hid_t) :: data
      integer(hsize_t) :: dims(3)

      if (self%container%failed) return
      dims = int([nx, ny, nz], hsize_t)
      call write_array(self%container, self%group, name, unit, title, values, dims, h5t_ieee_f64le, self%scales, data)
      call self%container%release(data)
   end subroutine block
end module contact_hdf5_file
