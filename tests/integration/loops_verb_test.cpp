#include "drive_fixture.h"
#include "g2o_solution.h"

#include "oneac/evaluation/trajectory_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace oneac {
namespace {

namespace fs = std::filesystem;

using Row = std::map<std::string, double>;

std::vector<Row> read_csv(const fs::path& path) {
  std::ifstream in(path);
  const auto cells = [](const std::string& line) {
    std::vector<std::string> all;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
    return all;
  };
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = cells(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> values = cells(line);
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = std::stod(values.at(i));
  }
  return rows;
}

/// Distance [m] and turn [deg] of a loop from what the true poses say.
std::pair<double, double> errors_of(const Row& loop, const Trajectory& truth) {
  const auto pose = [&](const char* index) {
    return truth.poses.at(static_cast<std::size_t>(loop.at(index)));
  };
  const Eigen::Isometry3d T = pose("index2").inverse() * pose("index1");
  const Eigen::Quaterniond q(loop.at("qw"), loop.at("qx"), loop.at("qy"), loop.at("qz"));
  const Eigen::Vector3d t(loop.at("tx"), loop.at("ty"), loop.at("tz"));
  const double turn = q.angularDistance(Eigen::Quaterniond(T.linear()));
  return {(t - T.translation()).norm(), turn * 180.0 / M_PI};
}

/// A block of 40 m driven twice; tests share the drives and the runs.
class LoopsVerb : public ::testing::Test {
 protected:
  static inline std::unique_ptr<TemporaryFolder> shared;

  static void SetUpTestSuite() {
    shared = std::make_unique<TemporaryFolder>();
    simulate("block", {"--lane-shift-m", "0.5"});
    run("block", "closed", {"--loops"});
  }
  static void TearDownTestSuite() { shared.reset(); }

  static fs::path folder(const std::string& name) { return shared->path() / name; }

