#include "oneac/frontend/map_formats.h"

#include "oneac/base/number_text.h"

#include <cstddef>
#include <ostream>

namespace oneac {
namespace {

template <class Number>
void append(std::string& text, Number value) {
  text += ' ' + exact_text(value);
}

template <class Number>
void append(std::string& text, const Eigen::Matrix<Number, 3, 1>& v) {
  for (int i = 0; i < 3; ++i) append(text, v(i));
}

void append(std::string& text, const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  append(text, Eigen::Vector3d(T.translation()));
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) append(text, sign * value);
}

}  // namespace

std::string g2o_vertex_line(const Keyframe& keyframe) {
  std::string line = "VERTEX_SE3:QUAT " + std::to_string(keyframe.id);
  append(line, keyframe.T_first_cam);
  return line + '\n';
}

std::string g2o_edge_line(const Keyframe& before, const Keyframe& now) {
  std::string line = "EDGE_SE3:QUAT " + std::to_string(before.id) + ' ' + std::to_string(now.id);
  append(line, before.T_first_cam.inverse() * now.T_first_cam);
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) append(line, now.information(row, column));
  }
  return line + '\n';
}

std::string format_g2o(const std::vector<Keyframe>& keyframes) {
  std::string text;
  for (const Keyframe& keyframe : keyframes) text += g2o_vertex_line(keyframe);
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    text += g2o_edge_line(keyframes[i - 1], keyframes[i]);
  }
  return text;
}

void write_ply_header(std::size_t points, std::ostream& out) {
  out << "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points) + '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
    out << "property float " << name << '\n';
  }
  for (const char* name : {"red", "green", "blue"}) out << "property uchar " << name << '\n';
  out << "end_header\n";
}

void write_ply_points(const std::vector<MapPoint>& points, std::ostream& out) {
  for (const MapPoint& point : points) {
    std::string line;
    append(line, point.position);
    append(line, point.normal);
    const std::string grey = ' ' + std::to_string(point.grey);
    out << line.substr(1) << grey << grey << grey << '\n';
  }
}

void write_ply(const std::vector<Keyframe>& keyframes, std::ostream& out) {
  std::size_t count = 0;
  for (const Keyframe& keyframe : keyframes) count += keyframe.points.size();
  write_ply_header(count, out);
  for (const Keyframe& keyframe : keyframes) write_ply_points(keyframe.points, out);
}

}  // namespace oneac
