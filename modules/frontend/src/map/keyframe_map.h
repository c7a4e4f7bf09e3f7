#pragma once

#include "local_map.h"
#include "scale/measurements.h"
#include "settling.h"
#include "two_view/two_view.h"

#include "oneac/frontend/keyframe.h"
#include "oneac/frontend/window_options.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>

namespace oneac {

/// Which image a frame is.
struct FrameStamp {
  std::size_t index = 0;  ///< of the camera in the log
  double time_s = 0.0;    ///< [s]
};

/// What the map makes of a step before its length is known.
struct MapLink {
  std::optional<LengthMeasurement> carried;  ///< length that its landmarks carry over [map]
  bool began_anew = false;                   ///< nothing was carried over: a new segment
};

/// Where the newest frame lies and what it made final.
struct FrameInMap {
  Eigen::Isometry3d T_first_cam = Eigen::Isometry3d::Identity();
  std::optional<std::size_t> keyframe;  ///< id, when the frame is one
  Settled settled;
};

/// Keyframes and landmarks of a drive: where the camera is, the window that is adjusted, what
/// leaves it. The one owner of LocalMap and Settling; without a window it adds up steps.
///
/// A step goes through link(), move() and settle(), between which others say how long it was and
/// how far the scale is to be corrected.
class KeyframeMap {
 public:
  /// @param workers  as of LocalMap
  explicit KeyframeMap(const WindowOptions& options, Workers* workers = nullptr);

  /// The first frame of the drive.
  [[nodiscard]] FrameInMap start(const FrameStamp& frame, double focal_px);
  /// Of the landmarks that the next step sees, in the newest frame [map]; empty without a window.
  [[nodiscard]] PointDepths depths(const TrackedPair& step) const {
    return window_ ? window_->depths(step, T_cam_map_) : PointDepths{};
  }
  /// Carries the tracks of the newest step on.
  [[nodiscard]] MapLink link(const TwoView& seen);
  /// Moves the camera to the new frame. When that becomes a keyframe the window is adjusted, and
  /// the lengths that can be compared with others come out.
  /// @param motion       T_2_1, length as used
  /// @param R_level_cam  of the mounting: the car's planar motion is a prior of the window
  /// @param lengths_hold  the steps since the last keyframe were measured, see LocalMap::refine()
  [[nodiscard]] std::optional<MapLengths> move(const FrameStamp& frame, const RelativePose& motion,
                                               const TwoView& seen,
                                               const Eigen::Matrix3d& R_level_cam,
                                               bool lengths_hold = false);
  /// All lengths are multiplied, between two steps.
  void rescale(const ScaleCorrection& correction);
  /// Ends the step.
  /// @param correction  when move() made a keyframe
  [[nodiscard]] FrameInMap settle(const std::optional<ScaleCorrection>& correction);
  /// See LocalMap::renormalise().
  void renormalise(const CameraChange& change) {
    if (window_) window_->renormalise(change);
  }
  /// What the map says of lengths is wrong: it begins anew with the next step.
  void forget() { lost_ = true; }
  /// What still waits, at the end of a drive. A frame that comes after it begins a new segment.
  [[nodiscard]] Settled finish();
  /// Tracks that have settled since the last call, see LocalMap::take_tracks().
  [[nodiscard]] SettledTracks take_tracks() {
    return window_ ? window_->take_tracks() : SettledTracks{};
  }

  /// The newest frame, when it became a keyframe.
  [[nodiscard]] std::optional<NewestKeyframe> newest() const {
    return window_ ? window_->newest() : std::nullopt;
  }
  [[nodiscard]] std::size_t frames() const { return frames_; }    ///< so far
  [[nodiscard]] std::size_t segment() const { return segment_; }  ///< of the newest frame

 private:
  void begin_anew();
  void correct(const ScaleCorrection& correction);
  [[nodiscard]] Eigen::Isometry3d T_first_cam() const;

  WindowOptions options_;
  Workers* workers_;
  std::optional<LocalMap> window_;  ///< from the first frame on, unless switched off
  Settling settling_;
  Settled final_;                 ///< since the last result
  FrameStamp newest_;             ///< frame
  RelativePose T_cam_map_;        ///< of it; the map's frame is the first camera's
  std::size_t frames_ = 0;        ///< so far, the newest included
  std::size_t segment_ = 0;       ///< raised when the map began anew
  bool lost_ = false;             ///< the last step was not carried by its images
  double keyframe_time_s_ = 0.0;  ///< of the last keyframe
  RelativePose T_from_before_;    ///< the newest one in that before, before the window was adjusted
};

}  // namespace oneac
