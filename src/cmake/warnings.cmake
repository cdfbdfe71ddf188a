# Warnings and language options shared by all rooms
option(CONTACT_WERROR "Treat compiler warnings as errors" OFF)
add_library(contact_warnings INTERFACE)
target_compile_options(contact_warnings INTERFACE
  $<$<COMPILE_LANGUAGE:Fortran>:-std=f2018 -Wall -Wextra -Wimplicit-interface -Wimplicit-procedure
    -Wtrampolines -Wno-compare-reals -Wno-maybe-uninitialized -frecursive -ffree-line-length-132>
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra>)
if(CONTACT_WERROR)
  target_compile_options(contact_warnings INTERFACE -Werror)
endif()
