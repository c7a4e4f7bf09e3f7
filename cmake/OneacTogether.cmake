# Compiles files of a target together (a "unity build"), so that Eigen, MRPT, Ceres and CLI11 are
# read once for eight files and not for each. Files that name a thing of their own alike, as kFewest
# or parse_row, never come together: no name has to be unique in a module because of the build.

set(ONEAC_TOGETHER 8)  # files at most: more leaves cores without work

# oneac_own_names(FILE NAMES): constants, types and functions that FILE defines, also inside of
# functions: one file's constant must not hide another's.
function(oneac_own_names file names)
  file(READ "${file}" text)
  string(REGEX REPLACE "[][;]" " " text "${text}")  # which CMake's lists would take for theirs
  string(REGEX MATCHALL "k[A-Z][A-Za-z0-9_]* *[={]" constants "${text}")
  string(REGEX MATCHALL "\n *(struct|class|enum class|using|namespace) [A-Za-z0-9_]+" types "${text}")
  string(REGEX MATCHALL "\n[A-Za-z][^\n=(){}\"]* [A-Za-z0-9_]+\\(" functions "${text}")
  list(TRANSFORM constants REPLACE " *[={]$" "")
  list(TRANSFORM types REPLACE "^.* " "")
  list(TRANSFORM functions REPLACE "^.* ([A-Za-z0-9_]+)\\($" "\\1")
  set(found ${constants} ${types} ${functions})
  list(REMOVE_DUPLICATES found)
  list(REMOVE_ITEM found oneac internal app simulation study rivals fs)
  set(${names} "${found}" PARENT_SCOPE)
endfunction()

# oneac_together(TARGET): puts each file into the first group that has room and no name of it.
function(oneac_together target)
  get_target_property(sources ${target} SOURCES)
  set(groups 0)
  foreach(source IN LISTS sources)
    set(path "${CMAKE_CURRENT_SOURCE_DIR}/${source}")
    if(NOT source MATCHES "\\.cpp$" OR NOT EXISTS "${path}")
      continue()
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
    oneac_own_names("${path}" own)
    set(group 0)
    while(group LESS groups)
      set(shared ${own})
      list(REMOVE_ITEM shared ${names_${group}} "")
      list(LENGTH own before)
      list(LENGTH shared after)
      if(before EQUAL after AND size_${group} LESS ONEAC_TOGETHER)
        break()
      endif()
      math(EXPR group "${group} + 1")
    endwhile()
    if(group EQUAL groups)
      math(EXPR groups "${groups} + 1")
      set(size_${group} 0)
      set(names_${group} "")
    endif()
    math(EXPR size_${group} "${size_${group}} + 1")
    list(APPEND names_${group} ${own})
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class of one file with a member of its anonymous namespace: fine, but GCC takes the group's
  # file for its main one and this file for a header.
  target_compile_options(${target} PRIVATE
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
endfunction()
