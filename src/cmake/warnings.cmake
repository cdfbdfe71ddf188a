# Warnings, language options and configurations shared by all rooms and tests
option(CONTACT_WERROR "Treat compiler warnings as errors" OFF)
option(CONTACT_NATIVE "Use all instructions of this machine (-march=native); not portable" OFF)
set(CONTACT_SANITIZE "" CACHE STRING "Sanitizers, for instance address,undefined")
option(CONTACT_COVERAGE "Count executed lines (gcov)" OFF)
option(CONTACT_FUZZ "Report every branch that is taken to tests/fuzz, which is then driven by libFuzzer" OFF)

add_library(contact_warnings INTERFACE)
target_compile_options(contact_warnings INTERFACE
  $<$<COMPILE_LANGUAGE:Fortran>:-std=f2018 -Wall -Wextra -Wimplicit-interface -Wimplicit-procedure
    -Wtrampolines -Wno-compare-reals -Wno-uninitialized -Wno-maybe-uninitialized -fimplicit-none -frecursive
    -ffree-line-length-132>
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra>)
# -Wno-uninitialized: gfortran 12.2 regards the bounds of an unallocated array as uninitialized when the array is
# assigned; debug builds set reals to signalling NaN
if(CONTACT_WERROR)
  target_compile_options(contact_warnings INTERFACE -Werror)
endif()
if(CONTACT_NATIVE)
  target_compile_options(contact_warnings INTERFACE -march=native)
endif()
if(CONTACT_SANITIZE)
  target_compile_options(contact_warnings INTERFACE
    -fsanitize=${CONTACT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  # gfortran 12.2 computes the address of an absent optional array before it passes on that it is absent, and
  # the check regards that as a load; a true access to address zero still ends the program
  target_compile_options(contact_warnings INTERFACE
    $<$<COMPILE_LANGUAGE:Fortran>:-fno-sanitize=null>)
  add_link_options(-fsanitize=${CONTACT_SANITIZE})
endif()
if(CONTACT_FUZZ)
  target_compile_options(contact_warnings INTERFACE -fsanitize-coverage=trace-pc)
endif()
if(CONTACT_COVERAGE)
  target_compile_options(contact_warnings INTERFACE --coverage)
  add_link_options(--coverage)
endif()

# Sources are not preprocessed, except where stated: CMake would write a copy of each before it searches for modules
set(CMAKE_Fortran_PREPROCESS OFF)

# Debug: all run-time checks of the compiler. Release: no -ffast-math, because checks for
# NaN and reproducible sums matter.
set(CMAKE_Fortran_FLAGS_DEBUG
  "-O0 -g -fcheck=all,no-array-temps -fbacktrace -finit-real=snan -ffpe-trap=invalid,zero,overflow")
set(CMAKE_Fortran_FLAGS_RELEASE "-O3 -g1")
set(CMAKE_C_FLAGS_DEBUG "-O0 -g")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")
