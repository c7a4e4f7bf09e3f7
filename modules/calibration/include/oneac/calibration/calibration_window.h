#pragma once

#include "oneac/geometry/camera.h"
#include "oneac/geometry/relative_pose.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace oneac {

/// A track in one image.
struct CalibrationSighting {
  std::uint64_t track = 0;                      ///< the same in every image
  Eigen::Vector2d u = Eigen::Vector2d::Zero();  ///< [px] of the raw image
};

/// A keyframe.
struct CalibrationView {
  RelativePose T_view_map;                     ///< as the drive believes; the length unit is free
  std::vector<CalibrationSighting> sightings;  ///< in the order of their tracks
};

/// A stretch of a drive, of which tracks reach from view to view.
struct CalibrationWindow {
  std::vector<CalibrationView> views;
};

/// [rad] how far the camera turned at most between any view and the first: without a turn nothing
/// tells a focal length.
[[nodiscard]] double turn_of(const CalibrationWindow& window);

/// Cuts a drive into windows that do not overlap, view by view. A view that shares no track with
/// the one before begins a new one.
class WindowCutter {
 public:
  /// Keyframes of a window: tracks live through ten, and errors of a drive add up.
  static constexpr std::size_t kViews = 12;

  /// @return the window before, when this view begins a new one
  [[nodiscard]] std::optional<CalibrationWindow> add(CalibrationView view);
  /// What is left.
  [[nodiscard]] CalibrationWindow finish();

 private:
  CalibrationWindow window_;
};

}  // namespace oneac
