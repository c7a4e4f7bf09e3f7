#include "oneac/comparison/summary.h"

#include "oneac/evaluation/pair_errors.h"
#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oneac {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Number = std::optional<double>;

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void take_statistics(const std::vector<double>& values, double unit, Number& mean, Number& median,
                     Number& p95) {
  const auto s = statistics_of(values);
  if (!s) return;
  mean = s->mean / unit;
  median = s->median / unit;
  p95 = s->p95 / unit;
}

/// The estimates of one method on one log.
struct Collected {
  std::vector<double> rotation, direction, pose, iterations, inlier_share, ms;
};

void collect(const PairRecord& pair, const MethodResult& result, Collected& values,
             MethodSummary& row) {
  const ResultError error = error_of(pair, result);
  ++row.estimates;
  row.judged += pair.truth ? 1 : 0;
  row.no_pose += result.has_pose ? 0 : 1;
  row.failures += error.failed ? 1 : 0;
  if (error.rotation) values.rotation.push_back(*error.rotation);
  if (error.direction) values.direction.push_back(*error.direction);
  if (error.pose) values.pose.push_back(*error.pose);
  // Methods of other libraries may not say how many they took.
  if (result.iterations > 0) values.iterations.push_back(static_cast<double>(result.iterations));
  values.ms.push_back(result.ms);
  if (pair.acs > 0) {
    values.inlier_share.push_back(static_cast<double>(result.inliers) /
                                  static_cast<double>(pair.acs));
  }
}

MethodSummary summarise(const ComparisonData& data, const LogRecord& log, std::size_t method) {
  MethodSummary row;
  row.log = log.name;
  row.method = data.methods[method];
  Collected values;
  for (const PairRecord& pair : data.pairs) {
    if (pair.log != log.log) continue;
    for (const MethodResult& result : pair.results) {
      if (result.method == method) collect(pair, result, values, row);
    }
  }
  take_statistics(values.rotation, kDegree, row.rotation_mean_deg, row.rotation_median_deg,
                  row.rotation_p95_deg);
  take_statistics(values.direction, kDegree, row.direction_mean_deg, row.direction_median_deg,
                  row.direction_p95_deg);
  take_statistics(values.ms, 1.0, row.ms_mean, row.ms_median, row.ms_p95);
  for (std::size_t i = 0; i < kAucBounds_deg.size(); ++i) {
    row.auc[i] = area_under_recall(values.pose, kAucBounds_deg[i] * kDegree);
  }
  if (!values.iterations.empty()) row.iterations_mean = mean_of(values.iterations);
  if (!values.inlier_share.empty()) row.inlier_share_mean = mean_of(values.inlier_share);
  return row;
}

/// Mean over the rows that have a value.
template <class Get>
Number average(const std::vector<const MethodSummary*>& rows, Get&& get) {
  std::vector<double> values;
  for (const MethodSummary* row : rows) {
    if (const Number value = get(*row)) values.push_back(*value);
  }
  return values.empty() ? Number() : Number(mean_of(values));
}

MethodSummary average_of(const std::vector<const MethodSummary*>& rows) {
  MethodSummary all;
  all.log = "average";
  all.method = rows.front()->method;
  for (const MethodSummary* row : rows) {
    all.estimates += row->estimates;
    all.judged += row->judged;
    all.no_pose += row->no_pose;
    all.failures += row->failures;
  }
  for (const auto field :
       {&MethodSummary::rotation_mean_deg, &MethodSummary::rotation_median_deg,
        &MethodSummary::rotation_p95_deg, &MethodSummary::direction_mean_deg,
        &MethodSummary::direction_median_deg, &MethodSummary::direction_p95_deg,
        &MethodSummary::iterations_mean, &MethodSummary::inlier_share_mean, &MethodSummary::ms_mean,
        &MethodSummary::ms_median, &MethodSummary::ms_p95}) {
    all.*field = average(rows, [&](const MethodSummary& row) { return row.*field; });
  }
  for (std::size_t i = 0; i < all.auc.size(); ++i) {
    all.auc[i] = average(rows, [&](const MethodSummary& row) { return row.auc[i]; });
  }
  return all;
}

}  // namespace

ResultError error_of(const PairRecord& pair, const MethodResult& result) {
  ResultError error;
  error.failed = !result.has_pose;
  if (!pair.truth) return error;
  error.pose = kInfinite;
  if (!result.has_pose) return error;
  RelativePoseRow row;
  row.T_2_1 = result.pose;
  const PairError judged = pair_error(row, *pair.truth);
  error.rotation = judged.rotation;
  error.direction = judged.direction;
  error.failed = judged.is_bad();
  if (!judged.is_moving()) {
    error.pose = judged.rotation;
  } else if (judged.direction) {
    error.pose = std::max(judged.rotation, *judged.direction);
  }
  return error;
}

std::optional<double> area_under_recall(const std::vector<double>& errors, double bound) {
  if (errors.empty()) return std::nullopt;
  // Recall rises by 1/n at each error; below the bound each contributes its distance to it.
  double area = 0.0;
  for (const double error : errors) area += error < bound ? 1.0 - error / bound : 0.0;
  return area / static_cast<double>(errors.size());
}

std::vector<MethodSummary> summarise(const ComparisonData& data) {
  std::vector<MethodSummary> rows;
  for (const LogRecord& log : data.logs) {
    const bool any = std::any_of(data.pairs.begin(), data.pairs.end(),
                                 [&](const PairRecord& pair) { return pair.log == log.log; });
    if (!any) continue;
    for (std::size_t m = 0; m < data.methods.size(); ++m) rows.push_back(summarise(data, log, m));
  }
  const std::size_t logs = data.methods.empty() ? 0 : rows.size() / data.methods.size();
  if (logs < 2) return rows;
  std::vector<MethodSummary> averages;
  for (std::size_t m = 0; m < data.methods.size(); ++m) {
    std::vector<const MethodSummary*> of_method;
    for (std::size_t log = 0; log < logs; ++log) {
      of_method.push_back(&rows[log * data.methods.size() + m]);
    }
    averages.push_back(average_of(of_method));
  }
  rows.insert(rows.end(), averages.begin(), averages.end());
  return rows;
}

}  // namespace oneac
