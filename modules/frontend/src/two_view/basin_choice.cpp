#include "basin_choice.h"

#include "oneac/geometry/angular_errors.h"
#include "oneac/geometry/essential.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace oneac {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kSurprising = 2.0;  // [σ] nearer to the course there is one basin
// [rad] A direction farther from it is that of a car in reverse: t and −t
// have the same cost.
constexpr double kFarthest = 2.1;
// −log of how seldom a car leaves its course at once: a kerb, a skid; one step in three thousand.
constexpr double kMostSurprise = 8.0;
// And of a direction that no wheels take, whatever the number of points that want it.
constexpr double kImpossible = 1e9;

/// A pose with its negative log-likelihood.
struct Basin {
  RelativePose pose;
  Matrix6 covariance = Matrix6::Zero();
  Matrix6 shared_covariance = Matrix6::Zero();
  double cost = 0.0;
};

double surprise(const Eigen::Vector3d& t, const Course& course) {
  if (!is_drivable(t, course)) return kImpossible;
  const double off = direction_error(t, course.direction) / course.sigma;
  return std::min(0.5 * off * off, kMostSurprise);
}

Basin basin_of(const RefineResult& result, double surprise) {
  return {result.pose, covariance_beside(result.information, result.pose.t),
          result.shared_covariance, result.final_cost + surprise};
}

/// Whether the images alone are sure of another way. A handful of points in the dark is not.
bool contradicts(const Basin& free, const Course& course) {
  constexpr double kSure = 5.0;  // [σ] far from the minimum, where σ is no more than a guess
  const double variance = free.covariance.bottomRightCorner<3, 3>().trace();
  const double off = direction_error(free.pose.t, course.direction);
  return variance > 0.0 && off > kSure * std::sqrt(variance);
}

/// From one pose to another, as covariances count it: (w, v).
Vector6 difference(const RelativePose& from, const RelativePose& to) {
  const Eigen::AngleAxisd turn(to.R * from.R.transpose());
  Vector6 d;
  d << turn.angle() * turn.axis(), to.t.normalized() - from.t.normalized();
  // Directions have no component along themselves.
  const Eigen::Vector3d along = from.t.normalized();
  d.tail<3>() -= along * along.dot(d.tail<3>());
  return d;
}

std::vector<bool> inliers_of(const std::vector<AffineCorrespondence>& acs,
                             const std::vector<bool>& told, const RelativePose& pose,
                             double threshold) {
  const Eigen::Matrix3d E = essential_matrix(pose);
  std::vector<bool> inliers(acs.size());
  for (std::size_t i = 0; i < acs.size(); ++i) {
    inliers[i] = told[i] && std::abs(sampson_distance(E, acs[i].x1, acs[i].x2)) <= threshold;
  }
  return inliers;
}

TwoView moved_to(const Basin& basin, TwoView found, const std::vector<AffineCorrespondence>& acs,
                 const std::vector<bool>& told, double threshold_px) {
  found.pose = basin.pose;
  found.covariance = basin.covariance;
  found.shared_covariance = basin.shared_covariance;
  found.set_inliers(inliers_of(acs, told, basin.pose, threshold_px / found.focal_px));
  return found;
}

/// The likelier of two, with the covariance of their mixture. @param there  on the course
TwoView of_two(const Basin& here, const Basin& there, TwoView found,
               const std::vector<AffineCorrespondence>& acs, const std::vector<bool>& told,
               double threshold_px) {
  const double for_course = 1.0 / (1.0 + std::exp(there.cost - here.cost));
  const bool moves = for_course > 0.5;
  if (moves) found = moved_to(there, std::move(found), acs, told, threshold_px);
  const Vector6 d = difference(found.pose, moves ? here.pose : there.pose);
  const double unlikelier = std::min(for_course, 1.0 - for_course);
  if (!found.covariance.isZero(0.0)) found.covariance += unlikelier * d * d.transpose();
  return found;
}

}  // namespace

TwoView in_likelier_basin(TwoView found, const std::vector<bool>& told, const Course& course,
                          const RefineOptions& refine, double threshold_px) {
  if (found.status != StepStatus::kOk || !(course.sigma > 0.0)) return found;
  const double off = direction_error(found.pose.t, course.direction);
  const bool as_usual = off < kSurprising * course.sigma || off > kFarthest;
  if (as_usual && is_drivable(found.pose.t, course)) return found;
  const std::vector<AffineCorrespondence> acs = affine_parts(found.pair);
  const std::vector<double> sigmas = point_sigmas(found.pair);
  const RefineResult here =
      refine_two_view(acs, told, found.pose, found.focal_px, refine, {{}, sigmas});
  const RefineResult there =
      refine_two_view(acs, told, {found.pose.R, course.direction}, found.focal_px, refine,
                      {{course.direction, course.sigma}, sigmas});
  if (!here.usable() || !there.usable()) return found;
  const Basin free = basin_of(here, surprise(here.pose.t, course));
  found.kept_on_course = !is_drivable(here.pose.t, course);
  found.doubts_course = found.kept_on_course && contradicts(free, course);
  return of_two(free, basin_of(there, 0.0), std::move(found), acs, told, threshold_px);
}

}  // namespace oneac
