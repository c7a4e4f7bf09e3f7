// Calibration files as their tools write them, one camera in all of them.
#include "log_maker.h"

#include "oneac/rawlog/calibration.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/img/TCamera.h>

#include <opencv2/core.hpp>

#include <array>

namespace oneac {
namespace {

constexpr std::array<double, 8> kPlumbBob{-0.28, 0.07, 0.0002, -0.0003, 0.01, 0, 0, 0};
constexpr std::array<double, 8> kRational{-0.28, 0.07, 0.0002, -0.0003, 0.01, 0.1, 0.02, 0.003};
constexpr std::array<double, 8> kFisheye{-0.01, 0.002, -0.003, 0.0004, 0, 0, 0, 0};

class CalibrationFormats : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& content) {
    test::write_bytes(folder_.path() / name, content);
    return (folder_.path() / name).string();
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }
  std::string fault(const std::string& name, const std::string& content) {
    const std::string what = file(name, content);
    return test::input_error([&] { static_cast<void>(load_calibration(what, "")); });
  }
  static void expect_camera(const std::string& what, const std::array<double, 8>& distortion,
                            LensModel lens = LensModel::plumb_bob) {
    const PinholeCamera camera = load_calibration(what, "left");
    EXPECT_EQ(camera.width, 752) << what;
    EXPECT_EQ(camera.height, 480) << what;
    EXPECT_DOUBLE_EQ(camera.fx, 458.654) << what;
    EXPECT_DOUBLE_EQ(camera.fy, 457.296) << what;
    EXPECT_DOUBLE_EQ(camera.cx, 367.215) << what;
    EXPECT_DOUBLE_EQ(camera.cy, 248.375) << what;
    EXPECT_EQ(camera.distortion, distortion) << what;
    EXPECT_EQ(camera.lens, lens) << what;
  }

  TemporaryFolder folder_;
};

/// What OpenCV's calibration program stores.
void write_with_opencv(const std::string& name, const std::array<double, 8>& distortion, int terms,
                       bool fisheye) {
  const cv::Matx33d K(458.654, 0, 367.215, 0, 457.296, 248.375, 0, 0, 1);
  cv::FileStorage storage(name, cv::FileStorage::WRITE);
  storage << "calibration_time"
          << "Thu Oct 26 10:00:00 2023";
  storage << "image_width" << 752 << "image_height" << 480 << "flags" << 0;
  storage << "fisheye_model" << (fisheye ? 1 : 0) << "camera_matrix" << cv::Mat(K);
  storage << "distortion_coefficients"
          << cv::Mat(terms, 1, CV_64F, const_cast<double*>(distortion.data())).clone();
  storage << "avg_reprojection_error" << 0.21;
}

TEST_F(CalibrationFormats, OpenCvYamlAndXml) {
  for (const char* name : {"camera.yml", "camera.yaml", "camera.xml"}) {
    write_with_opencv(path(name), kPlumbBob, 5, false);
    expect_camera(path(name), kPlumbBob);
    write_with_opencv(path(name), kRational, 8, false);
    expect_camera(path(name), kRational);
    write_with_opencv(path(name), kFisheye, 4, true);
    expect_camera(path(name), kFisheye, LensModel::kannala_brandt);
  }
}

TEST_F(CalibrationFormats, OpenCvStereoIntrinsics) {
  const cv::Matx33d M1(400, 0, 320, 0, 401, 240, 0, 0, 1), M2(500, 0, 310, 0, 501, 230, 0, 0, 1);
  {
    cv::FileStorage storage(path("intrinsics.yml"), cv::FileStorage::WRITE);
    storage << "M1" << cv::Mat(M1) << "D1" << cv::Mat(cv::Vec<double, 5>(0.1, 0, 0, 0, 0));
    storage << "M2" << cv::Mat(M2) << "D2" << cv::Mat(cv::Vec<double, 5>(0.2, 0, 0, 0, 0));
  }
  EXPECT_DOUBLE_EQ(load_calibration(path("intrinsics.yml") + ":M2", "").fx, 500);
  EXPECT_DOUBLE_EQ(load_calibration(path("intrinsics.yml") + ":M1", "").distortion[0], 0.1);
  EXPECT_EQ(load_calibration(path("intrinsics.yml") + ":M1", "").width, 0);
  EXPECT_NE(test::input_error([&] {
              static_cast<void>(load_calibration(path("intrinsics.yml"), "left"));
            }).find("M1, M2"),
            std::string::npos);
}

