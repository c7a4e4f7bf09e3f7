#include "commands.h"

#include "oneac/rawlog/import_kitti.h"
#include "oneac/rawlog/import_malaga.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace oneac::app {
namespace {

void print(const ImportReport& report) {
  for (const std::string& note : report.notes) std::cerr << "oneac: note: " << note << '\n';
  std::cout << "log     " << report.log.string() << '\n'
            << "cameras " << report.observations << " observations, " << report.images
            << " images\n";
  if (report.gps + report.imu > 0) {
    std::cout << "sensors " << report.gps << " GPS epochs, " << report.imu << " IMU samples\n";
  }
  if (!report.poses.empty()) std::cout << "poses   " << report.poses.string() << '\n';
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

void add_kitti(CLI::App& import) {
  auto* verb = import.add_subcommand("kitti", "KITTI odometry sequence, or a folder in its layout");
  const auto options = std::make_shared<KittiImport>();
  verb->add_option("SRC", options->source,
                   "Folder with image_0, image_l, image_2 or images (png, jpg) and calib.txt; "
                   "times.txt and poses.txt when present")
      ->required();
  verb->add_option("-o,--output", options->log, "Rawlog to write")->required();
  verb->add_flag("--copy-images", options->copy_images,
                 "Copy the images to <log>_Images instead of referring to them");
  verb->add_option("--camera-height", options->camera_height_m,
                   "Of the lens above the road [m], 0.3 to 5; without it 1.65 where focal length "
                   "and size of the images are KITTI's, else the log has none");
  add_mount(*verb, options->mount, options->convention);
  verb->callback([options] { print(import_kitti(*options)); });
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
  auto* verb = program.add_subcommand("import", "Image folders and text files to a native rawlog");
  verb->require_subcommand(1);
  add_kitti(*verb);
  add_malaga(*verb);
}

}  // namespace oneac::app
