# How every target of the project is compiled, and the functions that declare them.

add_library(myotact_options INTERFACE)
target_compile_features(myotact_options INTERFACE cxx_std_20)
# Contraction into fused multiply-adds would make results differ between compilers and optimisation levels.
target_compile_options(myotact_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Werror -Wno-psabi -ffp-contract=off)
# g++ collects its garbage from 128 MB on; from 1 GB on, it takes 8 to 15 % less time and some 150 MB more a process.
target_compile_options(myotact_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
if(MYOTACT_BUNDLES)  # where no source is the main one, g++ takes all for headers
  target_compile_options(myotact_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
target_compile_definitions(myotact_options INTERFACE EIGEN_MPL2_ONLY)
target_include_directories(myotact_options INTERFACE "${PROJECT_SOURCE_DIR}/src")

# myotact_declare_headers(NAME LINKS targets... HEADERS headers...): headers that are compiled once for all sources of the
# targets that myotact_precompile() names. Sources still include what they use: clang-tidy reads each without them.
function(myotact_declare_headers name)
  cmake_parse_arguments(ARG "" "" "LINKS;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp" CONTENT "")
  add_library(${name} OBJECT "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  target_link_libraries(${name} PRIVATE myotact_options ${ARG_LINKS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# myotact_precompile(HEADERS targets...): for targets that link myotact_core. Out of a precompiled header, g++ 12 warns of
# the strings of its own library (its bug 105329); by -fpch-preprocess ccache knows what is in it.
function(myotact_precompile headers)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)  # nor does clang-tidy know g++'s options
    return()
  endif()
  foreach(target IN LISTS ARGN)
    target_precompile_headers(${target} REUSE_FROM ${headers})
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread>)
  endforeach()
endfunction()

# myotact_unoptimised_if_sanitized(sources...): templates of a library that takes a minute to optimise under a sanitizer, in
# sources whose own work is short or waits for somebody. They cannot share precompiled headers with the optimised ones.
function(myotact_unoptimised_if_sanitized)
  if(MYOTACT_SANITIZED)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0 SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

set(MYOTACT_CORE_LINKS Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt spdlog::spdlog OpenSSL::Crypto)
set(MYOTACT_COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numbers> <optional> <span>
  <string> <string_view> <thread> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)
myotact_declare_headers(myotact_headers LINKS ${MYOTACT_CORE_LINKS} HEADERS ${MYOTACT_COMMON_HEADERS})

# myotact_library(FOLDER SOURCES files... LINKS targets...): the static library myotact_FOLDER of one src/ folder.
# A link line names the folders that this one may include.
function(myotact_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  if(ARG_SOURCES)
    add_library(myotact_${folder} STATIC ${ARG_SOURCES})
    target_link_libraries(myotact_${folder} PUBLIC myotact_options ${ARG_LINKS})
    myotact_precompile(myotact_headers myotact_${folder})
  else()
    add_library(myotact_${folder} INTERFACE)
    target_link_libraries(myotact_${folder} INTERFACE myotact_options ${ARG_LINKS})
  endif()
endfunction()

# myotact_test(NAME [DRAWS] [LOCKS resources...] [LONG cases] LABELS labels... SOURCES files... LINKS targets...): one
# GoogleTest program, each case a ctest entry. DRAWS: it starts Mesa, whose threads trip the leak check at the end now and
# then; our own leaks show in the other tests. LOCKS: what it shares with others, one of which runs at a time. LONG: a
# pattern of GoogleTest for the cases that take about a minute: they are labelled "long", too, and tools/test.sh runs them,
# but .ci/run, for every change, does not.
#
# Under a sanitizer a program is one entry, because to start it takes longer than most of its cases. What is slow there, or
# measures time, is not built with the rest and not run. The target slow_tests is what is left out there.
add_custom_target(slow_tests)
function(myotact_test name)
  cmake_parse_arguments(ARG "DRAWS" "TIMEOUT;LONG" "LABELS;LOCKS;SOURCES;LINKS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE myotact_options ${ARG_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  myotact_precompile(myotact_test_headers ${name})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  # One word, since lists do not survive gtest_discover_tests; ctest's -L and -LE find each label in it.
  string(REPLACE ";" "-" labels "${ARG_LABELS}")
  set(properties LABELS "${labels}" TIMEOUT ${ARG_TIMEOUT})
  if(ARG_DRAWS)
    list(APPEND properties ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  endif()
  if(labels MATCHES "slow")
    list(APPEND properties COST 100)  # first, so that no long one is left over at the end
  endif()
  if(ARG_LOCKS)
    string(REPLACE ";" "," locks "${ARG_LOCKS}")
    list(APPEND properties RESOURCE_LOCK "${locks}")
  endif()
  if(labels MATCHES "slow|realtime")
    add_dependencies(slow_tests ${name})
  endif()
  if(NOT MYOTACT_SANITIZED)
    if(ARG_LONG)
      set(others TEST_FILTER "-${ARG_LONG}")
      set(long_properties ${properties} LABELS "${labels}-long")
      gtest_discover_tests(${name} TEST_LIST ${name}_long_cases TEST_FILTER "${ARG_LONG}" DISCOVERY_MODE PRE_TEST
        PROPERTIES ${long_properties})
    endif()
    gtest_discover_tests(${name} ${others} DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
  elseif(labels MATCHES "slow|realtime")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  else()
    add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(${name} PROPERTIES ${properties} TIMEOUT 2400)
  endif()
endfunction()
