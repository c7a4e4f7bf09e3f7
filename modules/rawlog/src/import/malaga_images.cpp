#include "import/malaga_images.h"

#include "import/import_images.h"

#include "oneac/base/error.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "img_";
constexpr std::string_view kLeft = "_left";
constexpr std::string_view kRight = "_right";

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

struct ImageName {
  std::string label;
  std::string time_text;
  double time_s;
  bool right;
};

std::optional<ImageName> parse(const fs::path& image) {
  const std::string stem = image.stem().string();
  std::string_view text = stem;
  const bool right = ends_with(text, kRight);
  if (text.substr(0, kPrefix.size()) != kPrefix || (!right && !ends_with(text, kLeft))) {
    return std::nullopt;
  }
  text.remove_prefix(kPrefix.size());
  text.remove_suffix(right ? kRight.size() : kLeft.size());
  const auto split = text.rfind('_');
  if (split == std::string_view::npos) return std::nullopt;
  const std::string_view time = text.substr(split + 1);
  double seconds = 0.0;
  const auto result = std::from_chars(time.data(), time.data() + time.size(), seconds);
  if (result.ec != std::errc() || result.ptr != time.data() + time.size()) return std::nullopt;
  return ImageName{std::string(text.substr(0, split)), std::string(time), seconds, right};
}

std::vector<MalagaPair> pairs_in(const fs::path& folder) {
  std::map<std::tuple<double, std::string, std::string>, MalagaPair> pairs;
  for (const fs::path& image : list_images(folder)) {
    const auto name = parse(image);
    if (!name) continue;
    MalagaPair& pair = pairs[{name->time_s, name->label, name->time_text}];
    pair.label = name->label;
    pair.time_text = name->time_text;
    pair.time_s = name->time_s;
    (name->right ? pair.right : pair.left) = image;
  }
  std::vector<MalagaPair> list;
  list.reserve(pairs.size());
  for (auto& [key, pair] : pairs) list.push_back(std::move(pair));
  return list;
}

std::vector<fs::path> candidates(const fs::path& source) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(source, ignored)) {
    const bool named = ends_with(entry.path().filename().string(), "_Images");
    if (named && entry.is_directory(ignored)) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  folders.insert(folders.begin(), source / "Images");
  folders.push_back(source);
  return folders;
}

}  // namespace

std::vector<MalagaPair> find_malaga_pairs(const fs::path& source) {
  require_source_folder(source);
  for (const fs::path& folder : candidates(source)) {
    std::vector<MalagaPair> pairs = pairs_in(folder);
    if (!pairs.empty()) return pairs;
  }
  throw InputError(
      source.string(),
      "no images img_CAMERA1_<time>_left|right.jpg in Images, *_Images or the folder itself",
      "unpack the extract's images there");
}

}  // namespace oneac
