#pragma once

#include "car_region.h"
#include "patch/image_pyramid.h"
#include "static_structure.h"

#include "oneac/features/ac_tracker.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace oneac::internal {

/// Learns over the drive what is fixed to the car (bonnet, its ornaments and dust, a bar at the
/// lower border) by what only the car can do: rest in the image, far below the horizon, while the
/// image shows travel. docs/decisions/car-mask.md.
///
/// What it cannot know: things above kLow below the horizon (drops, dirt and displays high in the
/// image) rest like far scenery and are not learned; nor is anything while the camera looks
/// sideways, or the horizon is unknown.
class CarMask {
 public:
  /// Takes an image in order of time. @param hint  of the step to this image: camera, tilt and,
  /// where known, direction of travel
  /// @return whether it was decided anew what the car is
  bool observe(const ImagePyramid& now, const MotionHint& hint);
  /// Whether this place of the image is not known to be the car. [px of level 0]
  [[nodiscard]] bool usable(const Eigen::Vector2d& u) const;
  /// Black where the car is, white elsewhere; empty while nothing was learned.
  [[nodiscard]] GreyImage picture() const;
  /// Whether the last decision found more car than an image can lose, and dropped it.
  [[nodiscard]] bool is_refused() const { return refused_; }
  /// Another image does not follow the last one; what was learned holds.
  void break_sequence() { before_.clear(); }

 private:
  /// Where to look in an image, in pixels of level 0.
  struct Outlook {
    Eigen::Vector2d foe;   ///< direction of travel
    Eigen::Vector3d down;  ///< in the camera frame
    PinholeCamera camera;
    [[nodiscard]] double below_horizon(const Eigen::Vector2d& u) const;  ///< [sine]
    [[nodiscard]] int first_row_below(double sine, int width, int height) const;
  };
  [[nodiscard]] static std::optional<Outlook> outlook(const MotionHint& hint);
  [[nodiscard]] bool travels(const PyramidLevel& now, const Outlook& outlook) const;
  void set_size(const ImagePyramid& now);
  void decide(const Outlook& outlook);

  int width_ = 0;
  int height_ = 0;
  CellGrid grid_;
  std::vector<PyramidLevel> before_;  ///< the coarse level of the image before; none or one
  StaticStructure structure_;
  int undecided_ = 0;          ///< frames added since the last decision
  std::vector<int> evidence_;  ///< [frames] of rest less those of motion, per cell
  std::vector<bool> rests_;    ///< with hysteresis
  std::vector<bool> car_;
  bool any_ = false;
  bool refused_ = false;
};

}  // namespace oneac::internal
