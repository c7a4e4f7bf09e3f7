#pragma once

#include <Eigen/Core>

#include <deque>

namespace oneac {

/// Where a vehicle that goes on travels.
struct Course {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< t̂ of T_2_1; zero: not known
  double sigma = 0.0;                                   ///< [rad] 1σ of one step against it
};

/// Learns the direction of travel from the steps seen: steering and springs change it slowly, while
/// a wrong basin of one pair may lie anywhere.
class CourseBelief {
 public:
  /// A step's t̂ as two views told it.
  void follow(const Eigen::Vector3d& direction);
  /// @param ahead  t̂ of a camera that travels as it is mounted, for want of steps
  [[nodiscard]] Course now(const Eigen::Vector3d& ahead) const;

 private:
  std::deque<Eigen::Vector3d> newest_;
};

}  // namespace oneac
