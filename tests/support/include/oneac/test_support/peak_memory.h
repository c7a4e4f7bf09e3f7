#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace oneac {

/// Most memory resident at once, of the process whose usage this is [MiB].
inline std::size_t peak_mb(const rusage& usage) {
  return static_cast<std::size_t>(usage.ru_maxrss) / 1024U;
}

/// Most memory that this process has had resident at once since it began [MiB].
inline std::size_t peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return peak_mb(usage);
}

}  // namespace oneac
