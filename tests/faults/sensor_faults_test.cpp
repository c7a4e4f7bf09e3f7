#include "fault_fixture.h"

#include <mrpt/obs/CObservationIMU.h>

#include <nlohmann/json.hpp>

#include <limits>

namespace oneac {
namespace {

using test::external_image;

class SensorFaults : public FaultFixture {
 protected:
  static mrpt::obs::CObservationIMU::Ptr imu(double seconds) {
    auto observation = mrpt::obs::CObservationIMU::Create();
    observation->sensorLabel = "IMU";
    observation->timestamp = test::rmc(seconds, 0, 0)->timestamp;
    observation->set(mrpt::obs::IMU_X_ACC, 0.0);
    observation->set(mrpt::obs::IMU_Y_ACC, 0.0);
    observation->set(mrpt::obs::IMU_Z_ACC, 9.81);
    return observation;
  }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(file_content(out() / "summary.json"));
  }
};

TEST_F(SensorFaults, DuplicatedAndOutOfOrderStampsAreLeftOutAndSaid) {
  test::Objects frames = textured_frames(6);
  const auto stamp = [&](std::size_t i) -> auto& {
    return dynamic_cast<mrpt::obs::CObservation&>(*frames[i]).timestamp;
  };
  stamp(2) = stamp(1);
  stamp(4) = stamp(0);
  test::write_log(log(), frames);
  expect_exit(run(), 0, {"2 images do not lie after the one before in time"});
  EXPECT_EQ(poses_written(), 4U);
}

TEST_F(SensorFaults, ImagesThatRepeatTheOneBeforeAreLeftOutAndSaid) {
  test::Objects frames = textured_frames(6);
  for (const int i : {2, 3}) {
    const auto at = static_cast<std::size_t>(i);
    frames[at] = external_image("CAM", 0.1 * i, "frame_1.png");
  }
  test::write_log(log(), frames);
  expect_exit(run(), 0, {"2 images repeat the one before, pixel by pixel (first: frame_1.png)"});
  EXPECT_EQ(poses_written(), 4U);
  EXPECT_EQ(summary().at("counts").at("images_repeated"), 2);
}

TEST_F(SensorFaults, OfTwoInterleavedCamerasOneIsChosenAndFollowed) {
  const test::Objects a = textured_frames(5);
  test::Objects both;
  for (int i = 0; i < 5; ++i) {
    both.push_back(a[static_cast<std::size_t>(i)]);
    both.push_back(external_image("OTHER", 0.1 * i + 0.05, "frame_0.png"));
  }
  test::write_log(log(), both);
  expect_exit(run(), 2, {"several cameras", "--camera", "'CAM', 'OTHER'"});
  expect_exit(run({"--camera", "CAM"}), 0, {});
  EXPECT_EQ(poses_written(), 5U);
}

TEST_F(SensorFaults, CalibrationOfAnotherAspectIsRefused) {
  test::write_log(log(), textured_frames(3));
  test::write_bytes(scratch() / "large.ini",
                    "[CAM]\nresolution=[1024 512]\ncx=500\ncy=250\nfx=900\nfy=900\ndist=[0 0]\n");
  expect_exit(run({"--calibration", (scratch() / "large.ini").string()}), 2,
              {"64x48", "1024x512", "--calibration"});
}

// Who has rectified images beside a log with the raw calibration must be able to notice.
TEST_F(SensorFaults, UndistortingByTheLogIsSaid) {
  const auto image = test::stored_image("CAM", 0, textured(0));
  image->cameraParams.setDistortionPlumbBob(-0.3, 0.1, 0, 0);
  test::write_log(log(), {image});
  EXPECT_NE(run().out.find("images undistorted by the calibration in the log"), std::string::npos);
  test::write_bytes(scratch() / "calib.txt", "P0: 60 0 31 0 0 61 23 0 0 0 1 0\n");
  const ProgramResult given = run({"--calibration", (scratch() / "calib.txt").string()});
  EXPECT_EQ(given.exit_code, 0) << given.err;
  EXPECT_EQ(given.out.find("undistorted"), std::string::npos) << given.out;
}

TEST_F(SensorFaults, NumbersThatAreNoneInGpsReachNoResult) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  test::Objects objects = textured_frames(6);
  for (const double bad : {kNan, kInfinity, 1e300, -1e300}) {
    objects.push_back(test::gga(0.1, bad, -4.4, 70));
    objects.push_back(test::gga(0.2, 36.7, bad, 70));
    objects.push_back(test::gga(0.3, 36.7, -4.4, bad));
    objects.push_back(test::rmc(0.4, bad, 90));
    objects.push_back(test::rmc(0.5, 10, bad));
  }
  test::write_log(log(), objects);
  expect_exit(run({"--set", "front_end.scale.source=gps"}), 0, {});
  EXPECT_EQ(poses_written(), 6U);
  for (const std::string& name : file_names(out())) {
    const std::string content = file_content(out() / name);
    for (const char* word : {"nan", "inf "}) {
      EXPECT_EQ(content.find(std::string(" ") + word), std::string::npos) << word << " in " << name;
    }
  }
}

TEST_F(SensorFaults, WithoutGpsTheRunIsTheSameWithoutAComparison) {
  test::write_log(log(), textured_frames(4));
  expect_exit(run(), 0, {});
  EXPECT_EQ(poses_written(), 4U);
  EXPECT_FALSE(summary().contains("gps"));
}

TEST_F(SensorFaults, ImuBesideImagesIsEnoughForTheTilt) {
  test::Objects objects{imu(0.0)};
  for (const auto& frame : textured_frames(4)) objects.push_back(frame);
  test::write_log(log(), objects);
  expect_exit(run({"--set", "front_end.tilt.source=imu"}), 0, {});
  EXPECT_EQ(poses_written(), 4U);
}

TEST_F(SensorFaults, ALogOfAnImuOnlyIsRefused) {
  test::write_log(log(), {imu(0.0), imu(0.01)});
  expect_exit(run(), 2, {"no camera images", "IMU (CObservationIMU)"});
  EXPECT_FALSE(std::filesystem::exists(out() / "summary.json"));
}

TEST_F(SensorFaults, ALogOfOneImageGivesOnePose) {
  test::write_log(log(), textured_frames(1));
  expect_exit(run(), 0, {});
  EXPECT_EQ(poses_written(), 1U);
}

TEST_F(SensorFaults, ASelectionWithoutImagesIsNoSuccess) {
  test::write_log(log(), textured_frames(3));
  expect_exit(run({"--first", "10"}), 2, {"--first", "3 images"});
}

}  // namespace
}  // namespace oneac
