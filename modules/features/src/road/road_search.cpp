#include "road_search.h"

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

// Samples of a block per independent one: neighbours along a line see the same grain.
constexpr double kSamplesPerFact = 12.0;
// Beyond it a block proves nothing more: one lane mark shall not outvote the asphalt.
constexpr double kMostRho = 0.9;
// [-] of the samples of a line or a block, that must be seen to compare it.
constexpr int kLeastOfLine = kRows / 2;
constexpr int kLeastOfBlock = kPerBlock / 4;

/// Sums of pairs of grey values along a line; k counts its samples.
struct LineMoments {
  float n = 0, k = 0, kk = 0, t = 0, w = 0, tt = 0, ww = 0, tw = 0, tk = 0, wk = 0;

  void add(float place, float grey_t, float grey_w) {
    n += 1.0F;
    k += place;
    kk += place * place;
    t += grey_t;
    w += grey_w;
    tt += grey_t * grey_t;
    ww += grey_w * grey_w;
    tw += grey_t * grey_w;
    tk += grey_t * place;
    wk += grey_w * place;
  }
};

/// Sums over the lines of a block, each about its own straight line.
struct Moments {
  float n = 0, tt = 0, ww = 0, tw = 0;

  void add_line(const LineMoments& line) {
    if (line.n < static_cast<float>(kLeastOfLine)) return;
    const float kk = line.kk - line.k * line.k / line.n;
    const float tk = line.tk - line.t * line.k / line.n, wk = line.wk - line.w * line.k / line.n;
    n += line.n;
    tt += line.tt - line.t * line.t / line.n - tk * tk / kk;
    ww += line.ww - line.w * line.w / line.n - wk * wk / kk;
    tw += line.tw - line.t * line.w / line.n - tk * wk / kk;
  }
  [[nodiscard]] float rho(float noise_variance, int least) const {
    if (n < static_cast<float>(least)) return 0.0F;
    return tw / std::sqrt((std::max(tt, 0.0F) + n * noise_variance) *
                          (std::max(ww, 0.0F) + n * noise_variance));
  }
};

/// A ray of the template in the image, linear in the length: K (p0 + length p1).
class LineWarp {
 public:
  LineWarp(const RoadContext& context, const RoadMotion& motion, std::size_t level)
      : motion_(motion),
        pixels_(context.image->levels[level]),
        scale_(1.0 / static_cast<double>(1U << level)),
        camera_(context.camera) {}

  /// Pixel of the level; false when outside.
  bool operator()(const Eigen::Vector3d& ray, float& u, float& v) const {
    const Eigen::Vector3d y = motion_.R_b_a * ray;
    const double depth = 1.0 / motion_.n.dot(y);
    const double far = depth * (1.0 + motion_.length * motion_.n.dot(motion_.s));
    const Eigen::Vector3d X = far * y - motion_.length * motion_.s;
    if (!(depth > 0.0) || !(X.z() > 1e-3)) return false;
    const double inverse = scale_ / X.z();
    const double x = camera_.fx * X.x() * inverse + camera_.cx * scale_;
    const double w = camera_.fy * X.y() * inverse + camera_.cy * scale_;
    if (!inside_level(pixels_, x, w)) return false;
    u = static_cast<float>(x);
    v = static_cast<float>(w);
    return true;
  }

 private:
  RoadMotion motion_;
  const PyramidLevel& pixels_;
  double scale_;
  PinholeCamera camera_;
};

/// Grey values are taken about a middle one, for the sake of single precision.
constexpr float kMiddleGrey = 100.0F;

LineMoments moments_of_line(const RoadGrid& grid, const std::vector<float>& values,
                            const PyramidLevel& pixels, const LineWarp& warp, std::size_t first) {
  LineMoments line;
  for (std::size_t i = first; i < first + kRows; ++i) {
    float u = 0, v = 0;
    if (!grid.usable[i] || !warp(grid.rays[i], u, v)) continue;
    line.add(static_cast<float>(i - first), values[i] - kMiddleGrey,
             grey_at(pixels, u, v) - kMiddleGrey);
  }
  return line;
}

bool is_peak(const std::vector<RoadScore>& scores, std::size_t i) {
  const double here = scores[i].evidence;
  const bool left = i == 0 || scores[i - 1].evidence < here;
  const bool right = i + 1 == scores.size() || scores[i + 1].evidence <= here;
  return here > 0.0 && left && right;
}

}  // namespace

std::array<bool, kBlocks> textured_blocks(const RoadGrid& grid, const std::vector<float>& values,
                                          double noise_grey) {
  std::array<bool, kBlocks> textured{};
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Moments sum;
    for (std::size_t column = 0; column < kColumns; ++column) {
      LineMoments line;
      const std::size_t first = block * kPerBlock + column * kRows;
      for (std::size_t i = first; i < first + kRows; ++i) {
        const float grey = values[i] - kMiddleGrey;
        if (grid.usable[i]) line.add(static_cast<float>(i - first), grey, grey);
      }
      sum.add_line(line);
    }
    textured[block] = sum.n >= kLeastOfBlock && sum.tt > sum.n * noise_grey * noise_grey;
  }
  return textured;
}

RoadScore score_length(const RoadContext& context, const RoadGrid& grid,
                       const RoadLook<float>& look, const RoadMotion& motion) {
  const PyramidLevel& pixels = context.image->levels[look.level];
  const LineWarp warp(context, motion, look.level);
  const auto noise = static_cast<float>(look.noise_grey * look.noise_grey);
  RoadScore score;
  score.length = motion.length;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Moments sum;
    for (int column = 0; column < kColumns; column += look.stride) {
      const std::size_t first = block * kPerBlock + static_cast<std::size_t>(column * kRows);
      sum.add_line(moments_of_line(grid, look.values, pixels, warp, first));
    }
    const float rho = sum.rho(noise, kLeastOfBlock / look.stride);
    score.rho[block] = rho;
    const double sure = std::clamp(static_cast<double>(rho), 0.0, kMostRho);
    score.evidence -= 0.5 * look.stride * sum.n / kSamplesPerFact * std::log1p(-sure * sure);
  }
  return score;
}

std::vector<RoadScore> search_lengths(const RoadContext& context, const RoadGrid& grid,
                                      const RoadLook<float>& look, const RoadMotion& motion,
                                      const LengthRange& range, std::size_t most) {
  const int count = 1 + static_cast<int>(std::ceil((range.high - range.low) / range.step));
  std::vector<RoadScore> scores(static_cast<std::size_t>(count));
  context.workers->share(scores.size(), [&](std::size_t i, std::size_t) {
    RoadMotion at = motion;
    at.length = range.low + static_cast<double>(i) * range.step;
    scores[i] = score_length(context, grid, look, at);
  });
  std::vector<RoadScore> peaks;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (is_peak(scores, i)) peaks.push_back(scores[i]);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const RoadScore& a, const RoadScore& b) { return a.evidence > b.evidence; });
  if (peaks.size() > most) peaks.resize(most);
  return peaks;
}

}  // namespace oneac::internal
