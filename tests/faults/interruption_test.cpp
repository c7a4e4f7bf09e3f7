#include "fault_fixture.h"

#include "oneac/evaluation/relative_poses_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

namespace oneac {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 600;
constexpr unsigned kSeed = 7;  // of the moments, as shares of the whole run's CPU time

// Of the whole run's CPU time: sooner no signal is waited for, and the measured time may be half as
// long again as usual on a busy machine.
constexpr double kSoonest = 0.2, kLater = 0.06;

class Interruption : public FaultFixture {
 protected:
  void SetUp() override {
    test::write_log(log(), textured_frames(kFrames));
    const ProgramResult whole = run({"--quiet"});
    ASSERT_EQ(whole.exit_code, 0);
    whole_s_ = whole.cpu_seconds;
  }

  /// The run into a folder of its own, given a signal after a share of the whole run's CPU time.
  [[nodiscard]] ProgramResult run_with(int signal, double share, const fs::path& folder) const {
    std::vector<std::string> command = run_command({"--quiet"});
    command[4] = folder.string();
    return ended_by(signal, share, command);
  }
  /// Any command, given a signal after a share of the whole run's CPU time.
  [[nodiscard]] ProgramResult ended_by(int signal, double share,
                                       const std::vector<std::string>& command) const {
    RunningProgram program(command);
    while (!program.has_ended() && program.cpu_seconds() < share * whole_s_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    program.send(signal);
    return program.wait();
  }
  /// The same, given when the first of the results appears.
  [[nodiscard]] ProgramResult run_until_it_writes(int signal, const fs::path& folder) const {
    std::vector<std::string> command = run_command({"--quiet"});
    command[4] = folder.string();
    RunningProgram program(command);
    while (!program.has_ended() && !fs::exists(folder / "trajectory_camera.kitti")) {
      std::this_thread::yield();
    }
    program.send(signal);
    return program.wait();
  }

  /// Every file is that of the whole run; what a killed program was writing has another name.
  void expect_whole_files(const fs::path& folder) const {
    for (const std::string& name : file_names(folder)) {
      const bool of_this_run = name == "timings.csv" || name == "summary.json" ||
                               name == "report.html" || name.find(".part") != std::string::npos;
      if (of_this_run) continue;
      EXPECT_EQ(file_content(folder / name), file_content(out() / name)) << name;
    }
  }
  /// The files belong together and hold what the summary says.
  static void expect_consistent_files(const fs::path& folder) {
    const auto summary = nlohmann::json::parse(file_content(folder / "summary.json"));
    const std::string poses = file_content(folder / "trajectory_camera.kitti");
    const auto rows = static_cast<std::size_t>(std::count(poses.begin(), poses.end(), '\n'));
    EXPECT_EQ(read_relative_poses(folder / "relative_poses.csv").size() + 1, rows);
    EXPECT_EQ(summary.at("counts").at("frames").get<std::size_t>(), rows);
    for (const std::string& name : file_names(folder)) {
      EXPECT_EQ(name.find(".part"), std::string::npos) << name;
    }
  }

  double whole_s_ = 0.0;
};

TEST_F(Interruption, AKilledRunLeavesWholeFilesOrNone) {
  std::mt19937 moments(kSeed);
  for (int i = 0; i < 8; ++i) {
    const double share = static_cast<double>(moments() % 1000U) / 1000.0;
    SCOPED_TRACE("killed after " + std::to_string(share) + " of the time");
    const fs::path folder = scratch() / ("killed" + std::to_string(i));
    static_cast<void>(run_with(SIGKILL, share, folder));
    expect_whole_files(folder);
  }
}

TEST_F(Interruption, ARunKilledWhileItWritesLeavesWholeFiles) {
  for (int i = 0; i < 5; ++i) {
    const fs::path folder = scratch() / ("writing" + std::to_string(i));
    static_cast<void>(run_until_it_writes(SIGKILL, folder));
    expect_whole_files(folder);
    EXPECT_TRUE(fs::exists(folder / "trajectory_camera.kitti"));
  }
}

TEST_F(Interruption, AnInterruptedRunFinishesItsFiles) {
  std::mt19937 moments(kSeed);
  std::size_t interrupted = 0;
  for (int i = 0; i < 10; ++i) {
    const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
    const double share = static_cast<double>(moments() % 1000U) / 1000.0;
    SCOPED_TRACE("signal " + std::to_string(signal) + " after " + std::to_string(share));
    const fs::path folder = scratch() / ("interrupted" + std::to_string(i));
    const ProgramResult result = run_with(signal, share, folder);
    // Before it is ready for signals it ends as any program, without a file; behind the last frame
    // it is done.
    if (result.exit_code == 128 + signal) {
      EXPECT_TRUE(file_names(folder).empty());
      continue;
    }
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.exit_code << result.err;
    if (result.exit_code == 1) {
      ++interrupted;
      EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
    }
    if (!file_names(folder).empty()) expect_consistent_files(folder);
  }
  EXPECT_GT(interrupted, 0U) << "no signal met the work";
}

TEST_F(Interruption, OfSeveralLogsLeavesNoEmptyFolderAndSaysThatNothingWasSearched) {
  const fs::path second = scratch() / "second.rawlog";
  test::write_log(second, textured_frames(kFrames));
  bool met_the_first = false;
  for (int i = 0; i < 30 && !met_the_first; ++i) {
    const double share = kSoonest + kLater * i;
    SCOPED_TRACE("after " + std::to_string(share));
    const fs::path folder = scratch() / ("logs" + std::to_string(i));
    const ProgramResult result =
        ended_by(SIGINT, share,
                 {ONEAC_PROGRAM, "run", log().string(), second.string(), "-o", folder.string(),
                  "--loops", "--global-ba", "--quiet"});
    if (result.exit_code != 1) continue;
    const auto summary = nlohmann::json::parse(file_content(folder / "summary.json"));
    met_the_first = summary["logs"].size() == 1 && fs::exists(folder / "1" / "summary.json");
    if (!met_the_first) continue;  // before its first frame, or in the second
    EXPECT_FALSE(fs::exists(folder / "2"));
    EXPECT_EQ(summary["loops"]["global_ba"]["reason"], "the search for loops was not finished");
  }
  EXPECT_TRUE(met_the_first) << "no signal met the first log";
}

TEST_F(Interruption, OfADriveSaysThatLoopsWereNotLookedFor) {
  bool met_the_drive = false;
  for (int i = 0; i < 30 && !met_the_drive; ++i) {
    const double share = kSoonest + kLater * i;
    SCOPED_TRACE("after " + std::to_string(share));
    const fs::path folder = scratch() / ("loops" + std::to_string(i));
    const ProgramResult result = ended_by(
        SIGINT, share,
        {ONEAC_PROGRAM, "run", log().string(), "-o", folder.string(), "--loops", "--no-progress"});
    met_the_drive = result.exit_code == 1 && fs::exists(folder / "summary.json");
    if (!met_the_drive) continue;  // before its first frame
    EXPECT_NE(result.out.find("no loops: the search for them did not come to its end"),
              std::string::npos)
        << result.out;
    EXPECT_EQ(result.out.find("0 loops of"), std::string::npos) << result.out;
  }
  EXPECT_TRUE(met_the_drive) << "no signal met the drive";
}

TEST_F(Interruption, AComparisonKilledAgainAndAgainGivesTheSameBytes) {
  const auto command = [&](const fs::path& folder) -> std::vector<std::string> {
    return {ONEAC_PROGRAM,   "compare",        log().string(),          "-o",
            folder.string(), "--initialisers", "1ac_pooled,2pc_ground", "--quiet",
            "--no-progress"};
  };
  const fs::path once = scratch() / "once";
  ASSERT_EQ(run_program(command(once)).exit_code, 0);
  const fs::path again = scratch() / "again";
  std::mt19937 moments(kSeed);
  for (int i = 0; i < 8; ++i) {
    RunningProgram program(command(again));
    std::this_thread::sleep_for(std::chrono::milliseconds(100 + moments() % 400U));
    program.send(i % 2 == 0 ? SIGKILL : SIGTERM);
    static_cast<void>(program.wait());
  }
  ASSERT_EQ(run_program(command(again)).exit_code, 0);
  EXPECT_EQ(file_content(again / "pairs.csv"), file_content(once / "pairs.csv"));
}

}  // namespace
}  // namespace oneac
