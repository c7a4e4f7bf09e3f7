#pragma once

#include "oneac/geometry/affine_correspondence.h"
#include "oneac/geometry/homography.h"
#include "oneac/study/experiment.h"
#include "oneac/study/noise.h"

#include <array>
#include <cstddef>
#include <optional>

namespace oneac {

/// One point of a sweep: the true motion and plane, and how noisy its correspondences are.
struct StudyScene {
  RelativePose T_2_1;  ///< |t| = kStudyBaseline
  Plane plane;         ///< at distance 1 from the first camera
  NoiseLevel noise;
  double vertical_deg = 0.0;  ///< 1σ of the levelling, pitch and roll [deg]
  bool same_level = false;    ///< both views are levelled with the same error, a mount's
  double focal_ratio = 1.0;   ///< assumed over true focal length
};

constexpr double kStudyBaseline = 0.1;   ///< [distances to the plane]
constexpr double kStudyHalfImage = 0.5;  ///< half a side of the image, 500 px [-]
constexpr double kStudyMaxDepth = 10.0;  ///< of a plane point [distances to the plane]
constexpr std::size_t kStudyPoints = 4;  ///< plane points per trial

/// The scene of an experiment at a value of its sweep.
[[nodiscard]] StudyScene scene_at(const Experiment& experiment, double value);

/// Four correspondences of points of the plane. The points are uniform over the first image
/// (1000×1000 px), as far as both cameras see them and they are not deeper than kStudyMaxDepth.
[[nodiscard]] std::array<AffineCorrespondence, kStudyPoints> draw_correspondences(
    const StudyScene& scene, NoiseShape shape, TrialRandom& random);

/// What is measured of the correspondences: levelled with a vertical that is a little wrong, over a
/// focal length that is. `scene` becomes the truth of the levelled views.
void measure(StudyScene& scene, std::array<AffineCorrespondence, kStudyPoints>& acs,
             TrialRandom& random);

/// Errors against the truth [rad].
struct TrialErrors {
  double rotation = 0.0;
  double translation = 0.0;
  double normal = 0.0;

  [[nodiscard]] double of(StudyMetric metric) const;
};

/// The errors of the candidate that is closest to the truth (least ξ_R + ξ_t), for every method
/// alike: whoever has two candidates is not charged for a choice that one more correspondence
/// makes. Empty when the method has no candidate.
[[nodiscard]] std::optional<TrialErrors> errors_of(StudyMethod method, DataUse use,
                                                   AcSpan correspondences, const StudyScene& scene);

}  // namespace oneac
