#include "road_equations.h"

#include "oneac/geometry/relative_pose.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace oneac::internal {
namespace {

constexpr double kHuber = 1.5;  // [σ] of a residual: a stain more or less, not a car
constexpr int kLeastOfLine = kRows / 2;
constexpr int kLeastOfBlock = kPerBlock / 4;
// Residual's derivatives by the unknowns, then by a shift of the block across the road and its
// gain.
constexpr int kShift = kUnknowns, kGain = kUnknowns + 1;
constexpr int kWide = kUnknowns + 2;
using WideVector = Eigen::Matrix<double, kWide, 1>;
using WideMatrix = Eigen::Matrix<double, kWide, kWide>;

/// One line along the road: what is seen at its samples, and the derivatives.
struct Line {
  int count = 0;
  std::array<float, kRows> t{}, w{};          // grey values of template and image
  std::array<Eigen::Vector2f, kRows> dt, dw;  // [grey/px] their gradients
  std::array<Eigen::Vector2d, kRows> ut, uw;  // [px] where
  std::array<double, kRows> moves{};          // [px/height] by the length, up to a factor
  std::array<WideVector, kRows> J;

  /// Direction of the line in an image: a line along the road is seen as one.
  [[nodiscard]] Eigen::Vector2f along(const std::array<Eigen::Vector2d, kRows>& u) const {
    return (u[static_cast<std::size_t>(count) - 1] - u[0]).cast<float>().normalized();
  }
};

/// Derivatives of a ray's grey value in the image.
class Derivative {
 public:
  Derivative(const RoadContext& context, const RoadMotion& motion, const RoadTangents& tangents,
             std::size_t level)
      : motion_(motion),
        tangents_(tangents),
        camera_(context.camera),
        mask_(context.mask),
        pixels_(context.image->levels[level]),
        scale_(1.0 / static_cast<double>(1U << level)),
        c_(1.0 + motion.length * motion.n.dot(motion.s)),
        across_(motion.n.cross(motion.s).normalized()) {}

  bool operator()(const Eigen::Vector3d& ray, GreySample& s, Eigen::Vector2d& u,
                  WideVector& J) const {
    const Eigen::Vector3d y = motion_.R_b_a * ray;
    const double depth = 1.0 / motion_.n.dot(y);
    const Eigen::Vector3d X = depth * c_ * y - motion_.length * motion_.s;
    if (!(depth > 0.0) || !(X.z() > 1e-3)) return false;
    u = camera_.project({X.x() / X.z(), X.y() / X.z()});
    const Eigen::Vector2d there = scale_ * u;
    if (!inside_level(pixels_, there.x() - 1.0, there.y() - 1.0) ||
        !inside_level(pixels_, there.x() + 1.0, there.y() + 1.0) ||
        !unmasked(mask_, u.x(), u.y())) {
      return false;
    }
    s = sample_at(pixels_, static_cast<float>(there.x()), static_cast<float>(there.y()));
    fill(s, y, depth, X, J);
    return true;
  }

 private:
  /// docs/decisions/road-alignment.md, "Derivatives".
  void fill(const GreySample& s, const Eigen::Vector3d& y, double depth, const Eigen::Vector3d& X,
            WideVector& J) const {
    const double inverse = scale_ / X.z();
    const double gx = s.du * camera_.fx * inverse, gy = s.dv * camera_.fy * inverse;
    const Eigen::Vector3d g(gx, gy, -(gx * X.x() + gy * X.y()) / X.z());
    const double a = g.dot(y) * depth;
    const Eigen::Vector3d h = a * motion_.n - g;
    const Eigen::Vector3d by_normal = a * (motion_.length * motion_.s - c_ * depth * y);
    J(0) = h.dot(motion_.s);
    J(1) = by_normal.dot(tangents_.normal.col(0));
    J(2) = by_normal.dot(tangents_.normal.col(1));
    J.segment<3>(3) = X.cross(h);
    J(6) = motion_.length * h.dot(tangents_.travel.col(0));
    J(7) = motion_.length * h.dot(tangents_.travel.col(1));
    J(kShift) = h.dot(across_);
  }

