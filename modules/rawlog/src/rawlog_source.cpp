#include "oneac/rawlog/rawlog_source.h"

#include "camera_selection.h"
#include "external_images.h"
#include "image_decoding.h"
#include "log_reader.h"
#include "reference_collector.h"
#include "undistortion.h"

#include "oneac/base/error.h"
#include "oneac/base/thread_clock.h"
#include "oneac/mrpt_compat/observations.h"
#include "oneac/rawlog/calibration.h"
#include "oneac/rawlog/sensor_mount.h"

#include <utility>

namespace oneac {
namespace {

constexpr double kReferenceTail = 2.0;  // [s] read past the last image: two epochs of a 1 Hz GPS

/// What a ticket carries: the file of an external image, or the pixels of a stored one.
struct Payload {
  std::filesystem::path file;
  mrpt::img::CImage pixels;
  Eigen::Isometry3d T_vehicle_cam;
};

// Reads the beginning of the log until the camera is clear.
CameraCandidate probe(const SourceOptions& options, ExternalImages& images) {
  LogReader reader(options.log);
  CameraProbe probe(options.camera, images);
  while (!probe.decided()) {
    const auto record = reader.next();
    if (!record) break;
    probe.add(*record);
  }
  if (!probe.has_images() && reader.damage()) throw InputError(*reader.damage());
  return probe.choice(options.log);
}

}  // namespace

void SourceOptions::validate() const {
  if (every < 1) throw InputError("--every 0", "it must be at least 1", "use 1 for every image");
  static_cast<void>(mount_from_sensor_pose(Eigen::Isometry3d::Identity(), mount_convention));
}

class RawlogSource::Impl {
 public:
  explicit Impl(const SourceOptions& options);

  std::optional<FrameTicket> next();
  [[nodiscard]] CameraFrame load(const FrameTicket& ticket) const;
  void finish();
  [[nodiscard]] const SourceReport& report() const { return report_; }
  [[nodiscard]] double progress() const { return reader_.progress(); }

 private:
  [[nodiscard]] PinholeCamera calibration() const;
  [[nodiscard]] std::optional<CameraView> take(const LogRecord& record);
  [[nodiscard]] bool is_selected(std::size_t index) const;
  [[nodiscard]] std::optional<FrameTicket> ticket_of(const CameraView& view,
                                                     const LogRecord& record);
  [[nodiscard]] std::string where(std::size_t record) const;
  void check_calibration(const CameraView& view, std::size_t record) const;
  void complete_report();

