# One object library per room. A room sees the modules of the rooms it names after USES and of
# no other, so an upward `use` ends in "cannot open module file".
set(CONTACT_MODULE_ROOT ${CMAKE_BINARY_DIR}/modules)

# contact_room(<room> USES <lower rooms> SOURCES <files>)
function(contact_room room)
  cmake_parse_arguments(arg "" "" "USES;SOURCES" ${ARGN})
  list(TRANSFORM arg_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${room}/)
  add_library(contact_${room} OBJECT ${arg_SOURCES})
  set_target_properties(contact_${room} PROPERTIES
    Fortran_MODULE_DIRECTORY ${CONTACT_MODULE_ROOT}/${room}
    POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(contact_${room} PRIVATE contact_warnings OpenMP::OpenMP_Fortran)
  foreach(lower IN LISTS arg_USES)
    target_include_directories(contact_${room} PRIVATE ${CONTACT_MODULE_ROOT}/${lower})
    add_dependencies(contact_${room} contact_${lower})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY contact_rooms ${room})
endfunction()
