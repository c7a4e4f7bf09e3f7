#include "oneac/evaluation/evaluate.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"
#include "oneac/base/number_text.h"
#include "oneac/evaluation/association.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

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
  ReferenceRows(const Trajectory& reference, const std::vector<RelativePoseRow>& rows,
                const TimeAlignment& time)
      : timed_(reference.has_times()),
        at_rows_(timed_ ? resampled(reference, distinct_times(rows), time)
                        : ResampledReference{reference, 0}) {}

  [[nodiscard]] const Eigen::Isometry3d* find(std::size_t index, double time) const {
    const Trajectory& reference = at_rows_.trajectory;
    if (timed_) {
      const auto row = nearest_row(reference.times, time, 0.0);
      return row ? &reference.poses[*row] : nullptr;
    }
    return index < reference.poses.size() ? &reference.poses[index] : nullptr;
  }
  [[nodiscard]] std::size_t interpolated() const { return at_rows_.interpolated; }

 private:
  bool timed_;
  ResampledReference at_rows_;
};

void note_interpolated(std::size_t interpolated, Evaluation& evaluation) {
  if (interpolated == 0) return;
  evaluation.notes.push_back(std::to_string(interpolated) +
                             " frames lie between rows of the reference and are compared with the "
                             "straight motion between them");
}

MatchedTrajectories matched_poses(const Trajectory& estimate, const Trajectory& reference,
                                  const std::vector<RowMatch>& matches) {
  MatchedTrajectories matched;
  for (const RowMatch& match : matches) {
    matched.estimate.push_back(estimate.poses[match.estimate]);
    matched.reference.push_back(reference.poses[match.reference]);
  }
  return matched;
}

/// Rows that belong together, and the reference that they name.
struct Association {
  std::vector<RowMatch> matches;
  Trajectory reference;
  std::size_t interpolated = 0;
  bool by_time = false;
};

Association match_times(const std::vector<double>& times, const Trajectory& reference,
                        const TimeAlignment& time) {
  ResampledReference at_times = resampled(reference, times, time);
  auto matches = match_by_time(times, at_times.trajectory.times);
  return {std::move(matches), std::move(at_times.trajectory), at_times.interpolated, true};
}

Association match_frames(const ProcessedFrames& frames, const Trajectory& reference,
                         const TimeAlignment& time) {
  if (reference.has_times()) return match_times(frames.times, reference, time);
  return {match_by_index(frames.indices, reference.poses.size()), reference};
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

/// What the trajectories tell by themselves; empty when they do not.
std::optional<Association> associate(const Trajectory& estimate, const Trajectory& reference,
                                     const TimeAlignment& time) {
  if (estimate.has_times() && reference.has_times()) {
    return match_times(estimate.times, reference, time);
  }
  if (estimate.poses.size() != reference.poses.size()) return std::nullopt;
  return Association{match_by_row(estimate.poses.size(), reference.poses.size()), reference};
}

Association associate(const EvaluationRequest& request, const Trajectory& estimate,
                      const Trajectory& reference, const TimeAlignment& time) {
  if (auto found = associate(estimate, reference, time)) return *std::move(found);
  return match_frames(frames_beside(request, estimate, reference), reference, time);
}

std::string span_of(const std::vector<double>& times) {
  return fixed_text(times.front(), 3) + " to " + fixed_text(times.back(), 3) + " s";
}

[[noreturn]] void throw_nothing_in_common(const EvaluationRequest& request,
                                          std::vector<double> times, const Trajectory& reference,
                                          double offset_s) {
  const std::string fault = "has no frame in common with " + request.reference.string();
  if (times.empty() || !reference.has_times()) {
    throw InputError(request.estimate.string(), fault, "name the reference of the same log");
  }
  for (double& time : times) time += offset_s;
  const std::string shifted =
      offset_s != 0.0 ? ", the offset of " + fixed_text(offset_s, 3) + " s added" : "";
  throw InputError(
      request.estimate.string(),
      fault + " (" + span_of(times) + shifted + ", against " + span_of(reference.times) + ")",
      offset_s != 0.0 ? "correct --offset, or --offset estimate"
                      : "name the reference of the same log; give --offset S or --offset estimate "
                        "for another clock, --max-difference S for rows further apart than 10 ms");
}

/// The offset that was asked for, found where it is to be estimated.
TimeAlignment time_alignment(const EvaluationRequest& request, const Trajectory& estimate,
                             const Trajectory& reference, Evaluation& evaluation) {
  TimeAlignment time = request.time;
  if (request.estimate_offset) {
    const auto offset = estimated_offset(estimate, reference);
    if (!offset) {
      throw InputError("--offset estimate",
                       "the turns of " + request.estimate.string() + " and " +
                           request.reference.string() + " tell none",
                       "both must have times and the same bends; give the offset in seconds");
    }
    time.offset_s = *offset;
    evaluation.notes.push_back("offset " + fixed_text(*offset, 3) +
                               " s, estimated by the turns of both: added to the estimate's times");
  }
  // Those of an estimate may be in the pairs beside it.
  if (time.offset_s != 0.0 && !reference.has_times()) {
    evaluation.notes.push_back("the offset counts for nothing: " + request.reference.string() +
                               " has no times");
    time.offset_s = 0.0;
  }
  if (request.estimate_offset || time.offset_s != 0.0) evaluation.offset_s = time.offset_s;
  return time;
}

Trajectory take_file(TrajectoryFile file, Evaluation& evaluation) {
  evaluation.notes.insert(evaluation.notes.end(), file.notes.begin(), file.notes.end());
  return std::move(file.trajectory);
}

/// The pairs one after the other; empty when they form no chain.
Trajectory chained(const std::vector<RelativePoseRow>& rows) {
  const auto frames = processed_frames(rows);
  if (!frames) return {};
  Trajectory trajectory{frames->times, {Eigen::Isometry3d::Identity()}};
  for (const RelativePoseRow& row : rows) {
    Eigen::Isometry3d T_2_1 = Eigen::Isometry3d::Identity();
    T_2_1.linear() = row.T_2_1.R;
    T_2_1.translation() = row.T_2_1.t;
    trajectory.poses.push_back(trajectory.poses.back() * T_2_1.inverse());
  }
  return trajectory;
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
  Evaluation asked;
  const Trajectory reference = take_file(read_trajectory_file(request.reference), asked);
  const TimeAlignment time = time_alignment(request, chained(rows), reference, asked);
  Evaluation evaluation = evaluate_pairs(rows, reference, time);
  if (evaluation.pairs.empty()) {
    throw_nothing_in_common(request, distinct_times(rows), reference, time.offset_s);
  }
  evaluation.offset_s = asked.offset_s;
  evaluation.notes.insert(evaluation.notes.begin(), asked.notes.begin(), asked.notes.end());
  return evaluation;
}

Evaluation evaluate_trajectory_file(const EvaluationRequest& request) {
  Evaluation evaluation;
  const Trajectory estimate = take_file(read_trajectory_file(request.estimate), evaluation);
  const Trajectory reference = take_file(read_trajectory_file(request.reference), evaluation);
  const TimeAlignment time = time_alignment(request, estimate, reference, evaluation);
  const Association found = associate(request, estimate, reference, time);
  if (found.matches.empty()) {
    throw_nothing_in_common(request, estimate.times, reference, time.offset_s);
  }
  if (time.offset_s != 0.0 && !found.by_time) {
    evaluation.notes.push_back("the offset counts for nothing: " + request.estimate.string() +
                               " has no times");
    evaluation.offset_s.reset();
  }
  const MatchedTrajectories matched = matched_poses(estimate, found.reference, found.matches);
  note_interpolated(found.interpolated, evaluation);
  evaluation.estimate_frames = estimate.poses.size();
  evaluation.reference_frames = reference.poses.size();
  evaluation.trajectory = trajectory_errors(matched, request.alignment);
  if (request.pairs) add_pairs(found.matches, matched, evaluation);
  return evaluation;
}

}  // namespace

