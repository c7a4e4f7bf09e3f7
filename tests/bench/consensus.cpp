// What each part of the one-AC consensus is worth: an ablation on the correspondences of a real
// drive.
//
//   oneac_bench_consensus LOG POSES [EVERY]     prints Markdown
//
// The correspondences are VLFeat's, made once; the tilt is the log's.
#include "bench_main.h"
#include "stress.h"

#include "oneac/robust/one_ac_consensus.h"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

namespace {

using namespace oneac;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

void print(const char* name, const StressRow& row) {
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
       o.pool["planar"] = false;
       o.pitch_sweep_deg = 0.0;
       o.modes = o.finalists = 1;
     }},
    {"+ side, front and general walls",
     [](ConsensusOptions& o) {
       o.pool["planar"] = false;
       o.pool["side_wall"] = o.pool["front_wall"] = o.pool["wall"] = true;
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
    {"40 modes, ground only", [](ConsensusOptions& o) { o.pool["planar"] = false; }},
    {"40 modes, plane-free only", [](ConsensusOptions& o) { o.pool["ground"] = false; }},
    {"40 modes, + walls",
     [](ConsensusOptions& o) {
       o.pool["side_wall"] = o.pool["front_wall"] = o.pool["wall"] = true;
     }},
};

void ablation(const std::vector<LogPair>& pairs, const Trajectory& truth, const char* title,
              const Stress& stress) {
  print_head(title);
  for (const Variant& variant : kVariants) {
    ConsensusOptions options;
    options.first_modes = 0;
    variant.change(options);
    const auto estimate = [&](AcSpan acs, const LogPair& pair) {
      return one_ac_consensus(acs, pair.R_level_cam, pair.focal_px, options);
    };
    print(variant.name, measure_under(stress, pairs, truth, estimate));
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
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return oneac::guarded("oneac_bench_consensus", &run, argc, argv);
}
