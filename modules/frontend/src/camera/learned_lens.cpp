#include "camera/learned_lens.h"

#include <Eigen/LU>

#include <utility>

namespace oneac {

TrackedPair LearnedLens::corrected(TrackedPair pair) const {
  Eigen::Matrix2d J1, J2;
  for (Correspondence& ac : pair.correspondences) {
    ac.x1 = direction(ac.x1, J1);
    ac.x2 = direction(ac.x2, J2);
    ac.A = J2 * ac.A * J1.inverse();
  }
  return pair;
}

Eigen::Vector2d LearnedLens::direction(const Eigen::Vector2d& x, Eigen::Matrix2d& J) const {
  const Eigen::Vector2d given = to_given_(x);
  J = lens_.derivative(given) * to_given_.derivative(x);
  return lens_(given);
}

}  // namespace oneac
