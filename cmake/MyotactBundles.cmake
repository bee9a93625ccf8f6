# Builds in bundles (CMAKE_UNITY_BUILD, presets asan and tsan): which sources of a target are compiled as one.

set(MYOTACT_MOST_BUNDLED 12)  # more, and one changed source costs as much as the rest of its folder

# myotact_bundle(TARGET): bundle_sources.py says which of its sources go together. Sources of another folder may be in
# several targets and are compiled alone.
function(myotact_bundle target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(own)
  foreach(source IN LISTS sources)
    if(NOT source MATCHES "\\.cpp$")
      continue()
    endif()
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${folder}" NORMALIZE)
    get_property(bundled GLOBAL PROPERTY MYOTACT_BUNDLED_SOURCES)
    cmake_path(IS_PREFIX folder "${source}" NORMALIZE is_own)
    if(is_own AND NOT source IN_LIST bundled)
      list(APPEND own "${source}")
      set_property(GLOBAL APPEND PROPERTY MYOTACT_BUNDLED_SOURCES "${source}")
    else()
      set_source_files_properties("${source}" TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  list(LENGTH own count)
  if(count LESS 2)
    return()
  endif()
  execute_process(COMMAND "${Python3_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/cmake/bundle_sources.py" ${MYOTACT_MOST_BUNDLED} ${own}
    OUTPUT_VARIABLE bundles OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" bundles "${bundles}")
  foreach(source bundle IN ZIP_LISTS own bundles)
    set_source_files_properties("${source}" TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP "${target}_${bundle}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  # A source that changes what it declares may have to leave its bundle.
  set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${own})
endfunction()

# myotact_bundle_all(FOLDER): every target of a folder and of those in it.
function(myotact_bundle_all folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(unity ${target} UNITY_BUILD)
    if(unity AND type MATCHES "LIBRARY|EXECUTABLE" AND NOT type STREQUAL "INTERFACE_LIBRARY")
      myotact_bundle(${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(inner IN LISTS folders)
    myotact_bundle_all("${inner}")
  endforeach()
endfunction()

if(CMAKE_UNITY_BUILD)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  myotact_bundle_all("${PROJECT_SOURCE_DIR}")
endif()
