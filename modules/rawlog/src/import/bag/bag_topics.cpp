#include "import/bag/bag_topics.h"

#include "import/bag/ros_messages.h"

#include "oneac/base/error.h"
#include "oneac/base/nearest_name.h"

#include <algorithm>

namespace oneac {
namespace {

using Topics = std::vector<BagTopic>;
using Types = std::vector<RosType>;

const Types kImageTypes{kRosImage, kRosCompressedImage};

bool is_of(const BagTopic& topic, const Types& types) {
  return std::any_of(types.begin(), types.end(),
                     [&](const RosType& type) { return topic.type == type.name; });
}

/// Topics of these types in which there is something.
Topics of_types(const Topics& topics, const Types& types) {
  Topics some;
  std::copy_if(topics.begin(), topics.end(), std::back_inserter(some),
               [&](const BagTopic& topic) { return is_of(topic, types) && topic.messages > 0; });
  return some;
}

std::string list_text(const Topics& topics) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(topics.size(), kShown); ++i) {
    text += (i == 0 ? "" : ", ") + topics[i].name + " (" + topics[i].type + ", " +
            std::to_string(topics[i].messages) + ")";
  }
  return topics.size() > kShown ? text + " ..." : text;
}

std::vector<std::string> names_of(const Topics& topics) {
  std::vector<std::string> names;
  for (const BagTopic& topic : topics) names.push_back(topic.name);
  return names;
}

void require_definition(const BagTopic& topic, const Types& types, const std::string& bag) {
  for (const RosType& type : types) {
    if (topic.type != type.name || topic.md5 == type.md5) continue;
    throw InputError(bag + ": " + topic.name,
                     "its messages are another " + topic.type + " than ROS 1's",
                     "give a bag recorded with ROS 1's own messages");
  }
}

/// The choices that a person has made, one flag at a time.
class TopicFinder {
 public:
  TopicFinder(const RosbagImport& options, const Topics& topics)
      : bag_(options.source.string()), topics_(topics) {}

  /// @throws InputError when it is not there, of another type or empty
  void require(const std::string& name, const std::string& flag, const Types& types) const {
    const auto named = [&](const BagTopic& topic) { return topic.name == name; };
    const auto at = std::find_if(topics_.begin(), topics_.end(), named);
    if (at == topics_.end()) {
      const Topics fitting = of_types(topics_, types);
      throw InputError(bag_, "it has no topic '" + name + "'",
                       fitting.empty() ? "leave " + flag + " out"
                                       : "did you mean " + flag + " " +
                                             nearest_name(name, names_of(fitting)) + "?");
    }
    const auto fits = std::find_if(at, topics_.end(), [&](const BagTopic& topic) {
      return named(topic) && is_of(topic, types);
    });
    if (fits == topics_.end()) {
      throw InputError(bag_ + ": " + name, "its messages are " + at->type,
                       "give " + flag + " a topic of " + types.front().name);
    }
    if (fits->messages == 0) {
      throw InputError(bag_ + ": " + name, "there is no message in it", "give another topic");
    }
    require_definition(*fits, types, bag_);
  }

  [[nodiscard]] std::string images(const std::string& given) const {
    const Topics fitting = of_types(topics_, kImageTypes);
    if (given.empty() && fitting.empty()) {
      throw InputError(bag_, "no topic of it has images (sensor_msgs/Image, CompressedImage)",
                       "give the bag of a camera's drive");
    }
    if (given.empty() && fitting.size() > 1) {
      throw InputError(
          bag_, std::to_string(fitting.size()) + " topics have images: " + list_text(fitting),
          "choose with --image-topic");
    }
    const std::string name = given.empty() ? fitting.front().name : given;
    require(name, "--image-topic", kImageTypes);
    return name;
  }

