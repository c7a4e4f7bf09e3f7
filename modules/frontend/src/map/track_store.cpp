#include "track_store.h"

#include <algorithm>

namespace oneac {
namespace {

/// Affinities whose area changed more than a hundredfold over the track carry nothing.
constexpr double kSmallestArea = 0.01;

Track new_track(const Correspondence& ac, const std::size_t* keyframe_before) {
  Track track;
  track.grey = ac.grey;
  if (keyframe_before != nullptr) {
    track.seen.push_back(
        {*keyframe_before, ac.x1, Eigen::Matrix2d::Identity(), ac.point_sigma, ac.affine_sigma});
  }
  return track;
}

bool is_usable(const Eigen::Matrix2d& shape) {
  const double area = shape.determinant();
  return shape.allFinite() && area > kSmallestArea && area < 1.0 / kSmallestArea;
}

}  // namespace

const Sighting* Track::sighting(std::size_t keyframe) const {
  const auto found = std::find_if(seen.begin(), seen.end(),
                                  [=](const Sighting& s) { return s.keyframe == keyframe; });
  return found == seen.end() ? nullptr : &*found;
}

void extend_tracks(const TrackedPair& step, const std::vector<bool>& inliers,
                   const std::size_t* keyframe_before, TrackMap& tracks) {
  for (auto& [id, track] : tracks) {
    track.was_alive = track.alive;
    track.alive = false;
  }
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (!inliers.empty() && !inliers[i]) continue;
    const Correspondence& ac = step.correspondences[i];
    const auto [at, is_new] = tracks.try_emplace(ac.track);
    Track& track = at->second;
    // A gap breaks the chain of affinities.
    if (is_new || !track.was_alive) track = new_track(ac, keyframe_before);
    const Eigen::Matrix2d shape = ac.A * track.now.shape;
    if (!is_usable(shape)) continue;
    track.alive = true;
    track.previous_x = ac.x1 + track.offset;
    // The affinity carries the landmark along with the patch beside which it lies.
    const Eigen::Vector2d x = ac.x2 + ac.A * track.offset;
    track.offset = x - ac.x2;
    track.offset += ac.moved;
    track.now = {0, x, shape, ac.point_sigma, ac.affine_sigma};
  }
  for (auto at = tracks.begin(); at != tracks.end();) {
    // A dead track stays while it is a landmark: two keyframes of the window see it.
    const bool useless = !at->second.alive && (!at->second.has_depth || at->second.seen.size() < 2);
    at = useless ? tracks.erase(at) : std::next(at);
  }
}

}  // namespace oneac
