# What `cmake --install` puts where. Modules register themselves in oneac_module(); the rest is here.
# Nothing absolute is written: the tree may be moved as a whole.
include(CMakePackageConfigHelpers)

# Before the first rule: an install that would stop half-way, because only the program was built (as
# apps/demo.sh does), writes nothing and says what to build.
function(oneac_refuse_half_an_install)
  install(CODE "include(\"${PROJECT_BINARY_DIR}/oneac_install_needs.cmake\")
foreach(file IN LISTS oneac_install_needs)
  if(NOT EXISTS \"\${file}\")
    message(FATAL_ERROR \"not everything is built (\${file} is missing): run
  cmake --build ${PROJECT_BINARY_DIR}
and install again. Nothing was installed.\")
  endif()
endforeach()")
endfunction()

# Behind the last module: the files of all targets that are installed.
function(oneac_list_what_install_needs)
  oneac_collected(modules ONEAC_MODULES)
  set(files $<TARGET_FILE:oneac>)
  foreach(module IN LISTS modules)
    get_target_property(kind oneac_${module} TYPE)
    if(NOT kind STREQUAL INTERFACE_LIBRARY)
      list(APPEND files $<TARGET_FILE:oneac_${module}>)
    endif()
  endforeach()
  if(TARGET oneac_rivals)
    list(APPEND files $<TARGET_FILE:oneac_rivals>)
  endif()
  if(TARGET oneac_rosbag)
    list(APPEND files $<TARGET_FILE:oneac_rosbag>)
  endif()
  if(TARGET oneac_python)
    list(APPEND files $<TARGET_FILE:oneac_python>)
  endif()
  if(TARGET oneac_manual)
    list(APPEND files "${PROJECT_BINARY_DIR}/man/oneac.1")
  endif()
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/oneac_install_needs.cmake"
       CONTENT "set(oneac_install_needs \"${files}\")\n")
endfunction()

# oneac_install_module(NAME LINKED...): the library, its headers, and what its users must find.
function(oneac_install_module name)
  set_target_properties(oneac_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS oneac_${name} EXPORT oneacTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  # What only the modules' own sources include needs OpenCV's headers: it stays at home.
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h"
          PATTERN mrpt_compat/observations.h EXCLUDE)
  set_property(GLOBAL APPEND PROPERTY ONEAC_MODULES ${name})
  foreach(library IN LISTS ARGN)
    if(library MATCHES "^opencv_(.+)$")
      set_property(GLOBAL APPEND PROPERTY ONEAC_OPENCV_COMPONENTS ${CMAKE_MATCH_1})
    elseif(library MATCHES "^mrpt::(.+)$")
      set_property(GLOBAL APPEND PROPERTY ONEAC_MRPT_PACKAGES mrpt-${CMAKE_MATCH_1})
    endif()
  endforeach()
endfunction()

# oneac_collected(VARIABLE PROPERTY): a global list, each entry once.
function(oneac_collected variable property)
  get_property(values GLOBAL PROPERTY ${property})
  list(REMOVE_DUPLICATES values)
  set(${variable} "${values}" PARENT_SCOPE)
endfunction()

# find_package(oneac): targets, configuration, version, and the find modules of what has none.
function(oneac_install_config)
  set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/oneac)
  oneac_collected(ONEAC_MODULES ONEAC_MODULES)
  oneac_collected(ONEAC_OPENCV_COMPONENTS ONEAC_OPENCV_COMPONENTS)
  oneac_collected(ONEAC_MRPT_PACKAGES ONEAC_MRPT_PACKAGES)
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/oneacConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/oneacConfig.cmake" INSTALL_DESTINATION ${folder}
    PATH_VARS CMAKE_INSTALL_DATADIR)
  # Before 1.0 a minor release may change the interface.
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/oneacConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
  install(EXPORT oneacTargets NAMESPACE oneac:: DESTINATION ${folder})
  install(FILES "${PROJECT_BINARY_DIR}/oneacConfig.cmake"
                "${PROJECT_BINARY_DIR}/oneacConfigVersion.cmake"
                "${PROJECT_SOURCE_DIR}/cmake/FindVLFeat.cmake"
                "${PROJECT_SOURCE_DIR}/cmake/FindLibAv.cmake"
                "${PROJECT_SOURCE_DIR}/cmake/FindLibExif.cmake"
                "${PROJECT_SOURCE_DIR}/cmake/FindZstd.cmake"
                "${PROJECT_SOURCE_DIR}/cmake/OneacPlugin.cmake" DESTINATION ${folder})
endfunction()

# The program, its plugins where it looks for them, its manual, and the files that users read.
function(oneac_install_program)
  install(TARGETS oneac RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(TARGET oneac_rivals)
    install(TARGETS oneac_rivals LIBRARY DESTINATION lib/oneac)
  endif()
  if(TARGET oneac_rosbag)
    install(TARGETS oneac_rosbag RUNTIME DESTINATION lib/oneac)
  endif()
  set(shared ${CMAKE_INSTALL_DATADIR}/oneac)
  install(DIRECTORY params DESTINATION ${shared} FILES_MATCHING PATTERN "*.yaml")
  install(FILES datasets/README.md datasets/manifest.txt datasets/malaga-07.sha256
          DESTINATION ${shared}/datasets)
  install(PROGRAMS datasets/fetch.sh DESTINATION ${shared}/datasets)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/oneac RENAME copyright)
  install(FILES apps/completion.bash RENAME oneac
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endfunction()

# Manual pages say what the program's own --help says; made by running it, so not when cross
# compiling, and not under sanitizers, which watch the libraries it loads.
function(oneac_install_manual)
  if(CMAKE_CROSSCOMPILING OR ONEAC_SANITIZE)
    return()
  endif()
  set(pages "${PROJECT_BINARY_DIR}/man")
  set(maker "${PROJECT_SOURCE_DIR}/apps/manual.sh")
  add_custom_command(OUTPUT "${pages}/oneac.1"
    COMMAND bash "${maker}" $<TARGET_FILE:oneac> "${pages}" DEPENDS oneac "${maker}" VERBATIM)
  add_custom_target(oneac_manual ALL DEPENDS "${pages}/oneac.1")
  install(DIRECTORY "${pages}/" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
          FILES_MATCHING PATTERN "*.1")
endfunction()
