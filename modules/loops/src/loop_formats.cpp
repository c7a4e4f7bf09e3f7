#include "oneac/loops/loop_formats.h"

#include "oneac/base/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <initializer_list>

namespace oneac {
namespace {

constexpr int kTimeDecimals = 6;

Eigen::Quaterniond quaternion(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

void append(std::string& text, char separator, std::initializer_list<double> values) {
  for (const double value : values) text += separator + exact_text(value);
}

}  // namespace

std::string format_loops(const std::vector<LoopConstraint>& loops,
                         const std::vector<LoopKeyframe>& keyframes) {
  const bool several =
      std::any_of(keyframes.begin(), keyframes.end(), [](const auto& k) { return k.log > 0; });
  std::string text = "index1,index2,t1,t2,qw,qx,qy,qz,tx,ty,tz,sigma_length,inliers,acs";
  text += several ? ",log1,log2\n" : "\n";
  for (const LoopConstraint& loop : loops) {
    const LoopKeyframe &first = keyframes.at(loop.first), &second = keyframes.at(loop.second);
    text += std::to_string(first.index) + ',' + std::to_string(second.index) + ',' +
            exact_fixed_text(first.time_s, kTimeDecimals) + ',' +
            exact_fixed_text(second.time_s, kTimeDecimals);
    const Eigen::Quaterniond q = quaternion(loop.T_2_1.R);
    const Eigen::Vector3d& t = loop.T_2_1.t;
    append(text, ',', {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z(), loop.sigma_length});
    text += ',' + std::to_string(loop.inliers) + ',' + std::to_string(loop.acs);
    if (several) {
      text += ',' + std::to_string(first.log + 1) + ',' + std::to_string(second.log + 1);
    }
    text += '\n';
  }
  return text;
}

std::string format_g2o_loops(const std::vector<LoopConstraint>& loops,
                             const std::vector<LoopKeyframe>& keyframes) {
  std::string text;
  for (const LoopConstraint& loop : loops) {
    const RelativePose T_1_2 = loop.T_2_1.inverse();
    const Eigen::Quaterniond q = quaternion(T_1_2.R);
    text += "EDGE_SE3:QUAT " + std::to_string(keyframes.at(loop.first).id) + ' ' +
            std::to_string(keyframes.at(loop.second).id);
    append(text, ' ', {T_1_2.t.x(), T_1_2.t.y(), T_1_2.t.z(), q.x(), q.y(), q.z(), q.w()});
    const Eigen::Matrix<double, 6, 6> information = g2o_information(loop);
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) append(text, ' ', {information(row, column)});
    }
    text += '\n';
  }
  return text;
}

}  // namespace oneac
