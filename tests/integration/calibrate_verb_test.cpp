#include "rewritten_log.h"

#include "oneac/test_support/program.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace oneac {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

double value_of(const std::string& ini, const std::string& key) {
  const auto at = ini.find("\n" + key + " = ");
  if (at == std::string::npos) return 0.0;
  return std::stod(ini.substr(at + key.size() + 4));
}

class CalibrateVerb : public ::testing::Test {
 protected:
  /// A drive whose camera has f 250 px and c (159.5, 119.5).
  std::string simulate(std::vector<std::string> flags) {
    std::vector<std::string> command = {ONEAC_PROGRAM, "simulate", "-o",       folder("drive"),
                                        "--width",     "320",      "--height", "240",
                                        "--focal",     "250",      "--stop",   "0"};
    command.insert(command.end(), flags.begin(), flags.end());
    EXPECT_EQ(run_program(command).exit_code, 0);
    return folder("drive") + "/simulated.rawlog";
  }
  /// A calibration of it with another focal length and lens. @return the file
  [[nodiscard]] std::string camera(const std::string& name, const std::string& focal,
                                   const std::string& lens) const {
    const std::string file = folder(name + ".ini");
    std::ofstream(file) << "[CAMERA_PARAMS]\nresolution = [320 240]\ncx = 159.5\ncy = 119.5\nfx = "
                        << focal << "\nfy = " << focal << "\n"
                        << lens;
    return file;
  }
  [[nodiscard]] std::string folder(const std::string& name) const {
    return (scratch_.path() / name).string();
  }

 private:
  TemporaryFolder scratch_;
};

