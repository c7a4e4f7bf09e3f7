# Whether and for which Python the package of python/ is made: the one that Debian's pybind11,
# numpy and dist-packages belong to, not one that a shell's PATH happens to begin with.
# ONEAC_PYTHON: AUTO (where everything is found), ON (it must be) or OFF.
set(ONEAC_PYTHON AUTO CACHE STRING "Build the Python package: AUTO, ON or OFF")
set_property(CACHE ONEAC_PYTHON PROPERTY STRINGS AUTO ON OFF)

# oneac_find_python(VARIABLE): whether to build it; says why not.
macro(oneac_find_python variable)
  set(${variable} OFF)
  if(ONEAC_PYTHON AND ONEAC_SANITIZE)
    message(STATUS "The Python package is not built: no interpreter carries the sanitizers")
  elseif(ONEAC_PYTHON)
    oneac_find_python_parts()
    if(Python_FOUND AND pybind11_FOUND AND NOT oneac_no_numpy)
      set(${variable} ON)
    elseif(ONEAC_PYTHON STREQUAL "AUTO")
      message(STATUS "Python's headers, numpy or pybind11 not found (python3-dev, python3-numpy, "
                     "pybind11-dev): the Python package is not built")
    else()
      message(FATAL_ERROR "ONEAC_PYTHON needs python3-dev, python3-numpy and pybind11-dev")
    endif()
  endif()
endmacro()

macro(oneac_find_python_parts)
  if(NOT DEFINED Python_EXECUTABLE AND NOT DEFINED Python_ROOT_DIR AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  set(PYBIND11_FINDPYTHON ON)
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    find_package(pybind11 2.10 QUIET CONFIG)
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import numpy"
                    RESULT_VARIABLE oneac_no_numpy ERROR_QUIET)
  endif()
endmacro()

# oneac_install_python(PACKAGE FILE...): the extension and these files of the built package, where
# the system's Python looks: dist-packages of Debian below /usr, of this Python elsewhere.
function(oneac_install_python package)
  set(own python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
  install(CODE "if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
  set(ONEAC_PYTHON_FOLDER lib/python3/dist-packages/oneac)
else()
  set(ONEAC_PYTHON_FOLDER lib/${own}/dist-packages/oneac)
endif()")
  install(TARGETS oneac_python LIBRARY DESTINATION "\${ONEAC_PYTHON_FOLDER}")
  list(TRANSFORM ARGN PREPEND "${package}/")
  install(FILES ${ARGN} DESTINATION "\${ONEAC_PYTHON_FOLDER}")
endfunction()
