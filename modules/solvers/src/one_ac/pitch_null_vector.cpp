#include "one_ac/pitch_null_vector.h"

#include <cmath>

namespace oneac::internal {

NullVector null_vector(const AffineCorrespondence& ac) {
  const double x = ac.x1.x(), y = ac.x1.y(), u = ac.x2.x(), v = ac.x2.y();
  const double a1 = ac.A(0, 0), a2 = ac.A(0, 1), a3 = ac.A(1, 0), a4 = ac.A(1, 1);
  const double p1 = u * y, p2 = a1 * y, p3 = a2 * y + u;
  // D = v' (a4 τ y + w) − a4 w y, with k = a4 y + v.
  const double k = a4 * y + v;
  const double D[3] = {v - a4 * y, v * k - 1.0 - a4 * y * v, -k};
  // F = u y (a4 τ y + w) − (a2 y + u) w y, linear.
  const double F[2] = {p1 - p3 * y, p1 * k - p3 * y * v};
  // L = u y a4 − (a2 y + u) v', linear.
  const double L[2] = {p1 * a4 - p3 * v, p3};
  NullVector n;
  n.e12[0] = -v * D[0];  // −v' D
  n.e12[1] = -v * D[1] + D[0];
  n.e12[2] = -v * D[2] + D[1];
  n.e12[3] = D[2];
  n.e21[0] = -p1 * a3 + p2 * D[0] + p3 * a3 * y;
  n.e21[1] = -p1 * a3 * v + p2 * D[1];
  n.e21[2] = p2 * D[2] + p3 * a3 * y;
  n.e23[0] = v * F[0] - x * n.e21[0];  // v' F − x e21
  n.e23[1] = v * F[1] - F[0] - x * n.e21[1];
  n.e23[2] = -F[1] - x * n.e21[2];
  n.e32[0] = -v * L[0];  // −v' L
  n.e32[1] = -v * L[1] + L[0];
  n.e32[2] = L[1];
  const double a = std::abs(a1) + std::abs(a2) + std::abs(a3) + std::abs(a4);
  n.size = (std::abs(p1) + a * std::abs(y) + std::abs(u)) * (1.0 + std::abs(v)) * (std::abs(v) + a);
  return n;
}

}  // namespace oneac::internal
