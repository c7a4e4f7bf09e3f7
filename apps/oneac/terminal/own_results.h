#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace oneac::app {

/// A result of a verb, and what stands in its first lines.
struct ResultMark {
  const char* name;
  const char* mark;
};

/// Whether a file has the mark in its first lines.
[[nodiscard]] bool has_mark(const std::filesystem::path& file, std::string_view mark);

/// Opens no pipe. @throws InputError naming what has the name of a result and is no file
void require_result_place(const std::filesystem::path& file);

/// Before anything is computed: what has the name of a result is replaced only where this verb has
/// written it. Opens no pipe.
/// @throws InputError naming what is a folder, a device or a pipe, or somebody else's
void require_own(const char* verb, const std::filesystem::path& folder,
                 const std::vector<ResultMark>& results);

}  // namespace oneac::app
