#pragma once

#include "import/bag/bag_frames.h"

#include "oneac/rawlog/import_rosbag.h"

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// A message as it is in the bag.
struct BagMessage {
  std::size_t topic = 0;          ///< place in BagReader::topics()
  std::size_t number = 0;         ///< of its topic, from 1 on
  std::uint64_t received_ns = 0;  ///< Unix time of its recording [ns]
  std::vector<std::uint8_t> bytes;
};

/// The messages of a bag of ROS 1 in the order of their recording, read by the program of
/// apps/rosbag: what a damaged bag does to ROS's library stays there.
class BagReader {
 public:
  /// @param topics  whose messages are wanted; none: only topics() is
  /// @throws InputError for what is no bag of ROS 1, when there is no such program, or where it
  ///         cannot read the bag
  BagReader(const std::filesystem::path& bag, const std::vector<std::string>& topics);
  ~BagReader();  ///< ends the program
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  [[nodiscard]] const std::vector<BagTopic>& topics() const { return topics_; }
  /// @return false at the end of the bag
  /// @throws InputError where the bag is damaged; everything before it has been given
  [[nodiscard]] bool next(BagMessage& message);

 private:
  void start(const std::filesystem::path& program, const std::vector<std::string>& topics);
  void read_topics();
  /// @throws InputError for a fault instead
  [[nodiscard]] BagFrameHead read_frame(std::vector<std::uint8_t>& bytes);
  [[nodiscard]] bool read_bytes(void* into, std::size_t count) const;
  void end_program();
  [[noreturn]] void fail_as_it_ended();
  [[noreturn]] void fail(const std::string& fault) const;

  std::filesystem::path bag_;
  int pipe_ = -1;
  pid_t program_ = -1;
  std::vector<BagTopic> topics_;
  std::vector<std::size_t> given_;  ///< messages of each topic
};

/// @throws InputError for what is no bag of ROS 1: no such file, ROS 2's, another kind of file
void require_bag(const std::filesystem::path& bag);

}  // namespace oneac
