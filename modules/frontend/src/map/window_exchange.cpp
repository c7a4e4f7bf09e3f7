#include "window_exchange.h"

#include <algorithm>

namespace oneac {
namespace {

struct Candidate {
  std::uint64_t id;
  const Track* track;
};

/// The longest tracks with a depth, in the order of their numbers.
std::vector<Candidate> chosen_tracks(const TrackMap& tracks, std::size_t most) {
  std::vector<Candidate> chosen;
  for (const auto& [id, track] : tracks) {
    const bool seen_twice = track.has_depth && track.seen.size() >= 2;
    if (seen_twice && track.sighting(track.anchor) != nullptr) chosen.push_back({id, &track});
  }
  if (chosen.size() <= most) return chosen;
  const auto last = chosen.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(chosen.begin(), last, chosen.end(), [](const Candidate& a, const Candidate& b) {
    const std::size_t length_a = a.track->seen.size();
    const std::size_t length_b = b.track->seen.size();
    return length_a > length_b || (length_a == length_b && a.id < b.id);
  });
  chosen.erase(last, chosen.end());
  std::sort(chosen.begin(), chosen.end(),
            [](const Candidate& a, const Candidate& b) { return a.id < b.id; });
  return chosen;
}

void add_track(const Track& track, std::size_t first_id, SlidingWindow& window) {
  const Sighting* anchor = track.sighting(track.anchor);
  WindowLandmark landmark;
  landmark.anchor = track.anchor - first_id;
  landmark.x = track.ray;
  landmark.inverse_depth = track.inverse_depth;
  landmark.gradient = track.gradient;
  landmark.has_gradient = track.has_gradient;
  window.landmarks.push_back(landmark);
  const Eigen::Matrix2d from_anchor = anchor->shape.inverse();
  for (const Sighting& s : track.seen) {
    WindowObservation seen;
    seen.landmark = window.landmarks.size() - 1;
    seen.view = s.keyframe - first_id;
    seen.x = s.x;
    seen.A = s.shape * from_anchor;
    seen.point_sigma = s.point_sigma;
    seen.affine_sigma = s.affine_sigma;
    window.observations.push_back(seen);
  }
}

}  // namespace

WindowExchange to_sliding_window(const std::deque<WindowKeyframe>& keyframes,
                                 const TrackMap& tracks, const WindowOptions& options) {
  WindowExchange exchange;
  const std::size_t count = keyframes.size();
  // While the window is short a single view holds the gauge, or nothing could move.
  const std::size_t fixed =
      count > 3 ? std::min(static_cast<std::size_t>(options.fixed), count - 2) : 1;
  for (std::size_t i = 0; i < count; ++i) {
    exchange.window.views.push_back({keyframes[i].T_cam_map, i < fixed});
  }
  for (const Candidate& chosen :
       chosen_tracks(tracks, static_cast<std::size_t>(options.max_landmarks))) {
    exchange.tracks.push_back(chosen.id);
    add_track(*chosen.track, keyframes.front().id, exchange.window);
  }
  return exchange;
}

void take_back(const WindowExchange& exchange, std::deque<WindowKeyframe>& keyframes,
               TrackMap& tracks) {
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    keyframes[i].T_cam_map = exchange.window.views[i].T_view_map;
  }
  for (std::size_t i = 0; i < exchange.tracks.size(); ++i) {
    const WindowLandmark& landmark = exchange.window.landmarks[i];
    const auto at = tracks.find(exchange.tracks[i]);
    Track& track = at->second;
    if (!(landmark.inverse_depth > 0.0)) {
      tracks.erase(at);  // behind its camera: no point of the scene
      continue;
    }
    track.ray = landmark.x;
    track.inverse_depth = landmark.inverse_depth;
    track.gradient = landmark.gradient;
    track.has_gradient = landmark.has_gradient;
  }
}

}  // namespace oneac
