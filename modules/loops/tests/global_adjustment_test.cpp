#include "oneac/loops/global_adjustment.h"

#include "loop_scenes.h"

#include "oneac/geometry/homography.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace oneac {
namespace {

constexpr std::size_t kLap = 80;
constexpr double kFocal_px = 500.0, kNoise_px = 0.1;

/// Twice round a circle, 2 m a step.
std::vector<Eigen::Isometry3d> circle() {
  std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
  while (poses.size() < 2 * kLap) {
    poses.push_back(poses.back() * test::pose_at(0.0, 2.0, 360.0 / kLap));
  }
  return poses;
}

/// Points ahead of keyframes, on planes that face them, as other keyframes see them.
class Scene {
 public:
  explicit Scene(std::vector<Eigen::Isometry3d> truth) : truth_(std::move(truth)) {}

  /// Of a point of `anchor` in all of `others` that see it.
  SharedPatch patch(std::size_t anchor, const std::vector<std::size_t>& others) {
    std::uniform_real_distribution<double> across(-0.4, 0.4), depth(6.0, 25.0);
    const Eigen::Vector2d x(across(generator_), 0.5 * across(generator_));
    const Plane plane{Eigen::Vector3d::UnitZ(), depth(generator_)};
    SharedPatch patch{sighting(anchor, x, Eigen::Matrix2d::Identity())};
    for (const std::size_t other : others) {
      const Eigen::Isometry3d T = truth_[other].inverse() * truth_[anchor];
      if (!((T * (plane.d * x.homogeneous())).z() > 2.0)) continue;
      const auto ac = correspondence_from_homography(
          plane_induced_homography({T.linear(), T.translation()}, plane), x);
      if (ac && std::abs(ac->x2.x()) < 0.6) patch.push_back(sighting(other, ac->x2, ac->A));
    }
    return patch;
  }

 private:
  PatchSighting sighting(std::size_t keyframe, const Eigen::Vector2d& x, const Eigen::Matrix2d& A) {
    std::normal_distribution<double> noise(0.0, kNoise_px / kFocal_px);
    PatchSighting seen;
    seen.keyframe = static_cast<std::uint32_t>(keyframe);
    seen.point_sigma = static_cast<float>(kNoise_px / kFocal_px);
    seen.affine_sigma = 0.02F;
    seen.x = (x + Eigen::Vector2d(noise(generator_), noise(generator_))).cast<float>();
    seen.A = A.cast<float>();
    return seen;
  }

  std::vector<Eigen::Isometry3d> truth_;
  std::mt19937 generator_{11};
};

class GlobalAdjustmentOfTwoLaps : public ::testing::Test {
 protected:
  const std::vector<Eigen::Isometry3d> truth_ = circle();
  const std::vector<LoopKeyframe> keyframes_ = test::drifted(truth_, 0.05);
  DrivePatches drive_{kFocal_px, {}};
  ClosedGraph closed_;

  GlobalAdjustmentOfTwoLaps() {
    Scene scene(truth_);
    for (std::size_t i = 0; i + 4 < truth_.size(); ++i) {
      for (int k = 0; k < 15; ++k) drive_.patches.push_back(scene.patch(i, {i + 1, i + 2, i + 3}));
    }
    std::vector<LoopConstraint> loops;
    for (std::size_t i = 0; i + 1 < kLap; i += 4) {
      const Eigen::Vector3d off(i % 8 == 0 ? 0.03 : -0.03, 0.0, i % 3 == 0 ? 0.03 : -0.03);
      LoopConstraint& loop = loops.emplace_back(test::loop_between(truth_, i, i + kLap, off));
      for (int k = 0; k < 30; ++k) {
        loop.patches.push_back(scene.patch(i, {i + 1, i + kLap, i + kLap + 1}));
      }
    }
    closed_ = optimise_pose_graph(keyframes_, loops);
  }

  [[nodiscard]] GlobalAdjustment adjusted(const GlobalOptions& options = {}) const {
    return adjust_globally(keyframes_, closed_, drive_, options);
  }
  [[nodiscard]] double rms(const std::vector<Eigen::Isometry3d>& poses) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      sum += (poses[i].translation() - truth_[i].translation()).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(poses.size()));
  }
  [[nodiscard]] static double farthest(const std::vector<Eigen::Isometry3d>& a,
                                       const std::vector<Eigen::Isometry3d>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      most = std::max(most, (a[i].translation() - b[i].translation()).norm());
    }
    return most;
  }
};

TEST_F(GlobalAdjustmentOfTwoLaps, IsNearerToTheTruthThanThePoseGraph) {
  const GlobalAdjustment result = adjusted();
  ASSERT_TRUE(result.report.adjusted) << result.report.reason;
  EXPECT_LT(rms(result.T_first_cam), 0.5 * rms(closed_.T_first_cam));
  EXPECT_LT(result.report.rms_after_px, 0.5 * result.report.rms_before_px);
  // Of four sightings' eight coordinates three go into the patch.
  EXPECT_NEAR(result.report.rms_after_px, std::sqrt(2.0 * 5.0 / 8.0) * kNoise_px, 0.1 * kNoise_px);
  EXPECT_TRUE(result.T_first_cam.front().isApprox(truth_.front()));
}

