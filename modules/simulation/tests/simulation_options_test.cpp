#include "oneac/simulation/simulation_options.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

std::string complaint(const SimulationOptions& options) {
  try {
    options.validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SimulationOptions, DefaultsAreValid) {
  EXPECT_EQ(complaint({}), "");
}

TEST(SimulationOptions, NamesFieldValueAndBound) {
  SimulationOptions options;
  options.frames = 0;
  EXPECT_EQ(complaint(options), "SimulationOptions.frames = 0, must be within 1 ... 10000");
}

TEST(SimulationOptions, RefusesWhatIsNotANumber) {
  SimulationOptions options;
  options.camera_height_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint(options).find("camera_height_m"), std::string::npos);
}

}  // namespace
}  // namespace oneac
