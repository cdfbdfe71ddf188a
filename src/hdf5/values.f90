!> Values as datasets: named values of a group, buffered until the group is complete, and arrays
module contact_hdf5_values
   use hdf5, only : h5dcreate_f, h5dwrite_f, h5screate_simple_f, h5t_ieee_f64le, h5t_native_double, h5t_native_integer, &
      & h5t_std_i32le, h5t_std_i8le, hid_t, hsize_t
   use contact_base_kinds, only : long, wp
   use contact_hdf5_container, only : hdf5_container, large, max_chunk, max_text_length
   use contact_hdf5_scales, only : attach_scales, describe_flags, make_scale
   use contact_output_record, only : item_kind, named_value
   implicit none (type, external)
   private

   public :: flag_meanings, is_same, same_number, value_list, write_array, write_value

   !> Meanings of the element states, from 0
   character(len=*), parameter :: flag_meanings = "exterior adhesion slip plastic"

   !> The values of one group in their order
   type :: value_list
      integer :: count = 0
      !> Items 1...count are in use
      type(named_value), allocatable :: items(:)
   contains
      procedure :: add
      procedure :: keep_texts
      !> Are names and values of two lists equal?
      procedure :: equals
      !> Write texts and integers as attributes of the file
      procedure :: write_attributes
   end type value_list

