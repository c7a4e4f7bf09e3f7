#include "scale/first_rest.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

constexpr double kFocal = 500.0, kFrame = 0.1;  // [px], [s]
constexpr int kPoints = 100;

/// A drive that two views take for a rest, of whose points some drift by so much a frame.
class Rest {
 public:
  Rest(int drifting, double drift_px, int first_frame = 0)
      : drifting_(drifting), drift_(drift_px / kFocal), frame_(first_frame) {}

  void go_on(FirstRest& rest, int frames, StepStatus status = StepStatus::kNoMotion) {
    for (int i = 0; i < frames; ++i, ++frame_) {
      TwoView seen;
      seen.status = status;
      seen.focal_px = kFocal;
      for (int p = 0; p < kPoints; ++p) seen.pair.correspondences.push_back(point(p));
      rest.follow(seen, kFrame * frame_, kFrame * (frame_ + 1));
    }
  }

 private:
  [[nodiscard]] Correspondence point(int p) const {
    const double drift = p < drifting_ ? drift_ : 0.0;
    Correspondence ac;
    ac.track = static_cast<std::uint64_t>(p);
    ac.x1 = {0.01 * p + drift * frame_, 0.0};
    ac.x2 = {0.01 * p + drift * (frame_ + 1), 0.0};
    return ac;
  }

  int drifting_;
  double drift_;
  int frame_;
};

TEST(FirstRest, IsSureWhenNearlyAllKeepsItsPlaceForASecond) {
  FirstRest rest;
  Rest drive(5, 3.0);  // people pass
  drive.go_on(rest, 9);
  EXPECT_FALSE(rest.is_sure());
  drive.go_on(rest, 2);
  EXPECT_TRUE(rest.is_sure());
}

TEST(FirstRest, IsNoneWhereOnlyABonnetKeepsItsPlace) {
  FirstRest rest;
  Rest drive(40, 0.2);  // far scenery, by less a frame than two views can tell
  drive.go_on(rest, 50);
  EXPECT_FALSE(rest.is_sure());
}

TEST(FirstRest, IsFoundWhenTrafficHasPassed) {
  FirstRest rest;
  Rest(60, 5.0).go_on(rest, 15);
  ASSERT_FALSE(rest.is_sure());
  Rest(0, 0.0, 15).go_on(rest, 25);
  EXPECT_TRUE(rest.is_sure());
}

TEST(FirstRest, EndsWithTheFirstMotion) {
  FirstRest rest;
  Rest drive(0, 0.0);
  drive.go_on(rest, 15);
  ASSERT_TRUE(rest.is_sure());
  drive.go_on(rest, 1, StepStatus::kOk);
  EXPECT_FALSE(rest.is_sure());
  drive.go_on(rest, 30);
  EXPECT_FALSE(rest.is_sure()) << "what rests now may be the car's own parts";
}

TEST(FirstRest, AFewPointsSayNothing) {
  FirstRest rest;
  for (int i = 0; i < 30; ++i) {
    TwoView seen;
    seen.status = StepStatus::kNoMotion;
    seen.pair.correspondences.resize(5);
    rest.follow(seen, kFrame * i, kFrame * (i + 1));
  }
  EXPECT_FALSE(rest.is_sure());
}

}  // namespace
}  // namespace oneac
