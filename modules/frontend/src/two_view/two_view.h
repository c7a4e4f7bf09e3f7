#pragma once

#include "course.h"

#include "oneac/features/correspondence.h"
#include "oneac/frontend/frame_result.h"
#include "oneac/geometry/relative_pose.h"
#include "oneac/initialisers/checked_answer.h"
#include "oneac/refine/two_view.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oneac {

struct FrontEndOptions;

/// What is known of a pair beside its correspondences.
struct TwoViewPrior {
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< of the first camera
  RelativePose expected;     ///< motion that goes on when the images do not tell; t of any length
  double focal_px = 1.0;     ///< [px] of one normalised unit
  std::uint64_t number = 0;  ///< of the pair in the drive: methods that draw at random differ by it
  Course course;             ///< of the vehicle, from the steps before
  MotionPrior motion;        ///< direction and length [camera heights] that inertia lets expect
  /// [m] of the landmarks among the correspondences, one each; empty where none is known in metres.
  PointDepths depths = {};
};

/// What two images alone say about the motion between them.
struct TwoView {
  StepStatus status = StepStatus::kPredicted;
  RelativePose pose;  ///< T_2_1, |t| = 1 or 0; of a predicted step the expected one
  /// Of (w, v): R ← exp([w]×) R, t/|t| ← t/|t| + v with v ⊥ t [rad²]; rank five with a direction,
  /// of w alone without, zero where nobody told. Of tracks that share no errors.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// What errors that neighbouring tracks share add to it, where it is stated.
  Eigen::Matrix<double, 6, 6> shared_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  TrackedPair pair;           ///< normalised, its second points corrected for perspective
  std::vector<bool> inliers;  ///< one per correspondence; empty when predicted
  std::optional<MotionEvidence> motion;  ///< where rest was in question
  bool kept_on_course = false;   ///< the images alone wanted a direction that no wheels take
  bool doubts_course = false;    ///< and were sure of it
  std::size_t inlier_count = 0;  ///< of inliers, where they are not empty
  double focal_px = 1.0;         ///< [px] of one normalised unit
  double estimate_ms = 0.0, refine_ms = 0.0;  ///< CPU time [ms]
  std::string fault;  ///< of the initialiser's answer, which is not used; "" as a rule

  /// Takes these for the inliers.
  void set_inliers(std::vector<bool> flags) {
    inliers = std::move(flags);
    inlier_count = static_cast<std::size_t>(std::count(inliers.begin(), inliers.end(), true));
  }
};

/// 1σ of a coordinate of a normalised correspondence; 0.25 px where its track does not say.
[[nodiscard]] inline double point_sigma(const Correspondence& ac, double focal_px) {
  constexpr double kUntold_px = 0.25;
  return ac.point_sigma > 0.0 ? ac.point_sigma : kUntold_px / focal_px;
}

/// Initialises, corrects for perspective, refines. Does not change from pair to pair.
class TwoViewEstimator {
 public:
  TwoViewEstimator(const FrontEndOptions& options, RelativePoseInitialiser::Ptr initialiser);

  /// @param pair  normalised
  [[nodiscard]] TwoView estimate(TrackedPair pair, const TwoViewPrior& prior) const;

 private:
  /// @param told  those to go by
  [[nodiscard]] CheckedAnswer initialise(const TrackedPair& pair, const std::vector<bool>& told,
                                         const TwoViewPrior& prior, double& cpu_ms) const;
  [[nodiscard]] TwoView refined(TwoView start) const;

  RelativePoseInitialiser::Ptr initialiser_;
  RefineOptions refine_;
  bool refine_enabled_;
  bool perspective_;
  double threshold_px_;
  std::uint64_t seed_;
};

/// Covariance of (w, v) from an information of rank five that knows nothing of v along t: zero
/// there. Zero for an information that is zero or not finite.
/// @param direction  t, not zero
[[nodiscard]] Eigen::Matrix<double, 6, 6> covariance_beside(
    const Eigen::Matrix<double, 6, 6>& information, const Eigen::Vector3d& direction);

}  // namespace oneac
