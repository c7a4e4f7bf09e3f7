#include "images/mask_folder.h"

#include "images/image_names.h"

#include "oneac/base/error.h"
#include "oneac/base/mask.h"
#include "oneac/observations/image_decoding.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

std::string without_mask(const std::string& name) {
  constexpr std::array<std::string_view, 2> kBehind = {"_mask", "-mask"},
                                            kBefore = {"mask_", "mask-"};
  for (const std::string_view word : kBehind) {
    const bool has = name.size() > word.size() &&
                     name.compare(name.size() - word.size(), word.size(), word) == 0;
    if (has) return name.substr(0, name.size() - word.size());
  }
  for (const std::string_view word : kBefore) {
    if (name.size() > word.size() && name.compare(0, word.size(), word) == 0) {
      return name.substr(word.size());
    }
  }
  return name;
}

/// What an image and its mask have in common: a number without its leading zeros.
std::string key_of(const std::string& stem) {
  const bool number = !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) {
    return std::isdigit(c) != 0;
  });
  if (!number) return stem;
  const auto first = stem.find_first_not_of('0');
  return first == std::string::npos ? "0" : stem.substr(first);
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (is_image(it->path()) && it->is_regular_file(ignored)) files.push_back(it->path());
  }
  if (error) {
    throw InputError(folder.string(), "no such folder of masks", "name one with --mask-dir");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

MaskFolder::MaskFolder(const fs::path& folder) : MaskFolder(folder, true) {}

MaskFolder::MaskFolder(const fs::path& folder, bool may_have_right) : folder_(folder) {
  for (const fs::path& file : pictures_in(folder)) {
    const auto [at, fresh] = masks_.emplace(key_of(without_mask(file.stem().string())), file);
    if (fresh) continue;
    throw InputError(folder.string(),
                     at->second.filename().string() + " and " + file.filename().string() +
                         " are masks of one image",
                     "keep one of them, and masks in a folder of their own");
  }
  if (masks_.empty()) {
    throw InputError(folder.string(), "holds no pictures",
                     "name the folder of the masks with --mask-dir");
  }
  std::error_code ignored;
  const fs::path right = folder / "right";
  if (may_have_right && fs::is_directory(right, ignored)) {
    right_ = std::shared_ptr<const MaskFolder>(new MaskFolder(right, false));
  }
}

std::optional<fs::path> MaskFolder::find(const std::string& name, std::size_t index) const {
  const std::vector<std::string> keys =
      name.empty() ? std::vector<std::string>{std::to_string(index)}
                   : std::vector<std::string>{name, key_of(fs::path(name).stem().string())};
  for (const std::string& key : keys) {
    if (const auto at = masks_.find(key); at != masks_.end()) return at->second;
  }
  return std::nullopt;
}

fs::path MaskFolder::mask_of_right(const std::string& name, const std::string& left,
                                   std::size_t index) const {
  if (right_) return right_->mask_of(name, index);
  const auto stem = [](const std::string& file) { return key_of(fs::path(file).stem().string()); };
  // Images in the log, and those of KITTI's layout, are called as the left ones.
  if (name.empty() || stem(name) == stem(left)) return {};
  return find(name, index).value_or(fs::path());
}

fs::path MaskFolder::mask_of(const std::string& name, std::size_t index) const {
  if (const auto found = find(name, index)) return *found;
  const fs::path file(name);
  const std::string wanted = (name.empty() ? std::to_string(index) : file.stem().string()) + ".png";
  throw InputError(folder_.string(),
                   "no mask for image " + (name.empty() ? std::to_string(index) : name),
                   "add " + wanted + ", white where all of the image is to be used");
}

GreyImage read_mask(const fs::path& mask, const ImageView& pixels, const std::string& image) {
  GreyImage picture = decode_grey_file(mask);
  if (const std::string fault = fault_of_mask(picture.view()); !fault.empty()) {
    throw InputError(mask.string(), fault, kMaskCure);
  }
  if (picture.width() == pixels.width && picture.height() == pixels.height) return picture;
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw InputError(mask.string(),
                   "the mask has " + size(picture.width(), picture.height()) + " pixels, " + image +
                       " has " + size(pixels.width, pixels.height),
                   "make it of the same size");
}

}  // namespace oneac
