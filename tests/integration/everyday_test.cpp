// What people do with files, folders, names and clocks.
#include "drive_fixture.h"
#include "rewritten_log.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kLatin1 =
    "stra\xdf"
    "e";
const std::string kShown =
    "stra\xef\xbf\xbd"
    "e";

class Everyday : public DriveFixture {
 protected:
  [[nodiscard]] fs::path copy_of_drive(const std::string& name) const {
    fs::copy(drive(), scratch() / name, fs::copy_options::recursive);
    return scratch() / name / "simulated.rawlog";
  }
  [[nodiscard]] ProgramResult run(const fs::path& path, std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"run", path.string(), "-o", out(), "--no-progress"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return oneac_program(arguments);
  }
  [[nodiscard]] Json summary() const {
    return Json::parse(read_file(fs::path(out()) / "summary.json"));
  }
  [[nodiscard]] std::ptrdiff_t rows() const {
    const std::string poses = read_file(fs::path(out()) / "trajectory_camera.kitti");
    return std::count(poses.begin(), poses.end(), '\n');
  }
  /// The drive's images as a KITTI folder, and its log.
  [[nodiscard]] fs::path imported() const {
    const fs::path folder = scratch() / "sequence";
    fs::create_directories(folder / "image_0");
    std::vector<fs::path> images;
    for (const auto& entry : fs::directory_iterator(drive() / "Images")) {
      images.push_back(entry.path());
    }
    std::sort(images.begin(), images.end());
    for (std::size_t i = 0; i < images.size(); ++i) {
      fs::copy(images[i], folder / "image_0" / (std::to_string(i) + ".jpg"));
    }
    write_text(folder / "calib.txt", "P0: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
    fs::copy(drive() / "poses.txt", folder / "poses.txt");
    const fs::path log = scratch() / "imported.rawlog";
    const ProgramResult made = oneac_program(
        {"import", "kitti", folder.string(), "-o", log.string(), "--camera-height", "1.5"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return log;
  }
};

void expect_refused(const ProgramResult& result, const std::vector<std::string>& words) {
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& word : words) {
    EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' not in " << result.err;
  }
}

TEST_F(Everyday, NamesThatAreNoUtf8GiveResultsAndAreShownWithReplacements) {
  const fs::path log = copy_of_drive(kLatin1);
  const fs::path folder = scratch() / ("out " + kLatin1);
  const ProgramResult result = oneac_program({"run", log.string(), "-o", folder.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(read_file(folder / "summary.json"));
  EXPECT_NE(summary["log"].get<std::string>().find(kShown), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  EXPECT_NE(result.out.find(kShown), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find(kLatin1), std::string::npos);
  const ProgramResult info = oneac_program({"info", log.string()});
  EXPECT_EQ(info.out.find(kLatin1), std::string::npos) << info.out;
  const fs::path poses = scratch() / (kLatin1 + ".txt");
  fs::copy(drive() / "poses.txt", poses);
  const ProgramResult compared =
      oneac_program({"compare", log.string(), "-o", (folder / "c").string(), "--reference",
                     poses.string(), "--initialisers", "5pc"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_NE(read_file(folder / "c" / "report.html").find(kShown), std::string::npos);
  const ProgramResult merged =
      oneac_program({"compare", "--merge", (folder / "c").string(), "-o", (folder / "m").string()});
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
}

TEST_F(Everyday, AFolderHoldsTheFilesOfOneRun) {
  ASSERT_EQ(run(log()).exit_code, 0);
  const fs::path folder(out());
  ASSERT_TRUE(fs::exists(folder / "keyframes.tum"));
  write_text(folder / "my notes.txt", "mine");
  ASSERT_EQ(run(log(), {"--count", "1"}).exit_code, 0);
  EXPECT_EQ(rows(), 1);
  for (const char* stale : {"graph.g2o", "map.simplemap", "points.ply", "mask.png"}) {
    if (!fs::exists(folder / stale)) continue;
    EXPECT_GE(fs::last_write_time(folder / stale), fs::last_write_time(folder / "tilt.csv"))
        << stale;
  }
  EXPECT_EQ(read_file(folder / "my notes.txt"), "mine");
}

TEST_F(Everyday, ARunReplacesNothingThatItReads) {
  const std::vector<std::string> learning{"--set", "front_end.calibration.refine=focal"};
  ASSERT_EQ(run(log(), learning).exit_code, 0);
  const std::string camera = out() + "/camera.ini";
  const std::string own = read_file(camera);
  expect_refused(run(log(), {"--calibration", camera}), {"camera.ini", "is read by this run"});
  EXPECT_EQ(read_file(camera), own);
  EXPECT_EQ(rows(), kFrames);
  fs::remove(camera);
  ASSERT_EQ(run(log()).exit_code, 0);
  const std::string truth = out() + "/trajectory_camera.tum";
  expect_refused(run(log(), {"--reference", truth}), {"is read by this run"});
  EXPECT_TRUE(fs::exists(truth));
}

TEST_F(Everyday, WhatNoRunHasWrittenStays) {
  const fs::path folder(out());
  fs::create_directories(folder);
  write_text(scratch() / "far.png", "mine");
  for (const char* name : {"mask.png", "report.html", "loops.csv", "params.yaml"}) {
    write_text(folder / name, "mine");
    expect_refused(run(log()), {name, "no run has written it"});
    EXPECT_EQ(read_file(folder / name), "mine");
    fs::remove(folder / name);
  }
  fs::create_symlink("../far.png", folder / "mask.png");
  expect_refused(run(log()), {"mask.png", "no run has written it"});
  EXPECT_EQ(read_file(scratch() / "far.png"), "mine");
  fs::remove(folder / "mask.png");
  ASSERT_EQ(run(log()).exit_code, 0);
  write_text(folder / "loops.csv", "mine");  // the run before has not written this one
  expect_refused(run(log()), {"loops.csv"});
  EXPECT_EQ(rows(), kFrames);
}

TEST_F(Everyday, WhatCannotBeReplacedIsSaidBeforeAnythingIsTouched) {
  ASSERT_EQ(run(log()).exit_code, 0);
  const fs::path folder(out());
  for (const char* name : {"graph.g2o", "trajectory_camera.tum", "mask.png"}) {
    fs::remove(folder / name);
    fs::create_directories(folder / name / "in it");
    expect_refused(run(log()), {name, "is a folder"});
    EXPECT_TRUE(fs::exists(folder / "summary.json"));
    EXPECT_EQ(read_file(folder / "tilt.csv").empty(), false);
    fs::remove_all(folder / name);
  }
  for (const char* name : {"files.json", "trajectory.gpx"}) {
    fs::remove(folder / name);
    ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    expect_refused(run(log()), {name, "is a pipe"});
    fs::remove(folder / name);
  }
}

TEST_F(Everyday, AReferenceThatIsNoneCostsNoResults) {
  ASSERT_EQ(run(log()).exit_code, 0);
  expect_refused(run(log(), {"--reference", "nix.txt"}), {"nix.txt", "no such file"});
  EXPECT_EQ(rows(), kFrames) << "it was no run";
  const fs::path poses = drive() / "poses.txt", kept = scratch() / "kept.txt";
  fs::rename(poses, kept);
  write_text(poses, "no poses\n");
  const ProgramResult result = run(log());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("not compared"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(fs::path(out()) / "summary.json"));
  fs::rename(kept, poses);
}

TEST_F(Everyday, WhatCompareAndFeaturesHaveNotWrittenStays) {
  const auto call = [&](const char* verb, const std::vector<std::string>& more) {
    std::vector<std::string> words{verb, log(), "-o", out(), "--count", "3", "--no-progress"};
    words.insert(words.end(), more.begin(), more.end());
    return oneac_program(words);
  };
  const fs::path folder(out());
  fs::create_directories(folder);
  const std::vector<std::string> one{"--initialisers", "5pc"};
  for (const char* name : {"report.html", "table.md", "pairs.csv"}) {
    write_text(folder / name, "mine");
    expect_refused(call("compare", one), {name, "no compare has written it"});
    EXPECT_EQ(read_file(folder / name), "mine");
    fs::remove(folder / name);
  }
  ASSERT_EQ(call("compare", one).exit_code, 0);
  EXPECT_EQ(call("compare", one).exit_code, 0) << "its own are replaced";
  expect_refused(call("features", {}), {"pairs.csv", "no features has written it"});
  fs::remove_all(folder);
  ASSERT_EQ(call("features", {}).exit_code, 0);
  EXPECT_EQ(call("features", {}).exit_code, 0);
  fs::remove(folder / "summary.md");
  ASSERT_EQ(::mkfifo((folder / "summary.md").c_str(), 0600), 0);
  expect_refused(call("features", {}), {"summary.md", "is a pipe"});
}

TEST_F(Everyday, ACalibrationIsNotWrittenOverWhatOthersHaveMade) {
  const auto calibrate = [&](const std::string& output) {
    return oneac_program({"calibrate", log(), "-o", output, "--no-progress"});
  };
  const fs::path folder = scratch() / "cal";
  fs::create_directories(folder / "sub");
  write_text(folder / "other.rawlog", "mine");
  expect_refused(calibrate((folder / "other.rawlog").string()),
                 {"other.rawlog", "has not made it"});
  expect_refused(calibrate((folder / "sub").string()), {"is a folder"});
  ASSERT_EQ(::mkfifo((folder / "d_height.yaml").c_str(), 0600), 0);
  expect_refused(calibrate((folder / "d.ini").string()), {"d_height.yaml", "is a pipe"});
  write_text(folder / "report.html", "mine");
  expect_refused(calibrate((folder / "camera.ini").string()), {"report.html"});
  EXPECT_EQ(read_file(folder / "report.html"), "mine");
}

TEST_F(Everyday, ARefusedImportLeavesNothing) {
  const fs::path folder = scratch() / "kitti";
  fs::create_directories(folder / "image_0");
  const std::vector<std::string> none{"import", "kitti", folder.string(), "--camera-height", "1.5"};
  const auto import_to = [&](const std::string& log) {
    std::vector<std::string> arguments = none;
    arguments.insert(arguments.end(), {"-o", log});
    return oneac_program(arguments);
  };
  expect_refused(import_to(""), {"--output", "empty"});
  expect_refused(import_to((scratch() / "x/").string()), {"--output", "is a folder"});
  EXPECT_FALSE(fs::exists(scratch() / "x"));
  expect_refused(oneac_program({"import", "kity"}), {"'kity'", "did you mean 'kitti'"});
}

TEST_F(Everyday, ARunThatFailsBeforeItsFirstFrameLeavesNoOtherDrivesResults) {
  ASSERT_EQ(run(log()).exit_code, 0);
  expect_refused(run(scratch() / "mistyped.rawlog"), {"mistyped.rawlog", "no such file"});
  EXPECT_EQ(rows(), kFrames);  // it was no run
  expect_refused(run(log(), {"--camera", "REAR"}), {"REAR"});
  EXPECT_FALSE(fs::exists(fs::path(out()) / "trajectory_camera.kitti"));
  EXPECT_FALSE(fs::exists(fs::path(out()) / "summary.json"));
}

TEST_F(Everyday, WhatCameBeforeAFaultIsWrittenAtAnyNumberOfThreads) {
  const fs::path other = scratch() / "other";
  ASSERT_EQ(oneac_program({"simulate", "-o", other.string(), "--frames", "4", "--width", "320",
                           "--height", "240", "--focal", "260"})
                .exit_code,
            0);
  const fs::path calibration = copy_of_drive("calibration"), image = copy_of_drive("image");
  write_text(calibration, read_file(calibration) + read_file(other / "simulated.rawlog"));
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(image.parent_path() / "Images")) {
    images.push_back(entry.path());
  }
  std::sort(images.begin(), images.end());
  write_text(images[5], "no picture");
  for (const auto& [log, expected] : {std::pair(calibration, kFrames), std::pair(image, 5)}) {
    Json first;
    for (const char* threads : {"1", "2", "4", "8", "16"}) {
      EXPECT_EQ(run(log, {"--threads", threads}).exit_code, 2);
      EXPECT_EQ(rows(), expected) << log << " with " << threads << " threads";
      Json now = summary();
      now.erase("timing");
      if (first.is_null()) first = now;
      EXPECT_EQ(now, first) << threads << " threads";
    }
  }
}

TEST_F(Everyday, GravityThatIsNotInTheLogIsSaidAndWhatWasUsedInstead) {
  const ProgramResult result = run(imported(), {"--set", "front_end.tilt.source=imu"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("holds no acceleration"), std::string::npos) << result.err;
  EXPECT_EQ(summary()["tilt_source"], "log");
  ASSERT_EQ(run(log(), {"--set", "front_end.tilt.source=imu"}).exit_code, 0);
  EXPECT_EQ(summary()["tilt_source"], "imu");
}

TEST_F(Everyday, AGpsOfAnotherTimeIsNamedWithBothSpans) {
  const std::string late = (drive() / "late.rawlog").string();
  rewrite_log(log(), late, [](mrpt::obs::CObservation& observation) {
    const bool gps = dynamic_cast<mrpt::obs::CObservationGPS*>(&observation) != nullptr;
    if (gps) observation.timestamp += std::chrono::hours(2);
  });
  for (const char* source : {"height", "gps"}) {
    const ProgramResult result =
        run(late, {"--set", std::string("front_end.scale.source=") + source});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("does not overlap the images (1261229980.0 to"), std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("the GPS (1261237"), std::string::npos) << result.err;
  }
  fs::remove(late);
}

TEST_F(Everyday, OnlyFilesAreReadAndReplaced) {
  const fs::path pipe = scratch() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_refused(run(pipe), {"pipe", "not a file"});
  expect_refused(run(log(), {"--reference", pipe.string()}), {"pipe"});
  expect_refused(oneac_program({"info", pipe.string()}), {"pipe", "not a file"});
  expect_refused(oneac_program({"eval", pipe.string(), (drive() / "poses.txt").string()}),
                 {"pipe"});
  expect_refused(run(log(), {"--calibration", pipe.string()}), {"pipe", "not a file"});
  const fs::path camera = scratch() / "camera.txt";
  write_text(camera, "P0: 250 0 159.5 0 0 250 119.5 0 0 0 1 0\n");
  const std::vector<std::string> video = {
      "import",        "video",         pipe.string(),     "-o", (scratch() / "v.rawlog").string(),
      "--calibration", camera.string(), "--camera-height", "1.5"};
  expect_refused(oneac_program(video), {"pipe", "not a file"});
  for (const char* flag : {"--gpx", "--nmea", "--csv"}) {
    std::vector<std::string> arguments = video;
    arguments.insert(arguments.end(), {flag, pipe.string()});
    expect_refused(oneac_program(arguments), {"pipe", "not a file"});
  }
  fs::create_directories(out());
  ASSERT_EQ(::mkfifo((fs::path(out()) / "summary.json").c_str(), 0600), 0);
  const ProgramResult result = run(log());
  EXPECT_NE(result.exit_code, 0);
  EXPECT_NE(result.err.find("summary.json"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_fifo(fs::path(out()) / "summary.json"));
}

TEST_F(Everyday, ALinkAsOutputStaysAndIsWrittenThrough) {
  fs::create_directories(out());
  fs::create_symlink("../far.json", fs::path(out()) / "summary.json");
  ASSERT_EQ(run(log()).exit_code, 0);
  ASSERT_EQ(run(log()).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(fs::path(out()) / "summary.json"));
  EXPECT_EQ(Json::parse(read_file(scratch() / "far.json"))["metric"], summary()["metric"]);
}

TEST_F(Everyday, ALinkToALogFindsWhatLiesBesideTheLog) {
  fs::create_directories(scratch() / "links");
  const fs::path link = scratch() / "links" / "today.rawlog";
  fs::create_symlink(log(), link);
  const ProgramResult result = run(link);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(rows(), kFrames);
  EXPECT_NE(result.out.find("against"), std::string::npos) << result.out;
}

TEST_F(Everyday, APackedLogFindsTheImagesOfItsPlainName) {
  const fs::path folder = scratch() / "packed";
  fs::create_directories(folder);
  fs::copy(log(), folder / "drive.rawlog.gz");
  fs::copy(drive() / "Images", folder / "drive_Images");
  fs::copy(drive() / "poses.txt", folder / "drive_poses.txt");
  const ProgramResult result = run(folder / "drive.rawlog.gz");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("drive_poses.txt"), std::string::npos) << result.out;
}

TEST_F(Everyday, AMistypedVerbIsNamedWithTheNearestOne) {
  expect_refused(oneac_program({"rn", log()}), {"'rn'", "did you mean 'run'"});
  expect_refused(oneac_program({}), {"no verb", "run"});
}

TEST_F(Everyday, ValuesAreQuotedShortAndHarmless) {
  const std::string nasty = "\x1b[2J" + std::string(100000, 'a');
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", log(), "-o", out(), "--camera", nasty},
        std::vector<std::string>{"run", log(), "-o", out(), "--set", nasty},
        std::vector<std::string>{"run", log(), "-o", out(), "--set", "run.threads=" + nasty},
        std::vector<std::string>{nasty}, std::vector<std::string>{"run", "--" + nasty},
        std::vector<std::string>{"run", log(), "-o", nasty}}) {
    const ProgramResult result = oneac_program(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_LT(result.err.size(), 4000U);
    EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "--" + nasty},
        std::vector<std::string>{"import", "kitti", out(), "-o", out(), "--camera-height", nasty},
        std::vector<std::string>{"eval", "--align", nasty, out(), out()}}) {
    EXPECT_LT(oneac_program(arguments).err.size(), 300U);
  }
}

TEST_F(Everyday, ALoopOfLinksOrTooLongANameIsOneLine) {
  fs::create_symlink("loop", scratch() / "loop");
  const std::vector<std::string> names{(scratch() / "loop").string(),
                                       (scratch() / std::string(300, 'a')).string()};
  for (const std::string& name : names) {
    expect_refused(oneac_program({"run", log(), "-o", name}), {"output folder"});
    expect_refused(oneac_program({"compare", log(), "-o", name, "--initialisers", "5pc"}),
                   {"output folder"});
    expect_refused(oneac_program({"simulate", "-o", name, "--frames", "2"}), {});
    expect_refused(oneac_program({"run", name, "-o", out()}), {});
    expect_refused(oneac_program({"run", log(), "-o", out(), "--params", name}), {});
    expect_refused(oneac_program({"run", log(), "-o", out(), "--images-dir", name}), {});
  }
}

TEST_F(Everyday, MessagesNameTheKeyOrFlagThatWasTyped) {
  for (const char* key : {"front_end.window.refine.affine_noise", "front_end.refine.affine_noise",
                          "front_end.consensus.threshold_px", "front_end.features.klt.levels"}) {
    expect_refused(run(log(), {"--set", std::string(key) + "=-1"}), {std::string(key) + " = -1"});
  }
  expect_refused(run(log(), {"--set", "front_end.window.fixed=99"}),
                 {"front_end.window.fixed = 99"});
  expect_refused(oneac_program({"simulate", "-o", out(), "--camera-height", "0"}),
                 {"--camera-height = 0"});
  expect_refused(oneac_program({"simulate", "-o", out(), "--rolling-shutter", "9"}),
                 {"--rolling-shutter = 9"});
}

TEST_F(Everyday, AFlagThatIsAlsoAKeyIsNamedAsItWasTyped) {
  expect_refused(run(log(), {"--threads", "abc"}), {"--threads: ", "'abc'"});
  expect_refused(run(log(), {"--camera-height", "1,65"}), {"--camera-height: ", "'1,65'"});
  expect_refused(run(log(), {"--camera-height", "5.0000001"}),
                 {"--camera-height 5.0000001", "must be 0, or"});
  expect_refused(run(log(), {"--mount-roll", "abc"}), {"--mount-roll abc", "a number of degrees"});
  expect_refused(run(log(), {"--mount-roll", "400"}), {"--mount-roll 400", "from -360 to 360"});
  expect_refused(run(log(), {"--mount-roll", ""}), {"--mount-roll", "is empty"});
  expect_refused(oneac_program({"simulate", "-o", out(), "--seed", "-1"}), {"--seed", "from 0 to"});
  expect_refused(run(log(), {"--set", "run.threads=abc"}), {"--set run.threads: ", "'abc'"});
}

TEST_F(Everyday, NumbersOfFlagsAreDecimal) {
  const fs::path folder = scratch() / "few";
  const auto simulate = [&](const std::string& frames) {
    return oneac_program({"simulate", "-o", folder.string(), "--frames", frames, "--width", "64",
                          "--height", "48", "--focal", "50"});
  };
  for (const char* eight : {"08", "+8", "8"}) {
    EXPECT_EQ(simulate(eight).exit_code, 0);
    const fs::directory_iterator images(folder / "Images");
    EXPECT_EQ(std::distance(begin(images), end(images)), 8) << eight;
    fs::remove_all(folder);
  }
  for (const char* none : {"0x8", "8.5", "", "+-8", "1e1", "99999999999"}) {
    expect_refused(simulate(none), {"--frames", "whole number"});
  }
  for (const char* none : {"0x2", "", "nan", "1,5"}) {
    expect_refused(oneac_program({"import", "kitti", out(), "-o", out(), "--camera-height", none}),
                   {"--camera-height", "must be a number"});
  }
}

TEST_F(Everyday, MissingRightImagesAreSaidOnceWithCounts) {
  const fs::path folder = scratch() / "stereo";
  ASSERT_EQ(oneac_program({"simulate", "-o", folder.string(), "--frames", "6", "--width", "320",
                           "--height", "240", "--focal", "250", "--stereo"})
                .exit_code,
            0);
  std::vector<fs::path> right;
  for (const auto& entry : fs::directory_iterator(folder / "Images")) {
    if (entry.path().filename().string().find("right") != std::string::npos) {
      right.push_back(entry.path());
    }
  }
  std::sort(right.begin(), right.end());
  ASSERT_EQ(right.size(), 6U);
  const std::vector<std::string> by_stereo{"--set", "front_end.scale.source=stereo"};
  const ProgramResult whole = run(folder / "simulated.rawlog", by_stereo);
  EXPECT_EQ(whole.err.find("right image"), std::string::npos) << whole.err;
  fs::remove(right[1]);
  fs::remove(right[4]);
  const ProgramResult result = run(folder / "simulated.rawlog", by_stereo);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto first = result.err.find("2 of 6 images have no right image");
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("no right image", first + 40), std::string::npos) << result.err;
}

TEST_F(Everyday, TheProgressBarKeepsToItsLine) {
  const std::string command = "stty cols 40; " + std::string(ONEAC_PROGRAM) + " run " + log() +
                              " -o " + out() + " >/dev/null";
  const ProgramResult result = run_program({"script", "-qec", command, "/dev/null"});
  const std::string shown = result.out + result.err;
  ASSERT_NE(shown.find(" of " + std::to_string(kFrames) + " frames"), std::string::npos) << shown;
  for (std::size_t at = shown.find('\r'); at != std::string::npos;) {
    const auto next = shown.find('\r', at + 1);
    const std::string line = shown.substr(at + 1, next - at - 1);
    if (line.find("frames") != std::string::npos) {
      EXPECT_LT(line.find("\x1b"), 40U) << line;
    }
    at = next;
  }
}

TEST_F(Everyday, EvalKnowsOtherClocksAndForms) {
  ASSERT_EQ(run(log()).exit_code, 0);
  const fs::path estimate = fs::path(out()) / "trajectory_camera.tum";
  const auto eval = [&](const fs::path& reference, std::vector<std::string> extra) {
    std::vector<std::string> arguments{"eval", estimate.string(), reference.string(), "--json"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return oneac_program(arguments);
  };
  // The estimate itself in nanoseconds, 50 s late, behind commas, its scalar first.
  std::string euroc = "#timestamp [ns],x,y,z,qw,qx,qy,qz\n", unsorted;
  std::istringstream lines(read_file(estimate));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::vector<std::string> f;
    for (std::string field; fields >> field;) f.push_back(field);
    euroc += std::to_string(static_cast<long long>((std::stod(f[0]) + 50.0) * 1e6)) + "000," +
             f[1] + "," + f[2] + "," + f[3] + "," + f[7] + "," + f[4] + "," + f[5] + "," + f[6] +
             "\n";
    unsorted = line + "\n" + line + "\n" + unsorted;
  }
  write_text(scratch() / "euroc.csv", euroc);
  write_text(scratch() / "unsorted.txt", unsorted);
  expect_refused(eval(scratch() / "euroc.csv", {}), {"no frame in common", "--offset"});
  const ProgramResult good = eval(scratch() / "euroc.csv", {"--offset", "50"});
  ASSERT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(Json::parse(good.out)["trajectory"]["frames"], kFrames);
  EXPECT_EQ(Json::parse(good.out)["offset_s"], 50.0);
  EXPECT_LT(Json::parse(good.out)["trajectory"]["ape_m"]["max"].get<double>(), 0.01);
  const ProgramResult sorted = eval(scratch() / "unsorted.txt", {});
  ASSERT_EQ(sorted.exit_code, 0) << sorted.err;
  EXPECT_EQ(Json::parse(sorted.out)["trajectory"]["frames"], kFrames);
  const ProgramResult between = eval(scratch() / "unsorted.txt", {"--offset", "0.05"});
  ASSERT_EQ(between.exit_code, 0) << between.err;
  EXPECT_NE(between.err.find("lie between rows"), std::string::npos) << between.err;
  expect_refused(eval(scratch() / "unsorted.txt", {"--offset", "soon"}), {"--offset soon"});
  expect_refused(eval(scratch() / "unsorted.txt", {"--max-difference", "-1"}), {});
}

}  // namespace
}  // namespace oneac
