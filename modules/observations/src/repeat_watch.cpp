#include "oneac/observations/repeat_watch.h"

#include "oneac/base/fingerprint.h"

#include <utility>

namespace oneac {

bool RepeatWatch::repeats(const ImageView& image) {
  Fingerprint now;
  now.add(image);
  return std::exchange(before_, now.value()) == now.value();
}

}  // namespace oneac
