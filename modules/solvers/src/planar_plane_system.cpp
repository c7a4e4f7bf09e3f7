#include "planar_plane_system.h"

#include "minimise_on_circle.h"
#include "thresholds.h"

#include <Eigen/Geometry>

#include <cmath>

namespace oneac::internal {
namespace {

// Newton on the smallest eigenvalue takes two or three steps at 2 % affine noise; the rest is for
// noise so large that steps are halved. The vector's error is the square of its last change.
constexpr int kEigenvalueSteps = 40;
constexpr double kEigenvectorStep = 1e-5;

/// [A | −b]ᵀ[A | −b] − λI with p and q eliminated: a symmetric matrix over (c, s, 1), and what
/// gives p, q back. All of it times `det`, the determinant of the block of p and q, so that no
/// division delays it.
struct Reduced {
  double det = 0.0;
  double cc = 0.0, cs = 0.0, ss = 0.0, cb = 0.0, sb = 0.0, bb = 0.0;  // c·b, s·b for +b
  double p_of_c = 0.0, q_of_c = 0.0, p_of_s = 0.0, q_of_s = 0.0, p_of_b = 0.0, q_of_b = 0.0;

  [[nodiscard]] PlaneSolution solution(double c, double s, double inverse_det) const {
    return {c, s, (p_of_b - c * p_of_c - s * p_of_s) * inverse_det,
            (q_of_b - c * q_of_c - s * q_of_s) * inverse_det};
  }
};

/// False when the block of p and q is not positive definite.
[[nodiscard]] inline bool reduce(const PlaneGram& g, double shift, Reduced& r) {
  const double pp = g.pp - shift;
  const double qq = g.qq - shift;
  r.det = pp * qq - g.pq * g.pq;
  const double trace = g.pp + g.qq;
  if (!(pp > 0.0) || !(r.det > kSingularPlaneGram * trace * trace)) return false;
  r.p_of_c = qq * g.cp - g.pq * g.cq;
  r.q_of_c = pp * g.cq - g.pq * g.cp;
  r.p_of_s = qq * g.sp - g.pq * g.sq;
  r.q_of_s = pp * g.sq - g.pq * g.sp;
  r.p_of_b = -g.pq * g.qb;
  r.q_of_b = pp * g.qb;
  r.cc = r.det * (g.cc - shift) - g.cp * r.p_of_c - g.cq * r.q_of_c;
  r.cs = r.det * g.cs - g.cp * r.p_of_s - g.cq * r.q_of_s;
  r.ss = r.det * (g.ss - shift) - g.sp * r.p_of_s - g.sq * r.q_of_s;
  r.cb = r.det * g.cb - g.qb * r.q_of_c;
  r.sb = r.det * g.sb - g.qb * r.q_of_s;
  r.bb = r.det * (g.bb - shift) - g.qb * r.q_of_b;
  return true;
}

[[nodiscard]] double dot6(const double (&a)[6], const double (&b)[6]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

}  // namespace

void PlaneGram::add(const AffineCorrespondence& ac, const Eigen::Vector3d& n, double weight) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  const double nx = n.x(), ny = n.y();
  const double m = nx * x + ny * y + n.z();  // inverse depth of the point, times d
  // Columns of A; p has its only entries m, nx, ny in rows 0, 2, 3 and b its only ones −y, −1 in
  // 1, 5.
  const double c[6] = {x - u, -v, 1.0 - a1, -a2, -a3, -a4};
  const double s[6] = {-u * x - 1.0, -v * x, -u - a1 * x, -a2 * x, -v - a3 * x, -a4 * x};
  const double q[6] = {-u * m,           -v * m,           -u * nx - a1 * m,
                       -u * ny - a2 * m, -v * nx - a3 * m, -v * ny - a4 * m};
  cc += weight * dot6(c, c);
  cs += weight * dot6(c, s);
  ss += weight * dot6(s, s);
  cq += weight * dot6(c, q);
  sq += weight * dot6(s, q);
  qq += weight * dot6(q, q);
  cp += weight * (m * c[0] + nx * c[2] + ny * c[3]);
  sp += weight * (m * s[0] + nx * s[2] + ny * s[3]);
  pq += weight * (m * q[0] + nx * q[2] + ny * q[3]);
  pp += weight * (m * m + nx * nx + ny * ny);
  cb -= weight * (y * c[1] + c[5]);
  sb -= weight * (y * s[1] + s[5]);
  qb -= weight * (y * q[1] + q[5]);
  bb += weight * (y * y + 1.0);
}

void PlaneGram::add_points(const AffineCorrespondence& ac, const Eigen::Vector3d& n,
                           double weight) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double m = n.x() * x + n.y() * y + n.z();
  const double c[2] = {x - u, -v}, s[2] = {-u * x - 1.0, -v * x}, q[2] = {-u * m, -v * m};
  cc += weight * (c[0] * c[0] + c[1] * c[1]);
  cs += weight * (c[0] * s[0] + c[1] * s[1]);
  ss += weight * (s[0] * s[0] + s[1] * s[1]);
  cq += weight * (c[0] * q[0] + c[1] * q[1]);
  sq += weight * (s[0] * q[0] + s[1] * q[1]);
  qq += weight * (q[0] * q[0] + q[1] * q[1]);
  cp += weight * m * c[0];
  sp += weight * m * s[0];
  pq += weight * m * q[0];
  pp += weight * m * m;
  cb -= weight * y * c[1];
  sb -= weight * y * s[1];
  qb -= weight * y * q[1];
  bb += weight * y * y;
}

