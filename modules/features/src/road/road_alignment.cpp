#include "oneac/features/road_alignment.h"

#include "klt/klt_track.h"
#include "road_polish.h"
#include "road_prior.h"
#include "road_search.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/geometry/driven_path.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oneac {
namespace {

using namespace internal;

constexpr int kLevels = 3;             // full size, half, quarter
constexpr double kSearchStep = 0.8;    // [px of the level] of the nearest blocks, between lengths
constexpr std::size_t kMostPeaks = 4;  // of the search that are polished and compared
// A peak of the search with less of the best one's evidence will not overtake it.
constexpr double kPromising = 0.4;
constexpr double kLeastUsable = 0.25;  // [-] of the strip
constexpr int kLeastTextured = 3;      // blocks
constexpr int kScoreStride = 2;        // lines along the road that judge rivals
constexpr double kSamePlace = 1.5;     // [search steps] nearer peaks are one
// [heights] Shorter steps are those of a road that rests, and of a vehicle ahead that goes as we do
// or nearly so; what lies before its wheels and beside them tells them apart: so many of the
// nearest blocks, an outermost one among them, which no vehicle in our lane covers.
constexpr double kVehicleAhead = 0.3;
constexpr int kLeastNearest = 2;
constexpr double kClearly = 0.5;  // [-] weight of a block that agrees

/// The two views by their part: template and image.
struct Problem {
  RoadContext context;
  RoadPrior prior;
  Eigen::Matrix3d R_level_a;
  bool forward = true;  ///< the template is the second view, which sees road of the first nearer
};

Problem make_problem(const RoadViews& views, const PinholeCamera& camera, const RoadStep& step,
                     const RoadAlignmentOptions& options) {
  const Eigen::Vector3d direction = step.T_2_1.t.normalized();
  const Eigen::Vector3d goes = step.R_level_cam * (step.T_2_1.R.transpose() * -direction);
  Problem problem;
  problem.forward = goes.z() >= 0.0;
  const RoadImage& a = problem.forward ? views.second : views.first;
  const RoadImage& b = problem.forward ? views.first : views.second;
  problem.context = {&a.pyramid(), &b.pyramid(), camera, views.mask, nullptr};
  problem.prior = make_prior(step, problem.forward, direction, options);
  const Eigen::Matrix3d R_level_b =
      problem.forward ? step.R_level_cam : step.R_level_cam * step.T_2_1.R.transpose();
  problem.R_level_a = R_level_b * problem.prior.start.R_b_a;
  return problem;
}

/// A fit and what it explains at full size.
struct Candidate {
  RoadFit fit;
  RoadScore score;
  double searched = 0.0;  ///< evidence of its peak in the search
};

std::vector<Candidate> candidates_at(const Problem& problem, const RoadGrid& grid,
                                     std::size_t coarsest, const std::vector<RoadScore>& peaks,
                                     double step, const RoadAlignmentOptions& options) {
  std::vector<Candidate> candidates;
  const RoadLook<float> look{0, template_values(problem.context, grid, 0), options.noise_grey,
                             kScoreStride};
  for (const RoadScore& peak : peaks) {
    if (peak.evidence < kPromising * peaks.front().evidence) break;
    Candidate candidate;
    candidate.fit =
        polish(problem.context, grid, coarsest, problem.prior, {peak.length, 4.0 * step}, options);
    candidate.score = score_length(problem.context, grid, look, candidate.fit.motion);
    candidate.searched = peak.evidence;
    candidates.push_back(std::move(candidate));
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.score.evidence > b.score.evidence;
  });
  return candidates;
}

/// The pose of the two views as fitted, t in camera heights.
RelativePose fitted_pose(const RoadMotion& motion, bool forward) {
  if (forward)
    return {motion.R_b_a.transpose(), motion.length * (motion.R_b_a.transpose() * motion.s)};
  return {motion.R_b_a, -motion.length * motion.s};
}

/// The way of the car as far as its length is predicted; else straight ahead.
DrivenPath expected_path(const RoadStep& step) {
  constexpr double kTellingLength = 0.05;  // [heights] a shorter step turns by noise
  const bool known = step.length > kTellingLength && step.length_sigma < 0.5 * step.length;
  if (!known) return {};
  return {{step.T_2_1.R, step.length * step.T_2_1.t.normalized()}, step.R_level_cam};
}

