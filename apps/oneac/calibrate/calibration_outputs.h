#pragma once

#include "calibrate/calibration_drive.h"

#include <filesystem>
#include <string>

namespace oneac::app {

/// What the drive can tell and what it cannot, in plain words, with the cure.
[[nodiscard]] std::string verdict_of(const Calibration& calibration);
/// The camera's height above the road in plain words: with 1σ and who told it, or why not.
[[nodiscard]] std::string height_verdict(const CameraHeight& height);
/// Parameters that take the height, for --params; empty where it is not known.
[[nodiscard]] std::string height_yaml(const Calibration& calibration, const std::string& log);
/// Whether there is no such file, or one that height_yaml() filled.
[[nodiscard]] bool is_made_by_calibrate(const std::filesystem::path& file);
/// camera.ini, which --calibration reads back: the estimate where the drive knows it.
[[nodiscard]] std::string camera_ini(const Calibration& calibration, const std::string& log);
/// What goes to stdout: unknowns with their 1σ, then the verdict.
[[nodiscard]] std::string calibration_summary(const Calibration& calibration);
/// The page: verdict, unknowns, bends, residuals by image region with the guess and after.
[[nodiscard]] std::string calibration_html(const Calibration& calibration, const std::string& log);

}  // namespace oneac::app
