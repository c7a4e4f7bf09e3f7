#include "oneac/solvers/relpose_2ac.h"

#include "math/gram_descent.h"
#include "math/null_space.h"
#include "math/sign_vote.h"
#include "points/five_point_basis.h"
#include "points/five_point_polish.h"
#include "points/five_point_roots.h"
#include "points/motion_essential.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace oneac {
namespace {

using internal::MotionEssential;
using Rows = Eigen::Matrix<double, 6, 9>;

// Radius of a patch [-], 14 px at a focal length of 700 px: the affine equations, which are the
// epipolar one's derivatives, times it are the epipolar equation's change from the point to the
// edge of its patch, and as noisy as it.
constexpr double kPatchRadius = 0.02;
// Pivots below this share of the first: fewer than five independent equations.
constexpr double kSingular = 1e-10;
// Share of the rays' product that is rounding where the camera only turned.
constexpr double kNoParallax = 1e-10;
constexpr std::size_t kPolished = 4;  // candidates worth a descent, by their sixth residual
constexpr int kSteps = 12;
constexpr int kPatience = 2;        // steps after which a residual far above another's is given up
constexpr double kLastStep = 1e-7;  // [rad] converges quadratically without noise
constexpr double kLongestStep = 0.5;  // [rad] what asks for more is no neighbour
// Residuals within this factor of the least cannot be told apart by one equation of freedom.
constexpr double kAlike = 3.0;
constexpr double kHopeless = 10.0 * kAlike;
constexpr double kRounding = 1e-10;
constexpr double kSame = 1e-6;  // [-] motions closer than this are one
constexpr std::size_t kStarts = 8;

struct Candidate {
  RelativePose T;
  double residual = 0.0;
};
using Candidates = SolutionSet<Candidate, 10>;

/// The two epipolar equations and, times the radius of a patch, the four affine ones.
[[nodiscard]] Rows equations(AcSpan acs) {
  Rows rows;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const auto three = internal::epipolar_rows(acs[static_cast<std::size_t>(i)]);
    rows.row(i) = three.row(0);
    rows.middleRows<2>(2 + 2 * i) = kPatchRadius * three.bottomRows<2>();
  }
  return rows;
}

/// The rays of the first point, of both its patch's edges, and of the second with one edge: what
/// the scaling of the five equations goes by.
[[nodiscard]] internal::FiveRays rays_of(AcSpan acs) {
  AffineCorrespondence points[5];
  for (std::size_t i = 0, k = 0; i < 2; ++i) {
    points[k++] = acs[i];
    for (int axis = 0; axis < 2 && k < 5; ++axis, ++k) {
      const Eigen::Vector2d d = kPatchRadius * Eigen::Vector2d::Unit(axis);
      points[k] = {acs[i].x1 + d, acs[i].x2 + acs[i].A * d, acs[i].A};
    }
  }
  return internal::FiveRays(AcSpan(points, 5));
}

/// Gauss-Newton on all six equations. False when it runs away, or stays above `give_up`.
[[nodiscard]] bool polish(const Rows& rows, double give_up, Candidate& candidate) {
  MotionEssential E(candidate.T);
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Matrix<double, 6, 1> r = rows * E.e;
    if (step >= kPatience && r.norm() > give_up) return false;
    const Eigen::Matrix<double, 6, 5> J = rows * E.J;
    const Eigen::Matrix<double, 5, 5> N = J.transpose() * J;
    const Eigen::Matrix<double, 5, 1> delta = -N.llt().solve(J.transpose() * r);
    const double length = delta.norm();
    if (!(length < kLongestStep)) return false;
    E = E.moved(delta);
    if (length < kLastStep) break;
  }
  candidate = {E.T, (rows * E.e).norm()};
  return std::isfinite(candidate.residual);
}

/// Of the four motions of E the one that has both points before both cameras; false when none has.
[[nodiscard]] bool put_before_cameras(AcSpan acs, RelativePose& T) {
  const RelativePose twisted{(2.0 * T.t * T.t.transpose() - Eigen::Matrix3d::Identity()) * T.R,
                             T.t};
  for (const RelativePose& motion : {T, twisted}) {
    const internal::SignVote vote(motion, acs, nullptr);
    if (std::abs(vote.balance) != 2) continue;
    T = {motion.R, vote.balance > 0 ? motion.t : Eigen::Vector3d(-motion.t)};
    return true;
  }
  return false;
}

/// Solutions of the five best equations, those first that the sixth likes.
[[nodiscard]] Candidates solutions_of_five(const Rows& rows, AcSpan acs) {
  Candidates candidates;
  internal::Basis basis;
  if (!internal::null_space<5, 9, 6>(rows, kSingular, basis)) return candidates;
  for (const Eigen::Matrix3d& E :
       internal::essentials_of(internal::well_scaled(basis, rays_of(acs)))) {
    auto T = internal::motion_near(E);
    if (!T || !put_before_cameras(acs, *T)) continue;
    candidates.push_back({*T, (rows * internal::packed(E)).norm()});
    for (std::size_t i = candidates.size() - 1; i > 0; --i) {
      if (!(candidates[i].residual < candidates[i - 1].residual)) break;
      std::swap(candidates[i], candidates[i - 1]);
    }
  }
  return candidates;
}

