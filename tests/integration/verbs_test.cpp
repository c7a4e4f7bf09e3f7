#include "drive_fixture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class Verbs : public DriveFixture {};

TEST_F(Verbs, HelpNamesEveryVerbAndEachHasItsOwn) {
  const ProgramResult all = oneac_program({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  for (const char* verb : {"info", "run", "calibrate", "import", "simulate", "eval"}) {
    EXPECT_NE(all.out.find(verb), std::string::npos) << verb;
    EXPECT_EQ(oneac_program({verb, "--help"}).exit_code, 0) << verb;
  }
}

TEST_F(Verbs, WrongUsageExitsWithTwo) {
  EXPECT_EQ(oneac_program({}).exit_code, 2);
  EXPECT_EQ(oneac_program({"fly"}).exit_code, 2);
  EXPECT_EQ(oneac_program({"run", "--no-such-flag"}).exit_code, 2);
  EXPECT_EQ(oneac_program({"run", log(), "-o", out(), "--every", "two"}).exit_code, 2);
}

TEST_F(Verbs, VersionNamesReleaseAndCommit) {
  const ProgramResult result = oneac_program({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("0.1.0 ("), std::string::npos) << result.out;
}

TEST_F(Verbs, InfoTellsSensorsImagesAndTilt) {
  const ProgramResult result = oneac_program({"info", log()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* words :
       {"CAMERA1", "8 of 8 present", "5.0° upward", "x_forward", "GPS", "IMU"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << words << " not in\n" << result.out;
  }
}

TEST_F(Verbs, SimulateWritesTheTrueLoopsOfABlockAndOfNothingElse) {
  const std::vector<std::string> small{"--width", "64", "--height", "48",    "--focal",   "50",
                                       "--fps",   "1",  "--route",  "block", "--block-m", "40"};
  std::vector<std::string> arguments{"simulate", "-o", out(), "--laps", "2"};
  arguments.insert(arguments.end(), small.begin(), small.end());
  const ProgramResult result = oneac_program(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string loops = read_file(fs::path(out()) / "loops_true.csv");
  EXPECT_EQ(loops.rfind("index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz\n", 0), 0U) << loops;
  EXPECT_GT(std::count(loops.begin(), loops.end(), '\n'), 10) << loops;
  EXPECT_FALSE(fs::exists(drive() / "loops_true.csv"));
}

TEST_F(Verbs, SimulateRefusesLapsWithoutABlock) {
  const ProgramResult laps = oneac_program({"simulate", "-o", out(), "--laps", "2"});
  EXPECT_EQ(laps.exit_code, 2);
  EXPECT_NE(laps.err.find("--route block"), std::string::npos) << laps.err;
  const ProgramResult relit = oneac_program({"simulate", "-o", out(), "--relight"});
  EXPECT_EQ(relit.exit_code, 2);
  EXPECT_NE(relit.err.find("--relight"), std::string::npos) << relit.err;
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Verbs, RawlogEditReadsTheSimulatedLog) {
  const ProgramResult result = run_program({"rawlog-edit", "--info", "-i", log()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("CAMERA1"), std::string::npos) << result.out;
}

TEST_F(Verbs, EvalOfTheTruthAgainstItselfIsZero) {
  const std::string poses = (drive() / "poses.txt").string();
  const ProgramResult result = oneac_program({"eval", poses, poses, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("ape"), std::string::npos) << result.out;
  EXPECT_FALSE(nlohmann::json::parse(result.out).empty());
}

TEST_F(Verbs, EvalSaysWhereAnOffsetCountsForNothing) {
  const std::string truth = (drive() / "poses.txt").string();
  const ProgramResult result = oneac_program({"eval", truth, truth, "--offset", "5"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("offset counts for nothing"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
}

TEST_F(Verbs, ImportKittiMakesALogThatRunsAndThatMrptReads) {
  const fs::path source = scratch() / "kitti";
  fs::create_directories(source / "image_0");
  int count = 0;
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(drive() / "Images"))
    images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  for (const fs::path& image : images) {
    char name[16];
    std::snprintf(name, sizeof name, "%06d.jpg", count++);
    fs::copy(image, source / "image_0" / name);
  }
  write_text(source / "calib.txt", "P0: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
  fs::copy(drive() / "poses.txt", source / "poses.txt");
  const std::string imported = (scratch() / "k.rawlog").string();
  const ProgramResult import = oneac_program({"import", "kitti", source.string(), "-o", imported});
  ASSERT_EQ(import.exit_code, 0) << import.err;
  EXPECT_EQ(run_program({"rawlog-edit", "--info", "-i", imported}).exit_code, 0);
  const ProgramResult run = oneac_program({"run", imported, "-o", out()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(read_file(fs::path(out()) / "summary.json"));
  EXPECT_EQ(json["counts"]["frames"], kFrames);
  EXPECT_FALSE(json["reference"]["errors"].is_null());
}

TEST_F(Verbs, ImportRefusesAnEmptyFolder) {
  fs::create_directories(scratch() / "empty");
  for (const char* kind : {"kitti", "malaga"}) {
    const ProgramResult result = oneac_program(
        {"import", kind, (scratch() / "empty").string(), "-o", (scratch() / "x.rawlog").string()});
    EXPECT_EQ(result.exit_code, 2) << kind;
    EXPECT_NE(result.err.find("empty"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(scratch() / "x.rawlog"));
  }
}

}  // namespace
}  // namespace oneac
