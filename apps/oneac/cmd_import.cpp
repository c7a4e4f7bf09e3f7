#include "commands.h"

#include "oneac/rawlog/import_kitti.h"
#include "oneac/rawlog/import_malaga.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <string>

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
  verb->add_option("--camera-height", options->camera_height_m, "Above the road [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
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
  verb->callback([options] { print(import_malaga(*options)); });
}

}  // namespace

void add_import(CLI::App& program) {
  auto* verb = program.add_subcommand("import", "Image folders and text files to a native rawlog");
  verb->require_subcommand(1);
  add_kitti(*verb);
  add_malaga(*verb);
}

}  // namespace oneac::app
