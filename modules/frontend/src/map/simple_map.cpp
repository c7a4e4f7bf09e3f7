#include "oneac/frontend/map_formats.h"

#include <mrpt/core/Clock.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <ostream>
#include <sstream>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

mrpt::poses::CPose3D to_mrpt(const Eigen::Isometry3d& T) {
  mrpt::math::CMatrixDouble44 matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix(row, column) = T.matrix()(row, column);
  }
  return mrpt::poses::CPose3D(matrix);
}

mrpt::obs::CObservationImage::Ptr camera_of(const Keyframe& keyframe,
                                            const Eigen::Isometry3d& T_vehicle_cam,
                                            const PinholeCamera& camera) {
  auto image = mrpt::obs::CObservationImage::Create();
  image->timestamp = mrpt::Clock::fromDouble(keyframe.time_s);
  image->sensorLabel = "camera";
  image->cameraPose = to_mrpt(T_vehicle_cam);
  image->cameraParams.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
  image->cameraParams.ncols = static_cast<unsigned int>(camera.width);
  image->cameraParams.nrows = static_cast<unsigned int>(camera.height);
  return image;
}

/// 1σ² of the position, summed along the edges; MRPT's order x y z yaw pitch roll. The rotations'
/// share is that of the edges as well, for small turns.
Matrix6 step_covariance(const Keyframe& keyframe) {
  if (keyframe.information.isZero()) return Matrix6::Zero();
  const Matrix6 covariance = keyframe.information.inverse();
  Matrix6 variances = Matrix6::Zero();
  // One number for the position and one for the turn: free of the axes of camera and vehicle. The
  // quaternion's vector part is half the angle.
  const double position = covariance.diagonal().head<3>().mean();
  const double turn = 4.0 * covariance.diagonal().tail<3>().mean();
  variances.diagonal().head<3>().setConstant(position);
  variances.diagonal().tail<3>().setConstant(turn);
  return variances;
}

std::string bytes_of(const mrpt::maps::CSimpleMap& map) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  const auto* bytes = static_cast<const char*>(stream.getRawBufferData());
  return {bytes, static_cast<std::size_t>(stream.getTotalBytesCount())};
}

// A map is its class and version, the number of keyframes, these, and the mark of its end.
constexpr std::size_t kCountBytes = 4, kEndBytes = 1;

/// As MRPT stores it, the lowest byte first.
std::string count_bytes(std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < kCountBytes; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(count >> (8 * i) & 0xFF));
  }
  return bytes;
}

}  // namespace

SimpleMapWriter::SimpleMapWriter(const Eigen::Isometry3d& T_vehicle_cam,
                                 const PinholeCamera& camera, std::size_t keyframes,
                                 std::ostream& out)
    : T_vehicle_cam_(T_vehicle_cam), camera_(camera), out_(out) {
  const std::string empty = bytes_of({});
  head_ = empty.size() - kEndBytes;
  out_ << empty.substr(0, head_ - kCountBytes) << count_bytes(keyframes);
}

void SimpleMapWriter::add(const Keyframe& keyframe) {
  covariance_ += step_covariance(keyframe);
  auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
  pose->mean = to_mrpt(T_vehicle_cam_ * keyframe.T_first_cam * T_vehicle_cam_.inverse());
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) pose->cov(row, column) = covariance_(row, column);
  }
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(camera_of(keyframe, T_vehicle_cam_, camera_));
  mrpt::maps::CSimpleMap map;
  map.insert(pose, frame);
  const std::string alone = bytes_of(map);
  out_ << alone.substr(head_, alone.size() - head_ - kEndBytes);
}

void SimpleMapWriter::finish() {
  const std::string empty = bytes_of({});
  out_ << empty.substr(empty.size() - kEndBytes);
}

std::string format_simple_map(const std::vector<Keyframe>& keyframes,
                              const Eigen::Isometry3d& T_vehicle_cam, const PinholeCamera& camera) {
  std::ostringstream out;
  SimpleMapWriter writer(T_vehicle_cam, camera, keyframes.size(), out);
  for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
  writer.finish();
  return out.str();
}

}  // namespace oneac
