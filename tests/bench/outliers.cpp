// How estimators bear wrong correspondences: time and wrong basins over their share, on a real
// drive.
//
//   oneac_bench_outliers LOG POSES EVERY [FIGURE.svg]     prints Markdown, draws the times
//
// The correspondences are VLFeat's, made once; the tilt is the log's. One seed, the same wrong
// correspondences for every estimator.
#include "bench_main.h"
#include "stress.h"

#include "oneac/base/atomic_file.h"
#include "oneac/report/plot.h"
#include "oneac/robust/gc_ransac.h"
#include "oneac/robust/one_ac_consensus.h"
#include "oneac/solvers/registry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace oneac;

const std::vector<double> kShares = {0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9};

struct Contestant {
  std::string name;
  bool drawn;  ///< in the figure
  PairEstimator estimate;
};

Contestant in_gc_ransac(const char* name, bool drawn) {
  const Solver& solver = solver_named(name);
  return {std::string(solver.label), drawn, [&solver](AcSpan acs, const LogPair& pair) {
            return gc_ransac(acs, pair.R_level_cam, pair.focal_px, solver, 1, {});
          }};
}

std::vector<Contestant> contestants() {
  return {{"1AC consensus", true,
           [](AcSpan acs, const LogPair& pair) {
             return one_ac_consensus(acs, pair.R_level_cam, pair.focal_px, {});
           }},
          in_gc_ransac("relpose_1ac_ground", true),
          in_gc_ransac("relpose_1ac_wall", false),
          in_gc_ransac("relpose_2pc_ground", false),
          in_gc_ransac("relpose_3pc_vertical", false),
          in_gc_ransac("essential_5pc", true),
          in_gc_ransac("essential_8pc", true)};
}

void draw(const std::string& path, std::vector<PlotSeries> series) {
  Plot plot;
  plot.from_zero = true;
  plot.title = "Time of an estimate";
  plot.subtitle = "KITTI 03, VLFeat, median over the pairs; 1AC ground, 5PC, 8PC in GC-RANSAC";
  plot.x_label = "wrong correspondences [%]";
  plot.y_label = "time [log10 of µs]";
  for (PlotSeries& curve : series) {
    curve.pen = Pen::kMarkers;
    for (const double share : kShares) curve.x.push_back(100.0 * share);
  }
  plot.series = std::move(series);
  write_file_atomically(path, plot_document(plot));
}

int run(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: oneac_bench_outliers LOG POSES EVERY [FIGURE.svg]\n");
    return 2;
  }
  const std::size_t every = std::strtoul(argv[3], nullptr, 10);
  const std::vector<LogPair> pairs = pairs_of_log(argv[1], every, "vlfeat");
  const Trajectory truth = read_trajectory(argv[2]);
  std::vector<PlotSeries> curves;
  std::printf("| ms (wrong basins of %zu) |", pairs.size());
  for (const double share : kShares) std::printf(" %.0f %% |", 100.0 * share);
  std::printf("\n|---|");
  for (std::size_t i = 0; i < kShares.size(); ++i) std::printf("---|");
  for (const Contestant& contestant : contestants()) {
    PlotSeries curve;
    curve.label = contestant.name;
    std::printf("\n| %s |", contestant.name.c_str());
    for (const double share : kShares) {
      const StressRow row = measure_under({share, 0.0, 0.0}, pairs, truth, contestant.estimate);
      std::printf(" %.2f (%zu) |", row.median_ms, row.summary.bad);
      std::fflush(stdout);
      curve.y.push_back(std::max(0.0, std::log10(1e3 * row.median_ms)));
    }
    if (contestant.drawn) curves.push_back(curve);
  }
  std::printf("\n");
  if (argc > 4) draw(argv[4], curves);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return oneac::guarded("oneac_bench_outliers", &run, argc, argv);
}
