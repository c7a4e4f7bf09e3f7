#pragma once

#include "oneac/calibration/calibration_window.h"
#include "oneac/calibration/intrinsics.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace oneac {

/// A stretch of road as a camera on a car sees it, with tracks of all that stays in the picture.
struct SyntheticDrive {
  double turn = 0.0;      ///< [rad] to the right from one view to the next
  double step = 1.0;      ///< [m]
  double noise_px = 0.0;  ///< 1σ
  double nod = 0.003;     ///< [rad] of pitch, there and back: springs
  std::size_t views = 12;
  std::size_t points = 300;
  std::uint64_t seed = 1;
};

inline PinholeCamera true_camera() {
  PinholeCamera camera;
  camera.width = 1240;
  camera.height = 380;
  camera.fx = camera.fy = 720.0;
  camera.cx = 610.0;
  camera.cy = 180.0;
  return camera;
}

inline RelativePose synthetic_pose(const SyntheticDrive& drive, std::size_t view) {
  RelativePose T;  // of the view against the map
  for (std::size_t i = 0; i < view; ++i) {
    RelativePose step{yaw_rotation(std::cos(drive.turn), std::sin(drive.turn)),
                      {0, 0, -drive.step}};
    T = step * T;
  }
  T.R = pitch_rotation(view % 2 == 0 ? 0.0 : drive.nod) * T.R;
  T.t = pitch_rotation(view % 2 == 0 ? 0.0 : drive.nod) * T.t;
  return T;
}

inline CalibrationWindow synthetic_window(const SyntheticDrive& drive,
                                          const PinholeCamera& camera) {
  std::mt19937_64 random(drive.seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  CalibrationWindow window;
  for (std::size_t i = 0; i < drive.views; ++i) {
    window.views.push_back({synthetic_pose(drive, i), {}});
  }
  for (std::uint64_t track = 0; track < drive.points; ++track) {
    // Seen in a view in the middle, at 6 to 60 m.
    const auto& middle = window.views[track % drive.views].T_view_map;
    const Eigen::Vector2d u(share(random) * camera.width, share(random) * camera.height);
    const Eigen::Vector2d x = normalise_distorted(camera, u);
    const double depth = 6.0 * std::pow(10.0, share(random));
    const Eigen::Vector3d X =
        middle.inverse() * Eigen::Vector3d(depth * x.x(), depth * x.y(), depth);
    for (CalibrationView& view : window.views) {
      const Eigen::Vector3d p = view.T_view_map * X;
      if (p.z() < 1.0) continue;
      const Eigen::Vector2d at = project_distorted(camera, {p.x() / p.z(), p.y() / p.z()});
      if (at.x() < 0 || at.y() < 0 || at.x() > camera.width || at.y() > camera.height) continue;
      const Eigen::Vector2d error(noise(random), noise(random));
      view.sightings.push_back({track, at + drive.noise_px * error});
    }
  }
  return window;
}

}  // namespace oneac
