# The compiler and the outside libraries, with the targets by which rooms name them after LIBRARIES:
# FFTW3::fftw3 (fft), hdf5_fortran (hdf5, cli)
if(NOT CMAKE_Fortran_COMPILER_ID STREQUAL "GNU" OR CMAKE_Fortran_COMPILER_VERSION VERSION_LESS 12)
  message(FATAL_ERROR "CONTACT is built with gfortran 12 or newer, found "
    "${CMAKE_Fortran_COMPILER_ID} ${CMAKE_Fortran_COMPILER_VERSION}; "
    "choose another compiler with -DCMAKE_Fortran_COMPILER=...")
endif()
find_package(OpenMP REQUIRED COMPONENTS Fortran)
find_package(FFTW3 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS Fortran)

# HDF5 with its Fortran modules
add_library(hdf5_fortran INTERFACE)
target_include_directories(hdf5_fortran INTERFACE ${HDF5_Fortran_INCLUDE_DIRS})
target_link_libraries(hdf5_fortran INTERFACE ${HDF5_Fortran_LIBRARIES})
