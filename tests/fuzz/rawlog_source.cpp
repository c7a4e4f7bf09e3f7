// A rawlog, plain or compressed: read by `info` and, camera by camera, by `run`.
#include "oneac/rawlog/rawlog_source.h"

#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/rawlog/log_summary.h"

namespace {

using namespace oneac;

void read_camera(const SourceOptions& options) {
  try {
    RawlogSource source(options);
    while (const auto ticket = source.next()) {
      const CameraFrame frame = source.load(*ticket);
      fuzz::check(!frame.image.empty(), "a loaded image has pixels");
      fuzz::check(frame.T_vehicle_cam.matrix().allFinite(), "the mount is finite");
    }
    source.finish();
    for (const GpsFix& fix : source.report().reference.gps) {
      fuzz::check(!fix.position_enu || fix.position_enu->allFinite(), "positions are finite");
    }
  } catch (const InputError&) {  // what it may throw
  }
}

}  // namespace

ONEAC_FUZZ_TARGET(rawlog_source) {
  SummaryOptions summary_options;
  summary_options.log = fuzz::file_with(data);
  summary_options.images_dir = "/dev";  // no file in it is a regular one
  SourceOptions options;
  options.log = summary_options.log;
  options.images_dir = summary_options.images_dir;
  try {
    const LogSummary summary = summarise_log(summary_options);
    static_cast<void>(to_text(summary));
    for (const CameraSummary& camera : summary.cameras) {
      options.camera = camera.name;
      read_camera(options);
    }
  } catch (const InputError&) {  // what it may throw
  }
}
