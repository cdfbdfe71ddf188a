!> Version of this program, and of its compiler and libraries
module contact_cli_versions
   use, intrinsic :: iso_fortran_env, only : compiler_version
   use h5lib, only : h5get_libversion_f
   implicit none (type, external)
   private

   public :: contact_version, write_versions

   !> The version number; CMake reads it from this line
   character(len=*), parameter :: contact_version = "0.1.0"
   !> Library of Fourier transforms and its licence, set by CMake
   character(len=*), parameter :: transforms = CONTACT_TRANSFORMS

contains

   !> Write the answer to `contact --version`: program, compiler, linked HDF5 and transforms, one line each
   subroutine write_versions(unit)
      !> Unit open for formatted output
      integer, intent(in) :: unit

      write(unit, "(A)") "contact " // contact_version, "compiled by " // compiler_version(), "HDF5 " // trim(hdf5_version()), &
         & "transforms by " // transforms
   end subroutine write_versions

   !> Version of the linked HDF5 library, as it reports it
   function hdf5_version() result(text)
      character(len=40) :: text
      integer :: major, minor, release, status

      text = "of unknown version"
      call h5get_libversion_f(major, minor, release, status)
      if (status == 0) write(text, '(I0, ".", I0, ".", I0)') major, minor, release
   end function hdf5_version
end module contact_cli_versions
