#include "gc_ransac/gc_ransac_loop.h"

#include "oneac/robust/graph_cut.h"
#include "oneac/robust/samplers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace oneac::internal {
namespace {

// Iterations before the first local optimisation of a solver whose model is exact: the first few
// best models are soon beaten. The authors' program has 20.
constexpr std::size_t kBeforeFirstOptimisation = 20;
// Refits go from the first multiple of the threshold down to it by halves (Chum, Matas, Kittler,
// "Locally optimized RANSAC", 2003): a planar model misses by the suspension's pitch, 0.3° is 4 px.
constexpr double kWidths[] = {4.0, 2.0};
// A refit that gains less than half an inlier's cost ends a local optimisation.
constexpr double kWorthwhile = 0.5;

struct Scored {
  Eigen::Matrix3d model = Eigen::Matrix3d::Zero();
  double cost = std::numeric_limits<double>::infinity();
};

std::unique_ptr<Sampler> make_sampler(const ModelSpace& space, std::uint64_t seed,
                                      const GcRansacOptions& options) {
  const std::size_t size = space.points().size();
  if (options.sampler == "prosac") {
    return std::make_unique<ProsacSampler>(size, space.sample_size(), seed);
  }
  return std::make_unique<UniformSampler>(size, space.sample_size(), seed);
}

class Loop {
 public:
  Loop(ModelSpace& space, std::uint64_t seed, const GcRansacOptions& options)
      : space_(space),
        options_(options),
        sampler_(make_sampler(space, seed, options)),
        cut_(space.points().size(), grid_neighbours(space.points(), options.neighbourhood_cells),
             options.coherence) {
    limit_ = std::min(static_cast<std::size_t>(options.max_iterations), sampler_->distinct());
    first_optimisation_ = space.approximate() ? 1 : kBeforeFirstOptimisation;
    // A model without any inlier is none.
    minimal_.cost = static_cast<double>(space.points().size());
  }

  LoopResult run() {
    std::size_t& done = statistics_.iterations;
    while (done < limit_) {
      draw_and_verify();
      ++done;
      if (pending_ && done >= first_optimisation_) take_over();
    }
    if (pending_) take_over();
    return {std::isfinite(best_.cost), best_.model, best_.cost, statistics_};
  }

 private:
  void draw_and_verify() {
    std::size_t sample[kLargestSample];
    sampler_->draw(sample);
    for (const Eigen::Matrix3d& model : space_.solve(sample)) {
      ++statistics_.hypotheses;
      const double cost = space_.cost(model, minimal_.cost);
      if (!(cost < minimal_.cost)) continue;
      minimal_ = {model, cost};
      pending_ = true;
    }
  }

  /// Optimises the best minimal model. It is compared with other minimal models only: a coarse one
  /// in the right basin does not beat an optimised one in a wrong basin.
  void take_over() {
    pending_ = false;
    const Scored optimised = optimise(minimal_);
    if (optimised.cost < best_.cost) best_ = optimised;
    limit_ = std::min(limit_, stop_at());
  }

  Scored optimise(const Scored& start) {
    if (options_.lo_iterations == 0) return start;
    ++statistics_.local_optimisations;
    Scored current = start;
    for (int way = 0; way < space_.refits(); ++way) {
      const Scored candidate = narrowed(start, way);
      if (candidate.cost < current.cost) current = candidate;
    }
    for (int i = 0; i < options_.lo_iterations; ++i) {
      space_.squared_errors(current.model, errors_);
      if (options_.coherence > 0.0) ++statistics_.graph_cuts;
      if (cut_.label(errors_, labels_) < space_.sample_size()) break;
      Eigen::Matrix3d model = current.model;
      if (!space_.refit(space_.refits() - 1, labels_, model)) break;
      const double cost = space_.cost(model, current.cost);
      if (!(cost < current.cost)) break;
      const bool worthwhile = cost < current.cost - kWorthwhile;
      current = {model, cost};
      if (!worthwhile) break;
    }
    return current;
  }

  /// The model refitted to the points within a narrowing threshold, where that is better.
  Scored narrowed(const Scored& start, int way) {
    Eigen::Matrix3d model = start.model;
    for (const double wide : kWidths) {
      space_.squared_errors(model, errors_);
      labels_.resize(errors_.size());
      for (std::size_t i = 0; i < errors_.size(); ++i) labels_[i] = errors_[i] <= wide * wide;
      if (!space_.refit(way, labels_, model)) return start;
    }
    const double cost = space_.cost(model, start.cost);
    return cost < start.cost ? Scored{model, cost} : start;
  }

  /// By the share of points that obey the best model as its sample gave it: an optimised model's
  /// share says how good the samples are, not how many of them lead there.
  std::size_t stop_at() {
    space_.squared_errors(minimal_.model, errors_);
    const auto inliers =
        std::count_if(errors_.begin(), errors_.end(), [](double e) { return e <= 1.0; });
    const double ratio = static_cast<double>(inliers) / static_cast<double>(errors_.size());
    const double needed = needed_samples(ratio, space_.sample_size(), options_.confidence);
    const double most = static_cast<double>(options_.max_iterations);
    return static_cast<std::size_t>(
        std::clamp(std::ceil(needed), static_cast<double>(options_.min_iterations), most));
  }

  ModelSpace& space_;
  const GcRansacOptions& options_;
  std::unique_ptr<Sampler> sampler_;
  SpatialCut cut_;
  std::size_t limit_ = 0;
  std::size_t first_optimisation_ = 0;
  Scored minimal_;
  Scored best_;
  bool pending_ = false;
  std::vector<double> errors_;
  std::vector<std::uint8_t> labels_;
  RobustStatistics statistics_;
};

}  // namespace

double needed_samples(double inlier_ratio, std::size_t sample_size, double confidence) {
  const double clean = std::pow(inlier_ratio, static_cast<double>(sample_size));
  if (!(clean > 0.0)) return std::numeric_limits<double>::infinity();
  if (clean >= 1.0) return 1.0;
  return std::max(1.0, std::log1p(-confidence) / std::log1p(-clean));
}

LoopResult gc_ransac_loop(ModelSpace& space, std::uint64_t seed, const GcRansacOptions& options) {
  if (space.points().size() < std::max(space.sample_size(), std::size_t{1})) return {};
  return Loop(space, seed, options).run();
}

AcSpan gather(AcSpan acs, const std::vector<std::uint8_t>& labels,
              std::vector<AffineCorrespondence>& buffer) {
  buffer.clear();
  for (std::size_t i = 0; i < acs.size(); ++i) {
    if (labels[i] != 0) buffer.push_back(acs[i]);
  }
  return buffer;
}

}  // namespace oneac::internal
