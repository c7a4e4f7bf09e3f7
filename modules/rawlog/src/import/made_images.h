#pragma once

#include <filesystem>
#include <string>

namespace oneac {

/// Images that an import writes beside its log, in <log base>_Images. Until the log is complete
/// they lie in <log base>_Images.part: an import that is refused or stopped harms no images of an
/// earlier one, and what is nobody's import stays.
class MadeImages {
 public:
  /// @throws InputError where the folder holds files that are of no import of this log, or cannot
  /// be
  ///         written to
  explicit MadeImages(const std::filesystem::path& log);
  MadeImages(const MadeImages&) = delete;
  MadeImages& operator=(const MadeImages&) = delete;
  /// Takes away what was not kept.
  ~MadeImages();

  /// Where to write them for now.
  [[nodiscard]] const std::filesystem::path& folder() const { return part_; }
  /// Where they will lie.
  [[nodiscard]] const std::filesystem::path& destination() const { return destination_; }
  /// Of an image in folder(): its absolute path once it is kept.
  [[nodiscard]] std::string kept_path(const std::filesystem::path& image) const;
  /// Puts them where they belong, over those of an earlier import of the log.
  /// @throws OutputError
  void keep();

 private:
  std::filesystem::path log_, destination_, part_;
};

/// <log base>_Images beside the log.
[[nodiscard]] std::filesystem::path images_beside(const std::filesystem::path& log);

}  // namespace oneac
