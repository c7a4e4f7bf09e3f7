#include "degeneracy/motion_flow.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace oneac::internal {
namespace {

// Nothing that is seen is nearer than a camera height: bonnets are masked, the road begins at two.
constexpr float kNearest = 1.0F;
// |t| from a thousandth to four camera heights, in steps of an eighth: 2 mm to 6 m.
constexpr int kBins = 67;
constexpr float kFirstBin = 1e-3F;
constexpr float kBinsPerLog = 8.0F;
constexpr int kRounds = 3;           // of the reweighted length
constexpr float kMostGrowth = 1.0F;  // [nats] a single patch tells; affinities have heavy tails

struct Length {
  float value = 0.0F;
  double sigma = MotionPrior::kUnknown;
};

float square(float z) {
  return z * z;
}

/// 1σ of a road point's `along`, in its noise: slope and levelling move what the road predicts.
float road_variance(const Flow& f, float length, float slope) {
  return 1.0F + square(length * slope * f.per_depth);
}

bool is_below(const Flow& f, float slope) {
  return f.road > 2.0F * slope;
}

/// Whether t points the wrong way, by the points whose motion is beyond noise.
bool points_backwards(const std::vector<Flow>& flows) {
  float votes = 0.0F;
  for (const Flow& f : flows) {
    if (std::abs(f.along) > kDissents && std::abs(f.across) < kAgrees) {
      votes += f.along > 0.0F ? 1.0F : -1.0F;
    }
  }
  return votes < 0.0F;
}

/// The commonest length that points below the horizon would have on the road; 0 without any.
float commonest_length(const std::vector<Flow>& flows, float slope) {
  std::array<int, kBins + 1> votes{};
  for (const Flow& f : flows) {
    if (f.along < kDissents || std::abs(f.across) > kAgrees || !is_below(f, slope)) continue;
    const float length = f.along / (f.road * f.per_depth);
    const float bin = kBinsPerLog * std::log(length / kFirstBin);
    if (bin >= 0.0F && bin < static_cast<float>(kBins)) ++votes[static_cast<std::size_t>(bin)];
  }
  std::size_t best = 0;
  int most = 0;
  for (std::size_t i = 0; i + 1 < votes.size(); ++i) {
    const int both = votes[i] + votes[i + 1];
    if (both > most) {
      most = both;
      best = i;
    }
  }
  if (most == 0) return 0.0F;
  return kFirstBin * std::exp(static_cast<float>(best + 1) / kBinsPerLog);
}

/// The length at which the road explains most of what is near, from a start. Its sigma holds what
/// a wrong slope does to all points alike.
Length refined(float start, const std::vector<Flow>& flows, float slope) {
  Length length{start, MotionPrior::kUnknown};
  for (int round = 0; round < kRounds; ++round) {
    float information = 0.0F;
    float sum = 0.0F;
    float heights = 0.0F;
    const float scale = square(kAgrees);
    for (const Flow& f : flows) {
      if (!is_below(f, slope) || std::abs(f.across) > kAgrees) continue;
      const float per_length = f.road * f.per_depth;
      const float variance = road_variance(f, length.value, slope);
      const float z2 = square(f.along - length.value * per_length) / variance;
      const float weight = square(scale / (scale + z2)) / variance;
      information += weight * square(per_length);
      sum += weight * per_length * f.along;
      heights += weight * square(per_length) * f.road;
    }
    if (!(information > 0.0F)) return {start, MotionPrior::kUnknown};
    length.value = sum / information;
    length.sigma = std::hypot(1.0 / std::sqrt(static_cast<double>(information)),
                              static_cast<double>(length.value * slope * information / heights));
  }
  return length;
}

/// The shortest length that lets nine of ten dissenting points be a camera height away.
float least_length(const std::vector<Flow>& flows) {
  std::vector<float> least;
  for (const Flow& f : flows) {
    if (f.along > kDissents && std::abs(f.across) < kAgrees) {
      least.push_back(f.along / (f.per_depth * kNearest));
    }
  }
  if (least.empty()) return 0.0F;
  const auto at = least.begin() + static_cast<std::ptrdiff_t>(least.size() * 9 / 10);
  std::nth_element(least.begin(), at, least.end());
  return *at;
}

/// Costs of one point under a translation.
class PointCosts {
 public:
  PointCosts(float length, const MotionEvidenceOptions& o)
      : length_(length),
        slope_(static_cast<float>(o.slope)),
        outlier_(static_cast<float>(o.outlier_cost)),
        depth_(static_cast<float>(o.depth_cost)),
        ground_(static_cast<float>(o.ground_cost)),
        full_(static_cast<float>(o.road_below)) {}

