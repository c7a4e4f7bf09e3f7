#include "oneac/observations/camera_reader.h"

#include "log_maker.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

/// A reader of the left camera of a pair.
CameraReader reader_of(const mrpt::obs::CObservationStereoImages& pair,
                       const CameraReaderOptions& options = {}) {
  return {CameraDescription::of(camera_views(pair).front()), options, "record 0"};
}

TEST(CameraReader, RefusesAnotherCalibrationThanTheFirst) {
  const auto pair = test::external_pair("PAIR", 0, "a");
  const CameraReader reader = reader_of(*pair);
  reader.check_calibration(camera_views(*pair).front(), "record 1");
  const auto other = test::external_pair("PAIR", 1, "b");
  other->leftCamera.cx(33.0);
  const CameraView view = camera_views(*other).front();
  const std::string said = test::input_error([&] { reader.check_calibration(view, "record 2"); });
  EXPECT_NE(said.find("record 2: the calibration of camera 'PAIR/left' changes here"),
            std::string::npos)
      << said;
  CameraReaderOptions overridden;
  overridden.calibration = to_pinhole(pair->leftCamera, "");
  reader_of(*pair, overridden).check_calibration(view, "record 2");
}

TEST(CameraReader, MeasuresTheBaselineOfARectifiedPairOnly) {
  const auto pair = test::external_pair("PAIR", 0, "a");
  EXPECT_NEAR(reader_of(*pair).baseline(camera_views(*pair).back(), "record 0"), 0.12, 1e-12);
  pair->rightCamera.fx(70.0);
  EXPECT_THROW(static_cast<void>(reader_of(*pair).baseline(camera_views(*pair).back(), "")),
               InputError);
}

TEST(CameraReader, RefusesImagesWhoseSizeChangesWithoutASizeToGoBy) {
  const auto pair = test::external_pair("PAIR", 0, "a");
  pair->leftCamera.ncols = pair->leftCamera.nrows = 0;
  const CameraReader reader = reader_of(*pair);
  EXPECT_EQ(reader.rectify(GreyImage(64, 48, 9), "a").row(3)[3], 9);
  EXPECT_THROW(static_cast<void>(reader.rectify(GreyImage(32, 24), "b")), InputError);
}

TEST(CameraReader, KeepsTheConventionOfTheFirstPose) {
  const auto pair = test::external_pair("PAIR", 0, "a");  // x forward
  const CameraReader reader = reader_of(*pair);
  pair->cameraPose = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(0, 0, 0, 0, 0, 3.0));
  const auto mount = reader.mount(camera_views(*pair).front());
  EXPECT_NEAR(mount.linear()(0, 2), 1.0, 1e-9);  // still looks ahead
  EXPECT_GT(mount.linear()(2, 1), 0.9);          // and hangs upside down
}

TEST(CameraReader, TakesACalibrationThatIsRoundedFromImageToImage) {
  const auto pair = test::external_pair("PAIR", 0, "a");
  const CameraReader reader = reader_of(*pair);
  const auto rounded = test::external_pair("PAIR", 1, "b");
  rounded->leftCamera.fx(rounded->leftCamera.fx() + 1e-10);
  rounded->leftCamera.cy(rounded->leftCamera.cy() - 0.005);
  reader.check_calibration(camera_views(*rounded).front(), "record 1");
  rounded->leftCamera.fy(rounded->leftCamera.fy() + 0.02);
  const CameraView view = camera_views(*rounded).front();
  EXPECT_THROW(reader.check_calibration(view, "record 1"), InputError);
}

TEST(CameraReader, RefusesWhatNoCameraHas) {
  struct Case {
    double fx, fy, k1;
  };
  for (const Case& c :
       {Case{1e300, 60, 0}, Case{60, 1e-9, 0}, Case{60, 60, 1e9}, Case{60, 60, -1e9}}) {
    const auto pair = test::external_pair("PAIR", 0, "a");
    pair->leftCamera.fx(c.fx);
    pair->leftCamera.fy(c.fy);
    if (c.k1 != 0.0) pair->leftCamera.setDistortionPlumbBob(c.k1, 0, 0, 0);
    const std::string said = test::input_error([&] { static_cast<void>(reader_of(*pair)); });
    EXPECT_NE(said.find("no "), std::string::npos) << c.fx << ' ' << c.k1 << ": " << said;
    EXPECT_NE(said.find("--calibration"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace oneac
