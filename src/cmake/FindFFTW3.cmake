# FFTW 3 in double precision: the imported target FFTW3::fftw3
#
# FFTW3_ROOT or CMAKE_PREFIX_PATH is the folder of an installation outside the usual folders.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(PC_FFTW3 QUIET fftw3)
endif()
find_library(FFTW3_LIBRARY NAMES fftw3 HINTS ${PC_FFTW3_LIBRARY_DIRS})
find_path(FFTW3_INCLUDE_DIR NAMES fftw3.f03 HINTS ${PC_FFTW3_INCLUDE_DIRS} ${PC_FFTW3_INCLUDEDIR})
set(FFTW3_VERSION ${PC_FFTW3_VERSION})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW3
  REQUIRED_VARS FFTW3_LIBRARY FFTW3_INCLUDE_DIR VERSION_VAR FFTW3_VERSION
  REASON_FAILURE_MESSAGE "install FFTW 3 (Debian: libfftw3-dev), name its folder by -DFFTW3_ROOT=..., or build with -DCONTACT_FFT=pocketfft, which needs no library")
mark_as_advanced(FFTW3_LIBRARY FFTW3_INCLUDE_DIR)

if(FFTW3_FOUND AND NOT TARGET FFTW3::fftw3)
  add_library(FFTW3::fftw3 UNKNOWN IMPORTED)
  # As a compile option: CMake drops /usr/include from the include path, but gfortran does not search
  # it for fftw3.f03 by default
  set_target_properties(FFTW3::fftw3 PROPERTIES
    IMPORTED_LOCATION ${FFTW3_LIBRARY}
    INTERFACE_COMPILE_OPTIONS "$<$<COMPILE_LANGUAGE:Fortran>:-I${FFTW3_INCLUDE_DIR}>")
endif()
