#include "oneac/observations/camera_reader.h"

#include "log_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

double grey_at(double u, double v) {
  return 128.0 + 60.0 * std::sin(0.05 * u) + 40.0 * std::cos(0.07 * v);
}

GreyImage smooth_image(int width, int height) {
  GreyImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      image.row(v)[u] = static_cast<std::uint8_t>(std::lround(grey_at(u, v)));
    }
  }
  return image;
}

/// Where a direction (x, y, 1) falls, by the models' formulas.
Eigen::Vector2d distorted(const PinholeCamera& camera, const Eigen::Vector2d& x) {
  const auto& k = camera.distortion;
  const double r = x.norm(), q = r * r;
  if (camera.lens == LensModel::kannala_brandt) {
    const double a = std::atan(r), b = a * a;
    const double d = a * (1 + b * (k[0] + b * (k[1] + b * (k[2] + b * k[3]))));
    return camera.project(r > 0.0 ? Eigen::Vector2d(x * (d / r)) : x);
  }
  const double radial =
      (1 + q * (k[0] + q * (k[1] + q * k[4]))) / (1 + q * (k[5] + q * (k[6] + q * k[7])));
  const double xy = x.x() * x.y();
  return camera.project({x.x() * radial + 2 * k[2] * xy + k[3] * (q + 2 * x.x() * x.x()),
                         x.y() * radial + k[2] * (q + 2 * x.y() * x.y()) + 2 * k[3] * xy});
}

/// A reader of images whose calibration is given.
CameraReader reader_with(const PinholeCamera& camera, double fov_deg = 0.0) {
  CameraReaderOptions options;
  options.calibration = camera;
  options.undistorted_fov_deg = fov_deg;
  return {CameraDescription::of(camera_views(*test::external_pair("PAIR", 0, "a")).front()),
          options, "record 0"};
}

/// Each pixel of the undistorted image is the one that its direction falls on.
void expect_undistorts(const PinholeCamera& camera) {
  const CameraReader reader = reader_with(camera);
  const GreyImage image = reader.rectify(smooth_image(camera.width, camera.height), "a");
  const PinholeCamera pinhole = reader.rectified_camera(image);
  EXPECT_FALSE(pinhole.is_distorted());
  int compared = 0;
  for (int v = 0; v < image.height(); v += 7) {
    for (int u = 0; u < image.width(); u += 7) {
      const Eigen::Vector2d at = distorted(camera, pinhole.normalise({u, v}));
      const bool inside =
          at.x() > 1 && at.y() > 1 && at.x() < camera.width - 2 && at.y() < camera.height - 2;
      if (!inside) continue;
      ++compared;
      EXPECT_NEAR(image.row(v)[u], grey_at(at.x(), at.y()), 2.0) << u << ' ' << v;
    }
  }
  EXPECT_GT(compared, 1000);
}

PinholeCamera fisheye() {
  PinholeCamera camera{640, 480, 220, 221, 318, 242, {-0.01, 0.002, -0.003, 0.0004}};
  camera.lens = LensModel::kannala_brandt;
  return camera;
}

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

TEST(CameraReader, UndistortsEachLensByItsFormula) {
  expect_undistorts({640, 480, 400, 402, 318, 242, {-0.3, 0.1, 0.001, -0.002, -0.01}});
  expect_undistorts(
      {640, 480, 400, 402, 318, 242, {0.2, 0.05, 0.001, -0.002, 0.01, 0.5, 0.1, 0.02}});
  expect_undistorts(fisheye());
}

TEST(CameraReader, LeavesOutTheRimThatItsLensDoesNotSee) {
  const PinholeCamera pincushion{640, 480, 400, 402, 318, 242, {0.3, 0.1, 0, 0, 0}};
  const CameraReader reader = reader_with(pincushion);
  const GreyImage white = reader.rectify(GreyImage(640, 480, 255), "a");
  const GreyImage unused = reader.unused(white, {}, "none");
  ASSERT_EQ(unused.width(), 640);
  EXPECT_EQ(unused.row(242)[318], 255);
  for (int v = 0; v < 480; v += 3) {
    for (int u = 0; u < 628; u += 3) {
      if (white.row(v)[u] == 255) continue;  // seen
      EXPECT_EQ(unused.row(v)[u], 0) << u << ' ' << v;
      EXPECT_EQ(unused.row(v)[u + 12], 0) << "corners there would stand still: " << u << ' ' << v;
    }
  }
  const PinholeCamera barrel{640, 480, 400, 402, 318, 242, {-0.2, 0.1, 0, 0, 0}};
  EXPECT_TRUE(reader_with(barrel).unused(white, {}, "none").empty()) << "its lens sees all of it";
}

