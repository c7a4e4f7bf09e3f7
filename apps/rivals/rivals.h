#pragma once

#include "oneac/initialisers/relative_pose_initialiser.h"

#include <cstdint>
#include <string>
#include <vector>

namespace oneac::rivals {

// What is given to every rival: one pixel, as our methods, and OpenCV's usual confidence. OpenGV
// knows no pixels; its bound is the angle that one pixel is at the image's centre.
inline constexpr double kThreshold_px = 1.0;
inline constexpr double kConfidence = 0.999;
inline constexpr int kMostIterations = 5000;

/// A method of another library: nothing to configure, an estimator of its own.
class Rival : public RelativePoseInitialiser {
  ONEAC_DEFINE_VIRTUAL_MRPT_OBJECT(Rival)

 public:
  void configure(const mrpt::containers::yaml& parameters) override;

 protected:
  /// Fills in what follows from pose and inliers.
  [[nodiscard]] static InitialiserResult answer(const RelativePose& pose, std::vector<bool> inliers,
                                                std::size_t iterations);
};

/// findEssentialMat with USAC_MAGSAC, then recoverPose.
class OpencvMagsac : public Rival {
  DEFINE_MRPT_OBJECT(OpencvMagsac, oneac::rivals)
 public:
  [[nodiscard]] std::string name() const override { return "opencv_usac_magsac"; }
  [[nodiscard]] InitialiserResult estimate(const InitialiserInput& input) const override;
};

/// findEssentialMat with the classic RANSAC, then recoverPose.
class OpencvRansac : public Rival {
  DEFINE_MRPT_OBJECT(OpencvRansac, oneac::rivals)
 public:
  [[nodiscard]] std::string name() const override { return "opencv_ransac"; }
  [[nodiscard]] InitialiserResult estimate(const InitialiserInput& input) const override;
};

#ifdef ONEAC_WITH_OPENGV
/// Stewénius' five-point solver in RANSAC, then a non-linear refinement on the inliers.
class Opengv5pc : public Rival {
  DEFINE_MRPT_OBJECT(Opengv5pc, oneac::rivals)
 public:
  [[nodiscard]] std::string name() const override { return "opengv_5pc"; }
  [[nodiscard]] InitialiserResult estimate(const InitialiserInput& input) const override;
};
#endif

}  // namespace oneac::rivals
