#pragma once

#include "klt_track.h"
#include "motion_prediction.h"

#include <Eigen/Core>

#include <cstddef>
#include <unordered_map>

namespace oneac::internal {

/// Recognises what moves with the camera (bonnet, reflections in the windscreen): points that stay
/// where they are although the expected motion moves whatever is seen there. A point below the
/// horizon cannot lie beyond the road, one above it cannot lie beyond infinity.
class StaticPoints {
 public:
  explicit StaticPoints(int frames) : frames_(frames) {}

  /// Begins a pair. @param median_flow_px  of all points found
  void begin_pair(std::size_t frame, double median_flow_px);
  /// Whether the track rested while it had to move in this pair, or has rested since it had to by
  /// its place; counts it in the track.
  /// @param by_place  it had to move whatever the motion that is expected
  [[nodiscard]] bool rests(KltTrack& track, const Eigen::Vector2d& flow,
                           const MotionPrediction& expected, bool by_place);
  /// Whether a tenth of what had to move lately rested: the view goes through drops or dirt, or
  /// along the car, and what rests in the picture does not say that the car does.
  [[nodiscard]] bool views_through_dirt() const;
  /// Whether the track has rested so long that it is no part of the scene.
  [[nodiscard]] bool is_static(const KltTrack& track) const;
  /// Keeps corners of this cell from being taken for a while.
  void block(std::size_t cell);
  [[nodiscard]] bool is_blocked(std::size_t cell) const;
  void clear() { blocked_until_.clear(); }

 private:
  /// A point more that had to move in this pair.
  void count(bool at_rest);

  int frames_;
  std::size_t frame_ = 0;
  double median_flow_px_ = 0.0;
  bool counts_ = false;                      ///< something had to move in this pair
  double had_to_move_ = 0.0, rested_ = 0.0;  ///< [points] lately
  std::unordered_map<std::size_t, std::size_t> blocked_until_;
};

}  // namespace oneac::internal
