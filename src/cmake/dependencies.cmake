# The compiler and the external libraries, with the targets that rooms name after LIBRARIES:
# CONTACT_FFT_LIBRARY (fft), hdf5_fortran (hdf5, cli)
if(NOT CMAKE_Fortran_COMPILER_ID STREQUAL "GNU" OR CMAKE_Fortran_COMPILER_VERSION VERSION_LESS 12)
  message(FATAL_ERROR "CONTACT is built with gfortran 12 or newer, found "
    "${CMAKE_Fortran_COMPILER_ID} ${CMAKE_Fortran_COMPILER_VERSION}; "
    "choose another compiler with -DCMAKE_Fortran_COMPILER=...")
endif()
find_package(OpenMP REQUIRED COMPONENTS Fortran)
find_package(HDF5 COMPONENTS Fortran)
if(NOT HDF5_Fortran_FOUND)
  message(FATAL_ERROR "CONTACT needs HDF5 1.10.5 or newer with its Fortran interface (Debian: libhdf5-dev); "
    "-DHDF5_ROOT=... names its folder")
endif()

# HDF5 with its Fortran modules. Newer versions of CMake find it as targets, but contact.pc and the static libraries of the program
# need files
include(files_of_targets)
contact_files_of("${HDF5_Fortran_LIBRARIES}" CONTACT_HDF5_FILES target_folders)
set(CONTACT_HDF5_FOLDERS ${HDF5_Fortran_INCLUDE_DIRS} ${target_folders})
list(REMOVE_DUPLICATES CONTACT_HDF5_FOLDERS)
add_library(hdf5_fortran INTERFACE)
target_include_directories(hdf5_fortran INTERFACE ${CONTACT_HDF5_FOLDERS})
target_link_libraries(hdf5_fortran INTERFACE ${CONTACT_HDF5_FILES})

# Transforms: FFTW, MKL with the same interface, or pocketfft, whose source is included. CONTACT_FFT_LINK: libraries required by
# programs with the static library; CONTACT_FFT_NAME: name shown by contact --version, because the licence of the binary depends on it
set(CONTACT_FFT fftw CACHE STRING "Library of Fourier transforms: fftw, mkl or pocketfft")
set_property(CACHE CONTACT_FFT PROPERTY STRINGS fftw mkl pocketfft)
if(CONTACT_FFT STREQUAL "fftw")
  find_package(FFTW3 REQUIRED)
  set(CONTACT_FFT_SOURCES fftw.f90 library_fftw.f90)
  set(CONTACT_FFT_LIBRARY FFTW3::fftw3)
  set(CONTACT_FFT_LINK ${FFTW3_LIBRARY})
  set(CONTACT_FFT_NAME "FFTW 3 (GPL)")
elseif(CONTACT_FFT STREQUAL "mkl")
  find_package(MKLFFT REQUIRED)
  set(CONTACT_FFT_SOURCES fftw.f90 library_fftw.f90)
  set(CONTACT_FFT_LIBRARY MKLFFT::mkl)
  set(CONTACT_FFT_LINK ${MKLFFT_LIBRARY})
  set(CONTACT_FFT_NAME "MKL")
elseif(CONTACT_FFT STREQUAL "pocketfft")
  enable_language(CXX)
  set(CONTACT_FFT_SOURCES library_pocketfft.f90 pocketfft_plans.cpp pocketfft_portable.cpp)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND CONTACT_FFT_SOURCES pocketfft_avx2.cpp)
  endif()
  set(CONTACT_FFT_LIBRARY contact_cxx)
  set(CONTACT_FFT_LINK -lstdc++)
  set(CONTACT_FFT_NAME "pocketfft (BSD)")
  # Fortran is the linker language, so the run-time library of C++ is linked by name
  add_library(contact_cxx INTERFACE)
  target_link_libraries(contact_cxx INTERFACE ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
else()
  message(FATAL_ERROR "CONTACT_FFT must be fftw, mkl or pocketfft, not ${CONTACT_FFT}")
endif()