Evaluation evaluate_pairs(const std::vector<RelativePoseRow>& rows, const Trajectory& reference,
                          const TimeAlignment& time) {
  const ReferenceRows reference_rows(reference, rows, time);
  Evaluation evaluation;
  evaluation.reference_frames = reference.poses.size();
  for (const RelativePoseRow& row : rows) {
    const auto* first = reference_rows.find(row.index1, row.t1);
    const auto* second = reference_rows.find(row.index2, row.t2);
    if (first == nullptr || second == nullptr) continue;
    evaluation.pairs.push_back(pair_error(row, motion_between(*first, *second)));
  }
  note_interpolated(reference_rows.interpolated(), evaluation);
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
  const Association found = match_frames(*frames, reference, {});
  if (found.matches.empty()) return evaluation;
  evaluation.trajectory =
      trajectory_errors(matched_poses(estimate, found.reference, found.matches), alignment);
  return evaluation;
}

Evaluation evaluate_trajectory(const Trajectory& estimate, const Trajectory& reference,
                               Alignment alignment) {
  const auto found = associate(estimate, reference, {});
  if (!found) {
    throw std::invalid_argument("the trajectory has " + poses_in(estimate) +
                                ", the reference has " + poses_in(reference) +
                                ": must be as many, or both must have times");
  }
  if (found->matches.empty()) {
    throw std::invalid_argument("the trajectory has no frame in common with the reference");
  }
  Evaluation evaluation;
  evaluation.estimate_frames = estimate.poses.size();
  evaluation.reference_frames = reference.poses.size();
  note_interpolated(found->interpolated, evaluation);
  evaluation.trajectory =
      trajectory_errors(matched_poses(estimate, found->reference, found->matches), alignment);
  return evaluation;
}

namespace {

/// A table of poses: trajectory_camera.csv, or EuRoC's, whose first line is a comment or numbers.
bool looks_like_pose_table(const std::filesystem::path& path) {
  if (!fault_of_file(path).empty()) return false;
  std::ifstream stream(path);
  std::string line;
  if (!std::getline(stream, line) || line.empty()) return false;
  const bool number = line.front() >= '0' && line.front() <= '9';
  return number || line.front() == '#' || line.rfind("time,", 0) == 0;
}

}  // namespace

Evaluation evaluate_files(const EvaluationRequest& request) {
  const bool csv =
      request.estimate.extension() == ".csv" && !looks_like_pose_table(request.estimate);
  const bool is_pairs = csv || looks_like_relative_poses(request.estimate);
  return is_pairs ? evaluate_pairs_file(request) : evaluate_trajectory_file(request);
}

}  // namespace oneac
