#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPose2D.h>

namespace oneac {

/// Adds up what the actions of action/sensory-frame pairs say that the wheels did, and tells it as
/// an odometer would.
class ActionOdometry {
 public:
  /// @return where the wheels are behind these actions, with their time stamp, which may be
  /// missing;
  ///         null where they tell no odometry. After an increment that is not finite it begins anew
  [[nodiscard]] mrpt::obs::CObservationOdometry::Ptr take(mrpt::obs::CActionCollection& actions);

 private:
  mrpt::poses::CPose2D pose_;
};

}  // namespace oneac
