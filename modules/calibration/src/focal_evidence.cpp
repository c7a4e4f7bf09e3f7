#include "oneac/calibration/focal_evidence.h"

#include "oneac/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

constexpr double kContradiction = 3.0;  // [σ]

bool contradict(const FocalEvidence& a, const FocalEvidence& b) {
  return std::abs(a.log_focal - b.log_focal) > kContradiction * std::hypot(a.sigma, b.sigma);
}

/// Whether one of the others says something else: the bends, where they confirm each other, else
/// any other sensor.
bool is_contradicted(std::size_t i, const std::vector<FocalEvidence>& told,
                     const FocalEvidence* bends) {
  if (bends != nullptr) return contradict(told[i], *bends);
  return std::any_of(told.begin(), told.end(),
                     [&](const FocalEvidence& other) { return contradict(told[i], other); });
}

void widen(IntrinsicsEstimate& estimate, double apart, double most) {
  const double sigma = estimate.sigma(kFocal);
  const double wide = std::min(std::hypot(sigma, apart), std::max(sigma, most));
  if (!(sigma > 0.0)) return;
  estimate.covariance.row(kFocal) *= wide / sigma;
  estimate.covariance.col(kFocal) *= wide / sigma;
}

}  // namespace

TurnSensor usual_gyroscope() {
  return {0.1 * kDegree, 0.01, 1.0 * kDegree};
}

TurnSensor usual_course() {
  return {0.35 * kDegree, 0.0, 0.0};
}

bool JointEstimate::is_confirmed() const {
  return estimate.windows >= IntrinsicsBelief::kFewestWindows || agreeing.size() > 1;
}

JointEstimate joint_estimate(const IntrinsicsBelief& bends,
                             const std::vector<FocalEvidence>& told) {
  const IntrinsicsEstimate alone = bends.estimate();
  const FocalEvidence own{"bends", alone.change[kFocal], alone.sigma(kFocal)};
  const bool confirmed = alone.windows >= IntrinsicsBelief::kFewestWindows;
  IntrinsicsBelief all = bends;
  JointEstimate joint;
  double apart = 0.0;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (is_contradicted(i, told, confirmed ? &own : nullptr)) {
      joint.contradicting.push_back(told[i].sensor);
      apart = std::max(apart, std::abs(told[i].log_focal - own.log_focal));
    } else {
      all.add_focal(told[i].log_focal, told[i].sigma);
      joint.agreeing.push_back(told[i].sensor);
    }
  }
  joint.estimate = all.estimate();
  if (apart > 0.0) widen(joint.estimate, apart, bends.prior_sigma(kFocal));
  return joint;
}

}  // namespace oneac
