#pragma once

#include "oneac/base/bound.h"
#include "oneac/base/image.h"
#include "oneac/features/ac_extractor.h"
#include "oneac/geometry/camera.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace oneac {

class Workers;

namespace internal {
struct ImagePyramid;
}

/// How the road between two images is aligned. validate() throws std::invalid_argument naming
/// field, value and bound.
struct RoadAlignmentOptions {
  double half_width = 2.0;       ///< [heights] of the strip looked at: a lane and its markings
  double nearest = 2.5;          ///< [heights] nearer, a step is hundreds of pixels
  double farthest = 12.0;        ///< [heights] farther, a pixel is half a height long
  double search_sigmas = 3.0;    ///< [-] around the prediction
  double min_correlation = 0.4;  ///< [-] of a block, without what is the same all along the road
  double max_rival = 0.8;     ///< [-] evidence of another length over that of the best: ambiguous
  int min_blocks = 4;         ///< of 15, that agree on the length
  double min_agreeing = 0.6;  ///< [-] share of the evidence of blocks that agree
  double noise_grey = 0.75;   ///< [grey levels] 1σ of a camera's pixel, smoothed
  double unevenness = 0.015;  ///< [-] 1σ of the length in one block: crown, ruts, bumps
  double heave = 0.006;       ///< [heights] 1σ of the camera's rise in a step: 1 cm on the springs
  double height_sigma = 0.012;         ///< [-] 1σ of the height itself, the same in all blocks
  double min_rotation_sigma = 0.0003;  ///< [rad] what calibration and rolling shutter leave
  double min_direction_sigma = 0.005;  ///< [rad]

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Describes every option to a visitor: visit(key, field, unit, reason).
template <class Visitor>
void describe(Visitor&& visit, RoadAlignmentOptions& o) {
  visit("half_width", o.half_width, "heights", "of the strip of road that is aligned",
        Bound::positive());
  visit("nearest", o.nearest, "heights", "nearest road that is aligned", Bound::positive());
  visit("farthest", o.farthest, "heights", "farthest road that is aligned");
  visit("search_sigmas", o.search_sigmas, "-", "lengths searched around the prediction",
        Bound::positive());
  visit("min_correlation", o.min_correlation, "-", "least correlation of a block of road",
        Bound::between(0, 1));
  visit("max_rival", o.max_rival, "-", "evidence of another length that makes it ambiguous",
        Bound::above_to(0, 1));
  visit("min_blocks", o.min_blocks, "count", "of 15 blocks of road that must agree",
        Bound::from_to(1, 15));
  visit("min_agreeing", o.min_agreeing, "-", "least share of the evidence that agrees",
        Bound::from_to(0, 1));
  visit("noise_grey", o.noise_grey, "grey", "1-sigma of a smoothed pixel", Bound::positive());
  visit("unevenness", o.unevenness, "-", "1-sigma of the length by one block of uneven road",
        Bound::positive());
  visit("heave", o.heave, "heights", "1-sigma of the camera's rise in a step", Bound::positive());
  visit("height_sigma", o.height_sigma, "-", "1-sigma of the camera's height in a step",
        Bound::at_least(0));
  visit("min_rotation_sigma", o.min_rotation_sigma, "rad", "least 1-sigma of a rotation given",
        Bound::positive());
  visit("min_direction_sigma", o.min_direction_sigma, "rad", "least 1-sigma of a direction given",
        Bound::positive());
}

/// An image made ready for aligning roads; keep that of the frame before. A cheap
/// value (shared, immutable).
class RoadImage {
 public:
  RoadImage() = default;
  /// @cost  about 1 ms for 1242×375; pure, to be called where images are prepared
  explicit RoadImage(const ImageView& image);
  /// A pyramid that is there already.
  explicit RoadImage(std::shared_ptr<const internal::ImagePyramid> pyramid);

  /// No image: default-constructed.
  [[nodiscard]] bool empty() const { return pyramid_ == nullptr; }
  [[nodiscard]] const internal::ImagePyramid& pyramid() const { return *pyramid_; }