/// Share of the evidence from road that the car does not drive on: its way turns off before.
double share_beside(const RoadFit& fit, const RoadGrid& grid, const DrivenPath& path,
                    double half_width) {
  double weights = 0.0, beside = 0.0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const double x = half_width * (2.0 * (static_cast<double>(i % kLanes) + 0.5) / kLanes - 1.0);
    const auto middle = path.at(grid.distance[i]);
    weights += fit.weight[i];
    if (!middle || std::abs(x - *middle) > half_width) beside += fit.weight[i];
  }
  return weights > 0.0 ? beside / weights : 0.0;
}

/// Root mean square distance of the blocks that tell the length. [heights]
double reach_of(const RoadFit& fit, const RoadGrid& grid) {
  double evidence = 0.0, ahead = 0.0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    evidence += fit.evidence[i];
    ahead += fit.evidence[i] * grid.distance[i] * grid.distance[i];
  }
  return evidence > 0.0 ? std::sqrt(ahead / evidence) : 0.0;
}

void take_fit(const Problem& problem, const RoadFit& fit, double beside,
              const RoadAlignmentOptions& options, RoadAlignment& result) {
  result.length = fit.motion.length;
  const double floor =
      std::hypot(options.height_sigma, DrivenPath::kKerb * beside) * fit.motion.length;
  result.sigma = std::sqrt(std::max(fit.covariance(0, 0), 0.0) * fit.scatter + floor * floor);
  result.relative_sigma = result.length > 0.0 ? result.sigma / result.length : 0.0;
  result.T_2_1 = fitted_pose(fit.motion, problem.forward);
  result.normal =
      problem.forward ? fit.motion.n : Eigen::Vector3d(fit.motion.R_b_a.transpose() * fit.motion.n);
  result.roll = fit.z(2);
  result.roll_sigma = std::sqrt(std::max(fit.covariance(2, 2), 0.0));
}

/// Statistics of a fit, whatever comes of it.
void describe_fit(const RoadFit& fit, RoadAlignment& result) {
  double rho = 0.0, gain = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    rho += fit.weight[i] * fit.equations[i].rho;
    gain += fit.weight[i] * fit.equations[i].gain;
    weights += fit.weight[i];
  }
  result.blocks = fit.blocks;
  result.correlation = weights > 0.0 ? rho / weights : 0.0;
  result.gain = weights > 0.0 ? gain / weights : 1.0;
}

bool is_seen_near(const RoadFit& fit, const RoadAlignmentOptions& options) {
  const auto correlates = [&](std::size_t lane) {
    return fit.equations[lane].rho >= options.min_correlation;
  };
  const auto agrees = [&](std::size_t lane) {
    return correlates(lane) && fit.weight[lane] > kClearly;
  };
  // A lane line is the same at any length: it tells nothing, but no vehicle covers it.
  const auto is_open = [&](std::size_t lane) {
    return agrees(lane) || (correlates(lane) && !(fit.evidence[lane] > 0.0));
  };
  int agreeing = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) agreeing += agrees(lane) ? 1 : 0;
  return agreeing >= kLeastNearest && (is_open(0) || is_open(kLanes - 1));
}

RoadStatus judge(const std::vector<Candidate>& candidates, const LengthRange& range,
                 const RoadAlignmentOptions& options, RoadAlignment& result) {
  const RoadFit& best = candidates.front().fit;
  describe_fit(best, result);
  bool preferred = false;
  for (const Candidate& other : candidates) {
    const double apart = std::abs(other.fit.motion.length - best.motion.length);
    if (apart < kSamePlace * range.step) continue;
    // Of a length that the search would rather have the polish has lost the way.
    preferred = preferred || options.max_rival * other.searched > candidates.front().searched;
    if (result.rival_length != 0.0) continue;
    result.rival = other.score.evidence / candidates.front().score.evidence;
    result.rival_length = other.fit.motion.length;
  }
  if (best.blocks < options.min_blocks && best.agreeing > options.min_agreeing) {
    return RoadStatus::kNoCorrelation;
  }
  if (result.rival > options.max_rival || preferred) return RoadStatus::kAmbiguous;
  const double length = best.motion.length;
  if (length < -range.step) return RoadStatus::kAmbiguous;  // the other way than was seen
  if (length < range.low - range.step || length > range.high + range.step) {
    return RoadStatus::kOutOfRange;
  }
  if (best.blocks < options.min_blocks || best.agreeing < options.min_agreeing) {
    return RoadStatus::kInconsistent;
  }
  if (length < kVehicleAhead && !is_seen_near(best, options)) return RoadStatus::kInconsistent;
  return best.converged ? RoadStatus::kMeasured : RoadStatus::kNoCorrelation;
}

