#include "oneac/frontend/observation_input.h"

#include "oneac/base/error.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kKnot = 1852.0 / 3600.0;  // [m/s]
// A rectified pair: half an angle between the cameras [rad], other baselines than along X [-],
// difference between the calibrations [px].
constexpr double kParallel = 1e-3;
constexpr double kSideways = 0.01;
constexpr double kSamePixel = 0.1;

/// The parts of an image observation.
struct View {
  const mrpt::img::CImage* image;
  const mrpt::img::TCamera* camera;
  mrpt::poses::CPose3D pose;
};

std::optional<View> view_of(const mrpt::obs::CObservation& observation) {
  if (const auto* mono = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    return View{&mono->image, &mono->cameraParams, mono->cameraPose};
  }
  if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation)) {
    return View{&pair->imageLeft, &pair->leftCamera, mrpt::poses::CPose3D(pair->cameraPose)};
  }
  return std::nullopt;
}

Eigen::Matrix3d rotation_of(const mrpt::poses::CPose3D& pose) {
  const auto from = pose.getRotationMatrix();
  Eigen::Matrix3d R;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) R(row, column) = from(row, column);
  }
  return R;
}

/// Optical axes, whichever the log uses: the reading under which the lower edge of the image points
/// further down.
Eigen::Isometry3d mount_of(const mrpt::poses::CPose3D& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << pose.x(), pose.y(), pose.z();
  const Eigen::Matrix3d R = rotation_of(pose);
  const Eigen::Matrix3d x_forward = R * CameraFrame::forward_looking_mount().linear();
  T.linear() = x_forward(2, 1) < R(2, 1) ? x_forward : R;
  return T;
}

cv::Mat grey(const cv::Mat& pixels) {
  cv::Mat out = pixels;
  if (pixels.channels() == 3) cv::cvtColor(pixels, out, cv::COLOR_BGR2GRAY);
  if (pixels.channels() == 4) cv::cvtColor(pixels, out, cv::COLOR_BGRA2GRAY);
  return out;
}

bool is_straight(const mrpt::img::TCamera& camera) {
  return camera.distortion == mrpt::img::DistortionModel::none ||
         std::all_of(camera.dist.begin(), camera.dist.end(), [](double v) { return v == 0.0; });
}

cv::Mat rectified(const cv::Mat& pixels, const mrpt::img::TCamera& camera) {
  const auto& k = camera.dist;
  if (is_straight(camera)) return pixels;
  if (camera.distortion != mrpt::img::DistortionModel::plumb_bob) {
    throw InputError("image observation", "the lens model is not plumb-bob", "rectify the images");
  }
  const cv::Matx33d K(camera.fx(), 0.0, camera.cx(), 0.0, camera.fy(), camera.cy(), 0.0, 0.0, 1.0);
  cv::Mat out;
  cv::undistort(pixels, out, K, cv::Vec<double, 5>(k[0], k[1], k[2], k[3], k[4]));
  return out;
}

GreyImage copied(const cv::Mat& pixels) {
  return GreyImage(ImageView{pixels.data, pixels.cols, pixels.rows, static_cast<int>(pixels.step)});
}

PinholeCamera pinhole(const mrpt::img::TCamera& from, const cv::Mat& pixels) {
  PinholeCamera camera;
  camera.width = pixels.cols;
  camera.height = pixels.rows;
  camera.fx = from.fx();
  camera.fy = from.fy();
  camera.cx = from.cx();
  camera.cy = from.cy();
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) {
    throw InputError("image observation", "it carries no calibration", "set its cameraParams");
  }
  return camera;
}

cv::Mat loaded(const mrpt::img::CImage& image) {
  try {
    image.forceLoad();
    return compat::pixels_of(image);
  } catch (const std::exception&) {
    return {};  // an external image that is not there
  }
}

/// The right image of a rectified pair: equal cameras side by side. Any other is left out.
void add_right_image(const mrpt::obs::CObservation& observation, CameraFrame& frame) {
  const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation);
  if (pair == nullptr || !compat::is_set(pair->hasImageRight)) return;
  const auto& T = pair->rightCameraPose;
  const bool beside = T.x() > 0.0 && std::hypot(T.y(), T.z()) < kSideways * T.x() &&
                      std::abs(T.quat().r()) > std::cos(kParallel);
  const auto& left = pair->leftCamera;
  const auto& right = pair->rightCamera;
  const double off = std::abs(left.fx() - right.fx()) + std::abs(left.fy() - right.fy()) +
                     std::abs(left.cx() - right.cx()) + std::abs(left.cy() - right.cy());
  if (!beside || off > kSamePixel || !is_straight(left) || !is_straight(right)) return;
  const cv::Mat pixels = loaded(pair->imageRight);
  if (pixels.depth() == CV_8U && pixels.cols == frame.image.width() &&
      pixels.rows == frame.image.height()) {
    frame.right = copied(grey(pixels));
    frame.baseline_m = T.x();
  }
  if (pair->imageRight.isExternallyStored()) pair->imageRight.unload();
}

/// Three fields of an IMU, turned into the vehicle's axes.
std::optional<Eigen::Vector3d> in_vehicle(const mrpt::obs::CObservation& observation,
                                          const std::array<mrpt::obs::TIMUDataIndex, 3>& fields) {
  const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
  if (imu == nullptr) return std::nullopt;
  Eigen::Vector3d in_sensor;
  for (std::size_t axis = 0; axis < fields.size(); ++axis) {
    const auto value = compat::imu_field(*imu, fields[axis]);
    if (!value) return std::nullopt;
    in_sensor(static_cast<Eigen::Index>(axis)) = *value;
  }
  if (!in_sensor.allFinite()) return std::nullopt;
  return rotation_of(imu->sensorPose) * in_sensor;
}

}  // namespace

std::optional<CameraFrame> frame_from_observation(const mrpt::obs::CObservation& observation) {
  const auto view = view_of(observation);
  if (!view) return std::nullopt;
  const cv::Mat pixels = loaded(*view->image);
  if (pixels.empty() || pixels.depth() != CV_8U) return std::nullopt;
  CameraFrame frame;
  frame.time_s = compat::unix_seconds(observation.timestamp);
  frame.name = observation.sensorLabel;
  frame.camera = pinhole(*view->camera, pixels);
  frame.image = copied(rectified(grey(pixels), *view->camera));
  frame.T_vehicle_cam = mount_of(view->pose);
  if (view->image->isExternallyStored()) view->image->unload();
  add_right_image(observation, frame);
  return frame;
}

std::optional<Eigen::Vector3d> acceleration_from_observation(
    const mrpt::obs::CObservation& observation) {
  return in_vehicle(observation,
                    {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC});
}

std::optional<double> yaw_rate_from_observation(const mrpt::obs::CObservation& observation) {
  const auto rates =
      in_vehicle(observation, {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ});
  if (!rates) return std::nullopt;
  return rates->z();
}

std::optional<double> speed_from_observation(const mrpt::obs::CObservation& observation) {
  const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation);
  if (gps == nullptr) return std::nullopt;
  const auto* rmc = compat::gps_message<mrpt::obs::gnss::Message_NMEA_RMC>(*gps);
  if (rmc == nullptr || rmc->fields.validity_char != 'A') return std::nullopt;
  const double speed = rmc->fields.speed_knots * kKnot;
  if (!std::isfinite(speed) || speed < 0.0) return std::nullopt;
  return speed;
}

}  // namespace oneac
