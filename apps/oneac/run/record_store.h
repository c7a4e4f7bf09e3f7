#pragma once

#include "oneac/base/spooled_vector.h"
#include "oneac/frontend/frame_result.h"
#include "oneac/frontend/keyframe.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace oneac::app {

/// What a record keeps of a frame: all but `settled` and the step's `fault`.
struct FrameFields {
  template <class Archive, class Frame>
  static void visit(Archive& archive, Frame& frame) {
    archive(frame.index);
    archive(frame.time_s);
    archive.array(frame.T_first_cam.data(), 16);
    archive.array(frame.T_odom_cam.data(), 16);
    archive(frame.rescaled);
    archive(frame.tilt);
    archive(frame.suspension);
    archive(frame.keyframe);
    visit_step(archive, frame.step);
  }

 private:
  template <class Archive, class Step>
  static void visit_step(Archive& archive, Step& step) {
    bool is_there = step.has_value();
    archive(is_there);
    StepResult other;
    set_there(step, is_there);
    if (is_there) {
      visit_fields(archive, *step);
    } else {
      visit_fields(archive, other);  // every frame takes as much
    }
  }
  static void set_there(std::optional<StepResult>& step, bool is_there) {
    if (is_there && !step) step.emplace();
    if (!is_there) step.reset();
  }
  static void set_there(const std::optional<StepResult>&, bool) {}
  template <class Archive, class Step>
  static void visit_fields(Archive& archive, Step& step) {
    archive(step.index1);
    archive(step.index2);
    archive(step.time1);
    archive(step.time2);
    archive(step.status);
    archive.array(step.pose.R.data(), 9);
    archive.array(step.pose.t.data(), 3);
    archive(step.metric);
    archive(step.repeats_image);
    archive(step.length);
    archive(step.length_sigma);
    archive(step.camera_doubt);
    archive.array(step.covariance.data(), 36);
    archive(step.acs);
    archive(step.inliers);
    archive(step.ground_acs);
    archive(step.landmarks);
    archive(step.segment);
    archive(step.features_ms);
    archive(step.estimate_ms);
    archive(step.refine_ms);
  }
};

using FrameStore = SpooledVector<FrameResult, FrameFields>;

/// [m, or units without scale] along the frames.
[[nodiscard]] double way_along(const FrameStore& frames);

/// The keyframes of a drive, in order, with what each has settled of the map.
class KeyframeStore {
 public:
  /// @param folder  see Spool
  explicit KeyframeStore(const std::filesystem::path& folder = {})
      : heads_(folder), points_(folder) {}

  [[nodiscard]] std::size_t size() const { return heads_.size(); }
  [[nodiscard]] bool empty() const { return heads_.empty(); }
  /// The keyframe without its points.
  /// @throws as SpooledVector
  [[nodiscard]] Keyframe operator[](std::size_t i) const { return heads_[i].keyframe; }
  /// Its points. @throws as SpooledVector
  [[nodiscard]] std::vector<MapPoint> points(std::size_t i) const;
  /// Of all keyframes.
  [[nodiscard]] std::size_t count_points() const { return points_.size(); }
  /// The first keyframe with a number above that of the frame; size() where there is none.
  [[nodiscard]] std::size_t first_behind(std::size_t frame) const;

  void push_back(const Keyframe& keyframe);
  /// Lengths are metres where they were and `still` holds.
  void keep_metric(bool still);

 private:
  struct Head {
    Keyframe keyframe;  ///< without points
    std::size_t first_point = 0, points = 0;
  };
  struct HeadFields {
    template <class Archive, class Value>
    static void visit(Archive& archive, Value& head) {
      auto& keyframe = head.keyframe;
      archive(keyframe.id);
      archive(keyframe.frame);
      archive(keyframe.index);
      archive(keyframe.time_s);
      archive(keyframe.segment);
      archive.array(keyframe.T_first_cam.data(), 16);
      archive(keyframe.metric);
      archive.array(keyframe.information.data(), 36);
      archive(head.first_point);
      archive(head.points);
    }
  };
  struct PointFields {
    template <class Archive, class Point>
    static void visit(Archive& archive, Point& point) {
      archive.array(point.position.data(), 3);
      archive.array(point.normal.data(), 3);
      archive(point.grey);
      archive(point.views);
    }
  };

  SpooledVector<Head, HeadFields> heads_;
  SpooledVector<MapPoint, PointFields> points_;
};

}  // namespace oneac::app
