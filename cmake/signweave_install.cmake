# cmake --install installs the program, the library, its headers and a package for find_package(signweave).
# The components `program` and `development` are the Debian packages (signweave_package.cmake).
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE)
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Libraries, below the prefix")  # under any prefix, not only under /usr
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY SIGNWEAVE_MODULES)
add_library(signweave_library INTERFACE)
set_target_properties(signweave_library PROPERTIES EXPORT_NAME signweave)
target_link_libraries(signweave_library INTERFACE signweave::choose signweave::formats signweave::live signweave::retarget)
add_library(signweave::signweave ALIAS signweave_library)
install(TARGETS ${modules} signweave_library EXPORT signweave ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS signweave RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# The headers of the library's door, signweave/signweave.h, and those that they include; none that says it is for the inside.
set(to_read signweave/signweave.h)
set(public_headers "")
while(to_read)
  list(POP_FRONT to_read header)
  if(header IN_LIST public_headers)
    continue()
  endif()
  list(APPEND public_headers ${header})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/${header} inside REGEX "^/// Inside (this module|the library)")
  if(inside)
    message(FATAL_ERROR "${header} says that it is for the inside, and signweave/signweave.h includes it")
  endif()
  file(STRINGS ${PROJECT_SOURCE_DIR}/${header} includes REGEX "^#include \"signweave/")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
    list(APPEND to_read ${included})
  endforeach()
endwhile()
list(JOIN public_headers "\n" lines)
file(WRITE ${PROJECT_BINARY_DIR}/public_headers.txt "${lines}\n")  # for scripts/alone
foreach(header IN LISTS public_headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT development)
endforeach()
install(EXPORT signweave NAMESPACE signweave:: FILE signweave-targets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/signweave-config.cmake.in
                              ${PROJECT_BINARY_DIR}/signweave-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/signweave-config-version.cmake COMPATIBILITY SameMinorVersion)
if(SIGNWEAVE_BERKELEY)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/FindBerkeleyDB.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave
          COMPONENT development)
endif()
install(FILES ${PROJECT_BINARY_DIR}/signweave-config.cmake ${PROJECT_BINARY_DIR}/signweave-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
