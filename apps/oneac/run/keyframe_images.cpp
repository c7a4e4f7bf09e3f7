#include "keyframe_images.h"

#include "terminal/interrupt.h"

#include "oneac/rawlog/rawlog_source.h"

#include <map>
#include <optional>

namespace oneac::app {

/// A log once more, for the images of keyframes alone.
class KeyframeImages::OfLog {
 public:
  OfLog(const KeyframeStore& keyframes, const RunOptions& options)
      : source_(source_options(options)) {
    std::map<std::size_t, std::size_t> places;
    for (std::size_t i = 0; i < keyframes.size(); ++i) places[keyframes[i].index] = i;
    tickets_.resize(keyframes.size());
    std::size_t found = 0;
    while (found < places.size() && !interrupted()) {
      const auto ticket = source_.next();
      if (!ticket) return;
      const auto at = places.find(ticket->index);
      if (at == places.end()) continue;
      tickets_[at->second] = *ticket;
      ++found;
    }
  }

  [[nodiscard]] std::size_t size() const { return tickets_.size(); }
  /// Any thread. @throws InputError where the image has gone
  [[nodiscard]] CameraFrame load(std::size_t place) const {
    return tickets_[place] ? source_.load(*tickets_[place]) : CameraFrame{};
  }

 private:
  static SourceOptions source_options(const RunOptions& options) {
    SourceOptions source = options.source.for_log(options.log);
    source.camera_model = options.camera_model;
    return source;
  }

  RawlogSource source_;
  std::vector<std::optional<FrameTicket>> tickets_;
};

KeyframeImages::KeyframeImages(const std::vector<RecordedDrive>& drives) {
  for (const RecordedDrive& drive : drives) {
    logs_.push_back(std::make_unique<OfLog>(drive.record->keyframes, *drive.options));
  }
}

KeyframeImages::~KeyframeImages() = default;

CameraFrame KeyframeImages::load(std::size_t place) const {
  for (const auto& log : logs_) {
    if (place < log->size()) return log->load(place);
    place -= log->size();
  }
  return {};
}

}  // namespace oneac::app
