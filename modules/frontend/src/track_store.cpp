#include "track_store.h"

#include "oneac/geometry/perspective.h"

#include <algorithm>

namespace oneac {
namespace {

// [-] of an entry of A whose track does not say.
constexpr double kAffineSigma = 0.05;
/// Affinities whose area changed more than a hundredfold over the track carry nothing.
constexpr double kSmallestArea = 0.01;

Track new_track(const AffineCorrespondence& ac, const std::size_t* keyframe_before,
                double point_sigma, double affine_sigma) {
  Track track;
  if (keyframe_before != nullptr) {
    track.seen.push_back(
        {*keyframe_before, ac.x1, Eigen::Matrix2d::Identity(), point_sigma, affine_sigma});
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

void correct_perspective(const RelativePose& T_2_1, StepTracks& step) {
  step.moved.assign(step.acs.size(), Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < step.perspective.size(); ++i) {
    AffineCorrespondence& ac = step.acs[i];
    const double sigma = step.affine_sigma[i] > 0.0 ? step.affine_sigma[i] : kAffineSigma;
    const auto eta = perspective_of(ac, T_2_1, sigma);
    if (!eta) continue;
    step.moved[i] = ac.A * (step.perspective[i] * *eta);
    ac.x2 += step.moved[i];
  }
}

void extend_tracks(const StepTracks& step, const std::vector<bool>& inliers,
                   const std::size_t* keyframe_before, TrackMap& tracks) {
  for (auto& [id, track] : tracks) {
    track.was_alive = track.alive;
    track.alive = false;
  }
  for (std::size_t i = 0; i < step.acs.size(); ++i) {
    if (!inliers.empty() && !inliers[i]) continue;
    const AffineCorrespondence& ac = step.acs[i];
    const auto [at, is_new] = tracks.try_emplace(step.tracks[i]);
    Track& track = at->second;
    if (is_new || !track.was_alive) {  // a gap breaks the chain of affinities
      track = new_track(ac, keyframe_before, step.point_sigma[i], step.affine_sigma[i]);
      if (!step.grey.empty()) track.grey = step.grey[i];
    }
    const Eigen::Matrix2d shape = ac.A * track.now.shape;
    if (!is_usable(shape)) continue;
    track.alive = true;
    track.previous_x = ac.x1 + track.offset;
    // The affinity carries the landmark along with the patch beside which it lies.
    const Eigen::Vector2d x = ac.x2 + ac.A * track.offset;
    track.offset = x - ac.x2;
    if (!step.moved.empty()) track.offset += step.moved[i];
    track.now = {0, x, shape, step.point_sigma[i], step.affine_sigma[i]};
  }
  for (auto at = tracks.begin(); at != tracks.end();) {
    // A dead track stays while it is a landmark: two keyframes of the window see it.
    const bool useless = !at->second.alive && (!at->second.has_depth || at->second.seen.size() < 2);
    at = useless ? tracks.erase(at) : std::next(at);
  }
}

}  // namespace oneac
