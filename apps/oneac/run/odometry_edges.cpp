#include "odometry_edges.h"

#include "oneac/frontend/map_formats.h"
#include "oneac/loops/loop_keyframe.h"

#include <ostream>

namespace oneac::app {
StepTo steps_of(const DriveRecord& record) {
  return [&record](std::size_t frame) { return record.frames.at(frame).step; };
}

Keyframe keyframe_by_steps(const DriveRecord& record, std::size_t i) {
  const Keyframe keyframe = record.keyframes[i];
  LoopKeyframe edge;
  if (i > 0)
    edge.covariance = covariance_between(record.keyframes[i - 1], keyframe, steps_of(record));
  Keyframe link;
  link.id = keyframe.id;
  link.T_first_cam = keyframe.T_first_cam;
  link.information = g2o_information(edge);
  return link;
}

std::vector<Keyframe> keyframes_by_steps(const DriveRecord& record) {
  std::vector<Keyframe> chain;
  for (std::size_t i = 0; i < record.keyframes.size(); ++i) {
    chain.push_back(keyframe_by_steps(record, i));
  }
  return chain;
}

void write_graph(const DriveRecord& record, std::ostream& out) {
  const std::size_t count = record.keyframes.size();
  for (std::size_t i = 0; i < count; ++i) out << g2o_vertex_line(record.keyframes[i]);
  for (std::size_t i = 1; i < count; ++i) {
    out << g2o_edge_line(record.keyframes[i - 1], keyframe_by_steps(record, i));
  }
}

}  // namespace oneac::app
