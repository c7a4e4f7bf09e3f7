#pragma once

#include "oneac/initialisers/relative_pose_initialiser.h"

#include <mrpt/version.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace oneac {

/// What program and plugin must agree on before one calls the other, as the compiler saw it. Plain
/// bytes with a mark at either end: they are found in the library's file before any of its code
/// runs.
struct PluginStamp {
  static constexpr std::size_t kFields = 12;

  std::array<char, 24> begin;
  std::array<std::uint32_t, kFields> fields;
  std::array<char, 24> version;  ///< release, zero-terminated
  std::array<char, 24> end;
};

/// Of each field, for messages.
inline constexpr std::array<const char*, PluginStamp::kFields> kPluginStampFields{
    "interface of initialisers",
    "size of InitialiserInput",
    "size of InitialiserResult",
    "alignment of InitialiserResult",
    "size of RelativePoseInitialiser",
    "size of std::string",
    "size of std::vector<bool>",
    "ABI of the C++ library (_GLIBCXX_USE_CXX11_ABI)",
    "debug mode of the C++ library (_GLIBCXX_DEBUG)",
    "alignment of Eigen (-march)",
    "version of Eigen",
    "version of MRPT"};

inline constexpr std::uint32_t kInitialiserInterface =
    1;  ///< raised when a virtual function changes

namespace internal {

template <std::size_t N>
constexpr std::array<char, 24> letters(const char (&text)[N]) {
  static_assert(N <= 24);
  std::array<char, 24> all{};
  for (std::size_t i = 0; i < N; ++i) all[i] = text[i];
  return all;
}

#ifdef _GLIBCXX_USE_CXX11_ABI
inline constexpr std::uint32_t kCxx11Abi = _GLIBCXX_USE_CXX11_ABI;
#else
inline constexpr std::uint32_t kCxx11Abi = 0;
#endif
#ifdef _GLIBCXX_DEBUG
inline constexpr std::uint32_t kDebugContainers = 1;
#else
inline constexpr std::uint32_t kDebugContainers = 0;
#endif

}  // namespace internal

/// Of the file that is being compiled. @param version  release of oneac, up to 23 letters
template <std::size_t N>
constexpr PluginStamp plugin_stamp(const char (&version)[N]) {
  PluginStamp stamp{};
  stamp.begin = internal::letters("oneac plugin stamp <");
  stamp.fields = {kInitialiserInterface,
                  sizeof(InitialiserInput),
                  sizeof(InitialiserResult),
                  alignof(InitialiserResult),
                  sizeof(RelativePoseInitialiser),
                  sizeof(std::string),
                  sizeof(std::vector<bool>),
                  internal::kCxx11Abi,
                  internal::kDebugContainers,
                  EIGEN_MAX_ALIGN_BYTES,
                  EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100,
                  MRPT_VERSION};
  stamp.version = internal::letters(version);
  stamp.end = internal::letters("> oneac plugin stamp");
  return stamp;
}

}  // namespace oneac
