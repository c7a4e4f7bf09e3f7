#include "oneac/rawlog/import_rosbag.h"

#include "import/bag/bag_drive.h"
#include "import/bag/bag_reader.h"
#include "import/bag/bag_topics.h"
#include "import/image_drive.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"

#include <algorithm>
#include <optional>

namespace oneac {
namespace {

/// @return where the bag is damaged or a message is none: everything before it was taken
std::optional<InputError> read_messages(const RosbagImport& options, const BagChoice& choice,
                                        BagDrive& drive) {
  try {
    BagReader reader(options.source, choice.names());
    for (BagMessage message; reader.next(message);) {
      drive.take(reader.topics()[message.topic], message);
    }
    return std::nullopt;
  } catch (const InputError& fault) {
    return fault;
  }
}

}  // namespace

std::vector<BagTopic> topics_of_bag(const std::filesystem::path& bag) {
  std::vector<BagTopic> topics = BagReader(bag, {}).topics();
  std::sort(topics.begin(), topics.end(),
            [](const BagTopic& a, const BagTopic& b) { return a.name < b.name; });
  return topics;
}

ImportReport import_rosbag(const RosbagImport& options) {
  ImportReport report;
  report.log = options.log;
  const BagChoice choice = choose_topics(options, topics_of_bag(options.source), report);
  if (options.fps) static_cast<void>(stamps_of_fps(*options.fps, 0));  // a bad rate is refused
  const Eigen::Isometry3d T_vehicle_cam =
      mount_at(options.mount, height_above_road(options, report));
  require_writable_folder(options.log.has_parent_path() ? options.log.parent_path() : ".");
  BagDrive bag(options, choice);
  const std::optional<InputError> fault = read_messages(options, choice, bag);
  if (fault && !bag.is_complete()) throw *fault;
  ImageDrive drive = bag.drive(report);
  drive.T_vehicle_cam = T_vehicle_cam;
  drive.convention = options.convention;
  write_drive(drive, options.log, false, report);
  if (!fault) return report;
  throw InputError(options.log.string(),
                   "holds the " + std::to_string(drive.images.size()) +
                       " images before a fault: " + fault->what(),
                   "");
}

}  // namespace oneac
