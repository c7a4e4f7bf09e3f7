#pragma once

#include "oneac/base/image.h"
#include "oneac/test_support/scenes.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace oneac {

/// A random picture of several scales as a function of real coordinates, so that it can be warped
/// without interpolating pixels.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    SceneGenerator scene(seed);
    for (auto& octave : lattice_) {
      octave.resize(kSide * kSide);
      for (double& value : octave) value = scene.uniform(-1.0, 1.0);
    }
  }

  [[nodiscard]] double operator()(double x, double y) const {
    double grey = 120.0;
    for (std::size_t k = 0; k < 3; ++k) grey += kAmplitude[k] * at(k, x / kCell[k], y / kCell[k]);
    return grey;
  }

 private:
  static constexpr std::size_t kSide = 256;
  static constexpr double kCell[3] = {5.0, 11.0, 37.0};        // [px]
  static constexpr double kAmplitude[3] = {28.0, 45.0, 40.0};  // [grey]

  [[nodiscard]] double node(std::size_t k, long column, long row) const {
    const auto c = static_cast<std::size_t>(column & 255), r = static_cast<std::size_t>(row & 255);
    return lattice_[k][r * kSide + c];
  }
  [[nodiscard]] double at(std::size_t k, double x, double y) const {
    const auto column = static_cast<long>(std::floor(x)), row = static_cast<long>(std::floor(y));
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    const double sx = fx * fx * (3.0 - 2.0 * fx), sy = fy * fy * (3.0 - 2.0 * fy);
    const double top = node(k, column, row) * (1.0 - sx) + node(k, column + 1, row) * sx;
    const double bottom = node(k, column, row + 1) * (1.0 - sx) + node(k, column + 1, row + 1) * sx;
    return top * (1.0 - sy) + bottom * sy;
  }

  std::vector<double> lattice_[3];
};

/// How a picture is taken: what the first image shows at u = centre + d is seen at
/// A d / (1 + bend·d) + centre + shift.
struct View {
  int width = 480;
  int height = 360;
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Vector2d bend = Eigen::Vector2d::Zero();  ///< [1/px] perspective
  double gain = 1.0;
  double noise = 0.0;  ///< [grey]
  std::uint64_t seed = 1;

  [[nodiscard]] Eigen::Vector2d centre() const { return {0.5 * width, 0.5 * height}; }
  [[nodiscard]] Eigen::Vector2d map(const Eigen::Vector2d& u) const {
    const Eigen::Vector2d d = u - centre();
    return A * d / (1.0 + bend.dot(d)) + centre() + shift;
  }
  [[nodiscard]] Eigen::Vector2d unmap(const Eigen::Vector2d& u) const {
    const Eigen::Vector2d q = A.inverse() * (u - centre() - shift);
    return q / (1.0 - bend.dot(q)) + centre();
  }
};

[[nodiscard]] inline GreyImage render(const Texture& texture, const View& view) {
  GreyImage image(view.width, view.height);
  SceneGenerator random(view.seed);
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const Eigen::Vector2d source = view.unmap({u, v});
      double grey = view.gain * texture(source.x(), source.y());
      if (view.noise > 0.0) grey += random.normal(view.noise);
      image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return image;
}

[[nodiscard]] inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace oneac
