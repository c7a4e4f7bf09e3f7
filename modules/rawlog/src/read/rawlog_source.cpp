#include "oneac/rawlog/rawlog_source.h"

#include "images/external_images.h"
#include "images/mask_folder.h"
#include "images/stored_image.h"
#include "read/camera_selection.h"
#include "read/log_reader.h"
#include "read/name_order.h"
#include "read/reference_collector.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/base/thread_clock.h"
#include "oneac/mrpt_compat/observations.h"
#include "oneac/observations/camera_reader.h"
#include "oneac/observations/pose_watch.h"
#include "oneac/observations/wheel_readings.h"
#include "oneac/rawlog/calibration.h"

#include <utility>

namespace oneac {
namespace {

constexpr double kReferenceTail = 2.0;  // [s] read past the last image: two epochs of a 1 Hz GPS

/// What a ticket carries.
struct Payload {
  StoredImage image;
  std::optional<StoredImage> right;
  std::filesystem::path mask, right_mask;  ///< empty: none
  double baseline_m = 0.0;
  Eigen::Isometry3d T_vehicle_cam;
};

/// The image of the camera and, of a pair, that of its right half.
struct Sight {
  LogView view;
  std::optional<LogView> right;
};

/// The name of an image's file; "" for one in the log.
std::string file_of(const LogView& view) {
  const bool in_file = view.image->kind == LogImage::Kind::external;
  return in_file ? std::filesystem::path(view.image->file).filename().string() : "";
}

}  // namespace

void SourceOptions::validate() const {
  if (every < 1) throw InputError("--every 0", "it must be at least 1", "use 1 for every image");
  const bool chosen = undistorted_fov_deg == 0.0;
  if (!chosen && !(undistorted_fov_deg >= 10.0 && undistorted_fov_deg <= 150.0)) {
    throw InputError("--undistorted-fov " + exact_text(undistorted_fov_deg),
                     "no pinhole image of a road has this field of view",
                     "give degrees across the image, from 10 to 150, or 0 to keep the road");
  }
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
  [[nodiscard]] CameraReaderOptions reader_options() const;
  [[nodiscard]] std::optional<Sight> take(const RawlogRecord& record);
  void take_wheels(const mrpt::obs::CObservation& observation);
  [[nodiscard]] bool is_selected(std::size_t index) const;
  [[nodiscard]] std::optional<FrameTicket> ticket_of(const Sight& sight,
                                                     const RawlogRecord& record);
  void settle_by(const StoredImage& first, const std::string& ticket_name);
  void add_right(const LogView& right, std::size_t record, Payload& payload);
  /// The image, and its mask where it has one.
  struct Picture {
    GreyImage image, mask;
  };
  [[nodiscard]] Picture decoded(const StoredImage& image, const std::filesystem::path& mask,
                                const std::string& ticket_name) const;
  [[nodiscard]] std::string in_log(const std::string& ticket_name) const;
  [[nodiscard]] std::string where(std::size_t record) const;
  void complete_report();

  SourceOptions options_;
  ExternalImages images_;
  std::optional<MaskFolder> masks_;
  CameraCandidate chosen_;
  CameraReader camera_;
  LogReader reader_;
  ReferenceCollector collector_;
  NameOrder names_;
  PoseWatch poses_;
  WheelFollower wheels_;
  std::vector<SpeedReading> wheel_speeds_;  ///< that no ticket has taken along yet
  SourceReport report_;
  std::size_t delivered_ = 0;
  std::optional<double> last_time_;
  GreyRange grey_range_;
  bool settled_ = false;  ///< what the first image decides on
};

RawlogSource::Impl::Impl(const SourceOptions& options)
    : options_((options.validate(), options)),
      images_(options.log, options.images_dir),
      chosen_(choose_camera(options.log, options.camera, images_)),
      camera_(chosen_, reader_options(), where(chosen_.first_record)),
      reader_(options.log) {
  if (!options_.mask_dir.empty()) masks_.emplace(options_.mask_dir);
  report_.undistorted_by_log = camera_.undistorts() && options_.calibration.empty();
}

CameraReaderOptions RawlogSource::Impl::reader_options() const {
  CameraReaderOptions options;
  options.mount_convention = options_.mount_convention;
  options.stereo = options_.stereo;
  options.mount = options_.mount;
  options.undistorted_fov_deg = options_.undistorted_fov_deg;
  if (options_.camera_model) {
    options.calibration = options_.camera_model;
  } else if (!options_.calibration.empty()) {
    options.calibration = load_calibration(options_.calibration, chosen_.side_name);
  }
  return options;
}

std::string RawlogSource::Impl::in_log(const std::string& ticket_name) const {
  return options_.log.string() + ": " + ticket_name;
}

std::string RawlogSource::Impl::where(std::size_t record) const {
  return options_.log.string() + ": record " + std::to_string(record);
}

// Books the record; its view by the chosen camera, if it has one.
std::optional<Sight> RawlogSource::Impl::take(const RawlogRecord& record) {
  collector_.add(*record.observation);
  take_wheels(*record.observation);
  std::optional<Sight> sight;
  for (auto& view : log_views(record)) {
    if (view.name() == chosen_.name) {
      ++report_.images_in_log;
      sight.emplace(Sight{view, std::nullopt});
    } else if (sight && options_.stereo && view.side == CameraView::Side::right) {
      sight->right = view;  // it comes behind the left one
    }
  }
  return sight;
}

void RawlogSource::Impl::take_wheels(const mrpt::obs::CObservation& observation) {
  const WheelFollower::Taken taken = wheels_.take(observation);
  if (taken.use == WheelFollower::Use::kTaken) ++report_.wheel_readings;
  if (taken.speed) wheel_speeds_.push_back(*taken.speed);
}

bool RawlogSource::Impl::is_selected(std::size_t index) const {
  return index >= options_.first && (index - options_.first) % options_.every == 0;
}

std::optional<FrameTicket> RawlogSource::Impl::next() {
  if (options_.count != 0 && delivered_ == options_.count) return std::nullopt;
  while (const auto record = reader_.next()) {
    const auto sight = take(*record);
    if (!sight || !is_selected(report_.images_in_log - 1)) continue;
    auto ticket = ticket_of(*sight, *record);
    if (!ticket) continue;
    ++delivered_;
    last_time_ = ticket->time_s;
    ticket->wheels = std::exchange(wheel_speeds_, {});
    return ticket;
  }
  complete_report();
  return std::nullopt;
}

void RawlogSource::Impl::add_right(const LogView& right, std::size_t record, Payload& payload) {
  const double baseline = camera_.baseline(right, where(record));
  payload.right = stored_image(right, images_);
  payload.baseline_m = payload.right ? baseline : 0.0;
}

std::optional<FrameTicket> RawlogSource::Impl::ticket_of(const Sight& sight,
                                                         const RawlogRecord& record) {
  const LogView& view = sight.view;
  camera_.check_calibration(view, where(record.number));
  poses_.check(view, where(record.number));
  FrameTicket ticket;
  ticket.index = report_.images_in_log - 1;
  const std::string file = file_of(view);
  ticket.name = file.empty() ? "record " + std::to_string(record.number) : file;
  auto image = stored_image(view, images_);
  if (!image) {
    if (report_.images_missing++ == 0) report_.first_missing = ticket.name;
    return std::nullopt;
  }
  if (view.image->kind == LogImage::Kind::external) names_.add(ticket.name);
  auto payload = std::make_shared<Payload>();
  payload->image = std::move(*image);
  if (masks_) payload->mask = masks_->mask_of(file, ticket.index);
  if (sight.right) add_right(*sight.right, record.number, *payload);
  if (masks_ && payload->right) {
    payload->right_mask = masks_->mask_of_right(file_of(*sight.right), file, ticket.index);
  }
  if (payload->right) {
    ++report_.pairs_delivered;
  } else if (options_.stereo && report_.first_lone.empty()) {
    report_.first_lone = ticket.name;
  }
  ticket.time_s = CameraReader::time_of(record.observation->timestamp, where(record.number));
  payload->T_vehicle_cam = camera_.mount(view);
  ticket.payload = std::move(payload);
  if (!std::exchange(settled_, true)) {
    settle_by(std::static_pointer_cast<const Payload>(ticket.payload)->image, ticket.name);
  }
  return ticket;
}

// The first image decides on the grey levels in use and, where the calibration leaves it open, on
// the size of the images, whichever is loaded first by the threads that share the work.
void RawlogSource::Impl::settle_by(const StoredImage& first, const std::string& ticket_name) {
  const bool given = options_.camera_model || !options_.calibration.empty();
  try {
    GreyImage stored = first.grey(in_log(ticket_name), grey_range_);
    if (!given && chosen_.calibration.ncols != 0) return;
    static_cast<void>(camera_.rectify(std::move(stored), first.name(in_log(ticket_name))));
  } catch (const InputError&) {  // load() says it
  }
}

// The mask belongs to the image as it is stored, and is undistorted as it is.
RawlogSource::Impl::Picture RawlogSource::Impl::decoded(const StoredImage& image,
                                                        const std::filesystem::path& mask,
                                                        const std::string& ticket_name) const {
  Picture picture;
  GreyRange drive = grey_range_;  // of its own: several threads load
  GreyImage stored = image.grey(in_log(ticket_name), drive);
  GreyImage stored_mask;
  if (!mask.empty()) stored_mask = read_mask(mask, stored.view(), ticket_name);
  picture.image = camera_.rectify(std::move(stored), image.name(in_log(ticket_name)));
  picture.mask = camera_.unused(picture.image, std::move(stored_mask), mask.string());
  return picture;
}

CameraFrame RawlogSource::Impl::load(const FrameTicket& ticket) const {
  const auto& payload = *static_cast<const Payload*>(ticket.payload.get());
  CameraFrame frame;
  {
    const StageTimer timer(frame.decode_ms);
    Picture seen = decoded(payload.image, payload.mask, ticket.name);
    frame.image = std::move(seen.image);
    frame.mask = std::move(seen.mask);
    if (payload.right) {
      seen = decoded(*payload.right, payload.right_mask, ticket.name + " (right)");
      frame.right = std::move(seen.image);
      frame.right_mask = std::move(seen.mask);
    }
  }
  frame.baseline_m = payload.baseline_m;
  frame.index = ticket.index;
  frame.time_s = ticket.time_s;
  frame.name = ticket.name;
  frame.camera = camera_.rectified_camera(frame.image);
  frame.raw_camera = camera_.raw_camera(frame.image);
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
  report_.calibration_scaled = camera_.scaling_note();
  report_.names_out_of_order = names_.fault();
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
std::size_t RawlogSource::stored_bytes(const FrameTicket& ticket) const {
  return static_cast<const Payload*>(ticket.payload.get())->image.bytes();
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
