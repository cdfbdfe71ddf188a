# The transforms of MKL by its FFTW 3 interface: the imported target MKLFFT::mkl
#
# MKLROOT, or CMAKE_PREFIX_PATH, is the folder with lib and include, such as a virtual environment with mkl and mkl-include of PyPI
find_library(MKLFFT_LIBRARY NAMES mkl_rt libmkl_rt.so.3 libmkl_rt.so.2 HINTS ENV MKLROOT ${MKLROOT} PATH_SUFFIXES lib lib/intel64)
find_path(MKLFFT_INCLUDE_DIR NAMES fftw3.f03 HINTS ENV MKLROOT ${MKLROOT} PATH_SUFFIXES include/fftw)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MKLFFT REQUIRED_VARS MKLFFT_LIBRARY MKLFFT_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "the environment variable MKLROOT names the folder of MKL")
mark_as_advanced(MKLFFT_LIBRARY MKLFFT_INCLUDE_DIR)

if(MKLFFT_FOUND AND NOT TARGET MKLFFT::mkl)
  add_library(MKLFFT::mkl UNKNOWN IMPORTED)
  set_target_properties(MKLFFT::mkl PROPERTIES
    IMPORTED_LOCATION ${MKLFFT_LIBRARY}
    INTERFACE_COMPILE_OPTIONS "$<$<COMPILE_LANGUAGE:Fortran>:-I${MKLFFT_INCLUDE_DIR}>")
endif()
