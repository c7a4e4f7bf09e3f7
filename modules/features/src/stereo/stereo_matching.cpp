#include "oneac/features/stereo_matching.h"

#include "oneac/base/require.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace oneac {
namespace {

constexpr int kIterations = 10;        // of the last alignment; most take three
constexpr double kConverged = 0.01;    // [px]
constexpr double kFarthestStep = 1.5;  // [px] from the whole disparity: beyond it, another maximum
constexpr double kWayBack = 1.0;       // [px] the way back may end so far from the start
// [px] least 1σ: bilinear interpolation and what rectification leaves.
constexpr double kLeastSigma = 0.1;
// [grey levels] least standard deviation of a patch that can be found again.
constexpr double kLeastContrast = 3.0;

/// A square of grey values, mean removed, unit norm.
struct Patch {
  std::vector<float> values;
  double norm = 0.0;
};

struct Square {
  int u, v, radius;

  [[nodiscard]] bool is_inside(const ImageView& image) const {
    return u - radius >= 1 && v - radius >= 1 && u + radius < image.width - 1 &&
           v + radius < image.height - 1;
  }
  [[nodiscard]] int area() const { return (2 * radius + 1) * (2 * radius + 1); }
};

int at(const ImageView& image, int u, int v) {
  return image.data[static_cast<std::ptrdiff_t>(v) * image.stride + u];
}

std::optional<Patch> cut(const ImageView& image, const Square& square) {
  Patch patch;
  patch.values.reserve(static_cast<std::size_t>(square.area()));
  double sum = 0.0, squares = 0.0;
  for (int v = square.v - square.radius; v <= square.v + square.radius; ++v) {
    for (int u = square.u - square.radius; u <= square.u + square.radius; ++u) {
      const int grey = at(image, u, v);
      patch.values.push_back(static_cast<float>(grey));
      sum += grey;
      squares += grey * grey;
    }
  }
  const double mean = sum / square.area();
  patch.norm = std::sqrt(std::max(squares - mean * sum, 0.0));
  if (patch.norm < kLeastContrast * std::sqrt(square.area())) return std::nullopt;
  for (float& value : patch.values) value -= static_cast<float>(mean);
  return patch;
}

/// Zero-mean normalised cross-correlation with a square of the other image; −1 for a blank one.
double correlation(const Patch& patch, const ImageView& image, const Square& square) {
  int sum = 0, squares = 0;
  float product = 0.0F;
  std::size_t i = 0;
  for (int v = square.v - square.radius; v <= square.v + square.radius; ++v) {
    for (int u = square.u - square.radius; u <= square.u + square.radius; ++u) {
      const int grey = at(image, u, v);
      sum += grey;
      squares += grey * grey;
      product += patch.values[i++] * static_cast<float>(grey);
    }
  }
  const double variance = squares - static_cast<double>(sum) * sum / square.area();
  return variance > 0.0 ? static_cast<double>(product) / (patch.norm * std::sqrt(variance)) : -1.0;
}

/// Where on its row the patch lies in the other image: the best of `first` … `last`, when no place
/// more than two pixels away is nearly as good.
std::optional<int> search_row(const Patch& patch, const ImageView& image, const Square& start,
                              int first, int last, const StereoMatchOptions& options) {
  std::vector<double> scores;
  for (int u = first; u <= last; ++u) {
    const Square here{u, start.v, start.radius};
    scores.push_back(here.is_inside(image) ? correlation(patch, image, here) : -1.0);
  }
  if (scores.empty()) return std::nullopt;
  const auto best = std::max_element(scores.begin(), scores.end());
  if (*best < options.min_zncc) return std::nullopt;
  for (auto other = scores.begin(); other != scores.end(); ++other) {
    if (std::abs(other - best) > 2 && *other > options.max_rival * *best) return std::nullopt;
  }
  return first + static_cast<int>(best - scores.begin());
}

struct Sample {
  double grey, du, dv;
};

/// Bilinear grey value with its gradient.
Sample sample(const ImageView& image, double u, double v) {
  const int u0 = static_cast<int>(std::floor(u)), v0 = static_cast<int>(std::floor(v));
  const double a = u - u0, b = v - v0;
  const double p00 = at(image, u0, v0), p10 = at(image, u0 + 1, v0);
  const double p01 = at(image, u0, v0 + 1), p11 = at(image, u0 + 1, v0 + 1);
  const double top = p00 + a * (p10 - p00), bottom = p01 + a * (p11 - p01);
  return {top + b * (bottom - top), (1.0 - b) * (p10 - p00) + b * (p11 - p01), bottom - top};
}

/// Place of the patch in the other image and 1σ along the row.
struct Place {
  double u, v, sigma_u;
};

/// Normal equations of (du, dv, gain, bias) of the patch at a place.
struct Equations {
  Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
  Eigen::Vector4d g = Eigen::Vector4d::Zero();
  double squares = 0.0;
};

Equations equations_at(const ImageView& left, const Square& from, const ImageView& right,
                       const Place& at_place, const Eigen::Vector2d& gain_bias) {
  Equations equations;
  for (int y = -from.radius; y <= from.radius; ++y) {
    for (int x = -from.radius; x <= from.radius; ++x) {
      const Sample s = sample(right, at_place.u + x, at_place.v + y);
      const double grey = at(left, from.u + x, from.v + y);
      const double residual = gain_bias(0) * grey + gain_bias(1) - s.grey;
      const Eigen::Vector4d row(s.du, s.dv, -grey, -1.0);
      equations.H += row * row.transpose();
      equations.g += row * residual;
      equations.squares += residual * residual;
    }
  }
  return equations;
}

std::optional<Place> align(const ImageView& left, const Square& from, const ImageView& right,
                           int start_u) {
  Place place{static_cast<double>(start_u), static_cast<double>(from.v), 0.0};
  Eigen::Vector2d gain_bias(1.0, 0.0);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Square here{static_cast<int>(std::floor(place.u)), static_cast<int>(std::floor(place.v)),
                      from.radius + 1};
    if (!here.is_inside(right)) return std::nullopt;
    const Equations equations = equations_at(left, from, right, place, gain_bias);
    const Eigen::LDLT<Eigen::Matrix4d> factor(equations.H);
    const Eigen::Vector4d step = factor.solve(equations.g);
    if (!step.allFinite()) return std::nullopt;
    place.u += step(0);
    place.v += step(1);
    gain_bias += step.tail<2>();
    if (std::abs(place.u - start_u) > kFarthestStep) return std::nullopt;
    if (step.head<2>().norm() > kConverged) continue;
    const double variance = equations.squares / (from.area() - 4);
    place.sigma_u = std::sqrt(std::max(factor.solve(Eigen::Vector4d::UnitX()).x(), 0.0) * variance);
    return place;
  }
  return std::nullopt;
}

