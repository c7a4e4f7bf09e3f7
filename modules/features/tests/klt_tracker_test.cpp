#include "texture.h"
#include "track_numbers.h"

#include "oneac/base/error.h"
#include "oneac/base/workers.h"
#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

namespace oneac {
namespace {

FeatureOptions klt() {
  FeatureOptions options;
  options.extractor = "klt";
  return options;
}

View shifted(double x, double y) {
  View view;
  view.shift = {x, y};
  view.noise = 1.0;
  view.seed = static_cast<std::uint64_t>(1000.0 + 10.0 * x);
  return view;
}

/// A drive past a wall: 4 px to the left and 1 % closer each frame.
View drive(int frame) {
  View view = shifted(-4.0 * frame, 0.0);
  view.A *= std::pow(1.01, frame);
  return view;
}

/// The next image of a sequence.
TrackedPair feed(AcTracker& tracker, const GreyImage& image, const MotionHint& hint = {}) {
  return tracker.advance(tracker.prepare(image.view()), hint);
}

bool same_bytes(const Correspondence& a, const Correspondence& b) {
  return a.track == b.track && a.x1 == b.x1 && a.x2 == b.x2 && a.A == b.A &&
         a.affine_sigma == b.affine_sigma && a.point_sigma == b.point_sigma &&
         a.perspective == b.perspective;
}

bool same_bytes(const TrackedPair& a, const TrackedPair& b) {
  return std::equal(
      a.correspondences.begin(), a.correspondences.end(), b.correspondences.begin(),
      b.correspondences.end(),
      [](const Correspondence& one, const Correspondence& two) { return same_bytes(one, two); });
}

/// Correspondences from the first frame to that of the pair, of the tracks that began there.
std::map<std::uint64_t, AffineCorrespondence> composed(
    const std::map<std::uint64_t, AffineCorrespondence>& before, const TrackedPair& pair,
    bool first_pair) {
  std::map<std::uint64_t, AffineCorrespondence> now;
  for (const Correspondence& ac : pair.correspondences) {
    const auto found = before.find(ac.track);
    if (first_pair) now[ac.track] = ac;
    if (found == before.end()) continue;
    now[ac.track] = {found->second.x1, ac.x2, ac.A * found->second.A};
  }
  return now;
}

TEST(KltTracker, GivesNothingForTheFirstFrame) {
  const auto tracker = make_tracker(klt());
  const TrackedPair pair = feed(*tracker, render(Texture(1), shifted(0, 0)));
  EXPECT_TRUE(pair.empty());
  EXPECT_FALSE(pair.standing);
}

TEST(KltTracker, SpreadsCorrespondencesOverTheImage) {
  const auto tracker = make_tracker(klt());
  feed(*tracker, render(Texture(2), shifted(0, 0)));
  const TrackedPair pair = feed(*tracker, render(Texture(2), shifted(3, 1)));
  std::map<int, int> per_block;  // 4 × 3 blocks
  for (const auto& ac : pair.correspondences) {
    ++per_block[static_cast<int>(ac.x1.y() / 120.0) * 4 + static_cast<int>(ac.x1.x() / 120.0)];
  }
  EXPECT_GT(pair.size(), 300U);
  EXPECT_EQ(per_block.size(), 12U);
  for (const auto& [block, count] : per_block) EXPECT_GT(count, 12) << block;
}

TEST(KltTracker, FollowsTracksWhoseAffinitiesCompose) {
  const Texture texture(3);
  const auto tracker = make_tracker(klt());
  std::map<std::uint64_t, AffineCorrespondence> from_first;
  for (int frame = 0; frame <= 8; ++frame) {
    from_first = composed(from_first, feed(*tracker, render(texture, drive(frame))), frame == 1);
  }
  const View last = drive(8);
  std::vector<double> affine, point;
  for (const auto& [track, ac] : from_first) {
    affine.push_back((ac.A - last.A).norm());
    point.push_back((ac.x2 - last.map(ac.x1)).norm());
  }
  ASSERT_GT(affine.size(), 150U);
  EXPECT_LT(median_of(affine), 0.03);
  EXPECT_LT(median_of(point), 0.3);
}

TEST(KltTracker, NeverUsesATrackNumberTwice) {
  const Texture texture(4);
  const auto tracker = make_tracker(klt());
  std::map<std::uint64_t, Eigen::Vector2d> places;
  for (int frame = 0; frame <= 6; ++frame) {
    const TrackedPair pair = feed(*tracker, render(texture, drive(frame)));
    std::map<std::uint64_t, Eigen::Vector2d> now;
    for (std::size_t i = 0; i < pair.size(); ++i) {
      EXPECT_TRUE(now.emplace(pair.correspondences[i].track, pair.correspondences[i].x2).second);
      const auto before = places.find(pair.correspondences[i].track);
      if (before != places.end()) {
        EXPECT_TRUE(before->second == pair.correspondences[i].x1);
      }
    }
    places = now;
  }
}

/// A drive with room for new tracks, tracks that are lost and a jump that SIFT has to bridge.
std::vector<TrackedPair> pairs_of_a_drive(int threads) {
  const Texture texture(13);
  const auto tracker = make_tracker(klt(), std::make_shared<Workers>(threads));
  std::vector<TrackedPair> pairs;
  for (int frame = 0; frame <= 5; ++frame) {
    pairs.push_back(feed(*tracker, render(texture, drive(frame < 4 ? frame : frame + 40))));
  }
  return pairs;
}

TEST(KltTracker, GivesTheSameBytesAtAnyThreadCount) {
  const std::vector<TrackedPair> alone = pairs_of_a_drive(1);
  ASSERT_GT(alone[1].size(), 300U);
  ASSERT_GT(alone[5].size(), 100U) << "goes on behind the jump";
  for (const int threads : {2, 4, 8}) {
    const std::vector<TrackedPair> shared = pairs_of_a_drive(threads);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_TRUE(same_bytes(alone[i], shared[i])) << threads << " threads, frame " << i;
    }
  }
}

TEST(KltTracker, GivesTheSameBytesWhateverThreadPrepares) {
  const Texture texture(5);
  const auto here = make_tracker(klt()), there = make_tracker(klt());
  for (int frame = 0; frame <= 3; ++frame) {
    const GreyImage image = render(texture, drive(frame));
    auto prepared = std::async(std::launch::async, [&] { return there->prepare(image.view()); });
    const TrackedPair one = feed(*here, image);
    EXPECT_TRUE(same_bytes(one, there->advance(prepared.get(), {}))) << frame;
  }
}

TEST(KltTracker, ReportsStandingAndKeepsTheTracks) {
  const Texture texture(6);
  const auto tracker = make_tracker(klt());
  feed(*tracker, render(texture, drive(0)));
  const TrackedPair moving = feed(*tracker, render(texture, drive(1)));
  EXPECT_FALSE(moving.standing);
  View same = drive(1);
  for (int i = 0; i < 4; ++i) {
    same.seed = 500 + static_cast<std::uint64_t>(i);
    const TrackedPair pair = feed(*tracker, render(texture, same));
    ASSERT_TRUE(pair.standing) << i;
    for (const auto& ac : pair.correspondences) EXPECT_TRUE(ac.x1 == ac.x2);
  }
  const TrackedPair again = feed(*tracker, render(texture, drive(2)));
  EXPECT_FALSE(again.standing);
  const auto numbers = track_numbers(moving);
  const std::set<std::uint64_t> before(numbers.begin(), numbers.end());
  std::size_t kept = 0;
  for (const std::uint64_t track : track_numbers(again)) kept += before.count(track);
  EXPECT_GT(kept, moving.size() * 8 / 10);
}

/// The upper three quarters of the first image over the lowest of the second.
GreyImage far_and_near(const GreyImage& far, const GreyImage& near) {
  GreyImage image = far;
  for (int v = 3 * near.height() / 4; v < near.height(); ++v) {
    std::copy_n(near.row(v), near.width(), image.row(v));
  }
  return image;
}

TEST(KltTracker, ARollingCarThatOnlyTheNearPartShowsDoesNotStand) {
  const Texture texture(8);
  const auto tracker = make_tracker(klt());
  const GreyImage far = render(texture, shifted(0, 0));
  feed(*tracker, far_and_near(far, far));
  EXPECT_TRUE(feed(*tracker, far_and_near(far, render(texture, shifted(0.05, 0.0)))).standing);
  EXPECT_FALSE(feed(*tracker, far_and_near(far, render(texture, shifted(0.8, 0.0)))).standing);
}

TEST(KltTracker, LetsCreepingAddUpInsteadOfLosingIt) {
  const Texture texture(7);
  const auto tracker = make_tracker(klt());
  feed(*tracker, render(texture, shifted(0, 0)));
  double sum = 0.0;
  bool stood = false;
  for (int frame = 1; frame <= 20; ++frame) {
    const TrackedPair pair = feed(*tracker, render(texture, shifted(0.06 * frame, 0.0)));
    stood = stood || pair.standing;
    std::vector<double> flow;
    for (const auto& ac : pair.correspondences) flow.push_back(ac.x2.x() - ac.x1.x());
    ASSERT_FALSE(flow.empty());
    sum += median_of(flow);
  }
  EXPECT_TRUE(stood);
  EXPECT_NEAR(sum, 20 * 0.06, 0.2);
}

/// Yaw that moves the image's centre by 5 px.
MotionHint turning() {
  MotionHint hint;
  hint.camera.fx = hint.camera.fy = 500.0;
  hint.camera.cx = 240.0;
  hint.camera.cy = 180.0;
  hint.T_2_1 = RelativePose{yaw_rotation(std::cos(0.01), std::sin(0.01)), Eigen::Vector3d::Zero()};
  return hint;
}

TEST(KltTracker, DropsWhatMovesWithTheCamera) {
  constexpr int kBonnet = 260;  // rows below are the bonnet
  const Texture world(8), bonnet(9);
  const GreyImage car = render(bonnet, shifted(0, 0));
  const auto tracker = make_tracker(klt());
  std::size_t on_bonnet = 0, in_world = 0;
  for (int frame = 0; frame < 12; ++frame) {
    GreyImage image = render(world, shifted(-5.0 * frame, 0.0));
    for (int v = kBonnet; v < image.height(); ++v) {
      std::copy(car.row(v), car.row(v) + image.width(), image.row(v));
    }
    const TrackedPair pair = feed(*tracker, image, turning());
    for (const auto& ac : pair.correspondences) {
      if (ac.x2.y() > kBonnet + 20) ++on_bonnet;
      if (ac.x2.y() < kBonnet - 20) ++in_world;
    }
  }
  EXPECT_EQ(on_bonnet, 0U);
  EXPECT_GT(in_world, 1000U);
}

TEST(KltTracker, PredictsTheRoadFromTheMotion) {
  // Road 1 camera height below: 60 px nearer than the horizon it moves farther than windows reach.
  MotionHint hint = turning();
  hint.T_2_1 = RelativePose{Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.8}};
  hint.scaled = true;
  const Texture texture(10);
  const auto paint = [&](double driven) {
    GreyImage image(480, 360, 120);
    for (int v = 200; v < 360; ++v) {
      for (int u = 0; u < 480; ++u) {
        const double depth = 500.0 / (v - 180.0);
        const double grey = texture(160.0 * (u - 240.0) / 500.0 * depth, 160.0 * (depth + driven));
        image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
    return image;
  };
  const auto count = [&](const MotionHint& given) {
    const auto tracker = make_tracker(klt());
    feed(*tracker, paint(0.0), given);
    std::size_t right = 0;
    for (const auto& ac : feed(*tracker, paint(0.8), given).correspondences) {
      const double depth = 500.0 / (ac.x1.y() - 180.0);
      const double scale = depth / (depth - 0.8);
      const Eigen::Vector2d centre(240.0, 180.0);
      right += ((ac.x1 - centre) * scale + centre - ac.x2).norm() < 1.0 ? 1 : 0;
    }
    return right;
  };
  EXPECT_GT(count(hint), 60U);
  EXPECT_GT(count(hint), count({}));
}

TEST(KltTracker, StartsAnewAfterReset) {
  const auto tracker = make_tracker(klt());
  feed(*tracker, render(Texture(11), shifted(0, 0)));
  const TrackedPair pair = feed(*tracker, render(Texture(11), shifted(4, 0)));
  tracker->reset();
  EXPECT_TRUE(feed(*tracker, render(Texture(11), shifted(8, 0))).empty());
  const auto before = track_numbers(pair);
  for (const std::uint64_t track :
       track_numbers(feed(*tracker, render(Texture(11), shifted(12, 0))))) {
    EXPECT_EQ(std::count(before.begin(), before.end(), track), 0) << track;
  }
}

TEST(KltTracker, HasNothingToSayAboutABlankImage) {
  const auto tracker = make_tracker(klt());
  for (int i = 0; i < 3; ++i) {
    const TrackedPair pair = feed(*tracker, GreyImage(200, 100, 90));
    EXPECT_TRUE(pair.empty());
    EXPECT_FALSE(pair.standing);
  }
  EXPECT_NO_THROW(static_cast<void>(tracker->prepare(GreyImage(3, 2, 9).view())));
}

TEST(KltTracker, RefusesImagesOfAnotherSize) {
  const auto tracker = make_tracker(klt());
  feed(*tracker, GreyImage(200, 100, 90));
  EXPECT_THROW(feed(*tracker, GreyImage(100, 100, 90)), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
