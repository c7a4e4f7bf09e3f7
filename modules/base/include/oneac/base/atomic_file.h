#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace oneac {

/// The file that writing to a path replaces: the path, or what it links to.
/// @throws OutputError for what a rename would replace in silence: a device, a pipe, a socket
[[nodiscard]] std::filesystem::path replaced_file(const std::filesystem::path& path);

/// Writes a file whole or not at all: into a temporary beside it, flushed, then renamed over it.
/// A link stays, what it links to is written.
/// @throws OutputError naming the path when anything fails; the temporary is removed
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for content produced piece by piece. `produce` may throw; then nothing is written.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(std::ostream&)>& produce);

/// Creates the folder (and its parents) and proves that a file can be made in it.
/// @throws InputError naming the folder and the cure when it cannot be written to
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace oneac
