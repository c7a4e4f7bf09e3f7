#include "oneac/features/draw_tracks.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace oneac {
namespace {

constexpr double kGoodSigma = 0.01, kPoorSigma = 0.05;  // ends of the colours
constexpr int kFractionBits = 4;                        // lines end at sixteenths of a pixel
constexpr double kFraction = 1 << kFractionBits;

cv::Point fixed_point(const Eigen::Vector2d& u) {
  return {static_cast<int>(std::lround(u.x() * kFraction)),
          static_cast<int>(std::lround(u.y() * kFraction))};
}

cv::Scalar colour_of(const Correspondence& ac, bool standing) {
  if (standing) return {255, 128, 0};
  const double poor =
      std::clamp((ac.affine_sigma - kGoodSigma) / (kPoorSigma - kGoodSigma), 0.0, 1.0);
  return {0, 255.0 * (1.0 - poor), 255.0 * poor};
}

void draw(cv::Mat& canvas, const AffineCorrespondence& ac, const cv::Scalar& colour, double side) {
  cv::line(canvas, fixed_point(ac.x1), fixed_point(ac.x2), colour, 1, cv::LINE_AA, kFractionBits);
  const std::array<Eigen::Vector2d, 4> corners = {
      Eigen::Vector2d(-side, -side), Eigen::Vector2d(side, -side), Eigen::Vector2d(side, side),
      Eigen::Vector2d(-side, side)};
  std::vector<cv::Point> outline;
  outline.reserve(corners.size());
  for (const auto& corner : corners) outline.push_back(fixed_point(ac.x2 + ac.A * corner));
  cv::polylines(canvas, outline, true, colour, 1, cv::LINE_AA, kFractionBits);
}

}  // namespace

void draw_tracks(const ImageView& image, const TrackedPair& pair, const std::filesystem::path& png,
                 double half_side_px) {
  const cv::Mat grey(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                     static_cast<std::size_t>(image.stride));
  cv::Mat canvas;
  cv::cvtColor(grey, canvas, cv::COLOR_GRAY2BGR);
  for (const Correspondence& ac : pair.correspondences) {
    if (ac.is_finite()) draw(canvas, ac, colour_of(ac, pair.standing), half_side_px);
  }
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", canvas, bytes)) {
    throw OutputError(png.string(), "the picture cannot be encoded", "give an image with pixels");
  }
  write_file_atomically(
      png, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace oneac
