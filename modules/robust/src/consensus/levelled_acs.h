#pragma once

#include "consensus/consensus_kernels.h"

#include "oneac/solvers/batch.h"
#include "oneac/solvers/span.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace oneac::internal {

/// Which correspondences one step of the search looks at: first, first + stride, …
struct Stride {
  std::size_t first = 0;
  std::size_t step = 1;
};

/// Correspondences with the camera's tilt removed, as arrays, and a share of them with the second
/// view turned once more: what one relative pitch and roll of the search looks at.
class LevelledAcs {
 public:
  /// Correspondences that the levelling turns behind the camera are left out.
  LevelledAcs(AcSpan acs, const Eigen::Matrix3d& R_level_cam);

  /// All of them.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Turns the second view of a share by Q from the levelled one; the share before is forgotten.
  void turn_second_view(const Eigen::Matrix3d& Q, const Stride& share);
  /// The share; borrowed.
  [[nodiscard]] AcArrays arrays() const;
  [[nodiscard]] AffineCorrespondence at(std::size_t i) const;

  /// About `count` point pairs of all, evenly spaced, the second view turned by Q; borrowed.
  [[nodiscard]] PointArrays<float> sample(std::size_t count, const Eigen::Matrix3d& Q);

 private:
  enum Entry { kX1, kY1, kX2, kY2, kA11, kA12, kA21, kA22 };

  std::size_t size_ = 0;
  std::array<std::vector<double>, 8> level_;   ///< tilt removed from both views
  std::array<std::vector<double>, 8> turned_;  ///< the share
  std::array<std::vector<float>, 5> sample_;
};

}  // namespace oneac::internal
