#include "commands.h"

#include "oneac/evaluation/evaluate.h"
#include "oneac/evaluation/report.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <string>

namespace oneac::app {
namespace {

struct EvalArguments {
  std::string estimate;
  std::string reference;
  std::string alignment = "se3";
  bool pairs = false;
  bool json = false;
};

void evaluate(const EvalArguments& arguments) {
  const EvaluationRequest request{arguments.estimate, arguments.reference,
                                  alignment_from_name(arguments.alignment), arguments.pairs};
  const Evaluation evaluation = evaluate_files(request);
  std::cout << (arguments.json ? format_json(evaluation, arguments.pairs)
                               : format_table(evaluation, arguments.pairs));
}

}  // namespace

void add_eval(CLI::App& program) {
  auto* verb = program.add_subcommand("eval", "Compares an estimate with a reference trajectory");
  auto arguments = std::make_shared<EvalArguments>();
  verb->add_option("ESTIMATE", arguments->estimate,
                   "relative_poses.csv (pairs), or a trajectory: .kitti, .tum, .txt of either")
      ->required();
  verb->add_option("REFERENCE", arguments->reference,
                   "true poses of the same body: KITTI poses (row = image of the log) or TUM")
      ->required();
  verb->add_flag("--pairs", arguments->pairs,
                 "one line per pair before the summary; of a trajectory: its consecutive rows");
  verb->add_option("--align", arguments->alignment,
                   "what may be moved before positions are compared")
      ->check(CLI::IsMember({"none", "se3", "sim3"}))
      ->capture_default_str();
  verb->add_flag("--json", arguments->json, "print JSON instead of a table");
  verb->callback([arguments] { evaluate(*arguments); });
}

}  // namespace oneac::app
