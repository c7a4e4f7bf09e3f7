#include "text.h"

#include "oneac/comparison/tables.h"
#include "oneac/geometry/angles.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace oneac {
namespace {

using internal::decimals;
using internal::shortest;
using Number = std::optional<double>;

std::string name_of_log(const ComparisonData& data, std::size_t log) {
  const auto found = std::find_if(data.logs.begin(), data.logs.end(),
                                  [&](const LogRecord& record) { return record.log == log; });
  return found == data.logs.end() ? std::to_string(log) : found->name;
}

std::string degrees(const Number& angle) {
  return angle ? shortest(*angle / kDegree) : "";
}

std::string pose_cells(const MethodResult& result) {
  if (!result.has_pose) return ",,,,,,";
  Eigen::Quaterniond q(result.pose.R);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const Eigen::Vector3d& t = result.pose.t;
  std::string cells = shortest(q.w());
  for (const double value : {q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) {
    cells += "," + shortest(value);
  }
  return cells;
}

std::string key_cells(const ComparisonData& data, const PairRecord& pair,
                      const MethodResult& result) {
  return name_of_log(data, pair.log) + "," + std::to_string(pair.index1) + "," +
         std::to_string(pair.index2) + "," + data.methods[result.method] + "," +
         std::to_string(result.trial);
}

std::string cell(const Number& value, int digits) {
  return value ? decimals(*value, digits) : "";
}

}  // namespace

std::string pairs_csv(const ComparisonData& data) {
  std::string text =
      "log,index1,index2,method,trial,status,rot_err_deg,dir_err_deg,qw,qx,qy,qz,tx,ty,tz,"
      "inliers,acs,iterations,hypotheses,local_optimisations,graph_cuts\n";
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      const ResultError error = error_of(pair, result);
      text += key_cells(data, pair, result) + "," + result.status + "," + degrees(error.rotation) +
              "," + degrees(error.direction) + "," + pose_cells(result);
      for (const std::size_t count :
           {result.inliers, pair.acs, result.iterations, result.hypotheses,
            result.local_optimisations, result.graph_cuts}) {
        text += "," + std::to_string(count);
      }
      text += "\n";
    }
  }
  return text;
}

std::string timings_csv(const ComparisonData& data) {
  std::string text = "log,index1,index2,method,trial,ms\n";
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      text += key_cells(data, pair, result) + "," + decimals(result.ms, 4) + "\n";
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
    text += row.log + "," + row.method;
    for (const std::size_t count : {row.estimates, row.judged, row.no_pose, row.failures}) {
      text += "," + std::to_string(count);
    }
    for (const Number& value :
         {row.rotation_mean_deg, row.rotation_median_deg, row.rotation_p95_deg,
          row.direction_mean_deg, row.direction_median_deg, row.direction_p95_deg, row.auc[0],
          row.auc[1], row.auc[2]}) {
      text += "," + cell(value, 6);
    }
    text += "," + cell(row.iterations_mean, 2) + "," + cell(row.inlier_share_mean, 4);
    for (const Number& value : {row.ms_mean, row.ms_median, row.ms_p95}) {
      text += "," + cell(value, 4);
    }
    text += "\n";
  }
  return text;
}

}  // namespace oneac
