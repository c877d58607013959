# signweave_module(NAME DEPENDS core … [LIBRARIES Eigen3::Eigen …] [WITHOUT a.cpp …] [GENERATED b.cpp …])
#
# Defines one module of the library from the .cpp files of the folder it is called in and of the folders below; its tests
# are the *_test.cpp, and test_*.cpp are shared by tests. DEPENDS names the modules whose headers it may include; the test
# `layers` enforces this. LIBRARIES are third-party targets. WITHOUT names files that this build does not compile, GENERATED
# files that it writes. TEST_SOURCES are compiled into the test program along with the tests.
define_property(GLOBAL PROPERTY SIGNWEAVE_LAYERS BRIEF_DOCS "rows 'module:dependency,dependency'")
define_property(GLOBAL PROPERTY SIGNWEAVE_MODULES BRIEF_DOCS "library targets, lowest first")

# Headers that nearly every file includes, precompiled (docs/building.md says what this saves). Each file still lists its
# own includes, and `scripts/alone` compiles each without any of this: precompiled headers and batches only save time.
set(read_by_all <Eigen/Geometry> <algorithm> <array> <charconv> <cmath> <filesystem> <functional> <map> <memory> <mutex> <optional> <set>
                <span> <string> <string_view> <unordered_map> <variant> <vector> <fmt/format.h>)
file(WRITE ${PROJECT_BINARY_DIR}/pch.cpp "")
function(signweave_precompiled name)
  cmake_parse_arguments(arg "" "" "LIBRARIES;HEADERS" ${ARGN})
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/pch.cpp)
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} fmt::fmt)
  target_include_directories(${name} SYSTEM PRIVATE ${EIGEN3_INCLUDE_DIRS})
  target_precompile_headers(${name} PRIVATE ${read_by_all} ${arg_HEADERS})
endfunction()
signweave_precompiled(signweave_pch LIBRARIES signweave_flags)
signweave_precompiled(signweave_app_pch LIBRARIES signweave_app_flags nlohmann_json::nlohmann_json HEADERS <nlohmann/json.hpp>)
if(SIGNWEAVE_TESTS)
  signweave_precompiled(signweave_test_pch LIBRARIES signweave_test_flags HEADERS <gmock/gmock.h> <gtest/gtest.h> <rapidcheck/gtest.h>)
endif()

# signweave_batches(TARGET [PER_BATCH]): compiles the target's files in batches, so that common headers and template
# instances are compiled once per batch. Files of one target must therefore not share private names.
# SIGNWEAVE_BATCHES=OFF compiles each separately, which is quicker if one file is changed repeatedly.
function(signweave_batches target)
  set(size 40)
  if(ARGC GREATER 1)
    set(size ${ARGV1})
  endif()
  if(SIGNWEAVE_BATCHES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
    # GCC warns if a type in a file's unnamed namespace has a member of another such type, because the batch has a
    # different name than the file; this is harmless.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# signweave_sources(VARIABLE [WITHOUT a.cpp …]): the .cpp files of the folder it is called in and of the folders below but
# those of tests (*_test.cpp, test_*.cpp) and those named.
function(signweave_sources variable)
  cmake_parse_arguments(arg "" "" "WITHOUT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|(^|/)test_[^/]*\\.cpp$")
  if(arg_WITHOUT)
    list(REMOVE_ITEM sources ${arg_WITHOUT})
  endif()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

function(signweave_module name)
  cmake_parse_arguments(arg "" "" "DEPENDS;LIBRARIES;TEST_SOURCES;WITHOUT;GENERATED" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "signweave_module(${name}): unknown words ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(target signweave_${name})
  list(TRANSFORM arg_DEPENDS PREPEND signweave:: OUTPUT_VARIABLE depends)
  signweave_sources(sources WITHOUT ${arg_WITHOUT})
  add_library(${target} STATIC ${sources} ${arg_GENERATED})
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:signweave_flags>)
  target_precompile_headers(${target} REUSE_FROM signweave_pch)
  signweave_batches(${target})
  add_library(signweave::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} PUBLIC ${depends} ${arg_LIBRARIES})
  string(REPLACE ";" "," row "${arg_DEPENDS}")
  set_property(GLOBAL APPEND PROPERTY SIGNWEAVE_LAYERS "${name}:${row}")
  set_property(GLOBAL APPEND PROPERTY SIGNWEAVE_MODULES ${target})
  signweave_tests(${name} LIBRARIES signweave::${name} SOURCES ${arg_TEST_SOURCES})
endfunction()

