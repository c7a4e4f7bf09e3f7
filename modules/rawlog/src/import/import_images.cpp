#include "import/import_images.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/observations/image_decoding.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

}  // namespace

std::vector<fs::path> list_images(const fs::path& folder) {
  std::vector<fs::path> images;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && is_image(entry.path())) images.push_back(entry.path());
  }
  std::sort(images.begin(), images.end());
  return images;
}

std::pair<int, int> image_size(const fs::path& image) {
  const GreyImage pixels = decode_grey_file(image);
  return {pixels.width(), pixels.height()};
}

void require_source_folder(const fs::path& source) {
  std::error_code ignored;
  if (fs::is_directory(source, ignored)) return;
  throw InputError(source.string(), "no such folder", "give the folder of the dataset to import");
}

ImageReferences::ImageReferences(const fs::path& log, bool copy) {
  if (!copy) return;
  copies_ = log.parent_path() / (log.stem().string() + "_Images");
  require_writable_folder(copies_);
}

std::string ImageReferences::refer_to(const fs::path& image) const {
  if (copies_.empty()) return fs::canonical(image).string();
  std::error_code error;
  fs::copy_file(image, copies_ / image.filename(), fs::copy_options::overwrite_existing, error);
  if (error) {
    throw OutputError((copies_ / image.filename()).string(),
                      "cannot be copied (" + error.message() + ")",
                      "free some space or import without --copy-images");
  }
  return image.filename().string();
}

}  // namespace oneac
