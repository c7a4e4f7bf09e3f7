#include "commands.h"
#include "terminal/key_flags.h"

#include "oneac/base/error.h"
#include "oneac/base/finite_number.h"
#include "oneac/base/printable.h"
#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/report.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <memory>
#include <string>

namespace oneac::app {
namespace {

struct EvalArguments {
  std::string estimate;
  std::string reference;
  std::string alignment = "se3";
  std::string offset;
  double max_difference_s = 0.0;  // 0: not given
  bool pairs = false;
  bool json = false;
};

/// "estimate" or seconds.
void take_offset(const std::string& text, EvaluationRequest& request) {
  request.estimate_offset = text == "estimate";
  if (text.empty() || request.estimate_offset) return;
  const auto offset_s = finite_number(text);
  constexpr double kLongest_s = 1e11;  // from the year 1970 to the year 5138
  if (!offset_s || std::abs(*offset_s) > kLongest_s) {
    throw InputError("--offset " + text, "is no number of seconds", "give seconds, or estimate");
  }
  request.time.offset_s = *offset_s;
}

void evaluate(const EvalArguments& arguments) {
  EvaluationRequest request{arguments.estimate, arguments.reference,
                            alignment_from_name(arguments.alignment), arguments.pairs};
  take_offset(arguments.offset, request);
  if (arguments.max_difference_s > 0.0) request.time.max_difference_s = arguments.max_difference_s;
  const Evaluation evaluation = evaluate_files(request);
  for (const std::string& note : evaluation.notes) {
    std::cerr << "oneac: note: " << printable(note) << '\n';
  }
  std::cout << (arguments.json ? format_json(evaluation, arguments.pairs)
                               : format_table(evaluation, arguments.pairs));
}

}  // namespace

void add_eval(CLI::App& program) {
  auto* verb = program.add_subcommand("eval", "Compares an estimate with a reference trajectory");
  auto arguments = std::make_shared<EvalArguments>();
  verb->add_option(
          "ESTIMATE", arguments->estimate,
          "relative_poses.csv (pairs), or a trajectory: .kitti, .tum, .txt of either, .csv")
      ->required();
  verb->add_option(
          "REFERENCE", arguments->reference,
          "true poses of the same body: KITTI poses (row = image of the log), TUM, EuRoC or "
          "4x4 matrices")
      ->required();
  verb->add_flag("--pairs", arguments->pairs,
                 "one line per pair before the summary; of a trajectory: its consecutive rows");
  verb->add_option("--align", arguments->alignment,
                   "what may be moved before positions are compared")
      ->check(CLI::IsMember({"none", "se3", "sim3"}))
      ->capture_default_str();
  verb->add_option("--max-difference", arguments->max_difference_s,
                   "seconds to the nearest row of the reference at most; without it 10 ms, or as "
                   "far as rows around it are 0.25 s apart at most: poses between are interpolated")
      ->check(above_zero());
  verb->add_option("--offset", arguments->offset,
                   "seconds to be added to the estimate's times, or: estimate (by the turns of "
                   "both)");
  verb->add_flag("--json", arguments->json, "print JSON instead of a table");
  verb->callback([arguments] { evaluate(*arguments); });
}

}  // namespace oneac::app
