# One set of flags for every target: the baseline of x86-64 or aarch64, no fast-math and no implicit fused multiply-add,
# so that two builds of the same source give the same bits.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(signweave_flags INTERFACE)
target_compile_options(signweave_flags INTERFACE -pthread -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wold-style-cast
                       -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual)
# Warnings are errors only with Debian 12's compilers, whose warnings were reviewed.
if((CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.") OR
   (CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION MATCHES "^14\\."))
  target_compile_options(signweave_flags INTERFACE -Werror)
endif()
# -ffp-contract=off does not affect Eigen, which uses such instructions explicitly if the machine has them.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  target_include_directories(signweave_flags SYSTEM INTERFACE ${PROJECT_SOURCE_DIR}/cmake/unfused)
endif()
# Used if installed: ccache, and a linker that takes a tenth of the time (a cross compiler accepts only its own).
find_program(ccache_PROGRAM ccache)
if(ccache_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${ccache_PROGRAM})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  # Otherwise ccache treats a precompiled header that was rebuilt with the same content as a different one.
  add_compile_options("$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
find_program(fast_linker_PROGRAM NAMES mold ld.lld)
if(fast_linker_PROGRAM AND NOT CMAKE_CROSSCOMPILING)
  get_filename_component(fast_linker ${fast_linker_PROGRAM} NAME)
  string(REPLACE "ld.lld" "lld" fast_linker ${fast_linker})
  add_link_options(-fuse-ld=${fast_linker})
endif()
# GCC runs its garbage collector whenever its memory has doubled, which takes a seventh of the time of a large batch.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(--param ggc-min-heapsize=1048576)
endif()
if(SIGNWEAVE_SANITIZE)
  add_compile_definitions(SIGNWEAVE_SANITIZED)  # for tests of limits that leave no room for a sanitizer
  add_compile_options(-fsanitize=${SIGNWEAVE_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SIGNWEAVE_SANITIZE})
  # Instrumented code confuses GCC's flow analysis; the release build has the warning.
  target_compile_options(signweave_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  # ThreadSanitizer does not support the fences of Asio; they are used together with locks that it supports.
  if(SIGNWEAVE_SANITIZE MATCHES thread)
    target_compile_options(signweave_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
  endif()
  if(SIGNWEAVE_SANITIZE MATCHES "undefined")
    # These checks took up to a quarter of the compile time and find nothing that AddressSanitizer misses when the address
    # is used.
    add_compile_options(-fno-sanitize-recover=undefined -fno-sanitize=null,object-size,pointer-overflow)
  endif()
endif()

if(SIGNWEAVE_FUZZ)
  # The coverage that libFuzzer uses. Tracing every comparison too would double the time of this build's tests.
  add_compile_options(-fsanitize-coverage=inline-8bit-counters,pc-table)
endif()

# Code that need not be fast is not optimised, since optimisation took half of the compile time: the command line and
# tests and, in a build with sanitizers, everything around the library. Parameters, JSON and HTTP are optimised a little.
add_library(signweave_cold_flags INTERFACE)
target_link_libraries(signweave_cold_flags INTERFACE signweave_flags)
target_compile_options(signweave_cold_flags INTERFACE -O0)
add_library(signweave_app_flags INTERFACE)
target_link_libraries(signweave_app_flags INTERFACE signweave_flags)
if(SIGNWEAVE_SANITIZE)
  target_compile_options(signweave_app_flags INTERFACE -O0)
else()
  target_compile_options(signweave_app_flags INTERFACE $<$<CONFIG:Release>:-O1>)
endif()
add_library(signweave_test_flags INTERFACE)
target_link_libraries(signweave_test_flags INTERFACE signweave_cold_flags GTest::gmock GTest::gtest_main rapidcheck
                      rapidcheck_gtest)
# At low optimisation GCC 12 mistakes some short std::string copies for out-of-bounds writes (its bug 105329 and others).
target_compile_options(signweave_test_flags INTERFACE
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-restrict>)
# Only the code under test is checked for undefined behaviour: in the tests the checks double the compile time.
if(SIGNWEAVE_SANITIZE MATCHES "undefined")
  target_compile_options(signweave_test_flags INTERFACE -fno-sanitize=undefined)
endif()
target_compile_definitions(signweave_test_flags INTERFACE SIGNWEAVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                           SIGNWEAVE_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
