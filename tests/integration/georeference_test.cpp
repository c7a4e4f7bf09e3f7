#include "drive_fixture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace oneac {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Runs of a drive that is long enough to be joined to its GPS: 66 m.
class GeoreferencedRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const ProgramResult made =
        oneac_program({"simulate", "-o", shared_->path().string(), "--frames", "150", "--width",
                       "320", "--height", "240", "--focal", "250"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() { shared_.reset(); }

  [[nodiscard]] static std::string log() { return (shared_->path() / "simulated.rawlog").string(); }
  [[nodiscard]] fs::path out() const { return scratch_.path() / "out"; }
  ProgramResult run(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"run", log(), "-o", out().string(), "--no-progress"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return oneac_program(arguments);
  }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder scratch_;
};
std::unique_ptr<TemporaryFolder> GeoreferencedRun::shared_;

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST_F(GeoreferencedRun, WritesTheWayForMapsWithItsResidual) {
  const ProgramResult ran = run({"--georeference"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json joined = Json::parse(read_file(out() / "summary.json"))["georeference"];
  ASSERT_TRUE(joined.contains("origin")) << joined;
  EXPECT_EQ(joined["model"], "se2");
  EXPECT_EQ(joined["scale"], 1.0);
  EXPECT_LT(joined["residual_m"]["rms"], 3.0);
  EXPECT_GT(joined["yaw_sigma_deg"], 1.0);
  const std::string gpx = read_file(out() / "trajectory.gpx");
  EXPECT_EQ(count_of(gpx, "<trkpt "), 150U);
  EXPECT_EQ(count_of(gpx, "<time>"), 150U);
  EXPECT_NE(read_file(out() / "trajectory.kml").find("<LineString>"), std::string::npos);
  EXPECT_EQ(count_of(read_file(out() / "trajectory_enu.tum"), "\n"), 150U);
  EXPECT_NE(ran.out.find("trajectory.gpx, trajectory.kml, trajectory_enu.tum"), std::string::npos);
}

// One that oneac calibrate has made, say; a run that learns nothing leaves it alone.
TEST_F(GeoreferencedRun, DoesNotListACameraThatNoRunWrote) {
  fs::create_directories(out());
  std::ofstream(out() / "camera.ini") << "[CAMERA_PARAMS]\n";
  const ProgramResult ran = run();
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(read_file(out() / "files.json").find("camera.ini"), std::string::npos);
  EXPECT_EQ(ran.out.find("camera.ini"), std::string::npos);
  EXPECT_EQ(read_file(out() / "camera.ini"), "[CAMERA_PARAMS]\n");
}

TEST_F(GeoreferencedRun, ListsItsFilesWithFrameUnitAndRows) {
  ASSERT_EQ(run().exit_code, 0);
  const Json list = Json::parse(read_file(out() / "files.json"));
  std::map<std::string, Json> files;
  for (const Json& file : list["files"]) files[file["name"]] = file;
  std::size_t there = 0;
  for (const auto& entry : fs::directory_iterator(out())) {
    EXPECT_EQ(files.count(entry.path().filename().string()), 1U) << entry.path();
    ++there;
  }
  EXPECT_EQ(files.size(), there);
  EXPECT_EQ(files["trajectory_camera.kitti"]["rows"], 150);
  EXPECT_EQ(files["relative_poses.csv"]["rows"], 149);
  EXPECT_EQ(files["trajectory.gpx"]["rows"], 150);
  EXPECT_EQ(files["trajectory.kml"]["rows"], 150);
  EXPECT_GT(files["points.ply"]["rows"], 50);
  EXPECT_EQ(files["trajectory_vehicle.tum"]["unit"], "m");
  EXPECT_EQ(files["trajectory.gpx"]["frame"], "WGS84");
  EXPECT_EQ(files.count("trajectory_enu.tum"), 0U);
}

TEST_F(GeoreferencedRun, SaysWhyItIsNotJoined) {
  const ProgramResult ran = run({"--georeference", "--count", "10"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.err.find("not joined to the GPS: "), std::string::npos) << ran.err;
  EXPECT_FALSE(fs::exists(out() / "trajectory.gpx"));
  EXPECT_TRUE(Json::parse(read_file(out() / "summary.json"))["georeference"].contains("reason"));
}

TEST_F(GeoreferencedRun, TakesAwayItsOwnTracksAndNobodyElses) {
  ASSERT_EQ(run().exit_code, 0);
  ASSERT_TRUE(fs::exists(out() / "trajectory.gpx"));
  ASSERT_EQ(run({"--count", "10"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(out() / "trajectory.gpx"));
  write_text(out() / "trajectory.gpx", "<gpx creator=\"my phone\"/>");
  const ProgramResult refused = run({"--count", "10"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("would overwrite it"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(out() / "trajectory.gpx"), "<gpx creator=\"my phone\"/>");
}

}  // namespace
}  // namespace oneac
