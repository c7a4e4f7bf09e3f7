#include "window_costs.h"

#include "window_scenes.h"

#include <array>
#include <cmath>
#include <vector>

namespace oneac::test {
namespace {

/// Analytic Jacobian of a cost against central differences, poses moved through their manifold.
void expect_jacobians_agree(const ceres::CostFunction& cost,
                            std::vector<std::vector<double>> blocks) {
  const PoseManifold manifold;
  const auto rows = static_cast<std::size_t>(cost.num_residuals());
  const auto evaluate = [&](double** jacobians) {
    std::vector<const double*> pointers;
    pointers.reserve(blocks.size());
    for (const auto& block : blocks) pointers.push_back(block.data());
    std::vector<double> residuals(rows);
    EXPECT_TRUE(cost.Evaluate(pointers.data(), residuals.data(), jacobians));
    return residuals;
  };
  std::vector<std::vector<double>> analytic;
  std::vector<double*> pointers;
  analytic.reserve(blocks.size());
  pointers.reserve(blocks.size());
  for (const auto& block : blocks) analytic.emplace_back(rows * block.size());
  for (auto& jacobian : analytic) pointers.push_back(jacobian.data());
  static_cast<void>(evaluate(pointers.data()));
  constexpr double kStep = 1e-6;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const bool pose = blocks[b].size() == 7;
    const std::size_t tangent = pose ? 6 : blocks[b].size();
    for (std::size_t k = 0; k < tangent; ++k) {
      std::array<std::vector<double>, 2> ends;
      const std::vector<double> kept = blocks[b];
      for (std::size_t side = 0; side < 2; ++side) {
        const double step = side == 0 ? -kStep : kStep;
        if (pose) {
          std::array<double, 6> delta{};
          delta[k] = step;
          manifold.Plus(kept.data(), delta.data(), blocks[b].data());
        } else {
          blocks[b][k] += step;
        }
        ends[side] = evaluate(nullptr);
        blocks[b] = kept;
      }
      for (std::size_t r = 0; r < rows; ++r) {
        const double numeric = (ends[1][r] - ends[0][r]) / (2.0 * kStep);
        EXPECT_NEAR(analytic[b][r * kept.size() + k], numeric, 1e-6 * (1.0 + std::abs(numeric)))
            << "block " << b << ", column " << k << ", residual " << r;
      }
    }
  }
}

std::vector<double> pose_block(const RelativePose& pose) {
  std::vector<double> block(7);
  store_pose(pose, block.data());
  return block;
}

class WindowCosts : public ::testing::Test {
 protected:
  SceneGenerator generator_{71};
  RelativePose first_ = generator_.general_motion();
  RelativePose second_ =
      RelativePose{rotation_from_vector({0.05, -0.1, 0.02}), Eigen::Vector3d(0.1, -0.2, -1.0)} *
      first_;
  WindowLandmark patch_ = random_patch(generator_, 0);

  [[nodiscard]] std::vector<double> patch_block(std::size_t size) const {
    std::vector<double> block{patch_.x.x(), patch_.x.y(), patch_.inverse_depth, patch_.gradient.x(),
                              patch_.gradient.y()};
    block.resize(size);
    return block;
  }
};

TEST_F(WindowCosts, ReprojectionHasTheDerivativesOfItsValues) {
  const Eigen::Vector2d x(0.1, 0.05);
  expect_jacobians_agree(ReprojectionCost<3>(x, 0.01),
                         {pose_block(first_), pose_block(second_), patch_block(3)});
  expect_jacobians_agree(ReprojectionCost<5>(x, 0.01),
                         {pose_block(first_), pose_block(second_), patch_block(5)});
}

TEST_F(WindowCosts, AffinityHasTheDerivativesOfItsValues) {
  Eigen::Matrix2d A;
  A << 1.1, 0.1, -0.05, 0.9;
  expect_jacobians_agree(AffinityCost(A, 0.1),
                         {pose_block(first_), pose_block(second_), patch_block(5)});
}

TEST_F(WindowCosts, AnchorHasTheDerivativesOfItsValues) {
  expect_jacobians_agree(AnchorCost<3>({0.1, 0.2}, 0.01), {patch_block(3)});
  expect_jacobians_agree(AnchorCost<5>({0.1, 0.2}, 0.01), {patch_block(5)});
}

TEST_F(WindowCosts, PlanarMotionHasTheDerivativesOfItsValues) {
  const PlanarPrior prior{{0.1, 0.99, 0.05}, {0.99, -0.1, 0.0}, {0.0, -0.05, 0.99}, 0.1, 0.05};
  expect_jacobians_agree(PlanarMotionCost(prior), {pose_block(first_), pose_block(second_)});
}

TEST_F(WindowCosts, PlanarMotionIsZeroForAPlanarStep) {
  const double s = std::sin(0.1);
  const RelativePose step{yaw_rotation(std::cos(0.1), s), Eigen::Vector3d(0.3, 0.0, -1.0)};
  const PlanarMotionCost cost(
      PlanarPrior{{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.1, 0.05});
  const auto a = pose_block(first_);
  const auto b = pose_block(step * first_);
  const double* blocks[] = {a.data(), b.data()};
  double residuals[3];
  ASSERT_TRUE(cost.Evaluate(blocks, residuals, nullptr));
  for (const double residual : residuals) EXPECT_NEAR(residual, 0.0, 1e-9);
}

TEST_F(WindowCosts, ReprojectionAndAffinityVanishForTheHomographyOfThePatch) {
  SlidingWindow window;
  window.views = {{first_, false}, {second_, false}};
  window.landmarks = {patch_};
  WindowObservation seen;
  ASSERT_TRUE(observe(generator_, window, 0, 1, {}, seen));
  const auto a = pose_block(first_);
  const auto b = pose_block(second_);
  const auto p = patch_block(5);
  const double* blocks[] = {a.data(), b.data(), p.data()};
  double residuals[4];
  ASSERT_TRUE(ReprojectionCost<5>(seen.x, 1.0).Evaluate(blocks, residuals, nullptr));
  EXPECT_NEAR(std::hypot(residuals[0], residuals[1]), 0.0, 1e-12);
  ASSERT_TRUE(AffinityCost(seen.A, 1.0).Evaluate(blocks, residuals, nullptr));
  for (const double residual : residuals) EXPECT_NEAR(residual, 0.0, 1e-12);
}

TEST_F(WindowCosts, PoseManifoldIsOne) {
  const auto x = pose_block(first_);
  const auto y = pose_block(second_);
  const PoseManifold manifold;
  double delta[6];
  manifold.Minus(y.data(), x.data(), delta);
  double back[7];
  manifold.Plus(x.data(), delta, back);
  const RelativePose pose = load_pose(back);
  EXPECT_LT((pose.R - second_.R).norm(), 1e-12);
  EXPECT_LT((pose.t - second_.t).norm(), 1e-12);
}

}  // namespace
}  // namespace oneac::test
