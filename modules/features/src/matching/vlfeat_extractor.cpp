#include "oneac/features/vlfeat_extractor.h"

#include "oneac/features/descriptor_matching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

extern "C" {
#include <vl/covdet.h>
#include <vl/imopv.h>
#include <vl/sift.h>
}

namespace oneac {
namespace {

// SIFT on the normalised patch: 31×31 samples that reach 7.5 frame radii from the centre; the
// descriptor's 4 bins plus half a bin on either side fill it. Values of Lowe's descriptor in
// patch units.
constexpr int kPatchRadius = 15;
constexpr int kPatchSide = 2 * kPatchRadius + 1;
constexpr std::size_t kPatchPixels = std::size_t{kPatchSide} * std::size_t{kPatchSide};
constexpr vl_size kGradientStride = vl_size{2} * kPatchSide;  // modulus and angle interleaved
constexpr double kPatchExtent = 7.5;
constexpr double kPatchSmoothing = 1.0;
constexpr double kDescriptorMagnification = 3.0;
constexpr double kDescriptorBins = 4.0;

struct DeleteCovDet {
  void operator()(VlCovDet* detector) const { vl_covdet_delete(detector); }
};
struct DeleteSift {
  void operator()(VlSiftFilt* filter) const { vl_sift_delete(filter); }
};
using CovDet = std::unique_ptr<VlCovDet, DeleteCovDet>;
using Sift = std::unique_ptr<VlSiftFilt, DeleteSift>;

std::vector<float> to_unit_floats(const ImageView& image) {
  std::vector<float> pixels;
  pixels.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int v = 0; v < image.height; ++v) {
    const std::uint8_t* row = image.data + static_cast<std::ptrdiff_t>(v) * image.stride;
    for (int u = 0; u < image.width; ++u) pixels.push_back(static_cast<float>(row[u]) / 255.0F);
  }
  return pixels;
}

/// The strongest interest points, before the costly adaptation.
void keep_strongest(VlCovDet* detector, std::size_t count) {
  const std::size_t size = vl_covdet_get_num_features(detector);
  if (size <= count) return;
  auto* features = static_cast<VlCovDetFeature*>(vl_covdet_get_features(detector));
  std::vector<VlCovDetFeature> kept(features, features + size);
  std::stable_sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    return std::abs(a.peakScore) > std::abs(b.peakScore);
  });
  kept.resize(count);
  // covdet cannot shrink its list: moving the surplus outside the image drops it.
  std::copy(kept.begin(), kept.end(), features);
  for (std::size_t i = count; i < size; ++i) features[i].frame.x = -1e6F;
  vl_covdet_drop_features_outside(detector, 0.0);
}

/// RootSIFT of the patch under the frame: unit length, square roots of an L1-normalised histogram.
Eigen::Matrix<float, 1, 128> describe_patch(VlCovDet* detector, VlSiftFilt* sift,
                                            const VlFrameOrientedEllipse& frame) {
  std::array<float, kPatchPixels> patch{};
  std::array<float, 2 * kPatchPixels> gradient{};
  vl_covdet_extract_patch_for_frame(detector, patch.data(), kPatchRadius, kPatchExtent,
                                    kPatchSmoothing, frame);
  vl_imgradient_polar_f(gradient.data(), gradient.data() + 1, 2, kGradientStride, patch.data(),
                        kPatchSide, kPatchSide, kPatchSide);
  const double step = kPatchExtent / kPatchRadius;
  const double sigma =
      kPatchExtent / (kDescriptorMagnification * (kDescriptorBins + 1.0) / 2.0) / step;
  Eigen::Matrix<float, 1, 128> histogram;
  vl_sift_calc_raw_descriptor(sift, gradient.data(), histogram.data(), kPatchSide, kPatchSide,
                              kPatchRadius, kPatchRadius, sigma, 0.0);
  const float sum = histogram.sum();
  if (!(sum > 0.0F)) return Eigen::Matrix<float, 1, 128>::Zero();
  return (histogram / sum).cwiseMax(0.0F).cwiseSqrt();
}

AffineFrame to_frame(const VlFrameOrientedEllipse& frame) {
  AffineFrame out;
  out.centre = {static_cast<double>(frame.x), static_cast<double>(frame.y)};
  out.shape << static_cast<double>(frame.a11), static_cast<double>(frame.a12),
      static_cast<double>(frame.a21), static_cast<double>(frame.a22);
  return out;
}

class VlfeatFrame : public FrameFeatures {
 public:
  explicit VlfeatFrame(AffineFeatures&& values) : features(std::move(values)) {}
  AffineFeatures features;
};

}  // namespace

AffineFeatures detect_vlfeat(const ImageView& image, const VlfeatOptions& options) {
  const CovDet detector(vl_covdet_new(VL_COVDET_METHOD_DOG));
  vl_covdet_set_first_octave(detector.get(), options.first_octave);
  vl_covdet_set_peak_threshold(detector.get(), options.peak_threshold);
  vl_covdet_set_edge_threshold(detector.get(), options.edge_threshold);
  const std::vector<float> pixels = to_unit_floats(image);
  vl_covdet_put_image(detector.get(), pixels.data(), static_cast<vl_size>(image.width),
                      static_cast<vl_size>(image.height));
  vl_covdet_detect(detector.get());
  keep_strongest(detector.get(), static_cast<std::size_t>(options.max_features));
  vl_covdet_extract_affine_shape(detector.get());
  vl_covdet_extract_orientations(detector.get());

  const std::size_t count = vl_covdet_get_num_features(detector.get());
  const auto* found = static_cast<const VlCovDetFeature*>(vl_covdet_get_features(detector.get()));
  const Sift sift(vl_sift_new(16, 16, 1, 3, 0));
  vl_sift_set_magnif(sift.get(), kDescriptorMagnification);
  AffineFeatures features;
  features.frames.reserve(count);
  features.descriptors.resize(static_cast<Eigen::Index>(count), 128);
  for (std::size_t i = 0; i < count; ++i) {
    features.frames.push_back(to_frame(found[i].frame));
    features.descriptors.row(static_cast<Eigen::Index>(i)) =
        describe_patch(detector.get(), sift.get(), found[i].frame);
  }
  return features;
}

std::shared_ptr<const FrameFeatures> VlfeatExtractor::prepare(const ImageView& image) const {
  return std::make_shared<VlfeatFrame>(detect_vlfeat(image, options_.vlfeat));
}

std::vector<AffineCorrespondence> VlfeatExtractor::correspond(const FrameFeatures& first,
                                                              const FrameFeatures& second) const {
  const auto& from = dynamic_cast<const VlfeatFrame&>(first);
  const auto& to = dynamic_cast<const VlfeatFrame&>(second);
  return match_features(from.features, to.features, options_.match);
}

}  // namespace oneac
