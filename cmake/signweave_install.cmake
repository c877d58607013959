# cmake --install installs the program, the library, its headers and a package for find_package(signweave).
# The components `program` and `development` are the Debian packages (signweave_package.cmake).
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE)
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Libraries, below the prefix")  # under any prefix, not only under /usr
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY SIGNWEAVE_MODULES)
install(TARGETS ${modules} EXPORT signweave ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS signweave RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/signweave DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING
        PATTERN "*.h" PATTERN "*test*" EXCLUDE)
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
