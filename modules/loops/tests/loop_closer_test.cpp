#include "oneac/loops/loop_closer.h"

#include "loop_scenes.h"

#include "oneac/geometry/levelling.h"
#include "oneac/loops/loop_formats.h"
#include "oneac/loops/pose_graph.h"
#include "oneac/simulation/laps.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace oneac {
namespace {

SimulationOptions small_block() {
  SimulationOptions options;
  options.route = RouteKind::kBlock;
  options.block_m = 40.0;
  options.width_px = 320;
  options.height_px = 240;
  options.focal_px = 250.0;
  options.relight = true;
  options.frames = frames_for_laps(options, 2);
  return options;
}

LoopCamera camera_of(const SimulationOptions& options) {
  const StreetSimulator simulator(options);
  LoopCamera camera;
  camera.camera = simulator.camera();
  camera.R_level_cam = levelling_rotation(tilt_from_mounting(simulator.T_vehicle_cam().linear()));
  return camera;
}

/// Every second frame of the first street, then of the same street a lap later, with the
/// simulator's poses for odometry.
class LoopCloserOnABlock : public ::testing::Test {
 protected:
  struct Drive {
    std::vector<LoopKeyframe> keyframes;
    std::vector<GreyImage> images;
    std::vector<AffineFeatures> features;
    LoopCamera camera;
  };
  static inline Drive drive;

  static void SetUpTestSuite() {
    const SimulationOptions options = small_block();
    const StreetSimulator simulator(options);
    const std::size_t lap = simulator.size() / 2;
    for (const std::size_t begin : {std::size_t{0}, lap}) {
      for (std::size_t i = begin; i < begin + 24; i += 2) add(simulator, i);
    }
    drive.camera = camera_of(options);
    const LoopCloser closer({}, drive.camera, {});
    for (const GreyImage& image : drive.images) {
      drive.features.push_back(closer.features(image.view()));
    }
  }
  static void TearDownTestSuite() { drive = {}; }

  static void add(const StreetSimulator& simulator, std::size_t frame) {
    LoopKeyframe keyframe;
    keyframe.id = drive.keyframes.size();
    keyframe.index = frame;
    keyframe.time_s = 0.1 * static_cast<double>(frame);
    keyframe.metric = true;
    keyframe.T_first_cam =
        simulator.state(0).T_world_cam.inverse() * simulator.state(frame).T_world_cam;
    if (!drive.keyframes.empty()) keyframe.covariance = test::step_covariance();
    // The leap over the rest of the lap is long: its odometry is worth 20 cm.
    if (keyframe.id == 12) keyframe.covariance *= 1e2;
    keyframe.scale_sigma = 0.01;
    drive.keyframes.push_back(keyframe);
    drive.images.push_back(simulator.frame(frame).left);
  }

  [[nodiscard]] static FoundLoops close(std::vector<LoopKeyframe> keyframes, int threads) {
    LoopOptions options;
    options.driven_m = 14.0;  // the leap is a straight line
    LoopCloser closer(options, drive.camera, [&](std::size_t i) { return drive.images[i]; });
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
      closer.add(keyframes[i], drive.features[i]);
    }
    return closer.close(threads);
  }
};

TEST_F(LoopCloserOnABlock, MeasuresWhereItWasALapAgoInMetres) {
  const FoundLoops found = close(drive.keyframes, 2);
  EXPECT_GE(found.loops.size(), 8U);
  for (const LoopConstraint& loop : found.loops) {
    const Eigen::Isometry3d truth = drive.keyframes[loop.second].T_first_cam.inverse() *
                                    drive.keyframes[loop.first].T_first_cam;
    EXPECT_LT((loop.T_2_1.t - truth.translation()).norm(), 0.3) << loop.second;
    EXPECT_LT((loop.T_2_1.R - truth.linear()).norm(), 0.02) << loop.second;
    EXPECT_GT(loop.sigma_length, 0.0);
    EXPECT_LT(loop.first, loop.second);
  }
}

