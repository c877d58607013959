# One set of flags for every target: the baseline of x86-64 or aarch64, no fast-math, no fused multiply-add behind our back, so that
# two builds of one source give the same bits.
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
# Warnings are errors with Debian 12's compilers, which is where they were looked at.
if((CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.") OR
   (CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION MATCHES "^14\\."))
  target_compile_options(signweave_flags INTERFACE -Werror)
endif()
# -ffp-contract=off does not bind Eigen, which asks for such instructions by name where the machine has them.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  target_include_directories(signweave_flags SYSTEM INTERFACE ${PROJECT_SOURCE_DIR}/cmake/unfused)
endif()
# Used where they are there: what was compiled before, and a linker that takes a tenth of the time (a cross compiler
# takes one of its own only).
find_program(ccache_PROGRAM ccache)
if(ccache_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${ccache_PROGRAM})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  # Else a precompiled header that was made again, with the same bytes in it, is another to ccache.
  add_compile_options("$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
find_program(fast_linker_PROGRAM NAMES mold ld.lld)
if(fast_linker_PROGRAM AND NOT CMAKE_CROSSCOMPILING)
  get_filename_component(fast_linker ${fast_linker_PROGRAM} NAME)
  string(REPLACE "ld.lld" "lld" fast_linker ${fast_linker})
  add_link_options(-fuse-ld=${fast_linker})
endif()
# GCC collects its own garbage whenever its memory has doubled: that is a seventh of the time of a large batch.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(--param ggc-min-heapsize=1048576)
endif()
if(SIGNWEAVE_SANITIZE)
  add_compile_definitions(SIGNWEAVE_SANITIZED)  # for tests of limits that a sanitizer has no room in
  add_compile_options(-fsanitize=${SIGNWEAVE_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SIGNWEAVE_SANITIZE})
  # Instrumented code confuses GCC's flow analysis; the release build has the warning.
  target_compile_options(signweave_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  # ThreadSanitizer does not know the fences of Asio, which stand beside locks that it knows.
  if(SIGNWEAVE_SANITIZE MATCHES thread)
    target_compile_options(signweave_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
  endif()
  if(SIGNWEAVE_SANITIZE MATCHES "undefined")
    # Three checks took up to a quarter of the time of compiling and see nothing that AddressSanitizer does not see when the address is used.
    add_compile_options(-fno-sanitize-recover=undefined -fno-sanitize=null,object-size,pointer-overflow)
  endif()
endif()

if(SIGNWEAVE_FUZZ)
  # What libFuzzer goes by. Tracing every comparison too would make the tests of this build take twice as long.
  add_compile_options(-fsanitize-coverage=inline-8bit-counters,pc-table)
endif()

# What need not be fast is not optimised, which half of the time of compiling went into: the command line and tests; and, in a build with
# sanitizers, all that stands around the library. Parameters, JSON and HTTP are optimised a little.
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
# GCC 12 takes some short std::string copies at low optimisation for writes out of bounds (its bug 105329 and others).
target_compile_options(signweave_test_flags INTERFACE
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-restrict>)
# Undefined behaviour is looked for in what is tested: in the tests it doubles the time of compiling.
if(SIGNWEAVE_SANITIZE MATCHES "undefined")
  target_compile_options(signweave_test_flags INTERFACE -fno-sanitize=undefined)
endif()
target_compile_definitions(signweave_test_flags INTERFACE SIGNWEAVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                           SIGNWEAVE_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
