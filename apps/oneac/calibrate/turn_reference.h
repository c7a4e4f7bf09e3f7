#pragma once

#include "run/drive_record.h"

#include "oneac/calibration/turn_measurement.h"

#include <string>
#include <vector>

namespace oneac::app {

/// What turns that one sensor of the log saw say of the focal length of a drive.
struct TurnEvidence {
  std::string sensor;  ///< in words
  TurnMeasurement measured;
};

/// The gyroscope's and the GPS course's, as far as the log has them and they tell. Both are
/// compared with the drive between moments at which it goes straight, where a course is the
/// vehicle's heading and a stamp that is late does no harm; stretches that images did not carry are
/// left out.
[[nodiscard]] std::vector<TurnEvidence> turn_evidence(const DriveRecord& drive);

}  // namespace oneac::app
