#pragma once

#include "oneac/features/correspondence.h"

#include <cstdint>
#include <unordered_map>

namespace oneac {

/// Notices an image that shows once more what the one before it showed, but for noise: a video that
/// was stretched to another rate and encoded anew. (One that repeats it pixel by pixel is left out
/// when it is read, see RepeatWatch.) Everything that moved in the step before rests all at once,
/// which dirt, a bonnet and far scenery do not: they have not moved. Nor does what a bump turned,
/// for near points went farther in it, and go on.
class RepeatedView {
 public:
  /// Whether what moved in the last step that was none of these, a second ago at most, rests in
  /// this one.
  /// @param pair  normalised
  [[nodiscard]] bool repeats(const TrackedPair& pair, double focal_px, double begin_s,
                             double end_s);

 private:
  struct Travel {
    double px = 0.0;
    bool moves = false;
  };
  std::unordered_map<std::uint64_t, Travel> before_;  ///< of the tracks in that step
  double time_s_ = 0.0;                               ///< of its end
};

}  // namespace oneac
