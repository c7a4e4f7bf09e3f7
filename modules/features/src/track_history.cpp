#include "track_history.h"

#include <Eigen/LU>

#include <algorithm>

namespace oneac::internal {

void TrackHistory::start(std::uint64_t track, std::size_t frame, const Eigen::Vector2d& u) {
  tracks_[track] = {{frame, u, Eigen::Matrix2d::Identity()}};
}

void TrackHistory::extend(std::uint64_t track, std::size_t frame, const Eigen::Vector2d& u,
                          const Eigen::Matrix2d& A) {
  std::deque<Sighting>& seen = tracks_.at(track);
  seen.push_back({frame, u, A * seen.back().A_here_first});
  if (seen.size() > AcTracker::kTrackMemory) seen.pop_front();
}

void TrackHistory::end_all_but(std::size_t frame) {
  for (auto it = tracks_.begin(); it != tracks_.end();) {
    it = it->second.back().frame == frame ? std::next(it) : tracks_.erase(it);
  }
}

std::optional<AffineCorrespondence> TrackHistory::between(std::uint64_t track, std::size_t frame1,
                                                          std::size_t frame2) const {
  const auto found = tracks_.find(track);
  if (found == tracks_.end()) return std::nullopt;
  const auto at = [&seen = found->second](std::size_t frame) {
    return std::find_if(seen.begin(), seen.end(),
                        [frame](const Sighting& s) { return s.frame == frame; });
  };
  const auto one = at(frame1), two = at(frame2);
  if (one == found->second.end() || two == found->second.end()) return std::nullopt;
  return AffineCorrespondence{one->u, two->u, two->A_here_first * one->A_here_first.inverse()};
}

}  // namespace oneac::internal
