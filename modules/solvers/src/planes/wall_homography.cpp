#include "planes/wall_homography.h"

#include <Eigen/Dense>

#include <algorithm>

namespace oneac::internal {
namespace {

// Below this length [distances to the wall] t and n are rounding.
constexpr double kNoMotion = 1e-7;
// Share of GᵀG's entries that is rounding: a motion of 1e-7 parts its eigenvalues by more than
// 1e-8.
constexpr double kRounding = 1e-14;
// Reciprocal condition of the normal equations below which the wall's homography is not determined.
constexpr double kSingular = 1e-14;

/// A_vert of the paper without the column of h5 = 1, whose negative is `b`; unknowns (h1, h3, h7,
/// h9).
void wall_rows(const AffineCorrespondence& ac, Eigen::Matrix<double, 6, 4>& m,
               Eigen::Matrix<double, 6, 1>& b) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  m << 1.0, 0.0, -(u + a1 * x), -a1,  //
      0.0, 0.0, -a2 * x, -a2,         //
      0.0, 0.0, -(v + a3 * x), -a3,   //
      0.0, 0.0, -a4 * x, -a4,         //
      x, 1.0, -x * u, -u,             //
      0.0, 0.0, -x * v, -v;
  b << 0.0, 0.0, 0.0, -1.0, 0.0, -y;
}

/// Calls use(rows, right-hand side, weight) for each correspondence that takes part.
template <class Use>
void for_each_row_block(AcSpan acs, const double* weights, WallRows rows, Use&& use) {
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double weight = weights == nullptr ? 1.0 : weights[i];
    if (!(weight > 0.0) || !may_lie_on_wall(acs[i], rows)) continue;
    Eigen::Matrix<double, 6, 4> m;
    Eigen::Matrix<double, 6, 1> b;
    wall_rows(acs[i], m, b);
    if (rows == WallRows::kPointsOnly) {
      m.topRows<4>().setZero();
      b.head<4>().setZero();
    }
    use(m, b, weight);
  }
}

}  // namespace

std::optional<WallHomography> wall_homography(AcSpan acs, const double* weights, WallRows rows) {
  Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();
  Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
  for_each_row_block(acs, weights, rows, [&](const auto& m, const auto& b, double weight) {
    gram.noalias() += weight * m.transpose() * m;
    rhs.noalias() += weight * m.transpose() * b;
  });
  if (!gram.allFinite()) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix4d> factor(gram);
  if (factor.info() != Eigen::Success || !(factor.rcond() > kSingular)) return std::nullopt;
  Eigen::Vector4d h = factor.solve(rhs);
  // Normal equations keep half of the digits; one correction with the rows' own residual brings
  // the other half back.
  Eigen::Vector4d rest = Eigen::Vector4d::Zero();
  for_each_row_block(acs, weights, rows, [&](const auto& m, const auto& b, double weight) {
    rest.noalias() += weight * m.transpose() * (b - m * h);
  });
  h += factor.solve(rest);
  return WallHomography{h(0), h(1), h(2), h(3)};
}

