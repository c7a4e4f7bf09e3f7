#include "agreement.h"

#include "loop_scenes.h"

#include <gtest/gtest.h>

#include <vector>

namespace oneac::internal {
namespace {

constexpr double kSide = 40.0;
constexpr std::size_t kLap = 80;  // keyframes

class Agreement : public ::testing::Test {
 protected:
  const std::vector<Eigen::Isometry3d> truth_ = test::square_drive(kSide, 2);
  const Chain chain_ = test::chain_of(test::drifted(truth_, 0.02));

  [[nodiscard]] std::vector<LoopConstraint> true_loops() const {
    std::vector<LoopConstraint> loops;
    for (std::size_t i = 0; i < 60; i += 3) {
      loops.push_back(test::loop_between(truth_, i, i + kLap));
    }
    return loops;
  }
};

TEST_F(Agreement, KeepsLoopsThatCloseCyclesWithEachOther) {
  EXPECT_EQ(agreeing(true_loops(), chain_, 2).size(), true_loops().size());
}

TEST_F(Agreement, TakesOutWhatNobodySupports) {
  const auto lone = test::loop_between(truth_, 20, 20 + kLap);
  EXPECT_TRUE(agreeing({lone}, chain_, 2).empty());
}

TEST_F(Agreement, TakesOutAFewThatTheirNeighboursContradict) {
  auto loops = true_loops();
  loops[5] = test::loop_between(truth_, 15, 15 + kLap, {1.5, 0.0, 0.0});
  loops[6] = test::loop_between(truth_, 18, 18 + kLap, {0.0, 0.0, -3.0});
  const auto kept = agreeing(loops, chain_, 2);
  EXPECT_EQ(kept.size(), loops.size() - 2);
  for (const LoopConstraint& loop : kept) {
    EXPECT_NE(loop.first, 15U);
    EXPECT_NE(loop.first, 18U);
  }
}

TEST_F(Agreement, TwoStoriesOfOneStretchThatAreEquallyGoodAreBothRefused) {
  auto loops = true_loops();
  loops.resize(5);
  const std::size_t own = loops.size();
  // The same keyframes of the second lap, each claimed by a house 8 m on.
  for (std::size_t i = 0; i < own; ++i) {
    loops.push_back(test::loop_between(truth_, 3 * i, 3 * i + 1 + kLap, {0.0, 0.0, -8.0}));
  }
  EXPECT_LE(agreeing(loops, chain_, 2).size(), own);
}

TEST_F(Agreement, PlacesThatOdometryKnowsApartAreNotCompared) {
  EXPECT_TRUE(may_meet(10, 10 + kLap, chain_));
  EXPECT_FALSE(may_meet(10, 50, chain_));
}

TEST_F(Agreement, OdometryRefusesWhatItKnowsToBeElsewhere) {
  EXPECT_TRUE(is_possible(test::loop_between(truth_, 10, 10 + kLap), chain_));
  // The next street looks alike: keyframe 30 is 90 degrees and many metres from where 90 is.
  LoopConstraint alike = test::loop_between(truth_, 10, 10 + kLap);
  alike.first = 30;
  EXPECT_FALSE(is_possible(alike, chain_));
}

}  // namespace
}  // namespace oneac::internal
