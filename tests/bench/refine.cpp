// What affine terms add to the two-view refinement, by the number of inliers a pair has: each pair
// of a real drive is refined from the same start with points alone and with affinities beside them.
//
//   oneac_bench_refine LOG POSES [EVERY [FEATURES]]     prints Markdown
//
// Fewer inliers: every k-th of a pair's, up to kPhases of the k ways to do that, whose errors are
// averaged before pairs are compared.
#include "bench_main.h"
#include "log_pairs.h"

#include "oneac/base/thread_clock.h"
#include "oneac/evaluation/pair_errors.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/refine/two_view.h"
#include "oneac/robust/one_ac_consensus.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace oneac;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::size_t kPhases = 12;
const std::vector<std::size_t> kThinning = {1, 5, 10, 20, 40};

/// A pair with the start of its refinement and what is true.
struct Start {
  const LogPair* pair;
  RelativePose pose;
  std::vector<bool> inliers;
  RelativePose truth;
};

std::vector<Start> starts_of(const std::vector<LogPair>& pairs, const Trajectory& truth) {
  std::vector<Start> starts;
  for (const LogPair& pair : pairs) {
    const auto T = true_motion(pair, truth);
    if (!T || !(T->t.norm() > kSmallestTrueStep)) continue;
    RobustResult found = one_ac_consensus(pair.acs, pair.R_level_cam, pair.focal_px, {});
    if (!has_direction(found.status)) continue;
    starts.push_back({&pair, found.pose, std::move(found.inliers), *T});
  }
  return starts;
}

/// Mean over the pairs and its standard error.
struct Mean {
  double value = 0.0, error = 0.0;
};

Mean mean_of(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1.0)))};
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  std::transform(a.begin(), a.end(), b.begin(), out.begin(), std::minus<>());
  return out;
}

/// Every k-th inlier, beginning with number `phase`.
std::vector<bool> thinned(const std::vector<bool>& inliers, std::size_t k, std::size_t phase) {
  std::vector<bool> kept(inliers.size(), false);
  std::size_t number = 0;
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    if (inliers[i]) kept[i] = number++ % k == phase;
  }
  return kept;
}

/// One value per pair.
struct Errors {
  std::vector<double> rotation_deg, direction_deg;
  double inliers = 0.0;  ///< mean
  double ms = 0.0;       ///< mean of a refinement
};

/// Errors of one pair, averaged over the phases.
void refine_phases(const Start& start, std::size_t k, const RefineOptions& options, Errors& sum) {
  const std::size_t phases = std::min(k, kPhases);
  double rotation = 0.0, direction = 0.0;
  for (std::size_t n = 0; n < phases; ++n) {
    const std::vector<bool> inliers = thinned(start.inliers, k, n * k / phases);
    RelativePoseRow row;
    double ms = 0.0;
    {
      const StageTimer timer(ms);
      row.T_2_1 =
          refine_two_view(start.pair->acs, inliers, start.pose, start.pair->focal_px, options).pose;
    }
    const PairError error = pair_error(row, start.truth);
    const double share = 1.0 / static_cast<double>(phases);
    rotation += share * error.rotation / kDegree;
    direction += share * error.direction.value_or(0.0) / kDegree;
    sum.ms += share * ms;
    sum.inliers += share * static_cast<double>(std::count(inliers.begin(), inliers.end(), true));
  }
  sum.rotation_deg.push_back(rotation);
  sum.direction_deg.push_back(direction);
}

Errors refine(const std::vector<Start>& starts, std::size_t k, bool affine_terms) {
  RefineOptions options;
  options.affine_terms_below = affine_terms ? std::numeric_limits<int>::max() : 0;
  Errors errors;
  for (const Start& start : starts) refine_phases(start, k, options, errors);
  errors.ms /= static_cast<double>(starts.size());
  errors.inliers /= static_cast<double>(starts.size());
  return errors;
}

void print_row(const Errors& points, const Errors& both) {
  const Mean rotation = mean_of(difference(both.rotation_deg, points.rotation_deg));
  const Mean direction = mean_of(difference(both.direction_deg, points.direction_deg));
  std::printf("| %.0f | %.4f / %.3f | %+.4f ± %.4f | %+.4f ± %.4f | %.2f | %.2f |\n",
              points.inliers, mean_of(points.rotation_deg).value,
              mean_of(points.direction_deg).value, rotation.value, rotation.error, direction.value,
              direction.error, points.ms, both.ms);
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: oneac_bench_refine LOG POSES [EVERY [FEATURES]]\n");
    return 2;
  }
  const std::size_t every = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1;
  const std::string features = argc > 4 ? argv[4] : "klt";
  const std::vector<LogPair> pairs = pairs_of_log(argv[1], every, features);
  const std::vector<Start> starts = starts_of(pairs, read_trajectory(argv[2]));
  if (starts.size() < 2) throw std::runtime_error("fewer than two pairs with a true motion");
  std::printf(
      "%s, every %zu: %zu pairs\n\n| inliers a pair | points: rot / t [deg] | affine terms change "
      "rot | affine terms change t | points [ms] | both [ms] |\n|---|---|---|---|---|---|\n",
      features.c_str(), every, starts.size());
  for (const std::size_t k : kThinning) {
    print_row(refine(starts, k, false), refine(starts, k, true));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return oneac::guarded("oneac_bench_refine", &run, argc, argv);
}