TEST_F(CalibrateVerb, FindsTheCameraFromAFieldOfViewAndRunReadsItBack) {
  const std::string log = simulate({"--frames", "110"});
  const std::string ini = folder("camera.ini");
  const ProgramResult result =
      run_program({ONEAC_PROGRAM, "calibrate", log, "-o", ini, "--fov-deg", "80"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("% in f"), std::string::npos) << result.out;
  const std::string text = text_of(ini);
  EXPECT_NEAR(value_of(text, "fx"), 250.0, 250.0 * 0.015) << text;
  EXPECT_NEAR(value_of(text, "cx"), 159.5, 3.0) << text;
  EXPECT_NE(text_of(folder("report.html")).find("Residuals by image region"), std::string::npos);
  const ProgramResult run = run_program({ONEAC_PROGRAM, "run", log, "-o", folder("out"), "--count",
                                         "5", "--calibration", ini, "--no-progress"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto summary = nlohmann::json::parse(text_of(folder("out") + "/summary.json"));
  EXPECT_EQ(summary["camera"]["fx_px"].get<double>(), value_of(text, "fx"));
}

TEST_F(CalibrateVerb, SaysThatAStraightRoadCannotTell) {
  const std::string log = simulate({"--frames", "30", "--route", "straight"});
  const ProgramResult result =
      run_program({ONEAC_PROGRAM, "calibrate", log, "-o", folder("camera.ini")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("cannot tell the focal length"), std::string::npos) << result.out;
  EXPECT_EQ(value_of(text_of(folder("camera.ini")), "fx"), 250.0);
}

TEST_F(CalibrateVerb, GyroscopeAndCourseAreSetAgainstTheTurnsByImages) {
  const std::string log = simulate({"--frames", "400", "--seed", "3"});
  const ProgramResult result =
      run_program({ONEAC_PROGRAM, "calibrate", log, "-o", folder("camera.ini"), "--passes", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string said = "gyroscope against the turns by images: f ";
  const auto at = result.out.find(said);
  ASSERT_NE(at, std::string::npos) << result.out;
  EXPECT_NEAR(std::stod(result.out.substr(at + said.size())), 0.0, 0.3) << result.out;
  EXPECT_NE(result.out.find("GPS course against"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("bends, gyroscope, GPS course)"), std::string::npos) << result.out;
}

/// The log again with rates of its IMU in deg/s.
void write_rates_in_degrees(const std::string& log, const std::string& copy) {
  rewrite_log(log, copy, [](mrpt::obs::CObservation& observation) {
    auto* imu = dynamic_cast<mrpt::obs::CObservationIMU*>(&observation);
    if (imu == nullptr) return;
    for (const auto rate : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ}) {
      imu->set(rate, imu->get(rate) * 180.0 / M_PI);
    }
  });
}

TEST_F(CalibrateVerb, AGyroscopeOfAnotherUnitIsNamedByRunToo) {
  const std::string log = simulate({"--frames", "110"});
  const std::string wrong = folder("drive") + "/degrees.rawlog";
  write_rates_in_degrees(log, wrong);
  const std::string said =
      "the gyroscope does not turn with the images: they turn as it does about its +Z axis in "
      "deg/s";
  const auto run = [&](const std::string& of) {
    return run_program({ONEAC_PROGRAM, "run", of, "-o", folder("out"), "--images-dir",
                        folder("drive") + "/Images", "--no-progress"});
  };
  const ProgramResult right = run(log);
  ASSERT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(right.err.find("gyroscope"), std::string::npos) << right.err;
  const ProgramResult degrees = run(wrong);
  ASSERT_EQ(degrees.exit_code, 0) << degrees.err;
  EXPECT_NE(degrees.err.find(said), std::string::npos) << degrees.err;
  const ProgramResult calibrated =
      run_program({ONEAC_PROGRAM, "calibrate", wrong, "-o", folder("camera.ini"), "--passes", "1"});
  ASSERT_EQ(calibrated.exit_code, 0) << calibrated.err;
  EXPECT_NE(calibrated.out.find(said), std::string::npos) << calibrated.out;
}

TEST_F(CalibrateVerb, HeightIsToldByWhatTellsMetresAndRunTakesIt) {
  const std::string log = simulate({"--frames", "110", "--silent-mount", "--camera-height", "2.0",
                                    "--route", "straight", "--odometry"});
  const ProgramResult result =
      run_program({ONEAC_PROGRAM, "calibrate", log, "-o", folder("camera.ini")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("GPS speed: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("wheels: "), std::string::npos) << result.out;
  const std::string said = "camera is ";
  const auto at = result.out.find(said);
  ASSERT_NE(at, std::string::npos) << result.out;
  EXPECT_NEAR(std::stod(result.out.substr(at + said.size())), 2.0, 0.06) << result.out;
  const ProgramResult run = run_program({ONEAC_PROGRAM, "run", log, "-o", folder("out"), "--count",
                                         "5", "--calibration", folder("camera.ini"), "--params",
                                         folder("camera_height.yaml"), "--no-progress"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto summary = nlohmann::json::parse(text_of(folder("out") + "/summary.json"));
  EXPECT_NEAR(summary["camera_height_m"].get<double>(), 2.0, 0.06);
}

TEST_F(CalibrateVerb, HeightThatTheLogContradictsSaysSo) {
  const std::string log = simulate({"--frames", "110", "--route", "straight"});
  // Lengths by the road are as the focal length, so the height comes out too small.
  const std::string wrong = camera("wrong", "310", "dist = [0 0 0 0 0]\n");
  const ProgramResult result = run_program(
      {ONEAC_PROGRAM, "calibrate", log, "-o", folder("camera.ini"), "--calibration", wrong});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("the log's sensor pose says 1.50 m"), std::string::npos) << result.out;
}

TEST_F(CalibrateVerb, HeightIsNotWrittenWhereNothingTellsMetres) {
  const std::string log = simulate({"--frames", "12", "--route", "straight"});
  const std::string file = folder("camera_height.yaml");
  std::ofstream(file) << "# mine\n";
  const std::vector<std::string> command = {ONEAC_PROGRAM, "calibrate", log, "-o",
                                            folder("camera.ini")};
  const ProgramResult refused = run_program(command);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("camera_height.yaml"), std::string::npos) << refused.err;
  EXPECT_EQ(text_of(file), "# mine\n");
  std::ofstream(file) << "# made by oneac calibrate of another drive\n";
  const ProgramResult result = run_program(command);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("height of the camera not told"), std::string::npos) << result.out;
  EXPECT_FALSE(std::filesystem::exists(file)) << "of another drive";
}

TEST_F(CalibrateVerb, DoesNotOverwriteTheReportOfARun) {
  const std::string log = simulate({"--frames", "8"});
  ASSERT_EQ(run_program({ONEAC_PROGRAM, "run", log, "-o", folder("out")}).exit_code, 0);
  const std::string before = text_of(folder("out") + "/report.html");
  const ProgramResult result =
      run_program({ONEAC_PROGRAM, "calibrate", log, "-o", folder("out") + "/camera.ini"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("report.html"), std::string::npos) << result.err;
  EXPECT_EQ(text_of(folder("out") + "/report.html"), before);
}

TEST_F(CalibrateVerb, DoesNotReplaceItsLog) {
  const std::string log = simulate({"--frames", "8"});
  const std::string before = text_of(log);
  const ProgramResult result = run_program({ONEAC_PROGRAM, "calibrate", log, "-o", log});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("is the log"), std::string::npos) << result.err;
  EXPECT_EQ(text_of(log), before);
}

TEST_F(CalibrateVerb, RunThatLearnsWritesTheCameraItUsedAndTouchesNoOther) {
  const std::string log = simulate({"--frames", "8"});
  const std::string out = folder("out"), ini = out + "/camera.ini";
  std::filesystem::create_directory(out);
  const std::string own =
      "[CAMERA_PARAMS]\nresolution = [320 240]\ncx = 159.5\ncy = 119.5\n"
      "fx = 250\nfy = 250\ndist = [0 0 0 0 0]\n";
  std::ofstream(ini) << own;
  const std::vector<std::string> plain = {ONEAC_PROGRAM, "run", log, "-o", out};
  ASSERT_EQ(run_program(plain).exit_code, 0);
  EXPECT_EQ(text_of(ini), own);
  std::vector<std::string> learning = plain;
  learning.insert(learning.end(), {"--set", "front_end.calibration.refine=focal"});
  const ProgramResult refused = run_program(learning);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("camera.ini"), std::string::npos) << refused.err;
  EXPECT_EQ(text_of(ini), own);
  std::filesystem::remove(ini);
  ASSERT_EQ(run_program(learning).exit_code, 0);
  EXPECT_EQ(value_of(text_of(ini), "fx"), 250.0);
  EXPECT_EQ(text_of(ini).rfind("// used by oneac run", 0), 0U) << text_of(ini);
  ASSERT_EQ(run_program(plain).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(ini));
}

TEST_F(CalibrateVerb, CameraThatARunHasLearnedIsReadBackAsTheSame) {
  const std::string log = simulate({"--frames", "110"});
  const std::string wrong = camera("wrong", "290", "dist = [0 0 0 0 0]\n");
  const std::string out = folder("out");
  ASSERT_EQ(run_program({ONEAC_PROGRAM, "run", log, "-o", out, "--calibration", wrong, "--set",
                         "front_end.calibration.refine=focal", "--set",
                         "front_end.calibration.focal_sigma=0.2"})
                .exit_code,
            0);
  const auto learned = nlohmann::json::parse(text_of(out + "/summary.json"))["camera"];
  ASSERT_EQ(learned["self_calibration"]["used"], "learned");
  const std::string ini = text_of(out + "/camera.ini");
  EXPECT_NEAR(value_of(ini, "fx"), learned["self_calibration"]["focal_used_last_px"].get<double>(),
              1e-9);
  EXPECT_NEAR(value_of(ini, "fx"), 250.0, 6.0) << ini;
}

TEST_F(CalibrateVerb, LensThatARunHasLearnedIsItsCameraIni) {
  const std::string log = simulate({"--frames", "240"});
  const std::string wrong = camera("wrong", "250", "dist = [0.12 0 0 0 0]\n");
  const std::string out = folder("out");
  ASSERT_EQ(run_program({ONEAC_PROGRAM, "run", log, "-o", out, "--calibration", wrong, "--set",
                         "front_end.calibration.refine=full"})
                .exit_code,
            0);
  const std::string ini = text_of(out + "/camera.ini");
  EXPECT_NE(ini.find("k1 and k2 learned"), std::string::npos) << ini;
  const auto at = ini.find("dist = [");
  ASSERT_NE(at, std::string::npos) << ini;
  EXPECT_NEAR(std::stod(ini.substr(at + 8)), 0.0, 0.03) << ini;
  const auto said = nlohmann::json::parse(
      text_of(out + "/summary.json"))["camera"]["self_calibration"]["raw_camera_by_bends"];
  EXPECT_NEAR(said["k1"].get<double>(), 0.0, 0.03);
  EXPECT_GT(said["k1_sigma"].get<double>(), 0.0);
  EXPECT_LT(said["k1_sigma"].get<double>(), 0.03);
}

TEST_F(CalibrateVerb, FisheyeOfARunIsWrittenAsOne) {
  const std::string log = simulate({"--frames", "110"});
  const std::string fisheye =
      camera("fisheye", "250",
             "distortion = kannala_brandt\ndist = [0.3 0 0 0 0 0 0 0]\n");  // near a pinhole, tan θ
  const std::string ini = folder("camera.ini");
  const ProgramResult result = run_program(
      {ONEAC_PROGRAM, "calibrate", log, "-o", ini, "--calibration", fisheye, "--passes", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("fisheye with k3 = 0"), std::string::npos) << result.out;
  const std::string text = text_of(ini);
  EXPECT_NE(text.find("distortion = kannala_brandt"), std::string::npos) << text;
  EXPECT_NEAR(value_of(text, "fx"), 250.0, 250.0 * 0.03) << text;
  EXPECT_EQ(run_program({ONEAC_PROGRAM, "run", log, "-o", folder("out"), "--calibration", ini,
                         "--count", "5"})
                .exit_code,
            0);
}

TEST_F(CalibrateVerb, RefusesAFieldOfViewThatNoCameraHas) {
  const ProgramResult fisheye =
      run_program({ONEAC_PROGRAM, "calibrate", "a.rawlog", "-o", folder("camera.ini"), "--fisheye",
                   "--fov-deg", "230"});
  EXPECT_EQ(fisheye.exit_code, 2);
  EXPECT_NE(fisheye.err.find("to 220"), std::string::npos) << fisheye.err;
  const ProgramResult result = run_program(
      {ONEAC_PROGRAM, "calibrate", "a.rawlog", "-o", folder("camera.ini"), "--fov-deg", "200"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--fov-deg"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace oneac
