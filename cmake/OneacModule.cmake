# Helpers shared by all modules: one place for the language level, warnings, ccache,
# sanitizers, levels of optimisation.

include(OneacTogether)

find_program(ONEAC_CCACHE ccache)
if(ONEAC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${ONEAC_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${ONEAC_CCACHE}")
endif()
if(ONEAC_CLANG_TIDY)
  find_program(ONEAC_CLANG_TIDY_PROGRAM NAMES clang-tidy-14 clang-tidy REQUIRED)
endif()

add_library(oneac_options INTERFACE)
target_compile_features(oneac_options INTERFACE cxx_std_17)
# No fused multiply-add contraction: the same bytes on every machine.
target_compile_options(oneac_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off
  $<$<BOOL:${ONEAC_WARNINGS_AS_ERRORS}>:-Werror>)
if(ONEAC_SANITIZE)
  target_compile_options(oneac_options INTERFACE -fsanitize=${ONEAC_SANITIZE}
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(oneac_options INTERFACE -fsanitize=${ONEAC_SANITIZE})
endif()
if(ONEAC_COVERAGE)
  target_compile_options(oneac_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(oneac_options INTERFACE --coverage)
endif()
if(ONEAC_FUZZ)
  target_compile_options(oneac_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

function(oneac_common target)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:oneac_options>)
  if(ONEAC_CLANG_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "${ONEAC_CLANG_TIDY_PROGRAM}")
  endif()
endfunction()

# Kinds of targets: how hard a release optimises them. None changes a result: every level keeps IEEE
# arithmetic (no -ffast-math).
#   kernel           loops over points, pixels and hypotheses: the build type's own level
#   kernel_no_errno  the same with -fno-math-errno
#   mrpt             steers kernels; sees MRPT
#   cold             tables, figures, reports: runs once per result
#   program, test    as cold
# GCC misjudges Eigen below -O2.
set(ONEAC_COLD_OPTIONS -O1 $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)

set(ONEAC_OPTIONS_kernel_no_errno -fno-math-errno)  # sqrt is inlined, no call
set(ONEAC_RELEASE_OPTIONS_mrpt -O2)
set(ONEAC_RELEASE_OPTIONS_cold ${ONEAC_COLD_OPTIONS})
set(ONEAC_RELEASE_OPTIONS_program ${ONEAC_COLD_OPTIONS})
set(ONEAC_RELEASE_OPTIONS_test ${ONEAC_COLD_OPTIONS})

# oneac_kind(TARGET KIND): optimises as the kind, and compiles files together when asked to.
function(oneac_kind target kind)
  foreach(option IN LISTS ONEAC_OPTIONS_${kind})
    target_compile_options(${target} PRIVATE ${option})
  endforeach()
  foreach(option IN LISTS ONEAC_RELEASE_OPTIONS_${kind})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${option}>)
  endforeach()
  if(ONEAC_BUILD_TOGETHER)
    oneac_together(${target})
  endif()
endfunction()

# oneac_module(NAME SOURCES ... PUBLIC ... PRIVATE ... KIND KIND): library oneac_NAME, alias
# oneac::NAME, installed with its headers.
function(oneac_module name)
  cmake_parse_arguments(M "" "KIND" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(oneac_${name} STATIC ${M_SOURCES})
  add_library(oneac::${name} ALIAS oneac_${name})
  target_include_directories(oneac_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(oneac_${name} PUBLIC cxx_std_17)
  # Headers only: nothing that the users of the installed library would have to find.
  list(TRANSFORM M_PRIVATE REPLACE "^nlohmann_json::.*$" "$<BUILD_INTERFACE:\\0>")
  target_link_libraries(oneac_${name} PUBLIC ${M_PUBLIC} PRIVATE ${M_PRIVATE})
  set_target_properties(oneac_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  oneac_common(oneac_${name})
  if(M_KIND)
    oneac_kind(oneac_${name} ${M_KIND})
  endif()
  oneac_install_module(${name} ${M_PUBLIC} ${M_PRIVATE})
endfunction()

# oneac_simd(NAME FILE): compiles FILE of module NAME once per instruction set of base/simd.h, with
# ONEAC_SIMD_BYTES of register; simd_kernels() chooses among them at run time.
function(oneac_simd name file)
  set(levels "16")
  set(flags_32 -mavx2)
  set(flags_64 -mavx512f -mavx512dq -mavx512vl)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    list(APPEND levels 32 64)
  endif()
  get_filename_component(folder "${CMAKE_CURRENT_SOURCE_DIR}/${file}" DIRECTORY)
  get_filename_component(body "${file}" NAME)
  get_filename_component(stem "${file}" NAME_WE)
  foreach(bytes IN LISTS levels)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/simd/${stem}_${bytes}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#define ONEAC_SIMD_BYTES ${bytes}\n#include \"${body}\"\n")
    set_source_files_properties("${source}" PROPERTIES INCLUDE_DIRECTORIES "${folder}"
                                COMPILE_OPTIONS "${flags_${bytes}}")
    target_sources(oneac_${name} PRIVATE "${source}")
  endforeach()
endfunction()

# oneac_test(NAME SOURCES ... LINK ...): GoogleTest program NAME, every test known to ctest.
function(oneac_test name)
  if(NOT ONEAC_BUILD_TESTS)
    return()
  endif()
  cmake_parse_arguments(T "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${T_SOURCES})
  target_link_libraries(${name} PRIVATE ${T_LINK} oneac::test_support GTest::gtest GTest::gtest_main)
  oneac_common(${name})
  oneac_kind(${name} test)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 600 PROPERTIES TIMEOUT 300)
endfunction()
