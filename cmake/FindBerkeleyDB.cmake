# Berkeley DB 5.3, which has neither a pkg-config file nor a CMake package: BerkeleyDB::berkeley.
find_path(BerkeleyDB_INCLUDE_DIR db.h)
find_library(BerkeleyDB_LIBRARY NAMES db-5.3 db)
if(BerkeleyDB_INCLUDE_DIR)
  file(STRINGS ${BerkeleyDB_INCLUDE_DIR}/db.h lines REGEX "^#define[ \t]+DB_VERSION_(MAJOR|MINOR)[ \t]")
  string(REGEX REPLACE ".*MAJOR[ \t]+([0-9]+).*MINOR[ \t]+([0-9]+).*" "\\1.\\2" BerkeleyDB_VERSION "${lines}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BerkeleyDB REQUIRED_VARS BerkeleyDB_LIBRARY BerkeleyDB_INCLUDE_DIR
                                  VERSION_VAR BerkeleyDB_VERSION)
if(BerkeleyDB_FOUND AND NOT TARGET BerkeleyDB::berkeley)
  add_library(BerkeleyDB::berkeley UNKNOWN IMPORTED)
  set_target_properties(BerkeleyDB::berkeley PROPERTIES IMPORTED_LOCATION ${BerkeleyDB_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${BerkeleyDB_INCLUDE_DIR})
endif()
mark_as_advanced(BerkeleyDB_INCLUDE_DIR BerkeleyDB_LIBRARY)
