#include "commands.h"
#include "compare/compare_outputs.h"
#include "run/run_options.h"
#include "terminal/interrupt.h"
#include "terminal/key_flags.h"
#include "terminal/own_results.h"
#include "terminal/progress_bar.h"

#include "oneac/base/atomic_file.h"
#include "oneac/base/error.h"
#include "oneac/base/printable.h"
#include "oneac/comparison/comparison.h"
#include "oneac/comparison/method_faults.h"
#include "oneac/comparison/plugin.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace oneac::app {
namespace {

constexpr const char* kRivals = "oneac_rivals";
constexpr std::size_t kPictures = 6;  // worst pairs with their inliers in the report

struct CompareFlags {
  RunOptions options;  ///< the keys of `oneac run`, of which those of the refinement are not used
  std::vector<std::string> parameter_files;
  std::vector<Setting> settings;
  std::vector<std::string> logs;
  std::vector<std::string> merge;
  std::vector<std::string> plugins;
  std::vector<std::string> initialisers{"all"};
  std::vector<std::string> estimators{"default"};
  std::string shard = "0/1";
  int trials = 1;
  bool rivals = false;
  bool no_progress = false;
  bool quiet = false;
};

/// What the methods are configured with: their sections of the front-end's parameters.
std::string method_parameters(FrontEndOptions options) {
  ParameterTable table;
  table.add("consensus", options.consensus);
  return table.to_yaml(false);
}

std::vector<std::filesystem::path> plugins_of(const CompareFlags& flags) {
  std::vector<std::filesystem::path> plugins(flags.plugins.begin(), flags.plugins.end());
  if (flags.rivals) plugins.insert(plugins.begin(), find_plugin(kRivals));
  return plugins;
}

CompareSettings settings_from(CompareFlags& flags) {
  RunOptions& options = flags.options;
  apply_settings(flags.parameter_files, flags.settings, options);
  options.validate();
  CompareSettings settings;
  settings.logs = flags.logs;
  settings.source = options.source.for_log("");
  settings.features = options.front_end.features;
  const TiltOptions& tilt = options.front_end.tilt;
  settings.tilt = {tilt.source, tilt.pitch_up_deg, tilt.roll_right_deg, tilt.refine};
  settings.reference = options.run.reference;
  settings.method_parameters = method_parameters(options.front_end);
  settings.trials = flags.trials;
  settings.seed = static_cast<std::uint64_t>(options.run.seed);
  settings.methods = plan_methods(flags.initialisers, flags.estimators);
  settings.program = running_program();
  for (const auto& plugin : plugins_of(flags)) {
    settings.plugins.push_back(identity_of_plugin(plugin));
  }
  settings.validate();
  return settings;
}

void tell(const CompareFlags& flags, const std::vector<std::string>& notes) {
  if (flags.quiet) return;
  for (const std::string& note : notes) std::cerr << "oneac: " << printable(note) << '\n';
}

void add_method_faults(const ComparisonData& data, std::vector<std::string>& notes) {
  const std::vector<std::string> faults = method_faults(data);
  notes.insert(notes.end(), faults.begin(), faults.end());
}

/// Of write_comparison().
void require_place(const std::string& folder) {
  require_writable_folder(folder);
  require_own("compare", folder,
              {{"pairs.csv", "log,index1,index2,method,trial,"},
               {"timings.csv", "log,index1,index2,method,trial,ms"},
               {"summary.csv", "log,method,estimates,"},
               {"table.md", "| | method |"},
               {"table.tex", "% needs \\usepackage{multirow,graphicx}"},
               {"report.html", "<title>Initialisers compared"}});
}

void compare(CompareFlags& flags) {
  const CompareSettings settings = settings_from(flags);
  const Shard shard = parse_shard(flags.shard);
  require_place(flags.options.output);
  Journal journal(flags.options.output, settings, shard);
  catch_interrupts();
  std::vector<std::string> damage, notes;
  {
    ProgressBar bar(flags.options.run.progress && !flags.no_progress && !flags.quiet, "pairs");
    CompareHooks hooks;
    hooks.threads = flags.options.run.threads;
    hooks.keep_going = [] { return !interrupted(); };
    hooks.progress = [&bar](double share, std::size_t pairs) { bar.update(share, pairs); };
    hooks.note = [&notes](const std::string& note) { notes.push_back(note); };
    damage = run_comparison(settings, shard, journal, hooks);
  }
  notes.insert(notes.end(), damage.begin(), damage.end());
  if (interrupted()) {
    notes.emplace_back("interrupted: run the same command again and it goes on from here");
  }
  const ComparisonData data = merge_journals(settings, {journal.content()});
  add_method_faults(data, notes);
  tell(flags, notes);
  // An interrupt wants the files soon: without pictures.
  write_comparison(data, settings, notes, interrupted() ? 0 : kPictures, flags.options.output);
  if (interrupted()) throw std::runtime_error("interrupted; what was computed is written");
  if (!damage.empty()) throw InputError("log", damage.front(), "");
}

/// What there is is written; a script must not take it for the whole.
InputError incomplete(const std::vector<std::string>& missing) {
  constexpr std::size_t kMostNamed = 5;  // the report has them all
  std::string fault;
  for (std::size_t i = 0; i < std::min(missing.size(), kMostNamed); ++i) {
    fault += (i == 0 ? "" : "; ") + missing[i];
  }
  if (missing.size() > kMostNamed) {
    fault += "; and " + std::to_string(missing.size() - kMostNamed) + " more";
  }
  return {"compare --merge", fault,
          "what there is is written; run what is missing (the same command with its --shard, into "
          "its folder: it goes on where it stopped) and merge all again"};
}

void merge(const CompareFlags& flags) {
  std::vector<JournalContent> journals;
  for (const auto& path : find_journals({flags.merge.begin(), flags.merge.end()})) {
    journals.push_back(read_journal(path));
    if (journals.back().settings.empty()) journals.pop_back();  // not begun
  }
  if (journals.empty()) {
    throw InputError("--merge", "the journals are empty", "run the shards first");
  }
  const CompareSettings settings = settings_of(journals.front());
  require_place(flags.options.output);
  const ComparisonData data = merge_journals(settings, journals);
  const std::vector<std::string> missing = missing_in(journals, data);
  std::vector<std::string> faults;
  add_method_faults(data, faults);
  tell(flags, faults);
  std::vector<std::string> notes = missing;
  notes.insert(notes.end(), faults.begin(), faults.end());
  write_comparison(data, settings, notes, kPictures, flags.options.output);
  if (!missing.empty()) throw incomplete(missing);
}

void run(CompareFlags& flags) {
  if (flags.options.output.empty()) {
    throw InputError("compare", "no output folder given", "add -o DIR");
  }
  if (flags.logs.empty() && flags.merge.empty()) {
    throw InputError("compare", "no rawlog given", "oneac compare LOG... -o DIR");
  }
  if (!flags.logs.empty() && !flags.merge.empty()) {
    throw InputError("compare --merge", "takes folders, no logs", "leave the logs out");
  }
  for (const auto& plugin : plugins_of(flags)) load_plugin(plugin);
  if (flags.merge.empty()) {
    compare(flags);
  } else {
    merge(flags);
  }
}

void add_keys(CLI::App* verb, CompareFlags& flags) {
  add_selection(*verb, flags.settings);
  add_key(*verb, "--reference", "run.reference", flags.settings, "true poses of the only log");
  add_key(*verb, "--seed", "run.seed", flags.settings, "of the first trial; the next has one more");
  add_key(*verb, "--threads", "run.threads", flags.settings, "pairs at once, one thread each");
}

}  // namespace

