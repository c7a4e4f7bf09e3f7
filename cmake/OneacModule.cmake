# Helpers shared by all modules: one place for the language level, warnings, ccache, sanitizers,
# precompiled headers.

find_program(ONEAC_CCACHE ccache)
if(ONEAC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache keeps what uses a precompiled header only when told that its macros may be trusted.
  set(launcher env CCACHE_SLOPPINESS=pch_defines,time_macros "${ONEAC_CCACHE}")
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
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

# Kinds of targets: how hard a release optimises them, and the third-party headers that they read
# once together instead of once per file. Neither changes a result: every level keeps IEEE
# arithmetic (no -ffast-math). A kind's targets share all their compile flags.
#   kernel           loops over points, pixels and hypotheses: the build type's own level
#   kernel_no_errno  the same with -fno-math-errno
#   mrpt             steers kernels; sees MRPT
#   cold, cold_mrpt  tables, figures, reports: runs once per result
#   program, test    as cold
set(ONEAC_STD_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
    <optional> <string> <vector>)
set(ONEAC_MRPT_HEADERS <mrpt/containers/yaml.h> <mrpt/obs/CObservationImage.h>
    <mrpt/obs/CSensoryFrame.h>)
# GCC misjudges Eigen below -O2.
set(ONEAC_COLD_OPTIONS -O1 $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)

set(ONEAC_HEADERS_kernel ${ONEAC_STD_HEADERS} <Eigen/Dense>)
set(ONEAC_HEADERS_kernel_no_errno ${ONEAC_HEADERS_kernel})
set(ONEAC_OPTIONS_kernel_no_errno -fno-math-errno)  # sqrt is inlined, no call
set(ONEAC_HEADERS_mrpt ${ONEAC_HEADERS_kernel} ${ONEAC_MRPT_HEADERS})
set(ONEAC_RELEASE_OPTIONS_mrpt -O2)
set(ONEAC_HEADERS_cold ${ONEAC_HEADERS_kernel})
set(ONEAC_RELEASE_OPTIONS_cold ${ONEAC_COLD_OPTIONS})
set(ONEAC_HEADERS_cold_mrpt ${ONEAC_HEADERS_mrpt})
set(ONEAC_RELEASE_OPTIONS_cold_mrpt ${ONEAC_COLD_OPTIONS})
set(ONEAC_HEADERS_program ${ONEAC_HEADERS_kernel} <CLI/CLI.hpp> <mrpt/containers/yaml.h>)
set(ONEAC_RELEASE_OPTIONS_program ${ONEAC_COLD_OPTIONS})
set(ONEAC_HEADERS_test ${ONEAC_HEADERS_kernel} <gtest/gtest.h>)
set(ONEAC_RELEASE_OPTIONS_test ${ONEAC_COLD_OPTIONS})

set(ONEAC_HEADER_LIBRARIES_kernel Eigen3::Eigen)
set(ONEAC_HEADER_LIBRARIES_kernel_no_errno Eigen3::Eigen)
set(ONEAC_HEADER_LIBRARIES_cold Eigen3::Eigen)
set(ONEAC_HEADER_LIBRARIES_mrpt Eigen3::Eigen mrpt::obs mrpt::containers)
set(ONEAC_HEADER_LIBRARIES_cold_mrpt ${ONEAC_HEADER_LIBRARIES_mrpt})
set(ONEAC_HEADER_LIBRARIES_program Eigen3::Eigen mrpt::containers CLI11::CLI11)
set(ONEAC_HEADER_LIBRARIES_test Eigen3::Eigen GTest::gtest)
set(ONEAC_EXECUTABLE_KINDS program test)  # their code is not position independent

function(oneac_compile_options target kind)
  foreach(option IN LISTS ONEAC_OPTIONS_${kind})
    target_compile_options(${target} PRIVATE ${option})
  endforeach()
  foreach(option IN LISTS ONEAC_RELEASE_OPTIONS_${kind})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${option}>)
  endforeach()
  if(ONEAC_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # ccache asks for it
  endif()
endfunction()

# oneac_headers(KIND): the target oneac_headers_KIND, whose precompiled header the kind shares.
function(oneac_headers kind)
  if(TARGET oneac_headers_${kind})
    return()
  endif()
  set(source "${PROJECT_BINARY_DIR}/headers/${kind}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// Nothing but the headers of ${kind}.\n")
  add_library(oneac_headers_${kind} OBJECT "${source}")
  target_link_libraries(oneac_headers_${kind} PRIVATE ${ONEAC_HEADER_LIBRARIES_${kind}})
  if(NOT kind IN_LIST ONEAC_EXECUTABLE_KINDS)
    set_target_properties(oneac_headers_${kind} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_precompile_headers(oneac_headers_${kind} PRIVATE ${ONEAC_HEADERS_${kind}})
  oneac_compile_options(oneac_headers_${kind} ${kind})
  target_link_libraries(oneac_headers_${kind} PRIVATE oneac_options)
endfunction()

# oneac_kind(TARGET KIND): optimises as the kind, shares its headers. The presets "clang" and "tidy"
# do without these and see that each file includes what it uses.
function(oneac_kind target kind)
  oneac_compile_options(${target} ${kind})
  if(ONEAC_PRECOMPILED_HEADERS)
    oneac_headers(${kind})
    target_precompile_headers(${target} REUSE_FROM oneac_headers_${kind})
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
                                COMPILE_OPTIONS "${flags_${bytes}}" SKIP_PRECOMPILE_HEADERS ON)
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
