# HDF5 inside the program
#
# The shared library of HDF5 brings thirty others along on some systems (curl, Kerberos, LDAP), whose loading takes longer than
# many a case. Where its archives lie beside it, the program is linked with these: CONTACT_PROGRAM_HDF5 is the target that takes the
# place of hdf5_fortran. The library needs the shared one, as its host may use HDF5 too.
#
# Code that is linked in is our own for base/guard.c. HDF5 looks after refused memory itself, so its calls are renamed and
# lead to where those of outside libraries lead.
option(CONTACT_STATIC_HDF5 "Link the program with the archives of HDF5 where there are some" ON)
set(CONTACT_PROGRAM_HDF5 hdf5_fortran)
if(NOT CONTACT_STATIC_HDF5 OR CONTACT_SANITIZE OR CONTACT_FUZZ OR CONTACT_SHARED_ROOMS OR NOT CMAKE_OBJCOPY
  OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|aarch64)$")
  return()
endif()

# Its archives, and what they need besides
set(archives)
set(needed)
foreach(library IN LISTS HDF5_Fortran_LIBRARIES)
  if(library MATCHES "^(.*/libhdf5[a-z0-9_]*)\\.(so|a)$")
    list(APPEND archives ${CMAKE_MATCH_1}.a)
  elseif(library MATCHES "/lib(sz|aec|z|m|dl|pthread)\\.")
    list(APPEND needed ${library})
  endif()
endforeach()
foreach(archive IN LISTS archives)
  if(NOT EXISTS ${archive})
    return()
  endif()
endforeach()

# Its licence asks for its notice beside binaries that have it inside: no archives without it
find_file(CONTACT_HDF5_NOTICE NAMES copyright COPYING NO_DEFAULT_PATH
  PATHS /usr/share/doc/libhdf5-dev /usr/share/licenses/hdf5-static /usr/share/licenses/hdf5)
if(NOT CONTACT_HDF5_NOTICE)
  return()
endif()

include(CheckFortranSourceCompiles)
set(CMAKE_REQUIRED_INCLUDES ${HDF5_Fortran_INCLUDE_DIRS})
set(CMAKE_REQUIRED_LIBRARIES ${archives} ${needed})
check_fortran_source_compiles("
program start
   use hdf5, only : h5open_f
   integer :: status
   call h5open_f(status)
end program start
" CONTACT_HDF5_ARCHIVES_LINK SRC_EXT f90)
unset(CMAKE_REQUIRED_INCLUDES)
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT archives OR NOT CONTACT_HDF5_ARCHIVES_LINK)
  return()
endif()

set(renamed)
foreach(name malloc calloc realloc free strdup exit abort)
  list(APPEND renamed --redefine-sym ${name}=contact_outside_${name})
endforeach()
set(copies)
foreach(archive IN LISTS archives)
  get_filename_component(file ${archive} NAME)
  set(copy ${CMAKE_BINARY_DIR}/hdf5/${file})
  add_custom_command(OUTPUT ${copy} DEPENDS ${archive}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/hdf5
    COMMAND ${CMAKE_OBJCOPY} ${renamed} ${archive} ${copy})
  list(APPEND copies ${copy})
endforeach()
add_custom_target(contact_hdf5_archives DEPENDS ${copies})
add_library(hdf5_archives INTERFACE)
target_link_libraries(hdf5_archives INTERFACE ${copies} ${needed})
add_dependencies(hdf5_archives contact_hdf5_archives)
install(FILES ${CONTACT_HDF5_NOTICE} DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/${PROJECT_NAME} RENAME HDF5)
set(CONTACT_PROGRAM_HDF5 hdf5_archives)
