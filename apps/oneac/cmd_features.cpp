#include "commands.h"
#include "features/feature_pictures.h"
#include "features/feature_statistics.h"
#include "run/run_drive.h"
#include "run/run_options.h"
#include "run/run_outputs.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"
#include "terminal/own_results.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/printable.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

namespace oneac::app {
namespace {

namespace fs = std::filesystem;

struct FeaturesFlags {
  RunOptions options;
  std::vector<std::string> parameter_files;
  std::vector<Setting> settings;
  std::size_t picture_every = 50;  // five seconds at the usual 10 Hz
  bool no_progress = false;
};

fs::path picture_name(const fs::path& folder, std::size_t index) {
  char name[32];
  std::snprintf(name, sizeof name, "tracks_%06zu.png", index);
  return folder / name;
}

void write_statistics(const FeatureStatistics& statistics, const FeaturesFlags& flags,
                      const GreyImage& last_image) {
  const fs::path folder(flags.options.output);
  const std::string summary =
      format_summary(statistics, flags.options.front_end.features.extractor);
  write_file_atomically(folder / "pairs.csv", format_pairs(statistics));
  write_file_atomically(folder / "track_lengths.csv", format_track_lengths(statistics));
  write_file_atomically(folder / "regions.csv", format_regions(statistics));
  write_file_atomically(folder / "summary.md", summary);
  if (!last_image.empty()) draw_regions(last_image, statistics, folder / "regions.png");
  std::cout << summary << "\nwritten to " << printable(flags.options.output)
            << ": pairs.csv, track_lengths.csv, regions.csv, regions.png, summary.md, "
               "tracks_*.png\n";
}

void run(FeaturesFlags& flags) {
  RunOptions& options = flags.options;
  apply_settings(flags.parameter_files, flags.settings, options);
  if (flags.no_progress) options.run.progress = false;
  options.validate();
  if (flags.picture_every < 1) throw InputError("--picture-every 0", "it must be at least 1", "");
  if (options.log.empty()) {
    throw InputError("features", "no rawlog given", "oneac features LOG -o DIR");
  }
  if (options.output.empty()) throw InputError("features", "no output folder given", "add -o DIR");
  require_writable_folder(options.output);
  require_own("features", options.output,
              {{"pairs.csv", "index1,index2,acs,followed,"},
               {"track_lengths.csv", "images,tracks"},
               {"regions.csv", "row,column,count,"},
               {"summary.md", "# Affine correspondences of a drive"},
               {"regions.png", "PNG"}});
  catch_interrupts();
  FeatureStatistics statistics(options.front_end.consensus.threshold_px);
  GreyImage last_image;
  const DriveRecord record = run_drive(options, [&](const RunMoment& moment) {
    statistics.add(moment);
    last_image = moment.image;
    const std::size_t pairs = statistics.pairs().size();
    if (pairs == 0 || (pairs - 1) % flags.picture_every != 0) return;
    draw_tracks(moment.image.view(), moment.pair,
                picture_name(options.output, moment.record.frames.back().index));
  });
  statistics.finish();
  if (!options.run.quiet) {
    for (const std::string& note : notes_about(record)) std::cerr << "oneac: " << note << '\n';
  }
  write_statistics(statistics, flags, last_image);
  fail_if_incomplete(record);
}

}  // namespace

void add_features(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "features", "Statistics and pictures of the affine correspondences of a rawlog");
  auto flags = std::make_shared<FeaturesFlags>();
  verb->add_option("LOG", flags->options.log, "rawlog: plain, .gz or zstd");
  verb->add_option("-o,--output", flags->options.output, "folder for the results, made if missing");
  add_parameters(*verb, flags->parameter_files, flags->settings);
  verb->add_option("--picture-every", flags->picture_every, "draw the tracks of every K-th pair");
  add_selection(*verb, flags->settings);
  add_key(*verb, "--threads", "run.threads", flags->settings, "threads that share a drive");
  verb->add_flag("--no-progress", flags->no_progress, "no progress bar");
  verb->callback([flags] { run(*flags); });
}

}  // namespace oneac::app
