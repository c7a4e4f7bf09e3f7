// What each part of the one-AC consensus is worth: an ablation, a curve over added outliers, and
// the stages' share of the time, on the correspondences of a real drive.
//
//   oneac_bench_consensus LOG POSES [EVERY]     prints Markdown
//
// The correspondences are VLFeat's, made once; the tilt is the log's. Stress rows turn the second
// view of each pair by a random pitch and roll and take the turn out of the answer again.
#include "log_pairs.h"

#include "oneac/base/thread_clock.h"
#include "oneac/evaluation/pair_errors.h"
#include "oneac/evaluation/trajectory_io.h"
#include "oneac/geometry/homography.h"
#include "oneac/geometry/leveling.h"
#include "oneac/robust/one_ac_consensus.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace oneac;
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

struct Stress {
  double outliers = 0.0;   ///< share
  double pitch_deg = 0.0;  ///< largest turn of the second view
  double roll_deg = 0.0;
};

struct Row {
  PairSummary summary;
  double median_ms = 0.0;
  double correspondences = 0.0;  ///< median
};

Row measure(const std::vector<LogPair>& pairs, const Trajectory& truth,
            const ConsensusOptions& options, const Stress& stress) {
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
      result = one_ac_consensus(acs, pair.R_level_cam, pair.focal_px, options);
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

void print(const char* name, const Row& row) {
  const PairSummary& s = row.summary;
  std::printf("| %s | %zu of %zu | %.4f / %.4f | %.2f / %.2f | %.0f | %.2f |\n", name, s.bad,
              s.pairs, s.rotation->mean / kDegree, s.rotation->median / kDegree,
              s.direction->mean / kDegree, s.direction->median / kDegree, row.correspondences,
              row.median_ms);
  std::fflush(stdout);
}

void print_head(const char* title) {
  std::printf(
      "\n| %s | wrong basins | rotation mean / median [deg] | direction mean / median [deg] | "
      "ACs | ms |\n|---|---|---|---|---|---|\n",
      title);
}

struct Variant {
  const char* name;
  std::function<void(ConsensusOptions&)> change;
};

/// Beside the defaults every row is the whole search, of which it says what each part is worth.
const std::vector<Variant> kVariants = {
    {"defaults: first look, then the whole search", [](ConsensusOptions& o) { o.first_modes = 8; }},
    {"first look with 1 mode, then the whole search",
     [](ConsensusOptions& o) { o.first_modes = 1; }},
    {"first look, whatever it explains",
     [](ConsensusOptions& o) {
       o.first_modes = 8;
       o.settled_cost = 1.0;
     }},
    {"whole search", [](ConsensusOptions&) {}},
    {"ground only, no pitch, 1 mode",
     [](ConsensusOptions& o) {
       o.planar = false;
       o.pitch_sweep_deg = 0.0;
       o.modes = o.finalists = 1;
     }},
    {"+ side, front and general walls",
     [](ConsensusOptions& o) {
       o.planar = false;
       o.side_wall = o.front_wall = o.wall = true;
       o.pitch_sweep_deg = 0.0;
       o.modes = o.finalists = 1;
     }},
    {"ground + plane-free, no pitch, 1 mode",
     [](ConsensusOptions& o) {
       o.pitch_sweep_deg = 0.0;
       o.modes = o.finalists = 1;
     }},
    {"+ pitch sweep, 1 mode", [](ConsensusOptions& o) { o.modes = o.finalists = 1; }},
    {"+ pitch and roll sweep, 1 mode",
     [](ConsensusOptions& o) {
       o.modes = o.finalists = 1;
       o.roll_sweep_deg = 1.0;
     }},
    {"pitch sweep, 4 modes", [](ConsensusOptions& o) { o.modes = 4; }},
    {"pitch sweep, 16 modes", [](ConsensusOptions& o) { o.modes = 16; }},
    {"40 modes, no pitch sweep", [](ConsensusOptions& o) { o.pitch_sweep_deg = 0.0; }},
    {"40 modes, pitch and roll sweep", [](ConsensusOptions& o) { o.roll_sweep_deg = 1.0; }},
    {"40 modes, ground only", [](ConsensusOptions& o) { o.planar = false; }},
    {"40 modes, plane-free only", [](ConsensusOptions& o) { o.ground = false; }},
    {"40 modes, + walls", [](ConsensusOptions& o) { o.side_wall = o.front_wall = o.wall = true; }},
};

void ablation(const std::vector<LogPair>& pairs, const Trajectory& truth, const char* title,
              const Stress& stress) {
  print_head(title);
  for (const Variant& variant : kVariants) {
    ConsensusOptions options;
    options.first_modes = 0;
    variant.change(options);
    print(variant.name, measure(pairs, truth, options, stress));
  }
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: oneac_bench_consensus LOG POSES [EVERY]\n");
    return 2;
  }
  const std::size_t every = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1;
  const std::vector<LogPair> pairs = pairs_of_log(argv[1], every, "vlfeat");
  const Trajectory truth = read_trajectory(argv[2]);
  ablation(pairs, truth, "as recorded", {});
  ablation(pairs, truth, "60 % outliers, pitch to 2.5 deg, roll to 1.5 deg", {0.6, 2.5, 1.5});
  print_head("outliers");
  for (double share : {0.0, 0.2, 0.4, 0.6, 0.7, 0.8, 0.85, 0.9}) {
    char name[32];
    std::snprintf(name, sizeof name, "%.0f %% added", 100.0 * share);
    print(name, measure(pairs, truth, {}, {share, 0.0, 0.0}));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "oneac_bench_consensus: %s\n", error.what());
    return 2;
  }
}
