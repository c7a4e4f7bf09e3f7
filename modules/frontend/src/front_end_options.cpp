#include "oneac/frontend/front_end_options.h"

#include <stdexcept>

namespace oneac {
namespace {

void require(bool good, const std::string& field, const std::string& value, const char* bound) {
  if (!good) throw std::invalid_argument(field + " = " + value + ", must be " + bound);
}

}  // namespace

void TiltOptions::validate() const {
  require(source == "log" || source == "params", "tilt.source", source, "log or params");
  require(pitch_up_deg > -45.0 && pitch_up_deg < 45.0, "tilt.pitch_up_deg",
          std::to_string(pitch_up_deg), "between -45 and 45");
  require(roll_right_deg > -45.0 && roll_right_deg < 45.0, "tilt.roll_right_deg",
          std::to_string(roll_right_deg), "between -45 and 45");
  require(prior_steps >= 0, "tilt.prior_steps", std::to_string(prior_steps), "at least 0");
  require(window_steps >= 1, "tilt.window_steps", std::to_string(window_steps), "at least 1");
}

void FrontEndOptions::validate() const {
  require(camera_height >= 0.0 && camera_height < 100.0, "front_end.camera_height",
          std::to_string(camera_height), "from 0 to 100");
  require(max_hold >= 0.0, "front_end.max_hold", std::to_string(max_hold), "at least 0");
  tilt.validate();
  features.validate();
  consensus.validate();
  ground_scale.validate();
  refine.validate();
}

}  // namespace oneac
