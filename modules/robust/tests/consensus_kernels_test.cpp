#include "consensus/consensus_kernels.h"

#include "polish/point_arrays.h"

#include "oneac/geometry/essential.h"
#include "oneac/robust/point_set.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace oneac::internal {
namespace {

constexpr SimdLevel kLevels[] = {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512};

std::vector<AffineCorrespondence> scattered(SceneGenerator& scene, std::size_t count) {
  std::vector<AffineCorrespondence> acs(count);
  for (auto& ac : acs) ac = {scene.image_point(), scene.image_point(), Eigen::Matrix2d::Identity()};
  return acs;
}

template <class Number>
PoseNumbers<Number> some_pose() {
  PoseNumbers<Number> pose{};
  const Number R[9] = {Number(0.99), 0, Number(-0.1), 0, 1, 0, Number(0.1), 0, Number(0.99)};
  std::memcpy(pose.R, R, sizeof R);
  pose.t[2] = 1;
  pose.T1[0] = 1;
  pose.T2[1] = 1;
  return pose;
}

template <class Sums>
bool same_bits(const Sums& a, const Sums& b) {
  // Bits are what is compared: −0 is not 0 here.
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(ConsensusKernels, GiveTheSameBitsAtEveryLevel) {
  SceneGenerator scene(41);
  for (std::size_t count : {1U, 15U, 16U, 33U, 250U}) {
    const auto acs = scattered(scene, count);
    const PointSet points(acs);
    const PrecisePointSet precise(acs);
    const float E[9] = {0.1F, -1.0F, 0.02F, 0.9F, 0.0F, -0.3F, 0.01F, 0.2F, 0.0F};
    std::vector<float> entry(16, 0.3F);
    NormalSums<float> sums[3];
    NormalSums<double> precise_sums[3];
    NormalSums<double> newton_sums[3];
    float costs[3][16];
    float msac[3];
    int levels = 0;
    for (SimdLevel level : kLevels) {
      if (!is_supported(level)) continue;
      const ConsensusKernels& k = simd_kernels<ConsensusKernels>(level);
      k.normal_sums(some_pose<float>(), arrays_of(points), 0.1F, sums[levels]);
      k.normal_sums_double(some_pose<double>(), arrays_of(precise), 0.1, precise_sums[levels]);
      k.newton_sums(some_pose<double>(), arrays_of(precise), 0.1, newton_sums[levels]);
      k.planar_costs({entry.data(), entry.data(), entry.data(), entry.data(), 16},
                     arrays_of(points), 4.0F, costs[levels]);
      msac[levels] = k.msac(E, arrays_of(points), 0, points.x1.size() / kPointGroup, 4.0F);
      EXPECT_TRUE(same_bits(sums[levels], sums[0])) << count;
      EXPECT_TRUE(same_bits(precise_sums[levels], precise_sums[0])) << count;
      EXPECT_TRUE(same_bits(newton_sums[levels], newton_sums[0])) << count;
      EXPECT_TRUE(same_bits(costs[levels], costs[0])) << count;
      EXPECT_TRUE(same_bits(msac[levels], msac[0])) << count;
      ++levels;
    }
    EXPECT_GE(levels, 1);
  }
}

TEST(ConsensusKernels, PlanarCostsAreThoseOfTheEssentialMatrix) {
  SceneGenerator scene(42);
  const PointSet points(scattered(scene, 50));
  const RelativePose T = scene.planar_motion();
  const Eigen::Matrix3d E = essential_matrix(T);
  std::vector<float> e12(16, static_cast<float>(E(0, 1))), e21(16, static_cast<float>(E(1, 0)));
  std::vector<float> e23(16, static_cast<float>(E(1, 2))), e32(16, static_cast<float>(E(2, 1)));
  float costs[16];
  constexpr double kThreshold = 0.1;
  simd_kernels<ConsensusKernels>().planar_costs(
      {e12.data(), e21.data(), e23.data(), e32.data(), 16}, arrays_of(points),
      static_cast<float>(1.0 / (kThreshold * kThreshold)), costs);
  EXPECT_NEAR(costs[7], msac_cost(E, points, kThreshold, 1e9), 1e-3);
}

TEST(ConsensusKernels, PaddingWeighsNothing) {
  SceneGenerator scene(43);
  const auto acs = scattered(scene, 16);
  PointSet padded(acs);
  for (auto* v : {&padded.x1, &padded.y1, &padded.x2, &padded.y2, &padded.weight}) {
    v->resize(32, 0.0F);
  }
  NormalSums<float> plain, with_padding;
  const ConsensusKernels& k = simd_kernels<ConsensusKernels>(SimdLevel::kBaseline);
  k.normal_sums(some_pose<float>(), arrays_of(PointSet(acs)), 0.1F, plain);
  k.normal_sums(some_pose<float>(), arrays_of(padded), 0.1F, with_padding);
  EXPECT_TRUE(same_bits(plain, with_padding));
}

}  // namespace
}  // namespace oneac::internal
