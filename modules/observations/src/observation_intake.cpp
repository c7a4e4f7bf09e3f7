#include "oneac/observations/observation_intake.h"

#include "pixels.h"

#include "oneac/base/error.h"
#include "oneac/base/mask.h"
#include "oneac/base/thread_clock.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace oneac {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;

bool is_stamped(const CObservation& observation) {
  return observation.timestamp != INVALID_TIMESTAMP;
}

/// Whether the label is the one that is followed, or none is yet.
bool follows(const std::optional<std::string>& followed, const std::string& label) {
  return !followed || *followed == label;
}

void require_sound_pose(const CameraView& view, const std::string& where) {
  if (view.has_sound_pose()) return;
  throw InputError(where, damaged_pose(view), "correct it where the observation is made");
}

/// @throws std::invalid_argument when the mask is not of the image's size, or of other values
void require_mask(const ImageView& mask, const GreyImage& image, const std::string& name) {
  const bool same = mask.width == image.width() && mask.height == image.height();
  if (const std::string fault = fault_of_mask(mask); !fault.empty()) {
    throw std::invalid_argument(name + ": " + fault + ": " + kMaskCure);
  }
  if (mask.empty() || same) return;
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw std::invalid_argument("the mask of " + name + " has " + size(mask.width, mask.height) +
                              " pixels, must be " + size(image.width(), image.height()));
}

std::string short_name(const CameraView& view, const std::string& where) {
  if (!view.pixels->isExternallyStored()) return where;
  return std::filesystem::path(name_of(*view.pixels, where)).filename().string();
}

}  // namespace

const char* to_string(PassedOver reason) {
  switch (reason) {
    case PassedOver::kOtherClass:
      return "neither an image nor a reading of IMU, GPS or wheels";
    case PassedOver::kOtherSensor:
      return "of another camera, IMU, GPS receiver or odometer than the one in use";
    case PassedOver::kMissing:
      return "an image that is not there";
    case PassedOver::kOutOfOrder:
      return "an image not later than the one before";
    case PassedOver::kRepeated:
      return "an image that repeats the one before";
    case PassedOver::kUnstamped:
      return "a reading without time stamp";
    case PassedOver::kUnusable:
      return "a reading that is void or damaged";
    case PassedOver::kNotNeeded:
      return "a reading without acceleration or speed";
  }
  return "unknown";
}

ObservationIntake::ObservationIntake(IntakeOptions options) : options_(std::move(options)) {}

Intake ObservationIntake::take(const CObservation& observation, const ImageMasks& masks) {
  if (dynamic_cast<const CObservationIMU*>(&observation) != nullptr) {
    return take_inertial(observation);
  }
  if (dynamic_cast<const CObservationGPS*>(&observation) != nullptr) {
    return take_speed(observation);
  }
  if (dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation) != nullptr) {
    return take_wheels(observation);
  }
  return take_image(observation, masks);
}

std::string ObservationIntake::scaling_note() const {
  return reader_ ? reader_->scaling_note() : "";
}

Intake ObservationIntake::pass(PassedOver reason) {
  ++counts_.passed_over[static_cast<std::size_t>(reason)];
  Intake nothing;
  nothing.passed_over = reason;
  return nothing;
}

Intake ObservationIntake::take_inertial(const CObservation& observation) {
  if (!is_stamped(observation)) return pass(PassedOver::kUnstamped);
  if (!follows(imu_, observation.sensorLabel)) return pass(PassedOver::kOtherSensor);
  Intake intake;
  intake.inertial = imu_sample(observation);
  if (!intake.inertial) return pass(PassedOver::kUnusable);
  // A lone gyroscope serves until an IMU that feels gravity comes.
  if (intake.inertial->acceleration) imu_ = observation.sensorLabel;
  ++counts_.accelerations;
  return intake;
}

// A first position has no use alone; it may begin the epoch of the speed that follows.
Intake ObservationIntake::take_speed(const CObservation& observation) {
  if (!is_stamped(observation)) return pass(PassedOver::kUnstamped);
  if (!follows(gps_, observation.sensorLabel)) return pass(PassedOver::kOtherSensor);
  const auto reading = gps_reading(observation);
  if (!reading) return pass(PassedOver::kUnusable);
  gps_ = observation.sensorLabel;
  Intake intake;
  intake.speed = speeds_.add(*reading);
  if (reading->course && reading->speed) {
    intake.course = CourseReading{reading->time_s, *reading->course, *reading->speed};
  }
  if (!intake.speed) return pass(PassedOver::kNotNeeded);
  ++counts_.speeds;
  return intake;
}

