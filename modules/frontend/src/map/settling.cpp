#include "settling.h"

#include "chained_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace oneac {
namespace {

// Where nothing is known: 1σ of a keyframe's turn [rad] and of its position [lengths of the step].
constexpr double kUnknownTurn = 0.2;
constexpr double kUnknownPosition = 1.0;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// From (w, v) of T_2_1, R ← exp([w]×) R, t ← t + v, to g2o's (translation, quaternion's vector
/// part) of T_1_2, with the uncertainty of the scale.
Matrix6 as_g2o(const Matrix6& information, const RelativePose& T_2_1, double scale_sigma) {
  const double length = std::max(T_2_1.t.norm(), 1e-3);
  Matrix6 prior = Matrix6::Zero();
  prior.diagonal().head<3>().setConstant(1.0 / (kUnknownTurn * kUnknownTurn));
  prior.diagonal().tail<3>().setConstant(1.0 /
                                         (kUnknownPosition * kUnknownPosition * length * length));
  const Matrix6 covariance = (information + prior).inverse();
  Matrix6 J = Matrix6::Zero();
  J.block<3, 3>(0, 0) = -cross_matrix(T_2_1.t);
  J.block<3, 3>(0, 3) = -Eigen::Matrix3d::Identity();
  J.block<3, 3>(3, 0) = -0.5 * Eigen::Matrix3d::Identity();
  Matrix6 result = J * covariance * J.transpose();
  result.topLeftCorner<3, 3>() += scale_sigma * scale_sigma * T_2_1.t * T_2_1.t.transpose();
  const Matrix6 inverse = result.inverse();
  return 0.5 * (inverse + inverse.transpose());
}

/// How much longer adjustments made a step; empty where that is no longer the same step.
std::optional<double> stretch(double now, double before) {
  constexpr double kMost = 2.0;
  if (!(before > 0.0)) return std::nullopt;
  const double ratio = now / before;
  if (!(ratio < kMost && ratio > 1.0 / kMost)) return std::nullopt;
  return ratio;
}

}  // namespace

void Settling::add_frame(std::size_t frame, std::size_t keyframe,
                         const RelativePose& T_cam_keyframe) {
  frames_.push_back({frame, keyframe, T_cam_keyframe});
}

void Settling::set_metric(bool metric, double scale_sigma) {
  for (auto& [id, note] : notes_) {
    note.metric = metric;
    note.scale_sigma = scale_sigma;
  }
}

void Settling::drift(double share) {
  for (auto& [id, note] : notes_) note.share *= share;
}

void Settling::rescale(double factor) {
  const double change = std::log(factor);
  for (auto& [id, note] : notes_) {
    // The map is rescaled about its oldest keyframe: the step that ends there keeps its length.
    if (id != notes_.begin()->first) note.log_factor += (note.share - 1.0) * change;
  }
  for (auto& [id, note] : notes_) note.T_from_before.t *= factor;
  for (Waiting& waiting : frames_) waiting.T_cam_keyframe.t *= factor;
}

void Settling::settle_oldest(LocalMap& map, Settled& settled) {
  const WindowKeyframe oldest = map.keyframes().front();
  const Note note = notes_[oldest.id];
  notes_.erase(oldest.id);
  Keyframe keyframe;
  keyframe.id = oldest.id;
  keyframe.frame = oldest.frame;
  keyframe.index = note.index;
  keyframe.time_s = note.time_s;
  keyframe.segment = note.segment;
  keyframe.metric = note.metric;
  if (T_last_map_) {
    RelativePose T = oldest.T_cam_map * T_last_map_->inverse();
    const Eigen::Vector3d step = oldest.T_cam_map.inverse().t - T_last_map_->inverse().t;
    offset_ += (std::exp(note.log_factor) - 1.0) * step;
    T.t *= std::exp(note.log_factor);
    // A map that began anew is tied to the one before by a guess only.
    if (note.segment != last_segment_) constraint_.setZero();
    const double sigma = note.metric ? note.scale_sigma : 0.0;
    keyframe.information = as_g2o(constraint_, T, sigma);
  }
  keyframe.T_first_cam = camera_in_frame(oldest.T_cam_map);
  keyframe.T_first_cam.translation() += offset_;
  constraint_ = map.oldest_constraint();
  T_last_map_ = oldest.T_cam_map;
  last_segment_ = note.segment;
  keyframe.points = map.retire_oldest();
  for (MapPoint& point : keyframe.points) point.position += offset_.cast<float>();
  settle_frames(oldest, map, settled);
  settled.keyframes.push_back(std::move(keyframe));
}

Settling::Bend Settling::bend_after(const WindowKeyframe& keyframe, const LocalMap& map) const {
  Bend bend;
  if (notes_.empty() || map.keyframes().empty()) return bend;
  const Note& next = notes_.begin()->second;
  const double before = next.T_from_before.t.norm();
  RelativePose now = map.keyframes().front().T_cam_map * keyframe.T_cam_map.inverse();
  const std::optional<double> stretched = stretch(now.t.norm(), before);
  bend.factor = std::exp(next.log_factor) * stretched.value_or(1.0);
  if (!stretched) return bend;
  now.t *= std::exp(next.log_factor);
  RelativePose led = next.T_from_before;
  led.t *= bend.factor;
  bend.length = led.t.norm();
  bend.remainder = led.inverse() * now;
  return bend;
}

RelativePose Settling::Bend::of(RelativePose T_cam_keyframe) const {
  T_cam_keyframe.t *= factor;
  if (!(length > 0.0)) return T_cam_keyframe;
  const double share = std::min(T_cam_keyframe.t.norm() / length, 1.0);
  const Eigen::AngleAxisd turn(remainder.R);
  const RelativePose part{rotation_from_vector(share * turn.angle() * turn.axis()),
                          share * remainder.t};
  return T_cam_keyframe * part;
}

void Settling::settle_frames(const WindowKeyframe& keyframe, const LocalMap& map,
                             Settled& settled) {
  // They lie on the step that ends in the next keyframe, and bend with it.
  const Bend bend = bend_after(keyframe, map);
  while (!frames_.empty() && frames_.front().keyframe <= keyframe.id) {
    Eigen::Isometry3d T =
        camera_in_frame(bend.of(frames_.front().T_cam_keyframe) * keyframe.T_cam_map);
    T.translation() += offset_;
    settled.frames.push_back({frames_.front().frame, T});
    frames_.pop_front();
  }
}

void Settling::settle_all(LocalMap& map, Settled& settled) {
  while (!map.keyframes().empty()) settle_oldest(map, settled);
}

}  // namespace oneac
