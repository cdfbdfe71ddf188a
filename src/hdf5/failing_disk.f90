!> Creating and closing an HDF5 file so that a failed write, as on a full disk, is no failure inside the HDF5 library
!>
!> HDF5 2.2 checks assertions where its distributor did not switch them off. One says that everything has been written when a
!> file is closed, also after H5Fcreate has failed; where it does not hold, the process ends.
module contact_hdf5_failing_disk
   use, intrinsic :: iso_c_binding, only : c_char, c_f_pointer, c_int, c_int64_t, c_loc, c_null_ptr, c_ptr
   use hdf5, only : h5f_acc_trunc_f, h5f_scope_global_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5fget_file_image_f, &
      & h5pclose_f, h5pcopy_f, h5pset_fapl_core_f, hid_t, size_t
   use contact_base_output_file, only : output_file
   use contact_base_system, only : divert_to_memory
   implicit none (type, external)
   private

   public :: close_deleted, write_empty

   !> Step by which the file in memory grows [bytes]
   integer(size_t), parameter :: step = 4096_size_t

contains

   !> Write a file without content, which is to be opened next. It is made in memory
   subroutine write_empty(name, creation, access, status)
      !> Path of the file
      character(len=*), intent(in) :: name
      !> Properties of its creation and of the access to it
      integer(hid_t), intent(in) :: creation, access
      !> Negative if it cannot be written
      integer, intent(out) :: status
      character(kind=c_char), allocatable, target :: bytes(:)
      character(len=:), allocatable :: reason, text
      type(output_file) :: empty
      type(c_ptr) :: address
      integer(hid_t) :: in_memory, file
      integer(size_t) :: length
      integer :: closed, k
      logical :: complete

      address = c_null_ptr
      call h5pcopy_f(access, in_memory, status)
      call h5pset_fapl_core_f(in_memory, step, .false., status)
      call h5fcreate_f(name, h5f_acc_trunc_f, file, status, creation, in_memory)
      call h5pclose_f(in_memory, closed)
      if (status < 0) return
      length = 0
      ! the first call returns the length, and no content
      call h5fflush_f(file, h5f_scope_global_f, status)
      if (status >= 0) call h5fget_file_image_f(file, address, 0_size_t, status, length)
      allocate(bytes(length))
      address = c_loc(bytes)
      if (status >= 0) call h5fget_file_image_f(file, address, size(bytes, kind=size_t), status)
      call h5fclose_f(file, closed)
      if (status < 0) return
      allocate(character(len=int(length)) :: text)
      do k = 1, len(text)
         text(k:k) = bytes(k)
      end do
      call empty%open_file(name, reason)
      call empty%bytes(text)
      call empty%close_file(complete)
      if (allocated(reason) .or. .not. complete) status = -1
   end subroutine write_empty

   !> Close a file that is deleted next. What HDF5 has not written yet is written into memory, where no disk is full
   subroutine close_deleted(file)
      !> Identifier of the file, opened by a descriptor of the system (the driver "sec2")
      integer(hid_t), intent(in) :: file
      interface
         function descriptor_of(file, access, address) result(status) bind(c, name="H5Fget_vfd_handle")
            import :: c_int, c_int64_t, c_ptr
            integer(c_int64_t), value :: file, access
            type(c_ptr), intent(out) :: address
            integer(c_int) :: status
         end function descriptor_of
      end interface
      integer(c_int), pointer :: descriptor
      type(c_ptr) :: address
      integer :: status

      if (descriptor_of(int(file, c_int64_t), 0_c_int64_t, address) >= 0) then
         call c_f_pointer(address, descriptor)
         call divert_to_memory(descriptor)
      end if
      ! without memory this may fail again; then the file is left to HDF5, open and without a name
      call h5fflush_f(file, h5f_scope_global_f, status)
      if (status >= 0) call h5fclose_f(file, status)
   end subroutine close_deleted
end module contact_hdf5_failing_disk
