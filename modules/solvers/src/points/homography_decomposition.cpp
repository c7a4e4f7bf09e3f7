#include "oneac/solvers/homography_decomposition.h"

#include "math/normalisation.h"
#include "points/homography_scale.h"

#include <Eigen/Dense>

#include <cmath>

namespace oneac {
namespace {

// Spread of the squared singular values below which H is a rotation.
constexpr double kRotation = 1e-9;
// Smallest singular value, as a share of the largest, of a homography that can be inverted.
constexpr double kSingular = 1e-9;
// Middle singular value, as a share of the largest: about 1 / |t|, t in units of the plane's
// distance. R's error is the rounding times its inverse squared: 1e-8 at this share.
constexpr double kFarthest = 1e-4;

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// One of the two decompositions: the plane is orthogonal to n = v2 × u, where u keeps its length
/// under H.
[[nodiscard]] PlanePose along(const Matrix3d& H, const Vector3d& v2, const Vector3d& u) {
  Matrix3d U, W;
  U.col(0) = v2;
  U.col(1) = u;
  U.col(2) = v2.cross(u);
  W.col(0) = H * v2;
  W.col(1) = H * u;
  W.col(2) = W.col(0).cross(W.col(1));
  PlanePose pose;
  pose.motion.R = W * U.transpose();
  pose.n = U.col(2);
  pose.motion.t = (H - pose.motion.R) * pose.n;
  return pose;
}

}  // namespace

SolutionSet<PlanePose, 4> decompose_homography(const Matrix3d& H_any_scale) {
  SolutionSet<PlanePose, 4> poses;
  if (!H_any_scale.allFinite()) return poses;
  const double size = H_any_scale.norm();
  if (!(size > 1e-150)) return poses;
  const Matrix3d unit = H_any_scale / size;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(unit.transpose() * unit);
  const Vector3d& values = eigen.eigenvalues();
  if (!(values(0) > kSingular * kSingular * values(2))) return poses;
  const double middle = values(1);
  if (!(middle > kFarthest * kFarthest * values(2))) return poses;
  const Matrix3d H = unit / std::sqrt(middle);
  const double s1 = values(2) / middle, s3 = values(0) / middle;  // squared, s3 ≤ 1 ≤ s1
  if (!(s1 - s3 > kRotation)) return poses;
  const Vector3d v1 = eigen.eigenvectors().col(2);
  const Vector3d v2 = eigen.eigenvectors().col(1);
  const Vector3d v3 = eigen.eigenvectors().col(0);
  const double a = std::sqrt(std::max(1.0 - s3, 0.0) / (s1 - s3));
  const double b = std::sqrt(std::max(s1 - 1.0, 0.0) / (s1 - s3));
  for (const double sign : {1.0, -1.0}) {
    const PlanePose pose = along(H, v2, a * v1 + sign * b * v3);
    if (!pose.motion.is_finite()) continue;
    poses.push_back(pose);
    poses.push_back({{pose.motion.R, -pose.motion.t}, -pose.n});
  }
  return poses;
}

SolutionSet<PlanePose, 2> poses_from_homography(const Matrix3d& H, AcSpan points) {
  SolutionSet<PlanePose, 2> selected;
  if (points.empty()) return selected;
  for (const PlanePose& pose : decompose_homography(H)) {
    int votes = 0;
    const Matrix3d G = pose.motion.R + pose.motion.t * pose.n.transpose();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!internal::has_points(points[i])) continue;
      const bool first = pose.n.dot(points[i].x1.homogeneous()) > 0.0;
      const bool second = G.row(2).dot(points[i].x1.homogeneous()) > 0.0;
      votes += first && second ? 1 : -1;
    }
    if (votes > 0 && selected.size() < 2) selected.push_back(pose);
  }
  return selected;
}

namespace internal {

SolutionSet<Matrix3d, 1> scaled_homography(const Matrix3d& H, AcSpan acs, const double* weights) {
  const double size = H.norm();
  if (!(size > 1e-150) || !std::isfinite(size)) return {};
  const Matrix3d unit = H / size;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(unit.transpose() * unit,
                                                      Eigen::EigenvaluesOnly);
  const Vector3d& values = eigen.eigenvalues();
  if (!(values(0) > kSingular * kSingular * values(2))) return {};
  if (!(values(2) - values(0) > kRotation * values(1))) return {};  // a rotation: no plane seen
  int votes = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!takes_part(acs, weights, i)) continue;
    votes += acs[i].x2.homogeneous().dot(unit * acs[i].x1.homogeneous()) > 0.0 ? 1 : -1;
  }
  const double sign = votes >= 0 ? 1.0 : -1.0;
  const Matrix3d scaled = unit * (sign / std::sqrt(values(1)));
  if (!scaled.allFinite() || !(scaled.determinant() > 0.0)) return {};  // mirrored
  return scaled;
}

}  // namespace internal
}  // namespace oneac
