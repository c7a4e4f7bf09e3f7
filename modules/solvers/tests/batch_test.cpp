#include "oneac/solvers/batch.h"

#include "batch/batch_kernels.h"
#include "solver_test_tools.h"

#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"
#include "oneac/test_support/allocation_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

using namespace test;

/// Correspondences as arrays, and room for their poses.
struct Arrays {
  std::array<std::vector<double>, 8> entries;
  std::array<std::vector<double>, 4> poses;
  std::vector<std::uint8_t> valid;

  explicit Arrays(const std::vector<AffineCorrespondence>& acs) {
    for (const AffineCorrespondence& ac : acs) {
      const double values[8] = {ac.x1.x(),  ac.x1.y(),  ac.x2.x(),  ac.x2.y(),
                                ac.A(0, 0), ac.A(0, 1), ac.A(1, 0), ac.A(1, 1)};
      for (std::size_t k = 0; k < 8; ++k) entries[k].push_back(values[k]);
    }
    for (auto& pose : poses) pose.assign(acs.size() + 1, 77.0);  // a guard behind the last
    valid.assign(acs.size() + 1, 77);
  }
  [[nodiscard]] AcArrays in(std::size_t first, std::size_t size) const {
    const auto at = [&](std::size_t k) { return entries[k].data() + first; };
    return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), size};
  }
  [[nodiscard]] PlanarPoseArrays out() {
    return {poses[0].data(), poses[1].data(), poses[2].data(), poses[3].data(), valid.data()};
  }
  [[nodiscard]] Eigen::Vector4d pose(std::size_t i) const {
    return {poses[0][i], poses[1][i], poses[2][i], poses[3][i]};
  }
};

struct Forms {
  const char* name;
  SolutionSet<PlanarPose, 1> (*scalar)(const AffineCorrespondence&);
  std::size_t (*batch)(const AcArrays&, const PlanarPoseArrays&, SimdLevel);
  internal::BatchKernel kernel;
};

class BatchSolver : public testing::TestWithParam<Forms> {};

std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> list;
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (is_supported(level)) list.push_back(level);
  }
  return list;
}

/// The batch on acs[first …] against the scalar solver, one by one.
void expect_equal(const Forms& forms, const std::vector<AffineCorrespondence>& acs,
                  std::size_t first, SimdLevel level) {
  Arrays arrays(acs);
  const std::size_t size = acs.size() - first;
  const std::size_t count = forms.batch(arrays.in(first, size), arrays.out(), level);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto expected = forms.scalar(acs[first + i]);
    ASSERT_EQ(arrays.valid[i], expected.size()) << i << " at level " << static_cast<int>(level);
    valid += expected.size();
    Eigen::Vector4d pose(1.0, 0.0, 0.0, 0.0);
    if (!expected.empty()) {
      const PlanarPose& p = expected[0];
      pose << p.cos_alpha, p.sin_alpha, p.tx, p.tz;
    }
    ASSERT_LT((arrays.pose(i) - pose).cwiseAbs().maxCoeff(), 1e-9)
        << i << " at level " << static_cast<int>(level);
  }
  EXPECT_EQ(count, valid);
  EXPECT_EQ(arrays.valid[size], 77);
  EXPECT_EQ(arrays.pose(size), Eigen::Vector4d::Constant(77.0));
}

/// A scene as the solvers get it: exact, noisy, wrong, degenerate and broken correspondences.
AffineCorrespondence mixed(SceneGenerator& scene, int i) {
  const RelativePose T = scene.planar_motion();
  const double sigma = std::pow(10.0, scene.uniform(-6.0, -1.0));
  auto ground = scene.on_plane(T, scene.ground());
  switch (i % 16) {
    case 0:
      return ground;
    case 1:
      return scene.on_plane(T, scene.any_plane());
    case 2:
      return pure_rotation(scene.uniform(-0.5, 0.5), scene.image_point());
    case 3:
      return on_horizon(T, {Eigen::Vector3d(0.3, 0.4, 0.9).normalized(), 10.0}, 0.2);
    case 4: {
      const auto list = faults(ground);
      return list[static_cast<std::size_t>(i / 16) % list.size()].ac;
    }
    case 5: {  // next to the horizon and to no motion
      const RelativePose small{T.R, T.t * std::pow(10.0, scene.uniform(-12.0, -3.0))};
      return scene.on_plane(small, scene.ground());
    }
    case 6: {  // any numbers at all
      const auto wild = [&] { return scene.normal(1.0) * std::pow(10.0, scene.uniform(-90, 90)); };
      AffineCorrespondence ac{{wild(), wild()}, {wild(), wild()}, Eigen::Matrix2d::Zero()};
      ac.A << wild(), wild(), wild(), wild();
      return ac;
    }
    case 7:  // outliers
      return {scene.image_point(), scene.image_point(),
              Eigen::Matrix2d::Identity() + 0.3 * scene.with_noise(ground, 0.0, 1.0).A};
    default:
      return scene.with_noise(i % 2 == 0 ? ground : scene.on_plane(T, scene.any_plane()), sigma,
                              10.0 * sigma);
  }
}

TEST_P(BatchSolver, EqualsTheScalarSolverOnHundredThousandCorrespondencesAtEveryLevel) {
  SceneGenerator scene(1);
  std::vector<AffineCorrespondence> acs;
  acs.reserve(100000);
  for (int i = 0; i < 100000; ++i) acs.push_back(mixed(scene, i));
  for (const SimdLevel level : levels()) expect_equal(GetParam(), acs, 0, level);
}