  SourceOptions options_;
  ExternalImages images_;
  CameraCandidate chosen_;
  MountConvention convention_;
  PinholeCamera calibration_;
  bool rectified_;  ///< the images are, by the calibration in use
  Undistorter undistorter_;
  LogReader reader_;
  ReferenceCollector collector_;
  SourceReport report_;
  std::size_t delivered_ = 0;
  std::optional<double> last_time_;
};

RawlogSource::Impl::Impl(const SourceOptions& options)
    : options_((options.validate(), options)),
      images_(options.log, options.images_dir),
      chosen_(probe(options, images_)),
      convention_(
          mount_from_sensor_pose(chosen_.T_vehicle_sensor, options.mount_convention).convention),
      calibration_(calibration()),
      rectified_(!calibration_.is_distorted()),
      undistorter_(calibration_),
      reader_(options.log) {}

PinholeCamera RawlogSource::Impl::calibration() const {
  if (!options_.calibration.empty()) {
    return load_calibration(options_.calibration, chosen_.side_name);
  }
  return to_pinhole(chosen_.calibration,
                    where(chosen_.first_record) + ": camera '" + chosen_.name + "'");
}

std::string RawlogSource::Impl::where(std::size_t record) const {
  return options_.log.string() + ": record " + std::to_string(record);
}

// Books the record; its view by the chosen camera, if it has one.
std::optional<CameraView> RawlogSource::Impl::take(const LogRecord& record) {
  collector_.add(*record.observation);
  for (auto& view : camera_views(*record.observation)) {
    if (view.name() != chosen_.name) continue;
    ++report_.images_in_log;
    return view;
  }
  return std::nullopt;
}

bool RawlogSource::Impl::is_selected(std::size_t index) const {
  return index >= options_.first && (index - options_.first) % options_.every == 0;
}

std::optional<FrameTicket> RawlogSource::Impl::next() {
  if (options_.count != 0 && delivered_ == options_.count) return std::nullopt;
  while (const auto record = reader_.next()) {
    const auto view = take(*record);
    if (!view || !is_selected(report_.images_in_log - 1)) continue;
    auto ticket = ticket_of(*view, *record);
    if (!ticket) continue;
    ++delivered_;
    last_time_ = ticket->time_s;
    return ticket;
  }
  complete_report();
  return std::nullopt;
}

std::optional<FrameTicket> RawlogSource::Impl::ticket_of(const CameraView& view,
                                                         const LogRecord& record) {
  check_calibration(view, record.number);
  FrameTicket ticket;
  ticket.index = report_.images_in_log - 1;
  ticket.name = "record " + std::to_string(record.number);
  auto payload = std::make_shared<Payload>();
  bool present = false;
  if (view.image->isExternallyStored()) {
    const std::string stored_name = view.image->getExternalStorageFile();
    ticket.name = std::filesystem::path(stored_name).filename().string();
    const auto file = images_.find(stored_name);
    present = file.has_value();
    payload->file = file.value_or(std::filesystem::path());
  } else {
    present = !view.image->isEmpty();
    if (present) payload->pixels = view.image->makeShallowCopy();
  }
  if (!present) {
    if (report_.images_missing++ == 0) report_.first_missing = ticket.name;
    return std::nullopt;
  }
  if (record.observation->timestamp == INVALID_TIMESTAMP) {
    throw InputError(where(record.number), "the image has no time stamp",
                     "restamp the log with rawlog-edit");
  }
  ticket.time_s = compat::unix_seconds(record.observation->timestamp);
  const auto mount = mount_from_sensor_pose(view.T_vehicle_sensor, to_string(convention_));
  payload->T_vehicle_cam = mount.T_vehicle_cam * view.offset_in_pair(rectified_);
  ticket.payload = std::move(payload);
  return ticket;
}

// One map for all images holds only while the calibration stays the same.
void RawlogSource::Impl::check_calibration(const CameraView& view, std::size_t record) const {
  if (!options_.calibration.empty() || *view.calibration == chosen_.calibration) return;
  throw InputError(where(record), "the calibration of camera '" + chosen_.name + "' changes here",
                   "cut the log there, or give one with --calibration FILE[:SECTION]");
}

CameraFrame RawlogSource::Impl::load(const FrameTicket& ticket) const {
  const auto& payload = *static_cast<const Payload*>(ticket.payload.get());
  CameraFrame frame;
  {
    const StageTimer timer(frame.decode_ms);
    const bool external = !payload.file.empty();
    const std::string name =
        external ? payload.file.string() : options_.log.string() + ": " + ticket.name;
    const cv::Mat grey = external ? decode_grey_file(payload.file)
                                  : to_grey(compat::pixels_of(payload.pixels), name);
    frame.image = undistorter_.rectify(grey, name);
  }
  frame.index = ticket.index;
  frame.time_s = ticket.time_s;
  frame.name = ticket.name;
  frame.camera = undistorter_.rectified_camera(frame.image);
  frame.T_vehicle_cam = payload.T_vehicle_cam;
  return frame;
}

void RawlogSource::Impl::finish() {
  while (last_time_) {
    const auto record = reader_.next();
    if (!record) break;
    static_cast<void>(take(*record));
    const auto time = record->observation->timestamp;
    if (time != INVALID_TIMESTAMP && compat::unix_seconds(time) > *last_time_ + kReferenceTail)
      break;
  }
  complete_report();
}

void RawlogSource::Impl::complete_report() {
  if (reader_.damage()) report_.damage = reader_.damage()->what();
  report_.reference = collector_.build();
}

RawlogSource::RawlogSource(const SourceOptions& options) : impl_(std::make_unique<Impl>(options)) {}
RawlogSource::~RawlogSource() = default;
RawlogSource::RawlogSource(RawlogSource&&) noexcept = default;
RawlogSource& RawlogSource::operator=(RawlogSource&&) noexcept = default;

std::optional<FrameTicket> RawlogSource::next() {
  return impl_->next();
}
CameraFrame RawlogSource::load(const FrameTicket& ticket) const {
  return impl_->load(ticket);
}
void RawlogSource::finish() {
  impl_->finish();
}
const SourceReport& RawlogSource::report() const {
  return impl_->report();
}
double RawlogSource::progress() const {
  return impl_->progress();
}

}  // namespace oneac
