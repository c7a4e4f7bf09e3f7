#include "commands.h"

#include "oneac/base/printable.h"
#include "oneac/rawlog/import_drive.h"
#include "oneac/rawlog/import_kitti.h"
#include "oneac/rawlog/import_malaga.h"
#include "oneac/rawlog/import_rosbag.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace oneac::app {
namespace {

void print(const ImportReport& report) {
  for (const std::string& note : report.notes)
    std::cerr << "oneac: note: " << printable(note) << '\n';
  std::cout << "log     " << printable(report.log.string()) << '\n'
            << "cameras " << report.observations << " observations, " << report.images
            << " images\n";
  if (report.gps + report.imu + report.wheels > 0) {
    std::cout << "sensors " << report.gps << " GPS epochs, " << report.imu << " IMU samples";
    if (report.wheels > 0) std::cout << ", " << report.wheels << " odometer readings";
    std::cout << '\n';
  }
  if (!report.poses.empty()) std::cout << "poses   " << printable(report.poses.string()) << '\n';
}

/// @return the three angles
std::vector<CLI::Option*> add_mount(CLI::App& verb, MountAngles& mount,
                                    MountConvention& convention) {
  static const std::map<std::string, MountConvention> kConventions = {
      {"optical", MountConvention::optical}, {"x_forward", MountConvention::x_forward}};
  verb.add_option_function<std::string>(
          "--mount-convention",
          [&convention](const std::string& name) { convention = kConventions.at(name); },
          "Axes in which the log stores the camera's pose: optical or x_forward")
      ->check(CLI::IsMember({"optical", "x_forward"}));
  return {verb.add_option("--mount-roll", mount.roll_right_deg,
                          "Camera turned to the right about its optical axis [deg]: 180 upside "
                          "down, 90 or -90 portrait"),
          verb.add_option("--mount-pitch", mount.pitch_up_deg, "Looks above the horizon [deg]"),
          verb.add_option("--mount-yaw", mount.yaw_left_deg, "Looks to the left [deg]: 180 rear")};
}

constexpr const char* kCalibration =
    "FILE[:SECTION] of MRPT, KITTI, OpenCV, ROS, Kalibr, COLMAP or ORB-SLAM";

/// Before folders are made for what cannot be written.
CLI::Validator names_a_file() {
  return {[](std::string& text) {
            const std::filesystem::path file(text);
            std::error_code ignored;
            const bool folder =
                !file.has_filename() || std::filesystem::is_directory(file, ignored);
            return folder ? "'" + printable(text) + "' is a folder; name the rawlog to write"
                          : std::string();
          },
          ""};
}

void add_rate(CLI::App& verb, std::optional<double>& fps) {
  verb.add_option("--fps", fps, "Images per second, instead of the source's own times, 0.5 to 250");
}

void add_drive(CLI::App& verb, DriveImport& options, const std::string& source) {
  verb.add_option("SRC", options.source, source)->required();
  verb.add_option("-o,--output", options.log, "Rawlog to write")->required();
  verb.add_option("--calibration", options.calibration, kCalibration);
  verb.add_option("--camera-height", options.camera_height_m,
                  "Of the lens above the road [m], 0.3 to 5");
  add_rate(verb, options.fps);
  add_mount(verb, options.mount, options.convention);
}

using Importer = ImportReport (*)(const DriveImport&);

void add_folder(CLI::App& import, const char* name, const char* what, const char* source,
                Importer importer) {
  auto* verb = import.add_subcommand(name, what);
  const auto options = std::make_shared<DriveImport>();
  add_drive(*verb, *options, source);
  verb->add_flag("--copy-images", options->copy_images,
                 "Copy the images to <log>_Images instead of referring to them");
  verb->callback([options, importer] { print(importer(*options)); });
}

void add_video(CLI::App& import) {
  auto* verb = import.add_subcommand("video", "A video, whose frames are decoded to <log>_Images");
  const auto options = std::make_shared<VideoImport>();
  add_drive(*verb, *options, "File that FFmpeg reads: MP4, MKV, AVI, MOV ...");
  verb->add_option("--from", options->from_s, "Seconds of the video that are left out");
  verb->add_option("--to", options->to_s, "Second of the video at which to stop");
  verb->add_option("--nmea", options->nmea, "GPS of the drive: a file of NMEA sentences");
  verb->add_option("--gpx", options->gpx, "GPS of the drive: a GPX track");
  verb->add_option("--csv", options->csv,
                   "GPS of the drive: a table with columns time, lat, lon (ele, speed_mps, "
                   "speed_kmh or speed_knots, course)");
  verb->add_option("--start", options->start,
                   "When the video begins: seconds since 1970, or UTC as 2024-05-01T10:00:00Z; "
                   "without it with the first fix of the GPS");
  verb->callback([options] { print(import_video(*options)); });
}

/// Name, type and count of each, for who has to choose.
void print(const std::vector<BagTopic>& topics) {
  std::size_t name = 0, type = 0;
  for (const BagTopic& topic : topics) {
    name = std::max(name, topic.name.size());
    type = std::max(type, topic.type.size());
  }
  for (const BagTopic& topic : topics) {
    const std::string count = std::to_string(topic.messages);
    std::cout << printable(topic.name) << std::string(name - topic.name.size() + 2, ' ')
              << printable(topic.type) << std::string(type - topic.type.size() + 2, ' ') << count
              << '\n';
  }
}

/// Without a choice of the images, and with several to choose from, what there is is listed.
void import_bag(const RosbagImport& options) {
  if (options.image_topic.empty()) {
    const std::vector<BagTopic> topics = topics_of_bag(options.source);
    if (std::count_if(topics.begin(), topics.end(), has_images) != 1) print(topics);
  }
  print(import_rosbag(options));
}

void add_rosbag(CLI::App& import) {
  auto* verb = import.add_subcommand(
      "rosbag", "A bag of ROS 1, whose images are written to <log>_Images; ROS 2: rosbag2rawlog");
  const auto options = std::make_shared<RosbagImport>();
  add_drive(*verb, *options, "FILE.bag; its topics are listed where its images have to be chosen");
  verb->add_option("--image-topic", options->image_topic,
                   "Image or CompressedImage; without it the only one there is");
  verb->add_option("--right-topic", options->right_topic,
                   "The same of the right camera of a rectified pair");
  verb->add_option("--camera-info-topic", options->camera_info_topic,
                   "CameraInfo; without it the one beside the images, or the only one");
  verb->add_option("--gps-topic", options->gps_topic,
                   "NavSatFix; without it the only one there is");
  verb->add_option("--imu-topic", options->imu_topic,
                   "Imu with the axes of the vehicle: X ahead, Y left, Z up");
  verb->add_option("--wheels-topic", options->wheels_topic,
                   "Odometry of the wheels alone, not of a filter");
  verb->callback([options] { import_bag(*options); });
}

DriveImport drive_of(const KittiImport& options) {
  DriveImport drive;
  drive.source = options.source;
  drive.log = options.log;
  drive.copy_images = options.copy_images;
  drive.calibration = options.calibration;
  drive.camera_height_m = options.camera_height_m;
  drive.mount = options.mount;
  drive.convention = options.convention;
  drive.fps = options.fps;
  return drive;
}

void add_kitti(CLI::App& import) {
  auto* verb = import.add_subcommand(
      "kitti", "KITTI odometry sequence, a drive of its raw data, or a folder in either layout");
  const auto options = std::make_shared<KittiImport>();
  verb->add_option("SRC", options->source,
                   "Folder with image_0, image_l, image_2 or images (png, jpg) and calib.txt; "
                   "image_1 or image_3, times.txt and poses.txt when present. Raw data: "
                   "image_00/data, image_00/timestamps.txt, oxts, calib_cam_to_cam.txt beside or "
                   "above")
      ->required();
  verb->add_option("-o,--output", options->log, "Rawlog to write")->required();
  verb->add_option("--calibration", options->calibration,
                   std::string(kCalibration) + ", instead of the sequence's own");
  verb->add_flag("--copy-images", options->copy_images,
                 "Copy the images to <log>_Images instead of referring to them");
  verb->add_option("--camera-height", options->camera_height_m,
                   "Of the lens above the road [m], 0.3 to 5; without it 1.65 where focal length "
                   "and size of the images are KITTI's, else the log has none");
  add_rate(*verb, options->fps);
  add_mount(*verb, options->mount, options->convention);
  verb->callback([options] {
    const bool raw = is_kitti_raw(options->source);
    print(raw ? import_kitti_raw(drive_of(*options)) : import_kitti(*options));
  });
}

void add_malaga(CLI::App& import) {
  auto* verb = import.add_subcommand("malaga", "Extract of the Malaga Urban Dataset");
  const auto options = std::make_shared<MalagaImport>();
  verb->add_option("SRC", options->source,
                   "Folder with the images (in Images, *_Images or itself), camera_params_*.txt, "
                   "*_GPS.txt and *_IMU.txt")
      ->required();
  verb->add_option("-o,--output", options->log, "Rawlog to write")->required();
  verb->add_flag("--copy-images", options->copy_images,
                 "Copy the images to <log>_Images instead of referring to them");
  const auto mount = std::make_shared<MountAngles>();
  const std::vector<CLI::Option*> angles = add_mount(*verb, *mount, options->convention);
  verb->callback([options, mount, angles] {
    const bool given = std::any_of(angles.begin(), angles.end(),
                                   [](const CLI::Option* angle) { return angle->count() > 0; });
    if (given) options->mount = *mount;
    print(import_malaga(*options));
  });
}

}  // namespace

void add_import(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "import", "Image folders, videos, bags and text files to a native rawlog");
  verb->require_subcommand(1);
  add_kitti(*verb);
  add_malaga(*verb);
  add_folder(
      *verb, "images", "Images of any names in a folder",
      "Folder with the images; times.txt when present, else times in their names, else those "
      "of EXIF; or --fps",
      import_image_folder);
  add_video(*verb);
  add_rosbag(*verb);
  add_folder(*verb, "euroc", "EuRoC sequence",
             "Folder with mav0, or mav0 itself: cam0/data.csv, "
             "cam0/data, cam0/sensor.yaml",
             import_euroc);
  add_folder(*verb, "tum", "TUM RGB-D sequence", "Folder with rgb.txt and rgb", import_tum);
  for (CLI::App* importer : verb->get_subcommands({})) {
    importer->get_option("--output")->check(names_a_file());
  }
}

}  // namespace oneac::app
