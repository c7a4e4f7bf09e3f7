#include "marks.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace oneac {
namespace {

constexpr double kWidest = 960.0;       // [px] as wide as the page shows it
constexpr int kJpegQuality = 80;        // no visible loss at this size
constexpr int kFractionBits = 4;        // lines end at sixteenths of a pixel
constexpr double kOpacity = 0.45;       // of a tint: the image stays visible
constexpr double kLetterHeight = 22.0;  // [px] of OpenCV's font at scale 1

cv::Mat grey_of(const ImageView& image) {
  if (image.empty()) throw std::invalid_argument("picture: the image has no pixels");
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
          static_cast<std::size_t>(image.stride)};
}

cv::Mat canvas_of(const ImageView& image) {
  cv::Mat canvas;
  cv::cvtColor(grey_of(image), canvas, cv::COLOR_GRAY2BGR);
  return canvas;
}

std::string encoded(const cv::Mat& picture, const char* ending, const std::vector<int>& how = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, picture, bytes, how);
  return {bytes.begin(), bytes.end()};
}

cv::Scalar bgr_of(double poor) {
  const auto [r, g, b] = colour_of(poor);
  return cv::Scalar(b, g, r);
}

cv::Point sixteenths(const Eigen::Vector2d& u) {
  const auto fixed = [](double x) {
    return static_cast<int>(std::lround(x * (1 << kFractionBits)));
  };
  return {fixed(u.x()), fixed(u.y())};
}

void draw(cv::Mat& canvas, const Mark& mark) {
  const cv::Scalar colour = bgr_of(mark.poor);
  cv::line(canvas, sixteenths(mark.u1), sixteenths(mark.u2), colour, 1, cv::LINE_AA, kFractionBits);
  std::vector<cv::Point> outline;
  for (const Eigen::Vector2d& corner : internal::corners_of(mark)) {
    outline.push_back(sixteenths(corner));
  }
  cv::polylines(canvas, outline, true, colour, 1, cv::LINE_AA, kFractionBits);
}

void tint(cv::Mat& canvas, const cv::Rect& place, const TintedField& field) {
  cv::Mat part = canvas(place);
  const cv::Mat colour(part.size(), part.type(), bgr_of(field.poor));
  cv::addWeighted(part, 1.0 - kOpacity, colour, kOpacity, 0.0, part);
  const double size = std::min(0.3 * place.height, 0.19 * place.width) / kLetterHeight;
  const cv::Point at(place.x + 4, place.y + place.height / 2);
  // A dark rim keeps the number readable on a bright sky.
  for (const auto& [thickness, shade] : {std::pair(3, 0), std::pair(1, 255)}) {
    cv::putText(canvas, field.number, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(shade),
                thickness, cv::LINE_AA);
  }
}

}  // namespace

std::string jpeg_of(const ImageView& image) {
  const cv::Mat grey = grey_of(image);
  cv::Mat small = grey;
  const double factor = kWidest / image.width;
  if (factor < 1.0) cv::resize(grey, small, {}, factor, factor, cv::INTER_AREA);
  return encoded(small, ".jpg", {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
}

std::string png_of(const ImageView& image) {
  return encoded(grey_of(image), ".png");
}

std::string overlay_png(const ImageView& image, const std::vector<Mark>& marks) {
  cv::Mat canvas = canvas_of(image);
  for (const Mark& mark : marks) {
    if (internal::is_finite(mark)) draw(canvas, mark);
  }
  return encoded(canvas, ".png");
}

std::string tinted_png(const ImageView& image, int rows, int columns,
                       const std::vector<TintedField>& fields) {
  if (fields.size() != static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)) {
    throw std::invalid_argument("tinted_png: " + std::to_string(fields.size()) + " fields for " +
                                std::to_string(rows) + " x " + std::to_string(columns));
  }
  cv::Mat canvas = canvas_of(image);
  auto field = fields.begin();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column, ++field) {
      const cv::Point low(column * image.width / columns, row * image.height / rows);
      const cv::Point high((column + 1) * image.width / columns, (row + 1) * image.height / rows);
      if (!field->number.empty()) tint(canvas, cv::Rect(low, high), *field);
      cv::rectangle(canvas, low, high, cv::Scalar::all(90));
    }
  }
  return encoded(canvas, ".png");
}

}  // namespace oneac