LengthRange range_of(const RoadStep& step, const RoadGrid& grid, const PinholeCamera& camera,
                     std::size_t level, const RoadAlignmentOptions& options) {
  const double reach = options.search_sigmas * step.length_sigma;
  LengthRange range;
  range.low = std::clamp(step.length - reach, step.min_length, step.max_length);
  range.high = std::clamp(step.length + reach, step.min_length, step.max_length);
  const double px_per_height = camera.fy / (grid.distance[0] * grid.distance[0]);
  range.step = kSearchStep * static_cast<double>(1U << level) / px_per_height;
  // Room for a maximum inside.
  range.low = std::max(range.low - range.step, 0.0);
  range.high += range.step;
  return range;
}

/// What is searched: where no length is predicted the other sense of the direction as well, which
/// tracks that have slipped along a pattern take for the right one.
LengthRange searched(const RoadStep& step, LengthRange range) {
  if (step.length_sigma > range.high) range.low = -range.high;
  return range;
}

void require_size(const ImageView& mask, const PinholeCamera& camera, const RoadImage& image) {
  const auto& pyramid = image.pyramid();
  require(pyramid.width() == camera.width && pyramid.height() == camera.height, "align_road: image",
          pyramid.width(), "of the camera's size");
  require(mask.empty() || (mask.width == camera.width && mask.height == camera.height),
          "align_road: mask", mask.width, "of the camera's size");
}

RoadAlignment align(const Problem& problem, const RoadStep& step,
                    const RoadAlignmentOptions& options, RoadAlignment result) {
  const RoadGrid grid = make_road_grid(problem.context, problem.R_level_a, options);
  if (grid.usable_share < kLeastUsable) return result;
  const std::size_t coarsest =
      std::min(problem.context.image->levels.size(), std::size_t{kLevels}) - 1;
  const double noise = options.noise_grey / static_cast<double>(1U << coarsest);
  const auto textured =
      textured_blocks(grid, template_values(problem.context, grid, 0), options.noise_grey);
  result.textured = static_cast<int>(std::count(textured.begin(), textured.end(), true));
  result.status = RoadStatus::kNoTexture;
  if (result.textured < kLeastTextured) return result;
  const LengthRange range = range_of(step, grid, problem.context.camera, coarsest, options);
  const RoadLook<float> look{coarsest, template_values(problem.context, grid, coarsest), noise,
                             kSearchStride};
  const auto peaks = search_lengths(problem.context, grid, look, problem.prior.start,
                                    searched(step, range), kMostPeaks);
  result.status = RoadStatus::kNoCorrelation;
  if (peaks.empty()) return result;
  const auto candidates = candidates_at(problem, grid, coarsest, peaks, range.step, options);
  result.status = judge(candidates, range, options, result);
  if (result.status != RoadStatus::kMeasured) return result;
  const RoadFit& fit = candidates.front().fit;
  result.reach = reach_of(fit, grid);
  take_fit(problem, fit, share_beside(fit, grid, expected_path(step), options.half_width), options,
           result);
  return result;
}

}  // namespace

RoadImage::RoadImage(const ImageView& image) {
  if (image.empty()) return;
  pyramid_ = std::make_shared<const ImagePyramid>(build_pyramid(image, kLevels));
}

RoadImage::RoadImage(std::shared_ptr<const ImagePyramid> pyramid) : pyramid_(std::move(pyramid)) {}

RoadImage road_image(const std::shared_ptr<const FrameFeatures>& features, const ImageView& image) {
  const auto frame = std::dynamic_pointer_cast<const KltFrame>(features);
  if (!frame || frame->pyramid.levels.size() < static_cast<std::size_t>(kLevels)) {
    return RoadImage(image);
  }
  return RoadImage(std::shared_ptr<const ImagePyramid>(frame, &frame->pyramid));
}

void RoadAlignmentOptions::validate() const {
  check_bounds("road", *this);
  require(farthest > nearest, "road.farthest", farthest, "more than nearest");
}

RoadAlignment align_road(const RoadViews& views, const PinholeCamera& camera, const RoadStep& step,
                         const RoadAlignmentOptions& options, Workers* workers) {
  options.validate();
  step.validate();
  RoadAlignment result;
  result.T_2_1 = {step.T_2_1.R, step.T_2_1.t.normalized()};
  if (views.first.empty() || views.second.empty()) return result;
  require_size(views.mask, camera, views.first);
  require_size(views.mask, camera, views.second);
  Workers alone;
  Problem problem = make_problem(views, camera, step, options);
  problem.context.workers = workers != nullptr ? workers : &alone;
  return align(problem, step, options, result);
}

}  // namespace oneac
