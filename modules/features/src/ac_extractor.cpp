#include "oneac/features/ac_extractor.h"

#include "oneac/features/feature_options.h"
#include "oneac/features/vlfeat_extractor.h"

#include <cmath>
#include <stdexcept>

namespace oneac {
namespace {

void require(bool good, const char* field, double value, const char* bound) {
  if (good) return;
  throw std::invalid_argument(std::string(field) + " = " + std::to_string(value) + ", must be " +
                              bound);
}

}  // namespace

void MatchOptions::validate() const {
  require(snn_ratio > 0.0 && snn_ratio <= 1.0, "match.snn_ratio", snn_ratio, "in (0, 1]");
  require(max_shift_px > 0.0, "match.max_shift_px", max_shift_px, "positive");
  require(max_scale >= 1.0, "match.max_scale", max_scale, "at least 1");
}

void VlfeatOptions::validate() const {
  require(first_octave >= -1 && first_octave <= 4, "vlfeat.first_octave", first_octave,
          "from -1 to 4");
  require(peak_threshold >= 0.0, "vlfeat.peak_threshold", peak_threshold, "at least 0");
  require(edge_threshold >= 1.0, "vlfeat.edge_threshold", edge_threshold, "at least 1");
  require(max_features > 0, "vlfeat.max_features", max_features, "positive");
}

void FeatureOptions::validate() const {
  if (extractor != "vlfeat") {
    throw std::invalid_argument("features.extractor = '" + extractor + "', must be vlfeat");
  }
  vlfeat.validate();
  match.validate();
}

std::unique_ptr<AcExtractor> make_extractor(const FeatureOptions& options) {
  options.validate();
  return std::make_unique<VlfeatExtractor>(options);
}

}  // namespace oneac
