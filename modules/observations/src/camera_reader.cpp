#include "oneac/observations/camera_reader.h"

#include "undistortion.h"

#include "oneac/base/error.h"
#include "oneac/base/mask.h"
#include "oneac/geometry/camera_plausibility.h"
#include "oneac/mrpt_compat/observations.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace oneac {
namespace {

constexpr const char* kAnotherScale = "set front_end.scale.source to height, gps, wheels or none";

PinholeCamera calibration_of(const CameraDescription& first, const CameraReaderOptions& options,
                             const std::string& where) {
  const std::string name = where + ": camera '" + first.name + "'";
  const PinholeCamera camera =
      options.calibration ? *options.calibration : to_pinhole(first.calibration, name);
  const std::string fault = impossible_camera(camera);
  if (fault.empty()) return camera;
  throw InputError(options.calibration ? "the calibration given" : name, fault,
                   "give one that is measured, with --calibration FILE[:SECTION]");
}

/// [px] as far as a calibration may wander from image to image: a tenth of what a corner is found
/// to. Whoever writes K with every image rounds it, through text or single precision.
constexpr double kSamePixel = 0.01;
constexpr double kSameDistortion = 1e-5;  // [-] moves a point at half a focal length less than that

bool is_same(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b) {
  if (a == b) return true;
  const auto near = [](double x, double y, double off) { return std::abs(x - y) <= off; };
  for (std::size_t i = 0; i < a.dist.size(); ++i) {
    if (!near(a.dist[i], b.dist[i], kSameDistortion)) return false;
  }
  return a.ncols == b.ncols && a.nrows == b.nrows && a.distortion == b.distortion &&
         near(a.fx(), b.fx(), kSamePixel) && near(a.fy(), b.fy(), kSamePixel) &&
         near(a.cx(), b.cx(), kSamePixel) && near(a.cy(), b.cy(), kSamePixel);
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
        undistorter(calibration, {options.undistorted_fov_deg, overridden}) {}

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
  if (state_->overridden || is_same(*view.calibration, state_->stored)) return;
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

GreyImage CameraReader::unused(const GreyImage& rectified, GreyImage mask,
                               const std::string& name) const {
  const Undistorter& undistorter = state_->undistorter;
  if (mask.empty()) return undistorter.unseen(rectified);
  return darker(undistorter.rectify(std::move(mask), name), undistorter.unseen(rectified));
}

PinholeCamera CameraReader::rectified_camera(const GreyImage& image) const {
  return state_->undistorter.rectified_camera(image);
}

std::string CameraReader::scaling_note() const {
  return state_->undistorter.scaling_note();
}

PinholeCamera CameraReader::raw_camera(const GreyImage& image) const {
  return state_->undistorter.camera_for(image.width(), image.height());
}

bool CameraReader::undistorts() const {
  return state_->camera.is_distorted();
}

}  // namespace oneac
