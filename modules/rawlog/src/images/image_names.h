#pragma once

#include <filesystem>
#include <string>

namespace oneac {

/// Hidden files are no images: "._000000.jpg" is what macOS leaves beside an image.
[[nodiscard]] bool is_hidden(const std::filesystem::path& path);
/// ".jpg" of "A.JPG".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);
/// Whether a file is called as an image of a kind that is read.
[[nodiscard]] bool is_image(const std::filesystem::path& path);

}  // namespace oneac
