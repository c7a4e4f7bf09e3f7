#include "live_support.h"

#include "oneac/base/error.h"
#include "oneac/evaluation/trajectory_io.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/serialization/CArchive.h>

#include <fstream>
#include <iterator>

namespace oneac {
namespace {

constexpr double kAhead = 1.5;  // [s] as `oneac run` hands over speeds

template <class Class>
bool is(const mrpt::obs::CObservation::Ptr& observation) {
  return std::dynamic_pointer_cast<Class>(observation) != nullptr;
}

}  // namespace

std::unique_ptr<TemporaryFolder> LiveFixture::shared_;

Observations read_log(const std::filesystem::path& log) {
  mrpt::io::CFileGZInputStream file(log.string());
  auto archive = mrpt::serialization::archiveFrom(file);
  Observations observations;
  while (!file.checkEOF()) {
    try {
      const auto object = archive.ReadObject();
      const auto one = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
      if (one) observations.push_back(one);
    } catch (const mrpt::serialization::CExceptionEOF&) {
      break;
    }
  }
  return observations;
}

void write_log(const std::filesystem::path& log, const Observations& observations) {
  mrpt::io::CFileGZOutputStream file(log.string());
  auto archive = mrpt::serialization::archiveFrom(file);
  for (const auto& observation : observations) archive << *observation;
}

std::string feed_all(const Observations& observations, const FrontEndOptions& options) {
  FrontEnd front_end(options);
  front_end.logging_enable_console_output = false;
  Observations speeds;
  for (const auto& observation : observations) {
    if (is<mrpt::obs::CObservationIMU>(observation)) front_end.feed(observation);
    if (is<mrpt::obs::CObservationGPS>(observation)) speeds.push_back(observation);
  }
  std::size_t next = 0;
  for (const auto& observation : observations) {
    if (is<mrpt::obs::CObservationOdometry>(observation)) front_end.feed(observation);
    if (!is<mrpt::obs::CObservationImage>(observation) &&
        !is<mrpt::obs::CObservationStereoImages>(observation)) {
      continue;
    }
    const double until = mrpt::Clock::toDouble(observation->timestamp) + kAhead;
    while (next < speeds.size() && mrpt::Clock::toDouble(speeds[next]->timestamp) <= until) {
      front_end.feed(speeds[next++]);
    }
    front_end.feed(observation);
  }
  front_end.finish();
  Trajectory trajectory;
  for (const FramePose& pose : front_end.trajectory().poses()) {
    trajectory.times.push_back(pose.time_s);
    trajectory.poses.push_back(pose.T_first_cam);
  }
  return format_kitti(trajectory);
}

std::string refusal_of_feed(const Observations& observations) {
  try {
    static_cast<void>(feed_all(observations, FrontEndOptions{}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string run_all(const std::filesystem::path& log, std::vector<std::string> arguments) {
  const TemporaryFolder out;
  arguments.insert(arguments.begin(), {ONEAC_PROGRAM, "run", log.string(), "-o",
                                       out.path().string(), "--no-progress"});
  const ProgramResult run = run_program(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  if (run.exit_code != 0) return {};
  std::ifstream file(out.path() / "trajectory_camera.kitti");
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_same(const std::string& fed, const std::string& run) {
  EXPECT_TRUE(fed == run) << "fed:\n" << fed << "run:\n" << run;
  const TemporaryFolder folder;
  const auto file = folder.path() / "fed.kitti";
  std::ofstream(file) << fed;
  const Trajectory trajectory = read_kitti(file);
  ASSERT_GT(trajectory.poses.size(), 1U);
  EXPECT_GT(trajectory.poses.back().translation().norm(), 0.1);
}

void LiveFixture::SetUpTestSuite() {
  shared_ = std::make_unique<TemporaryFolder>();
  const ProgramResult made = run_program(
      {ONEAC_PROGRAM, "simulate", "-o", (shared_->path() / "drive").string(), "--frames", "14",
       "--seed", "5", "--width", "400", "--height", "300", "--focal", "310"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
}

void LiveFixture::TearDownTestSuite() {
  shared_.reset();
}

void LiveFixture::SetUp() {
  mrpt::img::CImage::setImagesPathBase(images().string());
}

std::filesystem::path LiveFixture::changed_log(
    const std::function<void(mrpt::obs::CObservationImage&, int)>& change) const {
  const Observations observations = read_log(log());
  int count = 0;
  for (const auto& observation : observations) {
    const auto image = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(observation);
    if (image) change(*image, count++);
  }
  const auto file = scratch() / "changed.rawlog";
  write_log(file, observations);
  return file;
}

}  // namespace oneac
