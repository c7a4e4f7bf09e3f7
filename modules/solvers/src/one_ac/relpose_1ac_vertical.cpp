#include "oneac/solvers/relpose_1ac_vertical.h"

#include "math/thresholds.h"
#include "math/usable.h"
#include "one_ac/upright_half_angles.h"

#include "oneac/geometry/triangulation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>

namespace oneac {
namespace {

// Residual of the third equation, as a share of the rows, above which a root was none.
constexpr double kAccepted = 1e-9;

/// The correspondence in views that are turned about the vertical until its point lies straight
/// ahead, x1' = (0, y), x2' = (0, v), and the turns.
struct Ahead : internal::AheadCorrespondence {
  double c1, s1;  ///< yaw of the first view's turn
  double c2, s2;  ///< of the second's

  explicit Ahead(const AffineCorrespondence& ac) {
    const double r1 = std::sqrt(1.0 + ac.x1.x() * ac.x1.x());
    const double r2 = std::sqrt(1.0 + ac.x2.x() * ac.x2.x());
    c1 = 1.0 / r1, s1 = ac.x1.x() * c1;
    c2 = 1.0 / r2, s2 = ac.x2.x() * c2;
    y = ac.x1.y() * c1;
    v = ac.x2.y() * c2;
    // A' = J2 A J1⁻¹, J the derivative of a turn at the point it turns ahead.
    const double along = r1 * r1, across = ac.x1.x() * ac.x1.y();
    const double b1 = ac.A(0, 0) * along + ac.A(0, 1) * across, b2 = ac.A(0, 1) * r1;
    const double b3 = ac.A(1, 0) * along + ac.A(1, 1) * across, b4 = ac.A(1, 1) * r1;
    a1 = b1 * c2 * c2;
    a2 = b2 * c2 * c2;
    a3 = (b3 - s2 * v * b1) * c2;
    a4 = (b4 - s2 * v * b2) * c2;
  }

  /// M(0) vanishes, and with it the quartic: the second view only turned.
  [[nodiscard]] bool is_pure_rotation() const {
    const double size = std::abs(a1) + std::abs(a4) + std::abs(y) + std::abs(v);
    const double rest =
        std::abs(v - y) + std::abs(a1 - 1.0) + std::abs(a2) + std::abs(a3) + std::abs(a4 - 1.0);
    return !(rest > internal::kParallelRows * size);
  }

  /// Null vector of M(α') of the turned views; empty when it has more than one.
  [[nodiscard]] std::optional<Eigen::Vector3d> direction(double c, double s) const {
    const double w = y - c * v;
    Eigen::Matrix3d M;  // in the basis (e1, e2, e3 + v e2), which leaves a zero
    M.row(0) << w, s, 0.0;
    M.row(1) << -c * a3 - s * v, c * (a1 - 1.0), -s * a3 - w * a1;
    M.row(2) << 1.0 - c * a4, c * a2, -s * a4 - w * a2;
    Eigen::Vector3d best = Eigen::Vector3d::Zero();
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d n = M.row(i).cross(M.row((i + 1) % 3));
      const double size = n.squaredNorm();
      if (size > largest) largest = size, best = n;
    }
    const double size = M.squaredNorm();
    if (!(largest > internal::kParallelRows * internal::kParallelRows * size * size))
      return std::nullopt;
    const double residual = (M * best).squaredNorm();
    if (!(residual <= kAccepted * kAccepted * size * largest)) return std::nullopt;
    best.y() += v * best.z();
    const double length = best.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    return Eigen::Vector3d(best / length);
  }

  [[nodiscard]] std::optional<UprightPose> pose_at(double tau) const {
    const double scale = 1.0 / (1.0 + tau * tau);
    const double c = (1.0 - tau * tau) * scale, s = 2.0 * tau * scale;
    const auto t = direction(c, s);
    if (!t) return std::nullopt;
    const double cd = c1 * c2 + s1 * s2, sd = s1 * c2 - c1 * s2;  // the turns' difference
    return UprightPose{c * cd - s * sd,
                       s * cd + c * sd,
                       {c2 * t->x() + s2 * t->z(), t->y(), c2 * t->z() - s2 * t->x()}};
  }
};

}  // namespace

SolutionSet<UprightPose, 4> relpose_1ac_vertical(const AffineCorrespondence& ac) {
  SolutionSet<UprightPose, 4> poses;
  if (!internal::is_usable(ac)) return poses;
  const Ahead ahead(ac);
  if (ahead.is_pure_rotation()) return poses;
  for (const double tau : internal::upright_half_angles(ahead)) {
    auto pose = ahead.pose_at(tau);
    if (!pose) continue;
    const int side = cheirality(pose->pose(), ac.x1, ac.x2);
    if (side == 0) continue;
    if (side < 0) pose->t = -pose->t;
    poses.push_back(*pose);
  }
  return poses;
}

}  // namespace oneac
