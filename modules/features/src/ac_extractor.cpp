#include "oneac/features/ac_extractor.h"

#include "feature_mask.h"

#include "oneac/base/require.h"
#include "oneac/features/feature_options.h"
#include "oneac/features/sift_extractor.h"
#include "oneac/features/vlfeat_extractor.h"

#include <algorithm>
#include <stdexcept>

namespace oneac {
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

void KltOptions::validate() const {
  require(max_tracks > 0, "klt.max_tracks", max_tracks, "positive");
  require(levels >= 2 && levels <= 6, "klt.levels", levels, "from 2 to 6");
  require(min_distance_px >= 1.0, "klt.min_distance_px", min_distance_px, "at least 1");
  require(forward_backward_px > 0.0, "klt.forward_backward_px", forward_backward_px, "positive");
  require(min_zncc > 0.0 && min_zncc < 1.0, "klt.min_zncc", min_zncc, "in (0, 1)");
  require(max_affine_sigma > 0.0, "klt.max_affine_sigma", max_affine_sigma, "positive");
  require(drift_zncc > 0.0 && drift_zncc < 1.0, "klt.drift_zncc", drift_zncc, "in (0, 1)");
  require(broken_share >= 0.0 && broken_share <= 1.0, "klt.broken_share", broken_share,
          "in [0, 1]");
  require(standing_px >= 0.0, "klt.standing_px", standing_px, "at least 0");
  require(static_frames > 0, "klt.static_frames", static_frames, "positive");
}

void MaskOptions::validate() const {
  static_cast<void>(internal::FeatureMask({polygon, ""}));  // reads the polygons, no file
}

void FeatureOptions::validate() const {
  const auto& known = extractor_names();
  if (std::find(known.begin(), known.end(), extractor) == known.end()) {
    throw std::invalid_argument("features.extractor = '" + extractor +
                                "', must be klt, vlfeat, vlfeat+align or sift");
  }
  klt.validate();
  vlfeat.validate();
  match.validate();
  mask.validate();
}

const std::vector<std::string>& extractor_names() {
  static const std::vector<std::string> names = {"klt", "vlfeat", "vlfeat+align", "sift"};
  return names;
}

std::unique_ptr<AcExtractor> make_extractor(const FeatureOptions& options) {
  options.validate();
  if (options.extractor == "klt") {
    throw std::invalid_argument("features.extractor = 'klt' tracks, it has no pairs: make_tracker");
  }
  if (options.extractor == "sift") return std::make_unique<SiftExtractor>(options);
  return std::make_unique<VlfeatExtractor>(options);
}

}  // namespace oneac
