#include "oneac/robust/graph_cut.h"

#include "oneac/robust/samplers.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace oneac {
namespace {

/// The energy as the paper writes it.
double energy(const std::vector<double>& squared, const NeighbourPairs& pairs, double weight,
              const std::vector<std::uint8_t>& labels) {
  const auto K = [&](std::size_t p) { return std::exp(-0.5 * squared[p]); };
  double sum = 0.0;
  for (std::size_t p = 0; p < squared.size(); ++p) sum += labels[p] != 0 ? 1.0 - K(p) : K(p);
  for (const auto& [p, q] : pairs) {
    const double mean = 0.5 * (K(p) + K(q));
    const double both = labels[p] != 0 ? 1.0 - mean : mean;
    sum += weight * (labels[p] != labels[q] ? 1.0 : both);
  }
  return sum;
}

TEST(SpatialCut, FindsTheGlobalMinimumOfTheEnergy) {
  SceneGenerator random(41);
  constexpr std::size_t kPoints = 10;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> squared(kPoints);
    for (double& s : squared) s = random.uniform(0.0, 4.0);
    NeighbourPairs pairs;
    for (std::uint32_t p = 0; p < kPoints; ++p) {
      for (std::uint32_t q = p + 1; q < kPoints; ++q) {
        if (random.uniform(0.0, 1.0) < 0.3) pairs.emplace_back(p, q);
      }
    }
    SpatialCut cut(kPoints, pairs, 0.5);
    std::vector<std::uint8_t> labels;
    (void)cut.label(squared, labels);
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::uint8_t> other(kPoints);
    for (std::size_t bits = 0; bits < (1U << kPoints); ++bits) {
      for (std::size_t p = 0; p < kPoints; ++p) other[p] = (bits >> p) & 1U;
      least = std::min(least, energy(squared, pairs, 0.5, other));
    }
    EXPECT_NEAR(energy(squared, pairs, 0.5, labels), least, 1e-9) << "trial " << trial;
  }
}

TEST(SpatialCut, LabelsAnUndecidedPointAsItsCoherentNeighbours) {
  // Points 0 … 4: a good cluster and an undecided member. 5 … 9: the same member among bad ones.
  std::vector<double> squared{0.1, 0.1, 0.1, 0.1, 1.5, 20.0, 20.0, 20.0, 20.0, 1.3};
  NeighbourPairs pairs;
  for (std::uint32_t p = 0; p < 4; ++p) {
    pairs.emplace_back(p, 4);
    pairs.emplace_back(p + 5, 9);
  }
  std::vector<std::uint8_t> labels;
  SpatialCut coherent(10, pairs, 0.3);
  EXPECT_EQ(coherent.label(squared, labels), 5U);
  EXPECT_EQ(labels[4], 1);
  EXPECT_EQ(labels[9], 0);
  SpatialCut alone(10, pairs, 0.0);
  EXPECT_EQ(alone.label(squared, labels), 5U);
  EXPECT_EQ(labels[4], 0);
  EXPECT_EQ(labels[9], 1);
}

TEST(SpatialCut, CanBeUsedAgainAndTakesInfiniteErrors) {
  SpatialCut cut(3, {{0, 1}, {1, 2}}, 0.14);
  std::vector<std::uint8_t> labels;
  EXPECT_EQ(cut.label({0.0, 0.0, 0.0}, labels), 3U);
  EXPECT_EQ(cut.label({0.0, 0.0, std::numeric_limits<double>::infinity()}, labels), 2U);
  EXPECT_EQ(cut.label({0.0, 0.0, 0.0}, labels), 3U);
}

TEST(SpatialCut, AnErrorThatIsNoNumberIsNoInliers) {
  std::vector<double> squared{0.1, std::numeric_limits<double>::quiet_NaN(), 0.2, 20.0};
  const NeighbourPairs pairs{{0, 1}, {1, 2}, {1, 3}, {0, 2}};
  for (const double weight : {0.0, 0.3}) {
    std::vector<std::uint8_t> labels;
    EXPECT_EQ(SpatialCut(4, pairs, weight).label(squared, labels), 2U);
    EXPECT_EQ(labels, (std::vector<std::uint8_t>{1, 0, 1, 0}));
  }
}

