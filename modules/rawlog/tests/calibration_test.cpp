#include "oneac/rawlog/calibration.h"

#include "log_maker.h"

#include "oneac/rawlog/calibration_writer.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

namespace oneac {
namespace {

constexpr const char* kTwoCameras = R"(# Stereo camera calibration report
[CAMERA_PARAMS_LEFT]
resolution = [1024 768]
cx         = 522.434637  // +/- 0.011
cy         = 402.367400
fx         = 837.619011
fy         = 839.808333
dist       = [-3.636834e-001 1.766205e-001 0.000000e+000 1.0e-003 -2.0e-3]    // [K1 K2 T1 T2 K3]
[CAMERA_PARAMS_RIGHT]
resolution=[800 600]
cx=404.00760
cy=309.05989
fx=621.18428
fy=621.18428
dist=[0.000000e+000 0.000000e+000 0.000000e+000 0.000000e+000 0.000000e+000]
[CAMERA_PARAMS_LEFT2RIGHT_POSE]
rotation_matrix_only = [1.0 0 0 ;0 1 0 ;0 0 1 ]
)";

class Calibration : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& content) {
    test::write_bytes(folder_.path() / name, content);
    return (folder_.path() / name).string();
  }
  static std::string fault(const std::string& what, const std::string& side) {
    return test::input_error([&] { static_cast<void>(load_calibration(what, side)); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Calibration, ReadsANamedSectionWithDistortion) {
  const auto camera = load_calibration(file("a=0.txt", kTwoCameras) + ":CAMERA_PARAMS_LEFT", "");
  EXPECT_EQ(camera.width, 1024);
  EXPECT_EQ(camera.height, 768);
  EXPECT_DOUBLE_EQ(camera.fx, 837.619011);
  EXPECT_DOUBLE_EQ(camera.fy, 839.808333);
  EXPECT_DOUBLE_EQ(camera.cx, 522.434637);
  EXPECT_DOUBLE_EQ(camera.cy, 402.3674);
  const std::array<double, 8> expected{-0.3636834, 0.1766205, 0.0, 0.001, -0.002};
  EXPECT_EQ(camera.distortion, expected);
}

TEST_F(Calibration, ChoosesTheSectionOfThePreferredSide) {
  const auto name = file("params.txt", kTwoCameras);
  EXPECT_EQ(load_calibration(name, "right").width, 800);
  EXPECT_FALSE(load_calibration(name, "right").is_distorted());
  EXPECT_EQ(load_calibration(name, "left").width, 1024);
}

TEST_F(Calibration, ListsTheSectionsWhenTheChoiceIsOpenOrTheSectionLacking) {
  const auto name = file("params.txt", kTwoCameras);
  for (const auto& message : {fault(name, ""), fault(name + ":NO_SUCH", "left")}) {
    EXPECT_NE(message.find("params.txt"), std::string::npos);
    EXPECT_NE(message.find("CAMERA_PARAMS_LEFT, CAMERA_PARAMS_RIGHT"), std::string::npos);
    EXPECT_EQ(message.find("LEFT2RIGHT"), std::string::npos);
  }
}

TEST_F(Calibration, ReadsWhatMrptWrites) {
  const auto name = file("camera.ini",
                         "[CAMERA]\nresolution = [640 480]\ncx = 320.5\ncy = 240\nfx = 500\n"
                         "fy = 501\ndist = [0.1 0 0 0 0 0 0 0]\ncamera_name = c\n"
                         "distortion = plumb_bob\n");
  const auto camera = load_calibration(name, "right");
  EXPECT_DOUBLE_EQ(camera.fy, 501);
  EXPECT_DOUBLE_EQ(camera.distortion[0], 0.1);
}

TEST_F(Calibration, ReadsWhatItWrites) {
  PinholeCamera camera{640, 480, 400.125, 401.0, 320.5, 239.75, {}, LensModel::plumb_bob};
  for (const LensModel lens : {LensModel::plumb_bob, LensModel::kannala_brandt}) {
    camera.lens = lens;
    camera.distortion = {-0.01, 0.002, -0.003, 0.0004};
    const auto read =
        load_calibration(file("own.ini", calibration_text(camera, {"by a test"})), "");
    EXPECT_EQ(read.lens, lens);
    EXPECT_EQ(read.distortion, camera.distortion);
    EXPECT_EQ(read.fx, camera.fx);
    EXPECT_EQ(read.cy, camera.cy);
  }
}

TEST_F(Calibration, RefusesOtherLensModels) {
  const std::string head = "[C]\nresolution=[640 480]\ncx=1\ncy=1\nfx=1\nfy=1\n";
  EXPECT_NE(fault(file("a", head + "distortion=double_sphere\n"), "").find("double_sphere"),
            std::string::npos);
  EXPECT_NE(fault(file("b", head + "dist=[0 0 0 0 0 0 0 0 1]\n"), "").find("beyond"),
            std::string::npos);
  const std::string fisheye = head + "distortion_model=kannala_brandt\n";
  EXPECT_NE(fault(file("c", fisheye + "dist=[0 0 1 1 1 0 0 0]\n"), "").find("beyond k1 k2 k3 k4"),
            std::string::npos);
}

TEST_F(Calibration, ReadsKittiProjections) {
  const auto name = file("calib.txt",
                         "P0: 7.2e+02 0 6.1e+02 0 0 7.3e+02 1.7e+02 0 0 0 1 0\n"
                         "P2: 700 0 600 45 0 700 180 -0.3 0 0 1 0.004\n"
                         "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_DOUBLE_EQ(load_calibration(name, "right").fx, 720);
  EXPECT_DOUBLE_EQ(load_calibration(name, "").cy, 170);
  EXPECT_DOUBLE_EQ(load_calibration(name + ":P2", "").cx, 600);
  EXPECT_EQ(load_calibration(name, "").width, 0);
  EXPECT_NE(fault(name + ":P1", "").find("P0, P2"), std::string::npos);
}

TEST_F(Calibration, NamesTheEntryThatIsMissingOrWrong) {
  EXPECT_NE(fault(file("a", "[C]\nfx=1\n"), "").find("resolution is missing"), std::string::npos);
  EXPECT_NE(fault(file("b", "[C]\nresolution=[640 480]\nfx=abc\n"), "").find("fx = 'abc'"),
            std::string::npos);
  EXPECT_NE(fault(file("c", "P0: 1 2 3\n"), "").find("twelve"), std::string::npos);
  EXPECT_NE(fault(file("d", "P0: 0 0 0 0 0 0 0 0 0 0 0 0\n"), "").find("focal"), std::string::npos);
  EXPECT_NE(fault(file("e", "nothing here\n"), "").find("no camera calibration"),
            std::string::npos);
  EXPECT_NE(fault("/nowhere/params.txt:LEFT", "").find("no such calibration file"),
            std::string::npos);
}

}  // namespace
}  // namespace oneac
