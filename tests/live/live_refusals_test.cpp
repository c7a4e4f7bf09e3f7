#include "live_support.h"

#include <mrpt/img/CImage.h>

#include <cmath>
#include <limits>

namespace oneac {
namespace {

using mrpt::obs::CObservationImage;

/// Spoils the drive in one way; feed() and run must say the same of it.
class LiveRefusals : public LiveFixture {
 protected:
  using Change = std::function<void(CObservationImage&, int)>;

  /// What both say behind the place, that of the program and that of feed().
  void expect_both_say(const std::string& words, const Change& change) const {
    const auto log = changed_log(change);
    const ProgramResult run =
        run_program({ONEAC_PROGRAM, "run", log.string(), "-o", (scratch() / "out").string(),
                     "--images-dir", images().string(), "--no-progress"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    Observations observations = read_log(scratch() / "changed.rawlog");
    const std::string fed = refusal_of_feed(observations);
    EXPECT_NE(fed.find(words), std::string::npos) << fed;
  }
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNan = std::nan("");

TEST_F(LiveRefusals, NoCalibration) {
  for (const double focal : {0.0, -300.0, kInfinity, kNan}) {
    expect_both_say("carries no calibration", [&](CObservationImage& image, int) {
      image.cameraParams.setIntrinsicParamsFromValues(focal, 310, 200, 150);
    });
  }
  expect_both_say("carries no calibration", [](CObservationImage& image, int) {
    image.cameraParams.setIntrinsicParamsFromValues(310, 310, kNan, 150);
  });
}

TEST_F(LiveRefusals, LensesThatNoModelDescribes) {
  expect_both_say("the fisheye lens has more than four terms", [](CObservationImage& image, int) {
    image.cameraParams.distortion = mrpt::img::DistortionModel::kannala_brandt;
    image.cameraParams.dist = {-0.1, 0.1, 0, 0, 0.01, 0.2, 0.1, 0.05};  // the rational model's
  });
  expect_both_say("the lens has terms that are no numbers", [](CObservationImage& image, int) {
    image.cameraParams.distortion = mrpt::img::DistortionModel::plumb_bob;
    image.cameraParams.dist = {kNan, 0, 0, 0, 0, 0, 0, 0};
  });
}

TEST_F(LiveRefusals, ACalibrationThatChanges) {
  expect_both_say("changes here; cut the log there", [](CObservationImage& image, int number) {
    if (number >= 4) image.cameraParams.setIntrinsicParamsFromValues(600, 600, 200, 150);
  });
}

TEST_F(LiveRefusals, ImagesOfAnotherSizeThanTheCalibration) {
  expect_both_say("but its calibration is for 800x600", [](CObservationImage& image, int) {
    image.cameraParams.ncols = 800;
    image.cameraParams.nrows = 600;
  });
}

TEST_F(LiveRefusals, ImagesWhoseSizeChanges) {
  expect_both_say("the size of the images changes within the log",
                  [](CObservationImage& image, int number) {
                    image.cameraParams.ncols = image.cameraParams.nrows = 0;
                    if (number == 12) image.image = mrpt::img::CImage(64, 48, mrpt::img::CH_GRAY);
                  });
}

TEST_F(LiveRefusals, ImagesWithoutTimeStamp) {
  expect_both_say("the image has no time stamp", [](CObservationImage& image, int number) {
    if (number == 4) image.timestamp = INVALID_TIMESTAMP;
  });
}

TEST_F(LiveRefusals, APoseThatIsDamaged) {
  expect_both_say("the pose of the camera is damaged", [](CObservationImage& image, int number) {
    if (number == 4) image.cameraPose.x(kNan);
  });
}

}  // namespace
}  // namespace oneac
