# cmake -D folder=<modules of a room> -D stamp=<file> -P module_stamp.cmake
#
# Write the checksums of all module files to the stamp file, whose time stamp does not change if the modules have not changed
file(GLOB modules ${folder}/*.mod)
set(sums "")
foreach(module IN LISTS modules)
  file(SHA256 ${module} sum)
  string(APPEND sums "${sum} ${module}\n")
endforeach()
set(before "")
if(EXISTS ${stamp})
  file(READ ${stamp} before)
endif()
if(NOT before STREQUAL sums)
  file(WRITE ${stamp} "${sums}")
endif()
