#include "degeneracy/motion_flow.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace oneac::internal {
namespace {

// Dissent as wide as this share of the picture's spread (variances) is no single body.
constexpr float kWideDissent = 0.6F;

}  // namespace

std::vector<Eigen::Vector2f> residuals(const Eigen::Matrix3d& R, AcSpan acs,
                                       const std::vector<double>& sigmas, double sigma) {
  std::vector<Eigen::Vector2f> all;
  all.reserve(acs.size());
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const Eigen::Vector3d y = R * acs[i].x1.homogeneous();
    if (!(y.z() > 1e-6)) {
      all.emplace_back(100.0F, 100.0F);
      continue;
    }
    const double s = sigmas.empty() ? sigma : sigmas[i];
    all.push_back(((acs[i].x2 - y.head<2>() / y.z()) / s).cast<float>());
  }
  return all;
}

double resting_cost(const std::vector<Eigen::Vector2f>& residuals,
                    const MotionEvidenceOptions& options) {
  const auto outlier = static_cast<float>(options.outlier_cost);
  float sum = 0.0F;
  for (const Eigen::Vector2f& r : residuals) sum += std::min(0.5F * r.squaredNorm(), outlier);
  return sum;
}

std::vector<Flow> flows(const RelativePose& pose, AcSpan acs, const std::vector<double>& sigmas,
                        const Eigen::Matrix3d& R_level_cam, double sigma) {
  const Eigen::RowVector3d down = R_level_cam.row(1);
  const Eigen::Vector2d t = pose.t.head<2>();
  const double tz = pose.t.z();
  std::vector<Flow> all;
  all.reserve(acs.size());
  for (std::size_t i = 0; i < acs.size(); ++i) {
    const AffineCorrespondence& ac = acs[i];
    const Eigen::Vector3d y = pose.R * ac.x1.homogeneous();
    const Eigen::Vector2d g = t - ac.x2 * tz;  // y_z r = |t| / depth · g, exactly
    const double size = g.norm();
    Flow f;
    f.x = static_cast<float>(ac.x2.x());
    if (!(y.z() > 1e-6) || !(size > 1e-9)) {
      f.across = 100.0F;
      all.push_back(f);
      continue;
    }
    const double s = sigmas.empty() ? sigma : sigmas[i];
    const Eigen::Vector2d r = (y.z() * ac.x2 - y.head<2>()) / s;
    f.along = static_cast<float>(r.dot(g) / size);
    f.across = static_cast<float>((r.x() * g.y() - r.y() * g.x()) / size);
    f.per_depth = static_cast<float>(size / s);
    const double road = down.dot(ac.x1.homogeneous());
    f.road = static_cast<float>(road);
    f.growth = static_cast<float>(ac.A.determinant() * y.z() * y.z() * y.z() - 1.0);
    f.road_growth = static_cast<float>(-3.0 * road * tz);
    all.push_back(f);
  }
  return all;
}

bool is_narrow(const std::vector<Flow>& flows) {
  struct Spread {
    float n = 0.0F, sum = 0.0F, squares = 0.0F;
    void add(float x) {
      n += 1.0F;
      sum += x;
      squares += x * x;
    }
    float variance() const { return n > 0.0F ? squares / n - (sum / n) * (sum / n) : 0.0F; }
  };
  Spread all;
  Spread dissent;
  for (const Flow& f : flows) {
    all.add(f.x);
    if (f.along > kDissents && std::abs(f.across) < kAgrees) dissent.add(f.x);
  }
  return dissent.variance() < kWideDissent * all.variance();
}

}  // namespace oneac::internal
