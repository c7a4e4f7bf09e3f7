#include "commands.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"
#include "terminal/progress_bar.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/printable.h"
#include "oneac/solvers/registry.h"
#include "oneac/study/claims.h"
#include "oneac/study/readings.h"
#include "oneac/study/report.h"
#include "oneac/study/study.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace oneac::app {
namespace {

struct SynthArguments {
  StudyOptions options;
  std::filesystem::path folder;
  int threads = 0;
  bool no_progress = false;
  bool list = false;
  bool readings = true;
};

void list_figures() {
  std::cout << "Figures (--figure takes the letter, with or without its number, or the name):\n";
  for (const Figure& figure : figures()) {
    const Experiment& experiment = experiment_named(figure.experiment);
    std::cout << "  " << std::left << std::setw(4) << figure.id << std::setw(34) << figure.name()
              << experiment.title << ", " << metric_name(figure.metric) << " error\n";
  }
}

void list_solvers() {
  std::cout << "\nSolvers:\n";
  for (const Solver& solver : solvers()) {
    const std::string needs = std::to_string(solver.sample) + (solver.affine        ? " AC"
                                                               : solver.sample == 1 ? " point"
                                                                                    : " points");
    std::cout << "  " << std::left << std::setw(29) << solver.name << std::setw(10) << needs
              << solver.assumptions() << "; gives " << solver.unknowns << ", up to "
              << solver.run.max_candidates << '\n';
  }
}

void validate(const StudyOptions& options) {
  try {
    options.validate();
  } catch (const std::invalid_argument& error) {
    throw InputError("synth", error.what(), "see oneac synth --list and --help");
  }
}

struct Outcome {
  StudyResult study;
  std::vector<StudyResult> readings;
};

Outcome run(const SynthArguments& arguments) {
  ProgressBar bar(!arguments.no_progress, "trials");
  // The readings run the study eight more times, without the supplement's rapid against optimal.
  const double share_of_study = arguments.readings ? 0.13 : 1.0;
  Outcome outcome;
  std::size_t trials_of_study = 0;
  outcome.study = run_study(arguments.options, [&](double share, std::size_t trials) {
    trials_of_study = trials;
    bar.update(share_of_study * share, trials);
    return !interrupted();
  });
  if (!arguments.readings || interrupted()) return outcome;
  outcome.readings = run_readings(arguments.options, [&](double share, std::size_t trials) {
    bar.update(share_of_study + (1.0 - share_of_study) * share, trials_of_study + trials);
    return !interrupted();
  });
  return outcome;
}

void print_outcome(const StudyResult& result, const std::filesystem::path& folder,
                   std::size_t files) {
  for (const Claim& claim : judge_claims(result)) {
    std::cout << (claim.holds() ? "confirmed  " : "disagrees  ") << claim.paper << '\n';
  }
  std::cout << "files      " << files << " in " << printable(folder.string())
            << ", read summary.md first\n";
}

void synth(SynthArguments arguments) {
  if (arguments.list) {
    list_figures();
    list_solvers();
    return;
  }
  if (arguments.folder.empty()) {
    throw InputError("synth", "no output folder", "give one with -o, or see --list");
  }
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  arguments.options.threads =
      arguments.threads > 0 ? arguments.threads : static_cast<int>(std::min(cores, 1024U));
  validate(arguments.options);
  require_writable_folder(arguments.folder);
  catch_interrupts();
  const Outcome outcome = run(arguments);
  if (interrupted()) std::cerr << "oneac: interrupted; finished experiments are written\n";
  const auto files = write_study(outcome.study, outcome.readings, arguments.folder);
  print_outcome(outcome.study, arguments.folder, files.size());
}

}  // namespace

void add_synth(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "synth", "The paper's synthetic study: a CSV and an SVG per figure, and summary.md");
  const auto arguments = std::make_shared<SynthArguments>();
  StudyOptions& options = arguments->options;
  verb->add_option("-o,--output", arguments->folder, "Folder to write to");
  verb->add_option("--figure", options.figures,
                   "Letter (i: i1 … i4, s: the supplement's, v: v1 … v10) or name, may be "
                   "repeated; all by default");
  verb->add_option("--trials", options.trials, "Per point of a curve")
      ->check(CLI::Range(1, 100000000))  // a size_t would take −3 for a large number
      ->capture_default_str();
  verb->add_option("--seed", options.seed, "Everything random follows from it")
      ->capture_default_str();
  const std::map<std::string, NoiseShape> shapes = {{"uniform", NoiseShape::kUniform},
                                                    {"fixed", NoiseShape::kFixed},
                                                    {"normal", NoiseShape::kNormal},
                                                    {"common", NoiseShape::kCommon}};
  verb->add_option(
          "--noise-shape", options.noise_shape,
          "Affine errors uniform up to the level (default), of exactly it (fixed), normal, or "
          "uniform with a common angle for both rotations")
      ->transform(CLI::CheckedTransformer(shapes));
  verb->add_flag_callback(
      "--minimal-data", [&options] { options.data_use = DataUse::kMinimal; },
      "1AC uses one of a trial's four correspondences, 2AC two; else every method uses all");
  verb->add_flag("!--no-readings", arguments->readings,
                 "Leave out the table that judges the claims under every reading of the paper");
  verb->add_option("--threads", arguments->threads, "0: as many as the machine has")
      ->check(at_least_zero())
      ->capture_default_str();
  verb->add_flag("--no-progress", arguments->no_progress, "Show none, even on a terminal");
  verb->add_flag("--list", arguments->list, "List the figures and the solvers, run nothing");
  verb->callback([arguments] { synth(*arguments); });
}

}  // namespace oneac::app
