#include "scale/length_votes.h"

#include <gtest/gtest.h>

#include <vector>

namespace oneac {
namespace {

TEST(RobustMean, IsNotPulledDownByTrafficAheadThatSeemsToStandStill) {
  std::vector<LengthVote> votes;
  votes.reserve(85);
  for (int i = 0; i < 60; ++i) votes.push_back({0.75 + 0.001 * (i % 7), 0.01, 0.01});
  for (int i = 0; i < 25; ++i) votes.push_back({0.002 * i, 0.003, 0.05});
  EXPECT_NEAR(robust_mean(votes).value, 0.753, 0.01);
}

TEST(RobustMean, IsNotDecidedByAFewDepthsThatClaimToBePerfect) {
  std::vector<LengthVote> votes;
  votes.reserve(206);
  for (int i = 0; i < 200; ++i) votes.push_back({0.75 + 0.001 * (i % 7), 0.01, 0.005});
  for (int i = 0; i < 6; ++i) votes.push_back({0.45, 0.0005, 0.0001});
  EXPECT_NEAR(robust_mean(votes).value, 0.753, 0.01);
}

TEST(RobustMean, SaysHowWellTheVotesAgree) {
  std::vector<LengthVote> tight, loose;
  for (int i = 0; i < 50; ++i) {
    tight.push_back({1.0 + 0.002 * (i % 5 - 2), 0.01, 0.02});
    loose.push_back({1.0 + 0.02 * (i % 5 - 2), 0.01, 0.02});
  }
  EXPECT_LT(robust_mean(tight).relative_sigma, robust_mean(loose).relative_sigma);
}

TEST(LengthVote, IsTheStepThatCarriesThePointToItsImage) {
  const RelativePose step{Eigen::Matrix3d::Identity(), -Eigen::Vector3d::UnitZ()};
  const Eigen::Vector3d X(2.0, 1.5, 12.0);
  const Eigen::Vector3d moved = X + 0.8 * step.t;
  const auto vote = length_vote(step, X, moved.head<2>() / moved.z(), 0.05, 1e-3);
  ASSERT_TRUE(vote.has_value());
  EXPECT_NEAR(vote->length, 0.8, 1e-12);
  EXPECT_GE(vote->sigma(0.8), 0.05 * 0.8);
}

}  // namespace
}  // namespace oneac
