#include "by_depths.h"

#include "below_the_sky.h"

#include "oneac/geometry/angles.h"
#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/robust_loss.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// [m] A longer step has parallax enough for its two views alone.
constexpr double kShort = 0.2;
// [px] what the σ of a track does not know of.
constexpr double kLeastSigma_px = 0.1;
// [1/m] of a point without a depth: it lies somewhere beyond 25 m, if it does not lie on the road.
constexpr double kFar = 0.02;
// Points that overdetermine six unknowns, and those of them that know metres.
constexpr std::size_t kFewest = 20, kFewestNear = 6;
constexpr double kMajority = 0.5;
constexpr double kCut = 3.0;     // [σ] scale of the loss at the end ...
constexpr double kWidest = 8.0;  // [-] ... and at the start, over that
constexpr int kIterations = 14;  // the last eight at the final scale
// Steps, the first at the widest scale, after which a way that far beyond kShort is taken for one:
// the rest would have to bring it back to a fifth.
constexpr int kFirstLook = 4;
constexpr double kFarBeyond = 5.0;  // [-]
constexpr double kMoves = 3.0;      // [σ] of a translation that is one
constexpr double kRocks = 0.005;    // [m] less is that of a body on its springs
// Wheels roll along the car, and a camera ahead of the rear axle swings by tan⁻¹(2 m / 4 m).
constexpr double kSwing = 30.0 * kDegree;
// Nor does a car turn on the spot: [m] the tightest bend of a camera's way, [rad] a turn's noise.
constexpr double kTightest = 3.0;
constexpr double kTurnNoise = 0.002;

/// A point by its ray and inverse depth in the second view, and where the first one sees it.
struct Point {
  Eigen::Vector3d ray;                        ///< z = 1
  Eigen::Vector2d x;                          ///< normalised, in the first
  double sigma;                               ///< 1σ of that [-]
  double inverse_depth, inverse_depth_sigma;  ///< [1/m]
  bool near;                                  ///< its depth was measured
  std::size_t index;                          ///< in the pair
};

/// What one iteration leaves.
struct Equations {
  Matrix6 H = Matrix6::Zero();
  Vector6 g = Vector6::Zero();
  std::size_t agreeing = 0, near = 0;
  double chi2 = 0.0;  ///< of those
};

std::vector<Point> points_of(const TwoView& seen, const PointDepths& depths,
                             const std::vector<bool>& below) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < seen.pair.size(); ++i) {
    const Correspondence& ac = seen.pair.correspondences[i];
    const bool near = depths[i] && depths[i]->z > 0.0;
    if (!near && !below[i]) continue;
    const double track = point_sigma(ac, seen.focal_px);
    Point point{ac.x2.homogeneous(),
                ac.x1,
                std::hypot(track, kLeastSigma_px / seen.focal_px),
                kFar,
                kFar,
                near,
                i};
    if (near) {
      point.inverse_depth = 1.0 / depths[i]->z;
      point.inverse_depth_sigma = depths[i]->sigma / depths[i]->z;
    }
    points.push_back(point);
  }
  return points;
}

/// Adds a point. @return its squared distance [σ²], infinite behind the camera
double add(const RelativePose& T, const Point& point, double squared_scale, Equations& sums) {
  const Eigen::Vector3d from = point.ray - point.inverse_depth * T.t;
  const Eigen::Matrix3d back = T.R.transpose();
  const Eigen::Vector3d P = back * from;
  if (!(P.z() > 0.1)) return std::numeric_limits<double>::infinity();
  Eigen::Matrix<double, 2, 3> project;
  project << 1.0 / P.z(), 0.0, -P.x() / (P.z() * P.z()), 0.0, 1.0 / P.z(), -P.y() / (P.z() * P.z());
  const Eigen::Matrix<double, 2, 3> by_point = project * back;
  const Eigen::Vector2d along = by_point * T.t * point.inverse_depth_sigma;
  const Eigen::Matrix2d covariance =
      point.sigma * point.sigma * Eigen::Matrix2d::Identity() + along * along.transpose();
  const Eigen::Matrix2d information = covariance.inverse();
  const Eigen::Vector2d r = P.hnormalized() - point.x;
  const double squared = r.dot(information * r);
  // R ← exp([w]×) R and t ← t + v take P by Rᵀ ([ray − ρ t]× w − ρ v).
  Eigen::Matrix<double, 2, 6> J;
  J << by_point * cross_matrix(from), -point.inverse_depth * by_point;
  const double weight = geman_mcclure_weight(squared, squared_scale);
  sums.H += weight * J.transpose() * information * J;
  sums.g += weight * J.transpose() * (information * r);
  return squared;
}

/// The motion and what it rests on.
struct MotionByDepths {
  RelativePose T_2_1;                    ///< t [m]
  Matrix6 covariance = Matrix6::Zero();  ///< of (w [rad], t [m])
  std::vector<bool> agrees;              ///< one per point
};

