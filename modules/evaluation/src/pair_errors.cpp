#include "oneac/evaluation/pair_errors.h"

#include "oneac/geometry/angular_errors.h"

#include <algorithm>
#include <cmath>

namespace oneac {

bool PairError::is_bad() const {
  return direction && (rotation > kBadRotation || *direction > kBadDirection);
}

PairError pair_error(const RelativePoseRow& row, const RelativePose& truth) {
  PairError error;
  error.index1 = row.index1;
  error.index2 = row.index2;
  error.true_step = truth.t.norm();
  error.rotation = rotation_error(row.T_2_1.R, truth.R);
  const double step = row.T_2_1.t.norm();
  if (!error.is_moving() || !(step > 0.0)) return error;
  error.direction = direction_error(row.T_2_1.t, truth.t);
  if (row.metric) error.length = step / error.true_step - 1.0;
  return error;
}

PairSummary summarise(const std::vector<PairError>& errors, std::size_t without_reference) {
  std::vector<double> rotation, direction, length;
  PairSummary summary;
  summary.pairs = errors.size();
  summary.without_reference = without_reference;
  for (const PairError& error : errors) {
    rotation.push_back(error.rotation);
    if (error.direction) direction.push_back(*error.direction);
    if (error.length) length.push_back(std::abs(*error.length));
    summary.moving += error.is_moving() ? 1 : 0;
    summary.bad += error.is_bad() ? 1 : 0;
  }
  summary.metric = length.size();
  summary.rotation = statistics_of(rotation);
  summary.direction = statistics_of(direction);
  summary.length = statistics_of(length);
  return summary;
}

}  // namespace oneac
