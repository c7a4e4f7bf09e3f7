#include "picture_effects.h"

#include "oneac/simulation/hard_drives.h"
#include "oneac/simulation/street_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace oneac::simulation {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

SimulationOptions small_picture() {
  SimulationOptions options;
  options.width_px = kWidth;
  options.height_px = kHeight;
  options.focal_px = 125.0;
  options.image_noise = 0.0;
  return options;
}

std::vector<float> even(float value) {
  return std::vector<float>(static_cast<std::size_t>(kWidth * kHeight), value);
}

/// A picture of one grey level after the effects.
std::vector<float> looked_at(const SimulationOptions& options, double time_s,
                             float value = 120.0F) {
  std::vector<float> grey = even(value);
  PictureEffects(options).apply(grey, time_s, 0);
  return grey;
}

int changed(const std::vector<float>& a, const std::vector<float>& b, int from_row, int to_row) {
  int count = 0;
  for (int i = from_row * kWidth; i < to_row * kWidth; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (std::abs(a[k] - b[k]) > 4.0F) ++count;
  }
  return count;
}

TEST(PictureEffects, ChangeNothingByDefault) {
  EXPECT_EQ(looked_at(small_picture(), 3.3), even(120.0F));
  EXPECT_EQ(PictureEffects(small_picture()).noise(), 0.0);
}

TEST(Bonnet, HidesItsShareAndNothingElse) {
  SimulationOptions options = small_picture();
  options.bonnet_share = 0.25;
  const std::vector<float> grey = looked_at(options, 0.0);
  EXPECT_EQ(changed(grey, even(120.0F), 0, kHeight * 3 / 4 - 2), 0);
  EXPECT_GT(changed(grey, even(120.0F), kHeight - 15, kHeight), 12 * kWidth);
}

TEST(Bonnet, KeepsItsMarksAndReflectsWhatIsAbove) {
  SimulationOptions options = small_picture();
  options.bonnet_share = 0.25;
  const std::vector<float> dim = looked_at(options, 0.0, 60.0F);
  const std::vector<float> bright = looked_at(options, 1.0, 160.0F);
  for (int u = 0; u < kWidth; u += 7) {
    const auto k = static_cast<std::size_t>((kHeight - 5) * kWidth + u);
    EXPECT_NEAR(bright[k] - dim[k], 40.0F, 0.1F) << u;  // marks cancel
  }
}

TEST(Windscreen, DropsStayUntilTheWiperPasses) {
  SimulationOptions options = small_picture();
  options.rain = options.wiper = true;
  const std::vector<float> veil = looked_at(options, 0.45, 150.0F);
  const int late = changed(looked_at(options, 1.55), looked_at(options, 1.58), 0, kHeight);
  const int wiped = changed(looked_at(options, 1.55), looked_at(options, 2.5), 0, kHeight);
  EXPECT_GT(wiped, 4 * std::max(1, late));
}

TEST(Windscreen, ThePictureChangesOnlyWithTime) {
  SimulationOptions options = small_picture();
  options.rain = options.wiper = true;
  EXPECT_EQ(looked_at(options, 0.7), looked_at(options, 0.7));
}

TEST(Windscreen, TheBladeSweepsThePicture) {
  SimulationOptions options = small_picture();
  options.wiper = true;
  const std::vector<float> sweeping = looked_at(options, 0.3);
  EXPECT_GT(changed(sweeping, even(120.0F), 0, kHeight), 100);
  EXPECT_LT(changed(sweeping, even(120.0F), 0, kHeight), kWidth * kHeight / 5);
  EXPECT_EQ(changed(looked_at(options, 1.2), even(120.0F), 0, kHeight), 0);  // parked
}

TEST(ExposureJumps, StartAtOneAndJump) {
  SimulationOptions options = small_picture();
  options.exposure_jumps = true;
  const PictureEffects effects(options);
  EXPECT_EQ(effects.gain(0.5), 1.0);
  double least = 1.0;
  double most = 1.0;
  for (int i = 0; i < 20; ++i) {
    const double gain = effects.gain(1.15 + 1.1 * i);
    EXPECT_EQ(gain, effects.gain(1.9 + 1.1 * i)) << "changed in between";
    least = std::min(least, gain);
    most = std::max(most, gain);
  }
  EXPECT_LT(least, 0.6);
  EXPECT_GT(most, 1.4);
}

TEST(Night, IsDarkNoisyAndHasPixelsThatAlwaysGlow) {
  SimulationOptions options = small_picture();
  options.night = true;
  const std::vector<float> now = looked_at(options, 0.0);
  const std::vector<float> later = looked_at(options, 5.0);
  EXPECT_EQ(now, later);
  EXPECT_LT(now[0], 20.0F);                                           // a corner of the sky
  EXPECT_GT(now[static_cast<std::size_t>(78 * kWidth + 80)], 80.0F);  // in the beam
  EXPECT_GT(PictureEffects(options).noise(), 5.0);
}

double row_difference(const GreyImage& a, const GreyImage& b, int v) {
  double sum = 0.0;
  for (int u = 0; u < a.width(); ++u) sum += std::abs(int{a.row(v)[u]} - int{b.row(v)[u]});
  return sum / a.width();
}