# signweave_tests(NAME [LABEL full] LIBRARIES …): one test program from every *_test.cpp of the folder it is called in and
# of the folders below. Its tests are in the tier `quick` unless LABEL says otherwise (CONTRIBUTING.md). UNRUN: they are
# compiled but not run.
define_property(GLOBAL PROPERTY SIGNWEAVE_TEST_FILES BRIEF_DOCS "every *_test.cpp of a test program, whether this build compiles it or not")
function(signweave_tests name)
  cmake_parse_arguments(arg "UNRUN" "LABEL" "LIBRARIES;SOURCES" ${ARGN})
  if(NOT SIGNWEAVE_TESTS)
    return()
  endif()
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  list(FILTER tests EXCLUDE REGEX "_wrong/")  # deliberately wrong files for testing the checks
  # A folder below with its own CMakeLists.txt defines its own test program.
  file(GLOB_RECURSE below CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*/CMakeLists.txt)
  foreach(list IN LISTS below)
    get_filename_component(folder ${list} DIRECTORY)
    list(FILTER tests EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${folder}/")
  endforeach()
  if(NOT tests)
    return()
  endif()
  foreach(test IN LISTS tests)
    file(RELATIVE_PATH short ${PROJECT_SOURCE_DIR} ${test})
    set_property(GLOBAL APPEND PROPERTY SIGNWEAVE_TEST_FILES ${short})
  endforeach()
  if(SIGNWEAVE_TESTED AND NOT name IN_LIST SIGNWEAVE_TESTED)
    return()
  endif()
  if(SIGNWEAVE_TESTS_NAMED)  # in builds that run only those tests, each other file would be compiled for nothing
    set(named "")
    foreach(test IN LISTS tests)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${test})
      file(STRINGS ${test} found LIMIT_COUNT 1 REGEX "^ *(TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP|INSTANTIATE_TEST_SUITE_P)\\(.*(${SIGNWEAVE_TESTS_NAMED})")
      if(found)
        list(APPEND named ${test})
      endif()
    endforeach()
    set(tests ${named})
    if(NOT tests)
      return()
    endif()
  endif()
  if(NOT arg_LABEL)
    set(arg_LABEL quick)
  endif()
  add_executable(${name}_test ${tests} ${arg_SOURCES})
  target_link_libraries(${name}_test PRIVATE ${arg_LIBRARIES} signweave_test_flags)
  target_precompile_headers(${name}_test REUSE_FROM signweave_test_pch)
  signweave_batches(${name}_test 10)
  add_dependencies(tests_${arg_LABEL} ${name}_test)
  if(arg_UNRUN)
    return()
  endif()
  if(SIGNWEAVE_SANITIZE)
    # Instrumented programs are slow to start, so each runs as two halves instead of one test at a time.
    foreach(half IN ITEMS 0 1)
      add_test(NAME ${name}_test.${half} COMMAND ${name}_test)
      set_tests_properties(${name}_test.${half} PROPERTIES TIMEOUT 1800 LABELS ${arg_LABEL}
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=${half};GTEST_BRIEF=1")
    endforeach()
  else()
    gtest_discover_tests(${name}_test DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS ${arg_LABEL})
  endif()
endfunction()

# signweave_app(FOLDER [DEPENDS calls …]): names the folders of app/ whose headers FOLDER may include; the test `layers` checks it.
define_property(GLOBAL PROPERTY SIGNWEAVE_APP_LAYERS BRIEF_DOCS "rows 'folder:dependency,dependency' of app/")
function(signweave_app folder)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  string(REPLACE ";" "," row "${arg_DEPENDS}")
  set_property(GLOBAL APPEND PROPERTY SIGNWEAVE_APP_LAYERS "${folder}:${row}")
endfunction()

# Writes the input of the structure tests: the table of modules, and the test files that belong to a program.
function(signweave_write_structure)
  get_property(rows GLOBAL PROPERTY SIGNWEAVE_LAYERS)
  string(REPLACE ";" "\n" text "${rows}")
  file(WRITE ${PROJECT_BINARY_DIR}/layers.txt "${text}\n")
  get_property(rows GLOBAL PROPERTY SIGNWEAVE_APP_LAYERS)
  string(REPLACE ";" "\n" text "${rows}")
  file(WRITE ${PROJECT_BINARY_DIR}/app_layers.txt "${text}\n")
  get_property(files GLOBAL PROPERTY SIGNWEAVE_TEST_FILES)
  string(REPLACE ";" "\n" text "${files}")
  file(WRITE ${PROJECT_BINARY_DIR}/tested.txt "${text}\n")
endfunction()
