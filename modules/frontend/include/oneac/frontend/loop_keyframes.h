#pragma once

#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/keyframe.h"
#include "oneac/loops/loop_keyframe.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace oneac {

/// The step to a frame of a drive, by the frame's place from 0 on; none for the first.
using StepTo = std::function<std::optional<StepResult>(std::size_t frame)>;

/// What the errors of the steps from one keyframe to the next add up to, as LoopKeyframe has it;
/// zero over a loss of tracking.
[[nodiscard]] Eigen::Matrix<double, 6, 6> covariance_between(const Keyframe& before,
                                                             const Keyframe& keyframe,
                                                             const StepTo& step_to);

/// A keyframe as LoopCloser takes it.
/// @param before        the keyframe before; null for the first of a drive
/// @param shared_sigma  relative 1σ that all lengths of the drive share: scale_sigma where the step
///                      to the keyframe is not in metres
[[nodiscard]] LoopKeyframe to_loop_keyframe(const Keyframe& keyframe, const Keyframe* before,
                                            const StepTo& step_to, double shared_sigma);

/// The keyframes of a drive as they settle, for LoopCloser.
class LoopKeyframes {
 public:
  /// @param shared_sigma  as of to_loop_keyframe(); by the road scale.road_uncertainty
  explicit LoopKeyframes(double shared_sigma) : shared_sigma_(shared_sigma) {}

  /// What FrontEnd::process() or feed() gave, all of it in its order.
  void add(const FrameResult& result);
  /// What FrontEnd::finish() gave.
  void add(const Settled& settled);
  /// Those that have settled so far.
  [[nodiscard]] const std::vector<LoopKeyframe>& settled() const { return keyframes_; }

 private:
  double shared_sigma_;
  std::size_t frames_ = 0;
  std::map<std::size_t, StepResult> steps_;  ///< by frame: from the last settled keyframe on
  std::optional<Keyframe> last_;             ///< without its points
  std::vector<LoopKeyframe> keyframes_;
};

}  // namespace oneac
