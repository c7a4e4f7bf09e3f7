#include "oneac/comparison/pair_stream.h"

#include <utility>

namespace oneac {

PairExtractor::PairExtractor(const FeatureOptions& options)
    : options_(options), prepares_(make_tracker(options)) {}

std::shared_ptr<const FrameFeatures> PairExtractor::prepare(const ImageView& image,
                                                            const ImageView& mask) const {
  return prepares_->prepare(image, mask);
}

std::vector<AffineCorrespondence> PairExtractor::correspond(
    std::shared_ptr<const FrameFeatures> first, std::shared_ptr<const FrameFeatures> second,
    const PinholeCamera& camera) const {
  const auto tracker = make_tracker(options_);
  MotionHint hint;
  hint.camera = camera;
  static_cast<void>(tracker->advance(std::move(first), hint));
  return affine_parts(tracker->advance(std::move(second), hint));
}

StreamImage::StreamImage(const RawlogSource& source, const PairExtractor& extractor,
                         FrameTicket ticket)
    : source_(source), extractor_(extractor), ticket_(std::move(ticket)) {}

std::shared_ptr<const FrameFeatures> StreamImage::features() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!features_) {
    const CameraFrame frame = source_.load(ticket_);
    camera_ = frame.camera;
    features_ = extractor_.prepare(frame.image.view(), frame.mask.view());
  }
  return features_;
}

PairAcs StreamPair::correspond(const PairExtractor& extractor) const {
  const auto features1 = first->features();
  const auto features2 = second->features();
  PairAcs pair{extractor.correspond(features1, features2, second->camera()), second->camera()};
  for (AffineCorrespondence& ac : pair.acs) ac = normalise(ac, first->camera(), pair.camera);
  return pair;
}

PairStream::PairStream(const SourceOptions& options, const PairExtractor& extractor)
    : source_(options), extractor_(extractor) {}

std::optional<StreamPair> PairStream::next() {
  while (auto ticket = source_.next()) {
    const bool later = !last_ || ticket->time_s > last_->moment().time_s;
    if (!later) continue;  // as `oneac run`: out of order, left out
    auto image = std::make_shared<StreamImage>(source_, extractor_, std::move(*ticket));
    auto before = std::exchange(last_, image);
    if (before) return StreamPair{ordinal_++, std::move(before), std::move(image)};
  }
  return std::nullopt;
}

LogScan scan_log(const SourceOptions& options) {
  RawlogSource source(options);
  LogScan scan;
  while (const auto ticket = source.next()) {
    if (scan.images.empty()) {
      scan.T_vehicle_cam = source.load(*ticket).T_vehicle_cam;
    } else if (!(ticket->time_s > scan.images.back().time_s)) {
      continue;
    }
    scan.images.push_back({ticket->index, ticket->time_s});
  }
  source.finish();
  scan.vehicle = source.report().reference;
  scan.damage = source.report().damage;
  return scan;
}

}  // namespace oneac
