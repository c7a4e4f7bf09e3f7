#include "images/image_names.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace oneac {

bool is_hidden(const std::filesystem::path& path) {
  return path.filename().native().front() == '.';
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_image(const std::filesystem::path& path) {
  static const std::set<std::string> kRead = {".png", ".jpg", ".jpeg", ".bmp", ".pgm",
                                              ".ppm", ".tif", ".tiff", ".webp"};
  return !is_hidden(path) && kRead.count(lower_extension(path)) > 0;
}

}  // namespace oneac