  const RoadMotion& motion_;
  const RoadTangents& tangents_;
  PinholeCamera camera_;
  ImageView mask_;
  const PyramidLevel& pixels_;
  double scale_;
  double c_;
  Eigen::Vector3d across_;
};

void read_line(const RoadGrid& grid, const std::vector<GreySample>& values,
               const Derivative& derivative, std::size_t first, Line& line) {
  line.count = 0;
  GreySample there{};
  for (std::size_t i = first; i < first + kRows; ++i) {
    const auto k = static_cast<std::size_t>(line.count);
    if (!grid.usable[i] || !derivative(grid.rays[i], there, line.uw[k], line.J[k])) continue;
    line.t[k] = values[i].grey;
    line.w[k] = there.grey;
    line.dt[k] = {values[i].du, values[i].dv};
    line.dw[k] = {there.du, there.dv};
    line.ut[k] = grid.u[i];
    line.moves[k] = 1.0 / grid.rays[i].squaredNorm();
    ++line.count;
  }
}

/// Sums over the lines of a block.
struct Sums {
  WideMatrix H = WideMatrix::Zero();
  WideVector g = WideVector::Zero();
  double weights = 0.0, squares = 0.0, tt = 0.0, ww = 0.0, tw = 0.0, lagged = 0.0, plain = 0.0;
  double slopes_tt = 0.0, slopes_ww = 0.0, slopes_tw = 0.0;  // along the road
  int samples = 0;

  /// [-] of the squared slopes along the road: what both images have. The rest is noise.
  [[nodiscard]] double coherence() const {
    const double both = std::sqrt(slopes_tt * slopes_ww);
    return both > 0.0 ? std::clamp(slopes_tw / both, 0.0, 1.0) : 0.0;
  }
};

void add_slopes(const Line& line, Sums& sums) {
  const Eigen::Vector2f along_t = line.along(line.ut), along_w = line.along(line.uw);
  for (std::size_t k = 0; k < static_cast<std::size_t>(line.count); ++k) {
    // A slope tells the more of the length the farther it moves in the image.
    const double t = line.moves[k] * line.dt[k].dot(along_t);
    const double w = line.moves[k] * line.dw[k].dot(along_w);
    sums.slopes_tt += t * t;
    sums.slopes_ww += w * w;
    sums.slopes_tw += t * w;
  }
}

/// Takes mean and slope out of the grey values of a line.
void straighten(const Line& line, std::array<float, kRows>& values) {
  const auto count = static_cast<std::size_t>(line.count);
  const float middle = 0.5F * static_cast<float>(count - 1);
  float mean = 0, slope = 0, kk = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const float place = static_cast<float>(k) - middle;
    mean += values[k];
    slope += place * values[k];
    kk += place * place;
  }
  mean /= static_cast<float>(count);
  slope /= kk;
  for (std::size_t k = 0; k < count; ++k) {
    values[k] -= mean + slope * (static_cast<float>(k) - middle);
  }
}

/// Weighted sums along a line, and what eliminates its bias and its slope.
struct LineSums {
  WideMatrix H = WideMatrix::Zero();
  WideVector g = WideVector::Zero();
  Eigen::Matrix<double, kWide, 2> cross = Eigen::Matrix<double, kWide, 2>::Zero();
  Eigen::Matrix2d regressors = Eigen::Matrix2d::Zero();
  Eigen::Vector2d r = Eigen::Vector2d::Zero();
  double weights = 0.0, squares = 0.0;

  void add(const WideVector& J, double residual, double weight, double place) {
    const Eigen::Vector2d one(weight, weight * place);
    for (int i = 0; i < kWide; ++i) H.col(i).tail(kWide - i) += (weight * J(i)) * J.tail(kWide - i);
    g += weight * residual * J;
    cross += J * one.transpose();
    regressors(0, 0) += weight;
    regressors(1, 0) += weight * place;
    regressors(1, 1) += weight * place * place;
    r += residual * one;
    weights += weight;
    squares += weight * residual * residual;
  }
};

