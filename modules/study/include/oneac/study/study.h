#pragma once

#include "oneac/study/experiment.h"
#include "oneac/study/noise.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace oneac {

struct StudyOptions {
  std::size_t trials = 10000;  ///< per point of a sweep; the paper's number
  std::uint64_t seed = 1;
  int threads = 1;                                ///< changes no byte of the results
  NoiseShape noise_shape = NoiseShape::kUniform;  ///< errors up to the level, as the text has it
  DataUse data_use = DataUse::kAll;  ///< the same four correspondences for every method
  std::vector<std::string> figures;  ///< ids, "i", "s" or names; empty or "all": all of them

  /// @throws std::invalid_argument naming field, value and bound; an unknown figure
  ///         with the nearest name
  void validate() const;
};

/// The figures that the options ask for, in the order of the catalogue.
[[nodiscard]] std::vector<Figure> wanted_figures(const StudyOptions& options);

/// Errors over the solved trials of one method at one point [deg].
struct ErrorStatistics {
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
};

struct StudyMethodResult {
  StudyMethod method;
  std::size_t solved = 0;                   ///< trials with a candidate
  std::array<ErrorStatistics, 3> errors{};  ///< by StudyMetric; zeros when nothing was solved

  [[nodiscard]] const ErrorStatistics& of(StudyMetric metric) const;
};

struct PointResult {
  double value = 0.0;                      ///< of the sweep
  std::vector<StudyMethodResult> methods;  ///< in the order of the experiment
};

struct ExperimentResult {
  const Experiment* experiment = nullptr;
  std::vector<PointResult> points;

  /// @throws std::invalid_argument when the method did not take part
  [[nodiscard]] std::size_t index_of(StudyMethod method) const;
};

struct StudyResult {
  StudyOptions options;
  std::vector<ExperimentResult> experiments;  ///< complete ones only

  /// Null when the experiment was not part of the run.
  [[nodiscard]] const ExperimentResult* find(std::string_view experiment) const;
};

/// One point of an experiment, on the calling thread.
[[nodiscard]] PointResult run_point(const Experiment& experiment, std::size_t point,
                                    const StudyOptions& options);

/// Called with the share of the study that is done (0 … 1) and the trials so far; false stops it.
using StudyProgress = std::function<bool(double share, std::size_t trials)>;

/// Runs the experiments of the wanted figures, several points at once.
/// @throws std::invalid_argument as StudyOptions::validate
[[nodiscard]] StudyResult run_study(const StudyOptions& options,
                                    const StudyProgress& progress = {});

}  // namespace oneac