std::string camera_info(const std::string& model, const std::string& coefficients,
                        const std::string& columns) {
  return "image_width: 752\nimage_height: 480\ncamera_name: narrow_stereo\ncamera_matrix:\n"
         "  rows: 3\n  cols: 3\n  data: [458.654, 0, 367.215, 0, 457.296, 248.375, 0, 0, 1]\n"
         "distortion_model: " +
         model + "\ndistortion_coefficients:\n  rows: 1\n  cols: " + columns + "\n  data: [" +
         coefficients +
         "]\nrectification_matrix:\n  rows: 3\n  cols: 3\n"
         "  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nprojection_matrix:\n  rows: 3\n  cols: 4\n"
         "  data: [435.5, 0, 371.5, 0, 0, 436.5, 250.5, 0, 0, 0, 1, 0]\n";
}

TEST_F(CalibrationFormats, RosCameraInfo) {
  const std::string five = "-0.28, 0.07, 0.0002, -0.0003, 0.01";
  expect_camera(file("a.yaml", camera_info("plumb_bob", five, "5")), kPlumbBob);
  expect_camera(file("b.yaml", "\xEF\xBB\xBF" + camera_info("rational_polynomial",
                                                            five + ", 0.1, 0.02, 0.003", "8")),
                kRational);
  const std::string fisheye = "-0.01, 0.002, -0.003, 0.0004";
  expect_camera(file("c.yaml", camera_info("equidistant", fisheye, "4")), kFisheye,
                LensModel::kannala_brandt);
  const PinholeCamera rectified = load_calibration(path("a.yaml") + ":projection", "");
  EXPECT_DOUBLE_EQ(rectified.fx, 435.5);
  EXPECT_DOUBLE_EQ(rectified.cy, 250.5);
  EXPECT_FALSE(rectified.is_distorted());
}

TEST_F(CalibrationFormats, RosCameraInfoAsRostopicEchoes) {
  expect_camera(file("echo.txt",
                     "header: \n  seq: 0\n  stamp: \n    secs: 0\n    nsecs: 1\n"
                     "  frame_id: \"cam\"\nheight: 480\nwidth: 752\n"
                     "distortion_model: \"plumb_bob\"\n"
                     "D: [-0.28, 0.07, 0.0002, -0.0003, 0.01]\n"
                     "K: [458.654, 0.0, 367.215, 0.0, 457.296, 248.375, 0.0, 0.0, 1.0]\n"
                     "R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n"
                     "P: [458.6, 0.0, 367.2, 0.0, 0.0, 457.2, 248.3, 0.0, 0.0, 0.0, 1.0, 0.0]\n"
                     "binning_x: 0\n---\n"),
                kPlumbBob);
}

TEST_F(CalibrationFormats, MrptSectionsAndYaml) {
  mrpt::img::TCamera camera;
  camera.ncols = 752;
  camera.nrows = 480;
  camera.setIntrinsicParamsFromValues(458.654, 457.296, 367.215, 248.375);
  const auto written = [&] {
    mrpt::config::CConfigFileMemory memory;
    camera.saveToConfigFile("CAMERA", memory);
    return memory.getContent();
  };
  camera.distortion = mrpt::img::DistortionModel::plumb_bob;
  camera.dist = kRational;
  expect_camera(file("plumb.ini", "\xEF\xBB\xBF" + written()), kRational);
  camera.setDistortionKannalaBrandt(-0.01, 0.002, -0.003, 0.0004);
  expect_camera(file("fisheye.ini", written()), kFisheye, LensModel::kannala_brandt);
  expect_camera(file("eight.ini",
                     "[CAMERA]\nresolution=[752 480]\nfx=458.654\nfy=457.296\ncx=367.215\n"
                     "cy=248.375\ndistortion=kannala_brandt\n"
                     "dist=[-0.01 0.002 0 0 -0.003 0.0004 0 0]\n"),
                kFisheye, LensModel::kannala_brandt);
}

std::string camchain(const std::string& model, const std::string& coefficients) {
  return "cam0:\n  cam_overlaps: [1]\n  camera_model: pinhole\n  distortion_coeffs: [" +
         coefficients + "]\n  distortion_model: " + model +
         "\n  intrinsics: [458.654, 457.296, 367.215, 248.375]\n  resolution: [752, 480]\n"
         "  rostopic: /cam0/image_raw\ncam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.11]\n"
         "  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n"
         "  camera_model: omni\n  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n"
         "  distortion_model: radtan\n  intrinsics: [0.8, 457, 456, 379, 255]\n"
         "  resolution: [752, 480]\n";
}