  /// Depth of its own, no farther than the road and no nearer than anything is.
  float free(const Flow& f) const {
    const float least = length_ * std::max(0.0F, f.road - 2.0F * slope_) * f.per_depth;
    const float most = std::max(1.0F, length_ * kNearest * f.per_depth);
    const float outside = std::max({0.0F, least - f.along, f.along - most, -f.along});
    const float moved = std::min(0.5F * square(std::max(0.0F, f.along)), depth_);
    const float cost = 0.5F * (square(f.across) + square(outside)) + moved;
    return std::min(cost, rests(f) ? outlier_ * std::min(1.0F, f.road / full_) : outlier_);
  }

  float road(const Flow& f) const {
    if (!is_below(f, slope_)) return outlier_;
    const float off = f.along - length_ * f.road * f.per_depth;
    return ground_ + 0.5F * (square(f.across) + square(off) / road_variance(f, length_, slope_));
  }

  /// Stands below the horizon: how much that says depends on how low it is.
  bool rests(const Flow& f) const {
    return f.road > 2.0F * slope_ && square(f.along) + square(f.across) < square(kDissents);
  }

  /// Beside the road's own cost, what the growth of its patch says for the translation.
  float growth(const Flow& f) const {
    const float odds = 0.5F * (square(f.growth) - square(f.growth - length_ * f.road_growth));
    return std::clamp(odds, -kMostGrowth, kMostGrowth);
  }

 private:
  float length_;
  float slope_;
  float outlier_;
  float depth_;
  float ground_;
  float full_;
};

struct Sums {
  float road = 0.0F, resting = 0.0F, dissent = 0.0F, growth = 0.0F, mover = 0.0F;
  double gain() const { return road + resting + dissent + growth; }
};

Sums sums_at(float length, const std::vector<Flow>& flows,
             const std::vector<Eigen::Vector2f>& resting, const MotionEvidenceOptions& options) {
  const PointCosts costs(length, options);
  const auto outlier = static_cast<float>(options.outlier_cost);
  const auto depth = static_cast<float>(options.depth_cost);
  Sums sums;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    const Flow& f = flows[i];
    const float rest = std::min(0.5F * resting[i].squaredNorm(), outlier);
    const float free = costs.free(f);
    const float road = costs.road(f);
    if (road < free) {
      sums.road += rest - road;
      sums.growth += costs.growth(f);
    } else {
      (free > rest && costs.rests(f) ? sums.resting : sums.dissent) += rest - free;
    }
    sums.mover += rest - std::min(rest, 0.5F * square(f.across) + depth);
  }
  return sums;
}

MotionScore scored(const Length& length, const std::vector<Flow>& flows,
                   const std::vector<Eigen::Vector2f>& resting, bool narrow,
                   const MotionEvidenceOptions& options) {
  const Sums sums = sums_at(std::max(0.0F, length.value), flows, resting, options);
  MotionScore score;
  score.gain = sums.gain();
  score.reasons.road = sums.road;
  score.reasons.resting = sums.resting;
  score.reasons.dissent = sums.dissent;
  score.reasons.affinity = sums.growth;
  const double mover = sums.mover - options.mover_cost;
  score.reasons.one_mover = narrow && mover > 0.0;
  if (score.reasons.one_mover) score.gain -= mover;
  score.length = length.value;
  score.length_sigma = length.sigma;
  return score;
}

}  // namespace

MotionScore best_score(std::vector<Flow> flows, const std::vector<Eigen::Vector2f>& resting,
                       const MotionEvidenceOptions& options) {
  const auto slope = static_cast<float>(options.slope);
  const auto per_growth = static_cast<float>(1.0 / options.affine_sigma);
  const bool backwards = points_backwards(flows);
  for (Flow& f : flows) {
    f.along = backwards ? -f.along : f.along;
    f.road_growth *= backwards ? -per_growth : per_growth;
    f.growth *= per_growth;
  }
  const bool narrow = is_narrow(flows);
  const Length near_rest = refined(0.0F, flows, slope);
  MotionScore best = scored(near_rest, flows, resting, narrow, options);
  const float commonest = commonest_length(flows, slope);
  if (commonest > 0.0F) {
    const MotionScore score =
        scored(refined(commonest, flows, slope), flows, resting, narrow, options);
    if (score.gain > best.gain) best = score;
  }
  const float least = least_length(flows);
  if (least > near_rest.value) {
    const MotionScore score =
        scored({least, MotionPrior::kUnknown}, flows, resting, narrow, options);
    if (score.gain > best.gain) best = score;
  }
  best.backwards = backwards;
  return best;
}

}  // namespace oneac::internal
