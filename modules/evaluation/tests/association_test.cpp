#include "oneac/evaluation/association.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

RelativePoseRow pair_of(std::size_t index1, std::size_t index2) {
  RelativePoseRow row;
  row.index1 = index1;
  row.index2 = index2;
  row.t1 = 0.1 * static_cast<double>(index1);
  row.t2 = 0.1 * static_cast<double>(index2);
  return row;
}

std::vector<std::pair<std::size_t, std::size_t>> as_pairs(const std::vector<RowMatch>& matches) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  pairs.reserve(matches.size());
  for (const RowMatch& match : matches) pairs.emplace_back(match.estimate, match.reference);
  return pairs;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(ProcessedFrames, FollowTheChainOfPairs) {
  const auto frames = processed_frames({pair_of(10, 13), pair_of(13, 16)});
  ASSERT_TRUE(frames);
  EXPECT_EQ(frames->indices, (std::vector<std::size_t>{10, 13, 16}));
  EXPECT_DOUBLE_EQ(frames->times.at(2), 1.6);
}

TEST(ProcessedFrames, AreEmptyWithoutOneChain) {
  EXPECT_FALSE(processed_frames({}));
  EXPECT_FALSE(processed_frames({pair_of(0, 1), pair_of(2, 3)}));
}

TEST(TimeTolerance, IsHalfTheMedianSpacingUpToTenMilliseconds) {
  EXPECT_NEAR(time_tolerance({0.0, 0.004, 0.008, 1.0}), 0.002, 1e-12);
  EXPECT_EQ(time_tolerance({0.0, 0.1, 0.2}), 0.01);
  EXPECT_EQ(time_tolerance({0.0}), 0.01);
}

TEST(NearestRow, PicksTheCloserNeighbourWithinTheTolerance) {
  const std::vector<double> times{1.0, 2.0, 3.0};
  EXPECT_EQ(nearest_row(times, 2.4, 0.5), 1U);
  EXPECT_EQ(nearest_row(times, 2.6, 0.5), 2U);
  EXPECT_EQ(nearest_row(times, 0.9, 0.5), 0U);
  EXPECT_EQ(nearest_row(times, 3.2, 0.5), 2U);
  EXPECT_EQ(nearest_row(times, 2.5, 0.5), 1U);
  EXPECT_FALSE(nearest_row(times, 2.4, 0.3));
  EXPECT_FALSE(nearest_row(times, 9.0, 0.5));
  EXPECT_FALSE(nearest_row({}, 1.0, 0.5));
}

TEST(MatchByRow, StopsWithTheShorter) {
  EXPECT_EQ(as_pairs(match_by_row(2, 3)), (Pairs{{0, 0}, {1, 1}}));
}

TEST(MatchByIndex, LeavesOutWhatTheReferenceLacks) {
  EXPECT_EQ(as_pairs(match_by_index({4, 6, 8}, 8)), (Pairs{{0, 4}, {1, 6}}));
}

TEST(MatchByTime, MatchesTheSameMomentsOnly) {
  const auto matches = match_by_time({0.0, 0.1, 0.2, 0.3}, {0.101, 0.15, 0.295, 5.0});
  EXPECT_EQ(as_pairs(matches), (Pairs{{1, 0}, {3, 2}}));
}

TEST(MatchByTime, UsesAReferenceRowOnceForTheNearest) {
  // Median spacing 0.1 s, but two rows lie 8 ms apart around the one reference row.
  const auto matches = match_by_time({0.0, 0.1, 0.108, 0.208, 0.308}, {0.107});
  EXPECT_EQ(as_pairs(matches), (Pairs{{2, 0}}));
}

}  // namespace
}  // namespace oneac
