#include "canvas.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

int wrapped(int i, int size) {
  if (i >= 0 && i < size) return i;
  const int r = i % size;
  return r < 0 ? r + size : r;
}

/// Share of [cell, cell + 1) inside [from, to).
double overlap(int cell, double from, double to) {
  return std::clamp(std::min(to, cell + 1.0) - std::max(from, static_cast<double>(cell)), 0.0, 1.0);
}

}  // namespace

Canvas::Canvas(int width, int height, float value)
    : width_(width),
      height_(height),
      values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

std::size_t Canvas::index(int u, int v) const {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(u);
}

void Canvas::mix(int u, int v, float value, float opacity) {
  float& texel = values_[index(wrapped(u, width_), wrapped(v, height_))];
  texel += opacity * (value - texel);
}

void Canvas::rectangle(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double value,
                       double opacity) {
  const int u_end = static_cast<int>(std::ceil(to.x()));
  const int v_end = static_cast<int>(std::ceil(to.y()));
  for (int v = static_cast<int>(std::floor(from.y())); v < v_end; ++v) {
    const double in_v = opacity * overlap(v, from.y(), to.y());
    for (int u = static_cast<int>(std::floor(from.x())); u < u_end; ++u) {
      const double covered = in_v * overlap(u, from.x(), to.x());
      mix(u, v, static_cast<float>(value), static_cast<float>(covered));
    }
  }
}

void Canvas::ellipse(const Ellipse& shape, double value, double opacity) {
  const double c = std::cos(shape.angle);
  const double s = std::sin(shape.angle);
  const double reach_u = std::hypot(c * shape.radii.x(), s * shape.radii.y()) + 1.0;
  const double reach_v = std::hypot(s * shape.radii.x(), c * shape.radii.y()) + 1.0;
  const double softness = shape.radii.minCoeff();  // texels per unit of the normalised radius
  const double outside = (1.0 + 0.5 / softness) * (1.0 + 0.5 / softness);
  const int u_end = static_cast<int>(std::ceil(shape.centre.x() + reach_u));
  const int v_end = static_cast<int>(std::ceil(shape.centre.y() + reach_v));
  for (int v = static_cast<int>(std::floor(shape.centre.y() - reach_v)); v < v_end; ++v) {
    const double dv = v + 0.5 - shape.centre.y();
    for (int u = static_cast<int>(std::floor(shape.centre.x() - reach_u)); u < u_end; ++u) {
      const double du = u + 0.5 - shape.centre.x();
      const double a = (c * du + s * dv) / shape.radii.x();
      const double b = (c * dv - s * du) / shape.radii.y();
      const double squared = a * a + b * b;
      if (squared >= outside) continue;
      const double covered = 0.5 + (1.0 - std::sqrt(squared)) * softness;
      mix(u, v, static_cast<float>(value), static_cast<float>(opacity * std::min(1.0, covered)));
    }
  }
}

void Canvas::crack(RandomNumbers& random, int segments, double width, double value) {
  Eigen::Vector2d at{random.uniform(0.0, width_), random.uniform(0.0, height_)};
  double angle = random.uniform(0.0, 6.28);
  for (int i = 0; i < segments; ++i) {
    const double length = random.uniform(4.0, 14.0);
    const Eigen::Vector2d ahead(std::cos(angle), std::sin(angle));
    ellipse({at + 0.5 * length * ahead, {0.6 * length, width}, angle}, value, 0.8);
    at += length * ahead;
    angle += 0.5 * random.normal();
  }
}

void Canvas::dead_leaves(RandomNumbers& random, const Leaves& leaves) {
  const double area = static_cast<double>(width_) * height_;
  double high = leaves.largest;
  while (high > leaves.smallest) {
    const double low = std::max(0.5 * high, leaves.smallest);
    const double mean_area =
        3.14 * 0.7 * 0.5625 * high * high;  // of radii in [high/2, high], squashed
    const int count = static_cast<int>(leaves.coverage * area / mean_area);
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d centre{random.uniform(0.0, width_), random.uniform(0.0, height_)};
      const double radius = random.uniform(low, high);
      const Eigen::Vector2d radii{radius, radius * random.uniform(0.4, 1.0)};
      const double value = at(static_cast<int>(centre.x()), static_cast<int>(centre.y())) +
                           leaves.contrast * random.normal();
      const double opacity = random.uniform(0.5, 1.0);
      if (random.chance(leaves.angular)) {
        rectangle(centre - radii, centre + radii, value, opacity);
      } else {
        ellipse({centre, radii, random.uniform(0.0, 3.14)}, value, opacity);
      }
    }
    high *= 0.5;
  }
}

void Canvas::grain(RandomNumbers& random, double sigma) {
  for (float& value : values_) value += static_cast<float>(sigma * random.normal());
}

}  // namespace oneac::simulation
