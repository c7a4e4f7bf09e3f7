#include "car_mask.h"

#include "../feature_mask.h"
#include "travel.h"

#include "oneac/geometry/angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac::internal {
namespace {

constexpr std::size_t kFine = 2;    // pyramid level of the structure: a quarter of the image
constexpr std::size_t kCoarse = 3;  // of the test for travel: 2 px there are 16 of the image
constexpr double kUsualWidth = 1242.0, kUsualCell = 16.0;  // [px]
constexpr int kEvery = 5;                                  // [frames] between decisions
constexpr std::size_t kOldest = 4;  // [frames] over more of them few near pixels are found again
constexpr int kKnown = 20, kForgotten = 0, kMostEvidence = 100;  // [frames] of evidence
constexpr double kLargestShare = 0.45;  // of the image: more is no drive that can be measured

// [rad] below the horizon: at kLow the road is ten camera heights away, and slopes of the road and
// an error of the tilt (3° together) do not lift the horizon so far. From kDistant up things may be
// so far away that they rest.
constexpr double kLow = 6.0 * kDegree, kDistant = 1.5 * kDegree;
// A direction of travel that differs more from the camera's level axis is not believed.
constexpr double kSteadiest = 0.97;  // [-] cosine of 14°

// On a bend that a kerb or a lane line shares, these rest in the image and lie aslant of the flow
// that a straight way would give: by 18° at most, five heights ahead, on a bend of this radius.
constexpr double kTightest = 33.0;  // [camera heights] 50 m under a camera at 1.5 m
// [rad] a frame: unsteady steering, and that bend at 4 m/s and 25 frames a second
constexpr double kStraight = 0.25 * kDegree;

constexpr std::size_t kStretches = 16;  // of the image's width
constexpr int kLeastVotes = 2;          // one track may be a wrong match
constexpr long kSuspected = 10;         // [frames] a car that sets off creeps no longer then
constexpr double kMargin = 4.0;         // [px] of an outline

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
  suspicions_.assign(kStretches, {});
  car_.assign(grid_.size(), false);
}

bool CarMask::observe(const ImagePyramid& now, const MotionHint& hint) {
  if (now.levels.size() <= kCoarse) return false;
  set_size(now);
  ++frame_;
  outlook_ = outlook(hint);
  shows_travel_ = false;
  if (!outlook_) return false;
  const Travel travel = travel_to(smoothed_for_travel(now.levels[kCoarse]), *outlook_);
  const bool rim_is_new = travel.shown && rim_.add(now.levels[kFine]);
  if (!travel.shown || !is_straight(travel, hint)) return rim_is_new;
  const int first = outlook_->first_row_below(-std::sin(kDistant), width_, height_);
  structure_.add(now.levels[kFine], outlook_->foe / (1 << kFine), first / (1 << kFine));
  if (++undecided_ < kEvery) return rim_is_new;
  undecided_ = 0;
  decide(*outlook_);
  return true;
}

TravelView CarMask::view_of(const Outlook& outlook) const {
  constexpr double kScale = 1.0 / (1 << kCoarse);
  TravelView view;
  view.centre = kScale * Eigen::Vector2d(outlook.camera.cx, outlook.camera.cy);
  view.foe = kScale * outlook.foe;
  view.focal = kScale * outlook.camera.focal_px();
  view.end_row =
      static_cast<int>(kScale * outlook.first_row_below(std::sin(kLow), width_, height_));
  return view;
}

Travel CarMask::travel_to(PyramidLevel now, const Outlook& outlook) {
  const TravelView view = view_of(outlook);
  Travel travel;
  if (!before_.empty()) travel = internal::shows_travel(before_.back(), now, view);
  shows_travel_ = travel.shown;
  if (!travel.shown && before_.size() > 1) {
    travel = internal::shows_travel(before_.front(), now, view);
    travel.yaw /= static_cast<double>(before_.size());
  }
  if (travel.shown || before_.size() > kOldest) before_.clear();
  before_.push_back(std::move(now));
  return travel;
}

bool CarMask::is_straight(const Travel& travel, const MotionHint& hint) {
  const bool scaled = hint.scaled && hint.T_2_1 && hint.T_2_1->is_finite();
  const double step = scaled ? hint.T_2_1->t.norm() : 0.0;
  return std::abs(travel.yaw) <= std::max(kStraight, step / kTightest);
}

bool CarMask::must_move(const Eigen::Vector2d& u) const {
  return shows_travel_ && !knows_ && outlook_ && outlook_->below_horizon(u) > std::sin(kLow);
}

void CarMask::break_sequence() {
  before_.clear();
  shows_travel_ = false;
}

void CarMask::decide(const Outlook& outlook) {
  const std::vector<CellTrace> traces = structure_.traces(grid_);
  const int frames = decided_ ? kEvery : structure_.frames();
  decided_ = structure_.can_tell();
  knows_ = structure_.frames() >= kKnown;
  std::vector<CellState> cells(grid_.size());
  const double cell_px = grid_.side * (1 << kFine);
  for (int row = 0; row < grid_.rows; ++row) {
    for (int column = 0; column < grid_.columns; ++column) {
      const std::size_t i = grid_.at(column, row);
      const int vote = traces[i] == CellTrace::kRests ? 1 : traces[i] == CellTrace::kMoves ? -1 : 0;
      evidence_[i] = std::clamp(evidence_[i] + vote * frames, kForgotten, kMostEvidence);
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

std::size_t CarMask::stretch_of(double column) const {
  const double stretch = column * static_cast<double>(kStretches) / width_;
  return static_cast<std::size_t>(std::clamp(stretch, 0.0, kStretches - 1.0));
}

void CarMask::suspect(const Eigen::Vector2d& u) {
  Suspicion& suspicion = suspicions_[stretch_of(u.x())];
  if (frame_ >= suspicion.until) suspicion = {0, u.y(), 0};
  ++suspicion.votes;
  suspicion.top = std::min(suspicion.top, u.y());
  suspicion.until = frame_ + kSuspected;
}

bool CarMask::is_suspected(const Eigen::Vector2d& u) const {
  if (knows_ || suspicions_.empty()) return false;
  const Suspicion& suspicion = suspicions_[stretch_of(u.x())];
  return suspicion.votes >= kLeastVotes && frame_ < suspicion.until &&
         u.y() > suspicion.top - kMargin;
}

bool CarMask::usable(const Eigen::Vector2d& u) const {
  return !is_suspected(u) && !is_fixed(u);
}

bool CarMask::is_car(const Eigen::Vector2d& u) const {
  if (!any_) return false;
  const double cell_px = grid_.side * (1 << kFine);
  const int column = std::clamp(static_cast<int>(u.x() / cell_px), 0, grid_.columns - 1);
  const int row = std::clamp(static_cast<int>(u.y() / cell_px), 0, grid_.rows - 1);
  return car_[grid_.at(column, row)];
}

bool CarMask::is_fixed(const Eigen::Vector2d& u) const {
  return is_car(u) || rim_.covers(u / (1 << kFine));
}

GreyImage CarMask::picture() const {
  if (!any_ && !rim_.any()) return {};
  return dark_where(width_, height_, [this](const Eigen::Vector2d& u) { return is_fixed(u); });
}

}  // namespace oneac::internal
