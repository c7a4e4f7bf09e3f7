#include "run_drive.h"

#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"

#include "oneac/base/error.h"
#include "oneac/base/mask.h"
#include "oneac/base/ordered_pipeline.h"
#include "oneac/observations/repeat_watch.h"

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace oneac::app {
namespace {

/// A prepared frame with what the record needs of it.
struct Prepared {
  PreparedFrame frame;
  double decode_ms = 0.0;
  double masked = 0.0;               ///< share of the image that its mask leaves out
  std::vector<SpeedReading> wheels;  ///< known before it
};

SourceOptions source_options(const RunOptions& options) {
  SourceOptions source = options.source.for_log(options.log);
  source.camera_model = options.camera_model;
  source.stereo = options.front_end.scale.source == "stereo";
  return source;
}

/// What GPS and IMU say, read before the images when the front-end is to use it.
VehicleReference read_ahead(const RunOptions& options) {
  const FrontEndOptions& front_end = options.front_end;
  const bool used = front_end.tilt.source == "imu" || front_end.scale.source == "gps" ||
                    front_end.self_calibration.refine != "off";
  if (!used) return {};
  return read_vehicle_reference(options.log);
}

// [s] speeds are handed over so far ahead of the images: the fix behind a moment is known, too.
constexpr double kLookAhead = 1.5;

/// Images that will be processed, by a pass over the log that decodes none; as many as were read
/// where it is damaged or interrupted.
std::size_t count_images(const SourceOptions& options) {
  std::size_t count = 0;
  try {
    RawlogSource source(options);
    for (double last = -std::numeric_limits<double>::infinity(); !interrupted();) {
      const auto ticket = source.next();
      if (!ticket) break;
      if (!(ticket->time_s > last)) continue;
      last = ticket->time_s;
      ++count;
    }
  } catch (const InputError&) {
    return count;  // the run itself says what is wrong
  }
  return count;
}

/// Hands the front-end the speeds of the log, in order.
class SpeedFeeder {
 public:
  explicit SpeedFeeder(const std::vector<SpeedReading>& speeds) : speeds_(speeds) {}
  void feed_until(double time_s, FrontEnd& front_end) {
    for (; next_ < speeds_.size() && speeds_[next_].time_s <= time_s + kLookAhead; ++next_) {
      const SpeedReading& told = speeds_[next_];
      front_end.add_speed(told.time_s, told.speed, told.sigma);
    }
  }

 private:
  const std::vector<SpeedReading>& speeds_;
  std::size_t next_ = 0;
};

/// The loop of a drive: images in order of time, prepared ahead on threads of their own, then
/// processed by this one and its helpers.
class Drive {
 public:
  Drive(const RunOptions& options, const RunObserver& observer)
      : options_(options),
        observer_(observer),
        source_(source_options(options)),
        front_end_(front_end_options(options), options.run.threads),
        sensors_(read_ahead(options)),
        progress_(options.run.progress && !options.run.quiet, "frames"),
        record_(options.output) {
    front_end_.keep_trajectory(false);  // the record has it
    feed_accelerations();
    feed_turns();
    if (progress_.is_shown()) progress_.expect(count_images(source_options(options)));
  }

  DriveRecord run() && {
    const auto next = [this] { return this->next(); };
    const auto prepare = [this](const FrameTicket& ticket) { return this->prepare(ticket); };
    const auto process = [this](Prepared prepared) { return this->process(std::move(prepared)); };
    try {
      ordered_pipeline(next, prepare, process, options_.run.threads);
    } catch (const InputError& error) {
      record_.failure = error.what();
      read_to_the_end();
    }
    finish();
    return std::move(record_);
  }

 private:
  static FrontEndOptions front_end_options(const RunOptions& options) {
    FrontEndOptions front_end = options.front_end;
    front_end.seed = static_cast<std::size_t>(options.run.seed);
    front_end.window.keep_sightings = options.run.global_ba;
    return front_end;
  }

  void feed_accelerations() {
    record_.tilt_source = options_.front_end.tilt.source;
    std::size_t felt = 0;
    for (const ImuSample& sample : sensors_.imu) {
      if (!sample.acceleration) continue;
      ++felt;
      const auto yaw_rate =
          sample.angular_rate ? std::optional(sample.angular_rate->z()) : std::nullopt;
      front_end_.add_acceleration(sample.time_s, *sample.acceleration, yaw_rate);
    }
    if (record_.tilt_source != "imu" || felt > 0) return;
    record_.tilt_source = "log";
    record_.tilt_fallback =
        "front_end.tilt.source is imu, but the log holds no acceleration: the tilt of its sensor "
        "pose is used";
  }

  void feed_turns() {
    for (const ImuSample& sample : sensors_.imu) {
      if (sample.angular_rate) front_end_.add_yaw_rate(sample.time_s, sample.angular_rate->z());
    }
    for (const GpsFix& fix : sensors_.gps) {
      if (!fix.course || !fix.speed) continue;
      front_end_.add_course(fix.time_s, *fix.course, *fix.speed);
    }
  }

  /// Behind an image that stopped the run: how far the threads had read ahead changes no count.
  void read_to_the_end() {
    try {
      while (!source_failed_ && next()) continue;
    } catch (const InputError&) {
      return;  // the first fault is the one to tell
    }
  }

  std::optional<FrameTicket> next_of_source() {
    try {
      return source_.next();
    } catch (const InputError&) {
      source_failed_ = true;
      throw;
    }
  }

  std::optional<FrameTicket> next() {
    while (!interrupted()) {
      auto ticket = next_of_source();
      if (!ticket) return ticket;
      wheels_.insert(wheels_.end(), ticket->wheels.begin(), ticket->wheels.end());
      if (ticket->time_s > last_time_) {
        last_time_ = ticket->time_s;
        ticket->wheels = std::exchange(wheels_, {});
        return ticket;
      }
      ++record_.out_of_order;
    }
    return std::nullopt;
  }

  /// Called by several threads at once.
  [[nodiscard]] Prepared prepare(const FrameTicket& ticket) const {
    CameraFrame frame = source_.load(ticket);
    const bool given = !options_.source.mask_dir.empty();  // else it is undistortion's rim
    const double decode_ms = frame.decode_ms;
    const double masked = given ? share_left_out(frame.mask.view()) : 0.0;
    return Prepared{front_end_.prepare(std::move(frame)), decode_ms, masked, ticket.wheels};
  }

  /// @return whether to go on
  bool process(Prepared prepared) {
    const CameraFrame& frame = prepared.frame.frame;
    feed_wheels(prepared.wheels);
    if (repeats_.repeats(frame.image.view())) {
      if (record_.repeated++ == 0) record_.first_repeated = frame.name;
      return !interrupted();
    }
    const bool is_first = record_.frames.empty();
    if (is_first) remember_mounting(frame);
    speeds_.feed_until(frame.time_s, front_end_);
    record_.masked += prepared.masked;
    const GreyImage image = observer_ ? frame.image : GreyImage{};
    record_.add(front_end_.process(std::move(prepared.frame)), prepared.decode_ms);
    record_.take(front_end_.take_tracks());
    record_.tilt = front_end_.tilt();
    if (is_first) record_.given_tilt = record_.tilt;
    if (observer_) observe(image);
    progress_.update(record_.frames.size());
    return !interrupted();
  }

  void feed_wheels(const std::vector<SpeedReading>& speeds) {
    record_.wheels.insert(record_.wheels.end(), speeds.begin(), speeds.end());
    if (options_.front_end.scale.source != "wheels") return;
    for (const SpeedReading& told : speeds) {
      front_end_.add_speed(told.time_s, told.speed, told.sigma);
    }
  }

  void observe(const GreyImage& image) {
    observer_({image, front_end_.correspondences(), record_, front_end_.newest_keyframe()});
  }

  void remember_mounting(const CameraFrame& first) {
    record_.T_vehicle_cam = first.T_vehicle_cam;
    const ScaleOptions& scale = options_.front_end.scale;
    record_.scale_source = scale.source;
    if (scale.source == "height") record_.common_length_sigma = scale.road_uncertainty;
    if (scale.source == "wheels") record_.common_length_sigma = scale.wheel_uncertainty;
    record_.camera = first.camera;
    record_.raw_camera = first.raw_camera;
  }

  void finish() {
    record_.take(front_end_.finish());
    record_.take(front_end_.take_tracks());
    record_.interrupted = interrupted();
    if (!record_.interrupted) source_.finish();
    record_.source = source_.report();
    const auto& fixes = sensors_.gps.empty() ? record_.source.reference.gps : sensors_.gps;
    if (!fixes.empty()) record_.gps = TimeSpan{fixes.front().time_s, fixes.back().time_s};
    record_.tilt = front_end_.tilt();
    record_.tilt_belief = front_end_.tilt_belief();
    record_.scale_uncertainty = front_end_.scale_uncertainty();
    record_.camera_belief = front_end_.camera_belief();
    record_.camera_height = front_end_.camera_height();
    record_.car_mask = front_end_.car_mask();
    record_.car_mask_refused = front_end_.car_mask_refused();
    record_.setup_faults = front_end_.setup_faults();
    record_.length_doubt = front_end_.length_doubt();
    record_.stamps_are_wrong = front_end_.stamps_are_wrong();
    record_.doubt_metres(record_.length_doubt, options_.front_end.scale.max_uncertainty);
    const std::string& names = record_.source.names_out_of_order;
    if (!names.empty()) record_.setup_faults.push_back(names);
    if (!record_.setup_faults.empty()) record_.withdraw_metres();
  }

  const RunOptions& options_;
  const RunObserver& observer_;
  RawlogSource source_;
  FrontEnd front_end_;
  const VehicleReference sensors_;
  SpeedFeeder speeds_{sensors_.speeds};
  ProgressBar progress_;
  RepeatWatch repeats_;
  std::vector<SpeedReading> wheels_;  ///< that wait for an image in order
  bool source_failed_ = false;
  double last_time_ = -std::numeric_limits<double>::infinity();
  DriveRecord record_;
};

}  // namespace

DriveRecord run_drive(const RunOptions& options, const RunObserver& observer) {
  return Drive(options, observer).run();
}

}  // namespace oneac::app
