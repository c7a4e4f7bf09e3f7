#include <oneac/geometry/levelling.h>
#include <oneac/initialisers/relative_pose_initialiser.h>
#include <oneac/solvers/gravity.h>
#include <oneac/solvers/relpose_1ac_ground.h>

#include <mrpt/core/initializer.h>

#include <algorithm>

namespace mine {

/// The median of the one-AC poses that the road would have: nothing robust, an example.
class MedianOfGround : public oneac::RelativePoseInitialiser {
  DEFINE_MRPT_OBJECT(MedianOfGround, mine)

 public:
  std::string name() const override { return "median_of_ground"; }
  void configure(const mrpt::containers::yaml&) override {}

  oneac::InitialiserResult estimate(const oneac::InitialiserInput& input) const override {
    const Eigen::Vector3d down = input.R_level_cam.transpose() * Eigen::Vector3d::UnitY();
    std::vector<oneac::RelativePose> poses;  // of levelled cameras
    for (const oneac::AffineCorrespondence& ac : input.acs) {
      for (const auto& found : oneac::solve_tilted(ac, down, down, oneac::relpose_1ac_ground)) {
        poses.push_back(oneac::level(found.motion, input.R_level_cam));
      }
    }
    oneac::InitialiserResult result;
    result.inliers.assign(input.acs.size(), false);
    result.statistics.iterations = input.acs.size();
    if (poses.empty()) return result;  // its status says: too few correspondences
    const auto middle = poses.begin() + static_cast<std::ptrdiff_t>(poses.size() / 2);
    std::nth_element(poses.begin(), middle, poses.end(), [](const auto& a, const auto& b) {
      return a.R(2, 0) < b.R(2, 0);  // sine of the yaw
    });
    result.pose = oneac::unlevel(*middle, input.R_level_cam);
    result.pose.t.normalize();
    result.status = oneac::PoseStatus::kOk;
    return result;
  }
};

}  // namespace mine

// MRPT's macro names the class in full and stands outside the namespace.
IMPLEMENTS_MRPT_OBJECT(MedianOfGround, oneac::RelativePoseInitialiser, mine)

// Runs when the library is loaded.
MRPT_INITIALIZER(register_mine) {
  mrpt::rtti::registerClass(CLASS_ID(mine::MedianOfGround));
}
