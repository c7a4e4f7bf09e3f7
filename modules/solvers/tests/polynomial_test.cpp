#include "math/polynomial.h"

#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oneac::internal {
namespace {

template <int N>
std::vector<double> sorted_roots(const double (&c)[N + 1]) {
  const RealRoots<N> found(c);
  std::vector<double> roots;
  roots.reserve(N);
  for (int i = 0; i < found.size(); ++i) roots.push_back(found[i]);
  std::sort(roots.begin(), roots.end());
  return roots;
}

/// Coefficients of ∏ (x − r) over the given roots times ∏ (x² + 1) up to degree N.
template <int N>
void expand(const std::vector<double>& roots, double (&c)[N + 1]) {
  std::vector<double> p{1.0};
  for (const double r : roots) {
    std::vector<double> next(p.size() + 1, 0.0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      next[i + 1] += p[i];
      next[i] -= r * p[i];
    }
    p = next;
  }
  while (p.size() + 2 <= N + 1) {
    std::vector<double> next(p.size() + 2, 0.0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      next[i + 2] += p[i];
      next[i] += p[i];
    }
    p = next;
  }
  for (int i = 0; i <= N; ++i)
    c[i] = static_cast<std::size_t>(i) < p.size() ? p[static_cast<std::size_t>(i)] : 0.0;
}

TEST(RealRoots, FindsTheRealRootsOfRandomPolynomials) {
  SceneGenerator random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> truth;
    for (int k = 0; k < 2 * (i % 6); ++k) {
      const double unit = random.uniform(-1, 1);
      truth.push_back(k % 2 == 0 ? unit : 1.0 / unit);
    }
    std::sort(truth.begin(), truth.end());
    bool apart = true;
    for (std::size_t k = 1; k < truth.size(); ++k) {
      apart = apart && truth[k] - truth[k - 1] > 0.03 * std::max(1.0, std::abs(truth[k]));
    }
    if (!apart || (!truth.empty() && std::max(-truth.front(), truth.back()) > 30.0)) continue;
    double c[11];
    expand<10>(truth, c);
    const auto roots = sorted_roots<10>(c);
    ASSERT_EQ(roots.size(), truth.size()) << "case " << i << " of seed 1";
    for (std::size_t k = 0; k < truth.size(); ++k) {
      EXPECT_NEAR(roots[k], truth[k], 1e-6 * std::max(1.0, std::abs(truth[k]))) << "case " << i;
    }
  }
}

TEST(RealRoots, FindsADoubleRootOnceAndRootsOfEvenPolynomials) {
  double c[7];
  expand<6>({0.25, 0.25, -0.5}, c);
  const auto roots = sorted_roots<6>(c);
  ASSERT_FALSE(roots.empty());
  EXPECT_NEAR(roots.front(), -0.5, 1e-9);
  EXPECT_NEAR(roots.back(), 0.25, 1e-6);
  const double even[7] = {-1.0, 0.0, 0.0, 0.0, 16.0, 0.0, 0.0};  // 16 x⁴ = 1
  const auto pair = sorted_roots<6>(even);
  ASSERT_EQ(pair.size(), 2u);
  EXPECT_NEAR(pair[0], -0.5, 1e-12);
  EXPECT_NEAR(pair[1], 0.5, 1e-12);
}

TEST(RealRoots, GivesNothingForZeroConstantAndNaN) {
  const double zero[7] = {};
  const double constant[7] = {3.0};
  double nan[7] = {1.0, 2.0, std::nan(""), 1.0, 0.0, 0.0, 1.0};
  EXPECT_TRUE(sorted_roots<6>(zero).empty());
  EXPECT_TRUE(sorted_roots<6>(constant).empty());
  EXPECT_TRUE(sorted_roots<6>(nan).empty());
  const double inside[7] = {-0.5, 1.0};
  EXPECT_EQ(RealRoots<6>(inside, 0.4).size(), 0);
  EXPECT_EQ(RealRoots<6>(inside, 0.6).size(), 1);
}

}  // namespace
}  // namespace oneac::internal
