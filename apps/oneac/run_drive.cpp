#include "run_drive.h"

#include "interrupt.h"
#include "progress_bar.h"

#include "oneac/base/error.h"
#include "oneac/base/ordered_pipeline.h"

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
};

SourceOptions source_options(const RunOptions& options) {
  SourceOptions source = options.source.for_log(options.log);
  source.stereo = options.front_end.scale.source == "stereo";
  return source;
}

/// What GPS and IMU say, read before the images when the front-end is to use it.
VehicleReference read_ahead(const RunOptions& options) {
  if (options.front_end.tilt.source != "imu" && options.front_end.scale.source != "gps") return {};
  return read_vehicle_reference(options.log);
}

// [s] speeds are handed over so far ahead of the images: the fix behind a moment is known, too.
constexpr double kLookAhead = 1.5;

/// Hands the front-end the speeds of the log, in order.
class SpeedFeeder {
 public:
  explicit SpeedFeeder(const std::vector<GpsFix>& fixes) : fixes_(fixes) {}
  void feed_until(double time_s, FrontEnd& front_end) {
    for (; next_ < fixes_.size() && fixes_[next_].time_s <= time_s + kLookAhead; ++next_) {
      const GpsFix& fix = fixes_[next_];
      if (fix.speed) front_end.add_speed(fix.time_s, *fix.speed);
    }
  }

 private:
  const std::vector<GpsFix>& fixes_;
  std::size_t next_ = 0;
};

CameraFrame without_image(const CameraFrame& frame) {
  CameraFrame copy;
  copy.T_vehicle_cam = frame.T_vehicle_cam;
  copy.camera = frame.camera;
  return copy;
}

void remember_first(const CameraFrame& frame, const FrontEnd& front_end, DriveRecord& record) {
  record.T_vehicle_cam = frame.T_vehicle_cam;
  record.camera = frame.camera;
  record.given_tilt = front_end.tilt();
}

}  // namespace

DriveRecord run_drive(const RunOptions& options, const RunObserver& observer) {
  RawlogSource source(source_options(options));
  FrontEndOptions front_end_options = options.front_end;
  front_end_options.seed = static_cast<std::size_t>(options.run.seed);
  FrontEnd front_end(front_end_options);
  const VehicleReference sensors = read_ahead(options);
  for (const ImuSample& sample : sensors.imu) {
    if (!sample.acceleration) continue;
    const auto yaw_rate =
        sample.angular_rate ? std::optional(sample.angular_rate->z()) : std::nullopt;
    front_end.add_acceleration(sample.time_s, *sample.acceleration, yaw_rate);
  }
  SpeedFeeder speeds(sensors.gps);
  DriveRecord record;
  {
    ProgressBar progress(options.run.progress && !options.run.quiet);
    double last_time = -std::numeric_limits<double>::infinity();
    const auto next = [&]() -> std::optional<FrameTicket> {
      while (!interrupted()) {
        auto ticket = source.next();
        if (!ticket || ticket->time_s > last_time) {
          if (ticket) last_time = ticket->time_s;
          return ticket;
        }
        ++record.out_of_order;
      }
      return std::nullopt;
    };
    const auto prepare = [&](const FrameTicket& ticket) {
      CameraFrame frame = source.load(ticket);
      const double decode_ms = frame.decode_ms;
      return Prepared{front_end.prepare(std::move(frame)), decode_ms};
    };
    const auto process = [&](Prepared prepared) {
      const CameraFrame first =
          record.frames.empty() ? without_image(prepared.frame.frame) : CameraFrame{};
      speeds.feed_until(prepared.frame.frame.time_s, front_end);
      const GreyImage image = observer ? prepared.frame.frame.image : GreyImage{};
      FrameResult result = front_end.process(std::move(prepared.frame));
      Settled settled = std::exchange(result.settled, {});
      record.frames.push_back(std::move(result));
      record.take(std::move(settled));
      record.decode_ms.push_back(prepared.decode_ms);
      if (record.frames.size() == 1) remember_first(first, front_end, record);
      record.tilt = front_end.tilt();
      if (observer) observer({image, front_end.correspondences(), record});
      progress.update(source.progress(), record.frames.size());
      return !interrupted();
    };
    try {
      ordered_pipeline(next, prepare, process, options.run.threads);
    } catch (const InputError& error) {
      record.failure = error.what();
    }
  }
  record.take(front_end.finish());
  record.interrupted = interrupted();
  if (!record.interrupted) source.finish();
  record.source = source.report();
  record.tilt = front_end.tilt();
  record.tilt_belief = front_end.tilt_belief();
  record.scale_uncertainty = front_end.scale_uncertainty();
  record.camera_height = front_end.camera_height();
  return record;
}

}  // namespace oneac::app
