# oneac_plugin(TARGET): lets a MODULE library see oneac's headers; its functions come from the
# program that loads it (--plugin), never from a second copy inside the library. Every file that
# includes relative_pose_initialiser.h carries a stamp of version and ABI, which the program compares
# before it loads the library.
set_property(GLOBAL PROPERTY ONEAC_PLUGIN_VERSION "${oneac_VERSION}")  # where this file is included
function(oneac_plugin target)
  get_property(release GLOBAL PROPERTY ONEAC_PLUGIN_VERSION)
  foreach(module initialisers robust solvers geometry base mrpt_compat)
    target_include_directories(${target} PRIVATE
      $<TARGET_PROPERTY:oneac::${module},INTERFACE_INCLUDE_DIRECTORIES>)
  endforeach()
  # Among those directories are MRPT's, which stay a third party's: no warnings from them.
  target_include_directories(${target} SYSTEM PRIVATE
    $<TARGET_PROPERTY:mrpt::obs,INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_link_libraries(${target} PRIVATE Eigen3::Eigen mrpt::containers mrpt::system)
  target_compile_definitions(${target} PRIVATE ONEAC_PLUGIN_VERSION="${release}")
  set_target_properties(${target} PROPERTIES PREFIX "")
endfunction()
