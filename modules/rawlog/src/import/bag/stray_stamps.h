#pragma once

#include <cstddef>
#include <vector>

namespace oneac {

/// When a message says that it was made, and when it was recorded [s].
struct MessageTime {
  double stamp_s = 0.0;
  double received_s = 0.0;
};

/// A message whose stamp is wrong: it would be sorted among others than those of its time.
struct StrayStamp {
  std::size_t place = 0;  ///< of the message in the order of recording
  double off_s = 0.0;     ///< later than its neighbours' [s]
};

/// Stamps that jump for a message: the time from stamp to recording differs by more than ten
/// seconds from that of the six messages around it (the usual one of the drive is the clocks'
/// offset, and may drift or step), and the stamp is not between theirs: messages that were held up
/// for long, and then come in their order, are none.
[[nodiscard]] std::vector<StrayStamp> stray_stamps(const std::vector<MessageTime>& times);

}  // namespace oneac
