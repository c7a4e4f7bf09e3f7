#include "map/keyframe_map.h"

#include "oneac/geometry/homography.h"
#include "oneac/test_support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace oneac {
namespace {

/// A car between two walls; images a tenth of a second apart.
class KeyframeMapDrive : public testing::Test {
 protected:
  KeyframeMapDrive() : map_(WindowOptions{}) {
    SceneGenerator random(9);
    for (int i = 0; i < 1000; ++i) {
      points_.push_back(
          {i % 2 == 0 ? 3.0 : -3.0, random.uniform(-2.0, 1.5), random.uniform(4.0, 90.0)});
    }
    take(map_.start({0, 0.0}, 700.0));
  }

  [[nodiscard]] TwoView look_ahead(double metres) const {
    const RelativePose T{Eigen::Matrix3d::Identity(), {0.0, 0.0, -metres}};
    TwoView seen;
    seen.status = StepStatus::kOk;
    seen.pose = {T.R, -Eigen::Vector3d::UnitZ()};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d X = points_[i] - Eigen::Vector3d(0.0, 0.0, way_);
      if (X.z() - metres < 2.0 || X.z() > 20.0) continue;
      const Plane wall{Eigen::Vector3d::UnitX() * (X.x() > 0.0 ? 1.0 : -1.0), std::abs(X.x())};
      Correspondence ac;
      static_cast<AffineCorrespondence&>(ac) =
          *correspondence_from_homography(plane_induced_homography(T, wall), X.head<2>() / X.z());
      ac.track = i;
      ac.affine_sigma = 0.001;
      seen.pair.correspondences.push_back(ac);
    }
    seen.inliers.assign(seen.pair.size(), true);
    return seen;
  }

  /// One step; the scale measures the map at every keyframe by this ratio.
  FrameInMap drive(double metres, double ratio = 1.0) {
    const TwoView seen = look_ahead(metres);
    link_ = map_.link(seen);
    const double length = link_.carried ? link_.carried->length : metres;
    const RelativePose motion{seen.pose.R, length * seen.pose.t};
    return end(seen, motion, metres, ratio);
  }

  FrameInMap lose() {
    const TwoView nothing;
    link_ = map_.link(nothing);
    return end(nothing, {}, 0.0, 1.0);
  }

  FrameInMap end(const TwoView& seen, const RelativePose& motion, double metres, double ratio) {
    way_ += metres;
    const auto lengths = map_.move(stamp(), motion, seen, Eigen::Matrix3d::Identity());
    std::optional<ScaleCorrection> correction;
    if (lengths) correction = ScaleCorrection{1.0, ratio, true, 0.02, 0};
    const FrameInMap in_map = map_.settle(correction);
    take(in_map);
    return in_map;
  }

  [[nodiscard]] FrameStamp stamp() const {
    return {map_.frames(), 0.1 * static_cast<double>(map_.frames())};
  }

  void take(const FrameInMap& in_map) { take(in_map.settled); }
  void take(const Settled& settled) {
    frames_.insert(frames_.end(), settled.frames.begin(), settled.frames.end());
    keyframes_.insert(keyframes_.end(), settled.keyframes.begin(), settled.keyframes.end());
  }

  KeyframeMap map_;
  std::vector<Eigen::Vector3d> points_;
  double way_ = 0.0;
  MapLink link_;
  std::vector<SettledFrame> frames_;
  std::vector<Keyframe> keyframes_;
};

TEST_F(KeyframeMapDrive, CarriesLengthsOnceItHasLandmarks) {
  drive(1.0);
  EXPECT_FALSE(link_.carried.has_value());
  drive(0.7);
  ASSERT_TRUE(link_.carried.has_value());
  EXPECT_NEAR(link_.carried->length, 0.7, 0.01);
  EXPECT_EQ(link_.carried->source, LengthSource::kMap);
  EXPECT_GT(link_.carried->support, 50U);
}

