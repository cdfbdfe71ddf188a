!> Dimension scales: arrays of the coordinates along a dimension, and their association with arrays
!>
!> The attributes CLASS and DIMENSION_LIST of the dimension scale specification of HDF5, by which NetCDF, xarray and h5py identify
!> dimensions. REFERENCE_LIST, the references from a scale to all its arrays, is omitted: one scale serves thousands of arrays, and
!> the list would be rewritten for each of them. Readers do not need it.
module contact_hdf5_scales
   use, intrinsic :: iso_c_binding, only : c_loc, c_null_char, c_ptr, c_size_t
   use hdf5, only : h5acreate_f, h5awrite_f, h5rcreate_f, h5screate_simple_f, h5t_c_s1, h5t_std_i8le, &
      & h5t_native_integer, h5t_std_ref_obj, h5tcopy_f, h5tset_size_f, h5tvlen_create_f, hid_t, hobj_ref_t_f, hsize_t, size_t
   use contact_hdf5_container, only : hdf5_container
   implicit none (type, external)
   private

   public :: attach_scales, make_scale, describe_flags

   !> Variable-length data as defined by HDF5
   type, bind(c) :: item_list
      integer(c_size_t) :: length
      type(c_ptr) :: items
   end type item_list

   !> Maximum number of dimensions of an array
   integer, parameter :: most_dimensions = 3

contains

   !> Mark an array as the coordinates along a dimension
   subroutine make_scale(container, data)
      type(hdf5_container), intent(inout) :: container
      !> Open dataset of rank 1
      integer(hid_t), intent(in) :: data
      character(len=*), parameter :: class = "DIMENSION_SCALE" // c_null_char
      integer(hid_t) :: attribute, kind
      integer(hsize_t) :: one(1)
      integer :: status

      one = 1
      call h5tcopy_f(h5t_c_s1, kind, status)
      call h5tset_size_f(kind, int(len(class), size_t), status)
      call container%check(status)
      call h5acreate_f(data, "CLASS", kind, container%scalar, attribute, status)
      call container%check(status)
      call h5awrite_f(attribute, kind, class, one, status)
      call container%check(status)
      call container%release(attribute)
      call container%release(kind)
   end subroutine make_scale

   !> Set the scales of an array
   subroutine attach_scales(container, data, scales)
      type(hdf5_container), intent(inout) :: container
      !> Open dataset
      integer(hid_t), intent(in) :: data
      !> Open datasets of the scales, in the order of the dimensions in Fortran
      integer(hid_t), intent(in) :: scales(:)
      type(hobj_ref_t_f), target :: references(most_dimensions)
      type(item_list), target :: lists(most_dimensions)
      integer(hid_t) :: attribute, kind, space
      integer :: k, n, status

      n = size(scales)
      do k = 1, n
         ! the order of dimensions in the file is the reverse
         call h5rcreate_f(scales(n + 1 - k), ".", references(k), status)
         call container%check(status)
         lists(k) = item_list(1_c_size_t, c_loc(references(k)))
      end do
      call h5tvlen_create_f(h5t_std_ref_obj, kind, status)
      call container%check(status)
      call h5screate_simple_f(1, [int(n, hsize_t)], space, status)
      call h5acreate_f(data, "DIMENSION_LIST", kind, space, attribute, status)
      call container%check(status)
      call h5awrite_f(attribute, kind, c_loc(lists), status)
      call container%check(status)
      call container%release(attribute)
      call container%release(space)
      call container%release(kind)
   end subroutine attach_scales

   !> Describe the integers of an array: meanings of 0, 1, ... in this order
   subroutine describe_flags(container, data, meanings)
      type(hdf5_container), intent(inout) :: container
      !> Open dataset of small integers
      integer(hid_t), intent(in) :: data
      !> Words separated by blanks
      character(len=*), intent(in) :: meanings
      integer(hid_t) :: attribute, space
      integer(hsize_t) :: dims(1)
      integer :: k, n, status

      n = 1 + count([(meanings(k:k) == " ", k = 1, len(meanings))])
      dims = n
      call h5screate_simple_f(1, dims, space, status)
      call h5acreate_f(data, "flag_values", h5t_std_i8le, space, attribute, status)
      call container%check(status)
      call h5awrite_f(attribute, h5t_native_integer, [(k, k = 0, n - 1)], dims, status)
      call container%check(status)
      call container%release(attribute)
      call container%release(space)
      call container%set_text(data, "flag_meanings", meanings)
   end subroutine describe_flags
end module contact_hdf5_scales
