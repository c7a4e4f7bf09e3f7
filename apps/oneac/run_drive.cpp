#include "run_drive.h"

#include "interrupt.h"
#include "progress_bar.h"

#include "oneac/base/error.h"
#include "oneac/base/ordered_pipeline.h"

#include <limits>
#include <utility>

namespace oneac::app {
namespace {

/// A prepared frame with what the record needs of it.
struct Prepared {
  PreparedFrame frame;
  double decode_ms = 0.0;
};

void remember_first(const CameraFrame& frame, const FrontEnd& front_end, DriveRecord& record) {
  record.T_vehicle_cam = frame.T_vehicle_cam;
  record.camera = frame.camera;
  record.given_tilt = front_end.tilt();
}

}  // namespace

DriveRecord run_drive(const RunOptions& options) {
  RawlogSource source(options.source.for_log(options.log));
  FrontEnd front_end(options.front_end);
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
      const CameraFrame first = record.frames.empty() ? prepared.frame.frame : CameraFrame{};
      record.frames.push_back(front_end.process(std::move(prepared.frame)));
      record.decode_ms.push_back(prepared.decode_ms);
      if (record.frames.size() == 1) remember_first(first, front_end, record);
      progress.update(source.progress(), record.frames.size());
      return !interrupted();
    };
    try {
      ordered_pipeline(next, prepare, process, options.run.threads);
    } catch (const InputError& error) {
      record.failure = error.what();
    }
  }
  record.interrupted = interrupted();
  if (!record.interrupted) source.finish();
  record.source = source.report();
  record.tilt = front_end.tilt();
  record.camera_height = front_end.camera_height();
  return record;
}

}  // namespace oneac::app