/// Adds a line, its bias and slope eliminated.
void add_line(Line& line, double gain, double scale, Sums& sums) {
  add_slopes(line, sums);
  straighten(line, line.t);
  straighten(line, line.w);
  LineSums here;
  double last = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(line.count); ++k) {
    const double t = line.t[k], w = line.w[k], r = w - gain * t;
    const double weight = scale > 0.0 ? std::min(1.0, kHuber * scale / (std::abs(r) + 1e-9)) : 1.0;
    line.J[k](kGain) = -t;
    here.add(line.J[k], r, weight, static_cast<double>(k) / kRows - 0.5);
    sums.tt += t * t;
    sums.ww += w * w;
    sums.tw += t * w;
    sums.plain += r * r;
    if (k > 0) sums.lagged += r * last;
    last = r;
  }
  here.regressors(0, 1) = here.regressors(1, 0);
  const Eigen::Matrix2d inverse = here.regressors.inverse();
  const Eigen::Matrix<double, kWide, 2> eliminate = here.cross * inverse;
  sums.H += here.H - eliminate * here.cross.transpose();
  sums.g += here.g - eliminate * here.r;
  sums.weights += here.weights;
  sums.squares += here.squares - here.r.dot(inverse * here.r);
  sums.samples += line.count;
}

/// Shift across the road and gain eliminated (Schur complement): what a block sees of edges that
/// only run obliquely is the same by a shift aside as by another length.
void eliminate_own(const Sums& sums, double noise, BlockEquations& block) {
  const WideMatrix H = sums.H.selfadjointView<Eigen::Lower>();
  Eigen::Matrix2d own = H.bottomRightCorner<2, 2>();
  own(0, 0) += 1e-6 * own(0, 0) + 1e-9;
  own(1, 1) += noise;
  const Eigen::Matrix<double, kUnknowns, 2> cross = H.topRightCorner<kUnknowns, 2>();
  const Eigen::Matrix<double, kUnknowns, 2> eliminate = cross * own.inverse();
  block.H = H.topLeftCorner<kUnknowns, kUnknowns>() - eliminate * cross.transpose();
  block.g = sums.g.head<kUnknowns>() - eliminate * sums.g.tail<2>();
}

/// Noise has slopes in every direction, and they would pass for texture that tells the length.
void discount_noise(const Sums& sums, BlockEquations& block) {
  const double of_noise = (1.0 - sums.coherence()) * sums.H(0, 0);
  const double told = block.H(0, 0) > of_noise ? 1.0 - of_noise / block.H(0, 0) : 0.0;
  block.H *= told;
  block.g *= told;
}

/// What a block says, and its statistics.
BlockEquations finish(const Sums& sums, double noise_grey, int stride) {
  BlockEquations block;
  block.samples = sums.samples;
  if (sums.samples < kLeastOfBlock / stride || !(sums.weights > 0.0)) return block;
  const double noise = noise_grey * noise_grey * sums.samples;
  eliminate_own(sums, noise, block);
  discount_noise(sums, block);
  block.weights = sums.weights;
  block.variance = std::max(sums.squares, 0.0) / sums.weights + noise_grey * noise_grey;
  block.gain = std::clamp((sums.tw + noise) / (sums.tt + noise), 0.2, 5.0);
  block.rho = sums.tw / std::sqrt((sums.tt + noise) * (sums.ww + noise));
  block.lag = sums.plain > 0.0 ? sums.lagged / sums.plain : 0.0;
  return block;
}

}  // namespace

RoadMotion moved(const RoadMotion& start, const RoadTangents& tangents, const RoadVector& z) {
  RoadMotion motion;
  const Eigen::Matrix3d turn = rotation_from_vector(-z.segment<3>(3));
  motion.length = start.length + z(0);
  motion.n = (start.n + tangents.normal * z.segment<2>(1)).normalized();
  motion.R_b_a = turn * start.R_b_a;
  motion.s = (turn * (start.s + tangents.travel * z.segment<2>(6))).normalized();
  return motion;
}

RoadEquations road_equations(const RoadContext& context, const RoadGrid& grid,
                             const RoadLook<GreySample>& look, const RoadMotion& motion,
                             const RoadTangents& tangents, const RoadEquations& before) {
  const Derivative derivative(context, motion, tangents, look.level);
  RoadEquations equations;
  context.workers->share(kBlocks, [&](std::size_t block, std::size_t) {
    Line line;
    Sums sums;
    const double gain = before[block].gain;
    const double scale = std::sqrt(before[block].variance);
    for (int column = 0; column < kColumns; column += look.stride) {
      const auto first = block * kPerBlock + static_cast<std::size_t>(column * kRows);
      read_line(grid, look.values, derivative, first, line);
      if (line.count >= kLeastOfLine) add_line(line, gain, scale, sums);
    }
    equations[block] = finish(sums, look.noise_grey, look.stride);
  });
  return equations;
}

}  // namespace oneac::internal
