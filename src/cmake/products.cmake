# Products of the rooms: libraries and program, and their installation
get_property(rooms GLOBAL PROPERTY contact_rooms)
get_property(program_room GLOBAL PROPERTY contact_program_room)
get_property(program_file GLOBAL PROPERTY contact_program_file)
set(program_start ${PROJECT_SOURCE_DIR}/src/cli/start.c)
list(REMOVE_ITEM rooms "" ${program_room})

set(objects)
set(libraries)
foreach(room IN LISTS rooms)
  list(APPEND objects $<TARGET_OBJECTS:contact_${room}>)
  get_target_property(room_libraries contact_${room} CONTACT_LIBRARIES)
  list(APPEND libraries ${room_libraries})
endforeach()
list(REMOVE_DUPLICATES libraries)
list(APPEND libraries OpenMP::OpenMP_Fortran)

# The shared library exports C functions only, and calls its own functions even if the host has others of the same names. It
# remains loaded when its host unloads it, because threads of the OpenMP run time would wait in code that no longer exists
set(map ${PROJECT_SOURCE_DIR}/src/cmake/contact.map)
function(contact_shared target)
  add_library(${target} SHARED ${objects})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE Fortran LINK_DEPENDS ${map})
  if(NOT APPLE AND NOT WIN32)
    target_link_options(${target} PRIVATE LINKER:--version-script=${map} LINKER:--as-needed LINKER:-Bsymbolic-functions
      LINKER:-z,nodelete)
    if(NOT CONTACT_SANITIZE AND NOT CONTACT_FUZZ)
      target_link_options(${target} PRIVATE LINKER:--no-undefined)
    endif()
  endif()
  target_link_libraries(${target} PRIVATE ${libraries})
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

# Its soname has the version of its interface
contact_shared(contact)
if(NOT SKBUILD)
  set_target_properties(contact PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
endif()
add_library(contact::contact ALIAS contact)

# The same under the file name that existing callers load and link, in the folder of the program. Like the library of that name it
# has no soname: programs linked with it load this file, not libcontact
if(NOT APPLE AND NOT WIN32)
  contact_shared(contact_addon)
  set_target_properties(contact_addon PROPERTIES
    PREFIX "" OUTPUT_NAME contact_addon_linux64 NO_SONAME ON
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
  # Remove the link to libcontact that build folders of earlier versions have here, because linkers write through links
  add_custom_command(TARGET contact_addon PRE_LINK COMMAND ${CMAKE_COMMAND} -E rm -f $<TARGET_FILE:contact_addon>)
  install(TARGETS contact_addon LIBRARY DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

add_library(contact_static STATIC ${objects})
set_target_properties(contact_static PROPERTIES LINKER_LANGUAGE Fortran OUTPUT_NAME contact)

if(CONTACT_SHARED_ROOMS)
  add_library(contact_all_rooms SHARED ${objects} $<TARGET_OBJECTS:contact_${program_room}>)
  set_target_properties(contact_all_rooms PROPERTIES LINKER_LANGUAGE Fortran)
  target_link_libraries(contact_all_rooms PRIVATE ${libraries})
endif()

# The program does not need the shared library, so it can be copied anywhere
if(program_room)
  add_executable(contact_program ${program_file} ${program_start})
  set_target_properties(contact_program PROPERTIES
    OUTPUT_NAME contact
    Fortran_MODULE_DIRECTORY ${CONTACT_MODULE_ROOT}/program)
  target_link_libraries(contact_program PRIVATE contact_warnings OpenMP::OpenMP_Fortran)
  contact_link_rooms(contact_program base ${program_room})
  get_target_property(program_libraries contact_program LINK_LIBRARIES)
  list(TRANSFORM program_libraries REPLACE "^hdf5_fortran$" ${CONTACT_PROGRAM_HDF5})
  set_target_properties(contact_program PROPERTIES LINK_LIBRARIES "${program_libraries}")
  install(TARGETS contact_program RUNTIME)
endif()

# Program and libraries without the tests: cmake --build --preset products
add_custom_target(products)
foreach(product contact contact_addon contact_static contact_program)
  if(TARGET ${product})
    add_dependencies(products ${product})
  endif()
endforeach()

# The Python package; the program finds the pages of `contact report` in this folder
install(DIRECTORY ${PROJECT_SOURCE_DIR}/python/contact ${PROJECT_SOURCE_DIR}/python/python_intfc DESTINATION ${CMAKE_INSTALL_DATADIR}/contact/python
  FILES_MATCHING PATTERN "*.py" PATTERN "*.html" PATTERN "*.js" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)

set(headers contact.h contact_addon.h caddon_flags.h caddon_flags.inc contact_addon.ifc contact_addon.f90
  contact_table.f90)
list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/include/)
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS contact EXPORT contact LIBRARY ARCHIVE)
install(TARGETS contact_static ARCHIVE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/matlab DESTINATION ${CMAKE_INSTALL_DATADIR}/contact
  FILES_MATCHING PATTERN *.m PATTERN *.c)
set(licences ${CMAKE_INSTALL_DATADIR}/licenses/${PROJECT_NAME})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${licences})
if(CONTACT_FFT STREQUAL "pocketfft")
  install(FILES ${PROJECT_SOURCE_DIR}/src/fft/pocketfft/LICENSE.md DESTINATION ${licences} RENAME pocketfft)
endif()

# In a Python wheel: library and program in the folder of the package, see src/packaging/pyproject.toml
if(SKBUILD)
  install(TARGETS contact LIBRARY DESTINATION contact COMPONENT python RUNTIME DESTINATION contact COMPONENT python)
  install(TARGETS contact_program RUNTIME DESTINATION contact/bin COMPONENT python)
endif()

# CMake package: find_package(contact) gives contact::contact
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/contact)
configure_package_config_file(${PROJECT_SOURCE_DIR}/src/cmake/contact-config.cmake.in
  ${CMAKE_BINARY_DIR}/contact-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/contact-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/contact-config.cmake
  ${CMAKE_BINARY_DIR}/contact-config-version.cmake DESTINATION ${package_folder})
install(EXPORT contact NAMESPACE contact:: FILE contact-targets.cmake
  DESTINATION ${package_folder})

# pkg-config: paths relative to the file, so that the installation can be moved, also where the folders are given as absolute paths;
# requirements of the static library are listed for `pkg-config --static`: libraries by their files, because they may be in folders
# that linkers do not search, and the run-time libraries of the compiler, which differ by processor
set(pc_folder ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix ${pc_folder} ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH pc_libdir ${pc_folder} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH pc_includedir ${pc_folder} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
set(run_time ${CMAKE_Fortran_IMPLICIT_LINK_LIBRARIES} ${OpenMP_Fortran_LIB_NAMES} m)
list(REMOVE_DUPLICATES run_time)
list(FILTER run_time EXCLUDE REGEX "^(gcc|gcc_s|c)$")
list(TRANSFORM run_time PREPEND -l REGEX "^[^/-]")
set(pc_private ${CONTACT_FFT_LINK} ${CONTACT_HDF5_FILES} ${run_time})
list(TRANSFORM pc_private REPLACE " " "\\\\ ")
string(JOIN " " pc_private ${pc_private})
configure_file(${PROJECT_SOURCE_DIR}/src/cmake/contact.pc.in ${CMAKE_BINARY_DIR}/contact.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/contact.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
