!> Which program this is, and what it was built and linked with
module contact_cli_versions
   use, intrinsic :: iso_fortran_env, only : compiler_version
   use h5lib, only : h5get_libversion_f
   implicit none (type, external)
   private

   public :: contact_version, version_text

   !> The one place of the version number; CMake reads it from this line
   character(len=*), parameter :: contact_version = "0.1.0"

contains

   !> Answer to `contact --version`: program, compiler and linked HDF5, one line each
   function version_text() result(text)
      character(len=:), allocatable :: text

      text = "contact " // contact_version // new_line("a") &
         & // "compiled by " // compiler_version() // new_line("a") &
         & // "HDF5 " // hdf5_version()
   end function version_text

   !> Number of the HDF5 library this program is linked with, as the library itself says it
   function hdf5_version() result(text)
      character(len=:), allocatable :: text
      character(len=40) :: numbers
      integer :: major, minor, release, status

      text = "of unknown version"
      call h5get_libversion_f(major, minor, release, status)
      if (status /= 0) return
      write(numbers, '(i0, ".", i0, ".", i0)') major, minor, release
      text = trim(numbers)
   end function hdf5_version
end module contact_cli_versions
