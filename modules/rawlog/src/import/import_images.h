#pragma once

#include "import/made_images.h"

#include "oneac/observations/sensor_mount.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace oneac {

/// Images (.png, .jpg, .jpeg, .bmp, .pgm, .ppm, .tif, .tiff, .webp) of a folder in the order of
/// their names, numbers in them by their value: 2 before 10; hidden files are none; empty when
/// there is no such folder.
/// @throws InputError when two differ by their endings only
[[nodiscard]] std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// Images of a folder that are not read, by kind: "12 .heic, 3 .gif"; "" for none.
[[nodiscard]] std::string foreign_images(const std::filesystem::path& folder);

/// Width and height [px]. @throws InputError when the image cannot be decoded or has less than 32
/// px
[[nodiscard]] std::pair<int, int> image_size(const std::filesystem::path& image);

/// @throws InputError when the source of an import is no folder
void require_source_folder(const std::filesystem::path& source);

/// Whether a list of names in alphabetical order would be another.
[[nodiscard]] bool is_reordered(const std::vector<std::filesystem::path>& images);

/// @throws InputError for angles out of bounds
void require_mount(const MountAngles& mount);

/// How a log refers to its images: where they are, or copied to <log base>_Images beside it.
class ImageReferences {
 public:
  ImageReferences(std::filesystem::path log, bool copy) : log_(std::move(log)), copy_(copy) {}
  /// What to store in the log for an image that exists. One that lies there already is not copied.
  /// @param prefix  of its copy's name: the images of a pair have the same one
  /// @throws OutputError when it cannot be copied, InputError as MadeImages
  [[nodiscard]] std::string refer_to(const std::filesystem::path& image,
                                     const std::string& prefix = "");
  /// Before the log is closed: the copies are complete. @throws OutputError
  void keep();

 private:
  std::filesystem::path log_;
  bool copy_;  ///< else images stay where they are
  std::unique_ptr<MadeImages> copies_;
};

}  // namespace oneac
