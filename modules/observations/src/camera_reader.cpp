#include "oneac/observations/camera_reader.h"

#include "undistortion.h"

#include "oneac/base/error.h"
#include "oneac/mrpt_compat/observations.h"

#include <utility>

namespace oneac {
namespace {

constexpr const char* kAnotherScale = "set front_end.scale.source to height, gps or none";

PinholeCamera calibration_of(const CameraDescription& first, const CameraReaderOptions& options,
                             const std::string& where) {
  if (options.calibration) return *options.calibration;
  return to_pinhole(first.calibration, where + ": camera '" + first.name + "'");
}

// The orientation that somebody states needs no convention.
MountConvention convention_of(const CameraDescription& first, const CameraReaderOptions& options,
                              const std::string& where) {
  const SensorMount mount =
      mount_from_sensor_pose(first.T_vehicle_sensor, options.mount_convention);
  if (mount.sure || options.mount) return mount.convention;
  throw InputError(where + ": camera '" + first.name + "'",
                   "its sensor pose is that of no upright camera, and whether its axes are optical "
                   "or x-forward cannot be guessed",
                   "give --mount-convention optical or x_forward, or --mount-roll, --mount-pitch "
                   "and --mount-yaw");
}

}  // namespace

CameraDescription CameraDescription::of(const CameraView& view) {
  return {view.name(), view.label,        view.side_name(),
          view.side,   *view.calibration, view.T_vehicle_sensor};
}

struct CameraReader::State {
  State(const CameraDescription& described, const CameraReaderOptions& options,
        const PinholeCamera& calibration, const std::string& where)
      : name(described.name),
        stored(described.calibration),
        overridden(options.calibration.has_value()),
        convention(convention_of(described, options, where)),
        mount(options.mount),
        camera(calibration),
        undistorter(calibration) {}

  std::string name;
  mrpt::img::TCamera stored;
  bool overridden;
  MountConvention convention;
  std::optional<MountAngles> mount;
  PinholeCamera camera;
  Undistorter undistorter;
};

CameraReader::CameraReader(const CameraDescription& first, const CameraReaderOptions& options,
                           const std::string& where)
    : state_(
          std::make_unique<State>(first, options, calibration_of(first, options, where), where)) {
  if (!options.stereo || first.side == CameraView::Side::left) return;
  throw InputError(where + ": camera '" + first.name + "'",
                   "it is not the left one of a stereo pair", kAnotherScale);
}

CameraReader::~CameraReader() = default;
CameraReader::CameraReader(CameraReader&&) noexcept = default;
CameraReader& CameraReader::operator=(CameraReader&&) noexcept = default;

// One map for all images holds only while the calibration stays the same.
void CameraReader::check_calibration(const CameraView& view, const std::string& where) const {
  if (state_->overridden || *view.calibration == state_->stored) return;
  throw InputError(where, "the calibration of camera '" + state_->name + "' changes here",
                   "cut the log there, or give one with --calibration FILE[:SECTION]");
}

// Rows correspond only when both images were rectified together; this program does not do it.
double CameraReader::baseline(const CameraView& right, const std::string& where) const {
  const auto baseline = rectified_baseline(right, state_->camera, state_->overridden);
  if (baseline) return *baseline;
  throw InputError(where, "the images of the stereo pair are not rectified",
                   std::string("rectify them, or ") + kAnotherScale);
}

double CameraReader::time_of(const mrpt::Clock::time_point& stamp, const std::string& where) {
  if (stamp != INVALID_TIMESTAMP) return compat::unix_seconds(stamp);
  throw InputError(where, "the image has no time stamp", "restamp the log with rawlog-edit");
}

Eigen::Isometry3d CameraReader::mount(const CameraView& view) const {
  auto mount = mount_from_sensor_pose(view.T_vehicle_sensor, to_string(state_->convention));
  if (state_->mount) mount.T_vehicle_cam.linear() = mount_rotation(*state_->mount);
  return mount.T_vehicle_cam * view.offset_in_pair(!undistorts());
}

GreyImage CameraReader::rectify(GreyImage grey, const std::string& name) const {
  return state_->undistorter.rectify(std::move(grey), name);
}

PinholeCamera CameraReader::rectified_camera(const GreyImage& image) const {
  return state_->undistorter.rectified_camera(image);
}

PinholeCamera CameraReader::raw_camera(const GreyImage& image) const {
  PinholeCamera camera = state_->camera;
  camera.width = image.width();
  camera.height = image.height();
  return camera;
}

bool CameraReader::undistorts() const {
  return state_->camera.is_distorted();
}

}  // namespace oneac
