#include "texture.h"
#include "track_numbers.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

std::unique_ptr<AcTracker> klt(double broken_share) {
  FeatureOptions options;
  options.klt.broken_share = broken_share;
  return make_tracker(options);
}

double default_share() {
  return KltOptions{}.broken_share;
}

TrackedPair feed(AcTracker& tracker, const GreyImage& image) {
  return tracker.advance(tracker.prepare(image.view()), {});
}

/// As if many frames were missing: farther than the top of the pyramid sees, turned and nearer.
View jump() {
  const double angle = 30.0 * 3.14159265358979 / 180.0;
  View view;
  view.A << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  view.A *= 1.25;
  view.shift = {80.0, -40.0};
  view.noise = 1.0;
  view.seed = 5;
  return view;
}

View after_jump() {
  View view = jump();
  view.shift.x() += 5.0;
  view.seed = 6;
  return view;
}

View drive(int frame) {
  View view;
  view.A *= std::pow(1.01, frame);
  view.shift = {-4.0 * frame, 0.0};
  view.noise = 1.0;
  view.seed = 10 + static_cast<std::uint64_t>(frame);
  return view;
}

TEST(Rematch, SiftFindsTheWayWhenTrackingBreaks) {
  const Texture texture(61);
  const auto with = klt(default_share()), without = klt(0.0);
  const GreyImage before = render(texture, View{}), after = render(texture, jump());
  static_cast<void>(feed(*with, before));
  static_cast<void>(feed(*without, before));
  EXPECT_LT(feed(*without, after).size(), 20U);
  const TrackedPair pair = feed(*with, after);
  ASSERT_GT(pair.size(), 100U);
  std::size_t right = 0;
  for (const auto& ac : pair.correspondences) {
    const bool near = (ac.x2 - jump().map(ac.x1)).norm() < 1.0 && (ac.A - jump().A).norm() < 0.1;
    right += near ? 1 : 0;
  }
  EXPECT_GE(right, pair.size() * 99 / 100);
}

TEST(Rematch, WhatWasFoundAgainIsTrackedOn) {
  const Texture texture(62);
  const auto tracker = klt(default_share());
  static_cast<void>(feed(*tracker, render(texture, View{})));
  const TrackedPair found = feed(*tracker, render(texture, jump()));
  const TrackedPair next = feed(*tracker, render(texture, after_jump()));
  std::map<std::uint64_t, AffineCorrespondence> known;
  for (const Correspondence& ac : found.correspondences) known[ac.track] = ac;
  EXPECT_EQ(known.size(), found.size());
  std::size_t followed = 0;
  for (const Correspondence& ac : next.correspondences) {
    const auto before = known.find(ac.track);
    if (before == known.end()) continue;
    ++followed;
    EXPECT_LT((ac.A * before->second.A - after_jump().A).norm(), 0.2);
    EXPECT_LT((ac.x2 - after_jump().map(before->second.x1)).norm(), 1.5);
  }
  EXPECT_GT(followed, found.size() / 2);
}

TEST(Rematch, ChangesNothingWhileTrackingHolds) {
  const Texture texture(63);
  const auto with = klt(default_share()), without = klt(0.0);
  for (int frame = 0; frame < 4; ++frame) {
    const GreyImage image = render(texture, drive(frame));
    const TrackedPair a = feed(*with, image), b = feed(*without, image);
    ASSERT_EQ(track_numbers(a), track_numbers(b));
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_TRUE(a.correspondences[i].A == b.correspondences[i].A) << frame;
  }
}

TEST(Rematch, TrackingGoesOnAfterADarkStretch) {
  const Texture texture(64);
  const auto tracker = klt(default_share());
  for (int frame = 0; frame < 7; ++frame) {
    const bool dark = frame == 2 || frame == 3;
    View view = drive(frame);
    if (dark) view.gain = 0.02;
    const TrackedPair pair = feed(*tracker, render(texture, view));
    const bool after_dark = frame == 4;
    if (frame == 0 || dark || after_dark) {
      EXPECT_TRUE(pair.empty()) << frame;
    } else {
      EXPECT_GT(pair.size(), 200U) << frame;
    }
    EXPECT_FALSE(pair.standing) << frame;
  }
}

TEST(Rematch, RefusesAShareThatIsNone) {
  EXPECT_THROW(static_cast<void>(klt(-0.1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(klt(1.1)), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
