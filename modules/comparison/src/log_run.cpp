#include "log_run.h"

#include "oneac/base/error.h"
#include "oneac/base/printable.h"
#include "oneac/base/thread_clock.h"
#include "oneac/geometry/angles.h"
#include "oneac/initialisers/checked_answer.h"
#include "oneac/rawlog/log_neighbours.h"

#include <algorithm>
#include <set>

namespace oneac::internal {
namespace {

constexpr const char* kTiltMethod = "1ac_pooled";

InitialiserInput input_of(const PairAcs& pair, const Eigen::Matrix3d& R_level_cam,
                          std::uint64_t seed) {
  InitialiserInput input;
  input.acs = pair.acs;
  input.R_level_cam = R_level_cam;
  input.focal_px = pair.camera.focal_px();
  input.seed = seed;
  return input;
}

/// Up to kTiltPairs numbers spread evenly over 0 … pairs − 1.
std::set<std::size_t> spread(std::size_t pairs) {
  std::set<std::size_t> chosen;
  const std::size_t count = std::min(pairs, kTiltPairs);
  for (std::size_t i = 0; i < count; ++i) chosen.insert(i * pairs / count);
  return chosen;
}

}  // namespace

LogRun::LogRun(const CompareSettings& settings, std::size_t log, const CompareHooks& hooks)
    : settings_(settings),
      log_(log),
      hooks_(hooks),
      source_(settings.source_of(log)),
      extractor_(settings.features),
      scan_(scan_log(source_)) {}

bool LogRun::begin(Journal& journal) {
  if (const LogRecord* known = journal.log(log_)) {
    record_ = *known;
    require_same_images();
    prepare_reference();
    return true;
  }
  record_.log = log_;
  record_.name = settings_.log_names()[log_];
  record_.images = scan_.images.size();
  record_.pairs = scan_.pairs();
  record_.last_index = scan_.images.empty() ? 0 : scan_.images.back().index;
  record_.content = scan_.content;
  if (!learn_tilt()) return false;
  prepare_reference();
  journal.add(record_);
  return true;
}

void LogRun::run(const Methods& methods, const Shard& shard, Journal& journal, std::size_t& done) {
  const auto wanted = [&](std::size_t ordinal) {
    return shard.has(ordinal) && !journal.has(log_, ordinal);
  };
  // `wanted` reads the journal on this thread only, as `add` writes it.
  for_pairs(
      wanted,
      [&](const StreamPair& pair, const PairAcs& acs) { return estimate(pair, acs, methods); },
      [&](const PairRecord& record) {
        journal.add(record);
        ++done;
        hooks_.progress(
            static_cast<double>(record.ordinal + 1) / static_cast<double>(scan_.pairs()), done);
      });
}

void LogRun::require_same_images() const {
  const std::size_t last = scan_.images.empty() ? 0 : scan_.images.back().index;
  if (record_.images == scan_.images.size() && record_.last_index == last) {
    if (record_.content == scan_.content) return;
    throw InputError(source_.log.string(), "has other images than when the journal was begun",
                     "choose an empty folder");
  }
  throw InputError(source_.log.string(),
                   "has " + std::to_string(scan_.images.size()) + " images now, and had " +
                       std::to_string(record_.images) + " when the journal was begun",
                   "choose an empty folder");
}

bool LogRun::learn_tilt() {
  record_.tilt = settings_.tilt.tilt(scan_.T_vehicle_cam.linear());
  if (!settings_.tilt.refine) return hooks_.keep_going();
  const auto method =
      make_method(plan_methods({kTiltMethod}, {"default"}).front(), settings_.method_parameters);
  const Eigen::Matrix3d R_level_cam = levelling_rotation(record_.tilt);
  const std::set<std::size_t> chosen = spread(scan_.pairs());
  struct Learned {
    std::size_t ordinal;
    PairAcs acs;
    InitialiserResult result;
  };
  std::vector<Eigen::Vector3d> translations;
  // The workers look pairs up in learned_, so it does not grow under them.
  std::map<std::size_t, PairAcs> learned;
  for_pairs([&](std::size_t ordinal) { return chosen.count(ordinal) > 0; },
            [&](const StreamPair& pair, const PairAcs& acs) {
              return Learned{
                  pair.ordinal, acs,
                  checked_answer(*method, input_of(acs, R_level_cam, settings_.seed)).result};
            },
            [&](Learned pair) {
              if (has_direction(pair.result.status)) translations.push_back(pair.result.pose.t);
              learned.emplace(pair.ordinal, std::move(pair.acs));
              hooks_.progress(0.0, 0);
            });
  learned_ = std::move(learned);
  record_.tilt = corrected_by_travel(record_.tilt, translations);
  return hooks_.keep_going();
}

void LogRun::prepare_reference() {
  R_level_cam_ = levelling_rotation(record_.tilt);
  const std::string poses =
      settings_.reference.empty() ? poses_beside(source_.log) : settings_.reference;
  if (!poses.empty()) {
    record_.reference = printable(poses);
    reference_.emplace(read_trajectory(poses), scan_.images);
    return;
  }
  reference_.emplace(scan_.vehicle, R_level_cam_);
  judge_gps();
}

void LogRun::judge_gps() {
  const auto spacing = scan_.images.size() < 2
                           ? 0.0
                           : (scan_.images.back().time_s - scan_.images.front().time_s) /
                                 static_cast<double>(scan_.pairs());
  const auto quality = gps_quality(scan_.vehicle, spacing);
  record_.reference = quality ? "GPS course" : "none";
  if (!quality) return;
  record_.course_sigma_deg = quality->course_sigma / kDegree;
  record_.heading_sigma_deg = quality->heading_sigma / kDegree;
  record_.heading_vs_gyro_deg =
      gps_against_gyro(scan_.vehicle, scan_.images).value_or(0.0) / kDegree;
}

PairRecord LogRun::estimate(const StreamPair& pair, const PairAcs& acs,
                            const Methods& methods) const {
  PairRecord record;
  record.log = log_;
  record.ordinal = pair.ordinal;
  record.index1 = pair.first->moment().index;
  record.index2 = pair.second->moment().index;
  record.acs = acs.acs.size();
  record.truth = reference_->motion(pair.first->moment(), pair.second->moment());
  for (std::size_t m = 0; m < methods.size(); ++m) {
    // A call that does not count brings code and data into the caches.
    static_cast<void>(checked_answer(*methods[m], input_of(acs, R_level_cam_, settings_.seed)));
    for (int trial = 0; trial < settings_.trials; ++trial) {
      record.results.push_back(timed(acs, *methods[m], trial));
      record.results.back().method = m;
    }
  }
  return record;
}

MethodResult LogRun::timed(const PairAcs& acs, const RelativePoseInitialiser& method,
                           int trial) const {
  const InitialiserInput input =
      input_of(acs, R_level_cam_, settings_.seed + static_cast<std::uint64_t>(trial));
  MethodResult result;
  CheckedAnswer answer;
  {
    const StageTimer timer(result.ms);
    answer = checked_answer(method, input);
  }
  const InitialiserResult& found = answer.result;
  result.trial = trial;
  result.status = answer.fault.empty() ? to_string(found.status) : kInvalidAnswer;
  result.fault = answer.fault;
  result.has_pose = found.status != PoseStatus::kTooFew;
  if (result.has_pose) result.pose = found.pose;
  result.inliers = found.inlier_count;
  result.iterations = found.statistics.iterations;
  result.hypotheses = found.statistics.hypotheses;
  result.local_optimisations = found.statistics.local_optimisations;
  result.graph_cuts = found.statistics.graph_cuts;
  return result;
}

}  // namespace oneac::internal
