#include "calibrate/turn_reference.h"

#include "run/vehicle_turns.h"

#include "oneac/calibration/focal_evidence.h"
#include "oneac/calibration/turn_spans.h"

#include <cstddef>

namespace oneac::app {
namespace {

/// The drive between moments at which it goes straight.
std::vector<TurnSpan> spans_of(const DriveRecord& drive, Heading& sensor, TurnSpanCutter cutter) {
  const Trajectory vehicle = drive.vehicle_trajectory();
  for (std::size_t i = 0; i < vehicle.poses.size() && i < drive.frames.size(); ++i) {
    const auto& step = drive.frames[i].step;
    const bool carried = step && step->status != StepStatus::kPredicted;
    cutter.add_frame(vehicle.times[i], turn_about_upright(vehicle, i), carried);
  }
  static_cast<void>(cutter.cut(sensor));
  return cutter.spans();
}

CourseHeading heading_by_course(const std::vector<GpsFix>& fixes) {
  CourseHeading heading;
  for (const GpsFix& fix : fixes) {
    if (fix.course) heading.add(fix.time_s, *fix.course, fix.speed.value_or(0.0));
  }
  return heading;
}

}  // namespace

std::vector<TurnEvidence> turn_evidence(const DriveRecord& drive) {
  const VehicleReference& reference = drive.source.reference;
  std::vector<TurnEvidence> evidence;
  const auto take = [&](const char* name, Heading& sensor, const TurnSpanCutter& cutter,
                        const TurnSensor& errors) {
    const auto measured = measure_focal_by_turns(spans_of(drive, sensor, cutter), errors);
    if (measured) evidence.push_back({name, *measured});
  };
  GyroscopeHeading gyroscope = heading_by_gyroscope(reference.imu);
  CourseHeading course = heading_by_course(reference.gps);
  take("gyroscope", gyroscope.heading(), TurnSpanCutter::for_gyroscope(), usual_gyroscope());
  take("GPS course", course.heading(), TurnSpanCutter::for_course(), usual_course());
  return evidence;
}

}  // namespace oneac::app
