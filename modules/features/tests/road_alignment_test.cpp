#include "oneac/features/road_alignment.h"

#include "texture.h"

#include "oneac/base/workers.h"
#include "oneac/geometry/levelling.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace oneac {
namespace {

/// Grey value of the road at (x, z) [heights] in the first view's levelled frame.
using Paint = std::function<double(double, double)>;

PinholeCamera camera_of_road() {
  PinholeCamera camera;
  camera.width = 640;
  camera.height = 360;
  camera.fx = camera.fy = 500.0;
  camera.cx = 320.0;
  camera.cy = 130.0;
  return camera;
}

/// Two views of a plane, one camera height below.
struct Drive {
  Paint paint;
  double length = 0.6;  // [heights]
  double yaw = 0.01, pitch = 0.002;
  double gain = 1.0, bias = 0.0, noise = 1.0;  // of the second view
  Tilt tilt{0.02, 0.0};

  [[nodiscard]] RelativePose pose() const {
    const RelativePose level{yaw_rotation(std::cos(yaw), std::sin(yaw)) * pitch_rotation(pitch),
                             length * Eigen::Vector3d(0.02, 0.0, -1.0).normalized()};
    return unlevel(level, levelling_rotation(tilt));
  }
  [[nodiscard]] GreyImage view(bool second) const {
    const PinholeCamera camera = camera_of_road();
    const RelativePose T_1_2 = pose().inverse();
    const Eigen::Matrix3d L = levelling_rotation(tilt);
    const Eigen::Matrix3d R = second ? Eigen::Matrix3d(L * T_1_2.R) : L;
    const Eigen::Vector3d centre = second ? Eigen::Vector3d(L * T_1_2.t) : Eigen::Vector3d::Zero();
    GreyImage image(camera.width, camera.height);
    SceneGenerator random(second ? 8 : 7);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = R * camera.normalise(Eigen::Vector2d(u, v)).homogeneous();
        double grey = 180.0;
        if (ray.y() > 0.01) {
          const Eigen::Vector3d X = centre + ray * ((1.0 - centre.y()) / ray.y());
          grey = paint(X.x(), X.z());
        }
        if (second) grey = gain * grey + bias;
        grey += random.normal(noise);
        image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
    return image;
  }
  [[nodiscard]] RoadStep step() const {
    RoadStep step;
    step.T_2_1 = pose();
    step.T_2_1.t.normalize();
    step.information = motion_information(0.0003, 0.005);
    step.R_level_cam = levelling_rotation(tilt);
    step.max_length = 2.0;
    return step;
  }
  [[nodiscard]] RoadAlignment align(const RoadStep& step, const ImageView& mask = {}) const {
    const GreyImage first = view(false), second = view(true);
    return align_road({RoadImage(first.view()), RoadImage(second.view()), mask}, camera_of_road(),
                      step);
  }
};

Paint asphalt(std::uint64_t seed) {
  return [texture = Texture(seed)](double x, double z) {
    return 90.0 + 0.4 * (texture(150.0 * x, 150.0 * z) - 120.0);
  };
}

void expect_true(const RoadAlignment& result, double length) {
  EXPECT_EQ(result.status, RoadStatus::kMeasured) << to_string(result.status);
  EXPECT_NEAR(result.length, length, 3.0 * result.sigma);
  EXPECT_NEAR(result.length, length, 0.01 * length + 0.002);
  EXPECT_LT(result.relative_sigma, 0.03);
}

TEST(RoadAlignment, RecoversTheLengthOfAStepInCameraHeights) {
  for (const double length : {0.1, 0.3, 0.6, 1.1}) {
    Drive drive{asphalt(3)};
    drive.length = length;
    const RoadAlignment result = drive.align(drive.step());
    EXPECT_EQ(result.status, RoadStatus::kMeasured) << length << " " << to_string(result.status);
    EXPECT_GT(result.reach, RoadAlignmentOptions().nearest);
    EXPECT_LT(result.reach, RoadAlignmentOptions().farthest);
    EXPECT_NEAR(result.length, length, 3.0 * result.sigma);
    EXPECT_NEAR(result.length, length, 0.01 * length + 0.002);
  }
}

TEST(RoadAlignment, TellsTheRollOfACameraAgainstTheRoad) {
  for (const double roll : {-0.07, 0.0, 0.05}) {
    Drive drive{asphalt(3)};
    drive.tilt = {0.02, roll};
    RoadStep step = drive.step();
    step.R_level_cam = levelling_rotation({0.02, 0.0});
    step.roll_sigma = 0.1;
    const RoadAlignment result = drive.align(step);
    EXPECT_EQ(result.status, RoadStatus::kMeasured) << roll << " " << to_string(result.status);
    EXPECT_NEAR(result.roll, roll, 3.0 * result.roll_sigma);
    EXPECT_LT(result.roll_sigma, 0.012);
    EXPECT_NEAR(result.length, drive.length, 3.0 * result.sigma) << roll;
  }
}

/// A car that turns off does not drive on what lies ahead of it: a kerb may stand between.
TEST(RoadAlignment, IsLessSureInABendOfWhatTheCarDoesNotDriveOn) {
  const auto in_bend = [](double yaw) {
    Drive drive{asphalt(3)};
    drive.yaw = yaw;
    RoadStep step = drive.step();
    step.length = drive.length;
    step.length_sigma = 0.05;
    return drive.align(step);
  };
  const RoadAlignment straight = in_bend(0.0), tight = in_bend(0.12);  // a circle of 5 heights
  ASSERT_EQ(straight.status, RoadStatus::kMeasured) << to_string(straight.status);
  ASSERT_EQ(tight.status, RoadStatus::kMeasured) << to_string(tight.status);
  EXPECT_LT(straight.relative_sigma, 0.025);
  EXPECT_GT(tight.relative_sigma, 0.03);
}

TEST(RoadAlignment, MeasuresStandingAsZeroWithASigma) {
  Drive drive{asphalt(4)};
  drive.length = 0.0;
  drive.yaw = drive.pitch = 0.0;
  RoadStep step = drive.step();
  step.T_2_1.t = {0.0, 0.0, -1.0};
  const RoadAlignment result = drive.align(step);
  EXPECT_EQ(result.status, RoadStatus::kMeasured) << to_string(result.status);
  EXPECT_NEAR(result.length, 0.0, 0.01);
  EXPECT_GT(result.sigma, 0.0);
}

TEST(RoadAlignment, MeasuresBackwards) {
  Drive drive{asphalt(5)};
  const GreyImage first = drive.view(false), second = drive.view(true);
  const RelativePose back = drive.pose().inverse();
  RoadStep step = drive.step();
  step.T_2_1 = {back.R, back.t.normalized()};
  step.R_level_cam = levelling_rotation(drive.tilt) * drive.pose().R.transpose();
  const RoadAlignment result =
      align_road({RoadImage(second.view()), RoadImage(first.view())}, camera_of_road(), step);
  expect_true(result, drive.length);
}

TEST(RoadAlignment, TakesAWrongPitchIntoItsSigma) {
  const Drive drive{asphalt(6)};
  RoadStep step = drive.step();
  step.R_level_cam = levelling_rotation({drive.tilt.pitch_up + 0.006, 0.0});
  const RoadAlignment result = drive.align(step);
  EXPECT_EQ(result.status, RoadStatus::kMeasured) << to_string(result.status);
  EXPECT_NEAR(result.length, drive.length, 3.0 * result.sigma);
}

TEST(RoadAlignment, CompensatesGainAndBias) {
  Drive drive{asphalt(7)};
  drive.gain = 1.3;
  drive.bias = -20.0;
  const RoadAlignment result = drive.align(drive.step());
  expect_true(result, drive.length);
}

TEST(RoadAlignment, SaysThatBrightConcreteHasNoTexture) {
  const Drive drive{[](double, double) { return 215.0; }};
  const RoadAlignment result = drive.align(drive.step());
  EXPECT_EQ(result.status, RoadStatus::kNoTexture) << to_string(result.status);
  EXPECT_EQ(result.length, 0.0);
}

TEST(RoadAlignment, SaysThatLinesAlongTheRoadTellNothing) {
  const Drive drive{[](double x, double) { return std::fmod(x + 10.0, 0.8) < 0.1 ? 220.0 : 90.0; }};
  RoadStep step = drive.step();
  const RoadAlignment result = drive.align(step);
  EXPECT_NE(result.status, RoadStatus::kMeasured) << result.length << " +- " << result.sigma;
}

/// Stones across the road, every 0.4 heights.
double stones(double x, double z) {
  const double across = std::sin(2.0 * 3.14159265 * z / 0.4), along = std::sin(9.0 * x);
  return 110.0 + 40.0 * across * (1.0 + 0.3 * along);
}

TEST(RoadAlignment, SaysThatARepeatingPatternIsAmbiguous) {
  const Drive drive{stones};
  const RoadAlignment result = drive.align(drive.step());
  EXPECT_EQ(result.status, RoadStatus::kAmbiguous)
      << to_string(result.status) << " " << result.length << " rival " << result.rival;
}

TEST(RoadAlignment, ResolvesARepeatingPatternByThePrediction) {
  const Drive drive{stones};
  RoadStep step = drive.step();
  step.length = 0.55;
  step.length_sigma = 0.04;
  expect_true(drive.align(step), drive.length);
}

TEST(RoadAlignment, IsNotPulledByACarOnPartOfTheRoad) {
  // A patch that moves along with the camera: the same place in both images.
  const Drive drive{asphalt(9)};
  const GreyImage first = drive.view(false);
  GreyImage second = drive.view(true), with_car = first;
  const Texture car(77);
  for (int v = 190; v < 290; ++v) {
    for (int u = 330; u < 450; ++u) {
      const auto grey = static_cast<std::uint8_t>(std::clamp(car(2.0 * u, 2.0 * v), 0.0, 255.0));
      with_car.row(v)[u] = grey;
      second.row(v)[u] = grey;
    }
  }
  const RoadAlignment result = align_road({RoadImage(with_car.view()), RoadImage(second.view())},
                                          camera_of_road(), drive.step());
  expect_true(result, drive.length);
}

/// What drives ahead at constant gap and covers the road of our lane down to the nearest blocks:
/// the same place in both images.
RoadAlignment behind_a_truck(const Drive& drive, RoadStep step) {
  GreyImage first = drive.view(false), second = drive.view(true);
  const Texture truck(78);
  for (int v = 100; v < 345; ++v) {
    for (int u = 140; u < 500; ++u) {
      const auto grey = static_cast<std::uint8_t>(std::clamp(truck(2.0 * u, 2.0 * v), 0.0, 255.0));
      first.row(v)[u] = grey;
      second.row(v)[u] = grey;
    }
  }
  step.T_2_1 = {Eigen::Matrix3d::Identity(), {0.0, 0.0, -1.0}};
  return align_road({RoadImage(first.view()), RoadImage(second.view())}, camera_of_road(), step);
}

/// Smooth asphalt with lane lines that run at a slight angle to the camera's way.
Paint lane_lines(double angle) {
  return [=](double x, double z) {
    const double across = x - std::tan(angle) * z;
    const bool on_a_line = std::abs(across + 0.9) < 0.05 || std::abs(across - 1.2) < 0.05;
    return on_a_line ? 150.0 : 90.0;
  };
}

TEST(RoadAlignment, LaneLinesThatNeverEndTellNoLength) {
  for (const double noise : {1.0, 4.0, 8.0}) {
    for (const double angle : {-0.06, 0.0, 0.03, 0.06}) {
      Drive drive{lane_lines(angle)};
      drive.noise = noise;
      RoadStep step = drive.step();
      step.length = 1.3 * drive.length;  // where a search begins must not pass for a measurement
      step.length_sigma = 0.15;
      const RoadAlignment result = drive.align(step);
      EXPECT_FALSE(result.status == RoadStatus::kMeasured && result.relative_sigma < 0.1)
          << noise << ", " << angle << ": " << result.length << " +- " << result.sigma;
    }
  }
}

TEST(RoadAlignment, DoesNotTakeATruckAtConstantGapForARoadThatRests) {
  for (const double contrast : {0.0, 0.1, 1.0}) {  // of the road beside it
    Drive drive{[=, asphalt = asphalt(10)](double x, double z) {
      return 90.0 + contrast * (asphalt(x, z) - 90.0);
    }};
    const RoadAlignment result = behind_a_truck(drive, drive.step());
    EXPECT_FALSE(result.status == RoadStatus::kMeasured && result.length < 0.3)
        << contrast << ": " << result.length << " +- " << result.sigma;
  }
}

TEST(RoadAlignment, SeesARestBesideATruckThatStandsToo) {
  Drive drive{asphalt(10)};
  drive.length = drive.yaw = drive.pitch = 0.0;
  const RoadAlignment result = behind_a_truck(drive, drive.step());
  EXPECT_EQ(result.status, RoadStatus::kMeasured) << to_string(result.status);
  EXPECT_NEAR(result.length, 0.0, 0.01);
}

TEST(RoadAlignment, LeavesOutWhatIsMasked) {
  const Drive drive{asphalt(10)};
  GreyImage first = drive.view(false), second = drive.view(true), mask(640, 360, 255);
  const Texture bonnet(78);
  for (int v = 270; v < 360; ++v) {
    for (int u = 0; u < 640; ++u) {
      first.row(v)[u] = second.row(v)[u] =
          static_cast<std::uint8_t>(std::clamp(bonnet(u, v), 0.0, 255.0));
      mask.row(v)[u] = 0;
    }
  }
  const RoadAlignment result =
      align_road({RoadImage(first.view()), RoadImage(second.view()), mask.view()}, camera_of_road(),
                 drive.step());
  expect_true(result, drive.length);
}

TEST(RoadAlignment, SaysThatUnrelatedImagesDoNotCorrelate) {
  const Drive one{asphalt(11)}, other{asphalt(12)};
  const GreyImage first = one.view(false), second = other.view(true);
  const RoadAlignment result =
      align_road({RoadImage(first.view()), RoadImage(second.view())}, camera_of_road(), one.step());
  EXPECT_NE(result.status, RoadStatus::kMeasured) << result.length << " +- " << result.sigma;
}

TEST(RoadAlignment, SaysThatThereIsNoRoadWhenAllIsMasked) {
  const Drive drive{asphalt(13)};
  const GreyImage mask(640, 360, 0);
  EXPECT_EQ(drive.align(drive.step(), mask.view()).status, RoadStatus::kNoRoad);
}

TEST(RoadAlignment, GivesTheSameBytesAtAnyThreadCount) {
  const Drive drive{asphalt(15)};
  const GreyImage first = drive.view(false), second = drive.view(true);
  const auto align = [&](int threads) {
    Workers workers(threads);
    return align_road({RoadImage(first.view()), RoadImage(second.view())}, camera_of_road(),
                      drive.step(), {}, &workers);
  };
  const RoadAlignment alone = align(1);
  ASSERT_EQ(alone.status, RoadStatus::kMeasured);
  for (const int threads : {2, 4, 8}) {
    const RoadAlignment shared = align(threads);
    EXPECT_EQ(shared.length, alone.length) << threads << " threads";
    EXPECT_EQ(shared.sigma, alone.sigma);
    EXPECT_EQ(shared.T_2_1.R, alone.T_2_1.R);
    EXPECT_EQ(shared.rival, alone.rival);
  }
}

TEST(RoadAlignment, RefusesMisuse) {
  const Drive drive{asphalt(14)};
  const RoadImage image(drive.view(false).view());
  RoadStep step = drive.step();
  PinholeCamera other = camera_of_road();
  other.width = 320;
  EXPECT_THROW(static_cast<void>(align_road({image, image}, other, step)), std::invalid_argument);
  step.T_2_1.t.setZero();
  EXPECT_THROW(static_cast<void>(align_road({image, image}, camera_of_road(), step)),
               std::invalid_argument);
  RoadAlignmentOptions options;
  options.farthest = 1.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
