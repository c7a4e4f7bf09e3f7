#include "oneac/rawlog/drive_recorder.h"

#include "writing_support.h"

#include "oneac/geometry/camera_frame.h"
#include "oneac/geometry/levelling.h"
#include "oneac/rawlog/rawlog_source.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace oneac {
namespace {

constexpr int kFrames = 5;
constexpr double kDegree = M_PI / 180.0;

GreyImage flat(std::size_t i, int offset) {
  return {64, 48, static_cast<std::uint8_t>(10 * i + static_cast<std::size_t>(offset))};
}

DriveRecording small_drive() {
  DriveRecording drive;
  drive.camera = {64, 48, 50.0, 50.0, 31.5, 23.5, {}};
  drive.T_vehicle_cam = CameraFrame::forward_looking_mount();
  drive.T_vehicle_cam.linear() *= levelling_rotation({5.0 * kDegree, 0.0});
  drive.T_vehicle_cam.translation().z() = 1.5;
  for (int i = 0; i < kFrames; ++i) {
    Eigen::Isometry3d T = drive.T_vehicle_cam;
    T.pretranslate(Eigen::Vector3d(0.8 * i, 0.0, 0.0));
    drive.times_s.push_back(0.1 * i);
    drive.T_world_cam.push_back(T);
  }
  drive.images = [](std::size_t i) { return DriveImages{flat(i, 20), flat(i, 120)}; };
  for (int i = 0; i < 50; ++i) drive.imu.push_back({0.01 * i, "IMU", {0, 0, 9.8}, {0, 0, 0}});
  GpsRecord fix;
  fix.label = "GPS";
  fix.velocity = GroundVelocity{8.0, 90.0};
  drive.gps.push_back(fix);
  return drive;
}

TEST(DriveRecorder, LaysTheDriveOutAsMalagaDoes) {
  const TemporaryFolder folder;
  const RecordedDrive files = record_drive(small_drive(), folder.path() / "drive");
  EXPECT_EQ(test::names_in(folder.path() / "drive"),
            (std::vector<std::string>{"Images", "poses.txt", "simulated.rawlog"}));
  const auto images = test::names_in(files.images);
  ASSERT_EQ(images.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(images[1], "img_CAMERA1_1261229980.100000.jpg");
  const cv::Mat second = cv::imread((files.images / images[1]).string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(second.channels(), 1);
  EXPECT_NEAR(second.at<unsigned char>(20, 20), 30, 1);
}

TEST(DriveRecorder, RawlogEditReadsTheLog) {
  const TemporaryFolder folder;
  const std::string info = test::rawlog_edit_info(record_drive(small_drive(), folder.path()).log);
  EXPECT_NE(info.find("Observations format               : Yes"), std::string::npos) << info;
  EXPECT_NE(info.find("All sensor labels                 : CAMERA1, GPS, IMU"), std::string::npos)
      << info;
  // 5 images, GGA and RMC, the 50 readings up to and past the last image.
  EXPECT_NE(info.find("Overall number of objects         : 57"), std::string::npos) << info;
}

TEST(DriveRecorder, RecordsAreInTheOrderOfTime) {
  const TemporaryFolder folder;
  const auto log = test::read_with_mrpt(record_drive(small_drive(), folder.path()).log);
  for (std::size_t i = 1; i < log.size(); ++i) {
    EXPECT_LE(log[i - 1]->timestamp, log[i]->timestamp) << i;
  }
}

TEST(DriveRecorder, PosesAreThoseOfTheCameraFromTheFirstOn) {
  const TemporaryFolder folder;
  const DriveRecording drive = small_drive();
  std::istringstream rows(test::read_text(record_drive(drive, folder.path()).poses));
  int count = 0;
  for (std::string line; std::getline(rows, line); ++count) {
    std::istringstream numbers(line);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (int k = 0; k < 12; ++k) numbers >> T(k / 4, k % 4);
    ASSERT_FALSE(numbers.fail()) << line;
    const auto i = static_cast<std::size_t>(count);
    EXPECT_TRUE((drive.T_world_cam[0] * T).isApprox(drive.T_world_cam[i], 1e-8)) << line;
    // 0.8 m forward per frame; the camera looks 5° upwards, so the way leads 5° down its own axis.
    EXPECT_NEAR(T.translation().z(), 0.8 * count * std::cos(5.0 * kDegree), 1e-6);
    EXPECT_NEAR(T.translation().y(), 0.8 * count * std::sin(5.0 * kDegree), 1e-6);
  }
  EXPECT_EQ(count, kFrames);
}

TEST(DriveRecorder, WritesStereoOnRequest) {
  const TemporaryFolder folder;
  DriveRecording drive = small_drive();
  drive.baseline_m = 0.12;
  const RecordedDrive files = record_drive(drive, folder.path());
  const auto pairs =
      test::only<mrpt::obs::CObservationStereoImages>(test::read_with_mrpt(files.log));
  ASSERT_EQ(pairs.size(), static_cast<std::size_t>(kFrames));
  EXPECT_NEAR(pairs[0]->rightCameraPose.x(), 0.12, 1e-12);
  const auto right = files.images / pairs[2]->imageRight.getExternalStorageFile();
  EXPECT_NEAR(cv::imread(right.string(), cv::IMREAD_UNCHANGED).at<unsigned char>(9, 9), 140, 1);
}

TEST(DriveRecorder, FilesDoNotDependOnTheNumberOfThreads) {
  const TemporaryFolder one;
  const TemporaryFolder many;
  DriveRecording drive = small_drive();
  const RecordedDrive first = record_drive(drive, one.path());
  drive.threads = 4;
  const RecordedDrive second = record_drive(drive, many.path());
  EXPECT_EQ(test::read_text(first.log), test::read_text(second.log));
  EXPECT_EQ(test::read_text(first.poses), test::read_text(second.poses));
  for (const std::string& name : test::names_in(first.images)) {
    EXPECT_EQ(test::read_text(first.images / name), test::read_text(second.images / name)) << name;
  }
}

TEST(DriveRecorder, EndsEarlyWithCompleteFiles) {
  const TemporaryFolder folder;
  DriveRecording drive = small_drive();
  drive.keep_going = [](std::size_t done) { return done < 2; };
  const RecordedDrive files = record_drive(drive, folder.path());
  const auto log = test::read_with_mrpt(files.log);
  EXPECT_EQ(test::only<mrpt::obs::CObservationImage>(log).size(), 2U);
  const std::string poses = test::read_text(files.poses);
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 2);
}

TEST(DriveRecorder, TheSourceReadsBackImagesTiltAndHeight) {
  for (const MountConvention convention : {MountConvention::x_forward, MountConvention::optical}) {
    const TemporaryFolder folder;
    DriveRecording drive = small_drive();
    drive.convention = convention;
    SourceOptions options;
    options.log = record_drive(drive, folder.path()).log;
    RawlogSource source(options);
    int count = 0;
    while (auto ticket = source.next()) {
      const CameraFrame frame = source.load(*ticket);
      const Tilt tilt = tilt_from_mounting(frame.T_vehicle_cam.linear());
      EXPECT_NEAR(tilt.pitch_up, 5.0 * kDegree, 1e-6) << to_string(convention);
      EXPECT_NEAR(frame.T_vehicle_cam.translation().z(), 1.5, 1e-9);
      EXPECT_NEAR(frame.image.row(5)[5], 10 * count + 20, 1);
      ++count;
    }
    EXPECT_EQ(count, kFrames);
  }
}

TEST(DriveRecorder, RefusesPosesThatDoNotMatchTheFrames) {
  const TemporaryFolder folder;
  DriveRecording drive = small_drive();
  drive.T_world_cam.pop_back();
  EXPECT_THROW(record_drive(drive, folder.path()), std::invalid_argument);
}

TEST(DriveRecorder, NamesAFolderThatCannotBeWrittenTo) {
  const std::string text = test::complaint_of([] { record_drive(small_drive(), "/proc/nowhere"); });
  EXPECT_NE(text.find("/proc/nowhere"), std::string::npos) << text;
}

}  // namespace
}  // namespace oneac