std::optional<MotionByDepths> solve(const std::vector<Point>& points, const Eigen::Matrix3d& R) {
  MotionByDepths motion;
  motion.T_2_1 = {R, Eigen::Vector3d::Zero()};
  motion.agrees.assign(points.size(), false);
  Equations sums;
  Eigen::LDLT<Matrix6> factor;
  for (int i = 0; i < kIterations; ++i) {
    const double wide = std::max(1.0, kWidest * std::pow(0.7, i));
    sums = {};
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double squared = add(motion.T_2_1, points[k], kCut * kCut * wide * wide, sums);
      motion.agrees[k] = squared < kCut * kCut;
      if (!motion.agrees[k]) continue;
      ++sums.agreeing;
      if (points[k].near) ++sums.near;
      sums.chi2 += squared;
    }
    factor.compute(sums.H);
    const Vector6 step = -factor.solve(sums.g);
    if (factor.info() != Eigen::Success || !step.allFinite()) return std::nullopt;
    motion.T_2_1.R = rotation_from_vector(step.head<3>()) * motion.T_2_1.R;
    motion.T_2_1.t += step.tail<3>();
    if (i + 1 == kFirstLook && motion.T_2_1.t.norm() > kFarBeyond * kShort) return std::nullopt;
  }
  const auto agreeing = static_cast<double>(sums.agreeing);
  if (sums.agreeing < kFewest || sums.near < kFewestNear ||
      agreeing < kMajority * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  const double scatter = std::max(1.0, sums.chi2 / std::max(2.0 * agreeing - 6.0, 1.0));
  motion.covariance = scatter * factor.solve(Matrix6::Identity());
  if (!motion.covariance.allFinite() || !motion.T_2_1.is_finite()) return std::nullopt;
  return motion;
}

/// [m] 1σ of the translation along itself.
double sigma_along(const MotionByDepths& motion) {
  const Eigen::Vector3d along = motion.T_2_1.t.normalized();
  return std::sqrt(std::max(along.dot(motion.covariance.bottomRightCorner<3, 3>() * along), 0.0));
}

/// [m] 1σ of the translation across itself, root mean square of the two.
double sigma_across(const MotionByDepths& motion) {
  const double along = sigma_along(motion);
  const double trace = motion.covariance.bottomRightCorner<3, 3>().trace();
  return std::sqrt(std::max(0.5 * (trace - along * along), 0.0));
}

/// Whether wheels allow it; a bus that fills the street moves otherwise.
bool is_of_a_car(const MotionByDepths& motion, const Eigen::Vector3d& course,
                 const Eigen::Vector3d& down) {
  const Eigen::Vector3d& t = motion.T_2_1.t;
  const double sigma = sigma_along(motion);
  const Eigen::AngleAxisd turn(motion.T_2_1.R);
  const double yaw = std::abs(turn.angle() * turn.axis().dot(down));
  if (yaw > (t.norm() + kMoves * sigma) / kTightest + kTurnNoise) return false;
  if (!(t.norm() > kMoves * sigma) || !(course.norm() > 0.0)) return true;
  const double off = direction_error(t, course);
  const double least = std::min(off, kPi - off);  // a car that reverses
  return least <= kSwing + kMoves * sigma_across(motion) / t.norm();
}

/// Covariance of (w, t/|t|) from that of (w, t).
Matrix6 of_direction(const Matrix6& covariance, const Eigen::Vector3d& t) {
  const Eigen::Vector3d along = t.normalized();
  Matrix6 map = Matrix6::Identity();
  map.bottomRightCorner<3, 3>() =
      (Eigen::Matrix3d::Identity() - along * along.transpose()) / t.norm();
  return map * covariance * map.transpose();
}

/// Whether two views alone say the same, and are surer of the direction. Depths are those of the
/// map, and what is wrong with it they hand on from step to step.
bool know_better(const TwoView& seen, const MotionByDepths& motion) {
  if (seen.status != StepStatus::kOk) return false;
  const Eigen::Vector3d& t = motion.T_2_1.t;
  const double alone = seen.covariance.bottomRightCorner<3, 3>().trace();
  const double by_depths = of_direction(motion.covariance, t).bottomRightCorner<3, 3>().trace();
  const bool same = direction_error(seen.pose.t, t) < kMoves * std::sqrt(alone + by_depths);
  return same && alone > 0.0 && alone < by_depths;
}

}  // namespace

TwoView creeping_by_depths(TwoView seen, const PointDepths& depths, const TwoViewPrior& prior,
                           double threshold_px) {
  if (seen.status != StepStatus::kOk && seen.status != StepStatus::kNoMotion) return seen;
  const std::vector<bool> below = below_the_sky(seen.pair, prior.R_level_cam);
  if (below.empty()) return seen;
  const std::vector<Point> points = points_of(seen, depths, below);
  const auto near =
      std::count_if(points.begin(), points.end(), [](const Point& p) { return p.near; });
  if (points.size() < kFewest || near < static_cast<std::ptrdiff_t>(kFewestNear)) return seen;
  const auto motion = solve(points, seen.pose.R);
  if (!motion || motion->T_2_1.t.norm() > kShort) return seen;
  if (!is_of_a_car(*motion, prior.course.direction, prior.R_level_cam.row(1))) return seen;
  const bool moves = motion->T_2_1.t.norm() > std::max(kRocks, kMoves * sigma_along(*motion));
  if (moves && know_better(seen, *motion)) return seen;
  seen.status = moves ? StepStatus::kOk : StepStatus::kNoMotion;
  seen.pose = {motion->T_2_1.R, Eigen::Vector3d::Zero()};
  seen.covariance.setZero();
  seen.shared_covariance.setZero();
  seen.covariance.topLeftCorner<3, 3>() = motion->covariance.topLeftCorner<3, 3>();
  if (moves) {
    seen.pose.t = motion->T_2_1.t.normalized();
    seen.covariance = of_direction(motion->covariance, motion->T_2_1.t);
  }
  std::vector<bool> told(seen.pair.size(), false);
  seen.inliers.assign(seen.pair.size(), false);
  for (std::size_t k = 0; k < points.size(); ++k) {
    told[points[k].index] = true;
    seen.inliers[points[k].index] = motion->agrees[k];
  }
  return with_the_sky(std::move(seen), told, threshold_px);
}

}  // namespace oneac
