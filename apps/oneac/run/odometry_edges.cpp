#include "odometry_edges.h"

#include "oneac/frontend/map_formats.h"
#include "oneac/loops/loop_keyframe.h"

#include <optional>
#include <ostream>

namespace oneac::app {
namespace {

/// A step as long as it is in the trajectory; one without metres may be of any length.
OdometryStep to_odometry_step(const StepResult& step) {
  OdometryStep out{step.pose, step.covariance};
  if (step.metric || !(step.length > 0.0) || !(step.pose.t.norm() > 0.0)) return out;
  const double factor = step.length / step.pose.t.norm();
  out.T_2_1.t *= factor;
  out.covariance.rightCols<3>() *= factor;
  out.covariance.bottomRows<3>() *= factor;
  out.covariance.bottomRightCorner<3, 3>() += out.T_2_1.t * out.T_2_1.t.transpose();
  return out;
}

}  // namespace

Eigen::Matrix<double, 6, 6> covariance_between(const Keyframe& before, const Keyframe& keyframe,
                                               const DriveRecord& record) {
  std::vector<OdometryStep> steps;
  if (before.segment != keyframe.segment) return covariance_of_steps(steps);
  for (std::size_t i = before.frame + 1; i <= keyframe.frame; ++i) {
    const std::optional<StepResult> step = record.frames.at(i).step;
    if (!step || step->status == StepStatus::kPredicted) return covariance_of_steps({});
    steps.push_back(to_odometry_step(*step));
  }
  return covariance_of_steps(steps);
}

Keyframe keyframe_by_steps(const DriveRecord& record, std::size_t i) {
  const Keyframe keyframe = record.keyframes[i];
  LoopKeyframe edge;
  if (i > 0) edge.covariance = covariance_between(record.keyframes[i - 1], keyframe, record);
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
