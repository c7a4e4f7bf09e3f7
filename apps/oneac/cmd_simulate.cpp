#include "commands.h"
#include "simulate/simulate_flags.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"
#include "terminal/progress_bar.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/printable.h"
#include "oneac/geometry/camera_frame.h"
#include "oneac/rawlog/drive_recorder.h"
#include "oneac/simulation/laps.h"
#include "oneac/simulation/street_simulator.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace oneac::app {
namespace {

struct SimulateArguments {
  SimulationOptions options;
  std::filesystem::path folder;
  std::string mount = "x_forward";
  bool silent_mount = false;
  std::string calibration_error = "none";
  int threads = 0;
  int laps = 0;
  bool odometry = false;
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

std::vector<OdometryRecord> wheel_records(const StreetSimulator& simulator) {
  std::vector<OdometryRecord> records;
  for (const SimulatedWheels& reading : simulator.wheels()) {
    records.push_back({reading.time_s, "WHEELS", reading.position_m, reading.heading_rad});
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

/// What the log says of the camera, where it does not tell the truth.
void falsify(DriveRecording& drive, const SimulateArguments& arguments) {
  if (arguments.silent_mount) {
    drive.T_vehicle_cam = CameraFrame::forward_looking_mount();
    drive.convention = MountConvention::x_forward;  // all zero there
  }
  PinholeCamera& camera = drive.camera;
  const std::string& error = arguments.calibration_error;
  if (error == "full-size") {
    camera.fx *= 2.0, camera.fy *= 2.0;
    camera.cx = 2.0 * camera.cx + 0.5, camera.cy = 2.0 * camera.cy + 0.5;
  } else if (error == "focal-5") {
    camera.fx = camera.fy = 5.0;
  } else if (error == "swapped") {
    std::swap(camera.cx, camera.cy);
  } else if (error == "focal-10-percent") {
    camera.fx *= 1.1, camera.fy *= 1.1;
  }
}

int number_of_threads(int wanted) {
  if (wanted > 0) return wanted;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void validate(const SimulationOptions& options) {
  try {
    options.validate();
  } catch (const std::invalid_argument& error) {
    throw InputError("simulate", in_words_of_flags(error.what()), "see oneac simulate --help");
  }
}

/// The drive that was asked for: as many frames as its laps take.
SimulationOptions drive_of(const SimulateArguments& arguments) {
  SimulationOptions options = arguments.options;
  validate(options);
  if (arguments.laps == 0) return options;
  if (!has_laps(options.route)) {
    throw InputError("simulate", "--laps counts those of a block or a figure 8",
                     "add --route block or figure8");
  }
  options.frames = frames_for_laps(options, arguments.laps);
  validate(options);
  return options;
}

/// Which of the written frames see a place again.
void write_loops(const StreetSimulator& simulator, std::size_t written,
                 const std::filesystem::path& path) {
  write_file_atomically(path, [&](std::ostream& out) {
    out.precision(9);
    out << "index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz\n";
    for (const TrueLoop& loop : true_loops(simulator)) {
      if (loop.index2 >= written) break;
      const Eigen::Quaterniond q(loop.T_2_1.linear());
      const Eigen::Vector3d t = loop.T_2_1.translation();
      out << loop.index1 << ',' << loop.index2 << ',' << simulator.state(loop.index1).time_s << ','
          << simulator.state(loop.index2).time_s << ',' << q.w() << ',' << q.x() << ',' << q.y()
          << ',' << q.z() << ',' << t.x() << ',' << t.y() << ',' << t.z() << '\n';
    }
  });
}

void simulate(const SimulateArguments& arguments) {
  catch_interrupts();
  const StreetSimulator simulator(drive_of(arguments));
  DriveRecording drive = recording_of(simulator);
  if (arguments.odometry) drive.wheels = wheel_records(simulator);
  if (arguments.mount == "optical") drive.convention = MountConvention::optical;
  falsify(drive, arguments);
  drive.threads = number_of_threads(arguments.threads);
  std::size_t written = 0;
  RecordedDrive files;
  {
    ProgressBar bar(!arguments.no_progress);
    bar.expect(simulator.size());
    drive.keep_going = [&](std::size_t done) {
      written = done;
      bar.update(done);
      return !interrupted();
    };
    files = record_drive(drive, arguments.folder);
  }
  if (written < simulator.size()) {
    std::cerr << "oneac: interrupted after " << written << " of " << simulator.size()
              << " frames; what exists is complete\n";
  }
  std::cout << "log     " << printable(files.log.string()) << '\n'
            << "images  " << printable(files.images.string()) << " (" << written
            << (arguments.options.stereo ? " pairs" : "") << ")\n"
            << "poses   " << printable(files.poses.string()) << '\n';
  if (!has_laps(arguments.options.route)) return;
  const std::filesystem::path loops = arguments.folder / "loops_true.csv";
  write_loops(simulator, written, loops);
  std::cout << "loops   " << printable(loops.string()) << '\n';
}

}  // namespace

void add_simulate(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "simulate", "A street drive in the Malaga layout: rawlog, images, GPS, IMU, true poses");
  const auto arguments = std::make_shared<SimulateArguments>();
  verb->add_option("-o,--output", arguments->folder, "Folder to write to")->required();
  add_simulation_flags(*verb, arguments->options);
  verb->add_option("--mount", arguments->mount, "Axes of the camera's pose in the log")
      ->check(CLI::IsMember({"x_forward", "optical"}))
      ->capture_default_str();
  verb->add_flag("--silent-mount", arguments->silent_mount,
                 "The log has the pose of a camera at the vehicle's origin, as most real logs");
  verb->add_option("--calibration-error", arguments->calibration_error,
                   "The log's calibration is wrong: of images twice as large, with a focal length "
                   "of 5 px, with the principal point's coordinates swapped, with a focal length "
                   "10 % too long")
      ->check(CLI::IsMember({"none", "full-size", "focal-5", "swapped", "focal-10-percent"}))
      ->capture_default_str();
  verb->add_option("--laps", arguments->laps, "As many frames as this many laps take")
      ->check(above_zero())
      ->excludes("--frames");
  verb->add_flag("--odometry", arguments->odometry,
                 "The log has the odometry of the vehicle's wheels, too");
  verb->add_option("--threads", arguments->threads, "0: as many as the machine has")
      ->check(at_least_zero())
      ->capture_default_str();
  verb->add_flag("--no-progress", arguments->no_progress, "Show none, even on a terminal");
  verb->callback([arguments] { simulate(*arguments); });
}

}  // namespace oneac::app
