#pragma once

#include "import/bag/ros_messages.h"

#include <filesystem>
#include <string>

namespace oneac {

/// Writes images of a bag to files: <folder>/<prefix><number>.png or .jpg.
/// @pre the folder is there
class BagImages {
 public:
  explicit BagImages(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Each returns the file. @throws BadMessage for an image that is not what it says, or whose kind
  // is not read; OutputError when it cannot be written

  [[nodiscard]] std::filesystem::path write(const RosImage& image, const std::string& name);
  [[nodiscard]] std::filesystem::path write(const RosCompressedImage& image,
                                            const std::string& name);

 private:
  std::filesystem::path folder_;
};

}  // namespace oneac
