#include "oneac/study/study.h"

#include "oneac/base/nearest_name.h"
#include "oneac/base/ordered_pipeline.h"
#include "oneac/base/require.h"
#include "oneac/geometry/angles.h"
#include "oneac/study/trial.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace oneac {
namespace {

constexpr std::array<StudyMetric, 3> kMetrics = {StudyMetric::kRotation, StudyMetric::kTranslation,
                                                 StudyMetric::kNormal};
// A trial takes some 50 µs; more than this would take weeks.
constexpr std::size_t kMaxTrials = 100000000;
constexpr int kMaxThreads = 1024;

/// Of values in any order, which are sorted on the way.
[[nodiscard]] ErrorStatistics statistics_of(std::vector<double>& values) {
  if (values.empty()) return {};
  double sum = 0.0;
  for (const double value : values) sum += value;
  std::sort(values.begin(), values.end());
  const auto quantile = [&values](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {sum / static_cast<double>(values.size()), quantile(0.5), quantile(0.95)};
}

/// What a method did in all trials of a point.
struct ErrorLists {
  std::array<std::vector<double>, 3> deg;  ///< by metric, solved trials in order
};

[[nodiscard]] StudyMethodResult summarised(StudyMethod method, ErrorLists& lists) {
  StudyMethodResult result{method, lists.deg[0].size(), {}};
  for (std::size_t i = 0; i < kMetrics.size(); ++i) result.errors[i] = statistics_of(lists.deg[i]);
  return result;
}

struct Task {
  const Experiment* experiment;
  std::size_t point;
};

[[nodiscard]] std::vector<Task> tasks_of(const std::vector<Figure>& wanted) {
  std::vector<Task> tasks;
  for (const Experiment& experiment : experiments()) {
    const bool needed = std::any_of(wanted.begin(), wanted.end(), [&](const Figure& figure) {
      return figure.experiment == experiment.name;
    });
    if (!needed) continue;
    for (std::size_t i = 0; i < sweep_values(experiment.sweep).size(); ++i) {
      tasks.push_back({&experiment, i});
    }
  }
  return tasks;
}

[[nodiscard]] bool asks_for(const std::string& wanted, const Figure& figure) {
  const std::string_view group = figure.id.substr(0, 1);  // of i1 … i4, of s1 …
  return wanted == "all" || wanted == group || wanted == figure.id || wanted == figure.name();
}

void drop_incomplete(std::vector<ExperimentResult>& results) {
  if (results.empty()) return;
  const ExperimentResult& last = results.back();
  if (last.points.size() < sweep_values(last.experiment->sweep).size()) results.pop_back();
}

}  // namespace

void StudyOptions::validate() const {
  require(trials >= 1 && trials <= kMaxTrials, "trials", trials,
          "1 … " + std::to_string(kMaxTrials));
  require(threads >= 1 && threads <= kMaxThreads, "threads", threads,
          "1 … " + std::to_string(kMaxThreads));
  std::vector<std::string> names = {"all"};
  for (const Figure& figure : oneac::figures()) names.push_back(figure.name());
  for (const std::string& wanted : figures) {
    const auto& known = oneac::figures();
    const bool found = std::any_of(known.begin(), known.end(),
                                   [&](const Figure& figure) { return asks_for(wanted, figure); });
    if (!found) {
      throw std::invalid_argument("figure '" + wanted + "' is unknown, did you mean '" +
                                  nearest_name(wanted, names) + "'?");
    }
  }
}

std::vector<Figure> wanted_figures(const StudyOptions& options) {
  if (options.figures.empty()) return figures();
  std::vector<Figure> chosen;
  for (const Figure& figure : figures()) {
    const bool wanted =
        std::any_of(options.figures.begin(), options.figures.end(),
                    [&](const std::string& name) { return asks_for(name, figure); });
    if (wanted) chosen.push_back(figure);
  }
  return chosen;
}

const ErrorStatistics& StudyMethodResult::of(StudyMetric metric) const {
  return errors[static_cast<std::size_t>(metric)];
}

std::size_t ExperimentResult::index_of(StudyMethod method) const {
  const std::vector<StudyMethod>& methods = experiment->methods;
  const auto found = std::find(methods.begin(), methods.end(), method);
  if (found == methods.end()) {
    throw std::invalid_argument("method: " + std::string(method->label) + " takes no part in " +
                                std::string(experiment->name));
  }
  return static_cast<std::size_t>(found - methods.begin());
}

const ExperimentResult* StudyResult::find(std::string_view experiment) const {
  for (const ExperimentResult& result : experiments) {
    if (result.experiment->name == experiment) return &result;
  }
  return nullptr;
}

PointResult run_point(const Experiment& experiment, std::size_t point,
                      const StudyOptions& options) {
  PointResult result;
  result.value = sweep_values(experiment.sweep).at(point);
  const StudyScene scene = scene_at(experiment, result.value);
  std::vector<ErrorLists> lists(experiment.methods.size());
  for (std::size_t trial = 0; trial < options.trials; ++trial) {
    TrialRandom random(trial_seed(options.seed, experiment.name, point, trial));
    auto acs = draw_correspondences(scene, options.noise_shape, random);
    StudyScene seen = scene;
    measure(seen, acs, random);
    for (std::size_t m = 0; m < lists.size(); ++m) {
      const auto errors =
          errors_of(experiment.methods[m], options.data_use, AcSpan(acs.data(), acs.size()), seen);
      if (!errors) continue;
      for (std::size_t i = 0; i < kMetrics.size(); ++i) {
        lists[m].deg[i].push_back(errors->of(kMetrics[i]) / kDegree);
      }
    }
  }
  for (std::size_t m = 0; m < lists.size(); ++m) {
    result.methods.push_back(summarised(experiment.methods[m], lists[m]));
  }
  return result;
}

StudyResult run_study(const StudyOptions& options, const StudyProgress& progress) {
  options.validate();
  const std::vector<Task> tasks = tasks_of(wanted_figures(options));
  StudyResult result{options, {}};
  std::size_t started = 0, done = 0;
  const auto next = [&]() -> std::optional<Task> {
    if (started == tasks.size()) return std::nullopt;
    return tasks[started++];
  };
  const auto map = [&options](Task task) {
    return run_point(*task.experiment, task.point, options);
  };
  const auto consume = [&](PointResult point) {
    const Task& task = tasks[done++];
    if (task.point == 0) result.experiments.push_back({task.experiment, {}});
    result.experiments.back().points.push_back(std::move(point));
    if (!progress) return true;
    return progress(static_cast<double>(done) / static_cast<double>(tasks.size()),
                    done * options.trials);
  };
  ordered_pipeline(next, map, consume, options.threads);
  drop_incomplete(result.experiments);
  return result;
}

}  // namespace oneac
