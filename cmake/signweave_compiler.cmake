# One set of flags for every target: the x86-64 baseline, no fast-math, no fused multiply-add behind our back, so that
# two builds of one source give the same bits.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(signweave_flags INTERFACE)
target_compile_options(signweave_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wold-style-cast
                       -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
if(SIGNWEAVE_SANITIZE)
  add_compile_options(-fsanitize=${SIGNWEAVE_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SIGNWEAVE_SANITIZE})
  if(SIGNWEAVE_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()