namespace {

/// Unit directions m (as n⊥) with |G m| = 1: the circle against the ellipse, in the eigenbasis of
/// GᵀG. One when noise keeps them from meeting: the nearest point.
struct Directions {
  Eigen::Vector2d m[2] = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  int count = 0;
};

[[nodiscard]] Directions preserved_directions(const Eigen::Matrix2d& G) {
  const double k00 = G(0, 0) * G(0, 0) + G(1, 0) * G(1, 0) - 1.0;
  const double k01 = G(0, 0) * G(0, 1) + G(1, 0) * G(1, 1);
  const double k11 = G(0, 1) * G(0, 1) + G(1, 1) * G(1, 1) - 1.0;
  const double half = 0.5 * (k00 - k11);
  const double radius = std::sqrt(half * half + k01 * k01);
  const double mean = 0.5 * (k00 + k11);
  if (!(radius > kRounding * (1.0 + std::abs(mean)))) return {};  // a scaled rotation: any would do
  const double large = radius + std::abs(half);
  const double scale = 1.0 / std::sqrt(2.0 * radius * large);
  const Eigen::Vector2d v1 = half > 0.0 ? Eigen::Vector2d(large * scale, k01 * scale)
                                        : Eigen::Vector2d(k01 * scale, large * scale);
  const Eigen::Vector2d v2(-v1.y(), v1.x());
  // κ1 = σ1² − 1 = mean + radius, κ2 = σ2² − 1 = mean − radius;  w1² = −κ2/(κ1 − κ2), clamped.
  const double w1_squared = std::clamp(0.5 * (radius - mean) / radius, 0.0, 1.0);
  const double w1 = std::sqrt(w1_squared);
  const double w2 = std::sqrt(1.0 - w1_squared);
  Directions directions;
  directions.m[directions.count++] = w1 * v1 + w2 * v2;
  if (w1 > 0.0 && w2 > 0.0) directions.m[directions.count++] = w1 * v1 - w2 * v2;
  return directions;
}

/// Pose of one direction; the sign of n (and t) is arbitrary.
[[nodiscard]] std::optional<WallPose> pose_of(const Eigen::Matrix2d& G, const Eigen::Vector2d& m) {
  const Eigen::Vector2d g = G * m;  // R₂ m
  const double length = g.norm();
  if (!(length > 1e-9)) return std::nullopt;
  WallPose pose;
  pose.cos_alpha = (m.x() * g.x() + m.y() * g.y()) / length;
  pose.sin_alpha = (m.x() * g.y() - m.y() * g.x()) / length;
  pose.nx = m.y();
  pose.nz = -m.x();
  // eq. (11): p = (G − R₂) n, both signs as H = R + (t/d) nᵀ.
  pose.tx = (G(0, 0) - pose.cos_alpha) * pose.nx + (G(0, 1) + pose.sin_alpha) * pose.nz;
  pose.tz = (G(1, 0) - pose.sin_alpha) * pose.nx + (G(1, 1) - pose.cos_alpha) * pose.nz;
  const double squared = pose.tx * pose.tx + pose.tz * pose.tz;
  if (!(squared > kNoMotion * kNoMotion) || !std::isfinite(squared)) return std::nullopt;
  return pose;
}

[[nodiscard]] WallPose turned_around(const WallPose& pose) {
  return {{pose.cos_alpha, pose.sin_alpha, -pose.tx, -pose.tz}, -pose.nx, -pose.nz};
}

/// What the points say about the signs: a point lies before the first camera when n·x̃1 > 0, and
/// before the second when the third row of H is positive there as well.
struct Side {
  int first = 0;
  int second = 0;
};

[[nodiscard]] Side side_votes(const WallHomography& h, const WallPose& pose, AcSpan acs,
                              const double* weights, WallRows rows) {
  Side votes;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (weights != nullptr && !(weights[i] > 0.0)) continue;
    if (!may_lie_on_wall(acs[i], rows)) continue;
    const double x = acs[i].x1.x();
    votes.first += pose.nx * x + pose.nz > 0.0 ? 1 : -1;
    votes.second += h.h7 * x + h.h9 > 0.0 ? 1 : -1;
  }
  return votes;
}

}  // namespace

SolutionSet<WallPose, 2> poses_of_wall(const WallHomography& h, AcSpan acs, const double* weights,
                                       WallRows rows) {
  SolutionSet<WallPose, 2> poses;
  Eigen::Matrix2d G;
  G << h.h1, h.h3, h.h7, h.h9;
  const Directions directions = preserved_directions(G);
  for (int i = 0; i < directions.count; ++i) {
    const std::optional<WallPose> pose = pose_of(G, directions.m[i]);
    if (!pose) continue;
    const Side votes = side_votes(h, *pose, acs, weights, rows);
    if (votes.second <= 0) return {};
    poses.push_back(votes.first >= 0 ? *pose : turned_around(*pose));
  }
  return poses;
}

}  // namespace oneac::internal
