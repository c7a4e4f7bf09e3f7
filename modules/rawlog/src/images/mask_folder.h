#pragma once

#include "oneac/base/image.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace oneac {

/// A folder with a mask per image: a picture that is dark (below 128) where pixels are not used.
///
/// The mask of `000003.jpg` is called as the image is, whatever its ending: `000003.png`, also
/// `000003.jpg.png`, `000003_mask.png`, `mask_000003.png` and `3.png`, numbers by their value. That
/// of an image that is stored in the log has the image's index for a name.
///
/// The right images of pairs have theirs in a folder `right` in it, which may lack, or beside those
/// of the left ones where they are called otherwise than these.
class MaskFolder {
 public:
  /// @throws InputError when there is no such folder, it holds no picture, or two for one image
  explicit MaskFolder(const std::filesystem::path& folder);

  /// @param name  of the image's file; "" for one in the log
  /// @throws InputError naming the image when it has no mask
  [[nodiscard]] std::filesystem::path mask_of(const std::string& name, std::size_t index) const;
  /// Of the right image of a pair; "" where all of it is used.
  /// @param left  what the left image is called
  /// @throws InputError naming the image when the folder `right` has no mask of it
  [[nodiscard]] std::filesystem::path mask_of_right(const std::string& name,
                                                    const std::string& left,
                                                    std::size_t index) const;

 private:
  explicit MaskFolder(const std::filesystem::path& folder, bool may_have_right);
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name,
                                                          std::size_t index) const;

  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::path> masks_;  ///< by what their names have in common
  std::shared_ptr<const MaskFolder> right_;             ///< null: none
};

/// The mask of an image of this size.
/// @param image  its name, for the message
/// @throws InputError when it cannot be read or has another size
[[nodiscard]] GreyImage read_mask(const std::filesystem::path& mask, const ImageView& pixels,
                                  const std::string& image);

}  // namespace oneac
