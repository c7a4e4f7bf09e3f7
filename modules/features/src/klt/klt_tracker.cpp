#include "klt_tracker.h"

#include "flow_search.h"
#include "point_bins.h"
#include "standing.h"
#include "with_quality.h"

#include "oneac/base/mask.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace oneac::internal {
namespace {

// The first patch is compared while the scale is within this factor; then the current one takes its
// place. Beyond it resampling alone changes a patch.
constexpr double kReferenceScale = 1.5;
constexpr double kMerge = 0.5;  // tracks nearer than half the corners' distance are one
// An image with fewer corners (dark, blank) has nothing that other features would find.
constexpr std::size_t kLeastCorners = 50;

Correspondence correspondence_of(const KltTrack& track, const PatchMatch& match) {
  return with_quality({track.u, match.warp.centre, match.warp.M}, track.id, match.quality);
}

}  // namespace

KltTracker::KltTracker(const FeatureOptions& options, std::shared_ptr<Workers> workers)
    : options_(options),
      workers_(std::move(workers)),
      mask_(options.mask),
      rematcher_(options),
      static_points_(options.klt.static_frames) {}

std::shared_ptr<const FrameFeatures> KltTracker::prepare(const ImageView& image,
                                                         const ImageView& mask) const {
  mask_.require_size(image.width, image.height);
  auto frame = std::make_shared<KltFrame>();
  frame->pyramid = build_pyramid(image, options_.klt.levels);
  frame->mask = mask_of_image(image, mask);
  frame->corners = find_corners(
      frame->pyramid, cell_px(frame->pyramid),
      [&](const Eigen::Vector2d& u) { return mask_.usable(u) && usable_in(frame->mask, u); });
  return frame;
}

TrackedPair KltTracker::advance(std::shared_ptr<const FrameFeatures> now, const MotionHint& hint) {
  const auto frame = std::dynamic_pointer_cast<const KltFrame>(now);
  if (!frame) throw std::invalid_argument("advance: the frame was not prepared by this tracker");
  if (anchor_ && (anchor_->pyramid.width() != frame->pyramid.width() ||
                  anchor_->pyramid.height() != frame->pyramid.height())) {
    throw std::invalid_argument("advance: the image has another size than the one before");
  }
  learn_car(*frame, hint);
  take_masks(*frame);
  TrackedPair pair;
  if (!anchor_) {
    frame_ = 0;
  } else {
    ++frame_;
    if (stands(*frame)) return stand(*frame);
    const MotionPrediction motion(hint);
    pair = take(*frame, motion, follow(frame, motion));
  }
  anchor_ = frame;
  replenish(*frame);
  return pair;
}

void KltTracker::learn_car(const KltFrame& now, const MotionHint& hint) {
  const int width = now.pyramid.width(), height = now.pyramid.height();
  if (!anchor_) unused_ = mask_.picture(width, height);
  if (!options_.mask.learn || !car_mask_.observe(now.pyramid, hint)) return;
  unused_ = darker(mask_.picture(width, height), car_mask_.picture());
  tracks_.erase(
      std::remove_if(tracks_.begin(), tracks_.end(),
                     [this](const KltTrack& track) { return !car_mask_.usable(track.u); }),
      tracks_.end());
}

void KltTracker::take_masks(const KltFrame& now) {
  masked_ = anchor_ ? darker(now.mask, anchor_->mask) : now.mask;
  if (!masked_.empty()) masked_ = darker(std::move(masked_), unused_);
}

bool KltTracker::stands(const KltFrame& now) const {
  // Where most tracks are the car's own, they stand whatever the car does.
  if (shows_travel()) return false;
  return is_standing(tracks_, anchor_->pyramid, now.pyramid, options_.klt.standing_px);
}

TrackedPair KltTracker::stand(const KltFrame& now) {
  TrackedPair pair;
  pair.standing = true;
  for (KltTrack& track : tracks_) {
    if (!usable_in(now.mask, track.u)) continue;
    PatchMatch same;
    same.warp.centre = track.u;
    pair.correspondences.push_back(correspondence_of(track, same));
  }
  return pair;
}

KltTracker::Matches KltTracker::follow(const std::shared_ptr<const KltFrame>& now,
                                       const MotionPrediction& motion) {
  const FlowImages images{anchor_->pyramid, now->pyramid, motion, options_.klt, *workers_};
  Matches matches = search_tracks(tracks_, images);
  if (!is_broken(matches, *now)) return matches;
  add_rematches(now, matches);
  search_lost_tracks(tracks_, images, matches);
  return matches;
}

bool KltTracker::is_broken(const Matches& matches, const KltFrame& now) const {
  const auto found = std::count_if(matches.begin(), matches.end(),
                                   [](const auto& match) { return match.has_value(); });
  return static_cast<double>(found) <
             options_.klt.broken_share * static_cast<double>(tracks_.size()) &&
         tracks_.size() >= kLeastCorners && now.corners.size() >= kLeastCorners;
}

