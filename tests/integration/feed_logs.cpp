// Feeds one front-end per log, turn by turn, and writes what each of them says, to the last bit:
//   feed_logs OUT_FOLDER LOG INITIALISER [LOG INITIALISER ...]     → OUT_FOLDER/<INITIALISER>.txt
#include "oneac/base/atomic_file.h"
#include "oneac/frontend/front_end.h"
#include "oneac/rawlog/rawlog_source.h"

#include <cstdio>
#include <deque>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace oneac {
namespace {

class Drive {
 public:
  Drive(const std::string& log, const std::string& initialiser)
      : name_(initialiser), source_(source_of(log)), front_end_(options_of(initialiser)) {}

  /// One image further; false at the end of the log.
  bool advance() {
    const auto ticket = source_.next();
    if (!ticket) return false;
    const FrameResult result = front_end_.process(front_end_.prepare(source_.load(*ticket)));
    say(result.T_first_cam);
    if (result.step) say(result.step->pose.R, result.step->pose.t, result.step->inliers);
    take(result.settled);
    return true;
  }
  void finish(const std::filesystem::path& folder) {
    take(front_end_.finish());
    write_file_atomically(folder / (name_ + ".txt"), text_);
  }

 private:
  static SourceOptions source_of(const std::string& log) {
    SourceOptions options;
    options.log = log;
    return options;
  }
  static FrontEndOptions options_of(const std::string& initialiser) {
    FrontEndOptions options;
    options.initialiser = initialiser;
    return options;
  }
  void say(double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%a ", value);  // hexadecimal: every bit
    text_ += digits;
  }
  void say(const Eigen::Isometry3d& T) {
    for (int k = 0; k < 12; ++k) say(T(k / 4, k % 4));
    text_ += '\n';
  }
  void say(const Eigen::Matrix3d& R, const Eigen::Vector3d& t, std::size_t inliers) {
    for (int k = 0; k < 9; ++k) say(R(k / 3, k % 3));
    for (int k = 0; k < 3; ++k) say(t(k));
    text_ += std::to_string(inliers) + '\n';
  }
  void take(const Settled& settled) {
    for (const SettledFrame& frame : settled.frames) say(frame.T_first_cam);
    for (const Keyframe& keyframe : settled.keyframes) {
      say(keyframe.information.sum());
      text_ += std::to_string(keyframe.points.size()) + '\n';
    }
  }

  std::string name_;
  RawlogSource source_;
  FrontEnd front_end_;
  std::string text_;
};

void feed(const std::vector<std::string>& arguments) {
  std::deque<Drive> drives;  // front-ends do not move
  for (std::size_t i = 1; i + 1 < arguments.size(); i += 2) {
    drives.emplace_back(arguments[i], arguments[i + 1]);
  }
  for (bool any = true; any;) {
    any = false;
    for (Drive& drive : drives) any = drive.advance() || any;
  }
  for (Drive& drive : drives) drive.finish(arguments[0]);
}

}  // namespace
}  // namespace oneac

int main(int argc, char** argv) {
  try {
    oneac::feed({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "feed_logs: %s\n", error.what());
    return 1;
  }
}
