# Outside libraries and the targets by which rooms name them after LIBRARIES:
# FFTW3::fftw3 (fft), LAPACK::LAPACK (numeric), contact_hdf5 (cli)
find_package(OpenMP REQUIRED COMPONENTS Fortran)
find_package(FFTW3 REQUIRED)
find_package(LAPACK REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS Fortran)

# HDF5 with its Fortran modules. Today only `contact --version` asks it for its number.
add_library(contact_hdf5 INTERFACE)
target_include_directories(contact_hdf5 INTERFACE ${HDF5_Fortran_INCLUDE_DIRS})
target_link_libraries(contact_hdf5 INTERFACE ${HDF5_Fortran_LIBRARIES})
