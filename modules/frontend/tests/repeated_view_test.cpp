#include "two_view/repeated_view.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

namespace oneac {
namespace {

constexpr double kFocal = 700.0;
constexpr double kFrame_s = 0.1;

/// Tracks from `first` on; `moving` of them go by 5 px, the others rest, to 0.1 px.
TrackedPair tracked(std::size_t count, std::size_t moving, std::size_t first = 0) {
  std::mt19937 generator(static_cast<unsigned>(count + 7 * moving));
  std::normal_distribution<double> noise(0.0, 0.1 / kFocal);
  TrackedPair pair;
  for (std::size_t i = 0; i < count; ++i) {
    Correspondence ac;
    ac.track = first + i;
    ac.point_sigma = 0.1 / kFocal;
    ac.x1 = {0.01 * static_cast<double>(i % 40), 0.01 * static_cast<double>(i / 40)};
    ac.x2 = ac.x1 + Eigen::Vector2d(noise(generator), noise(generator));
    if (i < moving) ac.x2.y() += 5.0 / kFocal;
    pair.correspondences.push_back(ac);
  }
  return pair;
}

class RepeatedViewTest : public testing::Test {
 protected:
  bool repeats(const TrackedPair& pair) {
    time_s_ += kFrame_s;
    return view_.repeats(pair, kFocal, time_s_ - kFrame_s, time_s_);
  }
  RepeatedView view_;
  double time_s_ = 0.0;
};

TEST_F(RepeatedViewTest, IsOneWhereAllThatMovedRests) {
  EXPECT_FALSE(repeats(tracked(200, 150)));
  EXPECT_TRUE(repeats(tracked(200, 0)));
  EXPECT_TRUE(repeats(tracked(200, 0))) << "and once more";
  EXPECT_FALSE(repeats(tracked(200, 150))) << "the drive goes on";
  EXPECT_TRUE(repeats(tracked(200, 0)));
}

TEST_F(RepeatedViewTest, IsNoneWhereWhatRestsHasRestedBefore) {
  EXPECT_FALSE(repeats(tracked(200, 30)));
  EXPECT_FALSE(repeats(tracked(200, 30))) << "dirt, a bonnet, far scenery";
  EXPECT_FALSE(repeats(tracked(200, 8)));
}

TEST_F(RepeatedViewTest, IsNoneOfTracksThatAreNew) {
  EXPECT_FALSE(repeats(tracked(200, 150)));
  EXPECT_FALSE(repeats(tracked(200, 0, 1000)));
}

TEST_F(RepeatedViewTest, IsNoneAfterABumpThatTurnedAll) {
  TrackedPair bump = tracked(200, 30);
  for (Correspondence& ac : bump.correspondences) ac.x2.x() += 3.0 / kFocal;
  EXPECT_FALSE(repeats(bump));
  EXPECT_FALSE(repeats(tracked(200, 30))) << "the near ones go on";
}

TEST_F(RepeatedViewTest, TracksThatAreNewSayNothingAgainstIt) {
  EXPECT_FALSE(repeats(tracked(100, 90)));
  TrackedPair stands = tracked(300, 0);
  stands.standing = true;
  EXPECT_TRUE(repeats(stands));
}

TEST_F(RepeatedViewTest, IsForgottenAfterASecond) {
  EXPECT_FALSE(repeats(tracked(200, 150)));
  time_s_ += 2.0;
  EXPECT_FALSE(repeats(tracked(200, 0)));
}

TEST_F(RepeatedViewTest, IsNotToldByAStandingPictureMostOfWhichNeverMoved) {
  EXPECT_FALSE(repeats(tracked(200, 60)));
  TrackedPair stands = tracked(200, 0);
  stands.standing = true;
  EXPECT_FALSE(repeats(stands));
  EXPECT_FALSE(repeats(tracked(200, 150)));
  EXPECT_TRUE(repeats(stands));
}

TEST_F(RepeatedViewTest, TakesNothingForARepeatBeforeAnythingMoved) {
  EXPECT_FALSE(repeats({}));
  EXPECT_FALSE(repeats(tracked(200, 0)));
  EXPECT_FALSE(repeats(tracked(200, 0)));
}

}  // namespace
}  // namespace oneac
