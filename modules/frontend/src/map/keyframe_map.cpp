#include "keyframe_map.h"

#include "chained_pose.h"

#include <utility>

namespace oneac {

KeyframeMap::KeyframeMap(const WindowOptions& options, Workers* workers)
    : options_(options), workers_(workers) {}

FrameInMap KeyframeMap::start(const FrameStamp& frame, double focal_px) {
  newest_ = frame;
  frames_ = 1;
  FrameInMap result;
  if (!options_.enabled) return result;
  window_.emplace(options_, focal_px, workers_);
  window_->start(0, T_cam_map_);
  result.keyframe = window_->keyframes().back().id;
  settling_.add_keyframe(*result.keyframe, {frame.index, frame.time_s, segment_, false, 0.0});
  settling_.add_frame(0, *result.keyframe, {});
  keyframe_time_s_ = frame.time_s;
  return result;
}

MapLink KeyframeMap::link(const TwoView& seen) {
  MapLink link;
  if (!window_) return link;
  const bool predicted = seen.status == StepStatus::kPredicted;
  link.began_anew = window_->keyframes().empty() || (lost_ && !predicted);
  if (link.began_anew) begin_anew();
  lost_ = predicted;
  // Inliers carry a track on; nothing goes on through a predicted step.
  window_->extend(predicted ? TrackedPair{} : seen.pair, seen.inliers);
  if (link.began_anew || seen.status != StepStatus::kOk) return link;
  link.carried = window_->carry(seen.pose, T_cam_map_);
  if (link.carried && link.carried->length > 0.0) return link;
  link.carried.reset();
  if (window_->keyframes().size() == 1) return link;  // it has no landmarks yet
  begin_anew();
  link.began_anew = true;
  window_->extend(seen.pair, seen.inliers);
  return link;
}

/// With the frame before the newest step.
void KeyframeMap::begin_anew() {
  settling_.settle_all(*window_, final_);
  ++segment_;
  window_->start(frames_ - 1, T_cam_map_);
  const std::size_t id = window_->keyframes().back().id;
  settling_.add_keyframe(id, {newest_.index, newest_.time_s, segment_, false, 0.0});
  keyframe_time_s_ = newest_.time_s;
}

std::optional<MapLengths> KeyframeMap::move(const FrameStamp& frame, const RelativePose& motion,
                                            const TwoView& seen, const Eigen::Matrix3d& R_level_cam,
                                            bool lengths_hold) {
  T_cam_map_ = orthonormalised(motion * T_cam_map_);
  newest_ = frame;
  ++frames_;
  // A camera that only turns adds no baseline: its keyframe would triangulate noise.
  if (!window_ || seen.status != StepStatus::kOk) return std::nullopt;
  if (!window_->needs_keyframe(T_cam_map_, frame.time_s - keyframe_time_s_)) return std::nullopt;
  T_from_before_ = T_cam_map_ * window_->keyframes().back().T_cam_map.inverse();
  window_->add_keyframe(frames_ - 1, T_cam_map_);
  keyframe_time_s_ = frame.time_s;
  static_cast<void>(window_->refine(R_level_cam, lengths_hold));
  return MapLengths{window_->pair_with(1), window_->compare_depths(seen.pair)};
}

void KeyframeMap::correct(const ScaleCorrection& correction) {
  settling_.drift(correction.share);
  if (correction.factor != 1.0) {
    window_->rescale(correction.factor);
    settling_.rescale(correction.factor);
  }
  const WindowKeyframe& keyframe = window_->keyframes().back();
  T_cam_map_ = keyframe.T_cam_map;
  RelativePose T_from_before = T_from_before_;
  T_from_before.t *= correction.factor;
  settling_.add_keyframe(keyframe.id,
                         {newest_.index, newest_.time_s, segment_, false, 0.0, T_from_before});
  settling_.set_metric(correction.metric, correction.sigma);
}

void KeyframeMap::rescale(const ScaleCorrection& correction) {
  if (!window_ || window_->keyframes().empty()) return;
  RelativePose T_cam_last = T_cam_map_ * window_->keyframes().back().T_cam_map.inverse();
  T_cam_last.t *= correction.factor;
  window_->rescale(correction.factor);
  settling_.rescale(correction.factor);
  T_cam_map_ = T_cam_last * window_->keyframes().back().T_cam_map;
  settling_.set_metric(correction.metric, correction.sigma);
}

FrameInMap KeyframeMap::settle(const std::optional<ScaleCorrection>& correction) {
  FrameInMap result;
  if (window_) {
    if (correction) correct(*correction);
    const WindowKeyframe& last = window_->keyframes().back();
    if (correction) result.keyframe = last.id;
    settling_.add_frame(frames_ - 1, last.id, T_cam_map_ * last.T_cam_map.inverse());
    while (window_->is_over_full()) settling_.settle_oldest(*window_, final_);
    result.settled = std::exchange(final_, {});
  }
  result.T_first_cam = T_first_cam();
  return result;
}

Eigen::Isometry3d KeyframeMap::T_first_cam() const {
  Eigen::Isometry3d T = camera_in_frame(T_cam_map_);
  T.translation() += settling_.offset();
  return T;
}

Settled KeyframeMap::finish() {
  if (window_) settling_.settle_all(*window_, final_);
  return std::exchange(final_, {});
}

}  // namespace oneac