TEST(RollingShutter, ReadsTheFirstRowAtThePoseAndTheLastOneLater) {
  SimulationOptions options = small_picture();
  const StreetSimulator global(options);
  options.rolling_shutter_s = 0.1;  // as long as a frame: the last row is that of the next frame
  const StreetSimulator rolling(options);
  const std::size_t i = 70;  // in a bend
  const GreyImage image = rolling.frame(i).left;
  const GreyImage now = global.frame(i).left;
  const GreyImage next = global.frame(i + 1).left;
  ASSERT_GT(row_difference(now, next, kHeight - 1), 3.0) << "hardly moved";
  EXPECT_LT(row_difference(image, now, 0), 0.5 * row_difference(image, next, 0));
  EXPECT_LT(row_difference(image, next, kHeight - 1),
            0.5 * row_difference(image, now, kHeight - 1));
}

TEST(RollingShutter, ShowsNothingWhileTheCarStands) {
  SimulationOptions options = small_picture();
  options.suspension_pitch_deg = options.suspension_roll_deg = 0.0;
  const StreetSimulator global(options);
  options.rolling_shutter_s = 0.03;
  const StreetSimulator rolling(options);
  std::size_t standing = 0;
  for (std::size_t i = 15; i + 12 < global.size() && standing == 0; ++i) {
    bool stands = true;
    for (std::size_t k = i - 12; k <= i + 1; ++k)
      stands = stands && global.state(k).speed_mps == 0.0;
    if (stands) standing = i;
  }
  ASSERT_GT(standing, 0U);
  const GreyImage a = global.frame(standing).left;
  const GreyImage b = rolling.frame(standing).left;
  double worst = 0.0;
  for (int v = 0; v < kHeight; ++v) worst = std::max(worst, row_difference(a, b, v));
  EXPECT_LT(worst, 1.5);
}

TEST(OpenLand, HasCloudsAndNoFacades) {
  SimulationOptions options = small_picture();
  options.scenery = Scenery::kFar;
  options.frames = 2;
  const StreetSimulator drive(options);
  const GreyImage image = drive.frame(0).left;
  const Eigen::Isometry3d T = drive.state(0).T_world_cam;
  int near = 0;
  int sky_structure = 0;
  for (int v = 1; v < kHeight; ++v) {
    for (int u = 1; u < kWidth; ++u) {
      const auto X = drive.surface_point(T, {u, v});
      if (!X) {
        sky_structure += std::abs(int{image.row(v)[u]} - int{image.row(v)[u - 1]}) > 2 ? 1 : 0;
      } else if (X->z() > 0.5 && (*X - T.translation()).norm() < 100.0) {
        ++near;
      }
    }
  }
  EXPECT_GT(sky_structure, 200);
  EXPECT_LT(near, kWidth * kHeight / 20);  // posts
}

double road_contrast(RoadSurface road) {
  SimulationOptions options = small_picture();
  options.road = road;
  options.frames = 1;
  const GreyImage image = StreetSimulator(options).frame(0).left;
  double sum = 0.0;
  for (int u = kWidth / 3; u < kWidth / 2; ++u) {
    sum += std::abs(int{image.row(kHeight - 3)[u]} - int{image.row(kHeight - 3)[u + 1]});
  }
  return sum;
}

TEST(Road, IsSmootherWhereItShouldBe) {
  const double textured = road_contrast(RoadSurface::kTextured);
  EXPECT_LT(road_contrast(RoadSurface::kDark), 0.5 * textured);
  EXPECT_LT(road_contrast(RoadSurface::kDashes), 0.2 * textured);
}

/// The frames of a car that drives 0.6 m from one to the next, springs locked.
SimulationOptions level_drive(RoadSurface road) {
  SimulationOptions options = small_picture();
  options.route = RouteKind::kStraight;
  options.road = road;
  options.frames = 12;
  options.speed_mps = 6.0;
  options.stop_s = 0.0;
  options.suspension_pitch_deg = options.suspension_roll_deg = 0.0;
  options.camera_tilt_deg = 0.0;
  return options;
}

TEST(Road, OfSlabsLooksTheSameASlabAhead) {
  const auto change = [](RoadSurface road) {
    const StreetSimulator drive(level_drive(road));
    const GreyImage a = drive.frame(10).left, b = drive.frame(11).left;
    double sum = 0.0;
    for (int v = kHeight - 30; v < kHeight; ++v) {
      for (int u = 50; u < 80; ++u) sum += std::abs(int{a.row(v)[u]} - int{b.row(v)[u]});
    }
    return sum;
  };
  EXPECT_LT(change(RoadSurface::kSlabs), 0.3 * change(RoadSurface::kTextured));
}

TEST(Road, ThatIsWetMirrorsTheSkyWhereOneLooksAlongIt) {
  const auto brighter_far_away = [](RoadSurface road) {
    SimulationOptions options = level_drive(road);
    options.scenery = Scenery::kFar;
    const GreyImage image = StreetSimulator(options).frame(0).left;
    const auto mean = [&](int row) {
      return std::accumulate(image.row(row), image.row(row) + kWidth, 0.0) / kWidth;
    };
    return mean(kHeight / 2 + 6) / mean(kHeight - 5);
  };
  EXPECT_GT(brighter_far_away(RoadSurface::kWet), 1.35);
  EXPECT_LT(brighter_far_away(RoadSurface::kTextured), 1.2);
}

}  // namespace
}  // namespace oneac::simulation
