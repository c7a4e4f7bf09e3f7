#include "oneac/features/ac_tracker.h"

#include "klt/klt_tracker.h"
#include "matching/matched_tracker.h"

#include "oneac/base/workers.h"
#include "oneac/features/feature_options.h"
#include "oneac/features/sift_extractor.h"
#include "oneac/features/vlfeat_extractor.h"

#include <utility>

namespace oneac {

std::unique_ptr<AcTracker> make_tracker(const FeatureOptions& options,
                                        std::shared_ptr<Workers> workers) {
  options.validate();
  if (options.extractor == "klt") {
    if (!workers) workers = std::make_shared<Workers>();
    return std::make_unique<internal::KltTracker>(options, std::move(workers));
  }
  const bool align = options.extractor != "vlfeat";
  return std::make_unique<internal::MatchedTracker>(options, make_extractor(options), align);
}

}  // namespace oneac
