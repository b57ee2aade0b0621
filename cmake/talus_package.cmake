# `cpack` in a build folder makes a Debian package of the files that `cmake --install` installs. Its dependencies are those
# found by dpkg-shlibdeps and those opened or called at run time.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME talus)
set(CPACK_PACKAGE_CONTACT "The Talus authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION "Talus tilts a bed of thousands of rigid disks to its angle of repose by Contact Dynamics, and
analyses and draws how failure grows inside it.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6 | libegl1")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, libgl1, libgl1-mesa-dri, python3-h5py, python3-matplotlib, python3-numpy, python3-xxhash")
include(CPack)
