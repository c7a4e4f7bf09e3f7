#include "oneac/robust/one_ac_consensus.h"

#include "pose_search.h"

#include "oneac/geometry/essential.h"
#include "oneac/robust/degeneracy.h"
#include "oneac/robust/point_set.h"
#include "oneac/robust/polish.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace oneac {
namespace {

using internal::Candidate;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
// Hypotheses scored on all points before they are thinned to distinct modes: near-copies of the
// best one crowd the top.
constexpr std::size_t kShortList = 128;
// Width of the first polishing pass against the second: reaches from the sweep's half step, about
// two pixels, into the basin.
constexpr double kWideLoss = 3.0;
constexpr int kWideIterations = 4;
constexpr int kNarrowIterations = 6;
// Modes closer than both after the first pass are in one basin: a point at 40° moves by half a
// pixel at f = 700 px.
constexpr double kMetRotationDeg = 0.05;
constexpr double kMetDirectionDeg = 1.0;
// Steps of the first passes need not be finer than the last pass [rad].
constexpr double kCoarseStep = 1e-5;

/// The correspondences in every form that the stages need.
struct Problem {
  AcSpan acs;
  const Eigen::Matrix3d& R_level_cam;
  double threshold;  ///< [-] normalised
  const ConsensusOptions& options;
  PointSet points;  ///< all of them
  PointSet sample;  ///< evenly spaced ones, for the first polishing pass
};

// Point pairs of the first polishing pass: with 80 % outliers still forty that the motion explains.
constexpr std::size_t kWideSample = 192;

PointSet evenly_spaced(AcSpan acs, std::size_t count) {
  if (acs.size() <= count) return PointSet(acs);
  std::vector<AffineCorrespondence> some(count);
  for (std::size_t k = 0; k < count; ++k) some[k] = acs[k * acs.size() / count];
  return PointSet(some);
}

/// Directions of t are compared without their sign: it is decided at the end.
bool same_mode(const RelativePose& a, const RelativePose& b, double cos_rotation,
               double cos_direction) {
  const double trace = (a.R.array() * b.R.array()).sum();
  return 0.5 * (trace - 1.0) > cos_rotation && std::abs(a.t.dot(b.t)) > cos_direction;
}

/// How close two poses are to count as one, as cosines.
struct Closeness {
  double cos_rotation, cos_direction;

  Closeness(double rotation_deg, double direction_deg)
      : cos_rotation(std::cos(rotation_deg * kDegree)),
        cos_direction(std::cos(direction_deg * kDegree)) {}
};

/// The first of each group of close poses, at most `count`. @param sorted  best first
std::vector<Candidate> distinct(const std::vector<Candidate>& sorted, const Closeness& close,
                                int count) {
  std::vector<Candidate> kept;
  for (const Candidate& candidate : sorted) {
    if (kept.size() >= static_cast<std::size_t>(count)) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& mode) {
      return same_mode(mode.pose, candidate.pose, close.cos_rotation, close.cos_direction);
    });
    if (!known) kept.push_back(candidate);
  }
  return kept;
}