TEST_F(CalibrationFormats, KalibrCamchain) {
  std::array<double, 8> four = kPlumbBob;
  four[4] = 0.0;
  const auto radtan = file("camchain.yaml", camchain("radtan", "-0.28, 0.07, 0.0002, -0.0003"));
  expect_camera(radtan + ":cam0", four);
  const auto equi = file("equi.yaml", camchain("equidistant", "-0.01, 0.002, -0.003, 0.0004"));
  expect_camera(equi + ":cam0", kFisheye, LensModel::kannala_brandt);
  const auto said = [&](const std::string& what) {
    return test::input_error([&] { static_cast<void>(load_calibration(what, "")); });
  };
  EXPECT_NE(said(radtan + ":cam1").find("the camera model 'omni' is not supported"),
            std::string::npos);
  EXPECT_NE(said(radtan).find("cam0, cam1"), std::string::npos);
  EXPECT_NE(fault("unsaid.yaml",
                  "cam0:\n  camera_model: pinhole\n  intrinsics: [458, 457, 367, 248]\n"
                  "  distortion_coeffs: [-0.28, 0.07, 0, 0]\n  resolution: [752, 480]\n")
                .find("distortion_model is missing"),
            std::string::npos);
}

TEST_F(CalibrationFormats, EurocSensor) {
  std::array<double, 8> four = kPlumbBob;
  four[4] = 0.0;
  expect_camera(file("sensor.yaml",
                     "# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0\n"
                     "T_BS:\n  cols: 4\n  rows: 4\n  data: [0.01, -0.99, 0.004, -0.02,\n"
                     "    0.99, 0.01, 0.02, -0.06,\n    -0.02, 0.003, 0.99, 0.009,\n"
                     "    0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nresolution: [752, 480]\n"
                     "camera_model: pinhole\nintrinsics: [458.654, 457.296, 367.215, 248.375]\n"
                     "distortion_model: radial-tangential\n"
                     "distortion_coefficients: [-0.28, 0.07, 0.0002, -0.0003]\n"),
                four);
}

TEST_F(CalibrationFormats, ColmapCountsFromTheCornerOfTheImage) {
  const std::string head =
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n# Number of cameras: 1\n";
  const std::string size = " 752 480 458.654 457.296 367.715 248.875";
  expect_camera(file("cameras.txt", head + "1 FULL_OPENCV" + size +
                                        " -0.28 0.07 0.0002 -0.0003 0.01 0.1 0.02 0.003\n"),
                kRational);
  expect_camera(
      file("fisheye.txt", head + "7 OPENCV_FISHEYE" + size + " -0.01 0.002 -0.003 0.0004\n"),
      kFisheye, LensModel::kannala_brandt);
  const auto simple = file("simple.txt", "1 SIMPLE_RADIAL 752 480 458 376 240 -0.1\r\n");
  const PinholeCamera camera = load_calibration(simple, "");
  EXPECT_DOUBLE_EQ(camera.fy, 458);
  EXPECT_DOUBLE_EQ(camera.cx, 375.5);
  EXPECT_DOUBLE_EQ(camera.distortion[0], -0.1);
  EXPECT_NE(fault("a.txt", "1 FOV 752 480 4 4 3 2 0.9\n").find("line 1: the camera model 'FOV'"),
            std::string::npos);
  EXPECT_NE(fault("b.txt", head + "1 OPENCV 752 480 4 4 3 2\n").find("line 4: OPENCV has 4"),
            std::string::npos);
}

