#include "feature_pictures.h"

#include "oneac/base/atomic_file.h"
#include "oneac/evaluation/statistics.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace oneac::app {
namespace {

// Ends of the colours: what a well textured patch reaches, and what the tracker refuses at last.
constexpr double kGood = 0.005, kPoor = 0.05;
constexpr double kOpacity = 0.45;       // the image stays visible
constexpr std::size_t kFewest = 10;     // values that make a median
constexpr double kLetterHeight = 22.0;  // [px] of OpenCV's font at scale 1

cv::Scalar colour_of(double residual) {
  const double poor = std::clamp((residual - kGood) / (kPoor - kGood), 0.0, 1.0);
  return {0.0, 220.0 * (1.0 - poor), 220.0 * poor};
}

void draw_region(cv::Mat& canvas, const cv::Rect& region, double residual) {
  cv::Mat part = canvas(region);
  const cv::Mat tint(part.size(), part.type(), colour_of(residual));
  cv::addWeighted(part, 1.0 - kOpacity, tint, kOpacity, 0.0, part);
  char text[16];
  std::snprintf(text, sizeof text, "%.3f", residual);
  const double size = std::min(0.3 * region.height, 0.19 * region.width) / kLetterHeight;
  const cv::Point at(region.x + 4, region.y + region.height / 2);
  // A dark rim keeps the number readable on a bright sky.
  cv::putText(canvas, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(canvas, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 1, cv::LINE_AA);
}

}  // namespace

void draw_regions(const GreyImage& image, const FeatureStatistics& statistics,
                  const std::filesystem::path& png) {
  const cv::Mat grey(image.height(), image.width(), CV_8UC1,
                     const_cast<std::uint8_t*>(image.row(0)));
  cv::Mat canvas;
  cv::cvtColor(grey, canvas, cv::COLOR_GRAY2BGR);
  constexpr int kColumns = FeatureStatistics::kColumns, kRows = FeatureStatistics::kRows;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const std::vector<double>& residuals = statistics.residuals(row, column);
      const cv::Point low(column * image.width() / kColumns, row * image.height() / kRows);
      const cv::Point high((column + 1) * image.width() / kColumns,
                           (row + 1) * image.height() / kRows);
      if (residuals.size() >= kFewest) {
        draw_region(canvas, cv::Rect(low, high), percentile(residuals, 50.0));
      }
      cv::rectangle(canvas, low, high, {90, 90, 90});
    }
  }
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", canvas, bytes);
  write_file_atomically(
      png, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace oneac::app
