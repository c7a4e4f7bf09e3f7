#include "oneac/features/sift_extractor.h"

#include "oneac/features/descriptor_matching.h"
#include "oneac/geometry/angles.h"

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace oneac {
namespace {

constexpr int kOctaveLayers = 3;  // Lowe's values
constexpr double kContrast = 0.04;
constexpr double kSigma = 1.6;

class SiftFrame : public FrameFeatures {
 public:
  explicit SiftFrame(AffineFeatures&& values) : features(std::move(values)) {}
  AffineFeatures features;
};

/// What SIFT is shown, and the pixels of the image that one of it has.
struct Shown {
  cv::Mat grey;
  double step_x = 1.0, step_y = 1.0;
};

Shown shown_of(const cv::Mat& grey, double megapixels) {
  const double pixels = static_cast<double>(grey.cols) * grey.rows;
  const double shrink = std::sqrt(megapixels * 1e6 / pixels);
  if (!(shrink < 1.0)) return {grey};
  Shown shown;
  cv::resize(grey, shown.grey, {}, shrink, shrink, cv::INTER_AREA);
  shown.step_x = static_cast<double>(grey.cols) / shown.grey.cols;
  shown.step_y = static_cast<double>(grey.rows) / shown.grey.rows;
  return shown;
}

AffineFrame to_frame(const cv::KeyPoint& key, const Shown& shown) {
  const double angle = static_cast<double>(key.angle) * kDegree;
  const double radius =
      0.5 * static_cast<double>(key.size) * std::sqrt(shown.step_x * shown.step_y);
  AffineFrame frame;
  // Pixels are counted from the middle of the first one.
  frame.centre = {(static_cast<double>(key.pt.x) + 0.5) * shown.step_x - 0.5,
                  (static_cast<double>(key.pt.y) + 0.5) * shown.step_y - 0.5};
  frame.shape << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  frame.shape *= radius;
  return frame;
}

}  // namespace

AffineFeatures detect_sift(const ImageView& image, const VlfeatOptions& options) {
  const cv::Mat grey(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                     static_cast<std::size_t>(image.stride));
  const auto sift = cv::SIFT::create(options.max_features, kOctaveLayers, kContrast,
                                     options.edge_threshold, kSigma);
  std::vector<cv::KeyPoint> keys;
  cv::Mat histograms;
  const Shown shown = shown_of(grey, options.sift_megapixels);
  sift->detectAndCompute(shown.grey, cv::noArray(), keys, histograms);
  AffineFeatures features;
  features.descriptors.resize(static_cast<Eigen::Index>(keys.size()), 128);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Eigen::Map<const Eigen::Matrix<float, 1, 128>> histogram(
        histograms.ptr<float>(static_cast<int>(i)));
    const float sum = histogram.sum();
    features.frames.push_back(to_frame(keys[i], shown));
    const auto row = static_cast<Eigen::Index>(i);
    if (sum > 0.0F) {
      features.descriptors.row(row) = (histogram / sum).cwiseMax(0.0F).cwiseSqrt();
    } else {
      features.descriptors.row(row).setZero();
    }
  }
  return features;
}

std::shared_ptr<const FrameFeatures> SiftExtractor::prepare(const ImageView& image) const {
  return std::make_shared<SiftFrame>(detect_sift(image, options_.vlfeat));
}

std::vector<AffineCorrespondence> SiftExtractor::correspond(const FrameFeatures& first,
                                                            const FrameFeatures& second) const {
  const auto& from = dynamic_cast<const SiftFrame&>(first);
  const auto& to = dynamic_cast<const SiftFrame&>(second);
  return match_features(from.features, to.features, options_.match);
}

}  // namespace oneac
