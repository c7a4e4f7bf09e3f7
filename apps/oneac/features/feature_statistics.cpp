#include "feature_statistics.h"

#include "oneac/base/number_text.h"
#include "oneac/evaluation/statistics.h"
#include "oneac/geometry/essential.h"
#include "oneac/report/table.h"

#include <algorithm>
#include <cmath>

namespace oneac::app {
namespace {

double median(std::vector<double> values) {
  return values.empty() ? 0.0 : percentile(std::move(values), 50.0);
}

int cell(double u, int size, int cells) {
  return std::clamp(static_cast<int>(u * cells / size), 0, cells - 1);
}

std::size_t region(int row, int column) {
  constexpr auto kColumns = static_cast<std::size_t>(FeatureStatistics::kColumns);
  return static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column);
}

template <class Field>
std::vector<double> values_of(const FeatureStatistics& statistics, Field&& field) {
  std::vector<double> values;
  for (const PairFeatures& pair : statistics.pairs()) {
    values.push_back(static_cast<double>(field(pair)));
  }
  return values;
}

Table empty_table() {
  return {"", {"per pair", "median", "mean", "least", "most"}, {}};
}

void add_row(Table& table, const char* name, const std::vector<double>& values, int decimals) {
  const std::optional<Statistics> s = statistics_of(values);
  if (!s) return;
  table.rows.push_back({{name}});
  for (const double value :
       {s->median, s->mean, *std::min_element(values.begin(), values.end()), s->max}) {
    table.rows.back().push_back({fixed_text(value, decimals)});
  }
}

}  // namespace

void FeatureStatistics::add(const RunMoment& moment) {
  const FrameResult& frame = moment.record.frames.back();
  if (!frame.step) return;
  PairFeatures features;
  features.index1 = frame.step->index1;
  features.index2 = frame.step->index2;
  features.acs = moment.pair.size();
  features.standing = moment.pair.standing;
  features.decode_ms = moment.record.decode_ms.back();
  features.features_ms = frame.step->features_ms;
  std::vector<double> motions;
  for (const AffineCorrespondence& ac : moment.pair.correspondences)
    motions.push_back((ac.x2 - ac.x1).norm());
  features.motion_px = median(std::move(motions));
  follow(moment.pair, features);
  const std::vector<double> residuals = judge(moment, *frame.step);
  if (!residuals.empty()) features.affine_residual = median(residuals);
  pairs_.push_back(features);
}

void FeatureStatistics::follow(const TrackedPair& pair, PairFeatures& features) {
  std::unordered_map<std::uint64_t, std::size_t> now;
  for (const Correspondence& ac : pair.correspondences) {
    const auto known = alive_.find(ac.track);
    if (known != alive_.end()) ++features.followed;
    now[ac.track] = known != alive_.end() ? known->second + 1 : 2;  // a pair is two images
  }
  for (const auto& [track, images] : alive_) {
    if (now.count(track) == 0) ++lengths_[images];
  }
  alive_ = std::move(now);
}

void FeatureStatistics::finish() {
  for (const auto& [track, images] : alive_) ++lengths_[images];
  alive_.clear();
}

std::vector<double> FeatureStatistics::judge(const RunMoment& moment, const StepResult& step) {
  std::vector<double> residuals;
  if (step.status != StepStatus::kOk || !(step.pose.t.norm() > 0.0)) return residuals;
  const PinholeCamera& camera = moment.record.camera;
  const Eigen::Matrix3d E = essential_matrix(step.pose);
  const double bound = threshold_px_ / camera.focal_px();
  for (const AffineCorrespondence& ac_px : moment.pair.correspondences) {
    const AffineCorrespondence ac = normalise(ac_px, camera, camera);
    if (!(std::abs(sampson_distance(E, ac.x1, ac.x2)) <= bound)) continue;
    const double slope = (E.transpose() * ac.x2.homogeneous()).head<2>().norm();
    if (!(slope > 0.0)) continue;
    const double residual = affine_epipolar_residual(E, ac).norm() / slope;
    if (!std::isfinite(residual)) continue;
    residuals.push_back(residual);
    const int row = cell(ac_px.x2.y(), camera.height, kRows);
    const int column = cell(ac_px.x2.x(), camera.width, kColumns);
    residuals_[region(row, column)].push_back(residual);
  }
  return residuals;
}

