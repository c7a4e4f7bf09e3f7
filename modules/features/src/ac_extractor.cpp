#include "oneac/features/ac_extractor.h"

#include "feature_mask.h"

#include "oneac/base/check_bounds.h"
#include "oneac/base/require.h"
#include "oneac/features/feature_options.h"
#include "oneac/features/sift_extractor.h"
#include "oneac/features/vlfeat_extractor.h"

#include <algorithm>
#include <stdexcept>

namespace oneac {
void MatchOptions::validate() const {
  check_bounds("match", *this);
}

void VlfeatOptions::validate() const {
  check_bounds("vlfeat", *this);
}

void KltOptions::validate() const {
  check_bounds("klt", *this);
}

void MaskOptions::validate() const {
  static_cast<void>(internal::FeatureMask({polygon, ""}));  // reads the polygons, no file
}

void FeatureOptions::validate() const {
  check_bounds("features", *this);
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
