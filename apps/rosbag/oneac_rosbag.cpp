// Reads a bag of ROS 1 for `oneac import rosbag`: oneac_rosbag FILE [TOPIC...] writes frames
// (bag_frames.h) to standard output. A program of its own, because ROS's library trusts what a bag
// says: a damaged one may end it, or keep it busy for ever (docs/decisions/rosbag.md).
#include "import/bag/bag_frames.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sys/time.h>

#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

namespace {

using oneac::BagFrameHead;

/// The system ends the program after a minute of computing for one answer: no message takes as
/// long, nor does the index of ten million.
void begin_answer() {
  constexpr time_t kLongest_s = 60;
  const itimerval timer{{0, 0}, {kLongest_s, 0}};
  ::setitimer(ITIMER_VIRTUAL, &timer, nullptr);
}

/// @return false: nobody listens any more
bool put(const BagFrameHead& head, const void* bytes) {
  return std::fwrite(&head, sizeof head, 1, stdout) == 1 &&
         (head.size == 0 || std::fwrite(bytes, head.size, 1, stdout) == 1);
}

bool put_text(oneac::BagFrame kind, const std::string& text) {
  return put({0, kind, 0, static_cast<std::uint32_t>(text.size()), 0}, text.data());
}

std::string described(const rosbag::ConnectionInfo& connection) {
  return connection.topic + '\0' + connection.datatype + '\0' + connection.md5sum;
}

using Topics = std::map<std::string, std::uint32_t>;

/// Publishers of one topic count together.
Topics put_topics(rosbag::Bag& bag) {
  std::map<std::string, std::uint64_t> messages;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    const std::uint32_t id = connection->id;
    rosbag::View own(bag, [id](const rosbag::ConnectionInfo* other) { return other->id == id; });
    messages[described(*connection)] += own.size();
  }
  Topics topics;
  for (const auto& [text, count] : messages) {
    const auto place = static_cast<std::uint32_t>(topics.size());
    put({count, oneac::kBagTopic, place, static_cast<std::uint32_t>(text.size()), 0}, text.data());
    topics[text] = place;
  }
  put_text(oneac::kBagEnd, "");
  return topics;
}

void put_messages(rosbag::Bag& bag, const Topics& topics, const std::vector<std::string>& wanted) {
  rosbag::View view(bag, rosbag::TopicQuery(wanted));
  std::vector<std::uint8_t> bytes;
  for (const rosbag::MessageInstance& message : view) {
    begin_answer();
    const std::string text =
        message.getTopic() + '\0' + message.getDataType() + '\0' + message.getMD5Sum();
    if (message.size() > oneac::kLargestBagMessage) {
      throw rosbag::BagFormatException("a message of " + std::to_string(message.size()) + " bytes");
    }
    bytes.resize(message.size());
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    message.write(stream);
    const BagFrameHead head{message.getTime().toNSec(), oneac::kBagMessage, topics.at(text),
                            static_cast<std::uint32_t>(bytes.size()), 0};
    if (!put(head, bytes.data())) return;
  }
}

bool read(const std::string& file, const std::vector<std::string>& wanted) {
  try {
    begin_answer();
    rosbag::Bag bag(file, rosbag::bagmode::Read);
    const Topics topics = put_topics(bag);
    if (!wanted.empty()) put_messages(bag, topics, wanted);
    return put_text(oneac::kBagEnd, "");
  } catch (const rosbag::BagUnindexedException& error) {
    return put_text(oneac::kBagUnindexed, error.what());
  } catch (const std::exception& error) {
    return put_text(oneac::kBagFault, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("oneac_rosbag FILE [TOPIC...]: for `oneac import rosbag`\n", stderr);
    return 2;
  }
  const bool done = read(argv[1], {argv + 2, argv + argc});
  return done && std::fflush(stdout) == 0 ? 0 : 1;
}