std::optional<PlaneSolution> solve_rapid(const PlaneGram& g) {
  // Newton on the last pivot of the elimination, a concave decreasing function of the shift whose
  // first root is the smallest eigenvalue, as long as all other pivots are positive.
  double low = 0.0, shift = 0.0;
  double c = 0.0, s = 0.0;
  for (int step = 0; step < kEigenvalueSteps; ++step) {
    Reduced r;
    const bool regular = reduce(g, shift, r);
    const double det = r.cc * r.ss - r.cs * r.cs;
    const double trace = r.cc + r.ss;
    if (!regular || !(r.cc > 0.0) || !(det > kSingularPlaneGram * trace * trace)) {
      if (!(shift > low))
        return std::nullopt;  // no unique null vector, or one without a last entry
      shift = 0.5 * (low + shift);
      continue;
    }
    const double inverse_both = 1.0 / (det * r.det);  // one division for two
    const double inverse = inverse_both * r.det;
    const double inverse_det = inverse_both * det;
    const double new_c = (r.ss * r.cb - r.cs * r.sb) * inverse;
    const double new_s = (r.cc * r.sb - r.cs * r.cb) * inverse;
    const double change = std::abs(new_c - c) + std::abs(new_s - s);
    c = new_c;
    s = new_s;
    const PlaneSolution x = r.solution(c, s, inverse_det);
    const double squared = c * c + s * s;
    if (!(change > kEigenvectorStep)) {
      // Erratum: the last entry is one now, but c² + s² is not; only the rotation is normalised.
      if (!(squared > 1e-24)) return std::nullopt;
      const double scale = 1.0 / std::sqrt(squared);
      return PlaneSolution{c * scale, s * scale, x.p, x.q};
    }
    const double pivot = (r.bb - c * r.cb - s * r.sb) * inverse_det;
    if (pivot > 0.0) low = shift;
    shift += pivot / (squared + x.p * x.p + x.q * x.q + 1.0);
  }
  return std::nullopt;
}

std::optional<PlaneSolution> solve_optimal(const PlaneGram& g) {
  Reduced r;
  if (!reduce(g, 0.0, r)) return std::nullopt;
  Eigen::Matrix2d Q;
  Q << r.cc, r.cs, r.cs, r.ss;
  const Eigen::Vector2d z = minimise_on_circle(Q, {r.cb, r.sb});
  return r.solution(z.x(), z.y(), 1.0 / r.det);
}

namespace {

struct SignedSolution {
  PlaneSolution x;
  double sign;  // of d
};

[[nodiscard]] std::optional<SignedSolution> solve_known_plane(const KnownPlane& plane, AcSpan acs,
                                                              const double* weights,
                                                              PlaneSolve solve) {
  PlaneGram gram;
  const AffineCorrespondence* usable = nullptr;
  double m = 0.0;  // n·x̃1 of the first usable point
  int side = 0;  // votes for the sign of d: a point before the camera has n·x̃1 of the sign of d
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double weight = weights == nullptr ? 1.0 : weights[i];
    const bool usable_pair = plane.points_only ? has_points(acs[i]) : is_usable(acs[i]);
    if (!(weight > 0.0) || !usable_pair || !plane.may_show(acs[i])) continue;
    if (plane.points_only) {
      gram.add_points(acs[i], plane.n, weight);
    } else {
      gram.add(acs[i], plane.n, weight);
    }
    const double m_i = plane.n.dot(acs[i].x1.homogeneous());
    side += m_i > 0.0 ? 1 : -1;
    if (usable == nullptr) m = m_i;
    if (usable == nullptr) usable = &acs[i];
  }
  if (usable == nullptr) return std::nullopt;
  const std::optional<PlaneSolution> x = solve(gram);
  if (!x) return std::nullopt;
  const double squared_length = x->p * x->p + x->q * x->q;
  if (!(squared_length > kNoPlaneMotion * kNoPlaneMotion) || !std::isfinite(squared_length)) {
    return std::nullopt;
  }
  // Third row of H: the plane must stay before the second camera.
  const double z2 = x->s * usable->x1.x() + x->q * m + x->c;
  if (!(z2 > 0.0) || !std::isfinite(z2)) return std::nullopt;
  return SignedSolution{*x, side >= 0 ? 1.0 : -1.0};
}

}  // namespace

SolutionSet<PlanarPose, 1> relpose_known_plane(const KnownPlane& plane, AcSpan acs,
                                               const double* weights, PlaneSolve solve) {
  const auto found = solve_known_plane(plane, acs, weights, solve);
  if (!found) return {};
  const PlaneSolution& x = found->x;
  return PlanarPose{x.c, x.s, found->sign * x.p, found->sign * x.q};
}

SolutionSet<WallPose, 1> relpose_known_wall(const KnownPlane& plane, AcSpan acs,
                                            const double* weights, PlaneSolve solve) {
  const auto found = solve_known_plane(plane, acs, weights, solve);
  if (!found) return {};
  const PlaneSolution& x = found->x;
  const double sign = found->sign;
  return WallPose{{x.c, x.s, sign * x.p, sign * x.q}, sign * plane.n.x(), sign * plane.n.z()};
}

}  // namespace oneac::internal
