#include "oneac/comparison/pair_stream.h"

#include "oneac/base/error.h"
#include "oneac/base/fingerprint.h"
#include "oneac/observations/repeat_watch.h"

#include <cstdint>
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
  // The pair before this one makes those of the first image: its own first, and neither waits.
  const auto features2 = second->features();
  const auto features1 = first->features();
  PairAcs pair{extractor.correspond(features1, features2, second->camera()), second->camera()};
  for (AffineCorrespondence& ac : pair.acs) ac = normalise(ac, first->camera(), pair.camera);
  return pair;
}

PairStream::PairStream(const SourceOptions& options, const LogScan& scan,
                       const PairExtractor& extractor)
    : source_(options), scan_(scan), extractor_(extractor) {}

std::optional<StreamPair> PairStream::next() {
  while (auto ticket = source_.next()) {
    const bool later = !last_ || ticket->time_s > last_->moment().time_s;
    // As `oneac run`: out of order, or no image of its own, left out.
    if (!later || scan_.repeated.count(ticket->index) > 0) continue;
    auto image = std::make_shared<StreamImage>(source_, extractor_, std::move(*ticket));
    auto before = std::exchange(last_, image);
    if (before) return StreamPair{ordinal_++, std::move(before), std::move(image)};
  }
  return std::nullopt;
}

namespace {

/// Notices images that repeat the one before; decodes those that take as many bytes as it.
class StoredRepeats {
 public:
  explicit StoredRepeats(const RawlogSource& source) : source_(source) {}

  bool repeats(const FrameTicket& ticket) {
    const std::size_t bytes = source_.stored_bytes(ticket);
    const bool alike = before_ && bytes == bytes_;
    if (alike && !loaded_) static_cast<void>(watch_.repeats(image_of(*before_)));
    const bool repeated = alike && watch_.repeats(image_of(ticket));
    loaded_ = alike;
    bytes_ = bytes;
    before_ = ticket;
    return repeated;
  }
  /// Of the image that was asked about last.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  /// One that cannot be decoded is like no other; whoever needs it says why.
  ImageView image_of(const FrameTicket& ticket) {
    try {
      image_ = source_.load(ticket).image;
    } catch (const InputError&) {
      image_ = GreyImage(1, static_cast<int>(ticket.index % kMostRows) + 1);
    }
    return image_.view();
  }

  static constexpr std::size_t kMostRows = 1000;
  const RawlogSource& source_;
  RepeatWatch watch_;
  GreyImage image_;
  std::optional<FrameTicket> before_;
  std::size_t bytes_ = 0;
  bool loaded_ = false;  ///< the watch has seen the one before
};

}  // namespace

LogScan scan_log(const SourceOptions& options) {
  RawlogSource source(options);
  StoredRepeats repeats(source);
  LogScan scan;
  Fingerprint content;
  while (const auto ticket = source.next()) {
    if (scan.images.empty()) {
      const CameraFrame frame = source.load(*ticket);
      scan.T_vehicle_cam = frame.T_vehicle_cam;
      content.add(frame.image.view());
    } else if (!(ticket->time_s > scan.images.back().time_s)) {
      continue;
    }
    if (repeats.repeats(*ticket)) {
      if (scan.repeated.empty()) scan.first_repeated = ticket->name;
      scan.repeated.insert(ticket->index);
      continue;
    }
    scan.images.push_back({ticket->index, ticket->time_s});
    content.add(ticket->time_s);
    content.add(std::uint64_t{repeats.bytes()});
  }
  source.finish();
  scan.vehicle = source.report().reference;
  scan.damage = source.report().damage;
  scan.content = content.text();
  return scan;
}

}  // namespace oneac
