# HDF5 inside the program
#
# On some systems the shared library of HDF5 loads thirty others (curl, Kerberos, LDAP), which takes longer than many cases. If its
# static libraries are in the same folder, the program is linked with them: CONTACT_PROGRAM_HDF5 is the target that replaces
# hdf5_fortran. The CONTACT library needs the shared one, because its host may use HDF5, too.
#
# base/guard.c treats statically linked code as our own. HDF5 handles refused memory requests itself, so its calls are renamed and
# handled like those of external libraries.
option(CONTACT_STATIC_HDF5 "Link the program with the archives of HDF5 where there are some" ON)
set(CONTACT_PROGRAM_HDF5 hdf5_fortran)
if(NOT CONTACT_STATIC_HDF5 OR CONTACT_SANITIZE OR CONTACT_FUZZ OR CONTACT_SHARED_ROOMS OR NOT CMAKE_OBJCOPY
  OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|aarch64)$")
  return()
endif()

# Its static libraries and their dependencies
set(archives)
set(needed)
foreach(library IN LISTS CONTACT_HDF5_FILES)
  if(library MATCHES "^(.*/libhdf5[a-z0-9_]*)\\.(so|a)$")
    list(APPEND archives ${CMAKE_MATCH_1}.a)
  elseif(library MATCHES "/lib(sz|aec|z|m|dl|pthread)\\.")
    list(APPEND needed ${library})
  endif()
endforeach()
# Targets of shared libraries do not name them
if(NOT needed)
  foreach(name sz aec z m)
    find_library(CONTACT_HDF5_NEEDS_${name} ${name})
    mark_as_advanced(CONTACT_HDF5_NEEDS_${name})
    if(CONTACT_HDF5_NEEDS_${name})
      list(APPEND needed ${CONTACT_HDF5_NEEDS_${name}})
    endif()
  endforeach()
  list(APPEND needed ${CMAKE_DL_LIBS})
endif()
foreach(archive IN LISTS archives)
  if(NOT EXISTS ${archive})
    return()
  endif()
endforeach()

# Its licence requires its notice with binaries that contain it: static libraries are used only if the notice is available
find_file(CONTACT_HDF5_NOTICE NAMES copyright COPYING NO_DEFAULT_PATH
  PATHS /usr/share/doc/libhdf5-dev /usr/share/licenses/hdf5-static /usr/share/licenses/hdf5)
if(NOT CONTACT_HDF5_NOTICE)
  return()
endif()

include(CheckFortranSourceCompiles)
set(CMAKE_REQUIRED_INCLUDES ${CONTACT_HDF5_FOLDERS})
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
