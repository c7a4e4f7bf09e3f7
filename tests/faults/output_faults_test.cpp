#include "fault_fixture.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace oneac {
namespace {

namespace fs = std::filesystem;

class OutputFaults : public FaultFixture {
 protected:
  static bool is_torn(const std::string& name) { return name.find(".part") != std::string::npos; }
};

// A file that may not grow beyond a few bytes fails as one on a full disk does.
TEST_F(OutputFaults, AFullDiskDuringRunLeavesWholeFilesAndOneLine) {
  test::write_log(log(), textured_frames(12));
  ASSERT_EQ(run().exit_code, 0);
  // Room for the message on stderr, which is a file too.
  for (const std::size_t room : {400U, 1000U, 3000U}) {
    SCOPED_TRACE("room for " + std::to_string(room) + " bytes");
    const fs::path full = scratch() / ("full" + std::to_string(room));
    std::vector<std::string> command = run_command({"--quiet"});
    command[4] = full.string();
    const ProgramResult result = RunningProgram(command, room).wait();
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("cannot be written"), std::string::npos) << result.err;
    for (const std::string& name : file_names(full)) {
      EXPECT_FALSE(is_torn(name)) << name;
      if (name.rfind("timings", 0) == 0) continue;
      EXPECT_EQ(file_content(full / name), file_content(out() / name)) << name;
    }
    EXPECT_EQ(run_program(command).exit_code, 0) << "what is left there is a run's";
  }
}

TEST_F(OutputFaults, AFullDiskDuringSimulateIsNoSuccess) {
  const ProgramResult result =
      RunningProgram({ONEAC_PROGRAM, "simulate", "-o", out().string(), "--frames", "3"}, 4000)
          .wait();
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("cannot be written"), std::string::npos) << result.err;
  EXPECT_EQ(file_names(out()), std::vector<std::string>{"Images"});
  EXPECT_TRUE(file_names(out() / "Images").empty());
}

// zlib holds the last bytes back until the file is closed.
TEST_F(OutputFaults, AFullDiskWhileALogIsWrittenLeavesNoLog) {
  const fs::path sequence = scratch() / "sequence";
  fs::create_directories(sequence / "images");
  for (int i = 0; i < 80; ++i) {
    const std::string name = std::to_string(i * 7919) + ".png";
    cv::imwrite((sequence / "images" / name).string(), cv::Mat(48, 64, CV_8U, cv::Scalar(9)));
  }
  test::write_bytes(sequence / "calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n");
  const std::vector<std::string> command{ONEAC_PROGRAM,     "import", "kitti",
                                         sequence.string(), "-o",     log().string()};
  ASSERT_EQ(run_program(command).exit_code, 0);
  const std::size_t size = fs::file_size(log());
  ASSERT_GT(size, 1000U);
  fs::remove(log());
  for (const std::size_t room : {size / 2, size - 1}) {
    const ProgramResult result = RunningProgram(command, room).wait();
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_NE(result.err.find("cannot be written"), std::string::npos) << result.err;
    for (const std::string& name : file_names(scratch())) {
      EXPECT_TRUE(name == "sequence") << name;
    }
  }
}

TEST_F(OutputFaults, AFullDiskDuringCompareIsNoSuccess) {
  test::write_log(log(), textured_frames(4));
  const ProgramResult result =
      RunningProgram({ONEAC_PROGRAM, "compare", log().string(), "-o", out().string(),
                      "--initialisers", "1ac_pooled", "--quiet"},
                     600)
          .wait();
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("free some space"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(out() / "report.html"));
}

TEST_F(OutputFaults, AResultThatCannotBePrintedIsNoSuccess) {
  test::write_log(log(), textured_frames(2));
  const std::string command =
      std::string(ONEAC_PROGRAM) + " info '" + log().string() + "' > /dev/full";
  const ProgramResult result = run_program({"sh", "-c", command});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
}

TEST_F(OutputFaults, AFolderWhereNobodyMayWriteIsRefusedBeforeTheWork) {
  test::write_log(log(), textured_frames(2));
  for (const char* verb : {"run", "compare"}) {
    const ProgramResult result =
        run_program({ONEAC_PROGRAM, verb, log().string(), "-o", "/proc/oneac"});
    expect_exit(result, 2, {"/proc/oneac", "output folder", "-o"});
  }
}

TEST_F(OutputFaults, AFolderInThePlaceOfAResultIsNamed) {
  test::write_log(log(), textured_frames(2));
  fs::create_directories(out() / "summary.json" / "in the way");
  expect_exit(run(), 2, {"summary.json", "is a folder"});
  EXPECT_EQ(file_names(out()), std::vector<std::string>{"summary.json"}) << "before the work";
}

}  // namespace
}  // namespace oneac
