#pragma once

#include "oneac/geometry/camera.h"

#include <functional>
#include <string>
#include <vector>

namespace oneac {

/// A camera that a calibration file describes, read when it is chosen: what is wrong with the
/// others does not matter.
struct CalibrationEntry {
  std::string section;  ///< its name after "FILE:"
  bool offered = true;  ///< may be chosen without being named
  std::function<PinholeCamera()> read;
};

using CalibrationEntries = std::vector<CalibrationEntry>;

}  // namespace oneac
