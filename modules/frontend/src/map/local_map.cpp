#include "local_map.h"

#include "patch_geometry.h"
#include "scale/length_votes.h"
#include "window_exchange.h"

#include "oneac/base/median.h"
#include "oneac/geometry/angles.h"
#include "oneac/geometry/angular_errors.h"

#include <algorithm>
#include <cmath>

namespace oneac {
namespace {

// A landmark whose depth is less certain than this carries no length.
constexpr double kUsefulDepth = 0.3;
// Measured steps are known to 3 to 6 %: an adjustment that changes one by more is wrong.
constexpr double kMostStretch = 1.1;
double relative_sigma(const Track& track) {
  return 1.0 / (std::sqrt(track.depth_information) * track.inverse_depth);
}

/// Seen now, at a depth that is known.
bool is_sure(const Track& track) {
  return track.alive && track.has_depth && relative_sigma(track) < kUsefulDepth;
}

}  // namespace

LocalMap::LocalMap(const WindowOptions& options, double focal_px, Workers* workers)
    : options_(options),
      focal_px_(focal_px),
      sigma_(options.refine.point_noise_px / focal_px),
      refiner_(workers) {}

void LocalMap::start(std::size_t frame, const RelativePose& T_cam_map) {
  tracks_.clear();
  window_.clear();
  window_.push_back({next_id_++, frame, T_cam_map});
  newest_is_keyframe_ = window_.back().id;
  tracks_of_last_ = 0;
}

void LocalMap::extend(const TrackedPair& step, const std::vector<bool>& inliers) {
  const std::size_t id = newest_is_keyframe_.value_or(0);
  extend_tracks(step, inliers, newest_is_keyframe_ ? &id : nullptr, tracks_);
  if (newest_is_keyframe_ && tracks_of_last_ == 0) {
    tracks_of_last_ = tracks_.size();  // the first keyframe's tracks begin with its first step
  }
  newest_is_keyframe_.reset();
}

double LocalMap::depth_in(const RelativePose& T_view_map, const Track& track) const {
  const RelativePose T = T_view_map * keyframe(track.anchor).T_cam_map.inverse();
  return (T * (track.ray.homogeneous() / track.inverse_depth)).z();
}

std::optional<LengthMeasurement> LocalMap::carry(const RelativePose& unit_step,
                                                 const RelativePose& T_before_map) const {
  std::vector<LengthVote> votes;
  for (const auto& [id, track] : tracks_) {
    if (!is_sure(track)) continue;
    // The map tells the depth; where the point lies in the image was measured.
    const Eigen::Vector3d X = depth_in(T_before_map, track) * track.previous_x.homogeneous();
    const auto vote = length_vote(unit_step, X, track.now.x, relative_sigma(track), sigma_);
    if (vote) votes.push_back(*vote);
  }
  if (votes.size() < static_cast<std::size_t>(options_.min_carry)) return std::nullopt;
  const RobustMean mean = robust_mean(votes);
  if (mean.support < static_cast<std::size_t>(options_.min_carry)) return std::nullopt;
  LengthMeasurement carried{mean.value, mean.relative_sigma, LengthSource::kMap, mean.support};
  carried.turn_sigma = kTurnSigma * mean.lever.norm();
  return carried;
}

PointDepths LocalMap::depths(const TrackedPair& step, const RelativePose& T_before_map) const {
  PointDepths depths(step.size());
  for (std::size_t i = 0; i < step.size(); ++i) {
    const auto at = tracks_.find(step.correspondences[i].track);
    if (at == tracks_.end() || !is_sure(at->second)) continue;
    const Track& track = at->second;
    const double z = depth_in(T_before_map, track);
    if (z > 0.0) depths[i] = MeasuredDepth{z, relative_sigma(track)};
  }
  return depths;
}

bool LocalMap::needs_keyframe(const RelativePose& T_cam_map, double seconds) const {
  const WindowKeyframe& last = window_.back();
  const Eigen::Matrix3d R = T_cam_map.R * last.T_cam_map.R.transpose();
  std::vector<double> parallax;
  for (const auto& [id, track] : tracks_) {
    if (!track.alive || track.seen.empty() || track.seen.back().keyframe != last.id) continue;
    const Eigen::Vector3d turned = R * track.seen.back().x.homogeneous();
    parallax.push_back(direction_error(turned, track.now.x.homogeneous()));
  }
  const double shared = static_cast<double>(parallax.size());
  if (shared < options_.min_shared * static_cast<double>(tracks_of_last_)) return true;
  if (parallax.empty()) return true;
  if (rotation_error(T_cam_map.R, last.T_cam_map.R) > options_.max_rotation_deg * kDegree)
    return true;
  const double moved = upper_median(std::move(parallax));
  if (moved > options_.min_parallax_deg * kDegree) return true;
  return seconds > options_.max_seconds && moved > 3.0 * sigma_;
}

void LocalMap::add_keyframe(std::size_t frame, const RelativePose& T_cam_map) {
  window_.push_back({next_id_++, frame, T_cam_map});
  newest_is_keyframe_ = window_.back().id;
  tracks_of_last_ = 0;
  for (auto& [id, track] : tracks_) {
    if (!track.alive) continue;
    ++tracks_of_last_;
    track.seen.push_back(track.now);
    track.seen.back().keyframe = window_.back().id;
  }
  triangulate_new();
  update_depth_information();
}

void LocalMap::triangulate_new() {
  for (auto& [id, track] : tracks_) {
    if (!track.alive || track.has_depth || track.seen.size() < 2) continue;
    const Sighting& first = track.seen.front();
    const RelativePose T = window_.back().T_cam_map * keyframe(first.keyframe).T_cam_map.inverse();
    track.anchor = first.keyframe;
    track.ray = first.x;
    track.inverse_depth = inverse_depth_of(T, first.x, track.now.x);
    track.has_depth = true;
  }
}

void LocalMap::update_depth_information() {
  for (auto& [id, track] : tracks_) {
    if (!track.has_depth) continue;
    track.depth_information = 0.0;
    for (const Sighting& s : track.seen) {
      if (s.keyframe == track.anchor) continue;
      const RelativePose T =
          keyframe(s.keyframe).T_cam_map * keyframe(track.anchor).T_cam_map.inverse();
      track.depth_information += depth_information(T, track.ray, track.inverse_depth, sigma_);
    }
  }
}

bool LocalMap::stretches(const std::vector<WindowView>& views) const {
  const auto length = [](const RelativePose& b, const RelativePose& a) {
    return (b.inverse().t - a.inverse().t).norm();
  };
  const double first_before = length(window_[1].T_cam_map, window_[0].T_cam_map);
  const double first_after = length(views[1].T_view_map, views[0].T_view_map);
  for (std::size_t i = 2; i < views.size(); ++i) {
    const double before = length(window_[i].T_cam_map, window_[i - 1].T_cam_map) / first_before;
    const double after = length(views[i].T_view_map, views[i - 1].T_view_map) / first_after;
    // Not finite where the first step has no length: then nothing is compared.
    if (after > kMostStretch * before || before > kMostStretch * after) return true;
  }
  return false;
}

bool LocalMap::refine(const Eigen::Matrix3d& R_level_cam, bool lengths_hold) {
  if (window_.size() < 2) return false;
  const double length =
      (window_[1].T_cam_map.inverse().t - window_[0].T_cam_map.inverse().t).norm();
  WindowExchange exchange = to_sliding_window(window_, tracks_, options_);
  exchange.window.R_level_cam = R_level_cam;
  exchange.window.focal_px = focal_px_;
  const WindowRefineResult result = refiner_.refine(exchange.window, options_.refine);
  if (!result.usable) return false;
  if (lengths_hold && stretches(exchange.window.views)) return false;
  take_back(exchange, window_, tracks_);
  triangulate_but(exchange.tracks);
  const double now = (window_[1].T_cam_map.inverse().t - window_[0].T_cam_map.inverse().t).norm();
  // A short window holds one pose only, so the optimiser may drift along the free scale.
  if (length > 0.0 && now > 0.0) rescale(length / now);
  update_depth_information();
  return true;
}

// Keyframes moved under the landmarks that did not take part: left as they are, they would carry
// the length that was corrected into the next step.
void LocalMap::triangulate_but(const std::vector<std::uint64_t>& adjusted) {
  const WindowKeyframe& last = window_.back();
  for (auto& [id, track] : tracks_) {
    if (!track.alive || !track.has_depth) continue;
    if (std::binary_search(adjusted.begin(), adjusted.end(), id)) continue;
    const Sighting* seen = track.sighting(last.id);
    if (seen == nullptr || track.anchor == last.id) continue;
    const RelativePose T = last.T_cam_map * keyframe(track.anchor).T_cam_map.inverse();
    track.inverse_depth = inverse_depth_of(T, track.ray, seen->x);
  }
}

std::vector<DepthComparison> LocalMap::compare_depths(const TrackedPair& step) const {
  std::vector<DepthComparison> depths;
  for (const Correspondence& ac : step.correspondences) {
    if (!ac.depth) continue;
    const auto at = tracks_.find(ac.track);
    if (at == tracks_.end() || !is_sure(at->second)) continue;
    const Track& track = at->second;
    depths.push_back({depth_in(window_.back().T_cam_map, track), relative_sigma(track), *ac.depth});
  }
  return depths;
}

KeyframePair LocalMap::pair_with(std::size_t steps_back) const {
  KeyframePair pair;
  if (window_.size() <= steps_back) return pair;
  const WindowKeyframe& first = window_[window_.size() - 1 - steps_back];
  const WindowKeyframe& last = window_.back();
  pair.T_2_1 = last.T_cam_map * first.T_cam_map.inverse();
  for (const auto& [id, track] : tracks_) {
    if (!track.has_depth) continue;
    const Sighting* a = track.sighting(first.id);
    const Sighting* b = track.sighting(last.id);
    if (a == nullptr || b == nullptr) continue;
    pair.acs.push_back({a->x, b->x, b->shape * a->shape.inverse()});
  }
  return pair;
}

void LocalMap::rescale(double factor) {
  if (window_.empty()) return;
  const Eigen::Vector3d origin = window_.front().T_cam_map.inverse().t;
  for (WindowKeyframe& kf : window_) {
    const Eigen::Vector3d centre = kf.T_cam_map.inverse().t;
    kf.T_cam_map.t = -(kf.T_cam_map.R * (origin + factor * (centre - origin)));
  }
  for (auto& [id, track] : tracks_) {
    track.inverse_depth /= factor;
    track.gradient /= factor;
    track.depth_information *= factor * factor;
  }
}

void LocalMap::renormalise(const CameraChange& change) {
  focal_px_ /= change.factor();
  sigma_ *= change.factor();
  for (auto& [id, track] : tracks_) {
    track.gradient = change.derivative(track.ray).transpose().inverse() * track.gradient;
    const Eigen::Matrix2d began =
        change.derivative(track.seen.empty() ? track.now.x : track.seen.front().x).inverse();
    const Eigen::Vector2d patch = change(track.now.x - track.offset);
    const auto move = [&](Sighting& seen) {
      seen.shape = change.derivative(seen.x) * seen.shape * began;
      seen.x = change(seen.x);
    };
    move(track.now);
    for (Sighting& seen : track.seen) move(seen);
    track.offset = track.now.x - patch;
    track.previous_x = change(track.previous_x);
    track.ray = change(track.ray);
  }
}

std::optional<NewestKeyframe> LocalMap::newest() const {
  if (!newest_is_keyframe_) return std::nullopt;
  NewestKeyframe result{window_.back().T_cam_map, {}};
  for (const auto& [id, track] : tracks_) {
    const Sighting* seen = track.alive ? track.sighting(*newest_is_keyframe_) : nullptr;
    if (seen != nullptr) result.sightings.push_back({id, seen->x});
  }
  return result;
}

const WindowKeyframe& LocalMap::keyframe(std::size_t id) const {
  return window_.at(position(id));
}

Eigen::Matrix<double, 6, 6> LocalMap::oldest_constraint() const {
  if (window_.size() < 2) return Eigen::Matrix<double, 6, 6>::Zero();
  WindowExchange exchange = to_sliding_window(window_, tracks_, options_);
  exchange.window.focal_px = focal_px_;
  return view_information(exchange.window, 1, options_.refine);
}

}  // namespace oneac
