#include "commands.h"

#include "oneac/rawlog/log_summary.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace oneac::app {
namespace {

void print_info(const SummaryOptions& options) {
  const LogSummary summary = summarise_log(options);
  std::cout << to_text(summary) << std::flush;
  if (summary.damage) throw InputError(*summary.damage);
}

}  // namespace

void add_info(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "info",
      "Sensors, rates, images present and missing, calibration, tilt, duration of a rawlog");
  const auto options = std::make_shared<SummaryOptions>();
  verb->add_option("LOG", options->log, "MRPT rawlog: plain, gzip or zstd")->required();
  verb->add_option("--images-dir", options->images_dir,
                   "Folder of external images; default: <base>_Images, Images, the log's folder");
  verb->add_option("--calibration", options->calibration,
                   "FILE[:SECTION] that replaces the log's calibration");
  verb->add_option("--mount-convention", options->mount_convention,
                   "Axes of sensor poses: auto, optical or x_forward")
      ->capture_default_str();
  verb->callback([options] { print_info(*options); });
}

}  // namespace oneac::app
