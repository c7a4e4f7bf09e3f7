#pragma once

#include <cstdint>

namespace oneac {

/// What the program that reads bags (apps/rosbag) writes to its standard output: frames of this
/// head and `size` bytes: the topics and their end, the messages that were asked for in the order
/// of their times and their end; at any place a fault instead. Both programs are of one build, so
/// bytes are in its order.
struct BagFrameHead {
  std::uint64_t number;  ///< topic: count of its messages; message: time of receipt [ns]
  std::uint32_t kind;    ///< a BagFrame
  std::uint32_t topic;   ///< place in the list of topics
  std::uint32_t size;    ///< of what follows [bytes]
  std::uint32_t unused;
};
static_assert(sizeof(BagFrameHead) == 24);

enum BagFrame : std::uint32_t {
  kBagTopic = 1,  ///< "name\0type\0md5 of its definition"
  kBagMessage,    ///< as ROS 1 serialises it
  kBagEnd,        ///< of the topics, of the messages; nothing
  kBagFault,      ///< the library's words
  kBagUnindexed,  ///< the same, for a bag without index
};

/// 8192 x 8192 pixels of four bytes; a longer message is damage.
inline constexpr std::uint32_t kLargestBagMessage = 1U << 28U;

}  // namespace oneac