TEST_P(BatchSolver, AnySizeAndAlignmentWillDo) {
  SceneGenerator scene(2);
  std::vector<AffineCorrespondence> acs;
  for (int i = 0; i < 40; ++i) {
    for (const SimdLevel level : levels()) {
      for (std::size_t first = 0; first < std::min<std::size_t>(acs.size(), 4); ++first) {
        expect_equal(GetParam(), acs, first, level);
      }
      expect_equal(GetParam(), acs, acs.size(), level);
    }
    acs.push_back(mixed(scene, i));
  }
}

TEST_P(BatchSolver, KernelItselfDecidesNearlyAllOfANoisyScene) {
  SceneGenerator scene(3);
  std::vector<AffineCorrespondence> acs;
  acs.reserve(1000);
  const RelativePose T = scene.planar_motion();
  const Plane ground = scene.ground();
  for (int i = 0; i < 1000; ++i) {
    acs.push_back(scene.with_noise(scene.on_plane(T, ground), 1e-3, 2e-2));
  }
  Arrays arrays(acs);
  const AcArrays in = arrays.in(0, acs.size());
  const PlanarPoseArrays out = arrays.out();
  GetParam().kernel({{in.x1, in.y1, in.x2, in.y2, in.a11, in.a12, in.a21, in.a22}},
                    {{out.cos_alpha, out.sin_alpha, out.tx, out.tz}, out.valid}, acs.size());
  const auto undecided =
      std::count(arrays.valid.begin(), arrays.valid.end(), internal::kBatchUndecided);
  EXPECT_LE(undecided, 20);
}

TEST_P(BatchSolver, LevelsAgree) {
  SceneGenerator scene(4);
  std::vector<AffineCorrespondence> acs;
  acs.reserve(1000);
  for (int i = 0; i < 1000; ++i) acs.push_back(mixed(scene, i));
  Arrays baseline(acs), widest(acs);
  GetParam().batch(baseline.in(0, acs.size()), baseline.out(), SimdLevel::kBaseline);
  GetParam().batch(widest.in(0, acs.size()), widest.out(), best_simd_level());
  EXPECT_EQ(baseline.valid, widest.valid);
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const double scale = std::max(1.0, baseline.pose(i).norm());
    EXPECT_LT((baseline.pose(i) - widest.pose(i)).norm(), 1e-9 * scale) << i;
  }
}

TEST_P(BatchSolver, MisuseThrowsAndNamesTheArgument) {
  SceneGenerator scene(5);
  Arrays arrays({mixed(scene, 0)});
  using In = const double* AcArrays::*;
  for (const In array : {&AcArrays::x1, &AcArrays::y1, &AcArrays::x2, &AcArrays::y2, &AcArrays::a11,
                         &AcArrays::a12, &AcArrays::a21, &AcArrays::a22}) {
    AcArrays acs = arrays.in(0, 1);
    acs.*array = nullptr;
    EXPECT_THROW(GetParam().batch(acs, arrays.out(), SimdLevel::kBaseline), std::invalid_argument);
  }
  using Out = double* PlanarPoseArrays::*;
  for (const Out array : {&PlanarPoseArrays::cos_alpha, &PlanarPoseArrays::sin_alpha,
                          &PlanarPoseArrays::tx, &PlanarPoseArrays::tz}) {
    PlanarPoseArrays poses = arrays.out();
    poses.*array = nullptr;
    EXPECT_THROW(GetParam().batch(arrays.in(0, 1), poses, SimdLevel::kBaseline),
                 std::invalid_argument);
  }
  PlanarPoseArrays no_mask = arrays.out();
  no_mask.valid = nullptr;
  EXPECT_THROW(GetParam().batch(arrays.in(0, 1), no_mask, SimdLevel::kBaseline),
               std::invalid_argument);
  EXPECT_EQ(GetParam().batch({}, {}, SimdLevel::kBaseline), 0u);
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (is_supported(level)) continue;
    EXPECT_THROW(GetParam().batch({}, {}, level), std::invalid_argument);
  }
}

TEST_P(BatchSolver, DoesNotAllocate) {
  SceneGenerator scene(6);
  std::vector<AffineCorrespondence> acs;
  acs.reserve(133);
  for (int i = 0; i < 133; ++i) acs.push_back(mixed(scene, i));
  Arrays arrays(acs);
  const AcArrays in = arrays.in(0, acs.size());
  const PlanarPoseArrays out = arrays.out();
  for (const SimdLevel level : levels()) {
    const std::size_t before = allocation_count();
    const std::size_t valid = GetParam().batch(in, out, level);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_GT(valid, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Solvers, BatchSolver,
    testing::Values(
        Forms{"Ground", &relpose_1ac_ground, &relpose_1ac_ground_batch,
              internal::simd_kernels_at<internal::BatchKernels, SimdLevel::kBaseline>().ground},
        Forms{"Planar", &relpose_1ac_planar, &relpose_1ac_planar_batch,
              internal::simd_kernels_at<internal::BatchKernels, SimdLevel::kBaseline>().planar}),
    [](const auto& forms) { return std::string(forms.param.name); });

}  // namespace
}  // namespace oneac
