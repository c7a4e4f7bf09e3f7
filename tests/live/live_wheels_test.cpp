#include "live_support.h"

#include "oneac/evaluation/relative_poses_io.h"
#include "oneac/evaluation/trajectory_io.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace oneac {
namespace {

using mrpt::obs::CObservationOdometry;

/// A street with a bend whose log tells no height of the camera, and whose wheels are taken to be
/// 2.5 % larger than they are.
class WheelsDrive : public ::testing::Test {
 protected:
  /// @param t  since the start of the drive [s]
  using Change = std::function<void(CObservationOdometry&, double t)>;

  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const ProgramResult made = run_program({ONEAC_PROGRAM,
                                            "simulate",
                                            "-o",
                                            drive().string(),
                                            "--frames",
                                            "80",
                                            "--seed",
                                            "3",
                                            "--width",
                                            "400",
                                            "--height",
                                            "300",
                                            "--focal",
                                            "310",
                                            "--stop",
                                            "0",
                                            "--silent-mount",
                                            "--odometry",
                                            "--wheel-error",
                                            "2.5"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    mrpt::img::CImage::setImagesPathBase((drive() / "Images").string());
  }
  static void TearDownTestSuite() { shared_.reset(); }
  static std::filesystem::path drive() { return shared_->path() / "drive"; }
  static std::filesystem::path log() { return drive() / "simulated.rawlog"; }

  /// The drive with its odometry changed.
  [[nodiscard]] std::filesystem::path changed(const Change& change) const {
    const Observations observations = read_log(log());
    const double start = mrpt::Clock::toDouble(observations.front()->timestamp);
    for (const auto& one : observations) {
      const auto wheels = std::dynamic_pointer_cast<CObservationOdometry>(one);
      if (wheels) change(*wheels, mrpt::Clock::toDouble(wheels->timestamp) - start);
    }
    write_log(scratch_.path() / "changed.rawlog", observations);
    return scratch_.path() / "changed.rawlog";
  }

  ProgramResult run(const std::filesystem::path& log) {
    const ProgramResult run = run_program(
        {ONEAC_PROGRAM, "run", log.string(), "-o", out().string(), "--no-progress", "--set",
         "front_end.scale.source=wheels", "--images-dir", (drive() / "Images").string()});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run;
  }
  [[nodiscard]] std::filesystem::path out() const { return scratch_.path() / "out"; }

  struct Lengths {
    std::size_t metric = 0, within_two_sigma = 0, within_three = 0;
    double worst = 0.0;  ///< relative error of a metric length
  };
  [[nodiscard]] Lengths lengths() const {
    const Trajectory truth = read_trajectory(drive() / "poses.txt");
    Lengths result;
    for (const RelativePoseRow& row : read_relative_poses(out() / "relative_poses.csv")) {
      if (!row.metric) continue;
      const double length =
          (truth.poses[row.index2].translation() - truth.poses[row.index1].translation()).norm();
      const double error = std::abs(row.T_2_1.t.norm() - length);
      ++result.metric;
      result.within_two_sigma += error <= 2.0 * *row.sigma_length ? 1 : 0;
      result.within_three += error <= 3.0 * *row.sigma_length ? 1 : 0;
      result.worst = std::max(result.worst, error / length);
    }
    return result;
  }

  /// Never metric and wrong.
  void expect_true_or_not_metric(const char* name, const Change& change) {
    run(changed(change));
    const Lengths found = lengths();
    EXPECT_EQ(found.within_three, found.metric) << name << ", worst " << found.worst;
    EXPECT_LT(found.worst, 0.1) << name;
  }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder scratch_;
};

std::unique_ptr<TemporaryFolder> WheelsDrive::shared_;

void move(CObservationOdometry& wheels, double ahead) {
  wheels.odometry.x(wheels.odometry.x() + ahead);
}

TEST_F(WheelsDrive, AnHourOffTheImagesIsSaidWithTheSpans) {
  for (const double off_s : {-3600.0, 3600.0}) {
    const ProgramResult result = run(changed([off_s](CObservationOdometry& wheels, double) {
      const double time_s = mrpt::Clock::toDouble(wheels.timestamp);
      wheels.timestamp = mrpt::Clock::fromDouble(time_s + off_s);
    }));
    const bool early = result.err.find("do not overlap the images (") != std::string::npos;
    const bool late =
        result.err.find("the wheels told no speed before the last image (") != std::string::npos;
    EXPECT_TRUE(early || late) << off_s << ": " << result.err;
    EXPECT_EQ(lengths().metric, 0U);
  }
}

TEST_F(WheelsDrive, GivesMetresWithTrueSigmasWithoutAHeight) {
  const ProgramResult result = run(log());
  const Lengths found = lengths();
  EXPECT_GT(found.metric, 25U) << result.err;
  EXPECT_GE(10 * found.within_two_sigma, 9 * found.metric);
  EXPECT_GT(found.worst, 0.01) << "the wheels' own error is there";
}

TEST_F(WheelsDrive, GivesThePosesOfRunBitByBit) {
  FrontEndOptions options;
  options.scale.source = "wheels";
  expect_same(feed_all(read_log(log()), options),
              run_all(log(), {"--set", "front_end.scale.source=wheels", "--images-dir",
                              (drive() / "Images").string()}));
}

TEST_F(WheelsDrive, IsNeverMetricAndWrongByWheelsThatFail) {
  expect_true_or_not_metric("jump", [](auto& w, double t) { move(w, t > 4.0 ? 30.0 : 0.0); });
  expect_true_or_not_metric("jump at the start",
                            [](auto& w, double t) { move(w, t > 0.3 ? 3.0 : 0.0); });
  expect_true_or_not_metric("set back", [](auto& w, double t) {
    if (t > 4.0) move(w, -w.odometry.x() + t);
  });
  expect_true_or_not_metric("jumps again and again",
                            [](auto& w, double t) { move(w, 2.0 * std::floor(3.0 * t)); });
  expect_true_or_not_metric(
      "spin for a second", [](auto& w, double t) { move(w, 8.0 * std::clamp(t - 5.0, 0.0, 1.0)); });
  expect_true_or_not_metric("spin from then on",
                            [](auto& w, double t) { move(w, 8.0 * std::max(t - 5.0, 0.0)); });
  expect_true_or_not_metric("spin at the start",
                            [](auto& w, double t) { move(w, 8.0 * std::min(t, 1.5)); });
}

TEST_F(WheelsDrive, IsNotMetricByWheelsThatStandOrTellNothing) {
  const auto fault = [this](const Change& change) { return run(changed(change)).err; };
  const std::string standing =
      fault([](auto& w, double) { w.odometry = mrpt::poses::CPose2D(1.0, 2.0, 0.0); });
  EXPECT_EQ(lengths().metric, 0U);
  EXPECT_NE(standing.find("the wheels told no speeds above walking pace"), std::string::npos);
  const std::string damaged =
      fault([](auto& w, double) { w.odometry.x(std::numeric_limits<double>::quiet_NaN()); });
  EXPECT_EQ(lengths().metric, 0U);
  EXPECT_NE(damaged.find("the log holds no odometry of wheels"), std::string::npos);
  fault([](auto& w, double) {
    w.hasVelocities = true;  // frozen, and far from the 8 m/s of the drive
    w.velocityLocal.vx = 3.0;
  });
  EXPECT_EQ(lengths().metric, 0U);
}

TEST_F(WheelsDrive, GoesOnByTheMapWhereWheelsFail) {
  run(changed([](auto& w, double t) {
    if (t > 5.0) w.odometry = mrpt::poses::CPose2D(0.0, 0.0, 0.0);
  }));
  const Lengths found = lengths();
  EXPECT_EQ(found.within_three, found.metric);
  EXPECT_GT(found.metric, 8U);
}

}  // namespace
}  // namespace oneac
