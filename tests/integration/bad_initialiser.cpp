// An initialiser that breaks what initialisers promise, as ONEAC_BAD_ANSWER says.
#include <oneac/initialisers/relative_pose_initialiser.h>

#include <mrpt/core/initializer.h>

#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

namespace mine {

class BadInitialiser : public oneac::RelativePoseInitialiser {
  DEFINE_MRPT_OBJECT(BadInitialiser, mine)

 public:
  std::string name() const override {
    const char* const asked = std::getenv("ONEAC_BAD_NAME");
    if (asked != nullptr && std::string(asked) == "throw") throw 42;
    return asked == nullptr ? "bad" : asked;
  }
  void configure(const mrpt::containers::yaml&) override {
    const char* const asked = std::getenv("ONEAC_BAD_ANSWER");
    if (asked != nullptr && std::string(asked) == "configure") throw 42;
  }

  oneac::InitialiserResult estimate(const oneac::InitialiserInput& input) const override {
    const char* const asked = std::getenv("ONEAC_BAD_ANSWER");
    const std::string how = asked == nullptr ? "" : asked;
    oneac::InitialiserResult result;
    result.status = oneac::PoseStatus::kOk;
    result.pose.t = Eigen::Vector3d(0.0, 0.0, -1.0);
    result.inliers.assign(input.acs.size(), true);
    result.inlier_count = input.acs.size();
    if (how == "nan") result.pose.t *= std::numeric_limits<double>::quiet_NaN();
    if (how == "zero") result.pose.R.setZero();
    if (how == "huge") result.pose.R *= 1e308;
    if (how == "short") result.inliers.resize(3);
    if (how == "status") result.status = static_cast<oneac::PoseStatus>(99);
    if (how == "uncounted") result.statistics.iterations = ~std::size_t{0};
    if (how == "throw") throw std::runtime_error("boom");
    return result;
  }
};

}  // namespace mine

IMPLEMENTS_MRPT_OBJECT(BadInitialiser, oneac::RelativePoseInitialiser, mine)

MRPT_INITIALIZER(register_bad) {
  mrpt::rtti::registerClass(CLASS_ID(mine::BadInitialiser));
}
