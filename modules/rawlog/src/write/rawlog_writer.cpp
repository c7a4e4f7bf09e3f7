#include "oneac/rawlog/rawlog_writer.h"

#include "read/log_reader.h"
#include "write/gps_message.h"
#include "write/gzip_file_stream.h"
#include "write/mrpt_time.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/geometry/camera_frame.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/serialization/CArchive.h>
#include <unistd.h>

#include <exception>
#include <memory>
#include <string>
#include <system_error>

namespace oneac {
namespace {

namespace fs = std::filesystem;

mrpt::img::TCamera mrpt_camera(const PinholeCamera& camera) {
  mrpt::img::TCamera params;
  params.ncols = static_cast<std::uint32_t>(camera.width);
  params.nrows = static_cast<std::uint32_t>(camera.height);
  params.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
  const auto& k = camera.distortion;
  if (camera.lens == LensModel::kannala_brandt) {
    params.setDistortionKannalaBrandt(k[0], k[1], k[2], k[3]);
  } else {
    params.distortion = camera.is_distorted() ? mrpt::img::DistortionModel::plumb_bob
                                              : mrpt::img::DistortionModel::none;
    params.dist = k;
  }
  return params;
}

mrpt::poses::CPose3D mrpt_pose(const Eigen::Isometry3d& T) {
  mrpt::math::CMatrixDouble44 matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix(row, column) = T.matrix()(row, column);
  }
  return mrpt::poses::CPose3D(matrix);
}

mrpt::poses::CPose3D sensor_pose(const Eigen::Isometry3d& T_vehicle_cam,
                                 MountConvention convention) {
  if (convention == MountConvention::optical) return mrpt_pose(T_vehicle_cam);
  Eigen::Isometry3d T_vehicle_sensor = T_vehicle_cam;
  T_vehicle_sensor.linear() =
      T_vehicle_cam.linear() * CameraFrame::forward_looking_mount().linear().transpose();
  return mrpt_pose(T_vehicle_sensor);
}

/// What is none may be a video, a table, or whatever else the log was to be made of.
void require_rawlog_or_nothing(const fs::path& file) {
  std::error_code missing;
  const auto size = fs::file_size(file, missing);
  if (missing || size == 0) return;
  try {
    const LogReader reader(file);
  } catch (const InputError&) {
    throw InputError(file.string(), "is there and is no rawlog, so it is not replaced",
                     "choose another name, or remove it first");
  }
}

/// The log, or the file that it links to.
fs::path log_to_replace(const fs::path& log) {
  if (const std::string fault = fault_of_place(log); !fault.empty()) {
    throw InputError(log.string(), fault, "give the name of a file, such as drive.rawlog");
  }
  require_rawlog_or_nothing(log);
  return replaced_file(log);
}

}  // namespace

class RawlogWriter::Impl {
 public:
  explicit Impl(const fs::path& log) : log_(log_to_replace(log)), temporary_(log_) {
    require_writable_folder(log_.has_parent_path() ? log_.parent_path() : fs::path("."));
    temporary_ += ".part" + std::to_string(::getpid());
    try {
      stream_ = std::make_unique<GzipFileStream>(temporary_);
    } catch (const std::exception&) {
      throw InputError(log.string(), "cannot be written", "choose another place with -o");
    }
  }
  ~Impl() {
    stream_.reset();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void put(const mrpt::serialization::CSerializable& object) {
    try {
      auto archive = mrpt::serialization::archiveFrom<mrpt::io::CStream>(*stream_);
      archive << object;
    } catch (const std::exception&) {
      fail("cannot be written on (is the disk full?)");
    }
  }
  void close() {
    try {
      stream_->close();
    } catch (const std::exception&) {
      fail("cannot be written on (is the disk full?)");
    }
    std::error_code error;
    fs::rename(temporary_, log_, error);
    if (error) fail("cannot be put in place (" + error.message() + ")");
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw OutputError(log_.string(), fault, "free some space or choose another place");
  }

  fs::path log_;
  fs::path temporary_;
  std::unique_ptr<GzipFileStream> stream_;
};

RawlogWriter::RawlogWriter(const fs::path& log) : impl_(std::make_unique<Impl>(log)) {}
RawlogWriter::~RawlogWriter() = default;
RawlogWriter::RawlogWriter(RawlogWriter&&) noexcept = default;
RawlogWriter& RawlogWriter::operator=(RawlogWriter&&) noexcept = default;

void RawlogWriter::write(const ImageRecord& record) {
  mrpt::obs::CObservationImage observation;
  observation.sensorLabel = record.label;
  observation.timestamp = mrpt_time(record.time_s);
  observation.cameraPose = sensor_pose(record.T_vehicle_cam, record.convention);
  observation.cameraParams = mrpt_camera(record.camera);
  observation.image.setExternalStorage(record.file);
  impl_->put(observation);
}

void RawlogWriter::write(const StereoRecord& record) {
  mrpt::obs::CObservationStereoImages observation;
  observation.sensorLabel = record.label;
  observation.timestamp = mrpt_time(record.time_s);
  const auto pose = sensor_pose(record.T_vehicle_left, record.convention);
  observation.cameraPose = mrpt::poses::CPose3DQuat(pose);
  observation.rightCameraPose = mrpt::poses::CPose3DQuat(mrpt_pose(record.T_left_right));
  observation.leftCamera = mrpt_camera(record.left);
  observation.rightCamera = mrpt_camera(record.right);
  observation.imageLeft.setExternalStorage(record.left_file);
  observation.hasImageRight = !record.right_file.empty();
  if (observation.hasImageRight) observation.imageRight.setExternalStorage(record.right_file);
  impl_->put(observation);
}

void RawlogWriter::write(const GpsRecord& record) {
  impl_->put(gga_observation(record));
  if (record.velocity) impl_->put(rmc_observation(record));
}

void RawlogWriter::write(const ImuRecord& record) {
  mrpt::obs::CObservationIMU observation;
  observation.sensorLabel = record.label;
  observation.timestamp = mrpt_time(record.time_s);
  observation.set(mrpt::obs::IMU_X_ACC, record.acceleration.x());
  observation.set(mrpt::obs::IMU_Y_ACC, record.acceleration.y());
  observation.set(mrpt::obs::IMU_Z_ACC, record.acceleration.z());
  observation.set(mrpt::obs::IMU_WX, record.angular_rate.x());
  observation.set(mrpt::obs::IMU_WY, record.angular_rate.y());
  observation.set(mrpt::obs::IMU_WZ, record.angular_rate.z());
  impl_->put(observation);
}

void RawlogWriter::write(const OdometryRecord& record) {
  mrpt::obs::CObservationOdometry observation;
  observation.sensorLabel = record.label;
  observation.timestamp = mrpt_time(record.time_s);
  observation.odometry =
      mrpt::poses::CPose2D(record.position.x(), record.position.y(), record.heading);
  impl_->put(observation);
}

void RawlogWriter::close() {
  impl_->close();
}

}  // namespace oneac
