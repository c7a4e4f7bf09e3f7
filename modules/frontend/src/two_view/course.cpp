#include "course.h"

#include "oneac/base/median.h"

#include <cstddef>
#include <vector>

namespace oneac {
namespace {

constexpr std::size_t kSteps = 9;   // a second or less, in which a car turns little
constexpr std::size_t kFewest = 3;  // of which one may be wrong
// Surprises after which it is the course that was wrong: more than it was learned from.
constexpr std::size_t kPatience = 10;
// [rad] 1σ of a step against those before: springs, steering.
constexpr double kSteady = 0.05;
// [rad] 1σ against the mount: cameras are set by eye.
constexpr double kMounted = 0.15;

}  // namespace

void CourseBelief::follow(const Eigen::Vector3d& direction, bool surprising) {
  if (!direction.allFinite()) return;
  surprises_ = surprising ? surprises_ + 1 : 0;
  if (surprises_ > kPatience) *this = {};
  newest_.push_back(direction);
  if (newest_.size() > kSteps) newest_.pop_front();
}

Course CourseBelief::now(const Eigen::Vector3d& ahead) const {
  if (newest_.size() < kFewest) return {ahead, kMounted};
  Eigen::Vector3d middle;
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<double> component;
    for (const Eigen::Vector3d& direction : newest_) component.push_back(direction[k]);
    middle[k] = upper_median(std::move(component));
  }
  if (!(middle.norm() > 0.5)) return {};  // they contradict each other
  return {middle.normalized(), kSteady, true};
}

}  // namespace oneac