TEST_F(KeyframeMapDrive, FinishesEveryFrameOnceAndInOrder) {
  for (int i = 0; i < 30; ++i) drive(1.0);
  take(map_.finish());
  ASSERT_EQ(frames_.size(), 31U);
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    EXPECT_EQ(frames_[i].frame, i);
    EXPECT_NEAR(frames_[i].T_first_cam.translation().z(), static_cast<double>(i), 0.3);
  }
}

TEST_F(KeyframeMapDrive, AppliesACorrectionToTheNewestFrame) {
  drive(1.0);
  drive(1.0);
  const FrameInMap halved = drive(1.0, 0.5);
  ASSERT_TRUE(halved.keyframe.has_value());
  EXPECT_NEAR(halved.T_first_cam.translation().z(), 1.5, 0.03);
  drive(1.0);
  ASSERT_TRUE(link_.carried.has_value());
  EXPECT_NEAR(link_.carried->length, 0.5, 0.02) << "landmarks shrank with it";
}

TEST_F(KeyframeMapDrive, IsRescaledBetweenTwoStepsWithAllThatWaits) {
  for (int i = 0; i < 4; ++i) drive(1.0);
  map_.rescale({1.0, 2.0, true, 0.03, 0});
  const FrameInMap next = drive(1.0);
  ASSERT_TRUE(link_.carried.has_value());
  EXPECT_NEAR(link_.carried->length, 2.0, 0.05) << "landmarks grew with it";
  EXPECT_NEAR(next.T_first_cam.translation().z(), 10.0, 0.2);
  take(map_.finish());
  ASSERT_EQ(frames_.size(), 6U);
  for (const SettledFrame& frame : frames_) {
    EXPECT_NEAR(frame.T_first_cam.translation().z(), 2.0 * static_cast<double>(frame.frame), 0.2);
  }
}

TEST_F(KeyframeMapDrive, BeginsANewSegmentAfterAStepThatWasNotCarried) {
  for (int i = 0; i < 3; ++i) drive(1.0);
  lose();
  EXPECT_FALSE(link_.began_anew) << "not before something is seen again";
  EXPECT_EQ(map_.segment(), 0U);
  drive(1.0);
  EXPECT_TRUE(link_.began_anew);
  EXPECT_FALSE(link_.carried.has_value());
  EXPECT_EQ(map_.segment(), 1U);
}

TEST_F(KeyframeMapDrive, GoesOnAfterTheEndOfADrive) {
  for (int i = 0; i < 3; ++i) drive(1.0);
  take(map_.finish());
  EXPECT_EQ(frames_.size(), 4U);
  drive(1.0);
  EXPECT_TRUE(link_.began_anew);
  EXPECT_EQ(map_.segment(), 1U);
  take(map_.finish());
  ASSERT_EQ(frames_.size(), 5U);
  EXPECT_EQ(frames_.back().frame, 4U);
  EXPECT_NEAR(frames_.back().T_first_cam.translation().z(), 4.0, 0.1);
  lose();
  EXPECT_TRUE(link_.began_anew) << "an empty window has no keyframe to tie a frame to";
}

TEST(KeyframeMap, AddsUpStepsWithoutAWindow) {
  WindowOptions options;
  options.enabled = false;
  KeyframeMap map(options);
  EXPECT_FALSE(map.start({0, 0.0}, 700.0).keyframe.has_value());
  TwoView seen;
  seen.status = StepStatus::kOk;
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_FALSE(map.link(seen).carried.has_value());
    const RelativePose motion{Eigen::Matrix3d::Identity(), {0.0, 0.0, -2.0}};
    EXPECT_FALSE(
        map.move({i, 0.1 * static_cast<double>(i)}, motion, seen, Eigen::Matrix3d::Identity()));
    const FrameInMap in_map = map.settle(std::nullopt);
    EXPECT_NEAR(in_map.T_first_cam.translation().z(), 2.0 * static_cast<double>(i), 1e-12);
  }
  EXPECT_EQ(map.frames(), 4U);
  EXPECT_TRUE(map.finish().frames.empty());
}

}  // namespace
}  // namespace oneac
