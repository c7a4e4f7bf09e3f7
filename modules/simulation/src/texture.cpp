#include "texture.h"

#include <algorithm>
#include <cmath>

namespace oneac::simulation {
namespace {

constexpr int kMostTaps = 12;  // grazing views beyond 12:1 are blurred across, never aliased

std::size_t at(int u, int v, int width) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(u);
}

/// Floor and fraction, wrapped into [0, size).
struct Cell {
  Cell(float x, int size) {
    low = static_cast<int>(x);
    if (static_cast<float>(low) > x) --low;
    fraction = x - static_cast<float>(low);
    if (low < 0 || low >= size) low = (low % size + size) % size;
    high = low + 1 == size ? 0 : low + 1;
  }
  int low;
  int high;
  float fraction;
};

}  // namespace

Texture::Texture(const Canvas& canvas, double texel_m)
    : texel_m_(texel_m), texels_per_m_(static_cast<float>(1.0 / texel_m)) {
  Level base{canvas.width(), canvas.height(), 1.0F, 1.0F, {}};
  base.texels.resize(at(0, base.height, base.width));
  for (int v = 0; v < base.height; ++v) {
    for (int u = 0; u < base.width; ++u) {
      base.texels[at(u, v, base.width)] =
          static_cast<std::uint8_t>(std::clamp(canvas.at(u, v) + 0.5F, 0.0F, 255.0F));
    }
  }
  levels_.push_back(std::move(base));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(halved(levels_.back()));
    Level& level = levels_.back();
    level.u_scale = static_cast<float>(level.width) / static_cast<float>(canvas.width());
    level.v_scale = static_cast<float>(level.height) / static_cast<float>(canvas.height());
  }
}

Texture::Level Texture::halved(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), 1.0F, 1.0F, {}};
  coarse.texels.resize(at(0, coarse.height, coarse.width));
  // An odd side is stretched over: its last texel is shared by the last two cells.
  const auto source = [](int i, int from, int to) { return std::min(i * from / to, from - 1); };
  for (int v = 0; v < coarse.height; ++v) {
    const int v0 = source(v, fine.height, coarse.height);
    const int v1 = std::min(v0 + 1, fine.height - 1);
    for (int u = 0; u < coarse.width; ++u) {
      const int u0 = source(u, fine.width, coarse.width);
      const int u1 = std::min(u0 + 1, fine.width - 1);
      const int sum = fine.texels[at(u0, v0, fine.width)] + fine.texels[at(u1, v0, fine.width)] +
                      fine.texels[at(u0, v1, fine.width)] + fine.texels[at(u1, v1, fine.width)];
      coarse.texels[at(u, v, coarse.width)] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  }
  return coarse;
}

float Texture::Level::bilinear(const Eigen::Vector2f& position) const {
  // Texel centres lie at halves on every level.
  const Cell u(position.x() * u_scale - 0.5F, width);
  const Cell v(position.y() * v_scale - 0.5F, height);
  const std::uint8_t* upper = &texels[at(0, v.low, width)];
  const std::uint8_t* lower = &texels[at(0, v.high, width)];
  const auto mixed = [&u](const std::uint8_t* row) {
    const auto low = static_cast<float>(row[u.low]);
    return low + u.fraction * (static_cast<float>(row[u.high]) - low);
  };
  const float top = mixed(upper);
  return top + v.fraction * (mixed(lower) - top);
}

/// Where to read for a footprint, in texels of the finest level.
struct Texture::Taps {
  int count;
  Eigen::Vector2f first;
  Eigen::Vector2f step;
  float level;
};

Texture::Taps Texture::taps(const Footprint& footprint) const {
  const Eigen::Vector2f a = texels_per_m_ * footprint.right;
  const Eigen::Vector2f b = texels_per_m_ * footprint.down;
  // Axes of the ellipse that the unit circle of pixel steps maps to: eigenvectors of aaᵀ + bbᵀ.
  const float xx = a.x() * a.x() + b.x() * b.x();
  const float xy = a.x() * a.y() + b.x() * b.y();
  const float yy = a.y() * a.y() + b.y() * b.y();
  const float centre = 0.5F * (xx + yy);
  const float spread = std::sqrt(0.25F * (xx - yy) * (xx - yy) + xy * xy);
  const float longer = std::sqrt(centre + spread);
  const float shorter = std::max(std::sqrt(std::max(centre - spread, 0.0F)), 1.0F);
  Taps taps{};
  // Taps may lie a little farther apart than they are wide: trilinear reading overlaps anyway.
  constexpr float kSpacing = 1.25F;
  taps.count = std::clamp(static_cast<int>(std::ceil(longer / (kSpacing * shorter))), 1, kMostTaps);
  const float width = std::max(shorter, longer / static_cast<float>(taps.count) / kSpacing);
  taps.level = std::min(std::log2(width), static_cast<float>(levels_.size() - 1));
  Eigen::Vector2f axis(xy, centre + spread - xx);
  if (axis.squaredNorm() < 1e-12F * centre * centre) {
    axis = xx >= yy ? Eigen::Vector2f(1.0F, 0.0F) : Eigen::Vector2f(0.0F, 1.0F);
  }
  axis *= longer / std::max(axis.norm(), 1e-30F);
  taps.step = axis / static_cast<float>(taps.count);
  taps.first = texels_per_m_ * footprint.centre - 0.5F * (axis - taps.step);
  return taps;
}

float Texture::mean(const Level& level, const Taps& taps) {
  float sum = 0.0F;
  for (int i = 0; i < taps.count; ++i) {
    sum += level.bilinear(taps.first + static_cast<float>(i) * taps.step);
  }
  return sum / static_cast<float>(taps.count);
}

float Texture::sample(const Footprint& footprint) const {
  const Taps where = taps(footprint);
  const auto fine = static_cast<std::size_t>(where.level);
  const float weight = where.level - static_cast<float>(fine);
  const float value = mean(levels_[fine], where);
  if (weight == 0.0F || fine + 1 == levels_.size()) return value;
  return value + weight * (mean(levels_[fine + 1], where) - value);
}

}  // namespace oneac::simulation
