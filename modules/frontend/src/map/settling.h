#pragma once

#include "local_map.h"

#include "oneac/frontend/keyframe.h"

#include <cstddef>
#include <deque>
#include <map>
#include <optional>

namespace oneac {

/// Frames wait here, tied to the keyframe before them, until that keyframe is final.
class Settling {
 public:
  /// What a keyframe needs to be reported.
  struct Note {
    std::size_t index = 0;
    double time_s = 0.0;
    std::size_t segment = 0;
    bool metric = false;
    double scale_sigma = 0.0;  ///< relative 1σ of lengths
    /// The keyframe in the one before, as its frames led there before adjustments [map].
    RelativePose T_from_before{};
    /// How far today's measurements speak for the step that ended here, and ...
    double share = 1.0;
    double log_factor = 0.0;  ///< ... what its length in the map has to be multiplied with for it
  };

  void add_frame(std::size_t frame, std::size_t keyframe, const RelativePose& T_cam_keyframe);
  void add_keyframe(std::size_t id, const Note& note) { notes_[id] = note; }
  /// The scale of all keyframes of the window is known so well now.
  void set_metric(bool metric, double scale_sigma);
  /// The scale went on by a keyframe, see ScaleFilter::drift().
  void drift(double share);
  /// The map's lengths were multiplied: all of them, while only `share` of it was meant for a step.
  void rescale(double factor);
  /// Takes the oldest keyframe out of the map.
  void settle_oldest(LocalMap& map, Settled& settled);
  void settle_all(LocalMap& map, Settled& settled);
  /// Of what is settled against the map [map lengths].
  [[nodiscard]] const Eigen::Vector3d& offset() const { return offset_; }

 private:
  /// What has become of a step between two keyframes.
  struct Bend {
    double factor = 1.0;     ///< of its lengths
    double length = 0.0;     ///< [map] of the step, in which ...
    RelativePose remainder;  ///< ... what is left grows from nothing; in the first keyframe
    [[nodiscard]] RelativePose of(RelativePose T_cam_keyframe) const;
  };
  [[nodiscard]] Bend bend_after(const WindowKeyframe& keyframe, const LocalMap& map) const;
  void settle_frames(const WindowKeyframe& keyframe, const LocalMap& map, Settled& settled);
  struct Waiting {
    std::size_t frame;
    std::size_t keyframe;
    RelativePose T_cam_keyframe;
  };
  std::deque<Waiting> frames_;
  std::map<std::size_t, Note> notes_;
  std::optional<RelativePose> T_last_map_;  ///< of the keyframe settled last, in this segment
  std::size_t last_segment_ = 0;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 6> constraint_ = Eigen::Matrix<double, 6, 6>::Zero();
};

}  // namespace oneac
