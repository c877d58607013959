# cmake --install puts the library, its headers and a package for find_package(signweave) in place, and the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY SIGNWEAVE_MODULES)
install(TARGETS ${modules} EXPORT signweave ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS signweave RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/signweave DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h"
        PATTERN "*test*" EXCLUDE)
install(EXPORT signweave NAMESPACE signweave:: FILE signweave-targets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/signweave-config.cmake.in
                              ${PROJECT_BINARY_DIR}/signweave-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/signweave-config-version.cmake COMPATIBILITY SameMinorVersion)
if(SIGNWEAVE_BERKELEY)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/FindBerkeleyDB.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave)
endif()
install(FILES ${PROJECT_BINARY_DIR}/signweave-config.cmake ${PROJECT_BINARY_DIR}/signweave-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/signweave)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
