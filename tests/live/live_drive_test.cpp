#include "live_support.h"

#include <mrpt/img/CImage.h>
#include <mrpt/poses/CPose3D.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace oneac {
namespace {

using mrpt::obs::CObservationImage;

/// The picture in colours that have nothing of its grey: a shade of its own per channel.
cv::Mat coloured(const std::filesystem::path& file) {
  const cv::Mat grey = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  cv::Mat turned;
  cv::flip(grey, turned, 1);
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>{grey * 0.9, grey, 0.8 * grey + 0.2 * turned}, colour);
  return colour;
}

class LiveDrive : public LiveFixture {
 protected:
  void expect_same_as_run(const std::filesystem::path& log, const FrontEndOptions& options = {},
                          std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.end(), {"--images-dir", images().string()});
    expect_same(feed_all(read_log(log), options), run_all(log, arguments));
  }
};

TEST_F(LiveDrive, GivesThePosesOfRun) {
  expect_same_as_run(log());
}

TEST_F(LiveDrive, GivesThePosesOfRunThroughADistortingLens) {
  expect_same_as_run(changed_log([](CObservationImage& image, int) {
    image.cameraParams.distortion = mrpt::img::DistortionModel::plumb_bob;
    image.cameraParams.dist = {-0.05, 0.02, 0.001, -0.001, 0.003, 0.0, 0.0, 0.0};
  }));
}

TEST_F(LiveDrive, GivesThePosesOfRunWithOpticalSensorPoses) {
  const auto optical = changed_log([](CObservationImage& image, int) {
    image.cameraPose = image.cameraPose + mrpt::poses::CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  });
  expect_same_as_run(optical);
  FrontEndOptions options;
  options.mount_convention = "optical";
  expect_same_as_run(optical, options, {"--set", "source.mount_convention=optical"});
}

TEST_F(LiveDrive, GivesThePosesOfRunLevelledByTheImuAndScaledByGps) {
  FrontEndOptions options;
  options.tilt.source = "imu";
  options.scale.source = "gps";
  expect_same_as_run(log(), options,
                     {"--set", "front_end.tilt.source=imu", "--set", "front_end.scale.source=gps"});
}

TEST_F(LiveDrive, GivesThePosesOfRunInColourFiles) {
  const auto colours = scratch() / "colours";
  std::filesystem::create_directories(colours);
  for (const auto& entry : std::filesystem::directory_iterator(images())) {
    cv::imwrite((colours / entry.path().filename()).string(), coloured(entry.path()));
  }
  mrpt::img::CImage::setImagesPathBase(colours.string());
  expect_same(feed_all(read_log(log()), {}), run_all(log(), {"--images-dir", colours.string()}));
}

TEST_F(LiveDrive, GivesThePosesOfRunInColourImagesOfTheLog) {
  for (const bool raw : {true, false}) {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(raw);
    const auto log = changed_log([](CObservationImage& image, int) {
      const auto file = images() / image.image.getExternalStorageFile();
      image.image = mrpt::img::CImage(coloured(file), mrpt::img::DEEP_COPY);
    });
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
    expect_same_as_run(log);
  }
}

TEST_F(LiveDrive, LearnsTheCameraByGyroscopeAndCourseAsRunDoes) {
  const std::filesystem::path drive = scratch() / "bends";
  const ProgramResult made =
      run_program({ONEAC_PROGRAM, "simulate", "-o", drive.string(), "--frames", "400", "--seed",
                   "3", "--width", "320", "--height", "240", "--focal", "250", "--stop", "0"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  mrpt::img::CImage::setImagesPathBase((drive / "Images").string());
  FrontEndOptions options;
  options.self_calibration.refine = "focal";
  FrontEnd front_end(options);
  for (const auto& observation : read_log(drive / "simulated.rawlog")) front_end.feed(observation);
  front_end.finish();
  const CameraBelief& belief = front_end.camera_belief();
  EXPECT_EQ(belief.sensors, (std::vector<std::string>{"gyroscope", "GPS course"}));
  EXPECT_NEAR(belief.focal_px, 250.0, 250.0 * 0.005);
}

TEST_F(LiveDrive, CollectsTheSettledPosesOfEverySegment) {
  FrontEnd front_end{FrontEndOptions{}};
  const auto observations = read_log(log());
  std::size_t settled = 0, keyframes = 0;
  const auto finish = [&] {
    const Settled last = front_end.finish();
    settled += last.frames.size();
    keyframes += last.keyframes.size();
  };
  std::size_t segment = 0;
  for (const auto& observation : observations) {
    const auto result = front_end.feed(observation);
    if (!result) continue;
    settled += result->settled.frames.size();
    if (result->step) segment = result->step->segment;
    if (result->index == 6) finish();
  }
  EXPECT_EQ(segment, 1U);
  finish();
  EXPECT_GT(keyframes, 2U);
  const auto& poses = front_end.trajectory().poses();
  EXPECT_EQ(settled, poses.size());
  EXPECT_EQ(poses.size(), front_end.fed().images);
  for (const FramePose& pose : poses) EXPECT_TRUE(pose.settled);
}

}  // namespace
}  // namespace oneac
