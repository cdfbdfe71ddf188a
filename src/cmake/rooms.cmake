# One object library per room. A room can use only the modules of the rooms named after USES;
# a `use` of a higher room fails with "cannot open module file".
set(CONTACT_MODULE_ROOT ${CMAKE_BINARY_DIR}/modules)
set(CONTACT_MODULE_STAMP ${CMAKE_CURRENT_LIST_DIR}/module_stamp.cmake)

# contact_room(<room> [USES <lower rooms>] SOURCES <files> [LIBRARIES <targets>] [PROGRAM <file>])
#
# LIBRARIES are external libraries used by this room only (that of transforms in fft). PROGRAM is the file of
# the main program; its room is linked into bin/contact and not into the libraries.
function(contact_room room)
  cmake_parse_arguments(arg "" "PROGRAM" "USES;SOURCES;LIBRARIES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "contact_room(${room}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  list(TRANSFORM arg_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${room}/)
  add_library(contact_${room} OBJECT ${arg_SOURCES})
  set_target_properties(contact_${room} PROPERTIES
    Fortran_MODULE_DIRECTORY ${CONTACT_MODULE_ROOT}/${room}
    POSITION_INDEPENDENT_CODE ON CXX_STANDARD 14 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_link_libraries(contact_${room} PRIVATE contact_warnings OpenMP::OpenMP_Fortran
    ${arg_LIBRARIES})

  set(closure ${room})
  set(below)
  set(libraries ${arg_LIBRARIES})
  foreach(lower IN LISTS arg_USES)
    if(NOT TARGET contact_${lower})
      message(FATAL_ERROR "contact_room(${room}): room ${lower} is not defined before it")
    endif()
    target_include_directories(contact_${room} PRIVATE ${CONTACT_MODULE_ROOT}/${lower})
    add_dependencies(contact_${room} contact_${lower}_modules)
    list(APPEND below ${CONTACT_MODULE_ROOT}/${lower}.stamp)
    get_target_property(lower_closure contact_${lower} CONTACT_CLOSURE)
    get_target_property(lower_libraries contact_${lower} CONTACT_LIBRARIES)
    list(APPEND closure ${lower_closure})
    list(APPEND libraries ${lower_libraries})
  endforeach()
  list(REMOVE_DUPLICATES closure)
  list(REMOVE_DUPLICATES libraries)
  # CMake tracks module files within a target and through linked libraries, but not between object
  # libraries: therefore a source is recompiled if a module file of a room that it uses has changed
  set(objects)
  foreach(source IN LISTS arg_SOURCES)
    file(RELATIVE_PATH relative ${CMAKE_CURRENT_SOURCE_DIR} ${source})
    list(APPEND objects ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/contact_${room}.dir/${relative}.o)
  endforeach()
  set_source_files_properties(${arg_SOURCES} PROPERTIES OBJECT_DEPENDS "${below}")
  set(stamp ${CONTACT_MODULE_ROOT}/${room}.stamp)
  add_custom_command(OUTPUT ${stamp} DEPENDS ${objects} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D folder=${CONTACT_MODULE_ROOT}/${room} -D stamp=${stamp} -P ${CONTACT_MODULE_STAMP})
  add_custom_target(contact_${room}_modules DEPENDS ${stamp})
  add_dependencies(contact_${room}_modules contact_${room})

  # Rooms and external libraries to be linked with a program that uses this room
  set_target_properties(contact_${room} PROPERTIES
    CONTACT_CLOSURE "${closure}"
    CONTACT_LIBRARIES "${libraries}")

  set_property(GLOBAL APPEND PROPERTY contact_rooms ${room})
  if(arg_PROGRAM)
    set_property(GLOBAL PROPERTY contact_program_room ${room})
    set_property(GLOBAL PROPERTY contact_program_file
      ${CMAKE_CURRENT_SOURCE_DIR}/${room}/${arg_PROGRAM})
  endif()
endfunction()

# Give a target access to the modules of the named rooms, and recompile it if one of them has changed
#
# A source belongs to its folder: each other target of the folder with the same Fortran source needs these rooms, too, or Make has no
# rule for them
function(contact_use_rooms target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.][fF](90)?$")
  foreach(room IN LISTS ARGN)
    if(NOT TARGET contact_${room})
      message(FATAL_ERROR "${target}: there is no room ${room}")
    endif()
    target_include_directories(${target} PRIVATE ${CONTACT_MODULE_ROOT}/${room})
    add_dependencies(${target} contact_${room}_modules)
    set_property(SOURCE ${sources} APPEND PROPERTY OBJECT_DEPENDS ${CONTACT_MODULE_ROOT}/${room}.stamp)
  endforeach()
endfunction()

# Program and tests share one library of all rooms, so that a change of one file needs one link
option(CONTACT_SHARED_ROOMS "Link program and tests with one shared library of all rooms (tests/planted)" OFF)

# The same, and link it with these rooms and all lower ones
function(contact_link_rooms target)
  contact_use_rooms(${target} ${ARGN})
  if(CONTACT_SHARED_ROOMS)
    target_link_libraries(${target} PRIVATE contact_all_rooms)
    return()
  endif()
  set(closure)
  set(libraries)
  foreach(room IN LISTS ARGN)
    get_target_property(room_closure contact_${room} CONTACT_CLOSURE)
    get_target_property(room_libraries contact_${room} CONTACT_LIBRARIES)
    list(APPEND closure ${room_closure})
    list(APPEND libraries ${room_libraries})
  endforeach()
  list(REMOVE_DUPLICATES closure)
  list(REMOVE_DUPLICATES libraries)
  foreach(room IN LISTS closure)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:contact_${room}>)
  endforeach()
  target_link_libraries(${target} PRIVATE ${libraries})
endfunction()
