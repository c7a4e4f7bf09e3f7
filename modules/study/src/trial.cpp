#include "oneac/study/trial.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/angular_errors.h"

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

// A visible point is found in two or three tries; far more means that the scene shows no plane.
constexpr int kMaxTries = 100000;
// A sharp turn that slides to its outside: strength sin 10° sin 40° of the focal solver.
constexpr double kFocalTurnDeg = 10.0, kFocalHeadingDeg = -25.0;

[[nodiscard]] Eigen::Vector3d normal_at(StudySurface surface, double angle_deg) {
  if (surface == StudySurface::kGround) return Eigen::Vector3d::UnitY();
  if (surface == StudySurface::kSideWall) return Eigen::Vector3d::UnitX();
  const double angle = angle_deg * kDegree;  // 0 for a frontal wall
  return {std::sin(angle), 0.0, std::cos(angle)};
}

[[nodiscard]] NoiseLevel noise_at(StudySweep sweep, double value) {
  if (sweep == StudySweep::kNoise) return {value, 5.0 * value, 5.0 * value};
  if (sweep == StudySweep::kWallAngle) return {1.0, 5.0, 5.0};
  if (sweep == StudySweep::kSlope) return {0.2, 0.2, 0.2};  // a tracker's, aligned
  return {1.0, 1.0, 1.0};
}

[[nodiscard]] bool in_image(const Eigen::Vector2d& x) {
  return x.cwiseAbs().maxCoeff() <= kStudyHalfImage;
}

[[nodiscard]] Eigen::Vector2d draw_visible(const StudyScene& scene, const Eigen::Matrix3d& H,
                                           TrialRandom& random) {
  for (int i = 0; i < kMaxTries; ++i) {
    const double x = random.uniform(-kStudyHalfImage, kStudyHalfImage);
    Eigen::Vector2d x1(x, random.uniform(-kStudyHalfImage, kStudyHalfImage));
    const double inverse_depth = scene.plane.n.dot(x1.homogeneous()) / scene.plane.d;
    if (!(inverse_depth * kStudyMaxDepth >= 1.0)) continue;
    const Eigen::Vector3d mapped = H * x1.homogeneous();
    if (mapped.z() > 0.0 && in_image(mapped.hnormalized())) return x1;
  }
  throw std::logic_error("study: the cameras do not see the plane");
}

/// Uphill in views that are level: the road rises, the camera does not pitch with it.
void put_on_slope(double slope_percent, double vertical_deg, StudyScene& scene) {
  const double angle = std::atan(slope_percent / 100.0);
  scene.T_2_1.t = kStudyBaseline * Eigen::Vector3d(0.0, std::sin(angle), -std::cos(angle));
  scene.plane.n = {0.0, std::cos(angle), std::sin(angle)};
  scene.vertical_deg = vertical_deg;
}

/// A turn far off the circle that would hide the focal length.
void turn_with_wrong_focal(double error_percent, StudyScene& scene) {
  const double yaw = kFocalTurnDeg * kDegree, heading = kFocalHeadingDeg * kDegree;
  scene.T_2_1.R = yaw_rotation(std::cos(yaw), std::sin(yaw));
  scene.T_2_1.t = kStudyBaseline * Eigen::Vector3d(std::sin(heading), 0.0, -std::cos(heading));
  scene.focal_ratio = 1.0 + error_percent / 100.0;
}

}  // namespace

StudyScene scene_at(const Experiment& experiment, double value) {
  StudyScene scene;
  // Points move against the camera: a camera that moves forward sees t_z < 0.
  scene.T_2_1.t = experiment.motion == StudyMotion::kForward
                      ? Eigen::Vector3d(0.0, 0.0, -kStudyBaseline)
                      : Eigen::Vector3d(-kStudyBaseline, 0.0, 0.0);
  const double wall_angle = experiment.sweep == StudySweep::kWallAngle ? value : 0.0;
  scene.plane = {normal_at(experiment.surface, wall_angle), 1.0};
  scene.noise = noise_at(experiment.sweep, value);
  if (experiment.sweep == StudySweep::kSlope) put_on_slope(value, kKnownVerticalDeg, scene);
  scene.same_level = experiment.sweep == StudySweep::kSlope;
  if (experiment.sweep == StudySweep::kLevel) put_on_slope(kLevelSlope, value, scene);
  if (experiment.sweep == StudySweep::kFocal) turn_with_wrong_focal(value, scene);
  if (experiment.sweep == StudySweep::kTilt) {
    scene.T_2_1 =
        RelativePose{pitch_rotation(value * kDegree), Eigen::Vector3d::Zero()} * scene.T_2_1;
  }
  return scene;
}

std::array<AffineCorrespondence, kStudyPoints> draw_correspondences(const StudyScene& scene,
                                                                    NoiseShape shape,
                                                                    TrialRandom& random) {
  const Eigen::Matrix3d H = plane_induced_homography(scene.T_2_1, scene.plane);
  std::array<AffineCorrespondence, kStudyPoints> acs;
  for (AffineCorrespondence& ac : acs) {
    const Eigen::Vector2d x1 = draw_visible(scene, H, random);
    ac = noisy_correspondence(H, x1, scene.noise, shape, random);
  }
  return acs;
}

void measure(StudyScene& scene, std::array<AffineCorrespondence, kStudyPoints>& acs,
             TrialRandom& random) {
  if (scene.vertical_deg > 0.0) {
    const double sigma = scene.vertical_deg * kDegree;
    const auto wrong_level = [&] {
      const Eigen::Matrix3d pitch = pitch_rotation(random.normal(sigma));
      return Eigen::Matrix3d(pitch * roll_rotation(random.normal(sigma)));
    };
    const Eigen::Matrix3d Q1 = wrong_level(), own = wrong_level();
    const Eigen::Matrix3d& Q2 = scene.same_level ? Q1 : own;
    for (AffineCorrespondence& ac : acs) ac = rotate_views(ac, Q1, Q2).value_or(ac);
    scene.T_2_1 = {Q2 * scene.T_2_1.R * Q1.transpose(), Q2 * scene.T_2_1.t};
    scene.plane.n = Q1 * scene.plane.n;
  }
  for (AffineCorrespondence& ac : acs) {
    ac.x1 /= scene.focal_ratio;
    ac.x2 /= scene.focal_ratio;
  }
}

double TrialErrors::of(StudyMetric metric) const {
  if (metric == StudyMetric::kNormal) return normal;
  return metric == StudyMetric::kRotation ? rotation : translation;
}

std::optional<TrialErrors> errors_of(StudyMethod method, DataUse use, AcSpan correspondences,
                                     const StudyScene& scene) {
  std::optional<TrialErrors> best;
  for (const PlanePose& pose : candidates_of(method, correspondences, use)) {
    const TrialErrors errors{rotation_error(pose.motion.R, scene.T_2_1.R),
                             direction_error(pose.motion.t, scene.T_2_1.t),
                             normal_error(pose.n, scene.plane.n)};
    const bool closer =
        !best || errors.rotation + errors.translation < best->rotation + best->translation;
    if (closer) best = errors;
  }
  return best;
}

}  // namespace oneac
