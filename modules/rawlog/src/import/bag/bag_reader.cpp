#include "import/bag/bag_reader.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/printable.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCopyAgain =
    "copy the bag again, or take what is left of it with ROS's `rosbag reindex`";

bool is_of_ros2(const fs::path& bag, const std::string& begin) {
  std::error_code ignored;
  if (fs::is_directory(bag, ignored)) return fs::exists(bag / "metadata.yaml", ignored);
  return begin.rfind("SQLite format 3", 0) == 0 || begin.rfind("\x89MCAP", 0) == 0 ||
         bag.extension() == ".db3" || bag.extension() == ".mcap";
}

/// "name\0type\0md5"
BagTopic topic_of(const std::vector<std::uint8_t>& bytes, std::size_t messages) {
  std::array<std::string, 3> parts;
  std::size_t part = 0;
  for (const std::uint8_t byte : bytes) {
    if (byte != 0) {
      parts[part] += static_cast<char>(byte);
    } else if (part + 1 < parts.size()) {
      ++part;
    }
  }
  return {parts[0], parts[1], parts[2], messages};
}

/// What is to be opened in a program that is started.
class FileActions {
 public:
  FileActions(int output, int other_end) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addclose(&actions_, other_end);
    ::posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

void require_bag(const fs::path& bag) {
  std::error_code ignored;
  const bool there = fs::exists(bag, ignored);
  const std::string begin = beginning_of(bag, 16);
  if (there && is_of_ros2(bag, begin)) {
    throw InputError(bag.string(), "is a bag of ROS 2, not of ROS 1",
                     "convert it with ROS 2's rosbag2rawlog, and give its rawlog to `oneac run`");
  }
  if (const std::string fault = fault_of_file(bag); !fault.empty()) {
    throw InputError(bag.string(), fault, "give the .bag file of a drive");
  }
  if (begin.rfind("#ROSBAG V2.", 0) == 0) return;
  if (begin.rfind("#ROSBAG V", 0) == 0 || begin.rfind("#ROSRECORD", 0) == 0) {
    throw InputError(bag.string(), "is a bag of a format before 2.0",
                     "bring it to 2.0 with ROS's `rosbag reindex`");
  }
  throw InputError(bag.string(), begin.empty() ? "is empty" : "is no bag of ROS",
                   "give the .bag file of a drive");
}

BagReader::BagReader(const fs::path& bag, const std::vector<std::string>& topics) : bag_(bag) {
  require_bag(bag);
  const fs::path program = file_of_program("oneac_rosbag");
  if (program.empty()) {
    throw InputError(bag.string(), "this oneac was built without what reads bags (oneac_rosbag)",
                     "install librosbag-storage-dev and build oneac again");
  }
  start(program, topics);
  try {
    read_topics();
  } catch (...) {
    end_program();
    throw;
  }
}

BagReader::~BagReader() {
  end_program();
}

void BagReader::end_program() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
  if (program_ <= 0) return;
  ::kill(program_, SIGKILL);
  ::waitpid(program_, nullptr, 0);
  program_ = -1;
}

void BagReader::start(const fs::path& program, const std::vector<std::string>& topics) {
  std::vector<std::string> words{program.string(), fs::absolute(bag_).string()};
  words.insert(words.end(), topics.begin(), topics.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{-1, -1};
  int error = ::pipe2(ends.data(), O_CLOEXEC) == 0 ? 0 : errno;
  if (error == 0) {
    const FileActions actions(ends[1], ends[0]);
    error = ::posix_spawn(&program_, program.c_str(), actions.get(), nullptr, arguments.data(),
                          environ);
    ::close(ends[1]);
    pipe_ = ends[0];
  }
  if (error == 0) return;
  program_ = -1;
  end_program();
  throw InputError(program.string(), "cannot be started (" + std::string(::strerror(error)) + ")",
                   "install oneac again");
}

void BagReader::fail(const std::string& fault) const {
  std::size_t messages = 0;
  for (const std::size_t count : given_) messages += count;
  const std::string where = messages == 0
                                ? bag_.string()
                                : bag_.string() + ": behind message " + std::to_string(messages);
  throw InputError(where, fault, kCopyAgain);
}

void BagReader::fail_as_it_ended() {
  constexpr int kNotStarted = 127;  // what ld.so ends with
  int status = 0;
  if (::waitpid(program_, &status, 0) == program_) program_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotStarted) {
    throw InputError(bag_.string(), "what reads bags (oneac_rosbag) misses a library",
                     "install librosbag-storage-dev");
  }
  fail("is damaged: ROS's library does not survive it");
}

bool BagReader::read_bytes(void* into, std::size_t count) const {
  auto* at = static_cast<char*>(into);
  while (count > 0) {
    const ssize_t got = ::read(pipe_, at, count);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

BagFrameHead BagReader::read_frame(std::vector<std::uint8_t>& bytes) {
  BagFrameHead head{};
  if (!read_bytes(&head, sizeof head)) fail_as_it_ended();
  if (head.size > kLargestBagMessage) {
    fail("is damaged (a message of " + std::to_string(head.size) + " bytes)");
  }
  bytes.resize(head.size);
  if (!read_bytes(bytes.data(), bytes.size())) fail_as_it_ended();
  const std::string text = printable({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (head.kind == kBagUnindexed) {
    throw InputError(bag_.string(), "has no index, as when its recording was cut off",
                     "make one with ROS's `rosbag reindex`");
  }
  if (head.kind == kBagFault) fail("is damaged (" + shortened(text, 200) + ")");
  return head;
}

void BagReader::read_topics() {
  std::vector<std::uint8_t> bytes;
  for (BagFrameHead head = read_frame(bytes); head.kind == kBagTopic; head = read_frame(bytes)) {
    topics_.push_back(topic_of(bytes, head.number));
  }
  given_.assign(topics_.size(), 0);
}

bool BagReader::next(BagMessage& message) {
  const BagFrameHead head = read_frame(message.bytes);
  if (head.kind == kBagEnd) return false;
  if (head.kind != kBagMessage || head.topic >= topics_.size()) fail("is damaged");
  message.topic = head.topic;
  message.number = ++given_[head.topic];
  message.received_ns = head.number;
  return true;
}

}  // namespace oneac