TEST(CameraReader, JoinsTheRimWithTheMaskOfTheImage) {
  const CameraReader reader = reader_with({640, 480, 400, 402, 318, 242, {0.3, 0.1, 0, 0, 0}});
  GreyImage mask(640, 480, 255);
  for (int v = 200; v < 300; ++v) std::fill(mask.row(v) + 300, mask.row(v) + 340, 0);
  const GreyImage unused = reader.unused(GreyImage(640, 480), std::move(mask), "a mask");
  EXPECT_EQ(unused.row(242)[318], 0);
  EXPECT_EQ(unused.row(242)[200], 255);
  EXPECT_EQ(unused.row(2)[2], 0);
}

TEST(CameraReader, KeepsTheFocalLengthsOfALensThatLosesLittle) {
  const PinholeCamera camera{640, 480, 400, 402, 318, 242, {-0.2, 0.1, 0, 0, 0}};
  const PinholeCamera pinhole = reader_with(camera).rectified_camera(GreyImage(640, 480));
  EXPECT_EQ(pinhole.fx, camera.fx);
  EXPECT_EQ(pinhole.cy, camera.cy);
}

TEST(CameraReader, ChoosesAViewThatKeepsTheRoad) {
  PinholeCamera narrow = fisheye();
  narrow.fx = narrow.fy = 280;  // the lower edge looks 48° down: 113° across suffice
  const PinholeCamera pinhole = reader_with(narrow).rectified_camera(GreyImage(640, 480));
  const Eigen::Vector2d edge = pinhole.normalise({narrow.cx, 479});
  EXPECT_NEAR(distorted(narrow, edge).y(), 479, 1.0);
  EXPECT_DOUBLE_EQ(pinhole.fx, pinhole.fy);
  EXPECT_EQ(pinhole.cx, narrow.cx);
  PinholeCamera all_round = fisheye();
  all_round.fx = all_round.fy = 140;
  const PinholeCamera widest = reader_with(all_round).rectified_camera(GreyImage(640, 480));
  EXPECT_NEAR(320 / widest.fx, std::tan(60 * M_PI / 180), 1e-9);
}

TEST(CameraReader, GivesTheViewThatIsAskedFor) {
  const PinholeCamera pinhole = reader_with(fisheye(), 90).rectified_camera(GreyImage(640, 480));
  EXPECT_NEAR(pinhole.fx, 320, 1e-9);
  EXPECT_NEAR(pinhole.fy / pinhole.fx, 221.0 / 220.0, 1e-12);
  const PinholeCamera plain{640, 480, 400, 402, 318, 242, {}};
  EXPECT_EQ(reader_with(plain, 90).rectified_camera(GreyImage(640, 480)).fx, 400);
}

TEST(CameraReader, ScalesAGivenCalibrationToImagesOfTheSameAspectAndSaysSo) {
  const CameraReader reader = reader_with({128, 96, 100, 102, 63.5, 47.5, {-0.1}});
  EXPECT_EQ(reader.scaling_note(), "");
  const PinholeCamera camera = reader.rectified_camera(reader.rectify(GreyImage(64, 48), "a"));
  EXPECT_DOUBLE_EQ(camera.fx, 50);
  EXPECT_DOUBLE_EQ(camera.cy, 23.5);
  EXPECT_NE(reader.scaling_note().find("images are 64x48, their calibration is for 128x96"),
            std::string::npos)
      << reader.scaling_note();
  EXPECT_THROW(static_cast<void>(reader.rectify(GreyImage(128, 96), "b")), InputError);
}

TEST(CameraReader, RefusesToScaleToAnotherAspectOrACalibrationOfTheLog) {
  const CameraReader given = reader_with({128, 72, 100, 102, 63.5, 35.5, {}});
  const std::string said =
      test::input_error([&] { static_cast<void>(given.rectify(GreyImage(64, 48), "a")); });
  EXPECT_NE(said.find("is 64x48 but its calibration is for 128x72"), std::string::npos) << said;
  const auto pair = test::external_pair("PAIR", 0, "a");
  EXPECT_THROW(static_cast<void>(reader_of(*pair).rectify(GreyImage(128, 96), "a")), InputError);
}

TEST(CameraReader, TakesTheLensModelsOfMrpt) {
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(220, 221, 318, 242);
  camera.setDistortionKannalaBrandt(1, 2, 3, 4);
  const std::array<double, 8> four{1, 2, 3, 4};
  EXPECT_EQ(to_pinhole(camera, "").lens, LensModel::kannala_brandt);
  EXPECT_EQ(to_pinhole(camera, "").distortion, four);
  camera.dist = {1, 2, 3, 4, 0, 0, 0, 0};
  EXPECT_EQ(to_pinhole(camera, "").distortion, four);
  camera.dist = {1, 2, 3, 4, 5, 6, 0, 0};
  EXPECT_THROW(static_cast<void>(to_pinhole(camera, "")), InputError);
  camera.distortion = mrpt::img::DistortionModel::plumb_bob;
  camera.dist = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(to_pinhole(camera, "").distortion, camera.dist);
  EXPECT_EQ(to_pinhole(camera, "").lens, LensModel::plumb_bob);
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
