#include "window_costs.h"

#include "oneac/geometry/lens_model.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/normal_prior.h>
#include <ceres/rotation.h>

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <cstddef>

namespace oneac {
namespace {

// [-] 1σ of a length that only holds the gauge: what the images say does not depend on it.
constexpr double kGaugeSigma = 1e-3;
// [-] of a depth beside the inverse depth: nearer, the model has no derivative.
constexpr double kNearest = 1e-6;

struct Reprojection {
  PinholeCamera from;
  double focal;
  Eigen::Matrix3d R;            // of the view against the anchor, at the start
  Eigen::Vector3d from_anchor;  // R t_anchor
  Eigen::Vector3d t;            // of the view, at the start
  Eigen::Vector2d u;
  double weight;

  template <typename T>
  bool operator()(const T* change, const T* pose, const T* landmark, T* residual) const {
    T ray[3], turned[3];
    for (int i = 0; i < 3; ++i) {
      ray[i] =
          R(i, 0) * landmark[0] + R(i, 1) * landmark[1] + R(i, 2) - landmark[2] * from_anchor[i];
    }
    ceres::AngleAxisRotatePoint(pose, ray, turned);
    for (int i = 0; i < 3; ++i) turned[i] += landmark[2] * (t[i] + pose[3 + i]);
    if (!(turned[2] > kNearest)) return false;
    project(change, turned, residual);
    return true;
  }

 private:
  template <typename T>
  void project(const T* change, const T* X, T* residual) const {
    using std::exp;
    std::array<T, 8> k;
    for (std::size_t i = 0; i < k.size(); ++i) k[i] = T(from.distortion[i]);
    k[0] += change[kK1];
    k[1] += change[kK2];
    T distorted[2];
    distort(from.lens, k.data(), T(X[0] / X[2]), T(X[1] / X[2]), distorted);
    const T factor = exp(change[kFocal]);
    residual[0] =
        weight * (from.fx * factor * distorted[0] + from.cx + focal * change[kCentreX] - u.x());
    residual[1] =
        weight * (from.fy * factor * distorted[1] + from.cy + focal * change[kCentreY] - u.y());
  }
};

struct Length {
  Eigen::Matrix3d R;       // of the view
  Eigen::Vector3d t;       // of the view
  Eigen::Vector3d origin;  // the first view's centre
  double length;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    // |R c + t| with R c turned by w: the centre of the first view as the view sees it.
    const Eigen::Vector3d start = R * origin;
    const T from[3] = {T(start.x()), T(start.y()), T(start.z())};
    T seen[3];
    ceres::AngleAxisRotatePoint(pose, from, seen);
    T squared(0.0);
    for (int i = 0; i < 3; ++i) {
      seen[i] += t[i] + pose[3 + i];
      squared += seen[i] * seen[i];
    }
    using std::sqrt;
    residual[0] = (sqrt(squared) / length - 1.0) / kGaugeSigma;
    return true;
  }
};

}  // namespace

ceres::CostFunction* reprojection_cost(const PinholeCamera& from, const RelativePose& T_view_map,
                                       const RelativePose& T_anchor_map, const Eigen::Vector2d& u,
                                       double sigma_px) {
  const Eigen::Matrix3d R = T_view_map.R * T_anchor_map.R.transpose();
  auto* cost = new Reprojection{from, from.focal_px(), R, R * T_anchor_map.t, T_view_map.t,
                                u,    1.0 / sigma_px};
  return new ceres::AutoDiffCostFunction<Reprojection, 2, kIntrinsics, 6, 3>(cost);
}

ceres::CostFunction* length_cost(const RelativePose& first, const RelativePose& T_view_map) {
  const Eigen::Vector3d origin = first.inverse().t;
  const double length = (T_view_map * origin).norm();
  return new ceres::AutoDiffCostFunction<Length, 1, 6>(
      new Length{T_view_map.R, T_view_map.t, origin, length});
}

ceres::CostFunction* prior_cost(const IntrinsicsMatrix& information) {
  const ceres::Matrix root = information.llt().matrixU();
  return new ceres::NormalPrior(root, ceres::Vector::Zero(kIntrinsics));
}

}  // namespace oneac
