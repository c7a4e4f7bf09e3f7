#pragma once

#include "refine_scenes.h"

#include "oneac/refine/sliding_window.h"

namespace oneac::test {

/// A street seen from a car: what is true, and the same with noisy observations.
struct WindowScene {
  SlidingWindow truth;  ///< its observations are the noisy ones
  double length = 0.0;  ///< from the first to the last view
};

struct WindowNoise {
  double point_px = 0.0;
  double affine = 0.0;
};

/// A patch of the street that view `anchor` sees 4 to 40 m ahead, at most 80° off face on.
inline WindowLandmark random_patch(SceneGenerator& generator, std::size_t anchor) {
  WindowLandmark patch;
  patch.anchor = anchor;
  patch.x = generator.image_point(-0.25, 0.25);
  patch.inverse_depth = 1.0 / generator.uniform(6.0, 40.0);
  patch.gradient.x() = patch.inverse_depth * generator.uniform(-2.0, 2.0);
  patch.gradient.y() = patch.inverse_depth * generator.uniform(-2.0, 2.0);
  return patch;
}

/// What a view measures of a patch, from the plane-induced homography of modules/geometry; false
/// when it cannot see it.
inline bool observe(SceneGenerator& generator, const SlidingWindow& window, std::size_t landmark,
                    std::size_t view, const WindowNoise& noise, WindowObservation& seen) {
  const WindowLandmark& patch = window.landmarks[landmark];
  const RelativePose T =
      window.views[view].T_view_map * window.views[patch.anchor].T_view_map.inverse();
  const Eigen::Vector3d m(patch.gradient.x(), patch.gradient.y(),
                          patch.inverse_depth - patch.gradient.dot(patch.x));
  const auto ac = correspondence_from_homography(T.R + T.t * m.transpose(), patch.x);
  if (!ac || ac->x2.norm() > 1.2 || ac->A.determinant() < 0.1) return false;
  seen.landmark = landmark;
  seen.view = view;
  seen.x = ac->x2;
  seen.A = ac->A;
  for (int i = 0; i < 2; ++i) seen.x(i) += generator.normal(noise.point_px / kFocal);
  for (int i = 0; i < 4; ++i) seen.A(i / 2, i % 2) += generator.normal(noise.affine);
  return true;
}

/// `views` keyframes a metre apart in a gentle bend, the first two fixed.
inline WindowScene street_window(SceneGenerator& generator, std::size_t views,
                                 std::size_t landmarks, const WindowNoise& noise) {
  WindowScene scene;
  scene.truth.focal_px = kFocal;
  RelativePose T_view_map;
  for (std::size_t i = 0; i < views; ++i) {
    scene.truth.views.push_back({T_view_map, i < 2});
    const double turn = 0.02;
    const RelativePose step{yaw_rotation(std::cos(turn), std::sin(turn)),
                            Eigen::Vector3d(0.01, 0.0, -1.0)};
    T_view_map = step * T_view_map;
  }
  for (std::size_t i = 0; i < landmarks; ++i) {
    scene.truth.landmarks.push_back(random_patch(generator, i % (views - 1)));
    for (std::size_t view = i % (views - 1); view < views; ++view) {
      WindowObservation seen;
      if (observe(generator, scene.truth, i, view, noise, seen))
        scene.truth.observations.push_back(seen);
    }
  }
  scene.length = static_cast<double>(views - 1);
  return scene;
}

/// The free views and all landmarks, disturbed.
inline SlidingWindow disturbed_window(SceneGenerator& generator, const SlidingWindow& truth) {
  SlidingWindow window = truth;
  for (WindowView& view : window.views) {
    if (view.fixed) continue;
    view.T_view_map.R = rotation_from_vector({generator.normal(0.005), generator.normal(0.005),
                                              generator.normal(0.005)}) *
                        view.T_view_map.R;
    for (int i = 0; i < 3; ++i) view.T_view_map.t(i) += generator.normal(0.05);
  }
  for (WindowLandmark& patch : window.landmarks) {
    patch.inverse_depth *= 1.0 + generator.uniform(-0.1, 0.1);
    patch.gradient.setZero();
  }
  return window;
}

}  // namespace oneac::test
