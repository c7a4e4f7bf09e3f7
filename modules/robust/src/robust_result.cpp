#include "oneac/robust/robust_result.h"

namespace oneac {

const char* to_string(PoseStatus status) {
  switch (status) {
    case PoseStatus::kOk:
      return "ok";
    case PoseStatus::kOnePlane:
      return "one_plane";
    case PoseStatus::kPureRotation:
      return "pure_rotation";
    case PoseStatus::kNoMotion:
      return "no_motion";
    case PoseStatus::kTooFew:
      return "too_few";
  }
  return "unknown";
}

}  // namespace oneac