std::optional<Disparity> match_point(const ImageView& left, const ImageView& right,
                                     const Eigen::Vector2d& u, const StereoMatchOptions& options) {
  if (!u.allFinite() || u.cwiseAbs().maxCoeff() > 1e6) return std::nullopt;
  const int farthest = static_cast<int>(options.max_disparity * left.width);
  const Square from{static_cast<int>(std::lround(u.x())), static_cast<int>(std::lround(u.y())),
                    options.radius_px};
  if (!from.is_inside(left)) return std::nullopt;
  const auto patch = cut(left, from);
  if (!patch) return std::nullopt;
  const auto there = search_row(*patch, right, from, from.u - farthest, from.u, options);
  if (!there) return std::nullopt;
  const Square to{*there, from.v, from.radius};
  const auto patch_there = cut(right, to);
  if (!patch_there) return std::nullopt;
  const auto back = search_row(*patch_there, left, to, to.u, to.u + farthest, options);
  if (!back || std::abs(*back - from.u) > kWayBack) return std::nullopt;
  const auto place = align(left, from, right, *there);
  if (!place || std::abs(place->v - from.v) > options.max_row_offset_px) return std::nullopt;
  const double disparity = from.u - place->u;
  if (!(disparity > 0.0)) return std::nullopt;
  return Disparity{disparity, std::max(place->sigma_u, kLeastSigma)};
}

}  // namespace

void StereoMatchOptions::validate() const {
  require(max_disparity > 0.0 && max_disparity < 1.0, "stereo.max_disparity", max_disparity,
          "between 0 and 1");
  require(radius_px >= 2 && radius_px <= 50, "stereo.radius_px", radius_px, "from 2 to 50");
  require(min_zncc > 0.0 && min_zncc < 1.0, "stereo.min_zncc", min_zncc, "between 0 and 1");
  require(max_rival > 0.0 && max_rival <= 1.0, "stereo.max_rival", max_rival, "from 0 to 1");
  require(max_row_offset_px > 0.0, "stereo.max_row_offset_px", max_row_offset_px, "positive");
}

std::vector<std::optional<Disparity>> match_along_rows(const ImageView& left,
                                                       const ImageView& right,
                                                       const std::vector<Eigen::Vector2d>& points,
                                                       const StereoMatchOptions& options) {
  options.validate();
  if (left.width != right.width || left.height != right.height) {
    throw std::invalid_argument("match_along_rows: right image of another size, must be equal");
  }
  std::vector<std::optional<Disparity>> disparities;
  disparities.reserve(points.size());
  for (const Eigen::Vector2d& u : points) {
    disparities.push_back(match_point(left, right, u, options));
  }
  return disparities;
}

}  // namespace oneac
