#pragma once

#include <cstddef>

namespace oneac {

/// Number of calls of operator new in this program so far, for "does not allocate" tests.
[[nodiscard]] std::size_t allocation_count();

}  // namespace oneac
