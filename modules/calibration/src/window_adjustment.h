#pragma once

#include "oneac/calibration/calibration_window.h"
#include "oneac/calibration/intrinsics.h"
#include "oneac/calibration/intrinsics_measurement.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace oneac {

/// Bundle adjustment of one window: its state, and what the images say about the camera.
class WindowAdjustment {
 public:
  /// Chooses tracks and triangulates them by the camera `start` away from `from`.
  WindowAdjustment(const CalibrationWindow& window, const PinholeCamera& from,
                   const IntrinsicsVector& start, const MeasurementOptions& options);

  [[nodiscard]] std::size_t tracks() const { return landmarks_.size(); }
  [[nodiscard]] std::size_t sightings() const { return seen_.size(); }
  [[nodiscard]] const IntrinsicsVector& change() const { return change_; }

  /// Minimises until the cost falls by less than this share in a step. @return whether something
  /// was found
  bool solve(const IntrinsicsMatrix& prior, double sigma_px, double function_tolerance);
  /// Of all sightings [px].
  [[nodiscard]] std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> residuals() const;
  /// Robust 1σ of a coordinate's residual [px].
  [[nodiscard]] double noise_px() const;
  /// Of the camera, poses and landmarks marginalised, without the prior.
  [[nodiscard]] IntrinsicsMatrix information(double sigma_px) const;

 private:
  struct Seen {
    std::size_t view, landmark;
    Eigen::Vector2d u;
  };
  using Point = std::array<double, 3>;  ///< x, y, ρ in its anchor
  using Pose = std::array<double, 6>;   ///< w, v

  /// One track: the view and pixel of each sighting.
  using Track = std::vector<std::pair<std::size_t, Eigen::Vector2d>>;
  void add_track(const Track& track, const PinholeCamera& camera);

  const CalibrationWindow& window_;
  PinholeCamera from_;
  MeasurementOptions options_;
  IntrinsicsVector change_;
  std::vector<Pose> poses_;
  std::vector<Point> landmarks_;
  std::vector<std::size_t> anchors_;  ///< views, one per landmark
  std::vector<Seen> seen_;            ///< landmark by landmark
};

}  // namespace oneac
