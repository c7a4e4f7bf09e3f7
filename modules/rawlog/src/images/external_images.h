#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace oneac {

/// Finds the files of images that a log stores outside itself.
///
/// A given folder is the only one searched; without one: `<base>_Images`, `<base>_images`, `Images`
/// and the log's own folder, in this order; of drive.rawlog.gz also `drive_Images`, of a link also
/// where it leads to (see bases_beside). An absolute name is taken as it is and, when it is not
/// there, looked for by its file name in the given folder.
class ExternalImages {
 public:
  /// @throws InputError when the given folder does not exist
  ExternalImages(const std::filesystem::path& log, const std::filesystem::path& images_dir);

  /// The file, or nothing when it is missing.
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& stored_name);
  /// "a, b": the folders searched, for messages.
  [[nodiscard]] std::string searched() const;
  /// Folders in which images have been found so far.
  [[nodiscard]] const std::set<std::filesystem::path>& used() const { return used_; }

 private:
  std::vector<std::filesystem::path> folders_;
  bool folder_given_ = false;
  std::set<std::filesystem::path> used_;
};

}  // namespace oneac