contains

   !> Append a value; texts are truncated at max_text_length, and have at least one blank
   subroutine add(self, item)
      class(value_list), intent(inout) :: self
      !> Value of the current group
      type(named_value), intent(in) :: item
      type(named_value), allocatable :: longer(:)

      if (.not. allocated(self%items)) allocate(self%items(100))
      if (self%count == size(self%items)) then
         allocate(longer(2*self%count))
         longer(:self%count) = self%items
         call move_alloc(longer, self%items)
      end if
      self%count = self%count + 1
      self%items(self%count) = item
      if (item%kind /= item_kind%text) return
      if (len(item%text) == 0) self%items(self%count)%text = " "
      if (len(item%text) > max_text_length) self%items(self%count)%text = item%text(:max_text_length)
   end subroutine add

   !> Remove all values but texts
   subroutine keep_texts(self)
      class(value_list), intent(inout) :: self
      integer :: i, k

      k = 0
      do i = 1, self%count
         if (self%items(i)%kind /= item_kind%text) cycle
         k = k + 1
         if (i > k) self%items(k) = self%items(i)
      end do
      self%count = k
   end subroutine keep_texts

   !> Are names and values of two lists equal?
   pure logical function equals(self, other)
      class(value_list), intent(in) :: self
      !> List to compare with, in the same order
      type(value_list), intent(in) :: other
      integer :: i

      equals = .false.
      if (self%count /= other%count) return
      do i = 1, self%count
         if (.not. is_same(self%items(i), other%items(i))) return
      end do
      equals = .true.
   end function equals

   !> Write the values as attributes of the file, replacing those of the same names
   subroutine write_attributes(self, container)
      class(value_list), intent(in) :: self
      type(hdf5_container), intent(inout) :: container
      integer :: i

      do i = 1, self%count
         if (container%failed) return
         associate (this => self%items(i))
            if (this%kind == item_kind%text) then
               call container%drop_attribute(trim(this%name))
               call container%set_text(container%file, trim(this%name), this%text)
            else
               call container%set_count(trim(this%name), nint(this%value))
            end if
         end associate
      end do
   end subroutine write_attributes

   !> Are name and value equal?
   pure logical function is_same(self, other) result(same)
      !> Values, compared bit by bit
      type(named_value), intent(in) :: self, other

      same = .false.
      if (self%name /= other%name .or. self%kind /= other%kind) return
      if (.not. same_number(self%value, other%value)) return
      if (allocated(other%values)) then
         if (size(self%values) /= size(other%values)) return
         if (.not. all(same_number(self%values, other%values))) return
      end if
      if (allocated(other%text)) then
         if (len(self%text) /= len(other%text)) return
         if (self%text /= other%text) return
      end if
      same = .true.
   end function is_same

   !> Equal bit by bit: NaN equals itself, 0 and -0 differ
   elemental logical function same_number(a, b) result(same)
      !> Numbers to compare
      real(wp), intent(in) :: a, b
      same = transfer(a, 0_long) == transfer(b, 0_long)
   end function same_number

   !> Write a value as a dataset of its group, with unit and description
   subroutine write_value(self, container, group, along)
      !> Value to be written
      type(named_value), intent(in), target :: self
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Open scale of an array of numbers; negative: none yet, the array becomes it and is left open; absent: the array is a scale
      !> of its own
      integer(hid_t), intent(inout), optional :: along
      integer(hid_t) :: data, kind, properties, space
      integer(hsize_t) :: dims(1)
      integer :: status

      properties = container%compact
      dims = 1
      space = container%scalar
      select case (self%kind)
      case (item_kind%real_number)
         kind = h5t_ieee_f64le
      case (item_kind%real_numbers)
         kind = h5t_ieee_f64le
         dims = size(self%values, kind=hsize_t)
         call h5screate_simple_f(1, dims, space, status)
         ! too large for the object header, whose checksum would cover them
         if (size(self%values)*8 >= large) call container%chunked(min(dims, int(max_chunk, hsize_t)), properties, &
            & compressed=.false., states=.false.)
      case (item_kind%whole)
         kind = h5t_std_i32le
      case (item_kind%flag)
         kind = h5t_std_i8le
      case default
         kind = container%text_type(len(self%text))
      end select
      call h5dcreate_f(group, trim(self%name), kind, space, data, status, dcpl_id=properties)
      call container%check(status)
      if (properties /= container%compact) call container%release(properties)
      select case (self%kind)
      case (item_kind%real_number)
         call h5dwrite_f(data, h5t_native_double, self%value, dims, status)
      case (item_kind%real_numbers)
         if (size(self%values) > 0) call h5dwrite_f(data, h5t_native_double, self%values, dims, status)
         call container%release(space)
      case (item_kind%whole, item_kind%flag)
         call h5dwrite_f(data, h5t_native_integer, nint(self%value), dims, status)
      case default
         call h5dwrite_f(data, kind, self%text // " ", dims, status)
      end select
      call container%check(status)
      call container%describe(data, trim(self%unit), trim(self%title))
      if (self%kind == item_kind%real_numbers) then
         if (.not. present(along)) then
            call make_scale(container, data)
         else if (along < 0) then
            call make_scale(container, data)
            along = data
            return
         else
            call attach_scales(container, data, [along])
         end if
      end if
      call container%release(data)
   end subroutine write_value

   !> Write an array of any rank as a dataset
   subroutine write_array(container, group, name, unit, title, values, dims, kind, scales, data)
      type(hdf5_container), intent(inout) :: container
      !> Open group
      integer(hid_t), intent(in) :: group
      !> Name, unit ("" for none), and description
      character(len=*), intent(in) :: name, unit, title
      !> Shape
      integer(hsize_t), intent(in) :: dims(:)
      !> Values, the first index running fastest
      real(wp), intent(in), target :: values(product(dims))
      !> Datatype on disk: of numbers, or of element states
      integer(hid_t), intent(in) :: kind
      !> Open scales of the dimensions; empty: the array is a scale itself
      integer(hid_t), intent(in) :: scales(:)
      !> The open dataset
      integer(hid_t), intent(out) :: data
      integer(hid_t) :: properties, space
      integer(hsize_t) :: chunk(size(dims))
      integer :: status

      properties = container%compact
      if (8*size(values) >= large) then
         chunk = dims
         if (product(chunk) > max_chunk) &
            & chunk(size(chunk)) = max(1_hsize_t, max_chunk/product(chunk(:size(chunk) - 1)))
         call container%chunked(chunk, properties, compressed=.true., states=kind == h5t_std_i8le)
      end if
      call h5screate_simple_f(size(dims), dims, space, status)
      call h5dcreate_f(group, name, kind, space, data, status, dcpl_id=properties)
      call container%check(status)
      call h5dwrite_f(data, h5t_native_double, values, [size(values, kind=hsize_t)], status)
      call container%check(status)
      if (kind == h5t_std_i8le) then
         call container%describe(data, "-", title)
         call describe_flags(container, data, flag_meanings)
      else
         call container%describe(data, unit, title)
      end if
      if (size(scales) > 0) then
         call attach_scales(container, data, scales)
      else
         call make_scale(container, data)
      end if
      call container%release(space)
      if (properties /= container%compact) call container%release(properties)
   end subroutine write_array
end module contact_hdf5_values
