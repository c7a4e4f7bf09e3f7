#include "face_rasteriser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace oneac::simulation {
namespace {

constexpr std::size_t kMostFaces = FaceRasteriser::kSky - 1;

/// value + slope · u ≥ 0 as bounds on u.
struct Span {
  double low;
  double high;

  void require(double value, double slope) {
    if (slope > 0.0) {
      low = std::max(low, -value / slope);
    } else if (slope < 0.0) {
      high = std::min(high, -value / slope);
    } else if (value < 0.0) {
      high = -std::numeric_limits<double>::infinity();
    }
  }
};

Face side(const Box& box, int index, int axis, bool upper) {
  Face face;
  face.axis = axis;
  face.offset = upper ? box.high[axis] : box.low[axis];
  face.low << box.low[face.first()], box.low[face.second()];
  face.high << box.high[face.first()], box.high[face.second()];
  face.box = index;
  face.upper = upper;
  return face;
}

Face ground() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Face face;
  face.low.setConstant(-kInfinity);
  face.high.setConstant(kInfinity);
  return face;
}

}  // namespace

RayFan::RayFan(const PinholeCamera& camera, const Eigen::Isometry3d& T_world_cam)
    : centre(T_world_cam.translation()),
      du(T_world_cam.linear().col(0) / camera.fx),
      dv(T_world_cam.linear().col(1) / camera.fy) {
  origin = T_world_cam.linear().col(2) - camera.cx * du - camera.cy * dv;
}

std::vector<Face> faces_towards(const std::vector<Box>& boxes, const Eigen::Vector3d& centre,
                                double range_m) {
  std::vector<Face> faces{ground()};
  for (std::size_t i = 0; i < boxes.size() && faces.size() + 3 < kMostFaces; ++i) {
    const Box& box = boxes[i];
    const Eigen::Vector3d nearest = centre.cwiseMax(box.low).cwiseMin(box.high);
    if ((nearest - centre).norm() > range_m) continue;
    for (int axis = 0; axis < 3; ++axis) {
      if (centre[axis] > box.high[axis])
        faces.push_back(side(box, static_cast<int>(i), axis, true));
      if (centre[axis] < box.low[axis])
        faces.push_back(side(box, static_cast<int>(i), axis, false));
    }
  }
  return faces;
}

FaceRasteriser::FaceRasteriser(const RayFan& fan, const std::vector<Face>& faces, int width,
                               int height)
    : columns_(width * kPerSide), rows_(height * kPerSide) {
  ids_.assign(index(0, rows_), kSky);
  inverse_depths_.assign(ids_.size(), static_cast<float>(1.0 / kFarthest_m));
  for (std::size_t i = 0; i < faces.size(); ++i) draw(fan, faces[i], static_cast<std::uint16_t>(i));
}

// Along a row the inverse depth w and the distances to the four borders (times w) are affine in u.
void FaceRasteriser::draw(const RayFan& fan, const Face& face, std::uint16_t id) {
  const double plane = face.offset - fan.centre[face.axis];
  if (plane == 0.0) return;
  const double slope = fan.du[face.axis] / plane;
  const std::array<int, 2> across{face.first(), face.second()};
  for (int j = 0; j < rows_; ++j) {
    const Eigen::Vector3d ray = fan.ray(0.0, pixel(j));
    const double at_zero = ray[face.axis] / plane;
    Span span{pixel(0), pixel(columns_ - 1)};
    span.require(at_zero - 1.0 / kFarthest_m, slope);
    for (int k = 0; k < 2; ++k) {
      const int axis = across[static_cast<std::size_t>(k)];
      if (!std::isfinite(face.low[k])) continue;
      const double low = face.low[k] - fan.centre[axis];
      const double high = face.high[k] - fan.centre[axis];
      span.require(ray[axis] - low * at_zero, fan.du[axis] - low * slope);
      span.require(high * at_zero - ray[axis], high * slope - fan.du[axis]);
    }
    if (!(span.low <= span.high)) continue;
    const int begin = static_cast<int>(std::ceil((span.low + 0.5) * kPerSide - 0.5));
    const int end = static_cast<int>(std::floor((span.high + 0.5) * kPerSide - 0.5));
    for (int i = begin; i <= end; ++i) {
      const auto w = static_cast<float>(at_zero + slope * pixel(i));
      float& nearest = inverse_depths_[index(i, j)];
      if (w <= nearest) continue;
      nearest = w;
      ids_[index(i, j)] = id;
    }
  }
}

}  // namespace oneac::simulation