TEST_F(GlobalAdjustmentOfTwoLaps, TakesLoopsAsImagesAndAsEdgesWhereTheyHaveNone) {
  EXPECT_EQ(adjusted().report.loops, closed_.loops.size());
  for (std::size_t i = 0; i < 5; ++i) closed_.loops[i].patches.clear();
  const GlobalAdjustment result = adjusted();
  EXPECT_EQ(result.report.loops, closed_.loops.size() - 5);
  EXPECT_LT(rms(result.T_first_cam), rms(closed_.T_first_cam));
  for (LoopConstraint& loop : closed_.loops) loop.patches.clear();
  const GlobalAdjustment by_edges = adjusted();
  EXPECT_EQ(by_edges.report.loops, 0U);
  EXPECT_EQ(by_edges.report.shared, 0U);
}

TEST_F(GlobalAdjustmentOfTwoLaps, KeepsTheMetresOfTheOdometry) {
  // As one camera sees it, a drive a tenth as large again explains every image as well.
  for (Eigen::Isometry3d& T : closed_.T_first_cam) T.translation() *= 1.1;
  const GlobalAdjustment result = adjusted();
  ASSERT_TRUE(result.report.adjusted) << result.report.reason;
  const auto way = [](const std::vector<Eigen::Isometry3d>& poses) {
    double sum = 0.0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      sum += (poses[i].translation() - poses[i - 1].translation()).norm();
    }
    return sum;
  };
  EXPECT_NEAR(way(result.T_first_cam) / way(truth_), 1.0, 0.003);
}

TEST_F(GlobalAdjustmentOfTwoLaps, RejectsMatchesOfTwoPlaces) {
  const GlobalAdjustment clean = adjusted();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < closed_.loops.size(); i += 3) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (PatchSighting& seen : closed_.loops[i].patches[k]) {
        if (seen.keyframe != closed_.loops[i].second) continue;
        seen.x.x() += 12.0F / static_cast<float>(kFocal_px);
        ++wrong;
      }
    }
  }
  ASSERT_GT(wrong, 15U);
  const GlobalAdjustment result = adjusted();
  ASSERT_TRUE(result.report.adjusted) << result.report.reason;
  EXPECT_GE(result.report.rejected, wrong);
  EXPECT_LT(farthest(result.T_first_cam, clean.T_first_cam), 0.02);
}

TEST_F(GlobalAdjustmentOfTwoLaps, LeavesOutWhatAnAffinityContradicts) {
  const GlobalAdjustment clean = adjusted();
  for (std::size_t i = 0; i < 50; ++i) drive_.patches[10 * i].back().A *= 1.5F;
  const GlobalAdjustment result = adjusted();
  EXPECT_GE(result.report.inconsistent, clean.report.inconsistent + 40);
  EXPECT_LT(result.report.observations, clean.report.observations);
}

TEST_F(GlobalAdjustmentOfTwoLaps, TellsWhereThePatchesAre) {
  const GlobalAdjustment result = adjusted();
  ASSERT_EQ(result.points.size(), drive_.patches.size());
  const auto known = std::find_if(result.points.begin() + 300, result.points.end(),
                                  [](const auto& point) { return point.has_value(); });
  ASSERT_NE(known, result.points.end());
  const auto place = static_cast<std::size_t>(known - result.points.begin());
  const PatchSighting& anchor = drive_.patches[place].front();
  const Eigen::Vector3d X = result.T_first_cam[anchor.keyframe].inverse() * **known;
  EXPECT_LT((X.head<2>() / X.z() - anchor.x.cast<double>()).norm(), 3.0 * kNoise_px / kFocal_px);
  EXPECT_GT(X.z(), 5.0);
  EXPECT_LT(X.z(), 30.0);
}

TEST_F(GlobalAdjustmentOfTwoLaps, StaysWithTheGraphWhenItIsStoppedOrHasNoLoop) {
  const GlobalAdjustment stopped =
      adjust_globally(keyframes_, closed_, drive_, {}, [] { return true; });
  EXPECT_FALSE(stopped.report.adjusted);
  EXPECT_EQ(stopped.report.reason, "it was interrupted");
  EXPECT_EQ(farthest(stopped.T_first_cam, closed_.T_first_cam), 0.0);
  closed_.loops.clear();
  const GlobalAdjustment open = adjusted();
  EXPECT_FALSE(open.report.adjusted);
  EXPECT_NE(open.report.reason, "");
  EXPECT_EQ(farthest(open.T_first_cam, closed_.T_first_cam), 0.0);
}

TEST_F(GlobalAdjustmentOfTwoLaps, IsTheSameEveryTime) {
  EXPECT_EQ(farthest(adjusted().T_first_cam, adjusted().T_first_cam), 0.0);
}

TEST_F(GlobalAdjustmentOfTwoLaps, TakesFewerPatchesOfEachKeyframeWhereThereAreTooMany) {
  GlobalOptions options;
  options.max_observations = 6000;
  const GlobalAdjustment result = adjusted(options);
  ASSERT_TRUE(result.report.adjusted) << result.report.reason;
  EXPECT_LE(result.report.observations, 6000U);
  EXPECT_GT(result.report.passed_over, 0U);
  options.max_observations = 1000;
  const GlobalAdjustment none = adjusted(options);
  EXPECT_FALSE(none.report.adjusted);
  EXPECT_NE(none.report.reason.find("max_observations"), std::string::npos);
}

TEST_F(GlobalAdjustmentOfTwoLaps, RefusesWhatMakesNoSense) {
  GlobalOptions options;
  options.patches = 1;
  EXPECT_THROW(static_cast<void>(adjusted(options)), std::invalid_argument);
  drive_.patches[0].front().keyframe = 9999;
  EXPECT_THROW(static_cast<void>(adjusted()), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
