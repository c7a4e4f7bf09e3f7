#include "car_mask/car_mask.h"

#include "texture.h"

#include "oneac/features/ac_tracker.h"
#include "oneac/features/feature_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac::internal {
namespace {

constexpr int kWidth = 480, kHeight = 320;
constexpr int kHorizon = 120;     // [px] row
constexpr int kBonnet = 270;      // [px] row of its upper edge
constexpr double kFocal = 500.0;  // [px]: the lower border lies 22° below the horizon
constexpr double kStep = 0.4;     // [camera heights] a frame

/// What a camera sees between two textured walls on a textured road, and what is fixed to it.
struct Drive {
  double step = kStep;
  bool bonnet = false;
  int truck_low = 0;                    ///< [px] row where a vehicle at constant gap ends; 0: none
  double pitch_px = 0.0, yaw_px = 0.0;  ///< swing from frame to frame
  bool shadow = false;                  ///< of the car itself, on the road ahead
  bool lines = false;                   ///< lane lines without gaps
  bool traffic = false;                 ///< a vehicle passes left, another goes away right
  bool text = false;                    ///< burnt into the picture near its lower border
  double circle_px = 0.0;               ///< radius of a lens's picture, black outside; 0: no circle
};

constexpr double kFar = 16.0;  // [camera heights] where all that is farther stands

double scene_grey(const Texture& texture, double x, double y, double travelled) {
  const double road = y > 0.0 ? 1.0 / std::max(y, 1e-3) : 1e3;  // [camera heights] ahead
  const double wall = 4.0 / std::max(std::abs(x), 1e-3);        // walls 4 heights beside
  const double depth = std::min({road, wall, kFar});
  const double across = (wall < road ? y : x) * depth;
  return texture(12.0 * (depth < kFar ? depth + travelled : 0.0), 8.0 * across);
}

constexpr int kShadowLeft = 180, kShadowRight = 300, kShadowTop = 210;  // [px]

/// What travels with the camera on the road: its shadow, lines that lead to the horizon.
double marked(const Drive& drive, double grey, int u, int v) {
  if (drive.text && v > 296 && v < 312 && u > 20 && u < 200) return (u / 6 + v / 8) % 2 * 240.0;
  if (drive.shadow && u > kShadowLeft && u < kShadowRight && v > kShadowTop) grey *= 0.4;
  const double lane = v > kHorizon ? (u - 0.5 * kWidth) / (v - kHorizon) : 0.0;
  return drive.lines && std::abs(std::abs(lane) - 1.2) < 0.08 ? 250.0 : grey;
}

/// Whether a block that moves outward left, inward right shows here.
bool is_traffic(const Drive& drive, int frame, int u, int v) {
  const int left = 150 - 4 * (frame % 30), right = 460 - 4 * (frame % 30);
  return drive.traffic && v > 80 && v < 180 &&
         ((u > left - 60 && u < left) || (u > right - 60 && u < right));
}

double from_centre(int u, int v) {
  return std::hypot(u - 0.5 * kWidth, v - 0.5 * kHeight);
}

GreyImage picture(const Drive& drive, int frame) {
  static const Texture kScene(3), kCar(4);
  GreyImage image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double swing = frame % 2 == 0 ? 0.5 : -0.5;
      const double x = (u - 0.5 * kWidth + swing * drive.yaw_px) / kFocal;
      const double y = (v - kHorizon + swing * drive.pitch_px) / kFocal;
      double grey = marked(drive, scene_grey(kScene, x, y, drive.step * frame), u, v);
      if (is_traffic(drive, frame, u, v)) grey = kCar(u + 4 * (frame % 30), v);
      const bool truck = drive.truck_low > 0 && v < drive.truck_low && v > 60 && u > 190 && u < 290;
      if (truck || (drive.bonnet && v >= kBonnet)) grey = kCar(u, v);
      if (drive.circle_px > 0.0 && from_centre(u, v) > drive.circle_px) grey = 8 + (u + v) % 3;
      image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return image;
}

MotionHint level_hint() {
  MotionHint hint;
  hint.camera.width = kWidth;
  hint.camera.height = kHeight;
  hint.camera.fx = hint.camera.fy = kFocal;
  hint.camera.cx = 0.5 * kWidth;
  hint.camera.cy = kHorizon;
  return hint;
}

constexpr int kLevels = 5;

void watch(CarMask& mask, const Drive& drive, int first, int count) {
  for (int frame = first; frame < first + count; ++frame) {
    mask.observe(build_pyramid(picture(drive, frame).view(), kLevels), level_hint());
  }
}

double share_in_rows(const GreyImage& mask, int first, int end) {
  if (mask.empty()) return 0.0;
  std::ptrdiff_t black = 0;
  for (int v = first; v < end; ++v) black += std::count(mask.row(v), mask.row(v) + kWidth, 0);
  return static_cast<double>(black) / (kWidth * (end - first));
}

Drive with_bonnet() {
  Drive drive;
  drive.bonnet = true;
  return drive;
}

TEST(CarMask, LearnsWhatALensLeavesBlackAndItsEdge) {
  Drive drive;
  drive.circle_px = 220.0;
  CarMask mask;
  watch(mask, drive, 0, 60);
  const GreyImage learned = mask.picture();
  ASSERT_FALSE(learned.empty());
  for (int v = 12; v < kHeight - 12; v += 2) {  // no corner is nearer to the border
    for (int u = 0; u < kWidth; u += 2) {
      const double beyond = from_centre(u, v) - drive.circle_px;
      if (beyond > -12.0) {
        EXPECT_EQ(learned.row(v)[u], 0) << u << ' ' << v << ": corners here would rest";
      } else if (beyond < -36.0) {
        EXPECT_EQ(learned.row(v)[u], 255) << u << ' ' << v << ": the lens sees this";
      }
    }
  }
}

TEST(CarMask, DropsARimThatShowsSomethingAfterAll) {
  Drive tunnel;
  tunnel.circle_px = 220.0;
  CarMask mask;
  watch(mask, tunnel, 0, 60);
  ASSERT_FALSE(mask.usable({5.0, 5.0}));
  watch(mask, Drive(), 60, 10);
  EXPECT_TRUE(mask.usable({5.0, 5.0}));
}

TEST(CarMask, LearnsABonnetWithinThirtyFrames) {
  CarMask mask;
  watch(mask, with_bonnet(), 0, 30);
  const GreyImage learned = mask.picture();
  ASSERT_FALSE(learned.empty());
  EXPECT_EQ(learned.width(), kWidth);
  EXPECT_EQ(learned.height(), kHeight);
  EXPECT_GT(share_in_rows(learned, kBonnet, kHeight), 0.97);
  EXPECT_LT(share_in_rows(learned, 0, kBonnet - 24), 0.01);
  EXPECT_FALSE(mask.usable({240.0, 300.0}));
  EXPECT_TRUE(mask.usable({240.0, 200.0}));
}

TEST(CarMask, LearnsABonnetOnSoftSprings) {
  Drive drive = with_bonnet();
  drive.step = 0.1;
  drive.pitch_px = 2.4;  // 0.3°
  CarMask mask;
  watch(mask, drive, 0, 40);
  EXPECT_GT(share_in_rows(mask.picture(), kBonnet, kHeight), 0.97);
}

TEST(CarMask, LearnsTheTailUnderARearCamera) {
  Drive drive = with_bonnet();
  drive.step = -kStep;
  CarMask mask;
  watch(mask, drive, 0, 30);
  EXPECT_GT(share_in_rows(mask.picture(), kBonnet, kHeight), 0.97);
}

TEST(CarMask, LearnsNothingWhileTheCameraTurns) {
  Drive drive = with_bonnet();
  drive.yaw_px = 8.7;  // 1° a frame
  CarMask mask;
  watch(mask, drive, 0, 50);
  EXPECT_TRUE(mask.picture().empty());
}

TEST(CarMask, LeavesTheRoadInsideTheCarsOwnShadow) {
  Drive drive;
  drive.shadow = true;
  CarMask mask;
  watch(mask, drive, 0, 60);
  EXPECT_TRUE(mask.usable({240.0, 290.0}));
  EXPECT_TRUE(mask.usable({100.0, 290.0}));
  EXPECT_LT(share_in_rows(mask.picture(), kShadowTop + 30, kHeight), 0.2);
}

TEST(CarMask, LearnsATextAtTheLowerBorder) {
  Drive drive;
  drive.text = true;
  CarMask mask;
  watch(mask, drive, 0, 40);
  EXPECT_FALSE(mask.usable({100.0, 304.0}));
  EXPECT_TRUE(mask.usable({100.0, 270.0}));
  EXPECT_TRUE(mask.usable({300.0, 304.0}));
}

TEST(CarMask, LeavesLaneLinesThatLookTheSameInEveryImage) {
  Drive drive;
  drive.lines = true;
  CarMask mask;
  watch(mask, drive, 0, 60);
  EXPECT_TRUE(mask.picture().empty());
}

TEST(CarMask, LearnsNothingAtARedLightWhileTrafficPasses) {
  Drive drive = with_bonnet();
  drive.step = 0.0;
  drive.traffic = true;
  CarMask mask;
  watch(mask, drive, 0, 60);
  EXPECT_TRUE(mask.picture().empty());
}

TEST(CarMask, SuspectsWhatRestsLowUntilItKnows) {
  CarMask mask;
  watch(mask, with_bonnet(), 0, 5);
  EXPECT_TRUE(mask.must_move({240.0, 300.0}));
  EXPECT_FALSE(mask.must_move({240.0, 150.0})) << "3° below the horizon things may rest";
  EXPECT_TRUE(mask.usable({240.0, 300.0}));
  for (int vote = 0; vote < 2; ++vote) mask.suspect({240.0, 280.0});
  EXPECT_FALSE(mask.usable({240.0, 300.0}));
  EXPECT_TRUE(mask.usable({240.0, 270.0}));
  EXPECT_TRUE(mask.usable({100.0, 300.0}));
  EXPECT_TRUE(mask.picture().empty()) << "a suspicion is not knowledge";
  watch(mask, with_bonnet(), 5, 12);
  EXPECT_TRUE(mask.usable({240.0, 300.0})) << "it is forgotten";
  watch(mask, with_bonnet(), 17, 20);
  EXPECT_FALSE(mask.must_move({240.0, 300.0}));
}

TEST(CarMask, StaysEmptyWhereTheSceneMoves) {
  CarMask mask;
  watch(mask, Drive{}, 0, 80);
  EXPECT_TRUE(mask.picture().empty());
}

TEST(CarMask, LearnsNothingWhileTheCameraStands) {
  Drive drive = with_bonnet();
  drive.step = 0.0;
  CarMask mask;
  watch(mask, drive, 0, 60);
  EXPECT_TRUE(mask.picture().empty());
}

TEST(CarMask, KeepsWhatItLearnedThroughAStop) {
  CarMask mask;
  watch(mask, with_bonnet(), 0, 50);
  Drive stop = with_bonnet();
  stop.step = 0.0;
  watch(mask, stop, 0, 30);
  EXPECT_GT(share_in_rows(mask.picture(), kBonnet, kHeight), 0.97);
}

// It rests below the horizon as a bonnet does, but reaches up to where far things rest.
TEST(CarMask, DoesNotTakeAVehicleAtConstantGapForTheCar) {
  Drive drive;
  drive.truck_low = 200;  // 9° below the horizon: six camera heights ahead
  CarMask mask;
  watch(mask, drive, 0, 120);
  EXPECT_TRUE(mask.picture().empty());
}

TEST(CarMask, ForgetsWhatMovesAgain) {
  CarMask mask;
  watch(mask, with_bonnet(), 0, 50);
  watch(mask, Drive{}, 50, 160);
  EXPECT_LT(share_in_rows(mask.picture(), kBonnet, kHeight), 0.2);
}

TEST(CarMask, LearnsNothingWithoutACamera) {
  CarMask mask;
  for (int frame = 0; frame < 50; ++frame) {
    mask.observe(build_pyramid(picture(with_bonnet(), frame).view(), kLevels), {});
  }
  EXPECT_TRUE(mask.picture().empty());
}

CellGrid grid_of(int columns, int rows) {
  CellGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  return grid;
}

/// All below the horizon, nothing known of them.
std::vector<CellState> low_cells(const CellGrid& grid) {
  std::vector<CellState> cells(grid.size());
  for (auto& cell : cells) cell.low = true;
  return cells;
}

TEST(CarRegion, FillsBelowALongOutlineAndNotBelowASpeck) {
  const CellGrid grid = grid_of(40, 20);
  std::vector<CellState> cells = low_cells(grid);
  for (int column = 5; column < 30; column += 2) cells[grid.at(column, 14)].rests = true;
  cells[grid.at(36, 5)].rests = true;
  const std::vector<bool> car = car_region(grid, cells);
  EXPECT_TRUE(car[grid.at(16, 19)]);
  EXPECT_TRUE(car[grid.at(0, 19)]) << "the outline is carried on to the border near it";
  EXPECT_FALSE(car[grid.at(16, 11)]);
  EXPECT_TRUE(car[grid.at(36, 5)]);
  EXPECT_FALSE(car[grid.at(36, 19)]);
}

TEST(CarRegion, DoesNotFillWhereTheRoadIsSeenBelow) {
  const CellGrid grid = grid_of(40, 20);
  std::vector<CellState> cells = low_cells(grid);
  for (int column = 5; column < 30; ++column) {
    cells[grid.at(column, 14)].rests = true;
    for (int row = 16; row < 20; ++row) cells[grid.at(column, row)].moves = true;
  }
  const std::vector<bool> car = car_region(grid, cells);
  EXPECT_TRUE(car[grid.at(16, 14)]);
  EXPECT_FALSE(car[grid.at(16, 19)]);
}

// Reflections move. They lie between the bonnet's edge and the dust below them.
TEST(CarRegion, FillsBetweenTheOutlineAndTheLowestRestWhereMostMoves) {
  const CellGrid grid = grid_of(40, 20);
  std::vector<CellState> cells = low_cells(grid);
  for (int column = 5; column < 30; ++column) {
    cells[grid.at(column, 14)].rests = true;
    for (int row = 15; row < 20; ++row) cells[grid.at(column, row)].moves = true;
  }
  for (int row = 14; row < 19; ++row) cells[grid.at(20, row)] = {true, false, true, false};
  const std::vector<bool> car = car_region(grid, cells);
  EXPECT_TRUE(car[grid.at(19, 17)]);
  EXPECT_TRUE(car[grid.at(22, 17)]);
  EXPECT_FALSE(car[grid.at(10, 17)]);
}

TEST(KltTrackerCarMask, UsesNoCornersOfTheCarOnceItIsKnown) {
  for (const bool learn : {true, false}) {
    FeatureOptions options;
    options.mask.learn = learn;
    options.klt.max_tracks = 200;
    const auto tracker = make_tracker(options);
    TrackedPair pair;
    for (int frame = 0; frame < 50; ++frame) {
      pair = tracker->advance(tracker->prepare(picture(with_bonnet(), frame).view()), level_hint());
    }
    EXPECT_EQ(tracker->car_mask().empty(), !learn);
    const auto on_bonnet =
        std::count_if(pair.correspondences.begin(), pair.correspondences.end(),
                      [](const Correspondence& ac) { return ac.x2.y() > kBonnet; });
    if (learn) {
      EXPECT_EQ(on_bonnet, 0);
    }
  }
}

// Before the mask is known, too: else they outvote the scene from the first frame on.
TEST(KltTrackerCarMask, UsesNoCornersThatRestLowWhileTheSceneTravels) {
  FeatureOptions options;
  options.klt.max_tracks = 200;
  const auto tracker = make_tracker(options);
  for (int frame = 0; frame < 10; ++frame) {
    const TrackedPair pair =
        tracker->advance(tracker->prepare(picture(with_bonnet(), frame).view()), level_hint());
    EXPECT_FALSE(pair.standing) << frame;
    EXPECT_TRUE(std::none_of(pair.correspondences.begin(), pair.correspondences.end(),
                             [](const Correspondence& ac) {
                               return ac.x2.y() > kBonnet && (ac.x2 - ac.x1).norm() < 0.3;
                             }))
        << frame;
  }
  EXPECT_TRUE(tracker->car_mask().empty());
}

}  // namespace
}  // namespace oneac::internal
