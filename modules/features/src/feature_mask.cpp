#include "feature_mask.h"

#include "oneac/base/error.h"
#include "oneac/base/mask.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace oneac::internal {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw std::invalid_argument("mask.polygon = '" + text +
                              "', must be corners \"u,v u,v u,v\", at least three");
}

Eigen::Vector2d read_corner(const std::string& word, const std::string& all) {
  std::istringstream in(word);
  in.imbue(std::locale::classic());
  Eigen::Vector2d u;
  char comma = 0, rest = 0;
  if (!(in >> u.x() >> comma >> u.y()) || comma != ',' || in >> rest) refuse(all);
  return u;
}

/// Whether a ray to the right crosses the outline an odd number of times.
bool inside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& u) {
  bool odd = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > u.y()) == (b.y() > u.y())) continue;
    if (u.x() < a.x() + (b.x() - a.x()) * (u.y() - a.y()) / (b.y() - a.y())) odd = !odd;
  }
  return odd;
}

GreyImage read_picture(const std::string& path) {
  cv::Mat picture;  // imread would print its own complaint about a missing file
  if (std::filesystem::is_regular_file(path)) picture = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (picture.empty()) {
    throw InputError(path, "the mask cannot be read as a picture", "give a PNG file in mask.image");
  }
  const ImageView view{picture.data, picture.cols, picture.rows, static_cast<int>(picture.step)};
  if (const std::string fault = fault_of_mask(view); !fault.empty()) {
    throw InputError(path, fault, kMaskCure);
  }
  return GreyImage(view);
}

}  // namespace

FeatureMask::FeatureMask(const MaskOptions& options) : path_(options.image) {
  std::istringstream polygons(options.polygon);
  for (std::string part; std::getline(polygons, part, ';');) {
    std::istringstream words(part);
    Polygon polygon;
    for (std::string word; words >> word;) polygon.push_back(read_corner(word, options.polygon));
    if (polygon.size() < 3) refuse(options.polygon);
    polygons_.push_back(std::move(polygon));
  }
  if (!path_.empty()) picture_ = read_picture(path_);
}

bool FeatureMask::usable(const Eigen::Vector2d& u) const {
  for (const Polygon& polygon : polygons_) {
    if (inside(polygon, u)) return false;
  }
  return usable_in(picture_, u);
}

GreyImage mask_of_image(const ImageView& image, const ImageView& mask) {
  if (mask.empty()) return {};
  if (mask.width == image.width && mask.height == image.height) return GreyImage(mask);
  throw std::invalid_argument("prepare: mask = " + std::to_string(mask.width) + "x" +
                              std::to_string(mask.height) + ", must be of the image's size");
}

GreyImage FeatureMask::picture(int width, int height) const {
  if (polygons_.empty() && picture_.empty()) return {};
  return dark_where(width, height, [this](const Eigen::Vector2d& u) { return !usable(u); });
}

void FeatureMask::require_size(int width, int height) const {
  if (picture_.empty() || (picture_.width() == width && picture_.height() == height)) return;
  throw InputError(path_,
                   "the mask has " + std::to_string(picture_.width()) + "x" +
                       std::to_string(picture_.height()) + " pixels, the images " +
                       std::to_string(width) + "x" + std::to_string(height),
                   "make it of the same size");
}

}  // namespace oneac::internal
