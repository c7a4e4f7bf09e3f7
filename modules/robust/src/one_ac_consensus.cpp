#include "oneac/robust/one_ac_consensus.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/essential.h"
#include "oneac/geometry/triangulation.h"
#include "oneac/robust/hypotheses.h"
#include "oneac/robust/point_set.h"
#include "oneac/robust/polish.h"
#include "oneac/robust/rotation_only.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
// Hypotheses remembered before they are thinned to distinct modes: near-copies of the best one
// crowd the top, one per good correspondence and pitch.
constexpr std::size_t kShortList = 2000;
// Width of the first polishing pass against the second: reaches from the sweep's half step, about
// two pixels, into the basin.
constexpr double kWideLoss = 3.0;
constexpr int kWideIterations = 6;

struct Scored {
  RelativePose pose;
  double cost;
};

/// Keeps the best hypotheses seen, and the cost that a new one has to beat.
class ShortList {
 public:
  explicit ShortList(double worst_cost) : bar_(worst_cost) {}

  [[nodiscard]] double bar() const { return bar_; }

  void offer(const RelativePose& pose, double cost) {
    if (!(cost < bar_)) return;
    entries_.push_back({pose, cost});
    if (entries_.size() >= 2 * kShortList) shrink();
  }

  /// Best first; equals in the order they came.
  [[nodiscard]] const std::vector<Scored>& sorted() {
    sort();
    return entries_;
  }

 private:
  void sort() {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Scored& a, const Scored& b) { return a.cost < b.cost; });
  }
  void shrink() {
    sort();
    entries_.resize(kShortList);
    bar_ = entries_.back().cost;
  }

  std::vector<Scored> entries_;
  double bar_;
};

/// Directions of t are compared without their sign: it is decided at the end.
bool same_mode(const RelativePose& a, const RelativePose& b, const ConsensusOptions& options) {
  return rotation_error(a.R, b.R) < options.mode_rotation_deg * kDegree &&
         normal_error(a.t, b.t) < options.mode_direction_deg * kDegree;
}

std::vector<RelativePose> distinct_modes(const std::vector<Scored>& sorted,
                                         const ConsensusOptions& options) {
  std::vector<RelativePose> modes;
  for (const Scored& candidate : sorted) {
    if (modes.size() >= static_cast<std::size_t>(options.modes)) break;
    const bool known = std::any_of(modes.begin(), modes.end(), [&](const RelativePose& mode) {
      return same_mode(mode, candidate.pose, options);
    });
    if (!known) modes.push_back({candidate.pose.R, candidate.pose.t.normalized()});
  }
  return modes;
}

RelativePose polish_twice(const RelativePose& mode, AcSpan acs, double threshold) {
  const PolishResult wide = polish(mode, acs, {kWideLoss * threshold, kWideIterations});
  return polish(wide.pose, acs, {threshold, PolishOptions{}.max_iterations}).pose;
}

/// t or −t, whichever puts more inliers before both cameras.
RelativePose with_forward_sign(const RelativePose& pose, AcSpan acs,
                               const std::vector<bool>& inliers) {
  int votes = 0;
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (inliers[i]) votes += cheirality(pose, acs[i].x1, acs[i].x2);
  }
  return votes < 0 ? RelativePose{pose.R, -pose.t} : pose;
}

/// Most of the points must be explained for the camera to have stood; the rest may be traffic.
constexpr double kStandingShare = 0.8;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The answer of a camera that did not travel: still, or rocking on its suspension (R ≠ I, t = 0).
/// Empty when neither explains the points.
std::optional<RobustResult> standing(AcSpan acs, double threshold, double standing_shift) {
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  std::vector<double> errors = rotation_transfer_errors(still, acs);
  RobustResult result;
  if (median(errors) >= standing_shift) {
    result.pose.R = fit_rotation(acs, threshold);
    errors = rotation_transfer_errors(result.pose.R, acs);
    if (median(errors) >= standing_shift) return std::nullopt;
  }
  for (double error : errors) result.inliers.push_back(error <= threshold);
  result.inlier_count =
      static_cast<std::size_t>(std::count(result.inliers.begin(), result.inliers.end(), true));
  const double needed = kStandingShare * static_cast<double>(acs.size());
  if (static_cast<double>(result.inlier_count) < needed) return std::nullopt;
  result.status = PoseStatus::kNoMotion;
  return result;
}

/// The consensus of correspondences that are all finite.
RobustResult consensus_of_finite(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double focal_px,
                                    const ConsensusOptions& options) {
  RobustResult result;
  result.inliers.assign(acs.size(), false);
  if (acs.size() < static_cast<std::size_t>(options.min_inliers)) return result;
  const double threshold = options.threshold_px / focal_px;
  if (auto stood = standing(acs, threshold, options.standing_px / focal_px)) return *stood;

  const PointSet points(acs);
  ShortList best(static_cast<double>(acs.size()));
  std::size_t scored = 0;
  const auto score = [&](const RelativePose& pose) {
    ++scored;
    best.offer(pose, msac_cost(essential_matrix(pose), points, threshold, best.bar()));
  };
  for (double pitch :
       pitch_sweep(options.pitch_sweep_deg * kDegree, options.pitch_step_deg * kDegree)) {
    planar_hypotheses(acs, R_level_cam, pitch, {options.ground, options.planar}, score);
  }

  result.statistics.hypotheses = scored;
  result.cost = std::numeric_limits<double>::infinity();
  for (const RelativePose& mode : distinct_modes(best.sorted(), options)) {
    const RelativePose polished = polish_twice(mode, acs, threshold);
    const double cost = msac_cost(essential_matrix(polished), points, threshold, result.cost);
    if (!(cost < result.cost)) continue;
    result.cost = cost;
    result.pose = polished;
  }
  if (!std::isfinite(result.cost)) return result;
  result.inliers = sampson_inliers(essential_matrix(result.pose), acs, threshold);
  result.inlier_count =
      static_cast<std::size_t>(std::count(result.inliers.begin(), result.inliers.end(), true));
  if (result.inlier_count < static_cast<std::size_t>(options.min_inliers)) {
    result.pose = {};
    return result;
  }
  result.pose = with_forward_sign(result.pose, acs, result.inliers);
  result.status = PoseStatus::kOk;
  return result;
}

void require(bool good, const char* field, double value, const char* bound) {
  if (good) return;
  throw std::invalid_argument(std::string("consensus.") + field + " = " + std::to_string(value) +
                              ", must be " + bound);
}

}  // namespace

void ConsensusOptions::validate() const {
  require(ground || planar, "ground", 0, "true when consensus.planar is false");
  require(threshold_px > 0.0, "threshold_px", threshold_px, "positive");
  require(pitch_sweep_deg >= 0.0 && pitch_sweep_deg <= 10.0, "pitch_sweep_deg", pitch_sweep_deg,
          "from 0 to 10");
  require(pitch_step_deg > 0.0, "pitch_step_deg", pitch_step_deg, "positive");
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