  /// Beside the images, as drivers have it: /cam/image_raw or /cam/image_raw/compressed and
  /// /cam/camera_info; else the only one there is.
  [[nodiscard]] std::string camera_info_of(const std::string& images, ImportReport& report) const {
    const Topics fitting = of_types(topics_, {kRosCameraInfo});
    const std::string folder = images.substr(0, images.rfind('/'));
    for (const std::string& parent : {folder, folder.substr(0, folder.rfind('/'))}) {
      for (const BagTopic& topic : fitting) {
        if (topic.name == parent + "/camera_info") return checked_info(topic);
      }
    }
    if (fitting.size() == 1) {
      report.notes.push_back("the camera of " + images + " is taken to be that of " +
                             fitting.front().name);
      return checked_info(fitting.front());
    }
    throw InputError(bag_,
                     "nothing tells the camera of " + images +
                         (fitting.empty() ? std::string(": it has no CameraInfo")
                                          : ": which of " + list_text(fitting) + "?"),
                     fitting.empty() ? "give it with --calibration FILE[:SECTION]"
                                     : "choose with --camera-info-topic");
  }

  [[nodiscard]] std::string gps(const std::string& given, ImportReport& report) const {
    if (!given.empty()) require(given, "--gps-topic", {kRosNavSatFix});
    const Topics fitting = of_types(topics_, {kRosNavSatFix});
    if (!given.empty() || fitting.empty()) return given;
    if (fitting.size() > 1) {
      report.notes.push_back("GPS is left out: choose among " + list_text(fitting) +
                             " with --gps-topic");
      return "";
    }
    require_definition(fitting.front(), {kRosNavSatFix}, bag_);
    report.notes.push_back("GPS is that of " + fitting.front().name);
    return fitting.front().name;
  }

  /// A sensor that is read only when somebody says that it is what it has to be.
  [[nodiscard]] std::string vouched(const std::string& given, const std::string& flag,
                                    const RosType& type, const std::string& what,
                                    ImportReport& report) const {
    if (!given.empty()) require(given, flag, {type});
    const Topics fitting = of_types(topics_, {type});
    if (given.empty() && !fitting.empty()) {
      report.notes.push_back(list_text(fitting) + " left out: give " + flag + " where " + what);
    }
    return given;
  }

 private:
  [[nodiscard]] std::string checked_info(const BagTopic& topic) const {
    require_definition(topic, {kRosCameraInfo}, bag_);
    return topic.name;
  }

  std::string bag_;
  const Topics& topics_;
};

void require_pair(const RosbagImport& options, const std::string& images) {
  if (options.right_topic == images) {
    throw InputError("--right-topic " + options.right_topic, "are the left images",
                     "give the topic of the right camera");
  }
  if (options.calibration.empty()) return;
  throw InputError("--right-topic " + options.right_topic,
                   "--calibration does not tell how the two cameras are to each other",
                   "leave one of the two out");
}

}  // namespace

std::vector<std::string> BagChoice::names() const {
  std::vector<std::string> all;
  for (const std::string& name : {images, right, camera_info, right_info, gps, imu, wheels}) {
    if (!name.empty()) all.push_back(name);
  }
  return all;
}

bool has_images(const BagTopic& topic) {
  return is_of(topic, kImageTypes);
}

BagChoice choose_topics(const RosbagImport& options, const std::vector<BagTopic>& topics,
                        ImportReport& report) {
  const TopicFinder finder(options, topics);
  BagChoice choice;
  choice.images = finder.images(options.image_topic);
  choice.right = options.right_topic;
  if (!choice.right.empty()) {
    require_pair(options, choice.images);
    finder.require(choice.right, "--right-topic", kImageTypes);
    choice.right_info = finder.camera_info_of(choice.right, report);
  }
  choice.camera_info = options.camera_info_topic;
  if (!choice.camera_info.empty()) {
    finder.require(choice.camera_info, "--camera-info-topic", {kRosCameraInfo});
  }
  if (!options.calibration.empty()) {
    choice.camera_info.clear();
  } else if (choice.camera_info.empty()) {
    choice.camera_info = finder.camera_info_of(choice.images, report);
  }
  choice.gps = finder.gps(options.gps_topic, report);
  choice.imu = finder.vouched(options.imu_topic, "--imu-topic", kRosImu,
                              "its axes are the vehicle's: ahead, left, up", report);
  choice.wheels = finder.vouched(options.wheels_topic, "--wheels-topic", kRosOdometry,
                                 "it counts wheels alone", report);
  return choice;
}

}  // namespace oneac
