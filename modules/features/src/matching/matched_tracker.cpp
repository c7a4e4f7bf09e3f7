#include "matched_tracker.h"

#include "patch/patch_flow.h"
#include "with_quality.h"

#include "oneac/base/mask.h"
#include "oneac/base/median.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace oneac::internal {
namespace {

constexpr int kAlignmentLevels = 2;

double median_shift(const TrackedPair& pair) {
  if (pair.empty()) return 1e9;  // nothing in common is no standing car
  std::vector<double> shifts;
  shifts.reserve(pair.size());
  for (const auto& ac : pair.correspondences) shifts.push_back((ac.x2 - ac.x1).norm());
  return upper_median(std::move(shifts));
}

}  // namespace

MatchedTracker::MatchedTracker(const FeatureOptions& options,
                               std::unique_ptr<AcExtractor> extractor, bool align)
    : options_(options), mask_(options.mask), extractor_(std::move(extractor)), align_(align) {}

std::shared_ptr<const FrameFeatures> MatchedTracker::prepare(const ImageView& image,
                                                             const ImageView& mask) const {
  mask_.require_size(image.width, image.height);
  auto frame = std::make_shared<Frame>();
  frame->width = image.width;
  frame->height = image.height;
  frame->mask = mask_of_image(image, mask);
  frame->features = extractor_->prepare(image);
  if (align_) frame->pyramid = build_pyramid(image, kAlignmentLevels);
  return frame;
}

bool MatchedTracker::usable(const AffineCorrespondence& ac, const Frame& now) const {
  return mask_.usable(ac.x1) && mask_.usable(ac.x2) && usable_in(last_->mask, ac.x1) &&
         usable_in(now.mask, ac.x2);
}

std::uint64_t MatchedTracker::carry_on(const AffineCorrespondence& matched,
                                       const std::map<Place, std::uint64_t>& known) {
  const auto found = known.find({matched.x1.x(), matched.x1.y()});
  const std::uint64_t id = found != known.end() ? found->second : next_id_++;
  tracks_[{matched.x2.x(), matched.x2.y()}] = id;
  return id;
}

TrackedPair MatchedTracker::advance(std::shared_ptr<const FrameFeatures> now, const MotionHint&) {
  const auto frame = std::dynamic_pointer_cast<const Frame>(now);
  if (!frame) throw std::invalid_argument("advance: the frame was not prepared by this tracker");
  TrackedPair pair;
  if (!last_) unused_ = mask_.picture(frame->width, frame->height);
  masked_ = last_ ? darker(frame->mask, last_->mask) : frame->mask;
  if (!masked_.empty()) masked_ = darker(std::move(masked_), unused_);
  if (last_) {
    const std::map<Place, std::uint64_t> known = std::move(tracks_);
    tracks_.clear();
    PatchFlow flow(last_->pyramid, frame->pyramid, options_.klt);
    for (const auto& ac : extractor_->correspond(*last_->features, *frame->features)) {
      if (!usable(ac, *frame)) continue;
      AffineCorrespondence aligned = ac;
      AlignmentQuality quality;
      if (align_) {
        PatchWarp warp;
        warp.M = ac.A;
        warp.centre = ac.x2;
        const auto match = flow.refine(ac.x1, warp, {});
        if (!match) continue;
        aligned = {ac.x1, match->warp.centre, match->warp.M};
        quality = match->quality;
      }
      const std::uint64_t track = carry_on(ac, known);
      pair.correspondences.push_back(with_quality(aligned, track, quality));
    }
    pair.standing = median_shift(pair) < options_.klt.standing_px;
  }
  last_ = frame;
  return pair;
}

void MatchedTracker::reset() {
  last_.reset();
  tracks_.clear();
}

}  // namespace oneac::internal