Intake ObservationIntake::take_wheels(const CObservation& observation) {
  if (!is_stamped(observation)) return pass(PassedOver::kUnstamped);
  const WheelFollower::Taken taken = wheels_.take(observation);
  if (taken.use == WheelFollower::Use::kOtherSensor) return pass(PassedOver::kOtherSensor);
  if (taken.use == WheelFollower::Use::kUnusable) return pass(PassedOver::kUnusable);
  ++counts_.wheels;
  Intake intake;
  intake.wheels = taken.speed;
  return intake;
}

bool ObservationIntake::is_followed(const CameraView& view) const {
  if (reader_) return view.name() == camera_;
  // Of a pair the left one, unless the right one is asked for.
  const bool any = options_.camera.empty() && view.side != CameraView::Side::right;
  return any || (!options_.camera.empty() && view.matches(options_.camera));
}

Intake ObservationIntake::take_image(const CObservation& observation, const ImageMasks& masks) {
  const auto views = camera_views(observation);
  if (views.empty()) return pass(PassedOver::kOtherClass);
  const auto view = std::find_if(views.begin(), views.end(),
                                 [this](const CameraView& v) { return is_followed(v); });
  if (view == views.end()) return pass(PassedOver::kOtherSensor);
  const auto right = std::find_if(
      view + 1, views.end(), [](const CameraView& v) { return v.side == CameraView::Side::right; });
  const bool wanted = options_.reader.stereo && right != views.end();
  return read({&*view, wanted ? &*right : nullptr, masks}, observation);
}

// The checks stand in the order in which RawlogSource makes them.
Intake ObservationIntake::read(const Sight& sight, const CObservation& observation) {
  const CameraView& view = *sight.view;
  const CameraView* right = sight.right;
  CameraFrame frame;
  frame.index = seen_++;
  const std::string where = "camera '" + view.name() + "': image " + std::to_string(frame.index);
  require_sound_pose(view, where);
  if (right != nullptr) require_sound_pose(*right, where);
  if (!reader_) {
    reader_.emplace(CameraDescription::of(view), options_.reader, where);
    camera_ = view.name();
  }
  reader_->check_calibration(view, where);
  poses_.check(view, where);
  if (!is_there(*view.pixels)) return pass(PassedOver::kMissing);
  const double baseline = right != nullptr ? reader_->baseline(*right, where) : 0.0;
  frame.time_s = CameraReader::time_of(observation.timestamp, where);
  if (!(frame.time_s > last_time_)) return pass(PassedOver::kOutOfOrder);
  frame.T_vehicle_cam = reader_->mount(view);
  if (right != nullptr && is_there(*right->pixels)) frame.baseline_m = baseline;
  frame.name = short_name(view, where);
  add_pixels(sight, where, frame);
  if (repeats_.repeats(frame.image.view())) return pass(PassedOver::kRepeated);
  last_time_ = frame.time_s;
  ++counts_.images;
  Intake intake;
  intake.frame = std::move(frame);
  return intake;
}

void ObservationIntake::add_pixels(const Sight& sight, const std::string& where,
                                   CameraFrame& frame) {
  const StageTimer timer(frame.decode_ms);
  const auto rectified = [this](const CameraView& of, const std::string& its,
                                const ImageView& its_mask, GreyImage& mask) {
    GreyImage stored = grey_of(*of.pixels, its, grey_range_);
    const std::string name = name_of(*of.pixels, its);
    require_mask(its_mask, stored, name);
    GreyImage image = reader_->rectify(std::move(stored), name);
    mask = reader_->unused(image, GreyImage(its_mask), "the mask of " + name);
    return image;
  };
  frame.image = rectified(*sight.view, where, sight.masks.image, frame.mask);
  if (frame.baseline_m > 0.0) {
    frame.right = rectified(*sight.right, where + " (right)", sight.masks.right, frame.right_mask);
  }
  frame.camera = reader_->rectified_camera(frame.image);
  frame.raw_camera = reader_->raw_camera(frame.image);
}

}  // namespace oneac
