#include "landmark_pose.h"

#include "oneac/geometry/shared_errors.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace oneac::internal {
namespace {

constexpr double kGate = 3.03;    // [σ] 99 % of Gaussian points
constexpr double kTukey = 4.685;  // [σ] 95 % efficient on Gaussian noise
// Wider gates at first: a start by the median of lengths is right to a few per cent of a few
// metres.
constexpr double kWidest = 16.0, kNarrower = 0.6;
constexpr int kRounds = 18;
constexpr double kStationary = 1e-9;  // [rad, m] a step that moves nothing

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

/// A sight's error in the other image in standard deviations, and its derivative.
struct Term {
  bool valid = false;
  Eigen::Vector2d r = Eigen::Vector2d::Zero();
  Matrix26 J = Matrix26::Zero();

  [[nodiscard]] double squared() const {
    return valid ? r.squaredNorm() : std::numeric_limits<double>::infinity();
  }
};

/// A point times its inverse depth in the other view, and the derivatives by (w, v) and by that.
struct Moved {
  Eigen::Vector3d p;
  Eigen::Matrix<double, 3, 6> by_pose;
  Eigen::Vector3d by_inverse_depth;
};

Moved moved(const LandmarkSight& sight, const RelativePose& T) {
  Moved out;
  const double rho = sight.inverse_depth;
  if (sight.of_first) {
    const Eigen::Vector3d turned = T.R * sight.x.homogeneous();
    out.p = turned + rho * T.t;
    out.by_pose << -cross_matrix(turned), rho * Eigen::Matrix3d::Identity();
    out.by_inverse_depth = T.t;
    return out;
  }
  const Eigen::Vector3d before = sight.x.homogeneous() - rho * T.t;
  out.p = T.R.transpose() * before;
  out.by_pose << T.R.transpose() * cross_matrix(before), -rho * T.R.transpose();
  out.by_inverse_depth = -(T.R.transpose() * T.t);
  return out;
}

Term term_of(const LandmarkSight& sight, const RelativePose& T, double noise) {
  constexpr double kBehind = 1e-3;
  const Moved m = moved(sight, T);
  Term term;
  if (!(m.p.z() > kBehind)) return term;
  Eigen::Matrix<double, 2, 3> projection;
  projection << 1.0, 0.0, -m.p.x() / m.p.z(), 0.0, 1.0, -m.p.y() / m.p.z();
  projection /= m.p.z();
  const Eigen::Vector2d depth = projection * m.by_inverse_depth * sight.inverse_depth_sigma;
  Eigen::Matrix2d S = noise * noise * Eigen::Matrix2d::Identity() + depth * depth.transpose();
  const Eigen::LLT<Eigen::Matrix2d> root(S);
  term.r = root.matrixL().solve(m.p.head<2>() / m.p.z() - sight.other);
  term.J = root.matrixL().solve(projection * m.by_pose);
  term.valid = term.r.allFinite() && term.J.allFinite();
  return term;
}

/// Half of Tukey's ψ(r)/r for a gate so many times as wide.
double weight_of(double squared, double wide) {
  const double share = squared / (kTukey * kTukey * wide * wide);
  return share < 1.0 ? (1.0 - share) * (1.0 - share) : 0.0;
}

struct Normal {
  Matrix6 H = Matrix6::Zero();
  Vector6 g = Vector6::Zero();
};

Normal normal_of(const std::vector<LandmarkSight>& sights, const RelativePose& T, double noise,
                 double wide) {
  Normal normal;
  for (const LandmarkSight& sight : sights) {
    const Term term = term_of(sight, T, noise);
    if (!term.valid) continue;
    const double weight = weight_of(term.squared(), wide);
    normal.H += weight * term.J.transpose() * term.J;
    normal.g += weight * term.J.transpose() * term.r;
  }
  return normal;
}

RelativePose moved_by(const RelativePose& T, const Vector6& step) {
  return {rotation_from_vector(step.head<3>()) * T.R, T.t + step.tail<3>()};
}

const Eigen::Vector2d& in_first(const LandmarkSight& sight) {
  return sight.of_first ? sight.x : sight.other;
}

/// Inliers, cost and covariance where the pose is.
void judge(const std::vector<LandmarkSight>& sights, double noise, LandmarkPose& pose) {
  double squares = 0.0;
  Matrix6 H = Matrix6::Zero(), V = Matrix6::Zero();
  GradientsOfCells<6> cells;
  cells.reserve(sights.size());
  for (const LandmarkSight& sight : sights) {
    const Term term = term_of(sight, pose.T_2_1, noise);
    const bool inlier = term.squared() < kGate * kGate;
    pose.inliers.push_back(inlier);
    pose.cost += std::min(term.squared(), kGate * kGate);
    if (!inlier) continue;
    ++(sight.of_first ? pose.first_side : pose.second_side);
    squares += term.squared();
    H += term.J.transpose() * term.J;
    const Vector6 gradient = term.J.transpose() * term.r;
    V += gradient * gradient.transpose();
    cells.add(in_first(sight), gradient);
  }
  const double count = static_cast<double>(pose.first_side + pose.second_side);
  const Eigen::LDLT<Matrix6> solver(H);
  if (count < 6.0 || !solver.isPositive()) return;
  const double scatter = squares / (2.0 * count - 6.0);
  // Both landmarks of a correspondence say the same once: their errors in the image are one.
  constexpr double kSaidTwice = 2.0;
  pose.covariance = kSaidTwice * std::max(scatter, 1.0) * solver.solve(Matrix6::Identity());
  const Matrix6 half = solver.solve(cells.shared(kSaidTwice * V));
  pose.covariance += solver.solve(half.transpose());
  pose.covariance = 0.5 * (pose.covariance + pose.covariance.transpose()).eval();
  pose.usable = pose.covariance.allFinite() && pose.covariance.diagonal().minCoeff() > 0.0;
}

}  // namespace

