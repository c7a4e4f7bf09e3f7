#include "commands.h"
#include "interrupt.h"
#include "progress_bar.h"

#include "oneac/base/error.h"
#include "oneac/rawlog/drive_recorder.h"
#include "oneac/simulation/street_simulator.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace oneac::app {
namespace {

struct SimulateArguments {
  SimulationOptions options;
  std::filesystem::path folder;
  std::string mount = "x_forward";
  int threads = 0;
  bool no_progress = false;
};

/// The drive starts in the middle of Málaga.
constexpr GeodeticPosition kOrigin{36.7242, -4.4762, 70.0};

std::vector<GpsRecord> gps_records(const StreetSimulator& simulator) {
  std::vector<GpsRecord> records;
  for (const SimulatedGps& fix : simulator.gps()) {
    GpsRecord record;
    record.time_s = fix.time_s;
    record.label = "GPS";
    record.position = geodetic_from_enu(fix.position_m, kOrigin);
    record.satellites = 9;
    record.velocity = GroundVelocity{fix.speed_mps, fix.course_deg};
    records.push_back(record);
  }
  return records;
}

std::vector<ImuRecord> imu_records(const StreetSimulator& simulator) {
  std::vector<ImuRecord> records;
  for (const SimulatedImu& reading : simulator.imu()) {
    records.push_back(
        {reading.time_s, "IMU", reading.specific_force_mps2, reading.angular_rate_radps});
  }
  return records;
}

DriveRecording recording_of(const StreetSimulator& simulator) {
  DriveRecording drive;
  drive.camera = simulator.camera();
  drive.T_vehicle_cam = simulator.T_vehicle_cam();
  drive.baseline_m = simulator.options().stereo ? simulator.options().baseline_m : 0.0;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    const SimulatedState state = simulator.state(i);
    drive.times_s.push_back(state.time_s);
    drive.T_world_cam.push_back(state.T_world_cam);
  }
  drive.images = [&simulator](std::size_t i) {
    SimulatedFrame frame = simulator.frame(i);
    return DriveImages{std::move(frame.left), std::move(frame.right)};
  };
  drive.gps = gps_records(simulator);
  drive.imu = imu_records(simulator);
  return drive;
}

int number_of_threads(int wanted) {
  if (wanted > 0) return wanted;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void validate(const SimulationOptions& options) {
  try {
    options.validate();
  } catch (const std::invalid_argument& error) {
    throw InputError("simulate", error.what(), "see oneac simulate --help");
  }
}

void simulate(const SimulateArguments& arguments) {
  validate(arguments.options);
  catch_interrupts();
  const StreetSimulator simulator(arguments.options);
  DriveRecording drive = recording_of(simulator);
  if (arguments.mount == "optical") drive.convention = MountConvention::optical;
  drive.threads = number_of_threads(arguments.threads);
  std::size_t written = 0;
  RecordedDrive files;
  {
    ProgressBar bar(!arguments.no_progress);
    drive.keep_going = [&](std::size_t done) {
      written = done;
      bar.update(static_cast<double>(done) / static_cast<double>(simulator.size()), done);
      return !interrupted();
    };
    files = record_drive(drive, arguments.folder);
  }
  if (written < simulator.size()) {
    std::cerr << "oneac: interrupted after " << written << " of " << simulator.size()
              << " frames; what exists is complete\n";
  }
  std::cout << "log     " << files.log.string() << '\n'
            << "images  " << files.images.string() << " (" << written
            << (arguments.options.stereo ? " pairs" : "") << ")\n"
            << "poses   " << files.poses.string() << '\n';
}

void add_camera_options(CLI::App& verb, SimulationOptions& options) {
  verb.add_option("--width", options.width_px, "[px]")->capture_default_str();
  verb.add_option("--height", options.height_px, "[px]")->capture_default_str();
  verb.add_option("--focal", options.focal_px, "[px]")->capture_default_str();
  verb.add_option("--fps", options.fps, "[Hz]")->capture_default_str();
  verb.add_option("--tilt-deg", options.camera_tilt_deg, "Camera, upwards [deg]")
      ->capture_default_str();
  verb.add_option("--camera-height", options.camera_height_m, "Above the road [m]")
      ->capture_default_str();
  verb.add_option("--noise", options.image_noise, "Std. deviation [grey levels]")
      ->capture_default_str();
  verb.add_flag("--stereo", options.stereo, "Write stereo observations");
  verb.add_option("--baseline", options.baseline_m, "Of the stereo pair [m]")
      ->capture_default_str();
}

void add_drive_options(CLI::App& verb, SimulationOptions& options) {
  verb.add_option("--frames", options.frames, "Number of images")->capture_default_str();
  verb.add_option("--seed", options.seed, "Everything random follows from it")
      ->capture_default_str();
  verb.add_option("--speed", options.speed_mps, "On straights [m/s]")->capture_default_str();
  verb.add_option("--stop", options.stop_s, "Standing on every second street [s]; 0: none")
      ->capture_default_str();
  verb.add_option("--suspension-pitch", options.suspension_pitch_deg, "Std. deviation [deg]")
      ->capture_default_str();
  verb.add_option("--suspension-roll", options.suspension_roll_deg, "Std. deviation [deg]")
      ->capture_default_str();
  verb.add_option("--slope", options.slope_percent, "Of the whole town, along the first street [%]")
      ->capture_default_str();
  verb.add_flag("--crossing-traffic", options.crossing_traffic,
                "A vehicle crosses every street before the camera");
  verb.add_option("--dark-from", options.dark_from_s, "Nearly black images from here on [s] ...")
      ->capture_default_str();
  verb.add_option("--dark", options.dark_s, "... for so long [s]; 0: never")->capture_default_str();
  verb.add_option("--gps-noise", options.gps_noise_m, "Std. deviation per axis [m]")
      ->capture_default_str();
}

}  // namespace

void add_simulate(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "simulate", "A street drive in the Malaga layout: rawlog, images, GPS, IMU, true poses");
  const auto arguments = std::make_shared<SimulateArguments>();
  verb->add_option("-o,--output", arguments->folder, "Folder to write to")->required();
  add_drive_options(*verb, arguments->options);
  add_camera_options(*verb, arguments->options);
  verb->add_option("--mount", arguments->mount, "Axes of the camera's pose in the log")
      ->check(CLI::IsMember({"x_forward", "optical"}))
      ->capture_default_str();
  verb->add_option("--threads", arguments->threads, "0: as many as the machine has")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_flag("--no-progress", arguments->no_progress, "Show none, even on a terminal");
  verb->callback([arguments] { simulate(*arguments); });
}

}  // namespace oneac::app
