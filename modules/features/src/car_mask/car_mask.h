#pragma once

#include "car_region.h"
#include "dark_rim.h"
#include "patch/image_pyramid.h"
#include "static_structure.h"
#include "travel.h"

#include "oneac/features/ac_tracker.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace oneac::internal {

/// Learns over the drive what is fixed to the car (bonnet, its ornaments and dust, a bar at the
/// lower border) by what only the car can do: rest in the image, far below the horizon, while the
/// image shows travel; and what its lens leaves black, see DarkRim. docs/decisions/car-mask.md.
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
  /// Whether the image given last shows travel since the one before, by itself.
  [[nodiscard]] bool shows_travel() const { return shows_travel_; }
  /// Whether there was enough travel to tell what the car is.
  [[nodiscard]] bool knows() const { return knows_; }
  /// Whether what is here must have moved to the image given last, or be the car: only until there
  /// was enough travel to tell what the car is. [px of level 0]
  [[nodiscard]] bool must_move(const Eigen::Vector2d& u) const;
  /// Takes the place of a track that must_move() and rests: what lies below it is not used for a
  /// while. The reflections in a bonnet move, and only its dust tells that they are no road.
  void suspect(const Eigen::Vector2d& u);
  /// Whether this place of the image is not known to be the car or black, nor suspected. [px of
  /// level 0]
  [[nodiscard]] bool usable(const Eigen::Vector2d& u) const;
  /// Black where the car is, or nothing at all; white elsewhere; empty while nothing was learned.
  [[nodiscard]] GreyImage picture() const;
  /// Whether the last decision found more car than an image can lose, and dropped it.
  [[nodiscard]] bool is_refused() const { return refused_; }
  /// Another image does not follow the last one; what was learned holds.
  void break_sequence();

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
  /// What rests in one stretch of columns, before anything is known.
  struct Suspicion {
    int votes = 0;
    double top = 0.0;  ///< [px] row of the highest
    long until = 0;    ///< [frames] it is forgotten then
  };
  [[nodiscard]] std::size_t stretch_of(double column) const;
  [[nodiscard]] bool is_car(const Eigen::Vector2d& u) const;
  [[nodiscard]] bool is_fixed(const Eigen::Vector2d& u) const;
  [[nodiscard]] bool is_suspected(const Eigen::Vector2d& u) const;
  /// Whether the car goes nearly straight, so that what passes flows along r of StaticStructure.
  [[nodiscard]] static bool is_straight(const Travel& travel, const MotionHint& hint);
  [[nodiscard]] TravelView view_of(const Outlook& outlook) const;
  /// Travel since the image before or, where that shows too little, since the last that showed any.
  [[nodiscard]] Travel travel_to(PyramidLevel now, const Outlook& outlook);
  void set_size(const ImagePyramid& now);
  void decide(const Outlook& outlook);

  int width_ = 0;
  int height_ = 0;
  CellGrid grid_;
  std::vector<PyramidLevel> before_;  ///< coarse levels since the last that showed travel
  std::optional<Outlook> outlook_;    ///< of the image given last
  bool shows_travel_ = false;
  StaticStructure structure_;
  DarkRim rim_;
  std::vector<Suspicion> suspicions_;
  long frame_ = 0;
  int undecided_ = 0;          ///< frames added since the last decision
  bool decided_ = false;       ///< whether any decision rested on enough frames
  bool knows_ = false;         ///< whether what always rested would be known by now
  std::vector<int> evidence_;  ///< [frames] of rest less those of motion, per cell
  std::vector<bool> rests_;    ///< with hysteresis
  std::vector<bool> car_;
  bool any_ = false;
  bool refused_ = false;
};

}  // namespace oneac::internal
