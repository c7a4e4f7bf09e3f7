#pragma once

#include "scale/measurements.h"
#include "track_store.h"

#include "oneac/calibration/camera_change.h"
#include "oneac/frontend/keyframe.h"
#include "oneac/frontend/window_options.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace oneac {

class Workers;

/// A keyframe of the window.
struct WindowKeyframe {
  std::size_t id = 0;
  std::size_t frame = 0;  ///< counts processed frames
  RelativePose T_cam_map;
};

/// Keyframes and landmarks of the recent past. Lengths are those of the map: metres once a scale
/// was set by rescale(). The map's frame is the first camera's; it goes on through restarts.
class LocalMap {
 public:
  /// @param workers  who shares the adjustment of the window; none: the calling thread alone
  LocalMap(const WindowOptions& options, double focal_px, Workers* workers = nullptr);

  /// The first keyframe of a map; tracks and keyframes before are forgotten.
  void start(std::size_t frame, const RelativePose& T_cam_map);
  /// One step further: tracks of its inliers.
  void extend(const TrackedPair& step, const std::vector<bool>& inliers);
  /// Length of the step (R, t̂) from the frame before to this one by the landmarks that both see.
  [[nodiscard]] std::optional<LengthMeasurement> carry(const RelativePose& unit_step,
                                                       const RelativePose& T_before_map) const;
  /// Depths of the landmarks that a step sees, in the frame before [map]; one per correspondence.
  [[nodiscard]] PointDepths depths(const TrackedPair& step, const RelativePose& T_before_map) const;
  /// Whether the newest frame should be a keyframe.
  [[nodiscard]] bool needs_keyframe(const RelativePose& T_cam_map, double seconds) const;
  /// Makes the newest frame one, and landmarks of the tracks that it shares with older ones.
  void add_keyframe(std::size_t frame, const RelativePose& T_cam_map);
  /// Adjusts the window; true when it took part.
  /// @param lengths_hold  the steps were measured: an adjustment that changes one by more than a
  ///                      tenth was led astray (the bonnet, traffic, nothing near) and is left out
  bool refine(const Eigen::Matrix3d& R_level_cam, bool lengths_hold = false);
  /// Depths of landmarks in the newest keyframe beside those measured otherwise.
  [[nodiscard]] std::vector<DepthComparison> compare_depths(const TrackedPair& step) const;
  /// Correspondences between the last keyframe and one before it.
  [[nodiscard]] KeyframePair pair_with(std::size_t steps_back) const;
  /// Multiplies all lengths, the oldest keyframe staying where it is.
  void rescale(double factor);
  /// Another camera from here on: the same pixels have other normalised coordinates. Poses and
  /// depths stay; the next adjustment moves them.
  void renormalise(const CameraChange& change);
  /// Whether the window has one keyframe more than it may.
  [[nodiscard]] bool is_over_full() const {
    return window_.size() > static_cast<std::size_t>(options_.size);
  }
  /// Takes the oldest keyframe out, with the landmarks that no other keyframe sees.
  [[nodiscard]] std::vector<MapPoint> retire_oldest();
  /// Sightings of landmarks that retire_oldest() has taken out since the last call, and which track
  /// each of its points was; only with options.keep_sightings.
  [[nodiscard]] SettledTracks take_tracks() { return std::exchange(settled_, {}); }

  /// The newest frame with what it sees, when it is a keyframe.
  [[nodiscard]] std::optional<NewestKeyframe> newest() const;
  [[nodiscard]] const std::deque<WindowKeyframe>& keyframes() const { return window_; }
  [[nodiscard]] const TrackMap& tracks() const { return tracks_; }
  /// Information of the second keyframe's pose given the first's, see Keyframe::information;
  /// of the two oldest ones.
  [[nodiscard]] Eigen::Matrix<double, 6, 6> oldest_constraint() const;

 private:
  /// [map] of a landmark in a view. @pre it has a depth
  [[nodiscard]] double depth_in(const RelativePose& T_view_map, const Track& track) const;
  [[nodiscard]] const WindowKeyframe& keyframe(std::size_t id) const;
  [[nodiscard]] std::size_t position(std::size_t id) const { return id - window_.front().id; }
  [[nodiscard]] bool stretches(const std::vector<WindowView>& views) const;
  void triangulate_new();
  void update_depth_information();
  void triangulate_but(const std::vector<std::uint64_t>& adjusted);
  [[nodiscard]] MapPoint point_of(const Track& track) const;
  void forget_sightings(std::size_t id, std::vector<MapPoint>& points);
  void move_anchor(Track& track);
  /// What forget_sightings() is about to take out of a landmark.
  void keep_sightings(std::uint64_t id, const Track& track, bool leaves);

  WindowOptions options_;
  double focal_px_;
  double sigma_;  ///< [-] of a point whose track does not say
  WindowRefiner refiner_;
  std::size_t next_id_ = 0;
  std::optional<std::size_t> newest_is_keyframe_;  ///< id, when the newest frame is one
  std::size_t tracks_of_last_ = 0;                 ///< alive when the last keyframe was made
  std::deque<WindowKeyframe> window_;
  TrackMap tracks_;
  SettledTracks settled_;
};

}  // namespace oneac
