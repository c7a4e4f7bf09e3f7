#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace oneac {

/// Images (.png, .jpg, .jpeg) of a folder by name; empty when there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// Width and height [px]. @throws InputError when the image cannot be decoded
[[nodiscard]] std::pair<int, int> image_size(const std::filesystem::path& image);

/// @throws InputError when the source of an import is no folder
void require_source_folder(const std::filesystem::path& source);

/// How a log refers to its images: where they are, or copied to <log base>_Images beside it.
class ImageReferences {
 public:
  /// @throws InputError when copies cannot be written
  ImageReferences(const std::filesystem::path& log, bool copy);
  /// What to store in the log for an image that exists. @throws OutputError when it cannot be
  /// copied
  [[nodiscard]] std::string refer_to(const std::filesystem::path& image) const;

 private:
  std::filesystem::path copies_;  ///< empty: images stay where they are
};

}  // namespace oneac
