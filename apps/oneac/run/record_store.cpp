#include "record_store.h"

namespace oneac::app {

double way_along(const FrameStore& frames) {
  double length = 0.0;
  std::optional<Eigen::Vector3d> before;
  for (const FrameResult& frame : frames) {
    const Eigen::Vector3d now = frame.T_first_cam.translation();
    if (before) length += (now - *before).norm();
    before = now;
  }
  return length;
}

std::vector<MapPoint> KeyframeStore::points(std::size_t i) const {
  const Head head = heads_[i];
  std::vector<MapPoint> points;
  points.reserve(head.points);
  for (std::size_t k = 0; k < head.points; ++k) points.push_back(points_[head.first_point + k]);
  return points;
}

std::size_t KeyframeStore::first_behind(std::size_t frame) const {
  std::size_t begin = 0, end = size();
  while (begin < end) {
    const std::size_t middle = begin + (end - begin) / 2;
    if (heads_[middle].keyframe.frame > frame) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  return begin;
}

void KeyframeStore::push_back(const Keyframe& keyframe) {
  Head head{keyframe, points_.size(), keyframe.points.size()};
  head.keyframe.points.clear();
  heads_.push_back(head);
  for (const MapPoint& point : keyframe.points) points_.push_back(point);
}

void KeyframeStore::keep_metric(bool still) {
  if (still) return;
  heads_.change_all([](Head& head) { head.keyframe.metric = false; });
}

}  // namespace oneac::app
