# Finds libexif and defines LibExif::LibExif.
find_path(LIBEXIF_INCLUDE_DIR libexif/exif-data.h)
find_library(LIBEXIF_LIBRARY exif)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LibExif REQUIRED_VARS LIBEXIF_LIBRARY LIBEXIF_INCLUDE_DIR)
if(LibExif_FOUND AND NOT TARGET LibExif::LibExif)
  add_library(LibExif::LibExif UNKNOWN IMPORTED)
  set_target_properties(LibExif::LibExif PROPERTIES IMPORTED_LOCATION "${LIBEXIF_LIBRARY}"
                        INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${LIBEXIF_INCLUDE_DIR}")
endif()
mark_as_advanced(LIBEXIF_INCLUDE_DIR LIBEXIF_LIBRARY)
