#include "oneac/base/number_text.h"
#include "oneac/comparison/tables.h"
#include "oneac/geometry/angles.h"
#include "oneac/report/table.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace oneac {
namespace {

using Number = std::optional<double>;
using Cells = std::vector<std::string>;

std::string degrees(const Number& angle) {
  return angle ? exact_text(*angle / kDegree) : "";
}

void add_pose(const MethodResult& result, Cells& cells) {
  if (!result.has_pose) {
    cells.resize(cells.size() + 7);
    return;
  }
  Eigen::Quaterniond q(result.pose.R);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const Eigen::Vector3d& t = result.pose.t;
  for (const double value : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) {
    cells.push_back(exact_text(value));
  }
}

Cells key_cells(const ComparisonData& data, const PairRecord& pair, const MethodResult& result) {
  return {name_of_log(data, pair.log), std::to_string(pair.index1), std::to_string(pair.index2),
          data.methods[result.method], std::to_string(result.trial)};
}

std::string cell(const Number& value, int digits) {
  return value ? fixed_text(*value, digits) : "";
}

}  // namespace

std::string name_of_log(const ComparisonData& data, std::size_t log) {
  const auto found = std::find_if(data.logs.begin(), data.logs.end(),
                                  [&](const LogRecord& record) { return record.log == log; });
  return found == data.logs.end() ? std::to_string(log) : found->name;
}

std::string pairs_csv(const ComparisonData& data) {
  std::string text =
      "log,index1,index2,method,trial,status,rot_err_deg,dir_err_deg,qw,qx,qy,qz,tx,ty,tz,"
      "inliers,acs,iterations,hypotheses,local_optimisations,graph_cuts\n";
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      const ResultError error = error_of(pair, result);
      Cells cells = key_cells(data, pair, result);
      cells.insert(cells.end(), {result.status, degrees(error.rotation), degrees(error.direction)});
      add_pose(result, cells);
      for (const std::size_t count :
           {result.inliers, pair.acs, result.iterations, result.hypotheses,
            result.local_optimisations, result.graph_cuts}) {
        cells.push_back(std::to_string(count));
      }
      text += csv_line(cells);
    }
  }
  return text;
}

std::string timings_csv(const ComparisonData& data) {
  std::string text = "log,index1,index2,method,trial,ms\n";
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      Cells cells = key_cells(data, pair, result);
      cells.push_back(fixed_text(result.ms, 4));
      text += csv_line(cells);
    }
  }
  return text;
}

std::string summary_csv(const std::vector<MethodSummary>& rows) {
  std::string text =
      "log,method,estimates,judged,no_pose,failures,rot_mean_deg,rot_median_deg,rot_p95_deg,"
      "dir_mean_deg,dir_median_deg,dir_p95_deg,auc_1deg,auc_5deg,auc_10deg,iterations_mean,"
      "inlier_share_mean,ms_mean,ms_median,ms_p95\n";
  for (const MethodSummary& row : rows) {
    Cells cells = {row.log, row.method};
    for (const std::size_t count : {row.estimates, row.judged, row.no_pose, row.failures}) {
      cells.push_back(std::to_string(count));
    }
    for (const Number& value :
         {row.rotation_mean_deg, row.rotation_median_deg, row.rotation_p95_deg,
          row.direction_mean_deg, row.direction_median_deg, row.direction_p95_deg, row.auc[0],
          row.auc[1], row.auc[2]}) {
      cells.push_back(cell(value, 6));
    }
    cells.insert(cells.end(), {cell(row.iterations_mean, 2), cell(row.inlier_share_mean, 4)});
    for (const Number& value : {row.ms_mean, row.ms_median, row.ms_p95}) {
      cells.push_back(cell(value, 4));
    }
    text += csv_line(cells);
  }
  return text;
}

}  // namespace oneac
