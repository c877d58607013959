# signweave_module(NAME SOURCES a.cpp … DEPENDS core … [LIBRARIES Eigen3::Eigen …])
#
# One module of the library: the folder it is called from. The sources are its table of contents; its tests are found by
# name (*_test.cpp), never listed. DEPENDS names the modules whose headers it may include; the test `layers` holds it to
# that. LIBRARIES are third-party targets. APART are sources whose private names are also those of another's: where sources
# are compiled together, they are not. TEST_SOURCES are compiled into the test program beside the tests.
define_property(GLOBAL PROPERTY SIGNWEAVE_LAYERS BRIEF_DOCS "rows 'module:dependency,dependency'")
define_property(GLOBAL PROPERTY SIGNWEAVE_MODULES BRIEF_DOCS "library targets, lowest first")

# What nearly every file reads, compiled once. Includes stay written out in each file: the precompiled header only saves time.
file(WRITE ${PROJECT_BINARY_DIR}/pch.cpp "")
add_library(signweave_pch OBJECT ${PROJECT_BINARY_DIR}/pch.cpp)
target_link_libraries(signweave_pch PRIVATE signweave_flags)
target_include_directories(signweave_pch SYSTEM PRIVATE ${EIGEN3_INCLUDE_DIRS})
target_precompile_headers(signweave_pch PRIVATE <Eigen/Geometry> <algorithm> <cmath> <filesystem> <functional> <map> <memory>
                          <optional> <span> <string> <string_view> <unordered_map> <variant> <vector>)
if(SIGNWEAVE_TESTS)
  add_library(signweave_test_pch OBJECT ${PROJECT_BINARY_DIR}/pch.cpp)
  target_link_libraries(signweave_test_pch PRIVATE signweave_test_flags)
  target_include_directories(signweave_test_pch SYSTEM PRIVATE ${EIGEN3_INCLUDE_DIRS})
  target_precompile_headers(signweave_test_pch PRIVATE <Eigen/Geometry> <algorithm> <cmath> <filesystem> <functional> <map>
                            <memory> <optional> <span> <string> <string_view> <unordered_map> <variant> <vector>
                            <gmock/gmock.h> <gtest/gtest.h> <rapidcheck/gtest.h>)
endif()

function(signweave_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;APART;DEPENDS;LIBRARIES;TEST_SOURCES" ${ARGN})
  set(target signweave_${name})
  list(TRANSFORM arg_DEPENDS PREPEND signweave:: OUTPUT_VARIABLE depends)
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES} ${arg_APART})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:signweave_flags>)
    target_precompile_headers(${target} REUSE_FROM signweave_pch)
    if(SIGNWEAVE_SANITIZE)
      # A third of the time of compiling is what files include. The release build compiles each by itself.
      set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
      set_source_files_properties(${arg_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(signweave::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} ${scope} ${depends} ${arg_LIBRARIES})
  string(REPLACE ";" "," row "${arg_DEPENDS}")
  set_property(GLOBAL APPEND PROPERTY SIGNWEAVE_LAYERS "${name}:${row}")
  set_property(GLOBAL APPEND PROPERTY SIGNWEAVE_MODULES ${target})
  signweave_tests(${name} LIBRARIES signweave::${name} SOURCES ${arg_TEST_SOURCES})
endfunction()

# signweave_tests(NAME LIBRARIES …): one test program from every *_test.cpp of the folder it is called from.
function(signweave_tests name)
  cmake_parse_arguments(arg "" "" "LIBRARIES;SOURCES" ${ARGN})
  if(NOT SIGNWEAVE_TESTS OR (SIGNWEAVE_TESTED AND NOT name IN_LIST SIGNWEAVE_TESTED))
    return()
  endif()
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  if(NOT tests)
    return()
  endif()
  add_executable(${name}_test ${tests} ${arg_SOURCES})
  target_link_libraries(${name}_test PRIVATE ${arg_LIBRARIES} signweave_test_flags)
  target_precompile_headers(${name}_test REUSE_FROM signweave_test_pch)
  if(SIGNWEAVE_SANITIZE)
    # Instrumented programs take long to start: each runs as a whole, in two halves.
    foreach(half IN ITEMS 0 1)
      add_test(NAME ${name}_test.${half} COMMAND ${name}_test)
      set_tests_properties(${name}_test.${half} PROPERTIES TIMEOUT 1800
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=${half};GTEST_BRIEF=1")
    endforeach()
  else()
    gtest_discover_tests(${name}_test DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
  endif()
endfunction()

# Writes the table of modules for the test `layers`.
function(signweave_write_layers)
  get_property(rows GLOBAL PROPERTY SIGNWEAVE_LAYERS)
  string(REPLACE ";" "\n" text "${rows}")
  file(WRITE ${PROJECT_BINARY_DIR}/layers.txt "${text}\n")
endfunction()
