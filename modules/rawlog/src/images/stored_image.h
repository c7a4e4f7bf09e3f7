#pragma once

#include "images/external_images.h"
#include "images/log_image.h"
#include "read/log_view.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace oneac {

/// An image to be loaded: the file of an external one, or what the log holds.
struct StoredImage {
  std::filesystem::path file;
  std::shared_ptr<const LogImage> in_log;

  /// @param name_in_log  for messages about an image of the log
  /// @param drive        what its images share, of 16 bits
  /// @throws InputError when it cannot be decoded
  [[nodiscard]] GreyImage grey(const std::string& name_in_log, GreyRange& drive) const;
  /// What it takes where it is stored [byte]; 0 when that cannot be told.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::string name(const std::string& name_in_log) const;
};

/// Empty when the file is not there, or the log holds no pixels.
[[nodiscard]] std::optional<StoredImage> stored_image(const LogView& view, ExternalImages& images);

}  // namespace oneac
