#include "oneac/study/noise.h"

#include "oneac/geometry/angles.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac {
namespace {

[[nodiscard]] Eigen::Matrix2d rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix2d R;
  R << c, -s, s, c;
  return R;
}

[[nodiscard]] double error_of(double level, NoiseShape shape, TrialRandom& random) {
  if (shape == NoiseShape::kNormal) return random.normal(level);
  return shape == NoiseShape::kFixed ? level * random.sign() : random.uniform(-level, level);
}

[[nodiscard]] Eigen::Vector2d point_error(double level, NoiseShape shape, TrialRandom& random) {
  if (shape == NoiseShape::kNormal) {
    const double u = random.normal(level);
    return {u, random.normal(level)};
  }
  const double direction = random.uniform(-kPi, kPi);
  return level * Eigen::Vector2d(std::cos(direction), std::sin(direction));
}

}  // namespace

Eigen::Matrix2d AffinityFactors::matrix() const {
  return rotation(first) * Eigen::Vector2d(large, small).asDiagonal() * rotation(second);
}

AffinityFactors affinity_factors(const Eigen::Matrix2d& A) {
  // A is the sum of a scaled rotation (e, h) and a scaled reflection (f, g).
  const double e = 0.5 * (A(0, 0) + A(1, 1)), f = 0.5 * (A(0, 0) - A(1, 1));
  const double g = 0.5 * (A(1, 0) + A(0, 1)), h = 0.5 * (A(1, 0) - A(0, 1));
  const double rotating = std::hypot(e, h), reflecting = std::hypot(f, g);
  const double sum = std::atan2(h, e), difference = std::atan2(g, f);
  return {0.5 * (sum + difference), rotating + reflecting, rotating - reflecting,
          0.5 * (sum - difference)};
}

Eigen::Matrix2d noisy_affinity(const Eigen::Matrix2d& A, const NoiseLevel& level, NoiseShape shape,
                               TrialRandom& random) {
  AffinityFactors factors = affinity_factors(A);
  const double angle = level.rotation_deg * kDegree;
  const double share = level.scale_percent / 100.0;
  const double error = error_of(angle, shape, random);
  factors.first += error;
  // The second rotation is Vᵀ: the same error on V counts the other way.
  factors.second += shape == NoiseShape::kCommon ? -error : error_of(angle, shape, random);
  factors.large *= 1.0 + error_of(share, shape, random);
  factors.small *= 1.0 + error_of(share, shape, random);
  return factors.matrix();
}

AffineCorrespondence noisy_correspondence(const Eigen::Matrix3d& H, const Eigen::Vector2d& x1,
                                          const NoiseLevel& level, NoiseShape shape,
                                          TrialRandom& random) {
  const Eigen::Vector3d mapped = H * x1.homogeneous();
  AffineCorrespondence ac;
  ac.x1 = x1;
  ac.x2 = mapped.hnormalized() + point_error(level.point_px, shape, random) / kStudyFocalPx;
  // eq. (5), solved for A: (H₂ₓ₂ − x2 (h7 h8)) / (h7 x + h8 y + h9).
  const Eigen::Matrix2d A =
      (H.topLeftCorner<2, 2>() - ac.x2 * H.bottomLeftCorner<1, 2>()) / mapped.z();
  ac.A = noisy_affinity(A, level, shape, random);
  return ac;
}

}  // namespace oneac
