#include "oneac/solvers/relpose_1ac_planar_pitch.h"

#include "math/polynomial.h"
#include "math/usable.h"
#include "one_ac/pitch_null_vector.h"
#include "one_ac/pitched_essential.h"

#include "oneac/geometry/triangulation.h"

#include <Eigen/Dense>

#include <cmath>
#include <optional>

namespace oneac {
namespace {

using internal::Angles;
using internal::Essential;
using internal::NullVector;

// Null vectors shorter than this share of the system's entries are rounding.
constexpr double kRankDeficient = 1e-10;
constexpr int kPolishSteps = 3;
constexpr double kPolished = 1e-31;    // squared residual that is rounding
constexpr double kPolishReach = 1e-3;  // [rad] a longer step would go to another root
// Roots of the sextic that are farther apart, in tan θ, are separate and accurate without help.
constexpr double kPairReach = 1e-4;
constexpr int kPairSteps = 3;          // Newton from the local parabola's roots
constexpr double kPairSettled = 1e-4;  // last step, as a share of the reach
// Residual, as a share of the rows, above which a root was none.
constexpr double kAccepted = 1e-9;

/// Adds scale·q² to the coefficients of p.
template <int N>
void add_square(const double (&q)[N], double scale, double* p) {
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) p[i + j] += scale * q[i] * q[j];
  }
}

/// g(τ) = (1 + τ²)(e21² + e23² − e32²) − e12², a sextic.
void constraint(const NullVector& n, double (&g)[7]) {
  double quartic[5] = {};
  add_square(n.e21, 1.0, quartic);
  add_square(n.e23, 1.0, quartic);
  add_square(n.e32, -1.0, quartic);
  for (double& c : g) c = 0.0;
  add_square(n.e12, -1.0, g);
  for (int i = 0; i < 5; ++i) {
    g[i] += quartic[i];
    g[i + 2] += quartic[i];
  }
}

[[nodiscard]] double at(const double (&q)[3], double t) {
  return q[0] + t * (q[1] + t * q[2]);
}

/// Value, slope and half the curvature of a polynomial.
struct Taylor {
  double c0, c1, c2;
};

template <int N>
[[nodiscard]] Taylor expand(const double (&q)[N], double t) {
  Taylor at{0.0, 0.0, 0.0};
  for (int i = N - 1; i >= 0; --i) {
    at.c2 = at.c2 * t + at.c1;
    at.c1 = at.c1 * t + at.c0;
    at.c0 = at.c0 * t + q[i];
  }
  return at;
}

[[nodiscard]] Taylor operator*(const Taylor& a, const Taylor& b) {
  return {a.c0 * b.c0, a.c0 * b.c1 + a.c1 * b.c0, a.c0 * b.c2 + a.c1 * b.c1 + a.c2 * b.c0};
}

[[nodiscard]] Taylor sum(const Taylor& a, const Taylor& b, double sign_of_b) {
  return {a.c0 + sign_of_b * b.c0, a.c1 + sign_of_b * b.c1, a.c2 + sign_of_b * b.c2};
}

/// g around τ from its factors: where all entries are small, as next to a pure rotation, they keep
/// the digits that cancel in the sextic's coefficients.
[[nodiscard]] Taylor constraint_around(const NullVector& n, double tau) {
  const Taylor e12 = expand(n.e12, tau), e21 = expand(n.e21, tau);
  const Taylor e23 = expand(n.e23, tau), e32 = expand(n.e32, tau);
  const Taylor squares = sum(sum(e21 * e21, e23 * e23, 1.0), e32 * e32, -1.0);
  return sum(Taylor{1.0 + tau * tau, 2.0 * tau, 1.0} * squares, e12 * e12, -1.0);
}

/// The one or two roots of g next to a root of the sextic. A small translation makes pairs that
/// Sturm's theorem cannot separate: the local parabola does.
struct NearbyRoots {
  double tau[2];
  int count = 1;

  NearbyRoots(const NullVector& n, double root) : tau{root, root} {
    const Taylor g = constraint_around(n, root);
    const double discriminant = g.c1 * g.c1 - 4.0 * g.c0 * g.c2;
    if (!(discriminant > 0.0)) return;
    const double q = -0.5 * (g.c1 + std::copysign(std::sqrt(discriminant), g.c1));
    const double small = g.c0 / q, large = q / g.c2;
    const double reach = kPairReach * (1.0 + root * root);
    if (!(std::abs(small) < reach)) return;
    tau[0] = root + small;
    if (!(std::abs(large) < reach)) return;
    if (!newton(n, reach, tau[0])) tau[0] = root;
    tau[1] = root + large;
    const bool converged = newton(n, reach, tau[1]);
    count = converged && std::abs(tau[1] - tau[0]) > 0.5 * std::abs(large - small) ? 2 : 1;
  }

  /// False when it leaves or does not settle: no root.
  [[nodiscard]] static bool newton(const NullVector& n, double reach, double& tau) {
    double delta = 0.0;
    for (int step = 0; step < kPairSteps; ++step) {
      const Taylor g = constraint_around(n, tau);
      delta = g.c0 / g.c1;
      if (!(std::abs(delta) < reach)) return false;
      tau -= delta;
    }
    return std::abs(delta) < kPairSettled * reach;
  }
};