 private:
  std::shared_ptr<const internal::ImagePyramid> pyramid_;
};

/// The image that features were found in; shares their pyramid where they have one.
[[nodiscard]] RoadImage road_image(const std::shared_ptr<const FrameFeatures>& features,
                                   const ImageView& image);

/// What is known of a step before its road is looked at.
struct RoadStep {
  RelativePose T_2_1;  ///< of the cameras; only the direction of t is used, whose sign counts
  /// Information (inverse covariance) of (w, v): R ← exp([w]×) R, t/|t| ← t/|t| + v [rad], as
  /// refine_two_view gives it.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< of the first view, to the road
  double pitch_sigma = 0.006;  ///< [rad] 1σ of that, springs and slope; less is not believed
  double roll_sigma = 0.01;    ///< [rad]
  double length = 0.0;         ///< [heights] predicted
  double length_sigma = 1e3;   ///< [heights]
  double min_length = 0.0;     ///< [heights] what inertia allows
  double max_length = 3.0;     ///< [heights]

  /// @throws std::invalid_argument naming field, value and bound
  void validate() const;
};

/// Information of a motion whose rotation and direction are known to these 1σ [rad] each.
[[nodiscard]] Eigen::Matrix<double, 6, 6> motion_information(double rotation_sigma,
                                                             double direction_sigma);

/// How an alignment of the road ended.
enum class RoadStatus {
  kMeasured,
  kNoRoad,         ///< too little of the strip is in both images and not masked
  kNoTexture,      ///< smooth concrete, overexposed or dark: no grey value changes along the road
  kNoCorrelation,  ///< texture, but no length makes the images alike: occluded, spray, no plane
  kAmbiguous,      ///< another length fits as well, or one against the direction better: repeats
  kOutOfRange,     ///< the best length lies at the end of what was searched
  kInconsistent,   ///< parts of the strip want different lengths: traffic, or not a plane
};
/// "measured", "no_road" and so on, for files.
[[nodiscard]] const char* to_string(RoadStatus status);

struct RoadAlignment {
  RoadStatus status = RoadStatus::kNoRoad;
  double length = 0.0;          ///< [heights] along the direction given; 0 unless measured; when
                                ///< standing negative by noise
  double sigma = 0.0;           ///< [heights] 1σ, everything included
  double relative_sigma = 0.0;  ///< [-] sigma / length; 0 for a length of 0
  RelativePose T_2_1;  ///< refined; t in camera heights; the pose given, |t| = 1, unless measured
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  ///< of the road in the first view, refined
  double roll = 0.0;          ///< [rad] by which the camera leans farther right than RoadStep said
  double roll_sigma = 0.0;    ///< [rad] 1σ, what RoadStep said included; 0 unless measured
  double correlation = 0.0;   ///< [-] mean over the agreeing blocks
  double rival = 0.0;         ///< [-] evidence of the second best length over that of the best
  double rival_length = 0.0;  ///< [heights] that length; 0: none
  double gain = 1.0;          ///< [-] second image over first, mean over the blocks
  double reach = 0.0;  ///< [heights] root mean square distance ahead of what tells the length
  int blocks = 0;      ///< that agree
  int textured = 0;    ///< blocks with texture
};

/// Two images of a road.
struct RoadViews {
  RoadImage first, second;
  ImageView mask = {};  ///< dark (< 128) where pixels of both are not used (bonnet); empty: all are
};

/// Length of a step in camera heights from all of the road that two images share.
///
/// Model: road n·X = 1 in the first view; H = R + |t| t̂ nᵀ; grey values of a block of road are the
/// same up to gain, a shift across the road, and a bias per line along it, so that lane lines and
/// shadows that run along the road or obliquely, which tell nothing, count nothing; slopes that
/// only one of the images has are noise, and count nothing either. Evidence of a length is the sum
/// over 15 blocks of ½ log 1/(1 − ρ²); its maximum is searched along |t|, then polished by
/// Gauss-Newton over |t|, n, R and t̂ with what is given as prior. Blocks that contradict (cars,
/// kerbs) lose their weight. See docs/decisions/road-alignment.md.
/// @param workers  who shares the work; none: the calling thread alone. The same to the last bit
/// @throws std::invalid_argument  images or mask of another size than the camera's, or a bad field
/// @cost   2 to 3 ms at 1242×375; pure, thread-safe, deterministic
[[nodiscard]] RoadAlignment align_road(const RoadViews& views, const PinholeCamera& camera,
                                       const RoadStep& step,
                                       const RoadAlignmentOptions& options = {},
                                       Workers* workers = nullptr);

}  // namespace oneac
