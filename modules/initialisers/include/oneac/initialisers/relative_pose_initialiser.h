#pragma once

#include "oneac/mrpt_compat/rtti.h"
#include "oneac/robust/robust_result.h"
#include "oneac/solvers/span.h"

#include <mrpt/system/COutputLogger.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mrpt::containers {
class yaml;
}

namespace oneac {

/// What an initialiser is given for one pair of images.
struct InitialiserInput {
  AcSpan acs;  ///< normalised, of the camera as it is mounted (tilted)
  Eigen::Matrix3d R_level_cam = Eigen::Matrix3d::Identity();  ///< removes the camera's tilt
  double focal_px = 1.0;                                      ///< [px] of one normalised unit
  std::uint64_t seed = 0;  ///< of methods that draw random samples
  MotionPrior prior = {};  ///< what inertia and sensors let expect; default: nothing
};

/// What it answers: status, pose in the camera frame (|t| = 1, or 0 when the
/// camera stood), inliers.
using InitialiserResult = RobustResult;

/// A relative-pose method as an MRPT class: made by name through MRPT's class factory, configured
/// by YAML, logging through COutputLogger. Derive from it, declare with DEFINE_MRPT_OBJECT and
/// register with mrpt::rtti::registerClass(CLASS_ID(…)) to add a method of your own.
class RelativePoseInitialiser : public mrpt::rtti::CObject, public mrpt::system::COutputLogger {
  ONEAC_DEFINE_VIRTUAL_MRPT_OBJECT(RelativePoseInitialiser)

 public:
  RelativePoseInitialiser() : COutputLogger("oneac.initialiser") {}

  /// The short name for command lines and tables, e.g. "1ac_pooled".
  [[nodiscard]] virtual std::string name() const = 0;
  /// Names of the robust estimators that it can run in, the default one first; key `estimator`
  /// chooses. A method with an estimator of its own has nothing to choose.
  [[nodiscard]] virtual std::vector<std::string> estimators() const { return {"own"}; }
  /// Takes its keys from a YAML map: `estimator`, the sections `consensus` and `gc_ransac`, or
  /// whatever the derived class defines.
  /// @throws InputError naming key, value and bound
  virtual void configure(const mrpt::containers::yaml& parameters) = 0;
  /// Estimates one pair. Deterministic; does not change the object, so it is thread-safe.
  [[nodiscard]] virtual InitialiserResult estimate(const InitialiserInput& input) const = 0;
};

/// Short names of all registered initialisers, sorted. The built-in ones are registered by the
/// first call of this function or of make_initialiser(): before it, mrpt::rtti::classFactory()
/// knows none.
[[nodiscard]] std::vector<std::string> initialiser_names();

/// Makes an initialiser from its short name ("1ac_pooled") or class name.
/// @throws InputError listing the names that exist
[[nodiscard]] RelativePoseInitialiser::Ptr make_initialiser(const std::string& name);

}  // namespace oneac

#ifdef ONEAC_PLUGIN_VERSION  // set by oneac_plugin(): every file of the library says how it was
                             // built
#include "oneac/initialisers/plugin_stamp.h"
namespace {
#if __has_attribute(retain)  // a linker that drops what nobody refers to keeps it
[[gnu::used, gnu::retain]]
#else
[[gnu::used]]
#endif
constexpr oneac::PluginStamp kOneacPluginStamp = oneac::plugin_stamp(ONEAC_PLUGIN_VERSION);
}  // namespace
#endif