TEST_F(CalibrationFormats, OrbSlamSettings) {
  const std::string four = "fx: 458.654\nPfy: 457.296\nPcx: 367.215\nPcy: 248.375\n";
  const auto with = [](std::string text, const std::string& prefix) {
    for (auto at = text.find('P'); at != std::string::npos; at = text.find('P', at + 1)) {
      text.replace(at, 1, prefix);
    }
    return prefix + text;
  };
  const std::string lens = "Pk1: -0.28\nPk2: 0.07\nPp1: 0.0002\nPp2: -0.0003\nPk3: 0.01\n";
  expect_camera(file("orb2.yaml", "%YAML:1.0\n\n# Camera\n" + with(four + lens, "Camera.") +
                                      "Camera.width: 752\nCamera.height: 480\nCamera.fps: 20.0\n"
                                      "ORBextractor.nFeatures: 1000\n"),
                kPlumbBob);
  expect_camera(
      file("orb3.yaml",
           "%YAML:1.0\nFile.version: \"1.0\"\nCamera.type: \"KannalaBrandt8\"\n" +
               with(four + "Pk1: -0.01\nPk2: 0.002\nPk3: -0.003\nPk4: 0.0004\n", "Camera1.") +
               "Camera.width: 752\nCamera.height: 480\nCamera.newWidth: 376\n"),
      kFisheye, LensModel::kannala_brandt);
  EXPECT_NE(fault("half.yaml", "%YAML:1.0\nCamera.fx: 458.0\n").find("Camera.fy is missing"),
            std::string::npos);
}

TEST_F(CalibrationFormats, KittiRawRectifiedAndRaw) {
  const auto name =
      file("calib_cam_to_cam.txt",
           "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\n"
           "S_00: 1.392000e+03 5.120000e+02\n"
           "K_00: 9.842439e+02 0.0 6.9e+02 0.0 9.808141e+02 2.331966e+02 0.0 0.0 1.0\n"
           "D_00: -3.728755e-01 2.037299e-01 2.219027e-03 1.383707e-03 -7.2e-02\n"
           "R_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\n"
           "S_rect_00: 1.242000e+03 3.750000e+02\nR_rect_00: 1 0 0 0 1 0 0 0 1\n"
           "P_rect_00: 7.215377e+02 0 6.095593e+02 0 0 7.215377e+02 1.72854e+02 0 0 0 "
           "1 0\nS_rect_02: 1.242e+03 3.75e+02\n"
           "P_rect_02: 7.2e+02 0 6.1e+02 45 0 7.2e+02 1.7e+02 -0.2 0 0 1 0.002\n");
  const PinholeCamera rectified = load_calibration(name, "");
  EXPECT_EQ(rectified.width, 1242);
  EXPECT_DOUBLE_EQ(rectified.fx, 721.5377);
  EXPECT_FALSE(rectified.is_distorted());
  EXPECT_DOUBLE_EQ(load_calibration(name + ":P_rect_02", "").cx, 610);
  const PinholeCamera raw = load_calibration(name + ":K_00", "");
  EXPECT_EQ(raw.height, 512);
  EXPECT_DOUBLE_EQ(raw.distortion[4], -7.2e-02);
}

TEST_F(CalibrationFormats, SayInOneLineWhatIsWrong) {
  const std::string info = camera_info("plumb_bob", "0, 0, 0, 0, 0", "5");
  const auto without = [&](const std::string& what, const std::string& by) {
    std::string text = info;
    return text.replace(text.find(what), what.size(), by);
  };
  struct Case {
    std::string content, words;
  };
  const std::vector<Case> cases{
      {without("458.654", "abc"), "section [narrow_stereo]: camera_matrix.data holds 'abc'"},
      {without("458.654", ".nan"), "'.nan', which is not a number"},
      {without("458.654", "-458"), "focal length is not positive"},
      {without("458.654, 0,", "458.654, 9,"), "skewed pixels"},
      {without("458.654, ", ""), "camera_matrix.data has 8 numbers"},
      {without("plumb_bob", "thin_prism"), "the lens model 'thin_prism' is not supported"},
      {without("image_width: 752", "image_width: 0"), "not [width height]"},
      {without("image_width: 752\n", ""), "image_width is missing"},
      {without("data: [458.654", "data: [[458.654"), "it is no YAML"},
      {info + "image_width: 752\n", "'image_width' is there twice"},
      {"%YAML:1.0\n---\nnothing: 1\n", "it holds no camera calibration"},
      {"<?xml version=\"1.0\"?>\n<opencv_storage>\n<camera_matrix", "it is no XML of OpenCV's"},
      {"<html>no</html>", "camera.yaml"},
      {"", "it holds no camera calibration"},
      {"&a [*a, *a]", "camera.yaml"}};
  for (const Case& c : cases) {
    const std::string said = fault("camera.yaml", c.content);
    EXPECT_NE(said.find("camera.yaml"), std::string::npos) << said;
    EXPECT_NE(said.find(c.words), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace oneac