[[nodiscard]] bool is_new(const RelativePose& T, const Candidates& among) {
  return std::none_of(among.begin(), among.end(), [&T](const Candidate& other) {
    return (T.R - other.T.R).norm() + (T.t - other.T.t).norm() < kSame;
  });
}

/// The ray of a point, its change along the patch's first axis and what is across, orthonormal.
[[nodiscard]] Eigen::Matrix3d frame_of(const Eigen::Vector2d& x, const Eigen::Vector2d& along) {
  const Eigen::Vector3d ray = x.homogeneous().normalized();
  const Eigen::Vector3d d(along.x(), along.y(), 0.0);
  Eigen::Matrix3d frame;
  frame.col(0) = ray;
  frame.col(1) = (d - ray * ray.dot(d)).normalized();
  frame.col(2) = ray.cross(frame.col(1));
  return frame;
}

/// Whether the turn that the first correspondence asks for explains all six equations whatever t.
[[nodiscard]] bool is_pure_rotation(AcSpan acs) {
  const Eigen::Matrix3d R = frame_of(acs[0].x2, acs[0].A.col(0)) *
                            frame_of(acs[0].x1, Eigen::Vector2d::UnitX()).transpose();
  double rest = 0.0, size = 0.0;
  for (const AffineCorrespondence& ac : acs) {
    const Eigen::Vector3d a = R * ac.x1.homogeneous(), b = ac.x2.homogeneous();
    rest += a.cross(b).norm();
    size += a.norm() * b.norm();
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d d(ac.A(0, k), ac.A(1, k), 0.0);
      rest += (a.cross(d) + R.col(k).cross(b)).norm();
    }
  }
  return !(rest > kNoParallax * size);
}

[[nodiscard]] Candidates two_ac(AcSpan acs) {
  Candidates polished;
  if (acs.size() < 2 || !internal::is_usable(acs[0]) || !internal::is_usable(acs[1])) return {};
  acs = AcSpan(acs.begin(), 2);
  if (is_pure_rotation(acs)) return {};
  const Rows rows = equations(acs);
  const Candidates rough = solutions_of_five(rows, acs);
  double give_up = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(rough.size(), kPolished); ++i) {
    Candidate candidate = rough[i];
    if (!polish(rows, give_up, candidate) || !put_before_cameras(acs, candidate.T)) continue;
    if (is_new(candidate.T, polished)) polished.push_back(candidate);
    give_up = std::min(give_up, std::max(kHopeless * candidate.residual, kRounding));
  }
  return polished;
}

/// The least of the minima that the solutions of pairs of neighbours lead to.
[[nodiscard]] std::optional<RelativePose> least_squares(const internal::Gram9& gram, AcSpan acs,
                                                        const double* weights) {
  std::optional<RelativePose> best;
  double least = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> before;
  for (std::size_t i = 0, starts = 0; i < acs.size() && starts < kStarts; ++i) {
    if (!internal::counts(acs, weights, i)) continue;
    const auto first = std::exchange(before, i);
    if (!first) continue;
    const AffineCorrespondence pair[2] = {acs[*first], acs[i]};
    const auto candidates = relpose_2ac(AcSpan(pair, 2));
    starts += candidates.empty() ? 0 : 1;
    for (const RelativePose& start : candidates) {
      MotionEssential E(start);
      const double cost = internal::descend(gram, E);
      if (cost < least) least = cost, best = E.T;
    }
  }
  return best;
}

}  // namespace

SolutionSet<RelativePose, 4> relpose_2ac(AcSpan acs) {
  SolutionSet<RelativePose, 4> poses;
  const Candidates candidates = two_ac(acs);
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) least = std::min(least, c.residual);
  for (const Candidate& c : candidates) {
    const bool alike = c.residual <= std::max(kAlike * least, kRounding);
    if (alike && poses.size() < poses.kCapacity) poses.push_back(c.T);
  }
  return poses;
}

SolutionSet<RelativePose, 4> relpose_nac(AcSpan acs, const double* weights) {
  if (acs.size() == 2 && weights == nullptr) return relpose_2ac(acs);
  const internal::Gram9 gram = internal::epipolar_gram(acs, weights, kPatchRadius);
  if (!(gram.trace() > 0.0) || !gram.allFinite()) return {};
  auto best = least_squares(gram, acs, weights);
  if (!best) return {};
  const internal::SignVote vote(*best, acs, weights);
  if (vote.voters == 0) return {};
  if (vote.balance < 0) best->t = -best->t;
  return *best;
}

}  // namespace oneac