/// Whether root i of the list is the one nearest to τ.
[[nodiscard]] bool is_nearest(const internal::RealRoots<6>& roots, int i, double tau) {
  for (int k = 0; k < roots.size(); ++k) {
    if (k != i && std::abs(roots[k] - tau) < std::abs(roots[i] - tau)) return false;
  }
  return true;
}

[[nodiscard]] std::optional<PitchedPose> pose_at(const NullVector& n, double tau,
                                                 const AffineCorrespondence& ac) {
  // All four over cos θ times 1/cos θ; the common factor does not matter.
  const double cosine = 1.0 / std::sqrt(1.0 + tau * tau);
  const double e12 = cosine * (n.e12[0] + tau * (n.e12[1] + tau * (n.e12[2] + tau * n.e12[3])));
  const double e21 = at(n.e21, tau), e23 = at(n.e23, tau), e32 = at(n.e32, tau);
  const double length = std::sqrt(e12 * e12 + e32 * e32);
  const double bound = n.size * (1.0 + tau * tau);
  if (!(length > kRankDeficient * bound)) return std::nullopt;
  const double tx = e32 / length, tz = -e12 / length;
  const double c = tz * e21 - tx * e23, s = -tx * e21 - tz * e23;
  const double norm = std::sqrt(c * c + s * s);
  if (!(norm > kRankDeficient * length) || !std::isfinite(norm)) return std::nullopt;
  PitchedPose pose{{c / norm, s / norm, tx, tz}, std::atan(tau)};
  const int side = cheirality(pose.pose(), ac.x1, ac.x2);
  if (side == 0) return std::nullopt;
  if (side < 0) pose.planar.tx = -tx, pose.planar.tz = -tz;
  return pose;
}

/// Newton on the three equations themselves: wins back the digits that the sextic's coefficients
/// lost. False when they do not hold: the root was none.
[[nodiscard]] bool polish(const Eigen::Matrix<double, 3, 9>& rows, PitchedPose& pose) {
  Angles angles{std::atan2(pose.planar.sin_alpha, pose.planar.cos_alpha),
                std::atan2(pose.planar.tx, pose.planar.tz), pose.pitch};
  Essential at_angles(angles);
  Eigen::Vector3d residual = rows * at_angles.e;
  for (int step = 0; step < kPolishSteps && residual.squaredNorm() > kPolished; ++step) {
    const Eigen::Matrix3d J = rows * at_angles.J;
    const Eigen::Vector3d delta = J.inverse() * residual;
    const Angles next{angles.alpha - delta.x(), angles.heading - delta.y(),
                      angles.pitch - delta.z()};
    const Essential at_next(next);
    const Eigen::Vector3d next_residual = rows * at_next.e;
    if (!(delta.squaredNorm() < kPolishReach * kPolishReach)) break;
    if (!(next_residual.squaredNorm() < residual.squaredNorm())) break;
    angles = next;
    at_angles = at_next;
    residual = next_residual;
    pose = angles.pose();
  }
  return residual.squaredNorm() <= kAccepted * kAccepted * rows.squaredNorm();
}

/// Whether the null vector vanishes at some pitch: the camera only turned (and pitched), and every
/// other root would be an accident. A common root must be that of L, the factor of e32.
[[nodiscard]] bool is_pure_rotation(const NullVector& n, double v) {
  const double slope = n.e32[2];  // −v' L = −(v − τ)(L0 + L1 τ)
  if (!(std::abs(slope) > kRankDeficient * n.size)) return false;
  const double tau =
      -(n.e32[1] + v * slope) / slope;  // sum of the roots is −e32[1]/slope, one is v
  const double e12 = n.e12[0] + tau * (n.e12[1] + tau * (n.e12[2] + tau * n.e12[3]));
  const double length = std::abs(e12) + std::abs(at(n.e21, tau)) + std::abs(at(n.e23, tau)) +
                        std::abs(at(n.e32, tau));
  return !(length > kRankDeficient * n.size * (1.0 + tau * tau));
}

}  // namespace

SolutionSet<PitchedPose, 6> relpose_1ac_planar_pitch(const AffineCorrespondence& ac,
                                                     double max_pitch) {
  if (!internal::is_usable(ac)) return {};
  const NullVector n = internal::null_vector(ac);
  if (is_pure_rotation(n, ac.x2.y())) return {};
  double g[7];
  constraint(n, g);
  const bool narrow = max_pitch < 0.7853981633974483;  // tan < 1: one interval instead of two
  const internal::RealRoots<6> roots =
      narrow ? internal::RealRoots<6>(g, std::tan(max_pitch)) : internal::RealRoots<6>(g);
  const Eigen::Matrix<double, 3, 9> rows = internal::epipolar_rows(ac);
  SolutionSet<PitchedPose, 6> poses;
  for (int i = 0; i < roots.size(); ++i) {
    const NearbyRoots nearby(n, roots[i]);
    for (int k = 0; k < nearby.count; ++k) {
      if (k == 1 && !is_nearest(roots, i, nearby.tau[1])) continue;  // listed itself
      auto pose = pose_at(n, nearby.tau[k], ac);
      const bool within = pose && polish(rows, *pose) && std::abs(pose->pitch) <= max_pitch;
      if (within && poses.size() < poses.kCapacity) poses.push_back(*pose);
    }
  }
  return poses;
}

}  // namespace oneac
