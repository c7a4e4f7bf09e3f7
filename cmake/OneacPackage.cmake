# `cpack` makes the Debian package; bash apps/package.sh does all of it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME oneac)
set(CPACK_PACKAGE_VENDOR "the oneac authors")
set(CPACK_PACKAGE_CONTACT "the oneac authors <oneac@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "vehicle egomotion from one camera, out of MRPT rawlogs")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"The program reads the rawlog of a vehicle-mounted camera and writes a metric
trajectory, each hypothesis from a single affine correspondence. The library
is the same as a front-end for programs of one's own: find_package(oneac).")
# The shared libraries in use, with the versions they were built with.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Needed by find_package(oneac), not by the program.
string(JOIN ", " CPACK_DEBIAN_PACKAGE_SUGGESTS
  g++ cmake libeigen3-dev libopencv-dev libceres-dev libvlfeat-dev libmrpt-obs-dev
  libmrpt-topography-dev libyaml-cpp-dev libexpat1-dev libexif-dev
  libavformat-dev libavcodec-dev libswscale-dev libavutil-dev zlib1g-dev libzstd-dev)
# Needed by `import oneac`, not by the program; of the one Python that the extension was built for.
if(TARGET oneac_python)
  math(EXPR oneac_next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_PROVIDES "python3-oneac (= ${PROJECT_VERSION})")
  string(JOIN ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "python3 (>= 3.${Python_VERSION_MINOR})" "python3 (<< 3.${oneac_next_python})" python3-numpy)
endif()
include(CPack)
