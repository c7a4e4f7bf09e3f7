#include "oneac/robust/hypotheses.h"

#include "oneac/geometry/homography.h"
#include "oneac/solvers/relpose_1ac_ground.h"
#include "oneac/solvers/relpose_1ac_planar.h"

#include <cmath>

namespace oneac {

std::vector<double> pitch_sweep(double range, double step) {
  std::vector<double> pitches{0.0};
  if (!(step > 0.0)) return pitches;
  const int count = static_cast<int>(std::floor(range / step + 1e-9));
  for (int i = 1; i <= count; ++i) {
    pitches.push_back(i * step);
    pitches.push_back(-i * step);
  }
  return pitches;
}

void planar_hypotheses(AcSpan acs, const Eigen::Matrix3d& R_level_cam, double pitch,
                       const HypothesisSolvers& solvers,
                       const std::function<void(const RelativePose&)>& sink) {
  const Eigen::Matrix3d Q1 = R_level_cam;
  const Eigen::Matrix3d Q2 = pitch_rotation(pitch) * R_level_cam;
  const auto give = [&](const SolutionSet<PlanarPose, 1>& solutions) {
    for (const PlanarPose& planar : solutions) {
      const RelativePose T = planar.pose();
      sink({Q2.transpose() * T.R * Q1, Q2.transpose() * T.t});
    }
  };
  for (const AffineCorrespondence& ac : acs) {
    const auto levelled = rotate_views(ac, Q1, Q2);
    if (!levelled) continue;
    if (solvers.planar) give(relpose_1ac_planar(*levelled));
    if (solvers.ground) give(relpose_1ac_ground(*levelled));
  }
}

}  // namespace oneac