TEST(GridNeighbours, ShareTheirCellInBothViews) {
  std::vector<AffineCorrespondence> acs(5);
  acs[0].x1 = {0.0, 0.0};
  acs[1].x1 = {0.01, 0.01};
  acs[2].x1 = {0.02, 0.0};  // beside them in the first view only
  acs[3].x1 = {1.0, 1.0};
  acs[4].x1 = {0.99, 0.99};
  for (auto& ac : acs) ac.x2 = ac.x1;
  acs[2].x2 = {0.9, 0.1};
  acs[4].x2 = {7.0, 1e9};  // beyond the box: counts to the border
  const NeighbourPairs pairs = grid_neighbours(acs, 8);
  EXPECT_EQ(pairs, (NeighbourPairs{{0, 1}, {3, 4}}));
  EXPECT_TRUE(grid_neighbours({}, 8).empty());
  EXPECT_THROW((void)grid_neighbours(acs, 0), std::invalid_argument);
}

TEST(GridNeighbours, AreBoundedInACrowd) {
  const std::vector<AffineCorrespondence> crowd(1000);
  EXPECT_LE(grid_neighbours(crowd, 8).size(), 1000U * kMaxNeighbours);
}

TEST(GridNeighbours, HaveCellsOfTheirOwnAsFarApartAsDoublesGo) {
  constexpr double kFar = 1.7e308;
  std::vector<AffineCorrespondence> acs(6);
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const std::size_t couple = i / 2;
    acs[i].x1.setConstant(kFar * (static_cast<double>(couple) - 1.0));
    acs[i].x2 = acs[i].x1;
  }
  const NeighbourPairs expected = {{0, 1}, {2, 3}, {4, 5}};
  EXPECT_EQ(grid_neighbours(acs, 8), expected);
}

TEST(UniformSampler, DrawsDistinctIndicesOfAll) {
  UniformSampler sampler(9, 5, 1);
  std::set<std::size_t> seen;
  for (int i = 0; i < 200; ++i) {
    std::size_t sample[5];
    sampler.draw(sample);
    EXPECT_EQ(std::set<std::size_t>(sample, sample + 5).size(), 5U);
    seen.insert(sample, sample + 5);
  }
  EXPECT_EQ(seen.size(), 9U);
  EXPECT_LT(*seen.rbegin(), 9U);
}

TEST(UniformSampler, DrawsEverySingleOnce) {
  UniformSampler sampler(50, 1, 1);
  EXPECT_EQ(sampler.distinct(), 50U);
  std::set<std::size_t> seen;
  for (int i = 0; i < 50; ++i) {
    std::size_t sample[1];
    sampler.draw(sample);
    seen.insert(sample[0]);
  }
  EXPECT_EQ(seen.size(), 50U);
}

TEST(ProsacSampler, TakesTheBestFirstAndAllInTheEnd) {
  ProsacSampler sampler(100, 4, 1);
  std::size_t sample[4];
  sampler.draw(sample);
  EXPECT_EQ(std::set<std::size_t>(sample, sample + 4), (std::set<std::size_t>{0, 1, 2, 3}));
  std::size_t last = sampler.subset();
  for (int i = 0; i < 250000; ++i) {
    sampler.draw(sample);
    ASSERT_EQ(std::set<std::size_t>(sample, sample + 4).size(), 4U);
    ASSERT_GE(sampler.subset(), last);
    last = sampler.subset();
    ASSERT_LT(*std::max_element(sample, sample + 4), last);
  }
  EXPECT_EQ(last, 100U);
}

TEST(ProsacSampler, DrawsSinglesInTheirOrder) {
  ProsacSampler sampler(20, 1, 1);
  for (std::size_t i = 0; i < 20; ++i) {
    std::size_t sample[1];
    sampler.draw(sample);
    EXPECT_EQ(sample[0], i);
  }
}

}  // namespace
}  // namespace oneac
