#pragma once

#include "oneac/base/image.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/observations/camera_reader.h"
#include "oneac/observations/image_decoding.h"
#include "oneac/observations/pose_watch.h"
#include "oneac/observations/repeat_watch.h"
#include "oneac/observations/sensor_readings.h"
#include "oneac/observations/wheel_readings.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace oneac {

/// Why an observation gave nothing, or an image of the camera no frame.
enum class PassedOver {
  kOtherClass,   ///< neither image nor IMU, GPS or wheels
  kOtherSensor,  ///< of another camera, IMU, GPS receiver or odometer than the one that is followed
  kMissing,      ///< an image without pixels, or whose file is not there
  kOutOfOrder,   ///< an image not later than the one before
  kRepeated,     ///< an image that repeats the one before, pixel by pixel
  kUnstamped,    ///< a reading of IMU, GPS or wheels without time stamp
  kUnusable,     ///< a reading of IMU, GPS or wheels that is void or damaged
  kNotNeeded,    ///< a sound reading that tells nothing of a motion: a first position
};
inline constexpr std::size_t kReasons = 8;
/// "of another sensor": completes "observation passed over: it is …" or "has …".
[[nodiscard]] const char* to_string(PassedOver reason);

/// What became of the observations so far.
struct IntakeCounts {
  std::size_t images = 0;         ///< gave a frame
  std::size_t accelerations = 0;  ///< readings of the IMU taken, with rates alone, too
  std::size_t speeds = 0;         ///< readings of the GPS taken
  std::size_t wheels = 0;         ///< readings of the odometer taken
  std::array<std::size_t, kReasons> passed_over{};

  [[nodiscard]] std::size_t of(PassedOver reason) const {
    return passed_over[static_cast<std::size_t>(reason)];
  }
};

/// A direction of travel that a receiver states.
struct CourseReading {
  double time_s = 0.0;  ///< [s] Unix time
  double course = 0.0;  ///< clockwise from north [rad]
  double speed = 0.0;   ///< over ground [m/s]
};

/// What an observation holds for a front-end: one of them, or speed and course, or a reason for
/// none. Of wheels most readings give nothing yet: they make stretches.
struct Intake {
  std::optional<CameraFrame> frame;
  std::optional<ImuSample> inertial;    ///< has an acceleration or rates
  std::optional<SpeedReading> speed;    ///< by the GPS
  std::optional<CourseReading> course;  ///< by the GPS, where it states its speed
  std::optional<SpeedReading> wheels;   ///< by the odometer, of a stretch that is over
  std::optional<PassedOver> passed_over;
};

/// What is not used of an image, dark (below 128); each of the size of the pixels as the
/// observation has them, or empty: all is used.
struct ImageMasks {
  ImageView image;  ///< of the camera that is followed
  ImageView right;  ///< of the right image of a pair
};

/// What to take in.
struct IntakeOptions {
  std::string camera;  ///< as of CameraView::matches(); empty: that of the first image
  CameraReaderOptions reader;
};

/// Observations as they come, one by one: the live counterpart of RawlogSource, with the same
/// CameraReader, readings and refusals.
///
/// One camera, one IMU, one GPS receiver and one odometer are followed: of each the first that can
/// be used, the camera by its label where one is asked for; of a stereo observation the left one.
/// What cannot be used of IMU, GPS and wheels is passed over and counted; an image of the camera
/// that exists and cannot be used is refused by an exception. It counts as an image of the camera
/// in `index` and changes nothing else, so that feeding may go on.
class ObservationIntake {
 public:
  explicit ObservationIntake(IntakeOptions options);

  /// @param masks  of an image of the camera; not looked at otherwise
  /// @throws InputError in the words of RawlogSource: what CameraReader refuses, a damaged pose, an
  ///         image that cannot be decoded; std::invalid_argument for a mask of another size
  [[nodiscard]] Intake take(const mrpt::obs::CObservation& observation,
                            const ImageMasks& masks = {});
  [[nodiscard]] const IntakeCounts& counts() const { return counts_; }
  /// As of CameraReader; "" before the first frame.
  [[nodiscard]] std::string scaling_note() const;

 private:
  [[nodiscard]] Intake take_inertial(const mrpt::obs::CObservation& observation);
  [[nodiscard]] Intake take_speed(const mrpt::obs::CObservation& observation);
  [[nodiscard]] Intake take_wheels(const mrpt::obs::CObservation& observation);
  /// The image of the camera, and of a pair that is wanted its right one.
  struct Sight {
    const CameraView* view = nullptr;
    const CameraView* right = nullptr;  ///< null: none
    ImageMasks masks;
  };
  [[nodiscard]] Intake take_image(const mrpt::obs::CObservation& observation,
                                  const ImageMasks& masks);
  [[nodiscard]] Intake read(const Sight& sight, const mrpt::obs::CObservation& observation);
  void add_pixels(const Sight& sight, const std::string& where, CameraFrame& frame);
  [[nodiscard]] bool is_followed(const CameraView& view) const;
  [[nodiscard]] Intake pass(PassedOver reason);

  IntakeOptions options_;
  std::optional<CameraReader> reader_;
  PoseWatch poses_;
  RepeatWatch repeats_;
  GreyRange grey_range_;
  std::string camera_;  ///< CameraView::name() of the one that is followed
  std::optional<std::string> imu_, gps_;
  SpeedOverGround speeds_;
  WheelFollower wheels_;
  std::size_t seen_ = 0;                                         ///< images of the camera
  double last_time_ = -std::numeric_limits<double>::infinity();  ///< [s] of the last frame
  IntakeCounts counts_;
};

}  // namespace oneac