void rank(std::vector<Candidate>& candidates, const PointSet& points, double threshold) {
  for (Candidate& c : candidates) {
    c.cost = msac_cost(essential_matrix(c.pose), points, threshold,
                       std::numeric_limits<double>::infinity());
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

void polish_all(std::vector<Candidate>& candidates, const PointSet& points, double scale,
                int iterations) {
  for (Candidate& c : candidates) {
    c.pose = polish_coarsely(c.pose, points, {scale, iterations, kCoarseStep}).pose;
  }
}

/// Best first. Empty when no correspondence gave a hypothesis.
std::vector<Candidate> ranked_modes(const Problem& p, RobustStatistics& statistics) {
  internal::SearchResult found =
      internal::search_poses(p.acs, p.R_level_cam, p.threshold, kShortList, p.options);
  statistics.iterations = found.solved;
  statistics.hypotheses = found.hypotheses;
  const double wide = kWideLoss * p.threshold;
  rank(found.best, p.sample, wide);
  std::vector<Candidate> modes = distinct(
      found.best, {p.options.mode_rotation_deg, p.options.mode_direction_deg}, p.options.modes);
  statistics.local_optimisations = modes.size();
  polish_all(modes, p.sample, wide, kWideIterations);
  rank(modes, p.sample, p.threshold);
  // Modes of one basin have met by now.
  std::vector<Candidate> finalists =
      distinct(modes, {kMetRotationDeg, kMetDirectionDeg}, p.options.finalists);
  polish_all(finalists, p.points, p.threshold, kNarrowIterations);
  rank(finalists, p.points, p.threshold);
  return finalists;
}

/// The consensus of correspondences that are all finite.
RobustResult consensus_of_finite(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                                 const ConsensusOptions& options) {
  RobustResult result;
  result.inliers.assign(acs.size(), false);
  if (acs.size() < static_cast<std::size_t>(options.min_inliers)) return result;
  const Problem p{acs,     R_level_cam,   options.threshold_px / focal_px,
                  options, PointSet(acs), evenly_spaced(acs, kWideSample)};
  const DegeneracyBounds bounds{p.threshold, options.standing_px / focal_px};
  if (auto stood = standing(acs, bounds)) return *stood;

  const std::vector<Candidate> modes = ranked_modes(p, result.statistics);
  if (modes.empty()) return result;
  if (auto turned = turning(acs, modes.front().pose.R, bounds)) {
    turned->statistics = result.statistics;
    return *turned;
  }
  conclude(modes.front().pose, acs, p.threshold, result);
  if (result.inlier_count < static_cast<std::size_t>(options.min_inliers)) {
    result.pose = {};
    result.covariance.setZero();
    return result;
  }
  result.status = PoseStatus::kOk;
  settle_one_plane(acs, R_level_cam, p.threshold, result);
  return result;
}

void require(bool good, const char* field, double value, const char* bound) {
  if (good) return;
  throw std::invalid_argument(std::string("consensus.") + field + " = " + std::to_string(value) +
                              ", must be " + bound);
}

}  // namespace

void ConsensusOptions::validate() const {
  require(ground || planar || side_wall || front_wall || wall, "ground", 0,
          "true when no other solver is on");
  require(threshold_px > 0.0, "threshold_px", threshold_px, "positive");
  require(pitch_sweep_deg >= 0.0 && pitch_sweep_deg <= 10.0, "pitch_sweep_deg", pitch_sweep_deg,
          "from 0 to 10");
  require(pitch_step_deg > 0.0, "pitch_step_deg", pitch_step_deg, "positive");
  require(roll_sweep_deg >= 0.0 && roll_sweep_deg <= 10.0, "roll_sweep_deg", roll_sweep_deg,
          "from 0 to 10");
  require(roll_step_deg > 0.0, "roll_step_deg", roll_step_deg, "positive");
  require(minimal_problems >= 1, "minimal_problems", minimal_problems, "at least 1");
  require(finalists >= 1, "finalists", finalists, "at least 1");
  require(modes >= 1, "modes", modes, "at least 1");
  require(mode_rotation_deg >= 0.0, "mode_rotation_deg", mode_rotation_deg, "at least 0");
  require(mode_direction_deg >= 0.0, "mode_direction_deg", mode_direction_deg, "at least 0");
  require(min_inliers >= 5, "min_inliers", min_inliers, "at least 5");
  require(standing_px >= 0.0, "standing_px", standing_px, "at least 0");
}

RobustResult one_ac_consensus(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                              const ConsensusOptions& options) {
  std::vector<AffineCorrespondence> finite;
  finite.reserve(acs.size());
  std::copy_if(acs.begin(), acs.end(), std::back_inserter(finite),
               [](const AffineCorrespondence& ac) { return ac.is_finite(); });
  RobustResult result = consensus_of_finite(finite, R_level_cam, focal_px, options);
  if (finite.size() == acs.size()) return result;
  std::vector<bool> inliers(acs.size(), false);
  for (std::size_t i = 0, k = 0; i < acs.size(); ++i) {
    if (acs[i].is_finite()) inliers[i] = result.inliers[k++];
  }
  result.inliers = std::move(inliers);
  return result;
}

}  // namespace oneac
