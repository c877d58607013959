# Debian packages, built by `scripts/package`: signweave, the program, and libsignweave-dev, the library.
set(SIGNWEAVE_MAINTAINER "the signweave authors <maintainers@signweave.invalid>" CACHE STRING "Maintainer of the Debian packages, NAME <ADDRESS>")
set(SIGNWEAVE_DEBIAN_REVISION 1 CACHE STRING "Revision of the Debian packages of one version")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME signweave)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${SIGNWEAVE_DEBIAN_REVISION})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${SIGNWEAVE_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME signweave)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS chromium)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "database of captured signing that makes new signing
signweave stores recordings of sign language twice, as motion (BVH, glTF, FBX,
ASF/AMC) and as annotation (ELAN, ANVIL). It finds signs by label, phase, time
and movement, and makes new signing from them: every stroke stays as it was
captured, and the transitions between strokes are computed. Results are motion
files, or live frames over HTTP and WebSocket.
.
This package holds no sign language and no recordings, and it does not
translate: it signs what you recorded, from the glosses that you give it.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsignweave-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The packages that signweave-config.cmake searches for and that the headers include.
set(development_needs libeigen3-dev libfmt-dev liblmdb-dev libmeshoptimizer-dev libpugixml-dev libre2-dev libtinygltf-dev
                      libutf8proc-dev libxml2-dev libxxhash-dev pkgconf zlib1g-dev)
if(SIGNWEAVE_BERKELEY)
  list(APPEND development_needs libdb5.3-dev)
endif()
if(SIGNWEAVE_TOKYO)
  list(APPEND development_needs libtokyocabinet-dev)
endif()
list(JOIN development_needs ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "database of captured signing - C++ library
signweave stores recordings of sign language as motion and as annotation,
finds signs in them, and makes new signing. This package holds its static
libraries and headers, and the CMake package for find_package(signweave).
.
It holds no sign language and no recordings.")

# Adds the files that only a package needs; see the script.
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/finish_package.cmake)
set(CPACK_SIGNWEAVE_SOURCE_DIR ${PROJECT_SOURCE_DIR})
set(CPACK_SIGNWEAVE_PROGRAM ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/signweave)
include(CPack)
