// Calibration files of every kind, with and without a section.
#include "oneac/rawlog/calibration.h"

#include "fuzz.h"

#include "oneac/base/error.h"

#include <cmath>

ONEAC_FUZZ_TARGET(calibration) {
  using namespace oneac;
  const std::string file = fuzz::file_with(data).string();
  for (const char* section : {"", ":CAMERA_LEFT", ":P0"}) {
    try {
      const PinholeCamera camera = load_calibration(file + section, "left");
      const double sum = camera.fx + camera.fy + camera.cx + camera.cy;
      fuzz::check(std::isfinite(sum) && camera.fx > 0.0 && camera.fy > 0.0, "usable intrinsics");
      fuzz::check(camera.width >= 0 && camera.height >= 0, "a size that is none or positive");
    } catch (const InputError&) {  // what it may throw
    }
  }
}
