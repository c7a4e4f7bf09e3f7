#include "stress.h"

#include "oneac/base/thread_clock.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/levelling.h"

#include <cstdint>
#include <random>
#include <utility>

namespace oneac {
namespace {

using Acs = std::vector<AffineCorrespondence>;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Uniform numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double a, double b) {
    return a + (b - a) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

/// Wrong correspondences until they make up `share`: points and affinities of different ones, in
/// random order.
Acs with_outliers(const Acs& acs, double share, Random& random) {
  if (share <= 0.0 || acs.empty()) return acs;
  Acs out = acs;
  const auto added =
      static_cast<std::size_t>(share / (1.0 - share) * static_cast<double>(acs.size()));
  for (std::size_t i = 0; i < added; ++i) {
    AffineCorrespondence wrong = acs[random.below(acs.size())];
    wrong.x2 = {random.uniform(-0.85, 0.85), random.uniform(-0.25, 0.25)};
    wrong.A = acs[random.below(acs.size())].A;
    out.push_back(wrong);
  }
  for (std::size_t i = 0; i + 1 < out.size(); ++i) {
    std::swap(out[i], out[i + random.below(out.size() - i)]);
  }
  return out;
}

}  // namespace

StressRow measure_under(const Stress& stress, const std::vector<LogPair>& pairs,
                        const Trajectory& truth, const PairEstimator& estimate) {
  Random random(1);
  std::vector<PairError> errors;
  std::vector<double> times, sizes;
  for (const LogPair& pair : pairs) {
    const auto T = true_motion(pair, truth);
    if (!T) continue;
    const Eigen::Matrix3d Q =
        roll_rotation(random.uniform(-1.0, 1.0) * stress.roll_deg * kDegree) *
        pitch_rotation(random.uniform(-1.0, 1.0) * stress.pitch_deg * kDegree);
    Acs acs;
    for (const AffineCorrespondence& ac : pair.acs) {
      const auto turned = rotate_views(ac, Eigen::Matrix3d::Identity(), Q);
      if (turned) acs.push_back(*turned);
    }
    acs = with_outliers(acs, stress.outliers, random);
    double ms = 0.0;
    RobustResult result;
    {
      const StageTimer timer(ms);
      result = estimate(acs, pair);
    }
    times.push_back(ms);
    sizes.push_back(static_cast<double>(acs.size()));
    RelativePoseRow row;
    row.index1 = pair.index1;
    row.index2 = pair.index2;
    row.T_2_1 = {Q.transpose() * result.pose.R, Q.transpose() * result.pose.t};
    errors.push_back(pair_error(row, *T));
  }
  return {summarise(errors, 0), percentile(times, 50), percentile(sizes, 50)};
}

}  // namespace oneac