void KltTracker::add_rematches(const std::shared_ptr<const KltFrame>& now, Matches& matches) {
  PointBins taken(now->pyramid.width(), now->pyramid.height(), options_.klt.min_distance_px);
  for (const auto& match : matches) {
    if (match) taken.add(match->warp.centre);
  }
  for (const Rematch& again : rematcher_.match(anchor_, now)) {
    const Eigen::Vector2d& u2 = again.match.warp.centre;
    if (!usable(*anchor_, again.u1) || !taken.is_free(u2, options_.klt.min_distance_px)) continue;
    taken.add(u2);
    KltTrack track;
    track.id = next_id_++;
    track.u = again.u1;
    tracks_.push_back(std::move(track));
    matches.push_back(again.match);
  }
}

TrackedPair KltTracker::take(const KltFrame& now, const MotionPrediction& motion,
                             const Matches& matches) {
  static_points_.begin_pair(frame_, median_flow(tracks_, matches));
  const std::vector<char> hold = which_hold(now, matches);
  TrackedPair pair;
  std::vector<KltTrack> kept;
  PointBins taken(now.pyramid.width(), now.pyramid.height(), options_.klt.min_distance_px);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    KltTrack& track = tracks_[i];
    if (!hold[i] || !usable(now, matches[i]->warp.centre)) continue;
    const Eigen::Vector2d& u2 = matches[i]->warp.centre;
    const bool by_place = options_.mask.learn && car_mask_.must_move(track.u);
    const bool rests = static_points_.rests(track, u2 - track.u, motion, by_place);
    if (rests && by_place) car_mask_.suspect(track.u);
    if (static_points_.is_static(track)) {
      static_points_.block(cell_of(now, u2));
      continue;
    }
    if (!taken.is_free(u2, kMerge * options_.klt.min_distance_px)) continue;
    taken.add(u2);
    if (!rests) pair.correspondences.push_back(correspondence_of(track, *matches[i]));
    track.A = matches[i]->warp.M;
    track.flow = u2 - track.u;
    track.u = u2;
    track.window = matches[i]->window;
    ++track.age;
    kept.push_back(std::move(track));
  }
  tracks_ = std::move(kept);
  return pair;
}

std::vector<char> KltTracker::which_hold(const KltFrame& now, const Matches& matches) {
  std::vector<char> hold(tracks_.size(), 0);
  workers_->share(tracks_.size(), [&](std::size_t i, std::size_t) {
    hold[i] = matches[i] && holds(tracks_[i], now, *matches[i]) ? 1 : 0;
  });
  return hold;
}

bool KltTracker::holds(KltTrack& track, const KltFrame& now, const PatchMatch& match) const {
  track.A_now_reference = match.warp.M * track.A_now_reference;
  track.reference_is_here = false;
  const double scale = std::sqrt(std::abs(track.A_now_reference.determinant()));
  if (track.reference && scale < kReferenceScale && scale > 1.0 / kReferenceScale) {
    PatchWarp warp;
    warp.M = track.A_now_reference;
    warp.centre = match.warp.centre;
    const double zncc = compare_patch(*track.reference, now.pyramid, warp);
    return zncc >= options_.klt.drift_zncc || zncc < -0.999;  // −1: sticks out of the image
  }
  auto renewed = std::make_unique<AnchoredPatch>();
  if (!anchor_adapted(now.pyramid, match.warp.centre, *renewed, match.window)) return false;
  track.reference = std::move(renewed);
  track.A_now_reference.setIdentity();
  track.reference_is_here = true;
  return true;
}

bool KltTracker::usable(const KltFrame& frame, const Eigen::Vector2d& u) const {
  return mask_.usable(u) && car_mask_.usable(u) && usable_in(frame.mask, u);
}

void KltTracker::reset() {
  anchor_.reset();
  tracks_.clear();
  static_points_.clear();
  car_mask_.break_sequence();
  frame_ = 0;
}

int KltTracker::cell_px(const ImagePyramid& pyramid) const {
  const double area = static_cast<double>(pyramid.width()) * pyramid.height();
  return std::max(8, static_cast<int>(std::lround(std::sqrt(area / options_.klt.max_tracks))));
}

std::size_t KltTracker::cell_of(const KltFrame& frame, const Eigen::Vector2d& u) const {
  const int cell = cell_px(frame.pyramid);
  const int column = std::clamp(static_cast<int>(u.x()) / cell, 0, frame.corners.columns - 1);
  const int row = std::clamp(static_cast<int>(u.y()) / cell, 0, frame.corners.rows - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.corners.columns) +
         static_cast<std::size_t>(column);
}

}  // namespace oneac::internal
