#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <deque>

namespace oneac {

/// Where a vehicle that goes on travels.
struct Course {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< t̂ of T_2_1; zero: not known
  double sigma = 0.0;                                   ///< [rad] 1σ of one step against it
  bool seen = false;                                    ///< by steps; else the mount tells it
};

/// Whether a step goes where wheels take a car that went along `heading`, forwards or backwards: a
/// wrong basin of two views may lie anywhere, and no length along it is one of the car.
/// @param t, heading  of T_2_1, of any length
[[nodiscard]] inline bool goes_along(const Eigen::Vector3d& t, const Eigen::Vector3d& heading) {
  constexpr double kCos45 = 0.7071;  // a front corner of a car that turns on the spot
  return std::abs(t.dot(heading)) >= kCos45 * t.norm() * heading.norm();
}

/// The same of a course that may not be known: a mount is no course.
[[nodiscard]] inline bool is_drivable(const Eigen::Vector3d& t, const Course& course) {
  return !course.seen || goes_along(t, course.direction);
}

/// Learns the direction of travel from the steps seen: steering and springs change it slowly, while
/// a wrong basin of one pair may lie anywhere.
class CourseBelief {
 public:
  /// A step's t̂ as two views told it.
  /// @param surprising  the images alone wanted one that is not drivable: many of them in a row
  ///                    had the course wrong, which begins anew
  void follow(const Eigen::Vector3d& direction, bool surprising = false);
  /// @param ahead  t̂ of a camera that travels as it is mounted, for want of steps
  [[nodiscard]] Course now(const Eigen::Vector3d& ahead) const;

 private:
  std::deque<Eigen::Vector3d> newest_;
  std::size_t surprises_ = 0;  ///< in a row
};

}  // namespace oneac
