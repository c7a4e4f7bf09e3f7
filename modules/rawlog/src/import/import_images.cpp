#include "import/import_images.h"

#include "images/image_names.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/observations/image_decoding.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr int kSmallest_px = 32;  // of an image that shows a road

bool is_foreign_image(const fs::path& path) {
  static const std::set<std::string> kForeign = {".heic", ".gif", ".jp2", ".raw", ".dng", ".exr"};
  return !is_hidden(path) && kForeign.count(lower_extension(path)) > 0;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t behind_number(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// The digits from `at` on, without zeros in front.
std::string_view number_at(std::string_view text, std::size_t at) {
  const std::size_t end = behind_number(text, at);
  while (at + 1 < end && text[at] == '0') ++at;
  return text.substr(at, end - at);
}

/// Whether the digits at `at` are decimals of seconds since 1970: "frame_1311868164.0363". Behind a
/// shorter number a point parts two counters: "cam1.9", "cam1.10".
bool is_fraction(std::string_view text, std::size_t at) {
  constexpr std::size_t kDigits = 9;
  if (at <= kDigits || text[at - 1] != '.') return false;
  const auto whole = text.substr(at - 1 - kDigits, kDigits);
  return std::all_of(whole.begin(), whole.end(), is_digit);
}

/// Below, at or above zero as the digits of one name at i come before, equal or follow those of
/// the other at j.
int compare_numbers(std::string_view a, std::size_t i, std::string_view b, std::size_t j) {
  if (is_fraction(a, i) && is_fraction(b, j)) {
    return a.substr(i, behind_number(a, i) - i).compare(b.substr(j, behind_number(b, j) - j));
  }
  const std::string_view m = number_at(a, i), n = number_at(b, j);
  if (m.size() != n.size()) return m.size() < n.size() ? -1 : 1;
  return m.compare(n);
}

/// A name with its numbers as one writes them: "img007" and "img7" are one moment.
std::string without_padding(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size();) {
    if (!is_digit(name[i])) {
      text += name[i++];
      continue;
    }
    const std::size_t end = behind_number(name, i);
    text += is_fraction(name, i) ? name.substr(i, end - i) : number_at(name, i);
    i = end;
  }
  return text;
}

/// One moment would be there twice: "000003.jpg" beside "000003.png", or beside "3.jpg".
void require_different_names(const std::vector<fs::path>& images) {
  std::map<std::string, fs::path> stems;
  for (const fs::path& image : images) {
    const auto [known, is_new] = stems.emplace(without_padding(image.stem().native()), image);
    if (is_new) continue;
    throw InputError(image.string(),
                     "is there beside " + known->second.filename().string() +
                         ", and which of them to take nobody says",
                     "move the images of one kind to another folder");
  }
}

/// Numbers in names count by their value, however many digits they have.
bool comes_before(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      if (const int order = compare_numbers(a, i, b, j); order != 0) return order < 0;
      i = behind_number(a, i);
      j = behind_number(b, j);
      continue;
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  const bool a_ends = i == a.size(), b_ends = j == b.size();
  return a_ends != b_ends ? a_ends : a < b;
}

}  // namespace

std::vector<fs::path> list_images(const fs::path& folder) {
  std::vector<fs::path> images;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!is_image(entry.path())) continue;
    if (entry.is_symlink(error) && !fs::exists(entry.path(), error)) {
      throw InputError(entry.path().string(), "is a link to nothing", "mend it, or take it away");
    }
    if (entry.is_regular_file(error)) images.push_back(entry.path());
  }
  require_different_names(images);
  std::sort(images.begin(), images.end(), [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().native(), b.filename().native());
  });
  return images;
}

std::string foreign_images(const fs::path& folder) {
  std::map<std::string, std::size_t> kinds;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (is_foreign_image(entry.path())) ++kinds[lower_extension(entry.path())];
  }
  std::string text;
  for (const auto& [kind, count] : kinds) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return text;
}

bool is_reordered(const std::vector<fs::path>& images) {
  return !std::is_sorted(images.begin(), images.end());
}

void require_mount(const MountAngles& mount) {
  try {
    mount.validate();
  } catch (const std::invalid_argument& error) {
    throw InputError("import", error.what(), "correct --mount-roll, --mount-pitch or --mount-yaw");
  }
}

std::pair<int, int> image_size(const fs::path& image) {
  const GreyImage pixels = decode_grey_file(image);
  if (std::min(pixels.width(), pixels.height()) < kSmallest_px) {
    throw InputError(
        image.string(),
        "has " + std::to_string(pixels.width()) + "x" + std::to_string(pixels.height()) + " pixels",
        "take it away, or get it again: it is no image of a drive");
  }
  return {pixels.width(), pixels.height()};
}

void require_source_folder(const fs::path& source) {
  std::error_code ignored;
  if (fs::is_directory(source, ignored)) return;
  throw InputError(source.string(), "no such folder", "give the folder of the dataset to import");
}

std::string ImageReferences::refer_to(const fs::path& image, const std::string& prefix) {
  if (!copy_) return fs::canonical(image).string();
  std::error_code error;
  std::string name = prefix + image.filename().string();
  const bool lies_there = is_same_file(image.parent_path(), images_beside(log_));
  if (lies_there && prefix.empty()) return name;
  if (!copies_) copies_ = std::make_unique<MadeImages>(log_);
  fs::copy_file(image, copies_->folder() / name, error);
  if (error) {
    throw OutputError((copies_->destination() / name).string(),
                      "cannot be copied (" + error.message() + ")",
                      "free some space or import without --copy-images");
  }
  return name;
}

void ImageReferences::keep() {
  if (copies_) copies_->keep();
}

}  // namespace oneac
