# How every target of the project is compiled, and the functions that declare them.

add_library(myotact_options INTERFACE)
target_compile_features(myotact_options INTERFACE cxx_std_20)
# Contraction into fused multiply-adds would make results differ between compilers and optimisation levels.
target_compile_options(myotact_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Werror -Wno-psabi -ffp-contract=off)
target_compile_definitions(myotact_options INTERFACE EIGEN_MPL2_ONLY)
target_include_directories(myotact_options INTERFACE "${PROJECT_SOURCE_DIR}/src")

# myotact_library(FOLDER SOURCES files... LINKS targets...): the static library myotact_FOLDER of one src/ folder.
# A link line names the folders that this one may include.
function(myotact_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  if(ARG_SOURCES)
    add_library(myotact_${folder} STATIC ${ARG_SOURCES})
    target_link_libraries(myotact_${folder} PUBLIC myotact_options ${ARG_LINKS})
  else()
    add_library(myotact_${folder} INTERFACE)
    target_link_libraries(myotact_${folder} INTERFACE myotact_options ${ARG_LINKS})
  endif()
endfunction()

# myotact_test(NAME [DRAWS] [ALONE] LABELS labels... SOURCES files... LINKS targets...): one GoogleTest program, each case a
# ctest entry. DRAWS: it starts Mesa, whose threads trip the leak check at the end now and then; our own leaks show in
# the other tests. ALONE: no other test runs beside it.
function(myotact_test name)
  cmake_parse_arguments(ARG "DRAWS;ALONE" "TIMEOUT" "LABELS;SOURCES;LINKS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE myotact_options ${ARG_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(${name} PRIVATE MYOTACT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # One word, since lists do not survive gtest_discover_tests; ctest's -L and -LE find each label in it.
  string(REPLACE ";" "-" labels "${ARG_LABELS}")
  set(environment)
  if(ARG_DRAWS)
    set(environment ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  endif()
  set(alone)
  if(ARG_ALONE)
    set(alone RUN_SERIAL TRUE)
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS "${labels}" TIMEOUT ${ARG_TIMEOUT} ${environment} ${alone})
endfunction()
