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

/// The second lap as a drive of its own, whose frame has nothing to do with the first's.
std::vector<LoopKeyframe> two_logs(const std::vector<Eigen::Isometry3d>& truth) {
  auto keyframes = test::drifted(truth, 0.02);
  const Eigen::Isometry3d elsewhere = test::pose_at(900.0, -40.0, 130.0);
  for (std::size_t i = kLap; i < keyframes.size(); ++i) {
    keyframes[i].log = 1;
    keyframes[i].T_first_cam = elsewhere * keyframes[i].T_first_cam;
  }
  return keyframes;
}

TEST_F(Agreement, JoinsTwoLogsThatAgreeOnOnePlacing) {
  const Chain chain = test::chain_of(two_logs(truth_));
  auto loops = true_loops();
  loops.push_back(test::loop_between(truth_, 9, 30 + kLap));  // by chance alike, and not alone:
  loops.back().T_2_1 = test::loop_between(truth_, 30, 30 + kLap).T_2_1;
  EXPECT_TRUE(is_possible(loops.back(), chain));             // nobody knows where the logs lie
  loops.push_back(test::loop_between(truth_, 4, 3 + kLap));  // once more, by a neighbour
  const auto kept = joining(loops, chain, 30.0);
  EXPECT_EQ(kept.size(), true_loops().size());
  EXPECT_EQ(agreeing(kept, chain, 2).size(), kept.size());
}

TEST_F(Agreement, JoinsNoLogsThatMayLieInTwoWays) {
  const Chain chain = test::chain_of(two_logs(truth_));
  auto loops = true_loops();
  const std::size_t own = loops.size();
  // Every street looks like the one before it.
  for (std::size_t i = 0; i + 20 < 60; i += 3) {
    loops.push_back(test::loop_between(truth_, i + 20, i + 20 + kLap));
    loops.back().first = i;
  }
  EXPECT_TRUE(joining(loops, chain, 30.0).empty());
  loops.resize(own + 3);  // three of them deceive nobody
  EXPECT_EQ(joining(loops, chain, 30.0).size(), own);
}

TEST_F(Agreement, GpsKnowsLogsOfAlikeStreetsApart) {
  const auto with_places = [this](double apart_m) {
    auto keyframes = two_logs(truth_);
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
      keyframes[i].place = GpsPlace{truth_[i].translation(), {}};
      if (i >= kLap) keyframes[i].place->point.x() += apart_m;
    }
    return keyframes;
  };
  const auto loop = test::loop_between(truth_, 10, 10 + kLap);
  for (const double near : {0.0, 40.0}) {  // as GPS may be wrong
    const Chain chain = test::chain_of(with_places(near));
    EXPECT_TRUE(may_meet(loop.first, loop.second, chain) && is_possible(loop, chain)) << near;
  }
  const Chain far = test::chain_of(with_places(100.0));
  EXPECT_FALSE(may_meet(loop.first, loop.second, far));
  EXPECT_FALSE(is_possible(loop, far));
  auto of_one = with_places(0.0);
  of_one[loop.second].place.reset();
  EXPECT_TRUE(is_possible(loop, test::chain_of(of_one)));
}

TEST_F(Agreement, StreetsAcrossEachOtherAreNotOnePlaceByGps) {
  const auto possible = [this](double first, double second) {
    auto keyframes = two_logs(truth_);
    const auto loop = test::loop_between(truth_, 10, 10 + kLap);
    keyframes[loop.first].place = GpsPlace{Eigen::Vector3d::Zero(), first};
    keyframes[loop.second].place = GpsPlace{Eigen::Vector3d(40.0, 0.0, 0.0), second};
    return is_possible(loop, test::chain_of(keyframes));
  };
  EXPECT_TRUE(possible(0.1, 2.0 * M_PI - 0.5));
  EXPECT_FALSE(possible(0.1, M_PI / 2));
  EXPECT_FALSE(possible(0.1, -M_PI / 2));
}

TEST_F(Agreement, WithinAPartGpsHasNoSay) {
  auto keyframes = test::drifted(truth_, 0.02);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    keyframes[i].place = GpsPlace{Eigen::Vector3d::UnitX() * 100.0 * static_cast<double>(i), {}};
  }
  EXPECT_TRUE(is_possible(test::loop_between(truth_, 10, 10 + kLap), test::chain_of(keyframes)));
}

TEST_F(Agreement, JoinsNoLogsByAShortStretch) {
  const Chain chain = test::chain_of(two_logs(truth_));
  auto loops = true_loops();
  loops.resize(5);  // along 24 m
  EXPECT_TRUE(joining(loops, chain, 30.0).empty());
  EXPECT_EQ(joining(loops, chain, 20.0).size(), loops.size());
}

TEST_F(Agreement, LeavesToOdometryWhatItKnows) {
  const auto lone = test::loop_between(truth_, 20, 20 + kLap);
  EXPECT_EQ(joining({lone}, chain_, 30.0).size(), 1U);
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