const std::vector<double>& FeatureStatistics::residuals(int row, int column) const {
  return residuals_.at(region(row, column));
}

std::optional<double> FeatureStatistics::median_residual() const {
  std::vector<double> all;
  for (const auto& region : residuals_) all.insert(all.end(), region.begin(), region.end());
  if (all.empty()) return std::nullopt;
  return median(std::move(all));
}

std::string format_pairs(const FeatureStatistics& statistics) {
  std::string text =
      "index1,index2,acs,followed,standing,motion_px,affine_residual,ms_decode,ms_features\n";
  for (const PairFeatures& p : statistics.pairs()) {
    text +=
        csv_line({std::to_string(p.index1), std::to_string(p.index2), std::to_string(p.acs),
                  std::to_string(p.followed), p.standing ? "1" : "0", fixed_text(p.motion_px, 3),
                  p.affine_residual ? fixed_text(*p.affine_residual, 5) : "",
                  fixed_text(p.decode_ms, 3), fixed_text(p.features_ms, 3)});
  }
  return text;
}

std::string format_track_lengths(const FeatureStatistics& statistics) {
  std::string text = "images,tracks\n";
  for (const auto& [images, tracks] : statistics.track_lengths()) {
    text += csv_line({std::to_string(images), std::to_string(tracks)});
  }
  return text;
}

std::string format_regions(const FeatureStatistics& statistics) {
  std::string text = "row,column,count,median_affine_residual\n";
  for (int row = 0; row < FeatureStatistics::kRows; ++row) {
    for (int column = 0; column < FeatureStatistics::kColumns; ++column) {
      const std::vector<double>& residuals = statistics.residuals(row, column);
      text +=
          csv_line({std::to_string(row), std::to_string(column), std::to_string(residuals.size()),
                    residuals.empty() ? "" : fixed_text(median(residuals), 5)});
    }
  }
  return text;
}

std::string format_summary(const FeatureStatistics& statistics, const std::string& extractor) {
  std::string text = "# Affine correspondences of a drive\n\nExtractor `" + extractor + "`, " +
                     std::to_string(statistics.pairs().size()) + " pairs of images.\n\n";
  Table counts = empty_table();
  add_row(counts, "correspondences", values_of(statistics, [](const auto& p) { return p.acs; }), 0);
  add_row(counts, "on followed tracks",
          values_of(statistics, [](const auto& p) { return p.followed; }), 0);
  add_row(counts, "motion [px]", values_of(statistics, [](const auto& p) { return p.motion_px; }),
          1);
  text += table_md(counts);
  std::size_t tracks = 0, images = 0;
  for (const auto& [length, count] : statistics.track_lengths()) {
    tracks += count;
    images += length * count;
  }
  if (tracks > 0) {
    text += "\n" + std::to_string(tracks) + " tracks, seen in " +
            fixed_text(static_cast<double>(images) / static_cast<double>(tracks), 2) +
            " images on average, in " + std::to_string(statistics.track_lengths().rbegin()->first) +
            " at most.\n";
  }
  if (const auto residual = statistics.median_residual()) {
    text += "\nMedian affine residual " + fixed_text(*residual, 4) +
            " of the correspondences whose points obey the pair's pose; by region of the image in "
            "`regions.csv` and `regions.png`.\n";
  }
  Table times = empty_table();
  add_row(times, "decode [ms]", values_of(statistics, [](const auto& p) { return p.decode_ms; }),
          2);
  add_row(times, "features [ms]",
          values_of(statistics, [](const auto& p) { return p.features_ms; }), 2);
  return text + "\n## Time\n\n" + table_md(times);
}

}  // namespace oneac::app
