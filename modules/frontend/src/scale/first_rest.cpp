#include "scale/first_rest.h"

namespace oneac {
namespace {

// [s] A car that creeps at half a metre a second has moved what is 50 m away and 15° aside by 1 px.
constexpr double kLong = 1.0;
// [-] The rest is left to people, and tracks that are lost: a bonnet and drops are less of a
// picture.
constexpr double kLeastInPlace = 0.9;
// [px] tracks of a second slip by half of it.
constexpr double kInPlace = 1.0;
constexpr std::size_t kFewest = 20;  // [points] of which a share says something

}  // namespace

void FirstRest::begin(const TwoView& seen, double time_s) {
  places_.clear();
  for (const Correspondence& ac : seen.pair.correspondences) places_.emplace(ac.track, ac.x1);
  since_s_ = time_s;
}

double FirstRest::share_in_place(const TwoView& seen) const {
  if (places_.size() < kFewest) return 0.0;
  std::size_t in_place = 0;
  for (const Correspondence& ac : seen.pair.correspondences) {
    const auto at = places_.find(ac.track);
    if (at == places_.end()) continue;
    if ((ac.x2 - at->second).norm() * seen.focal_px <= kInPlace) ++in_place;
  }
  return static_cast<double>(in_place) / static_cast<double>(places_.size());
}

void FirstRest::follow(const TwoView& seen, double begin_s, double end_s) {
  if (over_) return;
  if (seen.status != StepStatus::kNoMotion) {
    over_ = seen.status == StepStatus::kOk;
    sure_ = sure_ && !over_;
    places_.clear();
    return;
  }
  if (sure_) return;
  if (places_.empty()) begin(seen, begin_s);
  if (end_s - since_s_ < kLong) return;
  sure_ = share_in_place(seen) >= kLeastInPlace;
  places_.clear();
}

}  // namespace oneac
