#include "pixels.h"

#include "oneac/mrpt_compat/observations.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace oneac {
namespace {

std::string file_of(const mrpt::img::CImage& image) {
  std::string file = image.getExternalStorageFileAbsolutePath();
  std::replace(file.begin(), file.end(), '\\', '/');  // logs written on Windows
  return file;
}

}  // namespace

bool is_there(const mrpt::img::CImage& image) {
  if (!image.isExternallyStored()) return !image.isEmpty();
  std::error_code ignored;
  return !image.getExternalStorageFile().empty() &&
         std::filesystem::is_regular_file(file_of(image), ignored);
}

std::string name_of(const mrpt::img::CImage& image, const std::string& where) {
  return image.isExternallyStored() ? file_of(image) : where;
}

GreyImage grey_of(const mrpt::img::CImage& image, const std::string& where, GreyRange& drive) {
  if (image.isExternallyStored()) return decode_grey_file(file_of(image), drive);
  return to_grey(compat::pixels_of(image), where, drive);
}

}  // namespace oneac
