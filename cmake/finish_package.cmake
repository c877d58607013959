# Run by CPack between installing and packing: adds the copyright and the changelogs that Debian requires to both
# packages, and the manual page, which help2man generates from the program's help.
set(source ${CPACK_SIGNWEAVE_SOURCE_DIR})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}:\n${text}")
  endif()
endfunction()

# Formats one field of a control file: lines after the first begin with a blank, and empty lines contain a dot.
function(as_field text result)
  string(STRIP "${text}" text)
  string(REPLACE "\n\n" "\n.\n" text "${text}")
  string(REPLACE "\n" "\n " text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

file(READ ${source}/NOTICE notice)
as_field("${notice}" notice)
string(REGEX MATCH "Copyright ([0-9]+[^\n]*)" holder "${notice}")
set(holder "${CMAKE_MATCH_1}")
execute_process(COMMAND git -C ${source} log -1 --format=%at OUTPUT_VARIABLE changed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH} AND changed)
  set(ENV{SOURCE_DATE_EPOCH} ${changed})  # packages of the same commit are identical
endif()
string(TIMESTAMP day "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

foreach(pair IN ITEMS program:signweave development:libsignweave-dev)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(documents ${root}/share/doc/${package})
  file(WRITE ${documents}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: signweave
Comment: ${notice}

Files: *
Copyright: ${holder}
License: Apache-2.0
 On Debian systems, the full text of the Apache License, Version 2.0, is in /usr/share/common-licenses/Apache-2.0.
")
  file(COPY_FILE ${source}/CHANGELOG.md ${documents}/changelog)
  file(WRITE ${documents}/changelog.Debian "signweave (${version}) unstable; urgency=medium

  * Built by scripts/package of the source; its changes are in changelog.gz.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${day}
")
  run(gzip -9nf ${documents}/changelog ${documents}/changelog.Debian)
  run(chmod 644 ${documents}/copyright ${documents}/changelog.gz ${documents}/changelog.Debian.gz)
endforeach()

set(manual ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/program/usr/share/man/man1)
file(MAKE_DIRECTORY ${manual})
run(help2man --no-info --section 1 --name "database of captured signing that makes new signing" --version-string ${CPACK_PACKAGE_VERSION}
    --output ${manual}/signweave.1 ${CPACK_SIGNWEAVE_PROGRAM})
run(gzip -9nf ${manual}/signweave.1)
run(chmod 644 ${manual}/signweave.1.gz)
