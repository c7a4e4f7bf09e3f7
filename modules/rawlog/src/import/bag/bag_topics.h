#pragma once

#include "oneac/rawlog/import_rosbag.h"

#include <string>
#include <vector>

namespace oneac {

/// Which topic of a bag is what; "" for what is not read.
struct BagChoice {
  std::string images, right, camera_info, right_info, gps, imu, wheels;

  [[nodiscard]] std::vector<std::string> names() const;
};

/// What --*-topic say, and where they say nothing the only one there is. Notes tell what was taken
/// or left out.
/// @throws InputError for a topic that is not there, of another type or without messages; where
///         several hold images; where nothing tells the camera
[[nodiscard]] BagChoice choose_topics(const RosbagImport& options,
                                      const std::vector<BagTopic>& topics, ImportReport& report);

}  // namespace oneac
