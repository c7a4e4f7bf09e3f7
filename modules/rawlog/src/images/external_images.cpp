#include "images/external_images.h"

#include "oneac/base/error.h"
#include "oneac/rawlog/log_neighbours.h"

#include <algorithm>

namespace oneac {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

ExternalImages::ExternalImages(const fs::path& log, const fs::path& images_dir)
    : folder_given_(!images_dir.empty()) {
  std::error_code ignored;
  if (folder_given_) {
    if (!fs::is_directory(images_dir, ignored)) {
      throw InputError(images_dir.string(), "no such folder",
                       "give the folder of the log's images with --images-dir");
    }
    folders_ = {images_dir};
    return;
  }
  const auto add = [this](const fs::path& folder) {
    if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end()) {
      folders_.push_back(folder);
    }
  };
  const std::vector<fs::path> bases = bases_beside(log);
  for (const fs::path& base : bases) {
    for (const char* ending : {"_Images", "_images"}) add(base.string() + ending);
  }
  for (const fs::path& base : bases) {
    add(base.parent_path() / "Images");
    add(base.parent_path());
  }
}

std::optional<fs::path> ExternalImages::find(const std::string& stored_name) {
  std::string name = stored_name;
  std::replace(name.begin(), name.end(), '\\', '/');  // logs written on Windows
  fs::path wanted = name;
  if (wanted.empty()) return std::nullopt;
  if (wanted.is_absolute()) {
    if (is_file(wanted)) {
      used_.insert(wanted.parent_path());
      return wanted;
    }
    if (!folder_given_) return std::nullopt;
    wanted = wanted.filename();
  }
  for (const auto& folder : folders_) {
    if (!is_file(folder / wanted)) continue;
    used_.insert(folder);
    return folder / wanted;
  }
  return std::nullopt;
}

std::string ExternalImages::searched() const {
  std::string list;
  for (const auto& folder : folders_) list += (list.empty() ? "" : ", ") + folder.string();
  return list;
}

}  // namespace oneac
