#include "oneac/observations/camera_view.h"

#include "oneac/base/error.h"
#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <utility>

namespace oneac {
namespace {

using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationStereoImages;

constexpr const char* kGiveCalibration =
    "give one with --calibration FILE[:SECTION], or set the observations' cameraParams";
constexpr const char* kGiveTheirs =
    "rectify the images and give one with --calibration FILE[:SECTION], or set the observations' "
    "cameraParams";
constexpr double kRotationTolerance = 1e-3;      // poses stored in single precision are far better
constexpr std::uint32_t kLargestSide = 1000000;  // [px]; more is damage
// A rectified pair.
constexpr double kParallel = 1e-3;  // [rad] between its cameras
constexpr double kShortest = 1e-3;  // [m] of the baseline
constexpr double kSideways = 0.01;  // [-] of the baseline, off the X axis
constexpr double kSamePixel = 0.1;  // [px] between the calibrations

// MRPT's own conversions throw at a pose that is damaged.
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

bool is_sound(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  const double defect = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return defect < kRotationTolerance && R.determinant() > 0.0 && T.translation().allFinite();
}

std::vector<CameraView> halves_of(const CObservationStereoImages& pair) {
  CameraView left{pair.sensorLabel, CameraView::Side::left,       &pair.imageLeft,
                  &pair.leftCamera, isometry_of(pair.cameraPose), Eigen::Isometry3d::Identity()};
  if (!compat::is_set(pair.hasImageRight)) return {std::move(left)};
  CameraView right = left;
  right.side = CameraView::Side::right;
  right.pixels = &pair.imageRight;
  right.calibration = &pair.rightCamera;
  right.T_left_right = isometry_of(pair.rightCameraPose);
  return {std::move(left), std::move(right)};
}

bool is_like(const mrpt::img::TCamera& right, const PinholeCamera& left) {
  const double off = std::abs(right.fx() - left.fx) + std::abs(right.fy() - left.fy) +
                     std::abs(right.cx() - left.cx) + std::abs(right.cy() - left.cy);
  return off < kSamePixel;
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

// A damaged pose has entries that are not finite, or none of a rotation.
bool CameraView::has_sound_pose() const {
  return is_sound(T_vehicle_sensor) && is_sound(T_left_right);
}

std::vector<CameraView> camera_views(const mrpt::obs::CObservation& observation) {
  if (const auto* pair = dynamic_cast<const CObservationStereoImages*>(&observation)) {
    return halves_of(*pair);
  }
  const auto* mono = dynamic_cast<const CObservationImage*>(&observation);
  if (mono == nullptr) return {};
  return {{mono->sensorLabel, CameraView::Side::mono, &mono->image, &mono->cameraParams,
           isometry_of(mono->cameraPose), Eigen::Isometry3d::Identity()}};
}

std::string damaged_pose(const CameraView& view) {
  if (view.side == CameraView::Side::mono) return "the pose of the camera is damaged";
  const bool left = view.side == CameraView::Side::left || !is_sound(view.T_vehicle_sensor);
  return std::string("the pose of the ") + (left ? "left" : "right") + " camera is damaged";
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
  if (!usable) throw InputError(where, "it carries no calibration", kGiveCalibration);
  if (camera.distortion == DistortionModel::none) return pinhole;
  const auto& k = camera.dist;
  const bool finite = std::all_of(k.begin(), k.end(), [](double v) { return std::isfinite(v); });
  if (!finite) throw InputError(where, "the lens has terms that are no numbers", kGiveTheirs);
  if (camera.distortion == DistortionModel::plumb_bob) {
    pinhole.distortion = k;
    return pinhole;
  }
  if (camera.distortion != DistortionModel::kannala_brandt) {
    throw InputError(where, "the lens model is neither plumb-bob nor Kannala-Brandt", kGiveTheirs);
  }
  const auto terms = fisheye_terms_of_mrpt(k);
  if (!terms) throw InputError(where, "the fisheye lens has more than four terms", kGiveTheirs);
  pinhole.lens = LensModel::kannala_brandt;
  std::copy(terms->begin(), terms->end(), pinhole.distortion.begin());
  return pinhole;
}

std::optional<std::array<double, 4>> fisheye_terms_of_mrpt(const std::array<double, 8>& dist) {
  const auto none = [&](std::size_t from, std::size_t to) {
    return std::all_of(dist.begin() + static_cast<std::ptrdiff_t>(from),
                       dist.begin() + static_cast<std::ptrdiff_t>(to),
                       [](double value) { return value == 0.0; });
  };
  if (!none(6, 8)) return std::nullopt;
  if (none(2, 4)) return std::array<double, 4>{dist[0], dist[1], dist[4], dist[5]};
  if (none(4, 6)) return std::array<double, 4>{dist[0], dist[1], dist[2], dist[3]};
  return std::nullopt;
}

std::optional<double> rectified_baseline(const CameraView& right, const PinholeCamera& left,
                                         bool overridden) {
  if (left.is_distorted() || (!overridden && !is_like(*right.calibration, left))) {
    return std::nullopt;
  }
  const Eigen::Isometry3d T = right.offset_in_pair(true);
  const Eigen::Vector3d t = T.translation();
  const bool parallel = Eigen::AngleAxisd(T.linear()).angle() < kParallel;
  const bool beside = t.x() > kShortest && t.tail<2>().norm() < kSideways * t.x();
  if (!parallel || !beside) return std::nullopt;
  return t.x();
}

}  // namespace oneac
