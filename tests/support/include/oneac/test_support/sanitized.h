#pragma once

namespace oneac {

/// Whether these programs were built with a sanitizer: memory and time are then not what users see.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace oneac
