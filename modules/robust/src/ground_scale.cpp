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
#include <limits>

namespace oneac {
namespace {

constexpr double kPlaneCut = 2.5;     // [bandwidths] scale of the loss and bound of the support
constexpr int kPlaneIterations = 10;  // IRLS; the weights converge after four to six
// Smallest height of the camera above a ground point [baselines]: a step of more than 20 camera
// heights, 30 m from one frame to the next, is not driving.
constexpr double kSmallestHeight = 0.05;
// [-] Frobenius error of an affinity that counts as one when road and wall are compared, and how
// many of them count at most: then it says nothing more.
constexpr double kAffineError = 0.1, kMostErrors = 3.0;
// [-] of max_side: how far from the way a camera that looks more than 25° aside looks for road.
// That are two lanes; then comes the kerb, with roofs of parked vans before a high camera.
constexpr double kAside = 2.0;
const double kAhead = std::cos(25.0 * kDegree);

double squared(double value) {
  return value * value;
}

/// A correspondence that may lie on the ground, in the levelled first frame, unit: baselines.
struct Candidate {
  Eigen::Vector3d X;
  double relative_sigma;  ///< of its depth, hence of its height
  double weight;          ///< how well its affinity fits a horizontal plane, 0 … 1
  /// By how much its affinity fits a wall across and a wall along the way worse than the road.
  Eigen::Array2d against_wall;
  bool beside;  ///< the way turns off before it
};

/// Relative error of the depth: position noise over the shift that the translation causes.
double depth_sigma(const RelativePose& T, const AffineCorrespondence& ac, double z1, double sigma) {
  const Eigen::Vector3d rotated = T.R * ac.x1.homogeneous();
  const Eigen::Vector2d at_infinity = rotated.head<2>() / rotated.z();
  const double shift = (ac.x2 - at_infinity).norm();
  return shift > 0.0 && z1 > 0.0 ? sigma * std::sqrt(2.0) / shift : 1e9;
}

/// Frobenius error of an affinity against that of a plane through the point; infinite where such a
/// plane shows none.
/// @param X       the point in the camera frame, in the unit of T.t
/// @param normal  of the plane there, of either sign
double affine_error(const RelativePose& T, const AffineCorrespondence& ac, const Eigen::Vector3d& X,
                    const Eigen::Vector3d& normal) {
  const double distance = normal.dot(X);
  const Plane plane{distance < 0.0 ? Eigen::Vector3d(-normal) : normal, std::abs(distance)};
  if (!(plane.d > 0.0)) return std::numeric_limits<double>::infinity();
  const auto predicted = correspondence_from_homography(plane_induced_homography(T, plane), ac.x1);
  return predicted ? (predicted->A - ac.A).norm() : std::numeric_limits<double>::infinity();
}

double misfit(double affine_error) {
  return squared(std::min(affine_error / kAffineError, kMostErrors));
}

/// Normals in the camera frame: of the road, of walls across and along the way.
struct Normals {
  Eigen::Vector3d down, across, along;
  bool looks_aside;  ///< more than 25° off the way

  Normals(const RelativePose& T, const Eigen::Matrix3d& L) : down(L.row(1).transpose()) {
    const Eigen::Vector3d way = T.R.transpose() * T.t;
    across = way - way.dot(down) * down;
    if (!(across.norm() > 0.5 * way.norm())) across = L.row(2).transpose();  // a lift has no way
    across.normalize();
    along = down.cross(across);
    looks_aside = std::abs(L.row(2).dot(across)) < kAhead;
  }
};

std::vector<Candidate> ground_candidates(AcSpan acs, const std::vector<bool>& inliers,
                                         const RelativePose& T, const Eigen::Matrix3d& L,
                                         double sigma, const GroundScaleOptions& options) {
  const Normals normals(T, L);
  const DrivenPath path(T, L);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (!inliers[i]) continue;
    const auto point = triangulate(T, acs[i].x1, acs[i].x2);
    if (!point || !point->in_front()) continue;
    const Eigen::Vector3d seen = point->z1 * acs[i].x1.homogeneous();
    const Eigen::Vector3d X = L * seen;
    if (!(X.y() > kSmallestHeight)) continue;
    if (X.z() > options.max_distance * X.y()) continue;
    const double side = options.max_side * X.y();
    if (std::abs(X.x()) > side) continue;
    if (normals.looks_aside && std::abs(normals.along.dot(seen)) > kAside * side) continue;
    const auto middle = path.at(X.z());
    const bool beside = !middle || std::abs(X.x() - *middle) > side;
    const double relative_sigma = depth_sigma(T, acs[i], point->z1, sigma);
    if (!(relative_sigma < 0.3)) continue;  // no parallax
    const double error = affine_error(T, acs[i], seen, normals.down);
    const double weight = std::exp(-0.5 * squared(error / options.affine_tolerance));
    if (!(weight > 0.01)) continue;
    const Eigen::Array2d walls(misfit(affine_error(T, acs[i], seen, normals.across)),
                               misfit(affine_error(T, acs[i], seen, normals.along)));
    candidates.push_back({X, relative_sigma, weight, walls - misfit(error), beside});
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
  Eigen::Array2d against_wall = Eigen::Array2d::Zero();  ///< of the support together

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
    plane.against_wall.setZero();
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
      if (!(std::abs(z) < kPlaneCut && c.weight > 0.3)) continue;
      ++plane.support;
      plane.against_wall += c.against_wall;
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
  // The rear of a parked car has points at every height, some of which lie on any plane.
  if (plane.against_wall.minCoeff() < 0.0) return std::nullopt;
  const double distance = plane.distance();
  if (!(distance > kSmallestHeight) || !std::isfinite(distance)) return std::nullopt;
  const double uncertainty = std::sqrt(plane.variance_factor * plane.variance) / plane.d;
  if (!(uncertainty < options.max_uncertainty)) return std::nullopt;
  return GroundScale{T_2_1.t.norm() / distance,
                     std::hypot(uncertainty, DrivenPath::kKerb * plane.beside),
                     plane.reach / distance, plane.support};
}

}  // namespace oneac
