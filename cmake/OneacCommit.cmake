# oneac_commit(VARIABLE FOLDER): the commit that FOLDER is a checkout of, as git describes it
# ("v0.1.0-3-gabc123456", "abc123456-dirty"), or "unknown" outside a checkout of its own: a tarball
# unpacked within somebody else's checkout is not that commit. A build after a commit or a checkout
# asks again.
function(oneac_commit variable folder)
  set(commit unknown)
  find_program(ONEAC_GIT git)
  mark_as_advanced(ONEAC_GIT)
  if(ONEAC_GIT AND EXISTS "${folder}/.git")
    execute_process(
      COMMAND "${ONEAC_GIT}" describe --always --dirty --tags "--match=v[0-9]*" --abbrev=9
      WORKING_DIRECTORY "${folder}"
      OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(described)
      set(commit "${described}")
    endif()
    execute_process(
      COMMAND "${ONEAC_GIT}" rev-parse --git-path logs/HEAD
      WORKING_DIRECTORY "${folder}" OUTPUT_VARIABLE moves OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    get_filename_component(moves "${moves}" ABSOLUTE BASE_DIR "${folder}")
    if(EXISTS "${moves}" AND NOT CMAKE_SCRIPT_MODE_FILE)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${moves}")
    endif()
  endif()
  set(${variable} "${commit}" PARENT_SCOPE)
endfunction()
