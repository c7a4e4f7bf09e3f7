#include "length_votes.h"

#include "oneac/geometry/robust_loss.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// Relative 1σ of a depth at best. The formal one of a near point seen by eight keyframes is a
// tenth of it; a handful of those, slipped along an edge or on traffic, would outvote all others.
constexpr double kSurestDepth = 0.02;
constexpr int kIterations = 5;  // of the weights; they settle after three
constexpr double kCut = 4.0;    // (2σ)², scale of the robust weight

bool shorter(const LengthVote& a, const LengthVote& b) {
  return a.length < b.length || (a.length == b.length && a.point_sigma < b.point_sigma);
}

/// The length at which half of the weight is reached, weights for a true length of `assumed`.
double weighted_median(std::vector<LengthVote>& votes, double assumed) {
  std::sort(votes.begin(), votes.end(), shorter);
  const auto weight = [=](const LengthVote& vote) {
    const double sigma = vote.sigma(assumed);
    return 1.0 / (sigma * sigma);
  };
  double total = 0.0;
  for (const LengthVote& vote : votes) total += weight(vote);
  double sum = 0.0;
  for (const LengthVote& vote : votes) {
    sum += weight(vote);
    if (sum >= 0.5 * total) return vote.length;
  }
  return votes.back().length;
}

}  // namespace

std::optional<LengthVote> length_vote(const RelativePose& unit_step, const Eigen::Vector3d& X,
                                      const Eigen::Vector2d& x, double depth_sigma, double sigma) {
  if (!(X.z() > 0.0)) return std::nullopt;
  const Eigen::Vector3d p = unit_step.R * X;
  const Eigen::Vector2d a = p.head<2>() - x * p.z();
  const Eigen::Vector2d b = unit_step.t.head<2>() - x * unit_step.t.z();
  const double slope = b.norm();
  if (!(slope > 0.0) || !(p.z() > 0.0)) return std::nullopt;
  const double length = -a.dot(b) / (slope * slope);
  const double from_points = std::sqrt(2.0) * sigma * p.z() / slope;
  return LengthVote{length, from_points, depth_sigma, -p.z() / (slope * slope) * b};
}

double LengthVote::sigma(double true_length) const {
  return std::hypot(point_sigma, std::max(depth_sigma, kSurestDepth) * true_length);
}

RobustMean robust_mean(std::vector<LengthVote> votes) {
  RobustMean mean;
  const auto middle = votes.begin() + static_cast<std::ptrdiff_t>(votes.size() / 2);
  std::nth_element(votes.begin(), middle, votes.end(), shorter);
  mean.value = weighted_median(votes, middle->length);
  double variance = 0.0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    double weights = 0.0, sum = 0.0, chi2 = 0.0;
    mean.support = 0;
    mean.lever.setZero();
    mean.depth_sigma = 0.0;
    for (const LengthVote& vote : votes) {
      const double sigma = vote.sigma(mean.value);
      const double z = (vote.length - mean.value) / sigma;
      const double robust = 1.0 / geman_mcclure_divisor(z * z, kCut);
      const double weight = robust / (sigma * sigma);
      weights += weight;
      sum += weight * vote.length;
      mean.lever += weight * vote.lever;
      mean.depth_sigma += weight * vote.depth_sigma;
      chi2 += robust * z * z;
      if (z * z < kCut) ++mean.support;
    }
    mean.value = sum / weights;
    mean.lever /= weights;
    mean.depth_sigma /= weights;
    variance =
        std::max(chi2 / std::max<double>(1.0, static_cast<double>(mean.support)), 0.1) / weights;
  }
  mean.relative_sigma = std::sqrt(variance) / std::max(std::abs(mean.value), 1e-12);
  return mean;
}

}  // namespace oneac
