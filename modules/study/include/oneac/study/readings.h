#pragma once

#include "oneac/study/study.h"

#include <string>
#include <string_view>
#include <vector>

namespace oneac {

/// One way to understand what the paper leaves open about its experiments.
struct Reading {
  std::string_view meaning;
  NoiseShape noise_shape;
  DataUse data_use;
};

/// Every noise shape with minimal data and with all four correspondences for every method.
[[nodiscard]] const std::vector<Reading>& readings();

/// The experiments of the options' figures that claims rest on, under every reading in turn
/// (the options' own noise shape and data use are not looked at). Stopped: the readings
/// that are complete.
[[nodiscard]] std::vector<StudyResult> run_readings(const StudyOptions& options,
                                                    const StudyProgress& progress = {});

}  // namespace oneac
