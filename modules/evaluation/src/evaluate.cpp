#include "oneac/evaluation/evaluate.h"

#include "oneac/base/error.h"
#include "oneac/evaluation/association.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

constexpr const char* kPairsFile = "relative_poses.csv";

/// T_2_1 of a body that moves from one pose to the next.
RelativePose motion_between(const Eigen::Isometry3d& T_world_1,
                            const Eigen::Isometry3d& T_world_2) {
  const Eigen::Isometry3d T_2_1 = T_world_2.inverse() * T_world_1;
  return {T_2_1.linear(), T_2_1.translation()};
}

std::vector<double> distinct_times(const std::vector<RelativePoseRow>& rows) {
  std::vector<double> times;
  for (const RelativePoseRow& row : rows) times.insert(times.end(), {row.t1, row.t2});
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Finds the reference row of an image by its time or, without times, by its index.
class ReferenceRows {
 public:
  ReferenceRows(const Trajectory& reference, const std::vector<RelativePoseRow>& rows)
      : reference_(reference), tolerance_(time_tolerance(distinct_times(rows))) {}

  [[nodiscard]] const Eigen::Isometry3d* find(std::size_t index, double time) const {
    if (reference_.has_times()) {
      const auto row = nearest_row(reference_.times, time, tolerance_);
      return row ? &reference_.poses[*row] : nullptr;
    }
    return index < reference_.poses.size() ? &reference_.poses[index] : nullptr;
  }

 private:
  const Trajectory& reference_;
  double tolerance_;
};

MatchedTrajectories matched_poses(const Trajectory& estimate, const Trajectory& reference,
                                  const std::vector<RowMatch>& matches) {
  MatchedTrajectories matched;
  for (const RowMatch& match : matches) {
    matched.estimate.push_back(estimate.poses[match.estimate]);
    matched.reference.push_back(reference.poses[match.reference]);
  }
  return matched;
}

std::vector<RowMatch> match_frames(const ProcessedFrames& frames, const Trajectory& reference) {
  if (reference.has_times()) return match_by_time(frames.times, reference.times);
  return match_by_index(frames.indices, reference.poses.size());
}

std::string poses_in(const Trajectory& trajectory) {
  return std::to_string(trajectory.poses.size()) + " poses";
}

/// The frames that the estimate's rows show, from the pairs file of the same run.
ProcessedFrames frames_beside(const EvaluationRequest& request, const Trajectory& estimate,
                              const Trajectory& reference) {
  const std::filesystem::path file = request.estimate.parent_path() / kPairsFile;
  if (!std::filesystem::exists(file)) {
    throw InputError(request.estimate.string(),
                     "has " + poses_in(estimate) + ", " + request.reference.string() + " has " +
                         poses_in(reference) + ", so rows cannot be told to belong together",
                     std::string("put the run's ") + kPairsFile +
                         " beside it, or give both as .tum with the same clock");
  }
  auto frames = processed_frames(read_relative_poses(file));
  if (frames && frames->indices.size() == estimate.poses.size()) return *std::move(frames);
  throw InputError(file.string(),
                   "does not connect the " + poses_in(estimate) + " of " +
                       request.estimate.filename().string() + " one after the other",
                   "keep trajectory and pairs of the same run together");
}

std::vector<RowMatch> associate(const EvaluationRequest& request, const Trajectory& estimate,
                                const Trajectory& reference) {
  if (estimate.has_times() && reference.has_times()) {
    return match_by_time(estimate.times, reference.times);
  }
  if (estimate.poses.size() == reference.poses.size()) {
    return match_by_row(estimate.poses.size(), reference.poses.size());
  }
  return match_frames(frames_beside(request, estimate, reference), reference);
}

[[noreturn]] void throw_nothing_in_common(const EvaluationRequest& request) {
  throw InputError(request.estimate.string(),
                   "has no frame in common with " + request.reference.string(),
                   "name the reference of the same log; times must be on one clock, to 10 ms");
}

void add_pairs(const std::vector<RowMatch>& matches, const MatchedTrajectories& matched,
               Evaluation& evaluation) {
  for (std::size_t k = 1; k < matches.size(); ++k) {
    RelativePoseRow row;
    row.index1 = matches[k - 1].reference;
    row.index2 = matches[k].reference;
    row.metric = true;  // positions of a trajectory are metres
    row.T_2_1 = motion_between(matched.estimate[k - 1], matched.estimate[k]);
    evaluation.pairs.push_back(
        pair_error(row, motion_between(matched.reference[k - 1], matched.reference[k])));
  }
  evaluation.pair_summary = summarise(evaluation.pairs, 0);
}

Evaluation evaluate_pairs_file(const EvaluationRequest& request) {
  const auto rows = read_relative_poses(request.estimate);
  if (rows.empty()) {
    throw InputError(request.estimate.string(), "has no pairs", "run on at least two frames");
  }
  Evaluation evaluation = evaluate_pairs(rows, read_trajectory(request.reference));
  if (evaluation.pairs.empty()) throw_nothing_in_common(request);
  return evaluation;
}

Evaluation evaluate_trajectory_file(const EvaluationRequest& request) {
  const Trajectory estimate = read_trajectory(request.estimate);
  const Trajectory reference = read_trajectory(request.reference);
  const auto matches = associate(request, estimate, reference);
  if (matches.empty()) throw_nothing_in_common(request);
  const MatchedTrajectories matched = matched_poses(estimate, reference, matches);
  Evaluation evaluation;
  evaluation.estimate_frames = estimate.poses.size();
  evaluation.reference_frames = reference.poses.size();
  evaluation.trajectory = trajectory_errors(matched, request.alignment);
  if (request.pairs) add_pairs(matches, matched, evaluation);
  return evaluation;
}

}  // namespace

Evaluation evaluate_pairs(const std::vector<RelativePoseRow>& rows, const Trajectory& reference) {
  const ReferenceRows reference_rows(reference, rows);
  Evaluation evaluation;
  evaluation.reference_frames = reference.poses.size();
  for (const RelativePoseRow& row : rows) {
    const auto* first = reference_rows.find(row.index1, row.t1);
    const auto* second = reference_rows.find(row.index2, row.t2);
    if (first == nullptr || second == nullptr) continue;
    evaluation.pairs.push_back(pair_error(row, motion_between(*first, *second)));
  }
  evaluation.pair_summary = summarise(evaluation.pairs, rows.size() - evaluation.pairs.size());
  return evaluation;
}

Evaluation evaluate_run(const std::vector<RelativePoseRow>& rows, const Trajectory& estimate,
                        const Trajectory& reference, Alignment alignment) {
  Evaluation evaluation = evaluate_pairs(rows, reference);
  evaluation.estimate_frames = estimate.poses.size();
  if (rows.empty()) return evaluation;
  const auto frames = processed_frames(rows);
  if (!frames || frames->indices.size() != estimate.poses.size()) {
    throw std::invalid_argument("evaluate_run: rows = " + std::to_string(rows.size()) +
                                " pairs, must be one chain over the estimate's " +
                                poses_in(estimate));
  }
  const auto matches = match_frames(*frames, reference);
  if (matches.empty()) return evaluation;
  evaluation.trajectory = trajectory_errors(matched_poses(estimate, reference, matches), alignment);
  return evaluation;
}

Evaluation evaluate_files(const EvaluationRequest& request) {
  const bool is_pairs =
      request.estimate.extension() == ".csv" || looks_like_relative_poses(request.estimate);
  return is_pairs ? evaluate_pairs_file(request) : evaluate_trajectory_file(request);
}

}  // namespace oneac
