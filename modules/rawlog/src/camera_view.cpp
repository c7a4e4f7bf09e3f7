#include "camera_view.h"

#include "oneac/base/error.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationStereoImages;

constexpr const char* kGiveCalibration = "give one with --calibration FILE[:SECTION]";
constexpr double kRotationTolerance = 1e-3;      // poses stored in single precision are far better
constexpr std::uint32_t kLargestSide = 1000000;  // [px]; more is damage

// MRPT's own conversions throw at a pose that is damaged; check_cameras() has refused those.
Eigen::Isometry3d isometry_of(const mrpt::poses::CPose3D& pose) {
  const auto R = pose.getRotationMatrix();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) T.linear()(r, c) = R(r, c);
  }
  T.translation() = Eigen::Vector3d(pose.x(), pose.y(), pose.z());
  return T;
}

Eigen::Isometry3d isometry_of(const mrpt::poses::CPose3DQuat& pose) {
  const auto& q = pose.quat();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(q.r(), q.x(), q.y(), q.z()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(pose.x(), pose.y(), pose.z());
  return T;
}

void require_pose(const Eigen::Isometry3d& T, const char* whose) {
  const Eigen::Matrix3d R = T.linear();
  const double defect = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const bool rotates = defect < kRotationTolerance && R.determinant() > 0.0;
  if (rotates && T.translation().allFinite()) return;
  throw std::runtime_error(std::string("the pose of ") + whose + " is damaged");
}

// The image that GuardedStream took out of the record.
std::shared_ptr<const LogImage> image_of(const mrpt::img::CImage& image, const LogImages& images) {
  static const auto kNone = std::make_shared<const LogImage>();
  if (!image.isExternallyStored()) return kNone;
  const std::string& number = image.getExternalStorageFile();
  std::size_t index = images.size();
  std::from_chars(number.data(), number.data() + number.size(), index);
  return index < images.size() ? images[index] : kNone;
}

void append_pair(const CObservationStereoImages& pair, const LogImages& images,
                 std::vector<CameraView>& views) {
  const auto T_vehicle_left = isometry_of(pair.cameraPose);
  views.push_back({pair.sensorLabel, CameraView::Side::left, image_of(pair.imageLeft, images),
                   &pair.leftCamera, T_vehicle_left, Eigen::Isometry3d::Identity()});
  if (!compat::is_set(pair.hasImageRight)) return;
  views.push_back({pair.sensorLabel, CameraView::Side::right, image_of(pair.imageRight, images),
                   &pair.rightCamera, T_vehicle_left, isometry_of(pair.rightCameraPose)});
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

std::vector<CameraView> camera_views(const RawlogRecord& record) {
  std::vector<CameraView> views;
  const mrpt::obs::CObservation* observation = record.observation.get();
  if (const auto* pair = dynamic_cast<const CObservationStereoImages*>(observation)) {
    append_pair(*pair, *record.images, views);
  } else if (const auto* mono = dynamic_cast<const CObservationImage*>(observation)) {
    views.push_back({mono->sensorLabel, CameraView::Side::mono,
                     image_of(mono->image, *record.images), &mono->cameraParams,
                     isometry_of(mono->cameraPose), Eigen::Isometry3d::Identity()});
  }
  return views;
}

void check_cameras(const mrpt::obs::CObservation& observation) {
  if (const auto* pair = dynamic_cast<const CObservationStereoImages*>(&observation)) {
    require_pose(isometry_of(pair->cameraPose), "the left camera");
    if (compat::is_set(pair->hasImageRight))
      require_pose(isometry_of(pair->rightCameraPose), "the right camera");
  } else if (const auto* mono = dynamic_cast<const CObservationImage*>(&observation)) {
    require_pose(isometry_of(mono->cameraPose), "the camera");
  }
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
                      pinhole.fx > 0.0 && pinhole.fy > 0.0 && camera.ncols < kLargestSide &&
                      camera.nrows < kLargestSide;
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
