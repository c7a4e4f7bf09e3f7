#pragma once

#include "oneac/features/correspondence.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace oneac {

/// A track where a keyframe saw it.
struct Sighting {
  std::size_t keyframe = 0;                             ///< id
  Eigen::Vector2d x = Eigen::Vector2d::Zero();          ///< [-]
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();  ///< ∂x/∂(x where the track began)
  double point_sigma = 0.0;                             ///< [-]; 0: unknown
  double affine_sigma = 0.0;                            ///< [-]; 0: unknown
};

/// A landmark's track with what is known of its depth: a patch in an anchor keyframe, see
/// WindowLandmark.
struct Track {
  bool alive = true;      ///< seen in the newest frame, as the pose says
  bool was_alive = true;  ///< the same of the frame before
  bool has_depth = false;
  bool has_gradient = false;
  std::uint8_t grey = 0;
  std::size_t anchor = 0;  ///< keyframe id
  Sighting now;            ///< in the newest frame; `keyframe` is not used
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();      ///< of the landmark, now.x, from the patch
                                                         ///< that is followed from here
  Eigen::Vector2d previous_x = Eigen::Vector2d::Zero();  ///< in the frame before
  std::vector<Sighting> seen;  ///< by keyframes of the window, oldest first
  Eigen::Vector2d ray = Eigen::Vector2d::Zero();
  double inverse_depth = 0.0;
  double depth_information = 0.0;  ///< inverse variance of inverse_depth
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();

  /// The sighting of a keyframe, or nullptr.
  [[nodiscard]] const Sighting* sighting(std::size_t keyframe) const;
};

using TrackMap = std::map<std::uint64_t, Track>;  // ordered: the same sums in every run

/// Extends the tracks by one step: chains affinities, begins new tracks, ends those that were not
/// seen or did not obey the pose.
/// @param step     normalised, corrected for perspective
/// @param inliers  one per correspondence; empty: all
/// @param keyframe_before  id of the keyframe that the frame before was, if it was one
void extend_tracks(const TrackedPair& step, const std::vector<bool>& inliers,
                   const std::size_t* keyframe_before, TrackMap& tracks);

}  // namespace oneac
