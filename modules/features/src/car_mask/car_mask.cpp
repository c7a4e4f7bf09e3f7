#include "car_mask.h"

#include "travel.h"

#include "oneac/geometry/angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr std::size_t kFine = 2;    // pyramid level of the structure: a quarter of the image
constexpr std::size_t kCoarse = 3;  // of the test for travel: 2 px there are 16 of the image
constexpr double kUsualWidth = 1242.0, kUsualCell = 16.0;        // [px]
constexpr int kEvery = 5;                                        // [frames] between decisions
constexpr int kKnown = 20, kForgotten = 0, kMostEvidence = 100;  // [frames] of evidence
constexpr double kLargestShare = 0.45;  // of the image: more is no drive that can be measured

// [rad] below the horizon: at kLow the road is ten camera heights away, and slopes of the road and
// an error of the tilt (3° together) do not lift the horizon so far. From kDistant up things may be
// so far away that they rest.
constexpr double kLow = 6.0 * kDegree, kDistant = 1.5 * kDegree;
// A direction of travel that differs more from the camera's level axis is not believed.
constexpr double kSteadiest = 0.97;  // [-] cosine of 14°

}  // namespace

double CarMask::Outlook::below_horizon(const Eigen::Vector2d& u) const {
  return down.dot(camera.normalise(u).homogeneous().normalized());
}

int CarMask::Outlook::first_row_below(double sine, int width, int height) const {
  for (int v = 0; v < height; v += 4) {
    if (below_horizon({0.0, v}) > sine || below_horizon({width - 1.0, v}) > sine ||
        below_horizon({0.5 * width, v}) > sine) {
      return v;
    }
  }
  return height;
}

std::optional<CarMask::Outlook> CarMask::outlook(const MotionHint& hint) {
  if (!(hint.camera.fx > 1.0 && hint.camera.fy > 1.0)) return std::nullopt;  // no camera yet
  Outlook outlook;
  outlook.camera = hint.camera;
  outlook.down = hint.R_level_cam.transpose().col(1);
  Eigen::Vector3d travel = hint.R_level_cam.transpose().col(2);
  if (hint.T_2_1 && hint.T_2_1->is_finite() && hint.T_2_1->t.norm() > 0.0) {
    const Eigen::Vector3d seen = (hint.T_2_1->R.transpose() * hint.T_2_1->t).normalized();
    const double along = seen.dot(travel);
    if (std::abs(along) > kSteadiest) travel = std::copysign(1.0, along) * seen;
  }
  if (!(travel.z() > 0.5)) return std::nullopt;  // the camera looks up or down
  outlook.foe = hint.camera.project(travel.hnormalized());
  return outlook;
}

void CarMask::set_size(const ImagePyramid& now) {
  if (width_ == now.width() && height_ == now.height()) return;
  *this = CarMask();
  width_ = now.width();
  height_ = now.height();
  const PyramidLevel& fine = now.levels[kFine];
  const double cell = kUsualCell * width_ / kUsualWidth / (1 << kFine);
  grid_.side = std::max(2, static_cast<int>(std::lround(cell)));
  grid_.columns = (fine.width + grid_.side - 1) / grid_.side;
  grid_.rows = (fine.height + grid_.side - 1) / grid_.side;
  evidence_.assign(grid_.size(), 0);
  rests_.assign(grid_.size(), false);
  car_.assign(grid_.size(), false);
}

bool CarMask::observe(const ImagePyramid& now, const MotionHint& hint) {
  if (now.levels.size() <= kCoarse) return false;
  set_size(now);
  const auto outlook = CarMask::outlook(hint);
  const bool adds = outlook && travels(now.levels[kCoarse], *outlook);
  before_.assign(1, now.levels[kCoarse]);
  if (!adds) return false;
  const int first = outlook->first_row_below(-std::sin(kDistant), width_, height_);
  structure_.add(now.levels[kFine], outlook->foe / (1 << kFine), first / (1 << kFine));
  if (++undecided_ < kEvery) return false;
  undecided_ = 0;
  decide(*outlook);
  return true;
}

bool CarMask::travels(const PyramidLevel& now, const Outlook& outlook) const {
  if (before_.empty()) return false;
  const int end = outlook.first_row_below(std::sin(kLow), width_, height_);
  constexpr double kScale = 1.0 / (1 << kCoarse);
  return shows_travel(before_.front(), now, kScale * outlook.foe, static_cast<int>(kScale * end));
}

void CarMask::decide(const Outlook& outlook) {
  const std::vector<CellTrace> traces = structure_.traces(grid_);
  std::vector<CellState> cells(grid_.size());
  const double cell_px = grid_.side * (1 << kFine);
  for (int row = 0; row < grid_.rows; ++row) {
    for (int column = 0; column < grid_.columns; ++column) {
      const std::size_t i = grid_.at(column, row);
      const int vote = traces[i] == CellTrace::kRests ? 1 : traces[i] == CellTrace::kMoves ? -1 : 0;
      evidence_[i] = std::clamp(evidence_[i] + vote * kEvery, kForgotten, kMostEvidence);
      if (evidence_[i] >= kKnown) rests_[i] = true;
      if (evidence_[i] <= kForgotten) rests_[i] = false;
      const double sine = outlook.below_horizon(cell_px * Eigen::Vector2d(column + 0.5, row + 0.5));
      cells[i] = {rests_[i], traces[i] == CellTrace::kMoves, sine > std::sin(kLow),
                  sine < std::sin(kDistant)};
    }
  }
  car_ = car_region(grid_, cells);
  const auto share = static_cast<double>(std::count(car_.begin(), car_.end(), true));
  refused_ = share > kLargestShare * static_cast<double>(car_.size());
  if (refused_) car_.assign(car_.size(), false);
  any_ = !refused_ && share > 0.0;
}

bool CarMask::usable(const Eigen::Vector2d& u) const {
  if (!any_) return true;
  const double cell_px = grid_.side * (1 << kFine);
  const int column = std::clamp(static_cast<int>(u.x() / cell_px), 0, grid_.columns - 1);
  const int row = std::clamp(static_cast<int>(u.y() / cell_px), 0, grid_.rows - 1);
  return !car_[grid_.at(column, row)];
}

GreyImage CarMask::picture() const {
  if (!any_) return {};
  constexpr std::uint8_t kWhite = 255;
  GreyImage image(width_, height_, kWhite);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      if (!usable(Eigen::Vector2d(u, v))) image.row(v)[u] = 0;
    }
  }
  return image;
}

}  // namespace oneac::internal
