# Functions that define a test in one line. Labels are names of folders below tests/.
set(CONTACT_REFERENCE ${PROJECT_SOURCE_DIR}/../shared/reference CACHE PATH
  "Reference data; tests that need it are skipped when it is absent")

# Compile tests without optimisation: the tested code is compiled in its rooms, with optimisation and instrumentation.
# With -O1 scopes with cases and results take a minute, because the compiler copies the release of their components into each
function(contact_quick_compilation target)
  target_compile_options(${target} PRIVATE $<$<AND:$<COMPILE_LANGUAGE:Fortran>,$<NOT:$<CONFIG:Debug>>>:-O0>)
  if(CONTACT_SANITIZE)
    # An optimised test with full instrumentation takes a minute to compile; without it some seconds.
    # Options of the sources follow those of the target
    get_target_property(sources ${target} SOURCES)
    set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS "-O0;-fno-sanitize=undefined")
  endif()
endfunction()

# A hundred test programs are linked; gold takes half the time of the default linker
include(CheckLinkerFlag)
if(NOT CONTACT_SANITIZE AND NOT CONTACT_FUZZ AND NOT CONTACT_COVERAGE)
  check_linker_flag(Fortran -fuse-ld=gold CONTACT_HAS_GOLD)
endif()

# contact_test(<name> [BUILDERS] LABEL <labels> ROOMS <rooms> SOURCES <files> [TIMEOUT <seconds>])
#
# A Fortran test program. It can use the modules of the named rooms and of the harness, and is linked
# with these rooms and all lower ones, so that it can be built even if other parts cannot. It runs in
# a separate temporary folder. BUILDERS adds the modules of tests/support that build a case. Exit status 77 means "skipped".
# A second label `long` keeps a test out of the default run of tests/run.sh.
function(contact_test name)
  cmake_parse_arguments(arg "BUILDERS" "TIMEOUT" "LABEL;ROOMS;SOURCES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_LABEL OR NOT arg_SOURCES)
    message(FATAL_ERROR "contact_test(${name}): LABEL and SOURCES are required, and nothing else than "
      "ROOMS and TIMEOUT is known; got ${ARGN}")
  endif()
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE contact_test_support contact_warnings
    OpenMP::OpenMP_Fortran)
  set_target_properties(${target} PROPERTIES
    Fortran_MODULE_DIRECTORY ${CMAKE_BINARY_DIR}/modules/tests/${name}
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(NOT arg_LABEL MATCHES performance)
    contact_quick_compilation(${target})
  endif()
  if(arg_BUILDERS)
    target_link_libraries(${target} PRIVATE contact_test_builders)
  endif()
  contact_link_rooms(${target} base ${arg_ROOMS})
  if(CONTACT_HAS_GOLD)
    target_link_options(${target} PRIVATE -fuse-ld=gold)
  endif()
  contact_command_test(${name} LABEL ${arg_LABEL} TIMEOUT ${arg_TIMEOUT} COMMAND ${target})
endfunction()

# Tests that start first, so that none of them runs alone at the end, with their duration when three run on two processors [s]. From
# the second run on ctest uses its own figures
set(CONTACT_LONG_TESTS report_viewer:101 faults_of_files:73 study_cluster:70 octave_figures:59 oblique_edges:53 house_pages:48
  study_results:47 faults_resume:47 memcheck_readable:42 report_browser:40 performance_instructions:37 study_tables:36
  octave_plots:35 campaign_module1:34 report_damaged:34 capi_second_order:32 study_wheel_wear:31 hdf5_file:30 memcheck_resume:28
  octave_damaged:26 octave_hdf5:24 force_search:24 octave_results:23 memcheck_run:23 report_start:23 study_command:21
  manual_tutorials:21 worn_profiles:21 reference:21 octave_habits_drawn:19 faults_of_host_files:19 order:18 study_notebook:17
  sweeps:16 study_description:15 capi_past:15 capi_wheel:15 study_kills:14 capi_splits:14 report_server:14 hard_grids:13
  crossings:13)

# contact_command_test(<name> LABEL <labels> COMMAND <program> <arguments> [TIMEOUT <seconds>])
#
# Any other test: a script, or the program itself. Environment: CONTACT_SOURCE (top of the
# checkout), CONTACT_PROGRAM (bin/contact) and CONTACT_REFERENCE.
function(contact_command_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "LABEL;COMMAND" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(CMAKE_BUILD_TYPE STREQUAL Debug OR CONTACT_SANITIZE)
    # run-time checks take time
    math(EXPR arg_TIMEOUT "4*${arg_TIMEOUT}")
  endif()
  set(scratch ${CMAKE_BINARY_DIR}/tests/scratch/${name})
  file(MAKE_DIRECTORY ${scratch})
  add_test(NAME ${name} COMMAND ${arg_COMMAND} WORKING_DIRECTORY ${scratch})
  set_tests_properties(${name} PROPERTIES
    LABELS "${arg_LABEL}"
    TIMEOUT ${arg_TIMEOUT}
    SKIP_RETURN_CODE 77
    ENVIRONMENT "CONTACT_REFERENCE=${CONTACT_REFERENCE};CONTACT_SOURCE=${PROJECT_SOURCE_DIR};CONTACT_PROGRAM=${CMAKE_BINARY_DIR}/bin/contact")
  if(";${CONTACT_LONG_TESTS};" MATCHES ";${name}:([0-9]+);")
    set_property(TEST ${name} PROPERTY COST ${CMAKE_MATCH_1})
  endif()
endfunction()

# contact_python_test(<name> LABEL <labels> SCRIPT <file> [<arguments>] [TIMEOUT <seconds>])
#
# A test by a Python script. The interpreter is looked up when the test runs, not when the build is configured, because
# tests/run.sh may have added one with the packages of the tests to the search path.
function(contact_python_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "LABEL;SCRIPT" ${ARGN})
  contact_command_test(${name} LABEL ${arg_LABEL} TIMEOUT ${arg_TIMEOUT} COMMAND python3 -B ${arg_SCRIPT})
endfunction()

# Python is not instrumented; it can load a library with the address sanitizer if that is loaded first. Memory kept by Python is not
# reported as a leak
set(CONTACT_INSTRUMENTS)
if(CONTACT_SANITIZE MATCHES address)
  foreach(library asan ubsan)
    execute_process(COMMAND ${CMAKE_C_COMPILER} -print-file-name=lib${library}.so OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE)
    list(APPEND CONTACT_INSTRUMENTS ${path})
  endforeach()
  list(JOIN CONTACT_INSTRUMENTS " " CONTACT_INSTRUMENTS)
endif()

# contact_library_test(<name> ...): the same for a script that loads the library named by CONTACT_LIBRARY
function(contact_library_test name)
  contact_python_test(${name} ${ARGN})
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "CONTACT_LIBRARY=$<TARGET_FILE:contact>")
  if(CONTACT_INSTRUMENTS)
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT
      "LD_PRELOAD=${CONTACT_INSTRUMENTS}" "ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1")
  endif()
endfunction()
