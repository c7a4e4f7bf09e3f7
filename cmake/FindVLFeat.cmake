# Finds VLFeat and defines VLFeat::VLFeat.
find_path(VLFEAT_INCLUDE_DIR vl/covdet.h)
find_library(VLFEAT_LIBRARY vl)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(VLFeat REQUIRED_VARS VLFEAT_LIBRARY VLFEAT_INCLUDE_DIR)
if(VLFeat_FOUND AND NOT TARGET VLFeat::VLFeat)
  add_library(VLFeat::VLFeat UNKNOWN IMPORTED)
  set_target_properties(VLFeat::VLFeat PROPERTIES IMPORTED_LOCATION "${VLFEAT_LIBRARY}"
                        INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${VLFEAT_INCLUDE_DIR}")
endif()
mark_as_advanced(VLFEAT_INCLUDE_DIR VLFEAT_LIBRARY)
