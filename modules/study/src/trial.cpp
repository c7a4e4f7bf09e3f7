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

[[nodiscard]] Eigen::Vector3d normal_at(StudySurface surface, double angle_deg) {
  if (surface == StudySurface::kGround) return Eigen::Vector3d::UnitY();
  if (surface == StudySurface::kSideWall) return Eigen::Vector3d::UnitX();
  const double angle = angle_deg * kDegree;  // 0 for a frontal wall
  return {std::sin(angle), 0.0, std::cos(angle)};
}

[[nodiscard]] NoiseLevel noise_at(StudySweep sweep, double value) {
  if (sweep == StudySweep::kNoise) return {value, 5.0 * value, 5.0 * value};
  if (sweep == StudySweep::kTilt) return {1.0, 1.0, 1.0};
  return {1.0, 5.0, 5.0};
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
