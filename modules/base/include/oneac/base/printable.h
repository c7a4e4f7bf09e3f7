#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace oneac {

/// Text of any origin as one line that a terminal and a JSON reader take: what is no UTF-8 becomes
/// U+FFFD, line ends and tabs become blanks, other control characters "\x1b".
[[nodiscard]] std::string printable(std::string_view text);

/// Whether the text is UTF-8 throughout.
[[nodiscard]] bool is_utf8(std::string_view text);

/// Begin and end of a long text with "…" between them, at most `most` bytes and never within a
/// character; a text that is not longer as it is. @pre most ≥ 16
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

}  // namespace oneac
