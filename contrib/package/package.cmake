# cpack -G DEB makes a package, cpack --config CPackSourceConfig.cmake an archive of the source: doc/packages.md.
set(CPACK_PACKAGE_VENDOR "The tread developers")
set(CPACK_PACKAGE_CONTACT "The tread developers" CACHE STRING "Who answers for the package: name <address>")
set(CPACK_PACKAGE_DESCRIPTION "tread simulates an elastic or elasto-plastic railway wheel that rolls over
a rail, in three dimensions and in the time domain, by explicit finite
elements with frictional contact. With scenes, documentation, a Python
package, and a library for steady rolling of two half-spaces with its C
interface.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE.md)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/compress_manual.cmake)
# Folders of the package may be read by all, whatever the umask of who makes it.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Commands are in Python and need numpy; those that draw need matplotlib. openmpi-bin has mpirun.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.9), python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-pandas, python3-h5py, paraview")
# Programs linked to libtread_half_space depend on this package; ldconfig runs by a trigger. Python's compiled files come and go with the package.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/shlibs "libtread_half_space 1 tread (>= ${PROJECT_VERSION})\n")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/shlibs ${CMAKE_CURRENT_BINARY_DIR}/triggers
  ${CMAKE_CURRENT_LIST_DIR}/postinst ${CMAKE_CURRENT_LIST_DIR}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# A build for this processor ends on others with an illegal instruction: its package says so in its name.
if(TREAD_NATIVE)
  execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  set(CPACK_DEBIAN_FILE_NAME tread_${PROJECT_VERSION}_${architecture}-this-processor-only.deb)
  string(APPEND CPACK_PACKAGE_DESCRIPTION "\n.\nBuilt for one type of processor; on others the program may not start.")
endif()

set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME tread-${PROJECT_VERSION})
# What .gitignore lists, and git's own.
set(CPACK_VERBATIM_VARIABLES ON)
string(REGEX REPLACE "([][+.*?^$()|])" "\\\\\\1" root "${PROJECT_SOURCE_DIR}")
set(CPACK_SOURCE_IGNORE_FILES "/\\.git/" "/\\.git$" "^${root}/build[^/]*/" "^${root}/results(-reference)?/" "/__pycache__/" "/\\.vscode/" "/\\.idea/"
  "/contrib/python/build/" "\\.egg-info/" "~$" "\\.swp$" "\\.orig$" "\\.rej$" "/compile_commands\\.json$")
include(CPack)