TEST_F(LoopCloserOnABlock, GivesTheSameBytesAtAnyThreadCount) {
  const FoundLoops one = close(drive.keyframes, 1), three = close(drive.keyframes, 3);
  EXPECT_EQ(format_loops(one.loops, drive.keyframes), format_loops(three.loops, drive.keyframes));
}

TEST_F(LoopCloserOnABlock, NoLoopEndsWhereNothingIsInMetres) {
  auto keyframes = drive.keyframes;
  for (std::size_t i = 0; i < 12; ++i) keyframes[i].metric = false;
  const FoundLoops found = close(keyframes, 2);
  EXPECT_TRUE(found.loops.empty());
  EXPECT_EQ(found.report.not_metric, 12U);
}

TEST_F(LoopCloserOnABlock, OdometryThatKnowsBetterRefusesThem) {
  auto keyframes = drive.keyframes;
  for (std::size_t i = 12; i < keyframes.size(); ++i) {
    keyframes[i].T_first_cam.pretranslate(Eigen::Vector3d(6.0, 0.0, 0.0));
  }
  const FoundLoops found = close(keyframes, 2);
  EXPECT_TRUE(found.loops.empty());
  EXPECT_GT(found.report.impossible, 0U);
}

TEST_F(LoopCloserOnABlock, JoinsALogOfThePlaceWhateverItsFrame) {
  auto keyframes = drive.keyframes;
  const Eigen::Isometry3d elsewhere = test::pose_at(-300.0, 20.0, 70.0);
  for (std::size_t i = 12; i < keyframes.size(); ++i) {
    keyframes[i].log = 1;
    keyframes[i].T_first_cam = elsewhere * keyframes[i].T_first_cam;
  }
  const FoundLoops found = close(keyframes, 2);
  EXPECT_GE(found.loops.size(), 8U);
  const ClosedGraph closed = optimise_pose_graph(keyframes, found.loops);
  EXPECT_EQ(closed.group.back(), 0U);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Eigen::Vector3d off =
        closed.T_first_cam[i].translation() - drive.keyframes[i].T_first_cam.translation();
    EXPECT_LT(off.norm(), 0.3) << i;
  }
}

TEST(LoopCloser, FindsNothingInNothing) {
  LoopCloser closer({}, camera_of(small_block()), [](std::size_t) { return GreyImage{}; });
  EXPECT_TRUE(closer.close(1).loops.empty());
  const GreyImage dark(320, 240);
  for (std::size_t i = 0; i < 40; ++i) {
    LoopKeyframe keyframe;
    keyframe.metric = true;
    keyframe.T_first_cam = test::pose_at(0.0, 2.0 * static_cast<double>(i), 0.0);
    closer.add(keyframe, closer.features(dark.view()));
  }
  EXPECT_TRUE(closer.close(2).loops.empty());
}

TEST(LoopCloser, RefusesOptionsOutOfBounds) {
  LoopOptions options;
  options.min_share = 2.0;
  try {
    const LoopCloser closer(options, camera_of(small_block()), {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("loops.min_share = 2"), std::string::npos)
        << error.what();
  }
}

TEST(LoopFormats, NameImagesAndWriteMetres) {
  auto keyframes = test::drifted(test::square_drive(40.0, 2), 0.0);
  for (LoopKeyframe& keyframe : keyframes) keyframe.index = 10 * keyframe.id;
  LoopConstraint loop = test::loop_between(test::square_drive(40.0, 2), 2, 83);
  const std::string text = format_loops({loop}, keyframes);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz,sigma_length,inliers,acs");
  EXPECT_NE(text.find("\n20,830,2.000000,83.000000,1,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0.03,50,80\n"), std::string::npos) << text;
  EXPECT_EQ(format_g2o_loops({loop}, keyframes).rfind("EDGE_SE3:QUAT 2 83 ", 0), 0U);
  for (std::size_t i = 80; i < keyframes.size(); ++i) keyframes[i].log = 1;
  const std::string of_two = format_loops({loop}, keyframes);
  EXPECT_NE(of_two.find(",inliers,acs,log1,log2\n"), std::string::npos);
  EXPECT_NE(of_two.find(",0.03,50,80,1,2\n"), std::string::npos) << of_two;
}

}  // namespace
}  // namespace oneac
