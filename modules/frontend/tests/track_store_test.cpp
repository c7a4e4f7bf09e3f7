#include "map/track_store.h"

#include "two_view/perspective_correction.h"

#include "oneac/geometry/homography.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace oneac {
namespace {

constexpr std::uint64_t kTrack = 7;
const Plane kRoad{Eigen::Vector3d::UnitY(), 1.5};
const RelativePose kForward{Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.8}};
const Eigen::Vector2d kSpread(1e-4, 1e-4);  // K of a window of 7 px, focal length 700 px

/// One step of a patch of the road at x1 as affine alignment finds it: shifted by −A K η.
TrackedPair found_on_road(const Eigen::Vector2d& x1, Eigen::Vector2d& true_x2) {
  const Eigen::Matrix3d H = plane_induced_homography(kForward, kRoad);
  AffineCorrespondence ac = *correspondence_from_homography(H, x1);
  true_x2 = ac.x2;
  const Eigen::Vector2d eta = H.row(2).head<2>().transpose() / (H * x1.homogeneous()).z();
  ac.x2 -= ac.A * kSpread.asDiagonal() * eta;
  Correspondence found;
  static_cast<AffineCorrespondence&>(found) = ac;
  found.track = kTrack;
  found.point_sigma = 1e-4;
  found.affine_sigma = 1e-3;
  found.perspective = kSpread.asDiagonal();
  return {{found}, false};
}

TEST(PerspectiveCorrection, MovesAPatchOfTheRoadToWhereItIs) {
  Eigen::Vector2d true_x2;
  const TrackedPair found = found_on_road({0.1, 0.2}, true_x2);
  const double before = (found.correspondences[0].x2 - true_x2).norm();
  const Correspondence corrected = corrected_for_perspective(kForward, found).correspondences[0];
  EXPECT_GT(before, 5e-5);
  EXPECT_LT((corrected.x2 - true_x2).norm(), 0.05 * before);
  EXPECT_EQ(corrected.x2, found.correspondences[0].x2 + corrected.moved);
}

TEST(PerspectiveCorrection, LeavesTracksAloneThatDoNotTellTheirWindow) {
  Eigen::Vector2d true_x2;
  TrackedPair found = found_on_road({0.1, 0.2}, true_x2);
  found.correspondences[0].perspective.setZero();
  const Correspondence same = corrected_for_perspective(kForward, found).correspondences[0];
  EXPECT_EQ(same.x2, found.correspondences[0].x2);
  EXPECT_TRUE(same.moved.isZero(0.0));
}

/// The tracker goes on from where it found the patch, the landmark from where it is.
TEST(ExtendTracks, KeepsToThePointOfTheRoadThatATrackBeganAt) {
  const Eigen::Matrix3d H = plane_induced_homography(kForward, kRoad);
  TrackMap tracks;
  const std::size_t keyframe = 0;
  Eigen::Vector2d patch(0.1, 0.15), point = patch, true_x2;
  for (int i = 0; i < 5; ++i) {
    const TrackedPair found = found_on_road(patch, true_x2);
    patch = found.correspondences[0].x2;
    point = (H * point.homogeneous()).hnormalized();
    extend_tracks(corrected_for_perspective(kForward, found), {}, i == 0 ? &keyframe : nullptr,
                  tracks);
  }
  const double drifted = (patch - point).norm();
  EXPECT_GT(drifted, 2e-4);
  EXPECT_LT((tracks.at(kTrack).now.x - point).norm(), 0.1 * drifted);
}

}  // namespace
}  // namespace oneac
