#include "oneac/robust/ground_scale.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/driven_path.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/robust_loss.h"
#include "oneac/geometry/triangulation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

constexpr double kPlaneCut = 2.5;     // [bandwidths] scale of the loss and bound of the support
constexpr int kPlaneIterations = 10;  // IRLS; the weights converge after four to six
// Smallest height of the camera above a ground point [baselines]: a step of more than 20 camera
// heights, 30 m from one frame to the next, is not driving.
constexpr double kSmallestHeight = 0.05;

double squared(double value) {
  return value * value;
}

/// A correspondence that may lie on the ground, in the levelled first frame, unit: baselines.
struct Candidate {
  Eigen::Vector3d X;
  double relative_sigma;  ///< of its depth, hence of its height
  double weight;          ///< how well its affinity fits a horizontal plane, 0 … 1
  bool beside;            ///< the way turns off before it
};

/// Relative error of the depth: position noise over the shift that the translation causes.
double depth_sigma(const RelativePose& T, const AffineCorrespondence& ac, double z1, double sigma) {
  const Eigen::Vector3d rotated = T.R * ac.x1.homogeneous();
  const Eigen::Vector2d at_infinity = rotated.head<2>() / rotated.z();
  const double shift = (ac.x2 - at_infinity).norm();
  return shift > 0.0 && z1 > 0.0 ? sigma * std::sqrt(2.0) / shift : 1e9;
}

/// 1 for an affinity that the horizontal plane through the point explains, falling to 0.
double affine_agreement(const RelativePose& T, const AffineCorrespondence& ac,
                        const Eigen::Vector3d& down, double height, double tolerance) {
  const auto predicted =
      correspondence_from_homography(plane_induced_homography(T, {down, height}), ac.x1);
  if (!predicted) return 0.0;
  const double error = (predicted->A - ac.A).norm() / tolerance;
  return std::exp(-0.5 * error * error);
}

std::vector<Candidate> ground_candidates(AcSpan acs, const std::vector<bool>& inliers,
                                         const RelativePose& T, const Eigen::Matrix3d& L,
                                         double sigma, const GroundScaleOptions& options) {
  const Eigen::Vector3d down = L.row(1).transpose();  // levelled Y in the camera frame
  const DrivenPath path(T, L);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!inliers[i]) continue;
    const auto point = triangulate(T, acs[i].x1, acs[i].x2);
    if (!point || !point->in_front()) continue;
    const Eigen::Vector3d X = L * (point->z1 * acs[i].x1.homogeneous());
    if (!(X.y() > kSmallestHeight)) continue;
    if (X.z() > options.max_distance * X.y()) continue;
    const double side = options.max_side * X.y();
    if (std::abs(X.x()) > side) continue;
    const auto middle = path.at(X.z());
    const bool beside = !middle || std::abs(X.x() - *middle) > side;
    const double relative_sigma = depth_sigma(T, acs[i], point->z1, sigma);
    if (!(relative_sigma < 0.3)) continue;  // no parallax
    const double weight = affine_agreement(T, acs[i], down, X.y(), options.affine_tolerance);
    if (weight > 0.01) candidates.push_back({X, relative_sigma, weight, beside});
  }
  return candidates;
}

/// Height of the heaviest horizontal plane: mode of a Gaussian kernel density over log Y.
double heaviest_height(const std::vector<Candidate>& candidates, double bandwidth) {
  double best = 0.0;
  double best_density = -1.0;
  for (const Candidate& centre : candidates) {
    double density = 0.0;
    for (const Candidate& c : candidates) {
      const double width = std::hypot(bandwidth, c.relative_sigma);
      const double z = std::log(c.X.y() / centre.X.y()) / width;
      density += c.weight * std::exp(-0.5 * z * z) * bandwidth / width;
    }
    if (density <= best_density) continue;
    best_density = density;
    best = centre.X.y();
  }
  return best;
}

/// Y = d + a X + b Z in the levelled frame.
struct RoadPlane {
  double d = 0.0, a = 0.0, b = 0.0;
  double variance = 0.0;         ///< of d by the assumed noise
  double variance_factor = 1.0;  ///< how much more the residuals scatter
  double beside = 0.0;           ///< share of the support that the car does not drive on
  double reach = 0.0;            ///< root mean square distance ahead of the support
  std::size_t support = 0;

