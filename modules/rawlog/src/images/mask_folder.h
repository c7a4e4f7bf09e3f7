#pragma once

#include "oneac/base/image.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace oneac {

/// A folder with a mask per image: a picture that is dark (below 128) where pixels are not used.
///
/// The mask of `000003.jpg` is called as the image is, whatever its ending: `000003.png`, also
/// `000003.jpg.png`, `000003_mask.png`, `mask_000003.png` and `3.png`, numbers by their value. That
/// of an image that is stored in the log has the image's index for a name.
class MaskFolder {
 public:
  /// @throws InputError when there is no such folder, it holds no picture, or two for one image
  explicit MaskFolder(const std::filesystem::path& folder);

  /// @param name  of the image's file; "" for one in the log
  /// @throws InputError naming the image when it has no mask
  [[nodiscard]] std::filesystem::path mask_of(const std::string& name, std::size_t index) const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::path> masks_;  ///< by what their names have in common
};

/// The mask of an image of this size.
/// @param image  its name, for the message
/// @throws InputError when it cannot be read or has another size
[[nodiscard]] GreyImage read_mask(const std::filesystem::path& mask, const ImageView& pixels,
                                  const std::string& image);

}  // namespace oneac
