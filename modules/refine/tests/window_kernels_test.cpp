#include "window_kernels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

namespace oneac::internal {
namespace {

constexpr std::size_t kViews = 5;

/// Everything the kernels of one level make of the same random equations.
struct Outcome {
  PoseBlockSum H{}, beside{}, S{};
  PoseSum g{}, rhs{};
  std::vector<WindowLink> links{kViews};
  std::mt19937 random{7};

  explicit Outcome(SimdLevel level) {
    const WindowKernels& kernels = simd_kernels<WindowKernels>(level);
    std::vector<PoseDerivative> J(40);
    std::vector<PointRow> points(J.size());
    std::vector<DerivativePair> own, mixed;
    for (std::size_t i = 0; i < J.size(); ++i) {
      J[i] = derivative();
      points[i] = {{number(), number()},
                   {{number(), number(), number()}, {number(), number(), number()}}};
      kernels.add_coupling(points[i], J[i], links[i % kViews].W);
      own.push_back({&J[i], &J[i], points[i].r});
      mixed.push_back({&J[i], &J[i / 2], points[i].r});
    }
    kernels.add_pairs(own.data(), own.data() + own.size(), H, &g);
    kernels.add_pairs(mixed.data(), mixed.data() + mixed.size(), beside, nullptr);
    const ReducedLandmark landmark{
        {{number(), 0.0, 0.0}, {number(), number(), 0.0}, {number(), number(), number()}},
        {number(), number(), number()}};
    kernels.reduce(landmark, links.data(), links.data() + links.size());
    std::vector<CouplingPair> taken;
    for (const WindowLink& link : links) {
      taken.push_back({&link.reduced, &link.reduced, landmark.g});
    }
    kernels.take_pairs(taken.data(), taken.data() + taken.size(), S, &rhs);
  }

  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  PoseDerivative derivative() {
    PoseDerivative J{};
    for (double(&row)[kPaddedPose] : J.row) {
      for (std::size_t i = 0; i < kPoseNumbers; ++i) row[i] = number();
    }
    return J;
  }
};

TEST(WindowKernels, GiveTheSameBytesAtEveryLevel) {
  const Outcome baseline(SimdLevel::kBaseline);
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (!is_supported(level)) continue;
    const Outcome wide(level);
    EXPECT_EQ(std::memcmp(&baseline.H, &wide.H, sizeof(PoseBlockSum)), 0);
    EXPECT_EQ(std::memcmp(&baseline.beside, &wide.beside, sizeof(PoseBlockSum)), 0);
    EXPECT_EQ(std::memcmp(&baseline.S, &wide.S, sizeof(PoseBlockSum)), 0);
    EXPECT_EQ(std::memcmp(&baseline.g, &wide.g, sizeof(PoseSum)), 0);
    EXPECT_EQ(std::memcmp(&baseline.rhs, &wide.rhs, sizeof(PoseSum)), 0);
    for (std::size_t i = 0; i < kViews; ++i) {
      EXPECT_EQ(
          std::memcmp(&baseline.links[i].reduced, &wide.links[i].reduced, sizeof(CouplingSum)), 0);
    }
  }
}

}  // namespace
}  // namespace oneac::internal
