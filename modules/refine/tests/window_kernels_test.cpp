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
  std::vector<PoseBlockSum> H{kViews * (kViews + 1) / 2};
  std::vector<PoseSum> g{kViews};
  std::vector<WindowLink> links{kViews};
  std::mt19937 random{7};

  explicit Outcome(SimdLevel level) {
    const WindowKernels& kernels = simd_kernels<WindowKernels>(level);
    const std::size_t order[kViews] = {3, 0, 4, 1, 2};
    for (std::size_t i = 0; i < kViews; ++i) links[i].view = order[i];
    PoseDerivative before = derivative();
    for (int row = 0; row < 40; ++row) {
      const PoseDerivative J = derivative();
      WindowLink& link = links[static_cast<std::size_t>(row) % kViews];
      const PointRow point{{number(), number()},
                           {{number(), number(), number()}, {number(), number(), number()}}};
      kernels.add_view(point, J, H[block_at(link.view, link.view)], g[link.view], link.W);
      kernels.add_pair(J, before, H[block_at(4, 1)]);
      before = J;
    }
    const ReducedLandmark landmark{
        {{number(), 0.0, 0.0}, {number(), number(), 0.0}, {number(), number(), number()}},
        {number(), number(), number()}};
    kernels.eliminate(landmark, links.data(), links.data() + links.size(), H.data(), g.data());
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
    EXPECT_EQ(std::memcmp(baseline.H.data(), wide.H.data(), sizeof(PoseBlockSum) * wide.H.size()),
              0);
    EXPECT_EQ(std::memcmp(baseline.g.data(), wide.g.data(), sizeof(PoseSum) * wide.g.size()), 0);
    for (std::size_t i = 0; i < kViews; ++i) {
      EXPECT_EQ(
          std::memcmp(&baseline.links[i].reduced, &wide.links[i].reduced, sizeof(CouplingSum)), 0);
    }
  }
}

}  // namespace
}  // namespace oneac::internal
