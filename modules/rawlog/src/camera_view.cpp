#include "camera_view.h"

#include "oneac/base/error.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace oneac {
namespace {

constexpr const char* kGiveCalibration = "give one with --calibration FILE[:SECTION]";

Eigen::Isometry3d isometry_of(const mrpt::poses::CPose3D& pose) {
  const auto R = pose.getRotationMatrix();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) T.linear()(r, c) = R(r, c);
  }
  T.translation() = Eigen::Vector3d(pose.x(), pose.y(), pose.z());
  return T;
}

void append_pair(const mrpt::obs::CObservationStereoImages& pair, std::vector<CameraView>& views) {
  const auto T_vehicle_left = isometry_of(mrpt::poses::CPose3D(pair.cameraPose));
  views.push_back({pair.sensorLabel, CameraView::Side::left, &pair.imageLeft, &pair.leftCamera,
                   T_vehicle_left, Eigen::Isometry3d::Identity()});
  if (!pair.hasImageRight) return;
  views.push_back({pair.sensorLabel, CameraView::Side::right, &pair.imageRight, &pair.rightCamera,
                   T_vehicle_left, isometry_of(mrpt::poses::CPose3D(pair.rightCameraPose))});
}

}  // namespace

std::string CameraView::name() const {
  if (side == Side::mono) return label;
  return label + (side == Side::left ? "/left" : "/right");
}

bool CameraView::matches(const std::string& camera) const {
  if (camera.empty() || camera == name()) return true;
  if (side == Side::left && (camera == "left" || camera == label)) return true;
  return side == Side::right && camera == "right";
}

std::string CameraView::side_name() const {
  if (side != Side::mono) return side == Side::left ? "left" : "right";
  std::string text = label;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text.find("right") != std::string::npos) return "right";
  return text.find("left") != std::string::npos ? "left" : "";
}

Eigen::Isometry3d CameraView::offset_in_pair(bool images_rectified) const {
  const auto& k = calibration->dist;
  const bool stored_raw = calibration->distortion != mrpt::img::DistortionModel::none &&
                          std::any_of(k.begin(), k.end(), [](double v) { return v != 0.0; });
  if (!images_rectified || !stored_raw) return T_left_right;
  Eigen::Isometry3d parallel = Eigen::Isometry3d::Identity();
  parallel.translation().x() = T_left_right.translation().norm();
  return parallel;
}

std::vector<CameraView> camera_views(const mrpt::obs::CObservation& observation) {
  std::vector<CameraView> views;
  if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation)) {
    append_pair(*pair, views);
  } else if (const auto* mono = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    views.push_back({mono->sensorLabel, CameraView::Side::mono, &mono->image, &mono->cameraParams,
                     isometry_of(mono->cameraPose), Eigen::Isometry3d::Identity()});
  }
  return views;
}

PinholeCamera to_pinhole(const mrpt::img::TCamera& camera, const std::string& where) {
  using mrpt::img::DistortionModel;
  PinholeCamera pinhole;
  pinhole.width = static_cast<int>(camera.ncols);
  pinhole.height = static_cast<int>(camera.nrows);
  pinhole.fx = camera.fx();
  pinhole.fy = camera.fy();
  pinhole.cx = camera.cx();
  pinhole.cy = camera.cy();
  const bool usable = std::isfinite(pinhole.fx + pinhole.fy + pinhole.cx + pinhole.cy) &&
                      pinhole.fx > 0.0 && pinhole.fy > 0.0;
  if (!usable) throw InputError(where, "the log carries no calibration", kGiveCalibration);
  if (camera.distortion == DistortionModel::none) return pinhole;
  const auto& k = camera.dist;  // k1 k2 p1 p2 k3, then the rational model's k4 k5 k6
  const auto beyond = k.begin() + static_cast<std::ptrdiff_t>(pinhole.distortion.size());
  const bool finite = std::all_of(k.begin(), k.end(), [](double v) { return std::isfinite(v); });
  const bool supported = camera.distortion == DistortionModel::plumb_bob && finite &&
                         std::all_of(beyond, k.end(), [](double v) { return v == 0.0; });
  if (!supported) {
    throw InputError(where, "the lens model is not plumb-bob with k1 k2 p1 p2 k3",
                     "rectify the images and " + std::string(kGiveCalibration));
  }
  std::copy(k.begin(), beyond, pinhole.distortion.begin());
  return pinhole;
}

}  // namespace oneac