  static void simulate(const std::string& name, std::vector<std::string> extra) {
    std::vector<std::string> arguments{"simulate",  "-o",           folder(name).string(),
                                       "--route",   "block",        "--laps",
                                       "2",         "--block-m",    "40",
                                       "--width",   "400",          "--height",
                                       "300",       "--focal",      "312",
                                       "--relight", "--no-progress"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult made = oneac_program(arguments);
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static ProgramResult run(const std::string& drive, const std::string& out,
                           std::vector<std::string> extra) {
    std::vector<std::string> arguments{"run", (folder(drive) / "simulated.rawlog").string(), "-o",
                                       folder(out).string(), "--quiet"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    ProgramResult result = oneac_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  }
  static Trajectory truth_of(const std::string& drive) {
    return read_kitti(folder(drive) / "poses.txt");
  }
  static void expect_no_false_loop(const std::string& drive, const std::string& out) {
    const Trajectory truth = truth_of(drive);
    for (const Row& loop : read_csv(folder(out) / "loops.csv")) {
      const auto [metres, degrees] = errors_of(loop, truth);
      EXPECT_LT(metres, 1.0) << loop.at("index1") << " and " << loop.at("index2");
      EXPECT_LT(degrees, 3.0) << loop.at("index1") << " and " << loop.at("index2");
    }
  }
};

TEST_F(LoopsVerb, FindTheSecondLapsPlacesAndNoOthers) {
  expect_no_false_loop("block", "closed");
  std::set<std::size_t> found;
  for (const Row& loop : read_csv(folder("closed") / "loops.csv")) {
    found.insert(static_cast<std::size_t>(loop.at("index2")));
  }
  // Of the keyframes whose place the first lap has seen.
  std::map<double, std::size_t> index_at;
  const Trajectory all = read_tum(folder("closed") / "trajectory_camera.tum");
  for (std::size_t i = 0; i < all.times.size(); ++i) index_at[all.times[i]] = i;
  std::set<std::size_t> seen_again;
  for (const Row& loop : read_csv(folder("block") / "loops_true.csv")) {
    seen_again.insert(static_cast<std::size_t>(loop.at("index2")));
  }
  std::size_t places = 0, loops = 0;
  for (const double time : read_tum(folder("closed") / "keyframes.tum").times) {
    const std::size_t index = index_at.at(time);
    if (seen_again.count(index) == 0) continue;
    ++places;
    loops += found.count(index);
  }
  ASSERT_GT(places, 50U);
  EXPECT_GT(static_cast<double>(loops), 0.9 * static_cast<double>(places));
}

/// [m] 1σ of a position along its surest to unsurest axis, root of the trace.
double position_sigma(const Row& row) {
  return std::sqrt(row.at("c33") + row.at("c44") + row.at("c55"));
}

TEST_F(LoopsVerb, TellHowSureTheClosedDriveIs) {
  const fs::path out = folder("closed");
  const auto open = read_csv(out / "trajectory_camera.csv");
  const auto closed = read_csv(out / "trajectory_optimised_camera.csv");
  const Trajectory poses = read_tum(out / "trajectory_optimised_camera.tum");
  const Trajectory truth = truth_of("block");
  ASSERT_EQ(closed.size(), poses.poses.size());
  std::size_t within = 0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const Eigen::Vector3d at(closed[i].at("x"), closed[i].at("y"), closed[i].at("z"));
    EXPECT_LT((at - poses.poses[i].translation()).norm(), 1e-6);
    const double off = (at - truth.poses[i].translation()).norm();
    within += off <= 2.0 * position_sigma(closed[i]) + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(within, 9 * closed.size() / 10);
  EXPECT_NEAR(position_sigma(closed.front()), 0.0, 1e-9);
  // At the end of the second lap, where it has begun: the loops know, the chain has forgotten.
  EXPECT_LT(position_sigma(closed.back()), 0.7 * position_sigma(open.back()));
  EXPECT_EQ(read_csv(out / "trajectory_optimised_vehicle.csv").size(), closed.size());
}

TEST_F(LoopsVerb, WriteTheClosedDriveBesideTheOther) {
  const std::size_t frames = truth_of("block").poses.size();
  const fs::path out = folder("closed");
  for (const char* name : {"trajectory_optimised_camera.tum", "trajectory_optimised_vehicle.tum"}) {
    EXPECT_EQ(read_tum(out / name).poses.size(), frames) << name;
  }
  EXPECT_EQ(read_kitti(out / "trajectory_optimised_camera.kitti").poses.size(), frames);
  EXPECT_EQ(read_tum(out / "keyframes_optimised.tum").times, read_tum(out / "keyframes.tum").times);
  const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
  const std::size_t loops = read_csv(out / "loops.csv").size();
  EXPECT_EQ(summary["loops"]["loops"], loops);
  EXPECT_LT(summary["loops"]["ape_after_m"], 1.05 * summary["loops"]["ape_before_m"].get<double>());
  const std::string graph = read_file(out / "graph.g2o");
  std::size_t edges = 0;
  for (auto at = graph.find("EDGE_SE3:QUAT"); at != std::string::npos;
       at = graph.find("EDGE_SE3:QUAT", at + 1)) {
    ++edges;
  }
  EXPECT_EQ(edges, read_tum(out / "keyframes.tum").times.size() - 1 + loops);
  const std::string report = read_file(out / "report.html");
  EXPECT_NE(report.find("<h2>Loops</h2>"), std::string::npos);
  EXPECT_NE(report.find("Absolute position error"), std::string::npos);
}

/// [m] how far the poses lie apart at most.
double farthest(const std::vector<Eigen::Isometry3d>& a, const std::vector<Eigen::Isometry3d>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    most = std::max(most, (a[i].translation() - b[i].translation()).norm());
  }
  return most;
}

TEST_F(LoopsVerb, WriteTheGraphThatWasSolved) {
  const G2oGraph graph = read_g2o(folder("closed") / "graph.g2o");
  const auto closed = read_tum(folder("closed") / "keyframes_optimised.tum").poses;
  EXPECT_LT(farthest(least_squares(graph), closed), 1e-4);
  EXPECT_GT(farthest(graph.vertices, closed), 0.01);
}

/// VERTEX3 of MRPT's text format: id x y z roll pitch yaw.
std::vector<Eigen::Isometry3d> positions_of_mrpt(const fs::path& path) {
  std::ifstream file(path);
  std::vector<Eigen::Isometry3d> poses;
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    std::string key;
    std::size_t id = 0;
    Eigen::Vector3d t;
    if (!(in >> key >> id >> t.x() >> t.y() >> t.z()) || key != "VERTEX3") continue;
    poses.emplace_back(Eigen::Translation3d(t));
  }
  return poses;
}

// Its edges are CNetworkOfPoses3D's, which have no information. By its own first damping it may
// stop millimetres short of the minimum.
TEST_F(LoopsVerb, WriteAGraphThatMrptsGraphSlamSolvesWithItsEdgesWeighedAlike) {
  const fs::path out = folder("closed") / "mrpt.graph";
  const ProgramResult solved =
      run_program({"graph-slam", "--3d", "--levmarq", "-q", "--initial-lambda", "1e-6", "-i",
                   (folder("closed") / "graph.g2o").string(), "-o", out.string()});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  G2oGraph graph = read_g2o(folder("closed") / "graph.g2o");
  // Turns in radians there, halves of them here.
  for (G2oEdge& edge : graph.edges) {
    edge.information.setIdentity();
    edge.information.bottomRightCorner<3, 3>() *= 4.0;
  }
  EXPECT_LT(farthest(least_squares(graph), positions_of_mrpt(out)), 1e-3);
  fs::remove(out);
}

TEST_F(LoopsVerb, ChangeNothingElse) {
  run("block", "open", {"--threads", "1"});
  for (const char* name :
       {"trajectory_camera.kitti", "trajectory_camera.tum", "trajectory_vehicle.tum",
        "relative_poses.csv", "covariance.csv", "tilt.csv", "keyframes.tum"}) {
    EXPECT_EQ(read_file(folder("open") / name), read_file(folder("closed") / name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder("open") / "loops.csv"));
  const auto summary = nlohmann::json::parse(read_file(folder("open") / "summary.json"));
  EXPECT_FALSE(summary.contains("loops"));
  EXPECT_EQ(read_file(folder("open") / "params.yaml").find("loops"), std::string::npos);
}

TEST_F(LoopsVerb, GiveTheSameBytesAtAnyThreadCount) {
  run("block", "three", {"--loops", "--threads", "3"});
  for (const char* name : {"loops.csv", "graph.g2o", "trajectory_optimised_camera.kitti",
                           "points.ply", "map.simplemap", "keyframes_optimised.tum"}) {
    EXPECT_EQ(read_file(folder("three") / name), read_file(folder("closed") / name)) << name;
  }
}

TEST_F(LoopsVerb, AdjustTheWholeDriveWhereThatIsAskedFor) {
  run("block", "adjusted", {"--loops", "--global-ba"});
  const fs::path out = folder("adjusted");
  for (const char* name : {"loops.csv", "graph.g2o", "trajectory_camera.kitti", "keyframes.tum"}) {
    EXPECT_EQ(read_file(out / name), read_file(folder("closed") / name)) << name;
  }
  for (const char* name : {"trajectory_optimised_camera.kitti", "keyframes_optimised.tum",
                           "points.ply", "map.simplemap"}) {
    EXPECT_NE(read_file(out / name), read_file(folder("closed") / name)) << name;
  }
  const auto loops = nlohmann::json::parse(read_file(out / "summary.json"))["loops"];
  const auto& global = loops["global_ba"];
  ASSERT_EQ(global["adjusted"], true) << global["reason"];
  EXPECT_LT(global["reprojection_rms_after_px"], global["reprojection_rms_before_px"]);
  const auto before = nlohmann::json::parse(read_file(folder("closed") / "summary.json"))["loops"];
  EXPECT_LT(loops["ape_after_m"], 1.05 * before["ape_after_m"].get<double>());
  EXPECT_FALSE(before.contains("global_ba"));
  EXPECT_EQ(loops["ape_of_pose_graph_m"], before["ape_after_m"]);
  EXPECT_FALSE(before.contains("ape_of_pose_graph_m"));
  const std::string report = read_file(out / "report.html");
  for (const char* text :
       {"Global bundle adjustment", "Absolute position error", "loops, pose graph"}) {
    EXPECT_NE(report.find(text), std::string::npos) << text;
  }
}

TEST_F(LoopsVerb, HaveToBeAskedForWithTheGlobalAdjustment) {
  const ProgramResult refused =
      oneac_program({"run", (folder("block") / "simulated.rawlog").string(), "-o",
                     folder("refused").string(), "--global-ba"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("add --loops"), std::string::npos) << refused.err;
}

TEST_F(LoopsVerb, AreNotTakenInByStreetsThatLookAlike) {
  simulate("alike", {"--alike"});
  run("alike", "trap", {"--loops"});
  expect_no_false_loop("alike", "trap");
}

TEST_F(LoopsVerb, OfADriveWithoutAnyAreAnEmptyTable) {
  run("block", "short", {"--loops", "--count", "40"});
  EXPECT_TRUE(read_csv(folder("short") / "loops.csv").empty());
  EXPECT_EQ(read_file(folder("short") / "trajectory_optimised_camera.kitti"),
            read_file(folder("short") / "trajectory_camera.kitti"));
}

TEST_F(LoopsVerb, NeedMetres) {
  run("block", "unscaled", {"--loops", "--set", "front_end.scale.source=none"});
  EXPECT_TRUE(read_csv(folder("unscaled") / "loops.csv").empty());
  const auto summary = nlohmann::json::parse(read_file(folder("unscaled") / "summary.json"));
  EXPECT_EQ(summary["loops"]["keyframes_not_metric"], summary["loops"]["keyframes"]);
}

/// The first streets of a block, twice at different speeds, and of another block.
class LogsTogether : public ::testing::Test {
 protected:
  static inline std::unique_ptr<TemporaryFolder> shared;
  static inline ProgramResult joined;

  static void SetUpTestSuite() {
    shared = std::make_unique<TemporaryFolder>();
    simulate("a", {"--seed", "3"});
    simulate("b", {"--seed", "3", "--speed", "6.5"});
    simulate("other", {"--seed", "4"});
    joined = run({"a", "b", "other"}, "joined", {"--loops", "--count", "120"});
    ASSERT_EQ(joined.exit_code, 0) << joined.err;
  }
  static void TearDownTestSuite() { shared.reset(); }

  static fs::path folder(const std::string& name) { return shared->path() / name; }
  static std::string log_of(const std::string& name) {
    return (folder(name) / "simulated.rawlog").string();
  }
  static void simulate(const std::string& name, const std::vector<std::string>& extra,
                       const std::string& focal_px = "312") {
    std::vector<std::string> arguments{"simulate",
                                       "-o",
                                       folder(name).string(),
                                       "--route",
                                       "block",
                                       "--laps",
                                       "1",
                                       "--block-m",
                                       "40",
                                       "--width",
                                       "400",
                                       "--height",
                                       "300",
                                       "--focal",
                                       focal_px,
                                       "--no-progress"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult made = oneac_program(arguments);
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static ProgramResult run(const std::vector<std::string>& names, const std::string& out,
                           const std::vector<std::string>& extra) {
    std::vector<std::string> arguments{"run"};
    for (const std::string& name : names) arguments.push_back(log_of(name));
    arguments.insert(arguments.end(), {"-o", folder(out).string(), "--no-progress"});
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return oneac_program(arguments);
  }
};

TEST_F(LogsTogether, HaveLoopsWhereTheySawOnePlaceAndNoneWhereNot) {
  const Trajectory a = read_kitti(folder("a") / "poses.txt");
  const Trajectory b = read_kitti(folder("b") / "poses.txt");  // begins where the other does
  std::size_t between = 0;
  for (const Row& loop : read_csv(folder("joined") / "loops.csv")) {
    if (loop.at("log1") == loop.at("log2")) continue;
    ++between;
    ASSERT_EQ(loop.at("log1"), 1.0);
    ASSERT_EQ(loop.at("log2"), 2.0);
    const Eigen::Isometry3d T = b.poses.at(static_cast<std::size_t>(loop.at("index2"))).inverse() *
                                a.poses.at(static_cast<std::size_t>(loop.at("index1")));
    const Eigen::Vector3d t(loop.at("tx"), loop.at("ty"), loop.at("tz"));
    EXPECT_LT((t - T.translation()).norm(), 0.3) << loop.at("index1") << " " << loop.at("index2");
  }
  EXPECT_GT(between, 40U);
  const auto summary = nlohmann::json::parse(read_file(folder("joined") / "summary.json"));
  EXPECT_EQ(summary["loops"]["between_logs"], between);
  EXPECT_TRUE(summary["logs"][1]["joined_to_first"]);
  EXPECT_FALSE(summary["logs"][2]["joined_to_first"]);
  EXPECT_NE(joined.err.find("other/simulated.rawlog is not joined to"), std::string::npos)
      << joined.err;
  EXPECT_NE(joined.out.find("2 of 3 logs in the frame of"), std::string::npos) << joined.out;
}

TEST_F(LogsTogether, StandInOneFrame) {
  const Trajectory truth = read_kitti(folder("b") / "poses.txt");
  const auto poses = read_tum(folder("joined") / "2" / "trajectory_optimised_camera.tum").poses;
  ASSERT_EQ(poses.size(), 120U);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT((poses[i].translation() - truth.poses[i].translation()).norm(), 0.6) << i;
  }
  const G2oGraph graph = read_g2o(folder("joined") / "graph.g2o");
  std::size_t keyframes = 0;
  for (const char* log : {"1", "2", "3"}) {
    keyframes += read_tum(folder("joined") / log / "keyframes.tum").poses.size();
  }
  EXPECT_EQ(graph.vertices.size(), keyframes);
  EXPECT_NE(read_file(folder("joined") / "report.html").find("loops between logs"),
            std::string::npos);
}

TEST_F(LogsTogether, HaveTheFilesOfARunOfTheirOwn) {
  const ProgramResult alone = run({"b"}, "alone", {"--count", "120"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  for (const char* name : {"trajectory_camera.kitti", "trajectory_vehicle.tum",
                           "relative_poses.csv", "covariance.csv", "keyframes.tum"}) {
    EXPECT_EQ(read_file(folder("joined") / "2" / name), read_file(folder("alone") / name)) << name;
  }
}

TEST_F(LogsTogether, LeaveNothingToTheNextRunInTheirFolder) {
  ASSERT_EQ(run({"a", "b"}, "again", {"--loops", "--count", "6"}).exit_code, 0);
  ASSERT_TRUE(fs::exists(folder("again") / "2" / "summary.json"));
  ASSERT_EQ(run({"a"}, "again", {"--count", "6"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder("again") / "2"));
  EXPECT_FALSE(fs::exists(folder("again") / "loops.csv"));
}

TEST_F(LogsTogether, AreRefusedInALineWhereTheyCannotBeJoined) {
  simulate("wide", {"--seed", "3"}, "280");
  const auto refused = [&](const ProgramResult& result, const std::string& why) {
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  refused(run({"a", "b"}, "no", {}), "add --loops");
  refused(run({"a", "a"}, "no", {"--loops"}), "is given twice");
  fs::create_directory_symlink(folder("a"), folder("linked"));
  refused(run({"a", "linked"}, "no", {"--loops"}), "is given twice");
  refused(run({"a", "wide"}, "no", {"--loops"}), "its camera is another");
  refused(run({"a", "b"}, "no", {"--loops", "--reference", "poses.txt"}), "belongs to one log");
  refused(run({"a", "b"}, "no", {"--loops", "--gui"}), "shows one drive");
}

}  // namespace
}  // namespace oneac