void add_compare(CLI::App& program) {
  auto* verb = program.add_subcommand(
      "compare", "Gives the same correspondences to every initialiser: table, CDFs, report");
  auto flags = std::make_shared<CompareFlags>();
  verb->add_option("LOG", flags->logs, "rawlogs: plain, .gz or zstd");
  verb->add_option("-o,--output", flags->options.output, "folder for the results, made if missing");
  verb->add_option("--initialisers", flags->initialisers, "all, or names A,B,…")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--estimators", flags->estimators, "default, all, or names A,B,…")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--trials", flags->trials, "per pair and method, each with its own seed");
  verb->add_flag("--rivals", flags->rivals, "methods of OpenCV and OpenGV as well");
  verb->add_option("--plugin", flags->plugins, "library with initialisers; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("--shard", flags->shard, "i/n: only the pairs with number i modulo n");
  verb->add_option("--merge", flags->merge, "puts the results of shards together: their folders");
  add_parameters(*verb, flags->parameter_files, flags->settings);
  add_keys(verb, *flags);
  verb->add_flag("--no-progress", flags->no_progress, "no progress bar");
  verb->add_flag("--quiet", flags->quiet, "no progress bar, notes or warnings");
  verb->callback([flags] { run(*flags); });
}

}  // namespace oneac::app
