#include "points/five_point_cubics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace oneac::internal {
namespace {

// Pivots of the ten cubics below it: a continuum of solutions (a camera that only turned).
constexpr double kSingularCubics = 1e-11;

// Unknowns x, y, z, 1 by number. Monomials in Nistér's order, so that elimination of the first ten
// leaves, for each row of interest, cubics in z for x, y and 1.
using Linear = std::array<double, 4>;
using Quadratic = std::array<double, 10>;  // xx xy xz x yy yz y zz z 1
using Cubic = std::array<double, 20>;

constexpr int kQuadratic[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};
// x³ y³ x²y xy² x²z x² y²z y² xyz xy | xz² xz x | yz² yz y | z³ z² z 1; rows as Quadratic, columns
// as Linear.
constexpr int kCubic[10][4] = {{0, 2, 4, 5},     {2, 3, 8, 9},    {4, 8, 10, 11}, {5, 9, 11, 12},
                               {3, 1, 6, 7},     {8, 6, 13, 14},  {9, 7, 14, 15}, {10, 13, 16, 17},
                               {11, 14, 17, 18}, {12, 15, 18, 19}};

void add_product(const Linear& a, const Linear& b, Quadratic& q) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      q[static_cast<std::size_t>(kQuadratic[i][j])] += a[i] * b[j];
  }
}

void add_product(const Quadratic& q, const Linear& l, Cubic& c) {
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t j = 0; j < 4; ++j) c[static_cast<std::size_t>(kCubic[i][j])] += q[i] * l[j];
  }
}

using Cubics = std::array<Cubic, 10>;

/// The ten cubics in the coefficients of E = x X + y Y + z Z + W.
[[nodiscard]] Cubics cubics_of(const Basis& basis) {
  Linear e[3][3];
  for (int i = 0; i < 9; ++i) {
    e[i / 3][i % 3] = {basis(i, 0), basis(i, 1), basis(i, 2), basis(i, 3)};
  }
  Quadratic eet[3][3] = {};
  Quadratic half_trace{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      for (int k = 0; k < 3; ++k) add_product(e[i][k], e[j][k], eet[i][j]);
      eet[j][i] = eet[i][j];
    }
  }
  for (std::size_t m = 0; m < 10; ++m) {
    half_trace[m] = 0.5 * (eet[0][0][m] + eet[1][1][m] + eet[2][2][m]);
  }
  for (int i = 0; i < 3; ++i) {
    for (std::size_t m = 0; m < 10; ++m) eet[i][i][m] -= half_trace[m];
  }
  Cubics cubics{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Cubic& c = cubics[3 * i + j];
      for (int k = 0; k < 3; ++k) add_product(eet[i][k], e[k][j], c);
    }
  }
  for (int j = 0; j < 3; ++j) {  // det E by the first row
    const int a = (j + 1) % 3, b = (j + 2) % 3;
    Quadratic minor{};
    Linear negative = e[1][b];
    for (double& v : negative) v = -v;
    add_product(e[1][a], e[2][b], minor);
    add_product(negative, e[2][a], minor);
    add_product(minor, e[0][j], cubics[9]);
  }
  return cubics;
}

/// Reduced row echelon form of the rows 4 … 9 with respect to the first ten monomials; false when
/// singular.
[[nodiscard]] bool eliminate(Cubics& m) {
  double first = 0.0;
  for (std::size_t k = 0; k < 10; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 10; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    }
    const double largest = std::abs(m[pivot][k]);
    first = std::max(first, largest);
    if (!(largest > kSingularCubics * first) || !std::isfinite(largest)) return false;
    if (pivot != k) std::swap(m[pivot], m[k]);
    const double inverse = 1.0 / m[k][k];
    for (std::size_t j = k; j < 20; ++j) m[k][j] *= inverse;
    for (std::size_t i = k + 1; i < 10; ++i) {
      const double factor = m[i][k];
      for (std::size_t j = k + 1; j < 20; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (std::size_t k = 9; k > 4; --k) {  // upwards, as far as rows 4 … 9 are concerned
    for (std::size_t i = 4; i < k; ++i) {
      const double factor = m[i][k];
      for (std::size_t j = 10; j < 20; ++j) m[i][j] -= factor * m[k][j];
      m[i][k] = 0.0;
    }
  }
  return true;
}

/// ⟨a⟩ − z⟨b⟩, where the leading monomials cancel.
[[nodiscard]] PolynomialRow difference(const Cubic& a, const Cubic& b) {
  return {{a[12], a[11] - b[12], a[10] - b[11], -b[10]},
          {a[15], a[14] - b[15], a[13] - b[14], -b[13]},
          {a[19], a[18] - b[19], a[17] - b[18], a[16] - b[17], -b[16]}};
}

template <int N, int M>
void add_scaled_product(const double (&a)[N], const double (&b)[M], double scale, double* result) {
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < M; ++j) result[i + j] += scale * a[i] * b[j];
  }
}

}  // namespace

bool five_point_rows(const Basis& basis, PolynomialRow (&B)[3]) {
  Cubics cubics = cubics_of(basis);
  if (!eliminate(cubics)) return false;
  B[0] = difference(cubics[4], cubics[5]);
  B[1] = difference(cubics[6], cubics[7]);
  B[2] = difference(cubics[8], cubics[9]);
  return true;
}

void determinant(const PolynomialRow (&B)[3], double (&d)[11]) {
  for (double& c : d) c = 0.0;
  for (int i = 0; i < 3; ++i) {  // along the column of 1
    const PolynomialRow& r = B[(i + 1) % 3];
    const PolynomialRow& s = B[(i + 2) % 3];
    double minor[7] = {};
    add_scaled_product(r.x, s.y, 1.0, minor);
    add_scaled_product(r.y, s.x, -1.0, minor);
    add_scaled_product(minor, B[i].one, 1.0, d);
  }
}

}  // namespace oneac::internal