  [[nodiscard]] double height_at(const Eigen::Vector3d& X) const {
    return d + a * X.x() + b * X.z();
  }
  [[nodiscard]] double distance() const { return d / std::sqrt(1.0 + a * a + b * b); }
};

/// Iteratively reweighted least squares with a Geman–McClure weight.
RoadPlane fit_plane(const std::vector<Candidate>& candidates, double height,
                    const GroundScaleOptions& options) {
  RoadPlane plane;
  plane.d = height;
  const Eigen::Vector3d prior(0.0, 1.0 / squared(options.cross_fall_deg * kDegree),
                              1.0 / squared(options.plane_tilt_deg * kDegree));
  Eigen::LDLT<Eigen::Matrix3d> factor;
  for (int iteration = 0; iteration < kPlaneIterations; ++iteration) {
    Eigen::Matrix3d H = prior.asDiagonal();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    double chi2 = 0.0;
    double weights = 0.0, beside = 0.0, ahead = 0.0;
    plane.support = 0;
    for (const Candidate& c : candidates) {
      // Y, X, Z all scale with the depth, so the error of the residual is that of the depth times
      // the plane's height.
      const double width = std::hypot(options.bandwidth, c.relative_sigma) * plane.d;
      const double z = (c.X.y() - plane.height_at(c.X)) / width;
      const double robust = c.weight / geman_mcclure_divisor(z * z, squared(kPlaneCut));
      const Eigen::Vector3d row(1.0, c.X.x(), c.X.z());
      H += robust / (width * width) * row * row.transpose();
      g += robust / (width * width) * row * c.X.y();
      chi2 += robust * z * z;
      weights += robust;
      if (c.beside) beside += robust;
      ahead += robust * squared(c.X.z());
      if (std::abs(z) < kPlaneCut && c.weight > 0.3) ++plane.support;
    }
    factor.compute(H);
    const Eigen::Vector3d solution = factor.solve(g);
    if (!solution.allFinite() || !(solution(0) > kSmallestHeight)) return {};
    plane.d = solution(0);
    plane.a = solution(1);
    plane.b = solution(2);
    plane.variance_factor = weights > 0.0 ? std::max(chi2 / weights, 0.1) : 1.0;
    plane.beside = weights > 0.0 ? beside / weights : 0.0;
    plane.reach = weights > 0.0 ? std::sqrt(ahead / weights) : 0.0;
  }
  const Eigen::Matrix3d covariance = factor.solve(Eigen::Matrix3d::Identity());
  plane.variance = covariance(0, 0);
  return plane;
}

}  // namespace

void GroundScaleOptions::validate() const {
  check_bounds("ground_scale", *this);
}

std::optional<GroundScale> ground_scale(AcSpan acs, const std::vector<bool>& inliers,
                                        const RelativePose& T_2_1,
                                        const Eigen::Matrix3d& R_level_cam, double sigma,
                                        const GroundScaleOptions& options) {
  if (!(T_2_1.t.norm() > 0.0)) return std::nullopt;
  const std::vector<Candidate> candidates =
      ground_candidates(acs, inliers, T_2_1, R_level_cam, sigma, options);
  if (candidates.size() < static_cast<std::size_t>(options.min_support)) return std::nullopt;
  const double height = heaviest_height(candidates, options.bandwidth);
  const RoadPlane plane = fit_plane(candidates, height, options);
  if (plane.support < static_cast<std::size_t>(options.min_support)) return std::nullopt;
  const double distance = plane.distance();
  if (!(distance > kSmallestHeight) || !std::isfinite(distance)) return std::nullopt;
  const double uncertainty = std::sqrt(plane.variance_factor * plane.variance) / plane.d;
  if (!(uncertainty < options.max_uncertainty)) return std::nullopt;
  return GroundScale{T_2_1.t.norm() / distance,
                     std::hypot(uncertainty, DrivenPath::kKerb * plane.beside),
                     plane.reach / distance, plane.support};
}

}  // namespace oneac
