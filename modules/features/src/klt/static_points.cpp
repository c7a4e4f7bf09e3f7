#include "static_points.h"

namespace oneac::internal {
namespace {

constexpr double kRest = 0.3;         // [px] a few σ of a tracked point
constexpr double kMustMove = 2.5;     // [px] ten times kRest, so that no error of the hint does it
constexpr std::size_t kBlocked = 50;  // [frames] then the cell gets another chance
// Without a metric hint far points near the direction of travel rest as well: let only long rest
// count, while the image as a whole moves.
constexpr int kUncertainFactor = 4;
// [points] before anything is said, and what a pair leaves of the count: some fifty of them count.
constexpr double kFewest = 50.0, kMemory = 0.98;
// Through clean glass it is less than a twenty-fifth (wrong matches, traffic that keeps its
// distance), through drops a fifth.
constexpr double kDirt = 0.1;

}  // namespace

void StaticPoints::begin_pair(std::size_t frame, double median_flow_px) {
  frame_ = frame;
  median_flow_px_ = median_flow_px;
  counts_ = false;
}

void StaticPoints::count(bool at_rest) {
  // A pair in which nothing had to move, as at a light, does not clean the glass.
  if (!counts_) {
    had_to_move_ *= kMemory;
    rested_ *= kMemory;
  }
  counts_ = true;
  had_to_move_ += 1.0;
  rested_ += at_rest ? 1.0 : 0.0;
}

bool StaticPoints::views_through_dirt() const {
  return had_to_move_ >= kFewest && rested_ >= kDirt * had_to_move_;
}

bool StaticPoints::rests(KltTrack& track, const Eigen::Vector2d& flow,
                         const MotionPrediction& expected, bool by_place) {
  const bool at_rest = flow.norm() < kRest;
  auto warp = expected.on_road(track.u);
  if (!warp) warp = expected.far_away(track.u);
  const bool by_motion = warp && (warp->centre - track.u).norm() > kMustMove;
  const bool must_move = by_place || by_motion;
  if (must_move) count(at_rest);
  const bool others_move = !expected.is_metric() && median_flow_px_ > kMustMove;
  track.like_the_car = at_rest && (by_place || track.like_the_car);
  if (!at_rest) {
    track.at_rest = 0;
  } else if (must_move) {
    track.at_rest += kUncertainFactor;
  } else if (others_move) {
    ++track.at_rest;
  }
  return at_rest && (must_move || track.like_the_car);
}

bool StaticPoints::is_static(const KltTrack& track) const {
  return track.at_rest >= kUncertainFactor * frames_;
}

void StaticPoints::block(std::size_t cell) {
  blocked_until_[cell] = frame_ + kBlocked;
}

bool StaticPoints::is_blocked(std::size_t cell) const {
  const auto found = blocked_until_.find(cell);
  return found != blocked_until_.end() && frame_ < found->second;
}

}  // namespace oneac::internal
