#include "oneac/features/ac_tracker.h"

#include "klt/klt_tracker.h"
#include "matching/matched_tracker.h"

#include "oneac/features/feature_options.h"
#include "oneac/features/sift_extractor.h"
#include "oneac/features/vlfeat_extractor.h"

namespace oneac {

std::unique_ptr<AcTracker> make_tracker(const FeatureOptions& options) {
  options.validate();
  if (options.extractor == "klt") return std::make_unique<internal::KltTracker>(options);
  const bool align = options.extractor != "vlfeat";
  return std::make_unique<internal::MatchedTracker>(options, make_extractor(options), align);
}

}  // namespace oneac
