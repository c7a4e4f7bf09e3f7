#include "images/stored_image.h"

#include "oneac/observations/image_decoding.h"

#include <system_error>

namespace oneac {

std::string StoredImage::name(const std::string& name_in_log) const {
  return file.empty() ? name_in_log : file.string();
}

std::size_t StoredImage::bytes() const {
  if (file.empty()) return in_log->bytes.size();
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  return unknown ? 0 : static_cast<std::size_t>(size);
}

GreyImage StoredImage::grey(const std::string& name_in_log, GreyRange& drive) const {
  return file.empty() ? decode_grey(*in_log, name_in_log, drive) : decode_grey_file(file, drive);
}

std::optional<StoredImage> stored_image(const LogView& view, ExternalImages& images) {
  if (view.image->kind == LogImage::Kind::none) return std::nullopt;
  if (view.image->kind != LogImage::Kind::external) return StoredImage{{}, view.image};
  const auto file = images.find(view.image->file);
  if (!file) return std::nullopt;
  return StoredImage{*file, view.image};
}

}  // namespace oneac
