#include "patch/patch_flow.h"

#include "texture.h"

#include <gtest/gtest.h>

namespace oneac::internal {
namespace {

/// Two views of a texture, the second moved by a few pixels and a little nearer.
class PatchFlowTest : public ::testing::Test {
 protected:
  PatchFlowTest() {
    view_.shift = {7.0, -3.0};
    view_.A *= 1.02;
    view_.noise = 1.0;
    first_ = build_pyramid(render(Texture(41), View{}).view(), options_.levels);
    second_ = build_pyramid(render(Texture(41), view_).view(), options_.levels);
  }

  /// The guess that is off by so much, tried at a level.
  [[nodiscard]] FlowGuess guess(const Eigen::Vector2d& error_px, std::size_t level) const {
    FlowGuess guess;
    guess.warp.M = view_.A;
    guess.warp.centre = view_.map(u_) + error_px;
    guess.level = level;
    return guess;
  }
  [[nodiscard]] std::optional<PatchMatch> found(const std::vector<FlowGuess>& guesses) const {
    PatchMemory memory;
    memory.knows_shape = true;
    return PatchFlow(first_, second_, options_).find(u_, guesses, memory);
  }

  KltOptions options_;
  View view_;
  ImagePyramid first_, second_;
  Eigen::Vector2d u_{150.25, 140.5};
};

TEST_F(PatchFlowTest, FindsAPatchAtThePlaceForetoldAsTheSearchDoes) {
  const auto foretold = found({guess({0.4, -0.5}, 0)});
  const auto searched = found({guess({0.4, -0.5}, 2)});
  ASSERT_TRUE(foretold);
  ASSERT_TRUE(searched);
  EXPECT_LT((foretold->warp.centre - searched->warp.centre).norm(), 0.01);
  EXPECT_LT((foretold->warp.M - searched->warp.M).norm(), 0.005);
  EXPECT_LT((foretold->warp.centre - view_.map(u_)).norm(), 0.2);
}

TEST_F(PatchFlowTest, DoesNotBelieveWhatLiesElsewhereThanForetold) {
  EXPECT_FALSE(found({guess({2.0, 1.5}, 0)}));
  EXPECT_TRUE(found({guess({2.0, 1.5}, 0), guess({2.0, 1.5}, 2)})) << "a search finds it";
}

}  // namespace
}  // namespace oneac::internal