LandmarkPose pose_by_landmarks(const std::vector<LandmarkSight>& sights, const RelativePose& start,
                               double noise) {
  LandmarkPose pose;
  pose.T_2_1 = start;
  double wide = kWidest;
  for (int round = 0; round < kRounds; ++round, wide = std::max(1.0, wide * kNarrower)) {
    const Normal normal = normal_of(sights, pose.T_2_1, noise, wide);
    const Eigen::LDLT<Matrix6> solver(normal.H);
    const Vector6 step = -solver.solve(normal.g);
    if (!solver.isPositive() || !step.allFinite()) return pose;
    pose.T_2_1 = moved_by(pose.T_2_1, step);
    if (wide == 1.0 && step.norm() < kStationary) break;
  }
  judge(sights, noise, pose);
  return pose;
}

double length_by_landmarks(const std::vector<LandmarkSight>& sights, const RelativePose& unit) {
  std::vector<std::pair<double, double>> votes;  // length, weight
  double all = 0.0;
  for (const LandmarkSight& sight : sights) {
    const RelativePose T = sight.of_first ? unit : unit.inverse();
    // other × (R x + s ρ t) = 0
    const Eigen::Vector3d a = sight.other.homogeneous().cross(T.R * sight.x.homogeneous());
    const Eigen::Vector3d b = sight.inverse_depth * sight.other.homogeneous().cross(T.t);
    const double squared = b.squaredNorm();
    if (!(squared > 0.0)) continue;
    votes.emplace_back(-a.dot(b) / squared, std::sqrt(squared));
    all += votes.back().second;
  }
  std::sort(votes.begin(), votes.end());
  double sum = 0.0;
  for (const auto& [length, weight] : votes) {
    if ((sum += weight) >= 0.5 * all) return length;
  }
  return 0.0;
}

}  // namespace oneac::internal
