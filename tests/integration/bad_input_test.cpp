#include "drive_fixture.h"

#include <algorithm>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;

/// Exit code 2 and one line that names the culprit and every given word.
void expect_refused(const ProgramResult& result, const std::vector<std::string>& words) {
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& word : words) {
    EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' not in " << result.err;
  }
}

class BadInput : public DriveFixture {
 protected:
  [[nodiscard]] ProgramResult run_log(const fs::path& path,
                                      std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"run", path.string(), "-o", out()};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return oneac_program(arguments);
  }
  [[nodiscard]] fs::path copy_of_drive() const {
    fs::copy(drive(), scratch() / "copy", fs::copy_options::recursive);
    return scratch() / "copy" / "simulated.rawlog";
  }
};

TEST_F(BadInput, NoSuchFile) {
  expect_refused(run_log(scratch() / "missing.rawlog"), {"missing.rawlog", "no such file"});
}

TEST_F(BadInput, EmptyFile) {
  write_text(scratch() / "empty.rawlog", "");
  expect_refused(run_log(scratch() / "empty.rawlog"), {"empty.rawlog", "empty"});
}

TEST_F(BadInput, TextFile) {
  write_text(scratch() / "text.rawlog", "This is not a log at all.\nNot one observation.\n");
  expect_refused(run_log(scratch() / "text.rawlog"), {"text.rawlog", "not a readable rawlog"});
}

TEST_F(BadInput, TruncatedGzipIsUsedUpToTheCutAndSaid) {
  const fs::path copy = copy_of_drive();
  const std::string whole = read_file(copy);
  write_text(copy, whole.substr(0, whole.size() / 2));
  const ProgramResult result = run_log(copy, {"--quiet"});
  expect_refused(result, {"simulated.rawlog", "record"});
  const std::string poses = read_file(fs::path(out()) / "trajectory_camera.kitti");
  const auto rows = std::count(poses.begin(), poses.end(), '\n');
  EXPECT_GE(rows, 2);
  EXPECT_LT(rows, kFrames);
}

TEST_F(BadInput, DamagedZstd) {
  const fs::path copy = copy_of_drive();
  ASSERT_EQ(run_program({"gzip", "-d", "-S", ".rawlog", "-c", copy.string()}).exit_code, 0);
  write_text(scratch() / "plain", run_program({"gzip", "-dcS", ".rawlog", copy.string()}).out);
  ASSERT_EQ(run_program({"zstd", "-q", "-f", (scratch() / "plain").string(), "-o", copy.string()})
                .exit_code,
            0);
  std::string bytes = read_file(copy);
  for (std::size_t i = 20; i < 60; ++i) bytes[i] = static_cast<char>(~bytes[i]);
  write_text(copy, bytes);
  expect_refused(run_log(copy, {"--quiet"}), {"simulated.rawlog", "zstd"});
}

TEST_F(BadInput, RawlogWithoutImages) {
  expect_refused(run_log("/usr/share/mrpt/datasets/kf-slam_demo.rawlog"),
                 {"kf-slam_demo.rawlog", "no camera images"});
}

TEST_F(BadInput, ImagesDirWithNothingInIt) {
  fs::create_directory(scratch() / "nothing");
  expect_refused(run_log(log(), {"--images-dir", (scratch() / "nothing").string()}),
                 {"nothing", "--images-dir"});
}

TEST_F(BadInput, WrongCameraLabelListsThoseThatExist) {
  expect_refused(run_log(log(), {"--camera", "REAR"}), {"REAR", "CAMERA1"});
}

TEST_F(BadInput, CalibrationFileWithoutTheSection) {
  write_text(scratch() / "camera.ini",
             "[CAMERA_LEFT]\nresolution=[320 240]\ncx=160\ncy=120\n"
             "fx=250\nfy=250\ndist=[0 0 0 0 0]\n");
  expect_refused(
      run_log(log(), {"--calibration", (scratch() / "camera.ini").string() + ":CAMERA_TOP"}),
      {"camera.ini", "CAMERA_TOP", "CAMERA_LEFT"});
}

TEST_F(BadInput, UnknownYamlKeySuggestsTheNearest) {
  write_text(scratch() / "p.yaml", "front_end:\n  consensus:\n    treshold_px: 2\n");
  expect_refused(run_log(log(), {"--params", (scratch() / "p.yaml").string()}),
                 {"p.yaml", "front_end.consensus.treshold_px",
                  "did you mean 'front_end.consensus.threshold_px'"});
}

TEST_F(BadInput, ParameterFilesThatAreMissingOrNotYaml) {
  expect_refused(run_log(log(), {"--params", (scratch() / "no.yaml").string()}), {"no.yaml"});
  write_text(scratch() / "bad.yaml", "a: [1, 2\n}:");
  expect_refused(run_log(log(), {"--params", (scratch() / "bad.yaml").string()}),
                 {"bad.yaml: line", "not valid YAML"});
}

TEST_F(BadInput, ParameterFileThatContainsItself) {
  write_text(scratch() / "p.yaml", "front_end: &all\n  consensus: *all\n");
  expect_refused(run_log(log(), {"--params", (scratch() / "p.yaml").string()}),
                 {"p.yaml: line 2", "nested too deep"});
}

TEST_F(BadInput, OutputFolderThatCannotBeWritten) {
  write_text(scratch() / "file", "in the way");
  const ProgramResult result =
      oneac_program({"run", log(), "-o", (scratch() / "file" / "out").string()});
  expect_refused(result, {"file/out", "output folder"});
}

TEST_F(BadInput, EveryZero) {
  expect_refused(run_log(log(), {"--every", "0"}), {"every", "0"});
}

TEST_F(BadInput, UnknownInitialiserListsThoseThatExist) {
  expect_refused(run_log(log(), {"--initialiser", "6pc"}), {"6pc", "1ac_pooled"});
}

TEST_F(BadInput, AnImageThatCannotBeDecodedKeepsWhatCameBefore) {
  const fs::path copy = copy_of_drive();
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(copy.parent_path() / "Images")) {
    images.push_back(entry.path());
  }
  std::sort(images.begin(), images.end());
  write_text(images[4], "no picture");
  expect_refused(run_log(copy, {"--quiet"}), {images[4].filename().string()});
  const std::string poses = read_file(fs::path(out()) / "trajectory_camera.kitti");
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 4);
}

}  // namespace
}  // namespace oneac
