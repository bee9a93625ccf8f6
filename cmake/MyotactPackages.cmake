# Debian packages by "cpack", called by tools/package.sh: myotact, Apache-2.0, with the data; and myotact-prepare, which is
# AGPL-3.0-or-later because it links TetGen and CGAL.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Myotact authors <${MYOTACT_CONTACT}>")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_COMPONENTS_ALL myotact)
if(MYOTACT_BUILD_PREPARE)
  list(APPEND CPACK_COMPONENTS_ALL myotact-prepare)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_MYOTACT_PACKAGE_NAME myotact)
# libegl1 and libgl1 are loaded while the program runs, which shlibdeps does not see; without them libepoxy aborts.
set(CPACK_DEBIAN_MYOTACT_PACKAGE_DEPENDS "fonts-dejavu-core, fonts-fork-awesome, fonts-inter, libegl1, libgl1")
set(CPACK_DEBIAN_MYOTACT_PACKAGE_RECOMMENDS libgl1-mesa-dri)
set(CPACK_DEBIAN_MYOTACT_PACKAGE_SUGGESTS "ffmpeg, myotact-prepare")
set(CPACK_DEBIAN_MYOTACT_DESCRIPTION "feel the muscles of a dog's limb
Simulates the muscles of a dog's elbow, stifle and hock with implicit finite
elements, to be found, touched and pulled with a force-feedback device or with
the mouse, and shows how co-contraction stiffens a joint. With lessons.
.
Not a medical device.")

set(CPACK_DEBIAN_MYOTACT-PREPARE_PACKAGE_NAME myotact-prepare)
set(CPACK_DEBIAN_MYOTACT-PREPARE_PACKAGE_DEPENDS "myotact (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_MYOTACT-PREPARE_DESCRIPTION "turn surfaces of a limb into a specimen for Myotact
Takes surfaces of bones and muscles from scans, repairs them, parts what
overlaps and makes the tetrahedra, fibres and muscle lines that Myotact
simulates. It links TetGen and CGAL and is under the GNU Affero General Public
License.")
include(CPack)
