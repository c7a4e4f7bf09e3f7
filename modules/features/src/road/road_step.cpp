#include "oneac/base/require.h"
#include "oneac/features/road_alignment.h"

#include <cmath>

namespace oneac {

void RoadStep::validate() const {
  require(T_2_1.is_finite() && T_2_1.t.norm() > 0.0, "step.T_2_1.t", T_2_1.t.norm(),
          "finite and not zero");
  require(R_level_cam.allFinite(), "step.R_level_cam", R_level_cam.sum(), "finite");
  require(information.allFinite(), "step.information", information.sum(), "finite");
  require(pitch_sigma > 0.0, "step.pitch_sigma", pitch_sigma, "positive");
  require(roll_sigma > 0.0, "step.roll_sigma", roll_sigma, "positive");
  require(std::isfinite(length), "step.length", length, "finite");
  require(length_sigma > 0.0, "step.length_sigma", length_sigma, "positive");
  require(min_length >= 0.0, "step.min_length", min_length, "not negative");
  require(max_length >= min_length && max_length < 100.0, "step.max_length", max_length,
          "min_length … 100");
}

Eigen::Matrix<double, 6, 6> motion_information(double rotation_sigma, double direction_sigma) {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  information.diagonal().head<3>().setConstant(1.0 / (rotation_sigma * rotation_sigma));
  information.diagonal().tail<3>().setConstant(1.0 / (direction_sigma * direction_sigma));
  return information;
}

const char* to_string(RoadStatus status) {
  switch (status) {
    case RoadStatus::kMeasured:
      return "measured";
    case RoadStatus::kNoRoad:
      return "no_road";
    case RoadStatus::kNoTexture:
      return "no_texture";
    case RoadStatus::kNoCorrelation:
      return "no_correlation";
    case RoadStatus::kAmbiguous:
      return "ambiguous";
    case RoadStatus::kOutOfRange:
      return "out_of_range";
    case RoadStatus::kInconsistent:
      return "inconsistent";
  }
  return "unknown";
}

}  // namespace oneac
