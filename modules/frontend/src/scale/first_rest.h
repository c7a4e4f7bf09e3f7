#pragma once

#include "two_view/two_view.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace oneac {

/// Whether a drive begins at rest. From one image to the next a bonnet and drops on the glass rest
/// at any speed, and far scenery nearly does; over a second only what is fixed to the car does.
class FirstRest {
 public:
  /// The next step of the drive, normalised, between two times [s].
  void follow(const TwoView& seen, double begin_s, double end_s);
  /// Whether nearly all that was seen at once has kept its place for a while, before anything
  /// moved.
  [[nodiscard]] bool is_sure() const { return sure_; }

 private:
  void begin(const TwoView& seen, double time_s);
  /// Of the points that were there when it began. [-]
  [[nodiscard]] double share_in_place(const TwoView& seen) const;

  std::unordered_map<std::uint64_t, Eigen::Vector2d> places_;  ///< by track, where they began
  double since_s_ = 0.0;
  bool sure_ = false;
  bool over_ = false;  ///< something has moved, or nothing is left to ask
};

}  // namespace oneac
