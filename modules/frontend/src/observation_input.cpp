#include "oneac/frontend/observation_input.h"

#include "oneac/base/error.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

constexpr double kKnot = 1852.0 / 3600.0;  // [m/s]

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

cv::Mat rectified(const cv::Mat& pixels, const mrpt::img::TCamera& camera) {
  const auto& k = camera.dist;
  const bool straight = camera.distortion == mrpt::img::DistortionModel::none ||
                        std::all_of(k.begin(), k.end(), [](double v) { return v == 0.0; });
  if (straight) return pixels;
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
  return frame;
}

std::optional<Eigen::Vector3d> acceleration_from_observation(
    const mrpt::obs::CObservation& observation) {
  const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
  if (imu == nullptr) return std::nullopt;
  Eigen::Vector3d acceleration;
  const mrpt::obs::TIMUDataIndex fields[] = {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC,
                                             mrpt::obs::IMU_Z_ACC};
  for (int axis = 0; axis < 3; ++axis) {
    if (!imu->has(fields[axis])) return std::nullopt;
    acceleration(axis) = imu->get(fields[axis]);
  }
  if (!acceleration.allFinite()) return std::nullopt;
  return rotation_of(imu->sensorPose) * acceleration;
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
